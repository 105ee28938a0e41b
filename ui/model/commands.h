// What panels, menus and keys ask the application to do. They append; the application obeys after all panels
// have been drawn (app/editor/commands.cpp has one function a command).
#pragma once

#include <any>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/data/bake_request.h"
#include "app/measure/pop_side.h"
#include "app/measure/sweep_points.h"
#include "app/settings/view_settings.h"
#include "planet/bake/bake.h"
#include "planet/source/height_source.h"
#include "planet/sphere/block_id.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/view.h"
#include "ui/model/replay_controls.h"

namespace worldy::ui {

// Chunks.
struct HoverChunk {  // for this frame
    planet::ChunkId id;
};
struct SelectChunk {
    std::optional<planet::ChunkId> id;  // none: nothing is selected any more
};
struct LookAtChunk {  // moves the camera to where the chunk is drawn, selected or not
    planet::ChunkId id;
};

// Cameras.
struct FreezeLod {
    bool frozen = false;
};
struct MoveCamera {
    planet::CameraPose pose;
};
// Freezes LOD at the view that something was measured in, so that what was found there is still drawn, and
// moves the camera near it. In a replay, which chooses its chunks itself, pauses the replay instead.
struct InspectPlace {
    planet::View lodView;
    planet::CameraPose pose;
};
struct EndInspection {};  // gives back the camera and the LOD view of before the first InspectPlace
struct ResetCamera {};
struct KeepCameraAsStart {};
struct AddBookmark {  // of the camera as it is; replaces one of the same name
    std::string name;
};
struct RemoveBookmark {
    std::string name;
};
struct SetSpeedFactor {
    double factor = 1;
};
struct StartFlight {  // follows it from its beginning
    std::filesystem::path file;
};
struct MoveFlight {  // to a time, seconds
    double timeS = 0;
};
struct PauseFlight {
    bool paused = false;
};

// Paging.
struct PausePaging {
    bool paused = false;
};
struct LoadOne {};
struct DropAll {};
struct RetryFailed {
    std::optional<planet::BlockId> block{};  // or all
};

// Frames.
struct PauseFrames {  // nothing moves, is chosen or loaded but by StepFrame
    bool paused = false;
};
struct StepFrame {};

// Data.
struct OpenFile {  // a chunk file, an elevation image, a cube face, a settings file or a screenshot
    std::filesystem::path file;
};
struct AskForFile {};         // shows the dialog that asks for a file to open
struct AskForColourImage {};  // the same for the Bake panel's image of colours
struct ChooseColourImage {    // puts it into the Bake panel
    std::filesystem::path file;
};
struct StartBake {
    BakeRequest request;
};
struct BakeAgain {};  // the last one, of a data set that cannot be shown without it
struct EstimateBake {
    BakeRequest request;
};
struct CancelBake {};
struct PreviewSource {  // in place of what was asked before
    PreviewRequest request;
};
struct ShowPreviousBake {
    bool shown = false;
};
struct DismissPreviousBake {};

// Settings.
struct Undo {};
struct Redo {};
struct SavePreset {
    std::string name;
};
struct LoadPreset {
    std::string name;
};
struct DeletePreset {
    std::string name;
};
struct CopyCommandLine {};
struct CopyText {
    std::string text;
};
struct TakeScreenshot {
    bool withPanels = false;
};
struct Quit {};

// Texture layers.
struct LoadLayerSet {
    std::filesystem::path file;
};
struct SaveLayerSet {  // as one of the user's own
    std::string name;
};
struct ReloadLayerTextures {};
struct MarkAllocations {};  // what is held from now on is compared with what is held now
struct TryCostlyParts {};   // those that were turned down

// Instruments.
struct MeasureCracks {};       // of the view as it is
struct MeasureCosts {};        // of the parts of the picture
struct FindSmallestSkirts {};  // that leave none of the cracks measured open
// Pops.
struct MeasurePops {
    bool on = true;
};
struct ClearPops {};
struct GoBackToPop {  // inspects where one of the meter's events was seen
    std::uint64_t frame = 0;
    planet::ChunkId chunk;
};
struct ShowPopSide {  // of the event last gone back to: what was drawn then instead of what is chosen now
    PopSide side = PopSide::Live;
};
struct MeasureErrors {};  // the true error of what is drawn now, in the background
struct KeepMeasuringErrors {
    bool on = false;
};

// Recorded flights.
struct StartRecording {  // the planet starts anew; no name: the next free one
    std::string name;
};
struct StopRecording {};  // and keeps it
struct DeleteRecording {
    std::filesystem::path file;
};
struct StartReplay {
    std::filesystem::path file;
};
struct MoveReplay {  // until so many frames are made, at least one
    std::size_t frame = 1;
};
struct MoveReplayTo {  // to the last frame that ends no later than this, seconds from the start
    double timeS = 0;
};
struct SetReplay {
    ReplayControls controls;
};
struct StopReplay {};  // gives back what was before

// Sweeps over the planet that is shown.
struct StartSweep {  // in the background; or looks for a tau, where the request has a goal
    SweepRequest request;
};
struct CancelSweep {};
struct SaveSweep {  // table and plot, beside the screenshots
    SweepCost cost = SweepCost::Triangles;
};
struct OpenSweptChunks {  // shows the chunks of a size that the last sweep has flown
    int chunkSize = 33;
};

// Comparing. What is shown is A; B is a second planet.
struct StartCompare {  // or takes another B
    enum class With : std::uint8_t { SettingsKept, Preset, PreviousBake, File };
    With with = With::SettingsKept;
    std::string preset;          // of Preset
    std::filesystem::path file;  // of File
};
struct StopCompare {};
struct SwapCompare {};
struct MeasureCompare {};  // true error and cracks of this view, of both
struct CompareOverFlight {
    std::filesystem::path flight;
    int moments = 12;  // of it, [1, 100000]
};
struct CancelCompareFlight {};

template <class... Kinds>
struct CommandKindList {};

// All there are. app/editor/commands.cpp does not compile without a function for each.
using CommandKinds = CommandKindList<
    HoverChunk, SelectChunk, LookAtChunk, FreezeLod, MoveCamera, InspectPlace, EndInspection, ResetCamera,
    KeepCameraAsStart, AddBookmark, RemoveBookmark, SetSpeedFactor, StartFlight, MoveFlight, PauseFlight,
    PausePaging, LoadOne, DropAll, RetryFailed, PauseFrames, StepFrame, OpenFile, AskForFile, StartBake,
    BakeAgain, EstimateBake, CancelBake, ShowPreviousBake, DismissPreviousBake, Undo, Redo, SavePreset,
    LoadPreset, DeletePreset, CopyCommandLine, CopyText, TakeScreenshot, Quit, MeasureCracks, MeasureCosts,
    FindSmallestSkirts, MeasurePops, ClearPops, GoBackToPop, ShowPopSide, MeasureErrors, KeepMeasuringErrors,
    StartRecording, StopRecording, DeleteRecording, StartReplay, MoveReplay, MoveReplayTo, SetReplay,
    StopReplay, StartSweep, CancelSweep, SaveSweep, OpenSweptChunks, StartCompare, StopCompare, SwapCompare,
    MeasureCompare, CompareOverFlight, CancelCompareFlight, LoadLayerSet, SaveLayerSet, ReloadLayerTextures,
    PreviewSource, AskForColourImage, ChooseColourImage, TryCostlyParts, MarkAllocations>;

template <class Kind, class... Kinds>
constexpr bool isOneOf(CommandKindList<Kinds...>) {
    return (std::is_same_v<Kind, Kinds> || ...);
}

// One of any kind. Not a variant of them: whoever makes one would have the compiler write out for all kinds
// what moves and ends them, for longer than it takes to compile the rest of a panel.
class Command {
public:
    template <class Kind>
    requires(isOneOf<Kind>(CommandKinds{})) Command(Kind command) : held_(std::move(command)) {}

    // Null where it is of another kind.
    template <class Kind>
    requires(isOneOf<Kind>(CommandKinds{})) const Kind* as() const { return std::any_cast<Kind>(&held_); }

private:
    std::any held_;
};
using Commands = std::vector<Command>;

}  // namespace worldy::ui
