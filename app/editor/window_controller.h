// The window's own state: panels, menus, screenshots, and the displayed log. Main thread.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/base/log_lines.h"
#include "app/editor/camera_controller.h"
#include "app/editor/compare_controller.h"
#include "app/editor/viewport.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/settings/settings.h"
#include "app/window/window.h"
#include "ui/kit/exports.h"
#include "ui/model/commands.h"
#include "ui/model/layout.h"
#include "ui/shell/actions.h"
#include "ui/shell/docks_state.h"
#include "ui/shell/panels.h"

namespace worldy {

// A requested session report, and what is remembered for one.
struct PendingReport {
    bool isWanted = false;  // kept until a frame is drawn with its settings, without a menu
    int frames = 0;         // since it was requested
    std::vector<std::string> usedBookmarks{};
};

struct WindowController {
    ui::PanelStates panels;
    ui::DocksState docks;
    ui::MenuState menu;
    ui::ActionKeys keys = ui::defaultKeys();
    std::deque<LogLine> logLines;
    std::optional<ui::TakeScreenshot> screenshotPending;  // kept until a frame is drawn with its settings
    std::filesystem::path itemMapFile;                    // for the positions of controls; empty: not written
    ui::ExportState exports{};                            // of tables and plots
    std::vector<ui::SavePlotPicture> plotsPending{};      // in this frame
    PendingReport report{};
};

// The content of the window that a screenshot shows and its command line reproduces.
struct WindowContent {
    const Session& session;
    const Settings& settings;
    const CameraController& camera;
    const CompareController& compare;
    const Viewport& viewport;
};
void execute(WindowController& controller, const ui::WindowCommand& command, const Window& window,
             const WindowContent& content, Notices& notices);

// Opens the second window while it has panels, and keeps its place in the settings. Closing it moves its panels back. Call
// before a frame.
void followSecondWindow(Window& window, Settings& settings, Notices& notices);
// Returns the layout of both windows.
ui::Layout layoutIn(const Window& window, const Workspace& workspace);

// Reads the keys from keys.toml. A message tells what is wrong in the file.
void readKeys(WindowController& controller, Notices& notices);

// Writes the pictures of plots that were requested in this frame into new files. Call when the frame is drawn but not yet
// presented.
void savePlots(WindowController& controller, const Window& window, Notices& notices);

// Remembers a bookmark that the camera was moved to, for the report.
void noteMove(WindowController& controller, const ui::MoveCamera& move,
              std::span<const ui::Bookmark> bookmarks);

// Call at the start of a frame. Returns true if the frame may be that of the report: nothing is hovered in it.
bool advanceReport(PendingReport& report);
// Writes the requested session report, if any, into a new folder. view: of this frame. Call when the frame is drawn but
// not yet presented.
void keepReport(WindowController& controller, const Window& window, const WindowContent& content,
                const ui::EditorView& view, Notices& notices);

// Writes the requested screenshot, if any, into a new file, with the settings that made it. Call when the
// frame is drawn but not yet presented. Waits for a frame that is drawn as the settings require.
void keepScreenshot(WindowController& controller, const Window& window, const WindowContent& content,
                    Notices& notices);

}  // namespace worldy
