#include "app/scene/scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <future>
#include <glm/vec3.hpp>
#include <memory>
#include <stop_token>

#include "app/base/picture_file.h"
#include "app/scene/offscreen.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/scene_settings.h"
#include "planet/gl/device/render_target.h"
#include "planet/planet_tools.h"
#include "tests/app/session_fixture.h"
#include "tests/support/synthetic_colours.h"
#include "ui/model/overlay_legend.h"

namespace worldy {
namespace {

class SceneTest : public test::SessionTest {
protected:
    Scene openSlope(int faceSize = 513) {
        auto scene =
            openScene({.chunkFile = bakeTo("slope.chk", {.faceSize = faceSize, .chunkSize = 17})}, settings_);
        if (!scene) throw std::runtime_error(scene.error().message);
        return std::move(*scene);
    }
    static planet::View viewAt(double altitudeM, double longitudeDeg = 10) {
        return planet::viewFromPose({.longitudeDeg = longitudeDeg, .altitudeM = altitudeM}, 6'371'000, 1.0,
                                    160, 120);
    }
    std::vector<std::uint8_t> picture(Scene& scene, const planet::View& view, std::size_t selection = 0) {
        auto target = planet::gl::RenderTarget::create(view.widthPx, view.heightPx);
        target->bind();
        drawScene(scene, view, settings_, selection);
        target->resolve();
        return target->readRgb();
    }
};

// A program that embeds the library then sees what the editor shows.
TEST_F(SceneTest, TheLibrarysDefaultsAreTheEditors) {
    EXPECT_EQ(lodSettingsOf(ViewSettings()), planet::LodSettings());
}

TEST_F(SceneTest, selectionUsesTheSettingsAsTheyAre) {
    settings_.lod.tauPx = 3;
    settings_.lod.seams = planet::SeamMode::Stitched;
    EXPECT_EQ(lodSettingsOf(settings_), settings_.lod);
}

TEST_F(SceneTest, theCubeIsNotCulled) {
    EXPECT_TRUE(lodSettingsOf(settings_).frustumCulling);
    settings_.overlay.cube = true;
    EXPECT_FALSE(lodSettingsOf(settings_).frustumCulling);
    EXPECT_FALSE(lodSettingsOf(settings_).horizonCulling);
}

TEST_F(SceneTest, everySettingOfPagingReachesTheLibrary) {
    settings_.paging = {.budgetMB = 64,
                        .loaderThreads = 3,
                        .uploadLimitMs = 1.5,
                        .prefetch = {.mode = planet::PrefetchMode::Motion, .horizonS = 3, .share = 0.4},
                        .badDisk = {.latencyMs = 5, .failureRate = 0.5, .seed = 9}};
    const planet::PagingSettings paging = pagingSettingsOf(settings_, true);
    EXPECT_EQ(paging.budgetBytes, 64u << 20);
    EXPECT_EQ(paging.loaderThreads, 3);
    EXPECT_EQ(paging.uploadLimitMs, 1.5);
    EXPECT_TRUE(paging.paused);
    EXPECT_EQ(paging.badDisk, settings_.paging.badDisk);
    EXPECT_EQ(paging.prefetch, settings_.paging.prefetch);
    EXPECT_EQ(paging.time, planet::PagingTime::Clock);
    settings_.paging.simulated = true;
    EXPECT_EQ(pagingSettingsOf(settings_).time, planet::PagingTime::Simulated);
    EXPECT_EQ(pagingSettingsOf(settings_, false, planet::PagingTime::Recorded).time,
              planet::PagingTime::Recorded);
}

TEST_F(SceneTest, everySettingOfDrawingReachesTheLibraryAndHeightsAreExaggerated) {
    Scene scene = openSlope();
    settings_.surface.exaggeration = 3;
    ASSERT_TRUE(applyLiveSettings(scene, settings_));
    settings_.surface.surface = planet::gl::SurfaceColour::HeightRamp;
    settings_.surface.imageOpacity = 0.4;
    settings_.surface.ramp = {{100, {1, 0, 0}}, {200, {0, 1, 0}}};
    settings_.surface.sea = false;
    settings_.surface.seaLevelM = 50;
    settings_.surface.lighting = false;
    settings_.surface.detail = planet::gl::FeatureUse::Off;
    settings_.surface.sunFollows = false;
    settings_.surface.sunLatitudeDeg = 90;
    settings_.overlay.wireframe = true;
    settings_.overlay.outlines = true;
    settings_.overlay.skirtPaint = planet::gl::SkirtPaint::LoudAlone;
    const planet::gl::RenderSettings render = renderSettingsOf(settings_, viewAt(1e6), scene.planet->tree());
    EXPECT_EQ(render.surface, planet::gl::SurfaceColour::HeightRamp);
    EXPECT_EQ(render.imageOpacity, 0.4);
    ASSERT_EQ(render.ramp.size(), 2u);
    EXPECT_EQ(render.ramp[1].heightM, 600);
    EXPECT_EQ(render.ramp[1].colour, glm::vec3(0, 1, 0));
    EXPECT_FALSE(render.sea);
    EXPECT_EQ(render.seaLevelM, 150);
    EXPECT_FALSE(render.lighting);
    EXPECT_EQ(render.detail, planet::gl::FeatureUse::Off);
    EXPECT_TRUE(render.atmosphere);
    EXPECT_NEAR(render.sunDirection.z, 1, 1e-9);
    EXPECT_TRUE(render.wireframe);
    EXPECT_TRUE(render.outlines);
    EXPECT_EQ(render.skirtPaint, planet::gl::SkirtPaint::LoudAlone);
    EXPECT_FALSE(render.stitched);
    settings_.lod.seams = planet::SeamMode::Stitched;
    EXPECT_TRUE(renderSettingsOf(settings_, viewAt(1e6), scene.planet->tree()).stitched);
    settings_.overlay.cube = true;
    EXPECT_FALSE(renderSettingsOf(settings_, viewAt(1e6), scene.planet->tree()).atmosphere);
}

TEST_F(SceneTest, theFillLightIsLeftOutOfTintedPictures) {
    Scene scene = openSlope();
    EXPECT_EQ(renderSettingsOf(settings_, viewAt(1e6), scene.planet->tree()).light.fill, 0);
    settings_.surface.light.fill = 0.75;
    EXPECT_EQ(renderSettingsOf(settings_, viewAt(1e6), scene.planet->tree()).light.fill, 0.75);
    settings_.overlay.colourBy = ColourBy::Level;
    EXPECT_EQ(renderSettingsOf(settings_, viewAt(1e6), scene.planet->tree()).light.fill, 0);
}

TEST_F(SceneTest, aNewBudgetTakesEffectAndThePictureStays) {
    Scene scene = openSlope(1025);
    const planet::View view = viewAt(300'000);
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    const std::vector<std::uint8_t> before = picture(scene, view);
    const std::uint32_t slots = scene.planet->paging()[planet::BlockKind::Heights].capacity;
    settings_.paging.budgetMB = 16;
    ASSERT_TRUE(applyLiveSettings(scene, settings_));
    EXPECT_LT(scene.planet->paging()[planet::BlockKind::Heights].capacity, slots);
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    EXPECT_EQ(picture(scene, view), before);
}

TEST_F(SceneTest, whatIsRefusedIsToldOnceAndTheOldGoesOn) {
    Scene scene = openSlope();
    settings_.paging.loaderThreads = 0;
    EXPECT_FALSE(applyLiveSettings(scene, settings_));
    EXPECT_TRUE(applyLiveSettings(scene, settings_));
    EXPECT_EQ(scene.planet->pagingSettings().loaderThreads, 1);
    settings_.paging.loaderThreads = 2;
    EXPECT_TRUE(applyLiveSettings(scene, settings_));
    EXPECT_EQ(scene.planet->pagingSettings().loaderThreads, 2);
    settings_.paging.loaderThreads = 0;
    EXPECT_FALSE(applyLiveSettings(scene, settings_));
}

TEST_F(SceneTest, pausingReachesThePlanet) {
    Scene scene = openSlope();
    ASSERT_TRUE(applyLiveSettings(scene, settings_, true));
    EXPECT_TRUE(scene.planet->pagingSettings().paused);
    ASSERT_TRUE(applyLiveSettings(scene, settings_, false));
    EXPECT_FALSE(scene.planet->pagingSettings().paused);
}

TEST_F(SceneTest, exaggerationChangesThePictureAndComesBack) {
    Scene scene = openSlope();
    const planet::View view = viewAt(2000);
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    const double heightM = groundBelow(scene, view.eyeM).heightM;
    const double quantumM = scene.planet->tree().shape.quantumM;
    ASSERT_GT(heightM, 1);
    settings_.surface.exaggeration = 4;
    ASSERT_TRUE(applyLiveSettings(scene, settings_));
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    EXPECT_EQ(scene.planet->tree().shape.quantumM, 4 * quantumM);
    EXPECT_GT(groundBelow(scene, view.eyeM).heightM, 3.9 * heightM);
    settings_.surface.exaggeration = 1;
    ASSERT_TRUE(applyLiveSettings(scene, settings_));
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    EXPECT_NEAR(groundBelow(scene, view.eyeM).heightM, heightM, 1e-6);
}

TEST_F(SceneTest, anObserverHasASelectionOfItsOwn) {
    Scene scene = openSlope();
    const planet::View near = viewAt(300'000);
    const planet::View far = viewAt(2e7, 120);
    stepScene(scene, near, far, settings_);
    EXPECT_EQ(scene.planet->views().size(), 2u);
    EXPECT_EQ(scene.planet->views()[1].input.lodView.eyeM, far.eyeM);
    stepScene(scene, near, settings_);
    EXPECT_EQ(scene.planet->views().size(), 1u);
}

TEST_F(SceneTest, anObserversPictureAddsNoTrianglesToThoseOfTheLodView) {
    Scene scene = openSlope();
    const planet::View view = viewAt(1e6);
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    picture(scene, view);
    const FrameStats alone = statsOf(scene);
    ASSERT_GT(alone.selection.skirtTriangles, 0u);
    EXPECT_EQ(alone.render.groundTriangles, alone.selection.groundTriangles);
    EXPECT_EQ(alone.render.skirtTriangles, alone.selection.skirtTriangles);
    EXPECT_EQ(alone.selection.groundTriangles, alone.selection.drawn * 2u * 16 * 16);
    picture(scene, view);
    EXPECT_EQ(statsOf(scene).selection.triangles(), alone.selection.triangles());
    EXPECT_EQ(statsOf(scene).render.triangles(), 2 * alone.selection.triangles());
}

TEST_F(SceneTest, skirtsThatAreNotDrawnHaveNoTriangles) {
    Scene scene = openSlope();
    settings_.lod.seams = planet::SeamMode::Stitched;
    const planet::View view = viewAt(1e6);
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    picture(scene, view);
    EXPECT_EQ(statsOf(scene).selection.skirtTriangles, 0u);
    EXPECT_EQ(statsOf(scene).selection.triangles(), statsOf(scene).render.triangles());
}

TEST_F(SceneTest, whatASplitViewportDrawsIsCountedTogether) {
    Scene scene = openSlope();
    const planet::View view = viewAt(1e6);
    ASSERT_TRUE(settleScene(scene, view, settings_, 60));
    picture(scene, view);
    const std::uint32_t once = statsOf(scene).render.chunks;
    ASSERT_GT(once, 0u);
    picture(scene, view);
    EXPECT_EQ(statsOf(scene).render.chunks, 2 * once);
    stepScene(scene, view, settings_);
    picture(scene, view);
    EXPECT_EQ(statsOf(scene).render.chunks, once);
    EXPECT_GT(statsOf(scene).gpuMemory.total(), 0u);
}

glm::ivec3 bytesOfColour(const glm::vec3& colour) {
    return {std::lround(colour.x * 255), std::lround(colour.y * 255), std::lround(colour.z * 255)};
}

// Levels have a colour each; amounts have all the colours of their scale, of which the legend names some.
std::vector<glm::ivec3> coloursOfLegend(const OverlaySettings& overlay, double tauPx,
                                        std::uint32_t deepestLevel) {
    std::vector<glm::ivec3> colours;
    for (const ui::LegendEntry& entry : ui::legendOf(overlay, tauPx, deepestLevel).entries)
        colours.push_back(bytesOfColour(entry.colour));
    const bool isError = overlay.colourBy == ColourBy::Error || overlay.colourBy == ColourBy::Measured;
    for (int i = 0; i <= 1000 && overlay.colourBy != ColourBy::Level; ++i)
        colours.push_back(bytesOfColour(isError ? errorColour(i / 500.0) : rampColour(i / 1000.0)));
    return colours;
}

TEST_F(SceneTest, aTintOfFullOpacityHasOnlyTheColoursOfItsLegend) {
    const std::filesystem::path file = bakeTo("tinted.chk", {.faceSize = 257, .chunkSize = 17});
    settings_.overlay.opacity = 1;
    settings_.surface.light.air.use = planet::gl::FeatureUse::On;
    settings_.surface.light.sea.use = planet::gl::FeatureUse::On;
    settings_.surface.sunFollows = false;
    auto offscreen = openOffscreen({.chunkFile = file}, settings_, {96, 64}, 1);
    ASSERT_TRUE(offscreen) << offscreen.error().message;
    // All of the picture is ground.
    const SettledView settled =
        settleAt(*offscreen, {.latitudeDeg = 20, .longitudeDeg = 30, .altitudeM = 4e5}, settings_);
    ASSERT_TRUE(settled.settled);
    const std::uint32_t deepest = offscreen->scene.planet->selection().counters.deepestLevel;
    for (const double sunLongitudeDeg : {31.0, 120.0, 210.0}) {
        settings_.surface.sunLongitudeDeg = sunLongitudeDeg;
        for (const ColourBy colourBy : {ColourBy::Level, ColourBy::Error, ColourBy::DeltaC, ColourBy::Morph,
                                        ColourBy::Age, ColourBy::LoadOrder, ColourBy::Measured}) {
            settings_.overlay.colourBy = colourBy;
            ASSERT_TRUE(drawAndFinish(*offscreen, settled.view, settings_));
            const Picture picture = readPicture(*offscreen);
            const std::vector<glm::ivec3> legend =
                coloursOfLegend(settings_.overlay, settings_.lod.tauPx, deepest);
            std::size_t strangers = 0;
            for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
                strangers += std::none_of(legend.begin(), legend.end(), [&](const glm::ivec3& colour) {
                    const glm::ivec3 apart =
                        colour - glm::ivec3(picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]);
                    return std::abs(apart.x) <= 1 && std::abs(apart.y) <= 1 && std::abs(apart.z) <= 1;
                });
            }
            EXPECT_EQ(strangers, 0u) << static_cast<int>(colourBy) << ", sun at " << sunLongitudeDeg;
        }
    }
}

// A planet whose file has colours, drawn from tiles and from a clipmap.
class ClipmapScene : public SceneTest {
protected:
    ClipmapScene() {
        settings_.surface.lighting = false;
        settings_.surface.clipmapSizePx = 256;
    }

