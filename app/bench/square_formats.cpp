#include "app/bench/square_formats.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "app/base/picture_file.h"
#include "planet/base/try.h"

namespace worldy {

namespace {

using planet::Result;

constexpr int zstdLevel = 3;

Result<std::vector<char>> zstdPacked(std::span<const std::byte> bytes) {
    std::vector<char> packed(ZSTD_compressBound(bytes.size()));
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), zstdLevel);
    if (ZSTD_isError(size)) return planet::ioError(fmt::format("zstd: {}", ZSTD_getErrorName(size)));
    packed.resize(size);
    return packed;
}

Result<void> unpackZstd(std::span<const char> packed, std::span<std::uint8_t> bytes) {
    const std::size_t size = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
    if (ZSTD_isError(size)) return planet::ioError(fmt::format("zstd: {}", ZSTD_getErrorName(size)));
    if (size == bytes.size()) return {};
    return planet::ioError(fmt::format("zstd: {} bytes decoded; expected {}", size, bytes.size()));
}

// A benchmark of a format that loses something would compare what cannot be compared.
template <class A, class B>
Result<void> checkLossless(SquareFormat format, const A& decoded, const B& samples) {
    if (std::ranges::equal(decoded, samples)) return {};
    return planet::ioError(
        fmt::format("{}: the decoded samples differ; expected those that were stored", nameOf(format)));
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
        TRY(decode());
        times.push_back(clockS() - start);
    }
    return times;
}

Result<StoredSquare> storeZstd(const HeightSquare& square, bool shuffled, int rounds) {
    const std::span steps(square.steps);
    const std::vector<std::uint8_t> deltas = shuffled ? shuffledDeltas(steps) : std::vector<std::uint8_t>{};
    TRY_ASSIGN(const std::vector<char> packed,
               zstdPacked(shuffled ? std::as_bytes(std::span(deltas)) : std::as_bytes(steps)));
    std::vector<std::int16_t> decoded(steps.size());
    std::vector<std::uint8_t> bytes(2 * steps.size());
    const auto decode = [&]() -> Result<void> {
        TRY(unpackZstd(packed, bytes));
        if (shuffled) undoShuffledDeltas(bytes, decoded);
        return {};
    };
    TRY(decode());
    if (!shuffled) std::memcpy(decoded.data(), bytes.data(), bytes.size());
    TRY(checkLossless(shuffled ? SquareFormat::ShuffledDeltas : SquareFormat::Zstd, decoded, steps));
    TRY_ASSIGN(std::vector<double> times, timedRounds(rounds, threadCpuS, decode));
    return StoredSquare{packed.size(), std::move(times)};
}

std::vector<std::uint16_t> greyOf(const HeightSquare& square) {
    const std::int32_t darkest = std::ranges::min(square.steps);
    std::vector<std::uint16_t> grey(square.steps.size());
    std::ranges::transform(square.steps, grey.begin(),
                           [&](std::int32_t step) { return static_cast<std::uint16_t>(step - darkest); });
    return grey;
}

Result<std::size_t> bytesOf(const std::filesystem::path& file) {
    std::error_code status;
    const std::uintmax_t bytes = std::filesystem::file_size(file, status);
    if (status) return planet::ioError(fmt::format("{}: {}", file.string(), status.message()));
    return static_cast<std::size_t>(bytes);
}

Result<StoredSquare> storePng(const HeightSquare& square, const std::filesystem::path& folder, int rounds) {
    const std::filesystem::path file = folder / "square.png";
    const std::vector<std::uint16_t> grey = greyOf(square);
    TRY(writeGrey16(square.side, grey, file));
    TRY_ASSIGN(const Grey16 decoded, readGrey16(file));
    TRY(checkLossless(SquareFormat::Png, decoded.samples, grey));
    TRY_ASSIGN(std::vector<double> times, timedRounds(rounds, threadCpuS, [&]() -> Result<void> {
                   TRY(readGrey16(file));
                   return {};
               }));
    TRY_ASSIGN(const std::size_t bytes, bytesOf(file));
    return StoredSquare{bytes, std::move(times)};
}

