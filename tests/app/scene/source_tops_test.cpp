#include "app/scene/source_tops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace worldy {
namespace {

// Two layers; the upper one has heights in the north only, and none has any near the poles.
planet::SourceLayers twoLayers(int& asked) {
    planet::SourceLayers source;
    source.layers.resize(2);
    source.at =
        [&asked](const planet::Geographic& place) -> planet::Result<std::vector<planet::SourceReading>> {
        ++asked;
        const bool isPolar = std::abs(place.latitudeRad) > 1.2;
        std::vector<planet::SourceReading> readings;
        const auto height = [](bool isThere) { return isThere ? std::optional(5.0) : std::nullopt; };
        readings.push_back({.layer = 1, .heightM = height(!isPolar && place.latitudeRad >= 0)});
        readings.push_back({.layer = 0, .heightM = height(!isPolar)});
        return readings;
    };
    return source;
}

planet::DrawItem drawn(const planet::ChunkId& id) {
    planet::DrawItem item;
    item.id = id;
    return item;
}

TEST(SourceTops, AreTheTopmostLayersWithAHeight) {
    int asked = 0;
    const planet::SourceLayers source = twoLayers(asked);
    std::vector<planet::DrawItem> items;
    for (int face = 0; face < 6; ++face) {
        for (std::uint32_t i = 0; i < 16; ++i)
            items.push_back(drawn({static_cast<planet::Face>(face), 2, i % 4, i / 4}));
    }
    SourceTops tops;
    ASSERT_TRUE(addTops(source, items, tops));
    ASSERT_EQ(tops.size(), items.size());
    int upper = 0;
    int lower = 0;
    for (const auto& [id, top] : tops) {
        const double latitudeRad = placeInMiddleOf(id).latitudeRad;
        if (std::abs(latitudeRad) > 1.2) {
            EXPECT_EQ(top, std::nullopt);
            continue;
        }
        ASSERT_TRUE(top);
        EXPECT_EQ(*top, latitudeRad < 0 ? 0u : 1u);
        ++(latitudeRad < 0 ? lower : upper);
    }
    EXPECT_GT(upper, 0);
    EXPECT_GT(lower, 0);
    ASSERT_TRUE(addTops(source, items, tops));
    EXPECT_EQ(asked, static_cast<int>(items.size())) << "a chunk is asked about once";
}

TEST(SourceTops, AnUnreadablePlaceIsAnError) {
    planet::SourceLayers source;
    source.at = [](const planet::Geographic&) -> planet::Result<std::vector<planet::SourceReading>> {
        return planet::ioError("a.tif: cannot be read");
    };
    SourceTops tops;
    const auto item = drawn({});
    EXPECT_EQ(addTops(source, {&item, 1}, tops).error().message, "a.tif: cannot be read");
}

}  // namespace
}  // namespace worldy
