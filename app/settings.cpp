#include "app/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <sstream>
#include <variant>
#include <vector>

#include "app/output_file.h"
#include "app/toml_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

struct Number {
    double* value;
    NumberRange range;
};
struct Integer {
    int* value;
    NumberRange range;
};
// An enumerator, by its name's place in a list.
struct Choice {
    std::uint8_t* value;
    std::span<const std::string_view> names;
};

// One setting: where it stands in the file, what it means, and which field holds it.
struct Field {
    std::string_view table;
    std::string_view key;
    std::string_view meaning;
    std::variant<Number, Integer, bool*, std::string*, Choice> value;

    std::string name() const { return fmt::format("{}.{}", table, key); }
};

// The enumerations are bytes, so one kind of field serves them all.
template <class Enum>
std::uint8_t* asByte(Enum& value) {
    static_assert(sizeof(Enum) == 1);
    return reinterpret_cast<std::uint8_t*>(&value);
}

// Grouped by table, in the order of the file.
std::vector<Field> fieldsOf(Settings& s) {
    ui::ViewSettings& v = s.view;
    return {
        {"data", "set", "Chunk file, elevation image or cube faces to open; empty: the Earth.", &s.dataSet},
        {"data", "colour_image", "Picture laid over it; empty: colour.jpg or colour.png beside the data set.",
         &s.colourImage},
        {"lod", "tau_px", "Tolerance on screen, pixels; larger: fewer triangles, more visible error.",
         Number{&v.tauPx, {0.1, 64, "pixels"}}},
        {"lod", "skirt_factor", "Skirt depth in units of the errors it has to hide.",
         Number{&v.skirtFactor, {0, 10, ""}}},
        {"lod", "frustum_culling", "Leave out what lies beside and behind the view.", &v.frustumCulling},
        {"lod", "horizon_culling", "Leave out what the planet itself hides.", &v.horizonCulling},
        {"paging", "budget_mb", "Memory for resident chunks, CPU and GPU together, MiB.",
         Integer{&v.budgetMB, {16, 65536, "MiB"}}},
        {"paging", "loader_threads", "Threads that read chunks.",
         Integer{&v.loaderThreads, {1, 64, "threads"}}},
        {"paging", "upload_limit_ms", "Time a frame spent on chunks that have been loaded, milliseconds.",
         Number{&v.uploadLimitMs, {0.1, 100, "milliseconds"}}},
        {"view", "fov_deg", "Horizontal field of view, degrees.", Number{&v.fovDeg, {5, 150, "degrees"}}},
        {"view", "skirts", "Draw the curtains that hide cracks between chunks.", &v.skirts},
        {"view", "colour_by", "What the colour of a chunk shows: none, level or error.",
         Choice{asByte(v.colourBy), colourByNames}},
        {"view", "surface", "Colour of the ground: image, or ramp by height.",
         Choice{asByte(v.surface), surfaceNames}},
        {"view", "atmosphere", "Draw the atmosphere.", &v.atmosphere},
        {"view", "detail", "Roughen the ground between the samples: invented, only for the eye.", &v.detail},
        {"view", "lighting", "Light the ground by the sun; false: flat colour.", &v.lighting},
        {"view", "sun_follows", "Keep the sun to the camera's east, so that it is always day there.",
         &v.sunFollows},
        {"view", "sun_latitude_deg", "Else: where the sun stands in the zenith, degrees north.",
         Number{&v.sunLatitudeDeg, {-90, 90, "degrees"}}},
        {"view", "sun_longitude_deg", "Where the sun stands in the zenith, degrees east.",
         Number{&v.sunLongitudeDeg, {-180, 180, "degrees"}}},
        {"camera", "latitude_deg", "Where a session starts, degrees north.",
         Number{&s.camera.latitudeDeg, {-90, 90, "degrees"}}},
        {"camera", "longitude_deg", "Degrees east.", Number{&s.camera.longitudeDeg, {-180, 180, "degrees"}}},
        {"camera", "altitude_m", "Metres above the planet's radius; 0: the whole planet in view.",
         Number{&s.camera.altitudeM, {0, 2e10, "metres"}}},
        {"camera", "heading_deg", "0 north, 90 east.", Number{&s.camera.headingDeg, {-360, 360, "degrees"}}},
        {"camera", "pitch_deg", "-90 straight down, 0 level.",
         Number{&s.camera.pitchDeg, {-90, 90, "degrees"}}},
        {"window", "width_px", "Size of the window, pixels.",
         Integer{&s.windowWidthPx, {640, 16384, "pixels"}}},
        {"window", "height_px", "", Integer{&s.windowHeightPx, {400, 16384, "pixels"}}},
        {"window", "lod_panel_width", "Sizes of the panels, in units that follow the font.",
         Number{&s.panels.lodWidth, {160, 1000, ""}}},
        {"window", "log_panel_height", "", Number{&s.panels.logHeight, {60, 1000, ""}}},
    };
}

