// What stays resident, what is asked for and what makes room: the paging half of a Planet.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "planet/planet_state.h"
#include "planet/select/lod_select.h"

namespace planet {

namespace {

// A few a frame, since what yields is drawn coarser at once.
constexpr std::size_t yieldsPerFrame = 8;

constexpr std::size_t eventsKept = 1000;
constexpr std::uint64_t noFrame = std::numeric_limits<std::uint64_t>::max();  // later than any

}  // namespace

Result<std::uint32_t> slotsFor(const PlanetShape& shape, std::size_t budgetBytes) {
    const std::size_t bytes = chunkBytesCpu(shape) + chunkBytesGpu(shape);
    const std::size_t wanted = faceCount + 4 * quadrantCount * static_cast<std::size_t>(leafLevel(shape));
    const std::size_t least = std::min<std::uint64_t>(wanted, chunkCountOf(shape));
    if (budgetBytes < least * bytes) {
        return badInput(fmt::format("budget too small for this planet: {} bytes; expected at least {}",
                                    budgetBytes, least * bytes));
    }
    constexpr std::uint64_t most = std::uint64_t{1} << 31;
    const std::uint64_t slots = std::min({std::uint64_t{budgetBytes / bytes}, chunkCountOf(shape), most});
    return static_cast<std::uint32_t>(slots - (slots - faceCount) % quadrantCount);
}

std::vector<BlockSlots> freeSlotsFrom(std::uint32_t firstFree, std::uint32_t slotCapacity) {
    std::vector<BlockSlots> free;
    free.reserve((slotCapacity - firstFree) / quadrantCount);
    for (std::uint32_t end = slotCapacity; end > firstFree; end -= quadrantCount) {
        free.push_back({end - 4, end - 3, end - 2, end - 1});
    }
    return free;
}

BudgetShares sharesOf(const PagingSettings& settings, bool hasColours, bool hasNormals) {
    // Some hundred blocks are enough for one tile and those beside it.
    constexpr std::size_t mostHeights = std::size_t{8} << 20;
    const auto without = [](std::size_t bytes, double share) {
        return static_cast<std::size_t>((1 - share) * static_cast<double>(bytes));
    };
    BudgetShares shares;
    const std::size_t rest =
        hasColours ? without(settings.budgetBytes, settings.colourShare) : settings.budgetBytes;
    shares.colours = settings.budgetBytes - rest;
    shares.chunks = hasNormals ? without(rest, settings.normalShare) : rest;
    const std::size_t ofNormals = rest - shares.chunks;
    shares.normalHeights = std::min(mostHeights, ofNormals / 4);
    shares.normals = ofNormals - shares.normalHeights;
    return shares;
}

std::vector<MergedRequest> mergeRequests(const std::vector<PlanetView>& views, const RequestsOf& requestsOf) {
    std::vector<MergedRequest> all;
    for (std::size_t v = 0; v < views.size(); ++v) {
        const double factor = views[v].input.priorityFactor;
        assert(factor > 0);
        for (const ChildrenRequest& one : requestsOf(views[v])) {
            MergedRequest merged{one.parent, one.parentId};
            // Not 0, which would say that the view does not want it.
            merged.priority =
                std::max(static_cast<float>(one.priority * factor), std::numeric_limits<float>::min());
            merged.viewPriority[v] = merged.priority;
            all.push_back(merged);
        }
    }
    if (views.size() > 1) {
        std::sort(all.begin(), all.end(),
                  [](const MergedRequest& a, const MergedRequest& b) { return a.parent < b.parent; });
        std::size_t kept = 0;
        for (const MergedRequest& one : all) {
            if (kept == 0 || all[kept - 1].parent != one.parent) {
                all[kept++] = one;
                continue;
            }
            MergedRequest& same = all[kept - 1];
            same.priority = std::max(same.priority, one.priority);
            for (std::size_t v = 0; v < maxViews; ++v) same.viewPriority[v] += one.viewPriority[v];
        }
        all.resize(kept);
    }
    std::sort(all.begin(), all.end(), [](const MergedRequest& a, const MergedRequest& b) {
        return a.priority != b.priority ? a.priority > b.priority : a.parentId < b.parentId;
    });
    return all;
}

void PlanetState::select(double fadeElapsedS) {
    for (PlanetView& view : views) {
        selectChunks(tree, view.input.lodView, view.input.lod, view.selection, fadeElapsedS);
        selectTiles(colours.tree, tree, view.input.lodView, view.input.colours, view.input.lod, view.colours);
        selectTiles(normals.tree, tree, view.input.lodView, view.input.normals, view.input.lod, view.normals);
    }
}

void PlanetState::uploadFinished(const UploadChunk& upload) {
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
    } while (settings.time != PagingTime::Clock || msSince(start) < settings.uploadLimitMs);
}

