// Traces what an engine's level of detail does, frame by frame, into a file or to a tool that attaches to the running
// engine. One file, C99 or C++, no dependencies. README.md beside this file has a guide, the drop policy, and the
// format byte by byte.
//
//   #define LOD_TRACE_IMPLEMENTATION   // in exactly one source file, before any other include
//   #include "lod_trace.h"
//
// Define LOD_TRACE_DISABLE in every file to compile all calls to nothing. On Windows, link ws2_32. On POSIX, link the
// threads library (-pthread).
//
// WHAT TO CALL. Only lod_trace_open is necessary. What an engine does not tell is left out of the trace, and the tools
// say what they cannot show without it.
//
//   once         lod_trace_open, lod_trace_describe, lod_trace_setting...; at the end lod_trace_close
//   a node       lod_trace_node, when it becomes known and again when its values change
//   a frame      lod_trace_frame_begin, lod_trace_view for each view, lod_trace_drawn for each drawn node,
//                lod_trace_frame_end
//   paging       lod_trace_requested, _started, _arrived, _cancelled, _failed, _evicted
//   any time     lod_trace_setting, lod_trace_counter, lod_trace_message
//
// COST. A call copies its values into a ring of the calling thread: no lock, no system call, no allocation, no wait. A
// writer thread encodes and writes. Nothing in an engine depends on a trace: a call never fails the engine, and a null
// trace, as lod_trace_open returns it after an error, makes every call return at once. While nobody listens, the calls of
// a frame return at once too; nodes, settings and paging are still noted, because a tool that attaches later needs them.
//
// THREADS. Every call but lod_trace_open and lod_trace_close may come from any thread at any time. The calls of one frame
// (frame_begin, view, drawn, culled, frame_end) come from one thread, which may be another one in the next frame. A ring
// belongs to the thread that uses it until lod_trace_thread_end. Open several traces if several engines run in a process.
//
// VALUES of an enumeration below that this version does not know count as the first one; a reason for culling as
// LOD_TRACE_CULLED_OTHER, and a severity as LOD_TRACE_ERROR. Views and kinds out of range leave the event out.
//
// STRINGS are UTF-8, are copied before a call returns, and are cut at LOD_TRACE_MAX_NAME or LOD_TRACE_MAX_TEXT bytes.
//
// COORDINATES. World positions are doubles in the unit that lod_trace_description::metres_per_unit states, right-handed,
// with the planet's centre as the origin and z towards the north pole if the shape is a sphere. Matrices have 16 doubles in column-major order and
// multiply column vectors, as in OpenGL and GLM: m[12], m[13], m[14] are a translation.
//
// TIME. Events are stamped with a monotonic clock in nanoseconds, lod_trace_now_ns.
//
// MIT License
//
// Copyright (c) 2026 the Worldy authors
//
// Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
// documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
// rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
// persons to whom the Software is furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
// Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
// WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
// COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
// OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.

// NOLINTBEGIN: the checks of the project are for C++, and this file is C as well.

#if defined(LOD_TRACE_IMPLEMENTATION) && !defined(_WIN32) && !defined(__cplusplus)
// A strict -std=c99 hides the functions of POSIX.
#if !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200809L
#endif
#if defined(__APPLE__) && !defined(_DARWIN_C_SOURCE)
#define _DARWIN_C_SOURCE 1
#endif
#endif

#ifndef LOD_TRACE_H
#define LOD_TRACE_H

#include <stddef.h>
#include <stdint.h>

#define LOD_TRACE_VERSION 1      // of the format
#define LOD_TRACE_MAX_VIEWS 16   // views are numbered 0 to 15
#define LOD_TRACE_MAX_KINDS 4    // kinds of data that are paged are numbered 0 to 3
#define LOD_TRACE_MAX_NAME 255   // bytes of a name or a reason
#define LOD_TRACE_MAX_TEXT 4095  // bytes of a message or the text of a setting

// The setting that tools compare errors on screen with, in pixels, > 0: a node is good enough while its error on screen is
// at most tau. "tau" applies to all views, "tau/2" to view 2 only.
#define LOD_TRACE_TAU "tau"
// Other names that tools know. Hysteresis h in [0, 1): a split node stays split until its error is at most tau (1 - h).
// Max level: nodes of this level are never split.
#define LOD_TRACE_HYSTERESIS "hysteresis"
#define LOD_TRACE_MAX_LEVEL "max_level"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lod_trace lod_trace;

// The world's shape.
enum { LOD_TRACE_FLAT = 0, LOD_TRACE_SPHERE = 1 };

// The meaning of the 64 bits of a node's id.
enum {
    LOD_TRACE_IDS_OPAQUE = 0,   // only that different nodes have different ids
    LOD_TRACE_IDS_QUADTREE = 1  // face, level, x and y, as lod_trace_quadtree_id packs them
};

// The unit of lod_trace_node_info::error.
enum {
    LOD_TRACE_ERROR_WORLD = 0,  // a distance in world units; on screen it is error * K' / D, see below
    LOD_TRACE_ERROR_PIXELS = 1  // pixels on screen already
};
// D is the distance from the eye to the node's bounds, and K' the pixels that a unit covers at a distance of a unit:
// K' = |projection[0]| * viewport width / 2, which is W / (2 tan(Hfov / 2)) for a symmetric perspective.

// The nodes that a request loads.
enum {
    LOD_TRACE_REQUESTS_NODE = 0,  // the node that it names
    LOD_TRACE_REQUESTS_CHILDREN =
        1  // all children of the node that it names; nodes without a parent are always there
};

enum { LOD_TRACE_BOUNDS_NONE = 0, LOD_TRACE_BOUNDS_SPHERE = 1, LOD_TRACE_BOUNDS_BOX = 2 };

// Why a node and all its descendants are not drawn in a view.
enum {
    LOD_TRACE_CULLED_FRUSTUM = 0,
    LOD_TRACE_CULLED_HORIZON = 1,
    LOD_TRACE_CULLED_OCCLUSION = 2,
    LOD_TRACE_CULLED_OTHER = 3
};

enum { LOD_TRACE_INFO = 0, LOD_TRACE_WARNING = 1, LOD_TRACE_ERROR = 2 };

// Zero-initialise it, then set what differs from the defaults.
typedef struct lod_trace_options {
    uint32_t ring_bytes;   // of a thread: a power of two in [16 KiB, 64 MiB]; 0: 1 MiB
    uint32_t max_threads;  // that use the trace at the same time, [1, 64]; 0: 16
    uint32_t wake_ms;      // between two looks of the writer thread into the rings, [1, 1000]; 0: 5 ms
} lod_trace_options;

typedef struct lod_trace_description {
    const char* name;                        // of the engine or scene; NULL: unnamed
    int shape;                               // LOD_TRACE_FLAT or LOD_TRACE_SPHERE
    double radius;                           // of a sphere, world units, > 0
    double metres_per_unit;                  // > 0; 0 stands for 1
    int ids;                                 // LOD_TRACE_IDS_...
    int error;                               // LOD_TRACE_ERROR_...
    int requests;                            // LOD_TRACE_REQUESTS_...
    const char* kinds[LOD_TRACE_MAX_KINDS];  // names of the kinds of data that are paged; NULL: unnamed
} lod_trace_description;

typedef struct lod_trace_node_info {
    uint64_t id;
    uint64_t parent;   // id of the parent, if has_parent
    int has_parent;    // 0 for a root
    uint32_t level;    // 0 at a root; a child's is larger by one
    int bounds;        // LOD_TRACE_BOUNDS_...: a volume that holds all that the node and its descendants draw
    double centre[3];  // of the sphere or box, world units
    double radius;     // of the sphere, world units
    double axes
        [9];  // of the box: three unit vectors x, y, z after each other, orthogonal; the third is roughly up
    double half_size[3];  // of the box, along each axis, world units
    double error;         // >= 0, as lod_trace_description::error says
    uint64_t bytes;       // of the node's data; 0: unknown
    uint64_t triangles;   // when it is drawn; 0: unknown
} lod_trace_node_info;

typedef struct lod_trace_view_info {
    double eye[3];          // world units
    double view[16];        // camera from world; the camera looks along -z
    double projection[16];  // clip from camera, any depth range
    int32_t viewport[4];    // x, y, width, height, pixels
} lod_trace_view_info;

// Counts since lod_trace_open.
typedef struct lod_trace_stats {
    uint64_t dropped;      // events that had no room, in a ring or because a listener was too slow
    uint64_t refused;      // calls of node, setting or describe that returned 0
    uint64_t unringed;     // of dropped: events of threads beyond max_threads
    uint64_t events;       // in the stream, over all connections
    uint64_t bytes;        // in the stream, over all connections
    uint64_t connections;  // of tools; 1 for a file
    uint64_t nodes;        // known nodes
    int listening;         // 1: a tool is attached, or the file can be written
} lod_trace_stats;

#ifndef LOD_TRACE_DISABLE

// Opens a trace and starts its writer thread. Rings are allocated here, and never in a call below.
//   where    a path: a file is written. An existing trace is replaced; any other existing file is an error.
//            "tcp:127.0.0.1:PORT": a tool attaches there, one at a time, and may come and go. Port 0 takes a free port.
//   options  NULL for the defaults
//   error    receives why NULL is returned: "<where>: <what is wrong>; expected <what is right>". May be NULL.
lod_trace* lod_trace_open(const char* where, const lod_trace_options* options, char* error,
                          size_t error_bytes);

// Writes what is left, stops the writer thread and frees the trace. A tool that does not read gets a second at most. No
// other call on this trace may run or follow.
void lod_trace_close(lod_trace* trace);

// Describes the engine. Call it before the first node; a later call replaces the description. Returns as lod_trace_node.
int lod_trace_describe(lod_trace* trace, const lod_trace_description* description);

// Tells a node, or a node's new values. Returns 1 if it is noted, or if trace is NULL. Returns 0 if the thread's ring has
// no room, or if 4 million nodes are known: call it again in a later frame, for example while a flag of the node says that
// it was not told yet. A drawn or requested node that was never told is in the trace by its id alone.
int lod_trace_node(lod_trace* trace, const lod_trace_node_info* node);

// Begins a frame. time_s: the engine's own clock, seconds, such as simulated or recorded time.
void lod_trace_frame_begin(lod_trace* trace, double time_s);

// Tells a view of this frame. view: [0, LOD_TRACE_MAX_VIEWS).
void lod_trace_view(lod_trace* trace, int view, const lod_trace_view_info* info);

// Tells that a view draws a node in this frame. morph: [0, 1], 0 for the node's own surface, 1 for its parent's.
void lod_trace_drawn(lod_trace* trace, int view, uint64_t node, float morph);

// The same with the node's error on screen as the engine computed it, pixels. Use it if the errors are no distances, or if
// the engine measures distances in another way than error * K' / D.
void lod_trace_drawn_px(lod_trace* trace, int view, uint64_t node, float morph, float error_px);

// Tells that a view draws neither a node nor its descendants in this frame. Without it, tools compare bounds with the
// frustum to tell a culled node from a hole. reason: LOD_TRACE_CULLED_...
void lod_trace_culled(lod_trace* trace, int view, uint64_t node, int reason);

// Ends the frame. Milliseconds; negative: unknown. An engine that learns GPU times later tells that of the last frame that
// it knows.
void lod_trace_frame_end(lod_trace* trace, double cpu_ms, double gpu_ms);

// Tell the way of a request, in this order: requested, started, then arrived, cancelled or failed; evicted when the data
// is dropped again. lod_trace_description::requests says what is loaded. kind: [0, LOD_TRACE_MAX_KINDS), 0 if there is
// only one. priority: larger first; NAN: unknown.
void lod_trace_requested(lod_trace* trace, uint64_t node, int kind, float priority);
void lod_trace_started(lod_trace* trace, uint64_t node, int kind);
void lod_trace_arrived(lod_trace* trace, uint64_t node, int kind);
void lod_trace_cancelled(lod_trace* trace, uint64_t node, int kind);
void lod_trace_failed(lod_trace* trace, uint64_t node, int kind, const char* reason);
void lod_trace_evicted(lod_trace* trace, uint64_t node, int kind);

