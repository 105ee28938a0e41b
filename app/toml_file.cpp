#include "app/toml_file.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace worldy {

namespace {

std::string shown(const toml::node& node) {
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    return text.str().substr(0, 60);
}

std::string wanted(std::string_view kind, const NumberRange& range) {
    const std::string unit = range.unit.empty() ? std::string() : fmt::format(" of {}", range.unit);
    return fmt::format("{}{} from {} to {} would be right", kind, unit, range.min, range.max);
}

tl::unexpected<planet::Error> wrong(const std::filesystem::path& file, std::string_view name,
                                    const toml::node& node, const std::string& right) {
    return planet::badInput(fmt::format("{}: {} is {}; {}", placeOf(file, node), name, shown(node), right));
}

}  // namespace

std::string placeOf(const std::filesystem::path& file, const toml::node& node) {
    return fmt::format("{}: line {}", file.string(), node.source().begin.line);
}

planet::Result<toml::table> parseTomlFile(const std::filesystem::path& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) {
        return planet::ioError(fmt::format("{}: no such file; give the path of a TOML file", path.string()));
    }
    std::ifstream stream(path, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    if (!stream)
        return planet::ioError(fmt::format("{}: cannot be read; check its permissions", path.string()));
    try {
        return toml::parse(text.str(), path.string());
    } catch (const toml::parse_error& error) {
        return planet::badInput(fmt::format("{}: line {}: not TOML: {}; see toml.io for the syntax",
                                            path.string(), error.source().begin.line, error.description()));
    }
}

planet::Result<double> readNumber(const std::filesystem::path& file, std::string_view name,
                                  const toml::node& node, const NumberRange& range) {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || *value < range.min || *value > range.max) {
        return wrong(file, name, node, wanted("a number", range));
    }
    return *value;
}

planet::Result<std::int64_t> readInteger(const std::filesystem::path& file, std::string_view name,
                                         const toml::node& node, const NumberRange& range) {
    const std::optional<std::int64_t> value = node.value_exact<std::int64_t>();
    if (!value || static_cast<double>(*value) < range.min || static_cast<double>(*value) > range.max) {
        return wrong(file, name, node, wanted("a whole number", range));
    }
    return *value;
}

planet::Result<bool> readBool(const std::filesystem::path& file, std::string_view name,
                              const toml::node& node) {
    const std::optional<bool> value = node.value_exact<bool>();
    if (!value) return wrong(file, name, node, "true or false would be right");
    return *value;
}

planet::Result<std::string> readText(const std::filesystem::path& file, std::string_view name,
                                     const toml::node& node) {
    const std::optional<std::string> value = node.value_exact<std::string>();
    if (!value) return wrong(file, name, node, "a text in quotes would be right");
    return *value;
}

}  // namespace worldy
