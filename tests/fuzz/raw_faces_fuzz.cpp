// Fuzzes raw cube faces and their settings: they are refused, or every sample lies in the source's range. An
// input is the options, then the bytes of the six files.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "planet/source/height_source_kinds.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace planet;
using fuzz::isRead;
using fuzz::require;

HeightSourceSettings settingsFrom(fuzz::Input& input) {
    HeightSourceSettings settings;
    const unsigned given = input.byte();
    settings.rawSigned = given & 1;
    settings.rawBigEndian = given & 2;
    if (given & 4) settings.rawBits = given & 8 ? 8 : 16;
    if (given & 16) settings.rawSize = std::bit_cast<std::int32_t>(input.number());
    if (given & 32) settings.noDataValue = std::bit_cast<float>(input.number());
    if (given & 64) {
        const auto within = [](float value) {
            return std::isfinite(value) ? std::clamp(static_cast<double>(value), -1e9, 1e9) : 3.0;
        };
        settings.metresPerUnit = within(std::bit_cast<float>(input.number()));
        if (settings.metresPerUnit == 0) settings.metresPerUnit = 1;  // openHeightSource refuses it
        settings.offsetM = within(std::bit_cast<float>(input.number()));
        settings.fillM = within(std::bit_cast<float>(input.number()));
    }
    if (given & 128) settings.cacheBytes = input.byte() * std::size_t{64};
    return settings;
}

// Six files in memory, because files on a disk would take most of the time.
class FacesInMemory {
public:
    FacesInMemory() {
        for (std::size_t face = 0; face < faceCount; ++face) {
            descriptors_[face] = memfd_create("face", MFD_CLOEXEC);
            require(descriptors_[face] >= 0, "there are files in memory");
            files.paths[face] = "/proc/self/fd/" + std::to_string(descriptors_[face]);
        }
    }
    void write(bool alike, std::span<const std::byte> bytes) const {
        const std::size_t each = bytes.size() / faceCount;
        for (std::size_t face = 0; face < faceCount; ++face) {
            const auto part = alike ? bytes : bytes.subspan(face * each, each);
            require(ftruncate(descriptors_[face], 0) == 0 &&
                        pwrite(descriptors_[face], part.data(), part.size(), 0) ==
                            static_cast<ssize_t>(part.size()),
                    "files in memory can be written");
        }
    }

    FaceFiles files{"face", ".raw", {}, {}};

private:
    std::array<int, faceCount> descriptors_{};
};

void sample(const HeightSource& source, int tileByte) {
    require(source.minM <= source.maxM && std::isfinite(source.minM) && std::isfinite(source.maxM),
            "the range is one");
    SampleTile tile{
        allFaces[static_cast<std::size_t>(tileByte % faceCount)], 1 << (tileByte % 7), 0, 0, 1, 1};
    tile.columns = tile.rows = std::min(tile.faceCells + 1, 17);
    if (tileByte & 128) tile.firstColumn = tile.faceCells + 1 - tile.columns;
    std::vector<float> heights(static_cast<std::size_t>(tile.columns * tile.rows));
    if (!isRead(source.sample(tile, heights))) return;
    for (const float height : heights)
        require(height >= source.minM && height <= source.maxM, "heights lie within the range");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const FacesInMemory memory;
    fuzz::Input input(data, size);
    const unsigned shape = input.byte();
    const int tileByte = input.byte();
    const HeightSourceSettings settings = settingsFrom(input);
    FaceFiles files = memory.files;
    if (shape & 2) files.sizeInName = input.byte();
    memory.write(shape & 1, input.rest());
    const FaceEdges edges = shape & 4 ? FaceEdges::MustAgree : FaceEdges::MayDiffer;
    const auto source = openFaceSource(files, settings, edges);
    if (!isRead(source)) return 0;
    require(source->seamEdges >= 0 && source->seamEdges <= 12, "a cube has 12 edges");
    require((source->seamEdges > 0) == !source->notice.empty(), "seams get a notice");
    require(edges == FaceEdges::MayDiffer || source->notice.empty(), "faces that agree get no notice");
    sample(*source, tileByte);
    return 0;
}
