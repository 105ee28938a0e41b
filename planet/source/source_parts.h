// Hashes what the heights of a source depend on, part by part (source_record.h), so that a bake can tell what has
// changed since an earlier one. Internal to the library; any thread.
//
// A file counts by its content, wherever it lies and whenever it was written. Only of files of more than 256 MiB,
// which would take long to read, the size, the time of the last change and the first MiB count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "planet/base/little_endian.h"
#include "planet/base/result.h"
#include "planet/format/source_record.h"
#include "planet/raster/height_source_settings.h"

namespace planet {

// Collects values, and hashes them.
class Fingerprint {
public:
    template <Number T>
    Fingerprint& add(T value) {
        ByteWriter(bytes_).put(value);
        return *this;
    }
    Fingerprint& add(std::string_view text);

    std::uint64_t hash() const;

private:
    std::vector<std::byte> bytes_;
};

// Returns a hash of files. The Error names a file that cannot be read.
Result<std::uint64_t> hashOfFiles(const std::vector<std::filesystem::path>& files);
// Returns a hash of each list of files, all of which are read in parallel.
Result<std::vector<std::uint64_t>> hashesOfFiles(
    const std::vector<std::vector<std::filesystem::path>>& lists);

// Returns a hash of the settings that heights depend on.
std::uint64_t hashOf(const HeightSourceSettings& settings);

// Returns a part that covers the planet.
SourcePart wholePlanet(std::uint64_t signature, const SampleDensities& densities);

}  // namespace planet
