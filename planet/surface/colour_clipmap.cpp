#include "planet/surface/colour_clipmap.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

namespace planet {

namespace {

constexpr std::size_t texelBytes = 4;  // sRGB and an unused alpha: a format that every context can render to

int cellsOf(int level) {
    return colourTileCells << level;
}

int wrapped(int texel, int sizePx) {
    return texel & (sizePx - 1);  // sizePx is a power of two; also correct for negative texels
}

// Returns the rectangle from first to last, excluding last.
TexelRect rectOf(const glm::ivec2& first, const glm::ivec2& last) {
    return {first.x, first.y, std::max(last.x - first.x, 0), std::max(last.y - first.y, 0)};
}

}  // namespace

TexelRect intersectionOf(const TexelRect& a, const TexelRect& b) {
    return rectOf({std::max(a.x, b.x), std::max(a.y, b.y)},
                  {std::min(a.x + a.width, b.x + b.width), std::min(a.y + a.height, b.y + b.height)});
}

ClipmapLayout clipmapLayout(int sizePx, int leafLevel) {
    assert(leafLevel >= 0 && leafLevel <= maxColourLevel);
    const auto wanted = static_cast<unsigned>(std::clamp(sizePx, smallestClipmapPx, largestClipmapPx));
    const int size = static_cast<int>(std::bit_floor(wanted));
    int whole = 0;
    while (whole < leafLevel && cellsOf(whole + 1) <= size) ++whole;
    return {size, leafLevel, whole};
}

glm::ivec2 clipmapBaseSize(const ClipmapLayout& layout) {
    const int side = faceTexels(layout.wholeLevel).width;
    return {side, layout.wholeLevel > 0 ? side + faceTexels(layout.wholeLevel - 1).width : side};
}

glm::ivec2 clipmapBaseCorner(const ClipmapLayout& layout, int level) {
    assert(level >= 0 && level <= layout.wholeLevel);
    if (level == layout.wholeLevel) return {0, 0};
    glm::ivec2 corner(0, faceTexels(layout.wholeLevel).width);
    for (int finer = layout.wholeLevel - 1; finer > level; --finer) corner.x += faceTexels(finer).width;
    return corner;
}

std::size_t clipmapBaseBytes(const ClipmapLayout& layout) {
    const glm::ivec2 size = clipmapBaseSize(layout);
    return faceCount * texelBytes * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

std::size_t clipmapWindowBytes(const ClipmapLayout& layout) {
    return texelBytes * static_cast<std::size_t>(layout.sizePx) * static_cast<std::size_t>(layout.sizePx);
}

ClipmapCentre clipmapCentre(const glm::dvec3& eyeM) {
    const glm::dvec3 cube = cubeFromSphere(eyeM);
    return {cube, facePointFromCube(cube).face};
}

TexelRect faceTexels(int level) {
    const int side = colourBorderBefore + cellsOf(level) + 1 + colourBorderAfter;
    return {-colourBorderBefore, -colourBorderBefore, side, side};
}

TexelRect texelsUnder(const ChunkId& tile, int level) {
    assert(level >= tile.level);
    const TexelRect face = faceTexels(level);
    const int side = cellsOf(level - tile.level);
    const auto last = (1u << tile.level) - 1;
    const auto first = [&](std::uint32_t index) {
        return index == 0 ? face.x : static_cast<int>(index) * side;
    };
    const auto end = [&](std::uint32_t index) {
        return index == last ? face.x + face.width : static_cast<int>(index + 1) * side;
    };
    return rectOf({first(tile.x), first(tile.y)}, {end(tile.x), end(tile.y)});
}

TexelRect clipmapWindow(const ClipmapLayout& layout, const ClipmapCentre& centre, Face face, int level) {
    const FaceAxes& axes = faceAxes(face);
    const glm::dvec3& up = faceAxes(centre.home).normal;
    if (glm::dot(axes.normal, up) < -0.5) return {};  // the opposite face
    // The face is unfolded into the plane of the viewer's face.
    const double away = face == centre.home ? 0 : 1 - glm::dot(centre.cube, axes.normal);
    const glm::dvec3 unfolded = centre.cube + away * up;
    const int cells = cellsOf(level);
    const auto first = [&](const glm::dvec3& axis) {
        const double middle = (glm::dot(unfolded, axis) + 1) / 2 * cells;
        const double steps = (middle - layout.sizePx / 2.0) / clipmapStepTexels;
        return clipmapStepTexels * static_cast<int>(std::lround(steps));
    };
    const TexelRect window{first(axes.u), first(axes.v), layout.sizePx, layout.sizePx};
    // A window over the border alone shows nothing.
    if (intersectionOf(window, {0, 0, cells + 1, cells + 1}).isEmpty()) return {};
    return intersectionOf(window, faceTexels(level));
}

std::vector<TexelRect> texelsThatCameIn(const TexelRect& before, const TexelRect& now) {
    if (now.isEmpty()) return {};
    const TexelRect stay = intersectionOf(before, now);
    if (stay.isEmpty()) return {now};
    const int right = now.x + now.width;
    const int top = now.y + now.height;
    const int stayRight = stay.x + stay.width;
    const int stayTop = stay.y + stay.height;
    const std::array<TexelRect, 4> around = {
        rectOf({now.x, now.y}, {right, stay.y}), rectOf({now.x, stayTop}, {right, top}),
        rectOf({now.x, stay.y}, {stay.x, stayTop}), rectOf({stayRight, stay.y}, {right, stayTop})};
    std::vector<TexelRect> cameIn;
    for (const TexelRect& rect : around)
        if (!rect.isEmpty()) cameIn.push_back(rect);
    return cameIn;
}

std::vector<TorusPiece> onTorus(const TexelRect& texels, int sizePx) {
    assert(texels.width <= sizePx && texels.height <= sizePx);
    std::vector<TorusPiece> pieces;
    const int column = wrapped(texels.x, sizePx);
    const int row = wrapped(texels.y, sizePx);
    const int left = std::min(texels.width, sizePx - column);
    const int below = std::min(texels.height, sizePx - row);
    const auto add = [&](int skipX, int skipY, int width, int height) {
        const TexelRect part{texels.x + skipX, texels.y + skipY, width, height};
        if (!part.isEmpty()) pieces.push_back({part, skipX > 0 ? 0 : column, skipY > 0 ? 0 : row});
    };
    add(0, 0, left, below);
    add(left, 0, texels.width - left, below);
    add(0, below, left, texels.height - below);
    add(left, below, texels.width - left, texels.height - below);
    return pieces;
}

double clipmapReach(const ClipmapLayout& layout) {
    return static_cast<double>(layout.sizePx - 2 * clipmapMarginTexels) / colourTileCells;
}

ClipmapWindows::ClipmapWindows(const ClipmapLayout& layout) : layout_(layout), finest_(layout.wholeLevel) {
    forget();
}

const ClipmapWindows::Window& ClipmapWindows::at(Face face, int level) const {
    return windows_[static_cast<std::size_t>(face)][static_cast<std::size_t>(level)];
}
ClipmapWindows::Window& ClipmapWindows::at(Face face, int level) {
    return windows_[static_cast<std::size_t>(face)][static_cast<std::size_t>(level)];
}

void ClipmapWindows::change(const ChunkId& tile, int coarsest) {
    for (int level = coarsest; level <= layout_.leafLevel; ++level)
        at(tile.face, level).changed.push_back(texelsUnder(tile, level));
}

void ClipmapWindows::changeBlock(const ChunkId& parent) {
    change(parent, parent.level + 1);
}

void ClipmapWindows::changeRoot(Face face) {
    change({face, 0, 0, 0}, 0);
}

void ClipmapWindows::forget() {
    for (const Face face : allFaces) {
        for (int level = 0; level <= layout_.leafLevel; ++level) {
            Window& window = at(face, level);
            window.changed.clear();
            if (level <= layout_.wholeLevel) window.changed.push_back(faceTexels(level));
            window.texels = {};
        }
    }
}

// Stores a window's texels; allocates a layer if there are any, and frees it otherwise.
void ClipmapWindows::place(Window& window, const TexelRect& now) {
    window.texels = now;
    if (now.isEmpty() && window.layer >= 0) {
        freeLayers_.push_back(window.layer);
        window.layer = -1;
    } else if (!now.isEmpty() && window.layer < 0) {
        if (freeLayers_.empty()) freeLayers_.push_back(layerCount_++);
        window.layer = freeLayers_.back();
        freeLayers_.pop_back();
    }
}

void ClipmapWindows::moveWindow(Face face, int level, std::vector<ClipmapUpdate>& updates) {
    Window& window = at(face, level);
    const TexelRect before = window.texels;
    const TexelRect now = level <= finest_ ? clipmapWindow(layout_, centre_, face, level) : TexelRect{};
    place(window, now);
    for (const TexelRect& rect : texelsThatCameIn(before, now)) updates.push_back({face, level, rect, true});
    const TexelRect stayed = intersectionOf(before, now);
    for (const TexelRect& rect : window.changed) {
        const TexelRect seen = intersectionOf(rect, stayed);
        if (!seen.isEmpty()) updates.push_back({face, level, seen, false});
    }
    window.changed.clear();
}

void ClipmapWindows::fillWhole(Face face, int level, std::vector<ClipmapUpdate>& updates) {
    Window& window = at(face, level);
    for (const TexelRect& rect : window.changed) updates.push_back({face, level, rect, false});
    window.changed.clear();
}

std::vector<ClipmapUpdate> ClipmapWindows::move(const ClipmapCentre& centre, int finestLevel) {
    centre_ = centre;
    const int wanted = std::clamp(finestLevel, layout_.wholeLevel, layout_.leafLevel);
    finest_ = std::max(wanted, std::min(finest_, wanted + 1));
    std::vector<ClipmapUpdate> updates;
    for (const Face face : allFaces) {
        for (int level = 0; level <= layout_.leafLevel; ++level) {
            if (level <= layout_.wholeLevel)
                fillWhole(face, level, updates);
            else
                moveWindow(face, level, updates);
        }
    }
    return updates;
}

}  // namespace planet
