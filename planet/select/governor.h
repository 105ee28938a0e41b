// The governor: moves the tolerance τ so that frames keep to a budget. A pure function of what the last frame cost and of
// the governor's own memory, without a clock: the same samples give the same τ, bit for bit. Any thread.
//
//     planet::GovernorSettings settings{.budget = {.gpuMs = 8, .triangles = 2e6}, .fadeS = lod.fadeS};
//     planet::GovernorState governor;
//     for (;;) {
//         planet->step(view, lod, upload);  // and draw
//         const planet::Governed governed = planet::govern(governor, sample, settings);
//         governor = governed.state;
//         lod.tauPx = governed.tauPx;
//         lod.fadeS = governed.fadeS;
//     }
//
// A cost c follows τ by a power law near the τ of now. The governor works with logarithms, x = ln τ:
//
//     triangles = exp(level) τ^-k
//     c = c now ((1 - e) + e triangles / triangles now)
//
// k is counted in the selection (exponentOf). e is the elasticity of a time with respect to the triangles, [0.4, 1], by
// least squares over the changes of both in the last half minute; before any, a rise expects 0.9 and a fall 1. The rest of
// a time does not follow τ. For counts e is 1. Therefore each sample gives the factor by which τ must change, and one change
// of τ corrects a step of the cost. With a wrong exponent the error shrinks by the factor |1 - true / assumed| each time the
// cost responds, so it converges if the true exponent is below twice the assumed one. Far from the τ of now there is no such
// law. So where a third of the triangles must go, τ is read from the errors of all chunks that are split (MergeCurve).
//
// A cost belongs to an older τ (Smith, "Closer control of loops with dead time", 1957). Two bounds of it are followed,
// the smallest and the largest τ that a cost can belong to; τ rises by the smaller one and falls by the larger one, so
// that a change that has been made, but is not yet measured, is not made again:
//   - A chunk merges when its parent's ε is at most τ (1 - LodSettings::hysteresis). A τ that rises after a fall first
//     crosses that backlash.
//   - Chunks morph onto their parents before they merge (lod_select.h). That takes the time of a fade for each level, that is
//     for each doubling of τ, or for a rise by less than 1 + morphRange that share of it. When τ falls, chunks split at once.
//   - GPU times are of a frame gpuFramesLate frames ago. A time is the median of three frames, so that one slow frame
//     moves nothing.
//   - Blocks must load before a smaller τ costs anything. While chunks wait for theirs, τ falls only as far as the budget
//     allows with all of them split.
//   - Bytes are read when τ falls and when the camera moves. So with a budget for them τ falls at a speed that grows while
//     little is read and that halves every 0.1 s once the floor is reached, and what its own fall reads never raises it.
//
// Use is the cost as a share of its budget. Hysteresis: while use is between the floor and the middle of its band, τ
// stays. Above the middle τ creeps upwards by at most risePerS, slower than chunks that have just split would merge
// again; above the ceiling it rises at once, as far as needed. Below the floor it falls, by fallPerS or faster if there is
// far to go, but not within a second of a rise. So noise smaller than the band moves nothing, and τ never hunts.
//
// A camera that flies towards detail makes the level grow. That growth, which the triangles tell without noise, is foreseen
// by 0.1 s, and by 0.3 s for creeping.
//
// If several budgets are on, the one that needs the largest τ binds.
//
// Fades catch up: while many chunks have n > 1 levels to merge, for whatever reason, each level fades in fadeS / (n + 1). So
// after a step of the cost that needs several levels, the cost is back within its budget after the age of its measurement and
// about one fadeS. Whoever draws must take Governed::fadeS, or set GovernorSettings::leastFadeS to at least fadeS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "planet/select/lod_types.h"

namespace planet {

enum class GovernorBudget : std::uint8_t { CpuTime, GpuTime, Triangles, Memory, Reading };
inline constexpr std::size_t governorBudgetCount = 5;

// The costs of a frame, or their budgets. A value that is not finite or not above 0 is not measured, or off.
struct GovernorCosts {
    double cpuMs = 0;  // the CPU's work for the frame, without waiting for the monitor or the GPU
    double gpuMs = 0;
    double triangles = 0;
    // Memory of the chunks that the picture needs (neededChunks). The resident chunks are no measure: they fill the paging
    // budget whatever τ is.
    double memoryBytes = 0;
    double readBytesPerS = 0;  // bytes read since the last sample, divided by elapsedS