std::string joined(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    return text;
}

struct ReadField {
    const fs::path& file;
    const Field& field;
    const toml::node& node;

    Result<void> operator()(const Number& number) const {
        return readNumber(file, field.name(), node, number.range).map([&](double v) { *number.value = v; });
    }
    Result<void> operator()(const Integer& integer) const {
        return readInteger(file, field.name(), node, integer.range).map([&](std::int64_t v) {
            *integer.value = static_cast<int>(v);
        });
    }
    Result<void> operator()(bool* flag) const {
        return readBool(file, field.name(), node).map([&](bool v) { *flag = v; });
    }
    Result<void> operator()(std::string* text) const {
        return readText(file, field.name(), node).map([&](const std::string& v) { *text = v; });
    }
    Result<void> operator()(const Choice& choice) const {
        const std::string text = node.value_or(std::string());
        const auto found = std::find(choice.names.begin(), choice.names.end(), text);
        if (found == choice.names.end()) {
            return planet::badInput(fmt::format("{}: {} is not one of its words; one of {} would be right",
                                                placeOf(file, node), field.name(), joined(choice.names)));
        }
        *choice.value = static_cast<std::uint8_t>(found - choice.names.begin());
        return {};
    }
};

// Levenshtein's distance: how many letters differ.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t above = row[j + 1];
            row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row.back();
}

tl::unexpected<planet::Error> unknownKey(const std::string& place, const std::string& name,
                                         const std::vector<Field>& fields) {
    const auto nearest = std::min_element(fields.begin(), fields.end(), [&](const Field& a, const Field& b) {
        return editDistance(a.name(), name) < editDistance(b.name(), name);
    });
    return planet::badInput(
        fmt::format("{}: {} is not a setting; the nearest one is {}", place, name, nearest->name()));
}

Result<void> readTable(const fs::path& file, std::string_view tableName, const toml::table& table,
                       const std::vector<Field>& fields) {
    for (const auto& [key, node] : table) {
        const std::string_view name = key.str();
        const auto field = std::find_if(fields.begin(), fields.end(), [&](const Field& f) {
            return f.table == tableName && f.key == name;
        });
        if (field == fields.end()) {
            return unknownKey(placeOf(file, node), fmt::format("{}.{}", tableName, name), fields);
        }
        if (Result<void> read = std::visit(ReadField{file, *field, node}, field->value); !read) return read;
    }
    return {};
}

struct FieldText {
    // The shortest digits that read back as the same number.
    std::string operator()(const Number& number) const { return fmt::format("{}", *number.value); }
    std::string operator()(const Integer& integer) const { return fmt::format("{}", *integer.value); }
    std::string operator()(const bool* flag) const { return *flag ? "true" : "false"; }
    std::string operator()(const std::string* text) const {
        std::ostringstream stream;
        stream << toml::value<std::string>(*text);
        return stream.str();
    }
    std::string operator()(const Choice& choice) const {
        return fmt::format("\"{}\"", choice.names[*choice.value]);
    }
};

}  // namespace

Result<Settings> loadSettings(const fs::path& file) {
    const Result<toml::table> document = parseTomlFile(file);
    if (!document) return tl::unexpected(document.error());
    Settings settings;
    const std::vector<Field> fields = fieldsOf(settings);
    for (const auto& [key, node] : *document) {
        const std::string_view name = key.str();
        const bool known =
            std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.table == name; });
        const toml::table* table = node.as_table();
        if (!known || !table) return unknownKey(placeOf(file, node), std::string(name), fields);
        if (Result<void> read = readTable(file, name, *table, fields); !read) {
            return tl::unexpected(read.error());
        }
    }
    return settings;
}

std::string settingsText(const Settings& settings) {
    Settings copy = settings;
    std::string text = "# Worldy's settings, written when it ends. Delete a line to get its default back.\n";
    std::string_view table;
    for (const Field& field : fieldsOf(copy)) {
        if (field.table != table) text += fmt::format("\n[{}]\n", field.table);
        table = field.table;
        if (!field.meaning.empty()) text += fmt::format("# {}\n", field.meaning);
        text += fmt::format("{} = {}\n", field.key, std::visit(FieldText{}, field.value));
    }
    return text;
}

Result<void> saveSettings(const Settings& settings, const fs::path& file) {
    std::error_code status;
    fs::create_directories(fs::absolute(file).parent_path(), status);
    return writeTextFile(file, settingsText(settings));
}

}  // namespace worldy
