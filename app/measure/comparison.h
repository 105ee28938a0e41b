// Compares two settings or bakes over the same flight. Draws offscreen in contexts of its own: any thread,
// one comparison per thread.
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
    ViewSettings settings;  // flown as flownSide() says
};

struct ComparisonPlan {
    std::array<ComparedSide, 2> sides;  // A and B
    FlightPath path;
    int moments = 12;        // number of sample frames, >= 1
    double momentStepS = 0;  // seconds between sample frames; 0: evenly spread over the flight
    double popStepS = 1.0 / 60;
    PictureSize size;
};

// Returns side 0 or 1 as it is flown: with the camera settings of A, without fill light, and without I/O
// fault injection, because the flight waits for loads.
ComparedSide flownSide(const ComparisonPlan& plan, std::size_t index);

// Called often with the completed share, [0, 1], by one thread at a time, which may be any. Returning false
// ends the comparison with an Error of kind Cancelled.
using ComparisonWatch = std::function<bool(double share)>;

using ComparedPair = std::array<ComparedFigures, 2>;

// Measures one side after the other: settled at each sample frame the figures, the true error and the cracks,
// then the pops over the flight with all loads on time. Measures the frame times of both at the end, in
// alternation. Different radii are an Error.
planet::Result<ComparedPair> compareOverFlight(const ComparisonPlan& plan, const ComparisonWatch& goOn);

// Different radii are an Error that names both, because one camera cannot show both planets.
planet::Result<void> checkSameRadius(double radiusM, double radiusOfBM);

// The sample frame at which the pictures differ in most pixels.
struct ComparedPictures {
    double timeS = 0;
    Picture a;
    Picture b;
    std::uint64_t pixels = 0;  // pixels that differ by more than one 8-bit step in some channel
    int largestSteps = 0;
};
planet::Result<ComparedPictures> compareInPictures(const ComparisonPlan& plan, const ComparisonWatch& goOn);

// Returns both pictures side by side.
Picture besideEachOther(const Picture& a, const Picture& b);
// Returns |a - b| of each channel times a gain >= 0. Both pictures have the same size.
Picture differenceOf(const Picture& a, const Picture& b, double gain);

}  // namespace worldy
