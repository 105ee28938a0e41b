#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

using Context = GlTest;

TEST_F(Context, IsTheHighestCoreProfile) {
    EXPECT_GE(context().version(), (ContextVersion{3, 3}));
    EXPECT_FALSE(context().renderer().empty());
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
}

TEST_F(Context, SeveralLiveSideBySide) {
    const Result<OffscreenContext> other = OffscreenContext::create();
    ASSERT_TRUE(other);
    context().makeCurrent();
    const RenderTarget target = valueOf(RenderTarget::create(16, 16));
    EXPECT_EQ(target.readRgb().size(), 16u * 16 * 3);
}

TEST(OffscreenContext, BelowWhatWorldyNeedsIsAnError) {
    const Result<OffscreenContext> context = OffscreenContext::create({{3, 2}, false});
    ASSERT_FALSE(context);
    EXPECT_THAT(context.error().message, testing::HasSubstr("3.3"));
}

// The two tests below run in processes of their own, since Mesa reads its environment once. Other drivers do not read it,
// so there the processes end with this code, and the tests are skipped.
constexpr int notMesa = 77;

void endUnlessMesa() {
    const std::string_view version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    if (version.find("Mesa") != std::string_view::npos) return;
    std::fprintf(stderr, "the driver is not Mesa's\n");
    std::_Exit(notMesa);
}

// Expects the statement to end with 0 or notMesa. Takes the code out.
struct EndedWell {
    int& code;
    bool operator()(int status) const {
        code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return code == 0 || code == notMesa;
    }
};

void drawWithOpenGl33AndNothingMore() {
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    setenv("MESA_EXTENSION_OVERRIDE", "-GL_ARB_clip_control", 1);
    const OffscreenContext context = valueOf(OffscreenContext::create({{3, 3}, false}));
    endUnlessMesa();
    TestPlanet planet({}, 24);
    planet.addLevel(1, flat);
    const View view = viewFrom({}, 30, 40, 1.2e7, -90, 0, 200, 200);
    const Picture picture = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
    int drawn = 0;
    for (const float depth : picture.depth) drawn += depth < 1;
    const double rimPx = screenScalePx(view) * std::tan(std::asin(6.371 / 18.371));
    const bool good = context.version() == ContextVersion{3, 3} &&
                      !planet.renderer().capabilities().reversedZ &&
                      !planet.renderer().projection().reversedZ &&
                      std::abs(std::sqrt(drawn / 3.14159265) - rimPx) < 1.5 && glGetError() == GL_NO_ERROR;
    std::fprintf(stderr, "OpenGL %d.%d drew %d pixels\n", context.version().major, context.version().minor,
                 drawn);
    std::_Exit(good ? 0 : 1);
}

TEST(OffscreenContext, OpenGl33IsEnough) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    int code = 0;
    EXPECT_EXIT(drawWithOpenGl33AndNothingMore(), EndedWell{code}, "OpenGL 3.3|not Mesa");
    if (code == notMesa) GTEST_SKIP() << "only Mesa's drivers can pretend to be old";
}

void askForAContextOnAnOldDriver() {
    setenv("MESA_GL_VERSION_OVERRIDE", "3.2", 1);
    const Result<OffscreenContext> context = OffscreenContext::create();
    if (context) endUnlessMesa();
    std::fprintf(stderr, "%s\n", context ? "got one" : context.error().message.c_str());
    std::_Exit(context ? 1 : 0);
}

TEST(OffscreenContext, AnOldDriverIsAnErrorThatSaysWhatIsMissing) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    int code = 0;
    EXPECT_EXIT(askForAContextOnAnOldDriver(), EndedWell{code}, "3.3|not Mesa");
    if (code == notMesa) GTEST_SKIP() << "only Mesa's drivers can pretend to be old";
}

TEST_F(Context, RenderTargetsLargerThanTheContextDrawsAreAnError) {
    const Result<RenderTarget> target = RenderTarget::create(1 << 20, 16);
    ASSERT_FALSE(target);
    EXPECT_THAT(target.error().message, testing::HasSubstr("1048576"));
    EXPECT_FALSE(RenderTarget::create(16, 16, 1000));
}

TEST_F(Context, PicturesAreReadFromTheTop) {
    const RenderTarget target = valueOf(RenderTarget::create(7, 5));
    target.bind();
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 4, 1, 1);  // the top left pixel, counted from below
    glClearColor(1, 0.5, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    const std::vector<std::uint8_t> rgb = target.readRgb();
    EXPECT_EQ(rgb[0], 255);
    EXPECT_EQ(rgb[2], 0);
    EXPECT_EQ(std::count(rgb.begin(), rgb.end(), 0), 7 * 5 * 3 - 2);
    EXPECT_EQ(target.gpuBytes(), 7u * 5 * 8);
}

}  // namespace
}  // namespace planet::gl
