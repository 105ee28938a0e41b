// A trace of a small engine, written with lod_trace.h: a flat square with a root, four children, and four children of the
// first of these. The camera comes down over 60 frames of a clock of 10 Hz.
//
// | frames   | drawn                                                                        |
// |----------|------------------------------------------------------------------------------|
// | 1 to 20  | the root; from frame 11 on it exceeds τ, and its children are requested       |
// | 21 to 40 | its four children, whose data arrived in frame 21                            |
// | 41 to 60 | the children of the first one, and the other three                           |
#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "planet/trace/lod_trace.h"

namespace worldy::test {

inline constexpr std::uint64_t smallTraceFrames = 60;
inline constexpr double smallTraceTauPx = 2;

inline std::uint64_t smallTraceId(unsigned level, unsigned x, unsigned y) {
    return lod_trace_quadtree_id(0, level, x, y);
}

namespace detail {

inline void tellNode(lod_trace* trace, unsigned level, unsigned x, unsigned y) {
    const double side = 64.0 / (1u << level);
    lod_trace_node_info node{};
    node.id = smallTraceId(level, x, y);
    node.has_parent = level > 0;
    node.parent = level > 0 ? smallTraceId(level - 1, x / 2, y / 2) : 0;
    node.level = level;
    node.bounds = LOD_TRACE_BOUNDS_BOX;
    node.centre[0] = (x + 0.5) * side;
    node.centre[1] = (y + 0.5) * side;
    node.axes[0] = node.axes[4] = node.axes[8] = 1;
    node.half_size[0] = node.half_size[1] = side / 2;
    node.half_size[2] = 1;
    node.error = 8.0 / (1u << level);
    node.bytes = 1000;
    node.triangles = 128;
    lod_trace_node(trace, &node);
}

inline void tellView(lod_trace* trace, double height) {
    lod_trace_view_info view{};
    view.eye[0] = view.eye[1] = 16;
    view.eye[2] = 1 + height;
    view.view[0] = view.view[5] = view.view[10] = view.view[15] = 1;
    view.view[12] = view.view[13] = -16;
    view.view[14] = -view.eye[2];
    view.projection[0] = 0.5;  // K' is 100 px
    view.projection[5] = 1;
    view.projection[10] = view.projection[11] = -1;
    view.viewport[2] = 400;
    view.viewport[3] = 200;
    lod_trace_view(trace, 0, &view);
}

}  // namespace detail

// How a small trace differs from the one above.
struct SmallTraceChange {
    std::uint64_t rootFrame = 0, rootFrames = 0;  // draws only the root in so many frames from this one on
    double timeOffsetS = 0;
};

// Writes the trace. frames: of the 60, so many.
inline void writeSmallTrace(const std::filesystem::path& file, std::uint64_t frames = smallTraceFrames,
                            const SmallTraceChange& change = {}) {
    std::array<char, 512> error{};
    lod_trace* const trace = lod_trace_open(file.string().c_str(), nullptr, error.data(), error.size());
    if (!trace) throw std::runtime_error(error.data());
    lod_trace_description description{};
    description.name = "small engine";
    description.ids = LOD_TRACE_IDS_QUADTREE;
    description.kinds[0] = "heights";
    lod_trace_describe(trace, &description);
    lod_trace_setting(trace, LOD_TRACE_TAU, smallTraceTauPx);
    detail::tellNode(trace, 0, 0, 0);
    for (unsigned i = 0; i < 4; ++i) detail::tellNode(trace, 1, i % 2, i / 2);
    for (unsigned i = 0; i < 4; ++i) detail::tellNode(trace, 2, i % 2, i / 2);
    lod_trace_requested(trace, smallTraceId(0, 0, 0), 0, 9);
    lod_trace_arrived(trace, smallTraceId(0, 0, 0), 0);
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        lod_trace_frame_begin(trace, 0.1 * static_cast<double>(frame) + change.timeOffsetS);
        // The root's error is 800 / height px: 2 px at 400. That of a child is 400 / height px.
        detail::tellView(trace, frame <= 10 ? 500 : frame <= 40 ? 300 : 150);
        const bool isRoot =
            frame <= 20 || (frame >= change.rootFrame && frame < change.rootFrame + change.rootFrames);
        const unsigned level = isRoot ? 0 : frame <= 40 ? 1 : 2;
        for (unsigned i = 0; i < 4; ++i) {
            if (frame == 11)
                lod_trace_requested(trace, smallTraceId(1, i % 2, i / 2), 0, static_cast<float>(i));
            if (frame == 15) lod_trace_started(trace, smallTraceId(1, i % 2, i / 2), 0);
            if (frame == 21) lod_trace_arrived(trace, smallTraceId(1, i % 2, i / 2), 0);
            if (frame == 25) lod_trace_arrived(trace, smallTraceId(2, i % 2, i / 2), 0);
            if (level >= 1 && !(level == 2 && i == 0))
                lod_trace_drawn(trace, 0, smallTraceId(1, i % 2, i / 2), frame == 21 ? 1.0f : 0.0f);
            if (level == 2) lod_trace_drawn(trace, 0, smallTraceId(2, i % 2, i / 2), 0);
        }
        if (level == 0) lod_trace_drawn(trace, 0, smallTraceId(0, 0, 0), 0);
        lod_trace_counter(trace, "uploads", static_cast<double>(frame));
        if (frame == 30) lod_trace_message(trace, LOD_TRACE_WARNING, "half way");
        lod_trace_frame_end(trace, 2.0 + static_cast<double>(frame % 3), -1);
    }
    lod_trace_close(trace);
}

}  // namespace worldy::test
