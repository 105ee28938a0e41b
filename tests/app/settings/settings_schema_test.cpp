#include "app/settings/settings_schema.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "app/cli/command_options.h"
#include "app/cli/settings_command.h"
#include "app/settings/settings_text.h"
#include "tests/support/temporary_folder.h"
#include "ui/kit/setting_controls.h"

namespace worldy {
namespace {

using testing::HasSubstr;

std::optional<NumberRange> rangeIn(const Field& field) {
    if (const Number* number = std::get_if<Number>(&field.value)) return number->range;
    if (const Integer* integer = std::get_if<Integer>(&field.value)) return integer->range;
    return std::nullopt;
}

Field& fieldNamed(std::vector<Field>& fields, std::string_view name) {
    return *std::find_if(fields.begin(), fields.end(),
                         [&](const Field& field) { return field.name() == name; });
}

TEST(SettingsSchema, everyFieldHasALabelAndHelpInFullSentences) {
    for (const Field& field : defaultFields()) {
        EXPECT_FALSE(field.label.empty()) << field.name();
        EXPECT_EQ(field.label.find('_'), std::string_view::npos) << field.name();
        ASSERT_FALSE(field.help.empty()) << field.name();
        EXPECT_TRUE(std::isupper(static_cast<unsigned char>(field.help.front()))) << field.name();
        EXPECT_EQ(field.help.back(), '.') << field.name();
    }
}

TEST(SettingsSchema, everyViewSettingHasATitleOfItsOwn) {
    ViewSettings view;
    std::set<std::string_view> titles;
    for (const Field& field : fieldsOf(view))
        EXPECT_TRUE(titles.insert(titleOf(field)).second) << field.name();
    EXPECT_EQ(titleOf(defaultField("overlay.opacity")), "Tint opacity");
    EXPECT_EQ(titleOf(defaultField("lod.tau_px")), "Tolerance τ");
}

TEST(SettingsSchema, everyEnumeratorHasALabel) {
    for (const Field& field : defaultFields()) {
        const Choice* choice = std::get_if<Choice>(&field.value);
        if (!choice || choice->labels.empty()) continue;
        EXPECT_EQ(choice->labels.size(), choice->names.size()) << field.name();
    }
    EXPECT_EQ(choiceLabel(std::get<Choice>(defaultField("overlay.colour_by").value), 6), "load order");
    EXPECT_EQ(choiceLabel(std::get<Choice>(defaultField("compare.mode").value), 0), "side by side");
}

TEST(SettingsSchema, everyRangeIsNotEmptyAndHoldsTheDefault) {
    for (const Field& field : defaultFields()) {
        const std::optional<NumberRange> range = rangeIn(field);
        if (!range) continue;
        EXPECT_LT(range->min, range->max) << field.name();
        const Integer* integer = std::get_if<Integer>(&field.value);
        const double value = integer ? *integer->value : *std::get<Number>(field.value).value;
        EXPECT_GE(value, range->min) << field.name();
        EXPECT_LE(value, range->max) << field.name();
    }
}

TEST(SettingsSchema, theViewsFieldsAreThoseOfTheSettings) {
    Settings settings;
    std::vector<std::string> all, view;
    for (const Field& field : fieldsOf(settings)) {
        if (isViewTable(field.table)) all.push_back(field.name());
    }
    for (const Field& field : fieldsOf(settings.view)) view.push_back(field.name());
    EXPECT_EQ(all, view);
}

// A value in a file and as an assignment.
std::array<bool, 2> accepts(const Field& field, const std::string& value) {
    Settings settings;
    const std::string text = fmt::format("[{}]\n{} = {}\n", field.table, field.key, value);
    return {settingsFromText(text, "settings.toml").has_value(),
            setSetting(settings, fmt::format("{}={}", field.name(), value)).has_value()};
}

TEST(SettingsSchema, theEndsOfARangeAreAcceptedAndNothingBeyond) {
    const std::array yes = {true, true}, no = {false, false};
    for (const Field& field : defaultFields()) {
        const std::optional<NumberRange> range = rangeIn(field);
        if (!range) continue;
        const auto text = [&](double value) { return fmt::format("{}", value); };
        const bool whole = std::holds_alternative<Integer>(field.value);
        const auto step = [&](double end) { return whole ? 1 : std::max(std::abs(end), 1.0) * 1e-9; };
        EXPECT_EQ(accepts(field, text(range->min)), yes) << field.name();
        EXPECT_EQ(accepts(field, text(range->max)), yes) << field.name();
        EXPECT_EQ(accepts(field, text(range->min - step(range->min))), no) << field.name();
        EXPECT_EQ(accepts(field, text(range->max + step(range->max))), no) << field.name();
    }
}

TEST(SettingsSchema, aChangedRangeIsSeenWhereverTheSettingIs) {
    Settings settings;
    std::vector<Field> fields = fieldsOf(settings);
    Field& tau = fieldNamed(fields, "lod.tau_px");
    std::get<Number>(tau.value).range = {0.5, 9, "px"};
    const char* const allowed = "number in [0.5, 9] px, default 2";
    EXPECT_THAT(fieldsText(fields), HasSubstr("threshold. Number in [0.5, 9] px, default 2.\ntau_px = 2\n"));
    EXPECT_THAT(settingsTable(fields), HasSubstr(allowed));
    EXPECT_THAT(ui::settingTip(tau), HasSubstr(allowed));
    EXPECT_EQ(settingsJson(fields)["settings"][2]["max"], 9);
    const planet::Result<void> set = setSetting(fields, "lod.tau_px=20");
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().message, "lod.tau_px=20: lod.tau_px is 20; expected a number in [0.5, 9] px");

