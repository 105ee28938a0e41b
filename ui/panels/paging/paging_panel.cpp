#include "ui/panels/paging/paging_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "app/base/glossary.h"
#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "planet/base/percentile.h"
#include "planet/paging/normal_tile.h"
#include "planet/planet_tools.h"
#include "planet/select/screen_error.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/columns.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/history.h"
#include "ui/model/paging_text.h"
#include "ui/panels/paging/failed_blocks.h"

namespace worldy::ui {

namespace {

constexpr double pagingSampledEveryS = 0.1;
// The ends of the logarithmic latency axis, seconds.
constexpr double fastestS = 1e-4;
constexpr double slowestS = 100;
constexpr std::size_t latencyBuckets = 36;

// Controls.

void settingControls(const SettingControls& control, PagingOptions& paging, bool hasColours) {
    control(paging.budgetMB);
    if (hasColours) control(paging.colourShare);
    control(paging.loaderThreads);
    control(paging.uploadLimitMs);
    control(paging.retries);
    control(paging.retryDelayS);
}

void buttons(const EditorView& view, Commands& commands) {
    bool paused = view.pagingPaused;
    if (ImGui::Checkbox("Pause", &paused)) commands.push_back(PausePaging{paused});
    noteItem("Pause");
    tooltip("Stops loaders from taking requests from the queue. Missing chunks stay coarse.");
    sameLineForButton("Load one");
    beginGrey(!view.pagingPaused, "Pause paging first.");
    if (button("Load one", "While paused: processes the most urgent request.")) commands.push_back(LoadOne{});
    endGrey();
    sameLineForButton("Evict all");
    if (button("Evict all",
               "Evicts all chunks and colour tiles except the six roots, and cancels all queued requests, to "
               "show how the picture loads again."))
        commands.push_back(DropAll{});
    const planet::PagingCounters& p = view.frames.stats.paging;
    // The button is drawn without failures too. Otherwise the controls below would move under the pointer when one comes.
    const std::uint32_t failed = p.failedPermanently() + p.awaitingRetry();
    ImGui::PushStyleColor(ImGuiCol_Text, p.failedPermanently() > 0 ? palette().bad
                                         : failed > 0              ? palette().warning
                                                                   : palette().text);
    beginGrey(failed == 0, "No block has failed.");
    const std::string label =
        failed > 0 ? fmt::format("Retry {} failed###retry", failed) : "Retry failed###retry";
    const bool retry = ImGui::Button(label.c_str());
    noteItem("Retry failed");
    endGrey();
    if (retry) commands.push_back(RetryFailed{});
    ImGui::PopStyleColor();
    tooltip(
        "Retries all blocks that failed permanently. Where a block could not be read, its parent is drawn "
        "instead; permanently failed colour tiles are drawn as a checkerboard. The Failed tab lists them.");
}

bool hasNormals(const EditorView& view) {
    return view.frames.stats.paging[planet::BlockKind::Normals].capacity > 0;
}

// Returns true if the planet has other kinds of blocks than heights.
bool hasKinds(const EditorView& view) {
    return view.planet->colour() || hasNormals(view);
}

std::size_t tileBytes(const planet::Planet& planet) {
    const bool isUnpacked = planet.paging()[planet::BlockKind::Colours].unpacked;
    return planet::colourTileBytes(isUnpacked ? planet::ColourFormat::Lossless : planet.colour()->format);
}

void colourMemory(const EditorView& view) {
    const planet::BlockCounters& p = view.frames.stats.paging[planet::BlockKind::Colours];
    const double bytes = static_cast<double>(tileBytes(*view.planet));
    const double used = static_cast<double>(p.resident) * bytes;
    const double room = p.capacity * bytes;
    usageBar(room > 0 ? used / room : 0, fmt::format("colours {} of {}", bytesText(used), bytesText(room)));
    const planet::PagingSettings& settings = view.planet->pagingSettings();
    tooltip(
        fmt::format(
            "Resident colour tiles and their share of the budget, all on the GPU: {} of {} tiles of {} each. "
            "The share, {:.2f}, is {}. It is limited to the number of tiles in the file and to {} tiles.",
            p.resident, p.capacity, bytesText(bytes), settings.colourShare,
            bytesText(settings.colourShare * static_cast<double>(settings.budgetBytes)),
            settings.maxColourTiles)
            .c_str());
    if (p.budgetWaits > 0) {
        wrappedText(
            fmt::format("{} requested colour tiles do not fit into their share.", countText(p.budgetWaits)),
            palette().warning);
    }
}

void normalMemory(const EditorView& view) {
    const planet::BlockCounters& p = view.frames.stats.paging[planet::BlockKind::Normals];
    constexpr double bytes = planet::normalTileBytes;
    const double used = static_cast<double>(p.resident) * bytes;
    const double room = p.capacity * bytes;
    usageBar(used / room, fmt::format("normals {} of {}", bytesText(used), bytesText(room)));
    tooltip(fmt::format("Resident normal tiles and their share of the budget, all on the GPU: {} of {} tiles "
                        "of {} each. The Light panel sets the share.",
                        p.resident, p.capacity, bytesText(bytes))
                .c_str());
    if (p.budgetWaits > 0) {
        wrappedText(
            fmt::format("{} requested normal tiles do not fit into their share.", countText(p.budgetWaits)),
            palette().warning);
    }
}

void residentMemory(const EditorView& view) {
    const planet::PagingCounters& p = view.frames.stats.paging;
    const planet::PagingSettings& settings = view.planet->pagingSettings();
    const bool hasColours = view.planet->colour().has_value();
    const double used = static_cast<double>(p.residentBytesCpu + p.residentBytesGpu);
    const double budget = static_cast<double>(settings.budgetBytes) *
                          (hasColours ? 1 - settings.colourShare : 1) *
                          (hasNormals(view) ? 1 - settings.normalShare : 1);
    usageBar(budget > 0 ? used / budget : 0,
             fmt::format("{}{} of {}", hasKinds(view) ? "heights " : "", bytesText(used), bytesText(budget)));
    tooltip(fmt::format("Resident chunks and {}: {} chunks, {} on the CPU and {} on the GPU.",
                        hasKinds(view) ? "the budget minus the shares of colours and normals" : "the budget",
                        countText(static_cast<double>(p[planet::BlockKind::Heights].resident)),
                        bytesText(static_cast<double>(p.residentBytesCpu)),
                        bytesText(static_cast<double>(p.residentBytesGpu)))
                .c_str());
    if (p[planet::BlockKind::Heights].budgetWaits > 0) {
        wrappedText(fmt::format("{} requested blocks do not fit into the budget.",
                                countText(p[planet::BlockKind::Heights].budgetWaits)),
                    palette().warning);
    }
    if (hasColours) colourMemory(view);
    if (hasNormals(view)) normalMemory(view);
}

double countNumber(std::uint64_t value) {
    return static_cast<double>(value);
}
std::string countCell(std::uint64_t value) {
    return countText(countNumber(value));
}
std::string bytesCell(std::uint64_t value) {
    return bytesText(countNumber(value));
}

void totalsByKind(const FrameStats& stats) {
    const std::array kinds = {totalsOf("Heights", stats.paging[planet::BlockKind::Heights]),
                              totalsOf("Colours", stats.paging[planet::BlockKind::Colours]),
                              totalsOf("Normals", stats.paging[planet::BlockKind::Normals])};
    constexpr std::array columns = {
        TableColumn{"Kind", 0.6f},
        TableColumn{"Loaded", 0.6f, "Blocks read and made resident."},
        TableColumn{"Evicted", 0.6f,
                    "Loaded blocks evicted since: by the budget, by changed settings or manually."},
        TableColumn{"Failed", 0.6f, "Failed reads, including those retried later."},
        TableColumn{"Read", 0.7f,
                    "Bytes read from the chunk file. Normals are derived from heights, which are read again "
                    "for them.",
                    "1023 MiB"},
        TableColumn{"Resident", 0.6f, "Blocks resident now: loaded minus evicted."},
        TableColumn{"Tiles", 0.6f,
                    "Resident chunks, or tiles of 256 x 256 texels: four per block, the six roots, and "
                    "the checkerboards in place of failed colour tiles."},
        TableColumn{"Over budget", 1,
                    "Blocks requested in the last frame that do not fit into the budget or its share."}};
    if (!beginListTable("kinds", columns, kinds.size(), 12, 1)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const KindTotals& of = kinds[row];
        if (column == 0) return std::string(of.kind);
        const std::array<double, 7> values = {countNumber(of.loaded),     countNumber(of.evicted),
                                              countNumber(of.failed),     countNumber(of.bytesRead),
                                              countNumber(of.resident),   countNumber(of.tiles),
                                              countNumber(of.budgetWaits)};
        return values[column - 1];
    };
    tableRows(kinds.size(), key, [&](std::size_t row) {
        const KindTotals& of = kinds[row];
        cell(of.kind, palette().dim);
        cell(countCell(of.loaded));
        cell(countCell(of.evicted));
        cell(countCell(of.failed), of.failed > 0 ? palette().bad : palette().text);
        cell(bytesCell(of.bytesRead));
        cell(countCell(of.resident));
        cell(countCell(of.tiles));
        cell(countCell(of.budgetWaits), of.budgetWaits > 0 ? palette().warning : palette().text);
    });
    endTable(exportTable<KindTotals>("paging totals", kinds.size(),
                                     [&](std::size_t row) { return kinds[row]; },
                                     {{"kind", [](const KindTotals& k) { return k.kind; }, true},
                                      {"loaded", [](const KindTotals& k) { return k.loaded; }},
                                      {"evicted", [](const KindTotals& k) { return k.evicted; }},
                                      {"failed", [](const KindTotals& k) { return k.failed; }},
                                      {"bytes_read", [](const KindTotals& k) { return k.bytesRead; }},
                                      {"resident", [](const KindTotals& k) { return k.resident; }},
                                      {"tiles", [](const KindTotals& k) { return k.tiles; }},
                                      {"over_budget", [](const KindTotals& k) { return k.budgetWaits; }}}));
}

void totals(const EditorView& view) {
    const planet::PagingCounters& p = view.frames.stats.paging;
    if (!beginValues("totals")) return;
    const auto loadAndEvict = [](std::uint64_t loads, std::uint64_t evictions) {
        return fmt::format("{} load, {} evict", countCell(loads), countCell(evictions));
    };
    valueRow("Requested", loadAndEvict(p.requested, p.pageOutsQueued),
             "Requests of all kinds queued since the file was opened.");
    valueRow("Cancelled", loadAndEvict(p.cancelled - p.pageOutsCancelled, p.pageOutsCancelled),
             "Requests cancelled by a request of the other type, or no longer needed.");
    valueRow("Merged", countCell(p.merged), "Requests merged with an identical queued request.");
    endValues();
    totalsByKind(view.frames.stats);
}

std::string blocksText(std::uint64_t blocks, std::uint64_t bytes) {
    return fmt::format("{} blocks, {}", countText(countNumber(blocks)), bytesText(countNumber(bytes)));
}

void prefetchFigures(const planet::PrefetchCounters& p) {
    if (!beginValues("prefetch figures")) return;
    const std::uint64_t judged = p.hits + p.wasted;
    valueRow(terms::prefetchedBlocks.name, blocksText(p.blocks, p.bytes), terms::prefetchedBlocks.meaning);
    valueRow(terms::prefetchHits.name, blocksText(p.hits, p.hitBytes), terms::prefetchHits.meaning,
             p.hits > 0 ? &palette().good : nullptr);
    valueRow(terms::prefetchWaste.name, blocksText(p.wasted, p.wastedBytes), terms::prefetchWaste.meaning,
             p.wasted > 0 ? &palette().warning : nullptr);
    valueRow("Hit rate",
             judged > 0 ? fmt::format("{:.0f} %", 100 * countNumber(p.hits) / countNumber(judged)) : "-",
             "Hits as a share of hits and waste.");
    valueRow(terms::prefetchUnused.name, countCell(p.unused()), terms::prefetchUnused.meaning);
    valueRow("Pending", countCell(p.pending), "Prefetches that are queued or being read now.");
    endValues();
}

void prefetchSection(const SettingControls& control, PagingOptions& paging,
                     const planet::PrefetchCounters& counters) {
    planet::PrefetchSettings& prefetch = paging.prefetch;
    control(prefetch.mode);
    const bool isOff = prefetch.mode == planet::PrefetchMode::Off;
    beginGrey(isOff, "Choose a prediction first.");
    control(prefetch.horizonS);
    control(prefetch.share);
    control(prefetch.lastingFirst);
    endGrey();
    if (!isOff || counters.blocks > 0) prefetchFigures(counters);
}

void badDisk(const SettingControls& control, PagingOptions& paging) {
    planet::BadDiskSettings& disk = paging.badDisk;
    control(disk.latencyMs);
    control(disk.bandwidthMBs, {.format = disk.bandwidthMBs > 0 ? "" : "unlimited"});
    control(disk.failureRate);
    control(disk.shuffledOrder);
    control(disk.seed);
    // These lines stand below the sliders, which would otherwise move under the pointer.
    if (isBad(disk)) {
        wrappedText(fmt::format("Injecting I/O faults: {}.", badDiskText(disk)), palette().warning);
        if (button("Off", "Turns all fault injection off. The seed is kept.")) {
            const std::uint32_t seed = disk.seed;
            disk = {};
            disk.seed = seed;
        }
    }
    const Field& field = control.of(paging.simulated);
    const auto tip = [&] { return settingTip(field); };
    int time = paging.simulated ? 1 : 0;
    if (choiceIndex("Read timing", time, 0, "real time\0simulated\0", tip)) paging.simulated = time == 1;
    noteSetting(field);
}

// Samples of the planet, taken a few times a second.

void sampleQueue(const planet::Planet& planet, int shownView, PagingPanelState::Sample& sample) {
    std::vector<PagingRow>& queue = sample.queue;
    queue.clear();
    sample.hidden = 0;
    const std::vector<planet::PagingRequest> loads =
        planet.inspect().pendingRequests(planet::PagingType::PageIn);
    sample.loads = static_cast<std::size_t>(
        std::ranges::count_if(loads, [](const auto& load) { return !load.isPrefetch(); }));
    sample.prefetches = loads.size() - sample.loads;
    for (const planet::PagingType type : {planet::PagingType::PageIn, planet::PagingType::PageOut}) {
        const auto requests =
            shownView < 0 ? planet.inspect().pendingRequests(type)
                          : planet.inspect().pendingRequests(type, static_cast<std::size_t>(shownView));
        for (const planet::PagingRequest& request : requests) {
            if (sample.shownKind && request.kind != *sample.shownKind) {
                ++sample.hidden;
                continue;
            }
            PagingRow row{request.parent,   request.kind,     type,
                          request.priority, request.askedAtS, request.timesAsked};
            for (std::size_t v = 0; v < request.viewPriority.size(); ++v)
                if (request.viewPriority[v] > 0) row.views |= 1u << v;
            row.urgency = request.urgency;
            queue.push_back(row);
        }
    }
}

bool isShown(planet::BlockKind kind, const std::optional<planet::BlockKind>& shownKind) {
    return !shownKind || kind == *shownKind;
}

void sampleLatency(const planet::Planet& planet, bool ofReading, PagingPanelState::Sample& sample) {
    std::vector<float> seconds;
    std::vector<float> positions;
    for (const planet::PagingEvent& event : planet.inspect().pagingHistory()) {
        if (event.outcome != planet::PagingOutcome::Loaded) continue;
        if (!isShown(event.kind, sample.shownKind)) continue;
        const double s = ofReading ? event.readS : event.waitedS;
        seconds.push_back(static_cast<float>(s));
        positions.push_back(static_cast<float>(logarithmicPosition(s, fastestS, slowestS)));
    }
    sample.latencies = seconds.size();
    sample.latencyCounts = bucketCounts(positions, latencyBuckets);
    sample.medianS = planet::percentileOf(seconds, 0.5);
    sample.slowestS = planet::percentileOf(seconds, 0.99);
}

void refresh(const EditorView& view, PagingPanelState& state) {
    if (state.shownView >= static_cast<int>(view.planet->views().size())) state.shownView = -1;
    if (state.shownKind == planet::BlockKind::Colours && !view.planet->colour()) state.shownKind.reset();
    if (state.shownKind == planet::BlockKind::Normals && !hasNormals(view)) state.shownKind.reset();
    PagingPanelState::Sample& sample = state.sample;
    const bool current = sample.planet == view.planet && sample.shownView == state.shownView &&
                         sample.shownKind == state.shownKind &&
                         sample.latencyOfReading == state.latencyOfReading &&
                         sample.failedShown == state.failedShown && view.frames.timeS >= sample.takenAtS &&
                         view.frames.timeS < sample.takenAtS + pagingSampledEveryS;
    if (current) return;
    sample.takenAtS = view.frames.timeS;
    sample.planet = view.planet;
    sample.shownView = state.shownView;
    sample.shownKind = state.shownKind;
    sample.latencyOfReading = state.latencyOfReading;
    sample.failedShown = state.failedShown;
    sampleQueue(*view.planet, state.shownView, sample);
    sample.failed =
        state.failedShown ? view.planet->inspect().failedBlocks() : std::vector<planet::FailedBlock>();
    sortFailed(sample.failed);
    sampleLatency(*view.planet, state.latencyOfReading, sample);
}

// Tables.

// Returns the first view that wants the block, or view 0.
std::size_t wantingView(std::uint32_t views, std::size_t viewCount) {
    for (std::size_t v = 0; v < viewCount; ++v)
        if (views >> v & 1u) return v;
    return 0;
}

const char* typeText(const PagingRow& row) {
    if (row.type == planet::PagingType::PageOut) return "evict";
    return row.urgency == planet::PagingUrgency::Prefetch ? "prefetch" : "load";
}

std::string reason(const planet::Planet& planet, const PagingRow& row, int shownView, double ageS) {
    if (row.type == planet::PagingType::PageOut) return pageOutReason(ageS);
    if (row.urgency == planet::PagingUrgency::Prefetch) {
        // The priority is about 1 / seconds, times the factor of the view.
        const bool isOneView = planet.views().size() == 1 && row.priority > 0;
        return isOneView ? fmt::format("wanted in {:.1f} s", 1 / row.priority) : "predicted";
    }
    if (row.kind != planet::BlockKind::Heights) return colourReason(row.priority);
    const planet::NodeIndex index = planet::findNode(planet.tree(), row.parent);
    if (index == planet::noNode) return "parent evicted";
    const std::size_t v =
        shownView >= 0 ? static_cast<std::size_t>(shownView) : wantingView(row.views, planet.views().size());
    const planet::ChunkNode& node = planet.tree().nodes[index];
    const planet::View& lodView = planet.views()[v].input.lodView;
    const planet::LodSettings& lod = planet.views()[v].input.lod;
    const double epsPx = planet::epsPxOf(node, lodView.eyeM, planet::screenScalePx(lodView), lod.metric);
    std::string text = pageInReason(epsPx, lod.tauPx, lod.hysteresis, epsSymbol(), tauSymbol());
    if (planet.views().size() > 1) text += fmt::format(", view {}", v + 1);
    if (row.urgency == planet::PagingUrgency::Passing) text += ", passing";
    return text;
}

// Draws a link that spans the row, after the block's kind if there are several kinds.
void rowLink(const planet::ChunkId& id, planet::BlockKind kind, const EditorView& view, Commands& commands) {
    const bool tiles = kind != planet::BlockKind::Heights;
    if (hasKinds(view)) cell(kindText(kind), tiles ? palette().accent : palette().text);
    if (!tiles) return chunkCell(id, view, commands, ImGuiSelectableFlags_SpanAllColumns);
    ImGui::TableNextColumn();
    colourLink(id, view, commands, ImGuiSelectableFlags_SpanAllColumns);
}

// Returns the columns of a table of requests, with a kind column before the name column if there are several
// kinds.
std::vector<TableColumn> withKind(const EditorView& view, std::span<const TableColumn> columns,
                                  std::size_t name) {
    std::vector<TableColumn> all(columns.begin(), columns.end());
    if (hasKinds(view))
        all.insert(
            all.begin() + static_cast<std::ptrdiff_t>(name),
            TableColumn{"Kind", 0.9f,
                        "Kind of block: heights of a chunk, colour tiles or normal tiles. Click a tile "
                        "to select the chunk it covers; double-click to look at it.",
                        "heights"});
    return all;
}

// Returns the column's index in a table without kinds; none for the kind column.
std::optional<std::size_t> withoutKind(const EditorView& view, std::size_t column, std::size_t name) {
    if (!hasKinds(view) || column < name) return column;
    return column == name ? std::nullopt : std::optional(column - 1);
}

void kindFilter(const EditorView& view, PagingPanelState& state, bool goesOn = true) {
    if (!hasKinds(view)) return;
    std::vector<planet::BlockKind> kinds = {planet::BlockKind::Heights};
    if (view.planet->colour()) kinds.push_back(planet::BlockKind::Colours);
    if (hasNormals(view)) kinds.push_back(planet::BlockKind::Normals);
    std::string all;
    for (const planet::BlockKind kind : kinds) all += (all.empty() ? "" : ", ") + std::string(kindText(kind));
    const float width = ImGui::CalcTextSize(all.c_str()).x + 2 * ImGui::GetFrameHeight();
    if (goesOn) sameLineIfRoom(width);
    ImGui::SetNextItemWidth(std::min(width, ImGui::GetContentRegionAvail().x));
    std::string names = all + '\0';
    for (const planet::BlockKind kind : kinds) names += kindText(kind) + std::string(1, '\0');
    const auto shown = std::find(kinds.begin(), kinds.end(), state.shownKind);
    int index = shown == kinds.end() ? 0 : static_cast<int>(shown - kinds.begin()) + 1;
    if (combo("Kind", index, names.c_str()))
        state.shownKind =
            index == 0 ? std::nullopt : std::optional(kinds[static_cast<std::size_t>(index - 1)]);
    tooltip("Shows requests and latencies of all kinds of blocks or of one.");
}

void queueFilter(const EditorView& view, PagingPanelState& state) {
    filterBox(state.filter, "requests");
    sameLineIfRoom(checkboxWidth("Load"));
    ImGui::Checkbox("Load", &state.showPageIns);
    tooltip("Load requests, most urgent first; prefetches are last.");
    ImGui::SameLine();
    ImGui::Checkbox("Evict", &state.showPageOuts);
    tooltip(
        "Eviction candidates: unused blocks, least recently used first. They stay resident until their "
        "memory is needed. Tiles are not listed; they are evicted directly when memory is needed.");
    kindFilter(view, state);
    if (view.planet->views().size() < 2) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    int index = state.shownView + 1;
    const std::array<const char*, planet::maxViews + 1> names = {"all views", "view 1", "view 2", "view 3",
                                                                 "view 4"};
    if (ImGui::Combo("##view", &index, names.data(), static_cast<int>(view.planet->views().size()) + 1))
        state.shownView = index - 1;
    tooltip("Shows the requests of one view; each view requests blocks with its own priorities.");
}

// Returns the shown part of the queue, in which page-ins stand before page-outs.
std::span<const PagingRow> shownQueue(const PagingPanelState& state) {
    const std::span<const PagingRow> queue = state.sample.queue;
    const auto firstOut = static_cast<std::size_t>(
        std::partition_point(queue.begin(), queue.end(),
                             [](const PagingRow& row) { return row.type == planet::PagingType::PageIn; }) -
        queue.begin());
    const std::size_t first = state.showPageIns ? 0 : firstOut;
    return queue.subspan(first, (state.showPageOuts ? queue.size() : firstOut) - first);
}

// Returns the rows that also pass the text filter.
std::vector<const PagingRow*> filteredQueue(const EditorView& view, const PagingPanelState& state) {
    std::vector<const PagingRow*> rows;
    for (const PagingRow& row : shownQueue(state)) {
        const auto passesFilter = [&] {
            const double ageS = std::max(view.planet->lastStep().nowS - row.askedAtS, 0.0);
            return passes(state.filter.view(),
                          {planet::toString(row.parent), kindText(row.kind), typeText(row),
                           reason(*view.planet, row, state.shownView, ageS)});
        };
        if (state.filter.empty() || passesFilter()) rows.push_back(&row);
    }
    return rows;
}

const char* emptyQueueText(const EditorView& view, const PagingPanelState& state) {
    if (!state.sample.queue.empty() || state.sample.hidden > 0) return "No requests of this kind.";
    const planet::PagingCounters& p = view.frames.stats.paging;
    if (p.awaitingRetry() > 0)
        return "The queue is empty: missing blocks could not be read and will be retried.";
    if (p.failedPermanently() > 0) return "The queue is empty: missing blocks could not be read.";
    const bool waiting = view.frames.stats.selection.waiting > 0 ||
                         view.planet->views()[0].colours.counters.waiting > 0 ||
                         view.planet->views()[0].normals.counters.waiting > 0;
    return !waiting ? "The queue is empty: all requested blocks are resident." : "The queue is empty.";
}

// widestChunk: must outlive the columns.
std::vector<TableColumn> queueColumns(const EditorView& view, const std::string& widestChunk) {
    const std::array columns = {TableColumn{"Type", 0.8f, nullptr, "prefetch"},
                                TableColumn{"Parent", 1.7f, nullptr, widestChunk.c_str()},
                                TableColumn{"Priority", 0.9f, nullptr, "12.3 M"},
                                TableColumn{"Age", 1.15f, nullptr, "59 min 59 s"},
                                TableColumn{"Reason", 2.4f, nullptr, "unused for 59 min 59 s"}};
    return withKind(view, columns, 1);
}

std::vector<TableColumn> historyColumns(const EditorView& view, const std::string& widestChunk) {
    const std::array columns = {TableColumn{"Outcome", 1.1f, nullptr, "cancelled"},
                                TableColumn{"Parent", 1.7f, nullptr, widestChunk.c_str()},
                                TableColumn{"Waited", 1, nullptr, "99.9 ms"},
                                TableColumn{"Reading", 1, nullptr, "99.9 ms"},
                                TableColumn{"Size", 1, nullptr, "123 KiB"},
                                TableColumn{"Requests", 0.7f},
                                TableColumn{"Finished", 1.2f, nullptr, "59 min 59 s ago"}};
    return withKind(view, columns, 1);
}

void queueTable(const EditorView& view, PagingPanelState& state, Commands& commands) {
    queueFilter(view, state);
    const std::vector<const PagingRow*> queue = filteredQueue(view, state);
    if (queue.empty())
        return emptyState(state.filter.empty() ? emptyQueueText(view, state)
                                               : "No request matches the filter.");
    const HitHighlight highlight(state.filter);
    const std::string chunk = widestChunkName(view);
    if (!beginWideTable("queue", queueColumns(view, chunk))) return;
    const auto ageOf = [&](const PagingRow& row) {
        return std::max(view.planet->lastStep().nowS - row.askedAtS, 0.0);
    };
    const auto key = [&](std::size_t at, std::size_t column) -> SortKey {
        const PagingRow& row = *queue[at];
        const std::optional<std::size_t> plain = withoutKind(view, column, 1);
        if (!plain) return std::string(kindText(row.kind));
        switch (*plain) {
            case 0:
                return std::string(typeText(row));
            case 1:
                return sortKey(row.parent);
            case 2:
                return static_cast<double>(row.priority);
            case 3:
                return ageOf(row);
            default:
                return reason(*view.planet, row, state.shownView, ageOf(row));
        }
    };
    tableRows(queue.size(), key, [&](std::size_t at) {
        const PagingRow& row = *queue[at];
        const double ageS = ageOf(row);
        cell(typeText(row), row.urgency == planet::PagingUrgency::Prefetch ? palette().dim : palette().text);
        rowLink(row.parent, row.kind, view, commands);
        cell(axisText(row.priority));
        cell(latencyText(ageS));
        cell(reason(*view.planet, row, state.shownView, ageS));
    });
    endTable(exportTable<PagingRow>(
        "paging queue", queue.size(), [&](std::size_t row) { return *queue[row]; },
        {{"type", [](const PagingRow& row) { return typeText(row); }, true},
         {"kind", [](const PagingRow& row) { return kindText(row.kind); }, true},
         {"parent", [](const PagingRow& row) { return planet::toString(row.parent); }, true},
         {"priority", [](const PagingRow& row) { return row.priority; }},
         {"age_s", ageOf},
         {"reason",
          [&](const PagingRow& row) { return reason(*view.planet, row, state.shownView, ageOf(row)); }}}));
}

void loadingTable(const EditorView& view, PagingPanelState& state, Commands& commands) {
    std::vector<planet::LoadInProgress> loading = view.planet->inspect().loadingNow();
    const bool any = !loading.empty();
    std::erase_if(loading, [&](const auto& load) { return !isShown(load.kind, state.shownKind); });
    kindFilter(view, state, false);
    if (any && loading.empty()) return emptyState("No block of this kind is being read.");
    if (loading.empty())
        return emptyState(view.pagingPaused ? "Paging is paused." : "No block is being read.");
    const std::string chunk = widestChunkName(view);
    const std::array columns = {
        TableColumn{"Parent", 1.7f, nullptr, chunk.c_str()}, TableColumn{"Priority", 1, nullptr, "12.3 M"},
        TableColumn{"Size", 1, nullptr, "123 KiB"}, TableColumn{"Elapsed", 1, nullptr, "99.9 ms"}};
    const std::vector<TableColumn> shown = withKind(view, columns, 0);
    if (!beginWideTable("loading", shown)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::LoadInProgress& load = loading[row];
        const std::optional<std::size_t> plain = withoutKind(view, column, 0);
        if (!plain) return std::string(kindText(load.kind));
        switch (*plain) {
            case 0:
                return sortKey(load.parent);
            case 1:
                return static_cast<double>(load.priority);
            case 2:
                return static_cast<double>(load.bytes);
            default:
                return load.seconds;
        }
    };
    tableRows(loading.size(), key, [&](std::size_t row) {
        rowLink(loading[row].parent, loading[row].kind, view, commands);
        cell(axisText(loading[row].priority));
        cell(bytesText(loading[row].bytes));
        cell(latencyText(loading[row].seconds));
    });
    using Load = planet::LoadInProgress;
    endTable(
        exportTable<Load>("paging loading", loading.size(), [&](std::size_t row) { return loading[row]; },
                          {{"kind", [](const Load& load) { return kindText(load.kind); }, true},
                           {"parent", [](const Load& load) { return planet::toString(load.parent); }, true},
                           {"priority", [](const Load& load) { return load.priority; }},
                           {"size_bytes", [](const Load& load) { return load.bytes; }},
                           {"elapsed_s", [](const Load& load) { return load.seconds; }}}));
}

struct OutcomeLook {
    const char* name;
    const ImVec4& colour;
};
OutcomeLook lookOf(planet::PagingOutcome outcome) {
    switch (outcome) {
        case planet::PagingOutcome::Loaded:
            return {"loaded", palette().good};
        case planet::PagingOutcome::Failed:
            return {"failed", palette().bad};
        case planet::PagingOutcome::Evicted:
            return {"evicted", palette().warning};
        case planet::PagingOutcome::Cancelled:
            return {"cancelled", palette().dim};
    }
    return {"", palette().text};
}

bool isShown(const planet::PagingEvent& event, const PagingPanelState& state) {
    if (state.onlyMerged && event.timesAsked < 2) return false;
    if (!isShown(event.kind, state.shownKind)) return false;
    if (!state.filter.empty() &&
        !passes(state.filter.view(),
                {planet::toString(event.parent), kindText(event.kind), lookOf(event.outcome).name}))
        return false;
    switch (event.outcome) {
        case planet::PagingOutcome::Loaded:
            return state.showLoaded;
        case planet::PagingOutcome::Failed:
            return state.showFailed;
        case planet::PagingOutcome::Evicted:
            return state.showEvicted;
        case planet::PagingOutcome::Cancelled:
            return state.showCancelled;
    }
    return true;
}

void historyFilter(const EditorView& view, PagingPanelState& state) {
    filterBox(state.filter, "requests");
    sameLineIfRoom(checkboxWidth("Loaded"));
    ImGui::Checkbox("Loaded", &state.showLoaded);
    tooltip("Blocks read and made resident.");
    sameLineIfRoom(checkboxWidth("Failed"));
    ImGui::Checkbox("Failed", &state.showFailed);
    tooltip("Blocks that could not be read.");
    sameLineIfRoom(checkboxWidth("Cancelled"));
    ImGui::Checkbox("Cancelled", &state.showCancelled);
    tooltip("Requests cancelled before a loader took them.");
    sameLineIfRoom(checkboxWidth("Evicted"));
    ImGui::Checkbox("Evicted", &state.showEvicted);
    tooltip("Blocks evicted to stay within the budget.");
    sameLineIfRoom(checkboxWidth("Merged only"));
    ImGui::Checkbox("Merged only", &state.onlyMerged);
    tooltip("Shows only blocks requested more than once.");
    kindFilter(view, state);
}

void historyRow(const EditorView& view, const planet::PagingEvent& event, Commands& commands) {
    const OutcomeLook look = lookOf(event.outcome);
    const bool read = event.outcome == planet::PagingOutcome::Loaded;
    cell(look.name, look.colour);
    rowLink(event.parent, event.kind, view, commands);
    cell(latencyText(event.waitedS));
    cell(read ? latencyText(event.readS) : "");
    cell(read ? bytesText(event.bytes) : "");
    cell(fmt::format("{}x", event.timesAsked));
    cell(fmt::format("{} ago", latencyText(std::max(view.planet->lastStep().nowS - event.atS, 0.0))));
}

void historyTable(const EditorView& view, PagingPanelState& state, Commands& commands) {
    historyFilter(view, state);
    const std::deque<planet::PagingEvent>& history = view.planet->inspect().pagingHistory();
    std::vector<const planet::PagingEvent*> shown;
    shown.reserve(history.size());
    for (auto event = history.rbegin(); event != history.rend(); ++event)
        if (isShown(*event, state)) shown.push_back(&*event);
    if (shown.empty())
        return emptyState(history.empty() ? "No request has finished yet." : "No requests of this kind.");
    const HitHighlight highlight(state.filter);
    const std::string chunk = widestChunkName(view);
    if (!beginWideTable("history", historyColumns(view, chunk))) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::PagingEvent& event = *shown[row];
        const std::optional<std::size_t> plain = withoutKind(view, column, 1);
        if (!plain) return std::string(kindText(event.kind));
        switch (*plain) {
            case 0:
                return std::string(lookOf(event.outcome).name);
            case 1:
                return sortKey(event.parent);
            case 2:
                return event.waitedS;
            case 3:
                return event.readS;
            case 4:
                return static_cast<double>(event.bytes);
            case 5:
                return static_cast<double>(event.timesAsked);
            default:
                return -event.atS;
        }
    };
    tableRows(shown.size(), key, [&](std::size_t row) { historyRow(view, *shown[row], commands); });
    using Event = planet::PagingEvent;
    const auto wasRead = [](const Event& event) { return event.outcome == planet::PagingOutcome::Loaded; };
    endTable(exportTable<Event>(
        "paging history", shown.size(), [&](std::size_t row) { return *shown[row]; },
        {{"outcome", [](const Event& event) { return lookOf(event.outcome).name; }},
         {"kind", [](const Event& event) { return kindText(event.kind); }, true},
         {"parent", [](const Event& event) { return planet::toString(event.parent); }, true},
         {"waited_s", [](const Event& event) { return event.waitedS; }},
         {"reading_s",
          [=](const Event& event) { return wasRead(event) ? ExportCell(event.readS) : ExportCell(); }},
         {"size_bytes",
          [=](const Event& event) { return wasRead(event) ? ExportCell(event.bytes) : ExportCell(); }},
         {"requests", [](const Event& event) { return event.timesAsked; }},
         {"prefetch", [](const Event& event) { return event.isPrefetch ? "yes" : "no"; }, true},
         {"finished_at_s", [](const Event& event) { return event.atS; }, true}}));
}

// Plots.

void latencyHistogram(PagingPanelState& state, float lines) {
    const PagingPanelState::Sample& sample = state.sample;
    int index = state.latencyOfReading ? 1 : 0;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::Combo("##latency", &index, "total latency\0read latency\0"))
        state.latencyOfReading = index == 1;
    tooltip(
        "Total latency: from the first request of a block until it is loaded. Read latency: reading and "
        "decoding it, including injected delays.");
    std::vector<HistogramMark> marks;
    if (sample.latencies > 0) {
        marks.push_back({logarithmicPosition(static_cast<double>(sample.medianS), fastestS, slowestS),
                         "median " + latencyText(static_cast<double>(sample.medianS))});
        marks.push_back({logarithmicPosition(static_cast<double>(sample.slowestS), fastestS, slowestS),
                         "99 % " + latencyText(static_cast<double>(sample.slowestS))});
    }
    histogram("latencies", sample.latencyCounts, latencyText(fastestS), latencyText(slowestS), marks, lines,
              [](double position) { return latencyText(logarithmicValue(position, fastestS, slowestS)); });
}

