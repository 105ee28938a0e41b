// Implements the paging stage of a Planet's step, and the changes between steps.
#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <unordered_set>
#include <utility>

#include "planet/planet_state.h"
#include "planet/select/lod_select.h"
#include "planet/spans/span_recorder.h"

namespace planet {

namespace {

constexpr std::uint64_t noFrame = std::numeric_limits<std::uint64_t>::max();  // later than any frame

const std::vector<ChildrenRequest>& splitsIn(const PlanetView& view, BlockKind kind) {
    return kind == BlockKind::Heights ? view.selection.splits : view.tiles(kind).splits;
}

std::vector<MergedRequest> mergeSplits(const std::vector<PlanetView>& views, BlockKind kind) {
    return mergeRequests(
        views, [&](const PlanetView& view) -> auto& { return splitsIn(view, kind); });
}

void markPassing(std::vector<MergedRequest>& wanted, const std::unordered_set<NodeIndex>& lasting) {
    for (MergedRequest& one : wanted)
        if (!lasting.contains(one.parent)) one.urgency = PagingUrgency::Passing;
}

}  // namespace

const std::vector<ChildrenRequest>& requestsIn(const PlanetView& view, BlockKind kind) {
    return kind == BlockKind::Heights ? view.selection.requests : view.tiles(kind).requests;
}

void sortByPriority(std::vector<MergedRequest>& requests) {
    std::sort(requests.begin(), requests.end(), [](const MergedRequest& a, const MergedRequest& b) {
        return a.priority != b.priority ? a.priority > b.priority : a.parentId < b.parentId;
    });
}

BudgetShares sharesOf(const PagingSettings& settings, bool hasColours, bool hasNormals) {
    // Enough for the heights under one tile and its neighbours, a few hundred blocks.
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
            // 0 would mean that the view does not request the block.
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
    sortByPriority(all);
    return all;
}

void PlanetState::select(double fadeElapsedS) {
    const ChunkTree& chunks = heights.tree;
    for (PlanetView& view : views) {
        const ViewInput& input = view.input;
        selectChunks(chunks, input.lodView, input.lod, view.selection, fadeElapsedS);
        selectTiles(colours.tree, chunks, input.lodView, input.colours, input.lod, view.colours);
        selectTiles(normals.tree, chunks, input.lodView, input.normals, input.lod, view.normals);
    }
}

void PlanetState::uploadFinished(const UploadChunk& upload) {
    const Stopwatch uploading;
    if (run.frame == 1) {
        for (NodeIndex root = 0; root < faceCount; ++root)
            upload(heights.tree.nodes[root].slot, *heights.tree.nodes[root].heights);
    }
    do {
        std::optional<FinishedLoad> load = pager->takeFinished();
        if (!load) return;
        const SpanScope span("upload block", load->request.block());
        paging.loadSeconds += load->seconds;
        ++backlog.ended;
        of(load->request.kind).finish(std::move(*load), run, upload);
    } while (settings.time != PagingTime::Clock || uploading.elapsedMs() < settings.uploadLimitMs);
}

// Drops the blocks that the last step chose; they were in its draw lists.
void PlanetState::dropYielding() {
    if (!heights.isYielding()) return;
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        heights.dropYielding(queue, run);
    });
}

MergedRequests PlanetState::mergeFor(BlockKind kind) const {
    MergedRequests merged;
    merged.wanted = mergeRequests(
        views, [&](const PlanetView& view) -> auto& { return requestsIn(view, kind); });
    // Splits of heights are merged only if the budget is exhausted, because there are many.
    if (kind != BlockKind::Heights) merged.splits = mergeSplits(views, kind);
    return merged;
}

// Queues page-outs for the blocks that no view uses, and page-ins for the blocks that views lack, most urgent
// first, while there is room.
void PlanetState::page() {
    std::vector<const Selection*> selections;
    for (const PlanetView& view : views) {
        selections.push_back(&view.selection);
        colours.use(view.colours.touched, run.frame);
        normals.use(view.normals.touched, run.frame);
    }
    std::array<MergedRequests, blockKindCount> requests;
    for (const BlockPaging* kind : kinds())
        if (kind->isOn()) requests[static_cast<std::size_t>(kind->kind())] = mergeFor(kind->kind());
    MergedRequests& ofHeights = requests[static_cast<std::size_t>(BlockKind::Heights)];
    const bool prefetches = settings.prefetch.mode != PrefetchMode::Off;
    const Predicted predicted = prefetches ? predict() : Predicted{};
    if (prefetches && settings.prefetch.lastingFirst) {
        for (std::size_t kind = 0; kind < requests.size(); ++kind)
            markPassing(requests[kind].wanted, predicted.lasting[kind]);
    }

    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        heights.markUsed(queue, selections, run);
        for (std::size_t kind = 0; kind < requests.size(); ++kind)
            kinds()[kind]->renew(queue, requests[kind].wanted, run);
        for (std::size_t kind = 0; kind < requests.size(); ++kind)
            kinds()[kind]->renewPrefetches(queue, predicted.wanted[kind], run);
        for (const PagingRequest& stale : queue.cancelNotRenewed(PagingType::PageIn, run.frame))
            of(stale.kind).withdraw(stale, run);
        for (std::size_t kind = 0; kind < requests.size(); ++kind)
            kinds()[kind]->request(queue, requests[kind], run);
        backlog.queued = queue.count(PagingType::PageIn) - queue.prefetches();
        if (!prefetches) return;
        heights.markPredicted(queue, predicted.touched[static_cast<std::size_t>(BlockKind::Heights)], run);
        for (TilePaging* tiles : {&colours, &normals})
            tiles->markPredicted(predicted.touched[static_cast<std::size_t>(tiles->kind())], run);
        for (std::size_t kind = 0; kind < requests.size(); ++kind)
            kinds()[kind]->prefetch(queue, predicted.wanted[kind], run);
    });
    if (!heights.lacksRoom()) return;
    ofHeights.splits = mergeSplits(views, BlockKind::Heights);
    heights.chooseYielding(ofHeights);
}

