// Runs the worldy binary in a folder of its own, and keeps what it said.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::contentOf;
using tests::TemporaryFolder;

struct Ran {
    int exitCode = -1;  // 128 + the signal where one ended it
    std::string output;
    std::string errors;
};

// Settings, cache and pictures land in the folder; there is no display but where the arguments set one. Only
// what Mesa makes of shaders for a processor is shared by all: it takes two thirds of a picture's time.
inline Ran runShell(const TemporaryFolder& folder, const std::string& command) {
    const std::string home = folder.path().string();
    const std::string line = "cd '" + home + "' && unset DISPLAY WAYLAND_DISPLAY && export HOME='" + home +
                             "' XDG_CONFIG_HOME='" + home + "/config' XDG_CACHE_HOME='" + home +
                             "/cache' MESA_SHADER_CACHE_DIR='" WORLDY_BINARY "_shaders' && { " + command +
                             "\n} >.stdout 2>.stderr";
    const int status = std::system(line.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, contentOf(folder.path() / ".stdout"), contentOf(folder.path() / ".stderr")};
}

inline Ran runWorldy(const TemporaryFolder& folder, const std::string& arguments) {
    return runShell(folder, "'" WORLDY_BINARY "' " + arguments);
}

// Expects that a program or steps printed nothing and ended without an error.
inline void expectQuiet(const Ran& ran) {
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "") << ran.errors;
}

// "long.toml": a flight of a million seconds, for what must be refused as too many steps.
inline void writeLongFlight(const TemporaryFolder& folder) {
    std::ofstream flight(folder.path() / "long.toml");
    for (const int timeS : {0, 1'000'000}) {
        flight << "[[key]]\ntime_s = " << timeS
               << "\nlatitude_deg = 0\nlongitude_deg = 0\naltitude_m = 90000\nheading_deg = 0\npitch_deg = "
                  "-40\n";
    }
}

}  // namespace worldy
