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

// A place in the menus, or none, to which actions are added.
struct MenuPlace {
    List& list;
    Menu menu = Menu::None;
    int group = 0;
    std::string submenu{};

    // keys: by default. The reference is valid until the next action is added.
    Action& add(std::string id, std::string name, std::string help, std::vector<const char*> keys = {},
                std::function<void(const Context&)> act = {},
                std::function<std::string(const Context&)> whyNot = {}) const {
        list.push_back({.id = std::move(id),
                        .name = std::move(name),
                        .help = std::move(help),
                        .menu = menu,
                        .group = group,
                        .submenu = submenu,
                        .keys = std::move(keys),
                        .act = std::move(act),
                        .whyNot = std::move(whyNot)});
        return list.back();
    }

    // Adds an action that turns a setting on and off.
    void toggle(const char* id, const char* name, const char* help, std::vector<const char*> keys,
                const char* setting, bool& (*of)(const Context&)) const {
        Action& action = add(id, name, help, std::move(keys), [of](const Context& c) { of(c) = !of(c); });
        action.setting = setting;
        action.isOn = of;
    }
};

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
    const MenuPlace file{list, Menu::File}, saving{list, Menu::File, 1}, leaving{list, Menu::File, 2};
    file.add("open", "Open...", "Opens a file: a planet, a picture, settings, a flight or a trace.",
             {"Ctrl+O"}, sends(AskForFile{}));
    Action& openRecent = file.add("open_recent", "Open recent", "Opens a file that was open before.");
    openRecent.whyNot = [](const Context& c) {
        return unless(!c.view.data.recent.empty(), "No recent files.");
    };
    openRecent.choices = recentFiles;
    openRecent.choiceKind = PaletteKind::File;
    file.add("attach", "Attach to an engine...", "Shows the Trace panel, which attaches to a running engine.",
             {}, [](const Context& c) { showPanel(PanelId::Trace, c.workspace); });
    file.add("compare_trace", "Compare the trace with...",
             "Asks for a second trace of the same flight, and compares the open trace with it "
             "frame by frame.",
             {}, sends(AskForFile{FilePurpose::TraceB}), [](const Context& c) {
                 if (c.view.trace.file.empty()) return std::string("No trace is open.");
                 return unless(!c.view.trace.compared.running, "A comparison is running.");
             });
    file.toggle("resume", "Go on with the last session",
                "A start without a file opens the planet, the camera, the trace, the comparison and the "
                "ruler of the last session.",
                {}, "window.resume",
                [](const Context& c) -> bool& { return c.workspace.preferences.resume; });
    saving.add("screenshot", "Screenshot", "Saves a picture of the planet with its settings.", {"F12"},
               sends(TakeScreenshot{false}), needsPlanet);
    saving.add("screenshot_with_panels", "Screenshot with panels", "Saves a picture of the window.",
               {"Shift+F12"}, sends(TakeScreenshot{true}));
    saving.add("copy_command_line", "Copy as command line",
               "Copies a worldy shot command that draws this view with these settings.", {"Ctrl+Shift+C"},
               sends(CopyCommandLine{}), needsPlanet);
    saving.add("save_report", "Save session report...",
               "Saves the settings, measurements and notes of this session as a page with pictures.", {},
               sends(SaveReport{}), needsPlanet);
    leaving.add("quit", "Quit", "Saves the settings and ends Worldy. Asks first if regions are not saved.",
                {"Ctrl+Q"}, sends(Quit{}));
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
    const MenuPlace undoing{list, Menu::Edit}, finding{list, Menu::Edit, 1}, resetting{list, Menu::Edit, 2};
    Action& undo =
        undoing.add("undo", "Undo", "Reverts the last change of a setting.", {"Ctrl+Z"}, sends(Undo{}));
    undo.whyNot = [](const Context& c) {
        return unless(!c.view.settings.undoName.empty(), "Nothing to undo.");
    };
    undo.nameNow = [](const Context& c) { return verbWith("Undo", c.view.settings.undoName); };
    Action& redo = undoing.add("redo", "Redo", "Makes the last reverted change again.",
                               {"Ctrl+Shift+Z", "Ctrl+Y"}, sends(Redo{}));
    redo.whyNot = [](const Context& c) {
        return unless(!c.view.settings.redoName.empty(), "Nothing to redo.");
    };
    redo.nameNow = [](const Context& c) { return verbWith("Redo", c.view.settings.redoName); };
    Action& palette = finding.add(
        "palette", "Find anything...",
        "Opens or closes the palette, which finds commands, panels, settings, bookmarks, flights, "
        "presets, chunks and places.",
        {"Ctrl+K"}, [](const Context& c) { togglePalette(c.menu.palette); });
    palette.inTextFields = true;
    palette.whyNot = [](const Context&) { return unless(!isDialogOpen(), "A message waits for an answer."); };
    Action& find = finding.add(
        "find", "Find in list",
        "Moves the focus to the filter of the panel under the pointer, or of the one with the focus.",
        {"Ctrl+F"}, [](const Context& c) { c.menu.findsInList = true; });
    find.inTextFields = true;
    find.whyNot = [](const Context&) {
        return unless(isFilterShown(), "No list with a filter is shown; the Log panel has one.");
    };
    resetting.add(
        "reset_settings", "Reset all settings",
        "Resets all view settings to their defaults. Undo reverts this.", {},
        [](const Context& c) { c.settings = {}; },
        [](const Context& c) {
            return unless(c.settings != ViewSettings(), "All settings have their defaults.");
        });
    Action& loadPreset =
        resetting.add("load_preset", "Load preset", "Replaces the view settings by those of a preset.");
    loadPreset.whyNot = [](const Context& c) {
        return unless(!c.view.settings.presets.empty(), "No presets.");
    };
    loadPreset.choices = presets;
    loadPreset.choiceKind = PaletteKind::Preset;
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
        case PanelId::Suggest:
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
    const MenuPlace view{list, Menu::View, 0, std::string(submenu)};
    for (const PanelInfo& info : panelInfos) {
        if (submenuOf(info.id) != submenu) continue;
        Action& shows =
            view.add("panel_" + std::string(info.key), info.title,
                     "Brings the panel to the front, or hides it if it is there.", {info.shortcut},
                     [id = info.id](const Context& c) { togglePanel(id, c.workspace); });
        shows.panel = info.id;
        shows.isOn = [id = info.id](const Context& c) {
            return isShown(c.workspace, id) && !isViewportMaximised(c.workspace);
        };
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
    const MenuPlace docks{list, Menu::View, 1, "Focus and docks"};
    const auto add = [&](const char* id, const char* name, const char* help, std::vector<const char*> keys,
                         std::function<void(const Context&)> act,
                         std::function<std::string(const Context&)> whyNot = needsUsedPanel) {
        docks.add(id, name, help, std::move(keys), std::move(act), std::move(whyNot));
    };
    add("next_tab", "Next tab", "Brings the next panel of the dock to the front.", {"Ctrl+PageDown"},
        [](const Context& c) { stepTab(1, c); });
    add("previous_tab", "Previous tab", "Brings the previous panel of the dock to the front.",
        {"Ctrl+PageUp"}, [](const Context& c) { stepTab(-1, c); });
    add(
        "move_tab_forward", "Move tab forward", "Moves the panel's tab past the next one of its dock.",
        {"Ctrl+Shift+PageDown"}, [](const Context& c) { moveTab(1, c); },
        [](const Context& c) { return cannotMoveTab(1, c); });
    add(
        "move_tab_back", "Move tab back", "Moves the panel's tab before the previous one of its dock.",
        {"Ctrl+Shift+PageUp"}, [](const Context& c) { moveTab(-1, c); },
        [](const Context& c) { return cannotMoveTab(-1, c); });
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
        "Maximises or restores the dock of the panel that had the focus last.", {}, maximiseUsedPanel,
        cannotMaximise);
    add("hide_panel", "Hide panel", "Hides the panel that had the focus last.", {}, [](const Context& c) {
        c.workspace.panels[static_cast<std::size_t>(*c.menu.usedPanel)].shown = false;
    });
}

