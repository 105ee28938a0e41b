// Reads TOML, as the library does.
#pragma once

#include <fmt/format.h>

#include <sstream>
#include <string>

#include "planet/source/toml_file.h"

namespace worldy {

using planet::NumberRange;
using planet::parseTomlFile;
using planet::parseTomlText;
using planet::placeOf;
using planet::readBool;
using planet::readInteger;
using planet::readNumber;
using planet::readText;
using planet::shownValue;
using planet::textOf;

// Returns the Error that names the file and the line of a node.
inline tl::unexpected<planet::Error> wrong(const std::filesystem::path& file, const toml::node& node,
                                           const std::string& message) {
    return planet::badInput(fmt::format("{}: {}", placeOf(file, node), message));
}

// Returns a text as a TOML string in quotes.
inline std::string tomlText(const std::string& text) {
    std::ostringstream stream;
    stream << toml::value<std::string>(text);
    return stream.str();
}

}  // namespace worldy
