// Recordings that older versions made, in tests/program/recordings/, over a bake of the Earth in data/.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/program/run_program.h"

namespace worldy {
namespace {

// Made in the window at commit a9bae3a, before the files moved into folders. A bake is recognised by its content, so
// this also fails when a bake is no longer byte-identical. When the chunk file became version 4, 5 and 6, only the size and the
// checksum of the file that the recordings name were replaced; their frames are those of commit a9bae3a.
TEST(Recordings, replayExactlyOverAFreshBake) {
    const TemporaryFolder folder;
    const std::string earth = WORLDY_SOURCE_DIR "/data/earth/";
    const Ran baked =
        runWorldy(folder, "bake '" + earth + "elevation.tif' -o earth.chk --face-size 257 --colour '" +
                              earth + "colour.jpg'");
    ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    for (const std::string name : {"first", "second"}) {
        const Ran replayed = runWorldy(
            folder, "replay '" WORLDY_SOURCE_DIR "/tests/program/recordings/" + name + ".flight' earth.chk");
        EXPECT_EQ(replayed.exitCode, 0) << replayed.errors;
        EXPECT_THAT(replayed.output, testing::HasSubstr("exact: every frame matches the recording"));
    }
}

}  // namespace
}  // namespace worldy
