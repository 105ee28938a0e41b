// The program's own versions of the functions of image_functions.h. Each loads the module at the first call, and calls the
// function there. Without the module it fails with an Error that says why.

#include <filesystem>
#include <string>

#include "app/base/module.h"
#include "app/images/image_functions.h"

namespace worldy {

namespace {

using planet::Result;

Result<const ImageFunctions*> load() {
    constexpr const char* file = "worldy_images.so";
    // The module is never closed, because open sources have functions of it.
    const Result<const void*> found =
        loadModule(file, "worldyImageModule", "is built with Worldy and reads and writes images");
    if (!found) return tl::unexpected(found.error());
    const auto* const module = static_cast<const ImageModule*>(*found);
    if (module->build != ImageModuleBuild{WORLDY_VERSION})
        return tl::unexpected(otherBuild(file, std::string(module->build.version)));
    return &module->functions;
}

const Result<const ImageFunctions*>& images() {
    static const Result<const ImageFunctions*> loaded = load();
    return loaded;
}

// Calls a function of the module that returns a Result.
template <class Function, class... Arguments>
auto call(Function ImageFunctions::*function, const Arguments&... arguments) {
    using Returned = decltype(((*images())->*function)(arguments...));
    if (!images()) return Returned(tl::unexpected(images().error()));
    return ((*images())->*function)(arguments...);
}

// Calls one that returns a bool, which is false without the module.
template <class Function, class... Arguments>
bool ask(Function ImageFunctions::*function, const Arguments&... arguments) {
    return images() && ((*images())->*function)(arguments...);
}

}  // namespace

void loadImageLibraries() {
    images();
}

Result<Picture> readPicture(const std::filesystem::path& file) {
    return call(&ImageFunctions::readPicture, file);
}

Result<Picture> readPlanetPicture(const std::filesystem::path& file) {
    return call(&ImageFunctions::readPlanetPicture, file);
}

Result<std::string> readPictureText(const std::filesystem::path& file, const std::string& keyword) {
    return call(&ImageFunctions::readPictureText, file, keyword);
}

Result<void> writePicture(const Picture& picture, const std::filesystem::path& file,
                          std::span<const PictureText> texts) {
    return call(&ImageFunctions::writePicture, picture, file, texts);
}

Result<void> checkPictureName(const std::filesystem::path& file) {
    return call(&ImageFunctions::checkPictureName, file);
}

bool isOwnPicture(const std::filesystem::path& file) {
    return ask(&ImageFunctions::isOwnPicture, file);
}

Result<Texture> readTexture(const std::filesystem::path& file) {
    return call(&ImageFunctions::readTexture, file);
}

Result<void> writeTexture(const Texture& texture, const std::filesystem::path& file) {
    return call(&ImageFunctions::writeTexture, texture, file);
}

Result<void> writeGrey16(int size, std::span<const std::uint16_t> grey, const std::filesystem::path& file) {
    return call(&ImageFunctions::writeGrey16, size, grey, file);
}

Result<Picture> plotSweep(std::span<const SweepPoint> points, SweepCost cost, const std::string& title) {
    return call(&ImageFunctions::plotSweep, points, cost, title);
}

Result<Picture> drawSuggestPage(const SuggestPage& page) {
    return call(&ImageFunctions::drawSuggestPage, page);
}

}  // namespace worldy

namespace planet {

using worldy::ImageFunctions;

Result<HeightSource> openHeightSource(const std::filesystem::path& path,
                                      const HeightSourceSettings& settings) {
    return worldy::call(&ImageFunctions::openHeightSource, path, settings);
}

bool isGeoreferenced(const std::filesystem::path& file) {
    return worldy::ask(&ImageFunctions::isGeoreferenced, file);
}

Result<VrtFile> checkedVrt(const std::filesystem::path& path) {
    return worldy::call(&ImageFunctions::checkedVrt, path);
}

bool isImageExtension(const std::string& extension) {
    return worldy::ask(&ImageFunctions::isImageExtension, extension);
}

Result<void> writeLevelImages(const std::filesystem::path& chunkFile, const std::filesystem::path& folder) {
    return worldy::call(&ImageFunctions::writeLevelImages, chunkFile, folder);
}

}  // namespace planet
