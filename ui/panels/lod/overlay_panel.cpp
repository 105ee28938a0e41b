#include "ui/panels/lod/overlay_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/base/glossary.h"
#include "app/base/text.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

void colourKnobs(OverlaySettings& overlay, const OverlaySettings& defaults) {
    const std::string colours = std::string("none") + '\0' + "level" + '\0' + epsSymbol() + " / " +
                                tauSymbol() + '\0' + "δc" + '\0' + "morph" + '\0' + "age" + '\0' +
                                "load order" + '\0' + "measured" + '\0';
    choice("Colour by", overlay.colourBy, defaults.colourBy, colours.c_str(),
           "Quantity that tints the chunks in the viewport: level, screen-space error relative to the "
           "tolerance, geometric error δc in metres, morph, time since loading, load order, or the last "
           "measured error (True error panel) relative to the tolerance. F8 cycles through them.");
    beginGrey(overlay.colourBy == ColourBy::None, "Choose a tint first.");
    slider("Opacity", overlay.opacity, defaults.opacity, 0, 1, "%.2f",
           "Opacity of the tint, [0, 1]. Smaller: more of the ground shows, but colours are harder to tell "
           "apart. At 1, the colours are exactly those of the legend: neither light nor the atmosphere "
           "changes them.");
    endGrey();
    if (overlay.colourBy == ColourBy::Error || overlay.colourBy == ColourBy::Measured)
        slider("Midpoint", overlay.errorScale, defaults.errorScale, 0.01, 100,
               (std::string("%.2f x ") + tauSymbol()).c_str(),
               "Ratio ε / τ drawn in yellow; 0 is green, and twice this value or more is red.",
               ImGuiSliderFlags_Logarithmic);
    if (overlay.colourBy == ColourBy::DeltaC)
        slider("Max δc", overlay.deltaTopM, defaults.deltaTopM, 0.01, 100'000, "%.4g m",
               "Geometric error in metres that is drawn lightest. The scale is logarithmic over the four "
               "decades below it.",
               ImGuiSliderFlags_Logarithmic);
    if (overlay.colourBy == ColourBy::Age)
        slider("Max age", overlay.ageTopS, defaults.ageTopS, 0.1, 3600, "%.3g s",
               "Time since loading, in seconds, that is drawn darkest; chunks just loaded are lightest.",
               ImGuiSliderFlags_Logarithmic);
}

void drawnKnobs(OverlaySettings& overlay, const OverlaySettings& defaults) {
    checkbox(
        "Outlines", overlay.outlines, defaults.outlines,
        "Draws chunk borders: red where finer chunks could not be read, amber where they will be retried.");
    secondColumn("Bounds");
    checkbox("Bounds", overlay.bounds, defaults.bounds,
             "Draws the bounding boxes used for distance and culling, which contain a chunk and its "
             "descendants. Slow with thousands of chunks.");
    checkbox("Wireframe", overlay.wireframe, defaults.wireframe,
             "Draws the mesh edges over a dimmed surface (F1). Triangles smaller than about three pixels "
             "appear as uniform grey.");
    secondColumn("Unprojected cube");
    checkbox("Unprojected cube", overlay.cube, defaults.cube,
             "Draws the cube before it is projected onto the sphere (F4). LOD selection still uses the "
             "sphere, so screen-space errors do not apply to this picture.");
    checkbox("Clipmap", overlay.clipmap, defaults.clipmap,
             "If streamed colours use the clipmap (Surface panel): tints each clipmap level by its colour. "
             "Texels filled in the last two seconds are magenta if the window moved, cyan if tiles were "
             "loaded or evicted. Freeze LOD or use an observer to see it from outside.");
    choice("Skirts", overlay.skirtPaint, defaults.skirtPaint, "as ground\0highlighted\0only skirts\0",
           "How skirts are drawn: with the colour of the ground; in one bright colour, so that every crack "
           "they fill is visible; or only the skirts in that colour, without the ground.");
    const std::string labels =
        std::string("none") + '\0' + "level" + '\0' + epsSymbol() + '\0' + "level and " + epsSymbol() + '\0';
    choice("Labels", overlay.labels, defaults.labels, labels.c_str(),
           "Text at the centre of drawn chunks, nearest first, as far as there is room; ε in pixels. Costs a "
           "few tenths of a millisecond per frame.");
}

struct ErrorCounts {
    std::array<float, 40> counts{};
    std::size_t over = 0;  // tau
};

// From 0 to twice tau; the last bucket holds all beyond.
ErrorCounts errorCounts(const planet::Selection& selection, double tauPx) {
    ErrorCounts errors;
    const double perBucket = 2 * tauPx / static_cast<double>(errors.counts.size());
    for (const planet::DrawItem& item : selection.draw) {
        const double bucket = std::min(static_cast<double>(item.epsPx) / perBucket,
                                       static_cast<double>(errors.counts.size() - 1));
        errors.counts[static_cast<std::size_t>(bucket)] += 1;
        if (static_cast<double>(item.epsPx) > tauPx) ++errors.over;
    }
    return errors;
}

void errorHistogram(const planet::Planet& planet) {
    const planet::Selection& selection = planet.selection();
    if (selection.draw.empty()) {
        ImGui::TextDisabled("No chunks are drawn.");
        return;
    }
    const double tauPx = planet.views()[0].input.lod.tauPx;
    const ErrorCounts errors = errorCounts(selection, tauPx);
    const std::array marks = {HistogramMark{0.5, fmt::format("{} {:.3g} px", tauSymbol(), tauPx)}};
    histogram("eps", errors.counts, "0 px", fmt::format("{:.3g} px and over", 2 * tauPx), marks, 4,
              [&](double position) { return fmt::format("{:.3g} px", 2 * tauPx * position); });
    tooltip(
        "Histogram of the screen-space error of drawn chunks. Leaves have error 0. Chunks right of τ wait "
        "for their children or may not be split.");
    if (!beginValues("errors")) return;
    valueRow(terms::drawnChunks.name, fmt::format("{}", selection.draw.size()), terms::drawnChunks.meaning);
    const bool any = errors.over > 0;
    valueRow(fmt::format("Over {}", tauSymbol()).c_str(), fmt::format("{}", errors.over),
             "Chunks drawn although their error exceeds the tolerance, because their children are not loaded "
             "yet, or because the max LOD level or a stitched neighbour forbids a split.",
             any ? &palette().warning : nullptr);
    valueRow("Max ε", pixelsText(static_cast<double>(selection.counters.worstEpsPx)),
             "Largest screen-space error of the drawn chunks.", any ? &palette().warning : nullptr);
    endValues();
}

}  // namespace

void overlayPanel(const EditorView& view, ViewSettings& settings, Commands&) {
    const OverlaySettings defaults;
    colourKnobs(settings.overlay, defaults);
    drawnKnobs(settings.overlay, defaults);
    if (!section("Error of drawn chunks")) return;
    if (view.planet)
        errorHistogram(*view.planet);
    else
        ImGui::TextDisabled("No planet is open.");
}

}  // namespace worldy::ui
