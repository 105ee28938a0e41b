#include "planet/base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using ::tests::contentOf;

std::span<const std::byte> asBytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

TEST(AtomicFile, appearsOnlyWhenCommitted) {
    const tests::TemporaryFolder folder;
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->append(asBytes("hello world")));
    ASSERT_TRUE(file->overwrite(6, asBytes("there")));
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(contentOf(folder / "a"), "hello there");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 1u);
}

TEST(AtomicFile, uncommittedLeavesTheOldFileAndNothingElse) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder / "a") << "old";
    {
        auto file = AtomicFile::create(folder / "a");
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->append(asBytes("new")));
    }
    EXPECT_EQ(contentOf(folder / "a"), "old");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 1u);
}

TEST(AtomicFile, secondWriterOfTheSamePathIsRefused) {
    const tests::TemporaryFolder folder;
    auto first = AtomicFile::create(folder / "a");
    ASSERT_TRUE(first);
    const auto second = AtomicFile::create(folder / "a");
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("another program is writing"), std::string::npos);
    ASSERT_TRUE(first->commit());
    EXPECT_TRUE(AtomicFile::create(folder / "a"));
}

TEST(AtomicFile, leftoverOfAKilledWriterIsWrittenOver) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder / ".a.part") << "a long leftover of a writer that was killed";
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->append(asBytes("short")));
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(contentOf(folder / "a"), "short");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 1u);
}

TEST(AtomicFile, missingFolderAndFolderAsFileAreErrorsThatNameThem) {
    const tests::TemporaryFolder folder;
    const auto missing = AtomicFile::create(folder / "no/such/file");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().kind, ErrorKind::Io);
    EXPECT_NE(missing.error().message.find("no/such/file"), std::string::npos);
    EXPECT_FALSE(AtomicFile::create(folder.path()));
}

TEST(AtomicFile, deviceIsNotReplacedByAFile) {
    const tests::TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    const auto file = AtomicFile::create(folder / "pipe");
    ASSERT_FALSE(file);
    EXPECT_NE(file.error().message.find("pipe: is a folder or a device"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

TEST(AtomicFile, linkIsKeptAndItsTargetWritten) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "data");
    std::ofstream(folder / "data/file") << "old";
    std::filesystem::create_symlink("data/file", folder / "near");
    std::filesystem::create_symlink("near", folder / "far");
    auto file = AtomicFile::create(folder / "far");
    ASSERT_TRUE(file);
    EXPECT_FALSE(AtomicFile::create(folder / "data/file")) << "two writers of one file";
    ASSERT_TRUE(file->append(asBytes("new")));
    ASSERT_TRUE(file->commit());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "near"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "far"));
    EXPECT_FALSE(std::filesystem::is_symlink(folder / "data/file"));
    EXPECT_EQ(contentOf(folder / "data/file"), "new");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 3u);
    EXPECT_EQ(::tests::fileCountIn(folder / "data"), 1u);
}

TEST(AtomicFile, linkToNothingMakesTheFileThatItNames) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_symlink(folder / "later", folder / "link");
    auto file = AtomicFile::create(folder / "link");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->append(asBytes("new")));
    ASSERT_TRUE(file->commit());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(contentOf(folder / "later"), "new");
}

TEST(AtomicFile, replacedFileKeepsItsMode) {
    const tests::TemporaryFolder folder;
    const auto path = folder / "private";
    std::ofstream(path) << "old";
    const auto own = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
    for (const auto mode : {own, own | std::filesystem::perms::group_write}) {
        std::filesystem::permissions(path, mode);
        auto file = AtomicFile::create(path);
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->commit());
        EXPECT_EQ(std::filesystem::status(path).permissions(), mode);
    }
}

