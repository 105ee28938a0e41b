#include "app/bench/bench_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/base/output_file.h"
#include "app/base/report.h"

namespace worldy {

namespace {

using planet::Result;

// Returns a member that is a text, or nothing.
std::optional<std::string> textIn(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) return std::nullopt;
    return found->get<std::string>();
}

// Returns a spread of positive, finite numbers in order, or nothing.
std::optional<Spread> spreadIn(const nlohmann::json& object) {
    const auto number = [&](const char* key) {
        const auto found = object.find(key);
        return found != object.end() && found->is_number() ? found->get<double>() : std::nan("");
    };
    const Spread spread{number("median"), number("minimum"), number("maximum")};
    // The comparison is written so that NaN fails too.
    const bool isOrdered = spread.minimum > 0 && spread.minimum <= spread.median &&
                           spread.median <= spread.maximum && std::isfinite(spread.maximum);
    return isOrdered ? std::optional(spread) : std::nullopt;
}

std::optional<BenchRow> rowIn(const nlohmann::json& object) {
    if (!object.is_object()) return std::nullopt;
    const auto subject = textIn(object, "subject"), quantity = textIn(object, "quantity"),
               unit = textIn(object, "unit");
    const std::optional<Spread> value = spreadIn(object);
    if (!subject || !quantity || !unit || !value) return std::nullopt;
    BenchRow row{*subject, *quantity, *unit, *value};
    const auto times = object.find("times");
    if (times == object.end()) return row;
    if (!times->is_object()) return std::nullopt;
    const std::optional<Spread> ratio = spreadIn(*times);
    const auto yardstick = textIn(*times, "of");
    if (!ratio || !yardstick) return std::nullopt;
    row.ratio = *ratio;
    row.yardstick = *yardstick;
    return row;
}

bool isSameRow(const ReportedRow& a, const ReportedRow& b) {
    return a.part == b.part && a.row.subject == b.row.subject && a.row.quantity == b.row.quantity &&
           a.row.unit == b.row.unit && a.row.yardstick == b.row.yardstick;
}

// Returns whether more of a unit is better: more of a rate is, more of a time or of a size is not.
bool moreIsBetter(const std::string& unit) {
    return unit.ends_with("/s");
}

BenchVerdict verdictOf(const BenchChange& change) {
    if (change.b.minimum <= change.a.maximum && change.b.maximum >= change.a.minimum)
        return BenchVerdict::WithinNoise;
    if (change.of.row.unit.empty()) return BenchVerdict::Differs;
    return (change.factor > 1) == moreIsBetter(change.of.row.unit) ? BenchVerdict::Better
                                                                   : BenchVerdict::Worse;
}

}  // namespace

Result<std::vector<ReportedRow>> readBenchReport(const std::filesystem::path& file) {
    constexpr std::size_t mostBytes = std::size_t{16} << 20;
    std::error_code status;
    if (!std::filesystem::is_regular_file(file, status)) {
        return planet::ioError(
            fmt::format("{}: is no file; expected the JSON that worldy bench -o writes", file.string()));
    }
    const std::string text = startOfFile(file, mostBytes);
    const nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
    if (!report.is_object() || !report.contains("parts") || !report["parts"].is_object()) {
        return planet::badInput(
            fmt::format("{}: is not a report of a benchmark; expected the JSON that worldy bench -o writes",
                        file.string()));
    }
    if (report.value("schema_version", nlohmann::json()) != schemaVersion) {
        return planet::badInput(fmt::format(
            "{}: its schema_version is {}; expected {}, which this version of Worldy writes", file.string(),
            report.value("schema_version", nlohmann::json()).dump(), schemaVersion));
    }
    std::vector<ReportedRow> rows;
    for (const auto& [part, entries] : report["parts"].items()) {
        for (const nlohmann::json& entry : entries) {
            std::optional<BenchRow> row = rowIn(entry);
            if (!row) {
                return planet::badInput(fmt::format(
                    "{}: a row of {} is incomplete; expected a subject, a quantity, a unit, and a median "
                    "between a minimum above 0 and a maximum",
                    file.string(), part));
            }
            rows.push_back({part, *std::move(row)});
        }
    }
    return rows;
}

BenchComparison compareBenchReports(const std::vector<ReportedRow>& a, const std::vector<ReportedRow>& b) {
    BenchComparison comparison;
    for (const ReportedRow& of : a) {
        const auto found =
            std::ranges::find_if(b, [&](const ReportedRow& row) { return isSameRow(of, row); });
        if (found == b.end()) {
            comparison.onlyA.push_back(of);
            continue;
        }
        BenchChange change;
        change.of = of;
        change.isRatio = !of.row.yardstick.empty();
        change.a = change.isRatio ? of.row.ratio : of.row.value;
        change.b = change.isRatio ? found->row.ratio : found->row.value;
        change.factor = change.b.median / change.a.median;
        change.verdict = verdictOf(change);
        comparison.changes.push_back(std::move(change));
    }
    for (const ReportedRow& of : b) {
        const bool isInA = std::ranges::any_of(a, [&](const ReportedRow& row) { return isSameRow(row, of); });
        if (!isInA) comparison.onlyB.push_back(of);
    }
    return comparison;
}

}  // namespace worldy