void plots(const EditorView& view, PagingPanelState& state, bool wide) {
    // The other lines are two legends, the choice of a latency, and the histogram's axis.
    const float lines = wide ? linesThatFit(3, 5.6f, 8) : 2.5f;
    const std::vector<float> times = historyTimes(view.frames.history);
    const std::array queue = {
        Series{"queued", seriesColour(0),
               historyValues(view.frames.history, [](const FrameStats& s) { return s.paging.queued; })},
        Series{"loading", seriesColour(1),
               historyValues(view.frames.history, [](const FrameStats& s) { return s.paging.loading; })}};
    linePlot("queue length", times, queue, "", 0, lines);
    constexpr double windowS = 0.5;
    const auto read = historyValues<double>(view.frames.history, [](const FrameStats& s) {
        return static_cast<double>(s.paging.bytesRead()) / 1e6;
    });
    std::vector<Series> rate = {Series{"read", seriesColour(2), growthPerS(times, read, windowS)}};
    if (view.planet->colour()) {
        const auto colours = historyValues<double>(view.frames.history, [](const FrameStats& s) {
            return static_cast<double>(s.paging[planet::BlockKind::Colours].bytesRead) / 1e6;
        });
        rate.push_back({"colours", seriesColour(3), growthPerS(times, colours, windowS)});
    }
    if (hasNormals(view)) {
        const auto normals = historyValues<double>(view.frames.history, [](const FrameStats& s) {
            return static_cast<double>(s.paging[planet::BlockKind::Normals].bytesRead) / 1e6;
        });
        rate.push_back({"normals", seriesColour(4), growthPerS(times, normals, windowS)});
    }
    const planet::PrefetchCounters prefetch = view.frames.stats.paging.prefetch();
    if (prefetch.bytes > 0) {
        const auto early = historyValues<double>(view.frames.history, [](const FrameStats& s) {
            return static_cast<double>(s.paging.prefetch().bytes) / 1e6;
        });
        rate.push_back({"prefetched", seriesColour(5), growthPerS(times, early, windowS)});
    }
    linePlot("read rate", times, rate, "MB/s", 0, lines);
    latencyHistogram(state, lines);
}

