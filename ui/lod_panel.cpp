#include "ui/lod_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>
#include <type_traits>

#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

template <class T>
ImGuiDataType dataType() {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, int>);
    return std::is_same_v<T, double> ? ImGuiDataType_Double : ImGuiDataType_S32;
}

template <class T>
bool slider(const char* label, T& value, T min, T max, const char* format, const char* explanation,
            ImGuiSliderFlags flags = 0) {
    labelledControl(label, explanation);
    const bool changed = ImGui::SliderScalar(("##" + std::string(label)).c_str(), dataType<T>(), &value, &min,
                                             &max, format, flags | ImGuiSliderFlags_AlwaysClamp);
    tooltip(explanation);
    return changed;
}

void checkbox(const char* label, bool& value, const char* explanation) {
    ImGui::Checkbox(label, &value);
    tooltip(explanation);
}

// Starts the right-hand column of a pair of check boxes.
void secondColumn() {
    ImGui::SameLine(ImGui::GetWindowContentRegionMin().x + ImGui::GetWindowContentRegionMax().x * 0.5f);
}

template <class Enum>
void choice(const char* label, Enum& value, const char* items, const char* explanation) {
    labelledControl(label, explanation);
    int index = static_cast<int>(value);
    if (ImGui::Combo(("##" + std::string(label)).c_str(), &index, items)) value = static_cast<Enum>(index);
    tooltip(explanation);
}

void detailControls(LodPanelCommands& commands, bool lodFrozen, ViewSettings& settings) {
    slider(fmt::format("Tolerance {}", tauSymbol()).c_str(), settings.tauPx, 0.1, 64.0, "%.2f px",
           "Error on screen that is good enough, in pixels. Larger: fewer triangles, more visible error.",
           ImGuiSliderFlags_Logarithmic);
    slider("Skirt factor", settings.skirtFactor, 0.0, 10.0, "%.2f",
           "Skirt depth in units of the errors that a skirt has to hide. 0: no depth, cracks show.");
    bool frozen = lodFrozen;
    if (ImGui::Checkbox("Freeze LOD (F2)", &frozen)) commands.toggleFreeze = true;
    tooltip("What is drawn stays chosen for the view as it is now, while the camera flies on.");
    checkbox("Frustum culling", settings.frustumCulling, "Leaves out what lies beside and behind the view.");
    secondColumn();
    checkbox("Horizon culling", settings.horizonCulling, "Leaves out what the planet itself hides.");
}

void viewControls(const LodPanelInput& input, ViewSettings& settings) {
    choice("Colour by", settings.colourBy, "nothing\0level\0error\0",
           "Level: one colour a level. Error: green at 0, yellow at the tolerance, red at twice that.");
    choice("Surface", settings.surface, "image\0height ramp\0",
           input.hasColourImage ? "The colour image, or a ramp of colours by height."
                                : "No colour image is loaded, so the ramp is drawn for both.");
    slider("Field of view", settings.fovDeg, 5.0, 150.0, "%.0f deg", "Horizontal angle of view, degrees.");
    ImGui::BeginDisabled(settings.sunFollows);
    slider("Sun, east", settings.sunLongitudeDeg, -180.0, 180.0, "%.0f deg",
           "Longitude where the sun stands in the zenith, degrees east.");
    ImGui::EndDisabled();
    checkbox("Wireframe (F1)", settings.wireframe, "Draws the triangles' edges.");
    secondColumn();
    checkbox("Cube (F4)", settings.cube, "Draws the cube before it is blown up to the sphere.");
    checkbox("Skirts", settings.skirts, "Curtains along the chunks' edges that hide cracks.");
    secondColumn();
    checkbox("Atmosphere", settings.atmosphere, "Haze and sky.");
    checkbox("Lighting", settings.lighting, "Off: flat colour, no sun.");
    secondColumn();
    checkbox(
        "Detail", settings.detail,
        "Roughens the ground between the samples. Invented: light and colour only, nothing measured moves.");
    checkbox("Sun follows", settings.sunFollows, "Keeps the sun to the camera's east: always day.");
}

void drawnValues(const FrameStats& stats, double tauPx) {
    const planet::SelectionCounters& s = stats.selection;
    if (!beginValues("drawn")) return;
    valueRow("Visited", countText(s.visited), "Nodes of the quadtrees that selection looked at.");
    valueRow("Culled", fmt::format("{} + {}", countText(s.culledFrustum), countText(s.culledHorizon)),
             "Subtrees left out: outside the view + below the horizon.");
    valueRow("Drawn", countText(s.drawn), "Chunks drawn.");
    valueRow("Waiting", countText(s.waiting),
             "Chunks drawn though over the tolerance: their children are not loaded.",
             s.waiting > 0 ? &palette().warning : nullptr);
    valueRow("Triangles", countText(static_cast<double>(stats.render.triangles)),
             "Triangles drawn, skirts included.");
    valueRow("Deepest level", fmt::format("{}", s.deepestLevel), "Of what is drawn; 0 is a whole cube face.");
    const bool over = static_cast<double>(s.worstEpsPx) > tauPx;
    valueRow(fmt::format("Worst {}", epsSymbol()).c_str(), fmt::format("{:.2f} px", s.worstEpsPx),
             "Largest predicted error on screen of what is drawn, pixels.",
             over ? &palette().warning : nullptr);
    endValues();
}

