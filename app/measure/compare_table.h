// The figures of both sides of a comparison, and their text in a table. Plain data and pure functions, any
// thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace worldy {

// Unknown figures are unset. Over a flight, figures are those of its settled sample frames.
struct ComparedFigures {
    std::optional<double> groundTriangles;  // mean over a flight
    std::optional<double> skirtTriangles;   // mean over a flight
    std::optional<double> triangles;        // ground and skirt triangles
    std::optional<double> chunks;           // drawn chunks; mean over a flight
    std::optional<double> residentBytes;    // resident chunks, CPU and GPU; maximum over a flight
    std::optional<double> bytesRead;        // bytes read from the chunk file
    std::optional<double> selectMs;         // selection, smoothed; not over a flight
    std::optional<double> drawMs;           // drawing on the GPU, smoothed; not over a flight
    std::optional<double> frameMs;          // selection and drawing, including the GPU; median over a flight
    std::optional<double> worstEpsPx;       // predicted error of a chunk's own surface
    std::optional<double> worstDrawnBoundPx;  // bound of what is drawn, including morph
    std::optional<double> worstErrorPx;       // true error, as if the view faced it
    std::optional<double> p99ErrorPx;         // 99th percentile of the true error over chunks
    std::optional<double> violations;         // chunks whose true error exceeds the drawn bound
    std::optional<double> crackPx;
    std::optional<double> leakingPx;  // crack pixels that skirts do not cover
    std::optional<double> switches;   // level changes
    std::optional<double> worstPopPx;
    std::optional<double> p99PopPx;
    std::optional<double> late;  // chunks drawn too coarse because their children were not loaded

    bool operator==(const ComparedFigures&) const = default;
};

enum class FigureUnit { Count, Bytes, Milliseconds, Pixels };

struct CompareRow {
    const char* key;   // "mean_triangles"
    const char* name;  // "Triangles"
    const char* explanation;
    std::optional<double> ComparedFigures::*value;
    FigureUnit unit;
    bool live;    // shown in the table of the current view
    bool flight;  // shown in the table of a flight
    bool whole;   // an integer over a flight, written as such in reports; otherwise a mean or a measurement
};
std::span<const CompareRow> compareRows();

// Returns "-" for an unknown figure.
std::string figureText(const CompareRow& row, const std::optional<double>& value);

// Returns B relative to A: "x 0.53", "=", or the difference "+12" if one of them is 0; "-" if one is unknown.
std::string changeText(const CompareRow& row, const std::optional<double>& a, const std::optional<double>& b);

}  // namespace worldy
