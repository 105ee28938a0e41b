#include "ui/model/chunk_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "app/base/text.h"
#include "app/scene/camera_control.h"

namespace worldy::ui {

namespace {

struct Candidate {
    const planet::DrawItem* item = nullptr;
    glm::vec2 at{0, 0};
    double distanceM = 0;
};

// Returns the middle of a chunk's surface, metres from the planet's centre.
glm::dvec3 middleM(const planet::ChunkTree& tree, const planet::ChunkNode& node, bool cube) {
    const planet::FaceSquare square = faceSquareOf(node.id);
    const glm::dvec3 onCube = cubePoint(node.id.face, square.u + square.side / 2, square.v + square.side / 2);
    const double height = heightM(tree.shape, (*node.heights)[node.heights->size() / 2]);
    if (cube) return onCube * (tree.shape.radiusM / std::sqrt(3.0)) + height * glm::normalize(onCube);
    return positionM(tree.shape, planet::sphereFromCube(onCube), height);
}

// Returns true if a sphere around the planet's centre hides a point from the eye.
bool isHidden(const glm::dvec3& eyeM, const glm::dvec3& pointM, double radiusM) {
    if (glm::dot(eyeM, eyeM) <= radiusM * radiusM) return false;
    const glm::dvec3 ray = pointM - eyeM;
    const double along = -glm::dot(eyeM, ray) / glm::dot(ray, ray);
    if (along <= 0 || along >= 1) return false;
    const glm::dvec3 nearest = eyeM + along * ray;
    return glm::dot(nearest, nearest) < radiusM * radiusM;
}

// Returns true if the face points away from the eye, so that the unprojected cube hides it.
bool isHiddenByCube(const glm::dvec3& eyeM, planet::Face face, double radiusM) {
    return glm::dot(eyeM, planet::faceAxes(face).normal) < radiusM / std::sqrt(3.0);
}

// Returns where a point is in the area that shows the picture; nothing outside of it.
std::optional<glm::vec2> onScreen(const planet::View& view, const glm::vec2& areaPx,
                                  const glm::dvec3& pointM) {
    const std::optional<glm::dvec2> pixel = pixelOf(view, pointM);
    if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x > view.widthPx || pixel->y > view.heightPx)
        return std::nullopt;
    return glm::vec2(*pixel / glm::dvec2(view.widthPx, view.heightPx)) * areaPx;
}

std::vector<Candidate> visibleMiddles(const planet::View& view, const planet::ChunkTree& tree,
                                      std::span<const planet::DrawItem> items,
                                      const ChunkLabelSettings& settings) {
    std::vector<Candidate> visible;
    for (const planet::DrawItem& item : items) {
        // The selection may be older than the tree: paging may have evicted nodes since.
        if (item.node >= tree.nodes.size() || !tree.nodes[item.node].heights) continue;
        const glm::dvec3 middle = middleM(tree, tree.nodes[item.node], settings.cube);
        const std::optional<glm::vec2> at = onScreen(view, settings.areaPx, middle);
        if (!at) continue;
        const bool hidden = settings.cube ? isHiddenByCube(view.eyeM, item.id.face, tree.shape.radiusM)
                                          : isHidden(view.eyeM, middle, tree.occluderRadiusM);
        if (!hidden) visible.push_back({&item, *at, glm::length(middle - view.eyeM)});
    }
    std::stable_sort(visible.begin(), visible.end(),
                     [](const Candidate& a, const Candidate& b) { return a.distanceM < b.distanceM; });
    return visible;
}

std::string labelText(const planet::DrawItem& item, ChunkLabels show) {
    if (show == ChunkLabels::Level) return fmt::format("{}", item.id.level);
    const std::string error = pixelsText(static_cast<double>(item.epsPx));
    return show == ChunkLabels::Error ? error : fmt::format("{}: {}", item.id.level, error);
}

// The occupied part of the picture, as a grid of cells that list the boxes touching them.
class Occupancy {
public:
    explicit Occupancy(const glm::vec2& areaPx)
        : columns_(std::max(1, static_cast<int>(areaPx.x / cellPx) + 1)),
          rows_(std::max(1, static_cast<int>(areaPx.y / cellPx) + 1)),
          cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

    bool isFree(const glm::vec2& low, const glm::vec2& high) {
        bool free = true;
        forCells(low, high, [&](const std::vector<Box>& cell) {
            free = free && std::none_of(cell.begin(), cell.end(), [&](const Box& box) {
                       return box.low.x < high.x && low.x < box.high.x && box.low.y < high.y &&
                              low.y < box.high.y;
                   });
        });
        return free;
    }

    void take(const glm::vec2& low, const glm::vec2& high) {
        forCells(low, high, [&](std::vector<Box>& cell) { cell.push_back({low, high}); });
    }

private:
    static constexpr float cellPx = 64;
    struct Box {
        glm::vec2 low, high;
    };

    template <class Visit>
    void forCells(const glm::vec2& low, const glm::vec2& high, Visit&& visit) {
        const auto cell = [](float value, int count) {
            return std::clamp(static_cast<int>(value / cellPx), 0, count - 1);
        };
        for (int row = cell(low.y, rows_); row <= cell(high.y, rows_); ++row) {
            for (int column = cell(low.x, columns_); column <= cell(high.x, columns_); ++column) {
                visit(cells_[static_cast<std::size_t>(row * columns_ + column)]);
            }
        }
    }

    int columns_;
    int rows_;
    std::vector<std::vector<Box>> cells_;
};

}  // namespace

std::vector<ChunkLabel> chunkLabels(const planet::View& view, const planet::ChunkTree& tree,
                                    std::span<const planet::DrawItem> items,
                                    const ChunkLabelSettings& settings, const TextSize& textSize) {
    std::vector<ChunkLabel> labels;
    if (settings.show == ChunkLabels::None) return labels;
    Occupancy occupancy(settings.areaPx);
    const glm::vec2 gap(settings.gapPx);
    for (const Rect& rect : settings.taken) {
        occupancy.take(glm::vec2(rect.x, rect.y) - gap,
                       glm::vec2(rect.x + rect.width, rect.y + rect.height) + gap);
    }
    for (const Candidate& candidate : visibleMiddles(view, tree, items, settings)) {
        // The text is made only if its middle is free.
        if (!occupancy.isFree(candidate.at, candidate.at)) continue;
        std::string text = labelText(*candidate.item, settings.show);
        const glm::vec2 size = textSize(text);
        const glm::vec2 low = glm::round(candidate.at - size / 2.0f);
        const glm::vec2 high = low + size;
        if (low.x < gap.x || low.y < gap.y || high.x + gap.x > settings.areaPx.x ||
            high.y + gap.y > settings.areaPx.y || !occupancy.isFree(low, high)) {
            continue;
        }
        occupancy.take(low - gap, high + gap);
        labels.push_back({candidate.item->id, std::move(text), low, size});
    }
    return labels;
}

}  // namespace worldy::ui
