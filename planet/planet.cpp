#include "planet/planet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "planet/base/check_range.h"
#include "planet/base/try.h"
#include "planet/planet_state.h"
#include "planet/planet_tools.h"
#include "planet/spans/span_recorder.h"

namespace planet {

namespace {

using Clock = PlanetState::Clock;

Result<void> checkSettings(const PagingSettings& settings) {
    TRY(checkRange("loader threads", settings.loaderThreads, 1, maxLoaderThreads));
    if (!(settings.uploadLimitMs >= 0)) {
        return badInput(
            fmt::format("upload limit: {} ms is negative; expected 0 ms or more", settings.uploadLimitMs));
    }
    TRY(checkRange("colour share", settings.colourShare, 0.01, 0.9));
    TRY(checkRange("normal share", settings.normalShare, 0.01, 0.9));
    TRY(checkRange("prefetch horizon", settings.prefetch.horizonS, 0.1, 60.0, "s"));
    TRY(checkRange("prefetch share", settings.prefetch.share, 0.01, 1.0));
    TRY(checkRange("retries", settings.retry.retries, 0, 10));
    TRY(checkRange("retry delay", settings.retry.delayS, 0.0, 60.0, "s"));
    return checkBadDisk(settings.badDisk);
}

void applyTo(Pager& pager, const PagingSettings& settings) {
    pager.setBadDisk(settings.badDisk);
    pager.setPaused(settings.paused);
    pager.setThreads(settings.loaderThreads);
    pager.setPrefetchShare(settings.prefetch.share);
}

// The slots for chunks and tiles.
struct Room {
    std::uint32_t slots = 0;
    std::uint32_t colours = 0;  // 0: no colours
    bool coloursUnpacked = false;
    std::uint32_t normals = 0;  // 0: no normals
    std::size_t normalHeightBytes = 0;
    std::string problem;  // the reason if there are no normals
};
// Divides the budget. Too little memory for chunks or colours is an Error; too little for normals turns them
// off.
Result<Room> roomFor(const PlanetShape& shape, std::uint64_t allChunks,
                     const std::optional<ColourPyramid>& colour, const PagingSettings& settings) {
    const bool hasNormals = settings.normals && normalLeafLevel(shape) >= 0;
    const BudgetShares shares = sharesOf(settings, colour.has_value(), hasNormals);
    Room room;
    std::size_t chunkBytes = shares.chunks;
    if (hasNormals) {
        const TilePyramid pyramid{"normal tiles", normalLeafLevel(shape), normalTileBytes};
        const Result<std::uint32_t> normals = tileSlotsFor(pyramid, shares.normals, settings.maxNormalTiles);
        if (normals && chunkSlotsFor(shape, allChunks, chunkBytes)) {
            room.normals = *normals;
            room.normalHeightBytes = shares.normalHeights;
        } else {
            room.problem = (normals ? "budget too small for chunks and normals" : normals.error().message) +
                           "; using mesh normals";
            chunkBytes = sharesOf(settings, colour.has_value(), false).chunks;
        }
    }
    TRY_ASSIGN(const auto slots, chunkSlotsFor(shape, allChunks, chunkBytes));
    room.slots = slots;
    if (!colour) return room;
    const auto coloursFor = [&](ColourFormat held, std::size_t bytes) {
        return tileSlotsFor({"colour tiles", colour->leafLevel, colourTileBytes(held)}, bytes,
                            settings.maxColourTiles);
    };
    TRY_ASSIGN(const auto packed, coloursFor(colour->format, shares.colours));
    room.colours = packed;
    if (!settings.unpackedColours || colour->format == ColourFormat::Lossless) return room;
    constexpr std::uint32_t screenful = 200;  // of 1920 x 1080, at two levels
    const Result<std::uint32_t> unpacked = coloursFor(ColourFormat::Lossless, shares.colours);
    if (!unpacked || *unpacked < std::min(packed, screenful)) return room;
    room.colours = *unpacked;
    room.coloursUnpacked = true;
    return room;
}

// Returns a function that reads children and checks their heights too: on the loader's thread, where they are still in its
// cache.
LoadChildren checkingHeights(LoadChildren load, const PlanetShape& shape,
                             std::shared_ptr<const ChunkFile> file) {
    return
        [load = std::move(load), shape, file = std::move(file)](
            const ChunkId& parent, BlockLocation location, StepsView parentHeights) -> Result<SiblingBlock> {
            TRY_ASSIGN(auto children, load(parent, location, parentHeights));
            for (const ChunkData& child : children) {
                TRY(checkHeights(shape, child).map_error([&](Error error) {
                    return namingFile(file.get(), std::move(error));
                }));
            }
            return children;
        };
}

}  // namespace

PlanetState::PlanetState(ChunkTree&& tree, std::uint32_t chunkSlots,
                         std::shared_ptr<const ChunkFile> chunkFile, std::unique_ptr<NormalDeriver> deriver)
    : file(std::move(chunkFile)),
      heights(std::move(tree), chunkSlots, file),
      normalRoots(std::move(deriver)) {}

Result<std::unique_ptr<Planet>> Planet::open(PlanetSource source, const PagingSettings& settings) {
    TRY(checkSettings(settings));
    const std::uint64_t allChunks = source.chunks > 0 ? source.chunks : chunkCountOf(source.shape);
    TRY_ASSIGN(const auto room, roomFor(source.shape, allChunks, source.colour, settings));
    TRY_ASSIGN(auto tree,
               makeChunkTree(source.shape, source.minStep, source.maxStep, std::move(source.roots))
                   .map_error([&](Error error) { return namingFile(source.file.get(), std::move(error)); }));
    tree.allChunks = allChunks;
    const int normalLevel = normalLeafLevel(source.shape);
    std::unique_ptr<NormalDeriver> deriver;
    if (normalLevel >= 0) {
        std::array<HeldChunk, faceCount> roots;
        for (std::size_t face = 0; face < faceCount; ++face) {
            const ChunkNode& root = tree.nodes[face];
            roots[face] = {root.id, root.heights, root.children};
        }
        deriver = std::make_unique<NormalDeriver>(source.shape, roots, source.loadChildren);
    }
    auto state = std::make_unique<PlanetState>(std::move(tree), room.slots, std::move(source.file),
                                               std::move(deriver));
    state->settings = settings;
    state->run.retry = settings.retry;
    state->run.log.problems = std::move(source.problems);
    if (source.colour) {
        state->colours.leafLevel = source.colour->leafLevel;
        state->colours.checkers = source.colour->format;
        state->colours.roots = std::move(source.colourRoots);
        state->colours.unpacked = room.coloursUnpacked;
        state->colours.begin(room.colours, 0);
        state->colour = std::move(source.colour);
    }
    state->normals.leafLevel = normalLevel;
    for (const Face face : allFaces) state->normals.roots[static_cast<std::size_t>(face)].id.face = face;
    state->beginNormals(room.normals, room.normalHeightBytes, room.problem);
    BlockLoaders loaders{checkingHeights(std::move(source.loadChildren), source.shape, state->file),
                         std::move(source.loadColours)};
    loaders.normals = [of = state->normalRoots.deriver()](const ChunkId& parent) {
        return of->childrenOf(parent);
    };
    state->pager = std::make_unique<Pager>(std::move(loaders), settings.loaderThreads);
    state->pager->setTime(settings.time);  // no reads to abandon yet
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

void Planet::step(std::span<const ViewInput> views, const UploadChunk& upload,
                  std::optional<double> elapsedS) {
    const double clockS = state_->clockS();
    state_->step(views, upload, elapsedS.value_or(clockS), elapsedS.value_or(clockS));
}

// Returns the seconds since its last call.
double PlanetState::clockS() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(lastStepAt, now)).count();
}

