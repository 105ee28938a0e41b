// Images whose tags, or size, say where their samples lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "planet/raster/image_placement.h"
#include "planet/source/colour_source.h"
#include "tests/planet/source/height_source_fixture.h"

namespace planet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double radPerDegree = 3.14159265358979323846 / 180;

// The tags that are written into the file. Empty ones are left out.
struct GeoTiff {
    int width = 0;
    int height = 0;
    std::vector<double> pixelScale{};
    std::vector<double> tiepoint{};
    std::vector<double> transformation{};
    std::vector<std::uint16_t> keys{};  // fours of key, location, count, value
    std::vector<double> doubleParams{};
    std::string noData{};
    std::string metadata{};
};

constexpr std::array<std::uint16_t, 4> geographic = {1024, 0, 1, 2};
constexpr std::array<std::uint16_t, 4> projected = {1024, 0, 1, 1};
constexpr std::array<std::uint16_t, 4> pixelIsArea = {1025, 0, 1, 1};
constexpr std::array<std::uint16_t, 4> pixelIsPoint = {1025, 0, 1, 2};

std::vector<std::uint16_t> keysOf(const std::vector<std::array<std::uint16_t, 4>>& entries) {
    std::vector<std::uint16_t> keys;
    for (const auto& entry : entries) keys.insert(keys.end(), entry.begin(), entry.end());
    return keys;
}

// Samples stepDeg apart from the raster's origin.
GeoTiff placedAt(int width, int height, double westDeg, double northDeg, double stepDeg,
                 const std::array<std::uint16_t, 4>& rasterType) {
    return {.width = width,
            .height = height,
            .pixelScale = {stepDeg, stepDeg, 0},
            .tiepoint = {0, 0, 0, westDeg, northDeg, 0},
            .transformation = {},
            .keys = keysOf({geographic, rasterType}),
            .doubleParams = {},
            .noData = {},
            .metadata = {}};
}

using HeightAt = std::function<double(int column, int row)>;

template <class T>
void writeGeoTiff(const std::filesystem::path& path, const GeoTiff& tiff, const HeightAt& heightAt) {
    std::array names = {std::string("scale"),   std::string("tie"),     std::string("matrix"),
                        std::string("keys"),    std::string("doubles"), std::string("nodata"),
                        std::string("metadata")};
    const std::array<TIFFFieldInfo, 7> fields = {{
        {33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[0].data()},
        {33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[1].data()},
        {34264, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[2].data()},
        {34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, names[3].data()},
        {34736, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[4].data()},
        {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[5].data()},
        {42112, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[6].data()},
    }};
    TIFF* const out = TIFFOpen(path.c_str(), "w");
    ASSERT_TRUE(out);
    TIFFMergeFieldInfo(out, fields.data(), static_cast<std::uint32_t>(fields.size()));
    TIFFSetField(out, TIFFTAG_IMAGEWIDTH, tiff.width);
    TIFFSetField(out, TIFFTAG_IMAGELENGTH, tiff.height);
    TIFFSetField(out, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T)));
    TIFFSetField(out, TIFFTAG_SAMPLESPERPIXEL, 1);
    constexpr int integer = std::is_signed_v<T> ? SAMPLEFORMAT_INT : SAMPLEFORMAT_UINT;
    TIFFSetField(out, TIFFTAG_SAMPLEFORMAT, std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP : integer);
    TIFFSetField(out, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(out, TIFFTAG_ROWSPERSTRIP, 16);
    const auto set = [&](std::uint32_t tag, const auto& values) {
        if (!values.empty()) TIFFSetField(out, tag, static_cast<int>(values.size()), values.data());
    };
    set(33550, tiff.pixelScale);
    set(33922, tiff.tiepoint);
    set(34264, tiff.transformation);
    if (!tiff.keys.empty()) {
        std::vector<std::uint16_t> directory = {1, 1, 0, static_cast<std::uint16_t>(tiff.keys.size() / 4)};
        directory.insert(directory.end(), tiff.keys.begin(), tiff.keys.end());
        set(34735, directory);
    }
    set(34736, tiff.doubleParams);
    if (!tiff.noData.empty()) TIFFSetField(out, 42113, tiff.noData.c_str());
    if (!tiff.metadata.empty()) TIFFSetField(out, 42112, tiff.metadata.c_str());
    std::vector<T> samples(static_cast<std::size_t>(tiff.width));
    for (int row = 0; row < tiff.height; ++row) {
        for (int column = 0; column < tiff.width; ++column)
            samples[static_cast<std::size_t>(column)] = static_cast<T>(heightAt(column, row));
        ASSERT_EQ(TIFFWriteScanline(out, samples.data(), static_cast<std::uint32_t>(row), 0), 1);
    }
    TIFFClose(out);
}

