// The Earth as people know it, drawn from the elevation and colour in data/. Set WORLDY_PICTURES to a folder
// to have the pictures written there.
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

struct Elevation {
    int width = 0;
    int height = 0;
    std::vector<std::int16_t> metres;

    double at(int x, int y) const {
        const int row = std::clamp(y, 0, height - 1);
        const int column = ((x % width) + width) % width;
        return metres[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
    double operator()(const glm::dvec3& direction) const {
        const Geographic place = geographicFromDirection(direction);
        const double x = (glm::degrees(place.longitudeRad) + 180) / 360 * width - 0.5;
        const double y = (90 - glm::degrees(place.latitudeRad)) / 180 * height - 0.5;
        const int column = static_cast<int>(std::floor(x));
        const int row = static_cast<int>(std::floor(y));
        const double s = x - column;
        const double t = y - row;
        return (at(column, row) * (1 - s) + at(column + 1, row) * s) * (1 - t) +
               (at(column, row + 1) * (1 - s) + at(column + 1, row + 1) * s) * t;
    }
};

std::string dataFile(const char* name) {
    return (std::filesystem::path(WORLDY_SOURCE_DIR) / "data" / "earth" / name).string();
}

template <class T>
std::vector<T> readImage(const std::string& path, int channels, OIIO::TypeDesc type, int& width,
                         int& height) {
    const auto input = OIIO::ImageInput::open(path);
    if (!input) throw std::runtime_error(path + ": " + OIIO::geterror());
    width = input->spec().width;
    height = input->spec().height;
    std::vector<T> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                          static_cast<std::size_t>(channels));
    input->read_image(0, 0, 0, channels, type, pixels.data());
    return pixels;
}

void writePicture(const std::string& name, const Picture& picture) {
    const char* const folder = std::getenv("WORLDY_PICTURES");
    if (folder == nullptr) return;
    const std::string path = (std::filesystem::path(folder) / (name + ".png")).string();
    const auto output = OIIO::ImageOutput::create(path);
    output->open(path, OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8));
    output->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data());
}

constexpr int coarseLevel = 3;

class EarthPicture : public GlTest {
protected:
    EarthPicture() : planet_({}, 4096) {
        elevation_.metres = readImage<std::int16_t>(dataFile("elevation.tif"), 1, OIIO::TypeDesc::INT16,
                                                    elevation_.width, elevation_.height);
        int width = 0;
        int height = 0;
        const auto rgb =
            readImage<std::uint8_t>(dataFile("colour.jpg"), 3, OIIO::TypeDesc::UINT8, width, height);
        EXPECT_TRUE(planet_.renderer().setColourImage(rgb, width, height));
    }

    // The whole planet, finer near the eye: what a selection would do, without its errors and bounds.
    void refineAround(const View& view) {
        if (refinedAroundM_ == view.eyeM) return;
        refinedAroundM_ = view.eyeM;
        planet_.items().clear();
        for (const Face face : allFaces) refine({face, 0, 0, 0}, view.eyeM);
    }
    void refine(const ChunkId& id, const glm::dvec3& eyeM) {
        const FaceSquare square = faceSquareOf(id);
        const glm::dvec3 middle =
            sphereFromCube(cubePoint(id.face, square.u + square.side / 2, square.v + square.side / 2));
        const double away = glm::length(middle * planet_.shape().radiusM - eyeM) / planet_.shape().radiusM;
        const bool split = id.level < 6 && (id.level < coarseLevel || away < 2.0 * square.side);
        if (!split) return planet_.add(id, elevation_, static_cast<float>(20000 >> id.level));
        for (int quadrant = 0; quadrant < quadrantCount; ++quadrant) refine(childOf(id, quadrant), eyeM);
    }

    Picture draw(const std::string& name, const View& view, const RenderSettings& settings) {
        refineAround(view);
        Picture picture = drawPicture(planet_.renderer(), view, planet_.items(), settings, 4);
        writePicture(name, picture);
        return picture;
    }

    Elevation elevation_;
    TestPlanet planet_;
    std::optional<glm::dvec3> refinedAroundM_;
};

View wide(double latitudeDeg, double longitudeDeg, double altitudeM, double pitchDeg = -90,
          double headingDeg = 0) {
    return viewFrom({}, latitudeDeg, longitudeDeg, altitudeM, pitchDeg, headingDeg, 1280, 768);
}

