#include "app/editor/source_controller.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/app/session_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace worldy {
namespace {

using State = ui::SourcesView::State;
using ::testing::HasSubstr;

// A planet of two layers: an image of the whole planet, and a raster of 500 m around 10 E, 45 N.
class SourceControllerTest : public test::SessionTest {
protected:
    SourceControllerTest() {
        writeSource("slope.pgm");
        planet::test::writeRaster(folder_ / "mesa.tif",
                                  planet::test::gridAround(4326, 10, 45, 101, 101, 0.05),
                                  [](double, double) { return 500; });
        std::ofstream(folder_ / "world.toml")
            << "[[elevation]]\nfiles = \"slope.pgm\"\n[[elevation]]\nfiles = \"mesa.tif\"\n";
        editor_.workspace.inFront = {PanelId::Quadtree, PanelId::Lod, PanelId::Paging};
    }

    // Frames until something holds.
    bool framesUntil(Session& session, const std::function<bool()>& holds) {
        return advanceUntil(session, [&] {
            advanceSources(sources_, {shownPlanet(session), editor_, focus_, picture_}, log_);
            return holds();
        });
    }
    ui::SourcesView view(const Session& session) const { return sourcesViewOf(sources_, session); }
    void show(PanelId panel) {
        editor_.workspace.inFront[0] = panel,
        editor_.workspace.panels[static_cast<std::size_t>(panel)].shown = true;
    }
    ui::Commands run(Session& session, const ui::SourceCommand& command) {
        ui::Commands next;
        execute(sources_, command, shownPlanet(session), editor_.workspace, notices_, next);
        return next;
    }

    Settings editor_;
    ChunkFocus focus_;
    PlanetPicture picture_;
    SourceController sources_;
    Notices notices_{log_};
};

TEST_F(SourceControllerTest, BakedPlanetKnowsItsLayersAndAChunkFileDoesNot) {
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && view(session).state == State::Read; }));
    EXPECT_EQ(view(session).layers->layers.size(), 2u);
    const std::filesystem::path baked = session.open->data.chunkFile;

    // The same bake, found in the cache, is read when the panel is in front.
    Session again = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(again, [&] { return again.open.has_value(); }));
    ASSERT_TRUE(framesUntil(again, [&] { return sources_.scene == again.open->scene.identity; }));
    EXPECT_EQ(view(again).state, State::Unread);
    show(PanelId::Sources);
    ASSERT_TRUE(framesUntil(again, [&] { return view(again).state == State::Read; }));

    std::filesystem::copy_file(baked, folder_ / "alone.chk");
    Session alone = sessionOf(folder_ / "alone.chk");
    ASSERT_TRUE(
        framesUntil(alone, [&] { return alone.open && sources_.scene == alone.open->scene.identity; }));
    EXPECT_EQ(view(alone).state, State::Unknown);
    EXPECT_EQ(view(alone).edit, nullptr);
}

TEST_F(SourceControllerTest, SelectedChunkAndTintSayTheTopmostLayer) {
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && sources_.reader.layers; }));
    const planet::Geographic middle{45 * planet::test::radPerDeg, 10 * planet::test::radPerDeg};
    focus_.selected =
        planet::chunkAt(planet::facePointFromDirection(planet::directionFromGeographic(middle)), 10);
    ASSERT_TRUE(framesUntil(session, [&] { return sources_.queries.selected.has_value(); }));
    ASSERT_EQ(sources_.queries.selected->readings.size(), 2u);
    EXPECT_EQ(sources_.queries.selected->readings[0].heightM, 500);
    EXPECT_EQ(sources_.queries.selected->readings[0].file, folder_ / "mesa.tif");
    EXPECT_EQ(sources_.queries.selected->readings[1].file, folder_ / "slope.pgm");
    focus_.selected.reset();
    ASSERT_TRUE(framesUntil(session, [&] { return !sources_.queries.selected; }));

    editor_.view.overlay.colourBy = ColourBy::Source;
    editor_.view.lod.tauPx = 0.1;
    const planet::View over =
        planet::viewFromPose({.latitudeDeg = 45, .longitudeDeg = 10, .altitudeM = 5e4},
                             session.open->scene.planet->tree().shape.radiusM, 1, 64, 64);
    ASSERT_TRUE(settleScene(session.open->scene, over, editor_.view, 60));
    const planet::Selection& drawn = session.open->scene.planet->selection();
    ASSERT_TRUE(framesUntil(session, [&] { return sources_.queries.tops.size() >= drawn.draw.size(); }));
    int onMesa = 0;
    for (const planet::DrawItem& item : drawn.draw) {
        const planet::FaceSquare square = planet::faceSquareOf(item.id);
        const planet::Geographic place = planet::geographicFromDirection(planet::sphereFromCube(
            planet::cubePoint(item.id.face, square.u + square.side / 2, square.v + square.side / 2)));
        const double off = std::max(std::abs(place.latitudeRad / planet::test::radPerDeg - 45),
                                    std::abs(place.longitudeRad / planet::test::radPerDeg - 10));
        EXPECT_EQ(sources_.queries.tops.at(item.id), off < 2.525 ? 1u : 0u) << toString(item.id);
        onMesa += off < 2.525 ? 1 : 0;
    }
    EXPECT_GT(onMesa, 0);
    editor_.view.overlay.colourBy = ColourBy::LeafDepth;
    ASSERT_TRUE(framesUntil(session, [&] { return sources_.depths.depths.has_value(); }));
}

