#include "app/base/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::contentOf;
using tests::fileCountIn;
using tests::TemporaryFolder;
namespace {

namespace fs = std::filesystem;

TEST(OutputFile, ReplacesTheOldFile) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.txt";
    ASSERT_TRUE(writeTextFile(file, "old"));
    ASSERT_TRUE(writeTextFile(file, "new"));
    EXPECT_EQ(contentOf(file), "new");
    EXPECT_EQ(fileCountIn(folder.path()), 1u);
}

TEST(OutputFile, AFolderThatIsNotThereIsAnErrorThatNamesTheFile) {
    const planet::Result<void> written = writeTextFile("/nonexistent/folder/a.txt", "x");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, planet::ErrorKind::Io);
    EXPECT_THAT(written.error().message, testing::HasSubstr("/nonexistent/folder/a.txt: cannot be written"));
}

TEST(OutputFile, AFolderIsNoTarget) {
    const TemporaryFolder folder;
    EXPECT_FALSE(writeTextFile(folder.path(), "x"));
}

}  // namespace
}  // namespace worldy
