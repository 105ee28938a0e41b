// The planet's pictures in the window: the LOD view's and the observer's, side by side or alone. Needs a
// current GL context; one thread.
#pragma once

#include <optional>
#include <span>

#include "app/base/log.h"
#include "app/scene/scene.h"
#include "app/window/input.h"
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
    planet::View view;                                 // the view that was drawn
    std::optional<planet::gl::RenderTarget> target{};  // as large as rect once drawn
    // While comparing: the target shown instead, not owned and of the same size, and the mix of its columns.
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
    bool linesFailed = false;  // has been reported
    float pixelRatio = 1;      // pixels per window unit
    // Whether drawing waits for shaders. A live picture may use stand-in shaders until its own are compiled,
    // but a saved picture must not.
    planet::gl::ShaderWait shaderWait = planet::gl::ShaderWait::Never;
};

void layOut(Viewport& viewport, const ui::Rect& rect, ObserverMode observer, float pixelRatio);

// Returns the size of a picture, also of one that is not shown: the LOD view continues while only the
// observer is shown.
PixelSize pixelSizeOf(const ui::Rect& rect, float pixelRatio);

// Chunks of another frame, with the slots that hold them now.
struct KeptItems {
    std::span<const planet::DrawItem> items;
    bool stitched = false;
};

struct PictureContent {
    planet::View view;
    std::size_t selection = 0;                       // index of the planet view that selected the chunks
    std::span<const planet::gl::ChunkTint> tints{};  // of the chunks
    planet::Lines hiddenLines{};                     // occluded by the ground
    planet::Lines frontLines{};                      // drawn faintly through the ground
    std::optional<KeptItems> kept{};                 // drawn instead of the selection
};

// Draws into the picture's target. Failures are logged, and the picture then stays as it was.
void drawPicture(Viewport& viewport, PlanetPicture& picture, Scene& scene, const ViewSettings& settings,
                 const PictureContent& content, const Log& log);

std::size_t gpuBytes(const Viewport& viewport);

}  // namespace worldy
