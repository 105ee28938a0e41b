#include "app/settings/setting_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include "app/base/colour_text.h"
#include "app/base/edit_distance.h"
#include "app/base/toml_file.h"
#include "app/base/utf8.h"
#include "app/settings/layer_file.h"
#include "app/settings/panel_text.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;
using planet::gl::maxRampStops;

std::string joined(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    return text;
}

// Returns the name of a choice. Features that are on, off or automatic were flags once: recordings and settings files of that
// time say true or false.
std::string choiceName(const toml::node& node) {
    const toml::value<bool>* const flag = node.as_boolean();
    const std::string text = flag ? (flag->get() ? "true" : "false") : node.value_or(std::string());
    return text == "true" ? "on" : text == "false" ? "off" : text;
}

struct ReadField {
    const fs::path& file;
    const std::string name;
    const toml::node& node;

    tl::unexpected<planet::Error> wrong(const toml::node& where, const std::string& message) const {
        return planet::badInput(fmt::format("{}: {}", placeOf(file, where), message));
    }

    Result<void> operator()(const Number& number) const {
        return readNumber(file, name, node, number.range).map([&](double v) { *number.value = v; });
    }
    Result<void> operator()(const Integer& integer) const {
        return readInteger(file, name, node, integer.range).map([&](std::int64_t v) {
            *integer.value = static_cast<int>(v);
        });
    }
    Result<void> operator()(const Seed& seed) const {
        return readInteger(file, name, node, Seed::range).map([&](std::int64_t v) {
            *seed.value = static_cast<std::uint32_t>(v);
        });
    }
    Result<void> operator()(const Flag& flag) const {
        return readBool(file, name, node).map([&](bool v) { *flag.value = v; });
    }
    Result<void> operator()(const Text& text) const {
        return readText(file, name, node).map([&](const std::string& v) { *text.value = v; });
    }
    Result<void> operator()(const Choice& choice) const {
        const auto found = std::find(choice.names.begin(), choice.names.end(), choiceName(node));
        if (found == choice.names.end()) {
            return wrong(node, fmt::format("{} is {}; expected one of {}", name, shownValue(node),
                                           joined(choice.names)));
        }
        *choice.value = static_cast<std::uint8_t>(found - choice.names.begin());
        return {};
    }
    Result<void> operator()(const Ramp& ramp) const {
        const toml::array* array = node.as_array();
        if (!array) {
            return wrong(
                node,
                fmt::format(
                    "{} is {}; expected an array of stops such as [{{ height_m = 0, colour = \"#40a060\" }}]",
                    name, shownValue(node)));
        }
        if (array->size() > maxRampStops) {
            return wrong(
                node, fmt::format("{} has {} stops; expected at most {}", name, array->size(), maxRampStops));
        }
        std::vector<planet::gl::RampStop> stops;
        for (const toml::node& stop : *array) {
            if (Result<void> read = readStop(stop, stops); !read) return read;
        }
        *ramp.value = std::move(stops);
        return {};
    }

    Result<void> operator()(const LayerStack& layers) const {
        return layersFromToml(file, name, node).map([&](std::vector<planet::TextureLayer> read) {
            *layers.value = std::move(read);
        });
    }

    Result<void> operator()(const TabOrder& order) const {
        return panelOrderFromToml(file, name, node).map([&](const PanelOrder& read) { *order.value = read; });
    }
    Result<void> operator()(const FloatingPanels& floating) const {
        return floatingPanelsFromToml(file, name, node, *floating.value);
    }

    Result<void> readStop(const toml::node& stop, std::vector<planet::gl::RampStop>& stops) const {
        const std::string stopName = fmt::format("{}: stop {}", name, stops.size() + 1);
        const toml::table* table = stop.as_table();
        const toml::node* height = table ? table->get("height_m") : nullptr;
        const toml::node* colour = table ? table->get("colour") : nullptr;
        if (!height || !colour || table->size() != 2) {
            return wrong(stop, fmt::format("{} is not a stop; expected {{ height_m = 0, colour = \"#40a060\" "
                                           "}} with exactly these two keys",
                                           stopName));
        }
        const Result<double> heightM =
            readNumber(file, stopName + ": height_m", *height, {-100000, 100000, "m"});
        if (!heightM) return tl::unexpected(heightM.error());
        if (!stops.empty() && *heightM <= stops.back().heightM) {
            return wrong(
                *height,
                fmt::format("{}: height_m is {}; expected more than {}, the height of the previous stop",
                            stopName, *heightM, stops.back().heightM));
        }
        const std::optional<glm::vec3> rgb = colourFromText(colour->value_or(std::string()));
        if (!rgb) {
            return wrong(*colour, fmt::format("{}: colour is {}; expected red, green and blue as \"#rrggbb\"",
                                              stopName, shownValue(*colour)));
        }
        stops.push_back({*heightM, *rgb});
        return {};
    }
};

struct FieldText {
    std::string_view lineBreak;  // between the stops of a ramp
    std::string_view lineEnd;    // after the stops