TEST_F(SourceControllerTest, EditedLayersAreBakedAndOutliveTheirPlanet) {
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && view(session).edit; }));
    EXPECT_FALSE(view(session).edited);
    WorldEdit edit = *view(session).edit;
    edit.layers[1].offsetM = 100;
    run(session, ui::EditLayers{edit});
    EXPECT_TRUE(view(session).edited);
    const ui::Commands next = run(session, ui::BakeLayers{});
    ASSERT_EQ(next.size(), 1u);
    const auto* const bake = next[0].as<ui::StartBake>();
    ASSERT_NE(bake, nullptr);
    startBake(session, bake->request, log_);
    const std::shared_ptr<const int> before = session.open->scene.identity;
    ASSERT_TRUE(framesUntil(session, [&] { return !session.bake && sources_.scene != before; }));
    ASSERT_EQ(session.bakeProblem, std::nullopt);
    const double highestM = planet::heightM(session.open->scene.planet->tree().storedShape,
                                            session.open->scene.planet->tree().maxStep);
    EXPECT_NEAR(highestM, 600, 1) << "the raster with its offset";
    EXPECT_FALSE(view(session).edited) << "the planet was baked from these layers";
    EXPECT_TRUE(view(session).unsaved) << "the world file that was opened has others";
    EXPECT_EQ(view(session).source, folder_ / "world.toml");
    EXPECT_EQ(view(session).edit->layers[1].offsetM, 100);
    run(session, ui::RevertLayers{});
    EXPECT_FALSE(view(session).unsaved);
    EXPECT_EQ(view(session).edit->layers[1].offsetM, 0);
    EXPECT_TRUE(view(session).edited) << "the planet still shows the offset";
    run(session, ui::RevertLayers{});
    EXPECT_EQ(view(session).edit->layers[1].offsetM, 100) << "the layers of the planet";
    EXPECT_FALSE(view(session).edited);
}

TEST_F(SourceControllerTest, WrongEditIsSaidAndNotBaked) {
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && view(session).edit; }));
    WorldEdit edit = *view(session).edit;
    edit.layers[0].on = edit.layers[1].on = false;
    run(session, ui::EditLayers{edit});
    EXPECT_THAT(view(session).bakeProblem, HasSubstr("no layer is on"));
    EXPECT_TRUE(run(session, ui::BakeLayers{}).empty());
    EXPECT_THAT(notices_.message.text, HasSubstr("no layer is on"));
}

TEST_F(SourceControllerTest, SavedLayersAreStillOthersThanThePlanetShows) {
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && view(session).edit; }));
    WorldEdit edit = *view(session).edit;
    edit.layers[0].on = false;
    run(session, ui::EditLayers{edit});
    run(session, ui::SaveLayers{folder_ / "saved.toml"});
    EXPECT_TRUE(planet::isWorldFile(folder_ / "saved.toml"));
    EXPECT_FALSE(view(session).unsaved);
    EXPECT_TRUE(view(session).edited) << "the planet was baked with the layer";
    EXPECT_EQ(run(session, ui::BakeLayers{}).size(), 1u);
    const auto saved = planet::readWorldFile(folder_ / "saved.toml");
    ASSERT_TRUE(saved);
    EXPECT_EQ(saved->layers.size(), 2u);
    EXPECT_FALSE(saved->layers[0].on);
    run(session, ui::RevertLayers{});
    EXPECT_TRUE(view(session).edit->layers[0].on) << "the layers of the planet";
    EXPECT_FALSE(view(session).edited);
    EXPECT_TRUE(view(session).unsaved);
}

