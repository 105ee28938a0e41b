#include "ui/model/overlay_legend.h"

#include <fmt/format.h>

#include <cmath>

#include "app/base/text.h"
#include "app/measure/atlas_table.h"
#include "app/scene/overlay_colours.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

std::vector<LegendEntry> levelEntries(std::uint32_t deepestLevel) {
    std::vector<LegendEntry> entries;
    for (std::uint32_t level = 0; level <= deepestLevel; ++level) {
        entries.push_back({levelColour(static_cast<int>(level)), fmt::format("{}", level)});
    }
    return entries;
}

std::vector<LegendEntry> errorEntries(double yellowPx) {
    std::vector<LegendEntry> entries;
    for (const double share : {0.0, 0.5, 1.0, 1.5, 2.0}) {
        entries.push_back(
            {errorColour(share), fmt::format("{:.3g} px{}", share * yellowPx, share < 2 ? "" : " and over")});
    }
    return entries;
}

// Lists the top layer first, as the Sources panel does.
std::vector<LegendEntry> layerEntries(const std::vector<std::string>& layers) {
    if (layers.empty()) return {{unmeasuredColour, "not known (Sources panel)"}};
    std::vector<LegendEntry> entries;
    for (std::size_t i = layers.size(); i-- > 0;) entries.push_back({layerColour(i), layers[i]});
    entries.push_back({noLayerColour, "no layer"});
    entries.push_back({unmeasuredColour, "not read yet"});
    return entries;
}

std::vector<LegendEntry> regionEntries(const std::vector<LegendRegion>& regions) {
    std::vector<LegendEntry> entries;
    for (std::size_t i = 0; i < regions.size(); ++i)
        if (regions[i].on) entries.push_back({regionColour(i), regions[i].name});
    entries.push_back({noRegionColour, regions.empty() ? "no regions (Regions panel)" : "no region"});
    return entries;
}

// Returns a length with two digits below 1 m, which is enough for a scale in decades.
std::string deltaText(double metres) {
    return metres < 1 ? fmt::format("{:.2g} m", metres) : distanceText(metres);
}

template <class Label>
std::vector<LegendEntry> rampEntries(Label&& label) {
    std::vector<LegendEntry> entries;
    for (int i = 0; i <= 4; ++i) entries.push_back({rampColour(i / 4.0), label(i / 4.0)});
    return entries;
}

}  // namespace

std::vector<LegendRegion> legendRegions(const planet::Planet& planet) {
    std::vector<LegendRegion> regions;
    if (!planet.tree().regions) return regions;
    for (const planet::Region& region : planet.tree().regions->regions())
        regions.push_back({region.name, region.on});
    return regions;
}

std::string drapeText(const AtlasDrape& drape, double value) {
    return drape.isChange ? changeText(drape.measure, value) : figureText(drape.measure, value);
}

std::string scaleEndText(const AtlasDrape& drape, bool upper) {
    const bool isClamped = drape.isClamped && (upper || drape.isChange);
    const std::string sign = isClamped ? inFont(upper ? "\u2265" : "\u2264") + " " : "";
    return sign + drapeText(drape, upper ? drape.most : drape.least);
}

Legend legendOf(const AtlasDrape& drape) {
    Legend legend{fmt::format("{}{}", planet::textOf(drape.measure).name, drape.isChange ? ", change" : ""),
                  {}};
    const auto add = [&](double value, const std::string& text) {
        legend.entries.push_back({drapeColour(drape, value), text});
    };
    if (drape.cellsOnScale > 0) {
        const bool isOneValue = drape.least == drape.most;
        add(drape.least, scaleEndText(drape, false));
        for (int i = 1; i < 4 && !isOneValue; ++i) {
            const double value = valueOf(drape, i / 4.0);
            add(value, drapeText(drape, value));
        }
        if (!isOneValue) add(drape.most, scaleEndText(drape, true));
    }
    if (drape.hasUnbounded)
        legend.entries.push_back({unboundedColour, drape.isChange ? "bound lost" : "no bound"});
    if (drape.hasGained) legend.entries.push_back({gainedColour, "bound gained"});
    return legend;
}

Legend legendOf(const OverlaySettings& overlay, double tauPx, std::uint32_t deepestLevel,
                const LegendFacts& facts) {
    switch (overlay.colourBy) {
        case ColourBy::Level:
            return {"Level", levelEntries(deepestLevel)};
        case ColourBy::Error:
            return {std::string("Error ") + epsSymbol(), errorEntries(tauPx * overlay.errorScale)};
        case ColourBy::DeltaC:
            return {inFont("δc"), rampEntries([&](double share) {
                        return deltaText(overlay.deltaTopM * std::pow(10.0, deltaDecades * (share - 1)));
                    })};
        case ColourBy::Morph:
            return {"Morph", rampEntries([](double share) { return fmt::format("{:.0f} %", 100 * share); })};
        case ColourBy::Age:
            return {"Loaded", rampEntries([&](double share) {
                        return share == 1 ? "just now" : durationText((1 - share) * overlay.ageTopS) + " ago";
                    })};
        case ColourBy::LoadOrder:
            return {"Load order", rampEntries([](double share) {
                        return share == 0   ? std::string("first")
                               : share == 1 ? std::string("last")
                                            : fmt::format("{:.0f} %", 100 * share);
                    })};
        case ColourBy::Measured: {
            std::vector<LegendEntry> entries = errorEntries(tauPx * overlay.errorScale);
            entries.push_back({unmeasuredColour, "not measured"});
            return {"Measured error", entries};
        }
        case ColourBy::LeafDepth: {
            std::vector<LegendEntry> entries =
                levelEntries(static_cast<std::uint32_t>(planet::deepestLevelOf(facts.shape)));
            entries.push_back({unmeasuredColour, "not read yet"});
            return {"Deepest leaf", entries};
        }
        case ColourBy::Spacing: {
            std::vector<LegendEntry> entries = rampEntries([&](double share) {
                return deltaText(leafSpacingM(facts.shape, share * planet::deepestLevelOf(facts.shape)));
            });
            entries.push_back({unmeasuredColour, "not read yet"});
            return {"Sample spacing", entries};
        }
        case ColourBy::Atlas: {
            Legend legend = facts.atlas ? legendOf(*facts.atlas) : Legend{"Atlas", {}};
            legend.entries.push_back({unmeasuredColour, "not surveyed"});
            return legend;
        }
        case ColourBy::Region:
            return {"Region", regionEntries(facts.regions)};
        case ColourBy::Source:
            return {"Source", layerEntries(facts.layers)};
        case ColourBy::None:
            break;
    }
    return {};
}

}  // namespace worldy::ui
