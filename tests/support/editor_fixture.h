// A planet that panels can look at without a window: opened, flown for some frames, and gathered into the
// view that the application hands to panels.
#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/governing.h"
#include "app/trace/trace_what_if_job.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/traced_flight.h"
#include "ui/shell/panels.h"

namespace worldy::test {

class EditorFixture {
public:
    explicit EditorFixture(std::unique_ptr<planet::Planet> planet) : planet_(std::move(planet)) {}

    // Flies towards the ground over some frames, a sixtieth of a second each.
    void fly(ViewSettings settings, int frames) {
        planet::LodSettings lod = planet::suddenLod();
        lod.tauPx = settings.lod.tauPx;
        lod.hysteresis = settings.lod.hysteresis;
        lod.morph = settings.lod.morph;
        for (int frame = 0; frame < frames; ++frame) {
            const double share = frames > 1 ? static_cast<double>(frame) / (frames - 1) : 1;
            pose_.altitudeM = 4e6 * (1 - share) + altitudeM * share;
            pose_.pitchDeg = -90 + 60 * share;
            view_ = planet::viewFromPose(pose_, planet_->tree().shape.radiusM, 1.05, 1280, 720);
            const auto upload = [](std::uint32_t, planet::StepsView) {};
            lod.tauPx = settings.lod.tauPx;
            if (frame + 1 == frames)
                planet_->settle(view_, lod, upload, 60);
            else
                planet_->step(view_, lod, upload);
            timeS_ += 1.0 / 60;
            changes_.add(planet_->selection(), timeS_);
            stats_.selection = planet_->selection().counters;
            stats_.paging = planet_->paging();
            stats_.stages = planet_->lastStep().times;
            stats_.frameMs = 16.7;
            stats_.drawCpuMs = 2 + frame % 3;
            stats_.panelsMs = 1;
            stats_.render.chunksMs = 2 + 2e-5 * static_cast<double>(stats_.selection.triangles());
            stats_.tauPx = lod.tauPx;
            governTau(governing_, &stats_, *planet_, 1.0 / 60, settings);
            stats_.budget = governing_.use;
            history_.push_back({timeS_, stats_});
            recordFrame();
        }
    }

    ui::EditorView view() const {
        ui::EditorView view{.planet = planet_.get(),
                            .frames = {.stats = stats_,
                                       .history = history_,
                                       .timeS = timeS_,
                                       .timeline = &timeline_,
                                       .gpuClockErrorNs = 400},
                            .log = log_,
                            .instruments = {.changes = changes_}};
        view.camera.lodView = view.camera.renderView = view_;
        view.data.name = "earth.chk";
        view.data.hasColourImage = true;
        view.camera.pose = pose_;
        view.camera.bookmarks = bookmarks_;
        view.settings.presets = presets_;
        view.instruments.allocations.now = allocations();
        view.instruments.allocations.mark = allocations();
        view.instruments.allocations.mark.process.heapBytes -= 3 << 20;
        view.instruments.allocations.mark.process.threads = 5;
        if (traced_) {
            view.trace.file = traced_->file;
            view.trace.wanted = TracedFlight::plantedFirst;
            view.trace.whatIf.result = &*traced_;
        }
        if (!planet_->selection().draw.empty()) {
            view.focus.selected = planet_->selection().draw.front().id;
            view.focus.hovered = planet_->selection().draw.back().id;
        }
        return view;
    }

    const FrameTimeline& timeline() const { return timeline_; }

    // Writes a trace of another engine and selects in it again with some tolerances.
    void trace(const std::filesystem::path& file) {
        const TracedFlight flight(file);
        TraceWhatIfRequest request;
        for (const double tauPx : {0.5, 1.0, 2.0, 4.0, 8.0}) {
            request.settings.emplace_back();
            request.settings.back().tauPx = tauPx;
        }
        request.goal = planet::TraceTauGoal{.errorPx = 3, .bytes = 16e6};
        if (auto found = runTraceWhatIf(file, request, {})) traced_ = *std::move(found);
    }

