#include "app/editor.h"

#include <imgui.h>

#include <utility>

#include "app/allocations.h"
#include "app/commands.h"
#include "app/editor_panels.h"
#include "app/editor_planet.h"
#include "app/item_map_file.h"
#include "app/process_memory.h"
#include "app/recent_files.h"
#include "app/shortcuts.h"
#include "app/stopwatch.h"
#include "ui/status_bar.h"
#include "ui/theme.h"

namespace worldy {

namespace {

constexpr double historyS = 10;

void remember(const ui::FrameStats& stats, Editor& editor) {
    editor.stats = ui::smoothed(editor.stats, stats);
    editor.history.push_back({editor.timeS, stats});
    while (editor.history.front().timeS < editor.timeS - historyS) editor.history.pop_front();
}

}  // namespace

Editor openEditor(const Settings& settings, const Log& log) {
    Editor editor;
    editor.settings = settings;
    editor.bookmarks = loadBookmarks(bookmarksFile());
    if (!editor.bookmarks.problem.empty()) log->warn("{}", editor.bookmarks.problem);
    editor.flights = availableFlights();
    editor.desk = openFlightDesk(recordingsFolder());
    editor.recent = loadRecentFiles(recentFilesFile());
    editor.recentShown = shownRecentFiles(editor.recent);
    return editor;
}

void forgetChanges(Editor& editor) {
    editor.changes.clear();
    forgetPops(editor.pops);
    forgetPopsOfA(editor.compare);
}

void inspect(Editor& editor, const Camera& camera, const planet::View& lodView) {
    FlightDesk& desk = editor.desk;
    if (!editor.beforeInspection)
        editor.beforeInspection = BeforeInspection{editor.rig->camera, editor.lodView, editor.lodFrozen,
                                                   desk.replay && desk.replay->controls.playing};
    placeRig(*editor.rig, camera, editor.settings.view.camera);
    if (desk.replay) {
        desk.replay->controls.playing = false;
        return;
    }
    editor.lodFrozen = true;
    if (editor.lodView == lodView) return;
    editor.lodView = lodView;
    editor.stepOneFrame = true;  // paused frames choose for it too
}

void endInspection(Editor& editor) {
    const std::optional<BeforeInspection> before = std::exchange(editor.beforeInspection, std::nullopt);
    if (!before) return;
    if (editor.rig) placeRig(*editor.rig, before->camera, editor.settings.view.camera);
    if (editor.desk.replay) {
        editor.desk.replay->controls.playing = before->replayPlaying;
        return;
    }
    editor.lodView = before->lodView;
    editor.lodFrozen = before->lodFrozen;
    editor.stepOneFrame = true;
}

void confirm(Editor& editor, const Log& log, const std::string& text) {
    log->info("{}", text);
    editor.confirmation = {text, editor.timeS + confirmationS};
}

void tellError(Editor& editor, const Log& log, ui::Message message) {
    log->error("{}", message.text);
    editor.message = std::move(message);
}

void endReplay(Editor& editor, Scene* scene) {
    if (!editor.desk.replay) return;
    editor.beforeInspection.reset();  // it belongs to the replay
    const BeforeReplay before = stopReplay(editor.desk, scene);
    editor.settings.view = before.settings;
    editor.pagingPaused = before.pagingPaused;
    if (editor.rig) editor.rig->camera = before.camera;
    editor.lodView = before.lodView;
    editor.lodFrozen = before.lodFrozen;
    forgetChanges(editor);
    editor.stepOneFrame = true;
}

void endFlights(Session& session, Editor& editor, const Log& log) {
    Scene* scene = shownScene(session);
    endReplay(editor, scene);
    stopRecording(editor.desk, scene ? scene->planet.get() : nullptr, log);
}

void runFrame(Window& window, Session& session, Editor& editor, Log& log, double secondsSinceLast) {
    editor.timeS += secondsSinceLast;
    window.setTheme(editor.settings.workspace.theme, editor.settings.workspace.scale);
    // While there is only a bake to be seen, the cores have better things to do than to draw the same bar
    // again; and while a sweep measures frame times, than to disturb them. Input is answered at once.
    window.beginFrame(shownScene(session) && !editor.sweep.job ? 0 : 0.05);
    const float pixelRatio = window.pixelRatio();
    const ui::Layout layout = ui::layoutOf(window.width(), window.height(), editor.settings.workspace,
                                           ui::menuBarHeight(), ui::statusBarHeight(), ui::unitPx());
    layOut(editor.viewport, layout.viewport, editor.settings.view.camera.observer);
    std::vector<ui::ItemPlace> items;
    ui::collectItems(editor.itemMapFile.empty() ? nullptr : &items);

    ui::Commands commands;
    // Where the panel was in the frame before, if it was drawn at all.
    const bool dropsAreColours = std::exchange(editor.panels.bake.colour.takesDrops, false);
    for (const std::filesystem::path& file : window.droppedFiles()) {
        if (dropsAreColours)
            commands.push_back(ui::ChooseColourImage{file});
        else
            commands.push_back(ui::OpenFile{file});
    }
    const bool hadProblem = session.problem.has_value();
    advanceSession(session, editor.settings.view, log);
    // With no planet the viewport itself says why; the log has it already.
    if (!hadProblem && session.problem && shownScene(session) &&
        session.problem->kind != planet::ErrorKind::Cancelled)
        editor.message = {"The file cannot be baked", session.problem->message,
                          "The planet that is open stays. Correct the file, or open another one."};
    advanceSweep(editor.sweep, log);
    reloadChangedShaders(session, log);
    ui::FrameStats stats;
    if (Scene* scene = shownScene(session))
        stats = runPlanet(*scene, pixelRatio, editor, log, secondsSinceLast, commands);

    const Stopwatch panelWatch;
    log.moveNewLines(editor.logLines);
    const ui::ViewSettings before = editor.settings.view;
    const ui::EditorView view = gatherView(session, editor);
    drawPanels(session, view, layout, pixelRatio, editor, commands);
    obeyShortcuts(window.pressedKeys(),
                  {view, editor.settings.view, editor.settings.workspace, editor.menu, commands});
    // A replay's settings are not the user's.
    if (!editor.desk.replay)
        editor.undo.record(before, editor.settings.view, ImGui::IsAnyItemActive(), editor.timeS);
    obey(commands, window, session, editor, log);
    stats.panelsMs = panelWatch.elapsedMs();
    ui::collectItems(nullptr);

    window.endFrame([&] { keepScreenshot(window, session, editor, log); });
    stats.panelsGpuMs = window.panelsGpuMs();
    stats.presentMs = window.presentMs();
    stats.frameMs = 1000 * secondsSinceLast;
    stats.processBytes = residentProcessBytes();
    remember(stats, editor);
    watchAllocations(session, editor);
    ++editor.frames;
    if (!editor.itemMapFile.empty())
        writeItemMap(editor.itemMapFile, items, countersOf(session, editor, stats, window.queuedInput()));
}

}  // namespace worldy
