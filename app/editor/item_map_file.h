// The file written by --item-map for scripts that drive the window: the positions of controls, and the
// editor's counters. Lines of tab-separated fields:
//
//     lod/Hysteresis  x  y  width  height    pixels from the window's top left
//     counter/drawn   123
//
// The file is written after each frame. While nothing moves, frames are drawn a few times a second. A script that waits
// for more writes a frame number to FILE.ask: frames are then drawn at full speed until counter/frame has reached it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/editor/camera_controller.h"
#include "app/editor/compare_controller.h"
#include "app/editor/frame_controller.h"
#include "app/editor/recording_controller.h"
#include "app/editor/sweep_controller.h"
#include "app/session/session.h"
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

// Call after a frame. Returns the number of frames, this frame's counters, the selection, the camera, the number of key
// and button events that wait for the next frames, and whether something moves by itself.
std::vector<Counter> countersOf(const CounterSources& sources, const FrameStats& stats,
                                std::size_t queuedInput);

// Writes to a temporary file and renames it, because scripts may read the file at any time.
void writeItemMap(const std::filesystem::path& file, std::span<const ui::ItemPlace> items,
                  std::span<const Counter> counters);

// Returns the frame up to which a script asks for frames; 0 if the item map has no ask file or it holds no number.
std::uint64_t askedFrame(const std::filesystem::path& itemMap);

}  // namespace worldy
