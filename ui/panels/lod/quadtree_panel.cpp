#include "ui/panels/lod/quadtree_panel.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/base/glossary.h"
#include "app/base/text.h"
#include "app/scene/overlay_colours.h"
#include "ui/kit/item_map.h"
#include "ui/kit/legend_rows.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/explanation_text.h"
#include "ui/model/font_symbols.h"
#include "ui/model/overlay_legend.h"

namespace worldy::ui {

namespace {

NetColouring colouringOf(const QuadtreePanelState& state, const OverlaySettings& overlay) {
    const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    return {.by = static_cast<NetColour>(state.colourBy),
            .errorScale = overlay.errorScale,
            .deltaTopM = overlay.deltaTopM,
            .ageTopS = overlay.ageTopS,
            .ground = {ground.x, ground.y, ground.z}};
}

Legend stateLegend() {
    Legend legend;
    for (const planet::ChunkState state :
         {planet::ChunkState::Drawn, planet::ChunkState::Split, planet::ChunkState::CulledFrustum,
          planet::ChunkState::CulledHorizon, planet::ChunkState::Resident, planet::ChunkState::Requested,
          planet::ChunkState::Loading, planet::ChunkState::NotResident, planet::ChunkState::Failed}) {
        legend.entries.push_back({stateColour(state), stateText(state)});
    }
    return legend;
}

Legend legendOfNet(const EditorView& view, const QuadtreePanelState& state, const OverlaySettings& overlay) {
    if (state.colourBy == 0) return stateLegend();
    constexpr std::array same = {ColourBy::None, ColourBy::Level,  ColourBy::Error,  ColourBy::DeltaC,
                                 ColourBy::Age,  ColourBy::DeltaC, ColourBy::Region, ColourBy::Atlas};
    OverlaySettings asked = overlay;
    asked.colourBy = same[static_cast<std::size_t>(state.colourBy)];
    Legend legend = legendOf(asked, view.planet->views()[0].input.lod.tauPx,
                             static_cast<std::uint32_t>(deepestLevelOf(view.planet->tree().shape)),
                             {.regions = legendRegions(*view.planet), .atlas = view.instruments.atlas.drape});
    if (state.colourBy == static_cast<int>(NetColour::Tight)) legend.title = "tight";  // uses delta_c's scale
    return legend;
}

void quadtreeControls(const EditorView& view, QuadtreePanelState& state) {
    choiceIndex("Colour by", state.colourBy, 0,
                (std::string("state") + '\0' + "level" + '\0' + epsSymbol() + " / " + tauSymbol() + '\0' +
                 "δc" + '\0' + "age" + '\0' + "tight" + '\0' + "region" + '\0' + "atlas" + '\0')
                    .c_str(),
                "Quantity shown by the colours: selection state, level, screen-space error relative to the "
                "tolerance, geometric error δc, time since loading, the tight metric on the scale of δc, "
                "the region that decides, or the measure shown in the Atlas panel. Except "
                "for the state, chunks that are not drawn are dimmed. The Overlay panel sets the scales.");
    if (button("Fit", "Shows the whole net. Double-clicking beside the faces does the same."))
        state.focus = {};
    ImGui::SameLine();
    beginGrey(!view.focus.selected, "Select a chunk first.");
    const bool toSelection = button("Selected", "Centres and enlarges the selected chunk in the net.");
    endGrey();
    if (toSelection) state.focus = centredOn(state.focus, state.area, *view.focus.selected, 40);
    ImGui::SameLine();
    checkbox("List", state.showTree, true, "Shows the chunks as a tree beside the net.");
}

// Draws the rectangles in batches that 16-bit indices can address.
void drawRects(ImDrawList& drawList, const std::vector<NetRect>& rects) {
    constexpr std::size_t piece = 8192;
    for (std::size_t start = 0; start < rects.size(); start += piece) {
        const std::size_t count = std::min(piece, rects.size() - start);
        drawList.PrimReserve(static_cast<int>(6 * count), static_cast<int>(4 * count));
        for (std::size_t i = start; i < start + count; ++i) {
            const NetRect& rect = rects[i];
            drawList.PrimRect({rect.x0, rect.y0}, {rect.x1, rect.y1}, rect.colour);
        }
    }
}

ImVec2 pixel(const NetPlacement& placement, const NetPoint& point) {
    const NetPoint at = onScreen(placement, point);
    // Far outside the window a float cannot resolve a pixel, and nothing is visible there.
    return {static_cast<float>(std::clamp(at.x, -1e5, 1e5)), static_cast<float>(std::clamp(at.y, -1e5, 1e5))};
}

void drawNetLine(ImDrawList& drawList, const NetPlacement& placement,
                 const std::vector<glm::dvec3>& directions, ImU32 colour, float width) {
    for (const NetSegment& segment : netLine(directions)) {
        drawList.AddLine(pixel(placement, segment.from), pixel(placement, segment.to), colour, width);
    }
}

// Draws the outlines of the source's layers.
void drawSources(ImDrawList& drawList, const NetPlacement& placement, const planet::SourceLayers& source) {
    const float width = 1.4f * ImGui::GetFontSize() / 13;
    for (std::size_t i = 0; i < source.layers.size(); ++i) {
        for (const planet::Outline& outline : source.layers[i].outlines) {
            std::vector<glm::dvec3> directions;
            for (const planet::Geographic& place : outline)
                directions.push_back(planet::directionFromGeographic(place));
            drawNetLine(drawList, placement, directions, IM_COL32(0, 0, 0, 150), 2.2f * width);
            drawNetLine(drawList, placement, directions, packed(layerColour(i)), width);
        }
    }
}

void drawRegions(ImDrawList& drawList, const NetPlacement& placement, const RegionOutlines& outlines) {
    const float width = 1.4f * ImGui::GetFontSize() / 13;
    for (std::size_t i = 0; i < outlines.lines.size(); ++i) {
        for (const std::vector<glm::dvec3>& line : outlines.lines[i]) {
            drawNetLine(drawList, placement, line, IM_COL32(0, 0, 0, 150), 2.2f * width);
            drawNetLine(drawList, placement, line, packed(regionColour(i)), width);
        }
    }
}

// Draws a camera's position, an arrow in its viewing direction, and the outline of what it sees.
void drawCamera(ImDrawList& drawList, const NetPlacement& placement, const planet::View& view, double radiusM,
                const ImVec4& colour) {
    const float unit = ImGui::GetFontSize() / 13;
    const std::vector<glm::dvec3> footprint = footprintOf(view, radiusM);
    drawNetLine(drawList, placement, footprint, IM_COL32(0, 0, 0, 150), 3.2f * unit);
    drawNetLine(drawList, placement, footprint, packed(colour), 1.4f * unit);
    const glm::dvec3 up = glm::normalize(view.eyeM);
    glm::dvec3 look = -view.back - glm::dot(-view.back, up) * up;
    if (glm::length(look) < 0.1) look = view.up - glm::dot(view.up, up) * up;
    const NetPoint place = netPointOfDirection(up);
    // The point ahead is very near, so that the arrow stays on the face below the camera.
    const NetPoint ahead = netPointOfDirection(up + 1e-4 * glm::normalize(look));
    glm::dvec2 along(ahead.x - place.x, ahead.y - place.y);
    const ImVec2 at = pixel(placement, place);
    const double length = glm::length(along);
    if (length > 0 && length < 1e-2) {
        along /= length;
        const ImVec2 way(static_cast<float>(along.x) * unit, static_cast<float>(along.y) * unit);
        const ImVec2 tip(at.x + 13 * way.x, at.y + 13 * way.y);
        const ImVec2 left(at.x + 4 * way.x + 4.5f * way.y, at.y + 4 * way.y - 4.5f * way.x);
        const ImVec2 right(at.x + 4 * way.x - 4.5f * way.y, at.y + 4 * way.y + 4.5f * way.x);
        drawList.AddTriangleFilled(tip, left, right, packed(colour));
        drawList.AddTriangle(tip, left, right, IM_COL32(0, 0, 0, 200), unit);
    }
    drawList.AddCircleFilled(at, 4.5f * unit, packed(colour));
    drawList.AddCircle(at, 4.5f * unit, IM_COL32(0, 0, 0, 200), 0, unit);
}

// Draws a coloured outline between black ones, visible on any square. A chunk of a few pixels gets a larger
// box.
void outlineChunk(ImDrawList& drawList, const NetPlacement& placement, const planet::ChunkId& id,
                  const ImVec4& colour, float width) {
    const NetSquare square = netSquare(id);
    const ImVec2 low = pixel(placement, {square.x, square.y});
    const ImVec2 high = pixel(placement, {square.x + square.side, square.y + square.side});
    const float grow = std::max(0.0f, (ImGui::GetFontSize() * 0.45f - (high.x - low.x)) / 2);
    const ImVec2 from(std::round(low.x - grow), std::round(low.y - grow));
    const ImVec2 to(std::round(high.x + grow), std::round(high.y + grow));
    drawList.AddRect(from, to, IM_COL32(0, 0, 0, 220), 0, 0, width + 2);
    drawList.AddRect(from, to, packed(colour), 0, 0, width);
}

void faceNames(ImDrawList& drawList, const NetPlacement& placement) {
    for (const planet::Face face : planet::allFaces) {
        const std::string name(planet::faceName(face));
        const ImVec2 corner = pixel(placement, netPoint({face, -1, 1}));
        const ImVec2 end = pixel(placement, netPoint({face, 1, -1}));
        drawList.AddRect(corner, end, packed(palette().dim, 0.6f));
        const ImVec2 size = ImGui::CalcTextSize(name.c_str());
        if (end.x - corner.x < size.x * 1.3f) continue;
        const float pad = ImGui::GetFontSize() * 0.25f;
        const ImVec2 at(corner.x + pad, corner.y + pad);
        drawList.AddText({at.x + 1, at.y + 1}, IM_COL32(0, 0, 0, 200), name.c_str());
        drawList.AddText(at, IM_COL32(255, 255, 255, 230), name.c_str());
    }
}

std::string hitText(const NetData& data, const NetHit& hit) {
    std::string text = fmt::format("{}\nlevel {}, {}", toString(hit.id), hit.id.level, stateText(hit.state));
    if (hit.node == planet::noNode) return text;
    const planet::ChunkNode& node = data.tree.nodes[hit.node];
    return text + fmt::format("\n{} {}, {} {}, tight {}", epsSymbol(), pixelsText(epsPxOf(data, node)),
                              inFont("δc"), distanceText(static_cast<double>(node.deltaCM)),
                              distanceText(static_cast<double>(node.deltaTightM)));
}

// Handles wheel, drag, clicks and hovering.
void netMouse(const NetData& data, const Rect& area, QuadtreePanelState& state, Commands& commands) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto x = static_cast<double>(io.MousePos.x);
    const auto y = static_cast<double>(io.MousePos.y);
    if (ImGui::IsItemActivated()) state.dragging = false;
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) state.dragging = true;
    if (ImGui::IsItemActive() && state.dragging) {
        const ImVec2 moved = dragDelta(ImGuiMouseButton_Left);
        state.focus =
            movedBy(netSize, state.focus, area, static_cast<double>(moved.x), static_cast<double>(moved.y));
    }
    if (!plotIsHovered()) return;
    ImGui::SetItemUsingMouseWheel();
    if (io.MouseWheel != 0)
        state.focus =
            zoomedAbout(netSize, state.focus, area, x, y, std::pow(1.35, static_cast<double>(io.MouseWheel)));
    const auto hit = netHit(data, placementOf(netSize, state.focus, area), x, y);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        if (hit)
            commands.emplace_back(LookAtChunk{hit->id});
        else
            state.focus = {};
    }
    if (!hit || state.dragging) return;
    commands.emplace_back(HoverChunk{hit->id});
    tooltip(hitText(data, *hit).c_str());
    if (ImGui::IsItemDeactivated()) commands.emplace_back(SelectChunk{hit->id});
}

