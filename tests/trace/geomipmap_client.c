/* A flat geomipmapping terrain (de Boer, "Fast terrain rendering using geometrical mipmapping", 2000) that traces itself:
 * a second engine beside Worldy, in C99, with faults to order.
 *
 *   geomipmap_client WHERE [FAULT [FRAME_MS]]
 *
 * WHERE is what lod_trace_open takes. The camera flies over 16 x 16 patches for 120 frames. A patch has four levels, and
 * each level is a node whose parent is the next coarser one; the coarsest ones are children of one node for the whole
 * terrain. Prints the id of the node at fault, and the first and last frame in which it is planted.
 *
 * With FRAME_MS, each frame takes that long. The flight then begins when somebody listens, and each frame is printed once
 * the writer has passed it on. */
#define LOD_TRACE_IMPLEMENTATION
#include "planet/trace/lod_trace.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { side = 16, patches = side * side, levels = 4, frames = 120 };
enum { arrives_after = 3, late_after = 60 }; /* frames */

static const double patch_m = 64, altitude_m = 60, tau_px = 2, frame_s = 1.0 / 60;
static const double errors_m[levels] = {0.8, 0.4, 0.2, 0};
static const uint64_t terrain_id = 1;
static const int faulty = 8 * side + 5; /* column 5, row 8: ahead of the camera */

typedef enum {
    none,
    drawn_twice,
    hole,
    thrash,
    late_page,
    skipped_level,
    ignores_tau,
    fault_count
} fault_kind;
static const char* const fault_names[fault_count] = {"none",      "drawn_twice",   "hole",       "thrash",
                                                     "late_page", "skipped_level", "ignores_tau"};

typedef struct {
    int wanted;       /* level by tau */
    int resident;     /* the finest level that is loaded */
    int requested_in; /* frame of the pending request of level resident + 1; -1: none */
    int was_late;     /* the late page is planted once */
} patch_state;

typedef struct {
    lod_trace* trace;
    fault_kind fault;
    patch_state patch[patches];
    lod_trace_view_info view;
    double scale_px; /* K' */
    int first_planted, last_planted;
} engine;

static uint64_t id_of(int patch, int level) {
    return 1000u + 10u * (uint64_t)patch + (uint64_t)level;
}

/* ---- linear algebra: column-major, as the trace wants it ---- */

static void look_ahead(lod_trace_view_info* view, double x, double y, double pitch) {
    /* The camera looks along +x and down; right is -y. */
    const double forward[3] = {cos(pitch), 0, sin(pitch)}, up[3] = {-sin(pitch), 0, cos(pitch)},
                 right[3] = {0, -1, 0};
    int i;
    view->eye[0] = x;
    view->eye[1] = y;
    view->eye[2] = altitude_m;
    memset(view->view, 0, sizeof view->view);
    for (i = 0; i < 3; ++i) {
        view->view[4 * i] = right[i];
        view->view[4 * i + 1] = up[i];
        view->view[4 * i + 2] = -forward[i];
        view->view[12] -= right[i] * view->eye[i];
        view->view[13] -= up[i] * view->eye[i];
        view->view[14] += forward[i] * view->eye[i];
    }
    view->view[15] = 1;
}

static void set_perspective(lod_trace_view_info* view, double horizontal_fov, int width, int height) {
    const double near_m = 1, x = 1 / tan(horizontal_fov / 2);
    memset(view->projection, 0, sizeof view->projection);
    view->projection[0] = x;
    view->projection[5] = x * width / height;
    view->projection[10] = -1;
    view->projection[11] = -1;
    view->projection[14] = -2 * near_m;
    view->viewport[2] = width;
    view->viewport[3] = height;
}

static void to_clip(const lod_trace_view_info* view, const double point[3], double clip[4]) {
    double camera[4];
    int row, i;
    for (row = 0; row < 4; ++row) {
        camera[row] = view->view[12 + row];
        for (i = 0; i < 3; ++i) camera[row] += view->view[4 * i + row] * point[i];
    }
    for (row = 0; row < 4; ++row) {
        clip[row] = 0;
        for (i = 0; i < 4; ++i) clip[row] += view->projection[4 * i + row] * camera[i];
    }
}

/* ---- the terrain ---- */

static void set_box(lod_trace_node_info* node, double west, double south, double size) {
    memset(node, 0, sizeof *node);
    node->bounds = LOD_TRACE_BOUNDS_BOX;
    node->axes[0] = node->axes[4] = node->axes[8] = 1;
    node->centre[0] = west + size / 2;
    node->centre[1] = south + size / 2;
    node->half_size[0] = node->half_size[1] = size / 2;
    node->half_size[2] = 1;
}

