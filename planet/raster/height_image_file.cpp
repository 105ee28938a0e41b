#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <mutex>
#include <string_view>
#include <system_error>
#include <utility>

#include "planet/base/try.h"
#include "planet/raster/height_raster.h"

namespace planet {

namespace {

using ReaderPtr = std::unique_ptr<OIIO::ImageInput>;

constexpr int maxSide = 1 << 22;                   // samples
constexpr std::size_t maxTileSamples = 64u << 20;  // a larger tile could not be read in bounded memory

constexpr std::array<OIIO::TypeDesc::BASETYPE, sampleTypeCount> baseTypes = {
    OIIO::TypeDesc::UINT8,  OIIO::TypeDesc::INT8,  OIIO::TypeDesc::UINT16, OIIO::TypeDesc::INT16,
    OIIO::TypeDesc::UINT32, OIIO::TypeDesc::INT32, OIIO::TypeDesc::FLOAT,  OIIO::TypeDesc::DOUBLE};

OIIO::TypeDesc readAs(SampleType type) {
    return baseTypes[static_cast<std::size_t>(type)];
}

std::optional<SampleType> sampleTypeOf(const OIIO::TypeDesc& format) {
    // Half floats are exact as floats.
    if (format.basetype == OIIO::TypeDesc::HALF) return SampleType::Float;
    const auto found = std::ranges::find(baseTypes, format.basetype);
    if (found == baseTypes.end()) return std::nullopt;
    return static_cast<SampleType>(found - baseTypes.begin());
}

// Opens a reader that decodes on the calling thread, because the bake has its own threads, and returns
// colours as stored, not multiplied by alpha.
ReaderPtr openReader(const std::filesystem::path& path) {
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);
    ReaderPtr reader = OIIO::ImageInput::open(path.string(), &wish);
    if (reader) reader->threads(1);
    return reader;
}

std::string channelNames(const OIIO::ImageSpec& spec) {
    std::string names;
    for (const std::string& name : spec.channelnames) {
        if (!names.empty()) names += ", ";
        names += name;
    }
    return names;
}

// Returns the bits per sample in a PNG's header, which OpenImageIO does not report; 0 for other files.
int pngBits(const std::filesystem::path& path) {
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
    constexpr std::size_t bitsAt = 24;
    std::array<char, bitsAt + 1> header{};
    std::ifstream file(path, std::ios::binary);
    file.read(header.data(), header.size());
    return file && std::string_view(header.data(), signature.size()) == signature ? header[bitsAt] : 0;
}

Result<ImageLayout> layoutOf(const std::filesystem::path& path, const OIIO::ImageSpec& spec, bool colour) {
    const std::string file = path.string();
    if (colour && (spec.nchannels < 1 || spec.nchannels > 4)) {
        return badInput(fmt::format("{}: has {} channels ({}); expected a grey or an RGB image", file,
                                    spec.nchannels, channelNames(spec)));
    }
    if (!colour && spec.nchannels != 1) {
        return badInput(fmt::format("{}: has {} channels ({}); expected one grey channel", file,
                                    spec.nchannels, channelNames(spec)));
    }
    if (spec.deep || spec.depth > 1) {
        return badInput(fmt::format("{}: is a deep or volume image; expected a flat image", file));
    }
    if (spec.width < 1 || spec.height < 1 || spec.width > maxSide || spec.height > maxSide) {
        return badInput(fmt::format("{}: is {} x {} samples; expected [1, {}] per side", file, spec.width,
                                    spec.height, maxSide));
    }
    const std::optional<SampleType> type = sampleTypeOf(spec.format);
    if (!type) {
        return badInput(fmt::format(
            "{}: has samples of type {}; expected 8, 16 or 32 bit integers, half, float or double", file,
            spec.format.c_str()));
    }
    const bool unsignedOrFloat =
        *type != SampleType::Int8 && *type != SampleType::Int16 && *type != SampleType::Int32;
    if (colour && !unsignedOrFloat) {
        return badInput(
            fmt::format("{}: has colours of type {}; expected 8 or 16 bits without a sign, or floats", file,
                        spec.format.c_str()));
    }
    const int storedBits = spec.get_int_attribute("oiio:BitsPerSample", pngBits(path));
    const int readBits = static_cast<int>(spec.format.size()) * 8;
    if (storedBits != 0 && storedBits != readBits) {
        // The reader scales samples to the next larger integer type, so the file's own values are lost.
        return badInput(fmt::format("{}: has {} bits per sample; expected 8, 16 or 32", file, storedBits));
    }
    if (spec.tile_width > 0 && spec.tile_pixels() > maxTileSamples) {
        return badInput(fmt::format("{}: has tiles of {} x {} samples; expected at most {} samples per tile",
                                    file, spec.tile_width, spec.tile_height, maxTileSamples));
    }
    return ImageLayout{spec.width, spec.height,         spec.x, spec.y, spec.tile_width, spec.tile_height,
                       *type,      spec.format.c_str(), {}};
}

Result<void> checkIsFile(const std::filesystem::path& path) {
    std::error_code problem;
    const std::filesystem::file_status status = std::filesystem::status(path, problem);
    if (!std::filesystem::exists(status)) {
        return ioError(fmt::format("{}: no such file", path.string()));
    }
    if (!std::filesystem::is_regular_file(status)) {
        return badInput(fmt::format("{}: is not a file", path.string()));
    }
    const std::uintmax_t length = std::filesystem::file_size(path, problem);
    if (problem) return ioError(fmt::format("{}: {}", path.string(), problem.message()));
    if (length == 0) return badInput(fmt::format("{}: is empty (0 bytes)", path.string()));
    return {};
}

}  // namespace

