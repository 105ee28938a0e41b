// How small a chunk file is beside other ways to keep the same heights: compression_report FILE.chk
//
// Rebuilds the finest heights of each face and prints bits a sample for the file (all levels together), and
// for those finest heights alone as 16-bit PNG, as deltas split into bytes under zstd -3, and, where
// opj_compress is installed, as reversible JPEG 2000.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <zstd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "planet/file_report.h"
#include "tests/synthetic_source.h"
#include "tests/temporary_folder.h"

namespace {

using namespace planet;

struct FaceImage {
    int side;
    std::vector<std::int16_t> steps;
};

void copyLeaves(const ChunkFile& file, const ChunkData& chunk, FaceImage& image) {
    const PlanetShape& shape = file.info().shape;
    if (chunk.id.level < leafLevel(shape)) {
        const auto children = file.readChildren(chunk.id, chunk.children, chunk.heights).value();
        for (const ChunkData& child : children) copyLeaves(file, child, image);
        return;
    }
    const auto size = static_cast<std::size_t>(chunkSize(shape));
    for (std::size_t i = 0; i < chunk.heights.size(); ++i) {
        const std::size_t row = chunk.id.y * (size - 1) + i / size;
        image.steps[row * static_cast<std::size_t>(image.side) + chunk.id.x * (size - 1) + i % size] =
            chunk.heights[i];
    }
}

std::size_t pngBytes(const FaceImage& image, const std::vector<std::uint16_t>& grey,
                     const std::filesystem::path& path) {
    const auto output = OIIO::ImageOutput::create(path.string());
    output->open(path.string(), OIIO::ImageSpec(image.side, image.side, 1, OIIO::TypeDesc::UINT16));
    output->write_image(OIIO::TypeDesc::UINT16, grey.data());
    output->close();
    return std::filesystem::file_size(path);
}

std::size_t deltaZstdBytes(const FaceImage& image) {
    std::vector<std::uint8_t> low;
    std::vector<std::uint8_t> high;
    int previous = 0;
    for (const std::int16_t step : image.steps) {
        const auto delta = static_cast<std::uint16_t>(step - previous);
        previous = step;
        low.push_back(static_cast<std::uint8_t>(delta & 0xFF));
        high.push_back(static_cast<std::uint8_t>(delta >> 8));
    }
    low.insert(low.end(), high.begin(), high.end());
    std::vector<std::uint8_t> packed(ZSTD_compressBound(low.size()));
    return ZSTD_compress(packed.data(), packed.size(), low.data(), low.size(), 3);
}

// 0 where opj_compress is not installed.
std::size_t jpeg2000Bytes(const FaceImage& image, const std::vector<std::uint16_t>& grey,
                          const std::filesystem::path& folder) {
    std::ofstream pgm(folder / "face.pgm", std::ios::binary);
    pgm << fmt::format("P5\n{} {}\n65535\n", image.side, image.side);
    for (const std::uint16_t value : grey)
        pgm.put(static_cast<char>(value >> 8)).put(static_cast<char>(value & 0xFF));
    pgm.close();
    const auto output = folder / "face.j2k";
    const std::string command = fmt::format("opj_compress -r 1 -i '{}' -o '{}' >/dev/null 2>&1",
                                            (folder / "face.pgm").string(), output.string());
    if (std::system(command.c_str()) != 0) return 0;
    return std::filesystem::file_size(output);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return fmt::print(stderr, "usage: compression_report FILE.chk\n"), 2;
    const auto file = ChunkFile::open(argv[1]);
    if (!file) return fmt::print(stderr, "{}\n", file.error().message), 2;
    const tests::TemporaryFolder folder;
    const int side = faceCells(file->info().shape) + 1;
    std::size_t png = 0;
    std::size_t zstd = 0;
    std::size_t jpeg2000 = 0;
    for (const Face face : allFaces) {
        FaceImage image{
            side, std::vector<std::int16_t>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
        copyLeaves(*file, file->readRoot(face).value(), image);
        std::vector<std::uint16_t> grey(image.steps.size());
        for (std::size_t i = 0; i < grey.size(); ++i)
            grey[i] = static_cast<std::uint16_t>(image.steps[i] - file->info().minStep);
        png += pngBytes(image, grey, folder / "face.png");
        zstd += deltaZstdBytes(image);
        jpeg2000 += jpeg2000Bytes(image, grey, folder.path());
    }
    const double samples = 6.0 * side * side;
    const auto line = [&](const char* what, std::size_t bytes) {
        fmt::print("{:<38} {:>12} bytes  {:6.3f} bits a finest sample\n", what, bytes,
                   8 * static_cast<double>(bytes) / samples);
    };
    line("chunk file, all levels", file->sizeBytes());
    line("finest level: 16-bit PNG", png);
    line("finest level: delta, bytes, zstd -3", zstd);
    if (jpeg2000 > 0) line("finest level: reversible JPEG 2000", jpeg2000);
}