// Sets a setting, such as LOD_TRACE_TAU, from this frame on. Return as lod_trace_node.
int lod_trace_setting(lod_trace* trace, const char* name, double value);
int lod_trace_setting_text(lod_trace* trace, const char* name, const char* text);

// Tells a number that changes from frame to frame.
void lod_trace_counter(lod_trace* trace, const char* name, double value);

// severity: LOD_TRACE_INFO, LOD_TRACE_WARNING or LOD_TRACE_ERROR.
void lod_trace_message(lod_trace* trace, int severity, const char* text);

// Names the calling thread. It also reserves the thread's ring, so that its first event does not search for one.
void lod_trace_thread_begin(lod_trace* trace, const char* name);
// Gives the calling thread's ring back, for another thread. Call it before a thread ends.
void lod_trace_thread_end(lod_trace* trace);

// Returns 1 while a tool is attached, or while the file can be written. An engine may skip expensive preparations if not.
int lod_trace_listening(const lod_trace* trace);

// Returns why the writer gave up, such as a full disk; NULL if it did not. The text lives as long as the trace.
const char* lod_trace_error(const lod_trace* trace);

// Returns the port that the trace listens at; 0 for a file.
int lod_trace_port(const lod_trace* trace);

lod_trace_stats lod_trace_get_stats(const lod_trace* trace);

// Waits until everything that this thread told before is in the file or was passed to the socket, at most timeout_ms.
// Returns 1 if it is, or if nobody listens. For tests and for the end of a measurement: this is the only call that waits.
int lod_trace_flush(lod_trace* trace, uint32_t timeout_ms);

// Returns the time that events are stamped with, nanoseconds from an arbitrary start.
uint64_t lod_trace_now_ns(void);

#else  // LOD_TRACE_DISABLE

#define LOD_TRACE_NOTHING(declaration, unused) \
    static inline declaration {                \
        unused;                                \
    }
#define LOD_TRACE_RETURN(declaration, unused, value) \
    static inline declaration {                      \
        unused;                                      \
        return value;                                \
    }
LOD_TRACE_RETURN(lod_trace* lod_trace_open(const char* where, const lod_trace_options* o, char* error,
                                           size_t bytes),
                 ((void)where, (void)o, (void)(error&& bytes ? (error[0] = 0) : 0)), NULL)
LOD_TRACE_NOTHING(void lod_trace_close(lod_trace* t), (void)t)
LOD_TRACE_RETURN(int lod_trace_describe(lod_trace* t, const lod_trace_description* d), ((void)t, (void)d), 1)
LOD_TRACE_RETURN(int lod_trace_node(lod_trace* t, const lod_trace_node_info* n), ((void)t, (void)n), 1)
LOD_TRACE_NOTHING(void lod_trace_frame_begin(lod_trace* t, double s), ((void)t, (void)s))
LOD_TRACE_NOTHING(void lod_trace_view(lod_trace* t, int v, const lod_trace_view_info* i),
                  ((void)t, (void)v, (void)i))
LOD_TRACE_NOTHING(void lod_trace_drawn(lod_trace* t, int v, uint64_t n, float m),
                  ((void)t, (void)v, (void)n, (void)m))
LOD_TRACE_NOTHING(void lod_trace_drawn_px(lod_trace* t, int v, uint64_t n, float m, float px),
                  ((void)t, (void)v, (void)n, (void)m, (void)px))
LOD_TRACE_NOTHING(void lod_trace_culled(lod_trace* t, int v, uint64_t n, int r),
                  ((void)t, (void)v, (void)n, (void)r))
LOD_TRACE_NOTHING(void lod_trace_frame_end(lod_trace* t, double c, double g), ((void)t, (void)c, (void)g))
LOD_TRACE_NOTHING(void lod_trace_requested(lod_trace* t, uint64_t n, int k, float p),
                  ((void)t, (void)n, (void)k, (void)p))
LOD_TRACE_NOTHING(void lod_trace_started(lod_trace* t, uint64_t n, int k), ((void)t, (void)n, (void)k))
LOD_TRACE_NOTHING(void lod_trace_arrived(lod_trace* t, uint64_t n, int k), ((void)t, (void)n, (void)k))
LOD_TRACE_NOTHING(void lod_trace_cancelled(lod_trace* t, uint64_t n, int k), ((void)t, (void)n, (void)k))
LOD_TRACE_NOTHING(void lod_trace_failed(lod_trace* t, uint64_t n, int k, const char* r),
                  ((void)t, (void)n, (void)k, (void)r))
LOD_TRACE_NOTHING(void lod_trace_evicted(lod_trace* t, uint64_t n, int k), ((void)t, (void)n, (void)k))
LOD_TRACE_RETURN(int lod_trace_setting(lod_trace* t, const char* n, double v), ((void)t, (void)n, (void)v), 1)
LOD_TRACE_RETURN(int lod_trace_setting_text(lod_trace* t, const char* n, const char* v),
                 ((void)t, (void)n, (void)v), 1)
LOD_TRACE_NOTHING(void lod_trace_counter(lod_trace* t, const char* n, double v), ((void)t, (void)n, (void)v))
LOD_TRACE_NOTHING(void lod_trace_message(lod_trace* t, int s, const char* m), ((void)t, (void)s, (void)m))
LOD_TRACE_NOTHING(void lod_trace_thread_begin(lod_trace* t, const char* n), ((void)t, (void)n))
LOD_TRACE_NOTHING(void lod_trace_thread_end(lod_trace* t), (void)t)
LOD_TRACE_RETURN(int lod_trace_listening(const lod_trace* t), (void)t, 0)
LOD_TRACE_RETURN(const char* lod_trace_error(const lod_trace* t), (void)t, NULL)
LOD_TRACE_RETURN(int lod_trace_port(const lod_trace* t), (void)t, 0)
LOD_TRACE_RETURN(lod_trace_stats lod_trace_get_stats(const lod_trace* t), lod_trace_stats none; (void)t;
                 none.dropped = none.refused = none.unringed = none.events = none.bytes = 0;
                 none.connections = none.nodes = 0; none.listening = 0, none)
LOD_TRACE_RETURN(int lod_trace_flush(lod_trace* t, uint32_t ms), ((void)t, (void)ms), 1)
LOD_TRACE_RETURN(uint64_t lod_trace_now_ns(void), (void)0, 0)
#undef LOD_TRACE_NOTHING
#undef LOD_TRACE_RETURN

#endif  // LOD_TRACE_DISABLE

// Packs an id of LOD_TRACE_IDS_QUADTREE. face: [0, 6) in the order +x -x +y -y +z -z, 0 if flat; level: [0, 28]; x and y:
// [0, 2^level), along the face's two axes: seen from outside a sphere, x to the right and y up; +x to -y have north up,
// and +z lies above +x and -z below it in the unfolded cube. The children of x, y have 2x or 2x + 1, and 2y or 2y + 1.
static inline uint64_t lod_trace_quadtree_id(uint32_t face, uint32_t level, uint32_t x, uint32_t y) {
    return (uint64_t)face << 61 | (uint64_t)level << 56 | (uint64_t)y << 28 | x;
}

#ifdef __cplusplus
}
#endif

#endif  // LOD_TRACE_H

// ---- the implementation ----

#if defined(LOD_TRACE_IMPLEMENTATION) && !defined(LOD_TRACE_DISABLE) && !defined(LOD_TRACE_IMPLEMENTED)
#define LOD_TRACE_IMPLEMENTED

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <winsock2.h>
// winsock2.h comes before windows.h.
#include <windows.h>
#else
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

// ---- atomics: 64-bit numbers that several threads use ----

#if defined(__GNUC__) || defined(__clang__)
#define LODT_ALIGNED(n) __attribute__((aligned(n)))
#define LODT_THREAD_LOCAL __thread
static uint64_t lodt_load(const uint64_t* p) {
    return __atomic_load_n(p, __ATOMIC_ACQUIRE);
}
static uint64_t lodt_peek(const uint64_t* p) {
    return __atomic_load_n(p, __ATOMIC_RELAXED);
}
static void lodt_store(uint64_t* p, uint64_t value) {
    __atomic_store_n(p, value, __ATOMIC_RELEASE);
}
static void lodt_add(uint64_t* p, uint64_t value) {
    __atomic_fetch_add(p, value, __ATOMIC_RELAXED);
}
static int lodt_exchange_if(uint64_t* p, uint64_t expected, uint64_t value) {
    return __atomic_compare_exchange_n(p, &expected, value, 0, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED);
}
#elif defined(_MSC_VER)
#include <intrin.h>
#define LODT_ALIGNED(n) __declspec(align(n))
#define LODT_THREAD_LOCAL __declspec(thread)
// An interlocked operation is a full barrier on every machine that Windows runs on. x64 needs none for loads and stores.
static uint64_t lodt_load(const uint64_t* p) {
#if defined(_M_X64)
    const uint64_t value = *(const volatile uint64_t*)p;
    _ReadWriteBarrier();
    return value;
#else
    return (uint64_t)_InterlockedCompareExchange64((volatile __int64*)p, 0, 0);
#endif
}
static uint64_t lodt_peek(const uint64_t* p) {
    return lodt_load(p);
}
static void lodt_store(uint64_t* p, uint64_t value) {
#if defined(_M_X64)
    _ReadWriteBarrier();
    *(volatile uint64_t*)p = value;
#else
    __int64 old = *(volatile __int64*)p, seen;
    while ((seen = _InterlockedCompareExchange64((volatile __int64*)p, (__int64)value, old)) != old)
        old = seen;
#endif
}
static void lodt_add(uint64_t* p, uint64_t value) {
    __int64 old = *(volatile __int64*)p, seen;
    while ((seen = _InterlockedCompareExchange64((volatile __int64*)p, old + (__int64)value, old)) != old)
        old = seen;
}
static int lodt_exchange_if(uint64_t* p, uint64_t expected, uint64_t value) {
    return _InterlockedCompareExchange64((volatile __int64*)p, (__int64)value, (__int64)expected) ==
           (__int64)expected;
}
#else
#error "lod_trace.h: unknown compiler; expected GCC, Clang or MSVC"
#endif

// ---- the records of a ring ----

enum {
    LODT_PAD,  // skips the end of the ring
    LODT_DROPPED,
    LODT_DESCRIBE,
    LODT_NODE,
    LODT_FRAME_BEGIN,
    LODT_VIEW,
    LODT_DRAWN,
    LODT_CULLED,
    LODT_FRAME_END,
    LODT_QUEUE,
    LODT_SETTING,
    LODT_COUNTER,
    LODT_MESSAGE,
    LODT_THREAD_NAME
};

// The first 8 bytes of a record.
typedef struct lodt_head {
    uint32_t size;  // of the record, a multiple of 8
    uint8_t type;
    uint8_t a;  // view, kind or severity
    uint8_t b;  // flags or step
    uint8_t c;
} lodt_head;

typedef struct lodt_drawn {
    lodt_head head;  // b: 1 if error_px is told; the reason, if culled
    uint64_t node;
    float morph;
    float error_px;
} lodt_drawn;

typedef struct lodt_queue {
    lodt_head head;  // a: kind, b: event, c: 1 if a priority is told
    uint64_t node;
    uint64_t ns;
    float priority;
    uint32_t length;  // of the reason that follows
} lodt_queue;

typedef struct lodt_frame {
    lodt_head head;
    uint64_t ns;
    uint64_t number;
    double first;   // time_s or cpu_ms
    double second;  // gpu_ms
} lodt_frame;

typedef struct lodt_named {
    lodt_head head;  // b: 1 for a text
    uint64_t ns;
    double value;
    uint32_t name_length;  // the name follows, then the text
    uint32_t text_length;
} lodt_named;

typedef struct lodt_count {
    lodt_head head;
    uint64_t count;
} lodt_count;

typedef struct lodt_view {
    lodt_head head;
    lod_trace_view_info info;
} lodt_view;

typedef struct lodt_node {
    lodt_head head;
    lod_trace_node_info info;
} lodt_node;

