// Takes the conversion of a file's values to heights from its tags and from settings.

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "planet/base/try.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/image_names.h"

namespace planet {

namespace {

// Rounds a no-data value to a float if the samples are floats: a text such as -3.40282346638529e+38 matches
// only after that.
double asStored(double value, SampleType type) {
    const bool fits = std::abs(value) <= 3.4028235e38;
    return type == SampleType::Float && fits ? static_cast<double>(static_cast<float>(value)) : value;
}

// Returns one unit in metres, by its name in tags; nothing for an unknown name. An empty name means metres.
std::optional<double> metresIn(const std::string& unit) {
    const std::string name = lowerCase(unit);
    for (const char* metre : {"", "m", "metre", "meter", "metres", "meters"}) {
        if (name == metre) return 1;
    }
    for (const char* foot : {"ft", "foot", "feet", "international foot"}) {
        if (name == foot) return 0.3048;
    }
    for (const char* foot : {"us-ft", "ftus", "us survey foot", "us survey feet", "foot_us"}) {
        if (name == foot) return 1200.0 / 3937;
    }
    return std::nullopt;
}

// Applies the file's scale, offset and unit, unless the settings override them.
Result<void> takeUnits(const std::string& file, const HeightSourceSettings& settings, const GeoTags& tags,
                       HeightConversion& conversion) {
    if (settings.metresPerUnit) return {};
    const std::optional<double> unitM = metresIn(tags.unit);
    if (!unitM) {
        return badInput(
            fmt::format("{}: its heights are in {}, which is not known; expected metres or feet, or "
                        "--metres-per-unit",
                        file, tags.unit));
    }
    conversion.metresPerUnit = tags.scale.value_or(1) * *unitM;
    if (!settings.offsetM) conversion.offsetM = tags.offset.value_or(0) * *unitM;
    if (conversion.metresPerUnit != 0) return {};
    return badInput(fmt::format("{}: its scale is 0; expected another, or --metres-per-unit", file));
}

}  // namespace

Result<HeightConversion> conversionFor(const std::string& file, const HeightSourceSettings& settings,
                                       SampleType type, const GeoTags& tags) {
    HeightConversion conversion;
    conversion.type = type;
    conversion.metresPerUnit = settings.metresPerUnit.value_or(1);
    conversion.offsetM = settings.offsetM.value_or(0);
    if (!settings.colourChannel) {
        TRY(takeUnits(file, settings, tags, conversion));
    }
    conversion.noDataValue = settings.noDataValue ? settings.noDataValue : tags.noDataValue;
    if (conversion.noDataValue) conversion.noDataValue = asStored(*conversion.noDataValue, type);
    conversion.fillM = static_cast<float>(settings.fillM);
    if (settings.colourChannel) {
        const bool isInteger = type != SampleType::Float && type != SampleType::Double;
        const auto bits = static_cast<int>(8 * bytesOf(type));
        conversion.metresPerUnit = isInteger ? 1 / (std::ldexp(1.0, bits) - 1) : 1;
        conversion.offsetM = 0;
        conversion.noDataValue = settings.noDataValue;  // the file's value is often a colour of the picture
        conversion.fillM = 0;
        conversion.decodesSrgb = isInteger;
    }
    return conversion;
}

}  // namespace planet
