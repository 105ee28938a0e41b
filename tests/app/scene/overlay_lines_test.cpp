#include "app/scene/overlay_lines.h"

#include <gtest/gtest.h>

#include "planet/planet_tools.h"
#include "tests/support/planet_fixture.h"

namespace worldy {
namespace {

// Vertices of lines that are of a colour like red, or like amber.
std::pair<int, int> redAndAmber(const planet::Planet& planet, bool outlines) {
    ViewSettings settings;
    settings.overlay.outlines = outlines;
    int red = 0, amber = 0;
    for (const planet::LineVertex& vertex :
         overlayLines(planet.tree(), planet.selection(), planet.views()[0].input.lodView, settings)) {
        red += vertex.colour[1] < 100;
        amber += vertex.colour[1] >= 100;
    }
    return {red, amber};
}

TEST(OverlayLines, OutlinesMarkWhatStaysCoarseBecauseItCouldNotBeRead) {
    planet::Faulty faulty;
    planet::PagingSettings paging;
    paging.time = planet::PagingTime::Simulated;
    paging.retry = {.retries = 1, .delayS = 10};
    const auto planet = planet::Planet::open(faulty.source(), paging).value();
    planet::ViewInput input;
    input.lodView = planet::viewAt(10, 20, 2e4);
    input.lod = planet::fineSettings();
    input.lod.frustumCulling = input.lod.horizonCulling = false;
    for (int i = 0; i < 10; ++i) planet->step({&input, 1}, planet::noUpload, 0.1);
    ASSERT_GT(planet->paging().awaitingRetry(), 0u);
    EXPECT_EQ(redAndAmber(*planet, false), std::pair(0, 0));
    EXPECT_EQ(redAndAmber(*planet, true).first, 0);
    const int waiting = redAndAmber(*planet, true).second;
    EXPECT_GT(waiting, 0);
    ASSERT_TRUE(planet->settle({&input, 1}, planet::noUpload, 100));
    EXPECT_EQ(redAndAmber(*planet, true), std::pair(waiting, 0));
    faulty.broken = false;
    planet->tools().retryFailed();
    ASSERT_TRUE(planet->settle({&input, 1}, planet::noUpload, 100));
    EXPECT_EQ(redAndAmber(*planet, true), std::pair(0, 0));
}

}  // namespace
}  // namespace worldy
