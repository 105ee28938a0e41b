// ImGui without a window, for tests that draw panels and press their controls with a mouse of their own.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/commands.h"

namespace worldy::ui {

// One at a time, as it holds ImGui's context. The mouse lies beside the panel until it is moved.
class PanelWindow {
public:
    explicit PanelWindow(ImVec2 size) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DeltaTime = 1.0f / 60;
        applyTheme(Theme::Dark, 1);
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
        resize(size);
        movePointer({-1, -1});
    }
    ~PanelWindow() {
        collectItems(nullptr);
        ImGui::DestroyContext();
    }
    PanelWindow(const PanelWindow&) = delete;
    PanelWindow& operator=(const PanelWindow&) = delete;

    static void resize(ImVec2 size) { ImGui::GetIO().DisplaySize = size; }
    static void movePointer(ImVec2 to) { ImGui::GetIO().MousePos = to; }
    static void press(bool down) { ImGui::GetIO().MouseDown[0] = down; }

    // One frame of a panel that fills the window.
    template <class Draw>
    void frame(const Draw& draw) {
        items_.clear();
        collectItems(&items_);
        ImGui::NewFrame();
        const ImVec2 size = ImGui::GetIO().DisplaySize;
        beginFixedWindow("panel", {0, 0, size.x, size.y});
        draw();
        ImGui::End();
        ImGui::Render();
        collectItems(nullptr);
    }

    // Of the frame before, the first whose name ends so; null if there is none.
    const ItemPlace* find(std::string_view name) const {
        const auto item = std::find_if(items_.begin(), items_.end(),
                                       [&](const ItemPlace& i) { return i.name.ends_with(name); });
        return item == items_.end() ? nullptr : &*item;
    }
    bool isShown(std::string_view name) const { return find(name) != nullptr; }

    // Points at a share of an item's width, lets the button go down and up, and calls for a frame after each.
    // The pointer stays there.
    void click(std::string_view name, float share, const std::function<void()>& drawFrame) const {
        const ItemPlace* item = find(name);
        if (!item) {
            ADD_FAILURE() << name << " is not there";
            return;
        }
        movePointer({item->rect.x + share * item->rect.width, item->rect.y + item->rect.height / 2});
        for (const bool down : {false, true, false}) {
            press(down);
            drawFrame();
        }
    }

    // Points at an item and returns whether its tooltip says why it is grey.
    bool saysWhy(std::string_view name, const std::function<void()>& drawFrame) const {
        drawFrame();
        const ItemPlace item = *find(name);
        movePointer({item.rect.x + 2, item.rect.y + 2});
        for (int i = 0; i < 3; ++i) drawFrame();
        return isShown("Why grey");
    }

private:
    std::vector<ItemPlace> items_;
};

// Adds what a frame asked for, except for marking the chunk or the place that the pointer rests on.
inline void addAsked(Commands frame, Commands& all) {
    for (Command& command : frame) {
        if (!command.as<HoverChunk>() && !command.as<HoverProfile>()) all.push_back(std::move(command));
    }
}

}  // namespace worldy::ui