void pagingControls(const EditorView& view, const SettingControls& control, ViewSettings& settings,
                    Commands& commands) {
    residentMemory(view);
    buttons(view, commands);
    settingControls(control, settings.paging, view.planet->colour().has_value());
}

// Draws the tab of failed blocks; its title shows their number.
void failedTab(const EditorView& view, PagingPanelState& state, Commands& commands) {
    const planet::PagingCounters& p = view.frames.stats.paging;
    const std::uint32_t failed = p.failedPermanently() + p.awaitingRetry();
    const ImVec4 colour = p.failedPermanently() > 0 ? palette().bad : palette().warning;
    if (failed > 0) ImGui::PushStyleColor(ImGuiCol_Text, colour);
    const bool open = ImGui::BeginTabItem(fmt::format("Failed {}###failed", failed).c_str());
    if (failed > 0) ImGui::PopStyleColor();
    noteItem("Failed blocks");
    tooltip("Blocks that could not be read: those that will be retried, and those that failed permanently.");
    state.failedShown = open;
    if (!open) return;
    failedTable(view, state.sample.failed, state.filter, commands);
    ImGui::EndTabItem();
}

void tables(const EditorView& view, PagingPanelState& state, Commands& commands) {
    if (!ImGui::BeginTabBar("tables")) return;
    const planet::PagingCounters& p = view.frames.stats.paging;
    // The title counts what is to be loaded, as the status bar and the plot do, and then the prefetches.
    const std::size_t prefetches = state.sample.prefetches;
    const std::string queue = fmt::format("Queue {}{}###queue", state.sample.loads,
                                          prefetches > 0 ? fmt::format(" + {}", prefetches) : std::string());
    if (ImGui::BeginTabItem(queue.c_str())) {
        queueTable(view, state, commands);
        ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem(fmt::format("Loading {}###loading", p.loading).c_str())) {
        loadingTable(view, state, commands);
        ImGui::EndTabItem();
    }
    failedTab(view, state, commands);
    if (ImGui::BeginTabItem("History")) {
        historyTable(view, state, commands);
        ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem("Totals")) {
        totals(view);
        ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
}

}  // namespace

