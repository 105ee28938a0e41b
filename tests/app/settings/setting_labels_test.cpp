#include "app/settings/setting_labels.h"

#include <gtest/gtest.h>

#include <set>

#include "app/settings/settings_table.h"

namespace worldy {
namespace {

TEST(SettingLabels, everyViewSettingHasALabelOfItsOwn) {
    Settings settings;
    std::set<std::string_view> labels;
    for (const Field& field : fieldsOf(settings)) {
        if (!isViewTable(field.table)) continue;
        const std::string name = field.name();
        const std::string_view label = settingLabel(name);
        EXPECT_NE(label, name);
        EXPECT_EQ(label.find('_'), std::string_view::npos) << label;
        EXPECT_TRUE(labels.insert(label).second) << label;
    }
}

TEST(SettingLabels, areTheWordsOfThePanels) {
    EXPECT_EQ(settingLabel("lod.tau_px"), "Tolerance τ");
    EXPECT_EQ(settingLabel("surface.layer_colour_below"), "Base-colour blend");
    EXPECT_EQ(settingLabel("light.air_forward"), "Mie asymmetry g");
}

}  // namespace
}  // namespace worldy