void memoryValues(const LodPanelInput& input, LodPanelCommands& commands, ViewSettings& settings) {
    const planet::PagingCounters& p = input.stats.paging;
    slider("Budget", settings.budgetMB, 16, 8192, "%d MiB",
           "Memory for resident chunks, CPU and GPU together. Smaller: coarser when it is full.",
           ImGuiSliderFlags_Logarithmic);
    if (ImGui::IsItemDeactivatedAfterEdit()) commands.applyPaging = true;
    const double used = static_cast<double>(p.residentBytesCpu + p.residentBytesGpu);
    const double budget = input.openBudgetMB * 1048576.0;
    usageBar(used / budget, fmt::format("{} of {}", bytesText(used), bytesText(budget)));
    tooltip("Resident chunks against the budget.");
    if (!beginValues("memory")) return;
    valueRow("On the CPU", bytesText(static_cast<double>(p.residentBytesCpu)),
             "Heights and nodes of resident chunks.");
    valueRow("On the GPU", bytesText(static_cast<double>(p.residentBytesGpu)),
             "Heights in the pool that hold a resident chunk.");
    valueRow("Resident chunks", countText(static_cast<double>(p.residentChunks)), "Loaded and drawable.");
    valueRow("Queue", fmt::format("{} + {}", p.queued, p.loading), "Blocks queued + being read or uploaded.");
    valueRow("Read", bytesText(static_cast<double>(p.bytesRead)), "From the file, since it was opened.");
    if (p.failed > 0)
        valueRow("Failed", countText(static_cast<double>(p.failed)),
                 "Blocks that could not be read; see the log.", &palette().bad);
    endValues();
}

void timeValues(const FrameStats& stats) {
    if (!beginValues("times")) return;
    valueRow("Upload", millisecondsText(stats.stages.uploadMs), "Making loaded chunks drawable.");
    valueRow("Select", millisecondsText(stats.stages.selectMs), "Choosing what to draw.");
    valueRow("Paging", millisecondsText(stats.stages.pagingMs), "Dropping chunks and asking for new ones.");
    valueRow("Draw, GPU", millisecondsText(stats.render.drawMs), "The planet on the GPU, by a timer query.");
    valueRow("Draw, CPU", millisecondsText(stats.drawCpuMs), "Making the planet's draw calls.");
    valueRow("Panels", millisecondsText(stats.panelsMs), "These panels.");
    const double perSecond = stats.frameMs > 0 ? 1000 / stats.frameMs : 0;
    valueRow("Frame", fmt::format("{} ({:.0f}/s)", millisecondsText(stats.frameMs), perSecond),
             "From one frame to the next, waiting for the monitor included.");
    endValues();
}

void cameraValues(const LodPanelInput& input, LodPanelCommands& commands) {
    if (!beginValues("camera")) return;
    valueRow("Place", placeText(input.camera.latitudeDeg, input.camera.longitudeDeg),
             "Latitude and longitude, degrees.");
    valueRow("Altitude", distanceText(input.camera.altitudeM), "Above the planet's radius.");
    valueRow("Above ground", distanceText(input.heightAboveGroundM), "Above the surface that is loaded.");
    valueRow("Heading, pitch",
             fmt::format("{:.0f}, {:.0f} deg", std::fmod(std::round(input.camera.headingDeg), 360.0),
                         input.camera.pitchDeg),
             "0 is north, 90 east; -90 looks straight down.");
    valueRow("Speed", fmt::format("x {:.3g}", input.speedFactor), "Of the keys W A S D; + and - change it.");
    endValues();
    if (ImGui::Button("Reset (F3)")) commands.resetCamera = true;
    tooltip("Back to where the session started.");
    ImGui::SameLine();
    if (ImGui::Button("Start here")) commands.keepCameraAsStart = true;
    tooltip("Sessions start at this place from now on.");
}

}  // namespace

LodPanelCommands lodPanel(const LodPanelInput& input, bool lodFrozen, ViewSettings& settings) {
    LodPanelCommands commands;
    if (section("Level of detail")) detailControls(commands, lodFrozen, settings);
    if (section("View")) viewControls(input, settings);
    if (!input.open) return commands;
    if (section("Drawn")) drawnValues(input.stats, settings.tauPx);
    if (section("Memory")) memoryValues(input, commands, settings);
    if (section("Times")) timeValues(input.stats);
    if (section("Camera")) cameraValues(input, commands);
    return commands;
}

}  // namespace ui