    Scene openColoured() {
        const std::filesystem::path file = folder_ / "coloured.chk";
        const planet::ColourSource colours = planet::test::mottledColours();
        const auto heights = planet::openHeightSource(writeSource(), {});
        const planet::BakeSettings settings{
            .faceSize = 129, .chunkSize = 17, .colour = {.format = planet::ColourFormat::Lossless}};
        if (!heights || !planet::bake(*heights, settings, file, {}, &colours))
            throw std::runtime_error("no bake");
        auto scene = openScene({.chunkFile = file}, settings_);
        if (!scene) throw std::runtime_error(scene.error().message);
        return std::move(*scene);
    }
    std::vector<std::uint8_t> settledPicture(Scene& scene, ColourMode mode) {
        settings_.surface.colourMode = mode;
        EXPECT_TRUE(applyLiveSettings(scene, settings_));
        EXPECT_TRUE(settleScene(scene, view_, settings_, 60));
        return picture(scene, view_);
    }
    void expectBothModesAlike(Scene& scene) {
        const std::vector<std::uint8_t> tiles = settledPicture(scene, ColourMode::Tiles);
        EXPECT_EQ(scene.renderer.chunks().gpuMemory().colourClipmap, 0u);
        const std::vector<std::uint8_t> clipmap = settledPicture(scene, ColourMode::Clipmap);
        EXPECT_GT(scene.renderer.chunks().gpuMemory().colourClipmap, 0u);
        int furthest = 0;
        for (std::size_t i = 0; i < tiles.size(); ++i)
            furthest = std::max(furthest, std::abs(int{tiles[i]} - int{clipmap[i]}));
        EXPECT_LE(furthest, 3);
        EXPECT_GT(*std::max_element(tiles.begin(), tiles.end()), 60);
    }

