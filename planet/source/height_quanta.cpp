#include "planet/source/height_quanta.h"

#include <algorithm>

#include "planet/base/try.h"

namespace planet {

double finestQuantumOf(const HeightSource& source, double radiusM) {
    return source.finestQuantumM ? source.finestQuantumM(radiusM) : noQuantumM;
}

Result<void> sampleWithQuanta(const HeightSource& source, const SampleTile& tile, double radiusM,
                              std::span<float> out, std::span<float> neededM) {
    if (source.sampleWithQuanta) return source.sampleWithQuanta(tile, radiusM, out, neededM);
    TRY(source.sample(tile, out));
    std::ranges::fill(neededM, static_cast<float>(finestQuantumOf(source, radiusM)));
    return {};
}

}  // namespace planet
