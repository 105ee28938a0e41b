// The thread that works for OpenGL beside the drawing one, and drawing that does not wait for it.
#include "planet/gl/device/gl_worker.h"

#include <future>

#include "planet/gl/draw/chunk_programs.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

SharedContext sharedContextOf(const OffscreenContext& context) {
    return {[&context] { return context.makeCurrent(); }, [&context] { context.release(); }};
}

// Keeps a worker from its next job until it is opened.
class Gate {
public:
    explicit Gate(GlWorker& worker) {
        worker.add([opened = opened_.get_future().share()] { opened.wait(); }, Urgency::Now);
    }
    void open() { opened_.set_value(); }

private:
    std::promise<void> opened_;
};

// Until all jobs that were added by now have been run.
void waitFor(GlWorker& worker) {
    std::promise<void> done;
    worker.add([&done] { done.set_value(); }, Urgency::Later);
    done.get_future().wait();
}

class GlWorkerTest : public GlTest {
protected:
    OffscreenContext besides_ = valueOf(context().sharing());
    std::shared_ptr<GlWorker> worker_ = std::make_shared<GlWorker>(sharedContextOf(besides_));
};

TEST_F(GlWorkerTest, jobsThatAreNeededNowRunFirst) {
    std::vector<int> ran;
    Gate gate(*worker_);
    worker_->add([&ran] { ran.push_back(1); }, Urgency::Later);
    worker_->add([&ran] { ran.push_back(2); }, Urgency::Now);
    worker_->add([&ran] { ran.push_back(3); }, Urgency::Now);
    gate.open();
    waitFor(*worker_);
    EXPECT_EQ(ran, (std::vector<int>{2, 3, 1}));
}

TEST_F(GlWorkerTest, whatItMakesIsThereInTheDrawingContext) {
    Buffer made;
    worker_->add(
        [&made] {
            made = makeBuffer();
            glBindBuffer(GL_ARRAY_BUFFER, made.name());
            const int value = 4711;
            glBufferData(GL_ARRAY_BUFFER, sizeof(value), &value, GL_STATIC_DRAW);
            glFinish();
        },
        Urgency::Now);
    waitFor(*worker_);
    glBindBuffer(GL_ARRAY_BUFFER, made.name());
    int value = 0;
    glGetBufferSubData(GL_ARRAY_BUFFER, 0, sizeof(value), &value);
    EXPECT_EQ(value, 4711);
}

TEST_F(GlWorkerTest, itEndsWithJobsStillWaitingAndLetsThemGo) {
    std::promise<void> begun, go;
    worker_->add(
        [&] {
            begun.set_value();
            go.get_future().wait();
        },
        Urgency::Now);
    const auto held = std::make_shared<int>(0);
    for (int i = 0; i < 1000; ++i) worker_->add([held] {}, Urgency::Later);
    begun.get_future().wait();
    std::thread ends([this] { worker_.reset(); });
    go.set_value();
    ends.join();
    EXPECT_EQ(held.use_count(), 1);
}

TEST_F(GlWorkerTest, aContextThatCannotBeMadeCurrentIsTold) {
    GlWorker worker({[] { return false; }, [] {}});
    while (worker.works()) std::this_thread::yield();
    const auto programs =
        valueOf(ChunkPrograms::build({}, std::shared_ptr<GlWorker>(&worker, [](GlWorker*) {})));
    EXPECT_FALSE(programs.canOrder());
}

class StandInTest : public GlWorkerTest {
protected:
    StandInTest() {
        for (const Face face : allFaces) {
            DrawItem item;
            item.id = {face, 0, 0, 0};
            item.slot = static_cast<std::uint32_t>(face);
            renderer_.upload(item.slot, chunkSteps({}, item.id, hills));
            items_.push_back(item);
        }
    }

    static double hills(const glm::dvec3& d) {
        return 9000 * std::sin(9 * d.x + 3 * d.z) * std::cos(8 * d.y);
    }

    Picture drawn(const RenderSettings& settings, ShaderWait wait, std::span<const ChunkTint> tints = {}) {
        const RenderTarget target = valueOf(RenderTarget::create(view_.widthPx, view_.heightPx));
        target.bind();
        renderer_.draw(view_, items_, settings, tints, {}, wait);
        return {view_.widthPx, view_.heightPx, target.readRgb(), target.readDepth(),
                renderer_.projection().reversedZ ? 0.0f : 1.0f};
    }
    bool standIn() const { return renderer_.counters().standIn; }

    std::shared_ptr<ChunkPrograms> programs_ =
        std::make_shared<ChunkPrograms>(valueOf(ChunkPrograms::build({}, worker_)));
    ChunkRenderer renderer_ = valueOf(ChunkRenderer::create({{}, 6, {}, programs_}));
    std::vector<DrawItem> items_;
    View view_ = viewFrom({}, 20, 30, 1e7);
};

TEST_F(StandInTest, theAnalyticAtmosphereIsDrawnUntilTheFirstTablesAreThere) {
    RenderSettings settings = plainSettings();
    settings.atmosphere = settings.lighting = true;
    settings.light.air.use = FeatureUse::Off;
    const Picture analytic = drawn(settings, ShaderWait::UntilReady);
    settings.light.air.use = FeatureUse::On;
    settings.light.air.settings.haze = 6.75;  // that no other test has tables of
    renderer_.setAirInBackground(true);
    EXPECT_EQ(drawn(settings, ShaderWait::Never).rgb, analytic.rgb);
    EXPECT_TRUE(standIn());
    EXPECT_TRUE(renderer_.airFigures().working);
    EXPECT_NE(drawn(settings, ShaderWait::UntilReady).rgb, analytic.rgb);
    EXPECT_FALSE(standIn());
}

