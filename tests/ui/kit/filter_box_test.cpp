#include "ui/kit/filter_box.h"

#include <gtest/gtest.h>

#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

constexpr int escape = 256;

class FilterBoxTest : public testing::Test {
protected:
    FilterBoxTest() { ImGui::GetIO().KeyMap[ImGuiKey_Escape] = escape; }

    void frame() {
        window_.frame([&] { filterBox(filter_, "lines"); });
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }

    PanelWindow window_{{600, 300}};
    TextFilter filter_;
};

TEST_F(FilterBoxTest, theCommandGivesItTheFocusAndEscClearsIt) {
    frames(2);
    EXPECT_TRUE(isFilterShown());
    EXPECT_TRUE(focusFilter());
    frames(3);
    ImGui::GetIO().AddInputCharactersUTF8("z_pos");
    frames(2);
    EXPECT_EQ(filter_.view(), "z_pos");
    EXPECT_TRUE(window_.isShown("Clear filter"));
    ImGui::GetIO().KeysDown[escape] = true;
    frame();
    ImGui::GetIO().KeysDown[escape] = false;
    frames(2);
    EXPECT_TRUE(filter_.empty());
    EXPECT_FALSE(window_.isShown("Clear filter"));
}

TEST_F(FilterBoxTest, theButtonClearsIt) {
    filter_.text = {'a', 'b'};
    frames(2);
    window_.click("Clear filter", 0.5f, [&] { frame(); });
    EXPECT_TRUE(filter_.empty());
}

TEST_F(FilterBoxTest, aFilterThatIsHiddenTakesNoFocus) {
    frames(2);
    for (int i = 0; i < 3; ++i) window_.frame([] {});
    EXPECT_FALSE(isFilterShown());
    EXPECT_FALSE(focusFilter());
}

TEST_F(FilterBoxTest, hitsAreDrawnOnlyWhileTheirFilterLives) {
    filter_.text = {'a'};
    const auto vertices = [&](bool highlights) {
        int count = 0;
        window_.frame([&] {
            const auto draw = [&] {
                highlightHits("banana");
                ImGui::TextUnformatted("banana");
            };
            const int before = ImGui::GetWindowDrawList()->VtxBuffer.Size;
            if (highlights) {
                const HitHighlight highlight(filter_);
                draw();
            } else {
                draw();
            }
            count = ImGui::GetWindowDrawList()->VtxBuffer.Size - before;
        });
        return count;
    };
    vertices(false);
    EXPECT_GT(vertices(true), vertices(false));
}

}  // namespace
}  // namespace worldy::ui