    planet::View view_ = viewAt(1e6);
};

TEST_F(ClipmapScene, theColourImageIsReadWhenItIsDrawn) {
    Scene scene = openColoured();
    const std::filesystem::path image = folder_ / "colour.png";
    ASSERT_TRUE(writePicture({2, 1, {255, 0, 0, 255, 0, 0}}, image));
    scene.colourImage = image;
    settledPicture(scene, ColourMode::Tiles);
    EXPECT_FALSE(scene.hasColourImage);
    settings_.surface.surface = planet::gl::SurfaceColour::HeightRamp;
    settings_.surface.streamed = false;
    settledPicture(scene, ColourMode::Tiles);
    EXPECT_FALSE(scene.hasColourImage);

    settings_.surface.surface = planet::gl::SurfaceColour::Image;
    const std::vector<std::uint8_t> red = settledPicture(scene, ColourMode::Tiles);
    EXPECT_TRUE(scene.hasColourImage);
    EXPECT_EQ(*std::max_element(red.begin(), red.end()), 255);
    for (std::size_t i = 0; i < red.size(); i += 3) EXPECT_EQ(red[i + 1], 0);
    EXPECT_THAT(takeProblems(scene), testing::IsEmpty());
}

TEST_F(ClipmapScene, framesGoOnWhileTheColourImageIsRead) {
    Scene scene = openColoured();
    const std::filesystem::path image = folder_ / "colour.png";
    ASSERT_TRUE(writePicture({2, 1, {255, 0, 0, 255, 0, 0}}, image));
    settings_.surface.streamed = false;
    settings_.surface.surface = planet::gl::SurfaceColour::Image;
    settledPicture(scene, ColourMode::Tiles);  // compiles the shaders
    scene.colourImage = image;
    std::promise<void> goOn;
    scene.colourReading =
        std::make_unique<PictureJob>([&image, mayGoOn = goOn.get_future().share()](const std::stop_token&) {
            mayGoOn.wait();
            return readPlanetPicture(image);
        });
    const auto drawFrame = [&] {
        scene.drawn = {};
        drawScene(scene, view_, settings_, 0, {}, planet::gl::ShaderWait::Never);
    };
    drawFrame();
    EXPECT_FALSE(scene.hasColourImage);
    EXPECT_TRUE(scene.drawn.standIn);
    goOn.set_value();
    while (scene.colourReading) drawFrame();
    EXPECT_TRUE(scene.hasColourImage);
    EXPECT_FALSE(scene.drawn.standIn);
    EXPECT_THAT(takeProblems(scene), testing::IsEmpty());
}

TEST_F(ClipmapScene, anUnreadableColourImageIsToldOnce) {
    Scene scene = openColoured();
    scene.colourImage = folder_ / "none.png";
    settledPicture(scene, ColourMode::Tiles);
    EXPECT_THAT(takeProblems(scene), testing::IsEmpty());
    settings_.surface.streamed = false;
    settledPicture(scene, ColourMode::Tiles);
    EXPECT_THAT(takeProblems(scene), testing::ElementsAre(testing::HasSubstr("none.png: cannot be read")));
    settledPicture(scene, ColourMode::Tiles);
    EXPECT_THAT(takeProblems(scene), testing::IsEmpty());
}

TEST_F(ClipmapScene, switchesLiveAndGivesItsMemoryBack) {
    Scene scene = openColoured();
    expectBothModesAlike(scene);
    EXPECT_GT(statsOf(scene).clipmap.filledTexels, 6 * 256 * 256);
    EXPECT_EQ(statsOf(scene).clipmap.windows, 1);
    const std::size_t bytes = scene.renderer.chunks().gpuMemory().colourClipmap;
    settings_.surface.clipmapSizePx = 512;
    settledPicture(scene, ColourMode::Clipmap);
    EXPECT_GT(scene.renderer.chunks().gpuMemory().colourClipmap, bytes);
    EXPECT_EQ(statsOf(scene).clipmap.windows, 0);  // all levels are kept whole
    settings_.surface.streamed = false;
    settledPicture(scene, ColourMode::Clipmap);
    EXPECT_EQ(scene.renderer.chunks().gpuMemory().colourClipmap, 0u);
    settings_.surface.streamed = true;
    expectBothModesAlike(scene);
}

TEST_F(ClipmapScene, isRightAgainAfterThePoolOrItsTilesAreNew) {
    Scene scene = openColoured();
    settings_.paging.budgetMB = 16;
    expectBothModesAlike(scene);
    settings_.paging.budgetMB = 24;
    const auto tiles = scene.planet->paging()[planet::BlockKind::Colours].capacity;
    settledPicture(scene, ColourMode::Clipmap);
    EXPECT_NE(scene.planet->paging()[planet::BlockKind::Colours].capacity, tiles);
    const std::vector<std::uint8_t> before = settledPicture(scene, ColourMode::Clipmap);
    scene.planet->reloadTiles(planet::BlockKind::Colours);
    EXPECT_NE(picture(scene, view_), before);
    EXPECT_EQ(settledPicture(scene, ColourMode::Clipmap), before);
    scene.planet->tools().dropAll();
    EXPECT_EQ(settledPicture(scene, ColourMode::Clipmap), before);
    expectBothModesAlike(scene);
}

TEST_F(ClipmapScene, staysAroundTheLodViewAndShowsItsWindowsAndStrips) {
    Scene scene = openColoured();
    settledPicture(scene, ColourMode::Clipmap);
    const planet::Selection& selection = scene.planet->selection();
    EXPECT_TRUE(linesOver(scene, selection, view_, settings_).empty());
    settings_.overlay.clipmap = true;
    const std::size_t lines = linesOver(scene, selection, view_, settings_).size();
    EXPECT_GT(lines, 0u);
    stepScene(scene, view_, settings_, 10.0);
    // Looked at from elsewhere, as a frozen view or an observer does.
    picture(scene, viewAt(3e6, 25));
    EXPECT_EQ(statsOf(scene).clipmap.filledTexels, 0);
    // What was filled has faded; the window's outline is left.
    const std::size_t outline = linesOver(scene, selection, view_, settings_).size();
    EXPECT_GT(outline, 0u);
    EXPECT_LT(outline, lines);
    view_ = viewAt(1e6, 14);
    stepScene(scene, view_, settings_, 0.02);
    picture(scene, view_);
    EXPECT_GT(statsOf(scene).clipmap.filledTexels, 0);
    EXPECT_LT(statsOf(scene).clipmap.filledTexels, 256 * 64);
    EXPECT_GT(linesOver(scene, scene.planet->selection(), view_, settings_).size(), outline);
}

}  // namespace
}  // namespace worldy
