// Reads flights: camera keys in a TOML file, or the path of the camera in a recorded flight. Any thread.
//
//     name = "Orbit to ground"
//     [[key]]
//     time_s = 0
//     latitude_deg = 20
//     longitude_deg = 60
//     altitude_m = 1.2e7     # above the planet's radius
//     heading_deg = 0
//     pitch_deg = -90
#pragma once

#include <filesystem>
#include <string_view>

#include "app/flight/flight_path.h"
#include "app/flight/flight_record.h"
#include "planet/base/result.h"

namespace worldy {

// Reads a TOML file of keys, or the path of a recorded .flight (app/flight/flight_record.h). The Error names
// the file, the key's number from 1 and the expected value.
planet::Result<FlightPath> loadFlightPath(const std::filesystem::path& file);
// Reads the text of a TOML file. place stands for the file name in errors.
planet::Result<FlightPath> flightPathFromText(std::string_view text, const std::filesystem::path& place);

// Returns the path of the camera in a recorded flight, with at least two keys and at most ten per second. If
// the camera jumped, for example to a bookmark, the path jumps too, with a key on either side.
planet::Result<FlightPath> pathOf(const FlightRecord& record, const std::filesystem::path& file);

}  // namespace worldy
