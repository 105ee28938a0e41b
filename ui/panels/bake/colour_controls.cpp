#include "ui/panels/bake/colour_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/data/own_colour.h"
#include "planet/source/height_source.h"
#include "planet/source/terrain.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

namespace fs = std::filesystem;
using From = ColourEdit::From;

std::string problemOf(const ColourEdit& edit, const fs::path& source, const fs::path& image) {
    if (edit.from == From::None) return {};
    // Procedural terrain has no file that an image could lie beside.
    if (edit.from == From::Own && image.empty() && planet::isTerrainText(source)) return {};
    if (edit.from == From::Own && image.empty())
        return "There is no colour.jpg or colour.png beside the source; the file will have no colours.";
    if (image.empty()) return "Enter the path of the image.";
    return planet::heightSourceExists(image)
               ? std::string()
               : fmt::format("{}: no such image or cube faces.", image.string());
}

void setImageText(const fs::path& image, ColourEdit& edit) {
    const std::string text = image.string();
    edit.imageText.fill(0);
    std::copy_n(text.begin(), std::min(text.size(), edit.imageText.size() - 1), edit.imageText.begin());
}

void apply(BakeRequest& request, ColourEdit& edit) {
    const fs::path before = request.colour;
    switch (edit.from) {
        case From::None:
            request.colour.clear();
            break;
        case From::Own:
            request.colour = ownColourImage(request.source);
            break;
        case From::Image:
            request.colour = edit.imageText.data();
            break;
    }
    // The old image's size does not apply to the new one.
    if (request.colour != before && !before.empty()) request.settings.colour.faceSize.reset();
    edit.problem = problemOf(edit, request.source, request.colour);
}

bool fromControl(const BakeRequest& current, const BakeRequest& request, ColourEdit& edit) {
    constexpr const char* explanation =
        "Colours baked into the file as a second quadtree of tiles and streamed with the heights. The "
        "source's own: colour.jpg or colour.png beside the source. None: the ground is coloured by an "
        "overlaid image or by height.";
    litLabel("Colours", request.colour != current.colour, explanation);
    int index = static_cast<int>(edit.from);
    const bool changed = combo("Colours", index, "none\0the source's own\0another image\0");
    tooltip(explanation);
    edit.from = static_cast<From>(index);
    return changed;
}

bool imageControl(ColourEdit& edit, Commands& commands) {
    constexpr const char* explanation =
        "Path of an equirectangular image of the whole planet (2:1), of one of six cube faces, or of their "
        "common stem; grey or RGB, any size. You can also drop a file here.";
    labelledControl("Image", explanation);
    const char* choose = "Choose###choose colours";
    const float room = ImGui::CalcTextSize("Choose").x + 3 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(std::max(ImGui::GetFontSize() * 3, ImGui::GetContentRegionAvail().x - room));
    const bool changed = ImGui::InputTextWithHint("##colour image", "Image or cube faces",
                                                  edit.imageText.data(), edit.imageText.size());
    noteItem("Image");
    tooltip(edit.imageText[0] == 0 ? explanation
                                   : fmt::format("{}\n\n{}", edit.imageText.data(), explanation).c_str());
    ImGui::SameLine(0, ImGui::GetStyle().FramePadding.x);
    if (ImGui::Button(choose)) commands.push_back(AskForFile{FilePurpose::BakedColours});
    noteItem("Choose");
    tooltip("Opens a file dialog.");
    return changed;
}

std::string texelsText(int texels) {
    return fmt::format("{} texels", texels);
}

bool faceSizeControl(const BakeRequest& current, planet::ColourBakeSettings& colour) {
    constexpr const char* explanation =
        "Colour texels along a side of each of the six faces, 256 * 2^n + 1. Natural: the smallest size that "
        "keeps all detail of the image. Smaller: blurred colours and a smaller file. Larger: a bigger file "
        "without more detail.";
    litLabel("Colour face", colour.faceSize != current.settings.colour.faceSize, explanation);
    const bool open = ImGui::BeginCombo("##colour face",
                                        colour.faceSize ? texelsText(*colour.faceSize).c_str() : "natural");
    if (!open) noteItem("Colour face");
    tooltip(explanation);
    if (!open) return false;
    bool changed = ImGui::Selectable("natural", !colour.faceSize);
    noteItem("Colour face: natural");
    if (changed) colour.faceSize.reset();
    for (int level = 0; level <= planet::maxColourLevel; ++level) {
        const int texels = (planet::colourTileCells << level) + 1;
        const bool chosen = ImGui::Selectable(texelsText(texels).c_str(), colour.faceSize == texels);
        noteItem("Colour face: " + texelsText(texels));
        if (!chosen) continue;
        colour.faceSize = texels;
        changed = true;
    }
    ImGui::EndCombo();
    return changed;
}

bool formatControl(const BakeRequest& current, planet::ColourBakeSettings& colour) {
    constexpr const char* explanation =
        "BC1: GPU-compressed, 0.5 bytes per texel, with slight block artefacts in smooth gradients. "
        "Lossless: exact colours, 3 bytes per texel, so only a sixth as many tiles fit into the budget.";
    litLabel("Colour format", colour.format != current.settings.colour.format, explanation);
    int index = static_cast<int>(colour.format);
    const bool changed = combo("Colour format", index, "BC1\0lossless\0");
    tooltip(explanation);
    colour.format = static_cast<planet::ColourFormat>(index);
    return changed;
}

// Takes a file from the dialog or a drop. Returns true if there was one.
bool takeChosen(ColourEdit& edit) {
    if (edit.chosen.empty()) return false;
    edit.from = From::Image;
    setImageText(std::exchange(edit.chosen, {}), edit);
    return true;
}

}  // namespace

void setColour(const BakeRequest& request, ColourEdit& edit) {
    const fs::path own = ownColourImage(request.source);
    edit.from = request.colour.empty() ? From::None : request.colour == own ? From::Own : From::Image;
    if (edit.from == From::Image) setImageText(request.colour, edit);
    edit.problem = problemOf(edit, request.source, request.colour);
}

void followSource(BakeRequest& request, ColourEdit& edit) {
    if (edit.from == From::Own) apply(request, edit);
}

bool colourControls(const EditorView& view, ColourEdit& edit, BakeRequest& request, Commands& commands) {
    ImGui::BeginGroup();
    bool imageChanged = takeChosen(edit);
    imageChanged |= fromControl(view.bake.current, request, edit);
    if (edit.from == From::Image) imageChanged |= imageControl(edit, commands);
    if (imageChanged) apply(request, edit);
    bool changed = imageChanged;
    if (!request.colour.empty()) {
        changed |= faceSizeControl(view.bake.current, request.settings.colour);
        changed |= formatControl(view.bake.current, request.settings.colour);
    }
    if (!edit.problem.empty()) wrappedText(edit.problem, palette().warning);
    if (request.colour.empty() && !view.bake.lostColours.empty() && edit.from == From::None) {
        wrappedText(fmt::format("The colours of the open file come from {}, whose path is unknown. Choose it "
                                "as another image; otherwise the new file has no colours.",
                                view.bake.lostColours),
                    palette().warning);
    }
    ImGui::EndGroup();
    edit.takesDrops = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem |
                                           ImGuiHoveredFlags_AllowWhenDisabled);
    return changed;
}

std::string colourText(const planet::ColourBakeSettings& colour) {
    return fmt::format("{}, {}", colour.faceSize ? texelsText(*colour.faceSize) : "natural",
                       colour.format == planet::ColourFormat::Bc1 ? "BC1" : "lossless");
}

}  // namespace worldy::ui
