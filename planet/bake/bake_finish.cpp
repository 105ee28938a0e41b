#include "planet/bake/bake_finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"
#include "planet/format/height_codec.h"
#include "planet/source/height_quanta.h"

namespace planet {

namespace {

// Says that the finest part of the source needs a finer quantum than the steps allow; empty if it does not.
std::string quantumNotice(const HeightSource& source, const BakeSettings& settings,
                          const PlanetShape& shape) {
    if (settings.quantumM && !settings.finestQuantumM) return {};
    const double neededM =
        std::max(settings.finestQuantumM.value_or(0), finestQuantumOf(source, shape.radiusM));
    if (shape.quantumM <= neededM * (1 + 1e-6)) return {};
    return fmt::format(
        "{}: its finest heights need a quantum of {} m, but heights in [{}, {}] m allow no finer one than {} "
        "m",
        source.description, neededM, source.minM, source.maxM, shape.quantumM);
}

}  // namespace

Result<void> writeRoots(const BakeContext& bake, std::span<const DeferredChunk, faceCount> roots,
                        AtomicFile& file, ChunkFileInfo& info) {
    info.shape = bake.shape;
    info.missingSamples = bake.source.missingCount;
    info.source = bake.source.description;
    info.minStep = roots[0].baked.entry.minStep;
    info.maxStep = roots[0].baked.entry.maxStep;
    for (const DeferredChunk& held : roots) {
        const BakedChunk& root = held.baked;
        info.minStep = std::min(info.minStep, root.entry.minStep);
        info.maxStep = std::max(info.maxStep, root.entry.maxStep);
        std::vector<std::byte> block;
        putIndex(block, {&root.entry, 1}, file.size());
        encodeGrid(root.heights, chunkSize(bake.shape), bake.shape.fractionBits, block);
        ByteWriter(block).put(rootChecksum(block, root.id.face));
        info.roots[static_cast<std::size_t>(root.id.face)] = {file.size(),
                                                              static_cast<std::uint32_t>(block.size())};
        TRY(file.append(block));
    }
    return {};
}

Result<ChunkFile> openUnfinished(const std::string& name, std::uint64_t bytes, const PlanetShape& shape,
                                 std::int32_t anyStep, const ReadAt& readBlocks) {
    ChunkFileInfo info;
    info.shape = shape;
    info.minStep = info.maxStep = anyStep;
    return ChunkFile::open(name, bytes,
                           [header = headerBytes(info, bytes), readBlocks](
                               std::uint64_t offset, std::span<std::byte> out) -> Result<void> {
                               if (offset >= header.size()) return readBlocks(offset, out);
                               std::ranges::copy(
                                   std::span(header).subspan(static_cast<std::size_t>(offset), out.size()),
                                   out.begin());
                               return {};
                           });
}

Result<void> commitBake(const std::optional<SourceRecord>& record, AtomicFile& file, ChunkFileInfo& info) {
    if (record) {
        TRY(file.append(sourceRecordBytes(*record)));
        info.hasSourceRecord = true;
    }
    TRY(file.overwrite(0, headerBytes(info, file.size())));
    return file.commit();
}

void describeBake(const HeightSource& source, const BakeSettings& settings, const ColourSource* colour,
                  const ChunkFileInfo& info, std::span<const DeferredChunk, faceCount> roots,
                  BakeReport& report) {
    report.shape = info.shape;
    report.quantumNotice = quantumNotice(source, settings, info.shape);
    report.samples = sampleCountOf(info);
    report.chunks = info.chunks;
    report.coarsestLeafLevel = info.coarsestLeafLevel;
    report.missingSamples = source.missingCount;
    if (colour) report.colourNotice = colour->notice;
    for (const DeferredChunk& root : roots) {
        report.largestDeltaCM = std::max(report.largestDeltaCM, root.baked.entry.deltaCM);
        report.largestDeltaTightM = std::max(report.largestDeltaTightM, root.baked.entry.deltaTightM);
    }
}

}  // namespace planet
