#include "app/settings/session_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class SessionFile : public testing::Test {
protected:
    planet::Result<LastSession> loaded(const std::string& text) {
        std::ofstream(file_) << text;
        return loadLastSession(file_);
    }
    std::string problemOf(const std::string& text) {
        const planet::Result<LastSession> session = loaded(text);
        return session ? "no problem" : session.error().message;
    }

    tests::TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "session.toml";
};

TEST_F(SessionFile, isReadAsItWasWritten) {
    LastSession session{.file = "/a \"b\"\\c/ü.tif",
                        .bake = "/cache/ü 65.chk",
                        .colour = "/c'.jpg",
                        .camera = planet::CameraPose{46.25, -6.5, 6000.125, 180, -10.5},
                        .trace = "/t.lodtrace",
                        .traceFrame = 198,
                        .traceB = "/after.lodtrace",
                        .ruler = {{46.5, -7, 410.25}, {46.75, -7.125, -12}},
                        .compare = LastComparison{}};
    session.compare->file = "/b's.chk";
    session.compare->origin = "preset \"p\"";
    session.compare->settings.lod.tauPx = 3.5;
    session.compare->settings.overlay.colourBy = ColourBy::Age;
    const planet::Result<LastSession> read = loaded(lastSessionText(session));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->file, session.file);
    EXPECT_EQ(read->bake, session.bake);
    EXPECT_EQ(read->colour, session.colour);
    EXPECT_EQ(read->trace, session.trace);
    EXPECT_EQ(read->traceFrame, session.traceFrame);
    EXPECT_EQ(read->traceB, session.traceB);
    ASSERT_TRUE(read->camera);
    EXPECT_EQ(read->camera->latitudeDeg, 46.25);
    EXPECT_EQ(read->camera->altitudeM, 6000.125);
    EXPECT_EQ(read->camera->pitchDeg, -10.5);
    ASSERT_EQ(read->ruler.size(), 2u);
    EXPECT_EQ(read->ruler[0].altitudeM, 410.25);
    EXPECT_EQ(read->ruler[1].longitudeDeg, -7.125);
    ASSERT_TRUE(read->compare);
    EXPECT_EQ(read->compare->file, session.compare->file);
    EXPECT_EQ(read->compare->origin, session.compare->origin);
    EXPECT_TRUE(read->compare->settings == session.compare->settings);
    EXPECT_EQ(lastSessionText(*read), lastSessionText(session));
}

TEST_F(SessionFile, keepsHowTheSourceIsRead) {
    LastSession session;
    planet::HeightSourceSettings& source = session.sourceSettings;
    source.metresPerUnit = 1;
    source.offsetM = -12.25;
    source.noDataValue = -32768;
    source.fillM = 3;
    source.rawSize = 513;
    source.rawBits = 16;
    source.rawSigned = source.rawBigEndian = source.skipBroken = true;
    session.colour = "";  // it has no colours
    const planet::Result<LastSession> read = loaded(lastSessionText(session));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->sourceSettings.metresPerUnit, 1);
    EXPECT_EQ(read->sourceSettings.offsetM, -12.25);
    EXPECT_EQ(read->sourceSettings.noDataValue, -32768);
    EXPECT_EQ(read->sourceSettings.fillM, 3);
    EXPECT_EQ(read->sourceSettings.rawSize, 513);
    EXPECT_EQ(read->sourceSettings.rawBits, 16);
    EXPECT_TRUE(read->sourceSettings.rawSigned && read->sourceSettings.rawBigEndian);
    EXPECT_TRUE(read->sourceSettings.skipBroken);
    EXPECT_EQ(read->colour, std::filesystem::path());
    EXPECT_THAT(problemOf("[source]\nunits = 3\n"), HasSubstr("line 2: source.units is unknown"));
    EXPECT_THAT(problemOf("[source]\nraw_bits = 99\n"), HasSubstr("raw_bits"));
}

TEST_F(SessionFile, isEmptyBeforeTheFirstSession) {
    const planet::Result<LastSession> none = loadLastSession(file_);
    ASSERT_TRUE(none);
    EXPECT_EQ(lastSessionText(*none), lastSessionText({}));
    const planet::Result<LastSession> empty = loaded(lastSessionText({}));
    ASSERT_TRUE(empty);
    EXPECT_TRUE(empty->file.empty() && empty->trace.empty() && !empty->camera);
}

TEST_F(SessionFile, isRefusedWithItsLineIfItIsWrong) {
    EXPECT_THAT(problemOf("file = 'a.tif'\nfiles = 'b.tif'\n"),
                AllOf(HasSubstr("session.toml: line 2"),
                      HasSubstr("files is unknown; expected file, bake, colour, camera, trace, trace_frame, "
                                "trace_b, ruler, source or compare")));
    EXPECT_THAT(problemOf("\nfile = 3\n"), HasSubstr("session.toml: line 2"));
    EXPECT_THAT(problemOf("bake = ['a']\n"), AllOf(HasSubstr("session.toml: line 1"), HasSubstr("bake")));
    EXPECT_THAT(problemOf("camera = '1,2'\n"), AllOf(HasSubstr("session.toml: line 1"), HasSubstr("camera")));
    EXPECT_THAT(problemOf("camera = '1e999,0,0'\n"), HasSubstr("session.toml: line 1"));
    EXPECT_THAT(problemOf("\nruler = '1,2'"), AllOf(HasSubstr("line 2"), HasSubstr("at most two places")));
    EXPECT_THAT(problemOf("ruler = ['1,2', '3,4', '5,6']"), HasSubstr("at most two places"));
    EXPECT_THAT(problemOf("ruler = ['1,2,3', '91,2,3']"), AllOf(HasSubstr("line 1"), HasSubstr("ruler")));
    EXPECT_THAT(problemOf("compare = 3"), HasSubstr("expected a table"));
    EXPECT_THAT(problemOf("[compare]\nfiles = 'a'"), HasSubstr("compare.files is unknown"));
    EXPECT_THAT(problemOf("[compare]\nsettings = ['lod.tau=3']"),
                AllOf(HasSubstr("line 2"), HasSubstr("lod.tau")));
    EXPECT_THAT(problemOf("[compare]\nsettings = ['lod.tau_px=1e9']"), HasSubstr("lod.tau_px"));
    EXPECT_THAT(problemOf("[compare]\nsettings = 'lod.tau_px=3'"), HasSubstr("expected a list"));
    EXPECT_THAT(problemOf("file = 'a"), HasSubstr("session.toml"));
    EXPECT_THAT(problemOf(std::string(1 << 16, '[')), HasSubstr("session.toml"));
}

}  // namespace
}  // namespace worldy
