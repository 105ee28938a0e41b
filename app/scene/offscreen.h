// Drawing a planet without a window: what shot, fly and a machine without a display share.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "app/scene/scene.h"
#include "app/settings/camera_text.h"
#include "planet/gl/device/offscreen_context.h"
#include "planet/gl/device/render_target.h"
#include "planet/gl/draw/debug_lines.h"

namespace worldy {

// Declared in the order in which they need each other.
struct Offscreen {
    planet::gl::OffscreenContext context;
    planet::gl::RenderTarget target;
    Scene scene;
    std::optional<planet::gl::DebugLines> lines{};  // once any were drawn
};

planet::Result<Offscreen> openOffscreen(const SceneConfig& config, const ViewSettings& settings,
                                        const PictureSize& size, int samples);

// The picture to lay over a planet: the one named, else the one beside its file; none where there is none.
planet::Result<std::optional<Picture>> colourPictureOf(const std::filesystem::path& file,
                                                       const std::filesystem::path& colourImage);

// Draws the last selection, tints and lines over it included, and waits until the GPU has done it.
planet::Result<void> drawAndFinish(Offscreen& offscreen, const planet::View& view,
                                   const ViewSettings& settings);

Picture readPicture(const Offscreen& offscreen);

// The view from a pose, once everything for it is loaded. Its selection does not depend on earlier views:
// hysteresis and fades begin without a memory. What is resident stays, and with it a small budget and the
// height of the ground may still depend on earlier views; PlanetTools::startAnew() excludes that too. A
// camera below the ground is lifted above it. goOn is called several times a second; when it returns false,
// the view is left unsettled.
struct SettledView {
    planet::View view;
    planet::CameraPose pose;
    bool lifted = false;
    bool settled = false;  // false: the time ran out
};
SettledView settleAt(Offscreen& offscreen, const planet::CameraPose& pose, const ViewSettings& settings,
                     const std::function<bool()>& goOn = {});

}  // namespace worldy