// Moves the view by the keys.
void panNet(const PlotKeys& keys, const Rect& area, PlanFocus& focus) {
    const double stepPx = 0.15 * static_cast<double>(std::min(area.width, area.height));
    focus = movedBy(netSize, focus, area, -keys.right * stepPx, keys.up * stepPx);
}

// Moves the selection by the keys, and keeps it in sight; with Shift, moves the view.
void netKeys(const EditorView& view, const NetData& data, const Rect& area, QuadtreePanelState& state,
             Commands& commands) {
    const PlotKeys keys = takePlotKeys(PlotReads::View);
    if (keys.withShift && (keys.right != 0 || keys.up != 0)) return panNet(keys, area, state.focus);
    const std::optional<planet::ChunkId>& selected = view.focus.selected;
    const planet::FacePoint below = planet::facePointFromDirection(glm::normalize(data.eyeM));
    if (const auto to = steppedChunk(selected, keys, below, deepestLevelOf(data.tree.shape))) {
        commands.emplace_back(SelectChunk{to});
        const NetSquare square = netSquare(*to);
        const NetPoint low = onScreen(placementOf(netSize, state.focus, area), {square.x, square.y});
        const double sidePx = square.side * placementOf(netSize, state.focus, area).scalePx;
        const bool isInSight = low.x >= area.x && low.y >= area.y && low.x + sidePx <= area.x + area.width &&
                               low.y + sidePx <= area.y + area.height;
        constexpr double leastSidePx = 12;
        if (sidePx < leastSidePx || (!isInSight && sidePx < area.height))
            state.focus = centredOn(state.focus, area, *to, leastSidePx);
    }
    if (keys.acts && selected) commands.emplace_back(LookAtChunk{*selected});
    if (keys.toFirst) state.focus = {};
    if (keys.zoomIn == 0) return;
    NetPoint about{area.x + area.width / 2, area.y + area.height / 2};
    if (selected) {
        const NetSquare square = netSquare(*selected);
        about = onScreen(placementOf(netSize, state.focus, area),
                         {square.x + square.side / 2, square.y + square.side / 2});
    }
    state.focus = zoomedAbout(netSize, state.focus, area, about.x, about.y, std::pow(1.35, keys.zoomIn));
}

