#include "planet/source/source_parts.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <numbers>

#include "planet/base/file_calls.h"
#include "planet/base/open_file.h"
#include "planet/base/parallel.h"
#include "planet/base/try.h"

namespace planet {

namespace {

constexpr std::uint64_t mostHashedBytes = 256u << 20;  // of one file
constexpr std::uint64_t hashedHeadBytes = 1u << 20;    // of a larger one
constexpr std::uint64_t readBytes = 4u << 20;          // at once

Result<std::uint64_t> hashOfFile(const std::filesystem::path& path) {
    TRY_ASSIGN(const auto file, OpenFile::open(path, O_RDONLY, systemFileCalls()));
    struct stat status {};
    if (::fstat(file.descriptor(), &status) != 0)
        return ioError(fmt::format("{}: cannot be read: {}", path.string(), lastSystemError()));
    const auto size = static_cast<std::uint64_t>(status.st_size);
    const bool isWhole = size <= mostHashedBytes;
    Fingerprint fingerprint;
    fingerprint.add(size);
    if (!isWhole) {
        fingerprint.add(std::int64_t{status.st_mtim.tv_sec});
        fingerprint.add(std::int64_t{status.st_mtim.tv_nsec});
    }
    const std::uint64_t end = isWhole ? size : hashedHeadBytes;
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min(end, readBytes)));
    for (std::uint64_t at = 0; at < end; at += bytes.size()) {
        const auto part =
            std::span(bytes).first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), end - at)));
        TRY(file.read(at, part));
        fingerprint.add(std::uint64_t{XXH3_64bits(part.data(), part.size())});
    }
    return fingerprint.hash();
}

}  // namespace

Fingerprint& Fingerprint::add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char letter : text) add(letter);
    return *this;
}

std::uint64_t Fingerprint::hash() const {
    return XXH3_64bits(bytes_.data(), bytes_.size());
}

Result<std::uint64_t> hashOfFiles(const std::vector<std::filesystem::path>& files) {
    TRY_ASSIGN(const auto hashes, hashesOfFiles({files}));
    return hashes[0];
}

Result<std::vector<std::uint64_t>> hashesOfFiles(
    const std::vector<std::vector<std::filesystem::path>>& lists) {
    std::vector<std::filesystem::path> files;
    for (const auto& list : lists) files.insert(files.end(), list.begin(), list.end());
    std::vector<Result<std::uint64_t>> hashes(files.size());
    parallelFor(files.size(), [&](std::size_t i) { hashes[i] = hashOfFile(files[i]); });
    std::vector<std::uint64_t> ofLists;
    std::size_t next = 0;
    for (const auto& list : lists) {
        Fingerprint fingerprint;
        for (std::size_t i = 0; i < list.size(); ++i) {
            TRY_ASSIGN(const auto hash, hashes[next++]);
            fingerprint.add(hash);
        }
        ofLists.push_back(fingerprint.hash());
    }
    return ofLists;
}

std::uint64_t hashOf(const HeightSourceSettings& settings) {
    Fingerprint fingerprint;
    const auto addOptional = [&](const auto& value) {
        fingerprint.add(static_cast<std::uint8_t>(value.has_value()));
        if (value) fingerprint.add(*value);
    };
    addOptional(settings.metresPerUnit);
    addOptional(settings.offsetM);
    addOptional(settings.noDataValue);
    addOptional(settings.rawSize);
    addOptional(settings.rawBits);
    addOptional(settings.colourChannel);
    fingerprint.add(settings.fillM);
    fingerprint.add(static_cast<std::uint8_t>(settings.rawSigned));
    fingerprint.add(static_cast<std::uint8_t>(settings.rawBigEndian));
    return fingerprint.hash();
}

SourcePart wholePlanet(std::uint64_t signature, const SampleDensities& densities) {
    return {signature, {1, 0, 0}, std::numbers::pi, densities};
}

}  // namespace planet
