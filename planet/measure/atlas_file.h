// The file of an atlas.
//
//     8 bytes   "WORLDYAT"
//     u32       version, 1
//     u32       0
//
// Then records: u32 kind, u32 bytes of the content, u64 XXH3 of the content, seeded with kind + 2^32 bytes, and the
// content. All numbers are little-endian; a text is a u32 length and UTF-8; a float is its IEEE 754 bits.
//
//     kind 1  the survey, once and first: texts of the bake's name, the settings and the regions; u64 the bake's hash;
//             f64 radius; i32 width, height; f64 field of view; u8 measures the error; u8 is a revisit; then the grid:
//             u32 count and f64 altitudes; i32 headings; f64 pitch; i32 coarsest and finest level; u64 most viewpoints
//     kind 2  the tree, at most once: u32 count, then for each chunk a u8, bit 0 it has children, bit 1 it is a
//             summary; f32 δc; u32 digest
//     kind 3  viewpoints, [1, 32]: for each u8 face, level, altitude, heading; u32 x, y; f64 eye; f64 for each measure,
//             NaN for what was not measured, infinity for a predicted error without a bound
//     kind 4  the end, empty: the survey is finished
//
// While a survey runs, its file has the extension ".part" after its own, and records are appended to it. Wherever the
// program is killed, the complete records are an unfinished atlas that can be continued.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"
#include "planet/measure/atlas.h"

namespace planet {

// Reads an atlas from its bytes, which are untrusted. An incomplete last record is left out. name: for Errors, which say
// what is wrong and what is expected. keptBytes: receives the length of the complete records.
Result<Atlas> atlasFromBytes(std::span<const std::byte> bytes, const std::string& name,
                             std::uint64_t* keptBytes = nullptr);
Result<Atlas> loadAtlas(const std::filesystem::path& file);

// The name under which an unfinished survey is kept.
std::filesystem::path unfinishedAtlas(const std::filesystem::path& file);
// Returns the name that an unfinished survey has when it is finished; other names stay as they are.
std::filesystem::path finishedAtlas(const std::filesystem::path& file);
// Returns whether a file has the name of an atlas, NAME.atlas, or of an unfinished one, NAME.atlas.part.
bool isNamedAtlas(const std::filesystem::path& file);

// Writes the file of a survey while it runs. A file has one writer at a time. One thread.
class AtlasWriter {
public:
    // Begins a new file.
    static Result<AtlasWriter> create(const std::filesystem::path& file, const AtlasSurvey& survey,
                                      const AtlasTree& tree, const FileCalls& calls = systemFileCalls());
    // Continues the unfinished file. Returns its atlas as well; nothing if there is no unfinished file.
    struct Resumed;
    static Result<std::optional<Resumed>> resume(const std::filesystem::path& file,
                                                 const FileCalls& calls = systemFileCalls());

    Result<void> append(std::span<const AtlasViewpoint> viewpoints);
    // Marks the survey as finished, syncs the file and gives it its name.
    Result<void> finish();

private:
    AtlasWriter(std::filesystem::path file, OpenFile open, std::uint64_t bytes)
        : file_(std::move(file)), open_(std::move(open)), bytes_(bytes) {}
    Result<void> write(std::span<const std::byte> bytes);

    std::filesystem::path file_;
    OpenFile open_;
    std::uint64_t bytes_ = 0;
};

struct AtlasWriter::Resumed {
    AtlasWriter writer;
    Atlas atlas;
};

}  // namespace planet
