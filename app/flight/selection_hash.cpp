#include "app/flight/selection_hash.h"

#include <xxhash.h>

#include <cstddef>
#include <vector>

#include "planet/base/little_endian.h"

namespace worldy {

std::uint64_t selectionHashOf(const planet::Planet& planet) {
    std::vector<std::byte> bytes;
    planet::ByteWriter out(bytes);
    for (std::size_t v = 0; v < planet.views().size(); ++v) {
        const planet::Selection& selection = planet.selection(v);
        out.put(static_cast<std::uint64_t>(selection.draw.size()));
        for (const planet::DrawItem& item : selection.draw) {
            out.put(planet::keyOf(item.id));
            out.put(item.morph);
            for (const std::uint8_t levels : item.coarserBy) out.put(levels);
            for (const float morph : item.edgeMorph) out.put(morph);
        }
    }
    return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace worldy
