// The data of the Compare panel and of the comparison in the viewport: A is the planet that the window shows,
// B the second one.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "app/measure/compare_table.h"
#include "app/settings/setting_difference.h"
#include "app/settings/view_settings.h"
#include "planet/planet.h"

namespace worldy::ui {

// The difference between the current pictures.
struct PictureDifferenceNow {
    std::uint64_t pixels = 0;  // that differ by more than one 8-bit step in any channel
    std::uint64_t of = 0;      // all pixels
    int largestSteps = 0;      // [0, 255]
};

struct FlightComparisonView {
    bool running = false;
    bool stopping = false;
    double progress = 0;                                   // [0, 1]
    const std::array<ComparedFigures, 2>* last = nullptr;  // null: none yet
    std::string lastName;                                  // "andes low fast, 12 sample frames. A: ..."
    std::string problem;                                   // why the last measurement failed
};

struct CompareView {
    bool on = false;
    const planet::Planet* planetB = nullptr;  // null if off, as are the other members about B
    const ViewSettings* settingsB = nullptr;
    std::filesystem::path fileA;
    std::filesystem::path fileB;
    std::array<std::string, 2> names;  // of A's and B's planet: the sources or, if they have one, the files
    std::string origin;                // of B: "snapshot", "preset popping"
    std::span<const SettingDifference> different;  // SettingDifference::here is A, there is B
    std::array<ComparedFigures, 2> now;
    std::optional<PictureDifferenceNow> difference;
    bool measuring = false;  // the true error of this view is being measured
    double measured = 0;     // progress of that, [0, 1]
    bool stale = false;      // the measurement is of another view or other settings
    std::string problem;     // why there is no B
    FlightComparisonView flight;
};

// Returns "A  tau_px 2" and "B  tau_px 4" if that is the only difference, otherwise for example "A" and "B  3
// settings differ".
std::array<std::string, 2> sideNames(const CompareView& compare);

}  // namespace worldy::ui
