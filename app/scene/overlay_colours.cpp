#include "app/scene/overlay_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/packing.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <optional>
#include <span>

namespace worldy {

namespace {

// Adjacent levels differ in hue. After twelve levels the series repeats in lighter colours.
constexpr std::array<std::uint32_t, 12> hues = {0x3D6BE0, 0xFF9A1F, 0x1FA34A, 0xE0332B, 0x9B3FD1, 0xF2D024,
                                                0x12A5C9, 0xE64C93, 0x7CC21A, 0x95602E, 0x1BB89A, 0x6A6F7A};

// A ramp of even lightness steps that people with red-green colour blindness can read: viridis with a bluer
// dark end.
constexpr std::array<std::uint32_t, 6> rampColours = {0x1B1F6B, 0x30508F, 0x21898C,
                                                      0x3DBB75, 0xA6DB3A, 0xFDF3A0};

// From blue over a dark grey, which recedes where nothing has changed, to orange; also for red-green colour blindness.
constexpr std::array<std::uint32_t, 5> changeColours = {0x8CCBFF, 0x2C78C4, 0x35383C, 0xC25A12, 0xFFB066};

// In the order of planet::ChunkState.
constexpr std::array<std::uint32_t, 10> stateColours = {0x3FB65F, 0x246B43, 0x5C6B80, 0x75609A, 0x3478BD,
                                                        0xEDC238, 0xFA8522, 0x80858C, 0xE03A32, 0x4A4D52};

glm::vec3 fromHex(std::uint32_t hex) {
    const auto channel = [&](int shift) { return static_cast<float>((hex >> shift) & 0xFFu) / 255.0f; };
    return {channel(16), channel(8), channel(0)};
}

glm::vec3 colourAlong(std::span<const std::uint32_t> colours, double share) {
    const double along = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(along), colours.size() - 2);
    return glm::mix(fromHex(colours[below]), fromHex(colours[below + 1]),
                    static_cast<float>(along - static_cast<double>(below)));
}

// Returns the newest load order among the drawn chunks, at least 1.
double newestLoad(const planet::ChunkTree& tree, const planet::Selection& selection) {
    std::uint32_t newest = 1;
    for (const planet::DrawItem& item : selection.draw) {
        if (item.node < tree.nodes.size()) newest = std::max(newest, tree.nodes[item.node].loadOrder);
    }
    return newest;
}

struct TintScale {
    const OverlaySettings& overlay;
    double tauPx;
    double nowS;
    double newestLoad;
    const planet::ChunkTree& tree;
    const TintData& data;
};

glm::vec3 measuredColour(const planet::ChunkId& id, const TintScale& scale) {
    const ErrorMeasurement* const measured = scale.data.measured;
    if (!measured) return unmeasuredColour;
    const auto found = measured->indexOf.find(id);
    if (found == measured->indexOf.end()) return unmeasuredColour;
    const double px = measured->report.chunks[found->second].facingPx;
    return errorColour(px / (measured->tauPx * scale.overlay.errorScale));
}

glm::vec3 leafColour(const planet::DrawItem& item, const planet::ChunkNode& node, const TintScale& scale) {
    const bool isLeaf = node.childrenState == planet::ChildrenState::None;
    if (!scale.data.depths && !isLeaf) return unmeasuredColour;
    const int level = isLeaf ? item.id.level : deepestLeaf(*scale.data.depths, item.id, false);
    if (scale.overlay.colourBy == ColourBy::LeafDepth) return levelColour(level);
    return rampColour(spacingShare(level, planet::deepestLevelOf(scale.tree.shape)));
}

glm::vec3 sourceColour(const planet::ChunkId& id, const TintScale& scale) {
    if (!scale.data.tops) return unmeasuredColour;
    const auto found = scale.data.tops->find(id);
    if (found == scale.data.tops->end()) return unmeasuredColour;
    return found->second ? layerColour(*found->second) : noLayerColour;
}

glm::vec3 tintOf(const planet::DrawItem& item, const planet::ChunkNode& node, const TintScale& scale) {
    switch (scale.overlay.colourBy) {
        case ColourBy::Level:
            return levelColour(item.id.level);
        case ColourBy::Error:
            return errorColour(static_cast<double>(item.epsPx) / (scale.tauPx * scale.overlay.errorScale));
        case ColourBy::DeltaC:
            return rampColour(deltaShare(static_cast<double>(item.deltaCM), scale.overlay.deltaTopM));
        case ColourBy::Morph:
            return rampColour(static_cast<double>(item.morph));
        case ColourBy::Age:
            return rampColour(ageShare(scale.nowS - node.loadedAtS, scale.overlay.ageTopS));
        case ColourBy::LoadOrder:
            return rampColour(node.loadOrder / scale.newestLoad);
        case ColourBy::Measured:
            return measuredColour(item.id, scale);
        case ColourBy::LeafDepth:
        case ColourBy::Spacing:
            return leafColour(item, node, scale);
        case ColourBy::Source:
            return sourceColour(item.id, scale);
        case ColourBy::Region:
            return demandColour(scale.tree, node.demand);
        case ColourBy::Atlas:
            return atlasColour(scale.data.atlas, item.id);
        case ColourBy::None:
            break;
    }
    return {0, 0, 0};
}

}  // namespace

