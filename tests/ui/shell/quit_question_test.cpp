#include "ui/shell/quit_question.h"

#include <gtest/gtest.h>

#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

class QuitQuestion : public testing::Test {
protected:
    void frames(int count) {
        for (int i = 0; i < count; ++i) window_.frame([&] { quitQuestion(settings_, commands_); });
    }
    void answer(const char* item) {
        settings_.quitQuestion = {"/planets/earth.regions.toml"};
        frames(3);
        window_.click(item, 0.5f, [&] { frames(1); });
        settings_.quitQuestion.clear();
        frames(2);
        EXPECT_FALSE(window_.isShown("quit/Question"));
    }

    PanelWindow window_{{900, 700}};
    SettingsView settings_;
    Commands commands_;
};

TEST_F(QuitQuestion, isNotShownIfAllIsSaved) {
    frames(3);
    EXPECT_FALSE(window_.isShown("quit/Question"));
}

TEST_F(QuitQuestion, hasThreeAnswers) {
    answer("quit/Save and quit");
    answer("quit/Quit without saving");
    answer("quit/Cancel");
    ASSERT_EQ(commands_.size(), 3u);
    ASSERT_TRUE(commands_[0].as<Quit>());
    EXPECT_EQ(commands_[0].as<Quit>()->regions, Quit::Unsaved::Save);
    ASSERT_TRUE(commands_[1].as<Quit>());
    EXPECT_EQ(commands_[1].as<Quit>()->regions, Quit::Unsaved::Discard);
    EXPECT_TRUE(commands_[2].as<KeepWindow>());
}

}  // namespace
}  // namespace worldy::ui
