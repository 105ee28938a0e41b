// The events of a trace, as plain data. lod_trace.h writes traces, trace_reader.h and trace_index.h read them.
// The comments of lod_trace.h state units and coordinate conventions. Values are as the engine told them: a number may be
// infinite or not a number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <variant>

namespace planet {

inline constexpr std::size_t maxTraceViews = 16;
inline constexpr std::size_t maxTraceKinds = 4;

enum class TraceShape : std::uint8_t { Flat, Sphere };
enum class TraceIds : std::uint8_t { Opaque, Quadtree };
enum class TraceErrorUnit : std::uint8_t { World, Pixels };
enum class TraceRequests : std::uint8_t { Node, Children };
enum class TraceBoundsShape : std::uint8_t { None, Sphere, Box };
enum class TraceCulling : std::uint8_t { ByFrustum, ByHorizon, ByOcclusion, Other };
enum class TraceSeverity : std::uint8_t { Info, Warning, Failure };

// The state of a node's data of one kind.
enum class TraceData : std::uint8_t { Absent, Requested, Started, Resident, Failed };

struct TraceDescription {
    std::string name{};
    TraceShape shape = TraceShape::Flat;
    TraceIds ids = TraceIds::Opaque;
    TraceErrorUnit error = TraceErrorUnit::World;
    TraceRequests requests = TraceRequests::Node;
    double radius = 0;         // of a sphere, world units
    double metresPerUnit = 1;  // metres
    std::array<std::string, maxTraceKinds> kinds{};

    bool operator==(const TraceDescription&) const = default;
};

struct TraceBounds {
    TraceBoundsShape shape = TraceBoundsShape::None;
    glm::dvec3 centre{0, 0, 0};        // world units
    double radius = 0;                 // of a sphere, world units
    std::array<glm::dvec3, 3> axes{};  // of a box: unit, orthogonal, the third roughly up
    glm::dvec3 halfSize{0, 0, 0};      // of a box, along each axis, world units

    // Returns the radius of the smallest sphere around the centre that holds the bounds, world units.
    double reach() const { return shape == TraceBoundsShape::Sphere ? radius : glm::length(halfSize); }
    bool operator==(const TraceBounds&) const = default;
};

struct TraceNode {
    std::uint64_t id = 0;
    bool isTold = false;  // false: the engine named the id only, and the fields below are defaults
    bool hasParent = false;
    std::uint64_t parent = 0;  // id, if hasParent
    std::uint32_t level = 0;
    TraceBounds bounds{};
    double error = 0;             // in TraceDescription::error
    std::uint64_t bytes = 0;      // 0: unknown
    std::uint64_t triangles = 0;  // 0: unknown

    bool operator==(const TraceNode&) const = default;
};

struct TraceView {
    glm::dvec3 eye{0, 0, 0};                  // world units
    glm::dmat4 view{1};                       // camera from world
    glm::dmat4 projection{1};                 // clip from camera
    int x = 0, y = 0, width = 0, height = 0;  // viewport, pixels

    bool operator==(const TraceView&) const = default;
};

// Nodes and names are numbered from 0 in the order in which the stream defines them, without gaps.
using TraceNodeIndex = std::uint32_t;
using TraceNameIndex = std::uint32_t;

// ---- definitions ----

// All events before are void: the reader goes on at another place. Only trace_index.h makes it.
struct TraceRestarted {
    bool operator==(const TraceRestarted&) const = default;
};
// Earlier settings and paging are void: settings, names of threads, and the state of all data that is not Absent follow.
struct TraceKey {
    std::uint64_t frame = 0;
    std::uint64_t ns = 0;
    bool operator==(const TraceKey&) const = default;
};
struct TraceNamed {
    TraceNameIndex index = 0;
    std::string name{};
    bool operator==(const TraceNamed&) const = default;
};
// A new node, or new values of an old one.
struct TraceNodeTold {
    TraceNodeIndex index = 0;
    TraceNode node;
    bool operator==(const TraceNodeTold&) const = default;
};

// ---- events ----

struct TraceFrameBegan {
    std::uint64_t number = 0;  // from 1; a gap is a frame that was lost
    std::uint64_t ns = 0;
    double timeS = 0;
    bool operator==(const TraceFrameBegan&) const = default;
};
struct TraceFrameEnded {
    std::uint64_t ns = 0;
    double cpuMs = -1;  // negative: unknown
    double gpuMs = -1;
    bool operator==(const TraceFrameEnded&) const = default;
};
struct TraceViewTold {
    std::uint8_t view = 0;
    TraceView info;
    bool operator==(const TraceViewTold&) const = default;
};
struct TraceDrawn {
    std::uint8_t view = 0;
    TraceNodeIndex node = 0;
    float morph = 0;          // [0, 1]
    bool hasErrorPx = false;  // the engine told it
    float errorPx = 0;
    bool operator==(const TraceDrawn&) const = default;
};
struct TraceCulled {
    std::uint8_t view = 0;
    TraceNodeIndex node = 0;
    TraceCulling reason = TraceCulling::ByFrustum;
    bool operator==(const TraceCulled&) const = default;
};
enum class TraceStep : std::uint8_t { Requested, Started, Arrived, Cancelled, Failed, Evicted };
struct TracePaged {
    TraceStep step = TraceStep::Requested;
    std::uint8_t kind = 0;
    std::uint8_t thread = 0;
    bool hasPriority = false;
    TraceNodeIndex node = 0;
    std::uint64_t ns = 0;
    float priority = 0;
    TraceNameIndex reason = 0;  // of Failed
    bool operator==(const TracePaged&) const = default;
};
struct TraceCounted {
    TraceNameIndex name = 0;
    double value = 0;
    bool operator==(const TraceCounted&) const = default;
};
using TraceSettingValue = std::variant<double, std::string>;
struct TraceSet {
    TraceNameIndex name = 0;
    TraceSettingValue value{};
    bool operator==(const TraceSet&) const = default;
};
struct TraceMessage {
    TraceSeverity severity = TraceSeverity::Info;
    std::uint8_t thread = 0;
    std::uint64_t ns = 0;
    std::string text{};
    bool operator==(const TraceMessage&) const = default;
};
// Events were lost here, so the frame in progress and the one before it may lack some.
struct TraceDropped {
    std::uint64_t count = 0;
    bool operator==(const TraceDropped&) const = default;
};
struct TraceThreadNamed {
    std::uint8_t thread = 0;
    TraceNameIndex name = 0;
    bool operator==(const TraceThreadNamed&) const = default;
};
// Follows a TraceKey.
struct TraceRestored {
    std::uint8_t kind = 0;
    TraceData data = TraceData::Absent;
    TraceNodeIndex node = 0;
    std::uint64_t requestedNs = 0;  // of Requested and Started
    std::uint64_t startedNs = 0;    // of Started
    bool operator==(const TraceRestored&) const = default;
};

using TraceEvent =
    std::variant<TraceRestarted, TraceKey, TraceDescription, TraceNamed, TraceNodeTold, TraceFrameBegan,
                 TraceFrameEnded, TraceViewTold, TraceDrawn, TraceCulled, TracePaged, TraceCounted, TraceSet,
                 TraceMessage, TraceDropped, TraceThreadNamed, TraceRestored>;

}  // namespace planet