    ui::Allocations allocations() const {
        ui::Allocations held;
        held.process.residentBytes = 412 << 20;
        held.process.heapBytes = 138 << 20;
        held.process.openFiles = 11;
        held.process.threads = 7;
        held.gpu.heightPool = 64 << 20;
        held.gpu.textures = 31 << 20;
        held.objects = {41, 57, 9, 12, 2, 14, 0, 18};
        held.planets.count = 1;
        held.planets.chunks = planet_->paging()[planet::BlockKind::Heights].resident;
        held.planets.chunkSlots = planet_->paging()[planet::BlockKind::Heights].capacity;
        held.history.rememberedEnds = planet_->inspect().pagingHistory().size();
        held.history.frameSamples = history_.size();
        return held;
    }

    double altitudeM = 60'000;
    std::deque<LogLine> log_;
    std::vector<ui::PresetView> presets_{
        {"crack hunting",
         "/usr/share/worldy/presets/crack hunting.toml",
         {},
         {{"overlay.outlines", "false", "true", "Outlines"},
          {"overlay.skirt_paint", "as_ground", "loud", "Skirts"}},
         true},
        {"default", "/usr/share/worldy/presets/default.toml", {}, {}, true},
        {"broken",
         "/home/me/.config/worldy/presets/broken.toml",
         "broken.toml: line 2: lod.tau_px is 1000",
         {}},
    };

private:
    // Adds a frame of 16.7 ms to the timeline: a span of each stage, one of the GPU, and a load of each of two loaders. In each
    // frame a chunk splits, and its children came.
    void recordFrame() {
        constexpr std::int64_t frameNs = 16'700'000, stepNs = 2'000'000;
        const std::int64_t beginNs = 1'000'000'000 + frameNs * static_cast<std::int64_t>(history_.size());
        const std::vector<planet::DrawItem>& drawn = planet_->selection().draw;
        const planet::ChunkId chunk = drawn.empty() ? planet::ChunkId{} : drawn.front().id;
        timeline_.beginFrame(history_.size(), beginNs, beginNs);
        timeline_.add(ChunkChangeKind::Came, chunk, 2.5);
        timeline_.add(ChunkChangeKind::Split, chunk);
        timeline_.add(ChunkChangeKind::Popped, chunk, 1.25);
        const auto span = [&](const char* name, std::int64_t fromNs, std::int64_t toNs, bool loads = false) {
            planet::Span made;
            made.name = name;
            made.beginNs = beginNs + fromNs;
            made.endNs = beginNs + toNs;
            made.block = chunk;
            made.hasBlock = loads;
            return made;
        };
        std::vector<planet::Span> main;
        std::int64_t atNs = 0;
        for (const char* stage : {"input", "jobs", "planet", "panels", "draw panels", "present"}) {
            main.push_back(span(stage, atNs, atNs + stepNs));
            atNs += stepNs;
        }
        timeline_.add(planet::SpanBatch{0, "main", main, 0});
        const std::array gpu = {span("chunks", stepNs, 3 * stepNs)};
        timeline_.add(planet::SpanBatch{1, "GPU", gpu, 0});
        for (std::size_t loader = 1; loader <= 2; ++loader) {
            const std::array load = {span("load", 0, 2'500'000, true)};
            timeline_.add(planet::SpanBatch{1 + loader, "loader " + std::to_string(loader), load, 0});
        }
    }

    std::unique_ptr<planet::Planet> planet_;
    planet::CameraPose pose_{.latitudeDeg = 28, .longitudeDeg = 86, .altitudeM = 4e6};
    planet::View view_;
    planet::LodChanges changes_;
    Governing governing_;
    FrameStats stats_;
    std::deque<ui::FrameSample> history_;
    FrameTimeline timeline_;
    std::optional<TraceWhatIfResult> traced_;
    std::vector<ui::Bookmark> bookmarks_{{"Himalaya", {}, true}, {"My ridge", {}, false}};
    double timeS_ = 0;
};

}  // namespace worldy::test
