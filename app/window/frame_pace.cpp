#include "app/window/frame_pace.h"

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

}  // namespace worldy