// Where a place falls in a picture; the place must be in view.
glm::ivec2 pixelOf(const View& view, double latitudeDeg, double longitudeDeg) {
    const glm::dvec3 place =
        6.371e6 * directionFromGeographic({glm::radians(latitudeDeg), glm::radians(longitudeDeg)});
    const glm::dvec3 camera = cameraFromWorldRotation(view) * (place - view.eyeM);
    const double scale = screenScalePx(view) / -camera.z;
    return {view.widthPx / 2 + static_cast<int>(camera.x * scale),
            view.heightPx / 2 - static_cast<int>(camera.y * scale)};
}

struct Colours {
    glm::ivec3 sahara, congo, atlantic;
};

Colours coloursOf(const Picture& picture, const View& view) {
    const auto at = [&](double latitudeDeg, double longitudeDeg) {
        const glm::ivec2 pixel = pixelOf(view, latitudeDeg, longitudeDeg);
        return picture.at(pixel.x, pixel.y);
    };
    return {at(23, 12), at(1, 22), at(10, -30)};
}

void expectEarth(const Colours& colours) {
    EXPECT_GT(colours.sahara.x, colours.sahara.z + 20) << "sand is yellow";
    EXPECT_GT(colours.congo.y, colours.congo.x) << "forest is green";
    EXPECT_GT(colours.atlantic.z, colours.atlantic.x + 40) << "the sea is blue";
    EXPECT_GT(colours.sahara.x, colours.congo.x + 30) << "and sand is brighter";
}

TEST_F(EarthPicture, LandAndSeaHaveTheirColours) {
    RenderSettings settings;
    settings.sunDirection = directionFromGeographic({0.3, 0.1});
    const View view = wide(15, 0, 1.2e7);
    expectEarth(coloursOf(draw("earth_noon", view, settings), view));
    settings.surface = SurfaceColour::HeightRamp;
    expectEarth(coloursOf(draw("ramp_noon", view, settings), view));
}

// What people judge by eye; on request only, since it takes a while.
TEST_F(EarthPicture, AreDrawnForPeopleToLookAt) {
    if (std::getenv("WORLDY_PICTURES") == nullptr) GTEST_SKIP() << "WORLDY_PICTURES names no folder";
    struct Shot {
        const char* name;
        View view;
        glm::dvec3 sun;
        RenderSettings settings;
    };
    RenderSettings image;
    RenderSettings ramp;
    ramp.surface = SurfaceColour::HeightRamp;
    RenderSettings wire;
    wire.wireframe = true;
    RenderSettings levels;
    levels.outlines = true;
    RenderSettings levelsWire = levels;
    levelsWire.wireframe = true;
    RenderSettings cube;
    cube.cube = true;
    RenderSettings airless;
    airless.atmosphere = false;
    const glm::dvec3 morning = directionFromGeographic({0.2, 1.7});
    const glm::dvec3 noon = directionFromGeographic({0.2, 0.9});
    const glm::dvec3 afternoon = directionFromGeographic({0.3, 0.6});
    const std::array<Shot, 15> shots = {{
        {"earth", wide(20, 10, 1.2e7), image.sunDirection, image},
        {"airless", wide(20, 10, 1.2e7), image.sunDirection, airless},
        {"south", wide(-75, 10, 1.2e7), {0.5, 0.4, -0.6}, image},
        {"north", wide(89, 10, 9e6), {0.5, 0.4, 0.6}, image},
        {"terminator", wide(15, 20, 1.6e7), morning, image},
        {"sunset_limb", wide(10, -5, 6e5, -16, 75), morning, image},
        {"sunset_low", wide(20, 10, 1.2e4, 2, 80), morning, image},
        {"alps_50km", wide(42, 12, 5e4, -25, 330), noon, image},
        {"himalaya_50km", wide(26.5, 88.5, 5e4, -25, 320), afternoon, image},
        {"ramp_50km", wide(26.5, 88.5, 5e4, -25, 320), afternoon, ramp},
        {"ramp", wide(25, 80, 1e7), afternoon, ramp},
        {"wireframe", wide(42, 12, 8e5, -50, 0), noon, wire},
        {"levels", wide(36, -2, 3e5, -30, 60), noon, levels},
        {"levels_wire", wide(36, -2, 3e5, -30, 60), noon, levelsWire},
        {"cube", wide(30, 40, 1.2e7), image.sunDirection, cube},
    }};
    for (const Shot& shot : shots) {
        RenderSettings settings = shot.settings;
        settings.sunDirection = shot.sun;
        const Picture picture = draw(shot.name, shot.view, settings);
        EXPECT_GT(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 100) << shot.name;
    }
}

}  // namespace
}  // namespace planet::gl
