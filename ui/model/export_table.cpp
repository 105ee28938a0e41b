#include "ui/model/export_table.h"

#include <algorithm>
#include <cctype>

#include "app/base/report.h"
#include "app/base/text.h"

namespace worldy::ui {

namespace {

// Returns true for text that a spreadsheet would execute.
bool looksLikeFormula(const ExportCell& cell) {
    if (cell.isNumber || cell.text.empty()) return false;
    constexpr std::string_view starts = "=+-@\t\r";
    return starts.find(cell.text.front()) != std::string_view::npos && !numberFromText(cell.text);
}

std::string harmless(const ExportCell& cell) {
    return looksLikeFormula(cell) ? "'" + cell.text : cell.text;
}

std::string csvField(const ExportCell& cell) {
    const std::string text = harmless(cell);
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return quoted + "\"";
}

std::string tsvField(const ExportCell& cell) {
    std::string text = harmless(cell);
    std::replace_if(
        text.begin(), text.end(),
        [](char letter) { return letter == '\t' || letter == '\r' || letter == '\n'; }, ' ');
    return text;
}

struct TextFormat {
    std::string (*field)(const ExportCell&);
    const char* separator;
    const char* lineEnd;
    bool versioned;
};

std::string textOf(const ExportTable& table, std::span<const std::size_t> rows, const TextFormat& format) {
    std::string text = format.versioned ? "schema_version" : "";
    for (const ExportColumn& column : table.columns) {
        if (!text.empty()) text += format.separator;
        text += format.field(column.name);
    }
    text += format.lineEnd;
    for (const std::size_t row : rows) {
        if (format.versioned) text += fmt::format("{}", schemaVersion);
        for (std::size_t column = 0; column < table.columns.size(); ++column) {
            if (format.versioned || column > 0) text += format.separator;
            text += format.field(table.cell(row, column));
        }
        text += format.lineEnd;
    }
    return text;
}

}  // namespace

std::string csvOf(const ExportTable& table, std::span<const std::size_t> rows) {
    return textOf(table, rows, {csvField, ",", "\r\n", true});
}

std::string tsvOf(const ExportTable& table, std::span<const std::size_t> rows, bool versioned) {
    return textOf(table, rows, {tsvField, "\t", "\n", versioned});
}

std::size_t rowKey(const ExportTable& table, std::size_t row) {
    std::string key;
    bool hasKey = false;
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        if (!table.columns[column].isKey) continue;
        hasKey = true;
        key += table.cell(row, column).text + '\0';
    }
    return hasKey ? std::hash<std::string>()(key) : row;
}

std::string fileNamePart(std::string_view name) {
    std::string part(name);
    std::replace_if(
        part.begin(), part.end(),
        [](char letter) {
            const auto byte = static_cast<unsigned char>(letter);
            return !std::isalnum(byte) && letter != '-' && letter != '_' && letter != ' ';
        },
        '_');
    return part;
}

}  // namespace worldy::ui
