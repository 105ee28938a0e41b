#include "ui/shell/palette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/support/action_fixture.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/shell/palette_items.h"

namespace worldy::ui {
namespace {

using testing::HasSubstr;

class PaletteTest : public testing::Test {
protected:
    PaletteTest() {
        ImGuiIO& io = ImGui::GetIO();
        for (const ImGuiKey key : {ImGuiKey_Enter, ImGuiKey_UpArrow, ImGuiKey_DownArrow, ImGuiKey_PageDown,
                                   ImGuiKey_PageUp, ImGuiKey_Space, ImGuiKey_Backspace})
            io.KeyMap[key] = 300 + key;
        io.KeyRepeatDelay = 100;
        bench_.view.planet = planet_.get();
        togglePalette(bench_.menu.palette);
        frames(3);
    }

    void frame() {
        window_.frame([&] { palette(bench_.context()); });
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }
    void type(const char* text) {
        ImGui::GetIO().AddInputCharactersUTF8(text);
        frames(3);
    }
    void press(ImGuiKey key) {
        ImGui::GetIO().KeysDown[300 + key] = true;
        frame();
        ImGui::GetIO().KeysDown[300 + key] = false;
        frames(3);
    }
    // The chosen row's place, to compare with those of other items.
    bool isChosen(const char* title) const {
        const ItemPlace* const chosen = window_.find("palette/Chosen");
        const ItemPlace* const item = window_.find(std::string("palette/") + title);
        return chosen && item && chosen->rect.y == item->rect.y;
    }
    const PaletteState& state() const { return bench_.menu.palette; }

    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    PanelWindow window_{{1000, 700}};
    ActionBench bench_;
};

TEST_F(PaletteTest, enterCarriesOutTheBestMatch) {
    type("frl");
    EXPECT_TRUE(isChosen("Freeze LOD"));
    press(ImGuiKey_Enter);
    EXPECT_FALSE(state().isOpen);
    ASSERT_EQ(bench_.commands.size(), 1u);
    EXPECT_TRUE(bench_.commands[0].as<FreezeLod>());
    EXPECT_EQ(state().recent.front(), "command/freeze_lod");
}

TEST_F(PaletteTest, arrowsAndPagesMoveThroughTheRows) {
    const std::size_t last = paletteItems("", bench_.context()).entries.size() - 1;
    press(ImGuiKey_DownArrow);
    press(ImGuiKey_DownArrow);
    EXPECT_EQ(state().chosen, 2u);
    press(ImGuiKey_UpArrow);
    EXPECT_EQ(state().chosen, 1u);
    press(ImGuiKey_PageDown);
    EXPECT_EQ(state().chosen, 14u);
    EXPECT_TRUE(window_.find("palette/Chosen")) << "the row is in view";
    press(ImGuiKey_PageUp);
    press(ImGuiKey_PageUp);
    EXPECT_EQ(state().chosen, 0u);
    press(ImGuiKey_UpArrow);
    EXPECT_EQ(state().chosen, last);
    EXPECT_TRUE(window_.find("palette/Chosen"));
}

TEST_F(PaletteTest, aClickChoosesARow) {
    type("wireframe");
    window_.click("palette/Wireframe", 0.5f, [&] { frame(); });
    EXPECT_FALSE(state().isOpen);
    EXPECT_TRUE(bench_.settings.overlay.wireframe);
}

TEST_F(PaletteTest, aCommandThatIsNotPossibleStaysAndSaysWhy) {
    type("undo");
    press(ImGuiKey_Enter);
    EXPECT_TRUE(state().isOpen);
    EXPECT_TRUE(bench_.commands.empty());
}

TEST_F(PaletteTest, aNumberIsTypedIntoASetting) {
    type("lod.tau");
    press(ImGuiKey_Enter);
    EXPECT_EQ(state().edited, "lod.tau_px");
    type("7.5");
    press(ImGuiKey_Enter);
    EXPECT_DOUBLE_EQ(bench_.settings.lod.tauPx, 7.5);
    EXPECT_TRUE(state().isOpen);
    leavePalette(bench_.menu.palette);
    frames(3);
    EXPECT_STREQ(state().query.data(), "lod.tau") << "the list is as it was";
    EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "the field has the focus again";
}

TEST_F(PaletteTest, everySettingHasAControlOrAPanel) {
    const PaletteItems items = paletteItems("", bench_.context());
    int edited = 0;
    for (std::size_t i = 0; i < items.entries.size(); ++i) {
        if (items.entries[i].kind != PaletteKind::Setting) continue;
        if (items.choices[i].setting.empty()) {
            EXPECT_TRUE(items.choices[i].choose) << items.entries[i].also;
            continue;
        }
        bench_.menu.palette.edited = items.choices[i].setting;
        bench_.menu.palette.takesFocus = true;
        frames(2);
        EXPECT_TRUE(window_.find("palette/" + items.entries[i].also)) << items.entries[i].also;
        ++edited;
    }
    EXPECT_GT(edited, 100);
}

TEST_F(PaletteTest, aPanelIsShown) {
    type("precision");
    press(ImGuiKey_Enter);
    EXPECT_TRUE(isShown(bench_.workspace, PanelId::Probe));
    EXPECT_EQ(bench_.menu.usedPanel, PanelId::Probe);
}

TEST_F(PaletteTest, aChunkIsSelectedAndWithCtrlLookedAt) {
    type("y_pos/1/0/1");
    EXPECT_TRUE(isChosen("y_pos/1/0/1"));
    press(ImGuiKey_Enter);
    ASSERT_EQ(bench_.commands.size(), 1u);
    const auto* const select = bench_.commands[0].as<SelectChunk>();
    ASSERT_TRUE(select);
    EXPECT_EQ(planet::toString(*select->id), "y_pos/1/0/1");

    bench_.commands.clear();
    togglePalette(bench_.menu.palette);
    frames(3);
    type("y_pos/1/0/1");
    ImGui::GetIO().KeyCtrl = true;
    press(ImGuiKey_Enter);
    ImGui::GetIO().KeyCtrl = false;
    ASSERT_EQ(bench_.commands.size(), 2u);
    EXPECT_TRUE(bench_.commands[1].as<LookAtChunk>());
}

TEST_F(PaletteTest, aChunkBelowTheLeavesIsRefused) {
    const PaletteItems items = paletteItems("y_pos/20/0/1", bench_.context());
    ASSERT_EQ(items.entries[0].kind, PaletteKind::Chunk);
    EXPECT_NE(items.entries[0].whyNot, "");
}

TEST_F(PaletteTest, aPlaceIsFlownTo) {
    type("27.99, 86.93");
    press(ImGuiKey_Enter);
    ASSERT_EQ(bench_.commands.size(), 1u);
    const auto* const move = bench_.commands[0].as<MoveCamera>();
    ASSERT_TRUE(move);
    EXPECT_DOUBLE_EQ(move->pose.latitudeDeg, 27.99);
    EXPECT_DOUBLE_EQ(move->pose.longitudeDeg, 86.93);
    EXPECT_GT(move->pose.altitudeM, 9000);
}

TEST_F(PaletteTest, aPlaceOutOfRangeSaysWhy) {
    const PaletteItems items = paletteItems("98, 10", bench_.context());
    EXPECT_EQ(items.entries[0].kind, PaletteKind::Place);
    EXPECT_THAT(items.entries[0].whyNot, HasSubstr("out of range"));
}

TEST_F(PaletteTest, bookmarksFlightsPresetsAndFilesAreListed) {
    const std::array bookmarks = {Bookmark{.name = "Himalaya", .pose = {}}};
    const std::array flights = {std::filesystem::path("a/orbit_to_ground.toml")};
    const std::array presets = {PresetView{.name = "slow disk"},
                                PresetView{.name = "broken", .problem = "is bad"}};
    const std::array recent = {std::filesystem::path("/data/moon.chk")};
    bench_.view.camera.bookmarks = bookmarks;
    bench_.view.camera.flights = flights;
    bench_.view.settings.presets = presets;
    bench_.view.data.recent = recent;
    const PaletteItems items = paletteItems("", bench_.context());
    const auto kindOf = [&](std::string_view title, PaletteKind kind) {
        const auto found = std::ranges::find_if(items.entries, [&](const PaletteEntry& entry) {
            return entry.title == title && entry.kind == kind;
        });
        return found == items.entries.end() ? nullptr : &*found;
    };
    EXPECT_TRUE(kindOf("Himalaya", PaletteKind::Bookmark));
    EXPECT_TRUE(kindOf("orbit to ground", PaletteKind::Flight));
    EXPECT_TRUE(kindOf("slow disk", PaletteKind::Preset));
    EXPECT_TRUE(kindOf("/data/moon.chk", PaletteKind::File));
    ASSERT_TRUE(kindOf("broken", PaletteKind::Preset));
    EXPECT_EQ(kindOf("broken", PaletteKind::Preset)->whyNot, "is bad");
}

}  // namespace
}  // namespace worldy::ui
