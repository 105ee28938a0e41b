// Two settings or bakes over the same flight, in figures. Draws offscreen, in contexts of its own: any
// thread, one comparison a thread.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "app/flight/flight_path.h"
#include "app/measure/compare_table.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct ComparedSide {
    std::filesystem::path chunkFile;
    // Fly as they are, but for the camera's, which are A's, and for a bad disk: loads are waited for.
    ViewSettings settings;
};
using ComparedSides = std::array<ComparedSide, 2>;  // A and B

struct ComparisonPlan {
    ComparedSides sides;
    FlightPath path;
    int moments = 12;        // of the flight, >= 1
    double momentStepS = 0;  // seconds from one to the next; 0: evenly spread over the flight
    double popStepS = 1.0 / 60;
    PictureSize size;
};

// What is flown of a side, 0 or 1: the camera is one for both, and no disk is bad, since loads are waited
// for.
ComparedSide flownSide(const ComparisonPlan& plan, std::size_t index);

// Told again and again what share is done, [0, 1], by any thread, one at a time; false ends it with an Error
// of kind Cancelled.
using ComparisonWatch = std::function<bool(double share)>;

using ComparedPair = std::array<ComparedFigures, 2>;

// One side after the other: settled at each moment, what is drawn and held, its true error and its cracks;
// then flown with all loads on time for its pops. At last the frame times of both, in turn. The Error says
// what could not be opened, loaded or drawn, and of two planets of different radii.
planet::Result<ComparedPair> compareOverFlight(const ComparisonPlan& plan, const ComparisonWatch& goOn);

// Whether both can be looked at by the same camera. The Error names both radii.
planet::Result<void> checkSameRadius(double radiusM, double radiusOfBM);

// The moment of the flight at which the pictures differ at most pixels.
struct ComparedPictures {
    double timeS = 0;
    Picture a;
    Picture b;
    std::uint64_t pixels = 0;  // that differ by more than one 8-bit step in some channel
    int largestSteps = 0;
};
planet::Result<ComparedPictures> compareInPictures(const ComparisonPlan& plan, const ComparisonWatch& goOn);

// Both whole, side by side.
Picture besideEachOther(const Picture& a, const Picture& b);
// |a - b| of each channel times a gain, >= 0. Both of the same size.
Picture differenceOf(const Picture& a, const Picture& b, double gain);

}  // namespace worldy
