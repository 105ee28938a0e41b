#include "app/data/bake_job.h"

#include <functional>
#include <mutex>
#include <span>
#include <utility>

#include "app/data/launched_bake.h"
#include "app/data/write_check.h"
#include "planet/bake/bake_tile.h"
#include "planet/bake/bake_tree.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"

namespace worldy {

namespace {

using planet::Result;

Result<planet::BakeEstimate> estimate(const BakeRequest& request, const std::stop_token& stop) {
    planet::HeightSourceSettings sourceSettings = request.sourceSettings;
    sourceSettings.stop = stop;
    const auto goOn = [&] { return !stop.stop_requested(); };
    const Result<planet::HeightSource> heights = planet::openHeightSource(request.source, sourceSettings);
    if (!heights) return tl::unexpected(heights.error());
    if (request.colour.empty()) return planet::estimateBake(*heights, request.settings, goOn);
    const Result<planet::ColourSource> colours = planet::openColourSource(request.colour);
    if (!colours) return tl::unexpected(colours.error());
    return planet::estimateBake(*heights, request.settings, goOn, &*colours);
}

// Returns the source with a sampling function that keeps the source's first Error, to tell it from the bake's
// other Errors.
planet::ColourSource watched(const planet::ColourSource& source, std::mutex& mutex, std::string& problem) {
    planet::ColourSource same = source;
    same.sample = [&source, &mutex, &problem](const planet::SampleTile& tile, std::span<glm::vec3> out) {
        Result<void> sampled = source.sample(tile, out);
        if (sampled) return sampled;
        const std::lock_guard lock(mutex);
        if (problem.empty()) problem = sampled.error().message;
        return sampled;
    };
    return same;
}

// Returns whether a bake has so many samples that a first look is worth its time.
bool takesLong(const planet::HeightSource& heights, const planet::BakeSettings& settings,
               const std::function<bool()>& goOn) {
    const Result<planet::PlanetShape> shape = planet::chooseShape(heights, settings);
    if (!shape) return false;
    const std::optional<planet::TreeCount> count = planet::countTree(heights, *shape, goOn);
    return count && count->leafCells > mostWithoutFirstLook;
}

}  // namespace

Result<planet::BakeReport> bakeWithColour(const planet::HeightSource& heights,
                                          const planet::BakeSettings& settings,
                                          const std::filesystem::path& output,
                                          const planet::BakeProgressCallback& goOn, const JobColour& colour,
                                          std::string& colourProblem) {
    if (colour.image.empty()) return planet::bake(heights, settings, output, goOn);
    const Result<planet::ColourSource> opened = planet::openColourSource(colour.image);
    std::string problem = opened ? std::string() : opened.error().message;
    if (opened) {
        std::mutex mutex;
        const planet::ColourSource source = watched(*opened, mutex, problem);
        Result<planet::BakeReport> report = planet::bake(heights, settings, output, goOn, &source);
        if (report || problem.empty() || !colour.mayFail) return report;
    }
    if (!colour.mayFail) return tl::unexpected(opened.error());
    Result<planet::BakeReport> report = planet::bake(heights, settings, output, goOn);
    if (report) colourProblem = problem;
    return report;
}

BakeJob::BakeJob(BakeTask task)
    : job_([this, task = std::move(task)](const std::stop_token& stop) { return run(stop, task); }) {}

Result<planet::BakeReport> BakeJob::run(const std::stop_token& stop, BakeTask task) {
    CommandFiles files;
    addSource(files, task.source);
    addSource(files, task.colour.image);
    files.outputs = {{task.output, OutputKind::ChunkFile}};
    if (task.firstLook) files.outputs.push_back({task.firstLook->output, OutputKind::ChunkFile});
    task.sourceSettings.stop = stop;
    if (!task.launcher.empty()) {
        return checkNotInputs(files).and_then([&] {
            return runLaunchedBake(task.launcher, task, stop, [&](const planet::JobProgress& progress) {
                const std::lock_guard lock(mutex_);
                progress_ = progress;
            });
        });
    }
    const auto opened = [&]() -> Result<planet::HeightSource> {
        if (task.opened) return *task.opened;
        return planet::openHeightSource(task.source, task.sourceSettings);
    };
    return checkNotInputs(files).and_then(opened).and_then(
        [&](const planet::HeightSource& heights) { return bakeOpened(stop, task, heights); });
}

Result<planet::BakeReport> BakeJob::bakeOpened(const std::stop_token& stop, const BakeTask& task,
                                               const planet::HeightSource& heights) {
    {
        const std::lock_guard lock(mutex_);
        layers_ = heights.layers;
    }
    std::string colourProblem;
    const auto goOn = [&] { return !stop.stop_requested(); };
    if (task.firstLook && takesLong(heights, task.settings, goOn)) {
        const auto onFirst = [&](const planet::BakeProgress&) { return goOn(); };
        const Result<planet::BakeReport> first = bakeWithColour(
            heights, task.firstLook->settings, task.firstLook->output, onFirst, task.colour, colourProblem);
        // An Error of the first look is one of the whole bake too, which then reports it.
        const std::lock_guard lock(mutex_);
        firstLookIsBaked_ = first.has_value();
    }
    const auto onProgress = [&](const planet::BakeProgress& progress) {
        const std::lock_guard lock(mutex_);
        progress_.bake = progress;
        return goOn();
    };
    Result<planet::BakeReport> result =
        bakeWithColour(heights, task.settings, task.output, onProgress, task.colour, colourProblem);
    const std::lock_guard lock(mutex_);
    colourProblem_ = std::move(colourProblem);
    return result;
}

bool BakeJob::takeFirstLook() {
    const std::lock_guard lock(mutex_);
    return std::exchange(firstLookIsBaked_, false);
}

std::string BakeJob::colourProblem() const {
    const std::lock_guard lock(mutex_);
    return colourProblem_;
}

SharedLayers BakeJob::layers() const {
    const std::lock_guard lock(mutex_);
    return layers_;
}

planet::JobProgress BakeJob::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

EstimateJob::EstimateJob(BakeRequest request)
    : Job([request = std::move(request)](const std::stop_token& stop) { return estimate(request, stop); }) {}

}  // namespace worldy
