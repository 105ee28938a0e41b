#define LOD_TRACE_IMPLEMENTATION
#include "planet/trace/lod_trace.h"

#include <stdio.h>

int main(int argc, char** argv) {
    char error[512];
    /* A file, or "tcp:127.0.0.1:9910" for a tool that attaches. */
    lod_trace* trace = lod_trace_open(argc > 1 ? argv[1] : "engine.lodtrace", NULL, error, sizeof error);
    lod_trace_description engine = {0};
    lod_trace_node_info node = {0};
    lod_trace_view_info view = {{0, 0, 500}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -500, 1}, {0}, {0, 0, 1280, 720}};
    if (!trace) fprintf(stderr, "no trace: %s\n", error); /* the engine runs on: all calls do nothing */
    engine.name = "my engine";
    lod_trace_describe(trace, &engine);
    lod_trace_setting(trace, LOD_TRACE_TAU, 2.0); /* pixels */
    node.id = 1;
    node.bounds = LOD_TRACE_BOUNDS_SPHERE;
    node.radius = 100;
    node.error = 0.5; /* metres */
    view.projection[0] = 1, view.projection[5] = 16.0 / 9, view.projection[10] = view.projection[11] = -1;
    for (int frame = 0, is_told = 0; frame < 60; ++frame) {
        if (!is_told) is_told = lod_trace_node(trace, &node); /* again until it returns 1 */
        lod_trace_frame_begin(trace, frame / 60.0);
        lod_trace_view(trace, 0, &view);
        if (frame == 10) lod_trace_requested(trace, node.id, 0, 1.0f); /* on any thread */
        if (frame == 13) lod_trace_arrived(trace, node.id, 0);
        lod_trace_drawn(trace, 0, node.id, 0.0f);
        lod_trace_counter(trace, "triangles", 1024);
        lod_trace_frame_end(trace, 4.2, -1);
    }
    lod_trace_close(trace);
    return 0;
}
