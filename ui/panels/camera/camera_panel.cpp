#include "ui/panels/camera/camera_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/camera_heights.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

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
    {"Latitude", &Pose::latitudeDeg, -90, 90, "%.5f°", "Latitude in degrees, north positive."},
    {"Longitude", &Pose::longitudeDeg, -360, 360, "%.5f°", "Longitude in degrees, east positive."},
    {"Altitude", &Pose::altitudeM, -1e8, 2e10, "%.1f m",
     "Height in metres above the planet's radius (not above the ground). The camera cannot go below the "
     "ground."},
    {"Heading", &Pose::headingDeg, -360, 360, "%.2f°", "Degrees clockwise from north."},
    {"Pitch", &Pose::pitchDeg, -90, 90, "%.2f°", "Degrees above the horizontal; -90 looks straight down."},
}};

void modeControl(const EditorView& view, const SettingControls& control, ViewSettings& settings,
                 Commands& commands) {
    const CameraMode before = settings.camera.mode;
    if (!control(settings.camera.mode)) return;
    // Without a flight to follow, the mode changes only when one is started.
    if (settings.camera.mode != CameraMode::FollowFlight || !settings.camera.flight.empty()) return;
    settings.camera.mode = before;
    if (!view.camera.flights.empty()) commands.push_back(StartFlight{view.camera.flights.front()});
}

void motionSection(const EditorView& view, const SettingControls& control, ViewSettings& settings,
                   Commands& commands) {
    modeControl(view, control, settings, commands);
    control(settings.camera.fovDeg);
    double factor = view.camera.speedFactor;
    if (slider("Speed", factor, 1.0, 1.0 / 64, 64.0, "%.2f x",
               "Speed of the movement keys and of devices; + and -, and the wheel while a button is held, "
               "change it. "
               "At 1 x the camera moves 0.6 of its height above ground per second.",
               ImGuiSliderFlags_Logarithmic))
        commands.push_back(SetSpeedFactor{factor});
}

// Draws the control of one number of the pose. While it is being typed, the camera's motion does not change
// it.
bool poseControl(int index, Pose& pose, CameraPanelState& state) {
    const PoseField& field = poseFields[static_cast<std::size_t>(index)];
    ImGui::PushID(index);
    labelledControl(field.label, field.explanation);
    double value = state.typedField == index ? state.typedValue : pose.*field.value;
    numberField("##value", value, field.format);
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

void poseSection(const EditorView& view, const ViewSettings& settings, CameraPanelState& state,
                 Commands& commands) {
    if (!section("Place")) return;
    Pose pose = view.camera.pose;
    for (int i = 0; i < static_cast<int>(poseFields.size()); ++i) {
        if (poseControl(i, pose, state)) commands.push_back(MoveCamera{pose});
    }
    if (beginValues("height")) {
        for (NamedHeight& height : namedHeights(cameraHeights(view, settings))) {
            height.name[0] = 'A';
            valueRow(height.name.c_str(), distanceText(height.heightM), height.explanation);
        }
        endValues();
    }
    if (button("Reset", withKey("Moves the camera to where this session started.", "reset_camera").c_str()))
        commands.push_back(ResetCamera{});
    sameLineForButton("Set as start");
    if (button("Set as start", "Future sessions start with this view."))
        commands.push_back(KeepCameraAsStart{});
}

void bookmarkRow(const Bookmark& bookmark, Commands& commands) {
    ImGui::PushID(bookmark.name.c_str());
    const ImGuiStyle& style = ImGui::GetStyle();
    const float remove = ImGui::CalcTextSize("remove").x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - (bookmark.shipped ? 0 : remove);
    if (ImGui::Selectable(bookmark.name.c_str(), false, 0, {width, 0}))
        commands.push_back(MoveCamera{bookmark.pose, true});
    noteItem(bookmark.name);
    tooltip(fmt::format("{}\naltitude {}, heading {:.0f}°, pitch {:.0f}°{}",
                        placeText(bookmark.pose.latitudeDeg, bookmark.pose.longitudeDeg),
                        distanceText(bookmark.pose.altitudeM), bookmark.pose.headingDeg,
                        bookmark.pose.pitchDeg, bookmark.shipped ? "\nBuilt-in." : "")
                .c_str());
    if (!bookmark.shipped) {
        ImGui::SameLine();
        if (ImGui::SmallButton("remove")) commands.push_back(RemoveBookmark{bookmark.name});
        tooltip("Deletes this bookmark.");
    }
    ImGui::PopID();
}

void addBookmarkControl(CameraPanelState& state, Commands& commands) {
    const float room =
        ImGui::CalcTextSize("Add").x + 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - room);
    const bool entered =
        ImGui::InputTextWithHint("##name", "Bookmark name", state.bookmarkName.data(),
                                 state.bookmarkName.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    noteItem("Name");
    tooltip("Up to 60 bytes. A bookmark of your own with the same name is replaced.");
    ImGui::SameLine();
    beginGrey(state.bookmarkName[0] == 0, "Type a name first.");
    const bool pressed = button("Add", "Saves the current camera under this name.");
    endGrey();
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
    tooltip("Pauses or resumes the flight. At its end it starts again.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &timeS, &start, &flight.durationS, format.c_str(),
                            ImGuiSliderFlags_AlwaysClamp))
        commands.push_back(MoveFlight{timeS});
    tooltip("Time since the start of the flight, in seconds. Drag to seek.");
}

