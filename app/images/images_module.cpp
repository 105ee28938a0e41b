// The module worldy_images.so.
#include "app/images/image_functions.h"

extern "C" [[gnu::visibility("default")]] const worldy::ImageModule worldyImageModule;

extern "C" const worldy::ImageModule worldyImageModule = {{WORLDY_VERSION},
                                                          {
                                                              .openHeightSource = planet::openHeightSource,
                                                              .isGeoreferenced = planet::isGeoreferenced,
                                                              .checkedVrt = planet::checkedVrt,
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
                                                              .plotSweep = worldy::plotSweep,
                                                              .drawSuggestPage = worldy::drawSuggestPage,
                                                          }};
