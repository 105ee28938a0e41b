#include "app/measure/atlas_survey.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/scene_settings.h"
#include "app/settings/region_file.h"
#include "app/settings/settings_text.h"
#include "planet/base/result.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file.h"
#include "planet/gl/draw/frame_uniforms.h"
#include "planet/measure/atlas_file.h"
#include "planet/measure/atlas_tree.h"
#include "planet/measure/atlas_viewpoint.h"
#include "planet/paging/paging_types.h"
#include "planet/planet.h"

namespace worldy {

namespace {

using planet::AtlasSurvey;
using planet::Result;

// The header has a checksum and the places of the root blocks, whose entries lead to all others.
Result<std::uint64_t> hashOfBake(const planet::ChunkFile& file) {
    std::vector<std::byte> bytes(planet::chunkFileHeaderBytes);
    TRY(file.readBytes(0, bytes));
    for (const planet::BlockLocation& root : file.info().roots) {
        const std::size_t at = bytes.size();
        bytes.resize(at + root.size);
        TRY(file.readBytes(root.offset, std::span(bytes).subspan(at)));
    }
    return XXH3_64bits(bytes.data(), bytes.size());
}

Result<AtlasSurvey> surveyOf(const AtlasRequest& request, const planet::ChunkFile& file) {
    AtlasSurvey survey;
    survey.bake = request.file.filename().string();
    TRY_ASSIGN(survey.bakeHash, hashOfBake(file));
    survey.radiusM = file.info().shape.radiusM;
    survey.settings = viewSettingsText(request.view);
    const std::vector<planet::Region> regions = request.view.regions.applied();
    if (!regions.empty()) survey.regions = regionsText(regions);
    survey.measuresError = request.measuresError;
    survey.grid = request.grid;
    survey.widthPx = request.size.widthPx;
    survey.heightPx = request.size.heightPx;
    survey.fovDeg = request.view.camera.fovDeg;
    if (request.revisited) {
        const AtlasSurvey& old = request.revisited->survey;
        survey.isRevisit = true;
        survey.grid = old.grid;
        survey.widthPx = old.widthPx;
        survey.heightPx = old.heightPx;
        survey.fovDeg = old.fovDeg;
    }
    return survey;
}

// Returns the settings of the library. The sea is drawn as with a GPU, so that an atlas is the same on any machine.
Result<planet::AtlasSettings> atlasSettingsOf(const ViewSettings& view, const planet::PlanetSource& source) {
    planet::AtlasSettings settings;
    settings.input = {{}, lodSettingsOf(view), 1, colourSettingsOf(view), normalSettingsOf(view)};
    settings.paging = pagingSettingsOf(view, false, planet::PagingTime::Simulated);
    settings.exaggeration = view.surface.exaggeration;
    settings.regions = view.regions.applied();
    TRY_ASSIGN(const auto planet, planet::Planet::open(source, settings.paging));
    planet->setExaggeration(settings.exaggeration);
    const planet::gl::RenderSettings render = renderSettingsOf(view, {}, planet->tree());
    settings.stitched = render.stitched;
    if (planet::gl::isSeaSurfaceDrawn(render, /*software=*/false)) settings.seaM = render.seaLevelM;
    return settings;
}

// Returns what of a survey is another than in an unfinished one; empty if they are the same.
std::string differenceOf(const AtlasSurvey& unfinished, const AtlasSurvey& now) {
    if (unfinished.bakeHash != now.bakeHash)
        return fmt::format("is of another bake, {}; expected the same file", unfinished.bake);
    if (unfinished.settings != now.settings) {
        const auto before = viewPartFromText(unfinished.settings, "settings");
        const auto here = viewPartFromText(now.settings, "settings");
        if (before && here) {
            for (const SettingDifference& one : differences(before->values, *here))
                return fmt::format("has {} = {}, which is {} now; expected the same settings", one.setting,
                                   one.here, one.there);
        }
        return "has other settings; expected the same settings";
    }
    if (unfinished.regions != now.regions) return "has other regions; expected the same regions";
    if (unfinished.widthPx != now.widthPx || unfinished.heightPx != now.heightPx ||
        unfinished.fovDeg != now.fovDeg)
        return fmt::format(
            "has pictures of {}x{} pixels and {:g} degrees; expected the same --size and --fov",
            unfinished.widthPx, unfinished.heightPx, unfinished.fovDeg);
    if (unfinished.measuresError != now.measuresError)
        return fmt::format("{} the true error; expected the same --true-error",
                           unfinished.measuresError ? "measures" : "does not measure");
    if (unfinished.isRevisit != now.isRevisit) return "is a survey of another kind; expected the same --diff";
    if (unfinished.grid != now.grid)
        return "has other viewpoints; expected the same --altitudes, --headings, --pitch, --cells and "
               "--viewpoints";
    return {};
}

// Returns the names of the regions of a survey, for users: "peaks, coast", or "none".
std::string regionNames(const AtlasSurvey& survey) {
    constexpr std::size_t listed = 4;
    if (survey.regions.empty()) return "none";
    const auto regions = regionsFromText(survey.regions, "regions");
    if (!regions) return "unreadable";
    std::vector<std::string> names;
    for (const planet::Region& region : *regions) {
        if (names.size() == listed) {
            names.push_back(fmt::format("{} more", regions->size() - listed));
            break;
        }
        names.push_back(region.name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

// Tells regions of the same names apart.
std::uint32_t shortHashOf(const std::string& text) {
    return static_cast<std::uint32_t>(XXH3_64bits(text.data(), text.size()));
}

struct OpenedAtlas {
    std::unique_ptr<planet::AtlasWriter> writer;  // none if the atlas is kept in memory alone
    planet::Atlas atlas;
};

Result<std::optional<OpenedAtlas>> resumedAtlas(const AtlasRequest& request, const AtlasSurvey& survey) {
    if (!request.resumes) return std::nullopt;
    TRY_ASSIGN(auto resumed, planet::AtlasWriter::resume(request.output));
    if (!resumed) return std::nullopt;
    if (std::string other = differenceOf(resumed->atlas.survey, survey); !other.empty()) {
        return planet::badInput(
            fmt::format("{} {}", planet::unfinishedAtlas(request.output).string(), other));
    }
    if (request.recordsTree != !resumed->atlas.tree.chunks.empty()) {
        return planet::badInput(fmt::format("{} {} the tree; expected the same --no-tree",
                                            planet::unfinishedAtlas(request.output).string(),
                                            request.recordsTree ? "does not record" : "records"));
    }
    return OpenedAtlas{std::make_unique<planet::AtlasWriter>(std::move(resumed->writer)),
                       std::move(resumed->atlas)};
}

Result<OpenedAtlas> beginAtlas(const AtlasRequest& request, const AtlasSurvey& survey,
                               const planet::PlanetSource& source, const WatchAtlas& goOn, double& treeS) {
    OpenedAtlas opened;
    opened.atlas.survey = survey;
    if (request.recordsTree) {
        const planet::Stopwatch watch;
        std::mutex mutex;
        const auto mayGoOn = [&] {
            const std::lock_guard lock(mutex);
            return goOn(std::nullopt);
        };
        TRY_ASSIGN(opened.atlas.tree, planet::atlasTreeOf(source, mayGoOn));
        treeS = watch.elapsedS();
    }
    if (request.output.empty()) return opened;
    TRY_ASSIGN(planet::AtlasWriter writer,
               planet::AtlasWriter::create(request.output, survey, opened.atlas.tree));
    opened.writer = std::make_unique<planet::AtlasWriter>(std::move(writer));
    return opened;
}

}  // namespace

void setUsualDisk(planet::BadDiskSettings& disk) {
    if (disk.latencyMs != 0 || disk.bandwidthMBs != 0) return;
    disk.latencyMs = 5;
    disk.bandwidthMBs = 100;
}

Result<AtlasOutcome> surveyAtlas(const AtlasRequest& request, const WatchAtlas& goOn) {
    TRY_ASSIGN(const auto file, planet::ChunkFile::open(request.file));
    TRY_ASSIGN(const AtlasSurvey survey, surveyOf(request, file));
    TRY_ASSIGN(const planet::PlanetSource source, planet::planetSource(file));
    if (request.revisited && request.revisited->survey.radiusM != survey.radiusM) {
        return planet::badInput(fmt::format("{}: radius {} m is another than that of the atlas, {} m",
                                            request.file.string(), survey.radiusM,
                                            request.revisited->survey.radiusM));
    }
    TRY_ASSIGN(const planet::AtlasSettings settings, atlasSettingsOf(request.view, source));
    AtlasOutcome outcome;
    TRY_ASSIGN(std::optional<OpenedAtlas> opened, resumedAtlas(request, survey));
    if (!opened) {
        TRY_ASSIGN(opened, beginAtlas(request, survey, source, goOn, outcome.treeS));
    }
    planet::AtlasWatch watch;
    watch.goOn = [&](const planet::AtlasProgress& progress) { return goOn(progress); };
    watch.take = [&](std::span<const planet::AtlasViewpoint> viewpoints) -> Result<void> {
        return opened->writer ? opened->writer->append(viewpoints) : Result<void>();
    };
    std::span<const planet::AtlasViewpoint> revisited;
    if (request.revisited) revisited = request.revisited->viewpoints;
    const auto open = [&]() -> Result<planet::PlanetSource> { return source; };
    TRY_ASSIGN(outcome.run, planet::runAtlas(open, survey, settings, revisited, request.threads,
                                             opened->atlas.viewpoints, watch));
    if (opened->writer) TRY(opened->writer->finish());
    outcome.atlas = std::move(opened->atlas);
    outcome.atlas.isFinished = true;
    return outcome;
}

Result<ViewSettings> settingsOf(const AtlasSurvey& survey, const std::string& name) {
    TRY_ASSIGN(const ViewPart part, viewPartFromText(survey.settings, name + ": settings"));
    ViewSettings view = applied(part, {});
    view.regions.list = nullptr;
    if (survey.regions.empty()) return view;
    TRY_ASSIGN(std::vector<planet::Region> regions, regionsFromText(survey.regions, name + ": regions"));
    view.regions.list = std::make_shared<const std::vector<planet::Region>>(std::move(regions));
    return view;
}

Result<ViewSettings> settingsOf(const AtlasSurvey& survey, const std::string& name,
                                const RegionSettings& regions) {
    TRY_ASSIGN(const ViewPart part, viewPartFromText(survey.settings, name + ": settings"));
    ViewSettings view = applied(part, {});
    view.regions = regions;
    return view;
}

std::vector<SettingDifference> differencesOf(const AtlasSurvey& before, const AtlasSurvey& now) {
    Settings here, there;
    here.view = settingsOf(before, "before", RegionSettings{}).value_or(ViewSettings{});
    there.view = settingsOf(now, "now", RegionSettings{}).value_or(ViewSettings{});
    std::vector<SettingDifference> found = differences(here, there);
    std::erase_if(found, [](const SettingDifference& one) { return one.setting.starts_with("overlay."); });
    if (before.regions == now.regions) return found;
    SettingDifference regions{"regions", regionNames(before), regionNames(now), "Regions"};
    if (regions.here == regions.there) {
        regions.here += fmt::format(" ({:08x})", shortHashOf(before.regions));
        regions.there += fmt::format(" ({:08x})", shortHashOf(now.regions));
    }
    found.push_back(std::move(regions));
    return found;
}

Result<AtlasRequest> requestToResume(const planet::Atlas& unfinished, const std::filesystem::path& output,
                                     const std::filesystem::path& chunkFile, const RegionSettings& regions,
                                     std::shared_ptr<const planet::Atlas> revisited) {
    const AtlasSurvey& survey = unfinished.survey;
    const std::string name = planet::unfinishedAtlas(output).string();
    if (survey.isRevisit && !revisited) {
        return planet::badInput(
            fmt::format("{}: surveys the viewpoints of an earlier atlas again; expected worldy atlas --diff "
                        "EARLIER.atlas "
                        "-o {} --resume",
                        name, output.string()));
    }
    AtlasRequest request;
    request.file = chunkFile;
    request.output = output;
    TRY_ASSIGN(request.view, settingsOf(survey, name, regions));
    request.size = {survey.widthPx, survey.heightPx};
    request.grid = survey.grid;
    request.measuresError = survey.measuresError;
    request.recordsTree = !unfinished.tree.chunks.empty();
    request.resumes = true;
    if (survey.isRevisit) request.revisited = std::move(revisited);
    return request;
}

}  // namespace worldy
