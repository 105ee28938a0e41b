// What the window does with threads, all at once and at random: bakes started, cancelled and swapped in while
// the planet is flown over and drawn, files replaced while they are open, and every job in the background
// begun and dropped. Meant for the thread sanitizer; the rest runs them too.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <iostream>
#include <random>
#include <set>

#include "app/editor/bake_controller.h"
#include "app/measure/comparison_job.h"
#include "app/measure/error_job.h"
#include "app/measure/sweep_job.h"
#include "planet/gl/device/render_target.h"
#include "planet/planet_tools.h"
#include "tests/app/session_fixture.h"
#include "tests/support/random_view.h"

namespace worldy {
namespace {

int hammerSteps(int usual) {
    const char* asked = std::getenv("WORLDY_HAMMER_STEPS");
    return asked ? std::atoi(asked) : usual;
}

class SessionThreads : public test::SessionTest {
protected:
    static constexpr int widthPx = 64, heightPx = 48;

    SessionThreads() {
        settings_.paging.loaderThreads = 3;
        settings_.paging.budgetMB = 16;
        target_ = planet::gl::RenderTarget::create(widthPx, heightPx).value();
        chunkFiles_ = {bakeTo("a.chk", {.faceSize = 65, .chunkSize = 17}),
                       bakeTo("b.chk", {.faceSize = 129, .chunkSize = 17})};
        sources_ = {writeSource("one.pgm", 1), writeSource("two.pgm", 3)};
    }

    std::size_t pick(std::size_t count) { return random_() % count; }
    bool chance(std::size_t oneIn) { return pick(oneIn) == 0; }

    // One frame of the window, and perhaps one thing that a user does.
    void frame(Session& session) {
        act(session, pick(40));
        advanceSession(session, settings_, log_);
        advanceEstimate(bakes_.estimator);
        advancePreview(bakes_.preview);
        if (Scene* scene = shownScene(session)) fly(*scene);
        takeResults();
        ++frames_;
    }

    void act(Session& session, std::size_t what) {
        switch (what) {
            case 0:
                return startBake(
                    session, requestFor(sources_[pick(2)], chance(2) ? 33 : 17, chance(2) ? 65 : 129), log_);
            case 1:
                return startBake(session, log_);
            case 2:
                return cancelBake(session);
            case 3:
                return showPreviousBake(session, chance(2));
            case 4:
                return dismissPreviousBake(session);
            case 5:
                return static_cast<void>(openFile(session, chunkFiles_[pick(2)], settings_, log_));
            case 6:
                return static_cast<void>(openFile(session, sources_[pick(2)], settings_, log_));
            case 7:
                return openBake(session, requestFor(sources_[0], 17), chunkFiles_[pick(2)], settings_, log_);
            case 8:
                return requestEstimate(bakes_.estimator, requestFor(sources_[pick(2)], 17, 129));
            case 9:
                return preview();
            case 10:
                return compareBeside(session);
            case 11:
                return swapBeside(session);
            case 12:
                return beside_.reset();
            case 13:
                errors_.wanted = true;
                return;
            case 14:
                errors_.keepMeasuring = chance(2);
                return;
            case 15:
                return startComparison();
            case 16:
                return comparison_ ? comparison_->cancel() : void();
            case 17:
                return comparison_.reset();
            case 18:
                return startSweep();
            case 19:
                return sweep_ ? sweep_->cancel() : void();
            case 20:
                return sweep_.reset();
            case 21:
                return changeSettings();
            default:
                return;
        }
    }

    void changeSettings() {
        settings_.paging.loaderThreads = 1 + static_cast<int>(pick(4));
        settings_.paging.budgetMB = 8 + static_cast<int>(pick(3)) * 8;
        settings_.paging.simulated = chance(4);
        settings_.paging.badDisk = {.latencyMs = chance(2) ? 0.0 : 1.0, .failureRate = chance(3) ? 0.1 : 0.0};
        settings_.surface.exaggeration = chance(2) ? 1 : 3;
        settings_.surface.light.normals.use =
            chance(2) ? planet::gl::FeatureUse::On : planet::gl::FeatureUse::Off;
        settings_.surface.light.shadows.use =
            chance(4) ? planet::gl::FeatureUse::On : planet::gl::FeatureUse::Off;
    }

    void fly(Scene& scene) {
        static_cast<void>(applyLiveSettings(scene, settings_, chance(8)));
        planet::View view = planet::randomView(random_, scene.planet->tree().shape.radiusM);
        view.widthPx = widthPx;
        view.heightPx = heightPx;
        if (chance(3))
            stepScene(scene, view, planet::randomView(random_, scene.planet->tree().shape.radiusM),
                      settings_);
        else
            stepScene(scene, view, settings_);
        if (chance(20)) scene.planet->tools().dropAll();
        if (chance(20)) scene.planet->tools().retryFailed();
        if (lastScene_ != scene.identity) forgetErrors(errors_);
        lastScene_ = scene.identity;
        advanceErrorMeter(*scene.planet, frames_, errors_);
        expectSound(*scene.planet);
        if (!chance(4)) return;
        target_->bind();
        drawScene(scene, view, settings_);
        ++drawn_;
    }

    static void expectSound(const planet::Planet& planet) {
        const planet::PagingCounters& paging = planet.paging();
        ASSERT_LE(paging.residentBytesCpu + paging.residentBytesGpu, planet.pagingSettings().budgetBytes);
        std::set<std::uint32_t> slots;
        planet::forEachNode(planet.tree(), [&](planet::NodeIndex, const planet::ChunkNode& node) {
            ASSERT_LT(node.slot, planet.paging()[planet::BlockKind::Heights].capacity);
            ASSERT_TRUE(slots.insert(node.slot).second);
        });
        for (const planet::DrawItem& item : planet.selection().draw) {
            ASSERT_EQ(planet::findNode(planet.tree(), item.id), item.node);
            ASSERT_TRUE(slots.contains(item.slot));
        }
    }

