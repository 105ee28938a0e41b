#include "ui/camera_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "ui/item_map.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

const CameraSettings defaultCamera;

struct PoseField {
    const char* label;
    double planet::CameraPose::*value;
    double min;
    double max;
    const char* format;
    const char* explanation;
};
using Pose = planet::CameraPose;
constexpr std::array<PoseField, 5> poseFields = {{
    {"Latitude", &Pose::latitudeDeg, -90, 90, "%.5f deg", "Degrees north of the equator."},
    {"Longitude", &Pose::longitudeDeg, -360, 360, "%.5f deg", "Degrees east."},
    {"Altitude", &Pose::altitudeM, -1e8, 2e10, "%.1f m",
     "Metres above the planet's radius, which is not the ground; the ground keeps the camera above it."},
    {"Heading", &Pose::headingDeg, -360, 360, "%.2f deg", "Degrees from north over east."},
    {"Pitch", &Pose::pitchDeg, -90, 90, "%.2f deg", "Degrees above level; -90 looks straight down."},
}};

void modeControl(const EditorView& view, ViewSettings& settings, Commands& commands) {
    CameraMode mode = settings.camera.mode;
    if (!choice("Mode", mode, defaultCamera.mode, "fly\0orbit\0follow a flight\0",
                "Fly: drag moves the ground, keys W A S D E Q move the camera. Orbit: drag turns the camera "
                "about the ground that was in the middle, the wheel changes the distance, the right button "
                "moves the point. Follow a flight: a recorded way; touching the controls leaves it."))
        return;
    const bool follows = mode == CameraMode::FollowFlight;
    if (follows && settings.camera.flight.empty()) {
        if (!view.camera.flights.empty()) commands.push_back(StartFlight{view.camera.flights.front()});
        return;
    }
    settings.camera.mode = mode;
}

void motionSection(const EditorView& view, ViewSettings& settings, Commands& commands) {
    modeControl(view, settings, commands);
    slider("Field of view", settings.camera.fovDeg, defaultCamera.fovDeg, 5.0, 150.0, "%.0f deg",
           "Horizontal angle of view, degrees. Smaller: errors are magnified, so more detail is chosen, "
           "K' = W / (2 tan(fov / 2)).");
    double factor = view.camera.speedFactor;
    if (slider("Speed", factor, 1.0, 1.0 / 64, 64.0, "%.2f x",
               "Of the keys, + and -. At 1 x the camera moves 0.6 of its height above the ground a second.",
               ImGuiSliderFlags_Logarithmic))
        commands.push_back(SetSpeedFactor{factor});
}

// One number of the pose. While it is typed, it stands still though the camera may move.
bool poseControl(int index, Pose& pose, CameraPanelState& state) {
    const PoseField& field = poseFields[static_cast<std::size_t>(index)];
    ImGui::PushID(index);
    labelledControl(field.label, field.explanation);
    double value = state.typedField == index ? state.typedValue : pose.*field.value;
    ImGui::InputDouble("##value", &value, 0, 0, field.format);
    const bool entered = ImGui::IsItemDeactivatedAfterEdit();
    if (ImGui::IsItemActive()) {
        state.typedField = index;
        state.typedValue = value;
    } else if (state.typedField == index) {
        state.typedField = -1;
    }
    tooltip(field.explanation);
    ImGui::PopID();
    if (entered) pose.*field.value = std::clamp(value, field.min, field.max);
    return entered;
}

void poseSection(const EditorView& view, CameraPanelState& state, Commands& commands) {
    if (!section("Place")) return;
    Pose pose = view.camera.pose;
    for (int i = 0; i < static_cast<int>(poseFields.size()); ++i) {
        if (poseControl(i, pose, state)) commands.push_back(MoveCamera{pose});
    }
    if (beginValues("height")) {
        valueRow("Above ground", distanceText(view.camera.heightAboveGroundM),
                 "Height above the finest ground that is loaded below the camera.");
        endValues();
    }
    if (button("Reset", "Back to where this session started (F3).")) commands.push_back(ResetCamera{});
    ImGui::SameLine();
    if (button("Start here", "Sessions begin with this view from now on."))
        commands.push_back(KeepCameraAsStart{});
}

