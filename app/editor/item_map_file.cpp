#include "app/editor/item_map_file.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "app/settings/camera_text.h"
#include "planet/base/atomic_file.h"

namespace worldy {

std::vector<Counter> countersOf(const CounterSources& sources, const FrameStats& stats,
                                std::size_t queuedInput) {
    const Session& session = sources.session;
    const CameraController& camera = sources.camera;
    const RecordingController& recording = sources.recording;
    const SweepController& sweep = sources.sweep;
    const CompareController& compare = sources.compare;
    const planet::PagingCounters& paging = stats.paging;
    const planet::SelectionCounters& selection = stats.selection;
    std::vector<Counter> counters;
    const auto add = [&](const std::string& name, const auto& value) {
        counters.push_back({name, fmt::format("{}", value)});
    };
    add("frame", sources.frames.frame);
    add("queued_input", queuedInput);
    add("moving", sources.frames.activity.kind == Activity::Motion ? 1 : 0);
    const FrameStats* const b = compare.other ? &compare.other->stats : nullptr;
    add("stand_in", stats.render.standIn || (b && b->render.standIn) ? 1 : 0);
    add("drawn", selection.drawn);
    add("triangles", stats.selection.triangles());
    add("waiting", selection.waiting);
    add("deepest", selection.deepestLevel);
    add("widest_seam", selection.widestSeam);
    add("resident", paging[planet::BlockKind::Heights].resident);
    add("queued", paging.queued);
    add("loading", paging.loading);
    add("requested", paging.requested);
    const auto addTotals = [&](const std::string& kind, const auto& totals) {
        add("loaded_" + kind, totals.loaded);
        add("evicted_" + kind, totals.evicted);
        add("failed_" + kind, totals.failed);
    };
    addTotals("heights", paging[planet::BlockKind::Heights]);
    addTotals("colours", paging[planet::BlockKind::Colours]);
    addTotals("normals", paging[planet::BlockKind::Normals]);
    add("failed_for_good", paging.failedPermanently());
    add("awaiting_retry", paging.awaitingRetry());
    add("colour_tiles", paging[planet::BlockKind::Colours].resident);
    add("selected", sources.focus.selected ? planet::toString(*sources.focus.selected) : std::string("none"));
    if (const Scene* scene = shownScene(session); scene && camera.rig) {
        const double radiusM = scene->planet->tree().shape.radiusM;
        add("camera", cameraText(roundedPose(poseOf(camera.rig->camera, radiusM))));
        add("chunk_size", planet::chunkSize(scene->planet->tree().shape));
        add("file", scene->planet->file().name());
    }
    add("lod_frozen", camera.lodFrozen ? 1 : 0);
    add("recorded", recording.recorder ? recording.recorder->encoded().frames() : 0);
    add("replayed", recording.replay ? recording.replay->replay.next() : 0);
    add("different", recording.replay ? recording.replay->replay.framesDifferent() : 0);
    add("compared", compare.other ? 1 : 0);
    add("triangles_b", compare.other ? compare.other->stats.selection.triangles() : 0);
    add("pixels_differ", compare.difference ? static_cast<long long>(compare.difference->pixels) : -1);
    add("compare_flown", compare.flight.last ? 1 : 0);
    add("baking", session.bake ? 1 : 0);
    add("sweeping", sweep.job ? 1 : 0);
    add("swept", sweep.table ? sweep.table->points.size() : 0);
    add("suggested", sweep.suggestions.size());
    return counters;
}

void writeItemMap(const std::filesystem::path& file, std::span<const ui::ItemPlace> items,
                  std::span<const Counter> counters) {
    std::string text;
    for (const Counter& counter : counters)
        text += fmt::format("counter/{}\t{}\n", counter.name, counter.value);
    for (const ui::ItemPlace& item : items) {
        text += fmt::format("{}\t{:.0f}\t{:.0f}\t{:.0f}\t{:.0f}\n", item.name, item.rect.x, item.rect.y,
                            item.rect.width, item.rect.height);
    }
    std::error_code status;
    // A symbolic link stays a link, and a replaced file keeps its mode.
    const std::filesystem::path target = planet::linkTarget(file).value_or(file);
    const std::filesystem::path unfinished = target.string() + ".part";
    std::ofstream(unfinished) << text;
    const std::filesystem::file_status there = std::filesystem::status(target, status);
    if (std::filesystem::is_regular_file(there))
        std::filesystem::permissions(unfinished, there.permissions(), status);
    std::filesystem::rename(unfinished, target, status);
}

std::uint64_t askedFrame(const std::filesystem::path& itemMap) {
    std::ifstream file(itemMap.string() + ".ask");
    std::uint64_t frame = 0;
    return file >> frame ? frame : 0;
}

}  // namespace worldy