// Tells the selected chunk while the keyboard is used in the net.
void tellSelected(const EditorView& view, const NetData& data) {
    if (!plotHasKeyboard()) return;
    ImGui::BeginTooltip();
    if (view.focus.selected) {
        const planet::ChunkExplanation told = planet::explainChunk(*view.planet, *view.focus.selected);
        ImGui::TextUnformatted(hitText(data, {*view.focus.selected, told.node, told.state}).c_str());
    }
    ImGui::TextDisabled(
        "arrows: neighbour   PageUp, PageDown: parent, child\n+ -: zoom   Shift+arrows: move the view   "
        "Home: fit   Enter: look at it");
    ImGui::EndTooltip();
}

void net(const EditorView& view, const NetData& data, ImVec2 size, QuadtreePanelState& state,
         const OverlaySettings& overlay, Commands& commands) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const Rect area{corner.x, corner.y, size.x, size.y};
    state.area = area;
    plotItem("net", size);
    noteItem("Net");
    netMouse(data, area, state, commands);
    netKeys(view, data, area, state, commands);
    tellSelected(view, data);
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    drawList.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f));
    ImGui::PushClipRect(corner, end, true);
    const NetPlacement placement = placementOf(netSize, state.focus, area);
    fillNetRects(data, placement, area, colouringOf(state, overlay), state.rects);
    drawRects(drawList, state.rects);
    faceNames(drawList, placement);
    if (overlay.sources && view.sources.layers) drawSources(drawList, placement, *view.sources.layers);
    if (overlay.regions) {
        follow(state.regionOutlines, view.planet->tree());
        drawRegions(drawList, placement, state.regionOutlines);
    }
    const double radiusM = view.planet->tree().shape.radiusM;
    if (view.camera.lodFrozen)
        drawCamera(drawList, placement, view.camera.renderView, radiusM, palette().dim);
    drawCamera(drawList, placement, view.camera.lodView, radiusM, {1, 1, 1, 1});
    if (view.focus.hovered)
        outlineChunk(drawList, placement, *view.focus.hovered, {1, 1, 1, 1}, ImGui::GetFontSize() / 13);
    if (view.focus.selected)
        outlineChunk(drawList, placement, *view.focus.selected, palette().warning,
                     2 * ImGui::GetFontSize() / 13);
    ImGui::PopClipRect();
}

