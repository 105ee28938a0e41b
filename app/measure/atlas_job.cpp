#include "app/measure/atlas_job.h"

#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

#include "app/measure/atlas_survey.h"
#include "planet/measure/atlas_run.h"

namespace worldy {

AtlasJob::AtlasJob(AtlasRequest request) {
    job_.emplace([this, request = std::move(request)](const std::stop_token& stop) {
        return surveyAtlas(request, [&](const std::optional<planet::AtlasProgress>& progress) {
            const std::lock_guard lock(mutex_);
            progress_ = progress;
            return !stop.stop_requested();
        });
    });
}

std::optional<planet::AtlasProgress> AtlasJob::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

}  // namespace worldy
