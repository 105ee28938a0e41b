// Reports the outcome of a request to the user: in the log, in a message box, or in a line over the viewport.
// Main thread.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/settings/workspace.h"
#include "planet/base/result.h"
#include "ui/shell/message_box.h"

namespace worldy {

struct Notices {
    const Log& log;
    ui::Message message{};
    ui::Confirmation confirmation{};
    std::vector<ui::Alert> alerts{};
    double timeS = 0;                           // time of this frame since the window opened
    std::map<std::string, std::string> told{};  // the problem that tellOnce() was last called with, by title
};

inline constexpr double confirmationS = 5;  // how long a confirmation is shown
inline constexpr double alertS = 12;        // how long an alert is shown

// Shows a value for a moment after each of its changes.
void showBriefly(Notices& notices, const std::string& text);
// Shows in the viewport for confirmationS that a request is done.
void show(Notices& notices, const std::string& text);
// Shows in the viewport for confirmationS, as a warning, why a request is refused.
void refuse(Notices& notices, const std::string& why);
// Does the same as show() and writes it to the log. What was saved is told with its whole path.
void confirm(Notices& notices, const std::string& text);
// Shows a message box about an error that is in the log already. If one is open, the text is added to it, once.
void showError(Notices& notices, ui::Message message);
// Reports in the log and in a message box why a request failed and what to do about it.
void tellError(Notices& notices, ui::Message message);
// Shows once in a message box a problem that a panel tells as long as it lasts, unless the panel is in sight. problem: empty
// if there is none. It is in the log already.
void tellOnce(Notices& notices, const Workspace& workspace, PanelId panel, const std::string& title,
              const std::string& problem);
// Shows for alertS the warnings and errors among the newest lines of the log, unless tellError(), showError() or
// tellOnce() has told them. newLines: how many are new.
void alertOf(Notices& notices, const std::deque<LogLine>& log, std::size_t newLines);
// Reports an Error with failed as the title. Returns true if the result is not an Error.
bool succeeded(Notices& notices, const planet::Result<void>& result, const std::string& failed);

// Returns the message for a file that cannot be opened; tellCannotOpen() also reports it.
ui::Message openingFailed(const std::filesystem::path& file, const planet::Error& error);
void tellCannotOpen(Notices& notices, const std::filesystem::path& file, const planet::Error& error);

// Returns false and logs a warning during a replay, which controls settings and paging until it ends.
bool mayChange(const char* what, bool replaying, const Log& log);

}  // namespace worldy
