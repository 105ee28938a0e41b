#include "ui/kit/plot_keys.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>

namespace worldy::ui {

namespace {

int zoomKeysFrame = -2;  // ImGui's count of frames
int shownFocusFrame = -2;

struct {
    ImGuiID item = 0;
    std::size_t fromNewest = 0;
    int frame = -2;
} keptCursor;

bool isRecent(int frame) {
    const int ago = ImGui::GetFrameCount() - frame;
    return ago == 0 || ago == 1;
}

bool wasPressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

bool isDown(ImGuiKey key) {
    return ImGui::IsKeyDown(ImGui::GetKeyIndex(key));
}

int difference(ImGuiKey more, ImGuiKey less) {
    return static_cast<int>(wasPressed(more)) - static_cast<int>(wasPressed(less));
}

// ImGui would move its focus by the same keys. It repeats held keys at another rate, so this asks whether they are down.
void keepFocus(PlotReads reads) {
    constexpr std::array keys = {ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_Home,
                                 ImGuiKey_End,       ImGuiKey_PageUp,     ImGuiKey_PageDown};
    bool isUsed = reads == PlotReads::View && (isDown(ImGuiKey_UpArrow) || isDown(ImGuiKey_DownArrow));
    for (const ImGuiKey key : keys) isUsed |= isDown(key);
    if (!isUsed) return;
    ImGuiContext& g = *ImGui::GetCurrentContext();
    ImGui::NavMoveRequestCancel();
    g.NavDisableHighlight = false;
    g.NavDisableMouseHover = true;
}

// ImGui 1.86 lets Tab go on from an active item only, and a plot is none: otherwise it begins at the first field again.
void goOnByTab() {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    const bool isTab = g.NavMoveSubmitted && (g.NavMoveFlags & ImGuiNavMoveFlags_Tabbing) != 0;
    if (!isTab || g.NavTabbingDir != 0) return;
    g.NavTabbingDir = 1;
    g.NavTabbingCounter = 1;  // The next field or plot is the one.
    g.NavMoveScoringItems = true;
    g.NavAnyRequest = true;
}

}  // namespace

// Keys are read as characters, since + and - are elsewhere on other keyboards.
int typedSteps() {
    int steps = 0;
    for (const ImWchar letter : ImGui::GetIO().InputQueueCharacters) {
        if (letter == '+' || letter == '=') ++steps;
        if (letter == '-') --steps;
    }
    return steps;
}

void plotItem(const char* id, ImVec2 size, ImGuiButtonFlags flags) {
    ImGui::PushItemFlag(ImGuiItemFlags_Inputable, true);
    ImGui::InvisibleButton(id, size, flags);
    ImGui::PopItemFlag();
    ImGuiContext& g = *ImGui::GetCurrentContext();
    if (g.ActiveId != 0 && g.ActiveId == g.LastItemData.ID && g.ActiveIdSource == ImGuiInputSource_Nav)
        ImGui::ClearActiveID();  // A key must not look like a click at the place of the pointer.
    if (g.NavId != g.LastItemData.ID) return;
    goOnByTab();
    // Tab asks for text input in the item that it reaches, as Enter does.
    if (g.NavActivateInputId == g.NavId &&
        (g.NavActivateFlags & ImGuiActivateFlags_TryToPreserveState) != 0) {
        g.NavActivateInputId = 0;
        g.NavDisableHighlight = false;
        g.NavDisableMouseHover = true;
    }
    ImGui::RenderNavHighlight(g.LastItemData.Rect, g.NavId);
}

bool plotIsHovered() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    return ImGui::IsItemHovered() && (g.NavDisableHighlight || !g.NavDisableMouseHover);
}

PlotKeys takePlotKeys(PlotReads reads) {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    const ImGuiIO& io = ImGui::GetIO();
    const ImGuiID id = g.LastItemData.ID;
    if (!ImGui::IsItemFocused() || io.WantTextInput) return {};
    PlotKeys keys{.acts = g.NavActivateId == id || g.NavActivateInputId == id, .withShift = io.KeyShift};
    if (keys.acts) g.NavActivateInputId = 0;  // or followFocus() would press the plot once more
    if (!io.KeyCtrl && !io.KeyAlt) {
        keepFocus(reads);
        keys.right = difference(ImGuiKey_RightArrow, ImGuiKey_LeftArrow);
        keys.pagesDown = difference(ImGuiKey_PageDown, ImGuiKey_PageUp);
        keys.toFirst = wasPressed(ImGuiKey_Home);
        keys.toLast = wasPressed(ImGuiKey_End);
        if (reads == PlotReads::View) {
            keys.up = difference(ImGuiKey_UpArrow, ImGuiKey_DownArrow);
            keys.zoomIn = typedSteps();
            zoomKeysFrame = ImGui::GetFrameCount();
        }
    }
    if (!g.NavDisableHighlight) shownFocusFrame = ImGui::GetFrameCount();
    return keys;
}

bool plotTakesKeys() {
    return isRecent(zoomKeysFrame);
}

bool plotShowsFocus() {
    return isRecent(shownFocusFrame);
}

bool plotHasKeyboard() {
    return ImGui::IsItemFocused() && !ImGui::GetCurrentContext()->NavDisableHighlight && !plotIsHovered();
}

PlotCursor plotCursor(std::size_t count) {
    const PlotKeys keys = takePlotKeys(PlotReads::Samples);
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    if (!ImGui::IsItemFocused() || g.NavDisableHighlight || count == 0) return {};
    if (keptCursor.item != g.LastItemData.ID || !isRecent(keptCursor.frame)) keptCursor = {g.LastItemData.ID};
    keptCursor.frame = ImGui::GetFrameCount();
    const std::size_t before = count - 1 - std::min(keptCursor.fromNewest, count - 1);
    const std::size_t at = movedCursor(before, count, keys);
    keptCursor.fromNewest = count - 1 - at;
    if (plotIsHovered()) return {};
    return {at, keys.acts};
}

void beginSampleTooltip(const PlotCursor& cursor, float x, const char* keys) {
    if (cursor.at) {
        const ImRect& item = ImGui::GetCurrentContext()->LastItemData.Rect;
        const ImVec2 screen = ImGui::GetIO().DisplaySize;
        const float gap = ImGui::GetFontSize() / 2;
        // The tooltip lies above the plot, or below it if there is no room.
        const bool isAbove = item.Min.y > 10 * ImGui::GetTextLineHeightWithSpacing();
        const float y = isAbove ? item.Min.y - gap : item.Max.y + gap;
        ImGui::SetNextWindowPos({x, y}, ImGuiCond_Always,
                                {x > screen.x / 2 ? 1.0f : 0.0f, isAbove ? 1.0f : 0.0f});
    }
    ImGui::BeginTooltip();
    if (cursor.at) ImGui::TextDisabled("%s", keys);
}

}  // namespace worldy::ui
