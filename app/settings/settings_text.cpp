#include "app/settings/settings_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/output_file.h"
#include "app/base/toml_file.h"
#include "app/settings/setting_labels.h"
#include "app/settings/settings_table.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// The names of the settings that a table holds go to read. Former names in one pass and the present ones in
// another, so that where a file has both the present one counts.
Result<void> readTable(const fs::path& file, std::string_view tableName, const toml::table& table,
                       const std::vector<Field>& fields, bool formerNames, std::vector<std::string>& read) {
    for (const auto& [key, node] : table) {
        const std::string name = fmt::format("{}.{}", tableName, key.str());
        const Field* field = findField(fields, name);
        if (!field) return unknownSetting(placeOf(file, node), name, fields);
        if (isFormerName(name) != formerNames) continue;
        if (Result<void> good = readField(file, *field, name, node); !good) return good;
        read.push_back(field->name());
    }
    return {};
}

// Into the settings; returns the names of those that the document holds.
Result<std::vector<std::string>> readDocument(const fs::path& file, const toml::table& document,
                                              Settings& settings) {
    const std::vector<Field> fields = fieldsOf(settings);
    std::vector<std::string> read;
    for (const bool formerNames : {true, false}) {
        for (const auto& [key, node] : document) {
            const std::string_view name = key.str();
            const bool known =
                std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.table == name; });
            const toml::table* table = node.as_table();
            if (!known || !table) return unknownSetting(placeOf(file, node), name, fields);
            if (Result<void> good = readTable(file, name, *table, fields, formerNames, read); !good)
                return tl::unexpected(good.error());
        }
    }
    return read;
}

Result<Settings> settingsOf(const fs::path& file, const toml::table& document, const Settings& base) {
    Settings settings = base;
    return readDocument(file, document, settings).map([&](const auto&) { return std::move(settings); });
}

Result<ViewPart> viewPartOf(const fs::path& file, const toml::table& document) {
    Settings settings;
    const Result<std::vector<std::string>> names = readDocument(file, document, settings);
    if (!names) return tl::unexpected(names.error());
    ViewPart part{settings.view, {}};
    std::copy_if(names->begin(), names->end(), std::back_inserter(part.names),
                 [](const std::string& name) { return isViewTable(name.substr(0, name.find('.'))); });
    return part;
}

template <class Wanted>
std::string textOf(const Settings& settings, const Wanted& wanted) {
    Settings copy = settings;
    std::string text;
    std::string_view table;
    for (const Field& field : fieldsOf(copy)) {
        if (!wanted(field)) continue;
        if (field.table != table) text += fmt::format("\n[{}]\n", field.table);
        table = field.table;
        if (!field.meaning.empty()) text += fmt::format("# {}\n", field.meaning);
        text += fmt::format("{} = {}\n", field.key, tomlText(field));
    }
    return text;
}

template <class Wanted>
std::vector<SettingDifference> differencesIn(Settings here, Settings there, const Wanted& wanted) {
    const std::vector<Field> hereFields = fieldsOf(here), thereFields = fieldsOf(there);
    std::vector<SettingDifference> found;
    for (std::size_t i = 0; i < hereFields.size(); ++i) {
        if (!wanted(hereFields[i])) continue;
        std::string hereText = plainText(hereFields[i]), thereText = plainText(thereFields[i]);
        if (hereText == thereText) continue;
        const std::string name = hereFields[i].name();
        found.push_back({name, std::move(hereText), std::move(thereText), std::string(settingLabel(name))});
    }
    return found;
}

bool isViewField(const Field& field) {
    return isViewTable(field.table);
}

Settings settingsWith(const ViewSettings& view) {
    Settings settings;
    settings.view = view;
    return settings;
}

