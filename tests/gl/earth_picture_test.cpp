// The Earth as people know it, drawn from the elevation and colour in data/. Set WORLDY_PICTURES to a folder
// to have the pictures written there.
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <filesystem>

#include "gl_test.h"
#include "test_planet.h"

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
        planet_.renderer().setColourImage(rgb, width, height);
    }

    // The whole planet, finer near the eye: what a selection would do, without its errors and bounds.
    void refineAround(const View& view) {
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
};

View wide(double latitudeDeg, double longitudeDeg, double altitudeM, double pitchDeg = -90,
          double headingDeg = 0) {
    return viewFrom({}, latitudeDeg, longitudeDeg, altitudeM, pitchDeg, headingDeg, 1280, 768);
}

TEST_F(EarthPicture, LooksLikeEarth) {
    RenderSettings settings;
    draw("earth", wide(20, 10, 1.2e7), settings);
    settings.sunDirection = directionFromGeographic({0.2, 1.7});
    draw("sunset_limb", wide(10, -5, 6.0e5, -16, 75), settings);
    draw("terminator", wide(15, 20, 1.6e7), settings);
    draw("sunset_ground", wide(20, 10, 1.2e4, 2, 80), settings);
    settings.sunDirection = directionFromGeographic({0.2, 0.9});
    draw("alps_50km", wide(44, 12, 5e4, -28, 310), settings);
    settings.sunDirection = directionFromGeographic({0.3, 0.6});
    draw("himalaya_50km", wide(27.5, 88, 5e4, -28, 300), settings);
    settings.surface = SurfaceColour::HeightRamp;
    draw("ramp", wide(25, 80, 1.0e7), settings);
    draw("ramp_50km", wide(27.5, 88, 5e4, -28, 300), settings);
}

TEST_F(EarthPicture, Instruments) {
    RenderSettings settings;
    settings.wireframe = true;
    draw("wireframe", wide(40, 20, 4e6), settings);
    settings.colourBy = ColourBy::Level;
    settings.wireframe = false;
    draw("levels", wide(36, -2, 3e5, -30, 60), settings);
    settings.wireframe = true;
    draw("levels_wire", wide(36, -2, 3e5, -30, 60), settings);
    settings.wireframe = false;
    settings.colourBy = ColourBy::None;
    settings.cube = true;
    draw("cube", wide(30, 40, 1.2e7), settings);
}

}  // namespace
}  // namespace planet::gl