void PlanetState::step(std::span<const ViewInput> inputs, const UploadChunk& upload, double elapsedS,
                       double fadeElapsedS) {
    assert(!inputs.empty() && inputs.size() <= maxViews && std::isfinite(elapsedS) && elapsedS >= 0);
    ++run.frame;
    changed = false;
    run.nowS += elapsedS;
    run.sinceResetS += elapsedS;
    lastStep.nowS = run.nowS;
    lastStep.elapsedS = elapsedS;
    views.resize(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) views[i].input = inputs[i];
    followCourses(elapsedS);

    {
        const SpanScope span("upload");
        const Stopwatch stage;
        if (settings.time != PagingTime::Clock) pager->advance(elapsedS);
        if (normalRoots.follow(normals, run)) selectAgain();
        dropYielding();
        uploadFinished(upload);
        measureBacklog(elapsedS);
        lastStep.times.uploadMs = stage.elapsedMs();
    }
    {
        const SpanScope span("select");
        const Stopwatch stage;
        select(fadeElapsedS);
        lastStep.times.selectMs = stage.elapsedMs();
    }
    {
        const SpanScope span("paging");
        const Stopwatch stage;
        page();
        count();
        lastStep.times.pagingMs = stage.elapsedMs();
    }
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
            state_->normalRoots.waitUntil(deadline);
            continue;
        }
        const PagerStatus status = state_->pager->status();
        const std::optional<double> untilRetryS = state_->untilRetryS();
        if (status.held && status.atRest() && (status.queued > 0 || untilRetryS)) return false;  // paused
        const Clock::time_point until =
            untilRetryS ? std::min(deadline, Clock::now() + std::chrono::ceil<Clock::duration>(
                                                                std::chrono::duration<double>(*untilRetryS)))
                        : deadline;
        // Each step makes a new selection over all resident chunks. Half of what was requested keeps the loaders busy
        // during that time.
        const std::size_t half = (status.queued + status.loading) / 2;
        if (status.idle() && untilRetryS)
            std::this_thread::sleep_until(until);
        else
            state_->pager->waitForFinished(until, std::max<std::size_t>(half, 1));
    }
}

