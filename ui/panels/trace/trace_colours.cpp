#include "ui/panels/trace/trace_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "app/scene/overlay_colours.h"
#include "ui/model/explanation_text.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

using planet::ChunkState;

constexpr std::size_t mostLevels = 32;  // in a legend; a hostile trace can have any

// Returns the state of a chunk that has the same meaning, so that the same colours mean the same everywhere.
ChunkState stateOf(const TracedNode& node) {
    switch (node.place) {
        case TracedPlace::Drawn:
            return ChunkState::Drawn;
        case TracedPlace::Split:
            return ChunkState::Split;
        case TracedPlace::Culled:
            return node.culling == planet::TraceCulling::ByHorizon ? ChunkState::CulledHorizon
                                                                   : ChunkState::CulledFrustum;
        case TracedPlace::Unseen:
        case TracedPlace::Below:
            break;
    }
    if (node.isResident) return ChunkState::Resident;
    constexpr std::array states = {ChunkState::NotResident, ChunkState::Requested, ChunkState::Loading,
                                   ChunkState::Resident, ChunkState::Failed};
    return states[static_cast<std::size_t>(node.data.data)];
}

}  // namespace

glm::vec3 traceColour(TraceColouring by, const TracedNode& node, double tauPx) {
    switch (by) {
        case TraceColouring::State:
            return stateColour(stateOf(node));
        case TraceColouring::Level:
            return levelColour(static_cast<int>(node.node.level));
        case TraceColouring::Error: {
            const double share = node.errorPx / tauPx;
            return std::isnan(share) ? unmeasuredColour : errorColour(share);
        }
        case TraceColouring::Morph:
            return node.place == TracedPlace::Drawn ? rampColour(static_cast<double>(node.morph))
                                                    : unmeasuredColour;
    }
    return unmeasuredColour;
}

Legend traceLegend(TraceColouring by, const TracedView& view) {
    Legend legend;
    const auto add = [&](const glm::vec3& colour, std::string label) {
        legend.entries.push_back({colour, std::move(label)});
    };
    if (by == TraceColouring::State) {
        for (const ChunkState state : {ChunkState::Drawn, ChunkState::Split, ChunkState::CulledFrustum,
                                       ChunkState::CulledHorizon, ChunkState::Resident, ChunkState::Requested,
                                       ChunkState::Loading, ChunkState::NotResident, ChunkState::Failed})
            add(stateColour(state), stateText(state));
    } else if (by == TraceColouring::Level) {
        std::set<std::uint32_t> levels;
        for (const TracedNode& node : view.nodes)
            if (node.place == TracedPlace::Drawn) levels.insert(node.node.level);
        for (const std::uint32_t level : levels)
            if (legend.entries.size() < mostLevels)
                add(levelColour(static_cast<int>(level)), fmt::format("{}", level));
    } else if (by == TraceColouring::Error) {
        for (const double share : {0.0, 0.5, 1.0, 1.5, 2.0}) {
            const std::string label = std::isnan(view.tauPx) ? fmt::format("{:g} {}", share, tauSymbol())
                                                             : fmt::format("{:.3g} px", share * view.tauPx);
            add(errorColour(share), share == 2 ? label + " or more" : label);
        }
        add(unmeasuredColour, "unknown");
    } else {
        for (const double share : {0.0, 0.5, 1.0}) add(rampColour(share), fmt::format("{:g}", share));
    }
    for (const TraceMark mark : {TraceMark::Twice, TraceMark::Starved, TraceMark::Switched}) {
        const bool isSeen = std::ranges::any_of(
            view.nodes, [&](const TracedNode& node) { return traceMark(node, view.tauPx) == mark; });
        if (isSeen) add(markColour(mark), markText(mark));
    }
    return legend;
}

TraceMark traceMark(const TracedNode& node, double tauPx) {
    if (node.isTwice) return TraceMark::Twice;
    if (node.isStarved(tauPx)) return TraceMark::Starved;
    return node.isSwitched ? TraceMark::Switched : TraceMark::None;
}

glm::vec3 markColour(TraceMark mark) {
    constexpr std::array<glm::vec3, 4> colours = {glm::vec3(0), glm::vec3(1, 0.2f, 1),
                                                  glm::vec3(1, 0.35f, 0.25f), glm::vec3(1)};
    return colours[static_cast<std::size_t>(mark)];
}

const char* markText(TraceMark mark) {
    constexpr std::array texts = {"", "frame: drawn twice", "frame: waits for data", "frame: switched now"};
    return texts[static_cast<std::size_t>(mark)];
}

}  // namespace worldy::ui
