// What --item-map writes, for scripts that drive the window: where controls are, and what the editor counts.
// Lines of fields between tabs:
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

// After a frame: the number of frames so far, what this one counted, the selection and the camera, and the
// events of keys and buttons that wait for the next frames.
std::vector<Counter> countersOf(const CounterSources& sources, const FrameStats& stats,
                                std::size_t queuedInput);

// A script may read it at any time, so it is renamed into place.
void writeItemMap(const std::filesystem::path& file, std::span<const ui::ItemPlace> items,
                  std::span<const Counter> counters);

}  // namespace worldy