// Returns a short text for a narrow column; the legend explains the same colours in full.
const char* shortStateText(planet::ChunkState state) {
    if (state == planet::ChunkState::CulledFrustum) return "frustum";
    if (state == planet::ChunkState::CulledHorizon) return "horizon";
    return stateText(state);
}

// Draws the arrow before a chunk that has children. Returns true if it is pressed.
bool openArrow(const TreeRow& row) {
    const float side = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (!row.canOpen) {
        ImGui::Dummy({side, side});
        return false;
    }
    const bool pressed = ImGui::InvisibleButton("open", {side, side});
    const ImU32 colour = packed(ImGui::IsItemHovered() ? palette().text : palette().dim);
    ImGui::RenderArrow(ImGui::GetWindowDrawList(), at, colour, row.open ? ImGuiDir_Down : ImGuiDir_Right,
                       0.8f);
    return pressed;
}

void treeRow(const EditorView& view, const TreeRow& row, QuadtreePanelState& state, Commands& commands) {
    // Rows below the root rows omit the face.
    std::string name = toString(row.id);
    ImGui::PushID(name.c_str());
    if (row.id.level > 0) name.erase(0, name.find('/') + 1);
    ImGui::TableNextColumn();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.5f * ImGui::GetFontSize() * row.id.level);
    if (openArrow(row)) {
        if (!state.open.erase(row.id)) state.open.insert(row.id);
    }
    ImGui::SameLine(0, 2);
    const bool selected = view.focus.selected == row.id;
    if (view.focus.hovered == row.id)
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, packed(palette().accent, 0.18f));
    const ImVec4& accent = palette().accent;
    ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(accent.x, accent.y, accent.z, 0.4f));
    if (ImGui::Selectable(name.c_str(), selected,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick |
                              ImGuiSelectableFlags_AllowItemOverlap)) {
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
            commands.emplace_back(LookAtChunk{row.id});
        else
            commands.emplace_back(SelectChunk{row.id});
        state.followed = row.id;
    }
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) commands.emplace_back(HoverChunk{row.id});
    ImGui::TableNextColumn();
    if (row.node != planet::noNode) ImGui::TextUnformatted(pixelsText(row.epsPx, "").c_str());
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float swatch = std::round(ImGui::GetFontSize() * 0.6f);
    const float top = at.y + (ImGui::GetFontSize() - swatch) / 2;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + swatch, top + swatch},
                                              packed(stateColour(row.state)), 2);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + swatch * 1.5f);
    ImGui::TextUnformatted(shortStateText(row.state));
    ImGui::PopID();
}

