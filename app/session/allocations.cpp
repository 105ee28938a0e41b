#include "app/session/allocations.h"

#include "app/base/process_memory.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

constexpr double everyS = 1;

void add(const Scene& scene, ui::Allocations& held) {
    held.gpu += scene.renderer.chunks().gpuMemory();
    const planet::Planet& planet = *scene.planet;
    ++held.planets.count;
    held.planets.chunks += planet.paging()[planet::BlockKind::Heights].resident;
    held.planets.chunkSlots += planet.paging()[planet::BlockKind::Heights].capacity;
    held.planets.colourTiles += planet.paging()[planet::BlockKind::Colours].resident;
    held.planets.normalTiles += planet.paging()[planet::BlockKind::Normals].resident;
    held.planets.requests += planet.paging().queued + planet.paging().loading;
    held.history.rememberedEnds += planet.inspect().pagingHistory().size();
}

std::size_t jobsOf(const Session& session) {
    std::size_t jobs = session.ending.size();
    jobs += session.bake && session.bake->job;
    return jobs;
}

}  // namespace

ui::Allocations countAllocations(const AllocationSources& sources) {
    const Session& session = sources.session;
    ui::Allocations held;
    held.atS = sources.timeS;
    held.process.residentBytes = residentProcessBytes();
    held.process.heapBytes = heapBytesInUse();
    held.process.openFiles = openFileHandles();
    held.process.threads = runningThreads();
    held.objects = planet::gl::countObjects();
    if (session.open) add(session.open->scene, held);
    if (session.previous) add(session.previous->scene, held);
    if (sources.other) add(*sources.other, held);
    held.targetBytes = sources.targetBytes;
    held.history.logLines = sources.logLines;
    held.history.frameSamples = sources.frameSamples;
    held.history.recordedBytes = sources.recordedBytes;
    held.process.jobs = jobsOf(session) + sources.jobs;
    return held;
}

void watchAllocations(const AllocationSources& sources, bool panelShown, bool mark,
                      ui::AllocationsView& view) {
    if (mark || (!view.now && shownScene(sources.session)))
        view.now = view.mark = countAllocations(sources);
    else if (panelShown && view.now && sources.timeS - view.now->atS >= everyS)
        view.now = countAllocations(sources);
}

}  // namespace worldy
