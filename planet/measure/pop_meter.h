// Measures what one sees when the level of detail changes: how far the drawn surface jumps on screen in the
// frame of a switch (a pop), and how long chunks are drawn though they are too coarse because their children
// have not come (late arrivals). Plain data, fed with one selection a frame; no clock, no GL. One thread at a
// time; it works on several cores itself where much switches at once.
//
// A pop is the distance on screen, through the new view, between the surface as it was drawn in the frame
// before, morph included, and as it is drawn now at the same place. A camera that moves does not count, but
// what vertices slide in that frame anyway does. Only places in the picture are looked at; whether something
// hides them is not asked, but for a drawn sea: places under it do not count.
//
// A jump of the camera, and the first frame of all, begin loads and fades that say nothing about a camera
// that moves. Every switch that comes of what was wanted in such a frame is marked as after a jump, until
// none of it waits any more.
//
// What comes into view or goes out of it is no change of level.
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

// Why a place changed its level. A switch that fades is drawn many frames after it was decided: it has the
// cause of the frame that decided it, and so have those below and above it that it is followed by. Where the
// settings and the camera change in one frame, the settings are the cause.
enum class PopCause : std::uint8_t {
    CameraMoved,      // its error crossed the tolerance
    SettingsChanged,  // what chooses the level, field of view, picture size or exaggeration changed
    LoadFinished,     // it was waiting for its children, and they came
    Evicted,          // its children are gone though they are wanted
    SeamLimit,        // how far neighbours may differ with stitched seams, since a neighbour changed
    Culling,          // the same, since a neighbour came into view or went out
};
inline constexpr std::size_t popCauseCount = 6;
const char* popCauseName(PopCause cause);  // "camera moved"

// Further facts about a frame that the meter needs.
struct PopConditions {
    bool cameraJumped = false;     // since the frame before, or is on its way to a flight
    std::optional<double> seaM{};  // level of a sea that is drawn as water, metres above the radius
};

// What was drawn in a frame, for looking at it again.
struct DrawnFrame {
    std::vector<DrawItem> items;
    View view;
    bool stitched = false;
};

struct PopEvent {
    double timeS = 0;
    std::uint64_t frame = 0;  // frames that were added before it
    ChunkId chunk;            // the coarser one: replaced, or taking the finer ones' place
    int fromLevel = 0;        // of the finest chunk on either side
    int toLevel = 0;
    PopCause cause = PopCause::CameraMoved;
    bool afterJump = false;  // it was wanted in the frame of a jump, or in the first
    bool measured = true;    // false where the exaggeration changed in the same frame
    SurfaceJump jump;        // of the place itself; jump.places is 0 where nothing of it is seen
    double besidePx = 0;     // the largest screenPx along edges of unchanged chunks that it lies beside
    View viewBefore;
    View view;                     // that the jump is measured in
    std::vector<DrawItem> before;  // at the chunk's place; node and slot held in that frame only
    std::vector<DrawItem> after;
    std::weak_ptr<const DrawnFrame> frameBefore;  // all that was drawn; gone once it is too old
    std::weak_ptr<const DrawnFrame> frameAfter;
};

// Whether an event counts: it is seen, and not after a jump.
inline bool counts(const PopEvent& event) {
    return event.jump.places > 0 && !event.afterJump;
}
// Why it does not: "not measured", "outside picture", "under sea" or "after jump"; "" where it counts.
const char* popNote(const PopEvent& event);
// Those that count first, of either kind the largest jump first, and of equal ones the earliest.
bool isWorsePop(const PopEvent& a, const PopEvent& b);

enum class LateEnd : std::uint8_t {
    Open,       // still late
    Loaded,     // its children took its place
    NotWanted,  // its error came below the tolerance, or its parent took its place
    OutOfView,
};

// A chunk that was drawn though its eps was over tau, since its children were not resident.
struct LateArrival {
    ChunkId chunk;
    double sinceS = 0;
    double untilS = 0;         // of the first frame that did without it; of the last frame while it is open
    std::uint32_t frames = 0;  // that it was drawn in, too coarse
    double worstEpsPx = 0;     // predicted error on screen
    double tauPx = 0;          // at the worst
    LateEnd end = LateEnd::Open;
};

// Since the meter was cleared.
struct PopTotals {
    std::array<std::uint64_t, popCauseCount> byCause{};
    std::uint64_t switches = 0;
    std::uint64_t notMeasured = 0;     // switches in a frame that changed the exaggeration
    std::uint64_t outsidePicture = 0;  // switches of which no place lay in the picture
    std::uint64_t underSea = 0;        // of which all places in the picture lay under a drawn sea
    std::uint64_t afterJump = 0;       // seen, but after a jump
    std::uint64_t counted = 0;         // the others; the largest below are of these
    std::uint64_t cameIntoView = 0;    // chunks that were culled in the frame before
    std::uint64_t wentOutOfView = 0;
    std::uint64_t late = 0;  // late arrivals, open ones too
    double worstPx = 0;
    double worstBesidePx = 0;
    double measuringS = 0;  // spent in add() on measuring jumps
};

class PopMeter {
public:
    // One frame: what is drawn now, the view that shows it, and the settings that chose it. A time before the
    // last one forgets everything first. Across another exaggeration all heights jump: switches are counted by
    // cause, but no jump of theirs is measured.
    void add(const ChunkTree& tree, const Selection& selection, const View& view, const LodSettings& settings,
             double timeS, const PopConditions& conditions = {});
    // Forgets everything: for another planet.
    void clear();

    // Of the last keptS seconds and at most mostEvents, oldest first; of one frame by chunk.
    const std::deque<PopEvent>& events() const { return events_; }
    // The same, by when they ended; those still open last.
    const std::deque<LateArrival>& late() const { return late_; }
    std::size_t lateOpen() const { return open_.size(); }
    const PopTotals& totals() const { return totals_; }
    // The jump that a share, [0, 1], of the kept switches that count does not exceed: nearest rank. 0
    // where there are none.
    double percentilePx(double share) const;
    double measuredUsPerSwitch() const;  // time that measuring one switch takes, on average
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
    // A frame as it was drawn.
    struct Frame {
        std::vector<KeptChunk> chunks;  // in the order of the selection
        ChunkTable places{0};           // of chunks, by id
        View view;
        LodSettings settings;
        double exaggeration = 1;
        PopConditions conditions;
        std::shared_ptr<const DrawnFrame> drawn;
    };
    struct Switch;
    struct Why {
        PopCause cause = PopCause::CameraMoved;
        bool afterJump = false;
    };
    // Switches that are decided and not drawn yet, with what decided them; by the coarser chunk.
    struct Decided {
        std::unordered_map<ChunkId, Why> splits;
        std::unordered_map<ChunkId, Why> merges;
        std::unordered_set<ChunkId> loadsAfterJump;  // drawn, waiting for children since a jump
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
    std::deque<std::shared_ptr<const DrawnFrame>> drawnFrames_;  // that events refer to
    std::size_t keptItems_ = 0;
    PopTotals totals_;
    std::uint64_t frame_ = 0;
    double nowS_ = 0;
};

}  // namespace planet
