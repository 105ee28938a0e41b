// Draws one panel into a PNG, without a window:
//     panel_picture FILE.chk PANEL WIDTHxHEIGHT OUT.png [light] [failing] [governed] [click=ITEM]
// To look at what a change does to a panel. PANEL is a key of app/settings/panel_list.h, as "quadtree"; with
// failing some blocks cannot be read, with governed τ follows budgets; ITEM is what ui/kit/item_map.h calls it, and is
// clicked before.
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cstdio>
#include <span>
#include <string_view>

#include "app/base/picture_file.h"
#include "planet/gl/device/offscreen_context.h"
#include "planet/gl/device/render_target.h"
#include "tests/support/editor_fixture.h"
#include "tests/support/temporary_folder.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace {

using namespace worldy;

const PanelInfo* panelNamed(std::string_view key) {
    for (const PanelInfo& info : panelInfos) {
        if (info.key == key) return &info;
    }
    return nullptr;
}

// Where an item lies whose name ends so; beside the panel where there is none.
ImVec2 middleOf(const std::vector<ui::ItemPlace>& items, std::string_view name) {
    for (const ui::ItemPlace& item : items) {
        if (!name.empty() && item.name.ends_with(name))
            return {item.rect.x + item.rect.width / 2, item.rect.y + item.rect.height / 2};
    }
    return {-1, -1};
}

void drawFrames(const ui::EditorView& view, const PanelInfo& panel, int width, int height,
                std::string_view clicked, ViewSettings settings) {
    std::vector<ui::ItemPlace> items;
    ui::PanelStates states;
    if (!view.settings.presets.empty()) states.presets.selected = view.settings.presets.front().name;
    ui::Commands commands;
    ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    // Some frames until what sizes itself has done so.
    for (int frame = 0; frame < 10; ++frame) {
        ImGui::GetIO().MousePos = frame < 7 ? middleOf(items, clicked) : ImVec2{-1, -1};
        ImGui::GetIO().MouseDown[0] = frame == 5;
        items.clear();
        ui::collectItems(&items);
        ImGui::GetIO().DeltaTime = 1.0f / 60;
        ImGui_ImplOpenGL3_NewFrame();
        ImGui::NewFrame();
        ui::beginFixedWindow("panel", {0, 0, static_cast<float>(width), static_cast<float>(height)});
        ui::drawPanel(panel.id, view, states, settings, commands);
        ImGui::End();
        ImGui::Render();
        ui::collectItems(nullptr);
    }
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

int run(int argumentCount, char** arguments) {
    const PanelInfo* panel = argumentCount > 4 ? panelNamed(arguments[2]) : nullptr;
    int width = 0, height = 0;
    if (!panel || std::sscanf(arguments[3], "%dx%d", &width, &height) != 2) {
        std::fputs(
            "panel_picture FILE.chk PANEL WIDTHxHEIGHT OUT.png [light] [failing] [governed] [click=ITEM]\n",
            stderr);
        return 2;
    }
    constexpr std::string_view click = "click=";
    bool light = false;
    std::string_view clicked;
    planet::PagingSettings paging;
    ViewSettings settings;
    for (const std::string_view extra :
         std::span(arguments + 5, static_cast<std::size_t>(argumentCount - 5))) {
        light |= extra == "light";
        if (extra == "failing") paging.badDisk.failureRate = 0.5;
        if (extra == "governed") settings.budget = {.gpuMs = 8, .triangles = 600'000, .memoryMB = 64};
        if (extra.starts_with(click)) clicked = extra.substr(click.size());
    }
    auto planet = planet::Planet::open(arguments[1], paging);
    auto context = planet::gl::OffscreenContext::create();
    auto target = context ? planet::gl::RenderTarget::create(width, height)
                          : planet::Result<planet::gl::RenderTarget>(tl::unexpected(context.error()));
    if (!planet || !target) {
        std::fputs((!planet ? planet.error() : target.error()).message.c_str(), stderr);
        return 2;
    }
    test::EditorFixture fixture(std::move(*planet));
    fixture.fly(settings, 120);
    const tests::TemporaryFolder folder;
    fixture.trace(folder / "made engine.lodtrace");
    fixture.log_.push_back({LogLevel::Info, "14:03:22", "Open: earth.chk, 5.1 MiB on disk, 7 levels"});
    fixture.log_.push_back(
        {LogLevel::Error, "14:03:25", "earth.chk: block of z_pos/3/1/2: checksum is wrong"});

    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplOpenGL3_Init("#version 330 core");
    ui::applyTheme(light ? Theme::Light : Theme::Dark, 1);
    target->bind();
    glViewport(0, 0, width, height);
    drawFrames(fixture.view(), *panel, width, height, clicked, settings);
    const auto written = writePicture({width, height, target->readRgb()}, arguments[4]);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
    return written ? 0 : 2;
}

}  // namespace

int main(int argumentCount, char** arguments) {
    return run(argumentCount, arguments);
}
