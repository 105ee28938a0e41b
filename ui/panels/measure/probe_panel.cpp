#include "ui/panels/measure/probe_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "ui/kit/chunk_link.h"
#include "ui/kit/figure_rows.h"
#include "ui/kit/source_readings.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

std::string textOf(const ProbedVertex& probed) {
    const planet::VertexPrecision& p = probed.precision;
    return fmt::format(
        "{} vertex {}, {}: {:.4f} {:.4f} {:.4f} m, distance {:.3f} m; float error: camera-relative {:.6f} mm "
        "{:.6f} px, planet-origin {:.6f} mm {:.6f} px; view depth {:.3f} m; depth step: reversed Z {:.6g} m, "
        "non-reversed Z {:.6g} m",
        planet::toString(p.chunk), p.vertex.x, p.vertex.y, p.positionM.x, p.positionM.y, p.positionM.z,
        p.distanceM, 1000 * p.shader.errorM, p.shader.errorPx, 1000 * p.fromCentre.errorM,
        p.fromCentre.errorPx, probed.depth.aheadM, probed.depth.reversedFloatM, probed.depth.fallbackM);
}

void probed(const char* id, const ProbedVertex& vertex, const EditorView& view, Commands& commands) {
    ImGui::PushID(id);
    chunkLink(vertex.precision.chunk, view, commands);
    if (beginValues(id)) {
        figureRows(precisionFigures(vertex.precision));
        figureRows(depthFigures(vertex.depth));
        endValues();
    }
    if (button("Copy", "Copies all values as one line of text, with more digits."))
        commands.push_back(CopyText{textOf(vertex)});
    ImGui::PopID();
}

}  // namespace

void probePanel(const EditorView& view, Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to measure float and depth precision.");
    const ProbeView& probe = view.instruments.probe;
    if (section(probe.overGround || !probe.vertex ? "Under the pointer###pointer"
                                                  : "Last under the pointer###pointer")) {
        if (probe.vertex)
            probed("pointer", *probe.vertex, view, commands);
        else
            ImGui::TextWrapped("Point at the ground in the viewport.");
    }
    const bool isSourceOpen = section("Source");
    tooltip("Shows what each layer of the source says about the ground under the pointer.");
    if (isSourceOpen)
        sourceReadings("source", view.sources, view.sources.pointed, "Point at the ground in the viewport.",
                       commands);
    const bool isChunkOpen = section("Selected chunk");
    tooltip("Shows the vertex of the selected chunk that has the largest error.");
    if (!isChunkOpen) return;
    if (probe.selected)
        probed("selected", *probe.selected, view, commands);
    else
        ImGui::TextWrapped(view.focus.selected ? "The selected chunk is not drawn."
                                               : "Click a chunk in the viewport to select it.");
}

}  // namespace worldy::ui