void addDockSizes(List& list) {
    const MenuPlace docks{list, Menu::View, 1, "Focus and docks"};
    constexpr double stepUnits = 20;
    const auto add = [&](const char* id, const char* name, double Workspace::*size, double step,
                         double least) {
        docks.add(id, name, "Moves the edge of the dock, as its splitter does.", {}, [=](const Context& c) {
            c.workspace.*size = std::clamp(c.workspace.*size + step, least, 1000.0);
        });
    };
    add("widen_left", "Widen left dock", &Workspace::leftWidth, stepUnits, 160);
    add("narrow_left", "Narrow left dock", &Workspace::leftWidth, -stepUnits, 160);
    add("widen_right", "Widen right dock", &Workspace::rightWidth, stepUnits, 160);
    add("narrow_right", "Narrow right dock", &Workspace::rightWidth, -stepUnits, 160);
    add("raise_bottom", "Raise bottom dock", &Workspace::bottomHeight, stepUnits, 60);
    add("lower_bottom", "Lower bottom dock", &Workspace::bottomHeight, -stepUnits, 60);
}

void addFocus(List& list) {
    const MenuPlace docks{list, Menu::View, 1, "Focus and docks"};
    docks.add("next_pane", "Next pane", "Moves the focus to the next of menu bar, docks and viewport.",
              {"Ctrl+Tab"}, [](const Context& c) { c.menu.panes = 1; });
    docks.add("previous_pane", "Previous pane",
              "Moves the focus to the previous of menu bar, docks and viewport.", {"Ctrl+Shift+Tab"},
              [](const Context& c) { c.menu.panes = -1; });
    docks.add("context_menu", "Context menu",
              "Opens the menu of the control or row with the focus, as a right click does.",
              {"Shift+F10", "Menu"}, [](const Context& c) { c.menu.press = MenuState::Press::ContextMenu; });
}

