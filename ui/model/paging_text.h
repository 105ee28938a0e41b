// Texts of the Paging panel. Pure functions.
#pragma once

#include <string>

#include "planet/paging/disk_simulator.h"
#include "planet/paging/paging_types.h"
#include "planet/sphere/block_id.h"

namespace worldy::ui {

// Returns why children are requested: "ε 3.10 > τ 2.00", or that they are needed less by now. Errors in
// pixels; hysteresis is a share of tau.
std::string pageInReason(double epsPx, double tauPx, double hysteresis, const char* epsSymbol,
                         const char* tauSymbol);
// Returns the same for a colour tile. timesTooFew: its priority, the ratio of wanted to available texels per
// pixel. "62 % of texels".
std::string colourReason(double timesTooFew);
// Returns for example "unused for 12 s".
std::string pageOutReason(double ageS);

// Returns "heights", "colours" or "normals".
const char* kindText(planet::BlockKind kind);

// The totals of one kind of blocks since the planet was opened.
struct KindTotals {
    const char* kind;
    std::uint64_t loaded, evicted, failed, bytesRead;
    std::uint64_t resident;  // blocks of four chunks or tiles: loaded - evicted
    std::size_t tiles;       // chunks or tiles, including roots
    std::uint32_t budgetWaits;
};
KindTotals totalsOf(const char* kind, const planet::BlockCounters& paging);

// Returns true if the settings inject any faults; a seed alone has no effect.
bool isBad(const planet::BadDiskSettings& disk);
// Returns the injected faults: "+200 ms per read, 5 MB/s, 10 % of reads fail, shuffled order"; empty if there
// are none.
std::string badDiskText(const planet::BadDiskSettings& disk);

// Returns a short duration: "3.6 µs", "0.4 ms", "12 ms", "3.25 s", "4 min 10 s".
std::string latencyText(double seconds);

}  // namespace worldy::ui
