// Replays a recorded flight: makes the same calls to a planet in the same order, and compares its behaviour
// with the recording. It draws nothing and reads no clock. Call it from the planet's thread.
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

// AsRecorded: each block arrives in the recorded frame. Simulated: the recorded fault injection settings and
// seed decide when it arrives, which gives the same frames only if the flight was recorded in simulated time.
enum class ReplayPaging : std::uint8_t { AsRecorded, Simulated };

// The planet that a replay drives.
struct ReplayedPlanet {
    planet::Planet& planet;
    planet::UploadChunk upload;
    // Applies the settings to the planet and to the renderer.
    std::function<planet::Result<void>(const ViewSettings&, bool pagingPaused, planet::PagingTime)> apply;
};
// Returns a replayed planet without a renderer.
ReplayedPlanet headless(planet::Planet& planet);

// The first frame that differs from the recording.
struct ReplayDifference {
    std::size_t frame = 0;  // counted from 0
    double timeS = 0;       // end of the frame, from the start of the recording
    std::string what;       // the first of "selection", "requests" and "arrivals" that differs
    // The drawn chunks, or the requested or arrived blocks. Both are empty if only the order, morphs or
    // outcomes differ.
    std::vector<planet::BlockId> onlyReplayed;
    std::vector<planet::BlockId> onlyRecorded;
};

class FlightReplay {
public:
    // assignments: settings that override the recorded ones, "lod.tau_px=3". An invalid one is an Error that
    // names it.
    static planet::Result<FlightReplay> create(std::shared_ptr<const FlightRecord> record,
                                               ReplayPaging paging,
                                               std::vector<std::string> assignments = {});

    const FlightRecord& record() const { return *record_; }
    std::shared_ptr<const FlightRecord> sharedRecord() const { return record_; }
    ReplayPaging paging() const { return paging_; }
    std::size_t next() const { return next_; }  // index of the next frame; number of frames done
    bool atEnd() const { return next_ == record_->frames.size(); }
    double timeS() const { return timeS_; }  // end of the last frame
    const ViewSettings& settings() const { return settings_; }
    // Returns the first view of the last frame, or of the first frame before any step.
    const planet::View& view() const;

    std::size_t framesDifferent() const { return different_; }
    const std::optional<ReplayDifference>& firstDifference() const { return first_; }

    // Returns the settings with which the planet must be opened, or which it must be given before rewind().
    planet::PagingSettings pagingAtStart() const;

    // Resets the planet, which then keeps its moves, and goes back to the first frame. Call it before the
    // first step too.
    void rewind(planet::Planet& planet);
    // Makes the next frame. Settings that the planet refuses are an Error.
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
    std::vector<std::vector<planet::ChunkId>> drawn_;  // recorded chunks by view, ascending
    std::size_t different_ = 0;
    std::optional<ReplayDifference> first_;
};

// The splits and merges of the first view in a frame, derived from the recorded chunks.
struct FlightChange {
    std::size_t frame = 0;
    int splits = 0;
    int merges = 0;
};
std::vector<FlightChange> changesIn(const FlightRecord& record);

}  // namespace worldy
