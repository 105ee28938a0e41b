#include "app/editor/editor_actions.h"

#include <optional>
#include <utility>

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

}  // namespace worldy
