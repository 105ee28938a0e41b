#include "planet/bake/mpi/mpi_module.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdint>
#include <list>
#include <thread>
#include <vector>

namespace planet {

namespace {

// MPI ends the whole job on any failure of its own (MPI_ERRORS_ARE_FATAL), so no call here returns one.
class MpiRanks final : public Ranks {
public:
    MpiRanks() {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &count_);
    }
    ~MpiRanks() override {
        // The rank that was to receive the rest has failed as well.
        for (Sending& sending : sendings_) {
            MPI_Cancel(&sending.request);
            MPI_Request_free(&sending.request);
        }
        MPI_Finalize();
    }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    int rank() const override { return rank_; }
    int count() const override { return count_; }

    void send(int to, std::span<const std::byte> bytes) override {
        Sending& sending = sendings_.emplace_back();
        sending.bytes.assign(bytes.begin(), bytes.end());
        MPI_Isend(sending.bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD,
                  &sending.request);
    }

    std::optional<RankMessage> receive() override {
        sendings_.remove_if([](Sending& sending) { return hasEnded(sending.request); });
        int arrived = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &arrived, &status);
        if (!arrived) return std::nullopt;
        int bytes = 0;
        MPI_Get_count(&status, MPI_BYTE, &bytes);
        RankMessage message{status.MPI_SOURCE, std::vector<std::byte>(static_cast<std::size_t>(bytes))};
        MPI_Recv(message.bytes.data(), bytes, MPI_BYTE, message.from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        return message;
    }

    std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> toEach) override {
        const auto ranks = static_cast<std::size_t>(count_);
        std::vector<std::uint64_t> sent(ranks);
        std::vector<std::uint64_t> received(ranks);
        for (std::size_t rank = 0; rank < ranks; ++rank) sent[rank] = toEach[rank].size();
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Ialltoall(sent.data(), 1, MPI_UINT64_T, received.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD,
                      &request);
        wait(request);
        std::vector<std::vector<std::byte>> fromEach(ranks);
        for (std::size_t rank = 0; rank < ranks; ++rank)
            fromEach[rank].resize(static_cast<std::size_t>(received[rank]));
        // MPI counts bytes in ints, so long messages go in parts.
        const std::uint64_t most = static_cast<std::uint64_t>(INT_MAX) / ranks;
        std::uint64_t longest =
            std::max(*std::ranges::max_element(sent), *std::ranges::max_element(received));
        MPI_Iallreduce(MPI_IN_PLACE, &longest, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD, &request);
        wait(request);
        for (std::uint64_t begin = 0; begin < longest; begin += most) {
            Part out = partOf(toEach, begin, most);
            Part in = partOf(fromEach, begin, most);
            for (std::size_t rank = 0; rank < ranks; ++rank)
                std::copy_n(toEach[rank].begin() +
                                static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(begin, sent[rank])),
                            out.counts[rank], out.bytes.begin() + out.places[rank]);
            MPI_Ialltoallv(out.bytes.data(), out.counts.data(), out.places.data(), MPI_BYTE, in.bytes.data(),
                           in.counts.data(), in.places.data(), MPI_BYTE, MPI_COMM_WORLD, &request);
            wait(request);
            for (std::size_t rank = 0; rank < ranks; ++rank)
                std::copy_n(in.bytes.begin() + in.places[rank], in.counts[rank],
                            fromEach[rank].begin() +
                                static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(begin, received[rank])));
        }
        return fromEach;
    }

    std::uint64_t sumBefore(std::uint64_t value) override {
        std::uint64_t sum = 0;
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Iexscan(&value, &sum, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD, &request);
        wait(request);
        return rank_ == 0 ? 0 : sum;  // MPI leaves it undefined there
    }

private:
    static constexpr int tag = 1;

    struct Sending {
        std::vector<std::byte> bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    // A part of the messages to or from all ranks, one after the other.
    struct Part {
        std::vector<int> counts;
        std::vector<int> places;
        std::vector<std::byte> bytes;
    };

    static Part partOf(const std::vector<std::vector<std::byte>>& messages, std::uint64_t begin,
                       std::uint64_t most) {
        Part part;
        int at = 0;
        for (const std::vector<std::byte>& message : messages) {
            const std::uint64_t left = message.size() - std::min<std::uint64_t>(begin, message.size());
            part.counts.push_back(static_cast<int>(std::min(left, most)));
            part.places.push_back(at);
            at += part.counts.back();
        }
        part.bytes.resize(static_cast<std::size_t>(at));
        return part;
    }

    static bool hasEnded(MPI_Request& request) {
        int ended = 0;
        MPI_Test(&request, &ended, MPI_STATUS_IGNORE);
        return ended != 0;
    }

    // Waits without keeping a core busy, which MPI_Wait would.
    static void wait(MPI_Request& request) {
        constexpr int promptTests = 1000;
        for (int tests = 0; !hasEnded(request); ++tests) {
            if (tests > promptTests) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    int rank_ = 0;
    int count_ = 1;
    std::list<Sending> sendings_;
};

}  // namespace

}  // namespace planet

extern "C" [[gnu::visibility("default")]] const planet::MpiModule planetMpiModule;

extern "C" const planet::MpiModule planetMpiModule = {
    WORLDY_VERSION, sizeof(planet::RankMessage),
    []() -> std::unique_ptr<planet::Ranks> { return std::make_unique<planet::MpiRanks>(); }};
