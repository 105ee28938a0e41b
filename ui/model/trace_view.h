// The data that the trace panels read. Pointers are valid for the frame; the data that they point to does not change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/trace/trace_history.h"
#include "app/trace/traced_frame.h"
#include "ui/model/trace_compared_view.h"
#include "ui/model/trace_what_if_view.h"

namespace worldy::ui {

// The connection to a running engine.
struct TraceLinkView {
    bool isOn = false;         // waiting for an engine, or attached to one
    bool isReceiving = false;  // an engine is attached
    std::string message{};     // what it does or what is wrong, a sentence
};

struct TraceView {
    std::filesystem::path file{};  // that is shown, also while an engine is attached; empty: none
    std::string problem{};         // why it cannot be shown, or where it is damaged or cut off
    TraceLinkView link{};
    // The shown frame; null until it is read.
    const TracedFrame* frame = nullptr;
    // The history of the part that has been read so far; null until something is.
    const TraceHistory* history = nullptr;
    bool isReading = false;                   // the history of the file is not complete yet
    std::uint64_t wanted = 0;                 // number of the frame that is to be shown
    int view = 0;                             // of the engine
    std::optional<std::uint64_t> selected{};  // id of a node
    bool playing = false;
    double speed = 1;
    bool newest = true;
    bool hasPlace = false;  // on a planet: its world is a sphere
    bool onPlanet = true;   // its nodes are drawn over the open planet
    TraceWhatIfView whatIf{};
    TraceComparedView compared{};
};

}  // namespace worldy::ui
