// The settings of all kinds as one table, and their checks.
#include "planet/source/terrain.h"

#include <fmt/format.h>

#include <array>
#include <type_traits>

namespace planet {

namespace {

template <auto member>
struct MemberOf;
template <class S, class T, T S::*member>
struct MemberOf<member> {
    using Settings = S;
    using Value = T;
};

template <auto member>
constexpr TerrainField field(std::string_view name, std::string_view label, std::string_view unit,
                             double least, double most, bool logarithmic, std::string_view about) {
    using Settings = typename MemberOf<member>::Settings;
    using Value = typename MemberOf<member>::Value;
    return {
        name,
        label,
        unit,
        least,
        most,
        least,
        most,
        std::is_integral_v<Value>,
        logarithmic,
        about,
        [](const TerrainSettings& s) { return static_cast<double>(std::get<Settings>(s).*member); },
        [](TerrainSettings& s, double value) { std::get<Settings>(s).*member = static_cast<Value>(value); }};
}

// The same with a slider that spans less.
constexpr TerrainField usually(double least, double most, TerrainField field) {
    field.usualLeast = least;
    field.usualMost = most;
    return field;
}

template <class S>
constexpr TerrainField seedField() {
    return field<&S::seed>("seed", "Seed", "", 0, 4294967295.0, false,
                           "Another seed is another world of the same kind; the same seed the same world.");
}
template <class S>
constexpr TerrainField octavesField(double most, std::string_view about) {
    return field<&S::octaves>("octaves", "Octaves", "", 1, most, false, about);
}
template <class S>
constexpr TerrainField lacunarityField() {
    return field<&S::lacunarity>("lacunarity", "Lacunarity", "", 1.2, 4, false,
                                 "How many times finer each octave is than the one before. Small: more "
                                 "octaves are needed for the same detail; large: gaps between them show.");
}
template <class S>
constexpr TerrainField gainField() {
    return field<&S::gain>("gain", "Gain", "", 0, 0.95, false,
                           "How high each octave is, as a share of the one before. High: rough down to the "
                           "last grid step; low: smooth hills.");
}
template <class S>
constexpr TerrainField amplitudeField(std::string_view about) {
    return usually(0, 20000, field<&S::amplitudeM>("amplitude_m", "Amplitude", "m", 0, 1e6, true, about));
}
template <class S>
constexpr TerrainField featureField() {
    return usually(
        0.5, 180,
        field<&S::featureDeg>("feature_deg", "Feature size", "deg of arc", 0.01, 180, true,
                              "Width of the largest hills: the first octave's lattice cell. On Earth a "
                              "degree is 111 km. Too small: the planet looks like a golf ball from afar."));
}
template <class S>
constexpr TerrainField offsetField() {
    return usually(-15000, 15000,
                   field<&S::offsetM>("offset_m", "Offset", "m", -1e6, 1e6, false,
                                      "Added to every height. Below 0: more sea, above: more land."));
}

constexpr std::string_view octavesAbout =
    "Layers of noise, each finer and lower. Those finer than two grid steps are left out; more than the grid "
    "holds cost nothing and show nothing.";

using Fractal = FractalTerrain;
constexpr std::array fractalFields = {
    seedField<Fractal>(),
    octavesField<Fractal>(24, octavesAbout),
    lacunarityField<Fractal>(),
    gainField<Fractal>(),
    amplitudeField<Fractal>("All heights lie within this of the offset; it is five times their root mean "
                            "square, so few come near."),
    featureField<Fractal>(),
    offsetField<Fractal>(),
};

using Ridged = RidgedTerrain;
constexpr std::array ridgedFields = {
    seedField<Ridged>(),
    octavesField<Ridged>(24, octavesAbout),
    lacunarityField<Ridged>(),
    gainField<Ridged>(),
    field<&Ridged::sharpness>(
        "sharpness", "Sharpness", "", 0, 8, false,
        "How soon an octave has its full height near the ridges of the one before. Low: "
        "rough crests over smooth valleys; high: rough everywhere; 0: one octave only."),
    amplitudeField<Ridged>("Heights reach this above the offset, and 1.8 times this below it."),
    featureField<Ridged>(),
    offsetField<Ridged>(),
};

constexpr std::array faultFields = {
    seedField<FaultTerrain>(),
    usually(1, 3000,
            field<&FaultTerrain::count>(
                "count", "Faults", "", 1, 20000, true,
                "Planes that cut the sphere, n. Few: single steps show; many: the bake takes longer, "
                "in proportion.")),
    usually(0, 2000,
            field<&FaultTerrain::maxDeltaM>("max_delta_m", "First step", "m", 0, 1e6, true,
                                            "Height of the first fault. dt = max - (max - min) i / n.")),
    usually(0, 2000,
            field<&FaultTerrain::minDeltaM>(
                "min_delta_m", "Last step", "m", 0, 1e6, true,
                "Height that the last faults come down to, at most the first one's.")),
    usually(0, 10,
            field<&FaultTerrain::smoothDeg>(
                "smooth_deg", "Smoothing", "deg of arc", 0, 30, true,
                "Width w of a fault's soft step, e^(-x/w): the limit of the books' filter with "
                "k = e^(-spacing/w). 0: cliffs of one grid step; large: gentle swells.")),
    offsetField<FaultTerrain>(),
};

constexpr std::array midpointFields = {
    seedField<MidpointTerrain>(),
    field<&MidpointTerrain::roughness>(
        "roughness", "Roughness", "", 0, 1, false,
        "Offsets shrink by 2^-(1 - roughness) with each halving; the surface's "
        "fractal dimension is 2 + roughness. 0: smooth swells; 1: noise on every scale."),
    amplitudeField<MidpointTerrain>("All heights lie within this of the offset."),
    offsetField<MidpointTerrain>(),
};

constexpr std::array craterFields = {
    seedField<CraterTerrain>(),
    field<&CraterTerrain::sizes>(
        "sizes", "Crater sizes", "", 1, 16, false,
        "How often diameters halve from the largest on. More: smaller craters, and a longer "
        "bake. Those under four grid steps are left out."),
    usually(0.1, 60,
            field<&CraterTerrain::largestDeg>("largest_deg", "Largest crater", "deg of arc", 0.01, 60, true,
                                              "Its diameter. On the Moon a degree is 30 km.")),
    usually(0, 15000,
            field<&CraterTerrain::depthM>("depth_m", "Its depth", "m", 0, 1e5, true,
                                          "Of the largest crater, from the ground around it to its floor.")),
    field<&CraterTerrain::depthPower>(
        "depth_power", "Depth power", "", 0.2, 1.5, false,
        "Depth goes with diameter to this power. 1: all of the same shape; lower: "
        "small ones are deep for their size, as real ones are."),
    field<&CraterTerrain::density>("density", "Density", "", 0, 1, false,
                                   "Share of the lattice's cells that hold a crater."),
    octavesField<CraterTerrain>(24, octavesAbout),
    gainField<CraterTerrain>(),
    amplitudeField<CraterTerrain>("Of the ground beneath the craters: five times its root mean square."),
    featureField<CraterTerrain>(),
    offsetField<CraterTerrain>(),
};

constexpr std::array detailFields = {
    seedField<DetailTerrain>(),
    octavesField<DetailTerrain>(
        16,
        "Layers below the source's own resolution, each finer: 6 of them make 76 m of the "
        "Earth's 4.9 km. Shown as far as the face size holds them."),
    lacunarityField<DetailTerrain>(),
    gainField<DetailTerrain>(),
    field<&DetailTerrain::strength>(
        "strength", "Strength", "", 0, 8, false,
        "Height of the detail against the source's own relief at a place. 1: goes on as "
        "the source ends; high: spiky mountains."),
    field<&DetailTerrain::ridged>("ridged", "Ridged", "", 0, 1, false, "0: round hills; 1: ridges."),
    usually(0, 5000,
            field<&DetailTerrain::limitM>(
                "limit_m", "Limit", "m", 0, 1e5, true,
                "Never more than this is added or taken away. High: a coarser quantum is needed.")),
    usually(0, 500,
            field<&DetailTerrain::flatM>(
                "flat_m", "Flat below", "m", 0, 1e5, true,
                "Relief from sample to sample up to this counts as flat, and stays as it is; up to "
                "three times this, detail fades in.")),
    usually(-8000, 8000,
            field<&DetailTerrain::seaM>("sea_m", "Sea level", "m", -1e6, 1e6, false,
                                        "Below it detail fades out.")),
    usually(0, 2000,
            field<&DetailTerrain::coastM>(
                "coast_m", "Coast", "m", 0, 1e5, true,
                "Detail fades from all at this height above the sea to none at this depth below. "
                "0: to none at the coast, which shows; large: the sea floor gets detail too.")),
};

const std::array kinds = {
    TerrainKind{"noise:fbm", "Perlin fBm", "Rolling land: octaves of gradient noise.", Fractal{},
                fractalFields},
    TerrainKind{"noise:ridged", "Ridged",
                "Mountain chains with sharp crests: Musgrave's ridged multifractal.", Ridged{}, ridgedFields},
    TerrainKind{"noise:faults", "Faults", "Random faults, each raising one side, smoothed.", FaultTerrain{},
                faultFields},
    TerrainKind{"noise:midpoint", "Midpoint", "Midpoint displacement by diamonds and squares.",
                MidpointTerrain{}, midpointFields},
    TerrainKind{"noise:craters", "Craters", "Craters of many sizes over rolling ground.", CraterTerrain{},
                craterFields},
    TerrainKind{"detail", "Detail", "Another source with detail below its own resolution.", DetailTerrain{},
                detailFields},
};

}  // namespace

double faultDeltaM(const FaultTerrain& terrain, int i) {
    return terrain.maxDeltaM - (terrain.maxDeltaM - terrain.minDeltaM) * i / terrain.count;
}

std::span<const TerrainKind> terrainKinds() {
    return kinds;
}

const TerrainKind& kindOf(const TerrainSettings& settings) {
    return kinds[settings.index()];
}

Result<void> checkTerrain(const TerrainSettings& settings) {
    const TerrainKind& kind = kindOf(settings);
    for (const TerrainField& setting : kind.fields) {
        const double value = setting.get(settings);
        // Written so that NaN fails too.
        if (value >= setting.least && value <= setting.most) continue;
        return badInput(fmt::format("{}: {} is {}; it must be from {} to {}{}{}", kind.name, setting.name,
                                    value, setting.least, setting.most, setting.unit.empty() ? "" : " ",
                                    setting.unit));
    }
    if (const FaultTerrain* faults = std::get_if<FaultTerrain>(&settings);
        faults && faults->minDeltaM > faults->maxDeltaM) {
        return badInput(fmt::format("{}: min_delta_m is {}; it must be at most max_delta_m, {} m", kind.name,
                                    faults->minDeltaM, faults->maxDeltaM));
    }
    return {};
}

}  // namespace planet