TEST_F(StandInTest, theLastProgramDrawsUntilTheWantedOneIsCompiled) {
    const Picture plain = drawn(plainSettings(), ShaderWait::UntilReady);
    EXPECT_FALSE(standIn());
    RenderSettings lines = plainSettings();
    lines.wireframe = true;
    Gate gate(*worker_);
    EXPECT_EQ(drawn(lines, ShaderWait::Never).rgb, plain.rgb);
    EXPECT_TRUE(standIn());
    gate.open();
    waitFor(*worker_);
    const Picture compiled = drawn(lines, ShaderWait::Never);
    EXPECT_FALSE(standIn());
    EXPECT_NE(compiled.rgb, plain.rgb);

    // The same as by a renderer that waits.
    ChunkRenderer waiting = valueOf(ChunkRenderer::create({{}, 6, {}}));
    for (const DrawItem& item : items_) waiting.upload(item.slot, chunkSteps({}, item.id, hills));
    EXPECT_EQ(drawPicture(waiting, view_, items_, lines).rgb, compiled.rgb);
}

TEST_F(StandInTest, aDrawThatWaitsIsExactWhileTheWorkerIsBusy) {
    drawn(plainSettings(), ShaderWait::UntilReady);
    Gate gate(*worker_);
    const std::vector<ChunkTint> tints = oneTint(items_.size(), {200, 10, 20, 255});
    drawn(plainSettings(), ShaderWait::Never, tints);
    EXPECT_TRUE(standIn());
    const Picture tinted = drawn(plainSettings(), ShaderWait::UntilReady, tints);
    EXPECT_FALSE(standIn());
    EXPECT_TRUE(areNear(tinted.at(160, 120), {200, 10, 20}, 0));
    gate.open();
}

TEST_F(StandInTest, nothingIsDrawnBeforeTheFirstProgramIsReady) {
    Gate gate(*worker_);
    const Picture empty = drawn(RenderSettings{}, ShaderWait::Never);
    EXPECT_TRUE(standIn());
    EXPECT_FALSE(empty.isGround(160, 120));
    EXPECT_EQ(renderer_.counters().triangles(), 0u);
    gate.open();
    waitFor(*worker_);
    EXPECT_TRUE(drawn(RenderSettings{}, ShaderWait::Never).isGround(160, 120));
    EXPECT_FALSE(standIn());
}

TEST_F(StandInTest, shadowsComeOnceBothTheirProgramsAreReady) {
    RenderSettings settings = plainSettings();
    settings.lighting = true;
    settings.light.shadows.use = FeatureUse::On;
    settings.light.shadows.reachM = 3e7;
    const Picture exact = drawn(settings, ShaderWait::UntilReady);
    ASSERT_TRUE(programs_->reload());
    settings.light.shadows.use = FeatureUse::Off;
    drawn(settings, ShaderWait::UntilReady);
    settings.light.shadows.use = FeatureUse::On;
    Gate gate(*worker_);
    drawn(settings, ShaderWait::Never);
    EXPECT_TRUE(standIn());
    gate.open();
    waitFor(*worker_);
    EXPECT_EQ(drawn(settings, ShaderWait::Never).rgb, exact.rgb);
    EXPECT_FALSE(standIn());
}

TEST_F(StandInTest, whatMorphsNextIsCompiledBeforeItIsNeeded) {
    drawn(plainSettings(), ShaderWait::UntilReady);
    drawn(plainSettings(), ShaderWait::Never);
    waitFor(*worker_);
    for (DrawItem& item : items_) item.morph = 0.5f;
    Gate gate(*worker_);
    drawn(plainSettings(), ShaderWait::Never);
    EXPECT_FALSE(standIn());
    gate.open();
}

TEST_F(StandInTest, renderersThatShareProgramsCompileThemOnce) {
    drawn(plainSettings(), ShaderWait::UntilReady);
    ChunkRenderer other = valueOf(ChunkRenderer::create({{}, 6, {}, programs_}));
    for (const DrawItem& item : items_) other.upload(item.slot, chunkSteps({}, item.id, hills));
    Gate gate(*worker_);
    const RenderTarget target = valueOf(RenderTarget::create(view_.widthPx, view_.heightPx));
    target.bind();
    other.draw(view_, items_, plainSettings(), {}, {}, ShaderWait::Never);
    EXPECT_FALSE(other.counters().standIn);
    gate.open();
}

TEST_F(StandInTest, programsThatNobodyWaitsForAreLetGo) {
    drawn(plainSettings(), ShaderWait::UntilReady);
    Gate gate(*worker_);
    RenderSettings lines = plainSettings();
    lines.wireframe = true;
    drawn(lines, ShaderWait::Never);
    ASSERT_TRUE(programs_->reload());
    gate.open();
    waitFor(*worker_);
    // The worker has deleted the program of the replaced shaders, so the renderer orders it again.
    drawn(lines, ShaderWait::Never);
    EXPECT_TRUE(standIn());
    waitFor(*worker_);
    drawn(lines, ShaderWait::Never);
    EXPECT_FALSE(standIn());
}

}  // namespace
}  // namespace planet::gl
