// An hour of frames over random places with as little memory as will do: nothing grows, nothing is loaded and
// dropped in turns, nothing waits for ever. WORLDY_FLIGHT_SECONDS says how many simulated seconds to fly.
#include "tests/support/long_flight.h"

#include <gtest/gtest.h>

#include <iostream>

#include "planet/bake/bake.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::Holding;

class LongFlight : public testing::Test {
protected:
    void SetUp() override {
        const ColourSource colours = test::formulaColours(test::mottled);
        BakeSettings settings{.faceSize = 1025, .chunkSize = 65};
        settings.colour.faceSize = 513;
        const auto baked = bake(test::hillsSource(), settings, path_, {}, &colours);
        ASSERT_TRUE(baked) << baked.error().message;
        test::giveBackFreed();  // what the bake took would hide what the flight takes
    }

    // Little more than the least that pays for chunks, colours and normals.
    PagingSettings tight() const {
        PagingSettings settings;
        settings.loaderThreads = 1;
        settings.time = PagingTime::Simulated;
        settings.badDisk = {.latencyMs = 30, .bandwidthMBs = 0.5};
        // Shares that leave none of the three much more than its least.
        settings.normals = true;
        settings.normalShare = 0.9;
        settings.colourShare = 0.1;
        const auto suffices = [&](std::size_t bytes) {
            settings.budgetBytes = bytes;
            const auto planet = Planet::open(path_, settings);
            return planet && (*planet)->paging()[BlockKind::Normals].capacity > 0;
        };
        std::size_t tooLittle = 1 << 16, enough = 64 << 20;
        while (enough - tooLittle > 1 << 14) {
            const std::size_t middle = (tooLittle + enough) / 2;
            (suffices(middle) ? enough : tooLittle) = middle;
        }
        settings.budgetBytes = enough + enough / 10;
        return settings;
    }

    tests::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "hills.chk";
};

ViewInput inputOf(const View& view, double tauPx, double priorityFactor = 1) {
    ViewInput input{view, suddenLod(tauPx), priorityFactor};
    input.colours = {.enabled = true, .texelsPerPixel = 2};
    input.normals = input.colours;
    return input;
}

void expectFlat(const char* name, std::size_t early, std::size_t late) {
    EXPECT_LE(late, early + early / 100 + (64 << 10)) << name;
}

// Slots are told of once each, and what is resident is within the budget.
void expectWithin(const Planet& planet, std::size_t budgetBytes) {
    const PagingCounters& paging = planet.paging();
    ASSERT_LE(paging.residentBytesCpu + paging.residentBytesGpu, budgetBytes);
    ASSERT_LE(planet.tree().residentChunks, planet.paging()[BlockKind::Heights].capacity);
    ASSERT_LE(planet.tree().nodes.size(), planet.paging()[BlockKind::Heights].capacity);
    ASSERT_LE(planet.paging()[BlockKind::Colours].resident, planet.paging()[BlockKind::Colours].capacity);
    ASSERT_LE(planet.paging()[BlockKind::Normals].resident, planet.paging()[BlockKind::Normals].capacity);
}

struct FlownHour {
    std::uint64_t frames = 0;
    std::uint64_t legs = 0;
    std::uint64_t legsSettled = 0;
    std::uint64_t problems = 0;
    std::uint64_t framesShort = 0;  // of room for what was wanted
    std::uint32_t chunkSlots = 0, colourSlots = 0, normalSlots = 0;
    test::PagingWatch paging;
    // The most, after the first tenth: of the first half of what is left, and of the second.
    Holding early{0, 0, 0, 0}, late{0, 0, 0, 0};
};

