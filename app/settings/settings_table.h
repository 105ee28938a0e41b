// The table of all settings: by which name, in which range and with what meaning each field of Settings
// stands in a TOML file and on the command line. Pure functions.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/base/toml_file.h"
#include "app/settings/settings.h"

namespace worldy {

struct Number {
    double* value;
    NumberRange range;
};
struct Integer {
    int* value;
    NumberRange range;
};
struct Seed {
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
// An enumerator, by its name's place in a list.
struct Choice {
    std::uint8_t* value;
    std::span<const std::string_view> names;
};

// One setting: where it stands in the file, what it means, and which field holds it.
struct Field {
    std::string_view table;
    std::string key;
    std::string_view meaning;
    std::variant<Number, Integer, Seed, Flag, Text, Ramp, LayerStack, Choice> value;

    std::string name() const;  // "lod.tau_px"
};

// Grouped by table, in the order of the file. They point into the settings.
std::vector<Field> fieldsOf(Settings& settings);

// Returns true if the table belongs to ViewSettings, which presets hold. The others hold the data set, the
// camera and the window.
bool isViewTable(std::string_view table);

// The field of that name, or of the name that it had in former versions; null where there is none.
const Field* findField(std::span<const Field> fields, std::string_view name);
bool isFormerName(std::string_view name);

// Reads a value into a field. name: the present or a former one, for errors too.
planet::Result<void> readField(const std::filesystem::path& file, const Field& field, std::string_view name,
                               const toml::node& node);

// "place: lod.tua_px is not a setting; did you mean lod.tau_px?", or where none is near, what the name
// seems to belong to.
tl::unexpected<planet::Error> unknownSetting(const std::string& place, std::string_view name,
                                             std::span<const Field> fields);

// As TOML; equal values give equal text.
std::string tomlText(const Field& field);
// The same in one line, without the quotes of words: "level".
std::string plainText(const Field& field);

// Both of the same setting.
void copyValue(const Field& from, const Field& to);

}  // namespace worldy
