#include "ui/model/note_subjects.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

constexpr double radiusM = 6'371'000;

planet::View viewFrom(const planet::CameraPose& pose) {
    return planet::viewFromPose(pose, radiusM, 1.0, 1000, 600);
}
Note noteAt(double latitudeDeg, double longitudeDeg, double heightM = 0) {
    Note note;
    note.latitudeDeg = latitudeDeg;
    note.longitudeDeg = longitudeDeg;
    note.heightM = heightM;
    return note;
}
std::optional<glm::dvec2> pinOf(const planet::View& view, const Note& note) {
    return pinInPicture(view, placeOfNote(note, radiusM, 1), radiusM);
}

TEST(NotePins, thePlaceBelowTheCameraIsInTheMiddle) {
    const planet::View view = viewFrom({20, 10, 1e7, 0, -90});
    const auto at = pinOf(view, noteAt(20, 10));
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x, 500, 1e-6);
    EXPECT_NEAR(at->y, 300, 1e-6);
    // North is up, east is to the right.
    EXPECT_LT(pinOf(view, noteAt(25, 10))->y, 300);
    EXPECT_GT(pinOf(view, noteAt(20, 15))->x, 500);
}

TEST(NotePins, theFarSideIsHiddenBehindTheHorizon) {
    const planet::View view = viewFrom({0, 0, 1e7, 0, -90});
    // The horizon is acos(R / (R + h)) = 67.1 degrees away.
    EXPECT_TRUE(pinOf(view, noteAt(0, 66)));
    EXPECT_FALSE(pinOf(view, noteAt(0, 69)));
    EXPECT_FALSE(pinOf(view, noteAt(0, 180)));
    // A high place is seen from further away.
    EXPECT_TRUE(pinOf(view, noteAt(0, 69, 100'000)));
}

TEST(NotePins, aPlaceBelowTheRadiusIsNotHiddenByItself) {
    EXPECT_TRUE(pinOf(viewFrom({20, 10, 1e6, 0, -90}), noteAt(20, 10, -10'000)));
}

TEST(NotePins, whatIsBehindTheCameraOrOutsideThePictureHasNoPin) {
    EXPECT_FALSE(pinOf(viewFrom({20, 10, 1e6, 0, 90}), noteAt(20, 10)));
    EXPECT_FALSE(pinOf(viewFrom({20, 10, 1e5, 0, -90}), noteAt(30, 10)));
}

TEST(NotePins, exaggerationLiftsThePlace) {
    EXPECT_NEAR(glm::length(placeOfNote(noteAt(20, 10, 1000), radiusM, 3)), radiusM + 3000, 1e-6);
}

class NoteSubjects : public testing::Test {
protected:
    const NoteSubject& subject(const std::string& label) {
        subjects_ = noteSubjects(view_, 1);
        for (const NoteSubject& each : subjects_)
            if (each.label == label) return each;
        throw std::runtime_error("no subject " + label);
    }

    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    FrameStats stats_;
    std::deque<FrameSample> history_;
    planet::LodChanges changes_;
    std::deque<LogLine> log_;
    EditorView view_{.planet = planet_.get(),
                     .frames = {.stats = stats_, .history = history_},
                     .log = log_,
                     .instruments = {.changes = changes_}};
    std::vector<NoteSubject> subjects_;
};

TEST_F(NoteSubjects, aViewIsNotedWhereItLooks) {
    const double own = planet_->tree().shape.radiusM;
    view_.camera.pose = {20, 10, own, 0, -90};
    view_.camera.renderView = planet::viewFromPose(view_.camera.pose, own, 1, 1000, 600);
    const NoteSubject& seen = subject("this view");
    ASSERT_TRUE(seen.note);
    EXPECT_NEAR(seen.note->latitudeDeg, 20, 1e-6);
    EXPECT_NEAR(seen.note->longitudeDeg, 10, 1e-6);
    EXPECT_EQ(seen.note->camera.altitudeM, own);
    EXPECT_EQ(seen.note->about, "view");
}

TEST_F(NoteSubjects, aSkyViewIsNotedBelowTheCamera) {
    const double own = planet_->tree().shape.radiusM;
    view_.camera.renderView = planet::viewFromPose({-30, 40, own, 0, 60}, own, 1, 1000, 600);
    const NoteSubject& seen = subject("this view");
    EXPECT_NEAR(seen.note->latitudeDeg, -30, 1e-6);
    EXPECT_NEAR(seen.note->longitudeDeg, 40, 1e-6);
}

TEST_F(NoteSubjects, whatIsNotMeasuredSaysWhatToDo) {
    view_.camera.renderView = planet::viewFromPose({}, planet_->tree().shape.radiusM, 1, 1000, 600);
    EXPECT_FALSE(subject("the selected chunk").note);
    EXPECT_EQ(subject("the largest true error").whyNot, "Measure the true error first.");
    EXPECT_EQ(subject("the largest edge gap").whyNot, "Measure the cracks first.");
}

TEST_F(NoteSubjects, aChunkIsNotedInItsMiddle) {
    view_.camera.renderView = planet::viewFromPose({}, planet_->tree().shape.radiusM, 1, 1000, 600);
    view_.focus.selected = planet::ChunkId{planet::Face::PosX, 0, 0, 0};
    const NoteSubject& chunk = subject("the selected chunk");
    ASSERT_TRUE(chunk.note);
    EXPECT_EQ(chunk.note->chunk, "x_pos/0/0/0");
    EXPECT_NEAR(chunk.note->latitudeDeg, 0, 1e-9);
    EXPECT_NEAR(chunk.note->longitudeDeg, 0, 1e-9);
}

TEST_F(NoteSubjects, aMeasurementIsNotedWhereItIsWorstWithItsFigures) {
    view_.camera.renderView = planet::viewFromPose({}, planet_->tree().shape.radiusM, 1, 1000, 600);
    CrackMeasurement measured;
    planet::EdgeGap gap;
    gap.gapM = 12;
    gap.facingPx = 1.5;
    gap.placeM = {0, planet_->tree().shape.radiusM, 0};
    measured.gaps = {gap};
    view_.instruments.cracks = {&measured, true, nullptr};
    const NoteSubject& cracks = subject("the largest edge gap");
    ASSERT_TRUE(cracks.note);
    EXPECT_NEAR(cracks.note->longitudeDeg, 90, 1e-9);
    EXPECT_EQ(cracks.note->about, "cracks");
    EXPECT_NE(cracks.note->measurement.find("gap 12 m"), std::string::npos) << cracks.note->measurement;
}

}  // namespace
}  // namespace worldy::ui
