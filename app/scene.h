// An open planet and what draws it: what the window, a shot and a flight share. Wants a current GL context,
// and the same one throughout.
#pragma once

#include <filesystem>
#include <memory>

#include "app/camera_control.h"
#include "app/picture.h"
#include "planet/gl/chunk_renderer.h"
#include "planet/planet.h"
#include "ui/frame_stats.h"
#include "ui/view_settings.h"

namespace worldy {

struct Scene {
    std::unique_ptr<planet::Planet> planet;
    planet::gl::ChunkRenderer renderer;
    bool hasColourImage = false;
    int openBudgetMB = 0;
    double drawCpuMs = 0;  // of the last drawScene
};

struct SceneConfig {
    std::filesystem::path chunkFile;
    std::filesystem::path shaderFolder;  // empty: the shaders built in
    const Picture* colour = nullptr;     // none: a ramp by height
};

planet::Result<Scene> openScene(const SceneConfig& config, const ui::ViewSettings& settings);

// The user's units into the library's, here and nowhere else.
planet::LodSettings lodSettingsOf(const ui::ViewSettings& settings);
planet::gl::RenderSettings renderSettingsOf(const ui::ViewSettings& settings, const planet::View& view,
                                            const planet::ChunkTree& tree);

// One frame in two stages: choose and load by the lod view, then draw as the render view sees it.
void stepScene(Scene& scene, const planet::View& lodView, const ui::ViewSettings& settings);
void drawScene(Scene& scene, const planet::View& renderView, const ui::ViewSettings& settings);

// Steps until nothing more is wanted or can be had. False if that takes longer.
bool settleScene(Scene& scene, const planet::View& lodView, const ui::ViewSettings& settings,
                 double timeoutS);

// All but the frame and panel times, which the caller knows.
ui::FrameStats statsOf(const Scene& scene);

Ground groundBelow(const Scene& scene, const glm::dvec3& eyeM);

}  // namespace worldy
