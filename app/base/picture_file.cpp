#include "app/base/picture_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "planet/base/atomic_file.h"
#include "planet/raster/geo_tags.h"

namespace worldy {

namespace {

constexpr int maxSidePx = 32768;

tl::unexpected<planet::Error> notAnImage(const std::filesystem::path& file) {
    OIIO::geterror();  // discards the pending error, which would otherwise be reported by the next failure
    return planet::badInput(
        fmt::format("{}: cannot be read as an image; expected a JPEG, PNG or TIFF picture", file.string()));
}

bool hasGeoTags(const std::filesystem::path& file) {
    const planet::Result<planet::GeoTags> tags = planet::readGeoTags(file);
    return !tags || tags->placement || tags->noDataValue;
}

}  // namespace

void loadImageLibraries() {}

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

planet::Result<void> checkPictureName(const std::filesystem::path& file) {
    if (OIIO::ImageOutput::create(file.string())) return {};
    OIIO::geterror();  // discards the pending error
    return planet::badInput(
        fmt::format("{}: the extension names no picture format; expected a name ending in .png, .jpg or .tif",
                    file.string()));
}

bool isOwnPicture(const std::filesystem::path& file) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
    OIIO::geterror();  // discards the pending error
    if (!input || !output) return false;
    const OIIO::ImageSpec& spec = input->spec();
    return spec.nchannels == 3 && spec.format == OIIO::TypeDesc::UINT8 &&
           std::string_view(input->format_name()) == output->format_name() &&
           (std::string_view(input->format_name()) != "tiff" || !hasGeoTags(file));
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

planet::Result<Texture> readTexture(const std::filesystem::path& file) {
    OIIO::ImageSpec asStored;
    // Alpha is relief, so colour must not be multiplied by it.
    asStored.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string(), &asStored);
    if (!input) {
        OIIO::geterror();  // discards the pending error
        return planet::badInput(
            fmt::format("{}: cannot be read as an image; expected a PNG texture", file.string()));
    }
    const OIIO::ImageSpec& spec = input->spec();
    const bool powerOfTwo = spec.width > 0 && (spec.width & (spec.width - 1)) == 0;
    if (spec.width != spec.height || !powerOfTwo || spec.width < leastTextureSize ||
        spec.width > mostTextureSize) {
        return planet::badInput(
            fmt::format("{}: is {} x {} pixels; expected a square with a power-of-two side in [{}, {}]",
                        file.string(), spec.width, spec.height, leastTextureSize, mostTextureSize));
    }
    Texture texture{spec.width, spec.nchannels, {}};
    const auto side = static_cast<std::size_t>(spec.width);
    texture.bytes.resize(side * side * static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, texture.bytes.data()))
        return planet::badInput(
            fmt::format("{}: is damaged: {}; expected a complete picture", file.string(), input->geterror()));
    return texture;
}

planet::Result<void> writeTexture(const Texture& texture, const std::filesystem::path& file) {
    return planet::writeAtomically(file, [&](const std::filesystem::path& temporary) -> planet::Result<void> {
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(temporary.string());
        OIIO::ImageSpec spec(texture.size, texture.size, texture.channels, OIIO::TypeDesc::UINT8);
        spec.attribute("png:compressionLevel", 9);
        // The fourth channel is relief, so colour must not be multiplied by it.
        spec.attribute("oiio:UnassociatedAlpha", 1);
        if (output && output->open(temporary.string(), spec) &&
            output->write_image(OIIO::TypeDesc::UINT8, texture.bytes.data()) && output->close())
            return {};
        const std::string why = output ? output->geterror() : OIIO::geterror();
        return planet::ioError(
            fmt::format("{}: cannot be written: {}; expected a writable folder", file.string(), why));
    });
}

planet::Result<void> writeGrey16(int size, std::span<const std::uint16_t> grey,
                                 const std::filesystem::path& file) {
    const auto output = OIIO::ImageOutput::create(file.string());
    if (!output || !output->open(file.string(), OIIO::ImageSpec(size, size, 1, OIIO::TypeDesc::UINT16)) ||
        !output->write_image(OIIO::TypeDesc::UINT16, grey.data()) || !output->close()) {
        return planet::ioError(fmt::format("{}: cannot be written", file.string()));
    }
    return {};
}

planet::Result<Grey16> readGrey16(const std::filesystem::path& file) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
    if (!input) {
        OIIO::geterror();  // discards the pending error
        return planet::badInput(
            fmt::format("{}: cannot be read as an image; expected a grey image of 16 bits", file.string()));
    }
    const OIIO::ImageSpec& spec = input->spec();
    const bool isSigned = spec.format == OIIO::TypeDesc::INT16;
    if (spec.nchannels != 1 || spec.depth > 1 || spec.width < 1 || spec.height < 1 ||
        (!isSigned && spec.format != OIIO::TypeDesc::UINT16)) {
        return planet::badInput(fmt::format("{}: {} channels of {}; expected one of 16 bits", file.string(),
                                            spec.nchannels, spec.format.c_str()));
    }
    Grey16 grey{spec.width, spec.height, {}};
    std::vector<std::uint16_t> stored(static_cast<std::size_t>(spec.width) *
                                      static_cast<std::size_t>(spec.height));
    if (!input->read_image(0, 0, 0, 1, spec.format, stored.data()))
        return planet::badInput(
            fmt::format("{}: is damaged: {}; expected a complete picture", file.string(), input->geterror()));
    grey.samples.reserve(stored.size());
    for (const std::uint16_t sample : stored)
        grey.samples.push_back(isSigned ? static_cast<std::int32_t>(static_cast<std::int16_t>(sample))
                                        : static_cast<std::int32_t>(sample));
    return grey;
}

}  // namespace worldy
