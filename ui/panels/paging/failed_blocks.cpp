#include "ui/panels/paging/failed_blocks.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "ui/kit/chunk_link.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/paging_text.h"

namespace worldy::ui {

namespace {

void failedRow(const EditorView& view, const planet::FailedBlock& failed, Commands& commands) {
    ImGui::TableNextColumn();
    if (ImGui::SmallButton("Retry")) commands.push_back(RetryFailed{failed.block});
    noteItem("Retry " + planet::toString(failed.block));
    tooltip("Retries this block now and resets its failure count.");
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
    if (!retryInS) return "never";
    return *retryInS > 0 ? "in " + latencyText(*retryInS) : "when needed";
}

void failedTable(const EditorView& view, const std::vector<planet::FailedBlock>& blocks, TextFilter& filter,
                 Commands& commands) {
    if (blocks.empty())
        return emptyState("No read has failed. \"Failure rate\" under I/O fault injection makes reads fail.");
    filterBox(filter, "blocks");
    std::vector<const planet::FailedBlock*> rows;
    for (const planet::FailedBlock& failed : blocks) {
        if (filter.empty() || passes(filter.view(), {planet::toString(failed.block.parent),
                                                     kindText(failed.block.kind), failed.message}))
            rows.push_back(&failed);
    }
    if (rows.empty()) return emptyState("No block matches the filter.");
    const HitHighlight highlight(filter);
    const std::string chunk = widestChunkName(view);
    const std::array columns = {
        TableColumn{"##retry", 0.1f, nullptr, "Retry xx"},
        TableColumn{"Parent", 1, "Click to select the chunk; double-click to look at it.", chunk.c_str()},
        TableColumn{"Retry", 1,
                    "When the block is retried automatically: after a delay that doubles with each failure, "
                    "if a view needs it. Never: the block has failed permanently and only the Retry button "
                    "requests it again. \"Retries\" and \"Retry delay\" set the number and the delay; "
                    "corrupt blocks fail permanently at once.",
                    "when needed"},
        TableColumn{"Attempts", 0.5f, "Failed reads since the block was last loaded or retried manually."},
        TableColumn{"Kind", 0.5f, "Kind of block: heights of a chunk, colour tile or normal tile.",
                    "heights"},
        TableColumn{"Reason", 20, "The last error; its tooltip shows the full text.",
                    "planet.chk: block z_pos/3/5/2 at byte 1234567: read failed"}};
    if (!beginWideTable("failed", columns, 2)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::FailedBlock& failed = *rows[row];
        switch (column) {
            case 1:
                return sortKey(failed.block.parent);
            case 2:
                return failed.retryInS.value_or(std::numeric_limits<double>::infinity());
            case 3:
                return static_cast<double>(failed.attempts);
            case 4:
                return std::string(kindText(failed.block.kind));
            default:
                return failed.message;
        }
    };
    tableRows(rows.size(), key, [&](std::size_t row) { failedRow(view, *rows[row], commands); });
    using Failed = planet::FailedBlock;
    endTable(exportTable<Failed>(
        "failed blocks", rows.size(), [&](std::size_t row) { return *rows[row]; },
        {{"kind", [](const Failed& failed) { return kindText(failed.block.kind); }, true},
         {"parent", [](const Failed& failed) { return planet::toString(failed.block.parent); }, true},
         {"failed_permanently", [](const Failed& failed) { return !failed.retryInS.has_value(); }},
         {"retry_in_s", [](const Failed& failed) { return failed.retryInS; }},
         {"attempts", [](const Failed& failed) { return failed.attempts; }},
         {"reason", [](const Failed& failed) { return failed.message; }}}));
}

}  // namespace worldy::ui