    ViewTexts texts;
    CLI::App app;
    addSettingOption(app, "--tau", tau, texts);
    EXPECT_THAT(app.help(), HasSubstr(allowed));
    try {
        app.parse("--tau 20");
        FAIL() << "--tau 20 is accepted";
    } catch (const CLI::ParseError& error) {
        EXPECT_STREQ(error.what(), "--tau: lod.tau_px is 20; expected a number in [0.5, 9] px");
    }
    app.parse("--tau 9");
    EXPECT_EQ(texts.options, std::vector<std::string>{"lod.tau_px=9"});
}

TEST(SettingsSchema, aFlagSetsItsAssignments) {
    ViewTexts texts;
    CLI::App app;
    addSettingFlag(app, "--no-culling", {"lod.frustum_culling=false", "lod.horizon_culling=false"},
                   "Cull nothing", texts);
    app.parse("--no-culling");
    EXPECT_EQ(texts.options.size(), 2u);
    const planet::Result<Settings> settings = settingsFrom(texts);
    ASSERT_TRUE(settings);
    EXPECT_FALSE(settings->view.lod.frustumCulling || settings->view.lod.horizonCulling);
}

TEST(SettingsSchema, theManualsTableIsThatOfTheSchema) {
    const std::filesystem::path page = std::filesystem::path(WORLDY_SOURCE_DIR) / "app/SETTINGS.md";
    EXPECT_TRUE(tests::contentOf(page) == settingsTable(defaultFields()))
        << page << " is out of date; write it with: worldy settings --table > app/SETTINGS.md";
}

TEST(SettingsSchema, theJsonListHasTypeRangeAndDefault) {
    const nlohmann::ordered_json list = settingsJson(defaultFields())["settings"];
    ASSERT_EQ(list.size(), defaultFields().size());
    const auto named = [&](const char* name) {
        return *std::find_if(list.begin(), list.end(), [&](const auto& one) { return one["name"] == name; });
    };
    const nlohmann::ordered_json tau = named("lod.tau_px");
    EXPECT_EQ(tau["type"], "number");
    EXPECT_EQ(tau["unit"], "px");
    EXPECT_EQ(tau["min"], 0.1);
    EXPECT_EQ(tau["default"], 2);
    EXPECT_EQ(tau["label"], "Tolerance τ");
    EXPECT_EQ(named("seams.mode")["values"], (std::vector<std::string>{"none", "skirts", "stitched"}));
    EXPECT_EQ(named("seams.mode")["default"], "skirts");
    EXPECT_EQ(named("lod.morph")["default"], true);
}

}  // namespace
}  // namespace worldy
