// Two pictures of the same size in one, to see how they differ, and how much they do in numbers. Wants a
// current context; one thread.
#pragma once

#include <cstdint>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

// Which columns of the result show which columns of A or B, unscaled: each column x < border shows A's
// x + shiftA, each other one B's x + shiftB. Or the difference of the two, and nothing of the rest.
struct PictureMix {
    int border = 0;  // [0, width]
    int shiftA = 0;
    int shiftB = 0;
    bool difference = false;  // |A - B| of each channel, times the gain
    float gain = 1;

    bool operator==(const PictureMix&) const = default;
};
// Full pictures, the left one up to a share of the width, [0, 1].
PictureMix wipeMix(int widthPx, double share);
// The middle half of each, so that pixels keep their size: A's on the left.
PictureMix sideBySideMix(int widthPx);
PictureMix onlyMix(int widthPx, bool showsB);
PictureMix differenceMix(double gain);

// The column of A, or of B where the mix shows that, that a place in the mixed picture shows.
double pictureColumn(const PictureMix& mix, double columnPx);

struct PictureDifference {
    std::uint64_t pixels = 0;  // that differ by more than one 8-bit step in some channel
    int largestSteps = 0;      // of all pixels and channels, [0, 255]

    bool operator==(const PictureDifference&) const = default;
};

class PictureComparer {
public:
    static Result<PictureComparer> create();

    // Into the bound framebuffer, which is as large as the two RGBA8 textures. Sets the viewport.
    void draw(GLuint textureA, GLuint textureB, int widthPx, int heightPx, const PictureMix& mix) const;

    // Counted by the GPU, and waited for. Leaves another framebuffer bound, and sets the viewport.
    PictureDifference count(GLuint textureA, GLuint textureB, int widthPx, int heightPx);

private:
    PictureComparer() = default;
    void drawTriangle(const Program& program, GLuint textureA, GLuint textureB) const;
    void fitCounts(int widthPx, int heightPx);

    Program mix_;
    Program count_;
    VertexArray noVertices_;
    Texture counts_;  // one texel a block of pixels
    Framebuffer counted_;
    int countsWidth_ = 0;
    int countsHeight_ = 0;
};

}  // namespace planet::gl
