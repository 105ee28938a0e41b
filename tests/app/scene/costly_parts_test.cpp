#include "app/scene/costly_parts.h"

#include <gtest/gtest.h>

namespace worldy {

namespace {

using planet::gl::FeatureUse;

std::size_t downCount(const TurnedDown& turnedDown) {
    std::size_t count = 0;
    for (const bool part : turnedDown.parts) count += part ? 1 : 0;
    return count;
}

TEST(CostlyParts, StayWhilePicturesAreFastEnough) {
    TurnedDown turnedDown;
    for (int frame = 0; frame < 1000; ++frame)
        EXPECT_FALSE(watchPicture(turnedDown, SurfaceSettings{}, affordedMs, 0.05 * frame));
    EXPECT_EQ(downCount(turnedDown), 0u);
}

TEST(CostlyParts, AFewSlowPicturesTurnNothingDown) {
    TurnedDown turnedDown;
    for (int frame = 0; frame < 1000; ++frame) {
        const double gpuMs = frame % 10 == 0 ? 20 : 300;
        EXPECT_FALSE(watchPicture(turnedDown, SurfaceSettings{}, gpuMs, 0.1 * frame));
    }
}

TEST(CostlyParts, GoOneByOneWhilePicturesStaySlow) {
    TurnedDown turnedDown;
    turnedDown.fastAtS = 100;
    for (std::size_t part = 0; part < costlyPartCount; ++part) {
        const double fromS = 100 + patienceS * static_cast<double>(part);
        EXPECT_FALSE(watchPicture(turnedDown, SurfaceSettings{}, 80, fromS + 0.9 * patienceS));
        EXPECT_TRUE(watchPicture(turnedDown, SurfaceSettings{}, 80, fromS + patienceS));
        EXPECT_TRUE(turnedDown.parts[part]);
        EXPECT_EQ(turnedDown.tookMs[part], 80);
        EXPECT_EQ(downCount(turnedDown), part + 1);
    }
    EXPECT_FALSE(watchPicture(turnedDown, SurfaceSettings{}, 80, 1000));
}

TEST(CostlyParts, WhatTheUserHasSetIsLeftAlone) {
    SurfaceSettings surface;
    surface.light.air.use = FeatureUse::On;
    surface.light.normals.use = FeatureUse::Off;
    TurnedDown turnedDown;
    EXPECT_TRUE(watchPicture(turnedDown, surface, 80, 10));
    EXPECT_TRUE(turnedDown.has(CostlyPart::Layers));
    turnedDown.parts.fill(true);
    turnDown(turnedDown, surface);
    EXPECT_EQ(surface.light.air.use, FeatureUse::On);
    for (const CostlyPart part :
         {CostlyPart::Normals, CostlyPart::Layers, CostlyPart::Shadows, CostlyPart::Sea})
        EXPECT_EQ(useOf(part, surface), FeatureUse::Off);
}

}  // namespace

}  // namespace worldy
