// The table of the settings of all kinds of terrain, and their checks.
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

// Sets the range of the field's slider.
constexpr TerrainField usually(double least, double most, TerrainField field) {
    field.usualLeast = least;
    field.usualMost = most;
    return field;
}

template <class S>
constexpr TerrainField seedField() {
    return field<&S::seed>("seed", "Seed", "", 0, 4294967295.0, false,
                           "Different seeds give different worlds.");
}
template <class S>
constexpr TerrainField octavesField(double most, std::string_view about) {
    return field<&S::octaves>("octaves", "Octaves", "", 1, most, false, about);
}
template <class S>
constexpr TerrainField lacunarityField() {
    return field<&S::lacunarity>("lacunarity", "Lacunarity", "", 1.2, 4, false,
                                 "Frequency ratio between octaves. Small: more octaves are needed for the "
                                 "same detail; large: gaps between them show.");
}
template <class S>
constexpr TerrainField gainField() {
    return field<&S::gain>("gain", "Gain", "", 0, 0.95, false,
                           "Amplitude ratio between octaves. High: rough down to the last grid step; low: "
                           "smooth hills.");
}
template <class S>
constexpr TerrainField amplitudeField(std::string_view about) {
    return usually(0, 20000, field<&S::amplitudeM>("amplitude_m", "Amplitude", "m", 0, 1e6, true, about));
}
template <class S>
constexpr TerrainField featureField() {
    return usually(
        0.5, 180,
        field<&S::featureDeg>("feature_deg", "Feature size", "°", 0.01, 180, true,
                              "Width of the largest hills: the first octave's lattice cell. On Earth a "
                              "degree is 111 km."));
}
template <class S>
constexpr TerrainField offsetField() {
    return usually(-15000, 15000,
                   field<&S::offsetM>("offset_m", "Offset", "m", -1e6, 1e6, false,
                                      "Added to every height. Below 0: more sea, above: more land."));
}

constexpr std::string_view octavesAbout =
    "Layers of noise, each finer and lower than the one before. Octaves finer than two samples are skipped.";

using Fractal = FractalTerrain;
constexpr std::array fractalFields = {
    seedField<Fractal>(),
    octavesField<Fractal>(24, octavesAbout),
    lacunarityField<Fractal>(),
    gainField<Fractal>(),
    amplitudeField<Fractal>("Max deviation from the offset; 5x RMS."),
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
        "Octave weight near ridges. Low: rough crests over smooth valleys; high: rough everywhere; 0: one "
        "octave only."),
    amplitudeField<Ridged>("Max height above the offset; below it 1.8 times as much."),
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
            field<&FaultTerrain::minDeltaM>("min_delta_m", "Last step", "m", 0, 1e6, true,
                                            "Height of the last fault, at most that of the first.")),
    usually(
        0, 10,
        field<&FaultTerrain::smoothDeg>(
            "smooth_deg", "Smoothing", "°", 0, 30, true,
            "Falloff width w of a fault's step, e^(-x/w). 0: cliffs one sample wide; large: gentle swells.")),
    offsetField<FaultTerrain>(),
};

constexpr std::array midpointFields = {
    seedField<MidpointTerrain>(),
    field<&MidpointTerrain::roughness>(
        "roughness", "Roughness", "", 0, 1, false,
        "Offsets shrink by 2^-(1 - roughness) with each halving; the surface's "
        "fractal dimension is 2 + roughness. 0: smooth swells; 1: noise on every scale."),
    amplitudeField<MidpointTerrain>("Max deviation from the offset."),
    offsetField<MidpointTerrain>(),
};

constexpr std::array craterFields = {
    seedField<CraterTerrain>(),
    field<&CraterTerrain::sizes>(
        "sizes", "Crater sizes", "", 1, 16, false,
        "Number of crater size classes, each half as wide as the one before. More: smaller craters, and a "
        "longer bake. Craters narrower than four samples are skipped."),
    usually(0.1, 60,
            field<&CraterTerrain::largestDeg>("largest_deg", "Largest crater", "°", 0.01, 60, true,
                                              "Largest crater diameter. On the Moon a degree is 30 km.")),
    usually(0, 15000,
            field<&CraterTerrain::depthM>("depth_m", "Largest crater depth", "m", 0, 1e5, true,
                                          "Largest crater depth, from the surrounding ground to the floor.")),
    field<&CraterTerrain::depthPower>(
        "depth_power", "Depth power", "", 0.2, 1.5, false,
        "Depth is proportional to diameter to this power. 1: all craters have the same shape; lower: small "
        "craters are deep for their size."),
    field<&CraterTerrain::density>("density", "Density", "", 0, 1, false, "Fraction of cells with a crater."),
    octavesField<CraterTerrain>(24, octavesAbout),
    gainField<CraterTerrain>(),
    amplitudeField<CraterTerrain>("Amplitude of the ground below the craters; 5x RMS."),
    featureField<CraterTerrain>(),
    offsetField<CraterTerrain>(),
};

constexpr std::array detailFields = {
    seedField<DetailTerrain>(),
    octavesField<DetailTerrain>(
        16,
        "Layers of noise below the source's own resolution: 6 refine the Earth's 4.9 km to 76 m. Octaves "
        "finer than two samples are skipped."),
    lacunarityField<DetailTerrain>(),
    gainField<DetailTerrain>(),
    field<&DetailTerrain::strength>(
        "strength", "Strength", "", 0, 8, false,
        "Ratio of the detail's amplitude to the source's local relief. 1: matches the source roughness; "
        "high: spiky mountains."),
    field<&DetailTerrain::ridged>("ridged", "Ridged", "", 0, 1, false, "0: round hills; 1: ridges."),
    usually(0, 5000,
            field<&DetailTerrain::limitM>("limit_m", "Limit", "m", 0, 1e5, true,
                                          "Max height change. High: a coarser quantum is needed.")),
    usually(
        0, 500,
        field<&DetailTerrain::flatM>(
            "flat_m", "Flat below", "m", 0, 1e5, true,
            "Local relief up to this counts as flat and is unchanged; up to three times this, detail fades "
            "in.")),
    usually(-8000, 8000,
            field<&DetailTerrain::seaM>("sea_m", "Sea level", "m", -1e6, 1e6, false,
                                        "Detail fades out below this height.")),
    usually(0, 2000,
            field<&DetailTerrain::coastM>(
                "coast_m", "Coast", "m", 0, 1e5, true,
                "Width of the fade at the coast: full detail at this height above the sea, none at this "
                "depth below "
                "it. 0: a visible edge at the coast; large: the sea floor gets detail too.")),
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
        // The comparison is written so that NaN fails too.
        if (value >= setting.least && value <= setting.most) continue;
        return badInput(fmt::format("{}: {} is {}; expected [{}, {}]{}{}", kind.name, setting.name, value,
                                    setting.least, setting.most,
                                    setting.unit.empty() || setting.unit == "°" ? "" : " ", setting.unit));
    }
    if (const FaultTerrain* faults = std::get_if<FaultTerrain>(&settings);
        faults && faults->minDeltaM > faults->maxDeltaM) {
        return badInput(fmt::format("{}: min_delta_m is {}; expected at most max_delta_m, {} m", kind.name,
                                    faults->minDeltaM, faults->maxDeltaM));
    }
    return {};
}

}  // namespace planet
