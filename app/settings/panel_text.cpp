#include "app/settings/panel_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "app/base/toml_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// The keys of a table of a floating panel, except "panel".
struct PlaceKey {
    std::string_view key;
    double FloatingPlace::*value;
    NumberRange range;
};
constexpr std::array<PlaceKey, 4> placeKeys = {
    {{"x", &FloatingPlace::x, {0, 1, ""}},
     {"y", &FloatingPlace::y, {0, 1, ""}},
     {"width", &FloatingPlace::width, {leastFloatingWidth, mostFloatingSize, ""}},
     {"height", &FloatingPlace::height, {leastFloatingHeight, mostFloatingSize, ""}}}};
constexpr std::string_view exampleTable =
    "{ panel = \"chunk\", x = 0.5, y = 0.3, width = 380, height = 420 }";

std::optional<PanelId> panelOfKey(std::string_view key) {
    const auto found = std::find_if(panelInfos.begin(), panelInfos.end(),
                                    [&](const PanelInfo& info) { return info.key == key; });
    return found == panelInfos.end() ? std::nullopt : std::optional(found->id);
}

Result<PanelId> readPanel(const fs::path& file, const std::string& name, const toml::node& node) {
    const std::optional<PanelId> panel = panelOfKey(node.value_or(std::string()));
    if (panel) return *panel;
    return wrong(
        file, node,
        fmt::format("{} is {}; expected the key of a panel, such as \"lod\"", name, shownValue(node)));
}

std::string_view keyOf(PanelId panel) {
    return panelInfos[static_cast<std::size_t>(panel)].key;
}

struct FloatingPanel {
    PanelId panel = PanelId::Lod;
    FloatingPlace place;
};

Result<FloatingPanel> readFloating(const fs::path& file, const std::string& name, const toml::node& node) {
    const toml::table* table = node.as_table();
    const toml::node* panel = table ? table->get("panel") : nullptr;
    if (!panel) {
        return wrong(file, node, fmt::format("{} is not a floating panel; expected {}", name, exampleTable));
    }
    FloatingPanel read;
    for (const auto& [key, value] : *table) {
        const std::string_view keyName = key.str();
        if (keyName == "panel") continue;
        const auto known = std::find_if(placeKeys.begin(), placeKeys.end(),
                                        [&](const PlaceKey& one) { return one.key == keyName; });
        if (known == placeKeys.end()) {
            return wrong(
                file, value,
                fmt::format("{}: {:.60} is unknown; expected panel, x, y, width or height", name, key.str()));
        }
        const Result<double> number =
            readNumber(file, fmt::format("{}: {}", name, known->key), value, known->range);
        if (!number) return tl::unexpected(number.error());
        read.place.*known->value = *number;
    }
    return readPanel(file, name + ": panel", *panel).map([&](PanelId id) {
        read.panel = id;
        return read;
    });
}

}  // namespace

Result<PanelOrder> panelOrderFromToml(const fs::path& file, std::string_view name, const toml::node& node) {
    const toml::array* array = node.as_array();
    if (!array) {
        return wrong(file, node,
                     fmt::format("{} is {}; expected an array of panels such as [\"lod\", \"seams\"]", name,
                                 shownValue(node)));
    }
    std::vector<PanelId> listed;
    const auto isListed = [&](PanelId id) {
        return std::find(listed.begin(), listed.end(), id) != listed.end();
    };
    for (const toml::node& entry : *array) {
        const Result<PanelId> panel =
            readPanel(file, fmt::format("{}: panel {}", name, listed.size() + 1), entry);
        if (!panel) return tl::unexpected(panel.error());
        if (isListed(*panel)) {
            return wrong(
                file, entry,
                fmt::format("{} lists {} twice; expected each panel at most once", name, keyOf(*panel)));
        }
        listed.push_back(*panel);
    }
    for (const PanelId id : firstOrder()) {
        if (!isListed(id)) listed.push_back(id);
    }
    PanelOrder order{};
    std::copy_n(listed.begin(), panelCount, order.begin());
    return order;
}

std::string panelOrderText(const PanelOrder& order) {
    std::string text;
    for (const PanelId id : order) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", keyOf(id));
    return "[" + text + "]";
}

Result<void> floatingPanelsFromToml(const fs::path& file, std::string_view name, const toml::node& node,
                                    std::array<PanelPlace, panelCount>& panels) {
    const toml::array* array = node.as_array();
    if (!array) {
        return wrong(file, node,
                     fmt::format("{} is {}; expected an array of tables such as [{}]", name, shownValue(node),
                                 exampleTable));
    }
    std::array<PanelPlace, panelCount> changed = panels;
    for (PanelPlace& place : changed) place.floats = false;
    std::size_t number = 0;
    for (const toml::node& entry : *array) {
        const Result<FloatingPanel> read = readFloating(file, fmt::format("{}: {}", name, ++number), entry);
        if (!read) return tl::unexpected(read.error());
        PanelPlace& place = changed[static_cast<std::size_t>(read->panel)];
        if (place.floats) {
            return wrong(
                file, entry,
                fmt::format("{} lists {} twice; expected each panel at most once", name, keyOf(read->panel)));
        }
        place.floats = true;
        place.floating = read->place;
    }
    panels = changed;
    return {};
}

std::string floatingPanelsText(const std::array<PanelPlace, panelCount>& panels, std::string_view lineBreak,
                               std::string_view lineEnd) {
    std::string text;
    for (std::size_t i = 0; i < panelCount; ++i) {
        if (!panels[i].floats) continue;
        const FloatingPlace& place = panels[i].floating;
        text += fmt::format("{}{}{{ panel = \"{}\", x = {}, y = {}, width = {}, height = {} }}",
                            text.empty() ? "" : ",", lineBreak, panelInfos[i].key, place.x, place.y,
                            place.width, place.height);
    }
    return text.empty() ? "[]" : fmt::format("[{}{}]", text, lineEnd);
}

}  // namespace worldy
