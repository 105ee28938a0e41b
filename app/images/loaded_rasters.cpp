// The versions of worldy_rasters.so's functions that the program and worldy_images.so have.

#include <filesystem>

#include "app/images/loaded_module.h"

namespace worldy {

namespace {

const planet::Result<const RasterFunctions*>& rasters() {
    static const planet::Result<const RasterFunctions*> loaded = loadFunctions<RasterFunctions>(
        "worldy_rasters.so", "worldyRasterModule", "is built with Worldy and opens rasters", WORLDY_VERSION);
    return loaded;
}

}  // namespace

}  // namespace worldy

namespace planet {

using worldy::RasterFunctions;

Result<HeightSource> openHeightSource(const std::filesystem::path& path,
                                      const HeightSourceSettings& settings) {
    return worldy::callIn(worldy::rasters(), &RasterFunctions::openHeightSource, path, settings);
}

bool isGeoreferenced(const std::filesystem::path& file) {
    return worldy::askIn(worldy::rasters(), &RasterFunctions::isGeoreferenced, file);
}

Result<VrtFile> checkedVrt(const std::filesystem::path& path) {
    return worldy::callIn(worldy::rasters(), &RasterFunctions::checkedVrt, path);
}

}  // namespace planet
