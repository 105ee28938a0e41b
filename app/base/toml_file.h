// Reading TOML with errors that name the file, the line, the key and what would be right.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "planet/base/result.h"

namespace worldy {

struct NumberRange {
    double min = 0;
    double max = 0;
    std::string_view unit;  // "px"; may be empty
};

// A file of at most 16 MiB.
planet::Result<toml::table> parseTomlFile(const std::filesystem::path& path);
// The same of text; place stands for the file's name in errors.
planet::Result<toml::table> parseTomlText(std::string_view text, const std::filesystem::path& place);

// Well-formed, as TOML has to be.
bool isUtf8(std::string_view text);

// A value for a message, cut short.
std::string shownValue(const toml::node& node);

// "settings.toml: line 3"; without the line where the node was not read from a text.
std::string placeOf(const std::filesystem::path& file, const toml::node& node);

// "[0.1, 64] px".
std::string textOf(const NumberRange& range);

// A finite number of the range, integers included.
planet::Result<double> readNumber(const std::filesystem::path& file, std::string_view name,
                                  const toml::node& node, const NumberRange& range);
planet::Result<std::int64_t> readInteger(const std::filesystem::path& file, std::string_view name,
                                         const toml::node& node, const NumberRange& range);
planet::Result<bool> readBool(const std::filesystem::path& file, std::string_view name,
                              const toml::node& node);
planet::Result<std::string> readText(const std::filesystem::path& file, std::string_view name,
                                     const toml::node& node);

}  // namespace worldy
