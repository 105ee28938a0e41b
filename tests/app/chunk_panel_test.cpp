// Drives the chunk inspector, and asks for the badges over the viewport, without a window.
#include "ui/chunk_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "../editor_fixture.h"
#include "../fake_pyramid.h"
#include "ui/item_map.h"
#include "ui/theme.h"
#include "ui/viewport_overlay.h"
#include "ui/widgets.h"

namespace ui {
namespace {

std::unique_ptr<planet::Planet> openPlanet() {
    auto opened = planet::Planet::open(planet::fakePyramid().source(), {});
    EXPECT_TRUE(opened);
    return std::move(*opened);
}

class ChunkPanel : public testing::Test {
protected:
    ChunkPanel() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {400, 1400};
        applyTheme(Theme::Dark, 1);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        fixture_.fly({}, 2);
        selected_ = fixture_.view().focus.selected;
        io.MousePos = {-1, -1};
        frame();
        frame();
    }
    ~ChunkPanel() override { ImGui::DestroyContext(); }

    void frame() {
        ImGui::GetIO().DeltaTime = 1.0f / 60;
        commands_.clear();
        items_.clear();
        collectItems(&items_);
        ImGui::NewFrame();
        beginFixedWindow("panel", {0, 0, 400, 1400});
        EditorView view = fixture_.view();
        view.focus.selected = selected_;
        chunkPanel(view, state_, settings_, commands_);
        ImGui::End();
        ImGui::Render();
        collectItems(nullptr);
    }

    bool isShown(const std::string& item) const {
        return std::any_of(items_.begin(), items_.end(),
                           [&](const ItemPlace& place) { return place.name.ends_with(item); });
    }

    void click(const std::string& item) {
        const auto found = std::find_if(items_.begin(), items_.end(),
                                        [&](const ItemPlace& place) { return place.name.ends_with(item); });
        ASSERT_NE(found, items_.end()) << item;
        const Rect& rect = found->rect;
        ImGui::GetIO().MousePos = {rect.x + rect.width / 2, rect.y + rect.height / 2};
        frame();
        ImGui::GetIO().MouseDown[0] = true;
        frame();
        ImGui::GetIO().MouseDown[0] = false;
        frame();
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
            if (const auto* found = std::get_if<SelectChunk>(&command)) return found->id;
        }
        return std::nullopt;
    }

    worldy::test::EditorFixture fixture_{openPlanet()};
    ChunkPanelState state_;
    ViewSettings settings_;
    Commands commands_;
    std::vector<ItemPlace> items_;
    std::optional<planet::ChunkId> selected_;
};

TEST_F(ChunkPanel, ShowsHeightsOfAResidentChunkAndNoneOfOneThatIsNot) {
    EXPECT_TRUE(isShown("Heights"));
    EXPECT_TRUE(isShown("Profile"));
    planet::ChunkId absent{planet::Face::NegX, 4, 3, 3};
    const planet::Planet& planet = *fixture_.view().planet;
    for (const planet::Face face : planet::allFaces) {
        absent.face = face;
        if (findNode(planet.tree(), absent) == planet::noNode) break;
    }
    ASSERT_EQ(findNode(planet.tree(), absent), planet::noNode);
    selected_ = absent;
    frame();
    EXPECT_TRUE(isShown("Look at"));
    EXPECT_FALSE(isShown("Heights"));
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
    EXPECT_TRUE(isShown("Id"));
    EXPECT_FALSE(isShown("Look at"));
}

TEST_F(ChunkPanel, BadgesTellWhatChangesHowThePictureIsRead) {
    EditorView view = fixture_.view();
    ViewSettings settings;
    EXPECT_TRUE(viewportBadges(view, settings).empty());
    view.lodFrozen = view.framesPaused = view.pagingPaused = true;
    view.data.showsPreviousBake = true;
    settings.paging.badDisk.failureRate = 0.1;
    settings.overlay.wireframe = settings.overlay.cube = true;
    std::string all;
    for (const ViewportBadge& badge : viewportBadges(view, settings)) all += badge.text + '\n';
    for (const char* part :
         {"Paused", "LOD frozen", "Previous bake", "Paging paused", "Bad disk", "Wireframe", "Cube"}) {
        EXPECT_NE(all.find(part), std::string::npos) << part;
    }
}

}  // namespace
}  // namespace ui
