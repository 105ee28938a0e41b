#include "app/base/picture.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "planet/base/atomic_file.h"

namespace worldy {

namespace {

constexpr int maxSidePx = 32768;

tl::unexpected<planet::Error> notAnImage(const std::filesystem::path& file) {
    OIIO::geterror();  // discards the pending error, which would otherwise be reported by the next failure
    return planet::badInput(
        fmt::format("{}: cannot be read as an image; expected a JPEG, PNG or TIFF picture", file.string()));
}

}  // namespace

planet::Result<Picture> readPicture(const std::filesystem::path& file) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    if (!input) return notAnImage(file);
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > maxSidePx || spec.height > maxSidePx) {
        return planet::badInput(fmt::format("{}: is {} x {} pixels; expected [1, {}] per side", file.string(),
                                            spec.width, spec.height, maxSidePx));
    }
    const int channels = spec.nchannels >= 3 ? 3 : 1;
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    std::vector<std::uint8_t> samples(pixels * static_cast<std::size_t>(channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, samples.data())) {
        return planet::badInput(
            fmt::format("{}: is damaged: {}; expected a complete picture", file.string(), input->geterror()));
    }
    if (channels == 3) return Picture{spec.width, spec.height, std::move(samples)};
    Picture picture{spec.width, spec.height, {}};
    for (const std::uint8_t grey : samples) picture.rgb.insert(picture.rgb.end(), 3, grey);
    return picture;
}

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

Picture placedPicture(const Picture& picture, const planet::ImagePlacement& placement) {
    if (placement == planet::centredPlacement(picture.width)) return picture;
    Picture placed{placement.period, placement.hasPoleRows ? picture.height - 1 : picture.height, {}};
    const auto at = [&](int column, int row, int channel) {
        const int wrapped = (column % placement.period + placement.period) % placement.period;
        const int pixel = std::min(row, picture.height - 1) * picture.width + wrapped;
        return static_cast<double>(
            picture.rgb[3 * static_cast<std::size_t>(pixel) + static_cast<std::size_t>(channel)]);
    };
    const double firstColumn = placement.zeroColumn + 0.5 - placed.width / 2.0;
    const double down = placement.hasPoleRows ? 0.5 : 0;
    for (int y = 0; y < placed.height; ++y) {
        for (int x = 0; x < placed.width; ++x) {
            const double place = firstColumn + x;
            const int column = static_cast<int>(std::floor(place));
            const double right = place - column;
            for (int channel = 0; channel < 3; ++channel) {
                const double upper = std::lerp(at(column, y, channel), at(column + 1, y, channel), right);
                const double lower =
                    std::lerp(at(column, y + 1, channel), at(column + 1, y + 1, channel), right);
                placed.rgb.push_back(static_cast<std::uint8_t>(std::lround(std::lerp(upper, lower, down))));
            }
        }
    }
    return placed;
}

planet::Result<Picture> readPlanetPicture(const std::filesystem::path& file) {
    planet::Result<Picture> picture = readPicture(file);
    if (!picture) return picture;
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    const planet::Result<planet::GeoTags> tags =
        planet::geoTagsOf(file, input && std::string_view(input->format_name()) == "tiff");
    if (!tags) return tl::unexpected(tags.error());
    const auto placement = planet::placementOf(file.string(), picture->width, picture->height, *tags);
    if (placement) return placedPicture(*picture, *placement);
    // A picture without tags is stretched over the planet, whatever its shape.
    if (!tags->placement) return picture;
    return tl::unexpected(placement.error());
}

planet::Result<std::string> readPictureText(const std::filesystem::path& file, const std::string& keyword) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    if (!input) return notAnImage(file);
    return std::string(input->spec().get_string_attribute(keyword));
}

planet::Result<void> writePicture(const Picture& picture, const std::filesystem::path& file,
                                  std::span<const PictureText> texts) {
    return planet::writeAtomically(file, [&](const std::filesystem::path& temporary) -> planet::Result<void> {
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(temporary.string());
        OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
        for (const PictureText& text : texts) spec.attribute(text.keyword, text.text);
        if (!output || !output->open(temporary.string(), spec) ||
            !output->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) || !output->close()) {
            const std::string why = output ? output->geterror() : OIIO::geterror();
            return planet::ioError(
                fmt::format("{}: cannot be written: {}; expected a name ending in .png in a writable folder",
                            file.string(), why));
        }
        return {};
    });
}

}  // namespace worldy
