// Combines two pictures of the same size into one and counts the pixels that differ. Requires a current
// context; one thread.
#pragma once

#include <cstdint>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

// The columns x < border of the result show A's column x + shiftA, the others B's column x + shiftB,
// unscaled. With `difference`, all columns show the difference.
struct PictureMix {
    int border = 0;  // [0, width]
    int shiftA = 0;
    int shiftB = 0;
    bool difference = false;  // |A - B| of each channel, times the gain
    float gain = 1;

    bool operator==(const PictureMix&) const = default;
};
// Shows A in a share of the width, [0, 1], and B in the rest.
PictureMix wipeMix(int widthPx, double share);
// Shows the middle half of each picture unscaled, A on the left.
PictureMix sideBySideMix(int widthPx);
PictureMix onlyMix(int widthPx, bool showsB);
PictureMix differenceMix(double gain);

// Returns the column of A or B that a column of the result shows.
double pictureColumn(const PictureMix& mix, double columnPx);

struct PictureDifference {
    std::uint64_t pixels = 0;  // pixels that differ by more than one 8-bit step in a channel
    int largestSteps = 0;      // the largest over all pixels and channels, [0, 255]

    bool operator==(const PictureDifference&) const = default;
};

class PictureComparer {
public:
    static Result<PictureComparer> create();

    // Draws into the bound framebuffer, which has the size of the two RGBA8 textures. Sets the viewport.
    void draw(GLuint textureA, GLuint textureB, int widthPx, int heightPx, const PictureMix& mix) const;

    // Counts on the GPU and waits for the result. Leaves another framebuffer bound and sets the viewport.
    PictureDifference count(GLuint textureA, GLuint textureB, int widthPx, int heightPx);

private:
    PictureComparer() = default;
    void drawTriangle(GLuint textureA, GLuint textureB) const;
    void fitCounts(int widthPx, int heightPx);

    Program mix_;
    Program count_;
    VertexArray noVertices_;
    Texture counts_;  // one texel per block of pixels
    Framebuffer counted_;
    int countsWidth_ = 0;
    int countsHeight_ = 0;
};

}  // namespace planet::gl
