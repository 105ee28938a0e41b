#include "app/editor/editor_panels.h"

#include <imgui.h>

#include <cstdint>

#include "app/base/text.h"
#include "app/editor/instrument_views.h"
#include "ui/kit/inspection.h"
#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"
#include "ui/shell/bake_window.h"
#include "ui/shell/compare_overlay.h"
#include "ui/shell/status_bar.h"
#include "ui/shell/viewport_overlay.h"

namespace worldy {

namespace {

// wiped: null, or what its divider changes.
void pictureWindow(const char* name, PlanetPicture& picture, float pixelRatio,
                   CompareSettings* wiped = nullptr) {
    picture.pointer = {};
    if (!picture.shown()) return;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ui::beginFixedWindow(
        name, picture.rect,
        ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground);
    ImGui::PopStyleVar();
    const planet::gl::RenderTarget* target = picture.shownTarget();
    if (!target) return;
    const auto texture = static_cast<std::intptr_t>(target->colourTexture());
    ui::setItemScope(name);
    if (wiped) ui::wipeHandle(*wiped, picture.rect);
    ui::viewportPicture(reinterpret_cast<ImTextureID>(texture), picture.rect);
    ui::noteItem("picture");
    picture.pointer = readPointer(pixelRatio);
    if (picture.instead)
        picture.pointer.positionPx.x = planet::gl::pictureColumn(picture.mix, picture.pointer.positionPx.x);
}

void viewportWindows(const ui::EditorView& view, float pixelRatio, Editor& editor, ui::Commands& commands) {
    Viewport& viewport = editor.viewport;
    CompareSettings& compare = editor.settings.view.compare;
    const bool wiping = view.compare.on && compare.mode == CompareMode::Wipe;
    pictureWindow("viewport", viewport.main, pixelRatio, wiping ? &compare : nullptr);
    if (viewport.main.shown()) {
        if (view.planet) ui::viewportOverlay(view, editor.settings.view, viewport.main.rect);
        ImGui::End();
        if (view.inspecting) ui::inspectionNotice(view, viewport.main.rect, commands);
    }
    pictureWindow("observer", viewport.observer, pixelRatio);
    if (viewport.observer.shown()) {
        if (view.planet) {
            ui::observerOverlay(view, editor.settings.view, viewport.observer.view, viewport.observer.rect);
        }
        ImGui::End();
    }
}

ui::BakeWindowInput bakeWindowInputOf(const Session& session, const ui::EditorView& view) {
    ui::BakeWindowInput input;
    input.source = sourceName(session.data.source);
    input.progress = view.bake.progress;
    input.stopping = view.bake.stopping;
    if (!view.bake.running) input.problem = view.data.problem;
    input.canBake = session.data.chunkFile != session.data.source;
    return input;
}

// While there is no planet: the bake that it needs, or why there is none.
void emptyViewport(const Session& session, const ui::EditorView& view, const ui::Rect& rect, Editor& editor,
                   ui::Commands& commands) {
    editor.viewport.main.pointer = editor.viewport.observer.pointer = {};
    ui::beginFixedWindow("viewport", rect);
    ImGui::End();
    const ui::BakeWindowCommands asked = ui::bakeWindow(bakeWindowInputOf(session, view), rect);
    if (asked.cancel) commands.push_back(ui::CancelBake{});
    if (asked.bakeAgain) commands.push_back(ui::BakeAgain{});
}

}  // namespace

ui::EditorView gatherView(Session& session, Editor& editor) {
    ui::EditorView view{.planet = nullptr,
                        .stats = editor.stats,
                        .history = editor.history,
                        .changes = editor.changes,
                        .log = editor.logLines};
    const Scene* scene = shownScene(session);
    if (scene && editor.rig) {
        view.planet = scene->planet.get();
        view.cracks = cracksViewOf(editor.cracks, *scene, editor.viewport.main.view, editor.settings.view);
        view.camera = cameraViewOf(*editor.rig, groundBelow(*scene, editor.rig->camera.eyeM),
                                   editor.bookmarks.list, editor.flights);
        view.camera.seaSurfaceM = scene->seaSurfaceM;
    }
    view.lodView = editor.lodView;
    view.renderView = editor.viewport.main.view;
    view.lodFrozen = editor.lodFrozen;
    view.inspecting = editor.beforeInspection.has_value();
    view.framesPaused = editor.framesPaused;
    view.pagingPaused = editor.pagingPaused;
    view.timeS = editor.timeS;
    view.focus = editor.focus;
    view.data = dataViewOf(session, editor.recentShown);
    view.bake = bakeViewOf(session);
    view.presets = editor.presets.views(editor.settings.view);
    if (view.planet) view.pops = popsViewOf(editor.pops);
    view.probe = editor.probe;
    view.errors = errorsViewOf(editor.errors, editor.frames);
    view.recording = recordingViewOf(editor.desk, editor.settings.view);
    view.sweep = sweepViewOf(editor.sweep);
    view.compare =
        compareViewOf(editor.compare, session, editor.settings.view, editor.stats, editor.viewport.main.view);
    view.layers = layersViewOf(editor.layers, scene, editor.settings.view.surface.layers);
    view.light.costs = editor.costs.costs;
    view.light.measured = editor.costs.meter ? editor.costs.meter->share() : 1;
    if (scene) view.light.turnedDown = scene->turnedDown;
    view.light.software = scene && scene->renderer.chunks().capabilities().software;
    if (scene) view.light.air = scene->renderer.chunks().airFigures();
    view.allocations = editor.allocations;
    view.undoName = editor.undo.undoName();
    view.redoName = editor.undo.redoName();
    return view;
}

void drawPanels(const Session& session, const ui::EditorView& view, const ui::Layout& layout,
                float pixelRatio, Editor& editor, ui::Commands& commands) {
    Workspace& workspace = editor.settings.workspace;
    ViewSettings& settings = editor.settings.view;
    ui::menuBar(view, editor.menu, workspace, settings, commands);
    if (view.planet)
        viewportWindows(view, pixelRatio, editor, commands);
    else
        emptyViewport(session, view, layout.viewport, editor, commands);
    for (const Dock dock : {Dock::Left, Dock::Right, Dock::Bottom}) {
        ui::drawDock(dock, layout, view, editor.panels, workspace, settings, commands);
    }
    ui::statusBar(view, settings, layout.statusBar);
    ui::helpWindows(editor.menu);
    ui::confirmationLine(editor.confirmation, editor.timeS, layout.viewport);
    ui::openDialog(editor.openDialog, commands);
    ui::messageBox(editor.message, commands);
}

}  // namespace worldy
