#include "ui/panels/lod/chunk_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/base/glossary.h"
#include "app/base/text.h"
#include "app/scene/frame_stats.h"
#include "app/scene/governing.h"
#include "app/scene/overlay_colours.h"
#include "ui/kit/item_map.h"
#include "ui/kit/marked_box.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/source_readings.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/explanation_text.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

using planet::ChunkExplanation;
using planet::ChunkId;
using planet::ChunkNode;

constexpr int pictureCells = 64;

ImVec4 asVector(const glm::vec3& colour) {
    return {colour.x, colour.y, colour.z, 1};
}

void idField(const EditorView& view, ChunkPanelState& state, Commands& commands) {
    if (state.shown != view.focus.selected) {
        state.shown = view.focus.selected;
        const std::string text = state.shown ? toString(*state.shown) : std::string();
        state.idText.fill('\0');
        std::copy_n(text.begin(), std::min(text.size(), state.idText.size() - 1), state.idText.begin());
        state.problem.clear();
    }
    ImGui::SetNextItemWidth(-1);
    const bool entered =
        ImGui::InputTextWithHint("##id", "z_pos/3/5/2", state.idText.data(), state.idText.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    noteItem("Id");
    tooltip(
        "Chunk id: face, level (0 is the whole face), and x and y from the face's south-west corner, each in "
        "[0, 2^level - 1]. Press Enter to select it.");
    if (entered) {
        state.problem = chunkIdProblem(state.idText.data(), deepestLevelOf(view.planet->tree().shape));
        if (state.problem.empty())
            commands.emplace_back(SelectChunk{planet::chunkIdFromString(state.idText.data())});
    }
    if (state.problem.empty()) return;
    wrappedText(state.problem, palette().bad);
}

void buttons(const ChunkId& id, Commands& commands) {
    if (button("Look at",
               "Moves the camera so that the whole chunk is visible. Double-clicking the chunk in the net "
               "or the list does the same."))
        commands.emplace_back(LookAtChunk{id});
    sameLineForButton("Copy id");
    if (button("Copy id", "Copies the chunk id to the clipboard."))
        commands.emplace_back(CopyText{toString(id)});
    sameLineForButton("Parent");
    beginGrey(id.level == 0, "A root chunk has no parent.");
    const bool parent = button("Parent", "Selects the parent chunk.");
    endGrey();
    if (parent) commands.emplace_back(SelectChunk{parentOf(id)});
}

// Draws a button with a text that selects a chunk.
void chunkButton(const ChunkId& id, const std::string& text, const std::string& explanation,
                 Commands& commands) {
    ImGui::PushID(toString(id).c_str());
    if (ImGui::SmallButton(text.c_str())) commands.emplace_back(SelectChunk{id});
    ImGui::PopID();
    if (ImGui::IsItemHovered()) commands.emplace_back(HoverChunk{id});
    tooltip(explanation.c_str());
}

// Returns the sizes in one unit, so that several fit into a row: "130 x 160 x 5.47 km".
std::string sizesText(std::initializer_list<double> sizesM) {
    const bool inKm = std::max(sizesM) >= 10'000;
    std::string text;
    for (const double size : sizesM) {
        const double value = inKm ? size / 1000 : size;
        text += fmt::format("{}{:.{}f}", text.empty() ? "" : " x ", value,
                            value >= 100  ? 0
                            : value >= 10 ? 1
                                          : 2);
    }
    return text + (inKm ? " km" : " m");
}

void placeRows(const EditorView& view, const ChunkExplanation& explanation, const ChunkNode* node) {
    const planet::PlanetShape& shape = view.planet->tree().shape;
    const ChunkId& id = explanation.id;
    if (!beginValues("place")) return;
    valueRow("Level", fmt::format("{} of {}", id.level, deepestLevelOf(shape)),
             "Level 0 is the whole face. Each level halves the chunk side and doubles the sample density. "
             "The last level holds the finest samples.");
    valueRow("Centre", middlePlaceText(id), "Latitude and longitude of the chunk's centre.");
    const double acrossM = groundSizeM(shape, id, ProfileWay::WestEast);
    const double upM = groundSizeM(shape, id, ProfileWay::SouthNorth);
    valueRow("Size on ground", sizesText({acrossM, upM}),
             "Extent through the chunk's centre, west to east and south to north, at height 0.");
    valueRow("Spacing", distanceText(acrossM / chunkCells(shape)),
             "Distance between two vertices: chunk width divided by the number of cells.");
    if (node) {
        valueRow("Heights",
                 fmt::format("{} to {}", distanceText(static_cast<double>(node->minHeightM)),
                             distanceText(static_cast<double>(node->maxHeightM))),
                 "Minimum and maximum height of the finest samples under this chunk above the planet's "
                 "radius, including exaggeration.");
        const glm::dvec3 box = 2.0 * node->bounds.box.halfSizeM;
        valueRow("Bounds", sizesText({box.x, box.y, box.z}),
                 "Bounding box of the chunk and its descendants (east, north, up), used for distance and "
                 "culling.");
    }
    endValues();
}

void errorRows(const ChunkExplanation& explanation, const BudgetUse& budget) {
    if (!beginValues("errors")) return;
    const std::string bound = explanation.deltaGIsBound ? "at most " : "";
    valueRow("δg", bound + distanceText(static_cast<double>(explanation.deltaGM)),
             "Geometric error of this chunk's simplification step: the largest distance between a removed "
             "vertex and the triangle that replaces it. Exact while its children are resident.");
    valueRow("δc", distanceText(static_cast<double>(explanation.deltaCM)),
             "Geometric error bound of the chunk: δg + the largest δc of its four children; 0 at a leaf.");
    const double share = explanation.deltaCM > 0 ? static_cast<double>(explanation.deltaTightM) /
                                                       static_cast<double>(explanation.deltaCM)
                                                 : 1;
    valueRow("tight",
             fmt::format("{}, {:.0f} % of {}", distanceText(static_cast<double>(explanation.deltaTightM)),
                         100 * share, inFont("δc")),
             "Tight metric: the largest distance between the finest samples under the chunk and its surface "
             "at the same position, or a child's if larger; 0 at a leaf. It never exceeds δc, which sums the "
             "largest errors of all levels.");
    valueRow("Metric", explanation.metric == planet::ErrorMetric::Tight ? "tight" : "additive",
             "Metric used for ε, d_m and skirts (lod.metric, or a region's).");
    valueRow("Distance", distanceText(explanation.distanceM),
             "D, the distance from the LOD view's camera to the chunk's bounds.");
    const bool over = explanation.epsPx > explanation.regionTauPx();
    valueRow(epsSymbol(), pixelsText(explanation.epsPx),
             "Screen-space error ε = δc K' / D, K' = W / (2 tan(Hfov / 2)), W: viewport width in pixels. "
             "Above τ the chunk should be split.",
             over ? &palette().warning : nullptr);
    valueRow(tauSymbol(), fmt::format("{:.3g} px", explanation.regionTauPx()),
             "Tolerance from the LOD panel, times the factor of the regions here: a chunk is fine enough "
             "while ε <= τ.");
    for (const planet::RegionEffect& effect : explanation.regions) {
        valueRow(effect.name.c_str(), regionText(effect, explanation.demand),
                 "A region that touches the chunk (Regions panel). The strictest demand of any place in the "
                 "chunk counts.");
    }
    if (budget.isOn)
        valueRow(terms::budgetBinds.name, bindsText(budget, tauSymbol()), terms::budgetBinds.meaning);
    valueRow("d_m", distanceText(explanation.switchDistanceM),
             "Switch distance d_m = δc K, K = W / (2 τ tan(Hfov / 2)): a nearer chunk must be split.");
    endValues();
}

const planet::DrawItem* drawItemOf(const planet::Selection& selection, const ChunkId& id) {
    const auto found = std::find_if(selection.draw.begin(), selection.draw.end(),
                                    [&](const planet::DrawItem& item) { return item.id == id; });
    return found == selection.draw.end() ? nullptr : &*found;
}

void drawingRows(const EditorView& view, const ChunkExplanation& explanation, const ChunkNode* node) {
    if (!beginValues("drawing")) return;
    const ImVec4 colour = asVector(stateColour(explanation.state));
    valueRow("State", stateText(explanation.state), "Result of the last selection for this chunk.", &colour);
    valueRow(
        "Request",
        explanation.queuePlace ? fmt::format("{} of {}", *explanation.queuePlace, explanation.queueLength)
                               : std::string("none"),
        "Position in the paging queue of the request that loads this chunk or its children; 1 is read next.");
    if (const planet::DrawItem* item = drawItemOf(view.planet->selection(), explanation.id)) {
        valueRow("Morph", fmt::format("{:.2f}", item->morph),
                 "0: the chunk's own surface; 1: its parent's surface.");
        valueRow(terms::drawnBoundPx.name, pixelsText(static_cast<double>(item->drawnBoundPx)),
                 terms::drawnBoundPx.meaning);
        valueRow("Skirt", distanceText(static_cast<double>(item->skirtDepthM)),
                 "Skirt depth towards the planet's centre.");
    }
    if (node) {
        const double ageS = view.planet->lastStep().nowS - node->loadedAtS;
        valueRow("Loaded",
                 node->loadOrder == 0 ? std::string("with the planet")
                                      : fmt::format("{} ago, block {}", durationText(ageS), node->loadOrder),
                 "Time since the chunk was loaded, and the number of its block in load order since the "
                 "planet was opened.");
        valueRow("Slot", fmt::format("{}", node->slot), "Slot in the GPU pool of heights.");
    }
    endValues();
}

void parents(const ChunkId& id, Commands& commands) {
    if (id.level == 0) {
        wrappedText("None: this chunk is a whole face.", palette().dim);
        return;
    }
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    for (int level = 0; level < id.level; ++level) {
        const ChunkId above = ancestorOf(id, level);
        const std::string text =
            level == 0 ? toString(above) : fmt::format("{}: {}/{}", level, above.x, above.y);
        const float width = ImGui::CalcTextSize(text.c_str()).x + 3 * ImGui::GetStyle().FramePadding.x;
        if (level > 0 && ImGui::GetItemRectMax().x + width <= right)
            ImGui::SameLine(0, ImGui::GetFontSize() * 0.3f);
        chunkButton(above, text, toString(above), commands);
    }
}

std::string levelDifference(int own, int other) {
    if (own == other) return "same level";
    const int levels = std::abs(own - other);
    return fmt::format("{} {}", levels, other < own ? "coarser" : "finer");
}

void neighbours(const EditorView& view, const ChunkId& id, Commands& commands) {
    const auto beside = drawnNeighbours(view.planet->selection(), id);
    constexpr std::array names = {"West", "East", "South", "North"};
    if (!ImGui::BeginTable(
            "neighbours", 2,
            ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate))
        return;
    detail::beginRows();
    ImGui::TableSetupColumn("Edge", ImGuiTableColumnFlags_WidthFixed, 4.6f * ImGui::GetFontSize());
    ImGui::TableSetupColumn("Chunks", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    const auto key = [&](std::size_t edge, std::size_t column) -> SortKey {
        if (column == 0) return std::string(names[edge]);
        return beside[edge].empty() ? SortKey(std::string()) : sortKey(beside[edge].front());
    };
    const auto drawRow = [&](std::size_t edge) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", names[edge]);
        tooltip(
            "Side of the chunk on its face: west is minimum u, south is minimum v. On the four equatorial "
            "faces these are compass directions.");
        ImGui::TableNextColumn();
        if (beside[edge].empty()) ImGui::TextDisabled("none drawn");
        constexpr std::size_t most = 8;
        for (std::size_t i = 0; i < std::min(beside[edge].size(), most); ++i) {
            const ChunkId& other = beside[edge][i];
            const std::string difference = levelDifference(id.level, other.level);
            chunkButton(other, toString(other), fmt::format("{}: {}", toString(other), difference), commands);
            if (other.level == id.level) continue;
            ImGui::SameLine();
            ImGui::TextColored(palette().dim, "%s", difference.c_str());
        }
        if (beside[edge].size() > most) ImGui::TextDisabled("and %zu more", beside[edge].size() - most);
    };
    for (const std::size_t edge : tableOrder(planet::edgeCount, chosenSort(), key))
        tableRow(edge, [&] { drawRow(edge); });
    ExportTable table{.name = "neighbours", .columns = {{"edge"}, {"chunks"}}, .rows = planet::edgeCount};
    table.cell = [&](std::size_t edge, std::size_t column) -> ExportCell {
        if (column == 0) return names[edge];
        std::string chunks;
        for (const ChunkId& other : beside[edge]) chunks += (chunks.empty() ? "" : " ") + toString(other);
        return chunks;
    };
    endTable(table);
}

void heightPicture(const EditorView& view, const ChunkNode& node, ChunkPanelState& state) {
    if (state.pictured != node.heights) {
        state.pictured = node.heights;
        state.picture = chunkPicture(view.planet->tree(), node, pictureCells);
    }
    const int side = state.picture.side;
    const float room = std::min(ImGui::GetContentRegionAvail().x, 13 * ImGui::GetFontSize());
    const float cell = room / static_cast<float>(side);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy({room, room});
    noteItem("Heights");
    tooltip(
        "Height map of the chunk with shading from the north-west and exaggerated slopes. Dark blue is the "
        "lowest height, light yellow the highest. The lines mark the profiles.");
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    drawList.PrimReserve(6 * side * side, 4 * side * side);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const ImVec2 low(corner.x + static_cast<float>(column) * cell,
                             corner.y + static_cast<float>(row) * cell);
            drawList.PrimRect(low, {low.x + cell, low.y + cell},
                              state.picture.cells[static_cast<std::size_t>(row * side + column)]);
        }
    }
    const float middle = room / 2;
    drawList.AddLine({corner.x, corner.y + middle}, {corner.x + room, corner.y + middle},
                     packed(palette().accent, 0.8f));
    drawList.AddLine({corner.x + middle, corner.y}, {corner.x + middle, corner.y + room},
                     packed(palette().warning, 0.8f));
}

