// The program loads the libraries of rasters and of images only when it opens one (app/images/image_functions.h), and MPI
// only as one of several ranks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path modules = std::filesystem::path(WORLDY_BINARY).parent_path();

// Runs a copy of the program to bake an image. Beside it are only the modules that the folder has already.
Ran bakeCopied(const TemporaryFolder& folder) {
    writeHills(folder);
    std::filesystem::copy_file(WORLDY_BINARY, folder / "worldy");
    return runShell(folder, "./worldy bake hills.pgm -o planet.chk");
}

TEST(ImageModule, theProgramStartsWithoutImageLibraries) {
    const TemporaryFolder folder;
    // The variable makes the dynamic linker list the libraries instead of running the program.
    const Ran ran = runShell(folder, "LD_TRACE_LOADED_OBJECTS=1 '" WORLDY_BINARY "'");
    EXPECT_THAT(ran.output, HasSubstr("libglfw"));
    for (const char* const library : {"OpenImageIO", "libgdal", "libproj", "libtiff", "libpng", "libImath"})
        EXPECT_THAT(ran.output, Not(HasSubstr(library)));
    EXPECT_LT(std::ranges::count(ran.output, '\n'), 40);
}

TEST(ImageModule, aMissingModuleIsNamed) {
    const TemporaryFolder folder;
    const Ran ran = bakeCopied(folder);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, AllOf(HasSubstr("worldy_rasters.so: cannot be loaded"), HasSubstr("expected")));
    EXPECT_FALSE(std::filesystem::exists(folder / "planet.chk"));

    bakePlanet(folder);
    const Ran shot = runShell(folder, "./worldy shot planet.chk -o shot.png");
    EXPECT_EQ(shot.exitCode, 2);
    EXPECT_THAT(shot.errors, HasSubstr("worldy_images.so: cannot be loaded"));
    EXPECT_FALSE(std::filesystem::exists(folder / "shot.png"));
}

// The module of rasters reads images with the other module.
TEST(ImageModule, sourcesThatAreImagesNameTheOtherModule) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(modules / "worldy_rasters.so", folder / "worldy_rasters.so");
    const Ran ran = bakeCopied(folder);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("worldy_images.so: cannot be loaded"));
}

// OpenImageIO takes five times as long to load as GDAL.
TEST(ImageModule, aRasterIsBakedWithoutTheModuleOfImages) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(modules / "worldy_rasters.so", folder / "worldy_rasters.so");
    std::filesystem::copy_file(WORLDY_BINARY, folder / "worldy");
    const Ran ran = runShell(
        folder, "./worldy bake '" WORLDY_SOURCE_DIR
                "/data/regions/S33W071.tif' --face-size 1025 -o andes.chk && ./worldy info andes.chk");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
}

// A process that mpirun has started must not bake alone, or each rank would write the same file.
TEST(MpiModule, aRankWithoutTheModuleIsTold) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(WORLDY_BINARY, folder / "worldy");
    const Ran ran = runShell(folder, "PMIX_RANK=0 ./worldy bake noise:ridged -o planet.chk");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors,
                AllOf(HasSubstr("worldy_mpi.so: cannot be loaded"), HasSubstr("-DWORLDY_MPI=ON")));
    EXPECT_FALSE(std::filesystem::exists(folder / "planet.chk"));
}

TEST(ImageModule, aFileThatIsNoModuleIsRefused) {
    for (const char* const module : {"worldy_rasters.so", "worldy_images.so"}) {
        const TemporaryFolder folder;
        std::filesystem::copy_file(modules / "worldy_rasters.so", folder / "worldy_rasters.so");
        std::ofstream(folder / module) << "no library";
        const Ran ran = bakeCopied(folder);
        EXPECT_EQ(ran.exitCode, 2);
        EXPECT_THAT(ran.errors, HasSubstr(std::string(module) + ": cannot be loaded"));
    }
}

TEST(ImageModule, aLibraryThatIsNotWorldysIsRefused) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(FAKE_JOYSTICK_LIBRARY, folder / "worldy_rasters.so");
    const Ran ran = bakeCopied(folder);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("worldy_rasters.so: cannot be loaded"));
}

TEST(ImageModule, aChunkFileIsReadWithoutTheModule) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::filesystem::copy_file(WORLDY_BINARY, folder / "worldy");
    const Ran info = runShell(folder, "./worldy info planet.chk && ./worldy verify planet.chk");
    EXPECT_EQ(info.exitCode, 0) << info.errors;
}

}  // namespace
}  // namespace worldy
