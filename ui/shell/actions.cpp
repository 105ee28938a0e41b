#include "ui/shell/actions.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "app/base/text.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/plot_keys.h"
#include "ui/model/docking.h"
#include "ui/model/font_symbols.h"
#include "ui/model/key_names.h"
#include "ui/model/picked_point.h"
#include "ui/shell/focus.h"
#include "ui/shell/text_scale.h"

namespace worldy::ui {

namespace {

using Context = ActionContext;
using List = std::vector<Action>;

template <class Enum>
void advance(Enum& value, int count) {
    value = static_cast<Enum>((static_cast<int>(value) + 1) % count);
}

// Returns an action that sends a command.
template <class Kind>
auto sends(const Kind& command) {
    return [command](const Context& c) { c.commands.push_back(command); };
}

std::string unless(bool holds, const char* why) {
    return holds ? "" : why;
}

std::string needsPlanet(const Context& c) {
    return unless(c.view.planet, "No planet is open.");
}

// ---- File ----

std::vector<ActionChoice> recentFiles(const Context& c) {
    std::vector<ActionChoice> choices;
    for (const std::filesystem::path& file : c.view.data.recent)
        choices.push_back({file.string(), "", [file](Commands& to) { to.push_back(OpenFile{file}); }});
    return choices;
}

void addFile(List& list) {
    list.push_back({.id = "open",
                    .name = "Open...",
                    .help = "Opens a file: a planet, a picture, settings, a flight or a trace.",
                    .menu = Menu::File,
                    .keys = {"Ctrl+O"},
                    .act = sends(AskForFile{})});
    list.push_back(
        {.id = "open_recent",
         .name = "Open recent",
         .help = "Opens a file that was open before.",
         .menu = Menu::File,
         .whyNot = [](const Context& c) { return unless(!c.view.data.recent.empty(), "No recent files."); },
         .choices = recentFiles,
         .choiceKind = PaletteKind::File});
    list.push_back({.id = "attach",
                    .name = "Attach to an engine...",
                    .help = "Shows the Trace panel, which attaches to a running engine.",
                    .menu = Menu::File,
                    .act = [](const Context& c) { showPanel(PanelId::Trace, c.workspace); }});
    list.push_back({.id = "compare_trace",
                    .name = "Compare the trace with...",
                    .help = "Asks for a second trace of the same flight, and compares the open trace with it "
                            "frame by frame.",
                    .menu = Menu::File,
                    .act = sends(AskForFile{FilePurpose::TraceB}),
                    .whyNot = [](const Context& c) {
                        if (c.view.trace.file.empty()) return std::string("No trace is open.");
                        return unless(!c.view.trace.compared.running, "A comparison is running.");
                    }});
    list.push_back(
        {.id = "resume",
         .name = "Go on with the last session",
         .help = "A start without a file opens the planet, the camera, the trace, the comparison and the "
                 "ruler of the last session.",
         .menu = Menu::File,
         .setting = "window.resume",
         .act = [](const Context& c) { c.workspace.preferences.resume = !c.workspace.preferences.resume; },
         .isOn = [](const Context& c) { return c.workspace.preferences.resume; }});
    list.push_back({.id = "screenshot",
                    .name = "Screenshot",
                    .help = "Saves a picture of the planet with its settings.",
                    .menu = Menu::File,
                    .group = 1,
                    .keys = {"F12"},
                    .act = sends(TakeScreenshot{false}),
                    .whyNot = needsPlanet});
    list.push_back({.id = "screenshot_with_panels",
                    .name = "Screenshot with panels",
                    .help = "Saves a picture of the window.",
                    .menu = Menu::File,
                    .group = 1,
                    .keys = {"Shift+F12"},
                    .act = sends(TakeScreenshot{true})});
    list.push_back({.id = "copy_command_line",
                    .name = "Copy as command line",
                    .help = "Copies a worldy shot command that draws this view with these settings.",
                    .menu = Menu::File,
                    .group = 1,
                    .keys = {"Ctrl+Shift+C"},
                    .act = sends(CopyCommandLine{}),
                    .whyNot = needsPlanet});
    list.push_back(
        {.id = "save_report",
         .name = "Save session report...",
         .help = "Saves the settings, measurements and notes of this session as a page with pictures.",
         .menu = Menu::File,
         .group = 1,
         .act = sends(SaveReport{}),
         .whyNot = needsPlanet});
    list.push_back({.id = "quit",
                    .name = "Quit",
                    .help = "Saves the settings and ends Worldy.",
                    .menu = Menu::File,
                    .group = 2,
                    .keys = {"Ctrl+Q"},
                    .act = sends(Quit{})});
}

// ---- Edit ----

std::string verbWith(const char* verb, const std::string& name) {
    return name.empty() ? std::string(verb) : verb + (" " + inFont(name));
}

std::vector<ActionChoice> presets(const Context& c) {
    std::vector<ActionChoice> choices;
    for (const PresetView& preset : c.view.settings.presets)
        choices.push_back({preset.name, preset.problem,
                           [name = preset.name](Commands& to) { to.push_back(LoadPreset{name}); }});
    return choices;
}

void addEdit(List& list) {
    list.push_back(
        {.id = "undo",
         .name = "Undo",
         .help = "Reverts the last change of a setting.",
         .menu = Menu::Edit,
         .keys = {"Ctrl+Z"},
         .act = sends(Undo{}),
         .whyNot =
             [](const Context& c) { return unless(!c.view.settings.undoName.empty(), "Nothing to undo."); },
         .nameNow = [](const Context& c) { return verbWith("Undo", c.view.settings.undoName); }});
    list.push_back(
        {.id = "redo",
         .name = "Redo",
         .help = "Makes the last reverted change again.",
         .menu = Menu::Edit,
         .keys = {"Ctrl+Shift+Z", "Ctrl+Y"},
         .act = sends(Redo{}),
         .whyNot =
             [](const Context& c) { return unless(!c.view.settings.redoName.empty(), "Nothing to redo."); },
         .nameNow = [](const Context& c) { return verbWith("Redo", c.view.settings.redoName); }});
    list.push_back(
        {.id = "palette",
         .name = "Find anything...",
         .help = "Opens or closes the palette, which finds commands, panels, settings, bookmarks, flights, "
                 "presets, "
                 "chunks and places.",
         .menu = Menu::Edit,
         .group = 1,
         .keys = {"Ctrl+K"},
         .inTextFields = true,
         .act = [](const Context& c) { togglePalette(c.menu.palette); },
         .whyNot = [](const Context&) { return unless(!isDialogOpen(), "A message waits for an answer."); }});
    list.push_back(
        {.id = "find",
         .name = "Find in list",
         .help =
             "Moves the focus to the filter of the panel under the pointer, or of the one with the focus.",
         .menu = Menu::Edit,
         .group = 1,
         .keys = {"Ctrl+F"},
         .inTextFields = true,
         .act = [](const Context& c) { c.menu.findsInList = true; },
         .whyNot =
             [](const Context&) {
                 return unless(isFilterShown(), "No list with a filter is shown; the Log panel has one.");
             }});
    list.push_back({.id = "reset_settings",
                    .name = "Reset all settings",
                    .help = "Resets all view settings to their defaults. Undo reverts this.",
                    .menu = Menu::Edit,
                    .group = 2,
                    .act = [](const Context& c) { c.settings = {}; },
                    .whyNot =
                        [](const Context& c) {
                            return unless(c.settings != ViewSettings(), "All settings have their defaults.");
                        }});
    list.push_back(
        {.id = "load_preset",
         .name = "Load preset",
         .help = "Replaces the view settings by those of a preset.",
         .menu = Menu::Edit,
         .group = 2,
         .whyNot = [](const Context& c) { return unless(!c.view.settings.presets.empty(), "No presets."); },
         .choices = presets,
         .choiceKind = PaletteKind::Preset});
}

// ---- View ----

// Returns the submenu that lists a panel; empty: the View menu itself. With all panels it would not fit a small window.
const char* submenuOf(PanelId panel) {
    switch (panel) {
        case PanelId::Errors:
        case PanelId::Cracks:
        case PanelId::Pops:
        case PanelId::Probe:
        case PanelId::Flight:
        case PanelId::Compare:
        case PanelId::Sweep:
        case PanelId::Atlas:
        case PanelId::Ruler:
        case PanelId::Timeline:
            return "Measuring panels";
        case PanelId::Trace:
        case PanelId::TraceNodes:
        case PanelId::TraceNode:
        case PanelId::TracePaging:
        case PanelId::TraceFindings:
        case PanelId::TraceWhatIf:
            return "Trace panels";
        default:
            return "";
    }
}

void addPanels(List& list, std::string_view submenu) {
    for (const PanelInfo& info : panelInfos) {
        if (submenuOf(info.id) != submenu) continue;
        list.push_back({.id = "panel_" + std::string(info.key),
                        .name = info.title,
                        .help = "Brings the panel to the front, or hides it if it is there.",
                        .menu = Menu::View,
                        .submenu = std::string(submenu),
                        .keys = {info.shortcut},
                        .panel = info.id,
                        .act = [id = info.id](const Context& c) { togglePanel(id, c.workspace); },
                        .isOn =
                            [id = info.id](const Context& c) {
                                return isShown(c.workspace, id) && !isViewportMaximised(c.workspace);
                            }});
    }
}

std::string needsUsedPanel(const Context& c) {
    return unless(c.menu.usedPanel.has_value(),
                  "No panel has had the focus; click into one, or press Ctrl+Tab.");
}

void movePanel(Dock dock, const Context& c) {
    dockPanel(*c.menu.usedPanel, dock, panelCount, c.workspace);
}

Dock dockOf(PanelId panel, const Workspace& workspace) {
    return workspace.panels[static_cast<std::size_t>(panel)].dock;
}

// Brings the next panel of the dock to the front.
void stepTab(int step, const Context& c) {
    const std::vector<PanelId> tabs = panelsIn(dockOf(*c.menu.usedPanel, c.workspace), c.workspace);
    const auto found = std::find(tabs.begin(), tabs.end(), *c.menu.usedPanel);
    if (found == tabs.end()) return;  // it floats
    const auto count = static_cast<int>(tabs.size());
    const int next = (static_cast<int>(found - tabs.begin()) + step + count) % count;
    c.menu.usedPanel = tabs[static_cast<std::size_t>(next)];
    c.menu.focusesPanel = true;
    showPanel(*c.menu.usedPanel, c.workspace);
}

// step: -1 or 1.
std::string cannotMoveTab(int step, const Context& c) {
    if (std::string why = needsUsedPanel(c); !why.empty()) return why;
    const PanelPlace& place = placeOf(*c.menu.usedPanel, c.workspace);
    if (place.floats) return "The panel floats and has no tab.";
    const std::vector<PanelId> tabs = panelsIn(place.dock, c.workspace);
    const bool isLast = *c.menu.usedPanel == (step < 0 ? tabs.front() : tabs.back());
    return unless(!isLast, step < 0 ? "It is the first tab of its dock." : "It is the last tab of its dock.");
}

// Moves the panel's tab among those of its dock.
void moveTab(int step, const Context& c) {
    const PanelId panel = *c.menu.usedPanel;
    const Dock dock = dockOf(panel, c.workspace);
    const std::size_t position = positionIn(dock, panel, c.workspace);
    dockPanel(panel, dock, step < 0 ? position - 1 : position + 1, c.workspace);
    c.menu.focusesPanel = true;
}

void maximiseUsedPanel(const Context& c) {
    PanelPlace& place = c.workspace.panels[static_cast<std::size_t>(*c.menu.usedPanel)];
    place.floats = false;
    showPanel(*c.menu.usedPanel, c.workspace);
    toggleMaximised(place.dock, c.workspace);
}

std::string cannotMaximise(const Context& c) {
    if (std::string why = needsUsedPanel(c); !why.empty()) return why;
    return unless(dockOf(*c.menu.usedPanel, c.workspace) != Dock::Second,
                  "A panel already fills the second window.");
}

void addFocusedPanel(List& list) {
    const auto add = [&](const char* id, const char* name, const char* help, std::vector<const char*> keys,
                         std::function<void(const Context&)> act) {
        list.push_back({.id = id,
                        .name = name,
                        .help = help,
                        .menu = Menu::View,
                        .group = 1,
                        .submenu = "Focus and docks",
                        .keys = std::move(keys),
                        .act = std::move(act),
                        .whyNot = needsUsedPanel});
    };
    add("next_tab", "Next tab", "Brings the next panel of the dock to the front.", {"Ctrl+PageDown"},
        [](const Context& c) { stepTab(1, c); });
    add("previous_tab", "Previous tab", "Brings the previous panel of the dock to the front.",
        {"Ctrl+PageUp"}, [](const Context& c) { stepTab(-1, c); });
    add("move_tab_forward", "Move tab forward", "Moves the panel's tab past the next one of its dock.",
        {"Ctrl+Shift+PageDown"}, [](const Context& c) { moveTab(1, c); });
    list.back().whyNot = [](const Context& c) { return cannotMoveTab(1, c); };
    add("move_tab_back", "Move tab back", "Moves the panel's tab before the previous one of its dock.",
        {"Ctrl+Shift+PageUp"}, [](const Context& c) { moveTab(-1, c); });
    list.back().whyNot = [](const Context& c) { return cannotMoveTab(-1, c); };
    add("move_panel_left", "Move panel to the left dock", "Moves the panel that had the focus last.", {},
        [](const Context& c) { movePanel(Dock::Left, c); });
    add("move_panel_right", "Move panel to the right dock", "Moves the panel that had the focus last.", {},
        [](const Context& c) { movePanel(Dock::Right, c); });
    add("move_panel_bottom", "Move panel to the bottom dock", "Moves the panel that had the focus last.", {},
        [](const Context& c) { movePanel(Dock::Bottom, c); });
    add("move_panel_second", "Move panel to the second window",
        "Moves the panel that had the focus last into a window of its own for a second monitor.", {},
        [](const Context& c) { movePanel(Dock::Second, c); });
    add("float_panel", "Float panel", "Lets the panel that had the focus last float over the window.", {},
        [](const Context& c) {
            const auto panel = static_cast<std::size_t>(*c.menu.usedPanel);
            floatPanel(*c.menu.usedPanel, c.workspace.panels[panel].floating, c.workspace);
        });
    add("maximise_dock", "Maximise dock",
        "Maximises or restores the dock of the panel that had the focus last.", {}, maximiseUsedPanel);
    list.back().whyNot = cannotMaximise;
    add("hide_panel", "Hide panel", "Hides the panel that had the focus last.", {}, [](const Context& c) {
        c.workspace.panels[static_cast<std::size_t>(*c.menu.usedPanel)].shown = false;
    });
}

void addDockSizes(List& list) {
    constexpr double stepUnits = 20;
    const auto add = [&](const char* id, const char* name, double Workspace::*size, double step,
                         double least) {
        list.push_back({.id = id,
                        .name = name,
                        .help = "Moves the edge of the dock, as its splitter does.",
                        .menu = Menu::View,
                        .group = 1,
                        .submenu = "Focus and docks",
                        .act = [=](const Context& c) {
                            c.workspace.*size = std::clamp(c.workspace.*size + step, least, 1000.0);
                        }});
    };
    add("widen_left", "Widen left dock", &Workspace::leftWidth, stepUnits, 160);
    add("narrow_left", "Narrow left dock", &Workspace::leftWidth, -stepUnits, 160);
    add("widen_right", "Widen right dock", &Workspace::rightWidth, stepUnits, 160);
    add("narrow_right", "Narrow right dock", &Workspace::rightWidth, -stepUnits, 160);
    add("raise_bottom", "Raise bottom dock", &Workspace::bottomHeight, stepUnits, 60);
    add("lower_bottom", "Lower bottom dock", &Workspace::bottomHeight, -stepUnits, 60);
}

void addFocus(List& list) {
    const auto add = [&](const char* id, const char* name, const char* help, std::vector<const char*> keys,
                         std::function<void(const Context&)> act) {
        list.push_back({.id = id,
                        .name = name,
                        .help = help,
                        .menu = Menu::View,
                        .group = 1,
                        .submenu = "Focus and docks",
                        .keys = std::move(keys),
                        .act = std::move(act)});
    };
    add("next_pane", "Next pane", "Moves the focus to the next of menu bar, docks and viewport.",
        {"Ctrl+Tab"}, [](const Context& c) { c.menu.panes = 1; });
    add("previous_pane", "Previous pane", "Moves the focus to the previous of menu bar, docks and viewport.",
        {"Ctrl+Shift+Tab"}, [](const Context& c) { c.menu.panes = -1; });
    add("context_menu", "Context menu",
        "Opens the menu of the control or row with the focus, as a right click does.", {"Shift+F10", "Menu"},
        [](const Context& c) { c.menu.press = MenuState::Press::ContextMenu; });
}

void addPicture(List& list) {
    list.push_back(
        {.id = "wireframe",
         .name = "Wireframe",
         .help = "Draws the mesh edges.",
         .menu = Menu::View,
         .group = 1,
         .submenu = "Picture",
         .keys = {"F1"},
         .setting = "overlay.wireframe",
         .act = [](const Context& c) { c.settings.overlay.wireframe = !c.settings.overlay.wireframe; },
         .isOn = [](const Context& c) { return c.settings.overlay.wireframe; }});
    list.push_back({.id = "cube",
                    .name = "Unprojected cube",
                    .help = "Draws the cube before it is projected onto the sphere.",
                    .menu = Menu::View,
                    .group = 1,
                    .submenu = "Picture",
                    .keys = {"F4"},
                    .setting = "overlay.cube",
                    .act = [](const Context& c) { c.settings.overlay.cube = !c.settings.overlay.cube; },
                    .isOn = [](const Context& c) { return c.settings.overlay.cube; }});
    list.push_back({.id = "next_tint",
                    .name = "Next chunk tint",
                    .help = "Tints the chunks by the next quantity of the Overlay panel.",
                    .menu = Menu::View,
                    .group = 1,
                    .submenu = "Picture",
                    .keys = {"F8"},
                    .setting = "overlay.colour_by",
                    .act = [](const Context& c) { advance(c.settings.overlay.colourBy, 8); }});
    list.push_back(
        {.id = "flip_compared",
         .name = "Flip A and B",
         .help = "While comparing: shows the other of A and B.",
         .menu = Menu::View,
         .group = 1,
         .submenu = "Picture",
         .keys = {"F9"},
         .setting = "compare.show_b",
         .act =
             [](const Context& c) {
                 CompareSettings& compare = c.settings.compare;
                 compare.showB = compare.mode != CompareMode::Flip || !compare.showB;
                 compare.mode = CompareMode::Flip;
             },
         .whyNot = [](const Context& c) { return unless(c.view.compare.on, "Nothing is compared."); }});
}

void addWipe(List& list) {
    const auto add = [&](const char* id, const char* name, const char* help, const auto& moved) {
        list.push_back({.id = id,
                        .name = name,
                        .help = help,
                        .menu = Menu::View,
                        .group = 1,
                        .submenu = "Picture",
                        .act =
                            [=](const Context& c) {
                                double& wipe = c.settings.compare.wipe;
                                wipe = std::clamp(moved(wipe), 0.0, 1.0);
                            },
                        .whyNot =
                            [](const Context& c) {
                                if (!c.view.compare.on) return std::string("Nothing is compared.");
                                return unless(c.settings.compare.mode == CompareMode::Wipe,
                                              "The comparison shows no wipe; the Compare panel does.");
                            }});
    };
    constexpr double step = 0.05;
    add("wipe_left", "Move wipe left", "While comparing by a wipe: moves the divider left by 5 %.",
        [](double wipe) { return wipe - step; });
    list.back().keys = {"Ctrl+["};
    add("wipe_right", "Move wipe right", "While comparing by a wipe: moves the divider right by 5 %.",
        [](double wipe) { return wipe + step; });
    list.back().keys = {"Ctrl+]"};
    add("wipe_middle", "Wipe to the middle", "While comparing by a wipe: moves the divider to the middle.",
        [](double) { return 0.5; });
    list.back().keys = {"Ctrl+\\"};
}

void addTheme(List& list) {
    const auto add = [&](const char* id, const char* name, Theme theme) {
        list.push_back({.id = id,
                        .name = name,
                        .help = "Changes the colours of the window.",
                        .menu = Menu::View,
                        .group = 2,
                        .submenu = "Theme",
                        .act = [=](const Context& c) { c.workspace.preferences.theme = theme; },
                        .isOn = [=](const Context& c) { return c.workspace.preferences.theme == theme; }});
    };
    add("dark_theme", "Dark theme", Theme::Dark);
    add("light_theme", "Light theme", Theme::Light);
}

void addFrameLimits(List& list) {
    constexpr std::array limits = {0, 30, 60, 120, 144, 240};
    for (const int limit : limits) {
        const std::string number = std::to_string(limit);
        list.push_back(
            {.id = "frame_limit_" + number,
             .name = limit == 0 ? "No frame limit" : "At most " + number + " frames a second",
             .help = "Limits how many frames are drawn in a second.",
             .menu = Menu::View,
             .group = 4,
             .submenu = "Frame limit",
             .act = [=](const Context& c) { c.workspace.preferences.frameLimit = limit; },
             .isOn = [=](const Context& c) { return c.workspace.preferences.frameLimit == limit; }});
    }
}

void addFramePace(List& list) {
    list.push_back(
        {.id = "idle",
         .name = "Idle when still",
         .help = "Draws frames only while something changes, which saves power.",
         .menu = Menu::View,
         .group = 4,
         .setting = "window.idle",
         .act = [](const Context& c) { c.workspace.preferences.idle = !c.workspace.preferences.idle; },
         .isOn = [](const Context& c) { return c.workspace.preferences.idle; }});
    list.push_back(
        {.id = "vsync",
         .name = "Wait for the monitor",
         .help = "Draws at most as many frames as the monitor shows.",
         .menu = Menu::View,
         .group = 4,
         .setting = "window.vsync",
         .act = [](const Context& c) { c.workspace.preferences.vsync = !c.workspace.preferences.vsync; },
         .isOn = [](const Context& c) { return c.workspace.preferences.vsync; }});
    addFrameLimits(list);
    list.push_back(
        {.id = "full_speed",
         .name = "Full speed",
         .help = "Draws as many frames as the machine can until it is chosen again: no idling, no frame "
                 "limit, no wait for the monitor.",
         .menu = Menu::View,
         .group = 4,
         .keys = {"Shift+F5"},
         .act = [](const Context& c) { c.commands.push_back(DrawAtFullSpeed{!c.view.frames.fullSpeed}); },
         .isOn = [](const Context& c) { return c.view.frames.fullSpeed; }});
}

void addTextAndLayout(List& list) {
    list.push_back({.id = "larger_text",
                    .name = "Larger text",
                    .help = "Enlarges text and controls by a tenth.",
                    .menu = Menu::View,
                    .group = 2,
                    .keys = {"Ctrl++"},
                    .act = [](const Context& c) { zoomText(1.1, c.workspace); },
                    .whyNot =
                        [](const Context& c) {
                            return unless(!isTextLimited(c.workspace),
                                          "The window is too small for larger text.");
                        }});
    list.push_back({.id = "smaller_text",
                    .name = "Smaller text",
                    .help = "Makes text and controls smaller.",
                    .menu = Menu::View,
                    .group = 2,
                    .keys = {"Ctrl+-"},
                    .act = [](const Context& c) { zoomText(1 / 1.1, c.workspace); }});
    list.push_back({.id = "match_monitor_scale",
                    .name = "Match monitor scale",
                    .help = "Gives text and controls the size that the monitor asks for.",
                    .menu = Menu::View,
                    .group = 2,
                    .act = [](const Context& c) { c.workspace.preferences.scale = 1; },
                    .whyNot =
                        [](const Context& c) {
                            return unless(c.workspace.preferences.scale != 1,
                                          "The text already matches the monitor scale.");
                        }});
    list.push_back({.id = "all_panels",
                    .name = "All panels",
                    .help = "Puts all panels away, or brings back those that were shown.",
                    .menu = Menu::View,
                    .group = 3,
                    .keys = {"F11"},
                    .act = [](const Context& c) { toggleAllPanels(c.workspace); }});
}

// ---- Camera ----

std::vector<ActionChoice> bookmarks(const Context& c) {
    std::vector<ActionChoice> choices;
    for (const Bookmark& bookmark : c.view.camera.bookmarks)
        choices.push_back({bookmark.name, needsPlanet(c), [pose = bookmark.pose](Commands& to) {
                               to.push_back(MoveCamera{pose, true});
                           }});
    return choices;
}

std::vector<ActionChoice> flights(const Context& c) {
    std::vector<ActionChoice> choices;
    for (const std::filesystem::path& file : c.view.camera.flights)
        choices.push_back(
            {flightName(file), needsPlanet(c), [file](Commands& to) { to.push_back(StartFlight{file}); }});
    return choices;
}

void addCameraModes(List& list) {
    const auto add = [&](const char* id, const char* name, const char* help, CameraMode mode) {
        list.push_back({.id = id,
                        .name = name,
                        .help = help,
                        .menu = Menu::Camera,
                        .act = [=](const Context& c) { c.settings.camera.mode = mode; },
                        .isOn = [=](const Context& c) { return c.settings.camera.mode == mode; }});
    };
    add("fly", "Fly", "The keys move the camera freely.", CameraMode::Fly);
    add("orbit", "Orbit", "The camera turns around the planet.", CameraMode::Orbit);
    add("follow_flight", "Follow a flight", "The camera follows the last flight.", CameraMode::FollowFlight);
}

void addPlaces(List& list) {
    list.push_back({.id = "go_to",
                    .name = "Go to",
                    .help = "Moves the camera to a bookmark.",
                    .menu = Menu::Camera,
                    .group = 1,
                    .choices = bookmarks,
                    .choiceKind = PaletteKind::Bookmark});
    list.push_back(
        {.id = "start_flight",
         .name = "Start flight",
         .help = "Follows a flight from its start.",
         .menu = Menu::Camera,
         .group = 1,
         .whyNot =
             [](const Context& c) { return unless(!c.view.camera.flights.empty(), "No flights found."); },
         .choices = flights,
         .choiceKind = PaletteKind::Flight});
    list.push_back({.id = "reset_camera",
                    .name = "Reset camera",
                    .help = "Moves the camera to where this session started.",
                    .menu = Menu::Camera,
                    .group = 1,
                    .keys = {"F3"},
                    .act = sends(ResetCamera{})});
    list.push_back({.id = "select_middle",
                    .name = "Select chunk in the middle",
                    .help = "Selects the chunk in the middle of the viewport, as a click there does.",
                    .menu = Menu::Camera,
                    .group = 1,
                    .act = [](const Context& c) { c.menu.press = MenuState::Press::MiddleOfViewport; },
                    .whyNot = needsPlanet});
}

std::string needsPoint(const Context& c) {
    if (!c.view.planet) return needsPlanet(c);
    return unless(
        pickedPoint(c.view).has_value(),
        "No ground is under the pointer or in the middle of the picture, and no chunk is selected.");
}

// The point is the one that pickedPoint() returns.
void addPoints(List& list) {
    list.push_back({.id = "look_at_point",
                    .name = "Look at the point",
                    .help = "Turns the camera to the ground under the pointer, else to the selected chunk.",
                    .menu = Menu::Camera,
                    .group = 1,
                    .keys = {"F"},
                    .act = [](const Context& c) { c.commands.push_back(LookAtPoint{*pickedPoint(c.view)}); },
                    .whyNot = needsPoint});
    list.push_back(
        {.id = "orbit_point",
         .name = "Orbit the point",
         .help = "Orbits the ground under the pointer, else the selected chunk, else the middle of the "
                 "picture; chosen again, flies.",
         .menu = Menu::Camera,
         .group = 1,
         .keys = {"O"},
         .act =
             [](const Context& c) {
                 if (c.settings.camera.mode == CameraMode::Orbit)
                     c.settings.camera.mode = CameraMode::Fly;
                 else
                     c.commands.push_back(OrbitPoint{*pickedPoint(c.view)});
             },
         .isOn = [](const Context& c) { return c.settings.camera.mode == CameraMode::Orbit; },
         .whyNot =
             [](const Context& c) {
                 return c.settings.camera.mode == CameraMode::Orbit ? "" : needsPoint(c);
             }});
    list.push_back(
        {.id = "glide",
         .name = "Glide to places",
         .help = "The camera glides to bookmarks, places and notes instead of jumping.",
         .menu = Menu::Camera,
         .group = 1,
         .setting = "window.glide",
         .act = [](const Context& c) { c.workspace.preferences.glide = !c.workspace.preferences.glide; },
         .isOn = [](const Context& c) { return c.workspace.preferences.glide; }});
}

void addLens(List& list) {
    const auto addFov = [&](const char* id, const char* name, const char* help, const char* key,
                            double notches) {
        list.push_back({.id = id,
                        .name = name,
                        .help = help,
                        .menu = Menu::Camera,
                        .group = 4,
                        .keys = {key},
                        .act = [=](const Context& c) {
                            c.settings.camera.fovDeg = narrowedFovDeg(c.settings.camera.fovDeg, notches);
                        }});
    };
    addFov("narrower_view", "Narrow field of view", "Magnifies the picture by a tenth, as Ctrl+wheel does.",
           "]", 1);
    addFov("wider_view", "Widen field of view", "Widens the picture by a tenth, as Ctrl+wheel does.", "[",
           -1);
    const auto addSpeed = [&](const char* id, const char* name, double factor) {
        list.push_back({.id = id,
                        .name = name,
                        .help = "Changes the speed of the camera by half, as + and - do.",
                        .menu = Menu::Camera,
                        .group = 4,
                        .act =
                            [=](const Context& c) {
                                c.commands.push_back(SetSpeedFactor{c.view.camera.speedFactor * factor});
                            },
                        .whyNot = needsPlanet});
    };
    addSpeed("faster", "Fly faster", 1.5);
    addSpeed("slower", "Fly slower", 1 / 1.5);
}

void addFrames(List& list) {
    list.push_back(
        {.id = "freeze_lod",
         .name = "Freeze LOD",
         .help = "Keeps the selection while the camera moves.",
         .menu = Menu::Camera,
         .group = 2,
         .keys = {"F2"},
         .act = [](const Context& c) { c.commands.push_back(FreezeLod{!c.view.camera.lodFrozen}); },
         .isOn = [](const Context& c) { return c.view.camera.lodFrozen; }});
    list.push_back({.id = "pause_frames",
                    .name = "Pause frames",
                    .help = "Stops motion, selection and loading.",
                    .menu = Menu::Camera,
                    .group = 2,
                    .keys = {"F5"},
                    .act = [](const Context& c) { c.commands.push_back(PauseFrames{!c.view.frames.paused}); },
                    .isOn = [](const Context& c) { return c.view.frames.paused; }});
    list.push_back({.id = "step_frame",
                    .name = "Step one frame",
                    .help = "Makes one frame while frames are paused.",
                    .menu = Menu::Camera,
                    .group = 2,
                    .keys = {"F6"},
                    .act = sends(StepFrame{})});
}

void addObserver(List& list) {
    const auto add = [&](const char* id, const char* name, ObserverMode mode) {
        list.push_back({.id = id,
                        .name = name,
                        .help = "Chooses whether the second camera, which watches the first, is shown.",
                        .menu = Menu::Camera,
                        .group = 3,
                        .act = [=](const Context& c) { c.settings.camera.observer = mode; },
                        .isOn = [=](const Context& c) { return c.settings.camera.observer == mode; }});
    };
    add("observer_off", "Observer off", ObserverMode::Off);
    add("observer_split", "Observer split", ObserverMode::Split);
    add("observer_alone", "Observer alone", ObserverMode::Alone);
    list.push_back({.id = "next_observer",
                    .name = "Next observer mode",
                    .help = "Goes from off to split to alone.",
                    .menu = Menu::Camera,
                    .group = 3,
                    .keys = {"F7"},
                    .act = [](const Context& c) { advance(c.settings.camera.observer, 3); }});
}

// ---- Help ----

void addHelp(List& list) {
    list.push_back({.id = "keys",
                    .name = "Keys and mouse",
                    .help = "Shows or hides the list of keys.",
                    .menu = Menu::Help,
                    .keys = {"F10"},
                    .act = [](const Context& c) { c.menu.showKeys = !c.menu.showKeys; }});
    list.push_back({.id = "write_key_file",
                    .name = "Write key file",
                    .help = "Writes keys.toml, in which the keys can be changed. An existing file is kept.",
                    .menu = Menu::Help,
                    .act = sends(WriteKeyFile{})});
    list.push_back({.id = "reload_keys",
                    .name = "Reload keys",
                    .help = "Reads keys.toml again.",
                    .menu = Menu::Help,
                    .act = sends(ReloadKeys{})});
    list.push_back({.id = "about",
                    .name = "About",
                    .help = "Says what Worldy is.",
                    .menu = Menu::Help,
                    .group = 1,
                    .act = [](const Context& c) { c.menu.showAbout = true; }});
}

// ---- No menu ----

// Closes the topmost window, dialog or list; if none is open, restores a maximised dock; otherwise clears the selection.
void leave(const Context& c) {
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;  // Esc only cancels the drag
    if (c.menu.palette.isOpen) return leavePalette(c.menu.palette);
    // ImGui itself closes popups that are not modal, before this.
    if (closePopups() || c.menu.popupWasOpen) return;
    if (plotShowsFocus()) return;  // ImGui leaves the plot
    if (c.menu.showAbout || c.menu.showKeys)
        (c.menu.showAbout ? c.menu.showAbout : c.menu.showKeys) = false;
    else if (maximisedDock(c.workspace))
        c.workspace.maximised = MaximisedDock::None;
    else
        c.commands.push_back(SelectChunk{});
}

template <class Kind>
void addTool(List& list, const char* id, const char* name, const char* help, const Kind& command) {
    list.push_back({.id = id, .name = name, .help = help, .act = sends(command), .whyNot = needsPlanet});
}

std::vector<ActionChoice> layouts(const Context& c) {
    std::vector<ActionChoice> choices;
    for (const NamedLayout& layout : c.view.settings.layouts) {
        choices.push_back({layout.named.name, layout.workspace ? "" : layout.workspace.error().message,
                           [name = layout.named.name](Commands& to) { to.push_back(LoadLayout{name}); }});
    }
    return choices;
}

// The menu View > Layout has these too.
void addLayouts(List& list) {
    list.push_back({.id = "next_layout",
                    .name = "Next layout",
                    .help = "Shows the next layout of the panels.",
                    .keys = {"Ctrl+Shift+L"},
                    .act = sends(NextLayout{})});
    list.push_back({.id = "reset_layout",
                    .name = "Reset layout",
                    .help = "Puts all panels and docks where they were at first.",
                    .act = sends(ResetLayout{})});
    list.push_back({.id = "restore_layout",
                    .name = "Back to unsaved layout",
                    .help = "Brings back the panels before the last change of layout.",
                    .act = sends(RestoreLayout{}),
                    .whyNot = [](const Context& c) {
                        return unless(c.view.settings.hasUnsavedLayout,
                                      "No layout has replaced panels that were not saved as a layout.");
                    }});
    list.push_back({.id = "save_layout",
                    .name = "Save layout as...",
                    .help = "Saves which panels are shown, where they lie, and the sizes of the docks.",
                    .act = [](const Context& c) { c.menu.layout = {.asksName = true}; }});
    list.push_back({.id = "load_layout",
                    .name = "Layout",
                    .help = "Shows the panels of a layout.",
                    .choices = layouts,
                    .choiceKind = PaletteKind::Command});
}

void addWithoutMenu(List& list) {
    list.push_back({.id = "close",
                    .name = "Close",
                    .help = "Closes a menu, message or window; if none is open, restores a maximised dock; "
                            "otherwise clears the "
                            "selection.",
                    .keys = {"Esc"},
                    .act = leave});
    addLayouts(list);
    list.push_back({.id = "pause_paging",
                    .name = "Pause paging",
                    .help = "Stops loaders from taking requests from the queue.",
                    .act = [](const Context& c) { c.commands.push_back(PausePaging{!c.view.pagingPaused}); },
                    .isOn = [](const Context& c) { return c.view.pagingPaused; },
                    .whyNot = needsPlanet});
    addTool(list, "evict_all", "Evict all chunks", "Evicts all chunks and colour tiles except the six roots.",
            DropAll{});
    addTool(list, "retry_failed", "Retry failed blocks", "Retries all blocks that could not be read.",
            RetryFailed{});
    addTool(list, "measure_errors", "Measure true error",
            "Measures the true error of this view in the background.", MeasureErrors{});
    addTool(list, "measure_cracks", "Measure cracks", "Counts the cracks of this view.", MeasureCracks{});
    addTool(list, "measure_features", "Measure features",
            "Measures what the features of the picture cost in this view.", MeasureCosts{});
    addTool(list, "start_recording", "Start recording", "Records the flight from here.", StartRecording{});
    addTool(list, "stop_recording", "Stop recording", "Ends the recording and saves it.", StopRecording{});
    addTool(list, "snapshot_as_b", "Snapshot as B",
            "Compares with a second planet that keeps these settings.", StartCompare{});
    addTool(list, "end_comparison", "End comparison", "Closes the second planet.", StopCompare{});
    addTool(list, "set_as_start", "Set view as start", "Future sessions start with this view.",
            KeepCameraAsStart{});
}

List makeActions() {
    List list;
    addFile(list);
    addEdit(list);
    for (const char* const submenu : {"", "Measuring panels", "Trace panels"}) addPanels(list, submenu);
    addFocus(list);
    addFocusedPanel(list);
    addDockSizes(list);
    addPicture(list);
    addWipe(list);
    addTheme(list);
    addTextAndLayout(list);
    addFramePace(list);
    addCameraModes(list);
    addPlaces(list);
    addPoints(list);
    addFrames(list);
    addObserver(list);
    addLens(list);
    addHelp(list);
    addWithoutMenu(list);
    return list;
}

KeyChords chordsOf(const Action& action) {
    KeyChords chords;
    for (const char* name : action.keys) {
        const std::optional<KeyChord> chord = keyChordFrom(name);
        assert(chord);
        if (chord) chords.push_back(*chord);
    }
    return chords;
}

}  // namespace

const char* menuName(Menu menu) {
    constexpr std::array names = {"", "File", "Edit", "View", "Camera", "Help"};
    return names[static_cast<std::size_t>(menu)];
}

std::span<const Action> actions() {
    static const List list = makeActions();
    return list;
}

const Action& actionNamed(std::string_view id) {
    const auto list = actions();
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Action& action) { return action.id == id; });
    assert(found != list.end());
    return *found;
}

