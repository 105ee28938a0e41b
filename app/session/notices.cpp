#include "app/session/notices.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/flight/flight_record.h"
#include "ui/model/docking.h"

namespace worldy {

namespace {

// A text that is shown already is counted.
void addAlert(Notices& notices, LogLevel level, const std::string& text, double shownS) {
    const double untilS = notices.timeS + shownS;
    const auto shown = std::ranges::find(notices.alerts, text, &ui::Alert::text);
    if (shown == notices.alerts.end()) {
        notices.alerts.push_back({level, text, 1, untilS});
    } else {
        ++shown->count;
        shown->untilS = untilS;
    }
}

}  // namespace

void show(Notices& notices, const std::string& text) {
    notices.confirmation = {text, notices.timeS + confirmationS};
}

void refuse(Notices& notices, const std::string& why) {
    addAlert(notices, LogLevel::Warning, why, confirmationS);
}

void showBriefly(Notices& notices, const std::string& text) {
    constexpr double brieflyS = 1.5;
    notices.confirmation = {text, notices.timeS + brieflyS};
}

void confirm(Notices& notices, const std::string& text) {
    notices.log.info("{}", text);
    show(notices, text);
}

void showError(Notices& notices, ui::Message message) {
    constexpr std::size_t longestText = 2000;  // bytes; the log has the rest
    ui::Message& open = notices.message;
    if (open.title.empty()) {
        open = std::move(message);
        return;
    }
    if (open.text.find(message.text) != std::string::npos || open.text.size() > longestText) return;
    open.text += fmt::format("\n\n{}: {}", message.title, message.text);
    open.offersOpen = open.offersOpen || message.offersOpen;
}

void tellError(Notices& notices, ui::Message message) {
    notices.log.error("{}", message.text);
    showError(notices, std::move(message));
}

void tellOnce(Notices& notices, const Workspace& workspace, PanelId panel, const std::string& title,
              const std::string& problem) {
    std::string& told = notices.told[title];
    if (told == problem) return;
    told = problem;
    if (!problem.empty() && !ui::isVisible(panel, workspace)) showError(notices, {title, problem, ""});
}

void alertOf(Notices& notices, const std::deque<LogLine>& log, std::size_t newLines) {
    const auto isTold = [&](const std::string& text) {
        return notices.message.text.find(text) != std::string::npos ||
               std::ranges::any_of(notices.told, [&](const auto& told) { return told.second == text; });
    };
    for (std::size_t i = log.size() - newLines; i < log.size(); ++i) {
        const LogLine& line = log[i];
        if (line.level < LogLevel::Warning || isTold(line.text)) continue;
        addAlert(notices, line.level, line.text, alertS);
    }
}

bool succeeded(Notices& notices, const planet::Result<void>& result, const std::string& failed) {
    if (!result) tellError(notices, {failed, result.error().message, ""});
    return result.has_value();
}

ui::Message openingFailed(const std::filesystem::path& file, const planet::Error& error) {
    return {fmt::format("{} cannot be opened", file.filename().string()), error.message,
            fmt::format("The open planet is kept. Fix the file or open another: a "
                        "chunk file (.chk), an elevation image or raster, a cube face, a world file or "
                        "settings (.toml), regions (.regions.toml), an atlas (.atlas), a recorded "
                        "flight ({}), a trace (.lodtrace) or one of Worldy's own screenshots (.png).",
                        recordedFlightEnding),
            true};
}

void tellCannotOpen(Notices& notices, const std::filesystem::path& file, const planet::Error& error) {
    tellError(notices, openingFailed(file, error));
}

bool mayChange(const char* what, bool replaying, const Log& log) {
    if (replaying) log.warn("{} cannot be changed during a replay", what);
    return !replaying;
}

}  // namespace worldy
