// Governs τ by the budgets of the settings (planet/select/governor.h), frame by frame, and says in words what binds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/scene/frame_stats.h"
#include "app/settings/view_settings.h"
#include "planet/planet.h"
#include "planet/select/governor.h"

namespace worldy {

struct Governing {
    planet::GovernorState state;
    std::optional<double> ownTauPx;  // the user's τ, which returns when no budget is on; unset while none is
    double tauPx = 0;                // chosen for the last frame; another one in the settings is the user's
    std::optional<double> ownFadeS;  // likewise the time of a fade, which is shorter while many chunks merge
    double fadeS = 0;
    BudgetUse use;
    std::uint64_t bytesRead = 0;  // since the planet was opened, at the last sample
    bool knowsBytes = false;
    double stillS = 0;  // since τ changed
};

planet::GovernorSettings governorSettingsOf(const ViewSettings& settings);

// Returns what a frame cost. The planet's last step must be that of the frame, with these settings. bytesRead and elapsedS:
// since the sample before.
planet::GovernorSample governorSampleOf(const FrameStats& frame, const planet::Planet& planet,
                                        const planet::LodSettings& lod, std::uint64_t bytesRead,
                                        double elapsedS);

// Sets τ and the time of a fade in settings.lod for the next frame if a budget is on, and returns those of the user if none is
// any more. frame: the last one; null before the first. elapsedS: by which the next frame advances.
void governTau(Governing& governing, const FrameStats* frame, const planet::Planet& planet, double elapsedS,
               ViewSettings& settings);
// Forgets the costs, for another planet, but not what the user has set.
void forgetCosts(Governing& governing);
// Returns settings with τ and the time of a fade as the user has set them, where they are still those of the governor.
ViewSettings ungoverned(const Governing& governing, ViewSettings settings);

// τ may still change although nothing else does.
bool isSettling(const Governing& governing);

// The budgets' names on screen ("GPU time") and in reports ("gpu_time"), in the order of planet::GovernorBudget.
inline constexpr std::array<std::string_view, planet::governorBudgetCount> budgetNames = {
    "CPU time", "GPU time", "Triangles", "Memory", "Reading"};
inline constexpr std::array<std::string_view, planet::governorBudgetCount> budgetKeys = {
    "cpu_time", "gpu_time", "triangles", "memory", "reading"};

// Returns "GPU time binds", "Triangles bind", "τ is at its lower limit", "GPU time binds; τ is at its upper limit", or "No
// cost is measured yet". tau: the symbol.
std::string bindsText(const BudgetUse& use, std::string_view tau);
// Returns the same for reports: "gpu_time", "lower_limit", "upper_limit", or "none".
std::string_view bindsKey(const BudgetUse& use);
// Returns a cost with its budget: "7.4 of 8 ms".
std::string costText(planet::GovernorBudget budget, const BudgetUse& use, const BudgetSettings& settings);

}  // namespace worldy
