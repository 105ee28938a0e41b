#include "ui/model/note_subjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/empty_view.h"
#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

constexpr double earthRadiusM = 6'371'000;

planet::View viewFrom(const planet::CameraPose& pose) {
    return planet::viewFromPose(pose, earthRadiusM, 1.0, 1000, 600);
}
Note noteAt(double latitudeDeg, double longitudeDeg, double heightM = 0) {
    Note note;
    note.latitudeDeg = latitudeDeg;
    note.longitudeDeg = longitudeDeg;
    note.heightM = heightM;
    return note;
}
std::optional<glm::dvec2> pinOf(const planet::View& view, const Note& note) {
    return pinInPicture(view, placeOfNote(note, earthRadiusM, 1), earthRadiusM);
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
    EXPECT_NEAR(glm::length(placeOfNote(noteAt(20, 10, 1000), earthRadiusM, 3)), earthRadiusM + 3000, 1e-6);
}

// A planet of six chunks, flat but for a wall along the meridian 0, which falls to both sides within a cell.
planet::ChunkTree planetWithWall(double wallOfRadius) {
    const planet::FakePyramid& pyramid = planet::fakePyramid();
    const int side = planet::chunkSize(pyramid.shape);
    const auto stepAt = [&](double heightM) {
        return static_cast<std::int32_t>(
            std::lround((heightM - pyramid.shape.baseHeightM) / pyramid.shape.quantumM));
    };
    std::array<planet::ChunkData, planet::faceCount> roots = pyramid.roots();
    for (planet::ChunkData& root : roots) {
        root.children = {};
        root.deltaCM = root.deltaTightM = 0;
        std::vector<std::int32_t> steps(static_cast<std::size_t>(side * side), stepAt(0));
        if (root.id.face == planet::Face::PosX) {
            for (int row = 0; row < side; ++row)
                steps[static_cast<std::size_t>(row * side + side / 2)] =
                    stepAt(wallOfRadius * pyramid.shape.radiusM);
        }
        root.minStep = *std::min_element(steps.begin(), steps.end());
        root.maxStep = *std::max_element(steps.begin(), steps.end());
        root.heights = planet::Steps(std::span<const std::int32_t>(steps));
    }
    return planet::makeChunkTree(pyramid.shape, stepAt(0), stepAt(0.08 * pyramid.shape.radiusM),
                                 std::move(roots))
        .value();
}

// A camera west of the wall, at 0.3 radii, sees a place east of it over the wall at 0.043 radii.
bool isCovered(double wallOfRadius, double placeLongitudeDeg) {
    const planet::ChunkTree tree = planetWithWall(wallOfRadius);
    const double ownM = tree.shape.radiusM;
    const planet::View view = planet::viewFromPose({0, -22.5, 0.3 * ownM, 90, -30}, ownM, 1.5, 1000, 600);
    std::vector<planet::DrawItem> drawn;
    for (planet::NodeIndex i = 0; i < tree.nodes.size(); ++i)
        drawn.push_back({.node = i, .id = tree.nodes[i].id});
    const glm::dvec3 placeM = placeOfNote(noteAt(0, placeLongitudeDeg), ownM, 1);
    EXPECT_TRUE(pinInPicture(view, placeM, ownM));
    return isCoveredPin(tree, drawn, view, placeM);
}

TEST(NotePins, aMountainCoversThePinBehindIt) {
    EXPECT_TRUE(isCovered(0.06, 11.25));
    EXPECT_FALSE(isCovered(0.03, 11.25)) << "the pin is seen over the wall";
    EXPECT_FALSE(isCovered(0.06, -8)) << "the pin lies in front of the wall";
}

TEST(NotePins, flatGroundCoversNoPinInFrontOfTheHorizon) {
    for (double longitudeDeg = -10; longitudeDeg <= 14; longitudeDeg += 3)
        EXPECT_FALSE(isCovered(0, longitudeDeg)) << longitudeDeg;
}

