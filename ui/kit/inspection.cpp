#include "ui/kit/inspection.h"

#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

InspectPlace inspectionOf(const planet::View& lodView, const planet::View& measured, const glm::dvec3& placeM,
                          double radiusM) {
    // A place beyond the measured view's horizon is seen from above that place.
    constexpr double leastSine = 0.15;
    const glm::dvec3 up = glm::normalize(placeM);
    const glm::dvec3 toEye = measured.eyeM - placeM;
    planet::View near = measured;
    near.back = glm::normalize(toEye);
    const double sine = glm::dot(near.back, up);
    if (sine < leastSine) {
        const glm::dvec3 level = near.back - sine * up;
        const glm::dvec3 heading = glm::length(level) > 1e-6 ? glm::normalize(level) : measured.right;
        near.back = glm::normalize(leastSine * up + std::sqrt(1 - leastSine * leastSine) * heading);
    }
    near.eyeM = placeM + 0.35 * glm::length(toEye) * near.back;
    const glm::dvec3 aside = glm::cross(glm::normalize(near.eyeM), near.back);
    if (glm::length(aside) > 1e-3) near.right = glm::normalize(aside);
    near.up = glm::normalize(glm::cross(near.back, near.right));
    near.right = glm::cross(near.up, near.back);
    return {lodView, planet::poseFromView(near, radiusM)};
}

void inspectButton(const planet::View& lodView, const planet::View& measured, const planet::ChunkId& chunk,
                   const glm::dvec3& placeM, double radiusM, Commands& commands) {
    if (ImGui::SmallButton("Go")) {
        commands.push_back(SelectChunk{chunk});
        commands.push_back(inspectionOf(lodView, measured, placeM, radiusM));
    }
    noteItem("Go");
    tooltip(
        "Moves the camera near the place, selects the chunk, and freezes LOD as measured. A button in the "
        "viewport goes back.");
}

void inspectionNotice(const EditorView& view, const Rect& viewport, Commands& commands) {
    const float line = ImGui::GetFontSize();
    // The notice stands above the line of mouse and key hints.
    ImGui::SetNextWindowPos({viewport.x + viewport.width / 2, viewport.y + viewport.height - 3.2f * line},
                            ImGuiCond_Always, {0.5f, 1});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.8f * line, 0.5f * line});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette().box);
    ImGui::Begin("inspection", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    setItemScope("inspection");
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(palette().warning, "%s",
                       view.recording.replay ? "Replay paused at the place" : "LOD frozen as measured");
    ImGui::SameLine();
    if (button("Back", view.recording.replay
                           ? "Moves the camera back, and resumes the replay if it was playing."
                           : "Moves the camera back, and unfreezes LOD if it was not frozen before."))
        commands.push_back(EndInspection{});
    if (!view.recording.replay) {
        ImGui::SameLine();
        if (button("Unfreeze here",
                   withKey("Keeps the camera here. LOD follows it from now on.", "freeze_lod").c_str()))
            commands.push_back(FreezeLod{false});
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

}  // namespace worldy::ui
