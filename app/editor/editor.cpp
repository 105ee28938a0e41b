#include "app/editor/editor.h"

#include <imgui.h>

#include <utility>

#include "app/base/process_memory.h"
#include "app/base/stopwatch.h"
#include "app/data/recent_files.h"
#include "app/editor/allocations.h"
#include "app/editor/commands.h"
#include "app/editor/editor_actions.h"
#include "app/editor/editor_panels.h"
#include "app/editor/editor_planet.h"
#include "app/editor/item_map_file.h"
#include "app/editor/shortcuts.h"
#include "ui/kit/theme.h"
#include "ui/shell/status_bar.h"

namespace worldy {

namespace {

constexpr double historyS = 10;

void remember(const FrameStats& stats, Editor& editor) {
    editor.stats = smoothed(editor.stats, stats);
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
    advanceSession(session, editor.settings.view, log);
    if (followOpening(session, editor)) {
        if (const auto saved = saveRecentFiles(editor.recent, recentFilesFile()); !saved)
            log->error("{}", saved.error().message);
    }
    advanceSweep(editor.sweep, log);
    reloadChangedShaders(session, log);
    FrameStats stats;
    if (Scene* scene = shownScene(session))
        stats = runPlanet(*scene, pixelRatio, editor, log, secondsSinceLast, commands);

    const Stopwatch panelWatch;
    log.moveNewLines(editor.logLines);
    const ViewSettings before = editor.settings.view;
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
