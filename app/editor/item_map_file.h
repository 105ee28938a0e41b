// The file written by --item-map for scripts that drive the window: the positions of controls, and the
// editor's counters. Lines of tab-separated fields:
//
//     lod/Hysteresis  x  y  width  height    pixels from the window's top left
//     counter/drawn   123
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/editor/camera_controller.h"
#include "app/editor/compare_controller.h"
#include "app/editor/frame_controller.h"
#include "app/editor/recording_controller.h"
#include "app/editor/session.h"
#include "app/editor/sweep_controller.h"
#include "ui/kit/item_map.h"

namespace worldy {

struct Counter {
    std::string name;
    std::string value;
};

// The controllers whose state is counted.
struct CounterSources {
    const Session& session;
    const FrameController& frames;
    const CameraController& camera;
    const ChunkFocus& focus;
    const RecordingController& recording;
    const SweepController& sweep;
    const CompareController& compare;
};

// Call after a frame. Returns the number of frames, this frame's counters, the selection, the camera, and the
// number of key and button events that wait for the next frames.
std::vector<Counter> countersOf(const CounterSources& sources, const FrameStats& stats,
                                std::size_t queuedInput);

// Writes to a temporary file and renames it, because scripts may read the file at any time.
void writeItemMap(const std::filesystem::path& file, std::span<const ui::ItemPlace> items,
                  std::span<const Counter> counters);

}  // namespace worldy
