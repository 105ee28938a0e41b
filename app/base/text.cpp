#include "app/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "planet/source/terrain.h"

namespace worldy {

namespace {

// Returns three significant digits, and no fraction from 100 on.
std::string threeDigits(double value) {
    const double size = std::abs(value);
    return fmt::format("{:.{}f}", value, size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2);
}

}  // namespace

std::string sourceName(const std::filesystem::path& source) {
    if (!planet::isTerrainText(source)) {
        const std::string text = source.string();
        const auto more = std::ranges::count(text, '|');
        const std::string first = std::filesystem::path(text.substr(0, text.find('|'))).filename().string();
        return more == 0 ? first : fmt::format("{} and {} more", first, more);
    }
    const planet::Result<planet::TerrainSource> terrain = planet::terrainFromText(source);
    if (!terrain || terrain->of.empty()) return source.string();
    return sourceName(terrain->of) + " with detail";
}

std::string flightName(const std::filesystem::path& file) {
    std::string name = file.stem().string();
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

std::string bytesText(double bytes) {
    constexpr std::array units = {"B", "KiB", "MiB", "GiB", "TiB"};
    std::size_t unit = 0;
    while (bytes >= 1000 && unit + 1 < units.size()) {
        bytes /= 1024;
        ++unit;
    }
    return unit == 0 ? fmt::format("{:.0f} B", bytes) : fmt::format("{} {}", threeDigits(bytes), units[unit]);
}

std::string countText(double count) {
    if (count < 10'000) return fmt::format("{:.0f}", count);
    constexpr std::array units = {"k", "M", "G", "T"};
    std::size_t unit = 0;
    count /= 1000;
    while (count >= 1000 && unit + 1 < units.size()) {
        count /= 1000;
        ++unit;
    }
    return fmt::format("{} {}", threeDigits(count), units[unit]);
}

std::string countedText(std::uint64_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string durationText(double seconds) {
    if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
    const long long whole = std::llround(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string clockText(double hour) {
    const int minutes = static_cast<int>(std::lround(hour * 60));
    return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

std::string distanceText(double metres) {
    const double size = std::abs(metres);
    if (size < 10) return fmt::format("{:.1f} m", metres);
    if (size < 10'000) return fmt::format("{:.0f} m", metres);
    if (size < 10'000'000) return fmt::format("{:.1f} km", metres / 1000);
    return fmt::format("{:.0f} km", metres / 1000);
}

std::string placeText(double latitudeDeg, double longitudeDeg, int decimals) {
    const double longitude = std::remainder(longitudeDeg, 360.0);
    return fmt::format("{:.{}f}° {}, {:.{}f}° {}", std::abs(latitudeDeg), decimals,
                       latitudeDeg < 0 ? "S" : "N", std::abs(longitude), decimals, longitude < 0 ? "W" : "E");
}

std::optional<double> numberFromText(std::string_view text) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && last == end && std::isfinite(number) ? std::optional(number)
                                                                        : std::nullopt;
}

std::string shortNumberText(const std::string& value) {
    const std::optional<double> number = numberFromText(value);
    if (!number || *number == std::trunc(*number)) return value;
    const int decimals = std::clamp(3 - static_cast<int>(std::floor(std::log10(std::abs(*number)))), 0, 12);
    std::string text = fmt::format("{:.{}f}", *number, decimals);
    if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::array<std::string, 2> shortNumberTexts(const std::string& a, const std::string& b) {
    std::array<std::string, 2> texts = {shortNumberText(a), shortNumberText(b)};
    if (texts[0] == texts[1]) texts = {a, b};
    return texts;
}

std::string millisecondsText(double milliseconds) {
    const double size = std::abs(milliseconds);
    if (size < 9.995) return fmt::format("{:.2f} ms", milliseconds);
    if (size < 999.5) return fmt::format("{:.{}f} ms", milliseconds, size < 99.95 ? 1 : 0);
    return size < 9'995 ? fmt::format("{:.2f} s", milliseconds / 1000) : durationText(milliseconds / 1000);
}

std::string pixelsText(double pixels, const char* unit) {
    // The eye is inside the bounds, where the distance is clamped to a tiny value.
    if (pixels >= 1e6) return std::string("> 1 M") + unit;
    if (pixels >= 10'000) return countText(pixels) + unit;
    const int digits = pixels >= 9.95 || pixels == 0 ? 0 : pixels >= 0.095 ? 1 : 2;
    return fmt::format("{:.{}f}{}", pixels, digits, unit);
}

}  // namespace worldy