// From low over flat ground, with the wall's top above the eye.
TEST(GroundInMiddle, isOnTheMountainAheadThatRisesAboveTheEye) {
    const planet::ChunkTree tree = planetWithWall(0.06);
    const double ownM = tree.shape.radiusM;
    std::vector<planet::DrawItem> drawn;
    for (planet::NodeIndex i = 0; i < tree.nodes.size(); ++i)
        drawn.push_back({.node = i, .id = tree.nodes[i].id});
    const planet::View view = planet::viewFromPose({0, -12, 0.03 * ownM, 90, 0}, ownM, 1.5, 1000, 600);
    const glm::dvec3 place = groundInMiddle(view, tree, drawn);
    const planet::Geographic at = planet::geographicFromDirection(glm::normalize(place));
    EXPECT_GT(glm::degrees(at.longitudeRad), -11.5) << "it is below the camera";
    EXPECT_LT(glm::degrees(at.longitudeRad), 0.1);
    EXPECT_GT(glm::length(place), 1.02 * ownM);
    const planet::View sky = planet::viewFromPose({0, -12, 0.03 * ownM, 90, 60}, ownM, 1.5, 1000, 600);
    EXPECT_NEAR(glm::length(groundInMiddle(sky, tree, drawn)), ownM, 1) << "the sky is seen";
}

class NoteSubjects : public testing::Test {
protected:
    NoteSubjects() { view_.planet = planet_.get(); }

    const NoteSubject& subject(const std::string& label) {
        subjects_ = noteSubjects(view_, 1);
        for (const NoteSubject& each : subjects_)
            if (each.label == label) return each;
        throw std::runtime_error("no subject " + label);
    }

    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    EmptyView empty_;
    EditorView& view_ = empty_.view;
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

TEST_F(NoteSubjects, costsASweepAComparisonAndTheRulerAreNotedWithTheirFigures) {
    const double own = planet_->tree().shape.radiusM;
    view_.camera.renderView = planet::viewFromPose({20, 10, own, 0, -90}, own, 1, 1000, 600);
    for (const char* label : {"the costs of features", "the sweep", "the comparison", "the ruler"})
        EXPECT_FALSE(subject(label).note) << label;

    view_.instruments.light.costs = {{"shadows", 10, 14}};
    SweepTable table;
    table.flight = "andes low";
    table.points = {{33, planet::ErrorMetric::Additive, 2, {.meanTriangles = 1000, .worstMeasuredPx = 1.5}},
                    {33, planet::ErrorMetric::Additive, 4, {.meanTriangles = 2000, .worstMeasuredPx = 3}}};
    view_.sweep.table = &table;
    std::array<ComparedFigures, 2> sides;
    sides[0].triangles = 1000;
    sides[1].triangles = 500;
    view_.compare.flight.last = &sides;
    view_.compare.flight.lastName = "andes low, 12 sample frames";
    const std::vector<glm::dvec3> ends = {{own, 0, 0}, {0, own, 0}};
    MeasuredGround ground;
    ground.summary.riseM = 42;
    view_.instruments.ruler.ends = ends;
    view_.instruments.ruler.measured = &ground;

    const auto figures = [&](const char* label) { return subject(label).note->measurement; };
    EXPECT_EQ(figures("the costs of features"), "shadows +4.0 ms, 1.40 x");
    const std::string sweep = figures("the sweep");
    EXPECT_NE(sweep.find("over andes low, 2 points"), std::string::npos) << sweep;
    EXPECT_NE(sweep.find("\u03c4 2 px: 1000 triangles, max true error 1.5 px"), std::string::npos) << sweep;
    EXPECT_EQ(sweep.find("\u03c4 4 px"), std::string::npos) << "not on the front: " << sweep;
    EXPECT_NE(figures("the comparison").find("Triangles 1000, 500"), std::string::npos)
        << figures("the comparison");
    EXPECT_NE(figures("the ruler").find("Height difference 42.00 m"), std::string::npos);
    EXPECT_EQ(subject("the ruler").note->longitudeDeg, 0);
    EXPECT_NEAR(subject("the sweep").note->longitudeDeg, 10, 1e-6);
}

TEST_F(NoteSubjects, longFiguresAreShortenedToWhatANoteHolds) {
    const double own = planet_->tree().shape.radiusM;
    view_.camera.renderView = planet::viewFromPose({}, own, 1, 1000, 600);
    SweepTable table;
    table.flight = "andes low";
    for (int i = 0; i < 200; ++i)
        table.points.push_back({33,
                                planet::ErrorMetric::Additive,
                                1.0 + i,
                                {.meanTriangles = 1000.0 - i, .worstMeasuredPx = 1.0 + i}});
    view_.sweep.table = &table;
    const std::string text = subject("the sweep").note->measurement;
    EXPECT_LE(text.size(), longestNoteBytes);
    EXPECT_TRUE(text.ends_with(" px; ...")) << text.substr(text.size() - 20);
}

}  // namespace
}  // namespace worldy::ui
