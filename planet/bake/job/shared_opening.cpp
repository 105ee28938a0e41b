#include "planet/bake/job/shared_opening.h"

#include <algorithm>

#include "planet/base/little_endian.h"
#include "planet/source/source_parts.h"

namespace planet {

namespace {

// The start of each message. A rank that has ended its opening goes on sending Ended, until all have: so no rank waits for an
// exchange to which another does not come.
enum class Turn : std::uint8_t { Survey, Ended };
constexpr std::size_t headBytes = 1 + sizeof(std::uint64_t);

std::vector<std::byte> messageOf(Turn turn, std::uint64_t program, std::span<const std::byte> bytes) {
    std::vector<std::byte> message;
    message.reserve(headBytes + bytes.size());
    ByteWriter to(message);
    to.put(static_cast<std::uint8_t>(turn));
    to.put(program);
    message.insert(message.end(), bytes.begin(), bytes.end());
    return message;
}

bool isOf(Turn turn, const std::vector<std::byte>& message) {
    return message[0] == static_cast<std::byte>(turn);
}

}  // namespace

SharedOpening::SharedOpening(Team& team, std::string_view program)
    : team_(team), program_(Fingerprint().add(program).hash()) {}

std::shared_ptr<const SurveyShare> SharedOpening::share() {
    return std::make_shared<const SurveyShare>(
        SurveyShare{team_.rank(), team_.count(), [this](std::span<const std::byte> own, double tookS) {
                        surveyS_ += tookS;
                        return exchange(own);
                    }});
}

std::optional<std::vector<std::vector<std::byte>>> SharedOpening::exchange(std::span<const std::byte> own) {
    auto all = team_.tellAll(messageOf(Turn::Survey, program_, own));
    const auto joins = [&](const std::vector<std::byte>& message) {
        return isOf(Turn::Survey, message) && readLittleEndian<std::uint64_t>(message.data() + 1) == program_;
    };
    if (!std::ranges::all_of(all, joins)) return std::nullopt;
    for (std::vector<std::byte>& message : all) message.erase(message.begin(), message.begin() + headBytes);
    return all;
}

std::vector<double> SharedOpening::finish() {
    std::vector<std::byte> took;
    ByteWriter(took).put(surveyS_);
    const std::vector<std::byte> ended = messageOf(Turn::Ended, program_, took);
    for (;;) {
        const auto all = team_.tellAll(ended);
        if (!std::ranges::all_of(all, [](const auto& message) { return isOf(Turn::Ended, message); }))
            continue;
        std::vector<double> seconds;
        for (const std::vector<std::byte>& message : all)
            seconds.push_back(readLittleEndian<double>(message.data() + headBytes));
        return seconds;
    }
}

}  // namespace planet
