#include "ui/shell/note_pins.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/note_subjects.h"
#include "ui/shell/compare_overlay.h"

namespace worldy::ui {

namespace {

constexpr std::size_t pinLetters = 24;

// A pin in the window: its foot on the ground, and the box of its words.
struct Pin {
    const Note* note = nullptr;
    ImVec2 foot;
    Rect box;
    std::string words;
    bool isCovered = false;  // behind the drawn ground
    bool hasWords = true;    // false where they would cover another pin's, and behind the ground
};

bool overlap(const Rect& a, const Rect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// The box stays inside the picture, as far as there is room.
Pin pinAt(const Note& note, ImVec2 foot, const Rect& picture) {
    Pin pin{&note, foot, {}, inFont(firstWords(note, pinLetters))};
    const ImVec2 size = ImGui::CalcTextSize(pin.words.c_str());
    const float pad = std::round(ImGui::GetFontSize() * 0.3f);
    const float height = size.y + pad;
    pin.box = {foot.x - pad, foot.y - std::round(1.6f * ImGui::GetFontSize()) - height, size.x + 2 * pad,
               height};
    pin.box.x = std::max(std::min(pin.box.x, picture.x + picture.width - pin.box.width), picture.x);
    pin.box.y = std::max(pin.box.y, picture.y);
    return pin;
}

// Returns the pins in the picture. The words of the open note and of new notes have precedence. The unprojected cube has
// no places for them.
std::vector<Pin> pinsIn(const EditorView& view, const ViewSettings& settings, const Rect& viewport) {
    std::vector<Pin> pins;
    if (!view.planet || settings.overlay.cube || !settings.overlay.notes) return pins;
    const planet::View& picture = view.camera.renderView;
    const double radiusM = view.planet->tree().shape.radiusM;
    for (const ShownPart& one : shownParts(view.compare, settings.compare, viewport)) {
        if (one.isB) continue;
        const float scale = one.whole.width / static_cast<float>(std::max(picture.widthPx, 1));
        for (const Note& note : view.notes.notes) {
            const auto at =
                pinInPicture(picture, placeOfNote(note, radiusM, settings.surface.exaggeration), radiusM);
            if (!at) continue;
            const ImVec2 foot(one.whole.x + scale * static_cast<float>(at->x),
                              one.whole.y + scale * static_cast<float>(at->y));
            if (foot.x > one.part.x + one.part.width || foot.x < one.part.x) continue;
            pins.push_back(pinAt(note, foot, one.part));
            pins.back().isCovered =
                std::ranges::find(view.notes.covered, note.id) != view.notes.covered.end();
        }
    }
    std::stable_sort(pins.begin(), pins.end(), [&](const Pin& a, const Pin& b) {
        const bool aIsOpen = view.notes.open == a.note->id, bIsOpen = view.notes.open == b.note->id;
        return aIsOpen != bIsOpen ? aIsOpen : a.note->id > b.note->id;
    });
    std::vector<Rect> taken;
    for (Pin& pin : pins) {
        pin.hasWords = !pin.isCovered && std::none_of(taken.begin(), taken.end(), [&](const Rect& other) {
            return overlap(other, pin.box);
        });
        if (pin.hasWords) taken.push_back(pin.box);
    }
    return pins;
}

void drawPin(ImDrawList& list, const Pin& pin, bool isOpen) {
    constexpr float coveredAlpha = 0.4f;
    const ImU32 colour =
        packed(isOpen ? palette().warning : palette().accent, pin.isCovered ? coveredAlpha : 1);
    const float radius = std::round(ImGui::GetFontSize() * 0.28f);
    const float bottom = pin.box.y + pin.box.height;
    list.AddLine(pin.foot, {pin.foot.x, bottom}, colour, std::max(ImGui::GetFontSize() / 9, 1.0f));
    list.AddCircleFilled(pin.foot, radius * 0.7f, colour);
    if (!pin.hasWords) return list.AddCircleFilled({pin.foot.x, bottom}, radius, colour);
    const ImVec2 end(pin.box.x + pin.box.width, bottom);
    list.AddRectFilled({pin.box.x, pin.box.y}, end, boxColour(), radius);
    list.AddRect({pin.box.x, pin.box.y}, end, colour, radius);
    const float pad = std::round(ImGui::GetFontSize() * 0.3f);
    list.AddText({pin.box.x + pad, pin.box.y + pad / 2}, packed(palette().text), pin.words.c_str());
}

}  // namespace

void notePinItems(const EditorView& view, const ViewSettings& settings, const Rect& viewport,
                  Commands& commands) {
    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    for (const Pin& pin : pinsIn(view, settings, viewport)) {
        const float side = ImGui::GetFontSize();
        const Rect area =
            pin.hasWords ? pin.box : Rect{pin.foot.x - side / 2, pin.foot.y - 2 * side, side, 2 * side};
        ImGui::SetCursorScreenPos({area.x, area.y});
        const std::string id = fmt::format("note {}", pin.note->id);
        if (ImGui::InvisibleButton(id.c_str(), {area.width, area.height}))
            commands.emplace_back(OpenNote{pin.note->id});
        noteItem(id);
        tooltip([&] { return pin.note->text + (pin.isCovered ? "\n\nBehind the ground." : ""); });
    }
    ImGui::SetCursorScreenPos(cursor);
}

void drawNotePins(const EditorView& view, const ViewSettings& settings, const Rect& viewport) {
    std::vector<Pin> pins = pinsIn(view, settings, viewport);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::PushClipRect({viewport.x, viewport.y}, {viewport.x + viewport.width, viewport.y + viewport.height},
                        true);
    // The first pins lie on top.
    for (auto pin = pins.rbegin(); pin != pins.rend(); ++pin)
        drawPin(list, *pin, view.notes.open == pin->note->id);
    ImGui::PopClipRect();
}

}  // namespace worldy::ui
