#include "planet/source/toml_file.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace planet {

namespace {

std::string wanted(std::string_view kind, const NumberRange& range) {
    return fmt::format("expected {} in {}", kind, textOf(range));
}

tl::unexpected<Error> wrong(const std::filesystem::path& file, std::string_view name, const toml::node& node,
                            const std::string& right) {
    return badInput(fmt::format("{}: {} is {}; {}", placeOf(file, node), name, shownValue(node), right));
}

// The parts of a dotted key become nested tables. Parsing and destroying a million of them would overflow the
// stack. All dots of a line are counted, because a quoted part may contain anything but a newline.
constexpr std::size_t mostDotsALine = 5000;

// Returns the first line with more dots, 0 if there is none. Consecutive dots count as one.
std::size_t lineOfEndlessKey(std::string_view text) {
    std::size_t line = 1, dots = 0;
    char before = 0;  // last character that is not a space or tab
    for (const char letter : text) {
        if (letter == '.' && before != '.' && ++dots > mostDotsALine) return line;
        if (letter != ' ' && letter != '\t') before = letter;
        if (letter != '\n') continue;
        ++line;
        dots = 0;
    }
    return 0;
}

}  // namespace

std::string shownValue(const toml::node& node) {
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    return text.str().substr(0, 60);
}

std::string placeOf(const std::filesystem::path& file, const toml::node& node) {
    if (node.source().begin.line == 0) return file.string();
    return fmt::format("{}: line {}", file.string(), node.source().begin.line);
}

Result<toml::table> parseTomlFile(const std::filesystem::path& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) {
        return ioError(fmt::format("{}: no such file; expected a TOML file", path.string()));
    }
    if (const std::uintmax_t bytes = std::filesystem::file_size(path, status);
        !status && bytes > mostTomlBytes) {
        return badInput(fmt::format("{}: is {} bytes large; expected at most {} for a TOML file",
                                    path.string(), bytes, mostTomlBytes));
    }
    std::ifstream stream(path, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    if (!stream) return ioError(fmt::format("{}: cannot be read; expected a readable file", path.string()));
    return parseTomlText(text.str(), path);
}

Result<toml::table> parseTomlText(std::string_view text, const std::filesystem::path& place) {
    if (const std::size_t line = lineOfEndlessKey(text); line > 0) {
        return badInput(fmt::format("{}: line {}: has more than {} dots; expected several lines",
                                    place.string(), line, mostDotsALine));
    }
    try {
        return toml::parse(text, place.string());
    } catch (const toml::parse_error& error) {
        return badInput(fmt::format("{}: line {}: not TOML: {}; expected the syntax of toml.io",
                                    place.string(), error.source().begin.line, error.description()));
    }
}

Result<double> readNumber(const std::filesystem::path& file, std::string_view name, const toml::node& node,
                          const NumberRange& range) {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || *value < range.min || *value > range.max) {
        return wrong(file, name, node, wanted("a number", range));
    }
    return *value;
}

Result<std::int64_t> readInteger(const std::filesystem::path& file, std::string_view name,
                                 const toml::node& node, const NumberRange& range) {
    const std::optional<std::int64_t> value = node.value_exact<std::int64_t>();
    if (!value || static_cast<double>(*value) < range.min || static_cast<double>(*value) > range.max) {
        return wrong(file, name, node, wanted("an integer", range));
    }
    return *value;
}

Result<bool> readBool(const std::filesystem::path& file, std::string_view name, const toml::node& node) {
    const std::optional<bool> value = node.value_exact<bool>();
    if (!value) return wrong(file, name, node, "expected true or false");
    return *value;
}

Result<std::string> readText(const std::filesystem::path& file, std::string_view name,
                             const toml::node& node) {
    const std::optional<std::string> value = node.value_exact<std::string>();
    if (!value) return wrong(file, name, node, "expected a text in quotes");
    return *value;
}

}  // namespace planet
