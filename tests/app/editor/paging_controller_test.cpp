// Pausing paging, and who may.
#include "app/editor/paging_controller.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

TEST(PagingController, pausesWithoutAPlanetButNotDuringAReplay) {
    const Log log;
    PagingController paging;
    execute(paging, ui::PausePaging{true}, nullptr, nullptr, true, log);
    EXPECT_FALSE(paging.paused);
    execute(paging, ui::PausePaging{true}, nullptr, nullptr, false, log);
    EXPECT_TRUE(paging.paused);
    execute(paging, ui::LoadOne{}, nullptr, nullptr, false, log);
}

}  // namespace
}  // namespace worldy
