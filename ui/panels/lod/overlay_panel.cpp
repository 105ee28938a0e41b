#include "ui/panels/lod/overlay_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/base/glossary.h"
#include "app/base/text.h"
#include "ui/kit/plots.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

void colourControls(const SettingControls& control, OverlaySettings& overlay) {
    control(overlay.colourBy);
    beginGrey(overlay.colourBy == ColourBy::None, "Choose a tint first.");
    control(overlay.opacity);
    endGrey();
    if (overlay.colourBy == ColourBy::Error || overlay.colourBy == ColourBy::Measured)
        control(overlay.errorScale);
    if (overlay.colourBy == ColourBy::DeltaC) control(overlay.deltaTopM);
    if (overlay.colourBy == ColourBy::Age) control(overlay.ageTopS);
}

void drawnControls(const SettingControls& control, OverlaySettings& overlay) {
    control(overlay.outlines);
    control.beside(overlay.bounds);
    control(overlay.wireframe);
    control.beside(overlay.cube);
    control(overlay.clipmap);
    control.beside(overlay.sources);
    control(overlay.notes);
    control(overlay.skirtPaint);
    control(overlay.labels);
}

struct ErrorCounts {
    std::array<float, 40> counts{};
    std::size_t over = 0;  // number of chunks over tau
};

// Counts drawn chunks by eps in [0, 2 tau]; the last bucket holds all larger values.
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
    histogram("errors of drawn chunks", errors.counts, "0 px", fmt::format("{:.3g} px and over", 2 * tauPx),
              marks, 4, [&](double position) { return fmt::format("{:.3g} px", 2 * tauPx * position); });
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

void overlayPanel(const EditorView& view, ViewSettings& settings) {
    const SettingControls control(settings);
    colourControls(control, settings.overlay);
    drawnControls(control, settings.overlay);
    if (!section("Error of drawn chunks")) return;
    if (view.planet)
        errorHistogram(*view.planet);
    else
        ImGui::TextDisabled("No planet is open.");
}

}  // namespace worldy::ui
