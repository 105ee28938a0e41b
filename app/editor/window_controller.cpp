#include "app/editor/window_controller.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/base/new_file.h"
#include "app/base/picture_file.h"
#include "app/base/places.h"
#include "app/report/session_report.h"
#include "app/session/overloaded.h"
#include "app/settings/screenshot.h"
#include "app/settings/settings_text.h"
#include "app/settings/shot_line.h"
#include "ui/kit/theme.h"
#include "ui/model/docking.h"
#include "ui/shell/menu_bar.h"
#include "ui/shell/status_bar.h"

namespace worldy {

namespace {

using planet::Result;

// Returns the command line that reproduces the main picture. Needs a planet.
std::string lineOf(const WindowContent& content) {
    const planet::View& view = content.viewport.main.view;
    const OpenPlanet& open = *shownPlanet(content.session);
    const double radiusM = open.scene.planet->tree().shape.radiusM;
    return shotLine(open.data.chunkFile, planet::poseFromView(view, radiusM), {view.widthPx, view.heightPx},
                    content.settings.view, open.data.colourImage,
                    open.sourceIsThere ? open.baked.source : std::filesystem::path());
}

void copyCommandLine(const Window& window, const WindowContent& content, Notices& notices) {
    if (!shownScene(content.session) || !content.camera.rig) return;
    const std::string line = lineOf(content);
    window.setClipboard(line);
    notices.log.info("Copied: {}", line);
    show(notices, "Command line copied");
}

// Returns true while stand-in shaders are used, so that the picture does not match the settings.
bool showsStandIn(const WindowContent& content) {
    const Scene* const scene = shownScene(content.session);
    const auto& other = content.compare.other;
    return (scene && scene->drawn.standIn) || (other && other->planet.scene.drawn.standIn);
}

ScreenshotNote noteOf(const WindowContent& content) {
    ScreenshotNote note;
    note.version = WORLDY_VERSION;
    note.settings = settingsText(content.settings);
    const OpenPlanet* open = shownPlanet(content.session);
    if (!open || !content.camera.rig) return note;
    note.camera = poseOf(content.camera.rig->camera, open->scene.planet->tree().shape.radiusM);
    note.dataSet = open->data.source;
    note.shotLine = lineOf(content);
    return note;
}

void writeKeys(Notices& notices) {
    const std::filesystem::path file = keyFilePath();
    if (succeeded(notices, writeKeyFile(file, ui::keyedCommands()), "The key file was not written"))
        confirm(notices, fmt::format("Keys written: {}", file.string()));
}

// Returns the first problems in lines, and how many more the log has.
std::string problemText(const std::vector<std::string>& problems) {
    constexpr std::size_t most = 6;
    std::string text;
    for (std::size_t i = 0; i < std::min(problems.size(), most); ++i)
        text += (i > 0 ? "\n" : "") + problems[i];
    if (problems.size() > most) text += fmt::format("\n{} more are in the log.", problems.size() - most);
    return text;
}

// Says where a file was saved, or why it was not.
void tellSaved(const Result<std::filesystem::path>& file, Notices& notices) {
    if (!file) return tellError(notices, {"The file was not saved", file.error().message, ""});
    confirm(notices, fmt::format("Saved: {}", file->string()));
}

void saveExport(const ui::SaveExport& save, Notices& notices) {
    tellSaved(writeNewTextFile(picturesFolder(), ui::fileNamePart(save.name), save.extension, save.text),
              notices);
}

Result<std::filesystem::path> savePlot(const ui::SavePlotPicture& plot, const Window& window) {
    const bool isInSecond = plot.rect.x >= ui::secondWindowX;
    const Picture whole = isInSecond ? window.readSecondPicture() : window.readPicture();
    const float left = isInSecond ? ui::secondWindowX : 0;
    const float width = isInSecond ? window.secondRect().width : window.width();
    const float pixelRatio = static_cast<float>(whole.width) / width;
    const auto pixels = [&](float units) { return static_cast<int>(std::lround(units * pixelRatio)); };
    const Picture picture = partOf(whole, pixels(plot.rect.x - left), pixels(plot.rect.y),
                                   pixels(plot.rect.width), pixels(plot.rect.height));
    if (picture.rgb.empty())
        return planet::badInput("The plot is out of sight; scroll to it and save it again");
    Result<std::filesystem::path> file =
        newTimedFile(picturesFolder(), localTimeNow(), ui::fileNamePart(plot.name), "png");
    if (!file) return file;
    if (const Result<void> written = writePicture(picture, *file); !written) {
        std::error_code status;
        std::filesystem::remove(*file, status);  // otherwise an empty file would remain
        return tl::unexpected(written.error());
    }
    return file;
}

}  // namespace

void followSecondWindow(Window& window, Settings& settings, Notices& notices) {
    Workspace& workspace = settings.workspace;
    if (window.takeSecondClosed()) ui::leaveSecondWindow(workspace);
    const bool hasPanels = !ui::panelsIn(Dock::Second, workspace).empty();
    if (!window.showSecond(hasPanels, settings.secondWindow)) {
        ui::leaveSecondWindow(workspace);
        show(notices, "The system cannot open a second window.");
    }
    if (const auto place = window.secondPlace()) settings.secondWindow = *place;
}

ui::Layout layoutIn(const Window& window, const Workspace& workspace) {
    ui::Layout layout = ui::layoutOf(window.width(), window.height(), workspace, ui::menuBarHeight(),
                                     ui::statusBarHeight(), ui::unitPx());
    layout.docks[static_cast<std::size_t>(Dock::Second)] = window.secondRect();
    const glm::vec2 apart(window.secondFromMain());
    layout.secondLeft = apart.x;
    layout.secondTop = apart.y;
    return layout;
}

void readKeys(WindowController& controller, Notices& notices) {
    const KeyFile file = readKeyFile(keyFilePath(), ui::keyedCommands());
    controller.keys = ui::actionKeys(file.keys);
    ui::publishKeyNames(controller.keys);
    if (file.problems.empty()) return;
    for (std::size_t i = 1; i < file.problems.size(); ++i) notices.log.error("{}", file.problems[i]);
    tellError(notices, {"Keys of the key file are not used", problemText(file.problems),
                        "The commands of these lines have their default keys. Fix the file and choose Help > "
                        "Reload keys."});
}

void execute(WindowController& controller, const ui::WindowCommand& command, const Window& window,
             const WindowContent& content, Notices& notices) {
    std::visit(Overloaded{
                   [&](const ui::CopyCommandLine&) { copyCommandLine(window, content, notices); },
                   [&](const ui::CopyText& text) {
                       window.setClipboard(text.text);
                       if (!text.done.empty()) show(notices, text.done);
                   },
                   [&](const ui::SaveExport& save) { saveExport(save, notices); },
                   [&](const ui::SavePlotPicture& plot) { controller.plotsPending.push_back(plot); },
                   [&](const ui::TakeScreenshot& screenshot) { controller.screenshotPending = screenshot; },
                   [&](const ui::WriteKeyFile&) { writeKeys(notices); },
                   [&](const ui::ReloadKeys&) {
                       readKeys(controller, notices);
                       if (notices.message.title.empty()) confirm(notices, "Keys read again");
                   },
                   [&](const ui::SaveReport&) {
                       controller.report.isWanted = true;
                       controller.report.frames = 0;
                   },
                   [&](const ui::Quit&) { window.close(); },
               },
               command);
}

void savePlots(WindowController& controller, const Window& window, Notices& notices) {
    for (const ui::SavePlotPicture& plot : std::exchange(controller.plotsPending, {}))
        tellSaved(savePlot(plot, window), notices);
}

void noteMove(WindowController& controller, const ui::MoveCamera& move,
              std::span<const ui::Bookmark> bookmarks) {
    std::vector<std::string>& used = controller.report.usedBookmarks;
    for (const ui::Bookmark& bookmark : bookmarks) {
        const auto values = [](const planet::CameraPose& pose) {
            return std::array{pose.latitudeDeg, pose.longitudeDeg, pose.altitudeM, pose.headingDeg,
                              pose.pitchDeg};
        };
        const bool isNew = std::find(used.begin(), used.end(), bookmark.name) == used.end();
        if (isNew && values(bookmark.pose) == values(move.pose)) used.push_back(bookmark.name);
    }
}

bool advanceReport(PendingReport& report) {
    // The menu is still drawn in the frame of the request.
    return report.isWanted && ++report.frames >= 1;
}

void keepReport(WindowController& controller, const Window& window, const WindowContent& content,
                const ui::EditorView& view, Notices& notices) {
    PendingReport& report = controller.report;
    if (!report.isWanted || report.frames < 1 || showsStandIn(content)) return;
    report.isWanted = false;
    const OpenPlanet* const open = shownPlanet(content.session);
    if (!open || !view.planet) {
        tellError(notices, {"The report was not saved", "No planet is open; open one first", ""});
        return;
    }
    const planet::gl::RenderTarget* const target =
        (content.viewport.main.shown() ? content.viewport.main : content.viewport.observer).shownTarget();
    const Picture planet =
        target ? Picture{target->widthPx(), target->heightPx(), target->readRgb()} : Picture();
    const ReportFacts facts{.writtenAt = fmt::format("{:%Y-%m-%d %H:%M}", localTimeNow()),
                            .version = WORLDY_VERSION,
                            .openGl = window.openGlText(),
                            .commandLine = lineOf(content),
                            .usedBookmarks = report.usedBookmarks,
                            .file = &open->scene.planet->file()};
    const Result<std::filesystem::path> folder = writeSessionReport(
        picturesFolder(), sessionReport(view, content.settings, facts), planet, window.readPicture());
    if (!folder) return tellError(notices, {"The report was not saved", folder.error().message, ""});
    confirm(notices, fmt::format("Report saved: {}", (*folder / "report.md").string()));
}

void keepScreenshot(WindowController& controller, const Window& window, const WindowContent& content,
                    Notices& notices) {
    if (!controller.screenshotPending || showsStandIn(content)) return;
    const bool withPanels = std::exchange(controller.screenshotPending, std::nullopt)->withPanels;
    const Viewport& viewport = content.viewport;
    const PlanetPicture& shown = viewport.main.shown() ? viewport.main : viewport.observer;
    const planet::gl::RenderTarget* target = shown.shownTarget();
    if (!withPanels && !target) return;
    const Picture picture =
        withPanels ? window.readPicture() : Picture{target->widthPx(), target->heightPx(), target->readRgb()};
    const Result<std::filesystem::path> file = writeNewScreenshot(picture, noteOf(content));
    if (file)
        confirm(notices, fmt::format("Screenshot: {}", file->string()));
    else
        tellError(notices, {"The screenshot was not saved", file.error().message, ""});
}

}  // namespace worldy
