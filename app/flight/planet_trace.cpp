#include "app/flight/planet_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "planet/planet_tools.h"
#include "planet/select/screen_error.h"
#include "planet/sphere/view.h"
#include "planet/trace/lod_trace.h"

namespace worldy {

namespace {

using planet::Result;

// A frame of a flight can visit some thousand chunks that are new, at 300 bytes each.
constexpr std::uint32_t ringBytes = 16u << 20;

std::uint64_t idOf(const planet::ChunkId& id) {
    return lod_trace_quadtree_id(static_cast<std::uint32_t>(id.face), id.level, id.x, id.y);
}

void copy(const glm::dvec3& from, double* to) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

lod_trace_node_info infoOf(const planet::ChunkNode& node, const planet::PlanetShape& shape, float errorM) {
    lod_trace_node_info info{};
    info.id = idOf(node.id);
    info.has_parent = node.id.level > 0;
    if (info.has_parent) info.parent = idOf(planet::parentOf(node.id));
    info.level = node.id.level;
    info.bounds = LOD_TRACE_BOUNDS_BOX;
    copy(node.bounds.box.centreM, info.centre);
    for (std::size_t axis = 0; axis < 3; ++axis) copy(node.bounds.box.axes[axis], info.axes + 3 * axis);
    copy(node.bounds.box.halfSizeM, info.half_size);
    info.error = static_cast<double>(errorM);
    info.bytes = planet::chunkBytesCpu(shape) + planet::chunkBytesGpu(shape);
    info.triangles = 2 * planet::chunkCellCount(shape);
    return info;
}

lod_trace_view_info infoOf(const planet::View& view) {
    lod_trace_view_info info{};
    copy(view.eyeM, info.eye);
    const glm::dmat3 rotation = planet::cameraFromWorldRotation(view);
    const glm::dvec3 translation = -(rotation * view.eyeM);
    for (int column = 0; column < 3; ++column) copy(rotation[column], info.view + 4 * column);
    copy(translation, info.view + 12);
    info.view[15] = 1;
    // A perspective without a far plane, whose near plane lies at 1 m.
    info.projection[0] = 1 / std::tan(view.horizontalFovRad / 2);
    info.projection[5] = info.projection[0] * view.widthPx / view.heightPx;
    info.projection[10] = -1;
    info.projection[11] = -1;
    info.projection[14] = -2;
    info.viewport[2] = view.widthPx;
    info.viewport[3] = view.heightPx;
    return info;
}

}  // namespace

void PlanetTrace::Close::operator()(lod_trace* trace) const {
    lod_trace_close(trace);
}

Result<PlanetTrace> PlanetTrace::create(const std::filesystem::path& file, planet::Planet& planet,
                                        const std::string& name) {
    std::array<char, 1024> problem{};
    lod_trace_options options{};
    options.ring_bytes = ringBytes;
    lod_trace* const trace = lod_trace_open(file.c_str(), &options, problem.data(), problem.size());
    if (!trace) return planet::ioError(problem.data());
    PlanetTrace made(file, trace);
    made.describe(planet, name);
    made.eventsBefore_ = planet.inspect().pagingEventCount();
    planet.tools().keepMoves(true);
    return made;
}

void PlanetTrace::describe(const planet::Planet& planet, const std::string& name) {
    lod_trace_description description{};
    description.name = name.c_str();
    description.shape = LOD_TRACE_SPHERE;
    description.radius = planet.tree().shape.radiusM;
    description.metres_per_unit = 1;
    description.ids = LOD_TRACE_IDS_QUADTREE;
    description.error = LOD_TRACE_ERROR_WORLD;
    description.requests = LOD_TRACE_REQUESTS_CHILDREN;
    description.kinds[static_cast<std::size_t>(planet::BlockKind::Heights)] = "heights";
    description.kinds[static_cast<std::size_t>(planet::BlockKind::Colours)] = "colours";
    description.kinds[static_cast<std::size_t>(planet::BlockKind::Normals)] = "normals";
    lod_trace_describe(trace_.get(), &description);
}

void PlanetTrace::tellSettings(const planet::LodSettings& lod, std::size_t view) {
    const auto tell = [&](const char* what, double value) {
        const std::string name = view == 0 ? std::string(what) : fmt::format("{}/{}", what, view);
        const auto known = settings_.find(name);
        if (known != settings_.end() && known->second == value) return;
        if (lod_trace_setting(trace_.get(), name.c_str(), value) != 0) settings_[name] = value;
    };
    tell(LOD_TRACE_TAU, lod.tauPx);
    tell(LOD_TRACE_HYSTERESIS, lod.hysteresis);
    tell(LOD_TRACE_MAX_LEVEL, lod.maxLevel);
    tell("fade_s", lod.morph ? lod.fadeS : 0);
}

void PlanetTrace::tellNodes(const planet::Planet& planet, std::size_t view) {
    const planet::ChunkTree& tree = planet.tree();
    const planet::ErrorMetric metric = planet.views()[view].input.lod.metric;
    for (const planet::VisitedNode& visited : planet.selection(view).touched) {
        const planet::ChunkNode& node = tree.nodes[visited.node];
        // A region's factor on τ counts like an error that is less by it, so that tools compare with one τ.
        const Told now{planet::deltaOf(node, metric) / node.demand.tauFactor, node.maxHeightM};
        const auto known = told_.find(node.id);
        if (known != told_.end() && known->second.errorM == now.errorM &&
            known->second.maxHeightM == now.maxHeightM)
            continue;
        const lod_trace_node_info info = infoOf(node, tree.shape, now.errorM);
        if (lod_trace_node(trace_.get(), &info) != 0) told_[node.id] = now;
    }
}

void PlanetTrace::tellView(const planet::Planet& planet, std::size_t view) {
    const int number = static_cast<int>(view);
    const lod_trace_view_info info = infoOf(planet.views()[view].input.lodView);
    lod_trace_view(trace_.get(), number, &info);
    const planet::Selection& selection = planet.selection(view);
    for (const planet::DrawItem& item : selection.draw)
        lod_trace_drawn_px(trace_.get(), number, idOf(item.id), item.morph, item.epsPx);
    for (const planet::VisitedNode& visited : selection.touched) {
        const bool byFrustum = visited.fate == planet::NodeFate::CulledFrustum;
        if (!byFrustum && visited.fate != planet::NodeFate::CulledHorizon) continue;
        lod_trace_culled(trace_.get(), number, idOf(planet.tree().nodes[visited.node].id),
                         byFrustum ? LOD_TRACE_CULLED_FRUSTUM : LOD_TRACE_CULLED_HORIZON);
    }
}

void PlanetTrace::tellPaging(planet::Planet& planet) {
    lod_trace* const trace = trace_.get();
    const planet::PagingMoves moves = planet.tools().takeMoves();
    for (const planet::BlockId& block : moves.taken) tellStarted(block);
    const std::deque<planet::PagingEvent>& history = planet.inspect().pagingHistory();
    const std::uint64_t events = planet.inspect().pagingEventCount();
    // If there are more events than the planet keeps, the first are not known.
    const auto fresh = std::min<std::uint64_t>(events - eventsBefore_, history.size());
    eventsBefore_ = events;
    for (auto event = history.end() - static_cast<std::ptrdiff_t>(fresh); event != history.end(); ++event) {
        const std::uint64_t node = idOf(event->parent);
        const int kind = static_cast<int>(event->kind);
        if (event->type == planet::PagingType::PageIn) {
            waiting_.erase({event->parent, event->kind});
            started_.erase({event->parent, event->kind});
        }
        switch (event->outcome) {
            case planet::PagingOutcome::Loaded:
                lod_trace_arrived(trace, node, kind);
                break;
            case planet::PagingOutcome::Failed:
                lod_trace_failed(trace, node, kind, "the block cannot be read");
                break;
            case planet::PagingOutcome::Evicted:
                lod_trace_evicted(trace, node, kind);
                break;
            case planet::PagingOutcome::Cancelled:
                if (event->type == planet::PagingType::PageIn) lod_trace_cancelled(trace, node, kind);
                break;
        }
    }
    for (const planet::BlockId& block : moves.requested) {
        lod_trace_requested(trace, idOf(block.parent), static_cast<int>(block.kind), NAN);
        waiting_.insert(block);
    }
    // A loader may take a block within the step that requests it; moves tell that only in the next one.
    std::unordered_set<planet::BlockId> queued;
    for (const planet::PagingRequest& request : planet.inspect().pendingRequests(planet::PagingType::PageIn))
        queued.insert(request.block());
    const std::unordered_set<planet::BlockId> before = waiting_;
    for (const planet::BlockId& block : before)
        if (!queued.contains(block)) tellStarted(block);
}

// Tells it once.
void PlanetTrace::tellStarted(const planet::BlockId& block) {
    waiting_.erase(block);
    if (!started_.insert(block).second) return;
    lod_trace_started(trace_.get(), idOf(block.parent), static_cast<int>(block.kind));
}

void PlanetTrace::addFrame(planet::Planet& planet, const TracedTimes& times) {
    const std::size_t views = std::min<std::size_t>(planet.views().size(), LOD_TRACE_MAX_VIEWS);
    for (std::size_t view = 0; view < views; ++view) {
        tellSettings(planet.views()[view].input.lod, view);
        tellNodes(planet, view);
    }
    lod_trace_frame_begin(trace_.get(), times.timeS);
    tellPaging(planet);
    for (std::size_t view = 0; view < views; ++view) tellView(planet, view);
    lod_trace_frame_end(trace_.get(), times.cpuMs, times.gpuMs);
}

Result<void> PlanetTrace::finish(planet::Planet& planet) {
    planet.tools().keepMoves(false);
    lod_trace_flush(trace_.get(), 10'000);
    const lod_trace_stats stats = lod_trace_get_stats(trace_.get());
    const char* const problem = lod_trace_error(trace_.get());
    const std::string text = problem ? problem : "";
    trace_.reset();
    if (!text.empty()) return planet::ioError(fmt::format("{}: {}", file_.string(), text));
    if (stats.dropped > 0)
        return planet::ioError(
            fmt::format("{}: {} events are missing, because they came faster than they could be "
                        "written",
                        file_.string(), stats.dropped));
    return {};
}

}  // namespace worldy