void addPicture(List& list) {
    const MenuPlace picture{list, Menu::View, 1, "Picture"};
    picture.toggle("wireframe", "Wireframe", "Draws the mesh edges.", {"F1"}, "overlay.wireframe",
                   [](const Context& c) -> bool& { return c.settings.overlay.wireframe; });
    picture.toggle("cube", "Unprojected cube", "Draws the cube before it is projected onto the sphere.",
                   {"F4"}, "overlay.cube", [](const Context& c) -> bool& { return c.settings.overlay.cube; });
    picture
        .add("next_tint", "Next chunk tint", "Tints the chunks by the next quantity of the Overlay panel.",
             {"F8"}, [](const Context& c) { advance(c.settings.overlay.colourBy, 8); })
        .setting = "overlay.colour_by";
    Action& flipCompared =
        picture.add("flip_compared", "Flip A and B", "While comparing: shows the other of A and B.", {"F9"},
                    [](const Context& c) {
                        CompareSettings& compare = c.settings.compare;
                        compare.showB = compare.mode != CompareMode::Flip || !compare.showB;
                        compare.mode = CompareMode::Flip;
                    });
    flipCompared.setting = "compare.show_b";
    flipCompared.whyNot = [](const Context& c) { return unless(c.view.compare.on, "Nothing is compared."); };
}

void addWipe(List& list) {
    const MenuPlace picture{list, Menu::View, 1, "Picture"};
    const auto add = [&](const char* id, const char* name, const char* help, const char* key,
                         const auto& moved) {
        picture.add(
            id, name, help, {key},
            [=](const Context& c) {
                double& wipe = c.settings.compare.wipe;
                wipe = std::clamp(moved(wipe), 0.0, 1.0);
            },
            [](const Context& c) {
                if (!c.view.compare.on) return std::string("Nothing is compared.");
                return unless(c.settings.compare.mode == CompareMode::Wipe,
                              "The comparison shows no wipe; the Compare panel does.");
            });
    };
    constexpr double step = 0.05;
    add("wipe_left", "Move wipe left", "While comparing by a wipe: moves the divider left by 5 %.", "Ctrl+[",
        [](double wipe) { return wipe - step; });
    add("wipe_right", "Move wipe right", "While comparing by a wipe: moves the divider right by 5 %.",
        "Ctrl+]", [](double wipe) { return wipe + step; });
    add("wipe_middle", "Wipe to the middle", "While comparing by a wipe: moves the divider to the middle.",
        "Ctrl+\\", [](double) { return 0.5; });
}

