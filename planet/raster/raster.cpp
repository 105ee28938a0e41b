#include "planet/raster/raster.h"

#include <fmt/format.h>

namespace planet {

Result<void> ToldDatum::add(const Raster& raster, std::string_view expected) {
    const RasterLayout& layout = raster.layout();
    if (layout.verticalName.empty()) return {};
    if (path_.empty()) {
        path_ = raster.path();
        name_ = layout.verticalName;
        datum_ = layout.datum;
    }
    if (layout.verticalName == name_ || (datum_ && layout.datum == datum_)) return {};
    return badInput(fmt::format("{}: says that its heights are {}, but {} says {}; expected {}",
                                raster.path().string(), layout.verticalName, path_.string(), name_,
                                expected));
}

}  // namespace planet
