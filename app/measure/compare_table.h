// What is counted and measured of both sides of a comparison, and how it reads in a table. Plain data and
// pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace worldy {

// What is not known is none. Over a flight: of its moments, settled, unless said otherwise.
struct ComparedFigures {
    std::optional<double> groundTriangles;    // over a flight the mean
    std::optional<double> skirtTriangles;     // over a flight the mean
    std::optional<double> triangles;          // their sum
    std::optional<double> chunks;             // drawn; over a flight the mean
    std::optional<double> residentBytes;      // of chunks, CPU and GPU; over a flight the most
    std::optional<double> bytesRead;          // from the file
    std::optional<double> selectMs;           // choosing chunks, smoothed; not over a flight
    std::optional<double> drawMs;             // drawing on the GPU, smoothed; not over a flight
    std::optional<double> frameMs;            // choosing and drawing, waited for: the median over a flight
    std::optional<double> worstEpsPx;         // predicted error of a chunk's own surface
    std::optional<double> worstDrawnBoundPx;  // of what is drawn: morph counted in
    std::optional<double> worstErrorPx;       // true error, as if the view faced it
    std::optional<double> p99ErrorPx;         // of chunks
    std::optional<double> violations;         // chunks whose true error is over the drawn bound
    std::optional<double> crackPx;
    std::optional<double> leakingPx;  // of them
    std::optional<double> switches;   // changes of level
    std::optional<double> worstPopPx;
    std::optional<double> p99PopPx;
    std::optional<double> late;  // chunks drawn too coarse since their children had not come

    bool operator==(const ComparedFigures&) const = default;
};

enum class FigureUnit { Count, Bytes, Milliseconds, Pixels };

struct CompareRow {
    const char* key;   // "mean_triangles"
    const char* name;  // "Triangles"
    const char* explanation;
    std::optional<double> ComparedFigures::*value;
    FigureUnit unit;
    bool live;    // in the table of the view as it is
    bool flight;  // in the table of a flight
    bool whole;   // over a flight a whole number, which reports write as such; else a mean or a measure
};
std::span<const CompareRow> compareRows();

// "-" for what is not known.
std::string figureText(const CompareRow& row, const std::optional<double>& value);

// What B is of A: "x 0.53", "=", or the difference "+12" where one of them is 0; "-" where one is not known.
std::string changeText(const CompareRow& row, const std::optional<double>& a, const std::optional<double>& b);

}  // namespace worldy
