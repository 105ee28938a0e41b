// The functions that need OpenImageIO, GDAL, PROJ or libtiff. Worldy loads these libraries, about 250 with all that they
// need, when one of the functions is called first: `worldy --version` then starts in a tenth of the time.
//
// There are two modules, because most bakes of rasters need GDAL alone, which takes a fifth of the time to load that
// OpenImageIO takes: worldy_rasters.so opens sources with GDAL and PROJ, and worldy_images.so reads and writes images with
// OpenImageIO. The program and each module have a function of the same name for each one of another module
// (loaded_*.cpp), which loads that module beside the program and calls the function there. The modules themselves
// (*_module.cpp) and all other programs, such as the tests, have the functions themselves.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "app/base/picture_file.h"
#include "app/measure/sweep_plot.h"
#include "app/suggest/suggest_page.h"
#include "planet/bake/level_images.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/image_formats.h"
#include "planet/raster/vrt_file.h"
#include "planet/source/height_source.h"
#include "planet/source/source_layers.h"

namespace worldy {

// The functions that worldy_rasters.so exports.
struct RasterFunctions {
    decltype(&planet::openHeightSource) openHeightSource;
    decltype(&planet::isGeoreferenced) isGeoreferenced;
    decltype(&planet::checkedVrt) checkedVrt;
};

// The functions that worldy_images.so exports.
struct ImageFunctions {
    decltype(&planet::ImageFile::open) openImageFile;
    planet::Result<void> (*readTile)(planet::ImageFile& file, int x, int y, std::span<std::byte> native);
    planet::Result<void> (*readRows)(planet::ImageFile& file, int firstRow, int count,
                                     std::span<std::byte> native);
    decltype(&planet::isImageExtension) isImageExtension;
    decltype(&planet::writeLevelImages) writeLevelImages;
    decltype(&worldy::readPicture) readPicture;
    decltype(&worldy::readPlanetPicture) readPlanetPicture;
    decltype(&worldy::readPictureText) readPictureText;
    decltype(&worldy::writePicture) writePicture;
    decltype(&worldy::checkPictureName) checkPictureName;
    decltype(&worldy::isOwnPicture) isOwnPicture;
    decltype(&worldy::readTexture) readTexture;
    decltype(&worldy::writeTexture) writeTexture;
    decltype(&worldy::writeGrey16) writeGrey16;
    decltype(&worldy::readGrey16) readGrey16;
    decltype(&worldy::plotSweep) plotSweep;
    decltype(&worldy::drawSuggestPage) drawSuggestPage;
};

// Says which program a module fits: the version, and the sizes of what they hand each other.
struct ModuleBuild {
    std::string_view version;
    std::array<std::size_t, 6> sizes = {sizeof(RasterFunctions),      sizeof(ImageFunctions),
                                        sizeof(planet::HeightSource), sizeof(planet::HeightSourceSettings),
                                        sizeof(planet::SourceLayers), sizeof(planet::ImageFile)};
    bool operator==(const ModuleBuild&) const = default;
};

// A module exports one object of this type, under the name worldyRasterModule or worldyImageModule.
template <class Functions>
struct FunctionModule {
    ModuleBuild build;
    Functions functions;
};

}  // namespace worldy
