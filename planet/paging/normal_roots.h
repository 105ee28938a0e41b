// Derives the normal tiles of the six whole faces, which all other tiles of normals need. They are not in the
// file: deriving one reads all heights of its level. Internal to the library; one thread, except that
// follow() derives the tiles on a thread of its own, one after the other.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>

#include "planet/base/result.h"
#include "planet/paging/normal_tile.h"
#include "planet/paging/tile_paging.h"

namespace planet {

// Reads data that a planet cannot be shown without: repeats a failed read at once.
template <class Read>
auto readRoot(const Read& read) {
    constexpr int attempts = 3;
    auto root = read();
    for (int i = 1; i < attempts && !root && root.error().kind == ErrorKind::Io; ++i) root = read();
    return root;
}

class NormalRoots {
public:
    // deriver: null where the planet has no tiles of normals.
    explicit NormalRoots(std::unique_ptr<NormalDeriver> deriver) : deriver_(std::move(deriver)) {}
    NormalRoots(const NormalRoots&) = delete;
    NormalRoots& operator=(const NormalRoots&) = delete;

    NormalDeriver* deriver() const { return deriver_.get(); }
    // The slots that normals get once their roots are derived; 0 if they are off.
    std::uint32_t capacity() const { return capacity_; }
    const std::string& problem() const { return problem_; }
    // Returns whether normals will begin as soon as their roots are derived.
    bool arePending(const TilePaging& normals) const { return normals.capacity() != capacity_; }

    // Sets the number of slots, and the bytes of heights that are kept to derive tiles from. problem: why
    // there are no normals; it is reported when it changes.
    void set(std::uint32_t capacity, std::size_t heightBytes, const std::string& problem, PagingLog& log);
    // Continues deriving without waiting. Returns true if normals have begun.
    bool follow(TilePaging& normals, PagingRun& run);
    // Derives what is missing and begins normals, or ends them where there are no slots for them.
    void finish(TilePaging& normals, PagingRun& run);
    // Derives the roots that are missing. Returns true if it derived any.
    bool deriveMissing(TilePaging& normals, PagingLog& log);
    // Waits for the root that is being derived.
    void waitUntil(std::chrono::steady_clock::time_point until) const;

private:
    bool take(TilePaging& normals, Result<TileData>&& derived, PagingLog& log);

    std::unique_ptr<NormalDeriver> deriver_;
    std::uint32_t capacity_ = 0;
    std::string problem_;                   // the last that was reported
    std::size_t next_ = 0;                  // the first root that follow() has not asked for
    std::future<Result<TileData>> coming_;  // uses deriver_, so is destroyed before it
};

}  // namespace planet
