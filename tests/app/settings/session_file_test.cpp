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
    const LastSession session{"/a \"b\"\\c/ü.tif", planet::CameraPose{46.25, -6.5, 6000.125, 180, -10.5},
                              "/t.lodtrace"};
    const planet::Result<LastSession> read = loaded(lastSessionText(session));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->file, session.file);
    EXPECT_EQ(read->trace, session.trace);
    ASSERT_TRUE(read->camera);
    EXPECT_EQ(read->camera->latitudeDeg, 46.25);
    EXPECT_EQ(read->camera->altitudeM, 6000.125);
    EXPECT_EQ(read->camera->pitchDeg, -10.5);
    EXPECT_EQ(lastSessionText(*read), lastSessionText(session));
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
                      HasSubstr("files is unknown; expected file, camera or trace")));
    EXPECT_THAT(problemOf("\nfile = 3\n"), HasSubstr("session.toml: line 2"));
    EXPECT_THAT(problemOf("camera = '1,2'\n"), AllOf(HasSubstr("session.toml: line 1"), HasSubstr("camera")));
    EXPECT_THAT(problemOf("camera = '1e999,0,0'\n"), HasSubstr("session.toml: line 1"));
    EXPECT_THAT(problemOf("file = 'a"), HasSubstr("session.toml"));
    EXPECT_THAT(problemOf(std::string(1 << 16, '[')), HasSubstr("session.toml"));
}

}  // namespace
}  // namespace worldy
