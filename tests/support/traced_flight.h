// A trace of an engine that is large enough to select again in: a flat quadtree of seven levels, whose camera flies down to
// it and along it for 12 s of a clock of 30 Hz. The engine selects by τ = 2 px with a hysteresis of 0.1, culls by the
// frustum, tells a node when it visits it for the first time, and gets data 5 frames after it asks for it.
//
// From frame 200 to 219 a node is drawn although it should be split (plantedFirst, plantedFrames, TracedFlight::planted).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "planet/trace/lod_trace.h"

namespace worldy::test {

class TracedFlight {
public:
    static constexpr std::uint64_t frames = 360;
    static constexpr std::uint64_t plantedFirst = 200, plantedFrames = 20;
    static constexpr double tauPx = 2, hysteresis = 0.1;

    // Writes the trace.
    explicit TracedFlight(const std::filesystem::path& file) {
        std::array<char, 512> error{};
        lod_trace_options options{};
        // Holds the whole flight, so that nothing is dropped while the writer thread waits for a core.
        options.ring_bytes = 8 << 20;
        trace_ = lod_trace_open(file.string().c_str(), &options, error.data(), error.size());
        if (!trace_) throw std::runtime_error(error.data());
        lod_trace_description description{};
        description.name = "made engine";
        description.ids = LOD_TRACE_IDS_QUADTREE;
        description.requests = LOD_TRACE_REQUESTS_CHILDREN;
        description.kinds[0] = "heights";
        lod_trace_describe(trace_, &description);
        lod_trace_setting(trace_, LOD_TRACE_TAU, tauPx);
        lod_trace_setting(trace_, LOD_TRACE_HYSTERESIS, hysteresis);
        for (frame_ = 1; frame_ <= frames; ++frame_) fly();
        const lod_trace_stats stats = lod_trace_get_stats(trace_);
        lod_trace_close(trace_);
        if (stats.dropped > 0) throw std::runtime_error("the trace dropped events");
    }

    std::uint64_t planted() const { return planted_; }  // id of the node

private:
    struct Node {
        std::uint32_t level, x, y;
        double side() const { return 8192.0 / (1u << level); }
        glm::dvec3 centre() const { return {(x + 0.5) * side() - 4096, (y + 0.5) * side() - 4096, 0}; }
        double halfHeight() const { return side() / 40; }
        double error() const { return level == lastLevel ? 0 : 40.0 / (1u << level); }
        std::uint64_t id() const { return lod_trace_quadtree_id(0, level, x, y); }
        Node child(unsigned i) const { return {level + 1, 2 * x + i % 2, 2 * y + i / 2}; }
    };
    static constexpr std::uint32_t lastLevel = 6;
    static constexpr int widthPx = 1280, heightPx = 720;
    static constexpr std::uint64_t delayFrames = 5;

    void fly() {
        const double t = static_cast<double>(frame_) / frames;
        eye_ = {-3000 + 5000 * t, -2500 + 4500 * t, 60 + 5000 * std::pow(1 - std::min(1.4 * t, 1.0), 2)};
        const glm::dvec3 ahead = glm::normalize(glm::dvec3{1, 0.9, -0.9 + 0.6 * t});
        const glm::dmat4 view = glm::lookAt(eye_, eye_ + ahead, {0, 0, 1});
        const glm::dmat4 projection =
            glm::infinitePerspective(glm::radians(40.0), static_cast<double>(widthPx) / heightPx, 1.0);
        clip_ = projection * view;
        scalePx_ = projection[0][0] * widthPx / 2;
        lod_trace_frame_begin(trace_, static_cast<double>(frame_) / 30);
        lod_trace_view_info info{};
        for (int i = 0; i < 3; ++i) info.eye[i] = eye_[i];
        for (int i = 0; i < 16; ++i)
            info.view[i] = view[i / 4][i % 4], info.projection[i] = projection[i / 4][i % 4];
        info.viewport[2] = widthPx, info.viewport[3] = heightPx;
        lod_trace_view(trace_, 0, &info);
        for (const auto& [id, arrival] : asked_) {
            if (arrival != frame_) continue;
            lod_trace_arrived(trace_, id, 0);
            there_.insert(id);
        }
        std::set<std::uint64_t> split;
        std::uint64_t drawn = 0;
        visit({0, 0, 0}, split, drawn);
        wasSplit_ = std::move(split);
        lod_trace_counter(trace_, "triangles", 2048.0 * static_cast<double>(drawn));
        lod_trace_frame_end(trace_, 3 + 0.02 * static_cast<double>(drawn),
                            4 + 0.05 * static_cast<double>(drawn));
    }

