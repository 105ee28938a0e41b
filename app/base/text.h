// Converts numbers to readable text with units, and text to numbers. Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace worldy {

// Returns the short name of a source: "elevation.tif", "elevation.tif with detail", "a.tif and 2
// more", "noise:ridged,seed=7".
std::string sourceName(const std::filesystem::path& source);
std::string flightName(const std::filesystem::path& file);       // "orbit to ground" for orbit_to_ground.toml
std::string bytesText(double bytes);                             // "12.3 MiB"
std::string countText(double count);                             // "950", "12.3 k", "4.56 M"
std::string countedText(std::uint64_t count, const char* what);  // "1 flight", "2 flights"
std::string durationText(double seconds);                        // "0.4 s", "12 s", "3 min 20 s", "2 h 5 min"
std::string clockText(double hour);                              // "20:17" for 20.28
std::string distanceText(double metres);                         // "4.2 m", "950 m", "12.3 km", "14000 km"
std::string placeText(double latitudeDeg, double longitudeDeg,
                      int decimals = 4);  // "27.9880° N, 86.9250° E"
// Lower-cases an ASCII letter and returns other characters unchanged.
constexpr char lowerAscii(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
// Returns the number that the whole text is; nothing if the text is not a finite number.
std::optional<double> numberFromText(std::string_view text);
// Rounds a number to four significant digits: "19.63" for "19.630435466766357". Returns other texts
// unchanged.
std::string shortNumberText(const std::string& value);
// Rounds both with shortNumberText, unless they would then read the same.
std::array<std::string, 2> shortNumberTexts(const std::string& a, const std::string& b);
std::string millisecondsText(double milliseconds);                // "0.42 ms", "12.0 ms", "2.57 s"
std::string pixelsText(double pixels, const char* unit = " px");  // "0.04 px", "1.3 px", "29 px"

}  // namespace worldy
