#include "planet/measure/pop_meter.h"

#include <algorithm>
#include <cmath>

#include "planet/base/parallel.h"
#include "planet/base/percentile.h"
#include "planet/base/stopwatch.h"
#include "planet/select/screen_error.h"

namespace planet {

// A place whose level has changed: a coarser chunk of one frame, and the chunks at its place in the other.
struct PopMeter::Switch {
    ChunkId chunk;
    bool merged = false;        // the coarser one is drawn now
    std::uint32_t coarser = 0;  // index of the coarser chunk in its frame
    std::vector<std::uint32_t> finer;
    Why why{};
    SurfaceJump jump{};
    double besidePx = 0;
};

namespace {

// Returns the drawn ancestor of a chunk; null if there is none.
const std::uint32_t* drawnAbove(const ChunkTable& places, ChunkId id) {
    while (id.level > 0) {
        id = parentOf(id);
        if (const std::uint32_t* found = places.find(id)) return found;
    }
    return nullptr;
}

// Returns the drawn chunk that is the given one or an ancestor; null if there is none.
const std::uint32_t* drawnOver(const ChunkTable& places, const ChunkId& id) {
    const std::uint32_t* found = places.find(id);
    return found ? found : drawnAbove(places, id);
}

// Returns whether a chunk needs children that are not resident.
bool isWaiting(const DrawItem& item, ChildrenState children, const LodSettings& settings) {
    return children != ChildrenState::None && children != ChildrenState::Resident &&
           isTooCoarse(item, settings);
}

bool isStitched(const LodSettings& settings) {
    return settings.seams == SeamMode::Stitched;
}

// Returns whether a chunk needs its resident children and is drawn nevertheless, because of a stitched seam.
bool isHeldBack(const DrawItem& item, ChildrenState children, const LodSettings& settings) {
    return isStitched(settings) && children == ChildrenState::Resident && isTooCoarse(item, settings);
}

// Returns whether two settings choose the same levels for one camera. Morphs and skirts do not change levels.
bool chooseAlike(const LodSettings& a, const LodSettings& b) {
    return a.metric == b.metric && a.tauPx == b.tauPx && a.hysteresis == b.hysteresis &&
           a.maxLevel == b.maxLevel && a.frustumCulling == b.frustumCulling &&
           a.horizonCulling == b.horizonCulling && isStitched(a) == isStitched(b);
}

bool projectAlike(const View& a, const View& b) {
    return a.horizontalFovRad == b.horizontalFovRad && a.widthPx == b.widthPx && a.heightPx == b.heightPx;
}

// Returns whether a split chunk stays split by its own error.
bool keepsSplit(const ChildrenRequest& split, const LodSettings& settings) {
    return split.parentId.level<settings.maxLevel&& static_cast<double>(split.priority)> 1 -
           settings.hysteresis;
}

bool sameEdge(const DrawItem& a, const DrawItem& b, Edge edge) {
    const auto e = static_cast<std::size_t>(edge);
    return a.coarserBy[e] == b.coarserBy[e] && a.edgeMorph[e] == b.edgeMorph[e] && a.morph == b.morph;
}

bool isWithin(const ChunkId& id, const ChunkId& above) {
    return ancestorOf(id, above.level) == above;
}

}  // namespace

const char* popCauseName(PopCause cause) {
    constexpr std::array<const char*, popCauseCount> names = {
        "camera moved", "settings changed", "load finished", "evicted", "seam limit", "culling"};
    return names[static_cast<std::size_t>(cause)];
}

const char* popNote(const PopEvent& event) {
    if (!event.measured) return "not measured";
    if (event.jump.underSea) return "under sea";
    if (event.jump.places == 0) return "outside picture";
    return event.afterJump ? "after jump" : "";
}

bool isWorsePop(const PopEvent& a, const PopEvent& b) {
    if (counts(a) != counts(b)) return counts(a);
    if (a.jump.largestPx != b.jump.largestPx) return a.jump.largestPx > b.jump.largestPx;
    return a.frame != b.frame ? a.frame < b.frame : a.chunk < b.chunk;
}

PopMeter::Frame PopMeter::keep(const ChunkTree& tree, const Selection& selection, const View& view,
                               const LodSettings& settings) {
    Frame frame;
    frame.chunks.reserve(selection.draw.size());
    frame.places = ChunkTable(selection.draw.size());
    for (const DrawItem& item : selection.draw) {
        const ChunkNode& node = tree.nodes[item.node];
        frame.places.add(item.id, static_cast<std::uint32_t>(frame.chunks.size()));
        frame.chunks.push_back({item, node.heights, node.childrenState});
    }
    frame.view = view;
    frame.settings = settings;
    frame.exaggeration = tree.exaggeration;
    frame.regions = tree.regions;
    return frame;
}

void PopMeter::add(const ChunkTree& tree, const Selection& selection, const View& view,
                   const LodSettings& settings, double timeS, const PopConditions& conditions) {
    Frame now = keep(tree, selection, view, settings);
    if (timeS < nowS_) clear();
    now.conditions = conditions;
    now.conditions.cameraJumped |= !before_;
    nowS_ = timeS;
    std::vector<Switch> switches;
    if (before_) switches = findSwitches(now);
    if (!switches.empty()) {
        const Stopwatch measuring;
        if (before_->exaggeration == now.exaggeration) {
            measure(tree.shape, now, switches);
            measureBeside(tree.shape, now, switches);
        }
        totals_.measuringS += measuring.elapsedS();
        now.drawn = std::make_shared<DrawnFrame>(DrawnFrame{selection.draw, view, isStitched(settings)});
        for (Switch& change : switches) {
            change.why = whyOf(now, change);
            note(now, change);
        }
    }
    decided_ = findDecided(now, selection, switches);
    noteLate(now);
    forgetOld();
    before_ = std::move(now);
    ++frame_;
}

void PopMeter::clear() {
    *this = {};
}

std::vector<PopMeter::Switch> PopMeter::findSwitches(const Frame& now) {
    std::vector<Switch> switches;
    std::unordered_map<ChunkId, std::size_t> known;
    // Finds the chunks of one frame that lie below a chunk of the other frame and are not drawn there.
    const auto find = [&](const Frame& fine, const Frame& coarse, bool merged, std::uint64_t& unmatched) {
        for (std::uint32_t i = 0; i < fine.chunks.size(); ++i) {
            const ChunkId& id = fine.chunks[i].item.id;
            if (coarse.places.contains(id)) continue;
            const std::uint32_t* above = drawnAbove(coarse.places, id);
            if (!above) {
                ++unmatched;
                continue;
            }
            const ChunkId& chunk = coarse.chunks[*above].item.id;
            const auto [at, isNew] = known.try_emplace(chunk, switches.size());
            if (isNew) switches.push_back({chunk, merged, *above, {}});
            switches[at->second].finer.push_back(i);
        }
    };
    std::uint64_t came = 0;
    std::uint64_t went = 0;
    find(now, *before_, false, came);
    find(*before_, now, true, went);
    // The coarser chunk of a switch has no drawn ancestor in the other frame, so it was counted: subtract it.
    for (const Switch& change : switches) --(change.merged ? came : went);
    totals_.cameIntoView += came;
    totals_.wentOutOfView += went;
    std::sort(switches.begin(), switches.end(),
              [](const Switch& a, const Switch& b) { return a.chunk < b.chunk; });
    return switches;
}

void PopMeter::measure(const PlanetShape& shape, const Frame& now, std::vector<Switch>& switches) const {
    const auto drawnChunk = [](const Frame& frame, std::uint32_t place) {
        const KeptChunk& chunk = frame.chunks[place];
        return DrawnChunk{chunk.item, chunk.heights, isStitched(frame.settings)};
    };
    parallelFor(switches.size(), [&](std::size_t i) {
        Switch& change = switches[i];
        const Frame& coarse = change.merged ? now : *before_;
        const Frame& fine = change.merged ? *before_ : now;
        std::vector<DrawnChunk> finer;
        for (const std::uint32_t place : change.finer) finer.push_back(drawnChunk(fine, place));
        change.jump = surfaceJump(shape, drawnChunk(coarse, change.coarser), finer, change.merged, now.view,
                                  now.conditions.seaM);
    });
}

// Returns whether a place that has changed is drawn in both frames. The coarser chunk draws all of it; the
// finer chunks draw the part that is not culled.
bool PopMeter::isDrawn(const Frame& now, const Switch& change, const ChunkId& place) const {
    const Frame& fine = change.merged ? *before_ : now;
    return std::any_of(change.finer.begin(), change.finer.end(), [&](std::uint32_t i) {
        const ChunkId& id = fine.chunks[i].item.id;
        return id.level < place.level ? isWithin(place, id) : isWithin(id, place);
    });
}

// Measures the edges of unchanged chunks: an edge follows its neighbour, so it may jump when the neighbour is
// exchanged.
void PopMeter::measureBeside(const PlanetShape& shape, const Frame& now,
                             std::vector<Switch>& switches) const {
    ChunkTable switched(switches.size());
    for (std::uint32_t i = 0; i < switches.size(); ++i) switched.add(switches[i].chunk, i);
    const auto drawnChunk = [](const Frame& frame, const KeptChunk& chunk) {
        return DrawnChunk{chunk.item, chunk.heights, isStitched(frame.settings)};
    };
    for (const KeptChunk& chunk : now.chunks) {
        const std::uint32_t* place = before_->places.find(chunk.item.id);
        if (!place) continue;
        const KeptChunk& was = before_->chunks[*place];
        for (std::size_t e = 0; e < edgeCount; ++e) {
            const Edge edge = static_cast<Edge>(e);
            if (sameEdge(was.item, chunk.item, edge)) continue;
            const ChunkId neighbour = neighbourOf(chunk.item.id, edge);
            const std::uint32_t* beside = drawnOver(switched, neighbour);
            // An edge leaves the view together with its neighbour.
            if (!beside || !isDrawn(now, switches[*beside], neighbour)) continue;
            const SurfaceJump jump = edgeJump(shape, drawnChunk(*before_, was), drawnChunk(now, chunk), edge,
                                              now.view, now.conditions.seaM);
            double& largestPx = switches[*beside].besidePx;
            largestPx = std::max(largestPx, jump.largestPx);
        }
    }
}

bool PopMeter::neighbourCameOrWent(const Frame& now, const ChunkId& chunk) const {
    for (std::size_t e = 0; e < edgeCount; ++e) {
        const ChunkId other = neighbourOf(chunk, static_cast<Edge>(e));
        if ((drawnOver(before_->places, other) == nullptr) != (drawnOver(now.places, other) == nullptr))
            return true;
    }
    return false;
}

PopCause PopMeter::cameraOrSettings(const Frame& now) const {
    const bool same =
        !before_ || (chooseAlike(before_->settings, now.settings) && projectAlike(before_->view, now.view) &&
                     before_->exaggeration == now.exaggeration && before_->regions == now.regions);
    return same ? PopCause::CameraMoved : PopCause::SettingsChanged;
}

PopMeter::Why PopMeter::whyOf(const Frame& now, const Switch& change) const {
    const bool jumped = now.conditions.cameraJumped;
    const Frame& coarse = change.merged ? now : *before_;
    const KeptChunk& coarser = coarse.chunks[change.coarser];
    if (isWaiting(coarser.item, coarser.children, coarse.settings)) {
        if (change.merged) return {PopCause::Evicted, jumped};
        return {PopCause::LoadFinished, jumped || decided_.loadsAfterJump.contains(change.chunk)};
    }
    const auto& decided = change.merged ? decided_.merges : decided_.splits;
    if (const auto earlier = decided.find(change.chunk); earlier != decided.end()) return earlier->second;
    if (cameraOrSettings(now) == PopCause::SettingsChanged) return {PopCause::SettingsChanged, jumped};
    if (isHeldBack(coarser.item, coarser.children, coarse.settings)) {
        const bool culling = neighbourCameOrWent(now, change.chunk);
        return {culling ? PopCause::Culling : PopCause::SeamLimit, jumped};
    }
    // With resident children, hysteresis would have kept it split.
    const double leastPx = coarse.settings.tauPx * static_cast<double>(coarser.item.tauFactor) *
                           (1 - coarse.settings.hysteresis);
    if (change.merged && coarser.children != ChildrenState::Resident &&
        static_cast<double>(coarser.item.epsPx) > leastPx)
        return {PopCause::Evicted, jumped};
    return {PopCause::CameraMoved, jumped};
}

// Returns the switch of this frame that replaced a coarser chunk by this one; null if there is none.
const PopMeter::Switch* PopMeter::switchAbove(const ChunkId& chunk, std::span<const Switch> switches) const {
    const std::uint32_t* above = before_ ? drawnAbove(before_->places, chunk) : nullptr;
    if (!above) return nullptr;
    const ChunkId& split = before_->chunks[*above].item.id;
    const auto found =
        std::lower_bound(switches.begin(), switches.end(), split,
                         [](const Switch& change, const ChunkId& id) { return change.chunk < id; });
    return found != switches.end() && found->chunk == split ? &*found : nullptr;
}

// Returns the cause for a drawn chunk whose split is due and pending from this frame on.
PopMeter::Why PopMeter::whyOfWaiting(const Frame& now, const ChunkId& chunk,
                                     std::span<const Switch> switches) const {
    const bool jumped = now.conditions.cameraJumped;
    if (const std::uint32_t* place = before_ ? before_->places.find(chunk) : nullptr) {
        const KeptChunk& was = before_->chunks[*place];
        if (isWaiting(was.item, was.children, before_->settings))
            return {PopCause::LoadFinished, jumped || decided_.loadsAfterJump.contains(chunk)};
        const PopCause cause = cameraOrSettings(now);
        if (cause == PopCause::SettingsChanged || !isHeldBack(was.item, was.children, before_->settings))
            return {cause, jumped};
        return {neighbourCameOrWent(now, chunk) ? PopCause::Culling : PopCause::SeamLimit, jumped};
    }
    // The chunk came from a split in this frame and will be split further.
    if (const Switch* above = switchAbove(chunk, switches)) return above->why;
    return {cameraOrSettings(now), jumped};
}

PopMeter::Decided PopMeter::findDecided(const Frame& now, const Selection& selection,
                                        std::span<const Switch> switches) const {
    Decided decided;
    for (const KeptChunk& chunk : now.chunks) {
        const ChunkId& id = chunk.item.id;
        if (!isWaiting(chunk.item, chunk.children, now.settings)) continue;
        bool afterJump = now.conditions.cameraJumped || decided_.loadsAfterJump.contains(id);
        if (!afterJump && !(before_ && before_->places.contains(id))) {
            const Switch* above = switchAbove(id, switches);
            afterJump = above && above->why.afterJump;
        }
        if (afterJump) decided.loadsAfterJump.insert(id);
    }
    if (!now.settings.morph || now.settings.fadeS == 0) return decided;
    // Parents come first: the merges below a merge have its cause.
    for (const ChildrenRequest& split : selection.splits) {
        const ChunkId& id = split.parentId;
        const auto above = id.level > 0 ? decided.merges.find(parentOf(id)) : decided.merges.end();
        const bool keeps = keepsSplit(split, now.settings);
        if (keeps && above == decided.merges.end()) continue;
        const auto earlier = decided_.merges.find(id);
        const Why why = earlier != decided_.merges.end() ? earlier->second
                        : keeps                          ? above->second
                                : Why{cameraOrSettings(now), now.conditions.cameraJumped};
        decided.merges.emplace(id, why);
    }
    for (const KeptChunk& chunk : now.chunks) {
        if (!chunk.item.splitWaits) continue;
        const ChunkId& id = chunk.item.id;
        const auto earlier = decided_.splits.find(id);
        decided.splits.emplace(
            id, earlier != decided_.splits.end() ? earlier->second : whyOfWaiting(now, id, switches));
    }
    return decided;
}

void PopMeter::note(const Frame& now, const Switch& change) {
    const Frame& coarse = change.merged ? now : *before_;
    const Frame& fine = change.merged ? *before_ : now;
    if (!before_->drawn) {
        auto drawn = std::make_shared<DrawnFrame>();
        for (const KeptChunk& chunk : before_->chunks) drawn->items.push_back(chunk.item);
        drawn->view = before_->view;
        drawn->stitched = isStitched(before_->settings);
        before_->drawn = std::move(drawn);
    }
    for (const auto& drawn : {before_->drawn, now.drawn}) {
        if (!drawnFrames_.empty() && (drawnFrames_.back() == drawn)) continue;
        if (drawnFrames_.size() > 1 && *(drawnFrames_.rbegin() + 1) == drawn) continue;
        drawnFrames_.push_back(drawn);
        keptItems_ += drawn->items.size();
    }
    PopEvent event;
    event.timeS = nowS_;
    event.frame = frame_;
    event.chunk = change.chunk;
    event.cause = change.why.cause;
    event.afterJump = change.why.afterJump;
    event.measured = before_->exaggeration == now.exaggeration;
    event.jump = change.jump;
    event.besidePx = change.besidePx;
    event.viewBefore = before_->view;
    event.view = now.view;
    event.frameBefore = before_->drawn;
    event.frameAfter = now.drawn;
    int finest = 0;
    for (const std::uint32_t place : change.finer) {
        const DrawItem& item = fine.chunks[place].item;
        finest = std::max<int>(finest, item.id.level);
        (change.merged ? event.before : event.after).push_back(item);
    }
    (change.merged ? event.after : event.before).push_back(coarse.chunks[change.coarser].item);
    event.fromLevel = change.merged ? finest : change.chunk.level;
    event.toLevel = change.merged ? change.chunk.level : finest;
    ++totals_.switches;
    ++totals_.byCause[static_cast<std::size_t>(event.cause)];
    if (!event.measured)
        ++totals_.notMeasured;
    else if (event.jump.underSea)
        ++totals_.underSea;
    else if (event.jump.places == 0)
        ++totals_.outsidePicture;
    else
        ++(event.afterJump ? totals_.afterJump : totals_.counted);
    if (counts(event)) totals_.worstPx = std::max(totals_.worstPx, event.jump.largestPx);
    if (!event.afterJump) totals_.worstBesidePx = std::max(totals_.worstBesidePx, event.besidePx);
    events_.push_back(std::move(event));
}

void PopMeter::endLate(const Frame& now, LateArrival& arrival) const {
    arrival.untilS = nowS_;
    const ChunkId& id = arrival.chunk;
    if (drawnOver(now.places, id)) {
        arrival.end = LateEnd::NotWanted;
        return;
    }
    const bool replaced = std::any_of(now.chunks.begin(), now.chunks.end(), [&](const KeptChunk& chunk) {
        return chunk.item.id.level > id.level && isWithin(chunk.item.id, id);
    });
    arrival.end = replaced ? LateEnd::Loaded : LateEnd::OutOfView;
}

void PopMeter::noteLate(const Frame& now) {
    late_.resize(late_.size() - std::min(open_.size(), late_.size()));
    std::unordered_map<ChunkId, LateArrival> open;
    for (const KeptChunk& chunk : now.chunks) {
        const DrawItem& item = chunk.item;
        if (!isWaiting(item, chunk.children, now.settings)) continue;
        const auto known = open_.find(item.id);
        LateArrival arrival = known != open_.end() ? known->second : LateArrival{item.id, nowS_};
        if (known == open_.end()) ++totals_.late;
        ++arrival.frames;
        arrival.untilS = nowS_;
        if (static_cast<double>(item.epsPx) > arrival.worstEpsPx) {
            arrival.worstEpsPx = static_cast<double>(item.epsPx);
            arrival.tauPx = now.settings.tauPx;
        }
        open.emplace(item.id, arrival);
    }
    const std::size_t ended = late_.size();
    for (auto& [id, arrival] : open_) {
        if (open.contains(id)) continue;
        endLate(now, arrival);
        late_.push_back(arrival);
    }
    const auto byChunk = [](const LateArrival& a, const LateArrival& b) { return a.chunk < b.chunk; };
    std::sort(late_.begin() + static_cast<std::ptrdiff_t>(ended), late_.end(), byChunk);
    open_ = std::move(open);
    const std::size_t firstOpen = late_.size();
    for (const auto& [id, arrival] : open_) late_.push_back(arrival);
    std::sort(late_.begin() + static_cast<std::ptrdiff_t>(firstOpen), late_.end(), byChunk);
}

void PopMeter::forgetOld() {
    const double oldestS = nowS_ - keptS;
    while (!events_.empty() && (events_.front().timeS < oldestS || events_.size() > mostEvents))
        events_.pop_front();
    const auto ended = [&] { return late_.size() - std::min(open_.size(), late_.size()); };
    while (ended() > 0 && (late_.front().untilS < oldestS || late_.size() > mostLate)) late_.pop_front();
    while (keptItems_ > mostKeptItems && drawnFrames_.size() > 2) {
        keptItems_ -= drawnFrames_.front()->items.size();
        drawnFrames_.pop_front();
    }
}

double PopMeter::percentilePx(double share) const {
    std::vector<double> values;
    for (const PopEvent& event : events_) {
        if (counts(event)) values.push_back(event.jump.largestPx);
    }
    return percentileOf(values, share);
}

double PopMeter::measuredUsPerSwitch() const {
    return totals_.switches > 0 ? 1e6 * totals_.measuringS / static_cast<double>(totals_.switches) : 0;
}

}  // namespace planet
