// The versions of worldy_images.so's other functions that the program has.

#include <filesystem>
#include <string>

#include "app/images/loaded_module.h"

namespace worldy {

using planet::Result;

void loadImageLibraries() {
    images();
}

Result<Picture> readPicture(const std::filesystem::path& file) {
    return callIn(images(), &ImageFunctions::readPicture, file);
}

Result<Picture> readPlanetPicture(const std::filesystem::path& file) {
    return callIn(images(), &ImageFunctions::readPlanetPicture, file);
}

Result<std::string> readPictureText(const std::filesystem::path& file, const std::string& keyword) {
    return callIn(images(), &ImageFunctions::readPictureText, file, keyword);
}

Result<void> writePicture(const Picture& picture, const std::filesystem::path& file,
                          std::span<const PictureText> texts) {
    return callIn(images(), &ImageFunctions::writePicture, picture, file, texts);
}

Result<void> checkPictureName(const std::filesystem::path& file) {
    return callIn(images(), &ImageFunctions::checkPictureName, file);
}

bool isOwnPicture(const std::filesystem::path& file) {
    return askIn(images(), &ImageFunctions::isOwnPicture, file);
}

Result<Texture> readTexture(const std::filesystem::path& file) {
    return callIn(images(), &ImageFunctions::readTexture, file);
}

Result<void> writeTexture(const Texture& texture, const std::filesystem::path& file) {
    return callIn(images(), &ImageFunctions::writeTexture, texture, file);
}

Result<void> writeGrey16(int size, std::span<const std::uint16_t> grey, const std::filesystem::path& file) {
    return callIn(images(), &ImageFunctions::writeGrey16, size, grey, file);
}

Result<Grey16> readGrey16(const std::filesystem::path& file) {
    return callIn(images(), &ImageFunctions::readGrey16, file);
}

Result<Picture> plotSweep(std::span<const SweepPoint> points, SweepCost cost, const std::string& title) {
    return callIn(images(), &ImageFunctions::plotSweep, points, cost, title);
}

Result<Picture> drawSuggestPage(const SuggestPage& page) {
    return callIn(images(), &ImageFunctions::drawSuggestPage, page);
}

}  // namespace worldy
