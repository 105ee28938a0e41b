// Records the frames of the window into a timeline: their times, the spans of all threads and of the GPU, and the chunks that
// changed. Main thread; one may exist.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "app/measure/frame_timeline.h"
#include "planet/measure/lod_changes.h"
#include "planet/measure/pop_meter.h"
#include "planet/planet.h"

namespace worldy {

// Smaller jumps at a switch of level are no pops in the timeline, pixels.
inline constexpr double leastTimelinePopPx = 0.001;

class TimelineRecorder {
public:
    const FrameTimeline& timeline() const { return timeline_; }
    bool isOn() const { return isOn_; }

    // Starts or stops recording. What was recorded stays.
    void turn(bool on);
    // Call at the start of a frame; the first call starts recording.
    void beginFrame(std::uint64_t number);
    // Adds what changed in this frame's step. Call it while recording is off too. changes and pops: after the step. timeS: of
    // this frame in changes.
    void noteStep(const planet::Planet& planet, const planet::LodChanges& changes,
                  const planet::PopMeter& pops, double timeS);
    // Call when a frame is done, before a rest and the next frame.
    void endFrame();

private:
    void noteArrivals(const planet::Planet& planet);
    void notePops(const planet::PopMeter& pops);

    FrameTimeline timeline_;
    bool isOn_ = true;
    bool hasBegun_ = false;
    std::int64_t frameEndNs_ = 0;
    const planet::Planet* planet_ = nullptr;                   // of the last step, only compared
    std::uint64_t pagingEvents_ = 0;                           // of that planet, up to its last step
    std::optional<std::pair<std::uint64_t, double>> lastPop_;  // frame and time of the last one seen
};

}  // namespace worldy
