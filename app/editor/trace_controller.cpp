#include "app/editor/trace_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "app/base/places.h"
#include "app/session/overloaded.h"
#include "ui/model/docking.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

void showDocument(TraceController& controller, const fs::path& file, bool isLive) {
    const double speed = controller.playback.speed;
    controller.document = std::make_unique<TraceDocument>(file, isLive);
    controller.isLive = isLive;
    controller.frame.reset();
    controller.history.reset();
    controller.reported.clear();
    controller.playback = {.speed = speed, .onPlanet = controller.playback.onPlanet, .newest = isLive};
    if (isLive)
        controller.document->showNewest();
    else
        controller.document->show(0);
}

void showFrame(TraceController& controller, std::uint64_t frame) {
    if (!controller.document) return;
    controller.playback.frame = frame;
    controller.playback.newest = false;
    controller.document->show(frame);
}

// Shows a frame that the user chose, and plays on from there.
void jumpTo(TraceController& controller, std::uint64_t frame) {
    showFrame(controller, frame);
    if (!controller.history) return;
    const auto& samples = controller.history->samples;
    const auto after = std::ranges::upper_bound(samples, frame, {}, &TracedSample::frame);
    if (after != samples.begin()) controller.playback.timeS = std::prev(after)->timeS;
}

// Shows the first frame that draws something: an engine may load for many frames before.
void beginAtADrawnFrame(TraceController& controller) {
    if (!controller.history || !controller.history->isComplete) return;
    const TraceHistory& history = *controller.history;
    if (history.samples.empty()) return;
    for (std::size_t i = 0; i < history.samples.size(); ++i)
        for (const auto& [view, samples] : history.views)
            if (i < samples.size() && samples[i].drawn > 0)
                return jumpTo(controller, history.samples[i].frame);
    jumpTo(controller, history.samples.front().frame);  // so that it is not looked for again
}

std::uint64_t shownFrame(const TraceController& controller) {
    return controller.frame ? controller.frame->frame.number : controller.playback.frame;
}

void step(TraceController& controller, int frames) {
    controller.playback.playing = false;
    const std::uint64_t shown = shownFrame(controller);
    const auto back = static_cast<std::uint64_t>(-std::min(frames, 0));
    const std::uint64_t wanted =
        frames < 0 ? shown - std::min(back, shown) : shown + static_cast<std::uint64_t>(frames);
    const std::uint64_t last = controller.history ? controller.history->report.lastFrame : wanted;
    jumpTo(controller, std::min(wanted, std::max(last, shown)));
}

// Moves a playing trace by the engine's clock.
void play(TraceController& controller, double seconds) {
    TracePlayback& playback = controller.playback;
    if (!playback.playing || !controller.history || controller.history->samples.empty()) return;
    const auto& samples = controller.history->samples;
    playback.timeS += playback.speed * seconds;
    const auto after = std::ranges::upper_bound(samples, playback.timeS, {}, &TracedSample::timeS);
    const bool isAtEnd = after == samples.end();
    std::uint64_t frame = after == samples.begin() ? after->frame : std::prev(after)->frame;
    if (isAtEnd) frame = controller.history->report.lastFrame;
    showFrame(controller, frame);
    if (!isAtEnd) return;
    playback.timeS = samples.back().timeS;
    if (controller.history->isComplete) playback.playing = false;
}

void setPlaying(TraceController& controller, const ui::PlayTrace& play) {
    TracePlayback& playback = controller.playback;
    playback.speed = play.speed;
    if (controller.document && controller.isLive && play.newest && !playback.newest)
        controller.document->showNewest();
    playback.newest = controller.isLive && play.newest;
    const bool begins = play.playing && !playback.playing && !playback.newest;
    playback.playing = play.playing && !playback.newest;
    if (!begins || !controller.history || controller.history->samples.empty()) return;
    const bool isAtEnd = shownFrame(controller) >= controller.history->report.lastFrame;
    jumpTo(controller, isAtEnd ? controller.history->report.firstFrame : shownFrame(controller));
}