void PlanetState::finish(FinishedLoad&& load, const UploadChunk& upload) {
    if (load.request.kind == BlockKind::Heights)
        paging.bytesRead += load.bytes;
    else
        tilesOf(load.request.kind).counters.bytesRead += load.bytes;
    paging.loadSeconds += load.seconds;
    if (!isKept(load.request)) return throwAway(load);
    if (load.request.kind != BlockKind::Heights) return finishTiles(std::move(load));
    // Still there: a block above a block that is being loaded is never dropped, unless the load is thrown
    // away.
    const NodeIndex parent = findNode(tree, load.request.parent);
    assert(parent != noNode && tree.nodes[parent].childrenState == ChildrenState::Requested);
    --promised;
    if (!load.block) return fail(parent, load, std::move(load.block.error()));
    SiblingBlock& children = std::get<SiblingBlock>(*load.block);
    if (auto checked = checkChildren(tree, parent, children); !checked) {
        return fail(parent, load, namingFile(file.get(), std::move(checked.error())));
    }
    failures.forget(load.request.parent);
    assert(!freeSlots.empty());
    const BlockSlots slots = freeSlots.back();
    freeSlots.pop_back();
    for (std::size_t q = 0; q < quadrantCount; ++q) upload(slots[q], children[q].heights);
    const NodeIndex first = addChildren(tree, parent, std::move(children), slots);
    ++blocksLoaded;
    for (NodeIndex child = first; child < first + quadrantCount; ++child) {
        // As if used by the frame that asked for it, in case this one no longer does.
        tree.nodes[child].lastUsedFrame = frame - 1;
        tree.nodes[child].loadedAtS = nowS;
        tree.nodes[child].loadOrder = blocksLoaded;
        ChildrenState& below = tree.nodes[child].childrenState;
        const ChildrenState known = failures.stateAt(tree.nodes[child].id, sinceAnewS);
        if (below == ChildrenState::Absent && known != below) changeState(below, known);
    }
    watched.push_back(first);
    ++paging.loaded;
    if (keepsMoves) moves.arrived.push_back({load.request.block(), PagingOutcome::Loaded});
    note(load.request, PagingOutcome::Loaded, &load);
}

void PlanetState::finishTiles(FinishedLoad&& load) {
    TilePaging& tiles = tilesOf(load.request.kind);
    if (!load.block) {
        const bool badData = load.block.error().kind == ErrorKind::BadInput;
        tiles.fail(load.request.parent, std::move(load.block.error()), frame, sinceAnewS, settings.retry);
        return noteFailure(load, tiles.failures, badData);
    }
    tiles.finish(load.request.parent, std::get<TileBlock>(*std::move(load.block)), frame, sinceAnewS);
    if (keepsMoves) moves.arrived.push_back({load.request.block(), PagingOutcome::Loaded});
    note(load.request, PagingOutcome::Loaded, &load);
}

void PlanetState::fail(NodeIndex parent, const FinishedLoad& load, Error error) {
    const bool badData = error.kind == ErrorKind::BadInput;
    const bool forGood = failures.failed(load.request.parent, std::move(error), sinceAnewS, settings.retry);
    changeState(tree.nodes[parent].childrenState,
                forGood ? ChildrenState::Failed : ChildrenState::AwaitingRetry);
    ++paging.failed;
    noteFailure(load, failures, badData);
}

