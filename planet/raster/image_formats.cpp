#include "planet/raster/image_formats.h"

#include <OpenImageIO/imageio.h>

#include "planet/raster/image_names.h"

namespace planet {

bool isImageExtension(const std::string& extension) {
    if (extension.size() < 2) return false;
    const std::string wanted = lowerCase(extension.substr(1));
    // The list is "png:png;tiff:tif,tiff,env;...".
    static const std::string known = OIIO::get_string_attribute("extension_list");
    for (std::size_t at = known.find(wanted); at != std::string::npos; at = known.find(wanted, at + 1)) {
        const std::size_t end = at + wanted.size();
        const bool starts = at > 0 && (known[at - 1] == ':' || known[at - 1] == ',');
        const bool ends = end == known.size() || known[end] == ',' || known[end] == ';';
        if (starts && ends) return true;
    }
    return false;
}

}  // namespace planet
