#include "planet/planet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "planet/planet_state.h"

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;

Result<void> checkSettings(const PagingSettings& settings) {
    if (settings.loaderThreads < 1 || settings.loaderThreads > maxLoaderThreads) {
        return badInput(
            fmt::format("{} loader threads; 1 to {} will do", settings.loaderThreads, maxLoaderThreads));
    }
    if (!(settings.uploadLimitMs >= 0)) {
        return badInput(fmt::format("an upload limit of {} ms; 0 or more will do", settings.uploadLimitMs));
    }
    if (!(settings.colourShare >= 0.01 && settings.colourShare <= 0.9)) {
        return badInput(fmt::format("a share of {} for colours; 0.01 to 0.9 will do", settings.colourShare));
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
    std::uint32_t tiles = 0;  // 0 without colours
};
Result<Room> roomFor(const PlanetShape& shape, const std::optional<ColourPyramid>& colour,
                     const PagingSettings& settings) {
    const std::size_t chunkBytes = chunkBudgetBytes(settings, colour.has_value());
    const Result<std::uint32_t> slots = slotsFor(shape, chunkBytes);
    if (!slots) return tl::unexpected(slots.error());
    if (!colour) return Room{*slots};
    const Result<std::uint32_t> tiles =
        tilesFor(*colour, settings.budgetBytes - chunkBytes, settings.maxColourTiles);
    if (!tiles) return tl::unexpected(tiles.error());
    return Room{*slots, *tiles};
}

}  // namespace

Result<std::unique_ptr<Planet>> Planet::open(PlanetSource source, const PagingSettings& settings) {
    if (auto checked = checkSettings(settings); !checked) return tl::unexpected(std::move(checked.error()));
    const Result<Room> room = roomFor(source.shape, source.colour, settings);
    if (!room) return tl::unexpected(room.error());
    auto tree = makeChunkTree(source.shape, source.minStep, source.maxStep, std::move(source.roots));
    if (!tree) return tl::unexpected(std::move(tree.error()));
    auto state = std::make_unique<State>();
    state->settings = settings;
    state->file = std::move(source.file);
    state->tree = std::move(*tree);
    state->slotCapacity = room->slots;
    state->freeSlots = freeSlotsFrom(faceCount, room->slots);
    if (source.colour) {
        state->colours.tree.leafLevel = source.colour->leafLevel;
        state->colours.format = source.colour->format;
        state->colours.roots = std::move(source.colourRoots);
        state->colours.begin(room->tiles);
        state->colour = std::move(source.colour);
        state->problems = std::move(source.problems);
    }
    state->pager = std::make_unique<Pager>(
        BlockLoaders{std::move(source.loadChildren), std::move(source.loadColours)}, settings.loaderThreads);
    state->pager->setTime(settings.time);  // there is nothing to give up
    applyTo(*state->pager, settings);
    state->count();
    return std::unique_ptr<Planet>(new Planet(std::move(state)));
}

Planet::Planet(std::unique_ptr<State> state) : state_(std::move(state)) {}
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
    state_->lastStep = State::Clock::now();
    state_->step(views, upload, elapsedS, elapsedS);
}

// Seconds since this was asked last.
double Planet::State::clockS() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(lastStep, now)).count();
}

void Planet::State::step(std::span<const ViewInput> inputs, const UploadChunk& upload, double elapsedS,
                         double fadeElapsedS) {
    assert(!inputs.empty() && inputs.size() <= maxViews && std::isfinite(elapsedS) && elapsedS >= 0);
    ++frame;
    changed = false;
    nowS += elapsedS;
    lastElapsedS = elapsedS;
    views.resize(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) views[i].input = inputs[i];

    Clock::time_point start = Clock::now();
    if (settings.time != PagingTime::Clock) pager->advance(elapsedS);
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
        const PagerStatus status = state_->pager->status();
        if (status.queued > 0 && status.atRest()) return false;  // paused
        state_->pager->waitForFinished(deadline);
    }
}

bool Planet::settleSimulated(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS) {
    // Where no read is under way there may still be blocks that yield; where reads take no time, time goes
    // on.
    constexpr double idleStepS = 1.0 / 60, leastStepS = 1e-3;
    double leftS = timeoutS;
    double stepS = 0;
    while (true) {
        state_->lastStep = State::Clock::now();
        state_->step(views, upload, stepS, std::numeric_limits<double>::infinity());
        if (settled()) return true;
        const PagerStatus status = state_->pager->status();
        if ((status.queued > 0 && status.atRest()) || leftS <= 0) return false;  // paused, or too late
        // The last step goes to the end of the time, so that settling on goes on from there.
        stepS = std::min(std::max(state_->pager->untilNextEnd().value_or(idleStepS), leastStepS), leftS);
        leftS -= stepS;
    }
}

// What the budget has no room for can still come while a block is resident that no view uses, or that yields
// to it, for that block will be dropped.
bool Planet::settled() const {
    const State& state = *state_;
    const bool roomToCome = state.hasBlocksOutOfUse() || !state.yielding.empty();
    return state.frame > 0 && !state.changed && state.pager->status().idle() &&
           (state.paging.budgetWaits == 0 || !roomToCome) && !state.colours.roomToCome;
}

Result<bool> Planet::setPaging(const PagingSettings& settings) {
    State& state = *state_;
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
    if (room->tiles != state.colours.tileCapacity) state.resizeColours(room->tiles);
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
    state_->lastStep = State::Clock::now();
    state_->startAnew();
    state_->count();
}

void Planet::keepMoves(bool kept) {
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
        whole &= pager.finish(arrival.block, arrival.outcome == PagingOutcome::Failed,
                              arrival.outcome != PagingOutcome::Cancelled);
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

void Planet::retryFailed() {
    state_->changed = true;
    for (ChunkNode& node : state_->tree.nodes) {
        if (node.childrenState == ChildrenState::Failed) node.childrenState = ChildrenState::Absent;
    }
    state_->colours.retryFailed();
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
const ColourTree& Planet::colourTree() const {
    return state_->colours.tree;
}
const ColourSelection& Planet::colourSelection(std::size_t view) const {
    assert(view < viewCount());
    return state_->views[view].colours;
}
const ColourPagingCounters& Planet::colourPaging() const {
    return state_->colours.counters;
}
std::vector<ColourChange> Planet::takeColourChanges() {
    return std::exchange(state_->colours.changes, {});
}
void Planet::beginColoursAnew() {
    if (state_->colour) state_->resizeColours(state_->colours.tileCapacity);
}

}  // namespace planet
