// The functions that need OpenImageIO, GDAL, PROJ or libtiff. Worldy loads these libraries, about 200 with all that they
// need, when one of the functions is called first: `worldy --version` then starts in a tenth of the time.
//
// The program has a function of the same name for each (loaded_images.cpp), which loads the module worldy_images.so beside
// the program and calls the function there. The module (images_module.cpp) and all other programs, such as the tests, have
// the functions themselves.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "app/base/picture_file.h"
#include "app/measure/sweep_plot.h"
#include "app/suggest/suggest_page.h"
#include "planet/bake/level_images.h"
#include "planet/raster/image_formats.h"
#include "planet/raster/vrt_file.h"
#include "planet/source/height_source.h"
#include "planet/source/source_layers.h"

namespace worldy {

struct ImageFunctions {
    decltype(&planet::openHeightSource) openHeightSource;
    decltype(&planet::isGeoreferenced) isGeoreferenced;
    decltype(&planet::checkedVrt) checkedVrt;
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
    decltype(&worldy::plotSweep) plotSweep;
    decltype(&worldy::drawSuggestPage) drawSuggestPage;
};

// Says which program a module fits: the version, and the sizes of what they hand each other.
struct ImageModuleBuild {
    std::string_view version;
    std::array<std::size_t, 4> sizes = {sizeof(ImageFunctions), sizeof(planet::HeightSource),
                                        sizeof(planet::HeightSourceSettings), sizeof(planet::SourceLayers)};
    bool operator==(const ImageModuleBuild&) const = default;
};

// The module exports one object of this type, under the name worldyImageModule.
struct ImageModule {
    ImageModuleBuild build;
    ImageFunctions functions;
};

}  // namespace worldy
