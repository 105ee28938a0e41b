// Fuzzes layer sets: a set that is read is written as the same set, and its weights are valid.
#include "app/settings/layer_file.h"
#include "planet/surface/layer_place.h"
#include "planet/surface/layer_set.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace worldy;
using fuzz::isRead;
using fuzz::require;

void checkWeights(const planet::LayerSet& set) {
    for (const planet::TextureLayer& layer : set.layers) {
        if (!planet::layerProblem(layer).empty()) return;
    }
    for (const double heightM : {-9000.0, 0.0, 812.5, 9000.0}) {
        planet::LayerPlace place;
        place.heightM = heightM;
        place.slopeDeg = 31;
        place.latitudeDeg = -47;
        double sum = 0;
        for (const double weight : planet::layerWeights(set, place)) {
            require(weight >= 0 && weight <= 1, "weights lie within [0, 1]");
            sum += weight;
        }
        require(sum <= 1 + 1e-9, "weights share out no more than there is");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto set = layerSetFromText(fuzz::textOf(data, size), "fuzzed.toml");
    if (!isRead(set)) return 0;
    const std::string written = layerSetText(*set);
    const auto again = layerSetFromText(written, "written.toml");
    require(isRead(again), "what is written can be read");
    require(layerSetText(*again) == written, "what is read again is the same");
    static_cast<void>(layerSetText(movedTo("/a/b", "/a/b/c", *set)));
    checkWeights(*set);
    return 0;
}
