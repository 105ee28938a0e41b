// Replays a recorded flight: gives a planet the same calls in the same order, and compares what it does with
// what was recorded. Draws nothing and has no clock; one thread, the planet's.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/flight/flight_record.h"
#include "app/settings/view_settings.h"
#include "planet/planet.h"

namespace worldy {

// AsRecorded: each block arrives in the frame in which it did. Simulated: when the recorded bad disk and seed
// say, which is the same only where the flight was recorded by simulated time.
enum class ReplayPaging : std::uint8_t { AsRecorded, Simulated };

// What a replay moves.
struct ReplayedPlanet {
    planet::Planet& planet;
    planet::UploadChunk upload;
    // Gives the planet its settings, and draws by them.
    std::function<planet::Result<void>(const ViewSettings&, bool pagingPaused, planet::PagingTime)> apply;
};
// Without anything to draw with.
ReplayedPlanet headless(planet::Planet& planet);

// The first frame that was not as recorded.
struct ReplayDifference {
    std::size_t frame = 0;  // from 0
    double timeS = 0;       // from the recording's start, its end
    std::string what;       // "selection", "requests" or "arrivals", the first of these
    std::vector<planet::BlockId>
        onlyReplayed;  // chunks drawn, blocks asked for or arrived; both may be empty where
    std::vector<planet::BlockId> onlyRecorded;  // order, morphs or outcomes alone differ
};

class FlightReplay {
public:
    // assignments: settings that are held at other values than the recorded ones, "lod.tau_px=3". The Error
    // names one that is wrong.
    static planet::Result<FlightReplay> create(std::shared_ptr<const FlightRecord> record,
                                               ReplayPaging paging,
                                               std::vector<std::string> assignments = {});

    const FlightRecord& record() const { return *record_; }
    std::shared_ptr<const FlightRecord> sharedRecord() const { return record_; }
    ReplayPaging paging() const { return paging_; }
    std::size_t next() const { return next_; }  // the frame that step() makes; frames done
    bool atEnd() const { return next_ == record_->frames.size(); }
    double timeS() const { return timeS_; }  // of the frame done last
    const ViewSettings& settings() const { return settings_; }
    // Of the frame done last, or of the first where none is.
    const planet::View& view() const;

    std::size_t framesDifferent() const { return different_; }
    const std::optional<ReplayDifference>& firstDifference() const { return first_; }

    // With which the planet is opened, or given before rewind().
    planet::PagingSettings pagingAtStart() const;

    // Back to before the first frame: the planet starts anew and keeps its moves. Also to be called first.
    void rewind(planet::Planet& planet);
    // Makes the next frame. The Error says which settings the planet has refused.
    planet::Result<void> step(const ReplayedPlanet& replayed);

private:
    FlightReplay(std::shared_ptr<const FlightRecord> record, ReplayPaging paging,
                 std::vector<std::string> assignments)
        : record_(std::move(record)), paging_(paging), assignments_(std::move(assignments)) {}
    planet::PagingTime time() const;
    planet::Result<void> repeat(const CalledInFlight& called, const ReplayedPlanet& replayed);
    void follow(planet::Planet& planet, const planet::PagingMoves& moves) const;
    void compare(planet::Planet& planet, const FlightFrame& frame);

    std::shared_ptr<const FlightRecord> record_;
    ReplayPaging paging_;
    std::vector<std::string> assignments_;
    ViewSettings settings_;
    std::size_t next_ = 0;
    double timeS_ = 0;
    std::vector<std::vector<planet::ChunkId>> drawn_;  // as recorded, by view, ascending
    std::size_t different_ = 0;
    std::optional<ReplayDifference> first_;
};

// Splits and merges of the first view in each frame, told from what was recorded as drawn.
struct FlightChange {
    std::size_t frame = 0;
    int splits = 0;
    int merges = 0;
};
std::vector<FlightChange> changesIn(const FlightRecord& record);

}  // namespace worldy
