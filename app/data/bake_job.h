// A bake, and an estimate of one, on threads of their own.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "planet/bake/bake.h"
#include "planet/bake/bake_estimate.h"
#include "planet/source/height_source.h"

namespace worldy {

// The image of a bake's tiles of colour.
struct JobColour {
    std::filesystem::path image{};  // empty: none
    bool mayFail = false;           // where it cannot be read the bake goes on without, and tells why
};

// Bakes into a file, with the colours that it is asked for. goOn is given how far it is; false cancels.
// colourProblem: why there are none, of an image that may fail; else as it was.
planet::Result<planet::BakeReport> bakeWithColour(const planet::HeightSource& heights,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const planet::BakeProgressCallback& goOn,
                                                  const JobColour& colour, std::string& colourProblem);

// All calls from one thread.
class BakeJob {
public:
    BakeJob(std::filesystem::path source, planet::BakeSettings settings, std::filesystem::path output)
        : BakeJob(std::move(source), {}, std::move(settings), std::move(output)) {}
    BakeJob(std::filesystem::path source, planet::HeightSourceSettings sourceSettings,
            planet::BakeSettings settings, std::filesystem::path output, JobColour colour = {});
    ~BakeJob();  // cancels, and waits for the bake's end
    BakeJob(const BakeJob&) = delete;
    BakeJob& operator=(const BakeJob&) = delete;

    planet::BakeProgress progress() const;
    void cancel();
    bool cancelling() const;
    // What came of it, once it has ended; nothing until then and nothing again after.
    std::optional<planet::Result<planet::BakeReport>> takeResult();
    // Once it has ended: why it has no colours although it was asked for them; else empty.
    std::string colourProblem() const;

private:
    void run(const std::filesystem::path& source, const planet::HeightSourceSettings& sourceSettings,
             const planet::BakeSettings& settings, const std::filesystem::path& output,
             const JobColour& colour);

    mutable std::mutex mutex_;
    planet::BakeProgress progress_;                             // guarded
    std::string colourProblem_;                                 // guarded
    std::optional<planet::Result<planet::BakeReport>> result_;  // guarded
    std::atomic<bool> cancelled_{false};
    std::thread thread_;
};

// All calls from one thread.
class EstimateJob {
public:
    EstimateJob(std::filesystem::path source, planet::HeightSourceSettings sourceSettings,
                planet::BakeSettings settings, std::filesystem::path colour = {});
    ~EstimateJob();  // cancels, and waits for its end
    EstimateJob(const EstimateJob&) = delete;
    EstimateJob& operator=(const EstimateJob&) = delete;

    void cancel() { cancelled_ = true; }
    // Once it has ended; nothing until then and nothing again after.
    std::optional<planet::Result<planet::BakeEstimate>> takeResult();

private:
    mutable std::mutex mutex_;
    std::optional<planet::Result<planet::BakeEstimate>> result_;  // guarded
    std::atomic<bool> cancelled_{false};
    std::thread thread_;
};

}  // namespace worldy
