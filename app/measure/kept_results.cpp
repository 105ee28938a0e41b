#include "app/measure/kept_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "app/base/places.h"
#include "app/base/toml_file.h"
#include "planet/base/try.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::size_t mostPoints = 4096;
constexpr std::size_t mostFiles = 64;
constexpr NumberRange anyCount = {0, 9e15, ""};
constexpr NumberRange anyFigure = {0, 1e300, ""};

constexpr std::array<std::string_view, 2> metricNames = {"additive", "tight"};
constexpr std::array<std::string_view, 3> costNames = {"triangles", "frame_ms", "memory_mib"};

struct FigureKey {
    std::string_view key;
    double FlightFigures::*value;
};
constexpr std::array<FigureKey, 12> figureKeys = {{
    {"ground_triangles", &FlightFigures::meanGroundTriangles},
    {"skirt_triangles", &FlightFigures::meanSkirtTriangles},
    {"triangles", &FlightFigures::meanTriangles},
    {"most_triangles", &FlightFigures::mostTriangles},
    {"chunks", &FlightFigures::meanChunks},
    {"memory_mib", &FlightFigures::mostResidentMiB},
    {"frame_ms", &FlightFigures::medianFrameMs},
    {"eps_px", &FlightFigures::worstEpsPx},
    {"drawn_bound_px", &FlightFigures::worstDrawnBoundPx},
    {"error_px", &FlightFigures::worstMeasuredPx},
    {"p99_error_px", &FlightFigures::p99MeasuredPx},
    {"screen_error_px", &FlightFigures::worstScreenPx},
}};

// A table of the file, from which each key is taken once; what is left over is unknown.
class ResultsReader {
public:
    ResultsReader(const fs::path& file, const toml::table& table) : file_(file), table_(table) {}

    Result<double> number(std::string_view key, const NumberRange& range) {
        TRY_ASSIGN(const toml::node* const node, take(key));
        return readNumber(file_, key, *node, range);
    }
    Result<std::int64_t> integer(std::string_view key, const NumberRange& range) {
        TRY_ASSIGN(const toml::node* const node, take(key));
        return readInteger(file_, key, *node, range);
    }
    Result<bool> flag(std::string_view key) {
        TRY_ASSIGN(const toml::node* const node, take(key));
        return readBool(file_, key, *node);
    }
    Result<std::string> text(std::string_view key) {
        TRY_ASSIGN(const toml::node* const node, take(key));
        return readText(file_, key, *node);
    }
    // Reads one of some names and returns its index.
    Result<std::size_t> choice(std::string_view key, std::span<const std::string_view> names) {
        TRY_ASSIGN(const toml::node* const node, take(key));
        TRY_ASSIGN(const std::string name, readText(file_, key, *node));
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            return wrong(file_, *node, fmt::format("{}: {}; expected {}", key, name, fmt::join(names, ", ")));
        return static_cast<std::size_t>(found - names.begin());
    }
    Result<const toml::table*> table(std::string_view key) {
        TRY_ASSIGN(const toml::node* const node, take(key));
        if (const toml::table* const found = node->as_table()) return found;
        return wrong(file_, *node, fmt::format("{}: expected a table", key));
    }
    // Returns the tables of a list, [1, most] of them.
    Result<std::vector<const toml::table*>> tables(std::string_view key, std::size_t most) {
        TRY_ASSIGN(const toml::node* const node, take(key));
        const toml::array* const list = node->as_array();
        if (!list || list->empty() || list->size() > most)
            return wrong(file_, *node, fmt::format("{}: expected 1 to {} tables", key, most));
        std::vector<const toml::table*> found;
        for (const toml::node& one : *list) {
            if (!one.is_table()) return wrong(file_, one, fmt::format("{}: expected a table", key));
            found.push_back(one.as_table());
        }
        return found;
    }
    bool has(std::string_view key) const { return table_.contains(key); }
    Result<void> end() const {
        for (const auto& [key, node] : table_)
            if (!taken_.contains(std::string(key.str())))
                return wrong(file_, node, fmt::format("{} is unknown", key.str()));
        return {};
    }

private:
    Result<const toml::node*> take(std::string_view key) {
        taken_.insert(std::string(key));
        if (const toml::node* const node = table_.get(key)) return node;
        return planet::badInput(fmt::format("{}: {} is missing", placeOf(file_, table_), key));
    }

