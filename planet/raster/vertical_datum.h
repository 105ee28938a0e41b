// Converts heights above one vertical datum to heights above another, with PROJ's grids. Internal to the library.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "planet/base/result.h"

namespace planet {

// The surface that heights are measured from.
enum class VerticalDatum : std::uint8_t {
    Ellipsoid,  // the ellipsoid of WGS 84
    Egm96,      // a geoid
    Egm2008
};

// The names of the datums in world files, by VerticalDatum.
inline constexpr std::array<std::string_view, 3> verticalDatumNames = {"ellipsoid", "egm96", "egm2008"};

inline std::string_view nameOf(VerticalDatum datum) {
    return verticalDatumNames[static_cast<std::size_t>(datum)];
}
// Returns the datum of a name; nothing for any other text.
inline std::optional<VerticalDatum> verticalDatumNamed(std::string_view name) {
    const auto* const found = std::ranges::find(verticalDatumNames, name);
    if (found == verticalDatumNames.end()) return std::nullopt;
    return static_cast<VerticalDatum>(found - verticalDatumNames.begin());
}

// Computes the shift that turns heights above one datum into heights above another when it is added to them. A geoid
// lies N above the ellipsoid, so a height above it is H = h - N, where h is the height above the ellipsoid, and the
// shift is N(from) - N(to). Copies share the grids. Any thread.
class DatumShift {
public:
    // Opens the grids in PROJ's folders. The Error names a missing grid, and where PROJ looks for it.
    static Result<DatumShift> make(VerticalDatum from, VerticalDatum to);

    // Computes the shifts at places, metres; not finite where a grid has no value. All spans have the same length.
    void at(std::span<const double> longitudeRad, std::span<const double> latitudeRad,
            std::span<double> shiftM) const;

    // A range that holds all shifts.
    double minM() const { return minM_; }
    double maxM() const { return maxM_; }

private:
    class Transformations;
    DatumShift() = default;
    void findRange();

    std::shared_ptr<Transformations> transformations_;
    double minM_ = 0;
    double maxM_ = 0;
};

}  // namespace planet
