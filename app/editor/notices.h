// Reports to the user what became of a request: in the log, in a message box, and in a line over the
// viewport. Main thread.
#pragma once

#include <filesystem>
#include <string>

#include "app/base/log.h"
#include "planet/base/result.h"
#include "ui/shell/message_box.h"

namespace worldy {

struct Notices {
    const Log& log;
    ui::Message message{};
    ui::Confirmation confirmation{};
    double timeS = 0;  // of this frame, since the window opened
};

inline constexpr double confirmationS = 5;  // how long a confirmation is shown

// Shows for some seconds in the viewport that a request is done.
void show(Notices& notices, const std::string& text);
// Does the same and writes it to the log.
void confirm(Notices& notices, const std::string& text);
// Does the same with a longer text for the log: whole paths are too long for the viewport.
void confirm(Notices& notices, const std::string& text, const std::string& logged);
// Reports in the log and in a message box why a request failed, and what to do about it.
void tellError(Notices& notices, ui::Message message);
// Reports a result that is an Error, with what the user asked for as the title. Returns true if it is none.
bool succeeded(Notices& notices, const planet::Result<void>& result, const std::string& failed);

// Returns the message for a file that cannot be opened, and reports it.
ui::Message openingFailed(const std::filesystem::path& file, const planet::Error& error);
void tellCannotOpen(Notices& notices, const std::filesystem::path& file, const planet::Error& error);

// Returns false, and warns, while a replay runs: it owns settings and paging until it ends.
bool mayChange(const char* what, bool replaying, const Log& log);

}  // namespace worldy