Result<void> writePgm(const HeightSquare& square, const std::filesystem::path& file) {
    std::ofstream pgm(file, std::ios::binary);
    pgm << fmt::format("P5\n{} {}\n65535\n", square.side, square.side);
    for (const std::uint16_t value : greyOf(square))
        pgm.put(static_cast<char>(value >> 8)).put(static_cast<char>(value & 0xFF));
    pgm.close();
    if (pgm) return {};
    return planet::ioError(fmt::format("{}: cannot be written; expected room on the disk", file.string()));
}

// Returns the samples of a PGM of 16 bits, which the other programs write; nothing if it is none.
std::vector<std::uint16_t> samplesOfPgm(const std::filesystem::path& file) {
    std::ifstream pgm(file, std::ios::binary);
    const auto word = [&] {
        std::string text;
        while (pgm >> text && text.starts_with('#')) std::getline(pgm, text);  // a comment
        return text;
    };
    const std::string magic = word();
    word();  // the width
    word();  // the height
    const std::string most = word();
    pgm.get();  // the one white space before the samples
    std::vector<std::uint16_t> samples;
    if (magic != "P5" || most != "65535") return samples;
    std::array<char, 2> bytes{};
    while (pgm.read(bytes.data(), bytes.size()))
        samples.push_back(static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[0]) << 8 |
                                                     static_cast<unsigned char>(bytes[1])));
    return samples;
}

// The command lines of another program; {} stands for the files.
struct OtherProgram {
    const char* extension;
    const char* encode;  // from a PGM
    const char* decode;  // to a PGM
};

// Runs a command. Returns nothing if it succeeds; otherwise what is wrong, with the last line that it printed.
std::optional<std::string> problemOfRunning(const std::string& command, const std::filesystem::path& log) {
    const std::string program = command.substr(0, command.find(' '));
    const int status = std::system(fmt::format("{} >'{}' 2>&1", command, log.string()).c_str());
    if (status == 0) return std::nullopt;
    constexpr int notFound = 127;  // of the shell
    const bool hasExited = status != -1 && WIFEXITED(status);
    if (hasExited && WEXITSTATUS(status) == notFound) return fmt::format("{} is not installed", program);
    std::string line, last;
    for (std::ifstream lines(log); std::getline(lines, line);)
        if (!line.empty()) last = line;
    const std::string how = hasExited ? fmt::format("exit code {}", WEXITSTATUS(status)) : "a signal";
    return fmt::format("{} ended with {}: {}", program, how, last.empty() ? "no message" : last);
}

Result<StoredSquare> storeWith(SquareFormat format, const OtherProgram& program, const HeightSquare& square,
                               const std::filesystem::path& folder, int rounds) {
    const std::string input = (folder / "square.pgm").string();
    const std::string stored = (folder / "square").string() + program.extension;
    const std::string output = (folder / "decoded.pgm").string();
    const std::filesystem::path log = folder / "log.txt";
    TRY(writePgm(square, input));
    if (auto problem = problemOfRunning(fmt::format(fmt::runtime(program.encode), input, stored), log))
        return StoredSquare{.problem = *std::move(problem)};
    const auto decode = [&]() -> Result<void> {
        const auto problem = problemOfRunning(fmt::format(fmt::runtime(program.decode), stored, output), log);
        if (!problem) return {};
        return planet::ioError(fmt::format("{}: cannot be decoded again: {}", stored, *problem));
    };
    TRY(decode());
    TRY(checkLossless(format, samplesOfPgm(output), greyOf(square)));
    TRY_ASSIGN(std::vector<double> times, timedRounds(rounds, childrenCpuS, decode));
    TRY_ASSIGN(const std::size_t bytes, bytesOf(stored));
    return StoredSquare{bytes, std::move(times)};
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
            TRY_ASSIGN(StoredSquare stored, storeWith(format, openJpeg, square, folder, decodingRounds));
            if (stored.problem.empty()) return stored;
            TRY_ASSIGN(StoredSquare other, storeWith(format, gdalJpeg2000, square, folder, decodingRounds));
            if (!other.problem.empty()) other.problem = fmt::format("{}; {}", stored.problem, other.problem);
            return other;
        }
        case SquareFormat::JpegXl:
            break;
    }
    return storeWith(format, jpegXl, square, folder, decodingRounds);
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
