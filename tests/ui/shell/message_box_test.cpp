#include "ui/shell/message_box.h"

#include <gtest/gtest.h>

#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

class ConfirmationLine : public testing::Test {
protected:
    const Rect& boxOf(const std::string& text) {
        confirmation_ = {text, 10};
        window_.frame([&] { confirmationLine(confirmation_, 1, viewport_); });
        return window_.find("confirmation/Box")->rect;
    }

    PanelWindow window_{{1024, 640}};
    Rect viewport_{300, 40, 400, 500};
    Confirmation confirmation_;
};

TEST_F(ConfirmationLine, isAsWideAsItsTextInTheFirstFrame) {
    const std::string text = "Command line copied to the clipboard";
    boxOf("Short");
    const Rect box = boxOf(text);
    EXPECT_GE(box.width, ImGui::CalcTextSize(text.c_str()).x);
    const Rect later = boxOf(text);
    EXPECT_EQ(later.width, box.width);
    EXPECT_EQ(later.height, box.height);
}

TEST_F(ConfirmationLine, aLongPathIsWrappedWithinTheViewport) {
    const Rect box = boxOf("Screenshot: /home/someone/pictures/" + std::string(300, 'a') + "/shot one.png");
    EXPECT_GE(box.x, viewport_.x);
    EXPECT_LE(box.x + box.width, viewport_.x + viewport_.width);
    EXPECT_GT(box.height, 3 * ImGui::GetFontSize());
}

class AlertBoxes : public testing::Test {
protected:
    void frame(double timeS) {
        window_.frame([&] { alertBoxes(alerts_, timeS, viewport_, viewport_.y + 20); });
    }

    PanelWindow window_{{1024, 640}};
    Rect viewport_{300, 40, 400, 300};
    std::vector<Alert> alerts_{{LogLevel::Warning, "The colours cannot be read", 1, 10},
                               {LogLevel::Error, "No space is left", 1, 20}};
};

TEST_F(AlertBoxes, lieBelowEachOtherAndEnd) {
    frame(1);
    const Rect first = window_.find("alert 0/Box")->rect;
    const Rect second = window_.find("alert 1/Box")->rect;
    EXPECT_GE(first.y, viewport_.y + 20);
    EXPECT_GE(second.y, first.y + first.height);
    frame(15);
    ASSERT_EQ(alerts_.size(), 1u);
    EXPECT_EQ(alerts_[0].text, "No space is left");
    frame(21);
    EXPECT_TRUE(alerts_.empty());
}

TEST_F(AlertBoxes, aClickRemovesOne) {
    frame(1);
    window_.click("alert 0/Box", 0.5f, [&] { frame(1); });
    ASSERT_EQ(alerts_.size(), 1u);
    EXPECT_EQ(alerts_[0].text, "No space is left");
}

TEST_F(AlertBoxes, manyLeaveHalfOfThePictureFreeAndAreCounted) {
    for (int i = 0; i < 30; ++i) alerts_.push_back({LogLevel::Error, "block " + std::to_string(i), 1, 20});
    frame(1);
    const ItemPlace* more = window_.find("more alerts/Box");
    ASSERT_TRUE(more);
    EXPECT_LT(more->rect.y + more->rect.height, viewport_.y + 0.75f * viewport_.height);
}

}  // namespace
}  // namespace worldy::ui
