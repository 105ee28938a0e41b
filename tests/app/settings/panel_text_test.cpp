#include "app/settings/panel_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/settings/settings_text.h"

namespace worldy {
namespace {

using testing::HasSubstr;

std::string errorOf(const std::string& line) {
    const planet::Result<Settings> read = settingsFromText("[panels]\n" + line + "\n", "settings.toml");
    return read ? "no error" : read.error().message;
}

Workspace workspaceFrom(const std::string& line) {
    const planet::Result<Settings> settings = settingsFromText("[panels]\n" + line + "\n", "settings.toml");
    EXPECT_TRUE(settings) << settings.error().message;
    return settings ? settings->workspace : Workspace{};
}

const PanelPlace& placeOf(const Workspace& workspace, PanelId panel) {
    return workspace.panels[static_cast<std::size_t>(panel)];
}

TEST(PanelText, panelsThatTheOrderLeavesOutFollowIt) {
    const PanelOrder order = workspaceFrom("order = [\"pops\", \"lod\"]").order;
    EXPECT_EQ(order[0], PanelId::Pops);
    EXPECT_EQ(order[1], PanelId::Lod);
    EXPECT_EQ(order[2], PanelId::Seams);
    EXPECT_EQ(order.back(), panelInfos.back().id);
    EXPECT_EQ(workspaceFrom("order = []").order, firstOrder());
}

TEST(PanelText, aWrongOrderIsRefused) {
    EXPECT_THAT(errorOf("order = 3"), HasSubstr("panels.order is 3; expected an array of panels"));
    EXPECT_THAT(errorOf("order = [\"lod\", \"nope\"]"),
                HasSubstr("line 2: panels.order: panel 2 is 'nope'; expected the key of a panel"));
    EXPECT_THAT(errorOf("order = [\"lod\", [\"lod\"]]"), HasSubstr("panel 2 is "));
    EXPECT_THAT(errorOf("order = [\"lod\", \"lod\"]"), HasSubstr("lists lod twice"));
}

TEST(PanelText, floatingPanelsAreReadWithTheirPlaces) {
    const Workspace workspace = workspaceFrom(
        "floating = [{ panel = \"chunk\", x = 0.25, y = 1, width = 500, height = 300 }, { panel = \"log\" "
        "}]");
    EXPECT_TRUE(placeOf(workspace, PanelId::Chunk).floats);
    EXPECT_EQ(placeOf(workspace, PanelId::Chunk).floating, (FloatingPlace{0.25, 1, 500, 300}));
    EXPECT_EQ(placeOf(workspace, PanelId::Chunk).dock, Dock::Left);
    EXPECT_TRUE(placeOf(workspace, PanelId::Log).floats);
    EXPECT_EQ(placeOf(workspace, PanelId::Log).floating, FloatingPlace{});
    EXPECT_FALSE(placeOf(workspace, PanelId::Lod).floats);
}

TEST(PanelText, whatIsNotListedDoesNotFloat) {
    Settings base;
    base.workspace.panels[static_cast<std::size_t>(PanelId::Lod)].floats = true;
    const planet::Result<Settings> settings =
        settingsFromText("[panels]\nfloating = [{ panel = \"log\" }]\n", "settings.toml", base);
    ASSERT_TRUE(settings);
    EXPECT_FALSE(placeOf(settings->workspace, PanelId::Lod).floats);
}

TEST(PanelText, aHostileFloatingPanelIsRefused) {
    const auto with = [](const std::string& keys) {
        return errorOf("floating = [{ panel = \"chunk\"" + keys + " }]");
    };
    EXPECT_EQ(with(""), "no error");
    EXPECT_THAT(with(", x = -0.5"), HasSubstr("panels.floating: 1: x is -0.5; expected a number in [0, 1]"));
    EXPECT_THAT(with(", y = nan"), HasSubstr("y is nan"));
    EXPECT_THAT(with(", width = 1e300"), HasSubstr("expected a number in [160, 2000]"));
    EXPECT_THAT(with(", height = 0"), HasSubstr("expected a number in [100, 2000]"));
    EXPECT_THAT(with(", height = \"tall\""), HasSubstr("height is 'tall'"));
    EXPECT_THAT(with(", z = 1"), HasSubstr("z is unknown; expected panel, x, y, width or height"));
    EXPECT_THAT(errorOf("floating = [{ panel = \"nope\" }]"), HasSubstr("panel is 'nope'"));
    EXPECT_THAT(errorOf("floating = [{ x = 1 }]"), HasSubstr("is not a floating panel; expected { panel = "));
    EXPECT_THAT(errorOf("floating = [1]"), HasSubstr("is not a floating panel"));
    EXPECT_THAT(errorOf("floating = \"chunk\""), HasSubstr("expected an array of tables"));
    EXPECT_THAT(errorOf("floating = [{ panel = \"chunk\" }, { panel = \"chunk\" }]"),
                HasSubstr("lists chunk twice"));
    EXPECT_THAT(errorOf("maximised = \"top\""), HasSubstr("\"none\", \"left\", \"right\", \"bottom\""));
}

}  // namespace
}  // namespace worldy
