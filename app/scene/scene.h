// An open planet and what draws it: what the window, a shot and a flight share. Wants a current GL context,
// and the same one throughout.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "app/base/picture.h"
#include "app/data/layer_pictures.h"
#include "app/scene/camera_control.h"
#include "app/scene/clipmap_trace.h"
#include "app/scene/costly_parts.h"
#include "app/scene/frame_stats.h"
#include "app/settings/view_settings.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/gl/draw/planet_renderer.h"
#include "planet/planet.h"

namespace worldy {

struct Scene {
    std::unique_ptr<planet::Planet> planet;
    planet::gl::PlanetRenderer renderer;
    bool hasColourImage = false;
    // Sums over all drawScene calls since the last stepScene: an observer beside draws a second picture.
    double drawCpuMs = 0;
    planet::gl::RenderCounters drawn{};
    double exaggeration = 1;  // last asked for
    ClipmapTrace clipmap{};
    // What setPaging has refused; told once, and not tried again until it changes.
    std::optional<planet::PagingSettings> refusedPaging{};
    std::vector<std::string> problems{};  // not yet told
    LayerPictures layers{};               // read when they are first drawn
    TurnedDown turnedDown{};              // of what is Automatic; by the window's own measuring
    std::optional<double> seaSurfaceM{};  // above the radius, where it is drawn as water
    // Given by openScene; no two scenes have the same. Kept by who must see that another took its place: a
    // new planet may lie where one that is gone has lain.
    std::shared_ptr<const int> identity{};
};

struct SceneConfig {
    std::filesystem::path chunkFile;
    std::filesystem::path shaderFolder{};                   // empty: the shaders built in
    const Picture* colour = nullptr;                        // none: a ramp by height
    std::shared_ptr<planet::gl::ChunkPrograms> programs{};  // as of RendererConfig
};

planet::Result<Scene> openScene(const SceneConfig& config, const ViewSettings& settings);

// Of what an observer with a selection of its own wants: it looks at the same planet from afar, and the lod
// view is what one works on.
inline constexpr double observerPriorityFactor = 0.5;

// The user's units into the library's, here and nowhere else.
planet::LodSettings lodSettingsOf(const ViewSettings& settings);
planet::TileSettings colourSettingsOf(const ViewSettings& settings);
planet::TileSettings normalSettingsOf(const ViewSettings& settings);
// time: in place of what the settings say. software: the CPU draws, or nothing does; normals that are used
// automatically are then left out.
planet::PagingSettings pagingSettingsOf(const ViewSettings& settings, bool paused = false,
                                        std::optional<planet::PagingTime> time = std::nullopt,
                                        bool software = true);
planet::gl::RenderSettings renderSettingsOf(const ViewSettings& settings, const planet::View& view,
                                            const planet::ChunkTree& tree);

// What changes the planet itself takes effect at once: memory, loaders, the bad disk, the pause, vertical
// exaggeration. Cheap where nothing has changed. An Error comes once for each change that is refused; the
// planet then goes on as it was.
planet::Result<void> applyLiveSettings(Scene& scene, const ViewSettings& settings, bool pagingPaused = false,
                                       std::optional<planet::PagingTime> time = std::nullopt);

// One frame in two stages: choose and load by the lod view, then draw as the render view sees it.
// elapsedS: what fades and simulated paging go on by; none: by the clock.
void stepScene(Scene& scene, const planet::View& lodView, const ViewSettings& settings,
               std::optional<double> elapsedS = std::nullopt);
// The same for an observer who has a selection of its own, number 1; what it wants comes after what the lod
// view wants.
void stepScene(Scene& scene, const planet::View& lodView, const planet::View& observerView,
               const ViewSettings& settings, std::optional<double> elapsedS = std::nullopt);

// Draws a selection of the last step, with a tint for each of its items or none, into what is bound.
void drawScene(Scene& scene, const planet::View& renderView, const ViewSettings& settings,
               std::size_t selection = 0, std::span<const planet::gl::ChunkTint> tints = {},
               planet::gl::ShaderWait wait = planet::gl::ShaderWait::UntilReady);

// What has gone wrong since this was asked last, each once: blocks that could not be read, layers without
// their textures, what the context has no memory for.
std::vector<std::string> takeProblems(Scene& scene);

// The same for any chunks whose slots hold them.
void drawItems(Scene& scene, const planet::View& renderView, const ViewSettings& settings,
               std::span<const planet::DrawItem> items, bool stitched,
               std::span<const planet::gl::ChunkTint> tints = {},
               planet::gl::ShaderWait wait = planet::gl::ShaderWait::UntilReady);

// What is settled for a picture or a measurement has long done so by then.
inline constexpr double settleTimeoutS = 120;

// Steps until nothing more is wanted or can be had. False if that takes longer.
bool settleScene(Scene& scene, const planet::View& lodView, const ViewSettings& settings, double timeoutS);

// What the planet and its renderer know: selection 0, paging, stages, drawing, and the renderer's memory. The
// rest the caller knows.
FrameStats statsOf(const Scene& scene);

// What the settings want drawn over a selection: overlayLines, and the clipmap's as it was last drawn.
planet::Lines linesOver(const Scene& scene, const planet::Selection& selection,
                        const planet::View& renderView, const ViewSettings& settings);

// The sea's surface counts as ground where it is drawn as water.
Ground groundBelow(const Scene& scene, const glm::dvec3& eyeM);

}  // namespace worldy
