#include "app/flight/flight_replay.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "app/flight/recorder.h"
#include "app/flight/selection_hash.h"
#include "app/scene/scene_settings.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

using Ids = std::vector<planet::ChunkId>;
using Blocks = std::vector<planet::BlockId>;
using planet::PagingMoves;
using planet::Result;

template <class Id>
std::vector<Id> without(std::vector<Id> from, std::vector<Id> what) {
    std::sort(from.begin(), from.end());
    std::sort(what.begin(), what.end());
    std::vector<Id> rest;
    std::set_difference(from.begin(), from.end(), what.begin(), what.end(), std::back_inserter(rest));
    return rest;
}

void change(Ids& drawn, const FlownView& view) {
    Ids rest = without(drawn, view.vanished);
    rest.insert(rest.end(), view.appeared.begin(), view.appeared.end());
    std::sort(rest.begin(), rest.end());
    drawn = std::move(rest);
}

Blocks blocksOf(const std::vector<PagingMoves::Arrival>& arrivals) {
    Blocks blocks;
    for (const PagingMoves::Arrival& arrival : arrivals) blocks.push_back(arrival.block);
    return blocks;
}

// Returns the settings before those of the first frame, which contain all settings that existed at the time
// of the recording. Recordings older than the setting for retries were made without retries.
ViewSettings settingsBefore(const FlightRecord& record) {
    constexpr std::string_view assignment = "paging.retries=";
    ViewSettings settings;
    const auto namesRetries = [&](const CalledInFlight& called) {
        return std::any_of(called.settings.begin(), called.settings.end(),
                           [&](const std::string& one) { return one.starts_with(assignment); });
    };
    const std::vector<CalledInFlight>& calls = record.frames[0].calls;
    if (std::none_of(calls.begin(), calls.end(), namesRetries)) settings.paging.retries = 0;
    return settings;
}

}  // namespace

ReplayedPlanet headless(planet::Planet& planet) {
    return {planet, [](std::uint32_t, planet::StepsView) {},
            [&planet](const ViewSettings& settings, bool paused, planet::PagingTime time) {
                planet.setExaggeration(settings.surface.exaggeration);
                if (auto set = planet.setRegions(settings.regions.applied()); !set) return set;
                return planet.setPaging(pagingSettingsOf(settings, paused, time)).map([](bool) {});
            }};
}

Result<FlightReplay> FlightReplay::create(std::shared_ptr<const FlightRecord> record, ReplayPaging paging,
                                          std::vector<std::string> assignments) {
    ViewSettings settings;
    if (const Result<void> good = applyFlightSettings(assignments, settings); !good)
        return tl::unexpected(good.error());
    return FlightReplay(std::move(record), paging, std::move(assignments));
}

const planet::View& FlightReplay::view() const {
    return record_->frames[next_ > 0 ? next_ - 1 : 0].views[0].view;
}

planet::PagingTime FlightReplay::time() const {
    return paging_ == ReplayPaging::Simulated ? planet::PagingTime::Simulated : planet::PagingTime::Recorded;
}

planet::PagingSettings FlightReplay::pagingAtStart() const {
    ViewSettings settings = settingsBefore(*record_);
    bool paused = false;
    for (const CalledInFlight& called : record_->frames[0].calls) {
        if (called.call != FlightCall::Settings) continue;
        static_cast<void>(applyFlightSettings(called.settings, settings));
        paused = called.pagingPaused;
    }
    static_cast<void>(applyFlightSettings(assignments_, settings));
    return pagingSettingsOf(settings, paused, time());
}

void FlightReplay::rewind(planet::Planet& planet) {
    planet.tools().reset();
    planet.tools().keepMoves(true);
    settings_ = settingsBefore(*record_);
    next_ = 0;
    timeS_ = 0;
    drawn_.clear();
    different_ = 0;
    first_.reset();
}

void FlightReplay::follow(planet::Planet& planet, const PagingMoves& moves) const {
    // Moves that cannot be followed show up as differences.
    if (paging_ == ReplayPaging::AsRecorded) static_cast<void>(planet.tools().follow(moves));
}

Result<void> FlightReplay::repeat(const CalledInFlight& called, const ReplayedPlanet& replayed) {
    if (called.call == FlightCall::Settings) {
        // Both were checked when they were read, so they cannot fail.
        static_cast<void>(applyFlightSettings(called.settings, settings_));
        static_cast<void>(applyFlightSettings(assignments_, settings_));
        follow(replayed.planet, called.moves);
        return replayed.apply(settings_, called.pagingPaused, time());
    }
    follow(replayed.planet, called.moves);
    if (called.call == FlightCall::DropAll) replayed.planet.tools().dropAll();
    if (called.call == FlightCall::LoadOne) replayed.planet.tools().loadOne();
    if (called.call == FlightCall::RetryFailed) replayed.planet.tools().retryFailed();
    if (called.call == FlightCall::Announce) replayed.planet.announce(called.announced);
    if (called.call == FlightCall::RetryBlock) replayed.planet.tools().retryFailed(called.block);
    return {};
}