// The readers that are not in use. Another one is opened if none is free.
struct ImageFile::Readers {
    std::mutex mutex;
    std::vector<ReaderPtr> idle;

    ReaderPtr borrow(const std::filesystem::path& path) {
        {
            const std::lock_guard lock(mutex);
            if (!idle.empty()) {
                ReaderPtr reader = std::move(idle.back());
                idle.pop_back();
                return reader;
            }
        }
        return openReader(path);
    }
    void giveBack(ReaderPtr reader) {
        const std::lock_guard lock(mutex);
        idle.push_back(std::move(reader));
    }
};

ImageFile::ImageFile(std::filesystem::path path, ImageLayout layout, int channel,
                     std::unique_ptr<Readers> readers)
    : path_(std::move(path)), layout_(std::move(layout)), channel_(channel), readers_(std::move(readers)) {}

ImageFile::~ImageFile() = default;

Result<std::shared_ptr<ImageFile>> ImageFile::open(const std::filesystem::path& path,
                                                   std::optional<int> colourChannel) {
    TRY(checkIsFile(path));
    ReaderPtr reader = openReader(path);
    if (!reader) {
        OIIO::geterror();  // clears the error, which would otherwise be reported with the next failure
        return badInput(fmt::format(
            "{}: is not a readable image; expected GeoTIFF, TIFF, PNG, JPEG or another image format",
            path.string()));
    }
    TRY_ASSIGN(auto layout, layoutOf(path, reader->spec(), colourChannel.has_value()));
    TRY_ASSIGN(auto tags, geoTagsOf(path, std::string_view(reader->format_name()) == "tiff"));
    layout.geoTags = std::move(tags);
    // One or two channels are grey, without or with alpha.
    const int channel = reader->spec().nchannels < 3 ? 0 : colourChannel.value_or(0);
    auto readers = std::make_unique<Readers>();
    readers->giveBack(std::move(reader));
    return std::shared_ptr<ImageFile>(new ImageFile(path, std::move(layout), channel, std::move(readers)));
}

namespace {

// Returns the reason of a failure. Some readers fail without a message, and libtiff with the row 2^32 - 1.
std::string reasonOf(const OIIO::ImageInput& reader) {
    const std::string error = reader.geterror();
    const bool tellsNothing = error.empty() || error.find("4294967295") != std::string::npos;
    return tellsNothing ? "truncated or damaged" : error;
}

}  // namespace

Result<void> ImageFile::readTile(int x, int y, std::span<std::byte> native) {
    assert(native.size() == bytesOf(layout_.type) * static_cast<std::size_t>(layout_.tileWidth) *
                                static_cast<std::size_t>(layout_.tileHeight));
    ReaderPtr reader = readers_->borrow(path_);
    if (!reader) return ioError(fmt::format("{}: {}", path_.string(), OIIO::geterror()));
    const int tileX = layout_.originX + x / layout_.tileWidth * layout_.tileWidth;
    const int tileY = layout_.originY + y / layout_.tileHeight * layout_.tileHeight;
    const int endX = std::min(tileX + layout_.tileWidth, layout_.originX + layout_.width);
    const int endY = std::min(tileY + layout_.tileHeight, layout_.originY + layout_.height);
    const auto sampleBytes = static_cast<OIIO::stride_t>(bytesOf(layout_.type));
    const bool read =
        reader->read_tiles(0, 0, tileX, endX, tileY, endY, 0, 1, channel_, channel_ + 1, readAs(layout_.type),
                           native.data(), sampleBytes, sampleBytes * layout_.tileWidth);
    if (!read || reader->has_error()) {
        return ioError(fmt::format("{}: the tile at ({}, {}) cannot be read: {}", path_.string(), tileX,
                                   tileY, reasonOf(*reader)));
    }
    readers_->giveBack(std::move(reader));
    return {};
}

Result<void> ImageFile::readRows(int firstRow, int count, std::span<std::byte> native) {
    assert(native.size() ==
           bytesOf(layout_.type) * static_cast<std::size_t>(layout_.width) * static_cast<std::size_t>(count));
    ReaderPtr reader = readers_->borrow(path_);
    if (!reader) return ioError(fmt::format("{}: {}", path_.string(), OIIO::geterror()));
    const int begin = layout_.originY + firstRow;
    const bool read = reader->read_scanlines(0, 0, begin, begin + count, 0, channel_, channel_ + 1,
                                             readAs(layout_.type), native.data());
    // A truncated strip leaves an error message although the call returns true.
    if (!read || reader->has_error()) {
        return ioError(fmt::format("{}: rows {} to {} cannot be read: {}", path_.string(), firstRow,
                                   firstRow + count - 1, reasonOf(*reader)));
    }
    readers_->giveBack(std::move(reader));
    return {};
}

}  // namespace planet
