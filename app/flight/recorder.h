// Records a flight while a planet is flown over: told of each call to the planet, it keeps what a replay
// needs. One thread, the planet's.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/flight/flight_record.h"

namespace worldy {

// The chunks of a draw list, ascending.
std::vector<planet::ChunkId> drawnIds(const planet::Selection& selection);

class Recorder {
public:
    // Starts the planet anew, so that a replay begins where this does, and has it keep its moves until
    // stop(). The planet must be of a chunk file.
    Recorder(planet::Planet& planet, std::string name);

    // After each call, in the order of the calls; settings may be told of in every frame. Of paging what the
    // planet has is recorded, which is not what was asked for where the GPU had no room for it.
    // block: of RetryBlock.
    void called(planet::Planet& planet, FlightCall call, const planet::BlockId& block = {});
    void givenSettings(planet::Planet& planet, const ViewSettings& asked, bool pagingPaused);
    // priorityFactors: of the step's views. A frame that no file may hold is left out, and encoded() is full.
    void stepped(planet::Planet& planet, std::span<const double> priorityFactors);

    const std::string& name() const { return name_; }
    void rename(std::string name) { name_ = std::move(name); }
    const FlightEncoder& encoded() const { return encoder_; }
    // The planet keeps no more moves.
    void stop(planet::Planet& planet) const;
    // The Error also says that there is no frame to write.
    planet::Result<void> write(const std::filesystem::path& file, IfThere ifThere = IfThere::Replace) const;

private:
    std::string name_;
    FlightData data_;
    FlightEncoder encoder_;
    FlightFrame frame_;  // what was called since the last step
    std::optional<ViewSettings> settings_;
    bool pagingPaused_ = false;
    std::vector<std::vector<planet::ChunkId>> drawn_;  // by view, ascending
};

}  // namespace worldy
