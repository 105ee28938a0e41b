// Tables and samples of plots as text for other programs. Pure functions, any thread.
//
// A row has the exact values, not the rounded texts of the screen; a column's name carries the unit: "gap_m". The names
// are those of the reports of the command line where these have the quantity.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace worldy::ui {

// The exact value of a cell as text.
struct ExportCell {
    std::string text{};
    bool isNumber = false;

    ExportCell() = default;  // unknown or not applicable: an empty cell
    ExportCell(std::string value) : text(std::move(value)) {}
    ExportCell(std::string_view value) : text(value) {}
    ExportCell(const char* value) : text(value) {}
    ExportCell(bool value) : text(value ? "true" : "false") {}
    // The shortest text that reads back as the same number; empty for a value that is not known (NaN).
    template <std::floating_point Number>
    ExportCell(Number value)
        : text(std::isnan(value) ? std::string() : fmt::format("{}", value)),
          isNumber(std::isfinite(value)) {}
    template <std::integral Number>
    requires(!std::same_as<Number, bool> && !std::same_as<Number, char>) ExportCell(Number value)
        : text(fmt::format("{}", value)), isNumber(true) {}
    template <class Value>
    ExportCell(const std::optional<Value>& value) {
        if (value) *this = ExportCell(*value);
    }
};

struct ExportColumn {
    std::string name;    // with the unit: "gap_m"
    bool isKey = false;  // tells rows apart while the table changes; if no column does, the row's number does
};

// A table whose rows are asked for one at a time, because most frames need none of them.
struct ExportTable {
    std::string name;  // "paging queue"; part of the names of files
    std::vector<ExportColumn> columns{};
    std::size_t rows = 0;
    std::function<ExportCell(std::size_t row, std::size_t column)> cell{};
    // Called before more than the visible rows are read; sorts rows that are sorted only where they are seen.
    std::function<void()> sortAll{};
};

// A column, and its value of a row.
template <class Row>
struct ExportField {
    const char* name;
    std::function<ExportCell(const Row&)> value;
    bool isKey = false;
};

// Returns a table of rows of one kind. at(number) returns a row or a reference to it; it must stay valid as long as the
// table is used.
template <class Row, class At>
ExportTable exportTable(std::string name, std::size_t rows, At at, std::vector<ExportField<Row>> fields) {
    ExportTable table{.name = std::move(name), .rows = rows};
    for (const ExportField<Row>& field : fields) table.columns.push_back({field.name, field.isKey});
    table.cell = [at = std::move(at), fields = std::move(fields)](std::size_t row, std::size_t column) {
        return fields[column].value(at(row));
    };
    return table;
}

// Returns the rows as RFC 4180: a header, commas, lines that end with CR LF, and quotes around texts with a comma, a
// quote or a line break. The first column is schema_version, as in all CSV tables of Worldy. A text that a spreadsheet
// would take for a formula, because it starts with = + - @, a tab or a carriage return and is no number, gets an
// apostrophe in front.
std::string csvOf(const ExportTable& table, std::span<const std::size_t> rows);
// Returns the same as tab-separated text with lines that end with LF. Tabs and line breaks in texts become spaces.
// versioned: with the column schema_version, for files; text for the clipboard has none.
std::string tsvOf(const ExportTable& table, std::span<const std::size_t> rows, bool versioned);

// Returns a number that tells a row from others, from the texts of its key columns.
std::size_t rowKey(const ExportTable& table, std::size_t row);

// Returns a name that is safe in a file's name: letters, digits, "-", "_" and spaces; others become "_".
std::string fileNamePart(std::string_view name);

}  // namespace worldy::ui
