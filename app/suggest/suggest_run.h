// Runs a suggestion, for the command and for the window: measures, searches, verifies what would be written, and draws
// the worst places. README.md beside this file says what is done.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "app/measure/sweep_files.h"
#include "app/settings/camera_text.h"
#include "app/settings/setting_difference.h"
#include "app/settings/view_settings.h"
#include "app/suggest/frame_cost.h"
#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_meter.h"
#include "app/suggest/suggest_search.h"
#include "app/suggest/suggest_vary.h"
#include "planet/measure/atlas.h"
#include "planet/source/height_source.h"
#include "planet/sphere/view.h"

namespace worldy {

struct SuggestRequest {
    std::filesystem::path file;  // the chunk file
    // Bakes of the same source with other chunk sizes, which may be suggested instead. Those that are missing are baked.
    SweptFiles bakes{};
    planet::HeightSourceSettings sourceSettings{};  // of these bakes
    std::filesystem::path colourImage{};
    SuggestBudget budget;
    std::vector<std::filesystem::path> flights{};     // .toml or .flight: the path of the camera
    std::vector<std::filesystem::path> recordings{};  // .flight of this chunk file: its very views
    // Flights that are recordings of this chunk file count among the recordings.
    bool viewsOfRecordings = false;
    std::optional<planet::AtlasGrid> survey{};  // viewpoints of the whole planet
    double stepS = 1.0 / 30;                    // between frames of flights
    SuggestVary vary{};
    std::optional<FrameCost>
        cost{};  // of the target machine; unset: measured here if frame times have a budget
    bool drawsPictures = true;
    std::size_t worst = 2;  // places of each budget
    PictureSize size;
    ViewSettings view;
    // The files that the suggestion will be written to; the commands in the report name them. They are not touched.
    std::filesystem::path presetFile{};
    std::filesystem::path regionsFile{};
};

// A place where the suggestion leaves or costs most.
struct SuggestPlace {
    SuggestLimit limit = SuggestLimit::Triangles;
    double value = 0;
    std::string leg;
    planet::CameraPose pose;
    std::string line;   // the command that shows it
    Picture picture{};  // empty if it could not be drawn
};

struct SuggestOutcome {
    SuggestBudget budget;
    SuggestFound found;
    ViewSettings before;    // settings of now, without the governor
    ViewSettings settings;  // suggested, as read back from presetText and regionsText
    std::string presetText;
    std::string regionsText;  // all regions of the planet with the suggested ones; empty if none is suggested
    std::vector<SettingDifference> changes;
    SuggestMeasured beforeMeasured;
    SuggestMeasured measured;    // of the settings that were read back
    bool isMet = false;          // by that measurement
    std::filesystem::path file;  // the chunk file that is suggested: that of the request, or one of its bakes
    std::vector<std::string> legs;
    std::vector<std::size_t> frames;  // by leg
    std::optional<FrameCost> cost;
    // Drawn here with the settings before and the suggested ones, if frame times have a budget that is measured here. The
    // slowest counts in the frame times of both.
    std::vector<TimedFrame> drawnBefore;
    std::vector<TimedFrame> drawnFrames;
    std::vector<SuggestPlace> places;
    std::string noPictures;      // why there are none
    PictureSize size;            // of the views, with the field of view of the settings before
    bool hasRecordings = false;  // whose views have sizes of their own
    double radiusM = 0;
    double elapsedS = 0;
};

// Returns whether the suggestion is the settings of now: they meet the budget, or nothing that was found is better. Pure.
bool keepsSettings(const SuggestOutcome& outcome);
// Returns whether the suggestion misses the budget by no less than the settings of now, as both were measured last. Pure.
bool isNoBetter(const SuggestOutcome& outcome);

enum class SuggestStage { Surveying, Baking, Timing, Searching, Verifying, Drawing };
struct SuggestProgress {
    SuggestStage stage = SuggestStage::Surveying;
    double share = 0;               // of the current measurement or stage, [0, 1]
    std::size_t measured = 0;       // candidates so far
    std::size_t ahead = 0;          // at most so many more, as far as is known
    std::optional<double> leftS{};  // of the search
    SuggestCandidate candidate{};   // being measured; while baking, only its chunk size counts
};
// Called several times per second by the thread that runs; progress must return true to go on.
struct SuggestWatcher {
    std::function<bool(const SuggestProgress&)> progress;
    std::function<void(const SuggestTrial&)> tried{};
};

// Creates a GL context on the calling thread if one is needed, and leaves none current. Writes no file. The Error names a
// file or an option, or is of kind Cancelled.
planet::Result<SuggestOutcome> runSuggest(const SuggestRequest& request, const SuggestWatcher& watcher);

// Says where the suggestion is written, if that was not known before: the commands of the places name these files.
void nameSuggestFiles(SuggestRequest& request, const std::filesystem::path& preset,
                      const std::filesystem::path& regions, SuggestOutcome& outcome);

// Returns the settings that decide what was measured, as the text of a preset.
std::string suggestPresetText(const ViewSettings& settings);

}  // namespace worldy