TEST(AtomicFile, placeThatCannotBeWrittenIsToldBeforehand) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_symlink("loop", folder / "loop");
    std::filesystem::create_symlink("nowhere/file", folder / "link");
    for (const char* name : {"loop", "link", "nowhere/file", "."})
        EXPECT_FALSE(checkWritable(folder / name)) << name;
    EXPECT_FALSE(checkWritable("/dev/null"));
    EXPECT_TRUE(checkWritable(folder / "new"));
    std::ofstream(folder / "old") << "old";
    EXPECT_TRUE(checkWritable(folder / "old"));
}

TEST(AtomicFile, linkToItselfIsAnErrorThatNamesIt) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_symlink("loop", folder / "loop");
    const auto file = AtomicFile::create(folder / "loop");
    ASSERT_FALSE(file);
    EXPECT_NE(file.error().message.find("loop: cannot be written"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "loop"));
}

TEST(AtomicFile, fullDiskIsAnErrorAndKeepsTheOldFile) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder / "a") << "old";
    // A limit on a file's size fails the write as a full disk does, without needing one.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    {
        auto file = AtomicFile::create(folder / "a");
        ASSERT_TRUE(file);
        const auto written = file->append(std::vector<std::byte>(10000));
        ASSERT_FALSE(written);
        EXPECT_EQ(written.error().kind, ErrorKind::Io);
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(contentOf(folder / "a"), "old");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 1u);
}

TEST(WriteAtomically, aFailedWriteLeavesTheOldFileAndNothingElse) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.txt";
    std::ofstream(file) << "old";
    const Result<void> written = writeAtomically(file, [](const std::filesystem::path& temporary) {
        std::ofstream(temporary) << "half";
        return Result<void>(ioError("disk full"));
    });
    EXPECT_FALSE(written);
    EXPECT_EQ(contentOf(file), "old");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 1u);
}

TEST(WriteAtomically, linkIsKeptAndItsTargetWritten) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "data");
    std::ofstream(folder / "data/picture.png") << "old";
    std::filesystem::create_symlink("data/picture.png", folder / "link.png");
    ASSERT_TRUE(writeAtomically(folder / "link.png", [](const std::filesystem::path& temporary) {
        std::ofstream(temporary) << "new";
        return Result<void>();
    }));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.png"));
    EXPECT_EQ(contentOf(folder / "data/picture.png"), "new");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 2u);
    EXPECT_EQ(::tests::fileCountIn(folder / "data"), 1u);
}

TEST(WriteAtomically, theTemporaryNameKeepsTheExtension) {
    const tests::TemporaryFolder folder;
    std::filesystem::path seen;
    ASSERT_TRUE(writeAtomically(folder.path() / "a.png", [&](const std::filesystem::path& temporary) {
        seen = temporary;
        std::ofstream(temporary) << "x";
        return Result<void>();
    }));
    EXPECT_EQ(seen.extension(), ".png");
    EXPECT_EQ(seen.parent_path(), folder.path());
}

TEST(WriteAtomically, whatAKilledWriterLeftIsGoneWithTheNext) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.png";
    std::ofstream(folder / ".a.png.part") << "half of one that was killed";
    std::ofstream(folder / ".a.new.png") << "half of one that was killed";
    ASSERT_TRUE(writeAtomically(file, [](const std::filesystem::path& temporary) {
        std::ofstream(temporary) << "new";
        return Result<void>();
    }));
    EXPECT_EQ(contentOf(file), "new");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 1u);
}

TEST(WriteAtomically, aSecondWriterOfTheSameNameIsRefusedMeanwhile) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.png";
    const auto write = [&](const std::string& text) {
        return [text](const std::filesystem::path& temporary) {
            std::ofstream(temporary) << text;
            return Result<void>();
        };
    };
    Result<void> second;
    ASSERT_TRUE(writeAtomically(file, [&](const std::filesystem::path& temporary) {
        second = writeAtomically(file, write("second"));
        return write("first")(temporary);
    }));
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().message, testing::HasSubstr("another program is writing"));
    EXPECT_EQ(contentOf(file), "first");
    EXPECT_EQ(::tests::fileCountIn(folder.path()), 1u);
}

}  // namespace
}  // namespace planet
