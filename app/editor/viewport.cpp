#include "app/editor/viewport.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace worldy {

namespace {

bool fitTarget(PlanetPicture& picture, const planet::View& view, const Log& log) {
    const auto& target = picture.target;
    if (target && target->widthPx() == view.widthPx && target->heightPx() == view.heightPx) return true;
    picture.target.reset();
    planet::Result<planet::gl::RenderTarget> made =
        planet::gl::RenderTarget::create(view.widthPx, view.heightPx);
    if (!made) {
        log.error("{}", made.error().message);
        return false;
    }
    picture.target.emplace(std::move(*made));
    return true;
}

planet::gl::DebugLines* linesOf(Viewport& viewport, const Log& log) {
    if (viewport.lines) return &*viewport.lines;
    if (viewport.linesFailed) return nullptr;
    planet::Result<planet::gl::DebugLines> lines = planet::gl::DebugLines::create();
    if (lines) {
        viewport.lines.emplace(std::move(*lines));
        return &*viewport.lines;
    }
    log.error("{}", lines.error().message);
    viewport.linesFailed = true;
    return nullptr;
}

}  // namespace

void layOut(Viewport& viewport, const ui::Rect& rect, ObserverMode observer, float pixelRatio) {
    viewport.pixelRatio = pixelRatio;
    viewport.main.rect = viewport.observer.rect = {};
    switch (observer) {
        case ObserverMode::Off:
            viewport.main.rect = rect;
            return;
        case ObserverMode::Alone:
            viewport.observer.rect = rect;
            return;
        case ObserverMode::Split: {
            const float half = std::floor(rect.width / 2);
            viewport.main.rect = {rect.x, rect.y, half - 1, rect.height};
            viewport.observer.rect = {rect.x + half + 1, rect.y, rect.width - half - 1, rect.height};
            return;
        }
    }
}

PixelSize pixelSizeOf(const ui::Rect& rect, float pixelRatio) {
    const auto pixels = [&](float units) {
        return std::max(static_cast<int>(std::lround(units * pixelRatio)), 1);
    };
    return {pixels(rect.width), pixels(rect.height)};
}

void drawPicture(Viewport& viewport, PlanetPicture& picture, Scene& scene, const ViewSettings& settings,
                 const PictureContent& content, const Log& log) {
    picture.view = content.view;
    if (!fitTarget(picture, content.view, log)) return;
    picture.target->bind();
    if (content.kept)
        drawItems(scene, content.view, settings, content.kept->items, content.kept->stitched, content.tints,
                  viewport.shaderWait);
    else
        drawScene(scene, content.view, settings, content.selection, content.tints, viewport.shaderWait);
    planet::gl::DebugLines* lines = linesOf(viewport, log);
    if (lines && !settings.overlay.cube) {
        const planet::gl::Projection& projection = scene.renderer.chunks().projection();
        if (!content.hiddenLines.empty()) {
            lines->draw(content.view, projection, content.hiddenLines, 1.5f, planet::gl::LineDepth::Hidden);
        }
        if (!content.frontLines.empty()) {
            lines->draw(content.view, projection, content.frontLines, 2.0f, planet::gl::LineDepth::Faint);
        }
    }
    picture.target->resolve();
}

std::size_t gpuBytes(const Viewport& viewport) {
    const auto bytesOf = [](const auto& part) { return part ? part->gpuBytes() : 0; };
    return bytesOf(viewport.main.target) + bytesOf(viewport.observer.target) + bytesOf(viewport.lines);
}

}  // namespace worldy
