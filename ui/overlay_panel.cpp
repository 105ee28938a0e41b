#include "ui/overlay_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "ui/plots.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

void colourKnobs(OverlaySettings& overlay, const OverlaySettings& defaults) {
    const std::string colours = std::string("Nothing") + '\0' + "Level" + '\0' + epsSymbol() + " / " +
                                tauSymbol() + '\0' + "delta_c" + '\0' + "Morph" + '\0' + "Age" + '\0' +
                                "Load order" + '\0' + "Measured" + '\0';
    choice(
        "Colour by", overlay.colourBy, defaults.colourBy, colours.c_str(),
        "What tints the chunks in the viewport: their level, their error on screen against the tolerance, "
        "their error in metres, how far they have slid onto their parent, how long ago or in which order "
        "they were loaded, or their error as it was last measured (panel True error) against the tolerance. "
        "F8 goes through them. A tint hides the ground's own colours.");
    ImGui::BeginDisabled(overlay.colourBy == ColourBy::None);
    slider(
        "Opacity", overlay.opacity, defaults.opacity, 0, 1, "%.2f",
        "Of the tint over the ground, [0, 1]. Low: the ground shows, and colours are harder to tell apart. "
        "Without lighting the tint is opaque, so that colours are exactly those of the legend.");
    ImGui::EndDisabled();
    if (overlay.colourBy == ColourBy::Error || overlay.colourBy == ColourBy::Measured)
        slider(
            "Yellow at", overlay.errorScale, defaults.errorScale, 0.01, 100, "%.2f x tau",
            "The error / tau that is drawn yellow; 0 is green, twice it and over is red. Small: all that has "
            "any error is red. Large: all is green, also what is over the tolerance.",
            ImGuiSliderFlags_Logarithmic);
    if (overlay.colourBy == ColourBy::DeltaC)
        slider("Top", overlay.deltaTopM, defaults.deltaTopM, 0.01, 100'000, "%.4g m",
               "The delta_c, metres, that is drawn lightest; the scale is logarithmic over the four decades "
               "below it. Too small: all that is coarse looks the same; too large: all that is fine does.",
               ImGuiSliderFlags_Logarithmic);
    if (overlay.colourBy == ColourBy::Age)
        slider(
            "Oldest", overlay.ageTopS, defaults.ageTopS, 0.1, 3600, "%.3g s",
            "Seconds after which a chunk is drawn darkest; just loaded is lightest. Short: only the latest "
            "stand out; long: the latest do not differ from those before.",
            ImGuiSliderFlags_Logarithmic);
}

void drawnKnobs(OverlaySettings& overlay, const OverlaySettings& defaults) {
    checkbox(
        "Outlines", overlay.outlines, defaults.outlines,
        "The chunks' borders; red where finer chunks could not be read, amber where they are tried again. "
        "Many small chunks far away run into one another.");
    secondColumn();
    checkbox("Bounds", overlay.bounds, defaults.bounds,
             "The boxes that hold all that a chunk and those below it can draw; distances and culling go by "
             "them. Lines for every drawn chunk: slow with thousands.");
    checkbox(
        "Wireframe", overlay.wireframe, defaults.wireframe,
        "The mesh's lines over a dimmed surface (F1). Where triangles are smaller than some three pixels "
        "it turns into an even grey.");
    secondColumn();
    checkbox("Cube", overlay.cube, defaults.cube,
             "Draws the cube before it is blown up to the sphere (F4). What is drawn is still chosen for the "
             "sphere, so its errors on screen are not those of this picture.");
    checkbox(
        "Clipmap", overlay.clipmap, defaults.clipmap,
        "Where streamed colours are drawn from a clipmap (Surface): each level's window in that level's "
        "colour, and for two seconds what was filled of it: magenta came in by moving, cyan because tiles "
        "came or went. Freeze the view and fly on, or use an observer, to see it from outside.");
    choice("Skirts", overlay.skirtPaint, defaults.skirtPaint, "As ground\0Loud\0Loud alone\0",
           "How the curtains at chunks' borders are drawn: like the ground they hang from; in one glaring "
           "colour, so that every crack they fill is seen; or that alone, without the ground.");
    const std::string labels =
        std::string("None") + '\0' + "Level" + '\0' + epsSymbol() + '\0' + "Level and " + epsSymbol() + '\0';
    choice("Labels", overlay.labels, defaults.labels, labels.c_str(),
           "Written over the middle of drawn chunks, near ones first; those without room have none. eps in "
           "pixels. Costs some tenths of a millisecond a frame.");
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
        ImGui::TextDisabled("Nothing is drawn.");
        return;
    }
    const double tauPx = planet.lodSettings().tauPx;
    const ErrorCounts errors = errorCounts(selection, tauPx);
    const std::array marks = {HistogramMark{0.5, fmt::format("{} {:.3g} px", tauSymbol(), tauPx)}};
    histogram("eps", errors.counts, "0 px", fmt::format("{:.3g} px and over", 2 * tauPx), marks, 4,
              [&](double position) { return fmt::format("{:.3g} px", 2 * tauPx * position); });
    tooltip(
        "How many drawn chunks have which error on screen. Leaves have none. What is right of tau waits for "
        "its children, or may not be split.");
    if (!beginValues("errors")) return;
    valueRow("Drawn", fmt::format("{}", selection.draw.size()), "Chunks.");
    const bool any = errors.over > 0;
    valueRow(
        fmt::format("Over {}", tauSymbol()).c_str(), fmt::format("{}", errors.over),
        "Drawn though their error is over the tolerance: their children are not there yet, or the largest "
        "level or a stitched neighbour forbids them.",
        any ? &palette().warning : nullptr);
    valueRow("Worst", pixelsText(static_cast<double>(selection.counters.worstEpsPx)),
             "The largest eps of what is drawn.", any ? &palette().warning : nullptr);
    endValues();
}

}  // namespace

void overlayPanel(const EditorView& view, ViewSettings& settings, Commands&) {
    const OverlaySettings defaults;
    colourKnobs(settings.overlay, defaults);
    drawnKnobs(settings.overlay, defaults);
    if (!section("Error of what is drawn")) return;
    if (view.planet)
        errorHistogram(*view.planet);
    else
        ImGui::TextDisabled("No planet is open.");
}

}  // namespace ui
