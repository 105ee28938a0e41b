#include "app/window/frame_pace.h"

#include <algorithm>

namespace worldy {

namespace {

// Dear ImGui needs some frames to react to input, and a hand rests between two movements.
constexpr double fullSpeedS = 0.5;
constexpr double slowFrameS = 0.1;

}  // namespace

double scriptedRestS(Activity activity) {
    return activity == Activity::Motion ? 0 : slowFrameS;
}

void FramePace::noteInput(double nowS) {
    lastMotionS_ = lastChangeS_ = nowS;
}

void FramePace::noteFrame(Activity activity, double nowS) {
    if (activity == Activity::Motion) lastMotionS_ = nowS;
    if (activity != Activity::None) lastChangeS_ = nowS;
}

double FramePace::restS(double nowS) const {
    if (nowS - lastMotionS_ < fullSpeedS) return 0;
    return nowS - lastChangeS_ < runOutS ? slowFrameS : longestRestS;
}

double FramePace::limitS(double nowS, int framesPerSecond) {
    if (framesPerSecond <= 0) return 0;
    const double intervalS = 1.0 / framesPerSecond;
    // A frame that begins a little late does not delay those after it, so that the mean is the limit. After a longer
    // pause, frames do not catch up.
    if (nowS > nextFrameS_ + intervalS) nextFrameS_ = nowS;
    const double waitS = std::max(nextFrameS_ - nowS, 0.0);
    nextFrameS_ += intervalS;
    return waitS;
}

}  // namespace worldy
