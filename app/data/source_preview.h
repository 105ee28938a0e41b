// Pictures of a source before it is baked, made on a thread of their own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/data/bake_request.h"
#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/source/height_source.h"

namespace worldy {

inline constexpr int previewSidePx = 256;

struct PreviewPicture {
    PreviewRequest request;
    std::vector<std::uint8_t> rgba;  // previewSidePx^2, top row first
    double lowM = 0;                 // of the heights in it
    double highM = 0;
    double seconds = 0;
};

// The samples that a preview shows: one more a side than it has pixels, of the grid that its zoom makes.
planet::SampleTile tileOfPreview(const PreviewRequest& request);

// Relief lit from the upper left, slopes exaggerated until they show, coloured by height; blue below 0 m.
// goOn is asked every few rows; false ends it with an Error of kind Cancelled. Any thread.
planet::Result<PreviewPicture> drawPreview(const planet::HeightSource& source, const PreviewRequest& request,
                                           const std::function<bool()>& goOn = {});

// Opens the source and draws it. All calls from one thread.
class PreviewJob {
public:
    explicit PreviewJob(PreviewRequest request);
    ~PreviewJob();  // cancels, and waits for its end
    PreviewJob(const PreviewJob&) = delete;
    PreviewJob& operator=(const PreviewJob&) = delete;

    void cancel() { cancelled_ = true; }
    // Once it has ended; nothing until then and nothing again after.
    std::optional<planet::Result<PreviewPicture>> takeResult();

private:
    std::mutex mutex_;
    std::optional<planet::Result<PreviewPicture>> result_;  // guarded
    std::atomic<bool> cancelled_{false};
    std::thread thread_;
};

// One picture at a time; what is asked meanwhile takes the place of what was asked before. All calls from the
// thread of the GL context.
struct SourcePreviewer {
    std::unique_ptr<PreviewJob> job;
    std::optional<PreviewRequest> next;
    std::optional<PreviewPicture> shown;  // without its pixels, which are the texture's
    planet::gl::Texture texture;
    std::string problem;
};
void requestPreview(SourcePreviewer& previewer, const PreviewRequest& request);
// At a frame's start. Leaves no texture bound to the active unit.
void advancePreview(SourcePreviewer& previewer);

}  // namespace worldy
