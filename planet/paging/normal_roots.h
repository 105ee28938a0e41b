// Derives the normal tiles of the six whole faces, on which all other normal tiles depend. They are not in
// the file: deriving one reads all heights of its level. Internal to the library; one thread, except that
// follow() derives the tiles on a separate thread, one at a time.
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

// Reads data without which a planet cannot be shown: retries a failed read at once.
template <class Read>
auto readRoot(const Read& read) {
    constexpr int attempts = 3;
    auto root = read();
    for (int i = 1; i < attempts && !root && root.error().kind == ErrorKind::Io; ++i) root = read();
    return root;
}

class NormalRoots {
public:
    // deriver: null if the planet has no tiles of normals.
    explicit NormalRoots(std::unique_ptr<NormalDeriver> deriver) : deriver_(std::move(deriver)) {}
    NormalRoots(const NormalRoots&) = delete;
    NormalRoots& operator=(const NormalRoots&) = delete;

    NormalDeriver* deriver() const { return deriver_.get(); }
    // Returns the number of slots for normals once their roots are derived; 0 if normals are off.
    std::uint32_t capacity() const { return capacity_; }
    const std::string& problem() const { return problem_; }
    // Returns whether normals will begin as soon as their roots are derived.
    bool arePending(const TilePaging& normals) const { return normals.capacity() != capacity_; }

    // Sets the number of slots, and the bytes of cached heights to derive tiles from. problem: the reason why
    // there are no normals; it is reported when it changes.
    void set(std::uint32_t capacity, std::size_t heightBytes, const std::string& problem, PagingLog& log);
    // Continues deriving without waiting. Returns true if normals have begun.
    bool follow(TilePaging& normals, PagingRun& run);
    // Derives the missing roots and begins normals, or ends normals if they have no slots.
    void finish(TilePaging& normals, PagingRun& run);
    // Derives the missing roots. Returns true if it derived any.
    bool deriveMissing(TilePaging& normals, PagingLog& log);
    // Waits until the pending root is derived, or until the given time.
    void waitUntil(std::chrono::steady_clock::time_point until) const;

private:
    bool take(TilePaging& normals, Result<TileData>&& derived, PagingLog& log);

    std::unique_ptr<NormalDeriver> deriver_;
    std::uint32_t capacity_ = 0;
    std::string problem_;                   // last reported
    std::size_t next_ = 0;                  // the first root that follow() has not started
    std::future<Result<TileData>> coming_;  // uses deriver_, so it is destroyed before it
};

}  // namespace planet
