// The program's own versions of the functions of image_functions.h. Each loads the module at the first call, and calls the
// function there. Without the module it fails with an Error that says why.

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "app/images/image_functions.h"

namespace worldy {

namespace {

using planet::Result;

// Returns where the module lies: beside the program, as it is built, or in the folder of installed libraries.
std::filesystem::path modulePath() {
    constexpr const char* name = "worldy_images.so";
    std::error_code status;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", status);
    const std::filesystem::path folder = program.parent_path();
    const std::filesystem::path installed = folder / WORLDY_MODULES / name;
    return std::filesystem::exists(installed, status) ? installed.lexically_normal() : folder / name;
}

Result<const ImageFunctions*> load() {
    const std::filesystem::path path = modulePath();
    // The module is never closed, because open sources have functions of it.
    void* const handle = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    const void* const found = handle ? ::dlsym(handle, "worldyImageModule") : nullptr;
    if (!found) {
        return planet::ioError(fmt::format(
            "{}: cannot be loaded: {}; expected the module that is built with Worldy and reads and "
            "writes images",
            path.string(), ::dlerror()));
    }
    const auto* const module = static_cast<const ImageModule*>(found);
    if (module->build != ImageModuleBuild{WORLDY_VERSION}) {
        return planet::ioError(
            fmt::format("{}: belongs to another build of Worldy, of version {}; expected the one of this "
                        "build, of version {}",
                        path.string(), module->build.version, WORLDY_VERSION));
    }
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
