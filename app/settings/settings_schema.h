// The schema of all settings, one entry each: name, label, help, unit, range and presentation. The settings
// file, --set, the options of the command line, the controls of the panels and app/SETTINGS.md are generated
// from it. The defaults are those of Settings. Pure functions.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/settings/settings.h"
#include "planet/base/number_range.h"

namespace worldy {

using planet::NumberRange;

enum class SliderScale : std::uint8_t { Linear, Logarithmic };

struct Number {
    double* value;
    NumberRange range;
    const char* format = "%.2f";  // of the digits in a control; the unit follows
    SliderScale scale = SliderScale::Linear;
};
struct Integer {
    int* value;
    NumberRange range;
    SliderScale scale = SliderScale::Linear;
};
struct Seed {
    static constexpr NumberRange range{0, 4294967295.0, ""};
    std::uint32_t* value;
};
struct Flag {
    bool* value;
};
struct Text {
    std::string* value;
};
struct Ramp {
    std::vector<planet::gl::RampStop>* value;
};
struct LayerStack {
    std::vector<planet::TextureLayer>* value;
};
// The order of the tabs: the panels' keys.
struct TabOrder {
    PanelOrder* value;
};
// The panels that float, with their places. Reading it leaves the docks as they are.
struct FloatingPanels {
    std::array<PanelPlace, panelCount>* value;
};
// An enumerator, stored as its index in the names.
struct Choice {
    std::uint8_t* value;
    std::span<const std::string_view> names;     // in files and on the command line
    std::span<const std::string_view> labels{};  // on screen; empty: the names
};

// One setting. The value points into the settings from which the field was made.
struct Field {
    std::string_view table;
    std::string_view key;
    std::string_view label;  // of its control
    std::string_view help;   // full sentences; the first says what the setting is
    std::variant<Number, Integer, Seed, Flag, Text, Ramp, LayerStack, TabOrder, FloatingPanels, Choice> value;
    std::string_view title{};  // the label with its topic, for use without context; empty: the label

    std::string name() const;  // "lod.tau_px"
    const void* address() const;
};

// Return the fields grouped by table, in the order of the file.
std::vector<Field> fieldsOf(Settings& settings);
std::vector<Field> fieldsOf(ViewSettings& view);

// Returns the fields of Settings{}: the defaults.
std::span<const Field> defaultFields();
// Return a field of Settings{}, by its name, which must exist, or for the same setting.
const Field& defaultField(std::string_view name);
const Field& defaultOf(const Field& field);

// Returns the range of a number or an integer.
const NumberRange& rangeOf(std::string_view name);

// Returns true for the tables of ViewSettings, which presets contain. The others describe the data set, the
// camera and the window.
bool isViewTable(std::string_view table);

// Returns true for the settings that a layout contains: the docks and panels, but neither the size of the
// window nor the theme and the scale.
bool isLayoutField(const Field& field);

// Returns the field of that name, or null.
const Field* findField(std::span<const Field> fields, std::string_view name);

// Returns the label with its topic if it has one: "Tint opacity".
std::string_view titleOf(const Field& field);
// Returns the first sentence of the help.
std::string_view firstSentence(const Field& field);
// Returns an enumerator's words on screen: "load order".
std::string choiceLabel(const Choice& choice, std::size_t index);

// Copies the value of one setting; both fields must be of the same setting.
void copyValue(const Field& from, const Field& to);
// Returns the same field with its value in other settings.
Field movedTo(const Field& field, Settings& settings);

}  // namespace worldy
