// The module worldy_rasters.so.
#include "app/images/image_functions.h"

using Module = worldy::FunctionModule<worldy::RasterFunctions>;

extern "C" [[gnu::visibility("default")]] const Module worldyRasterModule;

extern "C" const Module worldyRasterModule = {{WORLDY_VERSION},
                                              {
                                                  .openHeightSource = planet::openHeightSource,
                                                  .isGeoreferenced = planet::isGeoreferenced,
                                                  .checkedVrt = planet::checkedVrt,
                                              }};