static double west_of(int patch) {
    return patch % side * patch_m;
}
static double south_of(int patch) {
    return patch / side * patch_m;
}

static double distance_to(const engine* e, int patch) {
    const double middle[2] = {west_of(patch) + patch_m / 2, south_of(patch) + patch_m / 2};
    double sum = (e->view.eye[2] - 1) * (e->view.eye[2] - 1);
    int i;
    for (i = 0; i < 2; ++i) {
        const double outside = fabs(e->view.eye[i] - middle[i]) - patch_m / 2;
        if (outside > 0) sum += outside * outside;
    }
    return sqrt(sum);
}

/* Returns whether all corners lie beyond one side of the frustum. */
static int is_culled(const engine* e, int patch) {
    int beyond[5] = {0, 0, 0, 0, 0}, corner, i;
    for (corner = 0; corner < 8; ++corner) {
        const double point[3] = {west_of(patch) + (corner & 1 ? patch_m : 0),
                                 south_of(patch) + (corner & 2 ? patch_m : 0), corner & 4 ? 1 : -1};
        double clip[4];
        to_clip(&e->view, point, clip);
        beyond[0] += clip[0] < -clip[3];
        beyond[1] += clip[0] > clip[3];
        beyond[2] += clip[1] < -clip[3];
        beyond[3] += clip[1] > clip[3];
        beyond[4] += clip[3] <= 0;
    }
    for (i = 0; i < 5; ++i)
        if (beyond[i] == 8) return 1;
    return 0;
}

static void tell_nodes(const engine* e) {
    lod_trace_node_info node;
    int patch, level;
    set_box(&node, 0, 0, side * patch_m);
    node.id = terrain_id;
    node.error = 2 * errors_m[0];
    while (!lod_trace_node(e->trace, &node)) lod_trace_flush(e->trace, 100);
    for (patch = 0; patch < patches; ++patch) {
        for (level = 0; level < levels; ++level) {
            set_box(&node, west_of(patch), south_of(patch), patch_m);
            node.id = id_of(patch, level);
            node.has_parent = 1;
            node.parent = level == 0 ? terrain_id : id_of(patch, level - 1);
            node.level = (uint32_t)level + 1;
            node.error = errors_m[level];
            node.triangles = 2u << 2 * (level + 2);
            node.bytes = node.triangles * 2;
            /* A real engine would keep a flag and try again in its next frame. */
            while (!lod_trace_node(e->trace, &node)) lod_trace_flush(e->trace, 100);
        }
        lod_trace_arrived(e->trace, id_of(patch, 0), 0);
    }
    lod_trace_arrived(e->trace, terrain_id, 0);
}

/* ---- a frame ---- */

static int is_planted(const engine* e, fault_kind fault, int patch, int frame) {
    return e->fault == fault && patch == faulty && frame >= e->first_planted && frame <= e->last_planted;
}

/* Loads one level after the other, and drops those that are two levels too fine. */
static void page(engine* e, int patch, int frame) {
    patch_state* p = &e->patch[patch];
    const int plants_late = e->fault == late_page && patch == faulty && p->resident == 1 && !p->was_late;
    if (p->requested_in >= 0 && frame >= p->requested_in + (plants_late ? late_after : arrives_after)) {
        if (plants_late) {
            p->was_late = 1;
            e->first_planted = p->requested_in;
            e->last_planted = frame;
        }
        p->requested_in = -1;
        ++p->resident;
        lod_trace_arrived(e->trace, id_of(patch, p->resident), 0);
    }
    if (p->requested_in >= 0 && frame == p->requested_in + 1)
        lod_trace_started(e->trace, id_of(patch, p->resident + 1), 0);
    if (p->requested_in < 0 && p->wanted > p->resident) {
        p->requested_in = frame;
        lod_trace_requested(e->trace, id_of(patch, p->resident + 1), 0, (float)(1 / distance_to(e, patch)));
    }
    if (p->requested_in < 0 && p->resident > p->wanted + 1) {
        lod_trace_evicted(e->trace, id_of(patch, p->resident), 0);
        --p->resident;
    }
}

/* Returns the coarsest level that is good enough for a tolerance. */
static int level_for(const engine* e, int patch, double tolerance_px) {
    const double distance = distance_to(e, patch);
    int level = 0;
    while (level + 1 < levels && errors_m[level] * e->scale_px / distance > tolerance_px) ++level;
    return level;
}

