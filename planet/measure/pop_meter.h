// Measures the visible effects of level changes: the jump of the drawn surface on screen in the frame of a
// switch (a pop), and the time for which chunks are drawn too coarse because their children have not loaded
// (late arrivals). Takes one selection per frame, reads no clock and calls no GL. One thread at a time;
// frames with many switches use several cores.
//
// A pop is the distance on screen, in the new view, between the surface as drawn in the previous frame, morph
// included, and as drawn now at the same place. Camera motion does not count, but the sliding of vertices in
// that frame does. Only places inside the picture count, even if ground hides them. Places under a drawn sea
// do not count.
//
// A camera jump, and the first frame, start loads and fades that do not occur with a moving camera. Every
// switch that results from such a frame is marked as after a jump, until none of them is pending.
//
// A chunk that comes into view or leaves it is not a change of level.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "planet/measure/surface_jump.h"
#include "planet/tree/chunk_table.h"

namespace planet {

// The reason why a place changed its level. A fading switch is drawn many frames after the decision. It has
// the cause of the frame that decided it, and so do the switches above and below that follow from it. If the
// settings and the camera change in one frame, the settings are the cause.
enum class PopCause : std::uint8_t {
    CameraMoved,      // its error crossed the tolerance
    SettingsChanged,  // level settings, field of view, picture size or exaggeration changed
    LoadFinished,     // its children were missing and have loaded
    Evicted,          // its children were evicted although they are needed
    SeamLimit,        // the level limit between stitched neighbours, because a neighbour changed
    Culling,          // that limit, because a neighbour came into view or left it
};
inline constexpr std::size_t popCauseCount = 6;
const char* popCauseName(PopCause cause);  // "camera moved"

// Additional facts about a frame.
struct PopConditions {
    bool cameraJumped = false;     // since the last frame; also true during the flight to a target
    std::optional<double> seaM{};  // level of a sea that is drawn as water, metres above the radius
};

// The drawn chunks of a frame, to show them again.
struct DrawnFrame {
    std::vector<DrawItem> items;
    View view;
    bool stitched = false;
};

struct PopEvent {
    double timeS = 0;
    std::uint64_t frame = 0;  // index of the frame, from 0
    ChunkId chunk;            // the coarser one: replaced, or replacing the finer ones
    int fromLevel = 0;        // of the finest chunk before
    int toLevel = 0;
    PopCause cause = PopCause::CameraMoved;
    bool afterJump = false;  // it was requested in the frame of a jump, or in the first
    bool measured = true;    // false if the exaggeration changed in the same frame
    SurfaceJump jump;        // of the place itself; jump.places is 0 if it is not visible
    double besidePx = 0;     // largest screenPx along the edges of unchanged chunks next to it
    View viewBefore;
    View view;                     // in which the jump is measured
    std::vector<DrawItem> before;  // at the chunk's place; nodes and slots are valid in that frame only
    std::vector<DrawItem> after;
    std::weak_ptr<const DrawnFrame> frameBefore;  // everything drawn in it; null once it is too old
    std::weak_ptr<const DrawnFrame> frameAfter;
};

// Returns whether an event counts: it is visible, and not after a jump.
inline bool counts(const PopEvent& event) {
    return event.jump.places > 0 && !event.afterJump;
}
// Returns why an event does not count: "not measured", "outside picture", "under sea" or "after jump"; "" if
// it counts.
const char* popNote(const PopEvent& event);
// Orders events that count first, then by decreasing jump, then by time.
bool isWorsePop(const PopEvent& a, const PopEvent& b);

enum class LateEnd : std::uint8_t {
    Open,       // still late
    Loaded,     // its children replaced it
    NotWanted,  // its error fell below the tolerance, or its parent replaced it
    OutOfView,
};

// A chunk that was drawn with ε above τ because its children were not resident.
struct LateArrival {
    ChunkId chunk;
    double sinceS = 0;
    double untilS = 0;         // of the first frame without it; of the last frame while it is open
    std::uint32_t frames = 0;  // in which it was drawn too coarse
    double worstEpsPx = 0;     // predicted error on screen
    double tauPx = 0;          // in the frame of worstEpsPx
    LateEnd end = LateEnd::Open;
};

// Totals since the meter was cleared.
struct PopTotals {
    std::array<std::uint64_t, popCauseCount> byCause{};
    std::uint64_t switches = 0;
    std::uint64_t notMeasured = 0;     // switches in a frame that changed the exaggeration
    std::uint64_t outsidePicture = 0;  // switches without a place in the picture
    std::uint64_t underSea = 0;        // switches with all their places in the picture under a drawn sea
    std::uint64_t afterJump = 0;       // visible, but after a jump
    std::uint64_t counted = 0;         // all others; the largest values below are of these
    std::uint64_t cameIntoView = 0;    // chunks that were culled in the previous frame
    std::uint64_t wentOutOfView = 0;
    std::uint64_t late = 0;  // late arrivals, including open ones
    double worstPx = 0;
    double worstBesidePx = 0;
    double measuringS = 0;  // spent in add() on measuring jumps
};

class PopMeter {
public:
    // Adds a frame: the drawn chunks, the view that shows them, and the settings that chose them. A time
    // before the last one clears everything first. When the exaggeration changes, all heights jump: switches
    // are counted by cause, but their jumps are not measured.
    void add(const ChunkTree& tree, const Selection& selection, const View& view, const LodSettings& settings,
             double timeS, const PopConditions& conditions = {});
    // Clears everything, for another planet.
    void clear();

