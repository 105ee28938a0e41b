// Draws previews of a source before it is baked, on a thread of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "app/data/bake_request.h"
#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/source/height_source.h"

namespace worldy {

inline constexpr int previewSidePx = 256;

struct PreviewPicture {
    PreviewRequest request;
    std::vector<std::uint8_t> rgba;  // previewSidePx^2, top row first
    double lowM = 0;                 // lowest height in the picture
    double highM = 0;
    double seconds = 0;
};

// Returns the samples of a preview: one more per side than it has pixels, on the grid of its zoom.
planet::SampleTile tileOfPreview(const PreviewRequest& request);

// Draws relief lit from the upper left, with slopes exaggerated so that they show, coloured by height; blue
// below 0 m. goOn is called every few rows; if it returns false, the result is an Error of kind Cancelled.
// Any thread.
planet::Result<PreviewPicture> drawPreview(const planet::HeightSource& source, const PreviewRequest& request,
                                           const std::function<bool()>& goOn = {});

// Opens the source and draws it. All calls come from one thread.
class PreviewJob : public Job<planet::Result<PreviewPicture>> {
public:
    explicit PreviewJob(PreviewRequest request);
};

// Draws one picture at a time; a newer request replaces a waiting one. All calls come from the thread of the
// GL context.
struct SourcePreviewer {
    std::unique_ptr<PreviewJob> job;
    std::optional<PreviewRequest> next;
    std::optional<PreviewPicture> shown;  // without its pixels, which are in the texture
    planet::gl::Texture texture;
    std::string problem;
};
void requestPreview(SourcePreviewer& previewer, const PreviewRequest& request);
// Call at the start of a frame. Leaves no texture bound to the active unit.
void advancePreview(SourcePreviewer& previewer);

}  // namespace worldy
