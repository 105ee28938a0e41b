#include "app/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/temporary_folder.h"

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

TEST(OutputFile, AFailedWriteLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.txt";
    ASSERT_TRUE(writeTextFile(file, "old"));
    const planet::Result<void> written = writeAtomically(file, [](const fs::path& temporary) {
        std::ofstream(temporary) << "half";
        return planet::Result<void>(planet::ioError("disk full"));
    });
    EXPECT_FALSE(written);
    EXPECT_EQ(contentOf(file), "old");
    EXPECT_EQ(fileCountIn(folder.path()), 1u);
}

TEST(OutputFile, TheTemporaryNameKeepsTheExtension) {
    const TemporaryFolder folder;
    fs::path seen;
    ASSERT_TRUE(writeAtomically(folder.path() / "a.png", [&](const fs::path& temporary) {
        seen = temporary;
        std::ofstream(temporary) << "x";
        return planet::Result<void>();
    }));
    EXPECT_EQ(seen.extension(), ".png");
    EXPECT_EQ(seen.parent_path(), folder.path());
}

TEST(OutputFile, WhatAKilledWriterLeftIsGoneWithTheNext) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.png";
    std::ofstream(folder / ".a.png.part") << "half of one that was killed";
    std::ofstream(folder / ".a.new.png") << "half of one that was killed";
    ASSERT_TRUE(writeAtomically(file, [](const fs::path& temporary) {
        std::ofstream(temporary) << "new";
        return planet::Result<void>();
    }));
    EXPECT_EQ(contentOf(file), "new");
    EXPECT_EQ(fileCountIn(folder.path()), 1u);
}

TEST(OutputFile, ASecondWriterOfTheSameNameIsRefusedMeanwhile) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.png";
    const auto write = [&](const std::string& text) {
        return [text](const fs::path& temporary) {
            std::ofstream(temporary) << text;
            return planet::Result<void>();
        };
    };
    planet::Result<void> second;
    ASSERT_TRUE(writeAtomically(file, [&](const fs::path& temporary) {
        second = writeAtomically(file, write("second"));
        return write("first")(temporary);
    }));
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().message, testing::HasSubstr("another program is writing"));
    EXPECT_EQ(contentOf(file), "first");
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