    void preview() {
        PreviewRequest request;
        request.source = sources_[pick(2)];
        requestPreview(bakes_.preview, request);
    }
    void compareBeside(const Session& session) {
        auto opened = openBeside(session, chunkFiles_[pick(2)], settings_);
        if (opened) beside_.emplace(std::move(*opened));
    }
    void swapBeside(Session& session) {
        if (beside_ && shownPlanet(session)) exchangeShown(session, *beside_);
    }

    void startComparison() {
        ComparisonPlan plan;
        plan.sides[0].chunkFile = chunkFiles_[0];
        plan.sides[1].chunkFile = chunkFiles_[1];
        plan.path.name = "Down";
        plan.path.keys = {{0, {10, 20, 2e6, 0, -80}}, {1, {12, 21, 2e5, 0, -50}}};
        plan.moments = 2;
        plan.popStepS = 0.25;
        plan.size = {80, 60};
        comparison_ = std::make_unique<ComparisonJob>(plan);
    }
    void startSweep() {
        SweepPlan plan;
        plan.files = {{17, chunkFiles_[0], false, {}}};
        plan.flight = flight_;
        plan.tausPx = {2, 8};
        plan.metrics = {planet::ErrorMetric::Additive};
        plan.frames = 2;
        plan.size = {80, 60};
        sweep_ = std::make_unique<SweepJob>(plan);
    }
    void takeResults() {
        if (comparison_) compared_ += comparison_->takeResult().has_value();
        if (!sweep_) return;
        static_cast<void>(sweep_->progress());
        swept_ += sweep_->takePoints().size();
        static_cast<void>(sweep_->takeSuggestions());
        static_cast<void>(sweep_->takeResult());
    }

    // A file that is open is replaced again and again by a bake of the same, or not, where that is cancelled.
    void replaceFile(const std::atomic<bool>& stopping) {
        const auto source = planet::openHeightSource(sources_[0], {});
        std::mt19937 random(6);
        while (!stopping) {
            const int cancelAfter = random() % 2 == 0 ? 1 : 1'000'000;
            std::atomic<int> told = 0;
            const auto result = planet::bake(*source, {.faceSize = 65, .chunkSize = 17}, chunkFiles_[0],
                                             [&](const auto&) { return ++told < cancelAfter && !stopping; });
            ++(result ? replaced_ : notReplaced_);
        }
    }

    std::mt19937 random_{11};
    std::optional<planet::gl::RenderTarget> target_;
    std::array<std::filesystem::path, 2> chunkFiles_, sources_;
    const std::filesystem::path flight_ = [this] {
        std::ofstream(folder_ / "down.toml") << "name = \"Down\"\n"
                                                "[[key]]\ntime_s = 0\nlatitude_deg = 10\nlongitude_deg = 20\n"
                                                "altitude_m = 5e6\nheading_deg = 0\npitch_deg = -90\n"
                                                "[[key]]\ntime_s = 2\nlatitude_deg = 12\nlongitude_deg = 22\n"
                                                "altitude_m = 1e5\nheading_deg = 30\npitch_deg = -40\n";
        return folder_ / "down.toml";
    }();
    BakeController bakes_;
    std::optional<OpenPlanet> beside_;
    ErrorMeter errors_;
    std::unique_ptr<ComparisonJob> comparison_;
    std::unique_ptr<SweepJob> sweep_;
    std::shared_ptr<const int> lastScene_;
    std::uint64_t frames_ = 0, drawn_ = 0, compared_ = 0, swept_ = 0;
    std::atomic<int> replaced_ = 0, notReplaced_ = 0;
};

TEST_F(SessionThreads, BakesSwapsJobsAndViewsAtRandomLeaveTheSessionSound) {
    const int steps = hammerSteps(300);
    std::uint64_t swaps = 0;
    {
        Session session = sessionOf(chunkFiles_[1]);
        std::atomic<bool> stopping = false;
        std::jthread replacing([&] { replaceFile(stopping); });
        std::shared_ptr<const int> last;
        for (int i = 0; i < steps; ++i) {
            frame(session);
            const OpenPlanet* open = shownPlanet(session);
            swaps += open && open->scene.identity != std::exchange(last, open->scene.identity);
            if (!HasFatalFailure()) continue;
            stopping = true;
            FAIL() << "step " << i;
        }
        stopping = true;
        replacing.join();
        cancelBake(session);
        EXPECT_TRUE(advanceUntilQuiet(session));
        // What was cancelled is over: a bake comes to its end as ever.
        startBake(session, requestFor(sources_[0], 33), log_);
        ASSERT_TRUE(advanceUntilQuiet(session));
        ASSERT_TRUE(session.open);
        EXPECT_EQ(planet::chunkSize(session.open->scene.planet->tree().shape), 33);
    }
    std::cout << steps << " frames, " << drawn_ << " drawn, " << swaps << " planets swapped in, " << replaced_
              << " files replaced and " << notReplaced_ << " not, " << compared_ << " comparisons, " << swept_
              << " points swept\n";
    EXPECT_GT(swaps, static_cast<std::uint64_t>(steps / 40));
    for (const auto& entry : std::filesystem::directory_iterator(cacheFolderPath()))
        EXPECT_EQ(entry.path().extension(), ".chk") << entry.path();
}

}  // namespace
}  // namespace worldy