bool Planet::settleSimulated(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS) {
    // Time must advance even if no read is in progress, because blocks may still yield, and even if reads
    // take no time.
    constexpr double idleStepS = 1.0 / 60, leastStepS = 1e-3;
    double leftS = timeoutS;
    double stepS = 0;
    while (true) {
        state_->lastStepAt = PlanetState::Clock::now();
        state_->step(views, upload, stepS, std::numeric_limits<double>::infinity());
        if (settled()) return true;
        const PagerStatus status = state_->pager->status();
        const std::optional<double> untilEndS = state_->pager->untilNextEnd();
        const std::optional<double> untilRetryS = state_->untilRetryS();
        const bool paused = status.held && status.atRest() && (status.queued > 0 || untilRetryS);
        if (paused || leftS <= 0) return false;
        const double untilNextS = std::min(untilEndS.value_or(untilRetryS.value_or(idleStepS)),
                                           untilRetryS.value_or(untilEndS.value_or(idleStepS)));
        // The last step ends exactly at the timeout, so that another settle() continues from there.
        stepS = std::min(std::max(untilNextS, leastStepS), leftS);
        leftS -= stepS;
    }
}

// Returns whether nothing that a view wants is pending. A block that waits for room can still arrive if another is about
// to be dropped.
bool PlanetState::isSettled() const {
    const auto all = kinds();
    const bool roomIsComing =
        std::any_of(all.begin(), all.end(), [](const BlockPaging* kind) { return kind->roomIsComing(); });
    std::size_t unwanted = 0;
    for (const BlockPaging* kind : all) unwanted += kind->pendingPrefetches();
    const PagerStatus status = pager->status();
    const bool isIdle = status.queued + status.loading + status.finished <= unwanted;
    return run.frame > 0 && !changed && isIdle && !roomIsComing && !normalsArePending() && !untilRetryS();
}

bool Planet::settled() const {
    return state_->isSettled();
}