void flightsSection(const EditorView& view, const ViewSettings& settings, Commands& commands) {
    if (!section("Flights")) return;
    if (view.camera.flights.empty())
        wrappedText("No flights found. Flights are TOML files in a folder \"flights\".", palette().dim);
    for (const std::filesystem::path& file : view.camera.flights) {
        const bool followed = view.camera.flight && settings.camera.flight == file.string();
        if (ImGui::Selectable(flightName(file).c_str(), followed)) commands.push_back(StartFlight{file});
        noteItem(flightName(file));
        tooltip(fmt::format("Follows this flight from the start.\n{}", file.string()).c_str());
    }
    if (view.camera.flight) followedFlight(*view.camera.flight, commands);
}

std::string deviceText(const SteeringState& device) {
    switch (device.kind) {
        case SteeringKind::Gamepad:
            return isUsed(device) ? "gamepad, in use" : "gamepad";
        case SteeringKind::SpaceMouse:
            return isUsed(device) ? "3-D mouse, in use" : "3-D mouse";
        case SteeringKind::Other:
            break;
    }
    return "not supported";
}

void deviceRows(std::span<const SteeringState> devices) {
    if (!beginValues("devices")) return;
    for (const SteeringState& device : devices) {
        const bool steers = device.kind != SteeringKind::Other;
        valueRow(
            device.name.empty() ? "Unnamed device" : device.name.c_str(), deviceText(device),
            steers
                ? "It steers the camera while this window has the focus. The list of keys says what its "
                  "sticks and buttons do."
                : "This joystick is neither a 3-D mouse nor a gamepad with a layout that GLFW knows, so it "
                  "is ignored.",
            isUsed(device) ? &palette().accent : nullptr);
    }
    endValues();
}

// Draws the control of a preference. Returns true if the value has changed.
template <class Kind, class Value>
bool preferenceControl(const char* name, Value& value) {
    Field field = defaultField(name);
    std::get<Kind>(field.value).value = &value;
    return settingControl(field);
}

void steeringSection(const SteeringView& steering, Commands& commands) {
    if (!section("Steering")) return;
    if (steering.devices.empty())
        wrappedText("No gamepad and no 3-D mouse is connected. Keyboard and mouse steer.", palette().dim);
    else
        deviceRows(steering.devices);
    const bool steers = std::ranges::any_of(
        steering.devices, [](SteeringKind kind) { return kind != SteeringKind::Other; },
        &SteeringState::kind);
    beginGrey(!steers, "Connect a gamepad or a 3-D mouse. Worldy finds it while it runs.");
    double sensitivity = steering.sensitivity;
    bool inverted = steering.inverted;
    const bool changed = preferenceControl<Number>("window.steering", sensitivity);
    if (preferenceControl<Flag>("window.invert_steering", inverted) || changed)
        commands.push_back(SetSteering{sensitivity, inverted});
    endGrey();
}

void observerSection(const SettingControls& control, CameraSettings& camera) {
    if (!section("Observer")) return;
    control(camera.observer);
    beginGrey(camera.observer == ObserverMode::Off, "The observer is off: choose a view above.");
    control(camera.showFrustum);
    control.beside(camera.showHorizon);
    control(camera.showSwitchDistances);
    control.beside(camera.observerOwnLod);
    endGrey();
}

}  // namespace

void cameraPanel(const EditorView& view, CameraPanelState& state, ViewSettings& settings,
                 Commands& commands) {
    if (!view.planet) return emptyState("No planet is open.");
    const SettingControls control(settings);
    motionSection(view, control, settings, commands);
    poseSection(view, settings, state, commands);
    bookmarksSection(view, state, commands);
    flightsSection(view, settings, commands);
    steeringSection(view.camera.steering, commands);
    observerSection(control, settings.camera);
}

}  // namespace worldy::ui
