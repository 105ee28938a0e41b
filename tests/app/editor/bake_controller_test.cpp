#include "app/editor/bake_controller.h"

#include <gmock/gmock.h>

#include "tests/app/session_fixture.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class BakeControllerTest : public test::SessionTest {
protected:
    void ask(const BakeRequest& request) {
        execute(bakes_, ui::EstimateBake{request}, session_, panel_, log_);
    }
    ui::BakeView view() const { return bakeViewOf(bakes_, session_); }
    bool answered() {
        return advanceUntil(session_, [&] {
            advanceEstimate(bakes_.estimator);
            return !view().estimating;
        });
    }

    const std::filesystem::path source_ = writeSource();
    Session session_ = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17}));
    BakeController bakes_;
    ui::BakePanelState panel_;
};

TEST_F(BakeControllerTest, theLastOfSeveralQuestionsIsAnswered) {
    ask(requestFor(source_, 17, 1025));
    advanceEstimate(bakes_.estimator);
    ask(requestFor(source_, 65, 257));
    EXPECT_TRUE(view().estimating);
    ASSERT_TRUE(answered());
    ASSERT_TRUE(view().estimate);
    EXPECT_EQ(planet::chunkSize(view().estimate->shape), 65);
    EXPECT_GT(view().estimate->fileBytes, 512);
}

TEST_F(BakeControllerTest, anEstimateThatCannotBeMadeSaysWhy) {
    ask(requestFor(source_, 17, 1000));
    ASSERT_TRUE(answered());
    EXPECT_FALSE(view().estimate);
    EXPECT_THAT(view().estimateProblem, HasSubstr("face size: 1000"));
    BakeRequest request = requestFor(source_, 17);
    request.colour = "/nonexistent/map.png";
    ask(request);
    ASSERT_TRUE(answered());
    EXPECT_THAT(view().estimateProblem, HasSubstr("/nonexistent/map.png"));
}

TEST_F(BakeControllerTest, theViewHoldsTheSessionsBakesAndTheWorlds) {
    ASSERT_TRUE(advanceUntilQuiet(session_));
    EXPECT_EQ(view().current.settings.chunkSize, 17);
    EXPECT_EQ(view().worlds.size(), 4u);
}

}  // namespace
}  // namespace worldy