Result<bool> Planet::setPaging(const PagingSettings& settings) {
    PlanetState& state = *state_;
    if (settings == state.settings) return false;
    TRY(checkSettings(settings));
    const ChunkTree& tree = state.heights.tree;
    TRY_ASSIGN(const auto room, roomFor(tree.storedShape, tree.allChunks, state.colour, settings));
    const bool otherTime = settings.time != state.settings.time;
    state.settings = settings;
    state.run.retry = settings.retry;
    state.changed = true;
    // Applies the settings first, so that they hold for the first reads in the new time.
    applyTo(*state.pager, settings);
    if (otherTime) state.requeue(state.pager->setTime(settings.time));
    const bool resized = room.slots != state.heights.capacity();
    if (resized) state.resizeHeights(room.slots);
    const bool repacked = std::exchange(state.colours.unpacked, room.coloursUnpacked) != room.coloursUnpacked;
    if (room.colours != state.colours.capacity() || repacked) state.resizeTiles(state.colours, room.colours);
    if (room.normals != state.normalRoots.capacity() || room.problem != state.normalRoots.problem())
        state.beginNormals(room.normals, room.normalHeightBytes, room.problem);
    else if (otherTime && state.normalsArePending())
        state.finishNormalRoots();
    state.count();
    return resized;
}

void Planet::setExaggeration(double factor) {
    assert(factor > 0);
    ChunkTree& tree = state_->heights.tree;
    const double possible = std::min(factor, largestExaggeration(tree));
    if (possible == tree.exaggeration) return;
    planet::setExaggeration(tree, possible);
    state_->changed = true;
}

Result<void> Planet::setRegions(std::vector<Region> regions) {
    ChunkTree& tree = state_->heights.tree;
    if (tree.regions ? tree.regions->regions() == regions : regions.empty()) return {};
    std::shared_ptr<const RegionSet> set;
    if (!regions.empty()) {
        TRY_ASSIGN(set, RegionSet::make(std::move(regions), tree.storedShape));
    }
    planet::setRegions(tree, std::move(set));
    state_->changed = true;
    return {};
}

void Planet::uploadAll(const UploadChunk& upload) const {
    forEachNode(tree(), [&](NodeIndex, const ChunkNode& node) { upload(node.slot, *node.heights); });
}

void Planet::announce(std::span<const AnnouncedView> path, std::size_t view) {
    assert(view < maxViews);
    state_->announce(path, view);
}

std::vector<TileChange> Planet::takeTileChanges(BlockKind kind) {
    return std::exchange(state_->tilesOf(kind).changes, {});
}

void Planet::reloadTiles(BlockKind kind) {
    TilePaging& tiles = state_->tilesOf(kind);
    if (!tiles.isOn()) return;
    state_->resizeTiles(tiles, tiles.capacity());
    state_->count();
}

std::vector<std::string> Planet::takeProblems() {
    return std::exchange(state_->run.log.problems, {});
}

const PagingSettings& Planet::pagingSettings() const {
    return state_->settings;
}
const ChunkFile& Planet::file() const {
    assert(state_->file);
    return *state_->file;
}
const ChunkTree& Planet::tree() const {
    return state_->heights.tree;
}
const std::optional<ColourPyramid>& Planet::colour() const {
    return state_->colour;
}
const TileTree& Planet::tiles(BlockKind kind) const {
    return state_->tilesOf(kind).tree;
}
std::span<const PlanetView> Planet::views() const {
    return state_->views;
}
const Selection& Planet::selection(std::size_t view) const {
    assert(view < state_->views.size());
    return state_->views[view].selection;
}
const PagingCounters& Planet::paging() const {
    return state_->paging;
}
const LastStep& Planet::lastStep() const {
    return state_->lastStep;
}
PlanetInspector Planet::inspect() const {
    return PlanetInspector(*state_);
}
PlanetTools Planet::tools() {
    return PlanetTools(*state_);
}

}  // namespace planet
