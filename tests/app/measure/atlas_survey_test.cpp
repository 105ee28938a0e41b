// Surveys of a baked planet that are cancelled and continued without the command line, as the window does it.
#include "app/measure/atlas_survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "planet/bake/bake.h"
#include "planet/measure/atlas_file.h"
#include "planet/source/height_source.h"
#include "planet/tree/region.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class AtlasSurveys : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new tests::TemporaryFolder;
        bakeInto("planet.chk", "noise:fbm,seed=6,gain=0.7");
    }
    static void TearDownTestSuite() { delete folder_; }
    static void bakeInto(const std::string& name, const std::string& terrain) {
        const auto source = planet::openHeightSource(terrain, {});
        ASSERT_TRUE(source);
        ASSERT_TRUE(planet::bake(*source, {.faceSize = 129, .chunkSize = 17, .radiusM = 1e5}, file(name)));
    }
    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }

    // Returns a request with settings that are not the usual ones, and with a region.
    static AtlasRequest requestInto(const std::string& name) {
        AtlasRequest request;
        request.file = file("planet.chk");
        request.output = file(name);
        request.view.lod.tauPx = 0.7123456789;
        request.view.camera.fovDeg = 51.7;
        request.view.overlay.wireframe = true;
        const std::vector<planet::Region> regions = {
            {.name = "coarse", .circles = {{{10.1, 20.2}, 30'000}}, .tauFactor = 2.5}};
        request.view.regions.list = std::make_shared<const std::vector<planet::Region>>(regions);
        setUsualDisk(request.view.paging.badDisk);
        request.size = {640, 400};
        request.grid.altitudesM = {2000, 10'000};
        request.grid.headings = 2;
        request.grid.most = 150;
        return request;
    }
    // Cancels a survey when it has some viewpoints, and returns what it leaves.
    static planet::Atlas cancelled(const AtlasRequest& request, std::uint64_t after = 40) {
        const auto outcome = surveyAtlas(request, [&](const std::optional<planet::AtlasProgress>& progress) {
            return !progress || progress->done < after;
        });
        EXPECT_EQ(outcome.error().kind, planet::ErrorKind::Cancelled);
        return planet::loadAtlas(planet::unfinishedAtlas(request.output)).value();
    }
    static bool goOn(const std::optional<planet::AtlasProgress>&) { return true; }

    static inline tests::TemporaryFolder* folder_ = nullptr;
};

TEST_F(AtlasSurveys, AnUnfinishedFileIsEnoughToContinueItToTheSameBytes) {
    ASSERT_TRUE(surveyAtlas(requestInto("whole.atlas"), goOn));
    const AtlasRequest parts = requestInto("parts.atlas");
    planet::Atlas left = cancelled(parts);
    EXPECT_FALSE(left.isFinished);
    EXPECT_FALSE(left.viewpoints.empty());
    EXPECT_LT(left.viewpoints.size(), 150u);
    const auto request = requestToResume(left, parts.output, parts.file, parts.view.regions, nullptr);
    ASSERT_TRUE(request) << request.error().message;
    const auto outcome = surveyAtlas(*request, goOn);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_LT(outcome->run.measured, outcome->atlas.viewpoints.size());
    EXPECT_EQ(tests::contentOf(parts.output), tests::contentOf(file("whole.atlas")));
    EXPECT_FALSE(std::filesystem::exists(planet::unfinishedAtlas(parts.output)));
}

TEST_F(AtlasSurveys, ASurveyIsContinuedWithTheSameBakeAndRegionsOnly) {
    const AtlasRequest parts = requestInto("other.atlas");
    const planet::Atlas left = cancelled(parts);
    const std::string bytes = tests::contentOf(planet::unfinishedAtlas(parts.output));
    const auto problemWith = [&](const std::filesystem::path& chunks, const RegionSettings& regions) {
        const auto outcome =
            surveyAtlas(*requestToResume(left, parts.output, chunks, regions, nullptr), goOn);
        return outcome ? std::string() : outcome.error().message;
    };
    EXPECT_THAT(problemWith(parts.file, {}), HasSubstr("has other regions; expected the same regions"));
    bakeInto("other.chk", "noise:fbm,seed=7,gain=0.7");
    EXPECT_THAT(problemWith(file("other.chk"), parts.view.regions),
                HasSubstr("other.atlas.part is of another bake, planet.chk; expected the same file"));
    EXPECT_EQ(tests::contentOf(planet::unfinishedAtlas(parts.output)), bytes);
}

TEST_F(AtlasSurveys, ARevisitIsContinuedWithTheAtlasThatItVisits) {
    ASSERT_TRUE(surveyAtlas(requestInto("first.atlas"), goOn));
    const auto first = std::make_shared<const planet::Atlas>(planet::loadAtlas(file("first.atlas")).value());
    AtlasRequest again = requestInto("again.atlas");
    again.revisited = first;
    again.view.lod.tauPx = 2;
    const planet::Atlas left = cancelled(again);
    const auto alone = requestToResume(left, again.output, again.file, again.view.regions, nullptr);
    ASSERT_FALSE(alone);
    EXPECT_THAT(alone.error().message, HasSubstr("--diff EARLIER.atlas"));
    const auto request = requestToResume(left, again.output, again.file, again.view.regions, first);
    ASSERT_TRUE(request);
    const auto outcome = surveyAtlas(*request, goOn);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_EQ(outcome->atlas.viewpoints.size(), first->viewpoints.size());
}

}  // namespace
}  // namespace worldy
