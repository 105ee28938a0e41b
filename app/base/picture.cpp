#include "app/base/picture.h"

#include <algorithm>
#include <cstddef>

namespace worldy {

Picture partOf(const Picture& picture, int x, int y, int width, int height) {
    const int left = std::clamp(x, 0, picture.width), top = std::clamp(y, 0, picture.height);
    const int right = std::clamp(x + width, left, picture.width);
    const int bottom = std::clamp(y + height, top, picture.height);
    Picture part{right - left, bottom - top, {}};
    part.rgb.reserve(3 * static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    for (int row = top; row < bottom; ++row) {
        const auto start =
            picture.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(row) * picture.width + left);
        part.rgb.insert(part.rgb.end(), start, start + 3 * static_cast<std::ptrdiff_t>(part.width));
    }
    return part;
}

}  // namespace worldy
