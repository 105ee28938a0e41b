#include "ui/model/explanation_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "planet/sphere/chunk_id.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

using planet::ChunkExplanation;
using planet::ChunkState;
using planet::WhyNotSplit;

// Returns for example "1.2 px", with four digits where fewer would hide whether it is above tau.
std::string pixels(double px, double besidePx) {
    const bool close = px != besidePx && fmt::format("{:.1f}", px) == fmt::format("{:.1f}", besidePx);
    return close ? fmt::format("{:.4g} px", px) : fmt::format("{:.1f} px", px);
}

// Returns the first region that decides something, in quotation marks.
template <class Decides>
std::string regionThat(const ChunkExplanation& chunk, Decides decides) {
    const auto found = std::find_if(chunk.regions.begin(), chunk.regions.end(), decides);
    return found == chunk.regions.end() ? "a region" : fmt::format("region \"{}\"", found->name);
}

std::string tauRegion(const ChunkExplanation& chunk) {
    return regionThat(chunk, [](const planet::RegionEffect& effect) { return effect.setsTauFactor; });
}
std::string leastRegion(const ChunkExplanation& chunk) {
    return regionThat(chunk, [](const planet::RegionEffect& effect) { return effect.setsLeastLevel; });
}
std::string mostRegion(const ChunkExplanation& chunk) {
    return regionThat(chunk, [](const planet::RegionEffect& effect) { return effect.setsMostLevel; });
}

// Returns for example "eps 3.1 px > tau 2.0 px", or "eps 3.1 px > tau 1.0 px (x 0.5 in region "Valley")".
std::string comparison(const ChunkExplanation& chunk, const char* how) {
    const double tauPx = chunk.regionTauPx();
    const std::string text = fmt::format("{} {} {} {} {}", epsSymbol(), pixels(chunk.epsPx, tauPx), how,
                                         tauSymbol(), pixels(tauPx, chunk.epsPx));
    if (chunk.demand.tauFactor == 1) return text;
    return fmt::format("{} (x {:.3g} in {})", text, chunk.demand.tauFactor, tauRegion(chunk));
}

bool mustSplit(const ChunkExplanation& chunk) {
    return chunk.id.level < chunk.demand.leastLevel;
}

// Returns for example "14th of 60 in the queue".
std::string gridPlaceText(const ChunkExplanation& chunk) {
    if (!chunk.queuePlace) return "in the queue";
    const std::size_t place = *chunk.queuePlace;
    const bool teens = place % 100 / 10 == 1;
    const char* ending = teens             ? "th"
                         : place % 10 == 1 ? "st"
                         : place % 10 == 2 ? "nd"
                         : place % 10 == 3 ? "rd"
                                           : "th";
    return fmt::format("{}{} of {} in the queue", place, ending, chunk.queueLength);
}

std::string drawnText(const ChunkExplanation& chunk) {
    const auto wanted = [&](const std::string& why) {
        if (!mustSplit(chunk)) return fmt::format("Should split: {}; {}.", comparison(chunk, ">"), why);
        return fmt::format("Should split: {} wants level {} or finer; {}.", leastRegion(chunk),
                           chunk.demand.leastLevel, why);
    };
    switch (chunk.notSplit) {
        case WhyNotSplit::SourceLimit:
            return fmt::format("Drawn: it is a leaf; no source is finer here than level {}.", chunk.id.level);
        case WhyNotSplit::Leaf:
            if (mustSplit(chunk)) {
                return fmt::format("Drawn: {} wants level {} or finer, but the file has no finer level here.",
                                   leastRegion(chunk), chunk.demand.leastLevel);
            }
            return fmt::format("Drawn: {}, but the file has no finer level here.", comparison(chunk, ">"));
        case WhyNotSplit::LevelLimit:
            return fmt::format("Drawn: {}, but level {} is the max LOD level.", comparison(chunk, ">"),
                               chunk.id.level);
        case WhyNotSplit::RegionLimit:
            return fmt::format("Drawn: {}, but {} has no level finer than {}.", comparison(chunk, ">"),
                               mostRegion(chunk), chunk.demand.mostLevel);
        case WhyNotSplit::WaitingForMorph:
            return wanted("it first morphs back to its own surface");
        case WhyNotSplit::SeamLimit:
            return wanted("a neighbour would then be too coarse for stitched seams");
        case WhyNotSplit::WaitingInQueue:
            return wanted("its children are " + gridPlaceText(chunk));
        case WhyNotSplit::WaitingForRead:
            return wanted("its children are being read");
        case WhyNotSplit::WaitingForBudget:
            return wanted("its children do not fit into the memory budget");
        case WhyNotSplit::WaitingForRetry:
            return wanted("its children could not be read and will be retried");
        case WhyNotSplit::ChildrenFailed:
            return wanted("its children could not be read");
        case WhyNotSplit::IsSplit:
        case WhyNotSplit::NotDrawn:
        case WhyNotSplit::GoodEnough:
            break;
    }
    return fmt::format("Drawn: {}.", comparison(chunk, "is within"));
}

