#include "ui/probe_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "ui/chunk_link.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

// Errors from micrometres to metres.
std::string errorText(double metres) {
    const double millimetres = 1000 * metres;
    return millimetres < 1000 ? fmt::format("{:.3f} mm", millimetres) : distanceText(metres);
}

std::string errorPxText(double px) {
    return fmt::format("{:.4f} px", px);
}

std::string stepText(double metres) {
    if (!std::isfinite(metres)) return "none";
    return metres < 1 ? errorText(metres) : distanceText(metres);
}

void precisionRows(const planet::VertexPrecision& p) {
    valueRow("Vertex", fmt::format("{}, {}", p.vertex.x, p.vertex.y),
             "Column and row on the chunk, from its south-west corner.");
    valueRow("Distance", distanceText(p.distanceM), "From the eye.");
    valueRow("x", fmt::format("{:.4f} m", p.positionM.x),
             "The vertex in doubles, as it is drawn, morph and stitched edges counted in; metres from the "
             "planet's centre. x: latitude 0, longitude 0.");
    valueRow("y", fmt::format("{:.4f} m", p.positionM.y), "y: latitude 0, longitude 90 east.");
    valueRow("z", fmt::format("{:.4f} m", p.positionM.z), "z: the north pole.");
    valueRow("Shader's floats", errorText(p.shader.errorM),
             "How far off the vertex shader's float position is, millimetres: the same maths worked out here "
             "in floats, relative to the eye from a reference point near it.");
    valueRow("", errorPxText(p.shader.errorPx),
             "The same on screen: K' |a/|a| - b/|b||, a and b seen from the eye. Over about half a pixel "
             "vertices tremble.",
             p.shader.errorPx > 0.5 ? &palette().bad : nullptr);
    valueRow("From the centre", errorText(p.fromCentre.errorM),
             "For comparison: how far off it would be with float positions from the planet's centre, less a "
             "float eye.");
    valueRow("", errorPxText(p.fromCentre.errorPx), "The same on screen.",
             p.fromCentre.errorPx > 0.5 ? &palette().warning : nullptr);
}

void depthRows(const DepthSteps& depth) {
    valueRow("Ahead", distanceText(depth.aheadM), "Along the view direction: what depth is made of.");
    const char* inUse = depth.reversedInUse ? "Reversed depth, in use" : "Reversed depth";
    valueRow(inUse, stepText(depth.reversedFloatM),
             "Metres between two neighbouring values of a float depth buffer, 1 at the near plane and 0 at "
             "infinity. Surfaces nearer together may show through each other.");
    valueRow(depth.reversedInUse ? "Fallback" : "Fallback, in use", stepText(depth.fallbackM),
             "The same for depth as OpenGL always had it, for machines without clip control: the near plane "
             "follows the height above the ground. None: beyond its planes.");
}

std::string textOf(const ProbedVertex& probed) {
    const planet::VertexPrecision& p = probed.precision;
    return fmt::format(
        "{} vertex {}, {}: {:.4f} {:.4f} {:.4f} m, {:.3f} m away; shader {:.6f} mm {:.6f} px; from centre "
        "{:.6f} mm {:.6f} px; {:.3f} m ahead, depth step reversed {:.6g} m, fallback {:.6g} m",
        planet::toString(p.chunk), p.vertex.x, p.vertex.y, p.positionM.x, p.positionM.y, p.positionM.z,
        p.distanceM, 1000 * p.shader.errorM, p.shader.errorPx, 1000 * p.fromCentre.errorM,
        p.fromCentre.errorPx, probed.depth.aheadM, probed.depth.reversedFloatM, probed.depth.fallbackM);
}

void probed(const char* id, const ProbedVertex& vertex, const EditorView& view, Commands& commands) {
    ImGui::PushID(id);
    chunkLink(vertex.precision.chunk, view, commands);
    if (beginValues(id)) {
        precisionRows(vertex.precision);
        depthRows(vertex.depth);
        endValues();
    }
    if (button("Copy", "All of it as a line of text, with more digits."))
        commands.push_back(CopyText{textOf(vertex)});
    ImGui::PopID();
}

}  // namespace

void probePanel(const EditorView& view, ProbePanelState&, ViewSettings&, Commands& commands) {
    if (!view.planet) return emptyState("How exact floats and depth are shows here once a planet is open.");
    const ProbeView& probe = view.probe;
    if (section(probe.overGround || !probe.vertex ? "Under the pointer###pointer"
                                                  : "Last under the pointer###pointer")) {
        if (probe.vertex)
            probed("pointer", *probe.vertex, view, commands);
        else
            ImGui::TextWrapped("Point at the ground in the viewport.");
    }
    if (!section("Selected chunk's worst vertex")) return;
    if (probe.selected)
        probed("selected", *probe.selected, view, commands);
    else
        ImGui::TextWrapped(view.focus.selected ? "The selected chunk is not drawn."
                                               : "Click a chunk in the viewport to select it.");
}

}  // namespace ui