    // Returns the shortest digits that read back as the same number.
    std::string operator()(const Number& number) const { return fmt::format("{}", *number.value); }
    std::string operator()(const Integer& integer) const { return fmt::format("{}", *integer.value); }
    std::string operator()(const Seed& seed) const { return fmt::format("{}", *seed.value); }
    std::string operator()(const Flag& flag) const { return *flag.value ? "true" : "false"; }
    std::string operator()(const Text& text) const {
        // TOML is UTF-8, but file names may not be. The default is written then, so that the file stays
        // readable.
        if (!isUtf8(*text.value)) return "\"\"";
        std::ostringstream stream;
        stream << toml::value<std::string>(*text.value);
        return stream.str();
    }
    std::string operator()(const Ramp& ramp) const {
        std::string text;
        for (const planet::gl::RampStop& stop : *ramp.value) {
            text += fmt::format("{}{}{{ height_m = {}, colour = \"{}\" }}", text.empty() ? "" : ",",
                                lineBreak, stop.heightM, colourText(stop.colour));
        }
        return ramp.value->empty() ? "[]" : fmt::format("[{}{}]", text, lineEnd);
    }
    std::string operator()(const LayerStack& layers) const {
        std::string text;
        for (const planet::TextureLayer& layer : *layers.value)
            text += fmt::format("{}{}{}", text.empty() ? "" : ",", lineBreak, layerLine(layer));
        return layers.value->empty() ? "[]" : fmt::format("[{}{}]", text, lineEnd);
    }
    std::string operator()(const TabOrder& order) const { return panelOrderText(*order.value); }
    std::string operator()(const FloatingPanels& floating) const {
        return floatingPanelsText(*floating.value, lineBreak, lineEnd);
    }
    std::string operator()(const Choice& choice) const {
        return fmt::format("\"{}\"", choice.names[*choice.value]);
    }
};

struct AllowedText {
    std::string operator()(const Number& number) const {
        return fmt::format("number in {}", textOf(number.range));
    }
    std::string operator()(const Integer& integer) const {
        return fmt::format("integer in {}", textOf(integer.range));
    }
    std::string operator()(const Seed&) const { return fmt::format("integer in {}", textOf(Seed::range)); }
    std::string operator()(const Flag&) const { return "true or false"; }
    std::string operator()(const Text&) const { return "text"; }
    std::string operator()(const Ramp&) const {
        return fmt::format("at most {} stops {{ height_m = 0, colour = \"#40a060\" }}", maxRampStops);
    }
    std::string operator()(const LayerStack&) const {
        return fmt::format("at most {} layers", planet::maxLayers);
    }
    std::string operator()(const TabOrder&) const { return "keys of panels"; }
    std::string operator()(const FloatingPanels&) const {
        return "tables { panel = \"chunk\", x = 0.5, y = 0.3, width = 380, height = 420 }";
    }
    std::string operator()(const Choice& choice) const {
        return fmt::format("one of {}", fmt::join(choice.names, ", "));
    }
};

std::string_view withoutSpaces(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
    return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// Parses the text of a value. Words and texts need no quotes. A text that is not TOML counts as a string, so
// that the field's error names what it expects.
toml::table valueFrom(const Field& field, std::string_view text) {
    const bool bare =
        std::holds_alternative<Choice>(field.value) || std::holds_alternative<Text>(field.value);
    if (!std::holds_alternative<Text>(field.value)) text = withoutSpaces(text);
    const bool quoted = text.starts_with('"') || text.starts_with('\'');
    if (!bare || quoted) {
        const Result<toml::table> parsed = parseTomlText(fmt::format("value = {}", text), {});
        // The copy has no line number, which would mean nothing to the user.
        if (parsed && parsed->size() == 1) return toml::table(*parsed);
    }
    return toml::table{{"value", std::string(text)}};
}

}  // namespace

Result<void> readField(const fs::path& file, const Field& field, const toml::node& node) {
    return std::visit(ReadField{file, field.name(), node}, field.value);
}

Result<void> setField(std::string_view place, const Field& field, std::string_view text) {
    const toml::table value = valueFrom(field, text);
    return readField(place, field, *value.get("value"));
}

tl::unexpected<planet::Error> unknownSetting(const std::string& place, std::string_view name,
                                             std::span<const Field> fields) {
    // A very long name is compared by its beginning only, which is far from every name anyway.
    constexpr std::size_t mostLetters = 100;
    std::string nearest;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const Field& field : fields) {
        const std::size_t distance = editDistance(field.name(), name.substr(0, mostLetters));
        if (distance < least) nearest = field.name();
        least = std::min(least, distance);
    }
    // A name that is far from all settings gets no suggestion.
    const std::size_t letters = std::max(std::min(name.size(), mostLetters), nearest.size());
    std::string instead = 3 * least <= letters ? "did you mean " + nearest + "?"
                                               : "expected a name of the settings file, such as lod.tau_px";
    if (name == "key") instead = "the file seems to be a flight; expected a settings file";
    if (name == "layer") instead = "the file seems to be a texture layer set; expected a settings file";
    return planet::badInput(fmt::format("{}: {:.60} is not a setting; {}", place, name, instead));
}

std::string tomlText(const Field& field) {
    return std::visit(FieldText{"\n    ", "\n"}, field.value);
}

std::string plainText(const Field& field) {
    if (const Choice* choice = std::get_if<Choice>(&field.value))
        return std::string(choice->names[*choice->value]);
    return std::visit(FieldText{" ", " "}, field.value);
}

std::string allowedText(const Field& field) {
    return std::visit(AllowedText{}, field.value);
}

std::string summaryOf(const Field& field) {
    const Field& defaults = defaultOf(field);
    const Text* text = std::get_if<Text>(&defaults.value);
    // A layer stack and the order of all tabs are too long for a line.
    const bool layers = std::holds_alternative<LayerStack>(field.value);
    const bool order = std::holds_alternative<TabOrder>(field.value);
    const std::string value = layers                         ? "the built-in layers"
                              : order                        ? "the order of the View menu"
                              : text && text->value->empty() ? "empty"
                                                             : plainText(defaults);
    const bool list = std::holds_alternative<Choice>(field.value);
    return fmt::format("{}{} default {}", allowedText(field), list ? ";" : ",", value);
}

}  // namespace worldy