HeightAt fieldFrom(double firstLongitudeDeg, double firstLatitudeDeg, double stepDeg) {
    return [=](int column, int row) {
        return smoothField(directionFromGeographic({(firstLatitudeDeg - row * stepDeg) * radPerDegree,
                                                    (firstLongitudeDeg + column * stepDeg) * radPerDegree}));
    };
}

// Half a sample off would be an error of some 25 m.
void expectIsTheField(const std::filesystem::path& path) {
    EXPECT_LT(largestError(mustOpen(path), 128, smoothField), 1) << path;
}

TEST(GeoTiff, AWholePlanetIsPlacedByItsTags) {
    const TemporaryFolder folder;
    writeGeoTiff<float>(folder / "area.tif", placedAt(360, 180, -180, 90, 1, pixelIsArea),
                        fieldFrom(-179.5, 89.5, 1));
    expectIsTheField(folder / "area.tif");
    writeGeoTiff<float>(folder / "from0.tif", placedAt(360, 180, 0, 90, 1, pixelIsArea),
                        fieldFrom(0.5, 89.5, 1));
    expectIsTheField(folder / "from0.tif");
    writeGeoTiff<float>(folder / "from-75.tif", placedAt(360, 180, -75, 90, 1, pixelIsArea),
                        fieldFrom(-74.5, 89.5, 1));
    expectIsTheField(folder / "from-75.tif");
    writeGeoTiff<float>(folder / "points.tif", placedAt(361, 181, -180, 90, 1, pixelIsPoint),
                        fieldFrom(-180, 90, 1));
    expectIsTheField(folder / "points.tif");
    writeGeoTiff<float>(folder / "pointsFrom0.tif", placedAt(361, 181, 0, 90, 1, pixelIsPoint),
                        fieldFrom(0, 90, 1));
    expectIsTheField(folder / "pointsFrom0.tif");
    writeGeoTiff<float>(folder / "pointCentres.tif", placedAt(360, 180, -179.5, 89.5, 1, pixelIsPoint),
                        fieldFrom(-179.5, 89.5, 1));
    expectIsTheField(folder / "pointCentres.tif");
    writeGeoTiff<float>(folder / "cellsAroundPoints.tif", placedAt(360, 181, -0.5, 90.5, 1, pixelIsArea),
                        fieldFrom(0, 90, 1));
    expectIsTheField(folder / "cellsAroundPoints.tif");
}

TEST(GeoTiff, ATransformationAndATiepointInTheMiddlePlaceTheSame) {
    const TemporaryFolder folder;
    GeoTiff matrix = placedAt(360, 180, 0, 0, 1, pixelIsArea);
    matrix.pixelScale = matrix.tiepoint = {};
    matrix.transformation = {1, 0, 0, 0, 0, -1, 0, 90, 0, 0, 0, 0, 0, 0, 0, 1};
    writeGeoTiff<float>(folder / "matrix.tif", matrix, fieldFrom(0.5, 89.5, 1));
    expectIsTheField(folder / "matrix.tif");
    GeoTiff middle = placedAt(360, 180, 0, 0, 1, pixelIsArea);
    middle.tiepoint = {180, 90, 0, 0, 0, 0};
    writeGeoTiff<float>(folder / "middle.tif", middle, fieldFrom(-179.5, 89.5, 1));
    expectIsTheField(folder / "middle.tif");
}

TEST(GeoTiff, EquirectangularMetresOfTheWholePlanetArePlaced) {
    const TemporaryFolder folder;
    constexpr double radiusM = 3'396'190;
    const double stepM = radiusM * radPerDegree;
    GeoTiff mars = placedAt(360, 180, -180 * stepM, 90 * stepM, stepM, pixelIsArea);
    mars.keys = keysOf({projected, pixelIsArea, {2057, 34736, 1, 0}, {3075, 0, 1, 17}, {3076, 0, 1, 9001}});
    mars.doubleParams = {radiusM};
    writeGeoTiff<float>(folder / "mars.tif", mars, fieldFrom(-179.5, 89.5, 1));
    expectIsTheField(folder / "mars.tif");
}

