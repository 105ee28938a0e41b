// The undo history of the view settings (Ctrl+Z and Ctrl+Shift+Z). Plain values, no clock.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/view_settings.h"

namespace worldy {

inline constexpr std::size_t maxUndoSteps = 200;  // the oldest are discarded
// Changes of the same settings within this time, for example by a mouse wheel or a held key, form one step.
inline constexpr double undoMergeS = 0.5;

class UndoHistory {
public:
    // Call every frame with the settings before and after the panels and keys have changed them. held: a
    // control is held, for example a slider that is dragged. All changes while it is held form one step;
    // changes that end at the initial value form none. A new step clears the redo steps. timeS: any clock
    // that does not run backwards.
    void record(const ViewSettings& before, const ViewSettings& after, bool held, double timeS);

    // Adds a change as a named step of its own: "preset popping".
    void add(const ViewSettings& before, const ViewSettings& after, std::string name);

    // Call when another planet is shown, with its regions. Removes those of the planet before from all steps, and the steps
    // that changed nothing else.
    void replaceRegions(const RegionSettings& regions);

    // Return the settings to go back or forward to; none if there are none.
    std::optional<ViewSettings> undo();
    std::optional<ViewSettings> redo();

    // Return the step that undo or redo would apply: "Tolerance τ 2 -> 3 px"; empty if there is none.
    std::string undoName() const;
    std::string redoName() const;

private:
    struct Step {
        ViewSettings before;
        ViewSettings after;
        std::string name;
        std::vector<std::string> settings;  // the settings it changes, "lod.tau_px"
    };
    void push(Step step);
    void close();  // the newest step, which cannot grow afterwards

    std::deque<Step> done_;  // newest last
    std::vector<Step> undone_;
    bool open_ = false;  // the newest step may still grow
    bool held_ = false;  // while a control is held; otherwise for undoMergeS
    double lastChangeS_ = 0;
};

// Returns for example "Tolerance τ 2 -> 3 px", "Outlines on", "4 settings".
std::string changeName(const ViewSettings& before, const ViewSettings& after);

}  // namespace worldy
