#include "planet/paging/normal_roots.h"

#include <utility>

#include "planet/spans/span_recorder.h"

namespace planet {

void NormalRoots::set(std::uint32_t capacity, std::size_t heightBytes, const std::string& problem,
                      PagingLog& log) {
    if (!problem.empty() && problem != problem_) log.report(problem);
    problem_ = problem;
    capacity_ = deriver_ ? capacity : 0;
    next_ = 0;
    if (deriver_) deriver_->keepHeights(heightBytes);
}

bool NormalRoots::follow(TilePaging& normals, PagingRun& run) {
    if (!arePending(normals)) return false;
    if (coming_.valid()) {
        if (coming_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
        take(normals, coming_.get(), run.log);
    }
    while (next_ < faceCount && !normals.roots[next_].texels.empty()) ++next_;
    if (next_ == faceCount) {
        normals.begin(capacity_, run.sinceResetS);
        return true;
    }
    coming_ = std::async(std::launch::async, [deriver = deriver_.get(), id = normals.roots[next_++].id] {
        nameSpanThread("normals of faces");
        const SpanScope span("derive", BlockId(id, BlockKind::Normals));
        return readRoot([&] { return deriver->tile(id); });
    });
    return false;
}

void NormalRoots::finish(TilePaging& normals, PagingRun& run) {
    if (coming_.valid()) take(normals, coming_.get(), run.log);
    if (capacity_ > 0) deriveMissing(normals, run.log);
    normals.begin(capacity_, run.sinceResetS);
}

bool NormalRoots::deriveMissing(TilePaging& normals, PagingLog& log) {
    bool any = false;
    for (std::size_t face = 0; face < faceCount; ++face) {
        const ChunkId id = normals.roots[face].id;
        if (normals.roots[face].texels.empty())
            any |= take(normals, readRoot([&] { return deriver_->tile(id); }), log);
    }
    return any;
}

bool NormalRoots::take(TilePaging& normals, Result<TileData>&& derived, PagingLog& log) {
    if (derived)
        normals.roots[static_cast<std::size_t>(derived->id.face)] = std::move(*derived);
    else
        log.report(std::move(derived.error().message));
    return derived.has_value();
}

void NormalRoots::waitUntil(std::chrono::steady_clock::time_point until) const {
    if (coming_.valid()) coming_.wait_until(until);
}

}  // namespace planet
