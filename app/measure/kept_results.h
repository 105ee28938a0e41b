// The results of sweeps and of comparisons over flights that the next start shows again. They lie in a file of their own,
// because they are many: results.toml beside the session's file.
//
// A result belongs to chunk files. Each is noted with its size and its time, so that a result whose file has changed since
// is recognised.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/measure/comparison.h"
#include "app/measure/sweep_table.h"
#include "planet/base/result.h"

namespace worldy {

// A file as it was when it was measured.
struct MeasuredFile {
    std::filesystem::path file;
    std::uint64_t bytes = 0;
    std::int64_t modified = 0;  // ticks of the file system's clock

    bool operator==(const MeasuredFile&) const = default;
};
// Returns a file as it is now; bytes and modified are 0 if there is none.
MeasuredFile measuredFileOf(const std::filesystem::path& file);

struct KeptSweep {
    SweepTable table;
    std::vector<int> chunkSizes;      // of each file
    std::vector<MeasuredFile> files;  // at least one
};
struct KeptSuggestions {
    std::vector<SweepSuggestion> found;
    std::vector<MeasuredFile> files;
};
struct KeptFlight {
    std::string name;
    ComparedPair figures;
    std::vector<MeasuredFile> files;  // of A and B
};
struct KeptResults {
    std::optional<KeptSweep> sweep{};
    std::optional<KeptSuggestions> suggestions{};
    std::optional<KeptFlight> flight{};
};

// Returns configFolder()/results.toml.
std::filesystem::path keptResultsFile();

// A file that does not exist holds no results. The Error names the file, the line and what is expected.
planet::Result<KeptResults> loadKeptResults(const std::filesystem::path& file);
// Returns the text of the file.
std::string keptResultsText(const KeptResults& results);

// Returns "/terrain/alps.chk has changed" or "... is gone" for the first file that has; empty if none has.
std::string changedSince(std::span<const MeasuredFile> files);

}  // namespace worldy