    const fs::path& file_;
    const toml::table& table_;
    std::set<std::string> taken_;
};

Result<MeasuredFile> readFile(const fs::path& file, const toml::table& table, std::vector<int>* chunkSizes) {
    ResultsReader reader(file, table);
    MeasuredFile one;
    TRY_ASSIGN(one.file, reader.text("file"));
    TRY_ASSIGN(const std::int64_t bytes, reader.integer("bytes", anyCount));
    TRY_ASSIGN(one.modified, reader.integer("modified", {-9.2e18, 9.2e18, ""}));
    one.bytes = static_cast<std::uint64_t>(bytes);
    if (chunkSizes) {
        TRY_ASSIGN(const std::int64_t size, reader.integer("chunk_size", {17, 129, ""}));
        chunkSizes->push_back(static_cast<int>(size));
    }
    TRY(reader.end());
    return one;
}

Result<std::vector<MeasuredFile>> readFiles(const fs::path& file, ResultsReader& reader,
                                            std::vector<int>* chunkSizes = nullptr) {
    TRY_ASSIGN(const auto tables, reader.tables("file", mostFiles));
    std::vector<MeasuredFile> files;
    for (const toml::table* const table : tables) {
        TRY_ASSIGN(MeasuredFile one, readFile(file, *table, chunkSizes));
        files.push_back(std::move(one));
    }
    return files;
}

Result<planet::ErrorMetric> readMetric(ResultsReader& reader) {
    TRY_ASSIGN(const std::size_t index, reader.choice("metric", metricNames));
    return index == 0 ? planet::ErrorMetric::Additive : planet::ErrorMetric::Tight;
}

Result<SweepPoint> readPoint(const fs::path& file, const toml::table& table) {
    ResultsReader reader(file, table);
    SweepPoint point;
    TRY_ASSIGN(const std::int64_t size, reader.integer("chunk_size", {17, 129, ""}));
    point.chunkSize = static_cast<int>(size);
    TRY_ASSIGN(point.metric, readMetric(reader));
    TRY_ASSIGN(point.tauPx, reader.number("tau_px", {1e-3, 1e4, "px"}));
    for (const FigureKey& figure : figureKeys) {
        TRY_ASSIGN(point.figures.*figure.value, reader.number(figure.key, anyFigure));
    }
    TRY_ASSIGN(const std::int64_t frames, reader.integer("frames", {0, 1e6, ""}));
    TRY_ASSIGN(const std::int64_t violations, reader.integer("violations", anyCount));
    TRY_ASSIGN(const std::int64_t bytesRead, reader.integer("bytes_read", anyCount));
    point.figures.frames = static_cast<int>(frames);
    point.figures.violations = static_cast<std::uint64_t>(violations);
    point.figures.bytesRead = static_cast<std::uint64_t>(bytesRead);
    TRY(reader.end());
    return point;
}

Result<KeptSweep> readSweep(const fs::path& file, const toml::table& table) {
    ResultsReader reader(file, table);
    KeptSweep sweep;
    TRY_ASSIGN(sweep.table.flight, reader.text("flight"));
    TRY_ASSIGN(sweep.table.request.flight, reader.text("flight_file"));
    TRY_ASSIGN(sweep.table.source, reader.text("source"));
    TRY_ASSIGN(sweep.table.whole, reader.flag("whole"));
    TRY_ASSIGN(const std::int64_t frames, reader.integer("frames", {1, 1e6, ""}));
    TRY_ASSIGN(const std::int64_t width, reader.integer("width_px", {1, 65536, "px"}));
    TRY_ASSIGN(const std::int64_t height, reader.integer("height_px", {1, 65536, "px"}));
    sweep.table.request.frames = static_cast<int>(frames);
    sweep.table.request.widthPx = static_cast<int>(width);
    sweep.table.request.heightPx = static_cast<int>(height);
    TRY_ASSIGN(sweep.files, readFiles(file, reader, &sweep.chunkSizes));
    TRY_ASSIGN(const auto points, reader.tables("point", mostPoints));
    for (const toml::table* const one : points) {
        TRY_ASSIGN(SweepPoint point, readPoint(file, *one));
        sweep.table.points.push_back(point);
    }
    TRY(reader.end());
    return sweep;
}

