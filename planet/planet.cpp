#include "planet/planet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// A block used in one of the last frames is not dropped: a camera that shakes would have it loaded and
// dropped in turns.
constexpr std::uint64_t framesKept = 4;

// Where all that is resident is in use, a block yields to one that is wanted this many times as much: so many
// times that the two never take turns. A few a frame, since what yields is drawn coarser at once.
constexpr float yieldFactor = 1.5f;
constexpr std::size_t yieldsPerFrame = 8;

constexpr int maxLoaderThreads = 64;

std::uint64_t chunkCountOf(const PlanetShape& shape) {
    return faceCount * ((std::uint64_t{1} << (2 * (leafLevel(shape) + 1))) - 1) / 3;
}

// The slots that a budget pays for: the roots' six and then whole sibling blocks, and no more than the planet
// has chunks. At least so many that the finest level can be reached in one place, even where four chunks
// meet.
Result<std::uint32_t> slotsFor(const PlanetShape& shape, std::size_t budgetBytes) {
    const std::size_t bytes = chunkBytesCpu(shape) + chunkBytesGpu(shape);
    const std::size_t wanted = faceCount + 4 * quadrantCount * static_cast<std::size_t>(leafLevel(shape));
    const std::size_t least = std::min<std::uint64_t>(wanted, chunkCountOf(shape));
    if (budgetBytes < least * bytes) {
        return badInput(fmt::format("a budget of {} bytes is too small for this planet: it needs at least {}",
                                    budgetBytes, least * bytes));
    }
    constexpr std::uint64_t most = std::uint64_t{1} << 31;
    const std::uint64_t slots = std::min({std::uint64_t{budgetBytes / bytes}, chunkCountOf(shape), most});
    return static_cast<std::uint32_t>(slots - (slots - faceCount) % quadrantCount);
}

using Slots = std::array<std::uint32_t, quadrantCount>;

// Every slot above the roots' six, in fours; the lowest are taken first.
std::vector<Slots> freeSlotsOf(std::uint32_t slotCapacity) {
    std::vector<Slots> free;
    free.reserve(slotCapacity / quadrantCount);
    for (std::uint32_t end = slotCapacity; end > faceCount; end -= quadrantCount) {
        free.push_back({end - 4, end - 3, end - 2, end - 1});
    }
    return free;
}

}  // namespace

struct Planet::State {
    PagingSettings settings;
    std::shared_ptr<const ChunkFile> file;
    ChunkTree tree;
    Selection selection;
    PagingCounters paging;
    StageTimes times;
    std::uint32_t slotCapacity = 0;
    std::vector<Slots> freeSlots;    // neither a resident block's nor promised to a page-in
    std::vector<NodeIndex> watched;  // first nodes of resident blocks that have no page-out pending
    std::vector<ChunkId> yielding;   // parents of blocks that the next step drops before it selects
    std::uint64_t frame = 0;         // of the current step; the first is 1
    std::vector<std::string> problems;
    std::unique_ptr<Pager> pager;

    // The stages of a step.
    void dropYielding();
    void uploadFinished(const UploadChunk& upload);
    void markUsed(PagingQueue& queue);
    void request(PagingQueue& queue);
    void chooseYielding();
    void count();

    void finish(FinishedLoad&& load, const UploadChunk& upload);
    void fail(NodeIndex parent, const FinishedLoad& load, std::string message);
    void withdraw(const PagingRequest& request);
    bool takeSlots(PagingQueue& queue, double priority, Slots& slots);
    bool evictOne(PagingQueue& queue);
    void evict(NodeIndex parent);
    bool mayBeEvicted(NodeIndex firstChild) const;
    bool hasBlocksOutOfUse() const { return tree.residentChunks > selection.touched.size(); }
};