// One that is tried again is not worth a line in a log yet.
void PlanetState::noteFailure(const FinishedLoad& load, const BlockFailures& known, bool badData) {
    const ChunkId& parent = load.request.parent;
    if (known.isForGood(parent)) tell(known.messageOf(parent));
    if (keepsMoves) moves.arrived.push_back({load.request.block(), PagingOutcome::Failed, badData});
    note(load.request, PagingOutcome::Failed, &load);
}

void PlanetState::throwAway(const FinishedLoad& load) {
    if (keepsMoves) moves.arrived.push_back({load.request.block(), PagingOutcome::Cancelled});
    ++thrownAway;
    note(load.request, PagingOutcome::Cancelled, &load);
}

// Keeps the page-outs what they are meant to be: the blocks that are out of use by all views, the longest
// unused first and of those the deepest, so that children go before their parents.
void PlanetState::markUsed(PagingQueue& queue) {
    std::vector<NodeIndex> before;
    before.swap(watched);
    usedChunks = 0;
    const auto use = [&](NodeIndex index) {
        ChunkNode& node = tree.nodes[index];
        if (node.lastUsedFrame == frame) return;  // by a view before
        ++usedChunks;
        const bool wasOutOfUse = std::exchange(node.lastUsedFrame, frame) + 1 < frame;
        if (node.parent == noNode || quadrantOf(node.id) != 0) return;
        watched.push_back(index);
        if (!wasOutOfUse) return;
        // Wanted after all: the two requests cancel each other.
        const ChunkId parentId = parentOf(node.id);
        if (const PagingRequest* pageOut = queue.find(parentId)) {
            note(*pageOut, PagingOutcome::Cancelled);
            queue.submit({.parent = parentId, .type = PagingType::PageIn, .renewedFrame = frame});
        }
    };
    for (const PlanetView& view : views) {
        colours.use(view.colours.touched, frame);
        normals.use(view.normals.touched, frame);
    }
    for (const PlanetView& view : views) {
        for (const VisitedNode& visited : view.selection.touched) use(visited.node);
        // What is about to be drawn, once a fade lets it.
        for (const DrawItem& item : view.selection.draw) {
            for (NodeIndex q = 0; item.splitWaits && q < quadrantCount; ++q) {
                use(tree.nodes[item.node].firstChild + q);
            }
        }
    }
    for (const NodeIndex index : before) {
        const ChunkNode& node = tree.nodes[index];
        if (node.lastUsedFrame == frame) continue;
        const double priority = node.id.level / 32.0 - static_cast<double>(node.lastUsedFrame);
        queue.submit({.parent = parentOf(node.id),
                      .type = PagingType::PageOut,
                      .priority = priority,
                      .renewedFrame = frame,
                      .askedAtS = nowS});
    }
}

// Page-ins for what the views lack, the most wanted first, as far as there is room for them.
void PlanetState::request(PagingQueue& queue) {
    wanted = mergeRequests(
        views, [](const PlanetView& view) -> auto& { return view.selection.requests; });
    const std::vector<MergedRequest> wantedColours = mergeRequests(
        views, [](const PlanetView& view) -> auto& { return view.colours.requests; });
    const std::vector<MergedRequest> wantedNormals = mergeRequests(
        views, [](const PlanetView& view) -> auto& { return view.normals.requests; });
    renew(queue, wanted, BlockKind::Heights);
    renew(queue, wantedColours, BlockKind::Colours);
    renew(queue, wantedNormals, BlockKind::Normals);
    for (const PagingRequest& stale : queue.cancelNotRenewed(PagingType::PageIn, frame)) withdraw(stale);
    paging.budgetWaits = 0;
    failures.beginStep();
    for (const MergedRequest& one : wanted) {
        ChunkNode& parent = tree.nodes[one.parent];
        if (!failures.mayAsk(one.parentId, parent.childrenState, sinceAnewS)) continue;
        if (!promiseRoom(queue, one.priority)) {
            ++paging.budgetWaits;
            continue;
        }
        changeState(parent.childrenState, ChildrenState::Requested);
        if (keepsMoves) moves.requested.push_back(one.parentId);
        queue.submit({.parent = one.parentId,
                      .priority = one.priority,
                      .renewedFrame = frame,
                      .askedAtS = nowS,
                      .viewPriority = one.viewPriority,
                      .location = parent.children,
                      .parentHeights = parent.heights,
                      .ticket = nextTicket++});
    }
    requestTiles(queue, colours, wantedColours);
    requestTiles(queue, normals, wantedNormals);
}

