// The options that several commands share. Each has the same meaning in every command. A table lists the
// options of each command, and the parser's options are created from it.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/flight/flight_path.h"
#include "app/settings/settings_schema.h"
#include "app/settings/view_options.h"
#include "planet/source/height_source.h"

namespace worldy {

// Sets of shared options, as bits.
namespace takes {
inline constexpr unsigned json = 1u << 0;        // --json
inline constexpr unsigned output = 1u << 1;      // -o, --output, and --overwrite
inline constexpr unsigned mustOutput = 1u << 2;  // the same, required
inline constexpr unsigned flight = 1u << 3;      // --flight, --frames, --step-s
inline constexpr unsigned mustFlight = 1u << 4;  // the same, --flight required
inline constexpr unsigned camera = 1u << 5;      // --camera
inline constexpr unsigned cameras = 1u << 6;     // --camera, which may be repeated
inline constexpr unsigned size = 1u << 7;        // --size
inline constexpr unsigned tau = 1u << 8;         // --tau, one tolerance
inline constexpr unsigned taus = 1u << 9;        // --tau, a list
inline constexpr unsigned set = 1u << 10;        // --set
inline constexpr unsigned view = 1u << 11;       // --settings, --layers, --budget, --no-culling, --fov
inline constexpr unsigned worst = 1u << 12;      // --worst
inline constexpr unsigned ownBudget =
    1u << 14;  // no --budget for the paging, because the command has another one
inline constexpr unsigned source = 1u << 13;  // --metres-per-unit and other options for reading a source
}  // namespace takes

struct CommandSpec {
    const char* name;
    const char* about;
    unsigned takes;
    const char* output = "";       // describes the argument of -o
    FlightSampling sampling{};     // default if neither --frames nor --step-s is given
    const char* defaultTaus = "";  // of the list
    const char* worst = "";        // the items that --worst counts
};

std::span<const CommandSpec> commandSpecs();
const CommandSpec& commandSpec(std::string_view name);

// The shared options of one command, unparsed.
struct SharedTexts {
    bool json = false;
    std::filesystem::path output;
    bool overwrite = false;  // outputs may replace files of other kinds
    std::filesystem::path flight;
    FlightSampling sampling;
    std::vector<double> tausPx;  // for takes::taus
    std::vector<std::string> cameras;
    int worst = 20;
    ViewTexts view;
    planet::HeightSourceSettings source;
};

// Adds the command with the shared options that the table gives it. The texts must outlive the app.
CLI::App& addCommand(CLI::App& app, const CommandSpec& spec, SharedTexts& texts);

// Returns an Error for an obsolete spelling, which names the current one, and for a list with an empty entry.
// The first argument is the program's name.
planet::Result<void> checkSpellings(std::span<const char* const> arguments);

// Add an option or a flag that sets a setting. The help, the range and the errors of an option are those of
// the schema. A flag sets the assignments.
CLI::Option& addSettingOption(CLI::App& command, const char* option, const Field& field, ViewTexts& view);
CLI::Option& addSettingFlag(CLI::App& command, const char* flag, std::vector<std::string> assignments,
                            const char* help, ViewTexts& view);
// Returns a validator that accepts the values of a setting.
CLI::Validator valueOf(const Field& field);

// Accepts numbers in a closed range; CLI11's own validator accepts "nan".
CLI::Validator number(double min, double max, bool zeroToo = true);
CLI::Validator wholeNumber(std::uint32_t min, std::uint32_t max);
// Accepts 2^n + 1.
CLI::Validator faceSize();

}  // namespace worldy
