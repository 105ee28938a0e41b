#include "ui/kit/setting_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

using testing::HasSubstr;

class SettingControlsTest : public testing::Test {
protected:
    // Draws with these fields and clicks at a share of a control's width.
    template <class Draw>
    void click(std::vector<Field> fields, std::string_view item, float share, const Draw& draw) {
        const SettingControls control(std::move(fields));
        const auto frame = [&] { window_.frame([&] { draw(control); }); };
        frame();
        window_.click(item, share, frame);
        window_.movePointer({-1, -1});
    }

    PanelWindow window_{{400, 400}};
    ViewSettings settings_;
};

TEST_F(SettingControlsTest, aSlidersEndsAreThoseOfTheRange) {
    std::vector<Field> fields = fieldsOf(settings_);
    const auto tau = std::find_if(fields.begin(), fields.end(),
                                  [](const Field& field) { return field.name() == "lod.tau_px"; });
    std::get<Number>(tau->value).range = {0.5, 9, "px"};
    const auto draw = [&](const SettingControls& control) { control(settings_.lod.tauPx); };
    click(fields, "/lod.tau_px", 0.999f, draw);
    EXPECT_EQ(settings_.lod.tauPx, 9);
    click(fields, "/lod.tau_px", 0.001f, draw);
    EXPECT_EQ(settings_.lod.tauPx, 0.5);
}

TEST_F(SettingControlsTest, aPanelMayNarrowARange) {
    const auto draw = [&](const SettingControls& control) {
        control(settings_.surface.sunDate.day, {.range = NumberRange{1, 28, ""}});
    };
    click(fieldsOf(settings_), "/surface.sun_day", 0.999f, draw);
    EXPECT_EQ(settings_.surface.sunDate.day, 28);
}

class TypedNumbers : public SettingControlsTest {
protected:
    TypedNumbers() {
        ImGuiIO& io = ImGui::GetIO();
        for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = 300 + key;
        frame();
    }
    void frame() {
        window_.frame([&] {
            const SettingControls control(settings_);
            control(settings_.budget.triangles);
            control(settings_.lod.tauPx);
        });
        seen_.push_back(settings_.budget.triangles);
    }
    void press(int key) {
        for (const bool down : {true, false}) {
            ImGui::GetIO().KeysDown[300 + key] = down;
            frame();
        }
    }
    // Types digits, one in each frame, and notes the budget after each.
    void type(const char* digits) {
        ImGui::GetIO().KeyCtrl = true;
        window_.click("/budget.triangles", 0.5f, [&] { frame(); });
        ImGui::GetIO().KeyCtrl = false;
        frame();
        for (; *digits; ++digits) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(*digits));
            frame();
        }
    }
    // Returns the values that the budget has had, without repetitions.
    std::vector<int> had() const {
        std::vector<int> values = seen_;
        values.erase(std::unique(values.begin(), values.end()), values.end());
        return values;
    }

    std::vector<int> seen_;
};

TEST_F(TypedNumbers, areAppliedWhenEnterEndsTheEdit) {
    type("60000");
    EXPECT_EQ(had(), std::vector<int>{0});
    press(ImGuiKey_Enter);
    EXPECT_EQ(had(), (std::vector<int>{0, 60000}));
}

TEST_F(TypedNumbers, areAppliedWhenAClickEndsTheEdit) {
    type("60000");
    window_.click("/lod.tau_px", 0.5f, [&] { frame(); });
    frame();
    EXPECT_EQ(had(), (std::vector<int>{0, 60000}));
}

TEST_F(TypedNumbers, areAppliedWhenTabEndsTheEdit) {
    type("60000");
    press(ImGuiKey_Tab);
    frame();
    frame();
    EXPECT_EQ(had(), (std::vector<int>{0, 60000}));
}

TEST_F(TypedNumbers, areForgottenByEscape) {
    type("60000");
    press(ImGuiKey_Escape);
    frame();
    EXPECT_EQ(had(), std::vector<int>{0});
}

TEST_F(SettingControlsTest, aBoxIsSwitchedAndFoundByItsLabelToo) {
    const auto draw = [&](const SettingControls& control) {
        control(settings_.lod.frustumCulling);
        control.beside(settings_.lod.horizonCulling);
    };
    click(fieldsOf(settings_), "/Horizon culling", 0.05f, draw);
    EXPECT_FALSE(settings_.lod.horizonCulling);
    EXPECT_TRUE(settings_.lod.frustumCulling);
    EXPECT_EQ(window_.find("/lod.frustum_culling")->rect.y, window_.find("/lod.horizon_culling")->rect.y);
}

TEST_F(SettingControlsTest, aListHasTheLabelsOfTheEnumerators) {
    const SettingControls control(settings_);
    const auto frame = [&] { window_.frame([&] { control(settings_.overlay.colourBy); }); };
    frame();
    window_.click("/overlay.colour_by", 0.5f, frame);
    frame();
    EXPECT_TRUE(window_.isShown("Colour by: load order"));
    window_.click("Colour by: load order", 0.5f, frame);
    EXPECT_EQ(settings_.overlay.colourBy, ColourBy::LoadOrder);
}

TEST_F(SettingControlsTest, drawingChangesNothing) {
    const SettingControls control(settings_);
    window_.frame([&] {
        for (const Field& field : fieldsOf(settings_)) {
            std::visit(
                [&](const auto& kind) {
                    using Kind = std::decay_t<decltype(kind)>;
                    constexpr bool drawn = !std::is_same_v<Kind, Text> && !std::is_same_v<Kind, Ramp> &&
                                           !std::is_same_v<Kind, LayerStack> &&
                                           !std::is_same_v<Kind, TabOrder> &&
                                           !std::is_same_v<Kind, FloatingPanels>;
                    if constexpr (drawn) {
                        EXPECT_FALSE(control(*kind.value)) << field.name();
                    }
                },
                field.value);
        }
    });
    EXPECT_EQ(settings_, ViewSettings{});
}

TEST_F(SettingControlsTest, theTooltipHasHelpNameRangeAndDefault) {
    const Field& tau = defaultField("lod.tau_px");
    EXPECT_EQ(settingTip(tau), std::string(tau.help) + "\nlod.tau_px: number in [0.1, 64] px, default 2.");
    EXPECT_THAT(settingTip(defaultField("lod.metric")),
                HasSubstr("one of additive, tight; default additive."));
}

}  // namespace
}  // namespace worldy::ui