    bool operator==(const GovernorCosts&) const = default;
};
double valueOf(const GovernorCosts& costs, GovernorBudget budget);

struct GovernorSettings {
    GovernorCosts budget{};   // 0: off
    double leastTauPx = 0.5;  // pixels, > 0
    double mostTauPx = 16;    // pixels; less than leastTauPx counts as leastTauPx
    double ceiling = 0.975;   // largest use, (0, 1]; larger: fewer triangles to spare when the cost jumps
    double hysteresis =
        0.12;  // the floor is ceiling - hysteresis; [0, 0.9]; smaller: more use, but more level changes
    double exponent = 1;  // k where a sample has none, [0.25, 4]; larger: smaller changes of τ
    double risePerS =
        0.15;  // most of ln τ while below the ceiling, >= 0; larger: more chunks change back and forth
    double fallPerS = 0.2;  // of ln τ, > 0; larger: sharp sooner, but more chunks change back and forth
    // These follow LodSettings (lodHysteresis is its hysteresis). An engine without morphs or hysteresis sets them to 0.
    double fadeS = LodSettings{}.fadeS;
    double leastFadeS = 0.03;  // of Governed::fadeS, >= 0; fadeS or more: fades never catch up
    double morphRange = LodSettings{}.morphRange;
    double lodHysteresis = LodSettings{}.hysteresis;
    int gpuFramesLate = 4;  // age of GPU times, frames, [0, 6]; if they are older, τ overshoots
};

// The share of the drawn triangles that is left after chunks have merged, as a function of τ.
struct MergeCurve {
    static constexpr std::size_t perDoubling = 4;
    static constexpr std::size_t count = 8 * perDoubling + 1;
    // ln of the share, by τ: from half the τ of the selection to 128 times that. Not above 0, and never rising.
    std::array<float, count> lnShare{};
    float lnShareToCome = 0;  // ln of the share that is left when all has merged that will merge if τ stays
    int levels = 0;           // the most levels by which these merges make a drawn chunk coarser
    bool isKnown = false;
};
// Reads the curve from the splits of a selection. lodHysteresis: LodSettings::hysteresis of the selection.
MergeCurve mergeCurveOf(const Selection& selection, double lodHysteresis);

struct GovernorSample {
    GovernorCosts cost{};     // of the last frame
    double tauPx = 2;         // with which the last frame was selected
    double elapsedS = 0;      // since the last sample; clamped to [0, 1]
    double exponent = 0;      // k, from exponentOf; 0: unknown
    MergeCurve merges{};      // from mergeCurveOf
    double waitingShare = 0;  // share of the drawn chunks that wait for their children's blocks, [0, 1]
};
// Returns k of a selection: by how many octaves the drawn chunks would become fewer if τ doubled, by their parents' ε.
// Morphs and hysteresis are not counted in.
double exponentOf(const Selection& selection, double tauPx);
// Returns the number of chunks that a selection needs: those visited, and those it requests.
std::size_t neededChunks(const Selection& selection);

// The governor's memory. An empty one has none, as after a jump of the camera or for another planet.
struct GovernorState {
    static constexpr std::size_t keptFrames = 8;
    static constexpr std::size_t fadeParts = 16;

    // The least values in a part of the last fade.
    struct Part {
        double mergingLnTau = 0;
        double shownLnTau = 0;
    };
    // The changes of a time and of the triangles.
    struct Elasticity {
        double lnTriangles = 0;  // where the current change began
        double lnCost = 0;
        double sumXX = 0;  // of the changes of ln triangles
        double sumXY = 0;  // with those of ln cost
        bool known = false;
    };

    std::uint64_t frames = 0;                // samples taken
    double fadeSpeed = 1;                    // GovernorSettings::fadeS / Governed::fadeS of the last call
    double mergingLnTau = 0;                 // ln τ, less the backlash that it has not crossed
    double shownLnTau = 0;                   // ln τ that the drawn chunks have morphed to
    std::array<Part, fadeParts> parts{};     // newest first
    double partS = 0;                        // age of the newest part
    std::array<double, keptFrames> lnTau{};  // shownLnTau of the last frames, newest first
    std::array<double, keptFrames> lnTriangles{};  // likewise
    double growthPerS = 0;                         // of the level of the triangles, for a moving camera
    std::array<std::array<double, 3>, governorBudgetCount>
        costs{};                               // of the last frames, newest first; 0: not measured
    std::array<Elasticity, 2> elasticities{};  // of CPU and GPU times
    double readBytesPerS = 0;                  // mean over about half a second
    double meanLnTau = 0;                      // likewise
    double readFallPerS = 0;                   // speed at which reading lets ln τ fall
    double sinceRiseS = 0;
    double sinceFallS = 0;
};

enum class GovernorLimit : std::uint8_t { None, LeastTau, MostTau };

struct Governed {
    GovernorState state;
    double tauPx = 2;      // for the next frame
    double fadeS = 0;      // LodSettings::fadeS for the next frame
    bool governs = false;  // a budget is on and its cost is measured; otherwise τ is that of the sample
    GovernorBudget binds = GovernorBudget::CpuTime;  // needs the largest τ
    double use =
        0;  // of the budget that binds: times are medians of three frames, and read bytes means of half a second
    std::array<double, governorBudgetCount> uses{};  // of all budgets; 0: off or not measured
    GovernorLimit limit = GovernorLimit::None;       // without it, τ would be smaller or larger
};

// Chooses the τ of the next frame. Settings out of range are clamped, and those that are no number are the defaults.
Governed govern(const GovernorState& before, const GovernorSample& sample, const GovernorSettings& settings);

}  // namespace planet
