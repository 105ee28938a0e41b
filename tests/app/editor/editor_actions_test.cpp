// Inspecting a place, and what is drawn after it.
#include "app/editor/editor_actions.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

struct EditorActions : testing::Test {
    Editor editor_;

    void inspectPop(PopSide side) {
        editor_.rig = CameraRig{};
        inspect(editor_, {}, {});
        editor_.pops.side = side;
    }
};

TEST_F(EditorActions, TheEndOfAnInspectionDrawsLiveAgain) {
    inspectPop(PopSide::Before);
    endInspection(editor_);
    EXPECT_EQ(editor_.pops.side, PopSide::Live);
    EXPECT_FALSE(editor_.lodFrozen);
}

TEST_F(EditorActions, UnfreezingDrawsLiveAgainAndFreezingDoesNot) {
    inspectPop(PopSide::After);
    freezeLod(editor_, true);
    EXPECT_EQ(editor_.pops.side, PopSide::After);
    EXPECT_FALSE(editor_.beforeInspection);
    freezeLod(editor_, false);
    EXPECT_EQ(editor_.pops.side, PopSide::Live);
    EXPECT_FALSE(editor_.lodFrozen);
}

TEST_F(EditorActions, AnotherInspectedPlaceIsDrawnLive) {
    inspectPop(PopSide::Before);
    inspect(editor_, {}, {});
    EXPECT_EQ(editor_.pops.side, PopSide::Live);
}

TEST_F(EditorActions, AFileIsRecentOnceItIsOpenAndNotBefore) {
    Session session;
    editor_.opening = "/maps/good.tif";
    session.bake.emplace();
    EXPECT_FALSE(followOpening(session, editor_));
    EXPECT_TRUE(editor_.recent.empty());
    session.bake.reset();
    EXPECT_TRUE(followOpening(session, editor_));
    EXPECT_EQ(editor_.recent, (std::vector<std::filesystem::path>{"/maps/good.tif"}));
    EXPECT_FALSE(followOpening(session, editor_));
}

TEST_F(EditorActions, AFileThatCannotBeBakedIsNotRecent) {
    Session session;
    editor_.opening = "/maps/bad.tif";
    session.problem = planet::Error{planet::ErrorKind::BadInput, "/maps/bad.tif: truncated or damaged"};
    EXPECT_FALSE(followOpening(session, editor_));
    EXPECT_TRUE(editor_.recent.empty());
    EXPECT_FALSE(editor_.opening);
    EXPECT_TRUE(editor_.message.title.empty());  // the viewport says so, since no planet is open
}

}  // namespace
}  // namespace worldy
