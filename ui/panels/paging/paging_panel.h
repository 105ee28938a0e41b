// Paging: the queue, what is being read, the history, memory; budget, threads, pause, and the bad disk.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/model/editor_view.h"

namespace worldy::ui {

// A pending request, as the table shows it.
struct PagingRow {
    planet::ChunkId parent;  // whose children are meant
    planet::BlockKind kind = planet::BlockKind::Heights;
    planet::PagingType type = planet::PagingType::PageIn;
    double priority = 0;
    double askedAtS = 0;  // seconds since the planet was opened
    std::uint32_t timesAsked = 1;
    std::uint32_t views = 0;  // bit v: view v wants it
};

struct PagingPanelState {
    int shownView = -1;                            // requests of one view, or -1 for all
    std::optional<planet::BlockKind> shownKind{};  // rows of one kind, or of all
    bool showPageIns = true;
    bool showPageOuts = true;
    bool showLoaded = true;  // in the history
    bool showFailed = true;
    bool showCancelled = true;
    bool showEvicted = true;
    bool onlyMerged = false;        // those asked for more than once
    bool failedShown = false;       // the list of failed blocks, in the frame before
    bool latencyOfReading = false;  // the histogram: of reading alone; else from asking to loaded

    // Read from the planet some ten times a second: copying a long queue takes longer than drawing it.
    struct Sample {
        double takenAtS = -1;  // EditorView::timeS
        const planet::Planet* planet = nullptr;
        int shownView = -1;
        std::optional<planet::BlockKind> shownKind{};
        bool latencyOfReading = false;
        std::vector<PagingRow> queue;  // page-ins, then page-outs, each most urgent first
        std::size_t hidden = 0;        // requests of the other kinds
        std::size_t loads = 0;         // queued, of all kinds and views
        std::size_t evictions = 0;
        std::vector<planet::FailedBlock> failed;  // where they are shown
        bool failedShown = false;
        std::vector<float> latencyCounts;
        float medianS = 0;
        float slowestS = 0;  // 99 of 100 are faster
        std::size_t latencies = 0;
    } sample;
};

// Fills the current window: columns side by side where it is wide, one below the other where it is narrow.
void pagingPanel(const EditorView& view, PagingPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