typedef struct lodt_description {
    lodt_head head;
    double radius;
    double metres_per_unit;
    uint8_t shape, ids, error, requests;
    uint32_t name_length;
    uint32_t kind_length[LOD_TRACE_MAX_KINDS];
    char text[(LOD_TRACE_MAX_KINDS + 1) * (LOD_TRACE_MAX_NAME + 1)];  // the name, then the kinds
} lodt_description;

// A ring with one producer, the thread that owns it, and one consumer, the writer. Positions only grow.
typedef struct lodt_ring {
    LODT_ALIGNED(64) uint64_t owner;  // a thread's token; 0: free
    unsigned char* bytes;
    uint64_t capacity;               // a power of two
    uint64_t head;                   // published by the producer
    uint64_t next_head;              // of the producer
    uint64_t seen_tail;              // the producer's copy of tail
    uint64_t lost;                   // events that had no room since the last one that had
    LODT_ALIGNED(64) uint64_t tail;  // published by the consumer
    uint64_t next_tail;              // of the consumer
    uint64_t limit;                  // the consumer reads to here
    uint64_t ns;                     // of the consumer's last record with a time
    uint32_t name;                   // the thread's name in the writer's table, plus one; 0: none
} lodt_ring;

// ---- the writer's state ----

typedef struct lodt_buffer {
    unsigned char* bytes;
    size_t size, capacity;
} lodt_buffer;

enum { LODT_ABSENT, LODT_REQUESTED, LODT_STARTED, LODT_RESIDENT, LODT_FAILED };  // states of a node's data

typedef struct lodt_entry {
    lod_trace_node_info info;
    uint64_t requested_ns[LOD_TRACE_MAX_KINDS];
    uint64_t started_ns[LOD_TRACE_MAX_KINDS];
    uint8_t state[LOD_TRACE_MAX_KINDS];
    uint8_t is_told;    // info is valid; otherwise only info.id is
    uint8_t is_dirty;   // listed in `dirty`
    uint8_t is_stored;  // the stream has it
} lodt_entry;

typedef struct lodt_name {
    char* text;
    uint32_t length;
} lodt_name;

typedef struct lodt_setting {
    uint32_t name;
    int is_text;
    double value;
    char* text;
    uint32_t length;
} lodt_setting;

#if defined(_WIN32)
typedef SOCKET lodt_socket;
#define LODT_NO_SOCKET INVALID_SOCKET
#else
typedef int lodt_socket;
#define LODT_NO_SOCKET (-1)
#endif

typedef struct lodt_writer {
    // where it goes
    FILE* file;
    lodt_socket listener, peer;
    int is_connected;
    int is_streaming;     // the stream has the frame in progress
    lodt_buffer pending;  // bytes that the socket did not take yet
    size_t sent;          // of pending
    // nodes by id: an open hash table of indices + 1
    lodt_entry* entries;
    size_t entry_count, entry_capacity;
    uint32_t* slots;
    size_t slot_count;
    uint32_t* dirty;
    size_t dirty_count, dirty_capacity, dirty_stored;
    // names
    lodt_name* names;
    size_t name_count, name_capacity, names_stored;
    lodt_setting* settings;
    size_t setting_count, setting_capacity;
    lodt_description description;
    int is_described, description_dirty;
    // the block in progress
    lodt_buffer definitions, events;
    int is_key;
    int is_inside;  // the block begins inside a frame, or after its end
    uint64_t block_frame, block_ns, block_began_ns;
    uint32_t block_frames, block_events;
    // what the deltas of the block refer to
    uint64_t last_ns, last_frame, last_drawn, last_queued;
    uint32_t last_view, last_thread;
    lod_trace_view_info views[LOD_TRACE_MAX_VIEWS];
    // the stream
    uint64_t now_ns;  // time of the record in progress
    uint64_t frame;   // in progress
    uint64_t frames_since_key, bytes_since_key, key_bytes;
    uint64_t skipped;        // events since the listener became too slow
    uint64_t unringed_told;  // of lod_trace::unringed
    uint64_t out_of_memory;
} lodt_writer;

struct lod_trace {
    // Read by the engine's threads at each call.
    LODT_ALIGNED(64) uint64_t listening;
    uint64_t serial;  // differs between all traces of a process
    lodt_ring* rings;
    uint32_t ring_count;
    uint32_t wake_ms;
    void* ring_memory;
    // Written by the engine's threads.
    LODT_ALIGNED(64) uint64_t frame;
    uint64_t dropped, refused, unringed;
    uint64_t flush_wanted;
    // Written by the writer.
    LODT_ALIGNED(64) uint64_t flush_done;
    uint64_t stop;
    uint64_t events, bytes, connections, nodes;
    uint64_t has_error;
    char error[512];
    char where[512];
    int port;
    lodt_writer writer;
#if defined(_WIN32)
    HANDLE thread;
    int has_winsock;
#else
    pthread_t thread;
#endif
};

static size_t lodt_cut(const char* text, size_t most);

// ---- the system ----

#if defined(_WIN32)
uint64_t lod_trace_now_ns(void) {
    static LARGE_INTEGER frequency;  // constant, so it does not matter which thread asks first
    LARGE_INTEGER count;
    if (frequency.QuadPart == 0) QueryPerformanceFrequency(&frequency);
    QueryPerformanceCounter(&count);
    {
        const uint64_t f = (uint64_t)frequency.QuadPart, c = (uint64_t)count.QuadPart;
        return c / f * 1000000000u + c % f * 1000000000u / f;
    }
}
static void lodt_sleep(uint32_t ms) {
    Sleep(ms);
}
static void lodt_system_error(char* text, size_t bytes) {
    const int code = WSAGetLastError() ? WSAGetLastError() : (int)GetLastError();
    snprintf(text, bytes, "system error %d", code);
}
static FILE* lodt_fopen(const char* path, const wchar_t* mode) {
    wchar_t wide[1024];
    if (!MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 1024)) return NULL;
    return _wfopen(wide, mode);
}
#define LODT_FOPEN(path, mode) lodt_fopen(path, L##mode)
static void lodt_close_socket(lodt_socket s) {
    closesocket(s);
}
static int lodt_unblock(lodt_socket s) {
    u_long on = 1;
    return ioctlsocket(s, (long)FIONBIO, &on) == 0;
}
static int lodt_would_block(void) {
    return WSAGetLastError() == WSAEWOULDBLOCK;
}
static long lodt_send(lodt_socket s, const void* bytes, size_t size) {
    return (long)send(s, (const char*)bytes, size > 1 << 20 ? 1 << 20 : (int)size, 0);
}
static long lodt_receive(lodt_socket s, void* bytes, size_t size) {
    return (long)recv(s, (char*)bytes, (int)size, 0);
}
#else
uint64_t lod_trace_now_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}
static void lodt_sleep(uint32_t ms) {
    struct timespec time;
    time.tv_sec = (time_t)(ms / 1000);
    time.tv_nsec = (long)(ms % 1000) * 1000000;
    nanosleep(&time, NULL);
}
static void lodt_system_error(char* text, size_t bytes) {
    snprintf(text, bytes, "%s", strerror(errno));
}
#define LODT_FOPEN(path, mode) fopen(path, mode)
static void lodt_close_socket(lodt_socket s) {
    close(s);
}
static int lodt_unblock(lodt_socket s) {
    const int flags = fcntl(s, F_GETFL, 0);
    fcntl(s, F_SETFD, FD_CLOEXEC);
    return flags >= 0 && fcntl(s, F_SETFL, flags | O_NONBLOCK) == 0;
}
static int lodt_would_block(void) {
    return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}
static long lodt_send(lodt_socket s, const void* bytes, size_t size) {
#if defined(MSG_NOSIGNAL)
    return (long)send(s, bytes, size, MSG_NOSIGNAL);
#else
    return (long)send(s, bytes, size, 0);
#endif
}
static long lodt_receive(lodt_socket s, void* bytes, size_t size) {
    return (long)recv(s, bytes, size, 0);
}
#endif

// ---- the engine's side: rings ----

// A thread's place, found once: the address of `serial` is the thread's token.
typedef struct lodt_self {
    uint64_t serial;
    lodt_ring* ring;
} lodt_self;
static LODT_THREAD_LOCAL lodt_self lodt_this_thread;

static uint64_t lodt_token(void) {
    return (uint64_t)(uintptr_t)&lodt_this_thread;
}

static lodt_ring* lodt_find_ring(lod_trace* trace) {
    const uint64_t token = lodt_token();
    lodt_ring* found = NULL;
    uint32_t i;
    for (i = 0; i < trace->ring_count && !found; ++i)
        if (lodt_load(&trace->rings[i].owner) == token) found = &trace->rings[i];
    for (i = 0; i < trace->ring_count && !found; ++i)
        if (lodt_load(&trace->rings[i].owner) == 0 && lodt_exchange_if(&trace->rings[i].owner, 0, token))
            found = &trace->rings[i];
    if (!found) return NULL;
    lodt_this_thread.serial = trace->serial;
    lodt_this_thread.ring = found;
    return found;
}

static lodt_ring* lodt_ring_of(lod_trace* trace) {
    if (lodt_this_thread.serial == trace->serial) return lodt_this_thread.ring;
    return lodt_find_ring(trace);
}

static uint64_t lodt_rounded(size_t size) {
    return ((uint64_t)size + 7) & ~(uint64_t)7;
}

// Returns room for a record, which lodt_publish makes visible; NULL if there is none. The last quarter is kept for records
// that others build on.
static unsigned char* lodt_room(lodt_ring* ring, uint64_t size, int others_build_on_it) {
    const uint64_t limit = others_build_on_it ? ring->capacity : ring->capacity / 4 * 3;
    uint64_t at = ring->next_head & (ring->capacity - 1);
    const uint64_t padding = ring->capacity - at < size ? ring->capacity - at : 0;
    const uint64_t end = ring->next_head + padding + size;
    if (end - ring->seen_tail > limit) {
        ring->seen_tail = lodt_load(&ring->tail);
        if (end - ring->seen_tail > limit) return NULL;
    }
    if (padding) {
        lodt_head* head = (lodt_head*)(void*)(ring->bytes + at);
        head->size = (uint32_t)padding;
        head->type = LODT_PAD;
        ring->next_head += padding;
        at = 0;
    }
    return ring->bytes + at;
}

static void lodt_publish(lodt_ring* ring, uint64_t size) {
    ring->next_head += size;
    lodt_store(&ring->head, ring->next_head);
}

// Returns room for a record of the calling thread with its head filled in. Tells first how many events were lost before.
static void* lodt_record(lod_trace* trace, lodt_ring** ring_out, uint64_t size, uint8_t type,
                         int others_build_on_it) {
    lodt_ring* ring = lodt_ring_of(trace);
    unsigned char* room;
    lodt_head* head;
    *ring_out = ring;
    if (!ring) return NULL;
    if (ring->lost) {
        lodt_count* count;
        room = lodt_room(ring, sizeof(lodt_count) + size, others_build_on_it);
        if (!room) return NULL;
        count = (lodt_count*)(void*)room;
        memset(count, 0, sizeof *count);
        count->head.size = (uint32_t)sizeof *count;
        count->head.type = LODT_DROPPED;
        count->count = ring->lost;
        ring->lost = 0;
        lodt_publish(ring, sizeof *count);
        room += sizeof *count;
    } else {
        room = lodt_room(ring, size, others_build_on_it);
        if (!room) return NULL;
    }
    head = (lodt_head*)(void*)room;
    head->size = (uint32_t)size;
    head->type = type;
    head->a = head->b = head->c = 0;
    return room;
}

static void lodt_drop(lod_trace* trace, lodt_ring* ring) {
    lodt_add(&trace->dropped, 1);
    if (ring)
        ++ring->lost;
    else
        lodt_add(&trace->unringed, 1);
}

static int lodt_refuse(lod_trace* trace) {
    lodt_add(&trace->refused, 1);
    return 0;
}

// ---- the engine's side: calls ----

// Returns the length of a text, cut at a number of bytes but not inside a character.
static size_t lodt_cut(const char* text, size_t most) {
    size_t length = 0;
    if (!text) return 0;
    while (length <= most && text[length]) ++length;
    if (length <= most) return length;
    length = most;
    while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) --length;
    return length;
}