TEST_F(SourceControllerTest, ExistingFileIsReplacedOnlyIfTheUserSaysSo) {
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && view(session).edit; }));
    WorldEdit edit = *view(session).edit;
    edit.layers[1].offsetM = 100;
    run(session, ui::EditLayers{edit});
    const std::filesystem::path file = folder_ / "notes.toml";
    std::ofstream(file) << "# mine\n";
    run(session, ui::SaveLayers{file});
    EXPECT_EQ(view(session).replaces, file);
    EXPECT_TRUE(view(session).edited);
    EXPECT_FALSE(planet::isWorldFile(file));
    run(session, ui::SaveLayers{file, true});
    EXPECT_TRUE(view(session).replaces.empty());
    EXPECT_FALSE(view(session).unsaved);
    EXPECT_TRUE(planet::isWorldFile(file));
}

TEST_F(SourceControllerTest, UnsavedChangesAreThereAgainWhenTheirSourceIs) {
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && view(session).edit; }));
    WorldEdit edit = *view(session).edit;
    edit.layers[1].offsetM = 100;
    run(session, ui::EditLayers{edit});
    ASSERT_TRUE(openFile(session, folder_ / "slope.pgm", editor_.view, log_));
    ASSERT_TRUE(framesUntil(session, [&] { return view(session).source == folder_ / "slope.pgm"; }));
    EXPECT_FALSE(view(session).edited);
    ASSERT_TRUE(openFile(session, folder_ / "world.toml", editor_.view, log_));
    ASSERT_TRUE(framesUntil(session, [&] { return view(session).source == folder_ / "world.toml"; }));
    EXPECT_TRUE(view(session).edited);
    EXPECT_EQ(view(session).edit->layers[1].offsetM, 100);
}

TEST_F(SourceControllerTest, OnlyGeoreferencedRastersAreAskedAbout) {
    EXPECT_FALSE(takeDroppedFile(sources_, folder_ / "mesa.tif")) << "no planet is open";
    Session session = sessionOf(folder_ / "world.toml");
    ASSERT_TRUE(framesUntil(session, [&] { return session.open && view(session).edit; }));
    EXPECT_FALSE(takeDroppedFile(sources_, folder_ / "slope.pgm"));
    EXPECT_FALSE(takeDroppedFile(sources_, folder_ / "world.toml"));
    EXPECT_FALSE(takeDroppedFile(sources_, session.open->data.chunkFile));
    EXPECT_TRUE(takeDroppedFile(sources_, folder_ / "mesa.tif"));
    planet::test::writeRaster(folder_ / "second.tif", planet::test::gridAround(4326, 0, 0, 11, 11, 0.05),
                              [](double, double) { return 1; });
    EXPECT_TRUE(takeDroppedFile(sources_, folder_ / "second.tif"));
    EXPECT_EQ(view(session).dropped.size(), 2u);
    run(session, ui::AddDroppedFiles{});
    EXPECT_TRUE(view(session).dropped.empty());
    ASSERT_EQ(view(session).edit->layers.size(), 3u);
    EXPECT_EQ(view(session).edit->layers[2].files.size(), 2u);
    EXPECT_EQ(editor_.workspace.inFront[static_cast<std::size_t>(Dock::Left)], PanelId::Sources);

    takeDroppedFile(sources_, folder_ / "mesa.tif");
    takeDroppedFile(sources_, folder_ / "second.tif");
    const ui::Commands open = run(session, ui::OpenDroppedFiles{});
    ASSERT_EQ(open.size(), 1u);
    EXPECT_EQ(open[0].as<ui::OpenFile>()->file,
              (folder_ / "mesa.tif").string() + "|" + (folder_ / "second.tif").string());
}

}  // namespace
}  // namespace worldy
