#include "planet/raster/image_placement.h"
#include "planet/base/try.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace planet {

namespace {

constexpr double fullTurnDeg = 360;
constexpr double poleToPoleDeg = 180;
// Steps in tags are often rounded, for example to 0.0083333.
constexpr double stepTolerance = 1e-4;

constexpr const char* regionHint =
    "heights of a region need a coordinate reference system, as in a GeoTIFF, and colours must cover the "
    "whole planet";

// The extent of an image, degrees.
struct ImageExtent {
    double firstLongitude = 0;  // of the first column's samples
    double firstLatitude = 0;   // of the first row's samples
    double columnStep = 0;      // eastwards
    double rowStep = 0;         // southwards
};

Result<ImageExtent> extentOf(const std::string& file, const GeoPlacement& tags) {
    if (tags.model == GeoModel::Other) {
        return badInput(
            fmt::format("{}: is in {} by {}; expected longitude and latitude in degrees, or an "
                        "equirectangular "
                        "projection in metres, of the whole planet",
                        file, tags.modelText, tags.from));
    }
    if (std::abs(tags.x[2]) > stepTolerance * std::abs(tags.x[1]) ||
        std::abs(tags.y[1]) > stepTolerance * std::abs(tags.y[2]) || !(tags.x[1] > 0) || !(tags.y[2] < 0)) {
        return badInput(fmt::format(
            "{}: is rotated or mirrored by {}; expected north up and east to the right", file, tags.from));
    }
    const double unit = tags.model == GeoModel::Metres ? tags.metresPerDegree : 1;
    return ImageExtent{tags.x[0] / unit, tags.y[0] / unit, tags.x[1] / unit, -tags.y[2] / unit};
}

Error regionError(const std::string& file, int width, int height, const ImageExtent& extent,
                  const std::string& from) {
    const double west = extent.firstLongitude - extent.columnStep / 2;
    const double north = extent.firstLatitude + extent.rowStep / 2;
    return {ErrorKind::BadInput,
            fmt::format("{}: covers longitude {:.6g} to {:.6g} and latitude {:.6g} to {:.6g} degrees by {}; "
                        "expected the whole planet, 360 degrees wide and from latitude 90 to -90; {}",
                        file, west, west + width * extent.columnStep, north - height * extent.rowStep, north,
                        from, regionHint)};
}

// Rounds to a half or a whole column if the difference is only rounding, so that tags and sizes give the same
// placement.
double withoutRounding(double column) {
    const double nearest = std::round(2 * column) / 2;
    return std::abs(column - nearest) < 0.01 ? nearest : column;
}

double wrappedColumn(double column, int period) {
    const double turns = std::floor((column + 0.5) / period);
    return column - turns * period;
}

Result<ImagePlacement> placementByTags(const std::string& file, int width, int height,
                                       const GeoPlacement& tags) {
    TRY_ASSIGN(const auto extent, extentOf(file, tags));
    ImagePlacement placement;
    const double columns = fullTurnDeg / extent.columnStep;
    const bool repeats = width > 2 && std::abs(columns - (width - 1)) < std::abs(columns - width);
    placement.period = repeats ? width - 1 : width;
    const double mostColumnsOff = std::max(0.25, stepTolerance * width);
    const double halfStep = extent.rowStep / 2;
    const double lastLatitude = extent.firstLatitude - (height - 1) * extent.rowStep;
    const auto offBy = [&](double firstLatitude) {
        return std::max(std::abs(extent.firstLatitude - firstLatitude),
                        std::abs(lastLatitude + firstLatitude));
    };
    const double pole = poleToPoleDeg / 2;
    placement.hasPoleRows = height > 1 && offBy(pole) < offBy(pole - halfStep);
    const double mostOff = extent.rowStep * std::max(0.25, stepTolerance * height);
    if (std::abs(columns - placement.period) > mostColumnsOff ||
        offBy(placement.hasPoleRows ? pole : pole - halfStep) > mostOff)
        return tl::unexpected(regionError(file, width, height, extent, tags.from));
    const double zero = -extent.firstLongitude * placement.period / fullTurnDeg;
    if (std::abs(extent.firstLongitude) > 2 * fullTurnDeg)
        return tl::unexpected(regionError(file, width, height, extent, tags.from));
    placement.zeroColumn = wrappedColumn(withoutRounding(zero), placement.period);
    return placement;
}

}  // namespace

ImagePlacement centredPlacement(int width) {
    return {width, width / 2.0 - 0.5, false};
}

Result<ImagePlacement> placementOf(const std::string& file, int width, int height, const GeoTags& tags) {
    if (tags.placement) return placementByTags(file, width, height, *tags.placement);
    if (height > 1 && width == 2 * height - 1) return ImagePlacement{width - 1, (width - 1) / 2.0, true};
    if (height > 1 && width == 2 * height - 2) return ImagePlacement{width, width / 2.0, true};
    const int excess = std::abs(width - 2 * height);
    if (width >= 2 && excess <= std::max(2, width / 100)) return centredPlacement(width);
    return badInput(
        fmt::format("{}: is {} x {} samples; expected an equirectangular image of the whole planet, twice as "
                    "wide as high, or "
                    "2 n + 1 by n + 1 points of a grid; {}",
                    file, width, height, regionHint));
}

std::string placementText(const ImagePlacement& placement, int width) {
    std::string text = "equirectangular";
    const double step = fullTurnDeg / placement.period;
    const double first = -placement.zeroColumn * step;
    const bool onGrid = placement.hasPoleRows;
    if (onGrid) text += " grid points from pole to pole";
    const double usual = onGrid ? placement.period / 2.0 : placement.period / 2.0 - 0.5;
    if (std::abs(placement.zeroColumn - usual) > 1e-6) {
        const double west = onGrid ? first : first - step / 2;
        text += fmt::format(" from longitude {:.6g}",
                            west <= -fullTurnDeg + step / 4 ? west + fullTurnDeg : west);
    }
    if (placement.period < width) text += ", the last column repeats the first";
    return text;
}

}  // namespace planet
