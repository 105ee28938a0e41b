// The program loads image libraries only when it opens an image (app/images/image_functions.h), and MPI only as one of
// several ranks.
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

// Runs a copy of the program, which has no module beside it, to bake an image.
Ran bakeWithoutModule(const TemporaryFolder& folder) {
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
    const Ran ran = bakeWithoutModule(folder);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, AllOf(HasSubstr("worldy_images.so: cannot be loaded"), HasSubstr("expected")));
    EXPECT_FALSE(std::filesystem::exists(folder / "planet.chk"));

    bakePlanet(folder);
    const Ran shot = runShell(folder, "./worldy shot planet.chk -o shot.png");
    EXPECT_EQ(shot.exitCode, 2);
    EXPECT_THAT(shot.errors, HasSubstr("worldy_images.so: cannot be loaded"));
    EXPECT_FALSE(std::filesystem::exists(folder / "shot.png"));
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
    const TemporaryFolder folder;
    std::ofstream(folder / "worldy_images.so") << "no library";
    const Ran ran = bakeWithoutModule(folder);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("worldy_images.so: cannot be loaded"));
}

TEST(ImageModule, aLibraryThatIsNotWorldysIsRefused) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(FAKE_JOYSTICK_LIBRARY, folder / "worldy_images.so");
    const Ran ran = bakeWithoutModule(folder);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("worldy_images.so: cannot be loaded"));
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