void addTheme(List& list) {
    const MenuPlace themes{list, Menu::View, 2, "Theme"};
    const auto add = [&](const char* id, const char* name, Theme theme) {
        themes
            .add(id, name, "Changes the colours of the window.", {},
                 [=](const Context& c) { c.workspace.preferences.theme = theme; })
            .isOn = [=](const Context& c) { return c.workspace.preferences.theme == theme; };
    };
    add("dark_theme", "Dark theme", Theme::Dark);
    add("light_theme", "Light theme", Theme::Light);
}

void addFrameLimits(List& list) {
    const MenuPlace limitMenu{list, Menu::View, 4, "Frame limit"};
    constexpr std::array limits = {0, 30, 60, 120, 144, 240};
    for (const int limit : limits) {
        const std::string number = std::to_string(limit);
        limitMenu
            .add("frame_limit_" + number,
                 limit == 0 ? "No frame limit" : "At most " + number + " frames a second",
                 "Limits how many frames are drawn in a second.", {},
                 [=](const Context& c) { c.workspace.preferences.frameLimit = limit; })
            .isOn = [=](const Context& c) { return c.workspace.preferences.frameLimit == limit; };
    }
}

void addFramePace(List& list) {
    const MenuPlace pace{list, Menu::View, 4};
    pace.toggle("idle", "Idle when still", "Draws frames only while something changes, which saves power.",
                {}, "window.idle", [](const Context& c) -> bool& { return c.workspace.preferences.idle; });
    pace.toggle("vsync", "Wait for the monitor", "Draws at most as many frames as the monitor shows.", {},
                "window.vsync", [](const Context& c) -> bool& { return c.workspace.preferences.vsync; });
    addFrameLimits(list);
    pace.add("full_speed", "Full speed",
             "Draws as many frames as the machine can until it is chosen again: no idling, no frame "
             "limit, no wait for the monitor.",
             {"Shift+F5"},
             [](const Context& c) { c.commands.push_back(DrawAtFullSpeed{!c.view.frames.fullSpeed}); })
        .isOn = [](const Context& c) { return c.view.frames.fullSpeed; };
}

void addTextAndLayout(List& list) {
    const MenuPlace text{list, Menu::View, 2}, panelsOf{list, Menu::View, 3};
    text.add(
        "larger_text", "Larger text", "Enlarges text and controls by a tenth.", {"Ctrl++"},
        [](const Context& c) { zoomText(1.1, c.workspace); },
        [](const Context& c) {
            return unless(!isTextLimited(c.workspace), "The window is too small for larger text.");
        });
    text.add("smaller_text", "Smaller text", "Makes text and controls smaller.", {"Ctrl+-"},
             [](const Context& c) { zoomText(1 / 1.1, c.workspace); });
    text.add(
        "match_monitor_scale", "Match monitor scale",
        "Gives text and controls the size that the monitor asks for.", {},
        [](const Context& c) { c.workspace.preferences.scale = 1; },
        [](const Context& c) {
            return unless(c.workspace.preferences.scale != 1, "The text already matches the monitor scale.");
        });
    panelsOf.add("all_panels", "All panels", "Puts all panels away, or brings back those that were shown.",
                 {"F11"}, [](const Context& c) { toggleAllPanels(c.workspace); });
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
    const MenuPlace modes{list, Menu::Camera};
    const auto add = [&](const char* id, const char* name, const char* help, CameraMode mode) {
        modes.add(id, name, help, {}, [=](const Context& c) { c.settings.camera.mode = mode; }).isOn =
            [=](const Context& c) { return c.settings.camera.mode == mode; };
    };
    add("fly", "Fly", "The keys move the camera freely.", CameraMode::Fly);
    add("orbit", "Orbit", "The camera turns around the planet.", CameraMode::Orbit);
    add("follow_flight", "Follow a flight", "The camera follows the last flight.", CameraMode::FollowFlight);
}