// Shows what the link has begun to write, and ends what it has ended.
void followLink(TraceController& controller, const Log& log) {
    if (!controller.link) return;
    const std::string before = controller.status.message;
    controller.status = controller.link->status();
    if (controller.status.message != before) log.info("{}", controller.status.message);
    using enum planet::TraceLinkState;
    const bool isComing = controller.status.state == Receiving || controller.status.state == Silent;
    const fs::path& file = controller.status.file.path;
    if (isComing && !file.empty() && (!controller.document || controller.document->file() != file))
        return showDocument(controller, file, true);
    if (!controller.isLive || (isComing && controller.document->file() == file)) return;
    controller.document->setGrows(false);
    controller.isLive = false;
    jumpTo(controller, shownFrame(controller));
}

void detach(TraceController& controller) {
    if (!controller.link) return;
    controller.link->stop();
    controller.link.reset();
    controller.status = {};
    if (!controller.isLive) return;
    controller.document->setGrows(false);
    controller.isLive = false;
    controller.playback.newest = false;
}

void showPanels(Workspace& workspace) {
    ui::showPanel(PanelId::TraceNode, workspace);
    ui::showPanel(PanelId::TraceNodes, workspace);
    ui::showPanel(PanelId::TraceFindings, workspace);
    ui::showPanel(PanelId::TracePaging, workspace);
    ui::showPanel(PanelId::Trace, workspace);
}

const TracedView* shownView(const TraceController& controller) {
    return controller.frame ? controller.frame->view(controller.playback.view) : nullptr;
}

// Returns the camera of the traced view on the open planet.
std::optional<planet::CameraPose> poseOfTrace(const TraceController& controller,
                                              std::optional<double> planetRadiusM) {
    const TracedView* const shown = shownView(controller);
    if (!planetRadiusM || !shown || !shown->info || !hasPlaceOnPlanet(*controller.frame)) return std::nullopt;
    const glm::dmat3 worldFromView = glm::transpose(glm::dmat3(shown->info->view));
    planet::View view;
    view.eyeM = *planetRadiusM / controller.frame->description->radius * shown->info->eye;
    view.right = worldFromView[0];
    view.up = worldFromView[1];
    view.back = worldFromView[2];
    const planet::CameraPose pose = planet::poseFromView(view, *planetRadiusM);
    const bool isFinite = std::isfinite(pose.latitudeDeg + pose.longitudeDeg + pose.altitudeM +
                                        pose.headingDeg + pose.pitchDeg);
    return isFinite ? std::optional(pose) : std::nullopt;
}

ui::TraceComparedView comparedViewOf(const TraceCompareRun& run) {
    ui::TraceComparedView view{.runs = run.runs,
                               .problem = run.problem,
                               .fileB = run.request.fileB,
                               .match = run.request.match,
                               .result = run.result ? &*run.result : nullptr};
    if (!run.job) return view;
    view.running = true;
    view.progress = run.job->progress();
    view.cancelling = run.job->cancelling();
    return view;
}

}  // namespace

fs::path tracesFolder() {
    return configFolder() / "traces";
}

Result<void> openTrace(TraceController& controller, const fs::path& file) {
    // Opening lists all blocks, which takes long for large traces, so here it only tells what is wrong with another file.
    if (!isTraceFile(file)) {
        if (const auto other = planet::TraceFile::open(file); !other) return tl::unexpected(other.error());
    }
    detach(controller);
    showDocument(controller, file, false);
    return {};
}

Result<void> attachTrace(TraceController& controller, int port, const fs::path& folder) {
    std::error_code status;
    fs::create_directories(folder, status);
    if (status)
        return planet::badInput(fmt::format("{}: cannot be created: {}; expected a folder for traces",
                                            folder.string(), status.message()));
    detach(controller);
    Result<std::unique_ptr<planet::TraceLink>> link =
        planet::TraceLink::start({.port = port, .folder = folder, .name = fmt::format("port {}", port)});
    if (!link) return tl::unexpected(link.error());
    controller.link = std::move(*link);
    return {};
}

void advanceTrace(TraceController& controller, double secondsSinceLast, const Log& log) {
    followLink(controller, log);
    advanceTraceWhatIf(controller.whatIf, log);
    advanceTraceCompare(controller.compare, log);
    if (!controller.document) return;
    play(controller, secondsSinceLast);
    controller.frame = controller.document->frame();
    controller.history = controller.document->history();
    if (!controller.isLive && controller.playback.frame == 0) beginAtADrawnFrame(controller);
    const std::string problem = controller.document->problem();
    if (problem == controller.reported) return;
    controller.reported = problem;
    if (!problem.empty()) log.warn("{}", problem);
}

