#include "app/cli/write_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/base/places.h"
#include "app/base/report.h"
#include "app/data/data_set.h"
#include "app/settings/layer_file.h"
#include "app/settings/view_options.h"
#include "app/suggest/suggest_files.h"
#include "app/trace/trace_document.h"
#include "planet/format/chunk_file.h"
#include "planet/measure/atlas_file.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;

// Adds the set's file and the textures of its layers.
void addLayerFiles(CommandFiles& files, const ViewSettings& view) {
    const LayerSettings& layers = view.surface.layers;
    const fs::path folder = layerFolderOf(layers.file);
    files.inputs.emplace_back(layers.file);
    for (const planet::TextureLayer& layer : layers.set.layers) {
        for (const std::string& texture : {layer.albedo, layer.normal, layer.roughness}) {
            if (!texture.empty()) files.inputs.push_back(folder / texture);
        }
    }
}

// Returns the source recorded in a chunk file, from which a sweep bakes other chunk sizes.
fs::path sourceIn(const fs::path& chunkFile) {
    if (chunkFile.extension() != ".chk") return {};
    const planet::Result<planet::ChunkFile> file = planet::ChunkFile::open(chunkFile);
    return file ? sourceOf(file->info()) : fs::path();
}

// Adds the images in a folder that --debug-levels might replace; the number of levels is not known yet.
void addLevelImages(CommandFiles& files, const fs::path& folder) {
    std::error_code status;
    if (folder.empty()) return;
    for (fs::directory_iterator entry(folder, status), end; !status && entry != end;
         entry.increment(status)) {
        const std::string name = entry->path().filename().string();
        const bool wouldBe =
            std::any_of(planet::allFaces.begin(), planet::allFaces.end(), [&](planet::Face face) {
                return name.starts_with(fmt::format("{}_level", planet::faceName(face))) &&
                       name.ends_with(".png");
            });
        if (wouldBe) files.outputs.push_back({entry->path(), OutputKind::PngImage});
    }
}

// Returns the files of a command that flies over a chunk file and writes a report.
template <class Options>
CommandFiles flownFiles(const Options& options) {
    CommandFiles files;
    addChunkFile(files, options.file);
    files.inputs.push_back(options.flight);
    addLayerFiles(files, options.view);
    files.outputs = {{options.report.file, OutputKind::Json}};
    return files;
}

}  // namespace

CommandFiles filesOf(const AppOptions& options) {
    CommandFiles files;
    addSource(files, options.file.empty() ? earthElevation() : options.file);
    files.inputs.insert(files.inputs.end(),
                        {options.settingsFile, options.shaderFolder, options.regionsFile});
    files.outputs = {{options.itemMapFile, OutputKind::ItemMap}};
    return files;
}

CommandFiles filesOf(const AtlasOptions& options) {
    CommandFiles files;
    addChunkFile(files, options.file);
    files.inputs.push_back(options.diff);
    addLayerFiles(files, options.view);
    files.outputs = {{options.output, OutputKind::Atlas}, {options.csv, OutputKind::Csv}};
    if (!options.output.empty())
        files.outputs.push_back({planet::unfinishedAtlas(options.output), OutputKind::Atlas});
    return files;
}

CommandFiles filesOf(const AuditOptions& options) {
    return flownFiles(options);
}

CommandFiles filesOf(const BakeOptions& options) {
    CommandFiles files;
    addSource(files, options.source);
    addSource(files, options.colour);
    files.outputs = {{options.output, OutputKind::ChunkFile}};
    addLevelImages(files, options.settings.debugLevelsFolder);
    return files;
}

CommandFiles filesOf(const BenchOptions& options) {
    CommandFiles files;
    if (options.compared.empty())
        addSource(files, options.source.empty() ? earthElevation() : options.source);
    else
        files.inputs = options.compared;
    const std::filesystem::path& report = options.report.file;
    files.outputs = {{report, isCsvTable(report) ? OutputKind::Csv : OutputKind::Json}};
    return files;
}

CommandFiles filesOf(const CompareOptions& options) {
    CommandFiles files;
    addChunkFile(files, options.file);
    addChunkFile(files, options.fileOfB);
    files.inputs.push_back(options.flight);
    for (const ViewSettings& view : options.settings) addLayerFiles(files, view);
    files.outputs = {{options.report.file, OutputKind::Json}};
    if (options.pictures.empty()) return files;
    for (const char* name : {"side_by_side.png", "difference.png"})
        files.outputs.push_back({options.pictures / name, OutputKind::Picture, true});
    return files;
}