Result<void> FlightReplay::step(const ReplayedPlanet& replayed) {
    const FlightFrame& frame = record_->frames[next_];
    planet::Planet& planet = replayed.planet;
    for (const CalledInFlight& called : frame.calls) {
        if (Result<void> done = repeat(called, replayed); !done) return done;
    }
    follow(planet, frame.moves);
    std::vector<planet::ViewInput> views;
    for (const FlownView& view : frame.views)
        views.push_back({view.view, lodSettingsOf(settings_), view.priorityFactor,
                         colourSettingsOf(settings_), normalSettingsOf(settings_)});
    planet.tools().takeMoves();  // discards the moves of the calls, which are not compared
    planet.step(views, replayed.upload, frame.elapsedS);
    timeS_ += frame.elapsedS;
    ++next_;
    compare(planet, frame);
    return {};
}

void FlightReplay::compare(planet::Planet& planet, const FlightFrame& frame) {
    drawn_.resize(frame.views.size());
    for (std::size_t v = 0; v < frame.views.size(); ++v) change(drawn_[v], frame.views[v]);
    const PagingMoves moves = planet.tools().takeMoves();
    ReplayDifference difference{next_ - 1, timeS_, {}, {}, {}};
    const auto differs = [&](const char* what, const Blocks& replayed, const Blocks& recorded) {
        difference.what = what;
        difference.onlyReplayed = without(replayed, recorded);
        difference.onlyRecorded = without(recorded, replayed);
    };
    if (selectionHashOf(planet) != frame.selectionHash) {
        for (std::size_t v = 0; v < frame.views.size(); ++v) {
            const Ids now = drawnIds(planet.selection(v));
            if (v == 0 || now != drawn_[v])
                differs("selection", {now.begin(), now.end()}, {drawn_[v].begin(), drawn_[v].end()});
            if (now != drawn_[v]) break;
        }
    } else if (moves.requested != frame.moves.requested) {
        differs("requests", moves.requested, frame.moves.requested);
    } else if (moves.arrived != frame.moves.arrived) {
        differs("arrivals", blocksOf(moves.arrived), blocksOf(frame.moves.arrived));
    }
    if (difference.what.empty()) return;
    if (!first_) first_ = std::move(difference);
    ++different_;
}

namespace {

// Tracks the drawn chunks from frame to frame at a cost proportional to the changes. A chunk is split if a
// descendant of it is drawn. Counts the same splits and merges as planet::LodChanges, which takes whole
// selections.
class DrawnBelow {
public:
    FlightChange change(std::size_t frame, const FlownView& view) {
        std::unordered_map<planet::ChunkId, std::int64_t> moved;
        for (const planet::ChunkId& id : view.vanished) addAbove(id, -1, moved);
        for (const planet::ChunkId& id : view.appeared) addAbove(id, 1, moved);
        FlightChange found{frame, 0, 0};
        Ids ended;
        for (const auto& [id, by] : moved) {
            std::int64_t& below = below_[id];
            const bool was = below > 0, is = below + by > 0;
            below += by;
            if (!was && is && coversOne(id)) ++found.splits;
            if (was && !is) ended.push_back(id);
            if (below == 0) below_.erase(id);
        }
        for (const planet::ChunkId& id : view.vanished) drawn_.erase(id);
        drawn_.insert(view.appeared.begin(), view.appeared.end());
        for (const planet::ChunkId& id : ended) found.merges += coversOne(id);
        return found;
    }

private:
    static void addAbove(planet::ChunkId id, int by, std::unordered_map<planet::ChunkId, std::int64_t>& to) {
        while (id.level > 0) {
            id = planet::parentOf(id);
            to[id] += by;
        }
    }
    // Returns true if the chunk or one of its ancestors is drawn.
    bool coversOne(planet::ChunkId id) const {
        while (drawn_.count(id) == 0) {
            if (id.level == 0) return false;
            id = planet::parentOf(id);
        }
        return true;
    }

    std::unordered_set<planet::ChunkId> drawn_;
    std::unordered_map<planet::ChunkId, std::int64_t> below_;  // drawn descendants of each chunk
};

}  // namespace

std::vector<FlightChange> changesIn(const FlightRecord& record) {
    std::vector<FlightChange> all;
    DrawnBelow drawn;
    for (std::size_t i = 0; i < record.frames.size(); ++i) {
        const FlownView& view = record.frames[i].views[0];
        if (view.appeared.empty() && view.vanished.empty()) continue;
        const FlightChange found = drawn.change(i, view);
        if (found.splits + found.merges > 0 && i > 0) all.push_back(found);
    }
    return all;
}

}  // namespace worldy