TEST(GeoTiff, TagsOfTheUsualPlaceChangeNoBit) {
    const TemporaryFolder folder;
    const HeightAt field = fieldFrom(-179.5, 89.5, 1);
    writeGeoTiff<float>(folder / "plain.tif", {.width = 360, .height = 180}, field);
    GeoTiff tagged = placedAt(360, 180, -180, 90, 0.99999999, pixelIsArea);
    writeGeoTiff<float>(folder / "tagged.tif", tagged, field);
    for (const Face face : allFaces)
        EXPECT_EQ(sampledFace(mustOpen(folder / "tagged.tif"), face, 64),
                  sampledFace(mustOpen(folder / "plain.tif"), face, 64));
}

TEST(GeoTiff, WithoutTagsTheSizeTellsAGridOfPoints) {
    const TemporaryFolder folder;
    writeGeoTiff<float>(folder / "points.tif", {.width = 361, .height = 181}, fieldFrom(-180, 90, 1));
    expectIsTheField(folder / "points.tif");
    EXPECT_EQ(mustOpen(folder / "points.tif").description,
              "points.tif, 361 x 181 float, equirectangular grid points from pole to pole, the last column "
              "repeats the first");
    writeGeoTiff<float>(folder / "once.tif", {.width = 360, .height = 181}, fieldFrom(-180, 90, 1));
    expectIsTheField(folder / "once.tif");
    writeGeoTiff<float>(folder / "from0.tif", placedAt(360, 180, 0, 90, 1, pixelIsArea),
                        fieldFrom(0.5, 89.5, 1));
    EXPECT_EQ(mustOpen(folder / "from0.tif").description,
              "from0.tif, 360 x 180 float, equirectangular from longitude 0");
}

TEST(GeoTiff, AGridOfPointsGivesItsOwnValuesAtItsPoints) {
    const TemporaryFolder folder;
    writeGeoTiff<float>(folder / "latitudes.tif", {.width = 361, .height = 181},
                        [](int, int row) { return 90 - row; });
    const HeightSource source = mustOpen(folder / "latitudes.tif");
    EXPECT_NEAR(sampledNear(source, 4096, 45, 10), 45, 0.02);
    EXPECT_NEAR(sampledNear(source, 4096, 90, 0), 90, 0.02);
    EXPECT_NEAR(sampledNear(source, 4096, -89, 170), -89, 0.02);
}

TEST(GeoTiff, SharedEdgesAreBitIdenticalAndTilesAgreeWhereverTheImageBegins) {
    const TemporaryFolder folder;
    writeGeoTiff<std::int16_t>(folder / "a.tif", placedAt(361, 181, 0, 90, 1, pixelIsPoint),
                               [](int column, int row) { return noise(column % 360, row, 4000); });
    const HeightSource source = mustOpen(folder / "a.tif");
    const SharedPoints points = sharedPoints(source, 64);
    EXPECT_EQ(points.different, 0);
    expectTilesAgree(source, 64, 8);
}

