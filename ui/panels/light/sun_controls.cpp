#include "ui/panels/light/sun_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "app/base/text.h"
#include "app/settings/sun_overhead.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

// Draws an equirectangular map of the world with the subsolar point and the camera. Dragging moves the sun.
// Returns true while it does.
bool sunMap(const EditorView& view, SurfaceSettings& surface) {
    const float width = std::min(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 18);
    const ImVec2 size(width, std::round(width / 2));
    const ImVec2 start = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("sunMap", size);
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    drawList.AddRectFilled(start, {start.x + size.x, start.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    const auto at = [&](double latitudeDeg, double longitudeDeg) {
        const double longitude = std::remainder(longitudeDeg, 360.0);
        return ImVec2(start.x + static_cast<float>((longitude + 180) / 360) * size.x,
                      start.y + static_cast<float>((90 - latitudeDeg) / 180) * size.y);
    };
    const ImU32 grid = ImGui::GetColorU32(ImGuiCol_Border);
    for (int degrees = -150; degrees <= 150; degrees += 30)
        drawList.AddLine(at(90, degrees), at(-90, degrees), grid, degrees == 0 ? 2.0f : 1.0f);
    for (int degrees = -60; degrees <= 60; degrees += 30) {
        const float y = at(degrees, 0).y;
        drawList.AddLine({start.x, y}, {start.x + size.x, y}, grid, degrees == 0 ? 2.0f : 1.0f);
    }
    const float dot = ImGui::GetFontSize() * 0.32f;
    const planet::CameraPose& camera = view.camera.pose;
    drawList.AddCircle(at(camera.latitudeDeg, camera.longitudeDeg), dot, ImGui::GetColorU32(palette().accent),
                       0, 2);
    if (!surface.sunFollows) {
        const planet::Geographic sun = sunOverheadOf(surface);
        drawList.AddCircleFilled(at(glm::degrees(sun.latitudeRad), glm::degrees(sun.longitudeRad)), dot,
                                 ImGui::GetColorU32(palette().warning));
    }
    tooltip("Drag to move the subsolar point. The ring is the camera. West is left.");
    if (!ImGui::IsItemActive()) return false;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const auto shareX = static_cast<double>(std::clamp((mouse.x - start.x) / size.x, 0.0f, 1.0f));
    const auto shareY = static_cast<double>(std::clamp((mouse.y - start.y) / size.y, 0.0f, 1.0f));
    surface.sunLongitudeDeg = std::round(shareX * 360 - 180);
    surface.sunLatitudeDeg = std::round(90 - shareY * 180);
    return true;
}

enum class SunChoice : std::uint8_t { Follows, ByDate, Placed };

SunChoice sunChoiceOf(const SurfaceSettings& surface) {
    if (surface.sunFollows) return SunChoice::Follows;
    return surface.sunByDate ? SunChoice::ByDate : SunChoice::Placed;
}

void chooseSun(SurfaceSettings& surface) {
    SunChoice sun = sunChoiceOf(surface);
    if (!choice("Sun", sun, SunChoice::Follows, "follow\0by date\0fixed\0",
                "Follow: the sun stays east of the camera, so it is always day there. By date: the "
                "sun's position over the Earth at a given time. Fixed: the position set below."))
        return;
    surface.sunFollows = sun == SunChoice::Follows;
    surface.sunByDate = sun == SunChoice::ByDate;
}

// Returns the sun's elevation above the horizon at the ground below the camera, degrees.
double sunHeightDeg(const EditorView& view, const SurfaceSettings& surface) {
    const planet::CameraPose& camera = view.camera.pose;
    const glm::dvec3 up = planet::directionFromGeographic(
        {glm::radians(camera.latitudeDeg), glm::radians(std::remainder(camera.longitudeDeg, 360.0))});
    const double sine = glm::dot(up, planet::directionFromGeographic(sunOverheadOf(surface)));
    return glm::degrees(std::asin(std::clamp(sine, -1.0, 1.0)));
}

void dateControls(const SettingControls& control, planet::SunDate& date) {
    constexpr std::array monthNames = {"%d: January",   "%d: February", "%d: March",    "%d: April",
                                       "%d: May",       "%d: June",     "%d: July",     "%d: August",
                                       "%d: September", "%d: October",  "%d: November", "%d: December"};
    control(date.year);
    control(date.month, {.format = monthNames[static_cast<std::size_t>(std::clamp(date.month, 1, 12) - 1)]});
    const int days = planet::daysInMonth(date.year, date.month);
    control(date.day, {.range = NumberRange{1, static_cast<double>(days), ""}});
    date.day = std::min(date.day, days);
    control(date.hour, {.format = clockText(date.hour)});
}

}  // namespace

void sunControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface) {
    chooseSun(surface);
    if (!surface.sunFollows && surface.sunByDate) dateControls(control, surface.sunDate);
    if (!surface.sunFollows && !surface.sunByDate) {
        control(surface.sunLatitudeDeg);
        control(surface.sunLongitudeDeg);
    }
    if (sunMap(view, surface)) surface.sunFollows = surface.sunByDate = false;
    if (surface.sunFollows || !beginValues("sun")) return;
    const planet::Geographic sun = sunOverheadOf(surface);
    valueRow("Subsolar point", placeText(glm::degrees(sun.latitudeRad), glm::degrees(sun.longitudeRad), 1),
             "The place where the sun is in the zenith.");
    valueRow("Sun elevation", fmt::format("{:.1f}°", sunHeightDeg(view, surface)),
             "Angle of the sun's centre above the horizon of a sphere, at the place under the camera. "
             "Negative: night.");
    endValues();
}

}  // namespace worldy::ui
