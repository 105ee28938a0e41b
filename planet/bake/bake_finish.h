// The end of a bake, when all blocks below the roots are in the file.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "planet/bake/bake_report.h"
#include "planet/bake/bake_settings.h"
#include "planet/bake/bake_tile.h"
#include "planet/bake/subtree_merging.h"
#include "planet/base/atomic_file.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_types.h"
#include "planet/format/source_record.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source_types.h"

namespace planet {

// The weight of a colour tile in the progress.
inline constexpr std::uint64_t samplesPerColourTile = std::uint64_t{colourTileCells} * colourTileCells;

// Appends the root blocks and fills in the header, but for the counts of chunks. roots: in the order of the faces.
Result<void> writeRoots(const BakeContext& bake, std::span<const DeferredChunk, faceCount> roots,
                        AtomicFile& file, ChunkFileInfo& info);

// Opens a file that has blocks but no header yet, with a header that is only in memory: nothing can take the file for a
// finished one if the bake is killed. bytes: written so far. anyStep: a step of the planet. readBlocks: reads bytes of the
// file.
Result<ChunkFile> openUnfinished(const std::string& name, std::uint64_t bytes, const PlanetShape& shape,
                                 std::int32_t anyStep, const ReadAt& readBlocks);

// Appends the record, writes the header, and gives the file its name.
Result<void> commitBake(const std::optional<SourceRecord>& record, AtomicFile& file, ChunkFileInfo& info);

// Fills in what the report says of the source, the header and the errors of the roots.
void describeBake(const HeightSource& source, const BakeSettings& settings, const ColourSource* colour,
                  const ChunkFileInfo& info, std::span<const DeferredChunk, faceCount> roots,
                  BakeReport& report);

}  // namespace planet
