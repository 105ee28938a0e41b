#include "app/editor/editor_panels.h"

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>

#include "app/base/text.h"
#include "ui/kit/inspection.h"
#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"
#include "ui/shell/bake_window.h"
#include "ui/shell/compare_overlay.h"
#include "ui/shell/docks.h"
#include "ui/shell/drop_question.h"
#include "ui/shell/focus.h"
#include "ui/shell/help_windows.h"
#include "ui/shell/menu_bar.h"
#include "ui/shell/note_pins.h"
#include "ui/shell/palette.h"
#include "ui/shell/quit_question.h"
#include "ui/shell/status_bar.h"
#include "ui/shell/viewport_overlay.h"

namespace worldy {

namespace {

// drawBefore: draws the items that lie over the picture.
template <class DrawBefore>
void pictureWindow(const char* name, PlanetPicture& picture, float pixelRatio, const DrawBefore& drawBefore) {
    picture.pointer = {};
    if (!picture.shown()) return;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ui::beginFixedWindow(name, picture.rect,
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                             ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNavInputs);
    ImGui::PopStyleVar();
    const planet::gl::RenderTarget* target = picture.shownTarget();
    if (!target) return;
    const auto texture = static_cast<std::intptr_t>(target->colourTexture());
    ui::setItemScope(name);
    drawBefore();
    ui::viewportPicture(reinterpret_cast<ImTextureID>(texture), picture.rect);
    ui::noteItem("picture");
    picture.pointer = readPointer(pixelRatio);
    if (picture.instead)
        picture.pointer.positionPx.x = planet::gl::pictureColumn(picture.mix, picture.pointer.positionPx.x);
}

void viewportWindows(const ui::EditorView& view, ViewSettings& settings, Viewport& viewport,
                     ui::Commands& commands) {
    const float pixelRatio = viewport.pixelRatio;
    CompareSettings& compare = settings.compare;
    const bool wiping = view.compare.on && compare.mode == CompareMode::Wipe;
    pictureWindow("viewport", viewport.main, pixelRatio, [&] {
        if (wiping) ui::wipeHandle(compare, viewport.main.rect);
        ui::notePinItems(view, settings, viewport.main.rect, commands);
    });
    if (viewport.main.shown()) {
        if (view.planet) ui::viewportOverlay(view, settings, viewport.main.rect);
        ImGui::End();
        if (view.camera.inspecting) ui::inspectionNotice(view, viewport.main.rect, commands);
    }
    pictureWindow("observer", viewport.observer, pixelRatio, [] {});
    settings.camera.fovDeg = narrowedFovDeg(
        settings.camera.fovDeg, viewport.main.pointer.fovNotches + viewport.observer.pointer.fovNotches);
    if (viewport.observer.shown()) {
        if (view.planet) {
            ui::observerOverlay(view, settings, viewport.observer.view, viewport.observer.rect);
        }
        ImGui::End();
    }
}

ui::BakeWindowInput bakeWindowInputOf(const Session& session, const ui::EditorView& view) {
    ui::BakeWindowInput input;
    input.source = sourceName(session.data.source);
    input.progress = view.bake.progress.bake;
    input.stopping = view.bake.stopping;
    if (!view.bake.running) input.problem = view.data.problem;
    input.canBake = session.data.chunkFile != session.data.source;
    return input;
}

// Draws the viewport without a planet: the bake that it needs, or why there is no planet.
void emptyViewport(const Session& session, const ui::EditorView& view, const ui::Rect& rect,
                   Viewport& viewport, ui::Commands& commands) {
    viewport.main.pointer = viewport.observer.pointer = {};
    ui::beginFixedWindow("viewport", rect, ImGuiWindowFlags_NoNavInputs);
    ImGui::End();
    const ui::BakeWindowCommands asked = ui::bakeWindow(bakeWindowInputOf(session, view), rect);
    if (asked.cancel) commands.push_back(ui::CancelBake{});
    if (asked.bakeAgain) commands.push_back(ui::BakeAgain{});
}

// Returns true if the command moves the camera to something that the user wants to see.
bool leadsToAPlace(const ui::Command& command) {
    return command.as<ui::MoveCamera>() || command.as<ui::InspectPlace>() || command.as<ui::LookAtChunk>() ||
           command.as<ui::GoBackToPop>() || command.as<ui::LookAsTrace>() || command.as<ui::LookFromAtlas>();
}

// Paints the chosen region where the pointer is pressed on the main picture, for which the camera stays where it is, or sets
// a corner where it was clicked.
void paintRegion(ui::RegionsPanelState& state, const ui::EditorView& view, const PanelContext& context) {
    PointerInput& pointer = context.viewport.main.pointer;
    const std::optional<glm::dvec3> last = std::exchange(state.strokeM, std::nullopt);
    if (!view.pointedM || !regionDraft(state, context.settings, view.pointedM)) return;
    if (state.brush.mode == ui::BrushMode::Polygon) {
        if (std::exchange(pointer.clicked, false)) ui::addCorner(*view.pointedM, state.corners);
        return;
    }
    if (!pointer.isPressed && !pointer.clicked) return;
    pointer.dragPx = {0, 0};
    pointer.clicked = false;
    const double radiusM = view.planet->tree().shape.radiusM;
    ui::paint(state.brush, state.chosen, {last.value_or(*view.pointedM), *view.pointedM}, radiusM,
              context.settings.view.regions);
    if (pointer.isPressed) state.strokeM = view.pointedM;
}

}  // namespace

std::optional<planet::Region> regionDraft(const ui::RegionsPanelState& state, const Settings& settings,
                                          const std::optional<glm::dvec3>& groundM) {
    const bool isDrawing = state.brush.mode != ui::BrushMode::Off &&
                           state.chosen < settings.view.regions.all().size() &&
                           isShown(settings.workspace, PanelId::Regions);
    if (!isDrawing) return std::nullopt;
    return ui::draftAt(state.brush, state.corners, groundM);
}

void drawPanels(WindowController& window, const PanelContext& context, ui::Commands& commands) {
    const ui::EditorView& view = context.view;
    const ui::Rect& middle = context.layout.viewportCovered ? context.layout.area : context.layout.viewport;
    Workspace& workspace = context.settings.workspace;
    ViewSettings& settings = context.settings.view;
    const ui::ActionContext actions{view, settings, workspace, window.menu, window.keys, commands};
    ui::menuBar(actions);
    if (context.layout.viewportCovered)
        context.viewport.main.pointer = context.viewport.observer.pointer = {};
    else if (view.planet)
        viewportWindows(view, settings, context.viewport, commands);
    else
        emptyViewport(context.session, view, middle, context.viewport, commands);
    if (view.planet) paintRegion(window.panels.regions, view, context);
    ui::drawDocks(context.layout, view, window.panels, window.docks, workspace, settings, commands);
    // A maximised dock would hide the place.
    if (ui::maximisedDock(workspace) && std::any_of(commands.begin(), commands.end(), leadsToAPlace))
        workspace.maximised = MaximisedDock::None;
    ui::statusBar(view, settings, context.layout.statusBar);
    ui::helpWindows(actions);
    ui::layoutWindows(view, window.menu.layout, commands);
    Notices& notices = context.notices;
    const float below = ui::confirmationLine(notices.confirmation, notices.timeS, middle);
    ui::alertBoxes(notices.alerts, notices.timeS, middle, below);
    ui::openDialog(context.openDialog, commands);
    ui::messageBox(notices.message, commands);
    ui::dropQuestion(view.sources, commands);
    ui::quitQuestion(view.settings, commands);
    ui::palette(actions);
    ui::followFocus(workspace, window.menu);
}

}  // namespace worldy
