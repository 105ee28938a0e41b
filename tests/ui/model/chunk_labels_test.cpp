#include "ui/model/chunk_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "tests/support/fake_pyramid.h"

namespace worldy::ui {
namespace {

const planet::ChunkTree& tree() {
    static const planet::ChunkTree made = planet::residentTree(planet::fakePyramid(), 4);
    return made;
}

// Looks down at latitude 0, longitude 0.
planet::View viewFrom(double altitudeM, double pitchDeg = -90) {
    return planet::viewFromPose({0, 0, altitudeM, 0, pitchDeg}, tree().shape.radiusM, 1.0, 1600, 900);
}

planet::Selection drawnFrom(const planet::View& view) {
    planet::Selection selection;
    selectChunks(tree(), view, {.tauPx = 0.5, .frustumCulling = false, .horizonCulling = false}, selection);
    return selection;
}

glm::vec2 fixedWidthText(std::string_view text) {
    return {8.0f * static_cast<float>(text.size()), 14};
}

ChunkLabelSettings settingsOf(ChunkLabels show) {
    return {.show = show, .areaPx = {800, 450}};
}

bool isInside(const ChunkLabel& label, const glm::vec2& areaPx) {
    const glm::vec2 end = label.topLeft + label.size;
    return label.topLeft.x >= 0 && label.topLeft.y >= 0 && end.x <= areaPx.x && end.y <= areaPx.y;
}

bool areApart(const ChunkLabel& a, const ChunkLabel& b) {
    return a.topLeft.x >= b.topLeft.x + b.size.x || b.topLeft.x >= a.topLeft.x + a.size.x ||
           a.topLeft.y >= b.topLeft.y + b.size.y || b.topLeft.y >= a.topLeft.y + a.size.y;
}

TEST(ChunkLabels, NoTwoOverlapAndAllLieInsideThePicture) {
    struct Place {
        double altitudeM, pitchDeg;
    };
    for (const Place& place : {Place{2e5, -90}, Place{2e5, -80}, Place{6e4, -90}, Place{1e4, -20}}) {
        const planet::View view = viewFrom(place.altitudeM, place.pitchDeg);
        const auto labels = chunkLabels(view, tree(), drawnFrom(view).draw,
                                        settingsOf(ChunkLabels::LevelAndError), fixedWidthText);
        ASSERT_GT(labels.size(), 5u) << place.altitudeM << " m, " << place.pitchDeg << " degrees";
        for (std::size_t i = 0; i < labels.size(); ++i) {
            EXPECT_TRUE(isInside(labels[i], {800, 450})) << toString(labels[i].id);
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_TRUE(areApart(labels[i], labels[j]))
                    << toString(labels[i].id) << " and " << toString(labels[j].id);
            }
        }
    }
}

TEST(ChunkLabels, StandOverTheMiddleOfTheirChunk) {
    const planet::View view = viewFrom(2e5);
    const planet::Selection selection = drawnFrom(view);
    const auto labels =
        chunkLabels(view, tree(), selection.draw, settingsOf(ChunkLabels::Level), fixedWidthText);
    ASSERT_FALSE(labels.empty());
    for (const ChunkLabel& label : labels) {
        const planet::FaceSquare square = faceSquareOf(label.id);
        const glm::dvec3 direction = planet::sphereFromCube(
            planet::cubePoint(label.id.face, square.u + square.side / 2, square.v + square.side / 2));
        // From straight above, east is right and north is up.
        const glm::vec2 middle = label.topLeft + label.size / 2.0f;
        if (std::abs(direction.y) > 0.02) {
            EXPECT_EQ(middle.x > 400, direction.y > 0) << toString(label.id);
        }
        if (std::abs(direction.z) > 0.02) {
            EXPECT_EQ(middle.y<225, direction.z> 0) << toString(label.id);
        }
    }
}

TEST(ChunkLabels, LeaveOutWhatThePlanetHides) {
    const planet::View view = viewFrom(2e5);
    const planet::Selection selection = drawnFrom(view);
    const auto isBehind = [](const planet::ChunkId& id) {
        const planet::FaceSquare square = faceSquareOf(id);
        return planet::cubePoint(id.face, square.u + square.side / 2, square.v + square.side / 2).x < -0.2;
    };
    ASSERT_TRUE(std::any_of(selection.draw.begin(), selection.draw.end(),
                            [&](const planet::DrawItem& item) { return isBehind(item.id); }));
    for (const bool cube : {false, true}) {
        ChunkLabelSettings settings = settingsOf(ChunkLabels::Level);
        settings.cube = cube;
        const auto labels = chunkLabels(view, tree(), selection.draw, settings, fixedWidthText);
        ASSERT_FALSE(labels.empty());
        for (const ChunkLabel& label : labels) EXPECT_FALSE(isBehind(label.id)) << toString(label.id);
    }
}

TEST(ChunkLabels, NearChunksComeFirst) {
    const planet::View view = viewFrom(1e4, -20);
    const planet::Selection selection = drawnFrom(view);
    const auto labels =
        chunkLabels(view, tree(), selection.draw, settingsOf(ChunkLabels::Level), fixedWidthText);
    ASSERT_GT(labels.size(), 5u);
    double last = 0;
    for (const ChunkLabel& label : labels) {
        const planet::NodeIndex node = findNode(tree(), label.id);
        const glm::dvec3 middle = planet::vertexM(tree().shape, planet::fakePyramid().at(label.id), 8, 8);
        ASSERT_NE(node, planet::noNode);
        EXPECT_GE(glm::length(middle - view.eyeM), last);
        last = glm::length(middle - view.eyeM);
    }
}

TEST(ChunkLabels, SayWhatIsAskedFor) {
    const planet::View view = viewFrom(2e5);
    planet::Selection selection = drawnFrom(view);
    selection.draw.resize(1);
    selection.draw[0].epsPx = 1.25f;
    const auto textFor = [&](ChunkLabels show) {
        const auto labels = chunkLabels(view, tree(), selection.draw, settingsOf(show), fixedWidthText);
        return labels.empty() ? std::string("nothing") : labels.front().text;
    };
    const std::string level = std::to_string(selection.draw[0].id.level);
    EXPECT_EQ(textFor(ChunkLabels::None), "nothing");
    EXPECT_EQ(textFor(ChunkLabels::Level), level);
    EXPECT_EQ(textFor(ChunkLabels::Error), "1.2 px");
    EXPECT_EQ(textFor(ChunkLabels::LevelAndError), level + ": 1.2 px");
}

TEST(ChunkLabels, KeepOffWhatIsTaken) {
    const planet::View view = viewFrom(2e5);
    const planet::Selection selection = drawnFrom(view);
    ChunkLabelSettings settings = settingsOf(ChunkLabels::Level);
    const std::size_t all = chunkLabels(view, tree(), selection.draw, settings, fixedWidthText).size();
    settings.taken = {{300, 100, 150, 200}};
    const auto labels = chunkLabels(view, tree(), selection.draw, settings, fixedWidthText);
    EXPECT_LT(labels.size(), all);
    EXPECT_FALSE(labels.empty());
    const ChunkLabel box{{}, "", {300, 100}, {150, 200}};
    for (const ChunkLabel& label : labels) EXPECT_TRUE(areApart(label, box)) << toString(label.id);
}

TEST(ChunkLabels, ATinyPictureHoldsNone) {
    const planet::View view = viewFrom(2e5);
    ChunkLabelSettings settings = settingsOf(ChunkLabels::LevelAndError);
    settings.areaPx = {20, 10};
    EXPECT_TRUE(chunkLabels(view, tree(), drawnFrom(view).draw, settings, fixedWidthText).empty());
}

}  // namespace
}  // namespace worldy::ui