void PlanetState::count() {
    const auto [counters, prefetches] = pager->readQueue([](const PagingQueue& queue) {
        return std::pair(queue.counters(), static_cast<std::uint32_t>(queue.prefetches()));
    });
    const PagerStatus status = pager->status();
    paging.queued = status.queued - std::min(status.queued, prefetches);
    paging.loading = status.loading + status.finished;
    paging.requested = counters.added[static_cast<std::size_t>(PagingType::PageIn)];
    paging.merged = counters.merged;
    paging.cancelled = counters.opposed + counters.withdrawn + run.log.discarded;
    paging.pageOutsQueued = counters.added[static_cast<std::size_t>(PagingType::PageOut)];
    paging.pageOutsCancelled = counters.cancelled[static_cast<std::size_t>(PagingType::PageOut)];
    const ChunkTree& tree = heights.tree;
    paging.residentBytesCpu = tree.residentChunks * chunkBytesCpu(tree.shape);
    paging.residentBytesGpu = tree.residentChunks * chunkBytesGpu(tree.shape);
    if (const NormalDeriver* deriver = normalRoots.deriver())
        normals.counters().bytesRead = deriver->bytesRead();
    colours.counters().unpacked = colours.unpacked;
    for (BlockPaging* kind : kinds()) {
        kind->count();
        paging[kind->kind()] = kind->counters();
    }
}

std::optional<double> PlanetState::untilRetryS() const {
    std::optional<double> first;
    for (const BlockPaging* kind : kinds()) {
        const std::optional<double> atS = kind->failures().nextRetryS();
        if (atS) first = std::min(first.value_or(*atS), *atS);
    }
    if (first) *first = std::max(*first - run.sinceResetS, 0.0);
    return first;
}

void PlanetState::resizeHeights(std::uint32_t capacity) {
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        heights.resize(queue, capacity, run);
    });
    selectAgain();
}

void PlanetState::resizeTiles(TilePaging& tiles, std::uint32_t capacity) {
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        if (tiles.isOn()) tiles.discardRequests(queue, run);
    });
    tiles.begin(capacity, run.sinceResetS);
    selectAgain();
}

void PlanetState::beginNormals(std::uint32_t capacity, std::size_t heightBytes, const std::string& problem) {
    if (pager) resizeTiles(normals, 0);
    normalRoots.set(capacity, heightBytes, problem, run.log);
    if (!normalRoots.deriver()) return;
    // They are derived at once if every step must be the same on any machine.
    if (pager && settings.time == PagingTime::Clock && !run.log.keepsMoves) {
        if (normalRoots.follow(normals, run)) selectAgain();
    } else {
        finishNormalRoots();
    }
}

void PlanetState::finishNormalRoots() {
    normalRoots.finish(normals, run);
    if (pager) selectAgain();
}

void PlanetState::dropAll() {
    for (BlockPaging* kind : kinds()) kind->retryAll();
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        for (const PagingRequest& request : queue.cancelNotRenewed(PagingType::PageIn, noFrame))
            of(request.kind).withdraw(request, run);
        for (BlockPaging* kind : kinds()) kind->dropAll(queue, run);
    });
    pager->forgetAttempts();
    selectAgain();
}

// Withdraws the queued requests first, so that no loader takes them, and then discards the reads in progress.
void PlanetState::reset() {
    pager->withQueue([&](PagingQueue& queue) {
        for (const PagingRequest& request : queue.cancelNotRenewed(PagingType::PageIn, noFrame))
            of(request.kind).withdraw(request, run);
        queue.cancelNotRenewed(PagingType::PageOut, noFrame);
    });
    for (const PagingRequest& request : pager->abandonReads()) run.log.discardedRead(request, run.nowS);
    pager->forgetAttempts();
    run.sinceResetS = 0;
    for (BlockPaging* kind : kinds()) kind->reset(run);
    views.assign(1, {});
    forgetCourses();
    run.frame = 0;
    changed = true;
    run.log.moves = {};
}

// Requeues reads that were abandoned. No other request for their blocks can exist.
void PlanetState::requeue(std::vector<PagingRequest> givenUp) {
    if (run.log.keepsMoves) run.log.moves = {.gaveUp = true};
    pager->withQueue([&](PagingQueue& queue) {
        noteTaken(queue);
        for (PagingRequest& request : givenUp) {
            if (of(request.kind).isKept(request))
                queue.submit(std::move(request));
            else
                run.log.discardedRead(request, run.nowS);
        }
    });
}

// Makes the selections again after changes between steps, because their nodes and slots may no longer be
// valid.
void PlanetState::selectAgain() {
    heights.cancelYielding();
    if (run.frame > 0) select(0);
}

void PlanetState::noteTaken(const PagingQueue& lockedQueue) {
    const std::vector<BlockId> taken = pager->takeTaken(lockedQueue);
    std::vector<BlockId>& noted = run.log.moves.taken;
    if (run.log.keepsMoves) noted.insert(noted.end(), taken.begin(), taken.end());
}

}  // namespace planet