Result<std::unique_ptr<Planet>> Planet::open(PlanetSource source, const PagingSettings& settings) {
    if (settings.loaderThreads < 1 || settings.loaderThreads > maxLoaderThreads) {
        return badInput(
            fmt::format("{} loader threads; 1 to {} will do", settings.loaderThreads, maxLoaderThreads));
    }
    const Result<std::uint32_t> slots = slotsFor(source.shape, settings.budgetBytes);
    if (!slots) return tl::unexpected(slots.error());
    auto tree = makeChunkTree(source.shape, source.minStep, source.maxStep, std::move(source.roots));
    if (!tree) return tl::unexpected(std::move(tree.error()));
    auto state = std::make_unique<State>();
    state->settings = settings;
    state->file = std::move(source.file);
    state->tree = std::move(*tree);
    state->slotCapacity = *slots;
    state->freeSlots = freeSlotsOf(*slots);
    state->pager = std::make_unique<Pager>(std::move(source.loadChildren), settings.loaderThreads);
    state->count();
    return std::unique_ptr<Planet>(new Planet(std::move(state)));
}

Planet::Planet(std::unique_ptr<State> state) : state_(std::move(state)) {}
Planet::~Planet() = default;

void Planet::step(const View& lodView, const LodSettings& settings, const UploadChunk& upload) {
    State& state = *state_;
    ++state.frame;

    Clock::time_point start = Clock::now();
    state.dropYielding();
    state.uploadFinished(upload);
    state.times.uploadMs = msSince(start);

    start = Clock::now();
    selectChunks(state.tree, lodView, settings, state.selection);
    state.times.selectMs = msSince(start);

    start = Clock::now();
    state.pager->withQueue([&](PagingQueue& queue) {
        state.markUsed(queue);
        state.request(queue);
    });
    state.chooseYielding();
    state.count();
    state.times.pagingMs = msSince(start);
}

void Planet::State::uploadFinished(const UploadChunk& upload) {
    const Clock::time_point start = Clock::now();
    if (frame == 1) {
        for (NodeIndex root = 0; root < faceCount; ++root) {
            upload(tree.nodes[root].slot, *tree.nodes[root].heights);
        }
    }
    do {
        std::optional<FinishedLoad> load = pager->takeFinished();
        if (!load) return;
        finish(std::move(*load), upload);
    } while (msSince(start) < settings.uploadLimitMs);
}

void Planet::State::finish(FinishedLoad&& load, const UploadChunk& upload) {
    // Still there: a block above a block that is being loaded is never dropped.
    const NodeIndex parent = findNode(tree, load.request.parent);
    assert(parent != noNode && tree.nodes[parent].childrenState == ChildrenState::Requested);
    paging.bytesRead += load.request.location.size;
    paging.loadSeconds += load.seconds;
    if (!load.children) return fail(parent, load, std::move(load.children.error().message));
    if (auto checked = checkChildren(tree, parent, *load.children); !checked) {
        return fail(parent, load, std::move(checked.error().message));
    }
    for (std::size_t q = 0; q < quadrantCount; ++q)
        upload(load.request.slots[q], (*load.children)[q].heights);
    const NodeIndex first = addChildren(tree, parent, std::move(*load.children), load.request.slots);
    // As if used by the frame that asked for it, in case this one no longer does.
    for (NodeIndex q = 0; q < quadrantCount; ++q) tree.nodes[first + q].lastUsedFrame = frame - 1;
    watched.push_back(first);
    ++paging.loaded;
}

void Planet::State::fail(NodeIndex parent, const FinishedLoad& load, std::string message) {
    tree.nodes[parent].childrenState = ChildrenState::Failed;
    freeSlots.push_back(load.request.slots);
    problems.push_back(std::move(message));
    ++paging.failed;
}

