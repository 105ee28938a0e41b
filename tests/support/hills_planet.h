// A small baked planet for tests of instruments.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "planet/bake/bake.h"
#include "planet/planet.h"
#include "tests/support/synthetic_source.h"

namespace planet::test {

// Bakes hills on a planet of 100 km into a file and opens it.
inline std::unique_ptr<Planet> openHills(const std::filesystem::path& file) {
    BakeSettings settings;
    settings.chunkSize = 17;
    settings.radiusM = 100'000;
    if (!bake(hillsSource(), settings, file)) throw std::runtime_error("cannot bake");
    return Planet::open(file, {}).value();
}

}  // namespace planet::test
