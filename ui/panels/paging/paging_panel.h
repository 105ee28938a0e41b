// The Paging panel: queue, loads in progress, history, memory, budget, threads, pause and I/O fault
// injection.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"

namespace worldy::ui {

// A pending request, as the table shows it.
struct PagingRow {
    planet::ChunkId parent;  // the chunk whose children are requested
    planet::BlockKind kind = planet::BlockKind::Heights;
    planet::PagingType type = planet::PagingType::PageIn;
    double priority = 0;
    double askedAtS = 0;  // seconds since the planet was opened
    std::uint32_t timesAsked = 1;
    std::uint32_t views = 0;  // bit v: view v wants it
    planet::PagingUrgency urgency = planet::PagingUrgency::Lasting;
};

struct PagingPanelState {
    int shownView = -1;                            // shows the requests of one view; -1: of all
    std::optional<planet::BlockKind> shownKind{};  // shows rows of one kind; none: of all
    bool showPageIns = true;
    bool showPageOuts = true;
    bool showLoaded = true;  // in the history, as the next three
    bool showFailed = true;
    bool showCancelled = true;
    bool showEvicted = true;
    bool onlyMerged = false;        // shows only requests made more than once
    TextFilter filter{};            // of the queue, of finished requests and of failed blocks
    bool failedShown = false;       // the list of failed blocks was shown in the last frame
    bool latencyOfReading = false;  // the histogram shows read latency; otherwise total latency

    // Read from the planet about ten times per second, because copying a long queue takes longer than drawing
    // it.
    struct Sample {
        double takenAtS = -1;  // as FramesView::timeS
        const planet::Planet* planet = nullptr;
        int shownView = -1;
        std::optional<planet::BlockKind> shownKind{};
        bool latencyOfReading = false;
        std::vector<PagingRow> queue;             // page-ins, then page-outs, each most urgent first
        std::size_t hidden = 0;                   // requests of the other kinds
        std::size_t loads = 0;                    // queued loads, of all kinds and views, without prefetches
        std::size_t prefetches = 0;               // queued
        std::vector<planet::FailedBlock> failed;  // filled only while the list is shown
        bool failedShown = false;
        std::vector<float> latencyCounts;
        float medianS = 0;
        float slowestS = 0;  // 99th percentile
        std::size_t latencies = 0;
    } sample;
};

// Fills the current window, with columns side by side if it is wide, otherwise stacked.
void pagingPanel(const EditorView& view, PagingPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