// Keeps the page-outs what they are meant to be: the blocks that are out of use, the longest unused first and
// of those the deepest, so that children go before their parents.
void Planet::State::markUsed(PagingQueue& queue) {
    std::vector<NodeIndex> before;
    before.swap(watched);
    for (const NodeIndex index : selection.touched) {
        ChunkNode& node = tree.nodes[index];
        const bool wasOutOfUse = std::exchange(node.lastUsedFrame, frame) + 1 < frame;
        if (node.parent == noNode || quadrantOf(node.id) != 0) continue;
        watched.push_back(index);
        const ChunkId parentId = parentOf(node.id);
        // Wanted after all: the two requests cancel each other.
        if (wasOutOfUse && queue.find(parentId))
            queue.submit({parentId, PagingType::PageIn, 0, frame, {}, {}, {}});
    }
    for (const NodeIndex index : before) {
        const ChunkNode& node = tree.nodes[index];
        if (node.lastUsedFrame == frame) continue;
        const double priority = node.id.level / 32.0 - static_cast<double>(node.lastUsedFrame);
        queue.submit({parentOf(node.id), PagingType::PageOut, priority, frame, {}, {}, {}});
    }
}

// Page-ins for what the selection lacks, the most wanted first, as far as there are slots for them.
void Planet::State::request(PagingQueue& queue) {
    for (const ChildrenRequest& wanted : selection.requests) {
        if (queue.find(wanted.parentId)) {
            queue.submit({wanted.parentId, PagingType::PageIn, wanted.priority, frame, {}, {}, {}});
        }
    }
    for (const PagingRequest& stale : queue.cancelNotRenewed(PagingType::PageIn, frame)) withdraw(stale);
    paging.budgetWaits = 0;
    for (const ChildrenRequest& wanted : selection.requests) {
        ChunkNode& parent = tree.nodes[wanted.parent];
        if (parent.childrenState != ChildrenState::Absent) continue;
        Slots slots{};
        if (!takeSlots(queue, wanted.priority, slots)) {
            ++paging.budgetWaits;
            continue;
        }
        parent.childrenState = ChildrenState::Requested;
        queue.submit({wanted.parentId, PagingType::PageIn, wanted.priority, frame, parent.children,
                      parent.heights, slots});
    }
}

// Undoes what request did for a page-in that no loader has taken.
void Planet::State::withdraw(const PagingRequest& request) {
    tree.nodes[findNode(tree, request.parent)].childrenState = ChildrenState::Absent;
    freeSlots.push_back(request.slots);
}

// Free slots first, then those of the block that is out of use longest, then those promised to a page-in that
// is wanted less.
bool Planet::State::takeSlots(PagingQueue& queue, double priority, Slots& slots) {
    if (freeSlots.empty() && !evictOne(queue)) {
        const PagingRequest* least = queue.worst(PagingType::PageIn);
        if (!least || least->priority >= priority) return false;
        withdraw(*queue.cancel(least->parent));
    }
    slots = freeSlots.back();
    freeSlots.pop_back();
    return true;
}

bool Planet::State::evictOne(PagingQueue& queue) {
    while (const PagingRequest* oldest = queue.best(PagingType::PageOut)) {
        const NodeIndex parent = findNode(tree, oldest->parent);
        const NodeIndex first = tree.nodes[parent].firstChild;
        if (tree.nodes[first].lastUsedFrame + framesKept >= frame) return false;
        queue.popBest(PagingType::PageOut);
        if (!mayBeEvicted(first)) {
            watched.push_back(first);
            continue;
        }
        evict(parent);
        return true;
    }
    return false;
}

void Planet::State::evict(NodeIndex parent) {
    Slots slots{};
    for (NodeIndex q = 0; q < quadrantCount; ++q)
        slots[q] = tree.nodes[tree.nodes[parent].firstChild + q].slot;
    freeSlots.push_back(slots);
    removeChildren(tree, parent);
    ++paging.evicted;
}

