#include "ui/compare_table.h"

#include <fmt/format.h>

#include <cmath>

#include "ui/text.h"

namespace ui {

namespace {

using Figures = ComparedFigures;

constexpr std::array<CompareRow, 17> comparedRows = {{
    {"triangles", "Triangles", "Drawn, skirts counted in. Over a flight: the mean of its moments.",
     &Figures::triangles, FigureUnit::Count, true, true, false},
    {"chunks", "Chunks", "Drawn: one draw call each. Over a flight: the mean of its moments.",
     &Figures::chunks, FigureUnit::Count, true, true, false},
    {"resident_bytes", "Memory", "Resident chunks, CPU and GPU together. Over a flight: the most.",
     &Figures::residentBytes, FigureUnit::Bytes, true, true, true},
    {"bytes_read", "Read",
     "Bytes read from the chunk file: since comparing began, or over the flight from an empty planet.",
     &Figures::bytesRead, FigureUnit::Bytes, true, true, true},
    {"select_ms", "Selection", "Choosing chunks, ms a frame, flicker taken out.", &Figures::selectMs,
     FigureUnit::Milliseconds, true, false, false},
    {"draw_ms", "Drawing", "Drawing the planet on the GPU, by timer queries, ms a frame, flicker taken out.",
     &Figures::drawMs, FigureUnit::Milliseconds, true, false, false},
    {"frame_ms", "Frame time",
     "Choosing and drawing one settled moment, the GPU waited for, ms: the best of five, A and B in turn, "
     "and "
     "of all moments the median. While the window goes on drawing small differences mean nothing.",
     &Figures::frameMs, FigureUnit::Milliseconds, false, true, false},
    {"worst_eps_px", "Worst eps",
     "The largest predicted error of a drawn chunk, delta K' / D, pixels. Over a flight a chunk that morphs "
     "has that share of its parent's.",
     &Figures::worstEpsPx, FigureUnit::Pixels, true, true, false},
    {"worst_error_px", "Worst error",
     "The largest true error: the distance between the finest data and what is drawn, pixels, as if the view "
     "faced it.",
     &Figures::worstErrorPx, FigureUnit::Pixels, true, true, false},
    {"p99_error_px", "99% error", "99% of the drawn chunks have no larger true error than this, pixels.",
     &Figures::p99ErrorPx, FigureUnit::Pixels, true, true, false},
    {"violations", "Over prediction",
     "Chunks whose true error is over what was predicted. Must be 0: else the threshold lies.",
     &Figures::violations, FigureUnit::Count, true, true, true},
    {"crack_px", "Crack pixels", "Pixels that would show a crack if there were no skirts.", &Figures::crackPx,
     FigureUnit::Count, true, true, true},
    {"leaking_px", "Leaking pixels", "Those of them that the skirts as set leave open.", &Figures::leakingPx,
     FigureUnit::Count, true, true, true},
    {"switches", "Level changes",
     "Chunks replaced by others of another level: since comparing began, or over the flight at 60 frames a "
     "second.",
     &Figures::switches, FigureUnit::Count, true, true, true},
    {"worst_pop_px", "Worst pop", "The farthest that the surface has jumped at such a change, pixels.",
     &Figures::worstPopPx, FigureUnit::Pixels, true, true, false},
    {"p99_pop_px", "99% of pops", "99% of the changes of level in the picture jump no farther, pixels.",
     &Figures::p99PopPx, FigureUnit::Pixels, true, true, false},
    {"late", "Late arrivals",
     "Chunks drawn too coarse since their children had not come. A flight has its loads on time: 0.",
     &Figures::late, FigureUnit::Count, true, true, true},
}};

std::string textOf(FigureUnit unit, double value) {
    switch (unit) {
        case FigureUnit::Count:
            return countText(value);
        case FigureUnit::Bytes:
            return bytesText(value);
        case FigureUnit::Milliseconds:
            return millisecondsText(value);
        case FigureUnit::Pixels:
            return pixelsText(value);
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

}  // namespace ui