// Returns a value of an enumeration from 0 to `last`, or `other` for any that the format does not know: a reader would refuse
// the whole trace.
static uint8_t lodt_known(int value, int last, int other) {
    return (uint8_t)(value >= 0 && value <= last ? value : other);
}

int lod_trace_describe(lod_trace* trace, const lod_trace_description* description) {
    const uint64_t size = lodt_rounded(sizeof(lodt_description));
    lodt_ring* ring;
    lodt_description* record;
    char* end;
    int i;
    if (!trace || !description) return 1;
    record = (lodt_description*)lodt_record(trace, &ring, size, LODT_DESCRIBE, 1);
    if (!record) return lodt_refuse(trace);
    record->radius = description->radius;
    record->metres_per_unit = description->metres_per_unit > 0 ? description->metres_per_unit : 1;
    record->shape = lodt_known(description->shape, LOD_TRACE_SPHERE, LOD_TRACE_FLAT);
    record->ids = lodt_known(description->ids, LOD_TRACE_IDS_QUADTREE, LOD_TRACE_IDS_OPAQUE);
    record->error = lodt_known(description->error, LOD_TRACE_ERROR_PIXELS, LOD_TRACE_ERROR_WORLD);
    record->requests =
        lodt_known(description->requests, LOD_TRACE_REQUESTS_CHILDREN, LOD_TRACE_REQUESTS_NODE);
    record->name_length = (uint32_t)lodt_cut(description->name, LOD_TRACE_MAX_NAME);
    end = record->text;
    memcpy(end, description->name ? description->name : "", record->name_length);
    end += record->name_length;
    for (i = 0; i < LOD_TRACE_MAX_KINDS; ++i) {
        const char* kind = description->kinds[i] ? description->kinds[i] : "";
        record->kind_length[i] = (uint32_t)lodt_cut(kind, LOD_TRACE_MAX_NAME);
        memcpy(end, kind, record->kind_length[i]);
        end += record->kind_length[i];
    }
    lodt_publish(ring, size);
    return 1;
}

int lod_trace_node(lod_trace* trace, const lod_trace_node_info* node) {
    lodt_ring* ring;
    lodt_node* record;
    if (!trace || !node) return 1;
    if (lodt_peek(&trace->nodes) >= 4000000u) return lodt_refuse(trace);
    record = (lodt_node*)lodt_record(trace, &ring, sizeof *record, LODT_NODE, 1);
    if (!record) return lodt_refuse(trace);
    record->info = *node;
    record->info.bounds = lodt_known(node->bounds, LOD_TRACE_BOUNDS_BOX, LOD_TRACE_BOUNDS_NONE);
    lodt_publish(ring, sizeof *record);
    return 1;
}

static void lodt_frame_event(lod_trace* trace, uint8_t type, uint64_t number, double first, double second) {
    lodt_ring* ring;
    lodt_frame* record = (lodt_frame*)lodt_record(trace, &ring, sizeof *record, type, 1);
    if (!record) {
        lodt_drop(trace, ring);
        return;
    }
    record->ns = lod_trace_now_ns();
    record->number = number;
    record->first = first;
    record->second = second;
    lodt_publish(ring, sizeof *record);
}

void lod_trace_frame_begin(lod_trace* trace, double time_s) {
    uint64_t number;
    if (!trace) return;
    number = lodt_peek(&trace->frame) + 1;
    lodt_store(&trace->frame, number);
    if (lodt_peek(&trace->listening)) lodt_frame_event(trace, LODT_FRAME_BEGIN, number, time_s, 0);
}

void lod_trace_frame_end(lod_trace* trace, double cpu_ms, double gpu_ms) {
    if (!trace || !lodt_peek(&trace->listening)) return;
    lodt_frame_event(trace, LODT_FRAME_END, lodt_peek(&trace->frame), cpu_ms, gpu_ms);
}

void lod_trace_view(lod_trace* trace, int view, const lod_trace_view_info* info) {
    lodt_ring* ring;
    lodt_view* record;
    if (!trace || !info || view < 0 || view >= LOD_TRACE_MAX_VIEWS || !lodt_peek(&trace->listening)) return;
    record = (lodt_view*)lodt_record(trace, &ring, sizeof *record, LODT_VIEW, 1);
    if (!record) {
        lodt_drop(trace, ring);
        return;
    }
    record->head.a = (uint8_t)view;
    record->info = *info;
    lodt_publish(ring, sizeof *record);
}

static void lodt_draw_event(lod_trace* trace, uint8_t type, int view, uint64_t node, uint8_t flags,
                            float morph, float error_px) {
    lodt_ring* ring;
    lodt_drawn* record;
    if (view < 0 || view >= LOD_TRACE_MAX_VIEWS || !lodt_peek(&trace->listening)) return;
    record = (lodt_drawn*)lodt_record(trace, &ring, sizeof *record, type, 0);
    if (!record) {
        lodt_drop(trace, ring);
        return;
    }
    record->head.a = (uint8_t)view;
    record->head.b = flags;
    record->node = node;
    record->morph = morph;
    record->error_px = error_px;
    lodt_publish(ring, sizeof *record);
}

void lod_trace_drawn(lod_trace* trace, int view, uint64_t node, float morph) {
    if (trace) lodt_draw_event(trace, LODT_DRAWN, view, node, 0, morph, 0);
}

void lod_trace_drawn_px(lod_trace* trace, int view, uint64_t node, float morph, float error_px) {
    if (trace) lodt_draw_event(trace, LODT_DRAWN, view, node, 1, morph, error_px);
}

void lod_trace_culled(lod_trace* trace, int view, uint64_t node, int reason) {
    const uint8_t known = lodt_known(reason, LOD_TRACE_CULLED_OTHER, LOD_TRACE_CULLED_OTHER);
    if (trace) lodt_draw_event(trace, LODT_CULLED, view, node, known, 0, 0);
}

// The types of events in the stream; README.md has the table.
enum {
    LODT_E_FRAME_BEGIN = 1,
    LODT_E_FRAME_END = 2,
    LODT_E_VIEW = 3,
    LODT_E_DRAWN = 4,
    LODT_E_CULLED = 5,
    LODT_E_SELECT_VIEW = 6,
    LODT_E_REQUESTED = 7,
    LODT_E_STARTED = 8,
    LODT_E_ARRIVED = 9,
    LODT_E_CANCELLED = 10,
    LODT_E_FAILED = 11,
    LODT_E_EVICTED = 12,
    LODT_E_COUNTER = 13,
    LODT_E_SETTING = 14,
    LODT_E_MESSAGE = 15,
    LODT_E_DROPPED = 16,
    LODT_E_THREAD = 17,
    LODT_E_THREAD_NAME = 18,
    LODT_E_RESTORE = 19
};
// The types of definitions.
enum { LODT_D_DESCRIBE = 1, LODT_D_NAME = 2, LODT_D_NODE = 3 };
// Bits above the type, which takes 5.
#define LODT_FLAG_1 0x20u
#define LODT_FLAG_2 0x40u

static void lodt_queue_event(lod_trace* trace, uint64_t node, int kind, uint8_t event, float priority,
                             const char* reason) {
    const size_t length = lodt_cut(reason, LOD_TRACE_MAX_NAME);
    const uint64_t size = sizeof(lodt_queue) + lodt_rounded(length);
    lodt_ring* ring;
    lodt_queue* record;
    if (!trace || kind < 0 || kind >= LOD_TRACE_MAX_KINDS) return;
    record = (lodt_queue*)lodt_record(trace, &ring, size, LODT_QUEUE, 1);
    if (!record) {
        lodt_drop(trace, ring);
        return;
    }
    record->head.a = (uint8_t)kind;
    record->head.b = event;
    record->head.c = event == LODT_E_REQUESTED && priority == priority;
    record->node = node;
    record->ns = lod_trace_now_ns();
    record->priority = priority;
    record->length = (uint32_t)length;
    if (length) memcpy(record + 1, reason, length);
    lodt_publish(ring, size);
}

void lod_trace_requested(lod_trace* trace, uint64_t node, int kind, float priority) {
    lodt_queue_event(trace, node, kind, LODT_E_REQUESTED, priority, NULL);
}
void lod_trace_started(lod_trace* trace, uint64_t node, int kind) {
    lodt_queue_event(trace, node, kind, LODT_E_STARTED, 0, NULL);
}
void lod_trace_arrived(lod_trace* trace, uint64_t node, int kind) {
    lodt_queue_event(trace, node, kind, LODT_E_ARRIVED, 0, NULL);
}
void lod_trace_cancelled(lod_trace* trace, uint64_t node, int kind) {
    lodt_queue_event(trace, node, kind, LODT_E_CANCELLED, 0, NULL);
}
void lod_trace_failed(lod_trace* trace, uint64_t node, int kind, const char* reason) {
    lodt_queue_event(trace, node, kind, LODT_E_FAILED, 0, reason);
}
void lod_trace_evicted(lod_trace* trace, uint64_t node, int kind) {
    lodt_queue_event(trace, node, kind, LODT_E_EVICTED, 0, NULL);
}

// Returns 0 if there is no room.
static int lodt_named_event(lod_trace* trace, uint8_t type, uint8_t a, uint64_t ns, const char* name,
                            double value, const char* text, lodt_ring** ring) {
    const size_t name_length = lodt_cut(name, LOD_TRACE_MAX_NAME);
    const size_t text_length = lodt_cut(text, LOD_TRACE_MAX_TEXT);
    const uint64_t size = sizeof(lodt_named) + lodt_rounded(name_length + text_length);
    lodt_named* record =
        (lodt_named*)lodt_record(trace, ring, size, type, type != LODT_COUNTER && type != LODT_MESSAGE);
    if (!record) return 0;
    record->head.a = a;
    record->head.b = text != NULL;
    record->ns = ns;
    record->value = value;
    record->name_length = (uint32_t)name_length;
    record->text_length = (uint32_t)text_length;
    if (name_length) memcpy(record + 1, name, name_length);
    if (text_length) memcpy((char*)(record + 1) + name_length, text, text_length);
    lodt_publish(*ring, size);
    return 1;
}

int lod_trace_setting(lod_trace* trace, const char* name, double value) {
    lodt_ring* ring;
    if (!trace || !name) return 1;
    if (lodt_named_event(trace, LODT_SETTING, 0, 0, name, value, NULL, &ring)) return 1;
    return lodt_refuse(trace);
}

int lod_trace_setting_text(lod_trace* trace, const char* name, const char* text) {
    lodt_ring* ring;
    if (!trace || !name) return 1;
    if (lodt_named_event(trace, LODT_SETTING, 0, 0, name, 0, text ? text : "", &ring)) return 1;
    return lodt_refuse(trace);
}

void lod_trace_counter(lod_trace* trace, const char* name, double value) {
    lodt_ring* ring;
    if (!trace || !name || !lodt_peek(&trace->listening)) return;
    if (!lodt_named_event(trace, LODT_COUNTER, 0, 0, name, value, NULL, &ring)) lodt_drop(trace, ring);
}

void lod_trace_message(lod_trace* trace, int severity, const char* text) {
    lodt_ring* ring;
    if (!trace || !text || !lodt_peek(&trace->listening)) return;
    if (!lodt_named_event(trace, LODT_MESSAGE, lodt_known(severity, LOD_TRACE_ERROR, LOD_TRACE_ERROR),
                          lod_trace_now_ns(), NULL, 0, text, &ring))
        lodt_drop(trace, ring);
}

void lod_trace_thread_begin(lod_trace* trace, const char* name) {
    lodt_ring* ring;
    if (!trace || !name) return;
    if (!lodt_named_event(trace, LODT_THREAD_NAME, 0, 0, name, 0, NULL, &ring)) lodt_refuse(trace);
}

void lod_trace_thread_end(lod_trace* trace) {
    const uint64_t token = lodt_token();
    uint32_t i;
    if (!trace) return;
    for (i = 0; i < trace->ring_count; ++i)
        if (lodt_load(&trace->rings[i].owner) == token) lodt_store(&trace->rings[i].owner, 0);
    if (lodt_this_thread.serial == trace->serial) lodt_this_thread.serial = 0;
}

