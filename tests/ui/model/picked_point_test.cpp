#include "ui/model/picked_point.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/action_fixture.h"
#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

struct PickedPointTest : testing::Test {
    void SetUp() override {
        const double planetRadiusM = planet_->tree().shape.radiusM;
        bench_.view.camera.renderView =
            planet::viewFromPose({.altitudeM = planetRadiusM}, planetRadiusM, 1.05, 640, 480);
        planet_->settle(
            bench_.view.camera.renderView, {}, [](std::uint32_t, planet::StepsView) {}, planet::timeoutS);
        bench_.view.planet = planet_.get();
    }
    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    ActionBench bench_;
};

TEST_F(PickedPointTest, thePointerComesBeforeTheSelectedChunkAndThatBeforeTheMiddle) {
    const auto middle = pickedPoint(bench_.view);
    ASSERT_TRUE(middle);
    const planet::View& camera = bench_.view.camera.renderView;
    EXPECT_NEAR(glm::dot(glm::normalize(*middle - camera.eyeM), -camera.back), 1, 1e-9);
    bench_.view.focus.selected = planet_->selection().draw.back().id;
    const auto ofChunk = pickedPoint(bench_.view);
    ASSERT_TRUE(ofChunk);
    EXPECT_NE(*ofChunk, *middle);
    EXPECT_NEAR(glm::length(*ofChunk) / planet_->tree().shape.radiusM, 1, 0.01);
    bench_.view.pointedM = glm::dvec3(1, 2, 3);
    EXPECT_EQ(*pickedPoint(bench_.view), glm::dvec3(1, 2, 3));
}

TEST_F(PickedPointTest, thereIsNoneInTheSkyAndWithoutAPlanet) {
    bench_.view.camera.renderView.back *= -1;
    EXPECT_FALSE(pickedPoint(bench_.view));
    bench_.view.planet = nullptr;
    bench_.view.pointedM = glm::dvec3(1, 2, 3);
    EXPECT_FALSE(pickedPoint(bench_.view));
}

}  // namespace
}  // namespace worldy::ui
