#include "app/measure/timeline_recorder.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "planet/planet_tools.h"

namespace worldy {

namespace {

std::optional<ChunkChangeKind> changeOf(planet::PagingOutcome outcome) {
    switch (outcome) {
        case planet::PagingOutcome::Loaded:
            return ChunkChangeKind::Came;
        case planet::PagingOutcome::Failed:
            return ChunkChangeKind::Failed;
        case planet::PagingOutcome::Evicted:
            return ChunkChangeKind::Evicted;
        case planet::PagingOutcome::Cancelled:
            break;
    }
    return std::nullopt;
}

}  // namespace

void TimelineRecorder::turn(bool on) {
    isOn_ = on;
    planet::recordSpans(on);
    timeline_.interrupt();
}

void TimelineRecorder::beginFrame(std::uint64_t number) {
    if (!isOn_) return;
    if (!hasBegun_) {
        hasBegun_ = true;
        planet::nameSpanThread("main");
        planet::recordSpans(true);
    }
    timeline_.beginFrame(number, planet::spanClockNs(), frameEndNs_);
}

void TimelineRecorder::noteStep(const planet::Planet& planet, const planet::LodChanges& changes,
                                const planet::PopMeter& pops, double timeS) {
    noteArrivals(planet);
    for (auto change = changes.recent().rbegin(); change != changes.recent().rend() && change->timeS == timeS;
         ++change)
        timeline_.add(
            change->type == planet::LodChangeType::Split ? ChunkChangeKind::Split : ChunkChangeKind::Merged,
            change->chunk);
    notePops(pops);
}

// A replay has a clock of its own, so pops are not found by their time.
void TimelineRecorder::notePops(const planet::PopMeter& pops) {
    const auto keyOf = [](const planet::PopEvent& pop) { return std::pair(pop.frame, pop.timeS); };
    const auto& events = pops.events();
    for (auto pop = events.rbegin(); pop != events.rend() && keyOf(*pop) != lastPop_; ++pop)
        if (planet::counts(*pop) && pop->jump.largestPx >= leastTimelinePopPx)
            timeline_.add(ChunkChangeKind::Popped, pop->chunk, pop->jump.largestPx);
    if (!events.empty()) lastPop_ = keyOf(events.back());
}

void TimelineRecorder::noteArrivals(const planet::Planet& planet) {
    const planet::PlanetInspector inspector = planet.inspect();
    const std::uint64_t count = inspector.pagingEventCount();
    if (&planet != planet_ || count < pagingEvents_) pagingEvents_ = 0;
    const std::deque<planet::PagingEvent>& history = inspector.pagingHistory();
    const std::uint64_t news = count - pagingEvents_;
    const auto kept = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(news, history.size()));
    if (isOn_) timeline_.missChanges(news - static_cast<std::uint64_t>(kept));
    for (auto event = history.end() - kept; event != history.end(); ++event)
        if (const auto kind = changeOf(event->outcome))
            timeline_.add(*kind, {event->parent, event->kind}, 1000 * event->readS);
    planet_ = &planet;
    pagingEvents_ = count;
}

void TimelineRecorder::endFrame() {
    if (!isOn_) return;
    frameEndNs_ = planet::spanClockNs();
    planet::drainSpans([&](const planet::SpanBatch& batch) { timeline_.add(batch); });
}

}  // namespace worldy