Result<SweepSuggestion> readSuggestion(const fs::path& file, const toml::table& table) {
    ResultsReader reader(file, table);
    SweepSuggestion one;
    TRY_ASSIGN(const std::int64_t size, reader.integer("chunk_size", {17, 129, ""}));
    one.chunkSize = static_cast<int>(size);
    TRY_ASSIGN(one.metric, readMetric(reader));
    TRY_ASSIGN(one.goal.limitsError, reader.flag("limits_error"));
    TRY_ASSIGN(const std::size_t cost, reader.choice("cost", costNames));
    one.goal.cost = static_cast<SweepCost>(cost);
    TRY_ASSIGN(one.goal.limit, reader.number("limit", {1e-12, 1e300, ""}));
    TRY_ASSIGN(one.found.tauPx, reader.number("tau_px", {0, 1e4, "px"}));
    TRY_ASSIGN(one.found.value, reader.number("value", anyFigure));
    TRY_ASSIGN(one.found.met, reader.flag("met"));
    TRY_ASSIGN(const std::int64_t flown, reader.integer("flown", {0, 1e6, ""}));
    one.found.flown = static_cast<int>(flown);
    TRY(reader.end());
    return one;
}

Result<KeptSuggestions> readSuggestions(const fs::path& file, const toml::table& table) {
    ResultsReader reader(file, table);
    KeptSuggestions suggestions;
    TRY_ASSIGN(suggestions.files, readFiles(file, reader));
    TRY_ASSIGN(const auto found, reader.tables("found", mostFiles));
    for (const toml::table* const one : found) {
        TRY_ASSIGN(SweepSuggestion suggestion, readSuggestion(file, *one));
        suggestions.found.push_back(suggestion);
    }
    TRY(reader.end());
    return suggestions;
}

Result<ComparedFigures> readSide(const fs::path& file, const toml::table& table) {
    ResultsReader reader(file, table);
    ComparedFigures figures;
    for (const CompareRow& row : compareRows()) {
        if (!reader.has(row.key)) continue;  // unknown
        TRY_ASSIGN(figures.*row.value, reader.number(row.key, anyFigure));
    }
    TRY(reader.end());
    return figures;
}

Result<KeptFlight> readFlight(const fs::path& file, const toml::table& table) {
    ResultsReader reader(file, table);
    KeptFlight flight;
    TRY_ASSIGN(flight.name, reader.text("name"));
    TRY_ASSIGN(flight.files, readFiles(file, reader));
    TRY_ASSIGN(const toml::table* const a, reader.table("a"));
    TRY_ASSIGN(const toml::table* const b, reader.table("b"));
    TRY_ASSIGN(flight.figures[0], readSide(file, *a));
    TRY_ASSIGN(flight.figures[1], readSide(file, *b));
    TRY(reader.end());
    return flight;
}

// Returns the shortest text that reads back as the same number. value: finite.
std::string shortest(double value) {
    return fmt::format("{}", value);
}

bool isFinite(const SweepPoint& point) {
    return std::ranges::all_of(
        figureKeys, [&](const FigureKey& figure) { return std::isfinite(point.figures.*figure.value); });
}

std::string filesText(std::string_view table, std::span<const MeasuredFile> files,
                      std::span<const int> chunkSizes = {}) {
    std::string text;
    for (std::size_t i = 0; i < files.size(); ++i) {
        text += fmt::format("\n[[{}.file]]\nfile = {}\nbytes = {}\nmodified = {}\n", table,
                            tomlText(files[i].file.string()), files[i].bytes, files[i].modified);
        if (!chunkSizes.empty()) text += fmt::format("chunk_size = {}\n", chunkSizes[i]);
    }
    return text;
}

std::string_view metricKey(planet::ErrorMetric metric) {
    return metricNames[metric == planet::ErrorMetric::Additive ? 0 : 1];
}

