// Draws a planet without a window, for the commands and for machines without a display.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "app/base/picture.h"
#include "app/data/leaf_depths.h"
#include "app/scene/scene.h"
#include "app/scene/source_tops.h"
#include "app/settings/camera_text.h"
#include "planet/gl/device/offscreen_context.h"
#include "planet/gl/device/render_target.h"
#include "planet/gl/draw/debug_lines.h"
#include "planet/source/source_layers.h"

namespace worldy {

// The order of the members matters: later ones use earlier ones.
struct Offscreen {
    planet::gl::OffscreenContext context;
    planet::gl::RenderTarget target;
    Scene scene;
    std::optional<planet::gl::DebugLines> lines{};  // created when lines are first drawn
    std::optional<LeafDepths> depths{};             // read when a tint first needs them
    // The layers of the planet's source, whose tint and outlines are drawn if the settings ask for them. The caller opens
    // the source; without it, the chunks are grey.
    std::shared_ptr<const planet::SourceLayers> layers{};
    SourceTops tops{};
};

// Reads the colour image now if the settings draw it; an unreadable one is an Error.
planet::Result<Offscreen> openOffscreen(const SceneConfig& config, const ViewSettings& settings,
                                        const PictureSize& size, int samples);

// Returns the colour image of a planet: the named one, otherwise the one beside its file; empty if there is none.
planet::Result<std::filesystem::path> colourImageToDraw(const std::filesystem::path& file,
                                                        const std::filesystem::path& named);

// Draws the last selection with its tints and lines, and waits until the GPU has finished.
planet::Result<void> drawAndFinish(Offscreen& offscreen, const planet::View& view,
                                   const ViewSettings& settings);

Picture readPicture(const Offscreen& offscreen);

// The view from a pose after all its blocks are loaded. Hysteresis and fades are reset, so its selection does
// not depend on earlier views. Resident chunks stay, so with a small budget the height of the ground may
// still depend on earlier views; PlanetTools::reset() excludes that too. A camera below the ground is
// lifted above it. goOn is called several times per second; if it returns false, the view stays unsettled.
struct SettledView {
    planet::View view;
    planet::CameraPose pose;
    bool lifted = false;
    bool settled = false;  // false after a timeout, or if goOn returned false
};
SettledView settleAt(Offscreen& offscreen, const planet::CameraPose& pose, const ViewSettings& settings,
                     const std::function<bool()>& goOn = {});

}  // namespace worldy