void fly(Planet& planet, double seconds, FlownHour& flown) {
    test::RandomFlight flight(47, planet.tree().shape.radiusM);
    const auto frames = static_cast<std::uint64_t>(seconds / test::frameS);
    flown.chunkSlots = planet.paging()[BlockKind::Heights].capacity;
    flown.colourSlots = planet.paging()[BlockKind::Colours].capacity;
    flown.normalSlots = planet.paging()[BlockKind::Normals].capacity;
    const std::size_t budgetBytes = planet.pagingSettings().budgetBytes;
    for (; flown.frames < frames; ++flown.frames) {
        const View view = flight.view(1280, 720);
        CameraPose above = flight.pose();
        above.altitudeM *= 20;
        above.pitchDeg = -90;
        const std::array views = {
            inputOf(view, 0.02),
            inputOf(viewFromPose(above, planet.tree().shape.radiusM, 1, 640, 480), 4, 0.5)};
        // On every third leg two views share the planet.
        planet.step(
            std::span(views).first(flown.legs % 3 == 0 ? 2 : 1), [](std::uint32_t, StepsView) {},
            test::frameS);
        flown.problems += planet.takeProblems().size();
        flown.framesShort += planet.paging()[BlockKind::Heights].budgetWaits +
                                 planet.paging()[BlockKind::Colours].budgetWaits >
                             0;
        planet.takeTileChanges(BlockKind::Colours);
        planet.takeTileChanges(BlockKind::Normals);
        flown.paging.look(planet);
        expectWithin(planet, budgetBytes);
        if (testing::Test::HasFatalFailure()) return;
        if (flight.endsLeg()) {
            ++flown.legs;
            flown.legsSettled += planet.settled();
        }
        flight.step();
        if (flown.frames % 300 == 0 && flown.frames * 10 > frames)
            raise(flown.frames * 20 > frames * 11 ? flown.late : flown.early, Holding());
    }
}

TEST_F(LongFlight, HoldsNothingThatItDidNotHoldBefore) {
    const PagingSettings settings = tight();
    const Holding atStart;
    FlownHour flown;
    {
        const auto opened = Planet::open(path_, settings);
        ASSERT_TRUE(opened) << opened.error().message;
        fly(**opened, test::flightSeconds(300), flown);
        if (HasFatalFailure()) return;
    }
    const Holding atEnd;
    std::cout << flown.frames << " frames over " << flown.legs << " places, budget " << settings.budgetBytes
              << " bytes (" << flown.chunkSlots << " slots for chunks, " << flown.colourSlots
              << " for colours, " << flown.normalSlots << " for normals; short of room in "
              << flown.framesShort << " frames): " << flown.paging.loaded() << " blocks loaded, "
              << flown.paging.dropped() << " dropped, " << flown.paging.loadedSoonAgain()
              << " loaded again within " << test::PagingWatch::soonS
              << " s of being dropped\nlongest wait by priority: " << flown.paging.waitsText()
              << "\nresident bytes " << flown.early.residentBytes << " then " << flown.late.residentBytes
              << ", heap " << flown.early.heapBytes << " then " << flown.late.heapBytes << ", files "
              << atStart.files << " then " << atEnd.files << "\n"
              << flown.legsSettled << " of " << flown.legs << " hovers came to rest\n";
    EXPECT_EQ(atEnd.files, atStart.files);
    EXPECT_EQ(flown.late.files, flown.early.files);
    // Sanitizers bring allocators that keep what was freed for a while.
    if (!tests::sanitized) {
        EXPECT_EQ(atEnd.threads, atStart.threads);
        expectFlat("resident memory", flown.early.residentBytes, flown.late.residentBytes);
        expectFlat("heap", flown.early.heapBytes, flown.late.heapBytes);
    }
    EXPECT_EQ(flown.problems, 0u);
    EXPECT_LE(flown.paging.longestHistory(), 1000u);
    EXPECT_GT(flown.paging.dropped(), flown.frames / 100);
    EXPECT_GT(flown.framesShort, 0u);
    EXPECT_LT(flown.paging.shareSoonAgain(), 0.15);
    EXPECT_LT(flown.paging.longestWaitS(), 3);
    EXPECT_LT(flown.paging.urgentWaitS(), flown.paging.otherWaitS());
    EXPECT_EQ(flown.legsSettled, flown.legs);
}

}  // namespace
}  // namespace planet
