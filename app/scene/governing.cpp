#include "app/scene/governing.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/text.h"
#include "app/scene/scene_settings.h"
#include "planet/tree/chunk_tree.h"

namespace worldy {

namespace {

using planet::GovernorBudget;
using planet::GovernorLimit;

constexpr double bytesPerMB = 1e6;

double cpuMsOf(const FrameStats& frame) {
    const planet::StageTimes& stages = frame.stages;
    return stages.uploadMs + stages.selectMs + stages.pagingMs + frame.drawCpuMs + frame.overlaysMs +
           frame.panelsMs;
}

double gpuMsOf(const FrameStats& frame) {
    return frame.render.chunksMs + frame.render.skyMs + frame.render.shadowsMs + frame.panelsGpuMs;
}

}  // namespace

planet::GovernorSettings governorSettingsOf(const ViewSettings& settings) {
    const BudgetSettings& budget = settings.budget;
    const planet::LodSettings lod = lodSettingsOf(settings);
    planet::GovernorSettings governor;
    governor.budget = {.cpuMs = budget.cpuMs,
                       .gpuMs = budget.gpuMs,
                       .triangles = static_cast<double>(budget.triangles),
                       .memoryBytes = static_cast<double>(budget.memoryMB) * (1 << 20),
                       .readBytesPerS = budget.readMBs * bytesPerMB};
    governor.leastTauPx = budget.leastTauPx;
    governor.mostTauPx = budget.mostTauPx;
    governor.hysteresis = budget.hysteresis;
    governor.fadeS = lod.morph ? lod.fadeS : 0;
    governor.morphRange = lod.morphRange;
    governor.lodHysteresis = lod.hysteresis;
    return governor;
}

planet::GovernorSample governorSampleOf(const FrameStats& frame, const planet::Planet& planet,
                                        const planet::LodSettings& lod, std::uint64_t bytesRead,
                                        double elapsedS) {
    const planet::Selection& selection = planet.selection();
    const planet::PlanetShape& shape = planet.tree().shape;
    const std::size_t chunkBytes = planet::chunkBytesCpu(shape) + planet::chunkBytesGpu(shape);
    planet::GovernorSample sample;
    sample.cost = {.cpuMs = cpuMsOf(frame),
                   .gpuMs = gpuMsOf(frame),
                   .triangles = static_cast<double>(frame.selection.triangles()),
                   .memoryBytes = static_cast<double>(planet::neededChunks(selection) * chunkBytes),
                   .readBytesPerS = elapsedS > 0 ? static_cast<double>(bytesRead) / elapsedS : 0};
    sample.tauPx = frame.tauPx;
    sample.elapsedS = elapsedS;
    sample.exponent = planet::exponentOf(selection, frame.tauPx);
    sample.merges = planet::mergeCurveOf(selection, lod.hysteresis);
    const std::uint32_t drawn = std::max(frame.selection.drawn, 1u);
    sample.waitingShare = static_cast<double>(frame.selection.waiting) / drawn;
    return sample;
}

void governTau(Governing& governing, const FrameStats* frame, const planet::Planet& planet, double elapsedS,
               ViewSettings& settings) {
    if (!settings.budget.isOn()) {
        settings = ungoverned(governing, std::move(settings));
        governing = {};
        return;
    }
    if (settings.lod.tauPx != governing.tauPx) governing.ownTauPx = settings.lod.tauPx;
    governing.tauPx = settings.lod.tauPx;
    if (settings.lod.fadeS != governing.fadeS) governing.ownFadeS = settings.lod.fadeS;
    governing.fadeS = settings.lod.fadeS = governing.ownFadeS.value_or(settings.lod.fadeS);
    governing.use.isOn = true;
    if (!frame || frame->tauPx <= 0) return;
    const std::uint64_t bytesRead = planet.paging().bytesRead();
    const std::uint64_t before = governing.knowsBytes ? governing.bytesRead : bytesRead;
    const planet::GovernorSample sample =
        governorSampleOf(*frame, planet, settings.lod, bytesRead - std::min(before, bytesRead), elapsedS);
    governing.bytesRead = bytesRead;
    governing.knowsBytes = true;
    const planet::Governed governed = planet::govern(governing.state, sample, governorSettingsOf(settings));
    governing.state = governed.state;
    governing.use = {true, governed.governs, governed.binds, governed.limit, governed.use, governed.uses};
    governing.tauPx = settings.lod.tauPx = std::clamp(governed.tauPx, smallestTauPx, largestTauPx);
    if (settings.lod.morph && governed.governs) governing.fadeS = settings.lod.fadeS = governed.fadeS;
    governing.stillS = settings.lod.tauPx == frame->tauPx ? governing.stillS + elapsedS : 0;
}

void forgetCosts(Governing& governing) {
    governing = {.state = {},
                 .ownTauPx = governing.ownTauPx,
                 .tauPx = governing.tauPx,
                 .ownFadeS = governing.ownFadeS,
                 .fadeS = governing.fadeS,
                 .use = {}};
}

ViewSettings ungoverned(const Governing& governing, ViewSettings settings) {
    planet::LodSettings& lod = settings.lod;
    if (governing.ownTauPx && lod.tauPx == governing.tauPx) lod.tauPx = *governing.ownTauPx;
    if (governing.ownFadeS && lod.fadeS == governing.fadeS) lod.fadeS = *governing.ownFadeS;
    return settings;
}

bool isSettling(const Governing& governing) {
    constexpr double stillEnoughS = 1.5;  // a fall begins a second after a rise
    return governing.use.isOn && governing.stillS < stillEnoughS;
}

std::string bindsText(const BudgetUse& use, std::string_view tau) {
    if (!use.isOn) return "No budget is on";
    if (!use.isMeasured) return "No cost is measured yet";
    if (use.limit == GovernorLimit::LeastTau) return fmt::format("{} is at its lower limit", tau);
    const std::string binds = fmt::format("{} {}", budgetNames[static_cast<std::size_t>(use.binds)],
                                          use.binds == GovernorBudget::Triangles ? "bind" : "binds");
    if (use.limit == GovernorLimit::MostTau) return fmt::format("{}; {} is at its upper limit", binds, tau);
    return binds;
}

std::string_view bindsKey(const BudgetUse& use) {
    if (!use.isMeasured) return "none";
    if (use.limit == GovernorLimit::LeastTau) return "lower_limit";
    if (use.limit == GovernorLimit::MostTau) return "upper_limit";
    return budgetKeys[static_cast<std::size_t>(use.binds)];
}

std::string costText(GovernorBudget budget, const BudgetUse& use, const BudgetSettings& settings) {
    const double share = use.uses[static_cast<std::size_t>(budget)];
    switch (budget) {
        case GovernorBudget::CpuTime:
            return fmt::format("{:.1f} of {:.4g} ms", share * settings.cpuMs, settings.cpuMs);
        case GovernorBudget::GpuTime:
            return fmt::format("{:.1f} of {:.4g} ms", share * settings.gpuMs, settings.gpuMs);
        case GovernorBudget::Triangles:
            return fmt::format("{} of {}", countText(share * settings.triangles),
                               countText(settings.triangles));
        case GovernorBudget::Memory:
            return fmt::format("{:.1f} of {} MiB", share * settings.memoryMB, settings.memoryMB);
        case GovernorBudget::Reading:
            return fmt::format("{:.2f} of {:.4g} MB/s", share * settings.readMBs, settings.readMBs);
    }
    return {};
}

}  // namespace worldy
