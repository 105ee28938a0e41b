#include "planet/planet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "planet/planet_state.h"

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;

Result<void> checkSettings(const PagingSettings& settings) {
    if (settings.loaderThreads < 1 || settings.loaderThreads > maxLoaderThreads) {
        return badInput(fmt::format("loader threads: {} is out of range; expected [1, {}]",
                                    settings.loaderThreads, maxLoaderThreads));
    }
    if (!(settings.uploadLimitMs >= 0)) {
        return badInput(
            fmt::format("upload limit: {} ms is negative; expected 0 ms or more", settings.uploadLimitMs));
    }
    if (!(settings.colourShare >= 0.01 && settings.colourShare <= 0.9)) {
        return badInput(
            fmt::format("colour share: {} is out of range; expected [0.01, 0.9]", settings.colourShare));
    }
    if (!(settings.normalShare >= 0.01 && settings.normalShare <= 0.9)) {
        return badInput(
            fmt::format("normal share: {} is out of range; expected [0.01, 0.9]", settings.normalShare));
    }
    if (settings.retry.retries < 0 || settings.retry.retries > 10)
        return badInput(fmt::format("retries: {} is out of range; expected [0, 10]", settings.retry.retries));
    if (!(settings.retry.delayS >= 0 && settings.retry.delayS <= 60)) {
        return badInput(
            fmt::format("retry delay: {} s is out of range; expected [0, 60] s", settings.retry.delayS));
    }
    return checkBadDisk(settings.badDisk);
}

void applyTo(Pager& pager, const PagingSettings& settings) {
    pager.setBadDisk(settings.badDisk);
    pager.setPaused(settings.paused);
    pager.setThreads(settings.loaderThreads);
}

// Slots for chunks and for tiles.
struct Room {
    std::uint32_t slots = 0;
    std::uint32_t colours = 0;  // 0 without any
    std::uint32_t normals = 0;  // 0 without any
    std::size_t normalHeightBytes = 0;
    std::string problem;  // why there are no normals
};
// Where there is too little for chunks or colours that is an Error; without normals the rest goes on.
Result<Room> roomFor(const PlanetShape& shape, const std::optional<ColourPyramid>& colour,
                     const PagingSettings& settings) {
    const bool hasNormals = settings.normals && normalLeafLevel(shape) >= 0;
    const BudgetShares shares = sharesOf(settings, colour.has_value(), hasNormals);
    Room room;
    std::size_t chunkBytes = shares.chunks;
    if (hasNormals) {
        const TilePyramid pyramid{"normal tiles", normalLeafLevel(shape), normalTileBytes};
        const Result<std::uint32_t> normals = tilesFor(pyramid, shares.normals, settings.maxNormalTiles);
        if (normals && slotsFor(shape, chunkBytes)) {
            room.normals = *normals;
            room.normalHeightBytes = shares.normalHeights;
        } else {
            room.problem = (normals ? "budget too small for chunks and normals" : normals.error().message) +
                           "; using mesh normals";
            chunkBytes = sharesOf(settings, colour.has_value(), false).chunks;
        }
    }
    const Result<std::uint32_t> slots = slotsFor(shape, chunkBytes);
    if (!slots) return tl::unexpected(slots.error());
    room.slots = *slots;
    if (!colour) return room;
    const Result<std::uint32_t> tiles =
        tilesFor({"colour tiles", colour->leafLevel, colourTileBytes(colour->format)}, shares.colours,
                 settings.maxColourTiles);
    if (!tiles) return tl::unexpected(tiles.error());
    room.colours = *tiles;
    return room;
}

}  // namespace

