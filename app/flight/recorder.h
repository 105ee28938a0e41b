// Records a flight over a planet: it is notified of each call to the planet and stores what a replay needs.
// Call it from the planet's thread.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/flight/flight_record.h"

namespace worldy {

// Returns the ids of the drawn chunks, ascending.
std::vector<planet::ChunkId> drawnIds(const planet::Selection& selection);

class Recorder {
public:
    // Resets the planet, so that a replay begins in the same state, and lets it keep its moves until stop().
    // The planet must have been opened from a chunk file.
    Recorder(planet::Planet& planet, std::string name);

    // Records a call. block is for RetryBlock.
    void called(planet::Planet& planet, FlightCall call, const planet::BlockId& block = {});
    // Records an announcement for the first view.
    void announced(planet::Planet& planet, std::span<const planet::AnnouncedView> path);
    // Records changed settings; may be called in every frame. Records the paging settings that the planet
    // actually has, which differ from the requested ones if the GPU is out of memory.
    void givenSettings(planet::Planet& planet, const ViewSettings& asked, bool pagingPaused);
    // Records a step with the priority factors of its views. A frame that exceeds the limits of a file is
    // dropped, and encoded() is full then.
    void stepped(planet::Planet& planet, std::span<const double> priorityFactors);

    const std::string& name() const { return name_; }
    void rename(std::string name) { name_ = std::move(name); }
    const FlightEncoder& encoded() const { return encoder_; }
    // Lets the planet discard its moves again.
    void stop(planet::Planet& planet) const;
    // A recording without frames is an Error.
    planet::Result<void> write(const std::filesystem::path& file, IfThere ifThere = IfThere::Replace) const;

private:
    std::string name_;
    FlightData data_;
    FlightEncoder encoder_;
    FlightFrame frame_;  // the calls since the last step
    std::optional<ViewSettings> settings_;
    bool pagingPaused_ = false;
    std::vector<std::vector<planet::ChunkId>> drawn_;  // ids by view, ascending
};

}  // namespace worldy
