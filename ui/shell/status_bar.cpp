#include "ui/shell/status_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/camera_heights.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

// Cells side by side, each as wide as its text, the most important first. The first that does not fit and all
// after it are left out.
class Cells {
public:
    explicit Cells(const Rect& rect) : end_(rect.x + rect.width) {}

    void add(const std::string& text, const char* explanation, const ImVec4& colour) {
        const float gap = ImGui::GetFontSize() * 1.2f;
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        if (full_) return;
        if (!first_) {
            full_ = ImGui::GetItemRectMax().x + gap + width > end_;
            if (full_) return;
            ImGui::SameLine(0, gap);
        }
        first_ = false;
        ImGui::PushStyleColor(ImGuiCol_Text, colour);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopStyleColor();
        tooltip(explanation);
    }

private:
    float end_;
    bool first_ = true;
    bool full_ = false;
};

std::string shortened(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t start = text.size() - most;
    while (start < text.size() && (static_cast<unsigned char>(text[start]) & 0xC0u) == 0x80u) ++start;
    return "..." + text.substr(start);
}

void planetCells(const EditorView& view, const ViewSettings& settings, Cells& cells) {
    const Palette& colours = palette();
    const planet::PagingCounters& paging = view.frames.stats.paging;
    const planet::CameraPose& pose = view.camera.pose;
    cells.add(placeText(pose.latitudeDeg, pose.longitudeDeg), "Camera position: latitude, longitude.",
              colours.text);
    const std::vector<NamedHeight> heights = namedHeights(cameraHeights(view, settings));
    const auto addHeight = [&](const NamedHeight& height) {
        cells.add(distanceText(height.heightM) + " " + height.name, height.explanation, colours.text);
    };
    addHeight(heights.front());
    if (view.pointedM) {
        const planet::Geographic place = planet::geographicFromDirection(*view.pointedM);
        const double heightM = glm::length(*view.pointedM) - view.planet->tree().shape.radiusM;
        cells.add(fmt::format("pointer {} {:.1f} m",
                              placeText(glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad)),
                              heightM),
                  "The drawn ground under the pointer: latitude, longitude, height.", colours.text);
    }
    const double perSecond = view.frames.stats.frameMs > 0 ? 1000 / view.frames.stats.frameMs : 0;
    cells.add(fmt::format("{:.1f} ms  {:.0f} FPS", view.frames.stats.frameMs, perSecond),
              "Frame time and frame rate, including the wait for the monitor.", colours.text);
    const std::uint32_t waiting = paging.queued + paging.loading;
    cells.add(fmt::format("queue {}", waiting), "Blocks queued, being read or waiting for upload.",
              waiting > 0 ? colours.good : colours.dim);
    cells.add("chunks " + bytesText(static_cast<double>(paging.residentBytesCpu + paging.residentBytesGpu)),
              "Memory of resident chunks, CPU and GPU together. Excludes colour and normal tiles.",
              colours.text);
    for (std::size_t i = 1; i < heights.size(); ++i) addHeight(heights[i]);
}

// Adds "1 error", or nothing if there are none.
void addLogCell(const std::deque<LogLine>& log, LogLevel level, const char* name, const ImVec4& colour,
                Cells& cells) {
    const auto count = static_cast<std::uint64_t>(
        std::count_if(log.begin(), log.end(), [&](const LogLine& line) { return line.level == level; }));
    if (count == 0) return;
    cells.add(countedText(count, name), withKey("See the Log panel.", "panel_log").c_str(), colour);
    noteItem(name);
}

void warningCells(const EditorView& view, Cells& cells) {
    const Palette& colours = palette();
    if (view.data.isFirstLook) {
        cells.add(
            "coarse first look",
            view.bake.running
                ? "This planet is a coarse bake, so that something is shown soon. The whole bake takes its "
                  "place when it is done."
                : "This planet is a coarse bake. The whole bake was stopped: bake again in the Bake panel.",
            colours.warning);
    }
    const planet::PagingCounters& paging = view.frames.stats.paging;
    if (paging.failedPermanently() > 0) {
        cells.add(fmt::format("{} failed", paging.failedPermanently()),
                  "Blocks that could not be read: see the Failed tab of the Paging panel, and the Log panel.",
                  colours.bad);
    }
    if (paging.awaitingRetry() > 0) {
        cells.add(
            fmt::format("{} retrying", paging.awaitingRetry()),
            "Blocks that could not be read and will be retried: see the Failed tab of the Paging panel.",
            colours.warning);
    }
    if (paging[planet::BlockKind::Heights].budgetWaits > 0) {
        cells.add("budget full", "The chunks requested by this view exceed the budget. See the Paging panel.",
                  colours.warning);
    }
    if (view.bake.running) {
        const planet::BakeProgress& progress = view.bake.progress.bake;
        const double total = std::max(static_cast<double>(progress.samplesTotal), 1.0);
        cells.add(fmt::format("baking {:.0f} %", 100 * static_cast<double>(progress.samplesDone) / total),
                  "See the Bake panel.", colours.good);
    }
    addLogCell(view.log, LogLevel::Error, "error", colours.bad, cells);
    addLogCell(view.log, LogLevel::Warning, "warning", colours.warning, cells);
}

}  // namespace

float statusBarHeight() {
    return std::round(ImGui::GetFontSize() * 1.65f);
}

void statusBar(const EditorView& view, const ViewSettings& settings, const Rect& rect) {
    const float pad = std::round((rect.height - ImGui::GetFontSize()) / 2);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ImGui::GetFontSize() * 0.7f, pad});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
    beginFixedWindow("status bar", rect, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoNav);
    setItemScope("status");
    Cells cells(rect);
    cells.add(view.data.name.empty() ? "no planet open" : shortened(view.data.name, 32),
              view.data.chunkFile.string().c_str(), palette().accent);
    // Warnings come first, because a narrow window leaves out cells on the right.
    warningCells(view, cells);
    if (view.planet) planetCells(view, settings, cells);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

}  // namespace worldy::ui