void PlanetState::renew(PagingQueue& queue, const std::vector<MergedRequest>& pending, BlockKind kind) const {
    for (const MergedRequest& one : pending) {
        if (!queue.find({one.parentId, kind})) continue;
        queue.submit({.parent = one.parentId,
                      .kind = kind,
                      .priority = one.priority,
                      .renewedFrame = frame,
                      .viewPriority = one.viewPriority});
    }
}

void PlanetState::requestTiles(PagingQueue& queue, TilePaging& tiles,
                               const std::vector<MergedRequest>& wantedTiles) {
    if (!tiles.isOn()) return;
    const std::vector<MergedRequest> splits = mergeRequests(
        views, [&](const PlanetView& view) -> auto& { return view.tiles(tiles.kind).splits; });
    const TilePaging::Note noteOf = [this](const PagingRequest& request, PagingOutcome outcome) {
        note(request, outcome);
    };
    tiles.request(queue, wantedTiles, splits,
                  {frame, nowS, sinceAnewS, nextTicket, noteOf, keepsMoves ? &moves.requested : nullptr});
}

// Undoes what request did for a page-in that no loader has taken.
void PlanetState::withdraw(const PagingRequest& request) {
    if (request.kind != BlockKind::Heights) {
        tilesOf(request.kind).withdraw(request.parent);
        return note(request, PagingOutcome::Cancelled);
    }
    changeState(tree.nodes[findNode(tree, request.parent)].childrenState, ChildrenState::Absent);
    --promised;
    note(request, PagingOutcome::Cancelled);
}

// Free slots first, then those of the block that is out of use longest, then those promised to a page-in that
// is wanted less.
bool PlanetState::promiseRoom(PagingQueue& queue, double priority) {
    if (freeSlots.size() <= promised && !evictOne(queue)) {
        const PagingRequest* least = queue.worst(PagingType::PageIn, BlockKind::Heights);
        if (!least || least->priority >= priority) return false;
        withdraw(*queue.cancel(least->parent));
    }
    ++promised;
    return true;
}

bool PlanetState::evictOne(PagingQueue& queue) {
    while (const PagingRequest* oldest = queue.best(PagingType::PageOut)) {
        const NodeIndex parent = findNode(tree, oldest->parent);
        const NodeIndex first = tree.nodes[parent].firstChild;
        if (tree.nodes[first].lastUsedFrame + framesKept >= frame) return false;
        if (mayBeEvicted(first)) {
            evict(queue, parent);
            return true;
        }
        queue.popBest(PagingType::PageOut);
        watched.push_back(first);
    }
    return false;
}

// Also ends the page-out that may be pending. Leaves what is watched as it is.
void PlanetState::evict(PagingQueue& queue, NodeIndex parent) {
    PagingRequest request{.parent = tree.nodes[parent].id, .type = PagingType::PageOut, .askedAtS = nowS};
    if (auto pending = queue.pop(request.parent)) request = std::move(*pending);
    assert(request.type == PagingType::PageOut);
    BlockSlots slots{};
    for (NodeIndex q = 0; q < quadrantCount; ++q) {
        slots[q] = tree.nodes[tree.nodes[parent].firstChild + q].slot;
    }
    freeSlots.push_back(slots);
    removeChildren(tree, parent);
    ++paging.evicted;
    note(request, PagingOutcome::Evicted);
}

// Evens out the errors of views that the budget cannot pay for: without this, what came first would stay fine
// and what came closer since would stay coarse. A block that several views split is worth what it is worth to
// the one that wants it most.
void PlanetState::chooseYielding() {
    if (paging.budgetWaits == 0 || hasBlocksOutOfUse()) return;
    std::vector<MergedRequest> least = mergeRequests(
        views, [](const PlanetView& view) -> auto& { return view.selection.splits; });
    std::erase_if(least, [&](const MergedRequest& split) {
        return !mayBeEvicted(tree.nodes[split.parent].firstChild);
    });
    std::sort(least.begin(), least.end(), [](const MergedRequest& a, const MergedRequest& b) {
        return a.priority != b.priority ? a.priority < b.priority : a.parentId < b.parentId;
    });
    for (const MergedRequest& one : wanted) {
        if (tree.nodes[one.parent].childrenState != ChildrenState::Absent) continue;
        const std::size_t next = yielding.size();
        if (next == std::min(least.size(), yieldsPerFrame)) return;
        if (one.priority <= yieldFactor * least[next].priority) return;
        yielding.push_back(least[next].parentId);
    }
}