std::string sweepText(const KeptSweep& sweep) {
    const SweepTable& table = sweep.table;
    std::string text = fmt::format(
        "\n[sweep]\nflight = {}\nflight_file = {}\nsource = {}\nwhole = {}\nframes = {}\nwidth_px = {}\n"
        "height_px = {}\n",
        tomlText(table.flight), tomlText(table.request.flight.string()), tomlText(table.source.string()),
        table.whole, table.request.frames, table.request.widthPx, table.request.heightPx);
    text += filesText("sweep", sweep.files, sweep.chunkSizes);
    for (const SweepPoint& point : table.points) {
        if (!isFinite(point)) continue;
        text += fmt::format("\n[[sweep.point]]\nchunk_size = {}\nmetric = \"{}\"\ntau_px = {}\n",
                            point.chunkSize, metricKey(point.metric), shortest(point.tauPx));
        for (const FigureKey& figure : figureKeys)
            text += fmt::format("{} = {}\n", figure.key, shortest(point.figures.*figure.value));
        text += fmt::format("frames = {}\nviolations = {}\nbytes_read = {}\n", point.figures.frames,
                            point.figures.violations, point.figures.bytesRead);
    }
    return text;
}

std::string suggestionsText(const KeptSuggestions& suggestions) {
    std::string text = "\n[suggestions]\n" + filesText("suggestions", suggestions.files);
    for (const SweepSuggestion& one : suggestions.found) {
        text += fmt::format(
            "\n[[suggestions.found]]\nchunk_size = {}\nmetric = \"{}\"\nlimits_error = {}\ncost = \"{}\"\n"
            "limit = {}\ntau_px = {}\nvalue = {}\nmet = {}\nflown = {}\n",
            one.chunkSize, metricKey(one.metric), one.goal.limitsError,
            costNames[static_cast<std::size_t>(one.goal.cost)], shortest(one.goal.limit),
            shortest(one.found.tauPx), shortest(one.found.value), one.found.met, one.found.flown);
    }
    return text;
}

std::string flightText(const KeptFlight& flight) {
    std::string text = fmt::format("\n[comparison]\nname = {}\n", tomlText(flight.name)) +
                       filesText("comparison", flight.files);
    for (std::size_t side = 0; side < flight.figures.size(); ++side) {
        text += fmt::format("\n[comparison.{}]\n", side == 0 ? "a" : "b");
        for (const CompareRow& row : compareRows())
            if (const std::optional<double>& value = flight.figures[side].*row.value;
                value && std::isfinite(*value))
                text += fmt::format("{} = {}\n", row.key, shortest(*value));
    }
    return text;
}

}  // namespace

fs::path keptResultsFile() {
    return configFolder() / "results.toml";
}

MeasuredFile measuredFileOf(const fs::path& file) {
    std::error_code status;
    MeasuredFile one{fs::absolute(file, status)};
    const std::uintmax_t bytes = fs::file_size(file, status);
    if (status) return one;
    const fs::file_time_type modified = fs::last_write_time(file, status);
    if (status) return one;
    one.bytes = bytes;
    one.modified = modified.time_since_epoch().count();
    return one;
}

Result<KeptResults> loadKeptResults(const fs::path& file) {
    KeptResults results;
    std::error_code status;
    if (!fs::exists(file, status)) return results;
    TRY_ASSIGN(const toml::table document, parseTomlFile(file));
    ResultsReader reader(file, document);
    TRY(reader.integer("format", {1, 1, ""}));
    if (reader.has("sweep")) {
        TRY_ASSIGN(const toml::table* const sweep, reader.table("sweep"));
        TRY_ASSIGN(results.sweep, readSweep(file, *sweep));
    }
    if (reader.has("suggestions")) {
        TRY_ASSIGN(const toml::table* const suggestions, reader.table("suggestions"));
        TRY_ASSIGN(results.suggestions, readSuggestions(file, *suggestions));
    }
    if (reader.has("comparison")) {
        TRY_ASSIGN(const toml::table* const flight, reader.table("comparison"));
        TRY_ASSIGN(results.flight, readFlight(file, *flight));
    }
    TRY(reader.end());
    return results;
}

std::string keptResultsText(const KeptResults& results) {
    std::string text = "# The results of the last session, for the next start.\nformat = 1\n";
    if (results.sweep && std::ranges::any_of(results.sweep->table.points, isFinite))
        text += sweepText(*results.sweep);
    if (results.suggestions) text += suggestionsText(*results.suggestions);
    if (results.flight) text += flightText(*results.flight);
    return text;
}

std::string changedSince(std::span<const MeasuredFile> files) {
    for (const MeasuredFile& one : files) {
        const MeasuredFile now = measuredFileOf(one.file);
        if (now == one) continue;
        return fmt::format("{} {}", one.file.string(), now.bytes == 0 ? "is gone" : "has changed");
    }
    return {};
}

}  // namespace worldy
