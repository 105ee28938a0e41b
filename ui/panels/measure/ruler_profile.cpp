#include "ui/panels/measure/ruler_profile.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <vector>

#include "app/base/text.h"
#include "ui/kit/exports.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/figures.h"

namespace worldy::ui {

namespace {

struct ProfileArea {
    ImVec2 start;
    ImVec2 end;
    double longestM = 1;
    double lowestM = 0;
    double highestM = 1;

    ImVec2 at(double alongM, double heightM) const {
        const double x = alongM / longestM;
        const double y = (heightM - lowestM) / (highestM - lowestM);
        return {start.x + static_cast<float>(x) * (end.x - start.x),
                end.y - static_cast<float>(y) * (end.y - start.y)};
    }
};

// Heights of both surfaces, with a margin of a twentieth.
ProfileArea areaOver(const planet::GroundProfile& profile, const planet::ProfileSummary& summary,
                     ImVec2 start, ImVec2 end) {
    double lowestM = summary.lowestM;
    double highestM = summary.highestM;
    for (const planet::ProfilePoint& point : profile.points) {
        lowestM = std::min(lowestM, point.drawnM.value_or(lowestM));
        highestM = std::max(highestM, point.drawnM.value_or(highestM));
    }
    const double marginM = std::max((highestM - lowestM) / 20, 0.01);
    return {start, end, std::max(summary.arcM, 1e-6), lowestM - marginM, highestM + marginM};
}

void drawSurface(const ProfileArea& area, const planet::GroundProfile& profile, const ImVec4& colour,
                 float thickness, const auto& heightOf) {
    std::vector<ImVec2> way;
    const auto drawWay = [&] {
        ImGui::GetWindowDrawList()->AddPolyline(way.data(), static_cast<int>(way.size()), packed(colour),
                                                ImDrawFlags_None, thickness);
        way.clear();
    };
    for (const planet::ProfilePoint& point : profile.points) {
        if (const std::optional<double> heightM = heightOf(point))
            way.push_back(area.at(point.alongM, *heightM));
        else
            drawWay();
    }
    drawWay();
}

void drawAxisTexts(const ProfileArea& area, const planet::ProfileSummary& summary) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 dim = packed(palette().dim);
    const float gap = ImGui::GetFontSize() * 0.3f;
    list.AddText({area.start.x + gap, area.start.y}, dim, heightText(area.highestM).c_str());
    list.AddText({area.start.x + gap, area.end.y - ImGui::GetTextLineHeight()}, dim,
                 heightText(area.lowestM).c_str());
    const std::string length = distanceText(summary.arcM);
    list.AddText(
        {area.end.x - ImGui::CalcTextSize(length.c_str()).x - gap, area.end.y - ImGui::GetTextLineHeight()},
        dim, length.c_str());
}

std::size_t pointUnderPointer(const ProfileArea& area, const planet::GroundProfile& profile) {
    const float share = (ImGui::GetIO().MousePos.x - area.start.x) / (area.end.x - area.start.x);
    const auto last = static_cast<float>(profile.points.size() - 1);
    return static_cast<std::size_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * last));
}

void tellPoint(const ProfileArea& area, const planet::ProfilePoint& point, const PlotCursor& cursor) {
    const float x = area.at(point.alongM, 0).x;
    ImGui::GetWindowDrawList()->AddLine({x, area.start.y}, {x, area.end.y}, packed(palette().dim));
    const planet::Geographic place = planet::geographicFromDirection(point.direction);
    std::string drawn = "not drawn";
    if (point.drawnM) {
        const double aboveM = *point.drawnM - point.finestM;
        drawn = fmt::format("{}, {} too {}", heightText(*point.drawnM), heightText(std::abs(aboveM)),
                            aboveM > 0 ? "high" : "low");
    }
    beginSampleTooltip(cursor, x);
    ImGui::TextUnformatted(
        fmt::format("{} from A\n{}\nfinest data {}\ndrawn surface {}", distanceText(point.alongM),
                    placeText(glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad)),
                    heightText(point.finestM), drawn)
            .c_str());
    ImGui::EndTooltip();
}

ExportTable profileTable(const planet::GroundProfile& profile) {
    using Point = planet::ProfilePoint;
    const auto placeOf = [](const Point& point) { return planet::geographicFromDirection(point.direction); };
    return exportTable<Point>(
        "height profile", profile.points.size(),
        [&](std::size_t row) -> const Point& { return profile.points[row]; },
        {{"along_m", [](const Point& point) { return point.alongM; }},
         {"latitude_deg", [=](const Point& point) { return glm::degrees(placeOf(point).latitudeRad); }},
         {"longitude_deg", [=](const Point& point) { return glm::degrees(placeOf(point).longitudeRad); }},
         {"finest_m", [](const Point& point) { return point.finestM; }},
         {"drawn_m", [](const Point& point) { return point.drawnM; }}});
}

}  // namespace

std::optional<std::size_t> rulerProfile(const planet::GroundProfile& profile,
                                        const planet::ProfileSummary& summary, float lines) {
    const std::vector<std::pair<const char*, ImVec4>> names = {{"finest data", seriesColour(0)},
                                                               {"drawn surface", seriesColour(1)}};
    for (const auto& [name, colour] : names) {
        if (name != names.front().first) sameLineIfRoom(ImGui::CalcTextSize(name).x);
        ImGui::TextColored(colour, "%s", name);
    }
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize()),
                      std::round(lines * ImGui::GetTextLineHeightWithSpacing()));
    plotItem("profile", size);
    noteItem("Profile");
    const ImVec2 end(start.x + size.x, start.y + size.y);
    ImGui::GetWindowDrawList()->AddRectFilled(start, end, ImGui::GetColorU32(ImGuiCol_FrameBg),
                                              ImGui::GetStyle().FrameRounding);
    const ProfileArea area = areaOver(profile, summary, start, end);
    ImGui::PushClipRect(start, end, true);
    const float thin = std::max(ImGui::GetFontSize() / 10, 1.0f);
    drawSurface(area, profile, names[0].second, 2 * thin,
                [](const planet::ProfilePoint& point) { return std::optional(point.finestM); });
    drawSurface(area, profile, names[1].second, thin,
                [](const planet::ProfilePoint& point) { return point.drawnM; });
    drawAxisTexts(area, summary);
    ImGui::PopClipRect();
    const PlotCursor cursor = plotCursor(profile.points.size());
    std::optional<std::size_t> told = cursor.at;
    if (!told && plotIsHovered()) told = pointUnderPointer(area, profile);
    if (told) tellPoint(area, profile.points[*told], cursor);
    exportPlot("profile", profileTable(profile));
    return told;
}

}  // namespace worldy::ui
