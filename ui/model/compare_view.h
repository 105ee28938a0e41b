// What the Compare panel and the viewport show: A, which is what the window shows anyway, beside B.
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

// Of the pictures as they are now.
struct PictureDifferenceNow {
    std::uint64_t pixels = 0;  // that differ by more than one 8-bit step in some channel
    std::uint64_t of = 0;      // all pixels
    int largestSteps = 0;      // [0, 255]
};

struct FlightComparisonView {
    bool running = false;
    bool stopping = false;
    double progress = 0;                                   // [0, 1]
    const std::array<ComparedFigures, 2>* last = nullptr;  // null: none yet
    std::string lastName;                                  // "andes low fast, 12 moments. A: ..., B: ..."
    std::string problem;                                   // why the last one came to nothing
};

struct CompareView {
    bool on = false;
    const planet::Planet* planetB = nullptr;  // null where off, as all that is of B
    const ViewSettings* settingsB = nullptr;
    std::filesystem::path fileA;
    std::filesystem::path fileB;
    std::string origin;                            // of B: "settings kept", "preset popping"
    std::span<const SettingDifference> different;  // here: A, there: B
    std::array<ComparedFigures, 2> now;
    std::optional<PictureDifferenceNow> difference;
    bool measuring = false;  // the true error of this view
    double measured = 0;     // share of that, [0, 1]
    bool stale = false;      // what was measured is of another view or other settings
    std::string problem;     // why there is no B
    FlightComparisonView flight;
};

// "A  tau_px 2" where that is the only difference, else "A" and "B, 3 settings differ".
std::array<std::string, 2> sideNames(const CompareView& compare);

}  // namespace worldy::ui
