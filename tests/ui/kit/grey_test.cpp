// A control that cannot be used says why.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/panel_fixture.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {
namespace {

TEST(Grey, theTooltipOfAGreyControlBeginsWithWhy) {
    PanelWindow window{{400, 300}};
    bool grey = true;
    bool pressed = false;
    const auto draw = [&] {
        window.frame([&] {
            beginGrey(grey, "Type a name first.");
            pressed |= button("Save", "Keeps it.");
            endGrey();
        });
    };
    draw();
    window.click("Save", 0.5f, draw);
    draw();
    EXPECT_FALSE(pressed);
    EXPECT_TRUE(window.isShown("Why grey"));
    grey = false;
    window.click("Save", 0.5f, draw);
    draw();
    EXPECT_TRUE(pressed);
    EXPECT_FALSE(window.isShown("Why grey"));
}

TEST(Grey, noPanelGreysWithoutAReason) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(WORLDY_SOURCE_DIR "/ui")) {
        if (entry.path().extension() != ".cpp" || entry.path().filename() == "widgets.cpp") continue;
        std::ifstream source(entry.path());
        const std::string text{std::istreambuf_iterator<char>(source), {}};
        EXPECT_EQ(text.find("BeginDisabled("), std::string::npos) << entry.path() << " wants beginGrey()";
    }
}

}  // namespace
}  // namespace worldy::ui
