#include "ui/model/export_table.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <numeric>

namespace worldy::ui {
namespace {

ExportTable tableOf(const std::vector<std::vector<ExportCell>>& rows) {
    ExportTable table{.name = "test", .columns = {{"text"}, {"gap_m"}}, .rows = rows.size()};
    table.cell = [rows](std::size_t row, std::size_t column) { return rows[row][column]; };
    return table;
}

std::vector<std::size_t> all(const ExportTable& table) {
    std::vector<std::size_t> rows(table.rows);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return rows;
}

std::string csvOf(const std::string& text) {
    const ExportTable table = tableOf({{text, 1}});
    const std::string whole = csvOf(table, all(table));
    const std::string start = "schema_version,text,gap_m\r\n2,", end = ",1\r\n";
    EXPECT_TRUE(whole.starts_with(start)) << whole;
    EXPECT_TRUE(whole.ends_with(end)) << whole;
    return whole.substr(start.size(), whole.size() - start.size() - end.size());
}

TEST(ExportTable, csvQuotesSeparatorsQuotesAndLineBreaks) {
    EXPECT_EQ(csvOf("plain"), "plain");
    EXPECT_EQ(csvOf("a,b"), "\"a,b\"");
    EXPECT_EQ(csvOf("say \"yes\""), "\"say \"\"yes\"\"\"");
    EXPECT_EQ(csvOf("two\nlines"), "\"two\nlines\"");
    EXPECT_EQ(csvOf("\u03b5 > \u03c4"), "\u03b5 > \u03c4");
}

TEST(ExportTable, textIsNoFormulaForASpreadsheet) {
    for (const char* text : {"=1+1", "+x", "-x", "@sum", "\tx"})
        EXPECT_EQ(csvOf(text), std::string("'") + text);
    EXPECT_EQ(csvOf("\r=1"), "\"'\r=1\"");
    EXPECT_EQ(csvOf("-12.5"), "-12.5");
    EXPECT_EQ(csvOf("a=b"), "a=b");
}

TEST(ExportTable, numbersReadBackExactly) {
    const double tenth = 0.1 + 0.2;
    EXPECT_EQ(std::stod(ExportCell(tenth).text), tenth);
    EXPECT_EQ(std::stof(ExportCell(0.1f).text), 0.1f);
    EXPECT_EQ(ExportCell(-3).text, "-3");
    EXPECT_EQ(ExportCell(std::numeric_limits<std::uint64_t>::max()).text, "18446744073709551615");
    EXPECT_EQ(ExportCell(std::numeric_limits<double>::quiet_NaN()).text, "");
    EXPECT_EQ(ExportCell(std::optional<double>()).text, "");
    EXPECT_EQ(ExportCell(std::optional(2.5)).text, "2.5");
    EXPECT_EQ(ExportCell(true).text, "true");
}

TEST(ExportTable, tsvHasNoTabsOrLineBreaksInCells) {
    const ExportTable table = tableOf({{"a\tb\r\nc", 0.5}});
    EXPECT_EQ(tsvOf(table, all(table), false), "text\tgap_m\na b  c\t0.5\n");
    EXPECT_EQ(tsvOf(table, all(table), true), "schema_version\ttext\tgap_m\n2\ta b  c\t0.5\n");
}

TEST(ExportTable, onlyTheAskedRowsInTheAskedOrder) {
    const ExportTable table = tableOf({{"a", 1}, {"b", 2}, {"c", 3}});
    constexpr std::array<std::size_t, 2> rows = {2, 0};
    EXPECT_EQ(tsvOf(table, rows, false), "text\tgap_m\nc\t3\na\t1\n");
}

TEST(ExportTable, aRowKeepsItsKeyWhileOtherColumnsChange) {
    ExportTable before = tableOf({{"a", 1}, {"b", 2}});
    ExportTable after = tableOf({{"b", 7}, {"a", 9}});
    before.columns[0].isKey = after.columns[0].isKey = true;
    EXPECT_EQ(rowKey(before, 0), rowKey(after, 1));
    EXPECT_NE(rowKey(before, 0), rowKey(after, 0));
    before.columns[0].isKey = false;
    EXPECT_EQ(rowKey(before, 1), 1u);
}

TEST(ExportTable, namesOfFilesHoldNoPaths) {
    EXPECT_EQ(fileNamePart("true error"), "true error");
    EXPECT_EQ(fileNamePart("../a/b:c"), "___a_b_c");
}

}  // namespace
}  // namespace worldy::ui