void addPlaces(List& list) {
    const MenuPlace places{list, Menu::Camera, 1};
    Action& goTo = places.add("go_to", "Go to", "Moves the camera to a bookmark.");
    goTo.choices = bookmarks;
    goTo.choiceKind = PaletteKind::Bookmark;
    Action& startFlight = places.add("start_flight", "Start flight", "Follows a flight from its start.");
    startFlight.whyNot = [](const Context& c) {
        return unless(!c.view.camera.flights.empty(), "No flights found.");
    };
    startFlight.choices = flights;
    startFlight.choiceKind = PaletteKind::Flight;
    places.add("reset_camera", "Reset camera", "Moves the camera to where this session started.", {"F3"},
               sends(ResetCamera{}));
    places.add(
        "select_middle", "Select chunk in the middle",
        "Selects the chunk in the middle of the viewport, as a click there does.", {},
        [](const Context& c) { c.menu.press = MenuState::Press::MiddleOfViewport; }, needsPlanet);
}

std::string needsPoint(const Context& c) {
    if (!c.view.planet) return needsPlanet(c);
    return unless(
        pickedPoint(c.view).has_value(),
        "No ground is under the pointer or in the middle of the picture, and no chunk is selected.");
}

// The point is the one that pickedPoint() returns.
void addPoints(List& list) {
    const MenuPlace places{list, Menu::Camera, 1};
    places.add(
        "look_at_point", "Look at the point",
        "Turns the camera to the ground under the pointer, else to the selected chunk.", {"F"},
        [](const Context& c) { c.commands.push_back(LookAtPoint{*pickedPoint(c.view)}); }, needsPoint);
    Action& orbitPoint =
        places.add("orbit_point", "Orbit the point",
                   "Orbits the ground under the pointer, else the selected chunk, else the middle of the "
                   "picture; chosen again, flies.",
                   {"O"}, [](const Context& c) {
                       if (c.settings.camera.mode == CameraMode::Orbit)
                           c.settings.camera.mode = CameraMode::Fly;
                       else
                           c.commands.push_back(OrbitPoint{*pickedPoint(c.view)});
                   });
    orbitPoint.isOn = [](const Context& c) { return c.settings.camera.mode == CameraMode::Orbit; };
    orbitPoint.whyNot = [](const Context& c) {
        return c.settings.camera.mode == CameraMode::Orbit ? "" : needsPoint(c);
    };
    places.toggle("glide", "Glide to places",
                  "The camera glides to bookmarks, places and notes instead of jumping.", {}, "window.glide",
                  [](const Context& c) -> bool& { return c.workspace.preferences.glide; });
}

void addLens(List& list) {
    const MenuPlace lens{list, Menu::Camera, 4};
    const auto addFov = [&](const char* id, const char* name, const char* help, const char* key,
                            double notches) {
        lens.add(id, name, help, {key}, [=](const Context& c) {
            c.settings.camera.fovDeg = narrowedFovDeg(c.settings.camera.fovDeg, notches);
        });
    };
    addFov("narrower_view", "Narrow field of view", "Magnifies the picture by a tenth, as Ctrl+wheel does.",
           "]", 1);
    addFov("wider_view", "Widen field of view", "Widens the picture by a tenth, as Ctrl+wheel does.", "[",
           -1);
    const auto addSpeed = [&](const char* id, const char* name, double factor) {
        lens.add(
            id, name, "Changes the speed of the camera by half, as + and - do.", {},
            [=](const Context& c) {
                c.commands.push_back(SetSpeedFactor{c.view.camera.speedFactor * factor});
            },
            needsPlanet);
    };
    addSpeed("faster", "Fly faster", 1.5);
    addSpeed("slower", "Fly slower", 1 / 1.5);
}

