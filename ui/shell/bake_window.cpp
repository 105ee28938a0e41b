#include "ui/shell/bake_window.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/base/text.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

void progressLines(const planet::BakeProgress& progress) {
    const double total = std::max(static_cast<double>(progress.samplesTotal), 1.0);
    const double share = static_cast<double>(progress.samplesDone) / total;
    ImGui::ProgressBar(static_cast<float>(share), {-1, 0}, fmt::format("{:.0f} %", 100 * share).c_str());
    if (!beginValues("bake")) return;
    valueRow("Samples",
             fmt::format("{} of {}", countText(static_cast<double>(progress.samplesDone)), countText(total)),
             "Finest-level height samples and colour texels.");
    valueRow("Rate", fmt::format("{} samples/s", countText(progress.samplesPerS)),
             "Mean rate since the bake began.");
    valueRow("Time left", progress.samplesDone == 0 ? "..." : durationText(progress.remainingS),
             "Estimated from the current rate.");
    endValues();
}

}  // namespace

BakeWindowCommands bakeWindow(const BakeWindowInput& input, const Rect& within) {
    BakeWindowCommands commands;
    const float width = std::min(ImGui::GetFontSize() * 28, within.width * 0.9f);
    ImGui::SetNextWindowPos({within.x + within.width / 2, within.y + within.height / 2}, ImGuiCond_Always,
                            {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ImGui::GetStyle().PopupRounding);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ImGui::GetFontSize(), ImGui::GetFontSize()});
    ImGui::Begin("Bake", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(input.problem.empty() ? fmt::format("Baking {}", input.source).c_str()
                                                 : fmt::format("{} cannot be shown", input.source).c_str());
    if (input.problem.empty()) {
        ImGui::TextDisabled("This is needed only once; the result is cached.");
        progressLines(input.progress);
        if (ImGui::Button(input.stopping ? "Stopping..." : "Cancel") && !input.stopping)
            commands.cancel = true;
    } else {
        ImGui::TextColored(palette().bad, "%s", input.problem.c_str());
        if (input.canBake && ImGui::Button("Bake again")) commands.bakeAgain = true;
    }
    ImGui::PopTextWrapPos();
    ImGui::End();
    ImGui::PopStyleVar(3);
    ImGui::PopStyleColor();
    return commands;
}

}  // namespace worldy::ui
