// Traces of other engines in the window: an open file, or a running engine that is attached. Main thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/editor/trace_what_if.h"
#include "app/session/notices.h"
#include "app/settings/workspace.h"
#include "app/trace/trace_compare_job.h"
#include "app/trace/trace_document.h"
#include "app/trace/trace_lines.h"
#include "planet/trace/trace_link.h"
#include "ui/model/commands.h"
#include "ui/model/trace_view.h"

namespace worldy {

// The frame that is shown, and how it moves on.
struct TracePlayback {
    std::uint64_t frame = 0;  // asked for
    double timeS = 0;         // engine's clock, while playing
    double speed = 1;
    bool playing = false;
    bool onPlanet = true;  // draws the nodes over the open planet
    bool newest = false;   // the newest frame of a running engine is shown
    int view = 0;
    std::optional<std::uint64_t> selected{};  // id of a node
};

struct TraceController {
    std::unique_ptr<TraceDocument> document{};
    std::unique_ptr<planet::TraceLink> link{};
    planet::TraceLinkStatus status{};  // of the link, in this frame
    bool isLive = false;               // the document's file is being written by the link
    TracePlayback playback{};
    // The document's latest frame and history, taken at the start of this frame of the window.
    std::shared_ptr<const TracedFrame> frame{};
    std::shared_ptr<const TraceHistory> history{};
    std::string reported{};  // the problem that was logged
    TraceWhatIfRun whatIf{};
    TraceCompareRun compare{};
};

// Returns the folder of the traces of running engines.
std::filesystem::path tracesFolder();

// Opens a trace file instead of the open one. The Error says that it is no trace.
planet::Result<void> openTrace(TraceController& controller, const std::filesystem::path& file);
// Waits for an engine at a port, and shows its trace. The Error says why that is impossible.
planet::Result<void> attachTrace(TraceController& controller, int port,
                                 const std::filesystem::path& folder = tracesFolder());

// Call every frame. secondsSinceLast: >= 0, moves a playing trace.
void advanceTrace(TraceController& controller, double secondsSinceLast, const Log& log);

// planetRadiusM: of the open planet; none: no planet is open. next: receives a command that moves the camera.
void execute(TraceController& controller, const ui::TraceCommand& command, Workspace& workspace,
             std::optional<double> planetRadiusM, Notices& notices, ui::Commands& next);

// Returns the nodes of the shown frame as lines over the planet; nothing if they are not to be drawn.
planet::Lines traceLinesOf(const TraceController& controller, double planetRadiusM, const glm::dvec3& eyeM,
                           const OverlaySettings& overlay);

ui::TraceView traceViewOf(const TraceController& controller);

}  // namespace worldy
