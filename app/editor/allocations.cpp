#include "app/editor/allocations.h"

#include "app/base/process_memory.h"
#include "app/editor/editor_state.h"
#include "app/editor/session.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

constexpr double everyS = 1;

void add(const Scene& scene, ui::Allocations& held) {
    held.gpu += scene.renderer.chunks().gpuMemory();
    const planet::Planet& planet = *scene.planet;
    ++held.planets;
    held.chunks += planet.paging()[planet::BlockKind::Heights].resident;
    held.chunkSlots += planet.paging()[planet::BlockKind::Heights].capacity;
    held.colourTiles += planet.paging()[planet::BlockKind::Colours].resident;
    held.normalTiles += planet.paging()[planet::BlockKind::Normals].resident;
    held.requests += planet.paging().queued + planet.paging().loading;
    held.rememberedEnds += planet.inspect().pagingHistory().size();
}

std::size_t jobsOf(const Session& session, const Editor& editor) {
    std::size_t jobs = session.ending.size();
    jobs += session.bake && session.bake->job;
    jobs += session.estimate.job != nullptr;
    jobs += session.preview.job != nullptr;
    jobs += editor.errors.job != nullptr;
    jobs += editor.compare.job != nullptr;
    jobs += editor.sweep.job != nullptr;
    return jobs;
}

}  // namespace

ui::Allocations countAllocations(const Session& session, const Editor& editor) {
    ui::Allocations held;
    held.atS = editor.timeS;
    held.residentBytes = residentProcessBytes();
    held.heapBytes = heapBytesInUse();
    held.openFiles = openFileHandles();
    held.threads = runningThreads();
    held.objects = planet::gl::countObjects();
    if (session.open) add(session.open->scene, held);
    if (session.previous) add(session.previous->scene, held);
    if (editor.compare.other) add(editor.compare.other->planet.scene, held);
    held.targetBytes = gpuBytes(editor.viewport) + gpuBytes(editor.compare);
    held.logLines = editor.logLines.size();
    held.frameSamples = editor.history.size();
    if (editor.desk.recorder) held.recordedBytes = editor.desk.recorder->encoded().bytes();
    held.jobs = jobsOf(session, editor);
    return held;
}

void watchAllocations(const Session& session, Editor& editor) {
    const bool lookedAt = editor.settings.workspace.panels[static_cast<std::size_t>(PanelId::Frame)].shown;
    ui::AllocationsView& view = editor.allocations;
    if (!view.now && shownScene(session)) {
        view.now = view.mark = countAllocations(session, editor);
        return;
    }
    if (lookedAt && view.now && editor.timeS - view.now->atS >= everyS)
        view.now = countAllocations(session, editor);
}

}  // namespace worldy
