#include "app/editor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/trigonometric.hpp>

#include "app/stopwatch.h"
#include "ui/bake_panel.h"
#include "ui/lod_panel.h"
#include "ui/theme.h"
#include "ui/viewport_overlay.h"
#include "ui/widgets.h"

namespace worldy {

namespace {

struct PixelSize {
    int width = 1;
    int height = 1;
};

PixelSize pixelSizeOf(const ui::Rect& rect, float pixelRatio) {
    const auto pixels = [&](float units) {
        return std::max(static_cast<int>(std::lround(units * pixelRatio)), 1);
    };
    return {pixels(rect.width), pixels(rect.height)};
}

Camera startCamera(const Settings& settings, double radiusM) {
    planet::CameraPose pose = settings.camera;
    if (pose.altitudeM == 0) pose.altitudeM = wholePlanetPose(radiusM).altitudeM;
    return cameraFromPose(pose, radiusM);
}

void obeyKeys(const KeyInput& keys, const Window& window, Editor& editor) {
    ui::ViewSettings& view = editor.settings.view;
    if (keys.toggleWireframe) view.wireframe = !view.wireframe;
    if (keys.toggleFreeze) editor.lodFrozen = !editor.lodFrozen;
    if (keys.resetCamera) editor.camera.reset();
    if (keys.toggleCube) view.cube = !view.cube;
    if (keys.quit) window.close();
    editor.speedFactor =
        std::clamp(editor.speedFactor * std::pow(1.5, keys.speedSteps), minSpeedFactor, maxSpeedFactor);
}

void moveCamera(const KeyInput& keys, const Scene& scene, const PixelSize& size, Editor& editor,
                double seconds) {
    const double radiusM = scene.planet->shape().radiusM;
    if (!editor.camera) editor.camera = startCamera(editor.settings, radiusM);
    const double fovRad = glm::radians(editor.settings.view.fovDeg);
    const Ground ground = groundBelow(scene, editor.camera->eyeM);
    const planet::View view = viewOf(*editor.camera, fovRad, size.width, size.height);
    const PointerInput& pointer = editor.pointer;

    Camera camera = drag(*editor.camera, ground, view, pointer.dragPx);
    const double radAPx = 1 / planet::screenScalePx(view);
    camera = look(camera, pointer.lookPx.x * radAPx, -pointer.lookPx.y * radAPx);
    if (pointer.wheelNotches != 0) {
        camera = approach(camera, ground, rayThrough(view, pointer.positionPx), pointer.wheelNotches);
    }
    camera = moveByKeys(camera, ground, keys.held, editor.speedFactor, seconds);
    editor.camera = keepInRange(camera, groundBelow(scene, camera.eyeM));
}

planet::View renderViewOf(const Editor& editor, const PixelSize& size) {
    return viewOf(*editor.camera, glm::radians(editor.settings.view.fovDeg), size.width, size.height);
}

void chooseChunks(Scene& scene, const PixelSize& size, Editor& editor) {
    if (!editor.lodFrozen) editor.lodView = renderViewOf(editor, size);
    stepScene(scene, editor.lodView, editor.settings.view);
}

void fitTarget(const PixelSize& size, Editor& editor, const Log& log) {
    if (editor.target && editor.target->widthPx() == size.width && editor.target->heightPx() == size.height)
        return;
    editor.target.reset();
    planet::Result<planet::gl::RenderTarget> target =
        planet::gl::RenderTarget::create(size.width, size.height);
    if (target)
        editor.target.emplace(std::move(*target));
    else
        log->error("{}", target.error().message);
}

void drawPlanet(Scene& scene, const PixelSize& size, Editor& editor, const Log& log) {
    fitTarget(size, editor, log);
    if (!editor.target) return;
    editor.target->bind();
    drawScene(scene, renderViewOf(editor, size), editor.settings.view);
    editor.target->resolve();
}

ui::BakePanelCommands bakeWindow(const Session& session, const ui::Rect& viewport) {
    ui::BakePanelInput input;
    input.source = session.data.source.filename().string();
    if (session.bake) {
        input.progress = session.bake->progress();
        input.stopping = session.bake->cancelling();
    }
    if (session.problem) {
        const bool cancelled = session.problem->kind == planet::ErrorKind::Cancelled;
        input.problem = cancelled ? "The bake was cancelled." : session.problem->message;
    }
    input.canBake = session.data.chunkFile != session.data.source;
    return ui::bakePanel(input, viewport);
}

void viewportWindow(const Session& session, const ui::Rect& rect, float pixelRatio, Editor& editor) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ui::beginFixedWindow("viewport", rect, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    editor.pointer = {};
    if (session.scene && editor.target) {
        const auto texture = static_cast<std::intptr_t>(editor.target->colourTexture());
        ui::viewportPicture(reinterpret_cast<ImTextureID>(texture), rect);
        editor.pointer = readPointer(pixelRatio);
        ui::viewportOverlay(
            {session.data.source.filename().string(), editor.lodFrozen, session.scene->planet->settled(),
             editor.stats.selection.deepestLevel, editor.settings.view},
            rect);
    }
    ImGui::End();
}

ui::LodPanelCommands lodWindow(const Session& session, const ui::Rect& rect, Editor& editor) {
    ui::beginFixedWindow("lod", rect);
    ui::LodPanelInput input{editor.stats};
    input.open = session.scene.has_value();
    input.speedFactor = editor.speedFactor;
    if (session.scene && editor.camera) {
        const Ground ground = groundBelow(*session.scene, editor.camera->eyeM);
        input.camera = planet::poseFromView(viewOf(*editor.camera, 1, 1, 1), ground.radiusM);
        input.heightAboveGroundM = heightAboveGroundM(*editor.camera, ground);
        input.hasColourImage = session.scene->hasColourImage;
        input.openBudgetMB = session.scene->openBudgetMB;
    }
    const ui::LodPanelCommands commands = ui::lodPanel(input, editor.lodFrozen, editor.settings.view);
    ImGui::End();
    return commands;
}

void logWindow(const ui::Rect& rect, Editor& editor, Log& log) {
    log.moveNewLines(editor.logLines);
    ui::beginFixedWindow("log", rect);
    ui::logPanel(editor.logLines, editor.logPanel);
    ImGui::End();
}

void splitters(const ui::Layout& layout, ui::PanelSizes& sizes) {
    double movedPx = 0;
    const double unitPx = static_cast<double>(ui::unitPx());
    if (ui::splitter("lod splitter", layout.lodSplitter, true, movedPx)) {
        sizes.lodWidth = std::clamp(sizes.lodWidth - movedPx / unitPx, 160.0, 1000.0);
    }
    movedPx = 0;
    if (ui::splitter("log splitter", layout.logSplitter, false, movedPx)) {
        sizes.logHeight = std::clamp(sizes.logHeight - movedPx / unitPx, 60.0, 1000.0);
    }
}

void obeyBakePanel(const ui::BakePanelCommands& commands, Session& session, const Log& log) {
    if (commands.cancel && session.bake) session.bake->cancel();
    if (commands.bakeAgain) startBake(session, log);
}

void obeyLodPanel(const ui::LodPanelCommands& commands, Session& session, Editor& editor, const Log& log) {
    if (commands.toggleFreeze) editor.lodFrozen = !editor.lodFrozen;
    if (commands.keepCameraAsStart && session.scene && editor.camera) {
        const double radiusM = session.scene->planet->shape().radiusM;
        editor.settings.camera = planet::poseFromView(viewOf(*editor.camera, 1, 1, 1), radiusM);
        log->info("Sessions start here from now on");
    }
    if (commands.resetCamera) editor.camera.reset();
    if (commands.applyPaging) reopenScene(session, editor.settings.view, log);
}

void drawPanels(const ui::Layout& layout, float pixelRatio, Session& session, Editor& editor, Log& log) {
    viewportWindow(session, layout.viewport, pixelRatio, editor);
    const ui::LodPanelCommands lodCommands = lodWindow(session, layout.lod, editor);
    logWindow(layout.log, editor, log);
    splitters(layout, editor.settings.panels);
    if (!session.scene) obeyBakePanel(bakeWindow(session, layout.viewport), session, log);
    obeyLodPanel(lodCommands, session, editor, log);
}

}  // namespace

void runFrame(const Window& window, Session& session, Editor& editor, Log& log, double secondsSinceLast) {
    // While baking the cores have better things to do than to draw the same bar again.
    window.beginFrame(session.scene ? 0 : 0.05);
    const ui::Layout layout =
        ui::layoutOf(window.width(), window.height(), editor.settings.panels, ui::unitPx());
    const PixelSize size = pixelSizeOf(layout.viewport, window.pixelRatio());
    const KeyInput keys = readKeys(window.pressedKeys());
    obeyKeys(keys, window, editor);
    advanceSession(session, editor.settings.view, log);
    reloadChangedShaders(session, log);
    ui::FrameStats stats;
    if (session.scene) {
        moveCamera(keys, *session.scene, size, editor, secondsSinceLast);
        chooseChunks(*session.scene, size, editor);
        drawPlanet(*session.scene, size, editor, log);
        stats = statsOf(*session.scene);
    }
    const Stopwatch panelWatch;
    drawPanels(layout, window.pixelRatio(), session, editor, log);
    stats.panelsMs = panelWatch.elapsedMs();
    stats.frameMs = 1000 * secondsSinceLast;
    editor.stats = ui::smoothed(editor.stats, stats);
    window.endFrame();
}

}  // namespace worldy
