#include "app/trace/traced_reasons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "app/base/text.h"
#include "planet/trace/trace_quadtree.h"

namespace worldy {

namespace {

using planet::TraceData;

// Finds what the sentences compare.
struct Reasons {
    const TracedFrame& frame;
    const TracedView& view;
    const TracedNode& node;
    std::vector<std::string> sentences{};

    std::string name(const TracedNode& of) const { return tracedName(frame.description, of.node.id); }
    const TracedNode* byIndex(planet::TraceNodeIndex index) const {
        const auto found = std::ranges::find(view.nodes, index, &TracedNode::index);
        return found == view.nodes.end() ? nullptr : &*found;
    }
    double mergePx() const { return view.tauPx * (1 - view.hysteresis); }
    template <class... Args>
    void say(fmt::format_string<Args...> format, Args&&... args) {
        sentences.push_back(fmt::format(format, std::forward<Args>(args)...));
    }
};

std::string px(double pixels) {
    return fmt::format("{:.2f} px", pixels);
}

const char* tau() {
    return "τ";
}

// The children of a node that should be split, but whose data is missing.
void sayMissing(Reasons& why) {
    std::array<std::uint32_t, 5> counts{};
    for (const TracedNode& child : why.view.nodes) {
        if (child.parent == why.node.index && !child.isResident)
            ++counts[static_cast<std::size_t>(child.data.data)];
    }
    std::string parts;
    constexpr std::array states = {TraceData::Requested, TraceData::Started, TraceData::Failed,
                                   TraceData::Absent};
    for (const TraceData state : states) {
        const std::uint32_t count = counts[static_cast<std::size_t>(state)];
        if (count == 0) continue;
        const char* const text = state == TraceData::Absent ? "not requested" : tracedDataText(state);
        parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", count, text);
    }
    why.say("It waits for data: {} of its {} children are not there ({}).", why.node.missingChildren,
            why.node.children, parts.empty() ? "their state is not known" : parts);
}

void sayCoarse(Reasons& why) {
    if (why.node.children == 0)
        return why.say(
            "The engine described no children of it: it is a leaf, or what is below is not known yet.");
    if (why.node.missingChildren > 0) return sayMissing(why);
    const auto maxLevel = why.frame.settings.find("max_level");
    if (maxLevel != why.frame.settings.end()) {
        const double* const level = std::get_if<double>(&maxLevel->second);
        if (level && static_cast<double>(why.node.node.level) >= *level)
            return why.say("Its level is the deepest one that the engine allows: max_level is {:g}.", *level);
    }
    why.say(
        "The data of all its {} children is there, so by its own numbers the engine should split it. A fade, "
        "a neighbour, a budget or another rule may hold it back; if not, this is a fault of its selection.",
        why.node.children);
}

void sayDrawn(Reasons& why) {
    const TracedNode& node = why.node;
    if (node.isTwice)
        why.say("An ancestor of it is drawn in the same frame, so the same place is drawn twice.");
    if (std::isnan(node.errorPx))
        return why.say("Its error on screen is not known: the engine told no error, bounds or view.");
    if (std::isnan(why.view.tauPx))
        return why.say(
            "Its error is {}. The engine told no setting \"tau\", so whether that is enough is not known.",
            px(node.errorPx));
    if (node.errorPx <= why.view.tauPx)
        why.say("It is fine enough: its error of {} does not exceed {} = {}.", px(node.errorPx), tau(),
                px(why.view.tauPx));
    else
        why.say("It is too coarse: its error of {} exceeds {} = {}.", px(node.errorPx), tau(),
                px(why.view.tauPx));
    if (node.errorPx > why.view.tauPx) sayCoarse(why);
}

// Why the parent of a node that is not coarser is not drawn instead.
void sayParent(Reasons& why) {
    const TracedNode* const parent = why.byIndex(why.node.parent);
    if (!parent || parent->place != TracedPlace::Split || std::isnan(parent->errorPx) ||
        std::isnan(why.view.tauPx))
        return;
    const std::string name = why.name(*parent);
    if (parent->errorPx > why.view.tauPx)
        why.say("Its parent {} would not do: its error of {} exceeds {}.", name, px(parent->errorPx), tau());
    else if (parent->errorPx > why.mergePx())
        why.say("Its parent {} stays split by hysteresis: its error of {} is between {} (1 - h) = {} and {}.",
                name, px(parent->errorPx), tau(), px(why.mergePx()), tau());
    else
        why.say(
            "By its numbers the parent {} would do: its error of {} is at most {}. A fade, a neighbour or "
            "another rule may keep it split; if not, the engine draws more than it needs.",
            name, px(parent->errorPx), px(why.mergePx()));
}

// Names the coarsest drawn neighbour on the node's own face, and says what hides the gap between them.
void sayNeighbour(Reasons& why) {
    if (why.frame.description.value_or(planet::TraceDescription{}).ids != planet::TraceIds::Quadtree) return;
    const planet::TraceQuadtreePlace place = planet::traceQuadtreePlace(why.node.node.id);
    const TracedNode* coarsest = nullptr;
    std::uint32_t coarsestLevel = place.level;
    for (const planet::Edge edge : planet::allEdges) {
        std::optional<planet::TraceQuadtreePlace> beyond = planet::tracePlaceBeyond(place, edge, false);
        while (beyond && beyond->level > 0) {
            beyond = {beyond->face, beyond->level - 1, beyond->x / 2, beyond->y / 2};
            const std::uint32_t up = place.level - beyond->level;
            if (beyond->x == place.x >> up && beyond->y == place.y >> up) break;  // its own ancestor
            const TracedNode* const beside = why.view.find(planet::traceQuadtreeId(*beyond));
            if (!beside || beside->place != TracedPlace::Drawn || beyond->level >= coarsestLevel) continue;
            coarsest = beside;
            coarsestLevel = beyond->level;
        }
    }
    if (!coarsest) return;
    const std::uint32_t steps = place.level - coarsestLevel;
    const auto setting = why.frame.settings.find("skirts");
    const double* const skirts =
        setting == why.frame.settings.end() ? nullptr : std::get_if<double>(&setting->second);
    why.say("Its neighbour {} is {} {} coarser, so their edges differ{}", why.name(*coarsest), steps,
            steps == 1 ? "level" : "levels",
            !skirts        ? ". The engine told no setting \"skirts\"."
            : *skirts != 0 ? ": the engine's skirts hide the gap (skirts is on)."
                           : " and a crack may show: the engine draws no skirts (skirts is off).");
}

void saySplit(Reasons& why) {
    const double errorPx = why.node.errorPx;
    if (std::isnan(errorPx)) return why.say("It is split. Its error on screen is not known.");
    if (std::isnan(why.view.tauPx)) return why.say("It is split. Its error is {}.", px(errorPx));
    if (errorPx > why.view.tauPx)
        why.say("It is split because its error of {} exceeds {} = {}.", px(errorPx), tau(),
                px(why.view.tauPx));
    else if (errorPx > why.mergePx())
        why.say("It stays split by hysteresis: its error of {} is between {} (1 - h) = {} and {} = {}.",
                px(errorPx), tau(), px(why.mergePx()), tau(), px(why.view.tauPx));
    else
        why.say(
            "By its numbers it would do: its error of {} is at most {}. A fade, a neighbour or another rule "
            "may keep it split; if not, the engine draws more than it needs.",
            px(errorPx), px(why.mergePx()));
}

void sayBelow(Reasons& why) {
    const TracedNode* const parent = why.byIndex(why.node.parent);
    if (!parent) return;
    why.say("It is not needed: its parent {} is drawn.", why.name(*parent));
    if (parent->errorPx > why.view.tauPx)
        why.say("The parent's error of {} exceeds {} = {}, so the engine wants to split it.",
                px(parent->errorPx), tau(), px(why.view.tauPx));
}

void sayUnseen(Reasons& why) {
    why.say(
        "Its parent is split, but the engine neither drew it nor said that it is culled. It is outside the "
        "view, or a hole: the faults list those that are visible.");
}

// Says how the error on screen is computed.
void sayError(Reasons& why) {
    const TracedNode& node = why.node;
    if (std::isnan(node.errorPx)) return;
    if (node.isErrorTold) why.say("The engine told the error on screen itself.");
    const planet::TraceDescription description = why.frame.description.value_or(planet::TraceDescription{});
    if (!why.view.info || description.error == planet::TraceErrorUnit::Pixels) return;
    const planet::TraceView& camera = *why.view.info;
    const double distance = planet::traceDistance(node.node.bounds, camera.eye);
    if (std::isnan(distance)) return;
    const double scalePx = std::abs(camera.projection[0][0]) * camera.width / 2;
    why.say("By its bounds: error K' / D = {} · {:.0f} px / {} = {}.",
            tracedLengthText(node.node.error, why.frame.description), scalePx,
            tracedLengthText(distance, why.frame.description),
            px(planet::traceErrorPx(description, node.node, camera)));
}

void sayData(Reasons& why) {
    const planet::TraceDataState& data = why.node.data;
    if (data.data == TraceData::Requested || data.data == TraceData::Started) {
        const std::uint64_t nowNs =
            why.frame.frame.endNs != 0 ? why.frame.frame.endNs : why.frame.frame.beginNs;
        const double ageMs = static_cast<double>(static_cast<std::int64_t>(nowNs - data.requestedNs)) * 1e-6;
        if (data.requestedNs != 0)
            why.say("Its data is {} since {}.", tracedDataText(data.data),
                    millisecondsText(std::max(ageMs, 0.0)));
    } else if (data.data == TraceData::Failed) {
        why.say("Loading its data has failed.");
    }
}

}  // namespace

std::vector<std::string> tracedReasons(const TracedFrame& frame, const TracedView& view,
                                       const TracedNode& node) {
    Reasons why{frame, view, node};
    switch (node.place) {
        case TracedPlace::Drawn:
            sayDrawn(why);
            sayParent(why);
            sayNeighbour(why);
            break;
        case TracedPlace::Split:
            saySplit(why);
            break;
        case TracedPlace::Culled:
            why.say("It is {}, and nothing of it is drawn.", tracedPlaceText(node));
            break;
        case TracedPlace::Unseen:
            sayUnseen(why);
            break;
        case TracedPlace::Below:
            sayBelow(why);
            break;
    }
    if (node.place == TracedPlace::Drawn && node.morph > 0)
        why.say("It is morphed by {:.0f} % towards its parent's surface.",
                100 * static_cast<double>(node.morph));
    sayError(why);
    sayData(why);
    return why.sentences;
}

std::string tracedLengthText(double units, const std::optional<planet::TraceDescription>& description) {
    const double metres = units * (description ? description->metresPerUnit : 1);
    return std::abs(metres) < 10'000 ? fmt::format("{:.4g} m", metres)
                                     : fmt::format("{:.4g} km", metres / 1000);
}

std::string tracedPlaceText(const TracedNode& node) {
    constexpr std::array cullings = {"culled by the frustum", "culled by the horizon", "culled by occlusion",
                                     "culled"};
    switch (node.place) {
        case TracedPlace::Drawn:
            return "drawn";
        case TracedPlace::Split:
            return "split";
        case TracedPlace::Culled:
            return cullings[static_cast<std::size_t>(node.culling)];
        case TracedPlace::Unseen:
            return "not drawn";
        case TracedPlace::Below:
            return "below a drawn node";
    }
    return "";
}

const char* tracedDataText(TraceData data) {
    constexpr std::array texts = {"absent", "requested", "being loaded", "resident", "failed"};
    return texts[static_cast<std::size_t>(data)];
}

}  // namespace worldy
