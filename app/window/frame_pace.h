// How often the window draws: at full speed while something moves, a few times a second while work in the background goes
// on or the plots of the last seconds run out, and hardly at all while nothing changes. No clock and no window; one thread.
#pragma once

#include <cstdint>

namespace worldy {

// A reason for the next frame to differ from the last one.
enum class Activity : std::uint8_t {
    None,
    Background,  // work whose progress is shown
    Motion,      // of the picture: a camera, loading, fading, a replay
};

struct FrameActivity {
    Activity kind = Activity::None;
    const char* reason = "nothing changes";  // completes "Frames are drawn because ..."
};

// Panels show rates and plots of the last ten seconds, which are drawn until they have run out.
inline constexpr double runOutS = 11;
// The longest rest. A change that no event announces, such as an edited shader, is seen after it.
inline constexpr double longestRestS = 15;

// Returns how long the next frame may wait for input or for a script that asks for it, seconds. A script counts frames and
// needs no plots to run out.
double scriptedRestS(Activity activity);

// All times are in seconds and never decrease.
class FramePace {
public:
    void noteInput(double nowS);
    // Notes what went on in the frame that ends now.
    void noteFrame(Activity activity, double nowS);
    // Returns how long the next frame may wait for input, seconds: 0 at full speed.
    double restS(double nowS) const;
    // Returns how long the next frame must wait, whatever the input, so that no more frames than the limit begin in a
    // second; 0 if the limit is 0. Call once a frame; nowS may be of another clock than above.
    double limitS(double nowS, int framesPerSecond);

private:
    double lastMotionS_ = 0;  // or input
    double lastChangeS_ = 0;  // any activity
    double nextFrameS_ = 0;   // earliest beginning of the next frame under the limit
};

}  // namespace worldy
