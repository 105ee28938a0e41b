#include "planet/bake/job/team.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "planet/base/error_bytes.h"
#include "planet/base/little_endian.h"
#include "planet/base/stopwatch.h"

namespace planet {

namespace {

std::string hostName() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

}  // namespace

Team::Team(Ranks& ranks) : ranks_(ranks), name_(fmt::format("rank {} on {}", ranks.rank(), hostName())) {}

std::vector<std::vector<std::byte>> Team::exchange(std::vector<std::vector<std::byte>> toEach) {
    const Stopwatch stopwatch;
    auto fromEach = ranks_.exchange(std::move(toEach));
    waitedS_ += stopwatch.elapsedS();
    return fromEach;
}

std::vector<std::vector<std::byte>> Team::tellAll(const std::vector<std::byte>& bytes) {
    return exchange(std::vector<std::vector<std::byte>>(static_cast<std::size_t>(count()), bytes));
}

std::uint64_t Team::sumBefore(std::uint64_t value) {
    const Stopwatch stopwatch;
    const std::uint64_t sum = ranks_.sumBefore(value);
    waitedS_ += stopwatch.elapsedS();
    return sum;
}

std::uint64_t Team::sumOf(std::uint64_t value) {
    std::vector<std::byte> bytes;
    ByteWriter(bytes).put(value);
    std::uint64_t sum = 0;
    for (const std::vector<std::byte>& other : tellAll(bytes))
        sum += readLittleEndian<std::uint64_t>(other.data());
    return sum;
}

Result<void> Team::agree(const Result<void>& own) {
    std::vector<std::byte> bytes;
    if (!own) putError(bytes, namedError(*this, own.error()));
    Result<void> outcome;
    for (const std::vector<std::byte>& other : tellAll(bytes)) {
        if (other.empty()) continue;
        ByteReader in(other);
        Error error = takeError(in);
        if (!outcome && (error.kind == ErrorKind::Cancelled || outcome.error().kind != ErrorKind::Cancelled))
            continue;
        outcome = tl::unexpected(std::move(error));
    }
    return outcome;
}

Error namedError(const Team& team, const Error& error) {
    if (error.kind == ErrorKind::Cancelled || team.count() == 1) return error;
    return {error.kind, fmt::format("{}: {}", team.name(), error.message)};
}

}  // namespace planet
