#include "app/measure/compare_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/base/glossary.h"
#include "app/base/text.h"

namespace worldy {

namespace {

using Figures = ComparedFigures;

constexpr std::array<CompareRow, 20> comparedRows = {{
    {"mean_ground_triangles", terms::groundTriangles.name,
     "Triangles of the drawn chunks without skirts. Over a flight: the mean of its sample frames.",
     &Figures::groundTriangles, FigureUnit::Count, true, true, false},
    {"mean_skirt_triangles", terms::skirtTriangles.name,
     "Triangles of the skirts. Over a flight: the mean of its sample frames.", &Figures::skirtTriangles,
     FigureUnit::Count, true, true, false},
    {"mean_triangles", terms::triangles.name,
     "The sum of ground triangles and skirt triangles. Over a flight: the mean of its sample frames.",
     &Figures::triangles, FigureUnit::Count, true, true, false},
    {"mean_drawn_chunks", terms::drawnChunks.name,
     "Chunks drawn. Over a flight: the mean of its sample frames.", &Figures::chunks, FigureUnit::Count, true,
     true, false},
    {"most_resident_bytes", "Memory",
     "Memory of resident chunks, CPU and GPU together. Over a flight: the maximum.", &Figures::residentBytes,
     FigureUnit::Bytes, true, true, true},
    {"bytes_read", "Bytes read",
     "Bytes read from the chunk file: since the comparison began, or over the flight starting with the roots "
     "only.",
     &Figures::bytesRead, FigureUnit::Bytes, true, true, true},
    {"select_ms", "Selection", "LOD selection, in ms per frame, smoothed.", &Figures::selectMs,
     FigureUnit::Milliseconds, true, false, false},
    {"draw_ms", "Drawing", "GPU time for drawing the planet by timer queries, in ms per frame, smoothed.",
     &Figures::drawMs, FigureUnit::Milliseconds, true, false, false},
    {"median_frame_ms", "Frame time",
     "Selecting and drawing one sample frame, including the GPU, in ms: best of five with A and B "
     "alternating, median over all sample frames. Small differences are not significant while the window "
     "draws too.",
     &Figures::frameMs, FigureUnit::Milliseconds, false, true, false},
    {"worst_eps_px", "Max ε",
     "Largest predicted error of a drawn chunk's own surface, δc K' / D, in pixels. Compared with τ. "
     "Excludes morph.",
     &Figures::worstEpsPx, FigureUnit::Pixels, true, true, false},
    {"worst_drawn_bound_px", "Max drawn bound",
     "Largest bound of the error of what is drawn, in pixels: a morphing chunk includes its parent's error "
     "by "
     "the morph weight.",
     &Figures::worstDrawnBoundPx, FigureUnit::Pixels, true, true, false},
    {"worst_measured_px", "Max true error",
     "Largest true error: distance between the finest data and the drawn surface, in facing pixels.",
     &Figures::worstErrorPx, FigureUnit::Pixels, true, true, false},
    {"p99_measured_px", "P99 true error", "99 % of the drawn chunks have no larger true error, in pixels.",
     &Figures::p99ErrorPx, FigureUnit::Pixels, true, true, false},
    {"violations", "Violations", "Chunks whose true error exceeds the drawn bound. Must be 0.",
     &Figures::violations, FigureUnit::Count, true, true, true},
    {"crack_px", "Crack pixels", "Pixels that would show a crack without skirts.", &Figures::crackPx,
     FigureUnit::Count, true, true, true},
    {"leaking_px", "Uncovered pixels", "Crack pixels that the current skirts do not cover.",
     &Figures::leakingPx, FigureUnit::Count, true, true, true},
    {"switches", "Level changes",
     "Chunks replaced by chunks of another level: since the comparison began, or over the flight at 60 "
     "frames per second.",
     &Figures::switches, FigureUnit::Count, true, true, true},
    {"worst_pop_px", "Max pop",
     "Largest jump of the surface at a level change that is visible and does not follow a camera jump, in "
     "pixels.",
     &Figures::worstPopPx, FigureUnit::Pixels, true, true, false},
    {"p99_pop_px", "P99 pop",
     "99 % of the level changes that are visible and do not follow a camera jump have no larger jump, in "
     "pixels.",
     &Figures::p99PopPx, FigureUnit::Pixels, true, true, false},
    {"late", "Late arrivals",
     "Chunks drawn too coarse because their children were not loaded. Over a flight all loads are on time, "
     "so it is 0.",
     &Figures::late, FigureUnit::Count, true, true, true},
}};

// Returns three significant digits below 100 px, so that figures with a ratio of 1.02 read differently.
std::string comparedPixelsText(double px) {
    if (px <= 0 || px >= 99.95) return pixelsText(px);
    const int digits = std::clamp(2 - static_cast<int>(std::floor(std::log10(px))), 1, 6);
    return fmt::format("{:.{}f} px", px, digits);
}

std::string textOf(FigureUnit unit, double value) {
    switch (unit) {
        case FigureUnit::Count:
            return countText(value);
        case FigureUnit::Bytes:
            return bytesText(value);
        case FigureUnit::Milliseconds:
            return millisecondsText(value);
        case FigureUnit::Pixels:
            return comparedPixelsText(value);
    }
    return {};
}

}  // namespace

std::span<const CompareRow> compareRows() {
    return comparedRows;
}

std::string figureText(const CompareRow& row, const std::optional<double>& value) {
    return value ? textOf(row.unit, *value) : "-";
}

std::string changeText(const CompareRow& row, const std::optional<double>& a,
                       const std::optional<double>& b) {
    if (!a || !b) return "-";
    if (*a == *b) return "=";
    if (*a > 0 && *b > 0) {
        const double ratio = *b / *a;
        if (ratio >= 1000) return fmt::format("x {:.0f}", ratio);
        return ratio < 0.1 ? fmt::format("x {:.2g}", ratio) : fmt::format("x {:.3g}", ratio);
    }
    return fmt::format("{}{}", *b > *a ? "+" : "-", textOf(row.unit, std::abs(*b - *a)));
}

}  // namespace worldy
