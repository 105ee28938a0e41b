#include "ui/panels/bake/source_preview_box.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

constexpr double previewAfterS = 0.15;  // since the last change
constexpr int zoomStepLog2 = 2;
constexpr int mostZoomLog2 = 14;

bool samePicture(const PreviewRequest& a, const PreviewRequest& b) {
    return a.source == b.source && a.radiusM == b.radiusM && a.face == b.face && a.zoomLog2 == b.zoomLog2 &&
           a.u == b.u && a.v == b.v;
}

void ask(const EditorView& view, const PreviewRequest& wanted, PreviewBoxState& state, Commands& commands) {
    if (!state.wanted || !samePicture(*state.wanted, wanted)) {
        state.wanted = wanted;
        state.askAtS = view.frames.timeS + previewAfterS;
        state.asked = false;
    }
    if (state.asked || view.frames.timeS < state.askAtS) return;
    state.asked = true;
    commands.push_back(PreviewSource{wanted});
}

// Sets centre and zoom, clamped so that the shown square lies on the face.
void showAt(PreviewBoxState& state, double u, double v, int zoomLog2) {
    state.zoomLog2 = std::clamp(zoomLog2, 0, mostZoomLog2);
    const double room = 1 - std::ldexp(1.0, -state.zoomLog2);
    state.u = std::clamp(u, -room, room);
    state.v = std::clamp(v, -room, room);
}

void faceControl(PreviewBoxState& state) {
    constexpr const char* explanation =
        "Cube face to preview. The centre of +x is latitude 0, longitude 0; +y is 90° E; +z is the north "
        "pole.";
    int index = static_cast<int>(state.face);
    labelledControl("Face", explanation);
    const bool changed =
        combo("Face", index, "+x, 0°\0-x, 180°\0+y, 90° E\0-y, 90° W\0+z, north\0-z, south\0");
    tooltip(explanation);
    if (!changed) return;
    state.face = static_cast<planet::Face>(index);
    showAt(state, 0, 0, 0);
}

void pictureOf(const SourcePreview& preview, PreviewBoxState& state) {
    const float side = std::min(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 20);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("preview", {side, side},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    noteItem("Preview");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 to{from.x + side, from.y + side};
    list.AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_FrameBg));
    if (preview.texture) list.AddImage(preview.texture, from, to);
    const bool stale = !preview.shown || !state.wanted || !samePicture(*preview.shown, *state.wanted);
    const float margin = ImGui::GetFontSize() / 2;
    if (stale) badge(list, {from.x + margin, from.y + margin}, "Rendering...", palette().text);
    tooltip(
        "Shaded relief of the source, lit from the upper left with exaggerated slopes; heights below 0 m are "
        "blue. Click to zoom in four times around the pointer; right-click to zoom out four times. Detail "
        "finer than a pixel is filtered out, as in a bake.");
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double half = std::ldexp(1.0, -state.zoomLog2);
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
        showAt(state, state.u, state.v, state.zoomLog2 - zoomStepLog2);
    } else if (ImGui::IsItemClicked(ImGuiMouseButton_Left)) {
        const double along = static_cast<double>((mouse.x - from.x) / side) * 2 - 1;
        const double up = 1 - static_cast<double>((mouse.y - from.y) / side) * 2;
        showAt(state, state.u + half * along, state.v + half * up, state.zoomLog2 + zoomStepLog2);
    }
}

void captionOf(const SourcePreview& preview, PreviewBoxState& state) {
    if (preview.shown) {
        const double acrossM =
            preview.shown->radiusM * std::numbers::pi / 2 * std::ldexp(1.0, -preview.shown->zoomLog2);
        const std::string text = fmt::format("{:.0f} to {:.0f} m, {} across, {}", preview.lowM, preview.highM,
                                             distanceText(acrossM), durationText(preview.seconds));
        wrappedText(text, palette().dim);
        tooltip(
            "Minimum and maximum height in the picture, its width along the middle, and the rendering time.");
    }
    if (state.zoomLog2 > 0 && button("Whole face", "Shows the whole face.")) showAt(state, 0, 0, 0);
}

}  // namespace

void sourcePreviewBox(const EditorView& view, const BakeRequest& request, bool good, PreviewBoxState& state,
                      Commands& commands) {
    ImGui::SetNextItemOpen(state.open);
    state.open = ImGui::CollapsingHeader("Preview");
    noteItem("Preview of the source");
    tooltip("Preview of the terrain to be baked; it updates when a setting changes.");
    if (!state.open) return;
    if (!good) {
        wrappedText("No source to preview.", palette().dim);
        return;
    }
    faceControl(state);
    pictureOf(view.bake.preview, state);
    captionOf(view.bake.preview, state);
    if (!view.bake.preview.problem.empty()) wrappedText(view.bake.preview.problem, palette().bad);
    ask(view,
        {request.source, request.sourceSettings, request.settings.radiusM, state.face, state.zoomLog2,
         state.u, state.v},
        state, commands);
}

}  // namespace worldy::ui
