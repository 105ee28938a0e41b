// Planets made for GL tests: every chunk's heights come from one function of the direction.
#pragma once

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "planet/gl/draw/chunk_renderer.h"
#include "planet/sphere/vertex_position.h"
#include "tests/support/made_heights.h"

namespace planet::gl {

// Uploads chunks into slots 0, 1, ... and keeps the list of what to draw.
class TestPlanet {
public:
    TestPlanet(const PlanetShape& shape, std::uint32_t slotCapacity)
        : shape_(shape), renderer_(makeRenderer(shape, slotCapacity)) {}

    void add(const ChunkId& id, const HeightFunction& height, float skirtDepthM = 0) {
        const auto slot = static_cast<std::uint32_t>(items_.size());
        renderer_.upload(slot, chunkSteps(shape_, id, height));
        DrawItem item;
        item.id = id;
        item.slot = slot;
        item.skirtDepthM = skirtDepthM;
        items_.push_back(item);
    }
    void addLevel(int level, const HeightFunction& height, float skirtDepthM = 0) {
        for (const Face face : allFaces) {
            for (std::uint32_t y = 0; y < 1u << level; ++y) {
                for (std::uint32_t x = 0; x < 1u << level; ++x)
                    add({face, static_cast<std::uint8_t>(level), x, y}, height, skirtDepthM);
            }
        }
    }

    const PlanetShape& shape() const { return shape_; }
    ChunkRenderer& renderer() { return renderer_; }
    std::vector<DrawItem>& items() { return items_; }

private:
    static ChunkRenderer makeRenderer(const PlanetShape& shape, std::uint32_t slotCapacity) {
        Result<ChunkRenderer> renderer = ChunkRenderer::create({shape, slotCapacity, {}});
        if (!renderer) throw std::runtime_error(renderer.error().message);
        return std::move(*renderer);
    }

    PlanetShape shape_;
    ChunkRenderer renderer_;
    std::vector<DrawItem> items_;
};

inline View viewFrom(const PlanetShape& shape, double latitudeDeg, double longitudeDeg, double altitudeM,
                     double pitchDeg = -90, double headingDeg = 0, int widthPx = 320, int heightPx = 240) {
    return viewFromPose({latitudeDeg, longitudeDeg, altitudeM, headingDeg, pitchDeg}, shape.radiusM,
                        glm::radians(60.0), widthPx, heightPx);
}

}  // namespace planet::gl
