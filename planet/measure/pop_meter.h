// Measures the visible effects of changes of level: the jump of the drawn surface on screen in the frame of a
// switch (a pop), and the time that chunks are drawn too coarse because their children have not loaded (late
// arrivals). It takes one selection per frame and uses no clock and no GL. One thread at a time; frames with
// many switches use several cores.
//
// A pop is the distance on screen, through the new view, between the surface as it was drawn in the frame
// before, morph included, and as it is drawn now at the same place. The motion of the camera does not count,
// but the sliding of vertices in that frame does. Only places in the picture count, hidden by ground or not;
// places under a drawn sea do not count.
//
// A jump of the camera, and the first frame, begin loads and fades that do not represent a moving camera.
// Every switch that results from such a frame is marked as after a jump, until none of them waits any more.
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

// Why a place changed its level. A switch that fades is drawn many frames after it was decided: it has the
// cause of the frame that decided it, and so do the switches above and below that follow it. If the settings
// and the camera change in one frame, the settings are the cause.
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

// The drawn chunks of a switch, for showing them again.
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

// Returns whether an event counts: it is seen, and not after a jump.
inline bool counts(const PopEvent& event) {
    return event.jump.places > 0 && !event.afterJump;
}
// Returns why it does not count: "not measured", "outside picture", "under sea" or "after jump"; "" if it
// counts.
const char* popNote(const PopEvent& event);
// Orders events that count first, then by the largest jump, then by the earliest.
bool isWorsePop(const PopEvent& a, const PopEvent& b);

enum class LateEnd : std::uint8_t {
    Open,       // still late
    Loaded,     // its children took its place
    NotWanted,  // its error came below the tolerance, or its parent took its place
    OutOfView,
};

// A chunk that was drawn with eps over tau, because its children were not resident.
struct LateArrival {
    ChunkId chunk;
    double sinceS = 0;
    double untilS = 0;         // of the first frame that did without it; of the last frame while it is open
    std::uint32_t frames = 0;  // that it was drawn in, too coarse
    double worstEpsPx = 0;     // predicted error on screen
    double tauPx = 0;          // at the worst
    LateEnd end = LateEnd::Open;
};

// Totals since the meter was cleared.
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
    // Adds a frame: the drawn chunks, the view that shows them, and the settings that chose them. A time
    // before the last one clears everything first. When the exaggeration changes, all heights jump: switches
    // are counted by cause, but their jumps are not measured.
    void add(const ChunkTree& tree, const Selection& selection, const View& view, const LodSettings& settings,
             double timeS, const PopConditions& conditions = {});
    // Clears everything, for another planet.
    void clear();

    // Returns the switches of the last keptS seconds, at most mostEvents, oldest first; those of one frame by
    // chunk.
    const std::deque<PopEvent>& events() const { return events_; }
    // Returns the late arrivals in the order in which they ended; those that have not ended are last.
    const std::deque<LateArrival>& late() const { return late_; }
    std::size_t lateOpen() const { return open_.size(); }
    const PopTotals& totals() const { return totals_; }
    // Returns the jump that a share, [0, 1], of the kept switches that count does not exceed, by nearest
    // rank; 0 if there are none.
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