void addFrames(List& list) {
    const MenuPlace frames{list, Menu::Camera, 2};
    frames
        .add("freeze_lod", "Freeze LOD", "Keeps the selection while the camera moves.", {"F2"},
             [](const Context& c) { c.commands.push_back(FreezeLod{!c.view.camera.lodFrozen}); })
        .isOn = [](const Context& c) { return c.view.camera.lodFrozen; };
    frames
        .add("pause_frames", "Pause frames", "Stops motion, selection and loading.", {"F5"},
             [](const Context& c) { c.commands.push_back(PauseFrames{!c.view.frames.paused}); })
        .isOn = [](const Context& c) { return c.view.frames.paused; };
    frames.add("step_frame", "Step one frame", "Makes one frame while frames are paused.", {"F6"},
               sends(StepFrame{}));
}

void addObserver(List& list) {
    const MenuPlace observer{list, Menu::Camera, 3};
    const auto add = [&](const char* id, const char* name, ObserverMode mode) {
        observer
            .add(id, name, "Chooses whether the second camera, which watches the first, is shown.", {},
                 [=](const Context& c) { c.settings.camera.observer = mode; })
            .isOn = [=](const Context& c) { return c.settings.camera.observer == mode; };
    };
    add("observer_off", "Observer off", ObserverMode::Off);
    add("observer_split", "Observer split", ObserverMode::Split);
    add("observer_alone", "Observer alone", ObserverMode::Alone);
    observer.add("next_observer", "Next observer mode", "Goes from off to split to alone.", {"F7"},
                 [](const Context& c) { advance(c.settings.camera.observer, 3); });
}

// ---- Help ----

void addHelp(List& list) {
    const MenuPlace help{list, Menu::Help}, about{list, Menu::Help, 1};
    help.add("keys", "Keys and mouse", "Shows or hides the list of keys.", {"F10"},
             [](const Context& c) { c.menu.showKeys = !c.menu.showKeys; });
    help.add("write_key_file", "Write key file",
             "Writes keys.toml, in which the keys can be changed. An existing file is kept.", {},
             sends(WriteKeyFile{}));
    help.add("reload_keys", "Reload keys", "Reads keys.toml again.", {}, sends(ReloadKeys{}));
    about.add("about", "About", "Says what Worldy is.", {},
              [](const Context& c) { c.menu.showAbout = true; });
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
    MenuPlace{list}.add(id, name, help, {}, sends(command), needsPlanet);
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
    const MenuPlace none{list};
    none.add("next_layout", "Next layout", "Shows the next layout of the panels.", {"Ctrl+Shift+L"},
             sends(NextLayout{}));
    none.add("reset_layout", "Reset layout", "Puts all panels and docks where they were at first.", {},
             sends(ResetLayout{}));
    none.add("restore_layout", "Back to unsaved layout",
             "Brings back the panels before the last change of layout.", {}, sends(RestoreLayout{}),
             [](const Context& c) {
                 return unless(c.view.settings.hasUnsavedLayout,
                               "No layout has replaced panels that were not saved as a layout.");
             });
    none.add("save_layout", "Save layout as...",
             "Saves which panels are shown, where they lie, and the sizes of the docks.", {},
             [](const Context& c) { c.menu.layout = {.asksName = true}; });
    Action& loadLayout = none.add("load_layout", "Layout", "Shows the panels of a layout.");
    loadLayout.choices = layouts;
    loadLayout.choiceKind = PaletteKind::Command;
}

void addWithoutMenu(List& list) {
    const MenuPlace none{list};
    none.add("close", "Close",
             "Closes a menu, message or window; if none is open, restores a maximised dock; "
             "otherwise clears the selection.",
             {"Esc"}, leave);
    addLayouts(list);
    Action& pausePaging =
        none.add("pause_paging", "Pause paging", "Stops loaders from taking requests from the queue.", {},
                 [](const Context& c) { c.commands.push_back(PausePaging{!c.view.pagingPaused}); });
    pausePaging.isOn = [](const Context& c) { return c.view.pagingPaused; };
    pausePaging.whyNot = needsPlanet;
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