int lod_trace_listening(const lod_trace* trace) {
    return trace && lodt_load(&trace->listening) != 0;
}

const char* lod_trace_error(const lod_trace* trace) {
    return trace && lodt_load(&trace->has_error) ? trace->error : NULL;
}

int lod_trace_port(const lod_trace* trace) {
    return trace ? trace->port : 0;
}

lod_trace_stats lod_trace_get_stats(const lod_trace* trace) {
    lod_trace_stats stats;
    memset(&stats, 0, sizeof stats);
    if (!trace) return stats;
    stats.dropped = lodt_load(&trace->dropped);
    stats.refused = lodt_load(&trace->refused);
    stats.unringed = lodt_load(&trace->unringed);
    stats.events = lodt_load(&trace->events);
    stats.bytes = lodt_load(&trace->bytes);
    stats.connections = lodt_load(&trace->connections);
    stats.nodes = lodt_load(&trace->nodes);
    stats.listening = lodt_load(&trace->listening) != 0;
    return stats;
}

int lod_trace_flush(lod_trace* trace, uint32_t timeout_ms) {
    const uint64_t end = lod_trace_now_ns() + (uint64_t)timeout_ms * 1000000u;
    uint64_t wanted;
    if (!trace) return 1;
    do wanted = lodt_load(&trace->flush_wanted) + 1;
    while (!lodt_exchange_if(&trace->flush_wanted, wanted - 1, wanted));
    while (lodt_load(&trace->flush_done) < wanted) {
        if (lod_trace_now_ns() > end) return 0;
        lodt_sleep(1);
    }
    return 1;
}

// ---- the writer: bytes ----

static int lodt_grow(lodt_writer* w, lodt_buffer* buffer, size_t more) {
    size_t capacity = buffer->capacity ? buffer->capacity : 4096;
    unsigned char* bytes;
    if (buffer->capacity - buffer->size >= more) return 1;
    while (capacity - buffer->size < more) capacity *= 2;
    bytes = (unsigned char*)realloc(buffer->bytes, capacity);
    if (!bytes) {
        w->out_of_memory = 1;
        return 0;
    }
    buffer->bytes = bytes;
    buffer->capacity = capacity;
    return 1;
}

static void lodt_put(lodt_writer* w, lodt_buffer* buffer, const void* bytes, size_t size) {
    if (!size || !lodt_grow(w, buffer, size)) return;
    memcpy(buffer->bytes + buffer->size, bytes, size);
    buffer->size += size;
}

static void lodt_put_number(lodt_writer* w, lodt_buffer* buffer, uint64_t value, int bytes) {
    unsigned char little[8];
    int i;
    for (i = 0; i < bytes; ++i) little[i] = (unsigned char)(value >> 8 * i);
    lodt_put(w, buffer, little, (size_t)bytes);
}

static void lodt_put_byte(lodt_writer* w, lodt_buffer* buffer, uint64_t value) {
    lodt_put_number(w, buffer, value, 1);
}

static void lodt_put_double(lodt_writer* w, lodt_buffer* buffer, double value) {
    uint64_t bits;
    memcpy(&bits, &value, 8);
    lodt_put_number(w, buffer, bits, 8);
}

static void lodt_put_float(lodt_writer* w, lodt_buffer* buffer, float value) {
    uint32_t bits;
    memcpy(&bits, &value, 4);
    lodt_put_number(w, buffer, bits, 4);
}

static void lodt_put_varint(lodt_writer* w, lodt_buffer* buffer, uint64_t value) {
    unsigned char bytes[10];
    size_t size = 0;
    for (; value >= 0x80; value >>= 7) bytes[size++] = (unsigned char)(value | 0x80);
    bytes[size++] = (unsigned char)value;
    lodt_put(w, buffer, bytes, size);
}

// A difference modulo 2^64, with its sign in bit 0.
static void lodt_put_delta(lodt_writer* w, lodt_buffer* buffer, uint64_t from, uint64_t to) {
    const uint64_t delta = to - from;
    lodt_put_varint(w, buffer, delta << 1 ^ (delta >> 63 ? ~(uint64_t)0 : 0));
}

static void lodt_put_text(lodt_writer* w, lodt_buffer* buffer, const char* text, size_t length) {
    lodt_put_varint(w, buffer, length);
    lodt_put(w, buffer, text, length);
}