void pagingPanel(const EditorView& view, PagingPanelState& state, ViewSettings& settings,
                 Commands& commands) {
    const SettingControls control(settings);
    if (!view.planet) {
        settingControls(control, settings.paging, false);
        prefetchSection(control, settings.paging, {});
        badDisk(control, settings.paging);
        return emptyState("No planet is open. Open one to see its paging requests.");
    }
    refresh(view, state);
    const bool wide = hasWideRoom();
    constexpr float tableLines = 13;
    const float font = ImGui::GetFontSize();
    const std::string chunk = widestChunkName(view);
    const float widestTable =
        std::max(listTableWidth(queueColumns(view, chunk)), listTableWidth(historyColumns(view, chunk)));
    const std::array columns = {Column{.title = "Paging",
                                       .share = 1.2f,
                                       .draw =
                                           [&] {
                                               pagingControls(view, control, settings, commands);
                                               if (section("Prefetch"))
                                                   prefetchSection(control, settings.paging,
                                                                   view.frames.stats.paging.prefetch());
                                               if (wide && section("I/O fault injection"))
                                                   badDisk(control, settings.paging);
                                           },
                                       .wanted = 17 * font},
                                Column{.title = "Requests",
                                       .share = 2,
                                       .stackedLines = tableLines,
                                       .draw = [&] { tables(view, state, commands); },
                                       .wanted = widestTable},
                                Column{.title = "Plots",
                                       .share = 0.95f,
                                       .draw = [&] { plots(view, state, wide); },
                                       .wanted = 13 * font}};
    drawColumns("paging", columns);
    if (!wide && section("I/O fault injection")) badDisk(control, settings.paging);
}

}  // namespace worldy::ui