Result<std::unique_ptr<Planet>> Planet::open(PlanetSource source, const PagingSettings& settings) {
    if (auto checked = checkSettings(settings); !checked) return tl::unexpected(std::move(checked.error()));
    const Result<Room> room = roomFor(source.shape, source.colour, settings);
    if (!room) return tl::unexpected(room.error());
    auto tree = makeChunkTree(source.shape, source.minStep, source.maxStep, std::move(source.roots));
    if (!tree) return tl::unexpected(namingFile(source.file.get(), std::move(tree.error())));
    auto state = std::make_unique<PlanetState>();
    state->settings = settings;
    state->file = std::move(source.file);
    state->tree = std::move(*tree);
    state->slotCapacity = room->slots;
    state->freeSlots = freeSlotsFrom(faceCount, room->slots);
    state->problems = std::move(source.problems);
    if (source.colour) {
        state->colours.leafLevel = source.colour->leafLevel;
        state->colours.checkers = source.colour->format;
        state->colours.roots = std::move(source.colourRoots);
        state->colours.begin(room->colours, 0);
        state->colour = std::move(source.colour);
    }
    state->normals.kind = BlockKind::Normals;
    state->normals.leafLevel = planet::normalLeafLevel(source.shape);
    if (state->normals.leafLevel >= 0) {
        std::array<HeldChunk, faceCount> roots;
        for (std::size_t face = 0; face < faceCount; ++face) {
            const ChunkNode& root = state->tree.nodes[face];
            roots[face] = {root.id, root.heights, root.children};
        }
        state->deriver = std::make_unique<NormalDeriver>(source.shape, roots, source.loadChildren);
        for (const Face face : allFaces) state->normals.roots[static_cast<std::size_t>(face)].id.face = face;
    }
    state->beginNormals(room->normals, room->normalHeightBytes, room->problem);
    BlockLoaders loaders{std::move(source.loadChildren), std::move(source.loadColours)};
    loaders.normals = [deriver = state->deriver.get()](const ChunkId& parent) {
        return deriver->childrenOf(parent);
    };
    state->pager = std::make_unique<Pager>(std::move(loaders), settings.loaderThreads);
    state->pager->setTime(settings.time);  // there is nothing to give up
    applyTo(*state->pager, settings);
    state->count();
    return std::unique_ptr<Planet>(new Planet(std::move(state)));
}

Planet::Planet(std::unique_ptr<PlanetState> state) : state_(std::move(state)) {}
Planet::~Planet() = default;

void Planet::step(const View& lodView, const LodSettings& settings, const UploadChunk& upload) {
    const ViewInput only{lodView, settings};
    step(std::span(&only, 1), upload);
}

void Planet::step(std::span<const ViewInput> views, const UploadChunk& upload) {
    const double elapsedS = state_->clockS();
    state_->step(views, upload, elapsedS, elapsedS);
}

void Planet::step(std::span<const ViewInput> views, const UploadChunk& upload, double elapsedS) {
    state_->lastStep = PlanetState::Clock::now();
    state_->step(views, upload, elapsedS, elapsedS);
}

// Seconds since this was asked last.
double PlanetState::clockS() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(lastStep, now)).count();
}

void PlanetState::step(std::span<const ViewInput> inputs, const UploadChunk& upload, double elapsedS,
                       double fadeElapsedS) {
    assert(!inputs.empty() && inputs.size() <= maxViews && std::isfinite(elapsedS) && elapsedS >= 0);
    ++frame;
    changed = false;
    nowS += elapsedS;
    sinceAnewS += elapsedS;
    lastElapsedS = elapsedS;
    views.resize(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) views[i].input = inputs[i];

    Clock::time_point start = Clock::now();
    if (settings.time != PagingTime::Clock) pager->advance(elapsedS);
    followNormalRoots();
    dropYielding();
    uploadFinished(upload);
    times.uploadMs = msSince(start);

    start = Clock::now();
    select(fadeElapsedS);
    times.selectMs = msSince(start);

    start = Clock::now();
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        markUsed(queue);
        request(queue);
    });
    chooseYielding();
    count();
    times.pagingMs = msSince(start);
}

bool Planet::settle(const View& lodView, const LodSettings& settings, const UploadChunk& upload,
                    double timeoutS) {
    const ViewInput only{lodView, settings};
    return settle(std::span(&only, 1), upload, timeoutS);
}

bool Planet::settle(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS) {
    const auto timeout = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeoutS));
    const Clock::time_point deadline = Clock::now() + timeout;
    if (state_->settings.time == PagingTime::Simulated) return settleSimulated(views, upload, timeoutS);
    while (true) {
        state_->step(views, upload, state_->clockS(), std::numeric_limits<double>::infinity());
        if (settled()) return true;
        if (Clock::now() >= deadline || state_->settings.time == PagingTime::Recorded) return false;
        if (state_->normalsArePending()) {
            state_->normalRootComing.wait_until(deadline);
            continue;
        }
        const PagerStatus status = state_->pager->status();
        const std::optional<double> untilRetryS = state_->untilRetryS();
        if (status.held && status.atRest() && (status.queued > 0 || untilRetryS)) return false;  // paused
        const Clock::time_point until =
            untilRetryS ? std::min(deadline, Clock::now() + std::chrono::ceil<Clock::duration>(
                                                                std::chrono::duration<double>(*untilRetryS)))
                        : deadline;
        if (status.idle() && untilRetryS)
            std::this_thread::sleep_until(until);
        else
            state_->pager->waitForFinished(until);
    }
}

