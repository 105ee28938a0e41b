#include "app/scene/steering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace worldy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

using Axes = std::array<float, 6>;
constexpr Axes atRest = {0, 0, 0, 0, -1, -1};

CameraMotion gamepadMotion(const Axes& axes) {
    return motionOf(gamepadState("pad", axes, {}), 1, false);
}

CameraMotion spaceMouseMotion(const Axes& axes) {
    return motionOf(spaceMouseState("mouse", axes), 1, false);
}

TEST(Steering, aDeviceAtRestMovesNothing) {
    EXPECT_EQ(gamepadMotion(atRest), CameraMotion());
    EXPECT_EQ(spaceMouseMotion({}), CameraMotion());
    EXPECT_FALSE(isUsed(gamepadState("pad", atRest, {})));
}

TEST(Steering, aWornStickThatDoesNotReturnToItsCentreMovesNothing) {
    EXPECT_EQ(gamepadMotion({0.1f, -0.1f, -0.1f, 0.1f, -0.95f, -0.92f}), CameraMotion());
    EXPECT_EQ(spaceMouseMotion({0.05f, -0.05f, 0.05f, 0.05f, -0.05f, 0.05f}), CameraMotion());
}

TEST(Steering, axesThatAreMissingOrNoNumbersAreAtRest) {
    EXPECT_EQ(gamepadMotion({nan, infinite, -infinite, nan, nan, infinite}), CameraMotion());
    EXPECT_EQ(spaceMouseMotion({nan, infinite, -infinite, nan, nan, infinite}), CameraMotion());
    EXPECT_EQ(motionOf(gamepadState("pad", {}, {}), 1, false), CameraMotion());
    EXPECT_EQ(motionOf(spaceMouseState("mouse", {}), 1, false), CameraMotion());
    const std::array<float, 2> two = {1, 0};
    EXPECT_EQ(motionOf(spaceMouseState("mouse", two), 1, false), (CameraMotion{.right = 1}));
    const std::array<float, 9> nine = {1, 0, 0, 0, 0, 0, 1, 1, 1};
    EXPECT_EQ(motionOf(spaceMouseState("mouse", nine), 1, false), (CameraMotion{.right = 1}));
}

TEST(Steering, axesOutOfRangeAreClamped) {
    EXPECT_EQ(gamepadMotion({1e30f, 0, 0, 0, -1e30f, 1e30f}), (CameraMotion{.right = 1, .up = 1}));
    EXPECT_EQ(spaceMouseMotion({-7, 0, 0, 0, 0, 0}), (CameraMotion{.right = -1}));
}

TEST(Steering, aStickAtItsEndDoesAsMuchAsAKey) {
    EXPECT_EQ(gamepadMotion({0, -1, 0, 0, -1, -1}), (CameraMotion{.forward = 1}));
    EXPECT_EQ(gamepadMotion({-1, 0, 0, 0, -1, -1}), (CameraMotion{.right = -1}));
    EXPECT_EQ(gamepadMotion({0, 0, 1, 0, -1, -1}), (CameraMotion{.lookRight = 1}));
    EXPECT_EQ(gamepadMotion({0, 0, 0, -1, -1, -1}), (CameraMotion{.lookUp = 1}));
    EXPECT_EQ(gamepadMotion({0, 0, 0, 0, 1, -1}), (CameraMotion{.up = -1}));
    EXPECT_EQ(gamepadMotion({0, 0, 0, 0, 1, 1}), CameraMotion());
}