std::string whyNot(const Action& action, const ActionContext& context) {
    return action.whyNot ? action.whyNot(context) : std::string();
}

std::vector<KeyedCommand> keyedCommands() {
    std::vector<KeyedCommand> commands;
    for (const Action& action : actions()) {
        if (action.act) commands.push_back({action.id, action.name, action.help, chordsOf(action)});
    }
    return commands;
}

ActionKeys actionKeys(std::span<const KeyChords> ofCommands) {
    ActionKeys keys;
    std::size_t command = 0;
    for (const Action& action : actions()) keys.push_back(action.act ? ofCommands[command++] : KeyChords());
    return keys;
}

ActionKeys defaultKeys() {
    ActionKeys keys;
    for (const Action& action : actions()) keys.push_back(chordsOf(action));
    return keys;
}

std::string keysText(const KeyChords& keys) {
    std::string text;
    for (const KeyChord& chord : keys) text += (text.empty() ? "" : ", ") + nameOf(chord);
    return text;
}

void publishKeyNames(const ActionKeys& keys) {
    KeyNames names;
    for (std::size_t i = 0; i < actions().size(); ++i) {
        const Action& action = actions()[i];
        if (keys[i].empty()) continue;
        names.emplace_back(action.id, nameOf(keys[i].front()));
        if (!action.setting.empty()) names.emplace_back(action.setting, nameOf(keys[i].front()));
    }
    setKeyNames(std::move(names));
}

}  // namespace worldy::ui