struct Profile {
    std::vector<float> heightsM;
    ImVec4 colour;
};

void drawProfile(ImDrawList& drawList, const Profile& profile, const ImVec2& corner, const ImVec2& size,
                 float low, float high) {
    const float range = std::max(high - low, 1e-3f);
    std::vector<ImVec2> points;
    for (std::size_t i = 0; i < profile.heightsM.size(); ++i) {
        const float along = static_cast<float>(i) / static_cast<float>(profile.heightsM.size() - 1);
        points.emplace_back(corner.x + along * size.x,
                            corner.y + (high - profile.heightsM[i]) / range * size.y);
    }
    drawList.AddPolyline(points.data(), static_cast<int>(points.size()), packed(profile.colour), 0,
                         ImGui::GetFontSize() / 10);
}

// Draws the west-east and south-north profiles in one frame. Hovering shows both heights.
void profiles(const EditorView& view, const ChunkNode& node, float lines) {
    const planet::ChunkTree& tree = view.planet->tree();
    const Profile across{chunkProfile(tree, node, ProfileWay::WestEast), palette().accent};
    const Profile up{chunkProfile(tree, node, ProfileWay::SouthNorth), palette().warning};
    const auto [low1, high1] = std::minmax_element(across.heightsM.begin(), across.heightsM.end());
    const auto [low2, high2] = std::minmax_element(up.heightsM.begin(), up.heightsM.end());
    const float low = std::min(*low1, *low2);
    const float high = std::max(*high1, *high2);
    ImGui::BeginGroup();
    ImGui::TextColored(across.colour, "west to east");
    sameLineIfRoom(ImGui::CalcTextSize("south to north").x);
    ImGui::TextColored(up.colour, "south to north");
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float pad = ImGui::GetFontSize() * 0.3f;
    const ImVec2 size(ImGui::GetContentRegionAvail().x, lines * ImGui::GetFontSize());
    plotItem("profile", size);
    noteItem("Profile");
    const bool hovered = plotIsHovered();
    const PlotCursor cursor = plotCursor(across.heightsM.size());
    ImGui::EndGroup();
    ExportTable heights{.name = "chunk profiles",
                        .columns = {{"vertex"}, {"west_to_east_m"}, {"south_to_north_m"}},
                        .rows = across.heightsM.size()};
    heights.cell = [&](std::size_t row, std::size_t column) -> ExportCell {
        if (column == 0) return row;
        return column == 1 ? across.heightsM[row] : up.heightsM[row];
    };
    exportPlot("profile", heights);
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    drawList.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg), 2);
    const ImVec2 inner(corner.x, corner.y + pad);
    const ImVec2 innerSize(size.x, size.y - 2 * pad);
    drawProfile(drawList, up, inner, innerSize, low, high);
    drawProfile(drawList, across, inner, innerSize, low, high);
    const std::string top = distanceText(static_cast<double>(high));
    const std::string bottom = distanceText(static_cast<double>(low));
    // The ends of the scale are drawn over the lines.
    const auto scaleEnd = [&](const std::string& text, float y) {
        const ImVec2 textSize = ImGui::CalcTextSize(text.c_str());
        drawList.AddRectFilled({corner.x, y}, {corner.x + textSize.x + 2 * pad, y + textSize.y},
                               ImGui::GetColorU32(ImGuiCol_FrameBg, 0.85f), 2);
        drawList.AddText({corner.x + pad, y}, packed(palette().dim), text.c_str());
    };
    scaleEnd(top, corner.y);
    scaleEnd(bottom, end.y - ImGui::GetFontSize());
    if (!hovered && !cursor.at) return;
    const auto last = static_cast<float>(across.heightsM.size() - 1);
    const float pointed = std::clamp((ImGui::GetIO().MousePos.x - corner.x) / size.x, 0.0f, 1.0f);
    const float share = cursor.at ? static_cast<float>(*cursor.at) / last : pointed;
    const auto at = static_cast<std::size_t>(std::lround(share * last));
    const float x = corner.x + share * size.x;
    drawList.AddLine({x, corner.y}, {x, end.y}, packed(palette().text, 0.6f));
    beginSampleTooltip(cursor, x);
    ImGui::TextUnformatted(fmt::format("at {:.0f} %\nwest to east {}\nsouth to north {}",
                                       static_cast<double>(100 * share),
                                       distanceText(static_cast<double>(across.heightsM[at])),
                                       distanceText(static_cast<double>(up.heightsM[at])))
                               .c_str());
    ImGui::EndTooltip();
}

}  // namespace

