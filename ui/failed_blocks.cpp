#include "ui/failed_blocks.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "ui/chunk_link.h"
#include "ui/item_map.h"
#include "ui/paging_text.h"
#include "ui/tables.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

void failedRow(const EditorView& view, const planet::FailedBlock& failed, Commands& commands) {
    ImGui::TableNextColumn();
    if (ImGui::SmallButton("Retry")) commands.push_back(RetryFailed{failed.block});
    noteItem("Retry " + planet::toString(failed.block));
    tooltip("Lets this block be asked for again at once, as if it had never failed.");
    const bool isTile = failed.block.kind != planet::BlockKind::Heights;
    ImGui::TableNextColumn();
    if (isTile)
        colourLink(failed.block.parent, view, commands);
    else
        chunkLink(failed.block.parent, view, commands);
    cell(retryText(failed.retryInS), failed.retryInS ? palette().warning : palette().bad);
    cell(fmt::format("{}", failed.attempts));
    cell(kindText(failed.block.kind), isTile ? palette().accent : palette().text);
    cell(failed.message);
    tooltip(failed.message.c_str());
}

}  // namespace

void sortFailed(std::vector<planet::FailedBlock>& blocks) {
    const auto place = [](const planet::FailedBlock& failed) {
        return std::tuple(failed.retryInS.value_or(-1), failed.block);
    };
    std::sort(blocks.begin(), blocks.end(),
              [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

std::string retryText(const std::optional<double>& retryInS) {
    if (!retryInS) return "for good";
    return *retryInS > 0 ? "in " + latencyText(*retryInS) : "when wanted";
}

void failedTable(const EditorView& view, const std::vector<planet::FailedBlock>& blocks, Commands& commands) {
    if (blocks.empty())
        return emptyState(
            "Every block that was asked for could be read. \"Failures\" under Bad disk makes some fail.");
    // As wide as their texts, in heights of the font.
    constexpr std::array columns = {
        TableColumn{"##retry", 3.6f},
        TableColumn{"Children of", 7, "A click selects the chunk, a double click looks at it."},
        TableColumn{
            "Again", 6.8f,
            "When the block is asked for again by itself: after a delay that doubles with each failure, "
            "as soon as a view wants it. For good: only by Retry. \"Retries\" and \"Retry after\" say how "
            "often and when; data that was read and is wrong has failed for good at once."},
        TableColumn{"Tried", 3.2f, "Reads that failed since the block was last there or asked for by Retry."},
        TableColumn{"Kind", 4.4f, "Heights of chunks, tiles of colour, or tiles of normals."},
        TableColumn{"Why", 24, "What went wrong last; the whole text stands in its tooltip."}};
    if (!beginWideTable("failed", columns, 49, 2)) return;
    tableRows(blocks.size(), [&](std::size_t row) { failedRow(view, blocks[row], commands); });
    ImGui::EndTable();
}

}  // namespace ui
