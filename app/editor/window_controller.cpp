#include "app/editor/window_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/editor/overloaded.h"
#include "app/settings/screenshot.h"
#include "app/settings/settings_text.h"
#include "app/settings/shot_line.h"

namespace worldy {

namespace {

using planet::Result;

// Returns the command line that reproduces the main picture. Needs a planet.
std::string lineOf(const WindowContent& content) {
    const planet::View& view = content.viewport.main.view;
    const OpenPlanet& open = *shownPlanet(content.session);
    const double radiusM = open.scene.planet->tree().shape.radiusM;
    return shotLine(open.data.chunkFile, planet::poseFromView(view, radiusM), {view.widthPx, view.heightPx},
                    content.settings.view, content.session.colourFile);
}

void copyCommandLine(const Window& window, const WindowContent& content, Notices& notices) {
    if (!shownScene(content.session) || !content.camera.rig) return;
    const std::string line = lineOf(content);
    window.setClipboard(line);
    notices.log->info("Copied: {}", line);
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

}  // namespace

void readKeys(WindowController& controller, Notices& notices) {
    const KeyFile file = readKeyFile(keyFilePath(), ui::keyedCommands());
    controller.keys = ui::actionKeys(file.keys);
    ui::publishKeyNames(controller.keys);
    if (file.problems.empty()) return;
    for (std::size_t i = 1; i < file.problems.size(); ++i) notices.log->error("{}", file.problems[i]);
    tellError(notices, {"Keys of the key file are not used", problemText(file.problems),
                        "The commands of these lines have their default keys. Fix the file and choose Help > "
                        "Reload keys."});
}

void execute(WindowController& controller, const ui::WindowCommand& command, const Window& window,
             const WindowContent& content, Notices& notices) {
    std::visit(Overloaded{
                   [&](const ui::CopyCommandLine&) { copyCommandLine(window, content, notices); },
                   [&](const ui::CopyText& text) { window.setClipboard(text.text); },
                   [&](const ui::TakeScreenshot& screenshot) { controller.screenshotPending = screenshot; },
                   [&](const ui::WriteKeyFile&) { writeKeys(notices); },
                   [&](const ui::ReloadKeys&) {
                       readKeys(controller, notices);
                       if (notices.message.title.empty()) confirm(notices, "Keys read again");
                   },
                   [&](const ui::Quit&) { window.close(); },
               },
               command);
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
        confirm(notices, fmt::format("Screenshot: {}", file->filename().string()),
                fmt::format("Screenshot: {}", file->string()));
    else
        tellError(notices, {"The screenshot was not saved", file.error().message, ""});
}

}  // namespace worldy
