// A context whose memory runs out: each allocation of a texture in turn is refused.
#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/base/picture_file.h"
#include "app/scene/scene.h"
#include "planet/gl/device/render_target.h"
#include "tests/app/session_fixture.h"
#include "tests/support/sanitized.h"
#include "tests/support/synthetic_colours.h"

namespace worldy {
namespace {

// What libepoxy calls; the pointer is another once it has been called for the first time.
struct TextureCalls {
    PFNGLTEXIMAGE2DPROC image2D = epoxy_glTexImage2D;
    PFNGLTEXIMAGE3DPROC image3D = epoxy_glTexImage3D;
    PFNGLCOMPRESSEDTEXIMAGE3DPROC compressedImage3D = epoxy_glCompressedTexImage3D;
    PFNGLGETERRORPROC getError = epoxy_glGetError;
};

TextureCalls realCalls;
int texturesAsked = 0;
int refusedAllocation = 0;  // which, counted from 1; 0: none
bool outOfMemory = false;

bool isRefused() {
    const bool now = ++texturesAsked == refusedAllocation;
    outOfMemory = outOfMemory || now;
    return now;
}

// Counts allocations of textures while it lives, and answers one of them as a full GPU does.
class FullGpu {
public:
    explicit FullGpu(int refused) {
        realCalls = {};
        texturesAsked = 0;
        refusedAllocation = refused;
        outOfMemory = false;
        epoxy_glTexImage2D = [](auto... arguments) {
            if (!isRefused()) realCalls.image2D(arguments...);
        };
        epoxy_glTexImage3D = [](auto... arguments) {
            if (!isRefused()) realCalls.image3D(arguments...);
        };
        epoxy_glCompressedTexImage3D = [](auto... arguments) {
            if (!isRefused()) realCalls.compressedImage3D(arguments...);
        };
        epoxy_glGetError = [] {
            return std::exchange(outOfMemory, false) ? GLenum{GL_OUT_OF_MEMORY} : realCalls.getError();
        };
    }
    FullGpu(const FullGpu&) = delete;
    FullGpu& operator=(const FullGpu&) = delete;
    ~FullGpu() {
        epoxy_glTexImage2D = realCalls.image2D;
        epoxy_glTexImage3D = realCalls.image3D;
        epoxy_glCompressedTexImage3D = realCalls.compressedImage3D;
        epoxy_glGetError = realCalls.getError;
    }
};

struct Drawn {
    std::string refusal{};  // why the scene could not be opened
    std::vector<std::string> problems{};
    std::string clipmapProblem{};
    std::vector<std::uint8_t> rgb{};

    bool isBlack() const {
        return std::all_of(rgb.begin(), rgb.end(), [](int value) { return value < 8; });
    }
};

// Everything that takes memory of the GPU, over ground near enough for all of it.
class FullGpuScene : public test::SessionTest {
protected:
    FullGpuScene() {
        const planet::ColourSource colours = planet::test::mottledColours();
        const auto heights = planet::openHeightSource(writeSource(), {});
        const planet::BakeSettings bake{.faceSize = 129, .chunkSize = 17, .colour = {}};
        if (!heights || !planet::bake(*heights, bake, file_, {}, &colours))
            throw std::runtime_error("no bake");
        planet::test::writeColours<std::uint8_t>(folder_ / "grey.png", 8, 8, 3,
                                                 [](int, int, int) { return 128; });
        using planet::gl::FeatureUse;
        settings_.surface.colourMode = ColourMode::Clipmap;
        settings_.surface.clipmapSizePx = 256;
        settings_.surface.light.air.use = FeatureUse::On;
        settings_.surface.light.normals.use = FeatureUse::On;
        settings_.surface.light.shadows.use = FeatureUse::On;
        settings_.surface.layers.use = FeatureUse::On;
        settings_.surface.layers.file = folder_ / "set.toml";
        planet::TextureLayer grey;
        grey.albedo = "grey.png";
        settings_.surface.layers.set.layers = {grey};
    }

    Drawn draw() {
        const std::filesystem::path image = folder_ / "colour.png";
        if (!writePicture({16, 8, std::vector<std::uint8_t>(std::size_t{16} * 8 * 3, 200)}, image))
            return {.refusal = "no picture"};
        auto target = planet::gl::RenderTarget::create(view_.widthPx, view_.heightPx);
        if (!target) return {.refusal = target.error().message};
        auto scene = openScene({.chunkFile = file_, .colourImage = image}, settings_);
        if (!scene) return {.refusal = scene.error().message};
        Drawn drawn;
        settleScene(*scene, view_, settings_, 60);
        target->bind();
        drawScene(*scene, view_, settings_);
        target->resolve();
        drawn.rgb = target->readRgb();
        drawn.problems = takeProblems(*scene);
        drawn.clipmapProblem = statsOf(*scene).clipmap.problem;
        // Told once, and not tried again in each picture.
        const int before = texturesAsked;
        drawScene(*scene, view_, settings_);
        EXPECT_EQ(texturesAsked, before);
        EXPECT_THAT(takeProblems(*scene), testing::IsEmpty());
        // Nor is anything read that cannot be drawn.
        settleScene(*scene, view_, settings_, 60);
        EXPECT_EQ(scene->planet->views()[0].colours.splits.empty(),
                  !scene->renderer.drawsTiles(planet::BlockKind::Colours));
        EXPECT_EQ(scene->planet->views()[0].normals.splits.empty(),
                  !scene->renderer.drawsTiles(planet::BlockKind::Normals));
        return drawn;
    }

    const std::filesystem::path file_ = folder_ / "coloured.chk";
    const planet::View view_ = planet::viewFromPose({.longitudeDeg = 10, .altitudeM = 3000, .pitchDeg = -30},
                                                    6'371'000, 1.0, 160, 120);
};

TEST_F(FullGpuScene, drawsWhatFitsAndSaysWhatDoesNot) {
    const Drawn whole = draw();
    ASSERT_THAT(whole.refusal, testing::IsEmpty());
    ASSERT_THAT(whole.problems, testing::IsEmpty());
    ASSERT_FALSE(whole.isBlack());
    int calls = 0;
    {
        const FullGpu counted(0);
        EXPECT_EQ(draw().rgb, whole.rgb);
        calls = texturesAsked;
    }
    EXPECT_GT(calls, 15);
    int refusals = 0, told = 0;
    for (int n = 1; n <= calls; n += tests::sanitized ? 3 : 1) {
        SCOPED_TRACE(n);
        const FullGpu full(n);
        const Drawn drawn = draw();
        if (!drawn.refusal.empty()) {
            ++refusals;
            EXPECT_THAT(drawn.refusal, testing::AnyOf(testing::HasSubstr("GPU out of memory: "),
                                                      testing::HasSubstr("OpenGL limit: ")));
            continue;
        }
        EXPECT_FALSE(drawn.isBlack());
        std::vector<std::string> problems = drawn.problems;
        if (!drawn.clipmapProblem.empty()) problems.push_back(drawn.clipmapProblem);
        EXPECT_THAT(problems, testing::ElementsAre(testing::HasSubstr("GPU out of memory: ")));
        told += static_cast<int>(problems.size());
    }
    EXPECT_GT(refusals, 0);
    EXPECT_GT(told, tests::sanitized ? 3 : 10);
    RecordProperty("allocations refused", calls);
    RecordProperty("scenes refused", refusals);
}

}  // namespace
}  // namespace worldy
