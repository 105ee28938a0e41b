// Checks that every setting of the view can be changed in a panel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "app/settings/settings_schema.h"
#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/shell/panels.h"

namespace worldy::ui {
namespace {

planet::PlanetSource sourceWithColours() {
    planet::PlanetSource source = planet::fakePyramid().source();
    source.colour =
        planet::ColourPyramid{.format = planet::ColourFormat::Bc1, .leafLevel = 0, .roots = {}, .source = {}};
    for (const planet::Face face : planet::allFaces) {
        planet::TileData& tile = source.colourRoots[static_cast<std::size_t>(face)];
        tile.id = {face, 0, 0, 0};
        tile.texels.resize(planet::colourTileBytes(planet::ColourFormat::Bc1));
    }
    source.loadColours = [](const planet::ChunkId&,
                            planet::BlockLocation) -> planet::Result<planet::TileBlock> {
        return planet::badInput("no tiles below the roots");
    };
    return source;
}

// Settings that some control depends on.
std::vector<ViewSettings> variants() {
    std::vector<ViewSettings> all(4);
    all[0].overlay.colourBy = ColourBy::Error;
    all[0].compare.mode = CompareMode::Difference;
    all[0].cracks.live = true;
    all[1].overlay.colourBy = ColourBy::DeltaC;
    all[1].compare.mode = CompareMode::Wipe;
    all[1].lod.skirtDepth = planet::SkirtDepth::Fixed;
    all[2].overlay.colourBy = ColourBy::Age;
    all[2].compare.mode = CompareMode::Flip;
    all[2].surface.sunFollows = false;
    all[3].surface.sunFollows = false;
    all[3].surface.sunByDate = true;
    return all;
}

TEST(PanelSettings, everyViewSettingHasAControl) {
    // These have editors of their own, or follow from another control.
    const std::set<std::string> without = {
        "surface.ramp",             // the Surface panel edits its stops
        "surface.layers",           // the Surface panel edits each layer
        "surface.layer_set",        // the list "Load" of the Surface panel
        "surface.layer_previewed",  // the chosen layer
        "surface.sun_follows",      // the list "Sun" of the Light panel
        "surface.sun_by_date",
        "view.flight",  // the list of flights in the Camera panel
    };
    const auto planet = planet::openFake(sourceWithColours());
    const planet::View lodView = planet::viewAt(10, 20);
    ASSERT_TRUE(planet->settle(lodView, {}, planet::noUpload, planet::timeoutS));
    EmptyView empty;
    EditorView& view = empty.view;
    view.planet = planet.get();
    view.camera.lodView = view.camera.renderView = lodView;
    view.compare.on = true;
    PanelWindow window({700, 4000});
    PanelStates states;
    std::set<std::string> drawn;
    for (ViewSettings settings : variants()) {
        for (const PanelInfo& info : panelInfos) {
            Commands commands;
            for (int i = 0; i < 2; ++i)
                window.frame([&] { drawPanel(info.id, view, states, settings, commands); });
            for (const Field& field : fieldsOf(settings)) {
                if (window.isShown("/" + field.name())) drawn.insert(field.name());
            }
        }
    }
    ViewSettings settings;
    for (const Field& field : fieldsOf(settings))
        EXPECT_NE(drawn.contains(field.name()), without.contains(field.name())) << field.name();
}

}  // namespace
}  // namespace worldy::ui
