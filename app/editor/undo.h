// The history of the view settings: what Ctrl+Z and Ctrl+Shift+Z walk through. Plain values, no clock.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/view_settings.h"

namespace worldy {

inline constexpr std::size_t maxUndoSteps = 200;  // the oldest ones are forgotten
// Changes of the same settings that come as close together, as by a mouse wheel or a held key, are one step.
inline constexpr double undoMergeS = 0.5;

class UndoHistory {
public:
    // Once a frame: the settings before and after the panels and keys have changed them, and whether a
    // control is being held, as a slider is while it is dragged. All changes while it is held are one step;
    // those that end where they began are none. A new step clears what could be redone. timeS: any clock
    // that does not run backwards.
    void record(const ViewSettings& before, const ViewSettings& after, bool held, double timeS);

    // A change that is a step of its own with a name of its own: "preset popping".
    void add(const ViewSettings& before, const ViewSettings& after, std::string name);

    // The settings to go back or forward to; none where there are none.
    std::optional<ViewSettings> undo();
    std::optional<ViewSettings> redo();

    // What they would take back or do again: "tau 2 -> 3 px"; empty where nothing.
    std::string undoName() const;
    std::string redoName() const;

private:
    struct Step {
        ViewSettings before;
        ViewSettings after;
        std::string name;
        std::vector<std::string> settings;  // that it changes, "lod.tau_px"
    };
    void push(Step step);
    void close();  // the newest step, which then grows no more

    std::deque<Step> done_;  // newest last
    std::vector<Step> undone_;
    bool open_ = false;  // the newest step may still grow,
    bool held_ = false;  // for as long as a control is held; else for undoMergeS
    double lastChangeS_ = 0;
};

// "tau 2 -> 3 px", "outlines on", "4 settings".
std::string changeName(const ViewSettings& before, const ViewSettings& after);

}  // namespace worldy