// Not in the step that chose them, whose draw lists they are in.
void PlanetState::dropYielding() {
    if (yielding.empty()) return;
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        for (const ChunkId& parentId : yielding) evict(queue, findNode(tree, parentId));
    });
    yielding.clear();
    forgetGone();
}

// Not while anything below is resident or on its way.
bool PlanetState::mayBeEvicted(NodeIndex firstChild) const {
    const auto begin = tree.nodes.begin() + firstChild;
    return std::none_of(begin, begin + quadrantCount, [](const ChunkNode& node) {
        return node.childrenState == ChildrenState::Resident ||
               node.childrenState == ChildrenState::Requested;
    });
}

// A freed node has no parent, and only roots have none else, which are never watched.
void PlanetState::forgetGone() {
    std::erase_if(watched, [&](NodeIndex index) { return tree.nodes[index].parent == noNode; });
}

bool PlanetState::isOver(std::size_t blocks) const {
    return (tree.residentChunks - faceCount) / quadrantCount + promised > blocks;
}

// What no view uses goes first, then the requests that are wanted least, then what was used longest ago, and
// where even that is held up by the loads below it, those loads.
void PlanetState::shrinkTo(PagingQueue& queue, std::size_t blocks) {
    evictLeastUsed(queue, blocks, frame);
    while (isOver(blocks)) {
        const PagingRequest* least = queue.worst(PagingType::PageIn, BlockKind::Heights);
        if (!least) break;
        withdraw(*queue.cancel(least->block()));
    }
    evictLeastUsed(queue, blocks, noFrame);
    if (!isOver(blocks)) return;
    abandonLoads();
    evictLeastUsed(queue, blocks, noFrame);
    assert(!isOver(blocks));
}

// Drops blocks last used before a frame until there are few enough or no more such blocks: the longest unused
// first, of those the deepest. In rounds, since dropping a block can free the one above it.
void PlanetState::evictLeastUsed(PagingQueue& queue, std::size_t blocks, std::uint64_t usedBefore) {
    if (!isOver(blocks)) return;
    struct Candidate {
        NodeIndex parent;
        std::uint64_t lastUsedFrame;
        std::uint8_t level;
    };
    std::vector<Candidate> candidates;
    forEachNode(tree, [&](NodeIndex index, const ChunkNode& node) {
        if (node.childrenState != ChildrenState::Resident) return;
        const std::uint64_t lastUsedFrame = tree.nodes[node.firstChild].lastUsedFrame;
        if (lastUsedFrame < usedBefore) candidates.push_back({index, lastUsedFrame, node.id.level});
    });
    std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.lastUsedFrame != b.lastUsedFrame ? a.lastUsedFrame < b.lastUsedFrame : a.level > b.level;
    });
    bool dropped = true;
    while (dropped) {
        dropped = false;
        for (const Candidate& candidate : candidates) {
            if (!isOver(blocks)) return;
            const ChunkNode& node = tree.nodes[candidate.parent];
            if (node.childrenState != ChildrenState::Resident || !mayBeEvicted(node.firstChild)) continue;
            evict(queue, candidate.parent);
            dropped = true;
        }
    }
}

// Only with no page-in of chunks queued: what is requested then is being read, or has been and is not yet
// resident.
void PlanetState::abandonLoads() {
    for (ChunkNode& node : tree.nodes) {
        if (node.childrenState == ChildrenState::Requested)
            changeState(node.childrenState, ChildrenState::Absent);
    }
    oldestTicketKept = nextTicket;
    promised = 0;
}

