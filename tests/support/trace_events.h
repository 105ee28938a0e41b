// Writes small traces through lod_trace.h and reads them back.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "planet/trace/lod_trace.h"
#include "planet/trace/trace_reader.h"
#include "planet/trace/trace_state.h"
#include "tests/support/temporary_folder.h"

namespace planet::test {

// An open trace; closed by the destructor.
class OpenTrace {
public:
    explicit OpenTrace(const std::string& where, const lod_trace_options& options = {}) {
        char error[512];
        trace_ = lod_trace_open(where.c_str(), &options, error, sizeof error);
        EXPECT_NE(trace_, nullptr) << error;
    }
    OpenTrace(const OpenTrace&) = delete;
    OpenTrace& operator=(const OpenTrace&) = delete;
    ~OpenTrace() { close(); }
    operator lod_trace*() const { return trace_; }
    void close() {
        lod_trace_close(trace_);
        trace_ = nullptr;
    }

private:
    lod_trace* trace_ = nullptr;
};

inline std::span<const std::byte> bytesOf(const std::string& content) {
    return std::as_bytes(std::span(content));
}

struct ReadTrace {
    std::vector<TraceEvent> events;
    std::string problem;  // empty: whole
};

inline ReadTrace readTrace(std::span<const std::byte> bytes) {
    ReadTrace read;
    TraceReader reader("made", [&](const TraceEvent& event) { read.events.push_back(event); });
    Result<void> result = reader.feed(bytes);
    if (result) result = reader.finish();
    if (!result) read.problem = result.error().message;
    return read;
}

template <class Event>
std::vector<Event> eventsOf(const std::vector<TraceEvent>& events) {
    std::vector<Event> found;
    for (const TraceEvent& event : events)
        if (const Event* one = std::get_if<Event>(&event)) found.push_back(*one);
    return found;
}

inline lod_trace_node_info sphereNode(std::uint64_t id, std::uint32_t level = 0) {
    lod_trace_node_info node{};
    node.id = id;
    node.level = level;
    node.bounds = LOD_TRACE_BOUNDS_SPHERE;
    node.centre[0] = static_cast<double>(id);
    node.radius = 1.5;
    node.error = 0.25 * static_cast<double>(id);
    return node;
}

inline lod_trace_view_info someView(double x) {
    lod_trace_view_info view{};
    view.eye[0] = x;
    for (int i = 0; i < 4; ++i) view.view[5 * i] = view.projection[5 * i] = 1;
    view.viewport[2] = 1280;
    view.viewport[3] = 720;
    return view;
}

}  // namespace planet::test