CommandFiles filesOf(const ScheduleOptions& options) {
    CommandFiles files;
    files.inputs.push_back(options.file);
    files.outputs = {{options.report.file, OutputKind::Json}};
    return files;
}

CommandFiles filesOf(const CostsOptions& options) {
    CommandFiles files;
    addChunkFile(files, options.file);
    files.inputs.push_back(options.colourImage);
    addLayerFiles(files, options.view);
    files.outputs = {{options.report.file, OutputKind::Json}};
    return files;
}

CommandFiles filesOf(const CracksOptions& options) {
    CommandFiles files = flownFiles(options);
    files.inputs.push_back(options.shaderFolder);
    files.outputs.push_back({options.markedPicture, OutputKind::Picture});
    return files;
}

CommandFiles filesOf(const FlyOptions& options) {
    CommandFiles files = flownFiles(options);
    files.inputs.push_back(options.shaderFolder);
    files.outputs.push_back({options.trace, OutputKind::Trace});
    return files;
}

CommandFiles filesOf(const MakeLayersOptions& options) {
    CommandFiles files;
    for (const std::string_view material : planet::materialNames) {
        for (const char* what : {"albedo", "normal", "roughness"}) {
            files.outputs.push_back(
                {options.output / fmt::format("{}_{}.png", material, what), OutputKind::PngImage, true});
        }
    }
    for (const char* name : {"earth.toml", "two_layer_height_blend.toml"})
        files.outputs.push_back({options.output / name, OutputKind::LayerSet, true});
    return files;
}

CommandFiles filesOf(const PopsOptions& options) {
    return flownFiles(options);
}

CommandFiles filesOf(const PrefetchOptions& options) {
    CommandFiles files = flownFiles(options);
    if (isCsvTable(options.report.file)) files.outputs[0].kind = OutputKind::Csv;
    return files;
}

CommandFiles filesOf(const ReplayOptions& options) {
    CommandFiles files;
    addChunkFile(files, options.file);
    files.inputs.push_back(options.flight);
    files.outputs = {{options.report.file, OutputKind::Json}};
    return files;
}

CommandFiles filesOf(const ShotOptions& options) {
    CommandFiles files;
    addChunkFile(files, options.file);
    files.inputs.insert(files.inputs.end(), {options.colourImage, options.shaderFolder});
    addSource(files, options.source);
    addLayerFiles(files, options.view);
    files.outputs = {{options.output, OutputKind::Picture}};
    return files;
}

CommandFiles filesOf(const SuggestOptions& options) {
    CommandFiles files;
    addChunkFile(files, options.file);
    for (const auto* inputs : {&options.flights, &options.recordings})
        files.inputs.insert(files.inputs.end(), inputs->begin(), inputs->end());
    addSource(files, options.source);
    files.inputs.push_back(options.view.regions.file);
    addLayerFiles(files, options.view);
    const SuggestFiles outputs = suggestFilesIn(options.output, options.name);
    files.outputs = {{outputs.report, OutputKind::SuggestReport, true}};
    if (isTraceFile(options.file)) return files;
    files.outputs.push_back({outputs.preset, OutputKind::Preset, true});
    files.outputs.push_back({outputs.regions, OutputKind::Regions, true});
    files.outputs.push_back({outputs.page, OutputKind::Picture, true});
    return files;
}

CommandFiles filesOf(const SweepOptions& options) {
    CommandFiles files;
    addSource(files, options.file);
    addSource(files, sourceIn(options.file));
    files.inputs.push_back(options.flight);
    addLayerFiles(files, options.view);
    const fs::path& table = options.report.file;
    files.outputs = {{table, isCsvTable(table) ? OutputKind::Csv : OutputKind::Json},
                     {options.plotOutput, OutputKind::Picture}};
    return files;
}

CommandFiles filesOf(const TraceCommandOptions& options) {
    CommandFiles files;
    files.inputs.push_back(options.file);
    if (!options.other.empty()) files.inputs.push_back(options.other);
    files.outputs = {{options.report.file, OutputKind::Json}};
    return files;
}

void addInputs(CommandFiles& files, const ViewTexts& texts) {
    files.inputs.insert(files.inputs.end(), {texts.settingsFile, texts.layerSet, texts.regions});
}

}  // namespace worldy