bool Planet::settleSimulated(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS) {
    // Where no read is under way there may still be blocks that yield; where reads take no time, time goes
    // on.
    constexpr double idleStepS = 1.0 / 60, leastStepS = 1e-3;
    double leftS = timeoutS;
    double stepS = 0;
    while (true) {
        state_->lastStep = PlanetState::Clock::now();
        state_->step(views, upload, stepS, std::numeric_limits<double>::infinity());
        if (settled()) return true;
        const PagerStatus status = state_->pager->status();
        const std::optional<double> untilEndS = state_->pager->untilNextEnd();
        const std::optional<double> untilRetryS = state_->untilRetryS();
        const bool paused = status.held && status.atRest() && (status.queued > 0 || untilRetryS);
        if (paused || leftS <= 0) return false;
        const double untilNextS = std::min(untilEndS.value_or(untilRetryS.value_or(idleStepS)),
                                           untilRetryS.value_or(untilEndS.value_or(idleStepS)));
        // The last step goes to the end of the time, so that settling on goes on from there.
        stepS = std::min(std::max(untilNextS, leastStepS), leftS);
        leftS -= stepS;
    }
}

// What the budget has no room for can still come while a block is resident that no view uses, or that yields
// to it, for that block will be dropped.
bool Planet::settled() const {
    const PlanetState& state = *state_;
    const bool roomToCome = state.hasBlocksOutOfUse() || !state.yielding.empty();
    return state.frame > 0 && !state.changed && state.pager->status().idle() &&
           (state.paging.budgetWaits == 0 || !roomToCome) && !state.colours.roomToCome &&
           !state.normals.roomToCome && !state.normalsArePending() && !state.untilRetryS();
}

Result<bool> Planet::setPaging(const PagingSettings& settings) {
    PlanetState& state = *state_;
    if (settings == state.settings) return false;
    if (auto checked = checkSettings(settings); !checked) return tl::unexpected(std::move(checked.error()));
    const Result<Room> room = roomFor(state.tree.storedShape, state.colour, settings);
    if (!room) return tl::unexpected(room.error());
    const bool otherTime = settings.time != state.settings.time;
    state.settings = settings;
    state.changed = true;
    // First what holds for the reads that the other time begins with.
    applyTo(*state.pager, settings);
    if (otherTime) state.putBack(state.pager->setTime(settings.time));
    const bool resized = room->slots != state.slotCapacity;
    if (resized) state.resize(room->slots);
    if (room->colours != state.colours.tileCapacity) state.resizeTiles(state.colours, room->colours);
    if (room->normals != state.normalCapacity || room->problem != state.normalProblem)
        state.beginNormals(room->normals, room->normalHeightBytes, room->problem);
    else if (otherTime && state.normalsArePending())
        state.finishNormalRoots();
    state.count();
    return resized;
}

void Planet::loadOne() {
    state_->pager->loadOne();
}

void Planet::dropAll() {
    state_->changed = true;
    state_->dropEverything();
    state_->count();
}

void Planet::startAnew() {
    state_->lastStep = PlanetState::Clock::now();
    state_->startAnew();
    state_->count();
}

void Planet::forgetSelections() {
    for (PlanetView& view : state_->views) view.selection = {};
    state_->changed = true;
}

void Planet::keepMoves(bool kept) {
    if (kept && state_->normalsArePending()) {
        state_->finishNormalRoots();
        state_->count();
    }
    state_->keepsMoves = kept;
    state_->moves = {};
}

PagingMoves Planet::takeMoves() {
    return std::exchange(state_->moves, {});
}

bool Planet::follow(const PagingMoves& moves) {
    assert(state_->settings.time == PagingTime::Recorded);
    Pager& pager = *state_->pager;
    if (moves.gaveUp) state_->putBack(pager.giveUp());
    bool whole = true;
    for (const BlockId& block : moves.taken) whole &= pager.take(block);
    for (const PagingMoves::Arrival& arrival : moves.arrived) {
        std::optional<ErrorKind> failure;
        if (arrival.outcome == PagingOutcome::Failed)
            failure = arrival.badData ? ErrorKind::BadInput : ErrorKind::Io;
        whole &= pager.finish(arrival.block, failure, arrival.outcome != PagingOutcome::Cancelled);
    }
    return whole;
}

