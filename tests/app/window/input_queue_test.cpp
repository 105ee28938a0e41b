#include "app/window/input_queue.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace worldy {
namespace {

using Kinds = std::vector<InputKind>;

InputEvent down(int key, int modifiers = 0) {
    return {InputKind::KeyDown, key, 0, modifiers};
}
InputEvent up(int key) {
    return {InputKind::KeyUp, key};
}
InputEvent text(char letter) {
    return {InputKind::Text, letter};
}

std::vector<Kinds> framesOf(const std::vector<InputEvent>& events) {
    InputQueue queue;
    for (const InputEvent& event : events) queue.add(event);
    std::vector<Kinds> frames;
    while (!queue.empty()) {
        Kinds& kinds = frames.emplace_back();
        for (const InputEvent& event : queue.takeFrame()) kinds.push_back(event.kind);
    }
    return frames;
}

TEST(InputQueue, aFrameWithoutInputIsEmpty) {
    InputQueue queue;
    EXPECT_TRUE(queue.empty());
    EXPECT_TRUE(queue.takeFrame().empty());
}

TEST(InputQueue, aKeyTappedWithinAFrameIsDownForOneFrame) {
    EXPECT_EQ(framesOf({down(GLFW_KEY_W), up(GLFW_KEY_W)}),
              (std::vector<Kinds>{{InputKind::KeyDown}, {InputKind::KeyUp}}));
    const std::vector<InputEvent> twice = {down(GLFW_KEY_W), up(GLFW_KEY_W), down(GLFW_KEY_W),
                                           up(GLFW_KEY_W)};
    EXPECT_EQ(framesOf(twice).size(), 4u);
}

// GLFW reports BackSpace tapped three times without a pause like this.
TEST(InputQueue, aRepeatThatComesWithoutAHoldIsAnotherTap) {
    const auto at = [](InputKind kind, double s) {
        return InputEvent{.kind = kind, .code = GLFW_KEY_BACKSPACE, .atS = s};
    };
    const auto tapped = framesOf({at(InputKind::KeyDown, 5), at(InputKind::KeyRepeat, 5.01),
                                  at(InputKind::KeyRepeat, 5.02), at(InputKind::KeyUp, 5.03)});
    const Kinds down = {InputKind::KeyDown};
    const Kinds up = {InputKind::KeyUp};
    EXPECT_EQ(tapped, (std::vector<Kinds>{down, up, down, up, down, up}));
}

TEST(InputQueue, theRepeatsOfAKeyThatIsHeldStayRepeats) {
    const auto at = [](InputKind kind, double s) {
        return InputEvent{.kind = kind, .code = GLFW_KEY_BACKSPACE, .atS = s};
    };
    std::size_t repeats = 0;
    for (const Kinds& frame : framesOf({at(InputKind::KeyDown, 5), at(InputKind::KeyRepeat, 5.25),
                                        at(InputKind::KeyRepeat, 5.28), at(InputKind::KeyUp, 5.3)}))
        repeats += static_cast<std::size_t>(std::count(frame.begin(), frame.end(), InputKind::KeyRepeat));
    EXPECT_EQ(repeats, 2u);
}

TEST(InputQueue, keysPressedTogetherComeInOneFrame) {
    EXPECT_EQ(framesOf({down(GLFW_KEY_W), down(GLFW_KEY_A), down(GLFW_KEY_LEFT_SHIFT)}).size(), 1u);
}

TEST(InputQueue, aModifierIsHeldForTheFrameOfTheKeyOrButtonThatItWasPressedFor) {
    const std::vector<InputEvent> ctrlA = {down(GLFW_KEY_LEFT_CONTROL), down('A', GLFW_MOD_CONTROL),
                                           up(GLFW_KEY_LEFT_CONTROL), up('A')};
    EXPECT_EQ(framesOf(ctrlA), (std::vector<Kinds>{{InputKind::KeyDown, InputKind::KeyDown},
                                                   {InputKind::KeyUp, InputKind::KeyUp}}));
    const std::vector<InputEvent> ctrlClick = {
        down(GLFW_KEY_LEFT_CONTROL), {InputKind::ButtonDown, 0}, up(GLFW_KEY_LEFT_CONTROL)};
    EXPECT_EQ(framesOf(ctrlClick),
              (std::vector<Kinds>{{InputKind::KeyDown, InputKind::ButtonDown}, {InputKind::KeyUp}}));
}

TEST(InputQueue, aDoubleClickWithinAFrameKeepsBothClicks) {
    const InputEvent press{InputKind::ButtonDown, 0, 0, 0, {10, 20}};
    const InputEvent release{InputKind::ButtonUp, 0, 0, 0, {11, 20}};
    EXPECT_EQ(framesOf({press, release, press, release}).size(), 4u);
    InputQueue queue;
    queue.add(press);
    queue.add(release);
    EXPECT_EQ(queue.takeFrame().front().pointer, glm::dvec2(10, 20));
    EXPECT_EQ(queue.takeFrame().front().pointer, glm::dvec2(11, 20));
}

TEST(InputQueue, mouseButtonsAndKeysOfTheSameNumberAreApart) {
    EXPECT_EQ(framesOf({{InputKind::ButtonDown, 0}, {InputKind::ButtonDown, 1}}).size(), 1u);
}

TEST(InputQueue, whatIsTypedAfterEnterComesAfterIt) {
    const auto frames = framesOf({down('5'), text('5'), down(GLFW_KEY_ENTER), down('W'), text('w')});
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0], (Kinds{InputKind::KeyDown, InputKind::Text, InputKind::KeyDown}));
}

