#include "app/bench/square_formats.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <zstd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <span>
#include <utility>

#include "app/base/picture_file.h"

namespace worldy {

namespace {

using planet::Result;

constexpr int zstdLevel = 3;

std::vector<char> zstdPacked(std::span<const std::byte> bytes) {
    std::vector<char> packed(ZSTD_compressBound(bytes.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), zstdLevel));
    return packed;
}

// Returns the differences between samples, low bytes before high bytes, which zstd compresses well.
std::vector<std::uint8_t> shuffledDeltas(std::span<const std::int16_t> steps) {
    std::vector<std::uint8_t> bytes(2 * steps.size());
    int previous = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const auto delta = static_cast<std::uint16_t>(steps[i] - previous);
        previous = steps[i];
        bytes[i] = static_cast<std::uint8_t>(delta & 0xFF);
        bytes[steps.size() + i] = static_cast<std::uint8_t>(delta >> 8);
    }
    return bytes;
}

void undoShuffledDeltas(std::span<const std::uint8_t> bytes, std::span<std::int16_t> steps) {
    std::uint16_t sum = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        sum = static_cast<std::uint16_t>(sum + (bytes[i] | bytes[steps.size() + i] << 8));
        steps[i] = static_cast<std::int16_t>(sum);
    }
}

// Measures a clock over some calls, each of which succeeds.
Result<std::vector<double>> timedRounds(int rounds, double (*clockS)(),
                                        const std::function<Result<void>()>& decode) {
    std::vector<double> times;
    for (int round = 0; round < rounds; ++round) {
        const double start = clockS();
        if (Result<void> decoded = decode(); !decoded) return tl::unexpected(decoded.error());
        times.push_back(clockS() - start);
    }
    return times;
}

Result<StoredSquare> storeZstd(const HeightSquare& square, bool shuffled, int rounds) {
    const std::span steps(square.steps);
    const std::vector<std::uint8_t> deltas = shuffled ? shuffledDeltas(steps) : std::vector<std::uint8_t>{};
    const std::vector<char> packed =
        zstdPacked(shuffled ? std::as_bytes(std::span(deltas)) : std::as_bytes(steps));
    std::vector<std::int16_t> decoded(steps.size());
    std::vector<std::uint8_t> bytes(2 * steps.size());
    const auto decode = [&]() -> Result<void> {
        ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
        if (shuffled) undoShuffledDeltas(bytes, decoded);
        return {};
    };
    auto times = timedRounds(rounds, threadCpuS, decode);
    if (!times) return tl::unexpected(times.error());
    return StoredSquare{packed.size(), *std::move(times)};
}

std::vector<std::uint16_t> greyOf(const HeightSquare& square) {
    const std::int32_t darkest = std::ranges::min(square.steps);
    std::vector<std::uint16_t> grey(square.steps.size());
    std::ranges::transform(square.steps, grey.begin(),
                           [&](std::int32_t step) { return static_cast<std::uint16_t>(step - darkest); });
    return grey;
}

Result<StoredSquare> storePng(const HeightSquare& square, const std::filesystem::path& folder, int rounds) {
    const std::filesystem::path file = folder / "square.png";
    if (Result<void> written = writeGrey16(square.side, greyOf(square), file); !written)
        return tl::unexpected(written.error());
    auto times = timedRounds(rounds, threadCpuS, [&]() -> Result<void> {
        const auto read = readGrey16(file);
        if (!read) return tl::unexpected(read.error());
        return {};
    });
    if (!times) return tl::unexpected(times.error());
    return StoredSquare{static_cast<std::size_t>(std::filesystem::file_size(file)), *std::move(times)};
}

void writePgm(const HeightSquare& square, const std::filesystem::path& file) {
    std::ofstream pgm(file, std::ios::binary);
    pgm << fmt::format("P5\n{} {}\n65535\n", square.side, square.side);
    for (const std::uint16_t value : greyOf(square))
        pgm.put(static_cast<char>(value >> 8)).put(static_cast<char>(value & 0xFF));
}

// The command lines of another program; {} stands for the files.
struct OtherProgram {
    const char* extension;
    const char* encode;  // from a PGM
    const char* decode;  // to a PGM
};

bool runs(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

// Returns 0 bytes if the program is not installed.
Result<StoredSquare> storeWith(const OtherProgram& program, const HeightSquare& square,
                               const std::filesystem::path& folder, int rounds) {
    const std::string input = (folder / "square.pgm").string();
    const std::string stored = (folder / "square").string() + program.extension;
    const std::string output = (folder / "decoded.pgm").string();
    writePgm(square, input);
    if (!runs(fmt::format(fmt::runtime(program.encode), input, stored))) return StoredSquare{};
    auto times = timedRounds(rounds, childrenCpuS, [&]() -> Result<void> {
        if (runs(fmt::format(fmt::runtime(program.decode), stored, output))) return {};
        return planet::ioError(fmt::format("{}: cannot be decoded again", stored));
    });
    if (!times) return tl::unexpected(times.error());
    return StoredSquare{static_cast<std::size_t>(std::filesystem::file_size(stored)), *std::move(times)};
}

constexpr OtherProgram openJpeg = {".j2k", "opj_compress -r 1 -i '{}' -o '{}'",
                                   "opj_decompress -i '{}' -o '{}'"};
constexpr OtherProgram gdalJpeg2000 = {
    ".jp2", "gdal_translate -of JP2OpenJPEG -co QUALITY=100 -co REVERSIBLE=YES -co YCBCR420=NO '{}' '{}'",
    "gdal_translate --config GDAL_NUM_THREADS 1 -of PNM '{}' '{}'"};
constexpr OtherProgram jpegXl = {".jxl", "cjxl -d 0 -e 7 --num_threads=1 '{}' '{}'",
                                 "djxl --num_threads=1 '{}' '{}'"};

double secondsOf(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::string nameOf(SquareFormat format) {
    switch (format) {
        case SquareFormat::Zstd:
            return "zstd -3";
        case SquareFormat::ShuffledDeltas:
            return "byte-shuffled deltas, zstd -3";
        case SquareFormat::Png:
            return "16-bit PNG";
        case SquareFormat::Jpeg2000:
            return "reversible JPEG 2000";
        case SquareFormat::JpegXl:
            return "JPEG XL, cjxl -d 0 -e 7";
    }
    return {};
}

Result<StoredSquare> storeSquare(SquareFormat format, const HeightSquare& square,
                                 const std::filesystem::path& folder, int decodingRounds) {
    switch (format) {
        case SquareFormat::Zstd:
            return storeZstd(square, false, decodingRounds);
        case SquareFormat::ShuffledDeltas:
            return storeZstd(square, true, decodingRounds);
        case SquareFormat::Png:
            return storePng(square, folder, decodingRounds);
        case SquareFormat::Jpeg2000: {
            Result<StoredSquare> stored = storeWith(openJpeg, square, folder, decodingRounds);
            if (!stored || stored->bytes > 0) return stored;
            return storeWith(gdalJpeg2000, square, folder, decodingRounds);
        }
        case SquareFormat::JpegXl:
            break;
    }
    return storeWith(jpegXl, square, folder, decodingRounds);
}

double threadCpuS() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double childrenCpuS() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
}

}  // namespace worldy
