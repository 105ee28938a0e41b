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

}  // namespace
}  // namespace worldy::ui
