// Drives the chunk inspector, and asks for the badges over the viewport, without a window.
#include "ui/panels/lod/chunk_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/editor_fixture.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/shell/viewport_overlay.h"

namespace worldy::ui {
namespace {

class ChunkPanel : public testing::Test {
protected:
    ChunkPanel() {
        fixture_.fly({}, 2);
        selected_ = fixture_.view().focus.selected;
        frame();
        frame();
    }

    void frame() {
        commands_.clear();
        EditorView view = fixture_.view();
        view.focus.selected = selected_;
        window_.frame([&] { chunkPanel(view, state_, commands_); });
    }

    void click(const std::string& item) {
        window_.click(item, 0.5f, [&] { frame(); });
    }

    void type(const std::string& id) {
        click("Id");
        for (const char letter : id) ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(letter));
        frame();
        const int enter = 1;
        ImGui::GetIO().KeyMap[ImGuiKey_Enter] = enter;
        ImGui::GetIO().KeysDown[enter] = true;
        frame();
        ImGui::GetIO().KeysDown[enter] = false;
    }

    std::optional<planet::ChunkId> askedSelection() const {
        for (const Command& command : commands_) {
            if (const auto* found = command.as<SelectChunk>()) return found->id;
        }
        return std::nullopt;
    }

    PanelWindow window_{{400, 1400}};
    worldy::test::EditorFixture fixture_{planet::openFake()};
    ChunkPanelState state_;
    Commands commands_;
    std::optional<planet::ChunkId> selected_;
};

TEST_F(ChunkPanel, ShowsHeightsOfAResidentChunkAndNoneOfOneThatIsNot) {
    EXPECT_TRUE(window_.isShown("Heights"));
    EXPECT_TRUE(window_.isShown("Profile"));
    planet::ChunkId absent{planet::Face::NegX, 4, 3, 3};
    const planet::Planet& planet = *fixture_.view().planet;
    for (const planet::Face face : planet::allFaces) {
        absent.face = face;
        if (findNode(planet.tree(), absent) == planet::noNode) break;
    }
    ASSERT_EQ(findNode(planet.tree(), absent), planet::noNode);
    selected_ = absent;
    frame();
    EXPECT_TRUE(window_.isShown("Look at"));
    EXPECT_FALSE(window_.isShown("Heights"));
}

TEST_F(ChunkPanel, ParentIsSelectedByItsButton) {
    ASSERT_GT(selected_->level, 0);
    click("Parent");
    EXPECT_EQ(askedSelection(), parentOf(*selected_));
}

TEST_F(ChunkPanel, ATypedIdIsSelectedAndAWrongOneExplained) {
    type("z_neg/2/1/3");
    EXPECT_EQ(askedSelection(), (planet::ChunkId{planet::Face::NegZ, 2, 1, 3}));
    EXPECT_TRUE(state_.problem.empty());
    frame();
    type("z_neg/2/1/4");
    EXPECT_FALSE(askedSelection());
    EXPECT_NE(state_.problem.find("z_neg/2/1/4"), std::string::npos);
}

TEST_F(ChunkPanel, NothingSelectedSaysHowToSelect) {
    selected_.reset();
    frame();
    EXPECT_TRUE(window_.isShown("Id"));
    EXPECT_FALSE(window_.isShown("Look at"));
}

TEST_F(ChunkPanel, BadgesTellWhatChangesHowThePictureIsRead) {
    EditorView view = fixture_.view();
    ViewSettings settings;
    EXPECT_TRUE(viewportBadges(view, settings).empty());
    view.camera.lodFrozen = view.frames.paused = view.pagingPaused = true;
    view.data.showsPreviousBake = view.data.isReadingColourImage = true;
    settings.paging.badDisk.failureRate = 0.1;
    settings.overlay.wireframe = settings.overlay.cube = true;
    std::string all;
    for (const ViewportBadge& badge : viewportBadges(view, settings)) all += badge.text + '\n';
    for (const char* part : {"Reading the colour image", "Paused", "LOD frozen", "Previous bake",
                             "Paging paused", "I/O fault injection", "Wireframe", "Unprojected cube"}) {
        EXPECT_NE(all.find(part), std::string::npos) << part;
    }
}

}  // namespace
}  // namespace worldy::ui