    void visit(const Node& node, std::set<std::uint64_t>& split, std::uint64_t& drawn) {
        tell(node);
        if (node.level > 0 && isOutside(node))
            return lod_trace_culled(trace_, 0, node.id(), LOD_TRACE_CULLED_FRUSTUM);
        const double px = node.error() * scalePx_ / std::max(distance(node), 1e-3);
        const bool wants = px > tauPx || (wasSplit_.contains(node.id()) && px > tauPx * (1 - hysteresis));
        if (wants && there_.contains(node.id()) && !isPlanted(node, px)) {
            split.insert(node.id());
            for (unsigned i = 0; i < 4; ++i) visit(node.child(i), split, drawn);
            return;
        }
        if (wants && asked_.try_emplace(node.id(), frame_ + delayFrames).second)
            lod_trace_requested(trace_, node.id(), 0, static_cast<float>(px / tauPx));
        ++drawn;
        lod_trace_drawn(trace_, 0, node.id(), 0);
    }

    void tell(const Node& node) {
        if (!told_.insert(node.id()).second) return;
        lod_trace_node_info info{};
        info.id = node.id();
        info.has_parent = node.level > 0;
        if (node.level > 0) info.parent = lod_trace_quadtree_id(0, node.level - 1, node.x / 2, node.y / 2);
        info.level = node.level;
        info.bounds = LOD_TRACE_BOUNDS_BOX;
        for (int axis = 0; axis < 3; ++axis) {
            info.centre[axis] = node.centre()[axis];
            info.axes[4 * axis] = 1;
            info.half_size[axis] = axis < 2 ? node.side() / 2 : node.halfHeight();
        }
        info.error = node.error();
        info.bytes = 20'000;
        info.triangles = 2048;
        if (lod_trace_node(trace_, &info) == 0) throw std::runtime_error("a node was not told");
    }

    double distance(const Node& node) const {
        const glm::dvec3 half{node.side() / 2, node.side() / 2, node.halfHeight()};
        return glm::length(glm::max(glm::abs(eye_ - node.centre()) - half, 0.0));
    }

    // Tests the node's sphere with the sides of the frustum.
    bool isOutside(const Node& node) const {
        const double radius = std::hypot(node.side() / 2, node.side() / 2, node.halfHeight());
        const glm::dmat4 rows = glm::transpose(clip_);
        for (const int axis : {0, 1}) {
            for (const double sign : {-1.0, 1.0}) {
                const glm::dvec4 plane = rows[3] + sign * rows[axis];
                const double above = glm::dot(glm::dvec3(plane), node.centre()) + plane.w;
                if (above < -radius * glm::length(glm::dvec3(plane))) return true;
            }
        }
        return false;
    }

    // The first node of level 4 that is visited then and exceeds τ a little, so that it lies ahead.
    bool isPlanted(const Node& node, double px) {
        if (frame_ < plantedFirst || frame_ >= plantedFirst + plantedFrames) return false;
        if (!hasPlanted_ && node.level == 4 && px > 1.3 * tauPx && px < 1.6 * tauPx) {
            hasPlanted_ = true;
            planted_ = node.id();
        }
        return hasPlanted_ && planted_ == node.id();
    }

    lod_trace* trace_ = nullptr;
    std::uint64_t frame_ = 0;
    bool hasPlanted_ = false;
    std::uint64_t planted_ = 0;
    glm::dvec3 eye_{0, 0, 0};
    glm::dmat4 clip_{1};
    double scalePx_ = 1;
    std::unordered_set<std::uint64_t> told_, there_;
    std::unordered_map<std::uint64_t, std::uint64_t> asked_;  // and the frame of the arrival
    std::set<std::uint64_t> wasSplit_;
};

}  // namespace worldy::test
