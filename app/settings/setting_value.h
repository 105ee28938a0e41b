// The values of settings as text. Pure functions.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "app/settings/settings_schema.h"
#include "planet/base/result.h"

namespace worldy {

// Reads a value into a field.
planet::Result<void> readField(const std::filesystem::path& file, const Field& field, const toml::node& node);

// Sets a field to a value as typed: "3", "level", "true". The Error begins with the place.
planet::Result<void> setField(std::string_view place, const Field& field, std::string_view text);

// Returns the Error for an unknown setting: "place: lod.tua_px is not a setting; did you mean lod.tau_px?",
// or, if no name is near, what the name seems to belong to.
tl::unexpected<planet::Error> unknownSetting(const std::string& place, std::string_view name,
                                             std::span<const Field> fields);

// Returns the value as TOML; equal values give equal text.
std::string tomlText(const Field& field);
// Returns the same in one line, without the quotes of words: "level".
std::string plainText(const Field& field);

// Returns the allowed values: "number in [0.1, 64] px".
std::string allowedText(const Field& field);
// Returns the allowed values and the default: "number in [0.1, 64] px, default 2".
std::string summaryOf(const Field& field);

}  // namespace worldy