std::string splitText(const ChunkExplanation& chunk) {
    if (chunk.mergeWaits) return "Split: it merges when its children have morphed onto it.";
    if (mustSplit(chunk)) {
        return fmt::format("Split: {} wants level {} or finer, so its descendants are drawn instead.",
                           leastRegion(chunk), chunk.demand.leastLevel);
    }
    if (chunk.epsPx > chunk.regionTauPx()) {
        return fmt::format("Split: {}, so its descendants are drawn instead.", comparison(chunk, ">"));
    }
    return fmt::format("Split: {}, but hysteresis keeps it split.", comparison(chunk, "is within"));
}

// Returns why the ancestor that is drawn instead is not split.
std::string insteadText(const ChunkExplanation& chunk) {
    const std::string above = "its ancestor " + toString(chunk.decidedBy);
    switch (chunk.decidedByNotSplit) {
        case WhyNotSplit::GoodEnough:
            return fmt::format("{} is within the tolerance ({} {}).", above, epsSymbol(),
                               pixels(chunk.decidedByEpsPx, chunk.decidedByTauPx));
        case WhyNotSplit::LevelLimit:
            return fmt::format("{} is drawn, and level {} is the max LOD level.", above,
                               chunk.decidedBy.level);
        case WhyNotSplit::RegionLimit:
            return fmt::format("{} is drawn, and {} has no finer level.", above, mostRegion(chunk));
        case WhyNotSplit::WaitingForMorph:
            return above + " is drawn until it has morphed back to its own surface.";
        case WhyNotSplit::SeamLimit:
            return above + " is drawn, because a neighbour would otherwise be too coarse for stitched seams.";
        case WhyNotSplit::WaitingInQueue:
            return fmt::format("{} is loaded first, {}.", above, gridPlaceText(chunk));
        case WhyNotSplit::WaitingForRead:
            return above + " is loaded first, and is being read.";
        case WhyNotSplit::WaitingForBudget:
            return above + " is drawn, because its children do not fit into the memory budget.";
        case WhyNotSplit::WaitingForRetry:
            return above + " is drawn, because its children could not be read; they will be retried.";
        case WhyNotSplit::ChildrenFailed:
            return above + " is drawn, because its children could not be read.";
        case WhyNotSplit::IsSplit:
        case WhyNotSplit::NotDrawn:
        case WhyNotSplit::SourceLimit:
        case WhyNotSplit::Leaf:
            break;
    }
    return "no view requests it.";
}

// Returns "it", or the name of the ancestor that decides.
std::string decider(const ChunkExplanation& chunk) {
    return chunk.decidedBy == chunk.id ? "it" : toString(chunk.decidedBy);
}

}  // namespace

std::string whyText(const ChunkExplanation& chunk) {
    switch (chunk.state) {
        case ChunkState::Drawn:
            return drawnText(chunk);
        case ChunkState::Split:
            return splitText(chunk);
        case ChunkState::CulledFrustum:
            return fmt::format("Not drawn: {} lies outside the view.", decider(chunk));
        case ChunkState::CulledHorizon:
            return fmt::format("Not drawn: {} lies below the horizon.", decider(chunk));
        case ChunkState::Resident:
            return "Not drawn: " + insteadText(chunk);
        case ChunkState::Requested:
            return fmt::format("Not loaded yet: it is {}.", gridPlaceText(chunk));
        case ChunkState::Loading:
            return "Not loaded yet: it is being read.";
        case ChunkState::NotResident:
            return "Not loaded: " + insteadText(chunk);
        case ChunkState::Failed:
            return fmt::format(
                "Not loaded: {} could not be read{}.", decider(chunk),
                chunk.decidedByNotSplit == WhyNotSplit::WaitingForRetry ? " and will be retried" : "");
        case ChunkState::NotInFile:
            break;
    }
    return fmt::format("No such chunk: its ancestor {} is a leaf.", toString(chunk.decidedBy));
}

std::string regionText(const planet::RegionEffect& effect, const planet::ChunkDemand& demand) {
    std::vector<std::string> sets;
    if (effect.setsTauFactor) sets.push_back(fmt::format("{} x {:.3g}", tauSymbol(), demand.tauFactor));
    if (effect.setsLeastLevel) sets.push_back(fmt::format("level {} or finer", demand.leastLevel));
    if (effect.setsMostLevel) sets.push_back(fmt::format("no level finer than {}", demand.mostLevel));
    if (effect.setsMetric)
        sets.push_back(demand.metric == planet::MetricRule::Tight ? "tight metric" : "additive metric");
    const char* const where = effect.leastWeight >= 1  ? "all of it"
                              : effect.mostWeight >= 1 ? "part of it"
                                                       : "in its soft border";
    return fmt::format("{}: {}", where,
                       sets.empty() ? "a stricter demand decides" : fmt::format("{}", fmt::join(sets, ", ")));
}

const char* stateText(ChunkState state) {
    switch (state) {
        case ChunkState::Drawn:
            return "drawn";
        case ChunkState::Split:
            return "split";
        case ChunkState::CulledFrustum:
            return "culled by frustum";
        case ChunkState::CulledHorizon:
            return "culled by horizon";
        case ChunkState::Resident:
            return "resident";
        case ChunkState::Requested:
            return "requested";
        case ChunkState::Loading:
            return "loading";
        case ChunkState::NotResident:
            return "not resident";
        case ChunkState::Failed:
            return "failed";
        case ChunkState::NotInFile:
            break;
    }
    return "not in the file";
}

}  // namespace worldy::ui
