#include "app/data/bake_ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/base/module.h"
#include "planet/bake/mpi/mpi_module.h"
#include "planet/source/source_parts.h"

namespace worldy {

namespace {

// The only rank of a bake that runs alone.
class OnlyRank final : public planet::Ranks {
public:
    int rank() const override { return 0; }
    int count() const override { return 1; }
    void send(int, std::span<const std::byte> bytes) override {
        messages_.push_back({0, {bytes.begin(), bytes.end()}});
    }
    std::optional<planet::RankMessage> receive() override {
        if (messages_.empty()) return std::nullopt;
        planet::RankMessage message = std::move(messages_.front());
        messages_.erase(messages_.begin());
        return message;
    }
    std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> toEach) override {
        return toEach;
    }
    std::uint64_t sumBefore(std::uint64_t) override { return 0; }

private:
    std::vector<planet::RankMessage> messages_;
};

}  // namespace

bool isOneOfSeveralRanks() {
    // Open MPI, PMIx and PMI tell a process so what it is.
    constexpr std::array names = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};
    return std::ranges::any_of(names, [](const char* name) { return std::getenv(name) != nullptr; });
}

planet::Result<std::unique_ptr<planet::Ranks>> joinRanks() {
    if (!isOneOfSeveralRanks()) return std::make_unique<OnlyRank>();
    constexpr const char* file = "worldy_mpi.so";
    // Open MPI loads parts of itself, which need its symbols.
    const planet::Result<const void*> found =
        loadModule(file, "planetMpiModule",
                   "is built with -DWORLDY_MPI=ON and bakes on several ranks; without it, bake "
                   "without mpirun or srun",
                   true);
    if (!found) return tl::unexpected(found.error());
    const auto* const module = static_cast<const planet::MpiModule*>(*found);
    if (module->version != WORLDY_VERSION || module->messageBytes != sizeof(planet::RankMessage))
        return tl::unexpected(otherBuild(file, std::string(module->version)));
    return module->start();
}

planet::Result<std::string> programBuild() {
    return planet::hashOfFiles({"/proc/self/exe"}).map([](std::uint64_t hash) {
        return fmt::format("Worldy {}, build {:016x}", WORLDY_VERSION, hash);
    });
}

}  // namespace worldy
