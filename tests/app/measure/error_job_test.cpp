// The window's measuring of the true error, and what panels and tints make of it.
#include "app/measure/error_job.h"

#include <gtest/gtest.h>

#include <thread>

#include "app/editor/instrument_views.h"
#include "app/scene/overlay_colours.h"
#include "tests/support/hills_planet.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/temporary_folder.h"
#include "ui/model/overlay_legend.h"

namespace worldy {
namespace {

class Errors : public testing::Test {
protected:
    Errors() {
        lod_.tauPx = 3;
        view_ = planet::viewFromPose(
            {.latitudeDeg = 10, .longitudeDeg = 20, .altitudeM = 15'000, .pitchDeg = -20}, 100'000, 1.1, 800,
            600);
        planet_->settle(view_, lod_, planet::noUpload, 60);
    }

    // Frames until nothing is measured any more; fails after a minute.
    void runUntilDone(std::uint64_t frame) {
        for (int i = 0; i < 60'000; ++i) {
            advanceErrorMeter(*planet_, frame, meter_);
            if (!meter_.job) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        FAIL() << "it never ends";
    }

    tests::TemporaryFolder folder_;
    std::unique_ptr<planet::Planet> planet_ = planet::test::openHills(folder_ / "hills.chk");
    planet::LodSettings lod_ = planet::suddenLod();
    planet::View view_;
    ErrorMeter meter_;
};

TEST_F(Errors, AreMeasuredOnceWhenAskedFor) {
    advanceErrorMeter(*planet_, 6, meter_);
    EXPECT_FALSE(errorsViewOf(meter_, 6).running) << "nobody asked";
    meter_.wanted = true;
    EXPECT_TRUE(errorsViewOf(meter_, 6).running);
    runUntilDone(7);
    ASSERT_TRUE(meter_.last);
    EXPECT_EQ(meter_.last->frame, 7u);
    EXPECT_EQ(meter_.last->tauPx, 3);
    planet::FinestHeights heights(std::make_shared<const planet::ChunkFile>(planet_->file()));
    const auto directly = planet::measureTrueError(
        planet::snapshotOf(planet_->tree(), planet_->selection().draw, view_, false), heights);
    EXPECT_EQ(meter_.last->report, *directly);
    EXPECT_GT(meter_.last->report.worstFacingPx, 0.1);
    advanceErrorMeter(*planet_, 8, meter_);
    EXPECT_FALSE(meter_.job);
}

TEST_F(Errors, AreOutOfDateOnceAnythingElseIsDrawn) {
    meter_.wanted = true;
    runUntilDone(1);
    const auto current = [&] {
        advanceErrorMeter(*planet_, 2, meter_);
        return errorsViewOf(meter_, 2).current;
    };
    EXPECT_TRUE(current());
    const auto draw = [&](const planet::View& view, const planet::LodSettings& lod) {
        planet_->settle(view, lod, planet::noUpload, 60);
    };
    planet::LodSettings finer = lod_;
    finer.tauPx = 2.9;
    draw(view_, finer);
    EXPECT_FALSE(current());
    draw(view_, lod_);
    EXPECT_TRUE(current());
    planet::View elsewhere = view_;
    elsewhere.eyeM *= 1.001;
    draw(elsewhere, lod_);
    EXPECT_FALSE(current());
    draw(view_, lod_);
    planet_->setExaggeration(2);
    EXPECT_FALSE(current());
}

TEST_F(Errors, AreMeasuredAgainWhenTheViewHasChangedWhileThatIsSet) {
    meter_.keepMeasuring = true;
    runUntilDone(1);
    advanceErrorMeter(*planet_, 2, meter_);
    EXPECT_FALSE(meter_.job) << "the same chunks are measured twice";
    planet::View elsewhere = view_;
    elsewhere.eyeM *= 1.001;
    planet_->settle(elsewhere, lod_, planet::noUpload, 60);
    advanceErrorMeter(*planet_, 3, meter_);
    EXPECT_TRUE(meter_.job);
    forgetErrors(meter_);
    EXPECT_FALSE(meter_.last);
    EXPECT_FALSE(meter_.job);
    EXPECT_TRUE(meter_.keepMeasuring);
}

TEST_F(Errors, ThatCannotBeMeasuredSayWhyAndStop) {
    meter_.heights = std::make_shared<planet::FinestHeights>(
        [](const planet::ChunkId& parent, planet::BlockLocation, planet::StepsView) {
            return planet::Result<planet::SiblingBlock>(
                planet::ioError("hills.chk: reading the block of chunk " + planet::toString(parent)));
        });
    meter_.keepMeasuring = true;
    advanceErrorMeter(*planet_, 1, meter_);
    for (int i = 0; i < 60'000 && meter_.keepMeasuring; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        advanceErrorMeter(*planet_, 2, meter_);
    }
    EXPECT_FALSE(meter_.keepMeasuring);
    EXPECT_NE(errorsViewOf(meter_, 2).problem.find("hills.chk"), std::string::npos);
}

TEST_F(Errors, TintChunksByWhatWasMeasuredAndGreyWhereNothingWas) {
    meter_.wanted = true;
    runUntilDone(1);
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::Measured;
    ErrorMeasurement measured = *meter_.last;
    measured.indexOf.erase(measured.report.chunks[0].id);
    const auto tints = chunkTints(*planet_, planet_->selection(), overlay, 3, {.measured = &measured});
    ASSERT_EQ(tints.size(), measured.report.chunks.size());
    EXPECT_EQ(tints[0].rgba[0], 128);
    EXPECT_EQ(tints[0].rgba[2], 128);
    for (std::size_t i = 1; i < tints.size(); ++i) {
        const glm::vec3 wanted = errorColour(measured.report.chunks[i].facingPx / 3);
        EXPECT_NEAR(tints[i].rgba[0], 255 * wanted.x, 1) << i;
        EXPECT_NEAR(tints[i].rgba[1], 255 * wanted.y, 1) << i;
    }
    EXPECT_EQ(ui::legendOf(overlay, 3, 4).entries.back().label, "not measured");
    EXPECT_EQ(chunkTints(*planet_, planet_->selection(), overlay, 3).back().rgba[1], 128);
}

TEST(ErrorMeasurement, ListsViolationsFirstThenTheLargest) {
    planet::TrueErrorReport report;
    report.chunks.resize(3);
    report.chunks[0] = {.id = {planet::Face::PosX, 1, 0, 0}, .drawnBoundPx = 5, .facingPx = 1};
    report.chunks[1] = {.id = {planet::Face::PosX, 1, 1, 0}, .drawnBoundPx = 5, .facingPx = 2};
    report.chunks[2] = {.id = {planet::Face::PosX, 1, 0, 1}, .drawnBoundPx = 0.1, .facingPx = 0.5};
    const ErrorMeasurement measured = measurementOf(std::move(report));
    EXPECT_EQ(measured.worstFirst, (std::vector<std::size_t>{2, 1, 0}));
    EXPECT_EQ(measured.indexOf.at({planet::Face::PosX, 1, 1, 0}), 1u);
}

}  // namespace
}  // namespace worldy
