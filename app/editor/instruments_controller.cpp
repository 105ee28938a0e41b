#include "app/editor/instruments_controller.h"

#include <utility>

#include "app/editor/instrument_views.h"
#include "app/measure/probe.h"
#include "planet/measure/pick.h"

namespace worldy {

namespace {

using planet::Result;

constexpr int costRounds = 5;

struct InstrumentHandler {
    InstrumentsController& instruments;
    const InstrumentContext& context;
    Notices& notices;

    bool isThere() const { return context.scene && context.camera.rig; }

    void operator()(const ui::MarkAllocations&) const { instruments.markAllocations = true; }
    void operator()(const ui::TryCostlyParts&) const {
        if (context.scene) context.scene->turnedDown = {.fastAtS = notices.timeS};
    }
    void operator()(const ui::MeasureCosts&) const {
        if (!context.scene) return;
        Result<CostMeter> meter =
            CostMeter::create(*context.scene, context.view, context.settings, costRounds);
        if (meter)
            instruments.costs.meter = std::move(*meter);
        else
            tellError(notices, {"The features were not measured", meter.error().message, ""});
    }
    void operator()(const ui::MeasureCracks&) const {
        if (!isThere()) return;
        if (!succeeded(notices,
                       measureNow(instruments.cracks, *context.scene, context.view, context.settings),
                       "The cracks were not measured"))
            context.settings.cracks.live = false;  // it would fail again
    }
    void operator()(const ui::FindSmallestSkirts&) const {
        if (!isThere()) return;
        succeeded(notices,
                  findSmallestNow(instruments.cracks, *context.scene, context.view, context.settings),
                  "The smallest skirts were not found");
    }
    void operator()(const ui::MeasurePops& command) const { instruments.pops.measuring = command.on; }
    void operator()(const ui::ClearPops&) const { forgetPops(instruments.pops); }
    void operator()(const ui::GoBackToPop& command) const {
        const planet::PopEvent* event = findPop(instruments.pops, command.frame, command.chunk);
        if (!event || !isThere()) return;
        instruments.pops.shown = *event;
        context.focus.selected = event->chunk;
        inspect(context.camera, {event->view.eyeM, event->view.right, event->view.back}, event->view,
                context.cameraContext);
    }
    void operator()(const ui::ShowPopSide& command) const { instruments.pops.side = command.side; }
    void operator()(const ui::TakeRulerClicks& command) const { instruments.ruler.takesClicks = command.on; }
    void operator()(const ui::PlaceRulerEnd& command) const {
        placeRulerEnd(instruments.ruler, command.positionM);
    }
    void operator()(const ui::SwapRulerEnds&) const { swapRulerEnds(instruments.ruler); }
    void operator()(const ui::ClearRuler&) const { clearRuler(instruments.ruler); }
    void operator()(const ui::HoverProfile& command) const { instruments.ruler.pointed = command.point; }
    void operator()(const ui::MeasureErrors&) const { instruments.errors.wanted = true; }
    void operator()(const ui::KeepMeasuringErrors& command) const {
        instruments.errors.keepMeasuring = command.on;
    }
};

// Measures part of the costs in each frame, so that the window stays responsive.
void measureCosts(Scene& scene, CostInstrument& instrument) {
    if (!instrument.meter || instrument.meter->step(scene)) return;
    instrument.costs = instrument.meter->costs();
    instrument.meter.reset();
}

// Probes the vertex under the pointer in the main picture; keeps the last one while the pointer is elsewhere.
void probe(const DrawnFrame& drawn, ui::ProbeView& probe) {
    if (!isShown(drawn.settings.workspace, PanelId::Probe)) return;
    const PlanetPicture& picture = drawn.picture;
    const planet::Planet& planet = *drawn.scene.planet;
    const ProbeInput input{planet.tree(), planet.selection(), picture.view,
                           drawn.scene.renderer.chunks().projection(),
                           drawn.settings.view.lod.seams == planet::SeamMode::Stitched};
    probe.overGround = false;
    if (picture.shown() && picture.pointer.over) {
        const std::optional<planet::SurfaceHit> hit =
            planet::pickSurface(planet.tree(), planet.selection().draw, picture.view.eyeM,
                                rayThrough(picture.view, picture.pointer.positionPx));
        probe.overGround = hit.has_value();
        if (hit) probe.vertex = probeHit(input, *hit);
    }
    probe.selected.reset();
    if (drawn.focus.selected) probe.selected = probeWorst(input, *drawn.focus.selected);
}

// Turns off features that are too slow, except while measurements draw other content.
void watchCosts(const DrawnFrame& drawn, const CostInstrument& costs, const Log& log) {
    Scene& scene = drawn.scene;
    if (scene.renderer.chunks().capabilities().software || costs.meter) return;
    const planet::gl::RenderCounters& counters = scene.drawn;
    const double gpuMs = counters.chunksMs + counters.skyMs + counters.shadowsMs;
    if (watchPicture(scene.turnedDown, drawn.settings.view.surface, gpuMs, drawn.timeS))
        log.info("A frame took {:.0f} ms on the GPU; a feature was turned off. The Light panel shows which.",
                 gpuMs);
}

}  // namespace

void execute(InstrumentsController& instruments, const ui::InstrumentCommand& command,
             const InstrumentContext& context, Notices& notices) {
    std::visit(InstrumentHandler{instruments, context, notices}, command);
}

void forgetPlanet(InstrumentsController& instruments) {
    instruments.changes.clear();
    forgetPops(instruments.pops);
    instruments.probe = {};
    forgetErrors(instruments.errors);
    instruments.cracks = {};
    instruments.costs = {};
    forgetGround(instruments.ruler);
}

void advanceInstruments(InstrumentsController& instruments, const DrawnFrame& drawn, const Log& log,
                        ui::Commands& commands) {
    const CrackSettings& cracks = drawn.settings.view.cracks;
    if (cracks.live && drawn.frame % static_cast<std::uint64_t>(cracks.everyFrames) == 0)
        commands.emplace_back(ui::MeasureCracks{});
    instruments.ruler.pointed.reset();
    measureCosts(drawn.scene, instruments.costs);
    probe(drawn, instruments.probe);
    watchCosts(drawn, instruments.costs, log);
}

ui::InstrumentsView instrumentsViewOf(const InstrumentsController& instruments, const Scene* scene,
                                      const planet::View& view, const ViewSettings& settings,
                                      std::uint64_t frame) {
    ui::InstrumentsView shown{.changes = instruments.changes,
                              .allocations = instruments.allocations,
                              .errors = errorsViewOf(instruments.errors, frame),
                              .probe = instruments.probe,
                              .ruler = rulerViewOf(instruments.ruler, view)};
    shown.light.costs = instruments.costs.costs;
    shown.light.measured = instruments.costs.meter ? instruments.costs.meter->share() : 1;
    if (!scene) return shown;
    shown.cracks = cracksViewOf(instruments.cracks, *scene, view, settings);
    shown.pops = popsViewOf(instruments.pops);
    shown.light.turnedDown = scene->turnedDown;
    shown.light.software = scene->renderer.chunks().capabilities().software;
    shown.light.air = scene->renderer.chunks().airFigures();
    return shown;
}

}  // namespace worldy
