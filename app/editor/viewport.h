// The pictures of the planet in the window: what the lod view shows, and what the observer sees of it, side
// by side or alone. Wants a current GL context; one thread.
#pragma once

#include <optional>
#include <span>

#include "app/base/log.h"
#include "app/editor/input.h"
#include "app/scene/scene.h"
#include "planet/gl/device/render_target.h"
#include "planet/gl/draw/debug_lines.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/gl/measure/picture_comparer.h"
#include "ui/model/layout.h"

namespace worldy {

struct PixelSize {
    int width = 1;
    int height = 1;
};

struct PlanetPicture {
    ui::Rect rect{};                                   // in the window; empty: not shown
    PointerInput pointer;                              // over it, in the last frame
    planet::View view;                                 // that it was drawn for
    std::optional<planet::gl::RenderTarget> target{};  // as large as the rectangle, once drawn
    // While comparing: what is shown in its place, not owned and as large, and where in it its columns lie.
    const planet::gl::RenderTarget* instead = nullptr;
    planet::gl::PictureMix mix{};

    const planet::gl::RenderTarget* shownTarget() const {
        return instead ? instead : target ? &*target : nullptr;
    }
    bool shown() const { return rect.width > 0 && rect.height > 0; }
};

struct Viewport {
    PlanetPicture main;
    PlanetPicture observer;
    std::optional<planet::gl::DebugLines> lines{};
    bool linesFailed = false;  // told once
    float pixelRatio = 1;      // of the window's units
    // Pictures are drawn in each frame, so one may show other settings until its shaders are compiled; not
    // one that is kept.
    planet::gl::ShaderWait shaderWait = planet::gl::ShaderWait::Never;
};

void layOut(Viewport& viewport, const ui::Rect& rect, ObserverMode observer, float pixelRatio);

// Also of a picture that is not shown: the lod view goes on while the observer is alone.
PixelSize pixelSizeOf(const ui::Rect& rect, float pixelRatio);

// Chunks of another frame, in the slots that hold them now.
struct KeptItems {
    std::span<const planet::DrawItem> items;
    bool stitched = false;
};

struct PictureContent {
    planet::View view;
    std::size_t selection = 0;                       // which of the planet's views chose
    std::span<const planet::gl::ChunkTint> tints{};  // of its chunks
    planet::Lines hiddenLines{};                     // the ground hides them
    planet::Lines frontLines{};                      // seen faintly through the ground
    std::optional<KeptItems> kept{};                 // drawn instead of the selection
};

// Draws into the picture's target. What fails is told in the log, and the picture stays as it was.
void drawPicture(Viewport& viewport, PlanetPicture& picture, Scene& scene, const ViewSettings& settings,
                 const PictureContent& content, const Log& log);

std::size_t gpuBytes(const Viewport& viewport);

}  // namespace worldy
