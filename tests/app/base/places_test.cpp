#include "app/base/places.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

namespace fs = std::filesystem;

// Sets variables of the environment for one test, and puts them back.
struct Places : testing::Test {
    TemporaryFolder folder;
    static constexpr const char* names[] = {"HOME", "XDG_CONFIG_HOME", "XDG_PICTURES_DIR"};
    std::optional<std::string> before[3];

    Places() {
        for (std::size_t i = 0; i < 3; ++i) {
            if (const char* value = std::getenv(names[i])) before[i] = value;
            unsetenv(names[i]);
        }
        setenv("HOME", folder.path().c_str(), 1);
    }
    ~Places() override {
        for (std::size_t i = 0; i < 3; ++i) {
            if (before[i])
                setenv(names[i], before[i]->c_str(), 1);
            else
                unsetenv(names[i]);
        }
    }
    void writeUserDirs(const std::string& text) const {
        fs::create_directories(folder / ".config");
        std::ofstream(folder / ".config/user-dirs.dirs") << text;
    }
};

TEST_F(Places, TheConfigFolderIsThatOfTheDesktopOrBelowHome) {
    EXPECT_EQ(configFolder(), folder / ".config/worldy");
    setenv("XDG_CONFIG_HOME", "relative", 1);
    EXPECT_EQ(configFolder(), folder / ".config/worldy");
    setenv("XDG_CONFIG_HOME", "/elsewhere", 1);
    EXPECT_EQ(configFolder(), "/elsewhere/worldy");
}

TEST_F(Places, PicturesGoToTheFirstFolderForThemThatIsThere) {
    EXPECT_EQ(picturesFolder(), fs::current_path());
    fs::create_directories(folder / "Pictures");
    EXPECT_EQ(picturesFolder(), folder / "Pictures");
    writeUserDirs("# comment\nXDG_DESKTOP_DIR=\"$HOME/Desktop\"\nXDG_PICTURES_DIR=\"$HOME/Bilder\"\n");
    EXPECT_EQ(picturesFolder(), folder / "Pictures");
    fs::create_directories(folder / "Bilder");
    EXPECT_EQ(picturesFolder(), folder / "Bilder");
    writeUserDirs("XDG_PICTURES_DIR=\"" + (folder / "Pictures").string() + "\"\n");
    EXPECT_EQ(picturesFolder(), folder / "Pictures");
    writeUserDirs("XDG_PICTURES_DIR=\"\nXDG_PICTURES_DIR=\n");
    EXPECT_EQ(picturesFolder(), folder / "Pictures");
    setenv("XDG_PICTURES_DIR", (folder / "Bilder").c_str(), 1);
    EXPECT_EQ(picturesFolder(), folder / "Bilder");
}

}  // namespace
}  // namespace worldy
