// An open planet with its renderer, for the window, shots and flights alike: open, apply settings, step,
// draw. All calls need the same current GL context.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "app/base/job.h"
#include "app/base/picture.h"
#include "app/data/layer_pictures.h"
#include "app/scene/camera_control.h"
#include "app/scene/clipmap_trace.h"
#include "app/scene/costly_parts.h"
#include "app/scene/frame_stats.h"
#include "app/scene/region_lines.h"
#include "app/settings/view_settings.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/gl/draw/planet_renderer.h"
#include "planet/planet.h"

namespace worldy {

using PictureJob = Job<planet::Result<Picture>>;

struct Scene {
    std::unique_ptr<planet::Planet> planet;
    planet::gl::PlanetRenderer renderer;
    std::filesystem::path colourImage{};          // still to be read; empty: there is none, or it was read
    std::unique_ptr<PictureJob> colourReading{};  // set while another thread reads the colour image
    bool hasColourImage = false;                  // the renderer has it
    // Sums over all draws since the last step; the observer draws a second picture per frame.
    double drawCpuMs = 0;
    planet::gl::RenderCounters drawn{};
    ClipmapTrace clipmap{};
    // Settings that setPaging refused. They are reported once and not tried again until they change.
    std::optional<planet::PagingSettings> refusedPaging{};
    std::vector<std::string> problems{};                           // not yet reported
    std::shared_ptr<const std::vector<planet::Region>> regions{};  // those that the planet was last given
    LayerPictures layers{};                                        // read when layers are first drawn
    TurnedDown turnedDown{};              // Automatic features that the window has measured to be too slow
    RegionOutlines regionOutlines{};      // as the editor last drew them
    std::optional<double> seaSurfaceM{};  // metres above the radius; set while the sea is drawn as water
    // Unique to each scene. Compare it to detect a new scene: its planet may have the address of the old one.
    std::shared_ptr<const int> identity{};
};

struct SceneConfig {
    std::filesystem::path chunkFile;
    std::filesystem::path shaderFolder{};                   // empty: the built-in shaders
    std::filesystem::path colourImage{};                    // empty: a colour ramp by height
    std::shared_ptr<planet::gl::ChunkPrograms> programs{};  // see planet::gl::RendererConfig
};

planet::Result<Scene> openScene(const SceneConfig& config, const ViewSettings& settings);

// Returns whether settings draw the colour image: a planet has no colours of its own, or does not draw them.
bool drawsColourImage(const Scene& scene, const SurfaceSettings& surface);
// Reads the colour image, if it is still to be read. Otherwise drawScene does so when it is first drawn, and tells a
// problem. Unless drawScene waits for shaders, another thread reads it, and the height ramp is drawn meanwhile.
planet::Result<void> readColourImage(Scene& scene);

// The loading priority of an observer with its own selection, relative to the LOD view.
inline constexpr double observerPriorityFactor = 0.5;

// Applies the settings that change the planet itself: memory, loaders, I/O fault injection, the pause, and
// vertical exaggeration. Cheap if nothing has changed. Returns one Error for each refused change; the planet
// then keeps its former settings.
planet::Result<void> applyLiveSettings(Scene& scene, const ViewSettings& settings, bool pagingPaused = false,
                                       std::optional<planet::PagingTime> time = std::nullopt);

// The first stage of a frame: selects and loads for the LOD view. elapsedS: the time by which fades and
// simulated paging advance; unset: the clock decides.
void stepScene(Scene& scene, const planet::View& lodView, const ViewSettings& settings,
               std::optional<double> elapsedS = std::nullopt);
// Also selects for an observer, as selection 1, whose requests come after those of the LOD view.
void stepScene(Scene& scene, const planet::View& lodView, const planet::View& observerView,
               const ViewSettings& settings, std::optional<double> elapsedS = std::nullopt);

// The second stage: draws a selection of the last step into the bound framebuffer, with one tint per item or
// none.
void drawScene(Scene& scene, const planet::View& renderView, const ViewSettings& settings,
               std::size_t selection = 0, std::span<const planet::gl::ChunkTint> tints = {},
               planet::gl::ShaderWait wait = planet::gl::ShaderWait::UntilReady);

// Returns the problems since the last call, each once: unreadable blocks, layers without textures, GPU out of
// memory.
std::vector<std::string> takeProblems(Scene& scene);

// Draws the given items, whose slots must hold their chunks.
void drawItems(Scene& scene, const planet::View& renderView, const ViewSettings& settings,
               std::span<const planet::DrawItem> items, bool stitched,
               std::span<const planet::gl::ChunkTint> tints = {},
               planet::gl::ShaderWait wait = planet::gl::ShaderWait::UntilReady);

// The time limit of settling for a picture or a measurement, in seconds.
inline constexpr double settleTimeoutS = 120;

// Steps until no more requested blocks can be loaded. Returns false if that takes longer than timeoutS.
bool settleScene(Scene& scene, const planet::View& lodView, const ViewSettings& settings, double timeoutS);

// Calls settle(timeoutS) with short timeouts until it returns true, settleTimeoutS is over, or goOn() returns
// false. Returns true if settled.
template <class Settle, class GoOn>
bool settleWhile(const Settle& settle, const GoOn& goOn) {
    constexpr int stretches = 600;
    for (int i = 0; i < stretches; ++i) {
        if (settle(settleTimeoutS / stretches)) return true;
        if (!goOn()) return false;
    }
    return false;
}

// Returns the Error of a view that did not settle within settleTimeoutS.
tl::unexpected<planet::Error> loadingTimedOut();

// Forgets what the draws since the last step drew and took, so that another draw of the same frame counts instead.
void forgetDraws(Scene& scene);

// Returns the figures of the planet and its renderer: selection 0, paging, stage times, drawing, and GPU
// memory. The caller fills in the rest.
FrameStats statsOf(const Scene& scene);

// Returns the overlay lines of a selection, including those of the clipmap as it was last drawn.
planet::Lines linesOver(const Scene& scene, const planet::Selection& selection,
                        const planet::View& renderView, const ViewSettings& settings);

// Returns the ground below an eye. The sea surface counts as ground if it is drawn as water.
Ground groundBelow(const Scene& scene, const glm::dvec3& eyeM);

}  // namespace worldy