std::string_view withoutSpaces(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
    return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// The value of an assignment. Words and texts may do without quotes; what is not TOML at all is taken for a
// text, and the field says what would be right.
toml::table valueFrom(const Field& field, std::string_view text) {
    const bool bare =
        std::holds_alternative<Choice>(field.value) || std::holds_alternative<Text>(field.value);
    if (!std::holds_alternative<Text>(field.value)) text = withoutSpaces(text);
    const bool quoted = text.starts_with('"') || text.starts_with('\'');
    if (!bare || quoted) {
        const Result<toml::table> parsed = parseTomlText(fmt::format("value = {}", text), {});
        // A copy has forgotten its line, which the user never saw.
        if (parsed && parsed->size() == 1) return toml::table(*parsed);
    }
    return toml::table{{"value", std::string(text)}};
}

}  // namespace

bool operator==(const Settings& a, const Settings& b) {
    return a.view == b.view && settingsText(a) == settingsText(b);
}

Result<Settings> loadSettings(const fs::path& file, const Settings& base) {
    return parseTomlFile(file).and_then(
        [&](const toml::table& document) { return settingsOf(file, document, base); });
}

Result<Settings> settingsFromText(std::string_view text, const fs::path& place, const Settings& base) {
    return parseTomlText(text, place).and_then([&](const toml::table& document) {
        return settingsOf(place, document, base);
    });
}

std::string settingsText(const Settings& settings) {
    return "# Worldy's settings, written on exit. Delete a line to restore its default.\n" +
           textOf(settings, [](const Field&) { return true; });
}

Result<void> saveSettings(const Settings& settings, const fs::path& file) {
    std::error_code status;
    fs::create_directories(fs::absolute(file).parent_path(), status);
    return writeTextFile(file, settingsText(settings));
}

Result<void> setSetting(Settings& settings, std::string_view assignment) {
    const std::string place = fmt::format("{:.60}", assignment);
    const std::size_t equals = assignment.find('=');
    const std::string_view name = withoutSpaces(assignment.substr(0, equals));
    const std::vector<Field> fields = fieldsOf(settings);
    const Field* field = findField(fields, name);
    if (!field) return unknownSetting(place, name, fields);
    if (equals == std::string_view::npos) {
        return planet::badInput(
            fmt::format("{}: has no value; expected {}={}", place, name, plainText(*field)));
    }
    const toml::table value = valueFrom(*field, assignment.substr(equals + 1));
    return readField(place, *field, name, *value.get("value"));
}

std::vector<SettingDifference> differences(const Settings& here, const Settings& there) {
    return differencesIn(here, there, isViewField);
}

std::vector<std::string> assignmentsFor(const ViewSettings& view) {
    std::vector<std::string> assignments;
    for (const SettingDifference& difference : differences(Settings{}, settingsWith(view)))
        assignments.push_back(fmt::format("{}={}", difference.setting, difference.there));
    return assignments;
}

std::string viewSettingsText(const ViewSettings& view) {
    return "# Partial view settings of Worldy; keys not listed keep their values.\n" +
           textOf(settingsWith(view), isViewField);
}

Result<ViewPart> loadViewPart(const fs::path& file) {
    return parseTomlFile(file).and_then(
        [&](const toml::table& document) { return viewPartOf(file, document); });
}

Result<ViewPart> viewPartFromText(std::string_view text, const fs::path& place) {
    return parseTomlText(text, place).and_then([&](const toml::table& document) {
        return viewPartOf(place, document);
    });
}

ViewSettings applied(const ViewPart& part, const ViewSettings& now) {
    Settings from = settingsWith(part.values), to = settingsWith(now);
    const std::vector<Field> fromFields = fieldsOf(from), toFields = fieldsOf(to);
    for (const std::string& name : part.names)
        copyValue(*findField(fromFields, name), *findField(toFields, name));
    return to.view;
}

std::vector<SettingDifference> differences(const ViewSettings& here, const ViewPart& there) {
    return differencesIn(settingsWith(here), settingsWith(there.values), [&](const Field& field) {
        return std::find(there.names.begin(), there.names.end(), field.name()) != there.names.end();
    });
}

Result<ViewSettings> loadViewSettings(const fs::path& file, const ViewSettings& now) {
    return loadViewPart(file).map([&](const ViewPart& part) { return applied(part, now); });
}

}  // namespace worldy
