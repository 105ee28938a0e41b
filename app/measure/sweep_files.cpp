#include "app/measure/sweep_files.h"

#include <filesystem>
#include <functional>
#include <system_error>
#include <vector>

#include "app/data/data_set.h"
#include "planet/bake/bake.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file.h"
#include "planet/source/height_source.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

using planet::Result;

// The source and the settings of the bake for a chunk size. A chunk file of that size needs no bake; for
// another size they are the file's recorded source, radius and face size.
struct Baked {
    std::filesystem::path source;
    planet::BakeSettings settings;
};
Result<Baked> bakedFor(const std::filesystem::path& file, int chunkSize, const std::filesystem::path& given) {
    Baked baked{file, {}};
    baked.settings.chunkSize = chunkSize;
    if (file.extension() != ".chk" || planet::isTerrainText(file)) return baked;
    TRY_ASSIGN(const planet::ChunkFile chunks, planet::ChunkFile::open(file));
    const planet::ChunkFileInfo& info = chunks.info();
    const std::filesystem::path source = given.empty() ? sourceOf(info) : given;
    if (chunkSize == planet::chunkSize(info.shape) || source.empty()) return baked;
    baked.source = source;
    baked.settings.faceSize = planet::faceCells(info.shape) + 1;
    baked.settings.radiusM = info.shape.radiusM;
    baked.settings.quantumM = fileQuantumM(info.shape);
    if (info.shape.fractionBits > 0) baked.settings.finestQuantumM = info.shape.quantumM;
    return baked;
}

}  // namespace

Result<SweptFiles> sweptFilesOf(const std::filesystem::path& file, const std::vector<int>& chunkSizes,
                                const planet::HeightSourceSettings& sourceSettings,
                                const std::filesystem::path& given) {
    SweptFiles swept{file, {}};
    for (const int chunkSize : chunkSizes) {
        TRY_ASSIGN(const Baked baked, bakedFor(file, chunkSize, given));
        TRY_ASSIGN(const DataSet data,
                   findDataSet(baked.source, baked.settings, sourceSettings, sweptColour));
        if (data.needsBake) swept.source = data.source;
        swept.files.push_back({chunkSize, data.chunkFile, data.needsBake, data.settings});
    }
    return swept;
}

Result<void> bakeSwept(const SweptFiles& swept, const SweptFile& file,
                       const planet::HeightSourceSettings& sourceSettings,
                       const std::function<bool(const planet::BakeProgress&)>& goOn) {
    // Another process may have baked it in the meantime.
    if (!file.needsBake || planet::ChunkFile::open(file.chunkFile)) return {};
    std::error_code problem;
    std::filesystem::create_directories(file.chunkFile.parent_path(), problem);  // the bake reports a failure
    TRY_ASSIGN(const planet::HeightSource source, planet::openHeightSource(swept.source, sourceSettings));
    return planet::bake(source, file.bake, file.chunkFile, goOn).map([](const auto&) {});
}

}  // namespace worldy
