#include "ui/model/explanation_text.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "ui/model/font_symbols.h"

namespace worldy::ui {
namespace {

using planet::ChunkExplanation;
using planet::ChunkId;
using planet::ChunkState;
using planet::Face;
using planet::WhyNotSplit;

// The text with its Greek letters spelled out, whatever font an earlier test has loaded.
std::string whySpelled(const ChunkExplanation& explained) {
    std::string text = whyText(explained);
    for (const auto& [symbol, name] : {std::pair{tauSymbol(), "tau"}, std::pair{epsSymbol(), "eps"}}) {
        for (std::size_t at = text.find(symbol); at != std::string::npos; at = text.find(symbol, at + 3)) {
            text.replace(at, std::string(symbol).size(), name);
        }
    }
    return text;
}

ChunkExplanation chunk(ChunkState state, WhyNotSplit notSplit, double epsPx) {
    ChunkExplanation made;
    made.id = made.decidedBy = {Face::PosZ, 5, 6, 4};
    made.state = state;
    made.notSplit = made.decidedByNotSplit = notSplit;
    made.epsPx = made.decidedByEpsPx = epsPx;
    made.tauPx = 2;
    made.queueLength = 60;
    return made;
}

ChunkExplanation below(ChunkState state, WhyNotSplit above, double aboveEpsPx) {
    ChunkExplanation made = chunk(state, WhyNotSplit::NotDrawn, 0.3);
    made.decidedBy = {Face::PosZ, 4, 3, 2};
    made.decidedByNotSplit = above;
    made.decidedByEpsPx = aboveEpsPx;
    return made;
}

TEST(ExplanationText, NamesTheRegionThatDecides) {
    const auto why = [](WhyNotSplit notSplit, double epsPx, const planet::ChunkDemand& demand,
                        const planet::RegionEffect& effect) {
        ChunkExplanation made = chunk(ChunkState::Drawn, notSplit, epsPx);
        made.demand = demand;
        made.regions = {planet::RegionEffect{}, effect};
        return whySpelled(made);
    };
    EXPECT_EQ(
        why(WhyNotSplit::GoodEnough, 0.8, {.tauFactor = 0.5f}, {.name = "Valley", .setsTauFactor = true}),
        "Drawn: eps 0.8 px is within tau 1.0 px (x 0.5 in region \"Valley\").");
    EXPECT_EQ(why(WhyNotSplit::RegionLimit, 3.1, {.mostLevel = 5}, {.name = "Sea", .setsMostLevel = true}),
              "Drawn: eps 3.1 px > tau 2.0 px, but region \"Sea\" has no level finer than 5.");
    EXPECT_EQ(
        why(WhyNotSplit::WaitingForRead, 0.1, {.leastLevel = 7}, {.name = "Town", .setsLeastLevel = true}),
        "Should split: region \"Town\" wants level 7 or finer; its children are being read.");
    EXPECT_EQ(why(WhyNotSplit::Leaf, 0, {.leastLevel = 7}, {.name = "Town", .setsLeastLevel = true}),
              "Drawn: region \"Town\" wants level 7 or finer, but the file has no finer level here.");
    ChunkExplanation split = chunk(ChunkState::Split, WhyNotSplit::IsSplit, 0.1);
    split.demand.leastLevel = 7;
    split.regions = {{.name = "Town", .setsLeastLevel = true}};
    EXPECT_EQ(whySpelled(split),
              "Split: region \"Town\" wants level 7 or finer, so its descendants are drawn instead.");
}

TEST(ExplanationText, SaysWhatARegionDoesInAChunk) {
    const planet::ChunkDemand demand{0.5f, 6, 9, planet::MetricRule::Tight, 0};
    planet::RegionEffect effect;
    effect.mostWeight = 0.5;
    EXPECT_EQ(regionText(effect, demand), "in its soft border: a stricter demand decides");
    effect.mostWeight = 1;
    effect.setsMostLevel = true;
    EXPECT_EQ(regionText(effect, demand), "part of it: no level finer than 9");
    effect = {};
    effect.leastWeight = effect.mostWeight = 1;
    effect.setsLeastLevel = effect.setsMetric = true;
    EXPECT_EQ(regionText(effect, demand), "all of it: level 6 or finer, tight metric");
}

TEST(ExplanationText, OfDrawnChunksSaysWhyTheyAreNotSplit) {
    const auto drawn = [](WhyNotSplit why, double epsPx) {
        return whySpelled(chunk(ChunkState::Drawn, why, epsPx));
    };
    EXPECT_EQ(drawn(WhyNotSplit::GoodEnough, 1.23), "Drawn: eps 1.2 px is within tau 2.0 px.");
    EXPECT_EQ(drawn(WhyNotSplit::SourceLimit, 0),
              "Drawn: it is a leaf; no source is finer here than level 5.");
    EXPECT_EQ(drawn(WhyNotSplit::Leaf, 3.1),
              "Drawn: eps 3.1 px > tau 2.0 px, but the file has no finer level here.");
    EXPECT_EQ(drawn(WhyNotSplit::LevelLimit, 3.1),
              "Drawn: eps 3.1 px > tau 2.0 px, but level 5 is the max LOD level.");
    EXPECT_EQ(
        drawn(WhyNotSplit::SeamLimit, 3.1),
        "Should split: eps 3.1 px > tau 2.0 px; a neighbour would then be too coarse for stitched seams.");
    EXPECT_EQ(drawn(WhyNotSplit::WaitingForMorph, 3.1),
              "Should split: eps 3.1 px > tau 2.0 px; it first morphs back to its own surface.");
    EXPECT_EQ(drawn(WhyNotSplit::WaitingForRead, 3.1),
              "Should split: eps 3.1 px > tau 2.0 px; its children are being read.");
    EXPECT_EQ(drawn(WhyNotSplit::WaitingForBudget, 3.1),
              "Should split: eps 3.1 px > tau 2.0 px; its children do not fit into the memory budget.");
    EXPECT_EQ(drawn(WhyNotSplit::WaitingForRetry, 3.1),
              "Should split: eps 3.1 px > tau 2.0 px; its children could not be read and will be retried.");
    EXPECT_EQ(drawn(WhyNotSplit::ChildrenFailed, 3.1),
              "Should split: eps 3.1 px > tau 2.0 px; its children could not be read.");
}

TEST(ExplanationText, PlacesInTheQueueAreCountedAsPeopleCount) {
    ChunkExplanation waiting = chunk(ChunkState::Drawn, WhyNotSplit::WaitingInQueue, 3.1);
    const auto at = [&](std::size_t place) {
        waiting.queuePlace = place;
        return whySpelled(waiting);
    };
    const std::string start = "Should split: eps 3.1 px > tau 2.0 px; its children are ";
    EXPECT_EQ(at(14), start + "14th of 60 in the queue.");
    EXPECT_EQ(at(1), start + "1st of 60 in the queue.");
    EXPECT_EQ(at(2), start + "2nd of 60 in the queue.");
    EXPECT_EQ(at(23), start + "23rd of 60 in the queue.");
    EXPECT_EQ(at(11), start + "11th of 60 in the queue.");
    EXPECT_EQ(at(112), start + "112th of 60 in the queue.");
    EXPECT_EQ(at(10), start + "10th of 60 in the queue.");
}

TEST(ExplanationText, NumbersThatAreCloseGetMoreDigits) {
    EXPECT_EQ(whySpelled(chunk(ChunkState::Drawn, WhyNotSplit::WaitingForRead, 2.004)),
              "Should split: eps 2.004 px > tau 2 px; its children are being read.");
    EXPECT_EQ(whySpelled(chunk(ChunkState::Drawn, WhyNotSplit::GoodEnough, 2)),
              "Drawn: eps 2.0 px is within tau 2.0 px.");
}

TEST(ExplanationText, OfSplitChunksSaysWhatKeepsThemSplit) {
    EXPECT_EQ(whySpelled(chunk(ChunkState::Split, WhyNotSplit::IsSplit, 5)),
              "Split: eps 5.0 px > tau 2.0 px, so its descendants are drawn instead.");
    EXPECT_EQ(whySpelled(chunk(ChunkState::Split, WhyNotSplit::IsSplit, 1.9)),
              "Split: eps 1.9 px is within tau 2.0 px, but hysteresis keeps it split.");
    ChunkExplanation waits = chunk(ChunkState::Split, WhyNotSplit::IsSplit, 1.1);
    waits.mergeWaits = true;
    EXPECT_EQ(whySpelled(waits), "Split: it merges when its children have morphed onto it.");
}

TEST(ExplanationText, OfCulledChunksNamesWhatIsCulled) {
    EXPECT_EQ(whySpelled(chunk(ChunkState::CulledFrustum, WhyNotSplit::NotDrawn, 5)),
              "Not drawn: it lies outside the view.");
    EXPECT_EQ(whySpelled(below(ChunkState::CulledFrustum, WhyNotSplit::NotDrawn, 5)),
              "Not drawn: z_pos/4/3/2 lies outside the view.");
    EXPECT_EQ(whySpelled(chunk(ChunkState::CulledHorizon, WhyNotSplit::NotDrawn, 5)),
              "Not drawn: it lies below the horizon.");
    EXPECT_EQ(whySpelled(below(ChunkState::CulledHorizon, WhyNotSplit::NotDrawn, 5)),
              "Not drawn: z_pos/4/3/2 lies below the horizon.");
}

TEST(ExplanationText, OfResidentChunksNamesWhatIsDrawnInstead) {
    const auto resident = [](WhyNotSplit above, double epsPx) {
        return whySpelled(below(ChunkState::Resident, above, epsPx));
    };
    EXPECT_EQ(resident(WhyNotSplit::GoodEnough, 0.8),
              "Not drawn: its ancestor z_pos/4/3/2 is within the tolerance (eps 0.8 px).");
    EXPECT_EQ(resident(WhyNotSplit::LevelLimit, 3),
              "Not drawn: its ancestor z_pos/4/3/2 is drawn, and level 4 is the max LOD level.");
    EXPECT_EQ(
        resident(WhyNotSplit::SeamLimit, 3),
        "Not drawn: its ancestor z_pos/4/3/2 is drawn, because a neighbour would otherwise be too coarse "
        "for stitched seams.");
    EXPECT_EQ(resident(WhyNotSplit::WaitingForMorph, 3),
              "Not drawn: its ancestor z_pos/4/3/2 is drawn until it has morphed back to its own surface.");
    EXPECT_EQ(resident(WhyNotSplit::NotDrawn, 3), "Not drawn: no view requests it.");
}

TEST(ExplanationText, OfMissingChunksSaysWhatTheyWaitFor) {
    const auto missing = [](WhyNotSplit above) {
        ChunkExplanation made = below(ChunkState::NotResident, above, 0.8);
        made.queuePlace = 3;
        return whySpelled(made);
    };
    EXPECT_EQ(missing(WhyNotSplit::GoodEnough),
              "Not loaded: its ancestor z_pos/4/3/2 is within the tolerance (eps 0.8 px).");
    EXPECT_EQ(missing(WhyNotSplit::WaitingInQueue),
              "Not loaded: its ancestor z_pos/4/3/2 is loaded first, 3rd of 60 in the queue.");
    EXPECT_EQ(missing(WhyNotSplit::WaitingForRead),
              "Not loaded: its ancestor z_pos/4/3/2 is loaded first, and is being read.");
    EXPECT_EQ(missing(WhyNotSplit::WaitingForBudget),
              "Not loaded: its ancestor z_pos/4/3/2 is drawn, because its children do not fit into the "
              "memory budget.");
    EXPECT_EQ(
        missing(WhyNotSplit::WaitingForRetry),
        "Not loaded: its ancestor z_pos/4/3/2 is drawn, because its children could not be read; they will "
        "be retried.");
    EXPECT_EQ(missing(WhyNotSplit::ChildrenFailed),
              "Not loaded: its ancestor z_pos/4/3/2 is drawn, because its children could not be read.");
    EXPECT_EQ(missing(WhyNotSplit::NotDrawn), "Not loaded: no view requests it.");
}

TEST(ExplanationText, OfChunksOnTheirWaySaysHowFarTheyAre) {
    ChunkExplanation queued = chunk(ChunkState::Requested, WhyNotSplit::NotDrawn, 0);
    queued.queuePlace = 3;
    EXPECT_EQ(whySpelled(queued), "Not loaded yet: it is 3rd of 60 in the queue.");
    EXPECT_EQ(whySpelled(chunk(ChunkState::Loading, WhyNotSplit::NotDrawn, 0)),
              "Not loaded yet: it is being read.");
}

TEST(ExplanationText, OfFailedAndUnknownChunksNamesTheCause) {
    EXPECT_EQ(whySpelled(chunk(ChunkState::Failed, WhyNotSplit::NotDrawn, 0)),
              "Not loaded: it could not be read.");
    EXPECT_EQ(whySpelled(below(ChunkState::Failed, WhyNotSplit::NotDrawn, 0)),
              "Not loaded: z_pos/4/3/2 could not be read.");
    EXPECT_EQ(whySpelled(below(ChunkState::NotInFile, WhyNotSplit::NotDrawn, 0)),
              "No such chunk: its ancestor z_pos/4/3/2 is a leaf.");
}

TEST(ExplanationText, StatesHaveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (int state = 0; state <= static_cast<int>(ChunkState::NotInFile); ++state) {
        names.insert(stateText(static_cast<ChunkState>(state)));
    }
    EXPECT_EQ(names.size(), static_cast<std::size_t>(ChunkState::NotInFile) + 1);
    EXPECT_EQ(stateText(ChunkState::CulledHorizon), std::string("culled by horizon"));
}

}  // namespace
}  // namespace worldy::ui