// Evens out the errors of a view that the budget cannot pay for: without this, what came first would stay
// fine and what came closer since would stay coarse.
void Planet::State::chooseYielding() {
    if (paging.budgetWaits == 0 || hasBlocksOutOfUse()) return;
    std::vector<ChildrenRequest> least;
    for (const ChildrenRequest& split : selection.splits) {
        if (mayBeEvicted(tree.nodes[split.parent].firstChild)) least.push_back(split);
    }
    std::sort(least.begin(), least.end(), [](const ChildrenRequest& a, const ChildrenRequest& b) {
        return a.priority != b.priority ? a.priority < b.priority : a.parentId < b.parentId;
    });
    for (const ChildrenRequest& wanted : selection.requests) {
        if (tree.nodes[wanted.parent].childrenState != ChildrenState::Absent) continue;
        const std::size_t next = yielding.size();
        if (next == std::min(least.size(), yieldsPerFrame)) return;
        if (wanted.priority <= yieldFactor * least[next].priority) return;
        yielding.push_back(least[next].parentId);
    }
}

// Not in the step that chose them, whose draw list they are in.
void Planet::State::dropYielding() {
    for (const ChunkId& parentId : yielding) {
        const NodeIndex parent = findNode(tree, parentId);
        std::erase(watched, tree.nodes[parent].firstChild);
        evict(parent);
    }
    yielding.clear();
}

// Not while anything below is resident or on its way.
bool Planet::State::mayBeEvicted(NodeIndex firstChild) const {
    const auto begin = tree.nodes.begin() + firstChild;
    return std::none_of(begin, begin + quadrantCount, [](const ChunkNode& node) {
        return node.childrenState == ChildrenState::Resident ||
               node.childrenState == ChildrenState::Requested;
    });
}

void Planet::State::count() {
    const auto counters = pager->withQueue([](const PagingQueue& queue) { return queue.counters(); });
    const PagerStatus status = pager->status();
    paging.queued = status.queued;
    paging.loading = status.loading + status.finished;
    paging.requested = counters.added[static_cast<std::size_t>(PagingType::PageIn)];
    paging.merged = counters.merged;
    paging.cancelled = counters.opposed + counters.withdrawn;
    paging.residentChunks = tree.residentChunks;
    paging.residentBytesCpu = tree.residentChunks * chunkBytesCpu(tree.shape);
    paging.residentBytesGpu = tree.residentChunks * chunkBytesGpu(tree.shape);
}

bool Planet::settle(const View& lodView, const LodSettings& settings, const UploadChunk& upload,
                    double timeoutS) {
    const auto timeout = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeoutS));
    const Clock::time_point deadline = Clock::now() + timeout;
    while (true) {
        step(lodView, settings, upload);
        if (settled()) return true;
        if (Clock::now() >= deadline) return false;
        state_->pager->waitForFinished(deadline);
    }
}

// What the budget has no room for can still come while a block is resident that this view does not use, or
// that yields to it, for that block will be dropped.
bool Planet::settled() const {
    const State& state = *state_;
    const bool roomToCome = state.hasBlocksOutOfUse() || !state.yielding.empty();
    return state.frame > 0 && state.pager->status().idle() && (state.paging.budgetWaits == 0 || !roomToCome);
}

void Planet::uploadAll(const UploadChunk& upload) const {
    forEachNode(state_->tree, [&](NodeIndex, const ChunkNode& node) { upload(node.slot, *node.heights); });
}

std::vector<std::string> Planet::takeProblems() {
    return std::exchange(state_->problems, {});
}

void Planet::retryFailed() {
    for (ChunkNode& node : state_->tree.nodes) {
        if (node.childrenState == ChildrenState::Failed) node.childrenState = ChildrenState::Absent;
    }
}

std::vector<PagingRequest> Planet::pendingRequests(PagingType type) const {
    return state_->pager->withQueue([&](const PagingQueue& queue) { return queue.sorted(type); });
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
const Selection& Planet::selection() const {
    return state_->selection;
}
const PagingCounters& Planet::paging() const {
    return state_->paging;
}
const StageTimes& Planet::times() const {
    return state_->times;
}
std::uint32_t Planet::slotCapacity() const {
    return state_->slotCapacity;
}

}  // namespace planet