    // Returns the switches of the last keptS seconds, at most mostEvents, oldest first; within a frame, by
    // chunk.
    const std::deque<PopEvent>& events() const { return events_; }
    // Returns the late arrivals in the order of their ends, open ones last.
    const std::deque<LateArrival>& late() const { return late_; }
    std::size_t lateOpen() const { return open_.size(); }
    const PopTotals& totals() const { return totals_; }
    // Returns the percentile of the jumps of the kept switches that count, by nearest rank; 0 if there are
    // none. share: [0, 1].
    double percentilePx(double share) const;
    double measuredUsPerSwitch() const;  // mean time to measure one switch
    double lastTimeS() const { return nowS_; }

    static constexpr double keptS = 300;
    static constexpr std::size_t mostEvents = 20'000;
    static constexpr std::size_t mostLate = 5'000;
    static constexpr std::size_t mostKeptItems = 200'000;  // of all kept DrawnFrames together

private:
    struct KeptChunk {
        DrawItem item;
        SharedHeights heights;
        ChildrenState children = ChildrenState::None;
    };
    struct Frame {
        std::vector<KeptChunk> chunks;  // in the order of the selection
        ChunkTable places{0};           // indices of chunks, by id
        View view;
        LodSettings settings;
        double exaggeration = 1;
        std::shared_ptr<const RegionSet> regions;
        PopConditions conditions;
        std::shared_ptr<const DrawnFrame> drawn;
    };
    struct Switch;
    struct Why {
        PopCause cause = PopCause::CameraMoved;
        bool afterJump = false;
    };
    // Switches that are decided but not drawn yet, with their causes, by the coarser chunk.
    struct Decided {
        std::unordered_map<ChunkId, Why> splits;
        std::unordered_map<ChunkId, Why> merges;
        std::unordered_set<ChunkId> loadsAfterJump;  // chunks that lack children since a jump
    };

    static Frame keep(const ChunkTree& tree, const Selection& selection, const View& view,
                      const LodSettings& settings);
    std::vector<Switch> findSwitches(const Frame& now);
    void measure(const PlanetShape& shape, const Frame& now, std::vector<Switch>& switches) const;
    void measureBeside(const PlanetShape& shape, const Frame& now, std::vector<Switch>& switches) const;
    bool isDrawn(const Frame& now, const Switch& change, const ChunkId& place) const;
    PopCause cameraOrSettings(const Frame& now) const;
    Why whyOf(const Frame& now, const Switch& change) const;
    Why whyOfWaiting(const Frame& now, const ChunkId& chunk, std::span<const Switch> switches) const;
    const Switch* switchAbove(const ChunkId& chunk, std::span<const Switch> switches) const;
    Decided findDecided(const Frame& now, const Selection& selection, std::span<const Switch> switches) const;
    bool neighbourCameOrWent(const Frame& now, const ChunkId& chunk) const;
    void note(const Frame& now, const Switch& change);
    void noteLate(const Frame& now);
    void endLate(const Frame& now, LateArrival& arrival) const;
    void forgetOld();

    std::optional<Frame> before_;
    Decided decided_;  // as of the last frame
    std::deque<PopEvent> events_;
    std::deque<LateArrival> late_;  // ended ones, then those in open_ as of the last frame
    std::unordered_map<ChunkId, LateArrival> open_;
    std::deque<std::shared_ptr<const DrawnFrame>> drawnFrames_;  // referenced by events
    std::size_t keptItems_ = 0;
    PopTotals totals_;
    std::uint64_t frame_ = 0;
    double nowS_ = 0;
};

}  // namespace planet