void PlanetState::dropTiles(PagingQueue& queue, TilePaging& tiles) {
    if (!tiles.isOn()) return;
    while (const PagingRequest* pending = queue.worst(PagingType::PageIn, tiles.kind))
        note(*queue.cancel(pending->block()), PagingOutcome::Cancelled);
    tiles.oldestTicketKept = nextTicket;
    tiles.begin(tiles.tileCapacity, sinceAnewS);
}

void PlanetState::resizeTiles(TilePaging& tiles, std::uint32_t tileCapacity) {
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        dropTiles(queue, tiles);
    });
    tiles.begin(tileCapacity, sinceAnewS);
    afterDrops();
}

void PlanetState::beginNormals(std::uint32_t tileCapacity, std::size_t heightBytes,
                               const std::string& problem) {
    if (pager) resizeTiles(normals, 0);
    if (!problem.empty() && problem != normalProblem) tell(problem);
    normalProblem = problem;
    normalCapacity = deriver ? tileCapacity : 0;
    if (!deriver) return;
    deriver->keepHeights(heightBytes);
    nextNormalRoot = 0;
    if (pager && settings.time == PagingTime::Clock && !keepsMoves)
        followNormalRoots();
    else
        finishNormalRoots();
}

void PlanetState::followNormalRoots() {
    if (!normalsArePending()) return;
    if (normalRootComing.valid()) {
        if (normalRootComing.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
        takeNormalRoot(normalRootComing.get());
    }
    while (nextNormalRoot < faceCount && !normals.roots[nextNormalRoot].texels.empty()) ++nextNormalRoot;
    if (nextNormalRoot == faceCount) {
        normals.begin(normalCapacity, sinceAnewS);
        return afterDrops();
    }
    normalRootComing = std::async(std::launch::async, [this, id = normals.roots[nextNormalRoot++].id] {
        return readRoot([&] { return deriver->tile(id); });
    });
}

void PlanetState::finishNormalRoots() {
    if (normalRootComing.valid()) takeNormalRoot(normalRootComing.get());
    if (normalCapacity > 0) deriveNormalRoots();
    normals.begin(normalCapacity, sinceAnewS);
    if (pager) afterDrops();
}

bool PlanetState::takeNormalRoot(Result<TileData>&& derived) {
    if (derived)
        normals.roots[static_cast<std::size_t>(derived->id.face)] = std::move(*derived);
    else
        tell(std::move(derived.error().message));
    return derived.has_value();
}

bool PlanetState::deriveNormalRoots() {
    bool any = false;
    for (const TileData& root : normals.roots) {
        if (root.texels.empty()) any |= takeNormalRoot(readRoot([&] { return deriver->tile(root.id); }));
    }
    return any;
}

// The lowest slots, in the order of the tree.
void PlanetState::renumber() {
    std::uint32_t next = faceCount;
    forEachNode(tree, [&](NodeIndex, const ChunkNode& node) {
        if (node.childrenState != ChildrenState::Resident) return;
        for (NodeIndex q = 0; q < quadrantCount; ++q) tree.nodes[node.firstChild + q].slot = next++;
    });
    freeSlots = freeSlotsFrom(next, slotCapacity);
    assert(freeSlots.size() >= promised);
}

void PlanetState::resize(std::uint32_t newCapacity) {
    slotCapacity = newCapacity;
    const std::size_t blocks = (slotCapacity - faceCount) / quadrantCount;
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        shrinkTo(queue, blocks);
    });
    renumber();
    afterDrops();
}

void PlanetState::dropEverything() {
    forgetFailures();
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        for (const PagingRequest& request : queue.cancelNotRenewed(PagingType::PageIn, noFrame)) {
            withdraw(request);
        }
        abandonLoads();
        evictLeastUsed(queue, 0, noFrame);
        dropTiles(queue, colours);
        dropTiles(queue, normals);
    });
    retryAll();
    pager->forgetAttempts();
    afterDrops();
}

