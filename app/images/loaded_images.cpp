// The versions that the program and worldy_rasters.so have of the functions of worldy_images.so that open images and
// write them for a bake.

#include "app/images/loaded_module.h"

namespace worldy {

const planet::Result<const ImageFunctions*>& images() {
    static const planet::Result<const ImageFunctions*> loaded =
        loadFunctions<ImageFunctions>("worldy_images.so", "worldyImageModule",
                                      "is built with Worldy and reads and writes images", WORLDY_VERSION);
    return loaded;
}

}  // namespace worldy

namespace planet {

using worldy::ImageFunctions;

Result<std::shared_ptr<ImageFile>> ImageFile::open(const std::filesystem::path& path,
                                                   std::optional<int> colourChannel) {
    return worldy::callIn(worldy::images(), &ImageFunctions::openImageFile, path, colourChannel);
}

Result<void> ImageFile::readTile(int x, int y, std::span<std::byte> native) {
    return worldy::callIn(worldy::images(), &ImageFunctions::readTile, *this, x, y, native);
}

Result<void> ImageFile::readRows(int firstRow, int count, std::span<std::byte> native) {
    return worldy::callIn(worldy::images(), &ImageFunctions::readRows, *this, firstRow, count, native);
}

bool isImageExtension(const std::string& extension) {
    return worldy::askIn(worldy::images(), &ImageFunctions::isImageExtension, extension);
}

Result<void> writeLevelImages(const std::filesystem::path& chunkFile, const std::filesystem::path& folder) {
    return worldy::callIn(worldy::images(), &ImageFunctions::writeLevelImages, chunkFile, folder);
}

}  // namespace planet