std::uint32_t packedColour(const glm::vec3& colour) {
    return glm::packUnorm4x8(glm::vec4(colour, 1));
}

std::array<std::uint8_t, 4> colourBytes(const glm::vec3& colour, std::uint8_t opacity) {
    const std::uint32_t packed = packedColour(colour);
    return {static_cast<std::uint8_t>(packed), static_cast<std::uint8_t>(packed >> 8),
            static_cast<std::uint8_t>(packed >> 16), opacity};
}

glm::vec3 levelColour(int level) {
    const auto index = static_cast<std::size_t>(std::max(level, 0));
    const glm::vec3 colour = fromHex(hues[index % hues.size()]);
    if (index < hues.size()) return colour;
    // More would make neighbouring levels look alike.
    constexpr float share = 0.25f;
    return glm::mix(colour, glm::vec3(index < 2 * hues.size() ? 1 : 0), share);
}

glm::vec3 errorColour(double epsOverTau) {
    const glm::vec3 green(0.16f, 0.66f, 0.26f);
    const glm::vec3 yellow(0.97f, 0.83f, 0.15f);
    const glm::vec3 red(0.86f, 0.14f, 0.12f);
    const auto t = static_cast<float>(std::clamp(epsOverTau, 0.0, 2.0));
    return t < 1 ? glm::mix(green, yellow, t) : glm::mix(yellow, red, t - 1);
}

glm::vec3 rampColour(double share) {
    return colourAlong(rampColours, share);
}

glm::vec3 changeColour(double share) {
    return colourAlong(changeColours, share);
}

glm::vec3 stateColour(planet::ChunkState state) {
    return fromHex(stateColours[static_cast<std::size_t>(state)]);
}

double deltaShare(double deltaCM, double topM) {
    if (!(deltaCM > 0)) return 0;
    return std::clamp(1 + std::log10(deltaCM / topM) / deltaDecades, 0.0, 1.0);
}

double ageShare(double ageS, double topS) {
    return std::clamp(1 - ageS / topS, 0.0, 1.0);
}

double spacingShare(int leafLevel, int deepestLevel) {
    return deepestLevel > 0 ? static_cast<double>(leafLevel) / deepestLevel : 1;
}

double leafSpacingM(const planet::PlanetShape& shape, double level) {
    return std::numbers::pi / 2 * shape.radiusM / (planet::chunkCells(shape) * std::exp2(level));
}

glm::vec3 layerColour(std::size_t layer) {
    return levelColour(static_cast<int>(layer));
}

glm::vec3 regionColour(std::size_t region) {
    // The first colour of levels, blue, would be lost on the sea.
    return levelColour(static_cast<int>(region % (hues.size() - 1)) + 1);
}

glm::vec3 demandColour(const planet::ChunkTree& tree, const planet::ChunkDemand& demand) {
    if (demand.region == planet::noRegion || !tree.regions) return noRegionColour;
    const planet::Region& region = tree.regions->regions()[demand.region];
    const double own = std::log2(region.tauFactor.value_or(1));
    const double share =
        own == 0 ? 1 : std::clamp(std::log2(static_cast<double>(demand.tauFactor)) / own, 0.25, 1.0);
    return glm::mix(noRegionColour, regionColour(demand.region), static_cast<float>(share));
}

glm::vec3 drapeColour(const AtlasDrape& drape, double value) {
    if (std::isinf(value)) return value > 0 ? unboundedColour : gainedColour;
    return drape.isChange ? changeColour(shareOf(drape, value)) : rampColour(shareOf(drape, value));
}

glm::vec3 atlasColour(const AtlasDrape* atlas, const planet::ChunkId& chunk) {
    const std::optional<double> value = atlas ? valueAt(*atlas, chunk) : std::nullopt;
    return value ? drapeColour(*atlas, *value) : unmeasuredColour;
}

std::vector<planet::gl::ChunkTint> chunkTints(const planet::Planet& planet,
                                              const planet::Selection& selection,
                                              const OverlaySettings& overlay, double tauPx,
                                              const TintData& data) {
    if (overlay.colourBy == ColourBy::None) return {};
    const planet::ChunkTree& tree = planet.tree();
    const TintScale scale{overlay, tauPx, planet.lastStep().nowS, newestLoad(tree, selection), tree, data};
    const auto strength = static_cast<std::uint8_t>(std::lround(std::clamp(overlay.opacity, 0.0, 1.0) * 255));
    std::vector<planet::gl::ChunkTint> tints;
    tints.reserve(selection.draw.size());
    const planet::ChunkNode unknown;
    for (const planet::DrawItem& item : selection.draw) {
        const auto& node = item.node < tree.nodes.size() ? tree.nodes[item.node] : unknown;
        // The cells of an atlas are drawn over chunks that are coarser (atlasLines).
        const bool isCovered =
            overlay.colourBy == ColourBy::Atlas && data.atlas && isCoarserThanCells(*data.atlas, item.id);
        tints.push_back({colourBytes(tintOf(item, node, scale), isCovered ? std::uint8_t{0} : strength)});
    }
    return tints;
}

}  // namespace worldy
