// What the paging panel says in words. Pure functions.
#pragma once

#include <string>

#include "planet/paging/disk_simulator.h"
#include "planet/paging/paging_types.h"
#include "planet/sphere/block_id.h"

namespace worldy::ui {

// Why children are asked for: "ε 3.1 > τ 2.0". Where the chunk has meanwhile come to need them less, it says
// so. All in pixels; hysteresis is a share of tau.
std::string pageInReason(double epsPx, double tauPx, double hysteresis, const char* epsSymbol,
                         const char* tauSymbol);
// The same of a tile of colour, by its priority: how many times too few texels a pixel it has. "62 % of its
// texels".
std::string colourReason(double timesTooFew);
// "unused for 12 s".
std::string pageOutReason(double ageS);

// "heights", "colours", "normals".
const char* kindText(planet::BlockKind kind);

// The totals of one kind of blocks since the planet was opened.
struct KindTotals {
    const char* kind;
    std::uint64_t loaded, evicted, failed, bytesRead;
    std::uint64_t resident;  // blocks of four: loaded - evicted
    std::size_t tiles;       // chunks or tiles, roots included
    std::uint32_t budgetWaits;
};
KindTotals totalsOf(const char* kind, const planet::BlockCounters& paging);

// Whether the disk is made bad at all: a seed alone does nothing.
bool isBad(const planet::BadDiskSettings& disk);
// What is made bad: "+200 ms a read, 5 MB/s, 10 % of the reads fail, shuffled order"; empty where nothing is.
std::string badDiskText(const planet::BadDiskSettings& disk);

// A duration as short as it can be said: "3.6 µs", "0.4 ms", "12 ms", "3.25 s", "4 min 10 s".
std::string latencyText(double seconds);

}  // namespace worldy::ui
