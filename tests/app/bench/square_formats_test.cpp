// Squares in formats of other programs: what is lost is an error, and what is wrong with a program is told.
#include "app/bench/square_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class StoredSquares : public testing::Test {
protected:
    StoredSquares() {
        std::filesystem::create_directory(programs_);
        setPath(programs_.string());
        for (int y = 0; y < square_.side; ++y)
            for (int x = 0; x < square_.side; ++x)
                square_.steps.push_back(static_cast<std::int16_t>(37 * x * y - 9000 + (x * x + y) % 17));
    }
    ~StoredSquares() override { setPath(oldPath_); }
    static void setPath(const std::string& path) { setenv("PATH", path.c_str(), 1); }
    // Puts a shell script into the only folder where programs are found.
    void install(const std::string& program, const std::string& script) const {
        std::ofstream(programs_ / program) << "#!/bin/sh\n" << script << '\n';
        std::filesystem::permissions(programs_ / program, std::filesystem::perms::owner_all);
    }
    planet::Result<StoredSquare> stored(SquareFormat format, int rounds = 0) const {
        return storeSquare(format, square_, folder_.path(), rounds);
    }

    const tests::TemporaryFolder folder_;
    const std::filesystem::path programs_ = folder_ / "programs";
    const std::string oldPath_ = std::getenv("PATH");
    HeightSquare square_{33, {}};
};

TEST_F(StoredSquares, onlyAProgramThatIsNotFoundIsSaidToBeNotInstalled) {
    auto kept = stored(SquareFormat::JpegXl);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->bytes, 0u);
    EXPECT_EQ(kept->problem, "cjxl is not installed");
    kept = stored(SquareFormat::Jpeg2000);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->problem, "opj_compress is not installed; gdal_translate is not installed");
    install("cjxl", "echo starting; echo 'out of memory' >&2; exit 3");
    kept = stored(SquareFormat::JpegXl);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->bytes, 0u);
    EXPECT_EQ(kept->problem, "cjxl ended with exit code 3: out of memory");
}

TEST_F(StoredSquares, aProgramThatKeepsEverySampleIsMeasured) {
    install("cjxl", "/bin/cp \"$6\" \"$7\"");
    install("djxl", "/bin/cp \"$2\" \"$3\"");
    const auto kept = stored(SquareFormat::JpegXl, 3);
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(kept->bytes, std::filesystem::file_size(folder_ / "square.jxl"));
    EXPECT_EQ(kept->decodingCpuS.size(), 3u);
    EXPECT_EQ(kept->problem, "");
}

TEST_F(StoredSquares, aProgramThatLosesSomethingIsAnError) {
    install("cjxl", "/bin/cp \"$6\" \"$7\"");
    // One byte of one sample is another one.
    install("djxl", "/bin/cp \"$2\" \"$3\"; printf '\\377' | /bin/dd of=\"$3\" bs=1 seek=100 conv=notrunc");
    auto lost = stored(SquareFormat::JpegXl);
    ASSERT_FALSE(lost);
    EXPECT_THAT(lost.error().message, HasSubstr("JPEG XL, cjxl -d 0 -e 7: the decoded samples differ"));
    install("djxl", "echo 'P5 33 33 255' > \"$3\"");
    EXPECT_FALSE(stored(SquareFormat::JpegXl));
    install("djxl", "exit 1");
    lost = stored(SquareFormat::JpegXl);
    ASSERT_FALSE(lost);
    EXPECT_THAT(lost.error().message, HasSubstr("square.jxl: cannot be decoded again: djxl ended with exit"));
}

TEST_F(StoredSquares, aFileThatCannotBeWrittenIsAnError) {
    std::filesystem::create_directory(folder_ / "square.pgm");
    const auto kept = stored(SquareFormat::JpegXl);
    ASSERT_FALSE(kept);
    EXPECT_THAT(kept.error().message, HasSubstr("square.pgm: cannot be written"));
}

}  // namespace
}  // namespace worldy
