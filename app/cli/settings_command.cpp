#include "app/cli/settings_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

#include "app/base/report.h"
#include "app/settings/setting_value.h"
#include "app/settings/settings_text.h"

namespace worldy {

namespace {

// Returns the text escaped for a cell of a Markdown table.
std::string cellText(std::string_view text) {
    std::string cell;
    for (const char letter : text) {
        if (letter == '|' || letter == '<' || letter == '_' || letter == '*') cell += '\\';
        cell += letter;
    }
    return cell;
}

template <class Kind>
nlohmann::ordered_json rangeJson(const char* type, const Kind& kind) {
    return {{"type", type}, {"min", kind.range.min}, {"max", kind.range.max}, {"unit", kind.range.unit}};
}

struct KindJson {
    nlohmann::ordered_json operator()(const Number& number) const { return rangeJson("number", number); }
    nlohmann::ordered_json operator()(const Integer& integer) const { return rangeJson("integer", integer); }
    nlohmann::ordered_json operator()(const Seed& seed) const { return rangeJson("integer", seed); }
    nlohmann::ordered_json operator()(const Flag&) const { return {{"type", "flag"}}; }
    nlohmann::ordered_json operator()(const Text&) const { return {{"type", "text"}}; }
    nlohmann::ordered_json operator()(const Ramp&) const { return {{"type", "ramp"}}; }
    nlohmann::ordered_json operator()(const LayerStack&) const { return {{"type", "layers"}}; }
    nlohmann::ordered_json operator()(const TabOrder&) const { return {{"type", "panels"}}; }
    nlohmann::ordered_json operator()(const FloatingPanels&) const { return {{"type", "floating_panels"}}; }
    nlohmann::ordered_json operator()(const Choice& choice) const {
        nlohmann::ordered_json values = nlohmann::ordered_json::array();
        for (const std::string_view name : choice.names) values.push_back(name);
        return {{"type", "choice"}, {"values", values}};
    }
};

struct DefaultJson {
    nlohmann::ordered_json operator()(const Number& number) const { return *number.value; }
    nlohmann::ordered_json operator()(const Integer& integer) const { return *integer.value; }
    nlohmann::ordered_json operator()(const Seed& seed) const { return *seed.value; }
    nlohmann::ordered_json operator()(const Flag& flag) const { return *flag.value; }
    nlohmann::ordered_json operator()(const Text& text) const { return *text.value; }
    nlohmann::ordered_json operator()(const Choice& choice) const { return choice.names[*choice.value]; }
    template <class Stops>
    nlohmann::ordered_json operator()(const Stops&) const {
        return tomlText(field);
    }
    const Field& field;
};

}  // namespace

std::string settingsTable(std::span<const Field> fields) {
    std::string text =
        "# Settings\n\n"
        "`worldy settings --table > app/SETTINGS.md` writes this page. The names are those of the settings "
        "file and of `--set`.\n";
    std::string_view table;
    for (const Field& field : fields) {
        if (field.table != table) {
            text +=
                fmt::format("\n## {}\n\n| name | label | values | help |\n|---|---|---|---|\n", field.table);
        }
        table = field.table;
        text += fmt::format("| `{}` | {} | {} | {} |\n", field.name(), cellText(titleOf(field)),
                            cellText(summaryOf(field)), cellText(field.help));
    }
    return text;
}

nlohmann::ordered_json settingsJson(std::span<const Field> fields) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Field& field : fields) {
        nlohmann::ordered_json one = {
            {"name", field.name()}, {"label", titleOf(field)}, {"help", field.help}};
        one.update(std::visit(KindJson{}, field.value));
        const Field& defaults = defaultOf(field);
        one["default"] = std::visit(DefaultJson{defaults}, defaults.value);
        list.push_back(std::move(one));
    }
    return {{"settings", std::move(list)}};
}

planet::Result<void> runSettings(const SettingsCommandOptions& options) {
    const std::span<const Field> fields = defaultFields();
    if (options.json)
        fmt::print("{}", jsonText(settingsJson(fields)));
    else
        fmt::print("{}", options.table ? settingsTable(fields) : settingsText(Settings{}));
    return {};
}

}  // namespace worldy