// The red of a picture at a place on a fine grid, sRGB in [0, 255].
double redNear(const std::filesystem::path& picture, double latitudeDeg, double longitudeDeg) {
    const Result<ColourSource> source = openColourSource(picture);
    EXPECT_TRUE(source) << source.error().message;
    if (!source) return -1;
    HeightSource red;
    red.sample = [&](const SampleTile& tile, std::span<float> out) {
        std::vector<glm::vec3> colours(out.size());
        const Result<void> sampled = source->sample(tile, colours);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = colours[i].r;
        return sampled;
    };
    const auto linear = static_cast<double>(sampledNear(red, 1 << 20, latitudeDeg, longitudeDeg));
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

TEST(GeoTiff, ColoursOfRegionsLieWhereTheirTagsSay) {
    const TemporaryFolder folder;
    const HeightAt flat = [](int, int) { return 50; };
    writeGeoTiff<std::uint8_t>(folder / "region.tif", placedAt(20, 10, 10, 50, 1, pixelIsArea), flat);
    EXPECT_NEAR(redNear(folder / "region.tif", 45, 20), 50, 0.1);
    EXPECT_EQ(redNear(folder / "region.tif", 45, 31), 0);
    writeGeoTiff<std::uint8_t>(folder / "band.tif", placedAt(360, 120, -180, 60, 1, pixelIsArea), flat);
    EXPECT_NEAR(redNear(folder / "band.tif", 59, -170), 50, 0.1);
    EXPECT_EQ(redNear(folder / "band.tif", 61, -170), 0);
    writeGeoTiff<std::uint8_t>(folder / "tile.tif", placedAt(61, 61, 86, 28, 1 / 60.0, pixelIsPoint), flat);
    EXPECT_NEAR(redNear(folder / "tile.tif", 27.5, 86.5), 50, 0.1);
    GeoTiff utm = placedAt(360, 180, 500'000, 4'600'000, 300, pixelIsArea);
    utm.keys = keysOf({projected, pixelIsArea, {3072, 0, 1, 32633}});
    writeGeoTiff<std::uint8_t>(folder / "utm.tif", utm, flat);
    EXPECT_NEAR(redNear(folder / "utm.tif", 41.3, 15.5), 50, 0.1);
    GeoTiff southUp = placedAt(360, 180, 0, 0, 1, pixelIsArea);
    southUp.pixelScale = southUp.tiepoint = {};
    southUp.transformation = {1, 0, 0, -180, 0, 1, 0, -90, 0, 0, 0, 0, 0, 0, 0, 1};
    writeGeoTiff<std::uint8_t>(folder / "southUp.tif", southUp,
                               [](int, int row) { return row < 90 ? 50 : 90; });
    EXPECT_NEAR(redNear(folder / "southUp.tif", -45, 10), 50, 0.1);
    EXPECT_NEAR(redNear(folder / "southUp.tif", 45, 10), 90, 0.1);
}

TEST(GeoTiff, HeightsMayRunFromSouthToNorth) {
    const TemporaryFolder folder;
    GeoTiff southUp = placedAt(360, 180, 0, 0, 1, pixelIsArea);
    southUp.pixelScale = southUp.tiepoint = {};
    southUp.transformation = {1, 0, 0, -180, 0, 1, 0, -90, 0, 0, 0, 0, 0, 0, 0, 1};
    writeGeoTiff<std::int16_t>(folder / "southUp.tif", southUp, [](int, int row) { return 10 * (row - 90); });
    const HeightSource source = mustOpen(folder / "southUp.tif");
    EXPECT_NEAR(sampledNear(source, 1 << 18, 30.5, 20), 300, 0.1);
    EXPECT_NEAR(sampledNear(source, 1 << 18, -70.5, -120), -710, 0.1);
}

TEST(GeoTiff, PositionsThatAreNotFiniteAreRefused) {
    const TemporaryFolder folder;
    GeoTiff endless = placedAt(360, 180, -180, 90, 1, pixelIsArea);
    endless.tiepoint[3] = std::numeric_limits<double>::infinity();
    writeGeoTiff<std::int16_t>(folder / "endless.tif", endless, [](int, int) { return 5; });
    EXPECT_THAT(errorOf(folder / "endless.tif"), HasSubstr("numbers that are not finite"));
}

TEST(GeoTiff, ATileWithoutTagsIsNotToBeCropped) {
    const TemporaryFolder folder;
    writeGeoTiff<std::int16_t>(folder / "tile.tif", {.width = 361, .height = 361},
                               [](int, int) { return 5; });
    EXPECT_THAT(
        errorOf(folder / "tile.tif"),
        AllOf(HasSubstr("tile.tif: is 361 x 361 samples; expected an equirectangular image of the whole "
                        "planet, twice as wide as high"),
              HasSubstr("heights of a region need a coordinate reference system"), Not(HasSubstr("180"))));
}

TEST(GeoTiff, SamplesOfTheNoDataValueAreMissing) {
    const TemporaryFolder folder;
    GeoTiff tiff = placedAt(72, 36, -180, 90, 5, pixelIsArea);
    tiff.noData = "-32768";
    const HeightAt hole = [](int column, int row) { return column < 10 && row < 3 ? -32768 : 100; };
    writeGeoTiff<std::int16_t>(folder / "hole.tif", tiff, hole);
    const HeightSource source = mustOpen(folder / "hole.tif");
    EXPECT_EQ(source.missingCount, 30u);
    EXPECT_EQ(source.minM, 0);
    EXPECT_EQ(source.maxM, 100);
    HeightSourceSettings settings;
    settings.noDataValue = 100;
    EXPECT_EQ(mustOpen(folder / "hole.tif", settings).missingCount, 72u * 36u - 30u)
        << "the setting is meant";
    tiff.noData = "-3.40282346638529e+38";  // as GDAL writes the lowest float
    writeGeoTiff<float>(folder / "lowest.tif", tiff, [](int column, int) {
        return column == 0 ? static_cast<double>(std::numeric_limits<float>::lowest()) : 7.0;
    });
    EXPECT_EQ(mustOpen(folder / "lowest.tif").missingCount, 36u);
    EXPECT_EQ(mustOpen(folder / "lowest.tif").maxM, 7);
}

std::string bandItem(const std::string& name, const std::string& role, const std::string& value) {
    return "<Item name=\"" + name + "\" sample=\"0\" role=\"" + role + "\">" + value + "</Item>\n";
}

TEST(GeoTiff, ScaleOffsetAndUnitOfItsMetadataMakeMetres) {
    const TemporaryFolder folder;
    GeoTiff tiff = placedAt(72, 36, -180, 90, 5, pixelIsArea);
    tiff.metadata = "<GDALMetadata>\n" + bandItem("OFFSET", "offset", "1000") +
                    bandItem("SCALE", "scale", "0.5") + bandItem("UNITTYPE", "unittype", "ft") +
                    "</GDALMetadata>";
    writeGeoTiff<std::int16_t>(folder / "feet.tif", tiff, [](int, int) { return 200; });
    const HeightSource source = mustOpen(folder / "feet.tif");
    EXPECT_NEAR(source.maxM, 1100 * 0.3048, 1e-3);
    EXPECT_NEAR(source.stepM, 0.5 * 0.3048, 1e-9);
    HeightSourceSettings settings;
    settings.metresPerUnit = 2;
    EXPECT_EQ(mustOpen(folder / "feet.tif", settings).maxM, 400) << "the setting is meant";
    settings.metresPerUnit = 1;
    EXPECT_EQ(mustOpen(folder / "feet.tif", settings).maxM, 200) << "1 is given, and so is no offset";
    settings.offsetM = 7;
    EXPECT_EQ(mustOpen(folder / "feet.tif", settings).maxM, 207);
    settings.metresPerUnit.reset();
    EXPECT_NEAR(mustOpen(folder / "feet.tif", settings).maxM, 100 * 0.3048 + 7, 1e-3);
    settings.offsetM = 0;
    EXPECT_NEAR(mustOpen(folder / "feet.tif", settings).maxM, 100 * 0.3048, 1e-3) << "0 is given";
    tiff.metadata = "<GDALMetadata>" + bandItem("UNITTYPE", "unittype", "fathom") + "</GDALMetadata>";
    writeGeoTiff<std::int16_t>(folder / "deep.tif", tiff, [](int, int) { return 200; });
    EXPECT_THAT(
        errorOf(folder / "deep.tif"),
        HasSubstr("deep.tif: its heights are in fathom, which is not known; expected metres or feet"));
    settings = {};
    settings.metresPerUnit = 1;
    EXPECT_EQ(mustOpen(folder / "deep.tif", settings).maxM, 200) << "the unit is overridden";
    tiff.metadata = "<GDALMetadata>" + bandItem("UNITTYPE", "unittype", "metre") +
                    "<Item name=\"SCALE\" sample=\"1\" role=\"scale\">7</Item></GDALMetadata>";
    writeGeoTiff<std::int16_t>(folder / "plain.tif", tiff, [](int, int) { return 200; });
    EXPECT_EQ(mustOpen(folder / "plain.tif").maxM, 200);
}

TEST(GeoTiff, AWorldFileBesideAnImagePlacesIt) {
    const TemporaryFolder folder;
    const GeoTiff bare = {.width = 360, .height = 180};
    writeGeoTiff<float>(folder / "from0.tif", bare, fieldFrom(0.5, 89.5, 1));
    std::ofstream(folder / "from0.tfw") << "1\n0\n0\n-1\n0.5\n89.5\n";
    expectIsTheField(folder / "from0.tif");
    EXPECT_EQ(heightSourceFiles(folder / "from0.tif").files.size(), 2u);
    for (const char* name : {"tfw", "tifw", "wld", "TFW"}) {
        const std::filesystem::path image = folder / (std::string("region_") + name + ".tif");
        writeGeoTiff<std::uint8_t>(image, bare, [](int, int) { return 5; });
        std::filesystem::path world = image;
        world.replace_extension(name);
        std::ofstream(world) << "0.01\n0\n0\n-0.01\n7.005\n46.995\n";
        EXPECT_THAT(errorOf(image), HasSubstr("has no coordinate reference system"));
        EXPECT_THAT(colourErrorOf(image), HasSubstr("has no coordinate reference system"));
        std::ofstream(world) << "no numbers";
        EXPECT_THAT(errorOf(image), HasSubstr(world.filename().string() + ": is an ESRI world file beside"));
    }
}

TEST(GeoTiff, AuxiliaryFileBesideAnImagePlacesAndScalesIt) {
    const TemporaryFolder folder;
    const GeoTiff bare = {.width = 72, .height = 36};
    const HeightAt flat = [](int, int) { return 10; };
    writeGeoTiff<std::int16_t>(folder / "a.tif", bare, flat);
    const std::filesystem::path beside = folder / "a.tif.aux.xml";
    std::ofstream(beside) << "<PAMDataset><PAMRasterBand band=\"1\"><Metadata><MDI "
                             "key=\"STATISTICS_MAXIMUM\">10</MDI></Metadata></PAMRasterBand></PAMDataset>";
    EXPECT_EQ(mustOpen(folder / "a.tif").maxM, 10);
    std::ofstream(beside) << "<PAMDataset><PAMRasterBand band=\"1\"><Offset>5</Offset><Scale>2</Scale>"
                             "</PAMRasterBand></PAMDataset>";
    EXPECT_EQ(mustOpen(folder / "a.tif").maxM, 25);
    std::ofstream(beside)
        << "<PAMDataset><GeoTransform>  7.0, 1.0e-02, 0, 47.0, 0, -1.0e-02</GeoTransform></PAMDataset>";
    writeGeoTiff<std::uint8_t>(folder / "a.tif", bare, flat);
    EXPECT_THAT(colourErrorOf(folder / "a.tif"), HasSubstr("has no coordinate reference system"));
}

TEST(GeoTiff, WorldEquidistantCylindricalNeedsNoKeysOfItsProjection) {
    const TemporaryFolder folder;
    for (const int code : {4087, 32662}) {
        const double stepM = 6378137 * 2 * 3.14159265358979323846 / 360;
        GeoTiff tiff = placedAt(360, 180, -180, 90, 1, pixelIsArea);
        tiff.pixelScale = {stepM, stepM, 0};
        tiff.tiepoint = {0, 0, 0, -180 * stepM, 90 * stepM, 0};
        tiff.keys = keysOf({projected, pixelIsArea, {3072, 0, 1, static_cast<std::uint16_t>(code)}});
        writeGeoTiff<float>(folder / "metres.tif", tiff, fieldFrom(-179.5, 89.5, 1));
        expectIsTheField(folder / "metres.tif");
    }
}

TEST(GeoTiff, ColoursArePlacedAsHeightsAre) {
    const TemporaryFolder folder;
    writeGeoTiff<float>(folder / "from0.tif", placedAt(360, 180, 0, 90, 1, pixelIsArea),
                        [](int column, int) { return column < 180 ? 1.0 : 0.0; });
    const auto source = openColourSource(folder / "from0.tif");
    ASSERT_TRUE(source) << source.error().message;
    const auto redAt = [&](double longitudeDeg) {
        const FacePoint point =
            facePointFromDirection(directionFromGeographic({0, longitudeDeg * radPerDegree}));
        std::vector<glm::vec3> out(1);
        const SampleTile tile{point.face,
                              256,
                              static_cast<int>(std::lround((point.u + 1) * 128)),
                              static_cast<int>(std::lround((point.v + 1) * 128)),
                              1,
                              1};
        EXPECT_TRUE(source->sample(tile, out));
        return out[0].r;
    };
    EXPECT_EQ(redAt(90), 1);
    EXPECT_EQ(redAt(-90), 0);
}

TEST(GeoTiff, BrokenTagsAreIgnoredOrRefusedAndNeverCrash) {
    const TemporaryFolder folder;
    const HeightAt flat = [](int, int) { return 5; };
    GeoTiff cut = placedAt(360, 180, -180, 90, 1, pixelIsArea);
    cut.tiepoint = {0, 0, 0};
    writeGeoTiff<std::int16_t>(folder / "cut.tif", cut, flat);
    EXPECT_EQ(errorOf(folder / "cut.tif"), "opened");
    GeoTiff still = placedAt(360, 180, -180, 90, 0, pixelIsArea);
    writeGeoTiff<std::int16_t>(folder / "still.tif", still, flat);
    EXPECT_NE(errorOf(folder / "still.tif"), "opened");
    GeoTiff keys = placedAt(360, 180, -180, 90, 1, pixelIsArea);
    keys.keys = {1024, 34736, 1, 999};
    writeGeoTiff<std::int16_t>(folder / "keys.tif", keys, flat);
    EXPECT_EQ(errorOf(folder / "keys.tif"), "opened");
}

}  // namespace
}  // namespace planet
