#include "app/editor/editor_actions.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "app/data/recent_files.h"

namespace worldy {

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
    editor.pops.side = PopSide::Live;
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
    editor.pops.side = PopSide::Live;
    if (editor.rig) placeRig(*editor.rig, before->camera, editor.settings.view.camera);
    if (editor.desk.replay) {
        editor.desk.replay->controls.playing = before->replayPlaying;
        return;
    }
    editor.lodView = before->lodView;
    editor.lodFrozen = before->lodFrozen;
    editor.stepOneFrame = true;
}

void freezeLod(Editor& editor, bool frozen) {
    editor.lodFrozen = frozen;
    editor.beforeInspection.reset();  // the user takes over from here
    if (!frozen) editor.pops.side = PopSide::Live;
}

void confirm(Editor& editor, const Log& log, const std::string& text) {
    confirm(editor, log, text, text);
}

void confirm(Editor& editor, const Log& log, const std::string& text, const std::string& logged) {
    log->info("{}", logged);
    editor.confirmation = {text, editor.timeS + confirmationS};
}

void tellError(Editor& editor, const Log& log, ui::Message message) {
    log->error("{}", message.text);
    editor.message = std::move(message);
}

bool followOpening(const Session& session, Editor& editor) {
    if (!editor.opening || session.bake) return false;
    const std::filesystem::path file = *std::exchange(editor.opening, std::nullopt);
    if (!session.problem) {
        addRecentFile(editor.recent, file);
        editor.recentShown = shownRecentFiles(editor.recent);
        return true;
    }
    if (session.open && session.problem->kind != planet::ErrorKind::Cancelled)
        editor.message = {fmt::format("{} cannot be baked", file.filename().string()),
                          session.problem->message,
                          "The open planet is kept. Fix the file or open another one.", true};
    return false;
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

}  // namespace worldy
