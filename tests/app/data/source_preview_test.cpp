#include "app/data/source_preview.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>

#include "app/editor/instrument_views.h"
#include "tests/app/session_fixture.h"
#include "tests/support/synthetic_source.h"

namespace worldy {
namespace {

using planet::Result;

PreviewRequest requestOf(const char* source, int zoomLog2 = 0, double u = 0, double v = 0) {
    PreviewRequest request;
    request.source = source;
    request.zoomLog2 = zoomLog2;
    request.u = u;
    request.v = v;
    return request;
}

std::array<int, 3> colourAt(const PreviewPicture& picture, int column, int row) {
    const auto at = static_cast<std::size_t>(4 * (row * previewSidePx + column));
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

TEST(SourcePreview, ShowsTheWholeFaceOrASquareThatLiesOnIt) {
    const planet::SampleTile whole = tileOfPreview(requestOf("", 0, 0.7, -3));
    EXPECT_EQ(whole.faceCells, previewSidePx);
    EXPECT_EQ(whole.firstColumn, 0);
    EXPECT_EQ(whole.firstRow, 0);
    EXPECT_EQ(whole.columns, previewSidePx + 1);
    for (const double middle : {-1.0, -0.2, 0.0, 0.63, 1.0}) {
        const planet::SampleTile part = tileOfPreview(requestOf("", 3, middle, -middle));
        EXPECT_EQ(part.faceCells, 8 * previewSidePx);
        EXPECT_GE(part.firstColumn, 0);
        EXPECT_LE(part.firstColumn + part.columns - 1, part.faceCells);
        const double shown = (part.firstColumn + previewSidePx / 2) * 2.0 / part.faceCells - 1;
        EXPECT_NEAR(shown, std::clamp(middle, -7.0 / 8, 7.0 / 8), 1e-3);
    }
    EXPECT_EQ(tileOfPreview(requestOf("", 99)).faceCells, 1 << 22);
}

TEST(SourcePreview, NorthIsUpSeaIsBlueAndTheSunStandsUpperLeft) {
    // Land in the north, sea in the south, a ridge along the meridian in the middle of +x.
    const auto source = planet::test::formulaSource(
        [](const glm::dvec3& d) { return d.z > 0 ? 3000 - 20000 * std::abs(d.y) : -2000; }, -2000, 3000);
    const auto picture = drawPreview(source, requestOf("formula"));
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->rgba.size(), std::size_t{4} * previewSidePx * previewSidePx);
    EXPECT_GT(picture->highM, 2900);
    const auto seaPixel = colourAt(*picture, 128, 200);
    EXPECT_GT(seaPixel[2], seaPixel[0] + 40);
    const auto west = colourAt(*picture, 124, 60), east = colourAt(*picture, 132, 60);
    EXPECT_GT(west[0], east[0] + 20);
    EXPECT_GE(west[0], west[2]);
}

TEST(SourcePreview, FlatGroundHasOneColour) {
    const auto source = planet::test::formulaSource([](const glm::dvec3&) { return 100.0; }, 100, 100);
    const auto picture = drawPreview(source, requestOf("formula"));
    ASSERT_TRUE(picture);
    for (const int at : {0, 77, 255})
        EXPECT_EQ(colourAt(*picture, at, 255 - at), colourAt(*picture, 128, 128));
    EXPECT_EQ(picture->lowM, 100);
}

TEST(SourcePreview, ACancelledOneEndsAsSuch) {
    const auto source = planet::test::hillsSource();
    int asked = 0;
    const auto picture = drawPreview(source, requestOf("formula"), [&] { return ++asked < 3; });
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_EQ(asked, 3);
}

class SourcePreviewerTest : public test::SessionTest {
protected:
    static bool advanceUntilDrawn(SourcePreviewer& previewer) {
        for (int i = 0; i < 4000; ++i) {
            advancePreview(previewer);
            if (!previewViewOf(previewer).working) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }
};

TEST_F(SourcePreviewerTest, TheLastThatWasAskedIsShownInATexture) {
    SourcePreviewer previewer;
    requestPreview(previewer, requestOf("noise:fbm,seed=1"));
    advancePreview(previewer);
    EXPECT_TRUE(previewViewOf(previewer).working);
    EXPECT_EQ(previewViewOf(previewer).texture, nullptr);
    requestPreview(previewer, requestOf("noise:fbm,seed=2"));
    requestPreview(previewer, requestOf("noise:fbm,seed=3"));
    ASSERT_TRUE(advanceUntilDrawn(previewer));
    const ui::SourcePreview view = previewViewOf(previewer);
    EXPECT_NE(view.texture, nullptr);
    EXPECT_EQ(view.shown->source, "noise:fbm,seed=3");
    EXPECT_LT(view.lowM, view.highM);
    EXPECT_EQ(view.problem, "");
}

TEST_F(SourcePreviewerTest, ABadSourceIsToldAndTheLastPictureStays) {
    SourcePreviewer previewer;
    requestPreview(previewer, requestOf("noise:midpoint"));
    ASSERT_TRUE(advanceUntilDrawn(previewer));
    requestPreview(previewer, requestOf("/nonexistent/elevation.tif"));
    ASSERT_TRUE(advanceUntilDrawn(previewer));
    EXPECT_THAT(previewViewOf(previewer).problem, ::testing::HasSubstr("/nonexistent/elevation.tif"));
    EXPECT_EQ(previewViewOf(previewer).shown->source, "noise:midpoint");
    requestPreview(previewer, requestOf("noise:fbm"));
    ASSERT_TRUE(advanceUntilDrawn(previewer));
    EXPECT_EQ(previewViewOf(previewer).problem, "");
}

}  // namespace
}  // namespace worldy
