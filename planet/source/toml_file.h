// Reads TOML. Each Error names the file, the line, the key and the expected value.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "planet/base/number_range.h"
#include "planet/base/result.h"

namespace planet {

inline constexpr std::uintmax_t mostTomlBytes = 16u << 20;  // of a file

// Reads a file of at most mostTomlBytes.
Result<toml::table> parseTomlFile(const std::filesystem::path& path);
// Parses text. place stands for the file name in errors.
Result<toml::table> parseTomlText(std::string_view text, const std::filesystem::path& place);

// Returns a value for a message, truncated to 60 bytes.
std::string shownValue(const toml::node& node);

// Returns "settings.toml: line 3", without the line if the node was not parsed from text.
std::string placeOf(const std::filesystem::path& file, const toml::node& node);

// Reads a finite number in the range; integers are numbers too.
Result<double> readNumber(const std::filesystem::path& file, std::string_view name, const toml::node& node,
                          const NumberRange& range);
Result<std::int64_t> readInteger(const std::filesystem::path& file, std::string_view name,
                                 const toml::node& node, const NumberRange& range);
Result<bool> readBool(const std::filesystem::path& file, std::string_view name, const toml::node& node);
Result<std::string> readText(const std::filesystem::path& file, std::string_view name,
                             const toml::node& node);

}  // namespace planet