// FNV-1a, 32 bits.
static uint32_t lodt_checksum(uint32_t hash, const unsigned char* bytes, size_t size) {
    size_t i;
    for (i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 16777619u;
    return hash;
}
#define LODT_CHECKSUM_START 2166136261u

// ---- the writer: where bytes go ----

static void lodt_fail(lod_trace* trace, const char* what) {
    if (lodt_load(&trace->has_error)) return;
    snprintf(trace->error, sizeof trace->error, "%.200s: %.200s", trace->where, what);
    lodt_store(&trace->has_error, 1);
}

static void lodt_disconnect(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    size_t i;
    lodt_store(&trace->listening, 0);
    w->is_connected = w->is_streaming = 0;
    w->definitions.size = w->events.size = w->pending.size = w->sent = 0;
    w->block_frames = w->block_events = 0;
    for (i = 0; i < w->dirty_count; ++i) w->entries[w->dirty[i]].is_dirty = 0;
    w->dirty_count = w->dirty_stored = 0;
    if (w->peer != LODT_NO_SOCKET) lodt_close_socket(w->peer);
    w->peer = LODT_NO_SOCKET;
    if (w->file) fclose(w->file);
    w->file = NULL;
}

static void lodt_fail_system(lod_trace* trace, const char* what) {
    char reason[128], text[256];
    lodt_system_error(reason, sizeof reason);
    snprintf(text, sizeof text, "%s: %s", what, reason);
    lodt_fail(trace, text);
}

// Passes on to the socket what it takes.
static void lodt_send_pending(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    while (w->is_connected && w->peer != LODT_NO_SOCKET && w->sent < w->pending.size) {
        const long count = lodt_send(w->peer, w->pending.bytes + w->sent, w->pending.size - w->sent);
        if (count > 0) {
            w->sent += (size_t)count;
        } else {
            if (count == 0 || !lodt_would_block()) lodt_disconnect(trace);
            return;
        }
    }
    if (w->sent == w->pending.size) {
        w->sent = w->pending.size = 0;
    } else if (w->sent > (1u << 20) && w->sent > w->pending.size / 2) {
        memmove(w->pending.bytes, w->pending.bytes + w->sent, w->pending.size - w->sent);
        w->pending.size -= w->sent;
        w->sent = 0;
    }
}

static void lodt_output(lod_trace* trace, const void* bytes, size_t size) {
    lodt_writer* w = &trace->writer;
    if (!w->is_connected) return;
    lodt_add(&trace->bytes, size);
    if (!w->file) {
        lodt_put(w, &w->pending, bytes, size);
    } else if (fwrite(bytes, 1, size, w->file) != size) {
        lodt_fail_system(trace, "writing failed");
        lodt_disconnect(trace);
    }
}

// ---- the writer: blocks ----

static void lodt_start_block(lodt_writer* w, uint64_t frame) {
    w->is_key = 0;
    w->is_inside = 1;
    w->block_frame = w->last_frame = frame;
    w->block_ns = w->last_ns = w->now_ns;
    w->block_began_ns = lod_trace_now_ns();
    w->block_frames = w->block_events = 0;
    w->last_drawn = w->last_queued = 0;
    w->last_view = w->last_thread = 0;
    memset(w->views, 0, sizeof w->views);
    w->definitions.size = w->events.size = 0;
}

static void lodt_put_description(lodt_writer* w) {
    const lodt_description* d = &w->description;
    lodt_buffer* out = &w->definitions;
    const char* text = d->text;
    int i;
    lodt_put_byte(w, out, LODT_D_DESCRIBE);
    lodt_put_byte(w, out, d->shape);
    lodt_put_byte(w, out, d->ids);
    lodt_put_byte(w, out, d->error);
    lodt_put_byte(w, out, d->requests);
    lodt_put_double(w, out, d->radius);
    lodt_put_double(w, out, d->metres_per_unit);
    lodt_put_text(w, out, text, d->name_length);
    text += d->name_length;
    for (i = 0; i < LOD_TRACE_MAX_KINDS; ++i) {
        lodt_put_text(w, out, text, d->kind_length[i]);
        text += d->kind_length[i];
    }
}

static void lodt_put_node(lod_trace* trace, uint32_t index) {
    lodt_writer* w = &trace->writer;
    lodt_buffer* out = &w->definitions;
    lodt_entry* entry = &w->entries[index];
    const lod_trace_node_info* node = &entry->info;
    const int bounds = node->bounds;
    int i;
    entry->is_stored = 1;
    lodt_put_byte(w, out, LODT_D_NODE);
    lodt_put_byte(w, out, (uint64_t)(entry->is_told ? 1 | (node->has_parent ? 2 : 0) | bounds << 2 : 0));
    lodt_put_varint(w, out, index);
    lodt_put_number(w, out, node->id, 8);
    if (!entry->is_told) return;
    if (node->has_parent) lodt_put_number(w, out, node->parent, 8);
    lodt_put_varint(w, out, node->level);
    if (bounds != LOD_TRACE_BOUNDS_NONE)
        for (i = 0; i < 3; ++i) lodt_put_double(w, out, node->centre[i]);
    if (bounds == LOD_TRACE_BOUNDS_SPHERE) lodt_put_double(w, out, node->radius);
    if (bounds == LOD_TRACE_BOUNDS_BOX) {
        for (i = 0; i < 9; ++i) lodt_put_double(w, out, node->axes[i]);
        for (i = 0; i < 3; ++i) lodt_put_double(w, out, node->half_size[i]);
    }
    lodt_put_double(w, out, node->error);
    lodt_put_varint(w, out, node->bytes);
    lodt_put_varint(w, out, node->triangles);
}

enum { LODT_ENOUGH = 1 << 20 };  // bytes of a block

// Puts what events refer to before them: the description, names, and nodes that are new or changed. Returns 0 if there is
// more than a block should hold.
static int lodt_put_definitions(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    if (w->is_described && w->description_dirty) lodt_put_description(w);
    w->description_dirty = 0;
    for (; w->names_stored < w->name_count; ++w->names_stored) {
        const lodt_name* name = &w->names[w->names_stored];
        lodt_put_byte(w, &w->definitions, LODT_D_NAME);
        lodt_put_varint(w, &w->definitions, w->names_stored);
        lodt_put_text(w, &w->definitions, name->text, name->length);
    }
    for (; w->dirty_stored < w->dirty_count && w->definitions.size < LODT_ENOUGH; ++w->dirty_stored) {
        w->entries[w->dirty[w->dirty_stored]].is_dirty = 0;
        lodt_put_node(trace, w->dirty[w->dirty_stored]);
    }
    if (w->dirty_stored < w->dirty_count && !w->out_of_memory) return 0;
    w->dirty_stored = w->dirty_count = 0;
    return 1;
}

static void lodt_write_block(lod_trace* trace, int with_events) {
    lodt_writer* w = &trace->writer;
    const size_t events = with_events ? w->events.size : 0;
    unsigned char header[48];
    lodt_buffer out;
    uint32_t checksum = lodt_checksum(LODT_CHECKSUM_START, w->definitions.bytes, w->definitions.size);
    checksum = lodt_checksum(checksum, w->events.bytes, events);
    out.bytes = header;
    out.size = 0;
    out.capacity = sizeof header;
    lodt_put(w, &out, "LTB1", 4);
    lodt_put_number(w, &out, w->definitions.size + events, 4);
    lodt_put_number(w, &out, w->definitions.size, 4);
    lodt_put_number(w, &out, (with_events && w->is_key ? 1u : 0u) | (w->is_inside ? 2u : 0u), 4);
    lodt_put_number(w, &out, w->block_frame, 8);
    lodt_put_number(w, &out, w->block_ns, 8);
    lodt_put_number(w, &out, with_events ? w->block_frames : 0, 4);
    lodt_put_number(w, &out, with_events ? w->block_events : 0, 4);
    lodt_put_number(w, &out, checksum, 4);
    lodt_put_number(w, &out, lodt_checksum(LODT_CHECKSUM_START, header, 44), 4);
    w->bytes_since_key += sizeof header + w->definitions.size + events;
    lodt_output(trace, header, sizeof header);
    lodt_output(trace, w->definitions.bytes, w->definitions.size);
    lodt_output(trace, w->events.bytes, events);
}

// Writes the block in progress, if it holds anything, and starts the next one.
static void lodt_flush_block(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    if (!w->is_connected) return;
    while (!lodt_put_definitions(trace)) {
        lodt_write_block(trace, 0);
        w->definitions.size = 0;
    }
    if (w->definitions.size + w->events.size == 0) {
        w->block_began_ns = lod_trace_now_ns();
        return;
    }
    if (!w->out_of_memory) {
        lodt_write_block(trace, 1);
        lodt_add(&trace->events, w->block_events);
        if (w->file && fflush(w->file) != 0) {
            lodt_fail_system(trace, "writing failed");
            lodt_disconnect(trace);
        }
    }
    lodt_start_block(w, w->frame);
}

static void lodt_type(lodt_writer* w, unsigned type) {
    lodt_put_byte(w, &w->events, type);
    ++w->block_events;
}

static void lodt_put_time(lodt_writer* w, uint64_t ns) {
    lodt_put_delta(w, &w->events, w->last_ns, ns);
    w->last_ns = ns;
}

// ---- the writer: tables ----

static uint64_t lodt_hash(uint64_t key) {
    key ^= key >> 32;
    key *= 0x9E3779B97F4A7C15u;
    return key ^ key >> 29;
}

// Returns an array with room for one more element; the old one if there is no memory.
static void* lodt_more(lodt_writer* w, void* array, size_t count, size_t* capacity, size_t element) {
    size_t larger = *capacity ? 2 * *capacity : 64;
    void* grown;
    if (count < *capacity) return array;
    grown = realloc(array, larger * element);
    if (!grown) {
        w->out_of_memory = 1;
        return array;
    }
    *capacity = larger;
    return grown;
}

static void lodt_grow_slots(lodt_writer* w) {
    const size_t count = w->slot_count ? 2 * w->slot_count : 1024;
    uint32_t* slots = (uint32_t*)calloc(count, sizeof(uint32_t));
    size_t i;
    if (!slots) {
        w->out_of_memory = 1;
        return;
    }
    for (i = 0; i < w->entry_count; ++i) {
        size_t at = (size_t)lodt_hash(w->entries[i].info.id) & (count - 1);
        while (slots[at]) at = (at + 1) & (count - 1);
        slots[at] = (uint32_t)i + 1;
    }
    free(w->slots);
    w->slots = slots;
    w->slot_count = count;
}

static void lodt_mark_dirty(lod_trace* trace, uint32_t index) {
    lodt_writer* w = &trace->writer;
    if (!w->is_connected || w->entries[index].is_dirty) return;
    // The events so far refer to the old values.
    if (w->entries[index].is_stored && w->events.size > 0) lodt_flush_block(trace);
    w->dirty = (uint32_t*)lodt_more(w, w->dirty, w->dirty_count, &w->dirty_capacity, sizeof(uint32_t));
    if (w->dirty_count >= w->dirty_capacity) return;
    w->entries[index].is_dirty = 1;
    w->dirty[w->dirty_count++] = index;
}

#define LODT_NO_INDEX 0xFFFFFFFFu

// Returns the index of a node, a new one if its id is new; LODT_NO_INDEX if there is no memory.
static uint32_t lodt_index_of(lod_trace* trace, uint64_t id) {
    lodt_writer* w = &trace->writer;
    lodt_entry* entry;
    size_t at;
    if (2 * (w->entry_count + 1) > w->slot_count) lodt_grow_slots(w);
    if (w->entry_count + 1 >= w->slot_count) return LODT_NO_INDEX;
    for (at = (size_t)lodt_hash(id) & (w->slot_count - 1); w->slots[at]; at = (at + 1) & (w->slot_count - 1))
        if (w->entries[w->slots[at] - 1].info.id == id) return w->slots[at] - 1;
    w->entries =
        (lodt_entry*)lodt_more(w, w->entries, w->entry_count, &w->entry_capacity, sizeof(lodt_entry));
    if (w->entry_count >= w->entry_capacity || w->entry_count >= 4194304u) return LODT_NO_INDEX;
    entry = &w->entries[w->entry_count];
    memset(entry, 0, sizeof *entry);
    entry->info.id = id;
    w->slots[at] = (uint32_t)++w->entry_count;
    lodt_store(&trace->nodes, w->entry_count);
    lodt_mark_dirty(trace, (uint32_t)w->entry_count - 1);
    return (uint32_t)w->entry_count - 1;
}

static char* lodt_copy(lodt_writer* w, const char* text, size_t length) {
    char* copy = (char*)malloc(length + 1);
    if (!copy) {
        w->out_of_memory = 1;
        return NULL;
    }
    memcpy(copy, text, length);
    copy[length] = 0;
    return copy;
}

// Returns the index of a name. The table holds 4096: name 0 stands for all that are new after that, so that an engine that
// makes up names does not fill the memory.
static uint32_t lodt_name_of(lodt_writer* w, const char* text, uint32_t length) {
    size_t i;
    if (!w->name_count) {
        w->names = (lodt_name*)lodt_more(w, w->names, 0, &w->name_capacity, sizeof(lodt_name));
        if (!w->name_capacity) return 0;
        w->names[0].text = lodt_copy(w, "(too many names)", 16);
        w->names[0].length = w->names[0].text ? 16 : 0;
        w->name_count = 1;
    }
    for (i = 1; i < w->name_count; ++i)
        if (w->names[i].length == length && memcmp(w->names[i].text, text, length) == 0) return (uint32_t)i;
    if (w->name_count >= 4096) return 0;
    w->names = (lodt_name*)lodt_more(w, w->names, w->name_count, &w->name_capacity, sizeof(lodt_name));
    if (w->name_count >= w->name_capacity) return 0;
    w->names[i].text = lodt_copy(w, text, length);
    w->names[i].length = length;
    if (!w->names[i].text) return 0;
    return (uint32_t)w->name_count++;
}

// ---- the writer: events ----

// Begins an event of a thread that is told with its time.
static void lodt_put_thread(lod_trace* trace, const lodt_ring* ring) {
    lodt_writer* w = &trace->writer;
    const uint32_t thread = (uint32_t)(ring - trace->rings);
    if (w->last_thread == thread) return;
    w->last_thread = thread;
    lodt_type(w, LODT_E_THREAD);
    lodt_put_varint(w, &w->events, thread);
}

static void lodt_put_thread_name(lod_trace* trace, const lodt_ring* ring) {
    lodt_writer* w = &trace->writer;
    if (!ring->name) return;
    lodt_type(w, LODT_E_THREAD_NAME);
    lodt_put_varint(w, &w->events, (uint32_t)(ring - trace->rings));
    lodt_put_varint(w, &w->events, ring->name - 1);
}

static void lodt_put_setting(lodt_writer* w, const lodt_setting* setting) {
    lodt_type(w, (unsigned)LODT_E_SETTING | (setting->is_text ? LODT_FLAG_1 : 0u));
    lodt_put_varint(w, &w->events, setting->name);
    if (setting->is_text) {
        lodt_put_text(w, &w->events, setting->text, setting->text ? setting->length : 0);
    } else {
        lodt_put_double(w, &w->events, setting->value);
    }
}

static void lodt_put_restore(lodt_writer* w, uint32_t index, unsigned kind) {
    const lodt_entry* entry = &w->entries[index];
    lodt_type(w, LODT_E_RESTORE);
    lodt_put_byte(w, &w->events, entry->state[kind] | kind << 4);
    lodt_put_delta(w, &w->events, w->last_queued, index);
    w->last_queued = index;
    if (entry->state[kind] == LODT_REQUESTED || entry->state[kind] == LODT_STARTED)
        lodt_put_delta(w, &w->events, w->block_ns, entry->requested_ns[kind]);
    if (entry->state[kind] == LODT_STARTED)
        lodt_put_delta(w, &w->events, w->block_ns, entry->started_ns[kind]);
}

// Starts a block with all that later events build on, but for the nodes' definitions.
static void lodt_start_key_block(lod_trace* trace, uint64_t frame, int is_inside) {
    lodt_writer* w = &trace->writer;
    uint32_t i;
    unsigned kind;
    lodt_flush_block(trace);
    lodt_start_block(w, frame);
    w->is_key = 1;
    w->is_inside = is_inside;
    w->description_dirty = 1;
    for (i = 0; i < w->setting_count; ++i) lodt_put_setting(w, &w->settings[i]);
    for (i = 0; i < trace->ring_count; ++i) lodt_put_thread_name(trace, &trace->rings[i]);
    for (i = 0; i < w->entry_count; ++i)
        for (kind = 0; kind < LOD_TRACE_MAX_KINDS; ++kind)
            if (w->entries[i].state[kind] != LODT_ABSENT) lodt_put_restore(w, i, kind);
    w->frames_since_key = w->bytes_since_key = 0;
    w->key_bytes = w->events.size;
}

// Leaves out an event because the listener is too slow.
static void lodt_skip(lod_trace* trace) {
    ++trace->writer.skipped;
    lodt_add(&trace->dropped, 1);
}

static void lodt_frame_began(lod_trace* trace, const lodt_frame* record) {
    lodt_writer* w = &trace->writer;
    const uint64_t age_ns = lod_trace_now_ns() - w->block_began_ns;
    const size_t waiting = w->pending.size - w->sent;
    const int is_full = w->events.size > 49152 || age_ns > (w->file ? 250000000u : 8000000u);
    w->frame = record->number;
    if (!w->is_connected) return;
    if (waiting > (w->is_streaming ? 8u << 20 : 1u << 20)) {
        w->is_streaming = 0;
        lodt_skip(trace);
        return;
    }
    // A key is worth its bytes once the blocks since the last one take as many.
    if (!w->is_streaming || w->frames_since_key >= 256 ||
        w->bytes_since_key > (w->key_bytes > 2u << 20 ? w->key_bytes : 4u << 20)) {
        lodt_start_key_block(trace, w->frame, 0);
    } else if (is_full) {
        lodt_flush_block(trace);
    }
    if (w->block_events == 0) {
        w->block_frame = w->last_frame = w->frame;
        w->is_inside = 0;
    }
    w->is_streaming = 1;
    ++w->frames_since_key;
    // Threads without a ring cannot say in their own place that events were lost.
    w->skipped += lodt_load(&trace->unringed) - w->unringed_told;
    w->unringed_told = lodt_load(&trace->unringed);
    if (w->skipped) {
        lodt_type(w, LODT_E_DROPPED);
        lodt_put_varint(w, &w->events, w->skipped);
    }
    w->skipped = 0;
    ++w->block_frames;
    lodt_type(w, LODT_E_FRAME_BEGIN);
    lodt_put_delta(w, &w->events, w->last_frame, w->frame);
    w->last_frame = w->frame;
    lodt_put_time(w, record->ns);
    lodt_put_double(w, &w->events, record->first);
}

static void lodt_frame_ended(lodt_writer* w, const lodt_frame* record) {
    lodt_type(w, LODT_E_FRAME_END);
    lodt_put_time(w, record->ns);
    lodt_put_double(w, &w->events, record->first);
    lodt_put_double(w, &w->events, record->second);
}

// A view's 39 numbers as 64-bit words: eye, view, projection, viewport.
static void lodt_view_words(const lod_trace_view_info* info, uint64_t words[39]) {
    int i;
    memcpy(words, info->eye, 24);
    memcpy(words + 3, info->view, 128);
    memcpy(words + 19, info->projection, 128);
    for (i = 0; i < 4; ++i) words[35 + i] = (uint32_t)info->viewport[i];
}

static void lodt_view_told(lodt_writer* w, const lodt_view* record) {
    uint64_t words[39], before[39], mask = 0;
    int i;
    lodt_view_words(&record->info, words);
    lodt_view_words(&w->views[record->head.a], before);
    for (i = 0; i < 39; ++i)
        if (words[i] != before[i]) mask |= (uint64_t)1 << i;
    w->views[record->head.a] = record->info;
    lodt_type(w, LODT_E_VIEW);
    lodt_put_byte(w, &w->events, record->head.a);
    lodt_put_varint(w, &w->events, mask);
    for (i = 0; i < 39; ++i)
        if (mask >> i & 1) lodt_put_number(w, &w->events, words[i], i < 35 ? 8 : 4);
}

static void lodt_node_drawn(lod_trace* trace, const lodt_drawn* record) {
    lodt_writer* w = &trace->writer;
    const uint32_t index = lodt_index_of(trace, record->node);
    const int is_drawn = record->head.type == LODT_DRAWN;
    const unsigned morph = !is_drawn || record->morph == 0 ? 0u : record->morph == 1 ? 1u : 2u;
    const unsigned has_px = is_drawn && record->head.b;
    if (index == LODT_NO_INDEX) {
        lodt_add(&trace->dropped, 1);
        return;
    }
    if (w->last_view != record->head.a) {
        w->last_view = record->head.a;
        lodt_type(w, LODT_E_SELECT_VIEW);
        lodt_put_byte(w, &w->events, record->head.a);
    }
    if (is_drawn) {
        lodt_type(w, LODT_E_DRAWN | morph << 5 | has_px << 7);
    } else {
        lodt_type(w, LODT_E_CULLED | (unsigned)record->head.b << 5);
    }
    lodt_put_delta(w, &w->events, w->last_drawn, index);
    w->last_drawn = index;
    if (morph == 2) lodt_put_float(w, &w->events, record->morph);
    if (has_px) lodt_put_float(w, &w->events, record->error_px);
}

// Follows the state of a node's data, whether someone listens or not.
static void lodt_follow(lodt_entry* entry, const lodt_queue* record) {
    const unsigned kind = record->head.a;
    switch (record->head.b) {
        case LODT_E_REQUESTED:
            entry->state[kind] = LODT_REQUESTED;
            entry->requested_ns[kind] = record->ns;
            break;
        case LODT_E_STARTED:
            if (entry->state[kind] != LODT_REQUESTED) entry->requested_ns[kind] = record->ns;
            entry->state[kind] = LODT_STARTED;
            entry->started_ns[kind] = record->ns;
            break;
        case LODT_E_ARRIVED:
            entry->state[kind] = LODT_RESIDENT;
            break;
        case LODT_E_FAILED:
            entry->state[kind] = LODT_FAILED;
            break;
        default:
            entry->state[kind] = LODT_ABSENT;
            break;
    }
}

static void lodt_queue_told(lod_trace* trace, const lodt_ring* ring, const lodt_queue* record) {
    lodt_writer* w = &trace->writer;
    const uint32_t index = lodt_index_of(trace, record->node);
    const unsigned flags = (record->head.a ? LODT_FLAG_1 : 0u) | (record->head.c ? LODT_FLAG_2 : 0u);
    uint32_t reason = 0;
    if (index == LODT_NO_INDEX) {
        lodt_add(&trace->dropped, 1);
        return;
    }
    lodt_follow(&w->entries[index], record);
    if (!w->is_streaming) return;
    if (record->head.b == LODT_E_FAILED) reason = lodt_name_of(w, (const char*)(record + 1), record->length);
    lodt_put_thread(trace, ring);
    lodt_type(w, record->head.b | flags);
    if (record->head.a) lodt_put_byte(w, &w->events, record->head.a);
    lodt_put_delta(w, &w->events, w->last_queued, index);
    w->last_queued = index;
    lodt_put_time(w, record->ns);
    if (record->head.c) lodt_put_float(w, &w->events, record->priority);
    if (record->head.b == LODT_E_FAILED) lodt_put_varint(w, &w->events, reason);
}

static void lodt_setting_told(lod_trace* trace, const lodt_named* record) {
    lodt_writer* w = &trace->writer;
    const char* name = (const char*)(record + 1);
    const uint32_t index = lodt_name_of(w, name, record->name_length);
    lodt_setting* setting = NULL;
    size_t i;
    if (!index) {
        lodt_add(&trace->dropped, 1);
        return;
    }
    for (i = 0; i < w->setting_count && !setting; ++i)
        if (w->settings[i].name == index) setting = &w->settings[i];
    if (!setting) {
        w->settings = (lodt_setting*)lodt_more(w, w->settings, w->setting_count, &w->setting_capacity,
                                               sizeof(lodt_setting));
        if (w->setting_count >= w->setting_capacity) return;
        setting = &w->settings[w->setting_count++];
        memset(setting, 0, sizeof *setting);
        setting->name = index;
    }
    free(setting->text);
    setting->text = record->head.b ? lodt_copy(w, name + record->name_length, record->text_length) : NULL;
    setting->length = record->text_length;
    setting->is_text = record->head.b;
    setting->value = record->value;
    if (w->is_streaming) lodt_put_setting(w, setting);
}

static void lodt_counter_told(lodt_writer* w, const lodt_named* record) {
    const uint32_t name = lodt_name_of(w, (const char*)(record + 1), record->name_length);
    // Only whole numbers that a double holds exactly. -0 is no whole number, because it would come back as 0.
    const int is_small = record->value >= -9007199254740992.0 && record->value <= 9007199254740992.0;
    const int64_t whole = is_small ? (int64_t)record->value : 0;
    const double back = (double)whole;
    if (is_small && memcmp(&back, &record->value, 8) == 0) {
        lodt_type(w, (unsigned)LODT_E_COUNTER | LODT_FLAG_1);
        lodt_put_varint(w, &w->events, name);
        lodt_put_delta(w, &w->events, 0, (uint64_t)whole);
    } else {
        lodt_type(w, LODT_E_COUNTER);
        lodt_put_varint(w, &w->events, name);
        lodt_put_double(w, &w->events, record->value);
    }
}

static int lodt_is_same(const lod_trace_node_info* a, const lod_trace_node_info* b) {
    return a->parent == b->parent && a->has_parent == b->has_parent && a->level == b->level &&
           a->bounds == b->bounds &&
           memcmp(a->centre, b->centre, sizeof *a - offsetof(lod_trace_node_info, centre)) == 0;
}

static void lodt_node_told(lod_trace* trace, const lodt_node* record) {
    lodt_writer* w = &trace->writer;
    const uint32_t index = lodt_index_of(trace, record->info.id);
    lodt_entry* entry;
    if (index == LODT_NO_INDEX) {
        lodt_add(&trace->dropped, 1);
        return;
    }
    entry = &w->entries[index];
    if (entry->is_told && lodt_is_same(&entry->info, &record->info)) return;
    // Events of this block refer to the values that are not written yet.
    if (entry->is_told && entry->is_dirty && w->events.size > 0) lodt_flush_block(trace);
    lodt_mark_dirty(trace, index);
    entry->info = record->info;
    entry->is_told = 1;
}

static void lodt_process(lod_trace* trace, lodt_ring* ring, const lodt_head* head) {
    lodt_writer* w = &trace->writer;
    const void* record = head;
    // The stream keeps its blocks small even if no frame begins, and a listener that is too slow loses the frame.
    if (w->events.size > LODT_ENOUGH) lodt_flush_block(trace);
    if (w->is_streaming && w->pending.size - w->sent > 32u << 20) {
        w->is_streaming = 0;
        lodt_skip(trace);
    }
    switch (head->type) {
        case LODT_DESCRIBE:
            if (w->events.size > 0) lodt_flush_block(trace);
            w->description = *(const lodt_description*)record;
            w->is_described = w->description_dirty = 1;
            return;
        case LODT_NODE:
            lodt_node_told(trace, (const lodt_node*)record);
            return;
        case LODT_QUEUE:
            lodt_queue_told(trace, ring, (const lodt_queue*)record);
            return;
        case LODT_SETTING:
            lodt_setting_told(trace, (const lodt_named*)record);
            return;
        case LODT_FRAME_BEGIN:
            lodt_frame_began(trace, (const lodt_frame*)record);
            return;
        case LODT_THREAD_NAME:
            ring->name = lodt_name_of(w, (const char*)((const lodt_named*)record + 1),
                                      ((const lodt_named*)record)->name_length) +
                         1;
            if (w->is_streaming) lodt_put_thread_name(trace, ring);
            return;
        default:
            break;
    }
    if (!w->is_streaming) {
        if (w->is_connected && head->type != LODT_DROPPED && w->skipped) lodt_skip(trace);
        return;
    }
    switch (head->type) {
        case LODT_FRAME_END:
            lodt_frame_ended(w, (const lodt_frame*)record);
            break;
        case LODT_VIEW:
            lodt_view_told(w, (const lodt_view*)record);
            break;
        case LODT_DRAWN:
        case LODT_CULLED:
            lodt_node_drawn(trace, (const lodt_drawn*)record);
            break;
        case LODT_COUNTER:
            lodt_counter_told(w, (const lodt_named*)record);
            break;
        case LODT_MESSAGE:
            lodt_put_thread(trace, ring);
            lodt_type(w, LODT_E_MESSAGE | (unsigned)head->a << 5);
            lodt_put_time(w, ((const lodt_named*)record)->ns);
            lodt_put_text(w, &w->events, (const char*)((const lodt_named*)record + 1),
                          ((const lodt_named*)record)->text_length);
            break;
        case LODT_DROPPED:
            lodt_type(w, LODT_E_DROPPED);
            lodt_put_varint(w, &w->events, ((const lodt_count*)record)->count);
            break;
        default:
            break;
    }
}

// ---- the writer: rings ----

// Returns the time of a record, or the ring's last one if it has none.
static uint64_t lodt_time_of(const lodt_ring* ring, const lodt_head* head) {
    const void* record = head;
    uint64_t ns = 0;
    if (head->type == LODT_QUEUE) ns = ((const lodt_queue*)record)->ns;
    if (head->type == LODT_FRAME_BEGIN || head->type == LODT_FRAME_END) ns = ((const lodt_frame*)record)->ns;
    if (head->type == LODT_MESSAGE) ns = ((const lodt_named*)record)->ns;
    return ns ? ns : ring->ns;
}

static const lodt_head* lodt_next_record(const lodt_ring* ring) {
    return (const lodt_head*)(const void*)(ring->bytes + (ring->next_tail & (ring->capacity - 1)));
}

// Reads all rings up to now, in the order of time. Returns 1 if a ring was more than a quarter full.
static int lodt_drain(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    int is_busy = 0;
    uint32_t i;
    for (i = 0; i < trace->ring_count; ++i) {
        lodt_ring* ring = &trace->rings[i];
        ring->limit = lodt_load(&ring->head);
        if (ring->limit - ring->next_tail > ring->capacity / 4) is_busy = 1;
    }
    for (;;) {
        lodt_ring* ring = NULL;
        uint64_t first = 0;
        for (i = 0; i < trace->ring_count; ++i) {
            lodt_ring* other = &trace->rings[i];
            uint64_t ns;
            if (other->next_tail == other->limit) continue;
            ns = lodt_time_of(other, lodt_next_record(other));
            if (!ring || ns < first) {
                ring = other;
                first = ns;
            }
        }
        if (!ring) return is_busy;
        // Up to the ring's next record with another time, no other ring has an earlier one.
        do {
            const lodt_head* head = lodt_next_record(ring);
            ring->ns = lodt_time_of(ring, head);
            if (ring->ns > w->now_ns) w->now_ns = ring->ns;
            if (head->type != LODT_PAD) lodt_process(trace, ring, head);
            ring->next_tail += head->size;
        } while (ring->next_tail != ring->limit && lodt_time_of(ring, lodt_next_record(ring)) == ring->ns);
        lodt_store(&ring->tail, ring->next_tail);
    }
}

// Begins a stream: the file header, and all that is known.
static void lodt_connect(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    static const unsigned char header[16] = {'L', 'O', 'D', 'T', 'R', 'A', 'C', 'E', LOD_TRACE_VERSION,
                                             0,   16,  0};
    uint32_t i;
    w->is_connected = 1;
    w->is_streaming = 0;
    w->skipped = 0;
    w->names_stored = 0;
    w->description_dirty = 1;
    w->now_ns = w->now_ns ? w->now_ns : lod_trace_now_ns();
    lodt_output(trace, header, sizeof header);
    lodt_start_block(w, w->frame);
    for (i = 0; i < w->entry_count; ++i) lodt_mark_dirty(trace, i);
    lodt_start_key_block(trace, w->frame, 1);
    // A file begins with the engine, so it has what happens before the first frame. A tool gets whole frames.
    w->is_streaming = w->file != NULL;
    if (!w->is_streaming) lodt_flush_block(trace);
    lodt_add(&trace->connections, 1);
    if (w->is_connected) lodt_store(&trace->listening, 1);
}

// Takes a tool that wants to attach, and notices one that left. A second tool at the same time is turned away.
static void lodt_poll_sockets(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    lodt_socket came;
    char ignored[256];
    const int on = 1;
    if (w->listener == LODT_NO_SOCKET || w->out_of_memory) return;
    if (w->peer != LODT_NO_SOCKET) {
        const long count = lodt_receive(w->peer, ignored, sizeof ignored);
        if (count == 0 || (count < 0 && !lodt_would_block())) lodt_disconnect(trace);
    }
    came = accept(w->listener, NULL, NULL);
    if (came == LODT_NO_SOCKET) return;
    if (w->peer != LODT_NO_SOCKET || !lodt_unblock(came)) {
        lodt_close_socket(came);
        return;
    }
    setsockopt(came, IPPROTO_TCP, TCP_NODELAY, (const char*)&on, sizeof on);
#if defined(SO_NOSIGPIPE)
    setsockopt(came, SOL_SOCKET, SO_NOSIGPIPE, (const char*)&on, sizeof on);
#endif
    w->peer = came;
    lodt_connect(trace);
}

static void lodt_write_on(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    for (;;) {
        const int stops = lodt_load(&trace->stop) != 0;
        const uint64_t flush = lodt_load(&trace->flush_wanted);
        const int flushes = flush != lodt_load(&trace->flush_done);
        int is_busy;
        uint64_t age_ns;
        lodt_poll_sockets(trace);
        is_busy = lodt_drain(trace);
        age_ns = lod_trace_now_ns() - w->block_began_ns;
        // Definitions wait, each once, while the listener is too slow.
        if (w->pending.size - w->sent < 8u << 20 &&
            (stops || flushes || age_ns > (w->file ? 500000000u : 50000000u)))
            lodt_flush_block(trace);
        lodt_send_pending(trace);
        if (w->out_of_memory && !lodt_load(&trace->has_error)) {
            lodt_fail(trace, "out of memory");
            lodt_disconnect(trace);
        }
        if (flushes && w->sent == w->pending.size) lodt_store(&trace->flush_done, flush);
        if (stops) return;
        if (!is_busy) lodt_sleep(flushes ? 1 : w->is_connected ? trace->wake_ms : 4 * trace->wake_ms);
    }
}

static void lodt_run_writer(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    const uint64_t patience_ns = 1000000000u;
    uint64_t end;
    lodt_write_on(trace);
    end = lod_trace_now_ns() + patience_ns;
    while (w->is_connected && w->sent < w->pending.size && lod_trace_now_ns() < end) {
        lodt_send_pending(trace);
        lodt_sleep(1);
    }
    lodt_disconnect(trace);
}

#if defined(_WIN32)
static DWORD WINAPI lodt_thread(LPVOID trace) {
    lodt_run_writer((lod_trace*)trace);
    return 0;
}
static int lodt_start_thread(lod_trace* trace) {
    trace->thread = CreateThread(NULL, 0, lodt_thread, trace, 0, NULL);
    return trace->thread != NULL;
}
static void lodt_join_thread(lod_trace* trace) {
    WaitForSingleObject(trace->thread, INFINITE);
    CloseHandle(trace->thread);
}
#else
static void* lodt_thread(void* trace) {
    lodt_run_writer((lod_trace*)trace);
    return NULL;
}
static int lodt_start_thread(lod_trace* trace) {
    // The engine's signal handlers run on the engine's threads.
    sigset_t all, before;
    int status;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    status = pthread_create(&trace->thread, NULL, lodt_thread, trace);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (status) errno = status;
    return status == 0;
}
static void lodt_join_thread(lod_trace* trace) {
    pthread_join(trace->thread, NULL);
}
#endif

// ---- opening and closing ----

// Returns whether a path leads to a file that holds something else than a trace. Pipes and devices hold nothing.
static int lodt_holds_other(const char* path) {
    FILE* old;
    char begins[8];
    size_t count = 0;
#if !defined(_WIN32)
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
#endif
    old = LODT_FOPEN(path, "rb");
    if (old) {
        count = fread(begins, 1, 8, old);
        fclose(old);
    }
    return count > 0 && (count < 8 || memcmp(begins, "LODTRACE", 8) != 0);
}

// Returns 0 with the error set.
static int lodt_open_file(lod_trace* trace) {
    if (lodt_holds_other(trace->where)) {
        lodt_fail(trace, "is another file; expected a trace or a new name");
        return 0;
    }
    trace->writer.file = LODT_FOPEN(trace->where, "wb");
    if (trace->writer.file) return 1;
    lodt_fail_system(trace, "cannot be written");
    return 0;
}

static int lodt_open_port(lod_trace* trace, const char* port) {
    struct sockaddr_in address;
#if defined(_WIN32)
    int length = (int)sizeof address;
#else
    socklen_t length = sizeof address;
#endif
    const int on = 1;
    long number = 0;
    const char* c = port;
    for (; *c >= '0' && *c <= '9' && number <= 65535; ++c) number = 10 * number + (*c - '0');
    if (c == port || *c || number > 65535) {
        lodt_fail(trace, "is no port; expected tcp:127.0.0.1:PORT with a port in [0, 65535]");
        return 0;
    }
#if defined(_WIN32)
    {
        WSADATA data;
        if (WSAStartup(MAKEWORD(2, 2), &data) != 0) {
            lodt_fail_system(trace, "no sockets");
            return 0;
        }
        trace->has_winsock = 1;
    }
#endif
    trace->writer.listener = socket(AF_INET, SOCK_STREAM, 0);
    if (trace->writer.listener == LODT_NO_SOCKET) {
        lodt_fail_system(trace, "no socket");
        return 0;
    }
#if defined(_WIN32)
    setsockopt(trace->writer.listener, SOL_SOCKET, SO_EXCLUSIVEADDRUSE, (const char*)&on, sizeof on);
#else
    setsockopt(trace->writer.listener, SOL_SOCKET, SO_REUSEADDR, (const char*)&on, sizeof on);
#endif
    memset(&address, 0, sizeof address);
    address.sin_family = AF_INET;
    address.sin_port = htons((uint16_t)number);
    address.sin_addr.s_addr = htonl(0x7F000001u);
    if (bind(trace->writer.listener, (struct sockaddr*)&address, length) != 0 ||
        listen(trace->writer.listener, 4) != 0 || !lodt_unblock(trace->writer.listener) ||
        getsockname(trace->writer.listener, (struct sockaddr*)&address, &length) != 0) {
        char reason[128], text[256];
        lodt_system_error(reason, sizeof reason);
        snprintf(text, sizeof text, "cannot listen: %s; expected a free port", reason);
        lodt_fail(trace, text);
        return 0;
    }
    trace->port = ntohs(address.sin_port);
    return 1;
}

static int lodt_open_where(lod_trace* trace) {
    const char* prefix = "tcp:127.0.0.1:";
    if (strncmp(trace->where, "tcp:", 4) != 0) return lodt_open_file(trace);
    if (strncmp(trace->where, prefix, strlen(prefix)) == 0)
        return lodt_open_port(trace, trace->where + strlen(prefix));
    lodt_fail(trace, "is another address; expected tcp:127.0.0.1:PORT");
    return 0;
}

static void lodt_free(lod_trace* trace) {
    lodt_writer* w = &trace->writer;
    size_t i;
    if (w->file) fclose(w->file);
    if (w->listener != LODT_NO_SOCKET) lodt_close_socket(w->listener);
#if defined(_WIN32)
    if (trace->has_winsock) WSACleanup();
#endif
    for (i = 0; i < w->name_count; ++i) free(w->names[i].text);
    for (i = 0; i < w->setting_count; ++i) free(w->settings[i].text);
    free(w->names);
    free(w->settings);
    free(w->entries);
    free(w->slots);
    free(w->dirty);
    free(w->definitions.bytes);
    free(w->events.bytes);
    free(w->pending.bytes);
    free(trace->ring_memory);
    free(*((void**)(void*)trace - 1));
}

// Allocates zeros at a multiple of 64 bytes, with the address to free in front of them.
static void* lodt_allocate(size_t size) {
    unsigned char* memory = (unsigned char*)calloc(1, size + 64 + sizeof(void*));
    unsigned char* aligned;
    if (!memory) return NULL;
    aligned = memory + sizeof(void*);
    aligned += (64 - (uintptr_t)aligned % 64) % 64;
    memcpy(aligned - sizeof(void*), &memory, sizeof memory);
    return aligned;
}

// Lays out the rings. Returns 0 if there is no memory.
static int lodt_allocate_rings(lod_trace* trace, const lod_trace_options* options) {
    uint64_t capacity = 16384;
    const uint64_t wanted = options->ring_bytes ? options->ring_bytes : 1u << 20;
    unsigned char* memory;
    uint32_t i;
    while (capacity < wanted && capacity < 64u << 20) capacity *= 2;
    trace->ring_count = options->max_threads ? options->max_threads : 16;
    if (trace->ring_count > 64) trace->ring_count = 64;
    trace->wake_ms = options->wake_ms ? options->wake_ms : 5;
    if (trace->wake_ms > 1000) trace->wake_ms = 1000;
    memory = (unsigned char*)calloc(1, trace->ring_count * (sizeof(lodt_ring) + (size_t)capacity) + 64);
    if (!memory) return 0;
    trace->ring_memory = memory;
    memory += (64 - (uintptr_t)memory % 64) % 64;
    trace->rings = (lodt_ring*)(void*)memory;
    memory += trace->ring_count * sizeof(lodt_ring);
    for (i = 0; i < trace->ring_count; ++i) {
        trace->rings[i].bytes = memory + i * (size_t)capacity;
        trace->rings[i].capacity = capacity;
    }
    return 1;
}

lod_trace* lod_trace_open(const char* where, const lod_trace_options* options, char* error,
                          size_t error_bytes) {
    static uint64_t serials;
    static const lod_trace_options defaults = {0, 0, 0};
    lod_trace* trace;
    uint64_t serial;
    int is_open = 0;
    if (error && error_bytes) error[0] = 0;
    trace = (lod_trace*)lodt_allocate(sizeof(lod_trace));
    if (!trace) {
        if (error && error_bytes) snprintf(error, error_bytes, "%s: out of memory", where ? where : "trace");
        return NULL;
    }
    trace->writer.listener = trace->writer.peer = LODT_NO_SOCKET;
    snprintf(trace->where, sizeof trace->where, "%s", where ? where : "");
    do serial = lodt_load(&serials) + 1;
    while (!lodt_exchange_if(&serials, serial - 1, serial));
    trace->serial = serial;
    if (!where || !*where || strlen(where) >= sizeof trace->where) {
        lodt_fail(trace, "is no path; expected 1 to 511 bytes");
    } else if (!lodt_allocate_rings(trace, options ? options : &defaults)) {
        lodt_fail(trace, "out of memory");
    } else if (lodt_open_where(trace)) {
        if (trace->writer.file) lodt_connect(trace);
        is_open = !lodt_load(&trace->has_error);
        if (is_open && !lodt_start_thread(trace)) {
            lodt_fail_system(trace, "no thread");
            is_open = 0;
        }
    }
    if (is_open) return trace;
    if (error && error_bytes) snprintf(error, error_bytes, "%s", trace->error);
    lodt_free(trace);
    return NULL;
}

void lod_trace_close(lod_trace* trace) {
    if (!trace) return;
    lodt_store(&trace->stop, 1);
    lodt_join_thread(trace);
    lodt_free(trace);
}

#ifdef __cplusplus
}
#endif

#endif  // LOD_TRACE_IMPLEMENTATION

// NOLINTEND
