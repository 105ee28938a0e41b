#include "app/settings/settings_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/base/output_file.h"
#include "app/base/toml_file.h"
#include "app/settings/setting_value.h"
#include "app/settings/settings_schema.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// Reads the settings that a table contains and appends their names.
Result<void> readTable(const fs::path& file, std::string_view tableName, const toml::table& table,
                       const std::vector<Field>& fields, std::vector<std::string>& names) {
    for (const auto& [key, node] : table) {
        std::string name = fmt::format("{}.{}", tableName, key.str());
        const Field* field = findField(fields, name);
        if (!field) return unknownSetting(placeOf(file, node), name, fields);
        if (Result<void> good = readField(file, *field, node); !good) return good;
        names.push_back(std::move(name));
    }
    return {};
}

// Reads a document into the settings. Returns the names of the settings that it contains.
Result<std::vector<std::string>> readDocument(const fs::path& file, const toml::table& document,
                                              Settings& settings) {
    const std::vector<Field> fields = fieldsOf(settings);
    std::vector<std::string> names;
    for (const auto& [key, node] : document) {
        const std::string_view name = key.str();
        const bool known =
            std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.table == name; });
        const toml::table* table = node.as_table();
        if (!known || !table) return unknownSetting(placeOf(file, node), name, fields);
        if (Result<void> good = readTable(file, name, *table, fields, names); !good)
            return tl::unexpected(good.error());
    }
    return names;
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
std::vector<SettingDifference> differencesIn(Settings here, Settings there, const Wanted& wanted) {
    const std::vector<Field> hereFields = fieldsOf(here), thereFields = fieldsOf(there);
    std::vector<SettingDifference> found;
    for (std::size_t i = 0; i < hereFields.size(); ++i) {
        if (!wanted(hereFields[i])) continue;
        std::string hereText = plainText(hereFields[i]), thereText = plainText(thereFields[i]);
        if (hereText == thereText) continue;
        found.push_back({hereFields[i].name(), std::move(hereText), std::move(thereText),
                         std::string(titleOf(hereFields[i]))});
    }
    return found;
}

bool isViewField(const Field& field) {
    return isViewTable(field.table);
}

Result<Workspace> layoutOf(const fs::path& file, const toml::table& document) {
    Settings settings;
    const Result<std::vector<std::string>> names = readDocument(file, document, settings);
    if (!names) return tl::unexpected(names.error());
    const std::vector<Field> fields = fieldsOf(settings);
    for (const std::string& name : *names) {
        if (isLayoutField(*findField(fields, name))) continue;
        return planet::badInput(
            fmt::format("{}: {} is not part of a layout; expected the table panels, and the sizes of the "
                        "docks in the table "
                        "window",
                        file.string(), name));
    }
    return settings.workspace;
}

Settings settingsWith(const ViewSettings& view) {
    Settings settings;
    settings.view = view;
    return settings;
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

std::string fieldsText(std::span<const Field> fields) {
    std::string text;
    std::string_view table;
    for (const Field& field : fields) {
        if (field.table != table) text += fmt::format("\n[{}]\n", field.table);
        table = field.table;
        std::string summary = summaryOf(field);
        summary.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(summary.front())));
        text += fmt::format("# {} {}.\n{} = {}\n", firstSentence(field), summary, field.key, tomlText(field));
    }
    return text;
}

std::string settingsText(const Settings& settings) {
    Settings copy = settings;
    return "# Worldy's settings, written on exit. Delete a line to restore its default.\n" +
           fieldsText(fieldsOf(copy));
}

Result<void> saveSettings(const Settings& settings, const fs::path& file) {
    std::error_code status;
    fs::create_directories(fs::absolute(file).parent_path(), status);
    return writeTextFile(file, settingsText(settings));
}

Result<void> setSetting(Settings& settings, std::string_view assignment) {
    return setSetting(fieldsOf(settings), assignment);
}

Result<void> setSetting(std::span<const Field> fields, std::string_view assignment) {
    const std::string place = fmt::format("{:.60}", assignment);
    const std::size_t equals = assignment.find('=');
    std::string_view name = assignment.substr(0, equals);
    while (name.starts_with(' ')) name.remove_prefix(1);
    while (name.ends_with(' ')) name.remove_suffix(1);
    const Field* field = findField(fields, name);
    if (!field) return unknownSetting(place, name, fields);
    if (equals == std::string_view::npos) {
        return planet::badInput(
            fmt::format("{}: has no value; expected {}={}", place, name, plainText(*field)));
    }
    return setField(place, *field, assignment.substr(equals + 1));
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
    ViewSettings copy = view;
    return "# Partial view settings of Worldy; keys not listed keep their values.\n" +
           fieldsText(fieldsOf(copy));
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
    ViewSettings from = part.values, to = now;
    const std::vector<Field> fromFields = fieldsOf(from), toFields = fieldsOf(to);
    for (const std::string& name : part.names)
        copyValue(*findField(fromFields, name), *findField(toFields, name));
    return to;
}

std::vector<SettingDifference> differences(const ViewSettings& here, const ViewPart& there) {
    return differencesIn(settingsWith(here), settingsWith(there.values), [&](const Field& field) {
        return std::find(there.names.begin(), there.names.end(), field.name()) != there.names.end();
    });
}

std::string layoutText(const Workspace& workspace) {
    Settings settings;
    settings.workspace = workspace;
    std::vector<Field> fields = fieldsOf(settings);
    std::erase_if(fields, [](const Field& field) { return !isLayoutField(field); });
    return "# A layout of Worldy's window; keys not listed have their defaults.\n" + fieldsText(fields);
}

Result<Workspace> loadLayout(const fs::path& file) {
    return parseTomlFile(file).and_then(
        [&](const toml::table& document) { return layoutOf(file, document); });
}

Result<ViewSettings> loadViewSettings(const fs::path& file, const ViewSettings& now) {
    return loadViewPart(file).map([&](const ViewPart& part) { return applied(part, now); });
}

}  // namespace worldy