static void draw(engine* e, int patch, int frame) {
    const double used_tau_px = e->fault == ignores_tau ? 3 * tau_px : tau_px;
    int level = level_for(e, patch, used_tau_px);
    if (level > e->patch[patch].resident) level = e->patch[patch].resident;
    if (is_culled(e, patch)) {
        lod_trace_culled(e->trace, 0, id_of(patch, 0), LOD_TRACE_CULLED_FRUSTUM);
        return;
    }
    if (is_planted(e, hole, patch, frame)) return;
    if (is_planted(e, skipped_level, patch, frame)) level = level > 2 ? level - 2 : 0;
    if (is_planted(e, thrash, patch, frame) && frame / 4 % 2) --level;
    if (is_planted(e, drawn_twice, patch, frame)) lod_trace_drawn(e->trace, 0, id_of(patch, level - 1), 0);
    lod_trace_drawn(e->trace, 0, id_of(patch, level), 0);
}

static void run_frame(engine* e, int frame) {
    int patch;
    look_ahead(&e->view, 100 + 2.0 * frame, side * patch_m / 2, -0.35);
    lod_trace_frame_begin(e->trace, frame * frame_s);
    lod_trace_view(e->trace, 0, &e->view);
    for (patch = 0; patch < patches; ++patch) {
        e->patch[patch].wanted = level_for(e, patch, tau_px);
        page(e, patch, frame);
        draw(e, patch, frame);
    }
    lod_trace_counter(e->trace, "patches", patches);
    lod_trace_frame_end(e->trace, 1, -1);
}

static lod_trace* open_trace(const char* where) {
    lod_trace_description description;
    char error[512];
    lod_trace* trace = lod_trace_open(where, NULL, error, sizeof error);
    if (!trace) {
        fprintf(stderr, "geomipmap_client: %s\n", error);
        return NULL;
    }
    memset(&description, 0, sizeof description);
    description.name = "geomipmap terrain";
    description.kinds[0] = "heights";
    lod_trace_describe(trace, &description);
    lod_trace_setting(trace, LOD_TRACE_TAU, tau_px);
    return trace;
}

static void sleep_ms(int ms) {
#if defined(_WIN32)
    Sleep((DWORD)ms);
#else
    struct timespec time;
    time.tv_sec = ms / 1000;
    time.tv_nsec = ms % 1000 * 1000000L;
    nanosleep(&time, NULL);
#endif
}

static void fly(engine* e, int frame_ms) {
    int frame;
    while (frame_ms > 0 && !lod_trace_listening(e->trace)) sleep_ms(1);
    for (frame = 0; frame < frames; ++frame) {
        run_frame(e, frame);
        /* The test flies as fast as it can, so it waits for the writer. A real frame takes long enough. */
        if (!lod_trace_flush(e->trace, 1000) || frame_ms <= 0) continue;
        printf("frame %d\n", frame + 1);
        fflush(stdout);
        sleep_ms(frame_ms);
    }
}

static fault_kind fault_from(const char* name) {
    int i = 0;
    while (i < fault_count && strcmp(fault_names[i], name) != 0) ++i;
    return (fault_kind)i;
}

int main(int argc, char** argv) {
    static engine e;
    int fault, patch;
    const char* problem;
    e.fault = argc >= 3 ? fault_from(argv[2]) : none;
    if (argc < 2 || argc > 4 || e.fault == fault_count) {
        fprintf(stderr, "usage: geomipmap_client WHERE [FAULT [FRAME_MS]], FAULT one of:");
        for (fault = 0; fault < fault_count; ++fault) fprintf(stderr, " %s", fault_names[fault]);
        fprintf(stderr, "\n");
        return EXIT_FAILURE;
    }
    e.trace = open_trace(argv[1]);
    if (!e.trace) return EXIT_FAILURE;
    lod_trace_thread_begin(e.trace, "main");
    set_perspective(&e.view, 1.0471975511965976, 1280, 720);
    e.scale_px = e.view.projection[0] * e.view.viewport[2] / 2;
    for (patch = 0; patch < patches; ++patch) e.patch[patch].requested_in = -1;
    e.first_planted = e.fault == thrash ? 29 : 39;
    e.last_planted = e.fault == thrash ? 68 : 48;
    tell_nodes(&e);
    fly(&e, argc == 4 ? atoi(argv[3]) : 0);
    problem = lod_trace_error(e.trace);
    if (problem) fprintf(stderr, "geomipmap_client: %s\n", problem);
    /* The trace numbers frames from 1. */
    printf("%s %d %d\n", fault_names[e.fault], e.first_planted + 1, e.last_planted + 1);
    lod_trace_close(e.trace);
    return problem ? EXIT_FAILURE : EXIT_SUCCESS;
}