// First what is queued, so that no loader takes it; then what is being read.
void PlanetState::startAnew() {
    pager->withQueue([&](PagingQueue& queue) {
        for (const PagingRequest& request : queue.cancelNotRenewed(PagingType::PageIn, noFrame)) {
            withdraw(request);
        }
        queue.cancelNotRenewed(PagingType::PageOut, noFrame);
    });
    for (const PagingRequest& request : pager->giveUp()) {
        ++thrownAway;
        note(request, PagingOutcome::Cancelled);
    }
    pager->forgetAttempts();
    paging.evicted += (tree.residentChunks - faceCount) / quadrantCount;
    tree.nodes.resize(faceCount);
    tree.freeGroups.clear();
    tree.residentChunks = faceCount;
    sinceAnewS = 0;
    forgetFailures();
    for (ChunkNode& root : tree.nodes) {
        if (root.childrenState != ChildrenState::None && root.childrenState != ChildrenState::Absent)
            changeState(root.childrenState, ChildrenState::Absent);
        root.firstChild = noNode;
        root.lastUsedFrame = 0;
    }
    freeSlots = freeSlotsFrom(faceCount, slotCapacity);
    promised = 0;
    for (TilePaging* tiles : {&colours, &normals}) {
        if (tiles->isOn()) tiles->begin(tiles->tileCapacity, sinceAnewS);
        tiles->oldestTicketKept = nextTicket;
    }
    watched.clear();
    yielding.clear();
    wanted.clear();
    views.assign(1, {});
    usedChunks = 0;
    paging.budgetWaits = 0;
    frame = 0;
    changed = true;
    oldestTicketKept = nextTicket;
    moves = {};
}

// Reads that were given up before their end. Nothing else can have asked for their blocks meanwhile.
void PlanetState::putBack(std::vector<PagingRequest> givenUp) {
    if (keepsMoves) moves = {.gaveUp = true};
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        for (PagingRequest& request : givenUp) {
            if (isKept(request)) {
                queue.submit(std::move(request));
                continue;
            }
            ++thrownAway;
            note(request, PagingOutcome::Cancelled);
        }
    });
}

// The selections, which hold nodes and slots, must not outlive what was dropped or moved between steps.
void PlanetState::afterDrops() {
    yielding.clear();
    forgetGone();
    if (frame > 0) select(0);
}

void PlanetState::note(const PagingRequest& request, PagingOutcome outcome, const FinishedLoad* load) {
    PagingEvent event;
    event.parent = request.parent;
    event.kind = request.kind;
    event.outcome = outcome;
    event.atS = nowS;
    event.waitedS = nowS - request.askedAtS;
    if (load) {
        event.readS = load->seconds;
        event.bytes = load->bytes;
    }
    event.timesAsked = request.timesAsked;
    event.priority = request.priority;
    event.type = request.type;
    history.push_back(event);
    if (history.size() > eventsKept) history.pop_front();
}

void PlanetState::noteTaken(const PagingQueue& queue) {
    const std::vector<BlockId> taken = pager->takeTaken(queue);
    if (keepsMoves) moves.taken.insert(moves.taken.end(), taken.begin(), taken.end());
}

void PlanetState::count() {
    const auto counters = pager->readQueue([](const PagingQueue& queue) { return queue.counters(); });
    const PagerStatus status = pager->status();
    paging.queued = status.queued;
    paging.loading = status.loading + status.finished;
    paging.requested = counters.added[static_cast<std::size_t>(PagingType::PageIn)];
    paging.merged = counters.merged;
    paging.cancelled = counters.opposed + counters.withdrawn + thrownAway;
    paging.pageOutsQueued = counters.added[static_cast<std::size_t>(PagingType::PageOut)];
    paging.pageOutsCancelled = counters.cancelled[static_cast<std::size_t>(PagingType::PageOut)];
    colours.count();
    normals.count();
    if (deriver) normals.counters.bytesRead = deriver->bytesRead();
    paging.failedForGood = paging.awaitingRetry = 0;
    for (const BlockFailures* known : {&failures, &colours.failures, &normals.failures}) {
        paging.failedForGood += static_cast<std::uint32_t>(known->countForGood());
        paging.awaitingRetry += static_cast<std::uint32_t>(known->count() - known->countForGood());
    }
    paging.residentChunks = tree.residentChunks;
    paging.residentBytesCpu = tree.residentChunks * chunkBytesCpu(tree.shape);
    paging.residentBytesGpu = tree.residentChunks * chunkBytesGpu(tree.shape);
}

}  // namespace planet
