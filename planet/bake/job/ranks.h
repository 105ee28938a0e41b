// The processes that bake one planet together, and the messages between them. planet/bake/mpi/ implements it with MPI, and
// the tests with threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace planet {

struct RankMessage {
    int from = 0;
    std::vector<std::byte> bytes;
};

// One thread of a process calls it. The calls do not fail: if a process is lost, the job ends.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int rank() const = 0;   // [0, count())
    virtual int count() const = 0;  // at least 1

    // Sends a message; it may arrive later. Messages between two ranks arrive in their order.
    virtual void send(int to, std::span<const std::byte> bytes) = 0;
    // Returns a message that has arrived, if any.
    virtual std::optional<RankMessage> receive() = 0;

    // All ranks call these together, when no message is under way.
    // Sends bytes to each rank, this one too, and returns those from each.
    virtual std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> toEach) = 0;
    // Returns the sum of the values of all lower ranks.
    virtual std::uint64_t sumBefore(std::uint64_t value) = 0;
};

}  // namespace planet
