#include "planet/source/height_source_kinds.h"

#include <cmath>

namespace planet {

void describeHeights(HeightSource& source, const HeightConversion& conversion,
                     const HeightStatistics& statistics) {
    const bool isFloat = conversion.type == SampleType::Float || conversion.type == SampleType::Double;
    source.stepM = isFloat ? 0 : std::abs(conversion.metresPerUnit);
    source.minM = statistics.minM;
    source.maxM = statistics.maxM;
    source.missingCount = statistics.missingCount;
}

}  // namespace planet
