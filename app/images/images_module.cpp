// The module worldy_images.so.
#include "app/images/image_functions.h"

using planet::ImageFile;
using Module = worldy::FunctionModule<worldy::ImageFunctions>;

extern "C" [[gnu::visibility("default")]] const Module worldyImageModule;

extern "C" const Module worldyImageModule = {
    {WORLDY_VERSION},
    {
        .openImageFile = ImageFile::open,
        .readTile = [](ImageFile& file, int x, int y,
                       std::span<std::byte> native) { return file.readTile(x, y, native); },
        .readRows = [](ImageFile& file, int firstRow, int count,
                       std::span<std::byte> native) { return file.readRows(firstRow, count, native); },
        .isImageExtension = planet::isImageExtension,
        .writeLevelImages = planet::writeLevelImages,
        .readPicture = worldy::readPicture,
        .readPlanetPicture = worldy::readPlanetPicture,
        .readPictureText = worldy::readPictureText,
        .writePicture = worldy::writePicture,
        .checkPictureName = worldy::checkPictureName,
        .isOwnPicture = worldy::isOwnPicture,
        .readTexture = worldy::readTexture,
        .writeTexture = worldy::writeTexture,
        .writeGrey16 = worldy::writeGrey16,
        .readGrey16 = worldy::readGrey16,
        .plotSweep = worldy::plotSweep,
        .drawSuggestPage = worldy::drawSuggestPage,
    }};