void execute(TraceController& controller, const ui::TraceCommand& command, Workspace& workspace,
             std::optional<double> planetRadiusM, Notices& notices, ui::Commands& next) {
    std::visit(
        Overloaded{
            [&](const ui::OpenTrace& open) {
                if (const Result<void> opened = openTrace(controller, open.file); !opened)
                    return tellCannotOpen(notices, open.file, opened.error());
                if (open.frame > 0) showFrame(controller, open.frame);
                if (!open.isResumed) showPanels(workspace);
                confirm(notices, fmt::format("Trace {} opened", open.file.string()));
            },
            [&](const ui::AttachTrace& attach) {
                if (succeeded(notices, attachTrace(controller, attach.port), "Attaching is impossible"))
                    showPanels(workspace);
            },
            [&](const ui::DetachTrace&) { detach(controller); },
            [&](const ui::CloseTrace&) {
                const double speed = controller.playback.speed;
                detach(controller);
                controller = {};
                controller.playback.speed = speed;
            },
            [&](const ui::ShowTraceFrame& show) { jumpTo(controller, show.frame); },
            [&](const ui::StepTrace& steps) { step(controller, steps.frames); },
            [&](const ui::PlayTrace& play) { setPlaying(controller, play); },
            [&](const ui::SelectTraceNode& select) { controller.playback.selected = select.id; },
            [&](const ui::SelectTraceView& select) { controller.playback.view = select.view; },
            [&](const ui::ShowTraceOnPlanet& show) { controller.playback.onPlanet = show.shown; },
            [&](const ui::LookAsTrace&) {
                if (const auto pose = poseOfTrace(controller, planetRadiusM))
                    next.push_back(ui::MoveCamera{*pose});
            },
            [&](const ui::StartTraceWhatIf& start) {
                if (controller.document)
                    startTraceWhatIf(controller.whatIf, controller.document->file(), start.request,
                                     notices.log);
            },
            [&](const ui::CancelTraceWhatIf&) { cancelTraceWhatIf(controller.whatIf); },
            [&](const ui::StartTraceCompare& start) {
                if (!controller.document) return;
                const planet::TraceMatch match = start.match.value_or(controller.compare.request.match);
                startTraceCompare(
                    controller.compare,
                    {.fileA = controller.document->file(), .fileB = start.fileB, .match = match},
                    notices.log);
                if (start.isShown) ui::showPanel(PanelId::TraceFindings, workspace);
            },
            [&](const ui::CancelTraceCompare&) {
                if (controller.compare.job) controller.compare.job->cancel();
            },
        },
        command);
}

planet::Lines traceLinesOf(const TraceController& controller, double planetRadiusM, const glm::dvec3& eyeM,
                           const OverlaySettings& overlay) {
    const TracedView* const shown = shownView(controller);
    if (!shown || !controller.playback.onPlanet) return {};
    return traceLines(*controller.frame, *shown, planetRadiusM, eyeM, overlay, controller.playback.selected);
}

ui::TraceView traceViewOf(const TraceController& controller) {
    ui::TraceView view;
    view.whatIf = traceWhatIfViewOf(controller.whatIf);
    view.compared = comparedViewOf(controller.compare);
    view.link.isOn = controller.link != nullptr;
    view.link.isReceiving = controller.isLive;
    view.link.message = controller.status.message;
    view.speed = controller.playback.speed;
    if (!controller.document) return view;
    view.file = controller.document->file();
    view.problem = controller.document->problem();
    view.frame = controller.frame.get();
    view.history = controller.history.get();
    view.isReading =
        view.problem.empty() && !controller.isLive && !(view.history && view.history->isComplete);
    view.wanted = controller.playback.newest ? shownFrame(controller) : controller.playback.frame;
    view.view = controller.playback.view;
    view.selected = controller.playback.selected;
    view.playing = controller.playback.playing;
    view.newest = controller.playback.newest;
    view.hasPlace = controller.frame && hasPlaceOnPlanet(*controller.frame);
    view.onPlanet = controller.playback.onPlanet;
    return view;
}

}  // namespace worldy
