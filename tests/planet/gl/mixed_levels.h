// A small planet whose chunks are selected as in the program, with all level differences that can occur.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "planet/gl/measure/crack_meter.h"
#include "planet/measure/edge_gaps.h"
#include "planet/select/lod_select.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet::gl {

class MixedLevels {
public:
    explicit MixedLevels(ChunkTree tree)
        : tree_(std::move(tree)),
          renderer_(valueOf(
              ChunkRenderer::create({tree_.shape, static_cast<std::uint32_t>(tree_.nodes.size()), {}}))) {
        forEachNode(tree_,
                    [&](NodeIndex, const ChunkNode& node) { renderer_.upload(node.slot, *node.heights); });
    }

    // Everything resident.
    static MixedLevels whole() { return MixedLevels(residentTree(fakePyramid(), 4)); }
    // Each chunk of level 1 is resident down to a level of its own, 1 to 4, so that neighbours differ by up
    // to three levels, which is the most that can be stitched.
    static MixedLevels patchy(unsigned seed) {
        std::mt19937 random(seed);
        std::array<int, 24> deepest{};
        for (int& level : deepest) level = 1 + static_cast<int>(random() % 4);
        ChunkTree tree = residentTree(fakePyramid(), 1);
        for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
            const ChunkId id = tree.nodes[i].id;
            if (tree.nodes[i].childrenState != ChildrenState::Absent) continue;
            const std::uint32_t quarter = (id.x >> (id.level - 1)) + 2 * (id.y >> (id.level - 1));
            if (id.level >= deepest[4 * static_cast<std::size_t>(id.face) + quarter]) continue;
            addFakeChildren(tree, i);
        }
        return MixedLevels(std::move(tree));
    }

    const ChunkTree& tree() const { return tree_; }
    ChunkRenderer& renderer() { return renderer_; }

    // From above the ground, however low.
    template <class Random>
    View viewFromAbove(Random& random, int widthPx, int heightPx) const {
        for (;;) {
            View view = randomView(random, tree_.shape.radiusM);
            view.widthPx = widthPx;
            view.heightPx = heightPx;
            const double groundM = tree_.shape.radiusM + residentHeightM(tree_, view.eyeM);
            if (glm::length(view.eyeM) > groundM + 500) return view;
        }
    }

    // Towards one of the widest seams that the planet can have, from any side and above the ground.
    template <class Random>
    View seamView(Random& random, int widthPx, int heightPx) {
        if (seamsM_.empty()) findSeams();
        const auto within = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        for (;;) {
            const glm::dvec3 placeM = seamsM_[random() % seamsM_.size()];
            const glm::dvec3 up = glm::normalize(placeM);
            const glm::dvec3 aside(within(-1, 1), within(-1, 1), within(-1, 1));
            View view;
            view.back = glm::normalize(glm::normalize(glm::cross(up, aside)) + within(0.1, 1.5) * up);
            view.right = glm::normalize(glm::cross(up, view.back));
            view.up = glm::cross(view.back, view.right);
            view.eyeM = placeM + within(3000, 30000) * view.back;
            view.widthPx = widthPx;
            view.heightPx = heightPx;
            const double groundM = tree_.shape.radiusM + residentHeightM(tree_, view.eyeM);
            if (glm::length(view.eyeM) > groundM + 500) return view;
        }
    }

    std::vector<DrawItem> select(const View& view, const LodSettings& settings) const {
        Selection selection;
        selectChunks(tree_, view, settings, selection);
        return selection.draw;
    }

    DrawnGround ground(std::span<const DrawItem> items, bool stitched) const {
        return {tree_.shape, items, heightsIn(tree_), stitched};
    }

    CrackMap measure(const View& view, std::span<const DrawItem> items, bool stitched) {
        return valueOf(measureCracks(renderer_, view, ground(items, stitched), drawnPairs(items),
                                     innerShellDepthM(tree_)));
    }

    // Moves one vertex of a chunk, as drawn and as the CPU knows it.
    void moveVertex(NodeIndex index, int column, int row, std::int32_t steps) {
        ChunkNode& node = tree_.nodes[index];
        std::vector<std::int32_t> heights = node.heights->view().toVector();
        heights[static_cast<std::size_t>(row * chunkSize(tree_.shape) + column)] += steps;
        node.heights = std::make_shared<const Steps>(std::span<const std::int32_t>(heights));
        renderer_.upload(node.slot, heights);
    }

private:
    void findSeams() {
        LodSettings settings = suddenLod();
        settings.tauPx = 0.01;
        settings.frustumCulling = settings.horizonCulling = false;
        const View view = viewFromPose({}, tree_.shape.radiusM, 1, 100, 100);
        const std::vector<DrawItem> items = select(view, settings);
        for (const EdgeGap& gap : edgeGaps(ground(items, false), view)) {
            if (seamsM_.size() < 40) seamsM_.push_back(gap.placeM);
        }
    }

    std::vector<glm::dvec3> seamsM_;
    ChunkTree tree_;
    ChunkRenderer renderer_;
};

}  // namespace planet::gl
