#include "app/scene/frame_report.h"

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "app/base/glossary.h"
#include "app/scene/governing.h"
#include "app/settings/camera_text.h"
#include "planet/tree/chunk_tree.h"

namespace worldy {

nlohmann::ordered_json poseJson(const planet::CameraPose& exact) {
    const planet::CameraPose pose = roundedPose(exact);
    return {{"latitude_deg", pose.latitudeDeg},
            {"longitude_deg", pose.longitudeDeg},
            {"altitude_m", pose.altitudeM},
            {"heading_deg", pose.headingDeg},
            {"pitch_deg", pose.pitchDeg}};
}

namespace {

// Returns one object for a total that is counted per kind of block; countOf(counters) picks the total.
template <class CountOf>
nlohmann::ordered_json byKind(const FrameStats& stats, const CountOf& countOf) {
    return {{"heights", countOf(stats.paging[planet::BlockKind::Heights])},
            {"colours", countOf(stats.paging[planet::BlockKind::Colours])},
            {"normals", countOf(stats.paging[planet::BlockKind::Normals])}};
}

nlohmann::ordered_json countersJson(const FrameStats& stats) {
    return {{"visited", stats.selection.visited},
            {"culled_frustum", stats.selection.culledFrustum},
            {"culled_horizon", stats.selection.culledHorizon},
            {terms::drawnChunks.key, stats.selection.drawn},
            {terms::groundTriangles.key, stats.selection.groundTriangles},
            {terms::skirtTriangles.key, stats.selection.skirtTriangles},
            {terms::triangles.key, stats.selection.triangles()},
            {"waiting", stats.selection.waiting},
            {"deepest_level", stats.selection.deepestLevel},
            {"worst_eps_px", stats.selection.worstEpsPx},
            {"worst_drawn_bound_px", stats.selection.worstDrawnBoundPx},
            {"widest_seam", stats.selection.widestSeam},
            {"requests", stats.paging.requested},
            {"queued", stats.paging.queued},
            {"loading", stats.paging.loading},
            {"loaded_blocks", byKind(stats, [](const planet::BlockCounters& kind) { return kind.loaded; })},
            {"evicted_blocks", byKind(stats, [](const planet::BlockCounters& kind) { return kind.evicted; })},
            {"failed_reads", byKind(stats, [](const planet::BlockCounters& kind) { return kind.failed; })},
            {"failed_blocks", stats.paging.failedPermanently()},
            {"budget_waits", stats.paging[planet::BlockKind::Heights].budgetWaits},
            {"resident_chunks", stats.paging[planet::BlockKind::Heights].resident},
            {"resident_bytes_cpu", stats.paging.residentBytesCpu},
            {"resident_bytes_gpu", stats.paging.residentBytesGpu},
            {"bytes_read", stats.paging.bytesRead()},
            {"prefetch_pending", stats.paging.prefetch().pending},
            {terms::prefetchedBlocks.key, stats.paging.prefetch().blocks},
            {"prefetched_bytes", stats.paging.prefetch().bytes},
            {terms::prefetchHits.key, stats.paging.prefetch().hits},
            {terms::prefetchWaste.key, stats.paging.prefetch().wasted},
            {terms::prefetchUnused.key, stats.paging.prefetch().unused()},
            {"upload_ms", stats.stages.uploadMs},
            {"select_ms", stats.stages.selectMs},
            {"paging_ms", stats.stages.pagingMs},
            {"draw_cpu_ms", stats.drawCpuMs},
            {"draw_gpu_ms", stats.render.chunksMs + stats.render.skyMs + stats.render.shadowsMs},
            {"chunks_gpu_ms", stats.render.chunksMs},
            {"sky_gpu_ms", stats.render.skyMs},
            {"frame_ms", stats.frameMs},
            {"colour_tile_bytes", stats.gpuMemory.colourTiles},
            {"clipmap_bytes", stats.gpuMemory.colourClipmap},
            {"clipmap_texels", stats.clipmap.filledTexels}};
}

}  // namespace

nlohmann::ordered_json statsJson(const FrameStats& stats) {
    nlohmann::ordered_json json = countersJson(stats);
    if (!stats.budget.isOn) return json;
    json[terms::tauPx.key] = stats.tauPx;
    json[terms::budgetUse.key] = stats.budget.use;
    json[terms::budgetBinds.key] = bindsKey(stats.budget);
    return json;
}

nlohmann::ordered_json regionsJson(const planet::ChunkTree& tree, const planet::Selection& selection) {
    struct Counted {
        std::string name;
        int touched = 0;
        int decided = 0;
    };
    std::map<std::size_t, Counted> regions;
    for (const planet::DrawItem& item : selection.draw) {
        for (const planet::RegionEffect& effect : planet::regionEffects(tree, item.node)) {
            Counted& counted = regions[effect.region];
            counted.name = effect.name;
            ++counted.touched;
            counted.decided += effect.decides() ? 1 : 0;
        }
    }
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const auto& [region, counted] : regions) {
        json.push_back(
            {{"name", counted.name}, {"drawn_chunks", counted.touched}, {"decided_chunks", counted.decided}});
    }
    return json;
}

std::vector<std::uint32_t> drawnByLevel(const planet::Selection& selection) {
    std::vector<std::uint32_t> levels(selection.counters.deepestLevel + std::size_t{1});
    for (const planet::DrawItem& item : selection.draw) ++levels[item.id.level];
    return levels;
}

}  // namespace worldy
