#include "app/editor/instrument_views.h"

namespace worldy {

ui::CracksView cracksViewOf(const CrackInstrument& instrument, const Scene& scene, const planet::View& view,
                            const ViewSettings& settings) {
    ui::CracksView shown;
    if (!instrument.measured) return shown;
    shown.measured = &*instrument.measured;
    shown.current = isCurrent(instrument, scene, view, settings);
    if (instrument.smallest) shown.smallest = &*instrument.smallest;
    return shown;
}

ui::ErrorsView errorsViewOf(const ErrorMeter& meter, std::uint64_t frame) {
    ui::ErrorsView view;
    view.last = meter.last ? &*meter.last : nullptr;
    view.current = meter.current;
    view.frame = frame;
    view.running = meter.job != nullptr || meter.wanted;
    view.progress = meter.job ? meter.job->progress() : 0;
    view.keepMeasuring = meter.keepMeasuring;
    view.problem = meter.problem;
    return view;
}

ui::PopsView popsViewOf(const Pops& pops) {
    return {.meter = &pops.meter,
            .measuring = pops.measuring,
            .shown = pops.shown ? &*pops.shown : nullptr,
            .side = pops.side,
            .problem = pops.problem};
}

ui::RulerView rulerViewOf(const Ruler& ruler, const planet::View& view) {
    ui::RulerView shown{.takesClicks = ruler.takesClicks,
                        .ends = ruler.ends,
                        .measured = ruler.last ? &*ruler.last : nullptr,
                        .current = ruler.current,
                        .running = ruler.job != nullptr,
                        .problem = ruler.problem};
    for (const glm::dvec3& endM : ruler.ends) shown.inPicture.push_back(rulerEndIn(view, endM));
    return shown;
}

ui::SourcePreview previewViewOf(const SourcePreviewer& previewer) {
    ui::SourcePreview view;
    view.working = previewer.job || previewer.next;
    view.problem = previewer.problem;
    if (!previewer.shown) return view;
    view.texture = reinterpret_cast<void*>(static_cast<std::intptr_t>(previewer.texture.name()));
    view.shown = previewer.shown->request;
    view.lowM = previewer.shown->lowM;
    view.highM = previewer.shown->highM;
    view.seconds = previewer.shown->seconds;
    return view;
}

}  // namespace worldy