TEST(InputQueue, whatIsTypedAfterSelectAllComesAfterIt) {
    const auto frames =
        framesOf({down(GLFW_KEY_LEFT_CONTROL), down('A', GLFW_MOD_CONTROL), down('5'), text('5')});
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0].size(), 2u);
}

TEST(InputQueue, ctrlAndClickComeInOneFrameButTypedTextComesBeforeTheClick) {
    const InputEvent press{InputKind::ButtonDown, 0};
    EXPECT_EQ(framesOf({down(GLFW_KEY_LEFT_CONTROL, 0), press}).size(), 1u);
    EXPECT_EQ(framesOf({down('5'), text('5'), press}).size(), 2u);
    EXPECT_EQ(framesOf({press, down('5'), text('5')}).size(), 2u);
}

TEST(InputQueue, textTypedIntoAFieldNeedsOneFrame) {
    InputQueue queue;
    for (int i = 0; i < 30; ++i) {
        for (const InputEvent& event : {down('5'), text('5'), up('5')}) queue.add(event);
    }
    EXPECT_EQ(queue.size(), 90u);
    EXPECT_EQ(queue.takeFrame(true).size(), 90u);
    EXPECT_EQ(queue.size(), 0u);
}

TEST(InputQueue, keysThatActInATextFieldKeepTheirFrames) {
    InputQueue queue;
    for (const InputEvent& event :
         {down(GLFW_KEY_BACKSPACE), up(GLFW_KEY_BACKSPACE), down('A', GLFW_MOD_CONTROL), up('A')})
        queue.add(event);
    EXPECT_EQ(queue.takeFrame(true).size(), 1u);
    EXPECT_EQ(queue.takeFrame(true).size(), 2u);
    EXPECT_EQ(queue.takeFrame(true).size(), 1u);
    EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, repeatsOfAHeldKeyWaitForNothing) {
    InputEvent first{InputKind::KeyRepeat, GLFW_KEY_DOWN};
    first.atS = 0.5;
    InputEvent second = first;
    second.atS = 0.53;
    EXPECT_EQ(framesOf({down(GLFW_KEY_DOWN), first, second}).size(), 1u);
}

}  // namespace
}  // namespace worldy