void bookmarkRow(const Bookmark& bookmark, Commands& commands) {
    ImGui::PushID(bookmark.name.c_str());
    const ImGuiStyle& style = ImGui::GetStyle();
    const float remove = ImGui::CalcTextSize("remove").x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - (bookmark.shipped ? 0 : remove);
    if (ImGui::Selectable(bookmark.name.c_str(), false, 0, {width, 0}))
        commands.push_back(MoveCamera{bookmark.pose});
    noteItem(bookmark.name);
    tooltip(fmt::format("{}\n{} high, heading {:.0f} deg, pitch {:.0f} deg{}",
                        placeText(bookmark.pose.latitudeDeg, bookmark.pose.longitudeDeg),
                        distanceText(bookmark.pose.altitudeM), bookmark.pose.headingDeg,
                        bookmark.pose.pitchDeg, bookmark.shipped ? "\nComes with Worldy." : "")
                .c_str());
    if (!bookmark.shipped) {
        ImGui::SameLine();
        if (ImGui::SmallButton("remove")) commands.push_back(RemoveBookmark{bookmark.name});
        tooltip("Forgets this bookmark.");
    }
    ImGui::PopID();
}

void addBookmarkControl(CameraPanelState& state, Commands& commands) {
    const float room =
        ImGui::CalcTextSize("Add").x + 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - room);
    const bool entered =
        ImGui::InputTextWithHint("##name", "name of this view", state.bookmarkName.data(),
                                 state.bookmarkName.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    noteItem("Name");
    tooltip("Up to 60 letters. The name of one of your own replaces it.");
    ImGui::SameLine();
    ImGui::BeginDisabled(state.bookmarkName[0] == 0);
    const bool pressed = button("Add", "Keeps the camera as it is under this name.");
    ImGui::EndDisabled();
    if ((!entered && !pressed) || state.bookmarkName[0] == 0) return;
    commands.push_back(AddBookmark{state.bookmarkName.data()});
    state.bookmarkName.fill(0);
}

void bookmarksSection(const EditorView& view, CameraPanelState& state, Commands& commands) {
    if (!section("Bookmarks")) return;
    for (const Bookmark& bookmark : view.camera.bookmarks) bookmarkRow(bookmark, commands);
    addBookmarkControl(state, commands);
}

void followedFlight(const FlightView& flight, Commands& commands) {
    double timeS = flight.timeS;
    constexpr double start = 0;
    const std::string format = fmt::format("%.1f s of {:.0f} s", flight.durationS);
    if (ImGui::Button(flight.paused ? "Play" : "Pause")) commands.push_back(PauseFlight{!flight.paused});
    tooltip("Holds the flight, or lets it go on. It begins anew at its end.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &timeS, &start, &flight.durationS, format.c_str(),
                            ImGuiSliderFlags_AlwaysClamp))
        commands.push_back(MoveFlight{timeS});
    tooltip("Time since the flight's start, seconds. Drag it to look at any moment again.");
}

void flightsSection(const EditorView& view, const ViewSettings& settings, Commands& commands) {
    if (!section("Flights")) return;
    if (view.camera.flights.empty())
        ImGui::TextColored(palette().dim, "There are none: TOML files in a folder \"flights\".");
    for (const std::filesystem::path& file : view.camera.flights) {
        const bool followed = view.camera.flight && settings.camera.flight == file.string();
        if (ImGui::Selectable(flightName(file).c_str(), followed)) commands.push_back(StartFlight{file});
        noteItem(flightName(file));
        tooltip(fmt::format("Follows it from its beginning.\n{}", file.string()).c_str());
    }
    if (view.camera.flight) followedFlight(*view.camera.flight, commands);
}

void observerSection(CameraSettings& camera) {
    if (!section("Observer")) return;
    choice("Picture", camera.observer, defaultCamera.observer, "off\0split\0alone\0",
           "A second camera that looks at the first one's view from outside: what was chosen for that view, "
           "and what was culled. Split: both side by side. Draws the planet twice.");
    ImGui::BeginDisabled(camera.observer == ObserverMode::Off);
    checkbox("Frustum", camera.showFrustum, defaultCamera.showFrustum,
             "The four edges of the first camera's view, to the farthest ground it can see.");
    secondColumn();
    checkbox("Horizon", camera.showHorizon, defaultCamera.showHorizon,
             "The circle beyond which the planet hides itself from the first camera.");
    checkbox("d_m of selected", camera.showSwitchDistances, defaultCamera.showSwitchDistances,
             "How far d_m = delta_c K reaches about the selected chunk, K = W / (2 tau tan(fov / 2)): an eye "
             "inside must see it replaced by its children. Nothing for a leaf.");
    secondColumn();
    checkbox("Own LOD", camera.observerOwnLod, defaultCamera.observerOwnLod,
             "The observer draws what it would choose itself, as a second view with requests of its own, "
             "instead of what was chosen for the first. Loads more.");
    ImGui::EndDisabled();
}

}  // namespace

void cameraPanel(const EditorView& view, CameraPanelState& state, ViewSettings& settings,
                 Commands& commands) {
    if (!view.planet) return emptyState("No planet is open.");
    motionSection(view, settings, commands);
    poseSection(view, state, commands);
    bookmarksSection(view, state, commands);
    flightsSection(view, settings, commands);
    observerSection(settings.camera);
}

}  // namespace ui