TEST(Steering, eachAxisOfASpaceMouseDoesOneThingAndRollingItNothing) {
    EXPECT_EQ(spaceMouseMotion({1, 0, 0, 0, 0, 0}), (CameraMotion{.right = 1}));
    EXPECT_EQ(spaceMouseMotion({0, 1, 0, 0, 0, 0}), (CameraMotion{.forward = -1}));
    EXPECT_EQ(spaceMouseMotion({0, 0, 1, 0, 0, 0}), (CameraMotion{.up = -1}));
    EXPECT_EQ(spaceMouseMotion({0, 0, 0, 1, 0, 0}), (CameraMotion{.lookUp = 1}));
    EXPECT_EQ(spaceMouseMotion({0, 0, 0, 0, 1, 0}), CameraMotion());
    EXPECT_EQ(spaceMouseMotion({0, 0, 0, 0, 0, 1}), (CameraMotion{.lookRight = 1}));
}

TEST(Steering, theResponseStartsAtTheDeadZoneWithoutAStepAndGrowsToOne) {
    EXPECT_EQ(steeringResponse(0.15, 0.15), 0);
    EXPECT_LT(steeringResponse(0.151, 0.15), 1e-4);
    EXPECT_DOUBLE_EQ(steeringResponse(1, 0.15), 1);
    EXPECT_LT(steeringResponse(0.575, 0.15), 0.3);  // fine near the centre
    for (double deflection = 0.16; deflection < 1; deflection += 0.01)
        EXPECT_LT(steeringResponse(deflection, 0.15), steeringResponse(deflection + 0.01, 0.15));
}

TEST(Steering, aStickKeepsItsDirection) {
    const CameraMotion motion = gamepadMotion({0.3f, -0.6f, 0, 0, -1, -1});
    EXPECT_NEAR(motion.forward, 2 * motion.right, 1e-6);
    const CameraMotion corner = gamepadMotion({1, -1, 0, 0, -1, -1});  // as square sticks report it
    EXPECT_NEAR(std::hypot(corner.forward, corner.right), 1, 1e-9);
}

TEST(Steering, theSensitivityScalesAllAndInversionTurnsOnlyThePitch) {
    const SteeringState state = gamepadState("pad", Axes{0, -1, 0, -1, -1, -1}, {});
    EXPECT_EQ(motionOf(state, 2.5, false), (CameraMotion{.forward = 2.5, .lookUp = 2.5}));
    EXPECT_EQ(motionOf(state, 1, true), (CameraMotion{.forward = 1, .lookUp = -1}));
}

TEST(Steering, aHeldButtonIsPressedOnceAndNotByADeviceThatComes) {
    const std::array<std::uint8_t, 15> held = {1, 0, 0, 0, 0, 1};
    const std::vector<SteeringState> none;
    const std::vector<SteeringState> up = {gamepadState("pad", atRest, {})};
    const std::vector<SteeringState> down = {gamepadState("pad", atRest, held)};
    const std::vector<SteeringState> other = {gamepadState("another", atRest, held)};
    EXPECT_THAT(pressedButtons(up, down), ElementsAre(GamepadButton::A, GamepadButton::RightBumper));
    EXPECT_THAT(pressedButtons(down, down), IsEmpty());
    EXPECT_THAT(pressedButtons(down, up), IsEmpty());
    EXPECT_THAT(pressedButtons(none, down), IsEmpty());
    EXPECT_THAT(pressedButtons(up, other), IsEmpty());
    EXPECT_TRUE(isUsed(down[0]));
}

TEST(Steering, moreButtonsThanAGamepadHasAreIgnored) {
    const std::array<std::uint8_t, 32> many = {0, 1};
    EXPECT_TRUE(gamepadState("pad", atRest, many).buttons[1]);
}

TEST(Steering, spaceMiceAreKnownByTheirNames) {
    EXPECT_TRUE(isSpaceMouse("3Dconnexion SpaceNavigator"));
    EXPECT_TRUE(isSpaceMouse("3DCONNEXION Universal Receiver"));
    EXPECT_TRUE(isSpaceMouse("SpaceMouse Pro"));
    EXPECT_FALSE(isSpaceMouse("Xbox Wireless Controller"));
    EXPECT_FALSE(isSpaceMouse(""));
}

}  // namespace
}  // namespace worldy
