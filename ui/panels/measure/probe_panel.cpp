#include "ui/panels/measure/probe_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "app/base/text.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/source_readings.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

// Formats errors from micrometres to metres.
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
             "Column and row in the chunk, from its south-west corner.");
    valueRow("Distance", distanceText(p.distanceM), "Distance from the camera.");
    valueRow("x", fmt::format("{:.4f} m", p.positionM.x),
             "Double-precision position of the drawn vertex, including morph and stitched edges, in metres "
             "from the planet's centre. x points to latitude 0, longitude 0.");
    valueRow("y", fmt::format("{:.4f} m", p.positionM.y), "y points to latitude 0, longitude 90° E.");
    valueRow("z", fmt::format("{:.4f} m", p.positionM.z), "z points to the north pole.");
    valueRow("Camera-relative float error", errorText(p.shader.errorM),
             "Camera-relative rendering: error of the vertex shader's single-precision position, in "
             "millimetres. The same computation "
             "is done in floats, relative to the camera and a nearby reference point.");
    valueRow("Camera-relative error in px", errorPxText(p.shader.errorPx),
             "The error in screen space: K' |a/|a| - b/|b||, with a and b relative to the camera. Above "
             "about 0.5 px vertices jitter.",
             p.shader.errorPx > 0.5 ? &palette().bad : nullptr);
    valueRow("Planet-origin float error", errorText(p.fromCentre.errorM),
             "For comparison: the error with float positions relative to the planet's centre minus a float "
             "camera position.");
    valueRow("Planet-origin error in px", errorPxText(p.fromCentre.errorPx), "The error in screen space.",
             p.fromCentre.errorPx > 0.5 ? &palette().warning : nullptr);
}

void depthRows(const DepthSteps& depth) {
    valueRow("View depth", distanceText(depth.aheadM),
             "Distance along the view direction, from which depth is computed.");
    const char* inUse = depth.reversedInUse ? "Reversed Z, in use" : "Reversed Z";
    valueRow(inUse, stepText(depth.reversedFloatM),
             "Distance in metres between adjacent values of a float depth buffer, with 1 at the near plane "
             "and 0 at infinity. Closer surfaces may z-fight.");
    valueRow(
        depth.reversedInUse ? "Non-reversed Z" : "Non-reversed Z, in use", stepText(depth.fallbackM),
        "Distance in metres between adjacent depth values with conventional OpenGL depth, used without clip "
        "control; the near plane follows the height above ground. None: outside the near and far planes.");
}

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
        precisionRows(vertex.precision);
        depthRows(vertex.depth);
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