// Opens the parents of a chunk selected elsewhere. Returns the row to scroll to, or -1.
int followSelection(const EditorView& view, const NetData& data, const std::optional<TableSort>& sort,
                    QuadtreePanelState& state, std::vector<TreeRow>& rows) {
    if (view.focus.selected == state.followed) return -1;
    state.followed = view.focus.selected;
    if (!state.followed) return -1;
    openWayTo(*state.followed, state.open);
    rows = treeRows(data, state.open, sort);
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const TreeRow& row) { return row.id == *state.followed; });
    return found == rows.end() ? -1 : static_cast<int>(found - rows.begin());
}

void treeList(const EditorView& view, const NetData& data, ImVec2 size, QuadtreePanelState& state,
              Commands& commands) {
    const std::string eps = fmt::format("{} px", epsSymbol());
    const std::array columns = {
        TableColumn{"Chunk", 1.6f, "Sorting orders the chunks below each parent.", "xxx 7/127/127"},
        TableColumn{eps.c_str(), 0.3f, "Predicted error of the chunk's own surface, in pixels.", "> 1 M"},
        TableColumn{"State", 0.8f, nullptr, "xx not resident"}};
    if (!beginSizedTable("tree", columns, size)) return;
    const std::optional<TableSort> sort = chosenSort();
    std::vector<TreeRow> rows = treeRows(data, state.open, sort);
    const int goal = followSelection(view, data, sort, state, rows);
    if (goal >= 0) {
        const float rowHeight = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
        ImGui::SetScrollY(std::max(0.0f, rowHeight * static_cast<float>(goal) - 0.4f * size.y));
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const auto row = static_cast<std::size_t>(i);
            tableRow(row, [&] { treeRow(view, rows[row], state, commands); });
        }
    }
    const auto epsPx = [](const TreeRow& row) {
        return row.node == planet::noNode ? ExportCell() : ExportCell(row.epsPx);
    };
    endTable(exportTable<TreeRow>("quadtree", rows.size(), [&](std::size_t row) { return rows[row]; },
                                  {{"chunk", [](const TreeRow& row) { return toString(row.id); }, true},
                                   {terms::epsPx.key, epsPx},
                                   {"state", [](const TreeRow& row) { return stateText(row.state); }}}));
}

}  // namespace

void quadtreePanel(const EditorView& view, QuadtreePanelState& state, ViewSettings& settings,
                   Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to see its quadtrees.");
    quadtreeControls(view, state);
    legendRows(legendOfNet(view, state, settings.overlay));
    NetData data = netDataOf(*view.planet);
    data.atlas = view.instruments.atlas.drape;
    const float font = ImGui::GetFontSize();
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    const ImVec2 room(ImGui::GetContentRegionAvail().x,
                      std::max(ImGui::GetContentRegionAvail().y, 12 * font));
    // The net's aspect ratio is 4:3; a list beside it needs about 20 letters.
    const bool beside = room.x > room.y && room.x > 44 * font;
    ImVec2 netPx = room;
    if (state.showTree && beside) netPx.x = std::max(room.x - 24 * font, room.x * 0.5f);
    if (state.showTree && !beside)
        netPx.y = std::min(room.x * netRows / netColumns, std::max(room.y - 9 * font, 8 * font));
    net(view, data, netPx, state, settings.overlay, commands);
    if (!state.showTree) return;
    if (beside) ImGui::SameLine();
    const ImVec2 listSize(beside ? 0 : room.x,
                          beside ? room.y : std::max(room.y - netPx.y - spacing.y, 6 * font));
    treeList(view, data, listSize, state, commands);
}

}  // namespace worldy::ui