void chunkPanel(const EditorView& view, ChunkPanelState& state, Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to inspect its chunks.");
    idField(view, state, commands);
    if (!view.focus.selected) {
        state.pictured.reset();
        return emptyState(
            "No chunk is selected. Click one in the viewport or in the Quadtree panel, or type its id "
            "above.");
    }
    const ChunkExplanation explanation = explainChunk(*view.planet, *view.focus.selected);
    const planet::ChunkTree& tree = view.planet->tree();
    const bool resident = explanation.node < tree.nodes.size() && tree.nodes[explanation.node].heights;
    const ChunkNode* node = resident ? &tree.nodes[explanation.node] : nullptr;
    markedBox(whyText(explanation), packed(asVector(stateColour(explanation.state))));
    buttons(explanation.id, commands);
    drawingRows(view, explanation, node);
    if (node && section("Error")) errorRows(explanation, view.frames.stats.budget);
    if (section("Position")) placeRows(view, explanation, node);
    if (section("Source"))
        sourceReadings("source", view.sources, view.sources.selected, "The source is being asked...",
                       commands);
    if (section("Parents")) parents(explanation.id, commands);
    if (section("Drawn neighbours")) neighbours(view, explanation.id, commands);
    if (node && section("Heights")) {
        const bool beside = ImGui::GetContentRegionAvail().x > 27 * ImGui::GetFontSize();
        heightPicture(view, *node, state);
        if (beside) ImGui::SameLine();
        profiles(view, *node, beside ? 11 : 6);
    }
}

}  // namespace worldy::ui
