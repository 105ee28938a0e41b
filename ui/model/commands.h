// The commands that panels, menus and keys send to the application: one struct per command, one std::variant
// per feature, and Command for any of them. The application executes them after all panels are drawn. Each
// feature has a controller (app/editor/..._controller.cpp), which does not compile without a function for
// each command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "app/data/bake_request.h"
#include "app/data/world_edit.h"
#include "app/measure/pop_side.h"
#include "app/measure/sweep_points.h"
#include "app/notes/note.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_vary.h"
#include "app/trace/trace_what_if_request.h"
#include "planet/bake/bake.h"
#include "planet/measure/atlas.h"
#include "planet/source/height_source.h"
#include "planet/sphere/block_id.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/view.h"
#include "planet/trace/trace_compare.h"
#include "ui/model/layout.h"
#include "ui/model/replay_controls.h"

namespace worldy::ui {

// Chunks.
struct HoverChunk {  // in this frame
    planet::ChunkId id;
};
struct SelectChunk {
    std::optional<planet::ChunkId> id;  // none: clears the selection
};
struct LookAtChunk {  // moves the camera to view the chunk, selected or not
    planet::ChunkId id;
};
using ChunkCommand = std::variant<HoverChunk, SelectChunk, LookAtChunk>;

// Cameras.
struct FreezeLod {
    bool frozen = false;
};
struct MoveCamera {
    planet::CameraPose pose;
    bool glides = false;  // if the preference allows it; otherwise the camera jumps
};
struct LookAtPoint {             // turns the camera so that a point lies in the middle of the picture
    glm::dvec3 pointM{0, 0, 0};  // from the planet's centre
};
struct OrbitPoint {  // orbits a point from now on, and turns to it
    glm::dvec3 pointM{0, 0, 0};
};
struct SetSteering {  // preferences of gamepads and 3-D mice
    double sensitivity = 1;
    bool inverted = false;
};
// Freezes LOD at the view of a measurement, so that the chunks measured are still drawn, and moves the camera
// near the place. A replay chooses its own chunks, so it is paused instead.
struct InspectPlace {
    planet::View lodView;
    planet::CameraPose pose;
};
struct EndInspection {};  // restores the camera and LOD view from before the first InspectPlace
struct ResetCamera {};
struct KeepCameraAsStart {};
struct AddBookmark {  // of the current camera; replaces one of the same name
    std::string name;
};
struct RemoveBookmark {
    std::string name;
};
struct SetSpeedFactor {
    double factor = 1;
};
struct StartFlight {  // follows it from its start
    std::filesystem::path file;
};
struct MoveFlight {  // to a time, seconds
    double timeS = 0;
};
struct PauseFlight {
    bool paused = false;
};
using CameraCommand = std::variant<FreezeLod, MoveCamera, LookAtPoint, OrbitPoint, SetSteering, InspectPlace,
                                   EndInspection, ResetCamera, KeepCameraAsStart, AddBookmark, RemoveBookmark,
                                   SetSpeedFactor, StartFlight, MoveFlight, PauseFlight>;

// Paging.
struct PausePaging {
    bool paused = false;
};
struct LoadOne {};
struct DropAll {};
struct RetryFailed {
    std::optional<planet::BlockId> block{};  // none: all
};
using PagingCommand = std::variant<PausePaging, LoadOne, DropAll, RetryFailed>;

// Frames.
struct PauseFrames {  // stops motion, selection and loading, except by StepFrame
    bool paused = false;
};
struct StepFrame {};
struct DrawAtFullSpeed {  // without idling, a frame limit and waiting for the monitor, until it is turned off
    bool on = false;
};
struct RecordTimeline {  // what was recorded stays
    bool on = true;
};
using FrameCommand = std::variant<PauseFrames, StepFrame, DrawAtFullSpeed, RecordTimeline>;

// Files.
struct OpenFile {  // a chunk file, an elevation image, a cube face, a settings file or a screenshot
    std::filesystem::path file;
    bool asks = false;  // about a raster that could become a layer of the open planet
};
enum class FilePurpose : std::uint8_t { Open, BakedColours, SideB, TraceB, EarlierAtlas };
struct AskForFile {  // shows the dialog that asks for a file
    FilePurpose purpose = FilePurpose::Open;
};
using FileCommand = std::variant<OpenFile, AskForFile>;

// Bakes.
struct ChooseColourImage {  // puts the image into the Bake panel
    std::filesystem::path file;
};
struct StartBake {
    BakeRequest request;
};
struct BakeAgain {};  // repeats the bake that the current data set needs to be shown
struct EstimateBake {
    BakeRequest request;
};
struct CancelBake {};
struct PreviewSource {  // replaces the previous request
    PreviewRequest request;
};
struct ShowPreviousBake {
    bool shown = false;
};
struct DismissPreviousBake {};
using BakeCommand = std::variant<ChooseColourImage, StartBake, BakeAgain, EstimateBake, CancelBake,
                                 PreviewSource, ShowPreviousBake, DismissPreviousBake>;

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
struct SaveLayout {  // of the panels
    std::string name;
    bool replaces = false;  // false: an existing layout is kept, and an error is shown
};
struct LoadLayout {
    std::string name;
};
struct DeleteLayout {
    std::string name;
};
struct NextLayout {};   // the default, the saved ones, and the panels before the last change of layout
struct ResetLayout {};  // to the default
struct SaveRegions {    // of the planet, beside it unless they are from another file
    std::filesystem::path file{};  // empty: that file
    bool replaces = false;  // false: the user is asked before comments or changes by another program are lost
};
struct KeepRegionsFile {};  // answers that question: nothing is saved
struct LoadRegions {        // replaces those of the planet
    std::filesystem::path file;
};
struct KeepWindow {};     // answers the question of Quit: the window stays
struct RestoreLayout {};  // to the panels before the last change of layout, if they were not saved
using SettingsCommand = std::variant<Undo, Redo, SavePreset, LoadPreset, DeletePreset, SaveLayout, LoadLayout,
                                     DeleteLayout, NextLayout, ResetLayout, RestoreLayout, SaveRegions,
                                     KeepRegionsFile, LoadRegions, KeepWindow>;

// The window.
struct CopyCommandLine {};
struct CopyText {
    std::string text;
    std::string done{};  // what the viewport confirms; empty: nothing
};
struct SaveExport {         // what a table or a plot shows, into a new file beside the screenshots
    std::string name;       // part of the file's name
    std::string extension;  // "csv"
    std::string text;
};
struct SavePlotPicture {  // a part of the window, from this frame, as PNG
    std::string name;
    Rect rect;  // in the window
};
struct TakeScreenshot {
    bool withPanels = false;
};
struct WriteKeyFile {};  // with all commands and their default keys; an existing file is kept
struct ReloadKeys {};
struct SaveReport {};  // of the session, into a new folder beside the screenshots
struct Quit {
    enum class Unsaved : std::uint8_t { Ask, Save, Discard };
    Unsaved regions = Unsaved::Ask;  // what to do about those that are not saved
};
using WindowCommand = std::variant<CopyCommandLine, CopyText, SaveExport, SavePlotPicture, TakeScreenshot,
                                   WriteKeyFile, ReloadKeys, SaveReport, Quit>;

// Texture layers.
struct LoadLayerSet {
    std::filesystem::path file;
};
struct SaveLayerSet {  // as a user set
    std::string name;
};
struct ReloadLayerTextures {};
using LayerCommand = std::variant<LoadLayerSet, SaveLayerSet, ReloadLayerTextures>;

// Instruments.
struct MarkAllocations {};     // stores the current allocations as the mark
struct TryCostlyParts {};      // turns features on again that were too slow
struct MeasureCracks {};       // of the current view
struct MeasureCosts {};        // of rendering features
struct FindSmallestSkirts {};  // the smallest that cover all measured cracks
struct MeasurePops {
    bool on = true;
};
struct ClearPops {};
struct GoBackToPop {  // inspects the place of one of the meter's events
    std::uint64_t frame = 0;
    planet::ChunkId chunk;
};
struct ShowPopSide {  // draws the surface before or after the last inspected event, or the current one
    PopSide side = PopSide::Live;
};
struct MeasureErrors {};  // the true error of the current view, in the background
struct KeepMeasuringErrors {
    bool on = false;
};
struct TakeRulerClicks {  // clicks on the ground place the ruler's ends
    bool on = false;
};
struct PlaceRulerEnd {
    glm::dvec3 positionM{0, 0, 0};  // on the drawn ground, from the planet's centre
};
struct SwapRulerEnds {};
struct ClearRuler {};
struct HoverProfile {       // in this frame: the pictures mark the place between the ruler's ends
    std::size_t point = 0;  // of the measured profile
};
using InstrumentCommand =
    std::variant<TakeRulerClicks, PlaceRulerEnd, SwapRulerEnds, ClearRuler, HoverProfile, MarkAllocations,
                 TryCostlyParts, MeasureCracks, MeasureCosts, FindSmallestSkirts, MeasurePops, ClearPops,
                 GoBackToPop, ShowPopSide, MeasureErrors, KeepMeasuringErrors>;

// Recorded flights.
struct StartRecording {  // resets the planet; no name: the next free one
    std::string name;
};
struct StopRecording {};  // and saves it
struct DeleteRecording {
    std::filesystem::path file;
};
struct StartReplay {
    std::filesystem::path file;
};
struct MoveReplay {  // to a number of frames made, >= 1
    std::size_t frame = 1;
};
struct MoveReplayTo {  // to the last frame that ends no later than timeS, seconds from the start
    double timeS = 0;
};
struct SetReplay {
    ReplayControls controls;
};
struct StopReplay {};  // restores the camera and settings from before
using RecordingCommand = std::variant<StartRecording, StopRecording, DeleteRecording, StartReplay, MoveReplay,
                                      MoveReplayTo, SetReplay, StopReplay>;

// Sweeps over the shown planet.
struct StartSweep {  // in the background; searches for a tau if the request has a goal
    SweepRequest request;
};
struct CancelSweep {};
struct SaveSweep {  // table and plot, beside the screenshots
    SweepCost cost = SweepCost::Triangles;
};
struct OpenSweptChunks {  // shows the chunks of one size from the last sweep
    int chunkSize = 33;
};
using SweepCommand = std::variant<StartSweep, CancelSweep, SaveSweep, OpenSweptChunks>;

// Comparing. A is the shown planet, B a second one.
struct StartCompare {  // replaces B if there is one
    enum class With : std::uint8_t { SettingsKept, Preset, PreviousBake, File };
    With with = With::SettingsKept;
    std::string preset;          // for With::Preset
    std::filesystem::path file;  // for With::File
};
struct StopCompare {};
struct SwapCompare {};
struct MeasureCompare {};  // measures the true error and the cracks of both in this view
struct CompareOverFlight {
    std::filesystem::path flight;
    int moments = 12;  // sample frames, [1, 100000]
};
struct CancelCompareFlight {};
using CompareCommand = std::variant<StartCompare, StopCompare, SwapCompare, MeasureCompare, CompareOverFlight,
                                    CancelCompareFlight>;

// The source of the shown planet, and its layers.
struct ReadSource {};  // opens the source in the background to describe its layers
struct EditLayers {    // replaces the edited layers
    WorldEdit edit;
};
struct RevertLayers {};  // to those of the planet, or to those of the file if they are those of the planet
struct BakeLayers {};    // with the settings of the open file
struct SaveLayers {      // as a world file
    std::filesystem::path file;
    bool replaces = false;  // false: an existing file is kept, and the user is asked
};
struct AddDroppedFiles {};   // adds the files of the drop question as a layer
struct OpenDroppedFiles {};  // opens them as a planet
struct DismissDrop {};
using SourceCommand = std::variant<ReadSource, EditLayers, RevertLayers, BakeLayers, SaveLayers,
                                   AddDroppedFiles, OpenDroppedFiles, DismissDrop>;

// Traces of other engines (planet/trace).
struct OpenTrace {  // a file; replaces the trace that is shown
    std::filesystem::path file;
    bool isResumed = false;   // it goes on with the last session, which keeps the panels as they are
    std::uint64_t frame = 0;  // to show; 0: the first one that draws something
};
struct AttachTrace {  // to an engine that listens on this machine
    int port = 9910;  // [1, 65535]
};
struct DetachTrace {};  // what has arrived stays open as a file
struct CloseTrace {};
struct ShowTraceFrame {  // by number; the nearest one that the trace has
    std::uint64_t frame = 0;
};
struct StepTrace {  // by frames, forwards or backwards
    int frames = 1;
};
struct PlayTrace {
    bool playing = false;
    double speed = 1;    // of the engine's clock, > 0
    bool newest = true;  // stays at the newest frame while an engine is attached
};
struct SelectTraceNode {
    std::optional<std::uint64_t> id;  // none: clears the selection
};
struct SelectTraceView {
    int view = 0;  // [0, 16)
};
struct ShowTraceOnPlanet {  // draws the drawn nodes over the open planet
    bool shown = true;
};
struct LookAsTrace {};     // moves the camera to that of the traced view
struct StartTraceWhatIf {  // over the whole trace, in the background
    TraceWhatIfRequest request;
};
struct CancelTraceWhatIf {};
struct StartTraceCompare {  // of the open trace, A, with another one, in the background
    std::filesystem::path fileB;
    std::optional<planet::TraceMatch> match{};  // of frames; none: as the last time
    bool isShown = true;                        // the panel with the result comes to the front
};
struct CancelTraceCompare {};
using TraceCommand = std::variant<OpenTrace, AttachTrace, DetachTrace, CloseTrace, ShowTraceFrame, StepTrace,
                                  PlayTrace, SelectTraceNode, SelectTraceView, ShowTraceOnPlanet, LookAsTrace,
                                  StartTraceWhatIf, CancelTraceWhatIf, StartTraceCompare, CancelTraceCompare>;

// Surveys of the whole planet (planet/measure/atlas.h).
struct OpenAtlas {
    std::filesystem::path file;
};
struct StartAtlas {  // of the shown planet, in the background, with the current settings
    std::uint64_t viewpoints = 1000;
    bool measuresError = false;
};
struct CancelAtlas {};  // keeps what was surveyed
struct ResumeAtlas {};  // continues the shown atlas, which is not finished, with its own settings
struct RevisitAtlas {   // surveys the viewpoints of the shown atlas on the shown planet, and compares both
    bool withItsSettings = true;  // otherwise with the current settings
};
struct CompareAtlas {  // the shown atlas with an earlier survey of the same viewpoints
    std::filesystem::path earlier;
};
struct ChooseAtlas {  // to show
    planet::AtlasMeasure measure = planet::AtlasMeasure::EpsPx;
    int altitude = 0;       // index
    bool isChange = false;  // since the earlier survey
};
struct LookFromAtlas {          // moves the camera to a viewpoint and takes over the settings of the survey
    std::size_t viewpoint = 0;  // index
};
using AtlasCommand = std::variant<OpenAtlas, StartAtlas, CancelAtlas, ResumeAtlas, RevisitAtlas, CompareAtlas,
                                  ChooseAtlas, LookFromAtlas>;

// Settings for a budget (app/suggest).
struct StartSuggest {      // for the shown planet, in the background, from the current settings
    SuggestBudget budget;  // not empty
    std::vector<std::filesystem::path> flights{};
    bool surveys = false;           // also measures viewpoints of the whole planet
    std::vector<int> chunkSizes{};  // that may be suggested instead of the planet's own
    SuggestVary vary{};
    PictureSize size{};
};
struct CancelSuggest {};
struct ApplySuggest {};  // of the last result
struct SaveSuggest {};   // beside the screenshots
using SuggestCommand = std::variant<StartSuggest, CancelSuggest, ApplySuggest, SaveSuggest>;

// Notes on the planet.
struct AddNote {
    Note note;
};
struct EditNote {
    std::uint64_t id = 0;
    std::string text;
};
struct DeleteNote {
    std::uint64_t id = 0;
};
struct OpenNote {  // in the Notes panel
    std::uint64_t id = 0;
};
using NoteCommand = std::variant<AddNote, EditNote, DeleteNote, OpenNote>;

using FeatureCommand = std::variant<ChunkCommand, CameraCommand, PagingCommand, FrameCommand, FileCommand,
                                    BakeCommand, SettingsCommand, WindowCommand, LayerCommand,
                                    InstrumentCommand, RecordingCommand, SweepCommand, CompareCommand,
                                    SourceCommand, TraceCommand, AtlasCommand, SuggestCommand, NoteCommand>;

// FeatureOf<Kind> is the variant that holds a kind of command: FeatureOf<SelectChunk> is ChunkCommand.
template <class Kind, class Features>
struct FindFeature;
template <class Kind, class... Kinds, class... Features>
struct FindFeature<Kind, std::variant<std::variant<Kinds...>, Features...>>
    : std::conditional_t<(std::is_same_v<Kind, Kinds> || ...), std::type_identity<std::variant<Kinds...>>,
                         FindFeature<Kind, std::variant<Features...>>> {};
template <class Kind>
struct FindFeature<Kind, std::variant<>> {};
template <class Kind>
using FeatureOf = typename FindFeature<Kind, FeatureCommand>::type;

// A command of any feature. It is made and destroyed in commands.cpp, because the variants take long to compile: a file
// that sends commands compiles only those of the features that it uses.
class Command {
public:
    template <class Kind, class Feature = FeatureOf<Kind>>
    Command(Kind command) : Command(std::in_place, Feature(std::in_place_type<Kind>, std::move(command))) {}
    Command(Command&&) noexcept;
    Command& operator=(Command&&) noexcept;
    ~Command();

    const FeatureCommand& feature() const;

    // Returns null if the command is of another kind.
    template <class Kind>
    const Kind* as() const {
        const auto* of = std::get_if<FeatureOf<Kind>>(&feature());
        return of ? std::get_if<Kind>(of) : nullptr;
    }

private:
    // Instantiated for each feature in commands.cpp.
    template <class Feature>
    Command(std::in_place_t, Feature feature);

    std::unique_ptr<const FeatureCommand> feature_;
};
using Commands = std::vector<Command>;

}  // namespace worldy::ui