void Planet::setExaggeration(double factor) {
    assert(factor > 0);
    ChunkTree& tree = state_->tree;
    const double possible = std::min(factor, largestExaggeration(tree));
    if (possible == tree.exaggeration) return;
    planet::setExaggeration(tree, possible);
    state_->changed = true;
}

void Planet::uploadAll(const UploadChunk& upload) const {
    forEachNode(state_->tree, [&](NodeIndex, const ChunkNode& node) { upload(node.slot, *node.heights); });
}

std::vector<std::string> Planet::takeProblems() {
    return std::exchange(state_->problems, {});
}

std::vector<PagingRequest> Planet::pendingRequests(PagingType type) const {
    return state_->pager->readQueue([&](const PagingQueue& queue) { return queue.sorted(type); });
}

std::vector<PagingRequest> Planet::pendingRequests(PagingType type, std::size_t view) const {
    assert(view < viewCount());
    std::vector<PagingRequest> pending = pendingRequests(type);
    std::erase_if(pending, [&](const PagingRequest& request) { return request.viewPriority[view] == 0; });
    std::stable_sort(pending.begin(), pending.end(), [&](const PagingRequest& a, const PagingRequest& b) {
        return a.viewPriority[view] > b.viewPriority[view];
    });
    return pending;
}

std::vector<LoadInProgress> Planet::loadingNow() const {
    return state_->pager->loadingNow();
}
const ChunkFile& Planet::file() const {
    assert(state_->file);
    return *state_->file;
}
const PlanetShape& Planet::shape() const {
    return state_->tree.shape;
}
const ChunkTree& Planet::tree() const {
    return state_->tree;
}
const Selection& Planet::selection(std::size_t view) const {
    assert(view < viewCount());
    return state_->views[view].selection;
}
std::size_t Planet::viewCount() const {
    return state_->views.size();
}
const LodSettings& Planet::lodSettings(std::size_t view) const {
    assert(view < viewCount());
    return state_->views[view].input.lod;
}
const View& Planet::lodView(std::size_t view) const {
    assert(view < viewCount());
    return state_->views[view].input.lodView;
}
const PagingSettings& Planet::pagingSettings() const {
    return state_->settings;
}
const PagingCounters& Planet::paging() const {
    return state_->paging;
}
std::uint64_t Planet::bytesRead() const {
    return paging().bytesRead + colourPaging().bytesRead + normalPaging().bytesRead;
}
const std::deque<PagingEvent>& Planet::pagingHistory() const {
    return state_->history;
}
const StageTimes& Planet::times() const {
    return state_->times;
}
std::uint32_t Planet::slotCapacity() const {
    return state_->slotCapacity;
}
double Planet::elapsedS() const {
    return state_->lastElapsedS;
}
double Planet::seconds() const {
    return state_->nowS;
}

const std::optional<ColourPyramid>& Planet::colour() const {
    return state_->colour;
}
const TileTree& Planet::colourTree() const {
    return state_->colours.tree;
}
const TileSelection& Planet::colourSelection(std::size_t view) const {
    assert(view < viewCount());
    return state_->views[view].colours;
}
const TilePagingCounters& Planet::colourPaging() const {
    return state_->colours.counters;
}
std::vector<TileChange> Planet::takeColourChanges() {
    return std::exchange(state_->colours.changes, {});
}
void Planet::beginColoursAnew() {
    if (state_->colour) state_->resizeTiles(state_->colours, state_->colours.tileCapacity);
}

int Planet::normalLeafLevel() const {
    return state_->normals.leafLevel;
}
const TileTree& Planet::normalTree() const {
    return state_->normals.tree;
}
const TileSelection& Planet::normalSelection(std::size_t view) const {
    assert(view < viewCount());
    return state_->views[view].normals;
}
bool Planet::normalsArePending() const {
    return state_->normalsArePending();
}
const TilePagingCounters& Planet::normalPaging() const {
    return state_->normals.counters;
}
std::vector<TileChange> Planet::takeNormalChanges() {
    return std::exchange(state_->normals.changes, {});
}
void Planet::beginNormalsAnew() {
    state_->resizeTiles(state_->normals, state_->normals.tileCapacity);
}

}  // namespace planet
