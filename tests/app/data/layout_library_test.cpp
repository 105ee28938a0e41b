#include "app/data/layout_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/settings/settings_text.h"
#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Workspace someLayout() {
    Workspace workspace;
    workspace.leftWidth = 444.5;
    workspace.panels[static_cast<std::size_t>(PanelId::Log)].shown = false;
    workspace.panels[static_cast<std::size_t>(PanelId::Chunk)].floats = true;
    workspace.panels[static_cast<std::size_t>(PanelId::Chunk)].floating = {0.125, 1, 500, 300};
    std::swap(workspace.order[0], workspace.order[5]);
    workspace.inFront[0] = PanelId::Chunk;
    workspace.maximised = MaximisedDock::Bottom;
    return workspace;
}

// Shipped: "Base", without a key. Own: none, the folder is not there yet.
struct Layouts : testing::Test {
    TemporaryFolder folder;
    NamedFolders folders{folder / "shipped", folder / "config/layouts"};

    Layouts() {
        std::filesystem::create_directories(folders.shipped);
        std::ofstream(folders.shipped / "Base.toml") << "[panels]\nlog_shown = false\n";
    }
    void writeOwn(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories(folders.own);
        std::ofstream(folders.own / file) << text;
    }
    static std::vector<std::string> names(const LayoutLibrary& library) {
        std::vector<std::string> all;
        for (const NamedLayout& layout : library.layouts()) all.push_back(layout.named.name);
        return all;
    }
};

TEST_F(Layouts, whatIsSavedIsListedAndLoadedAgainWithoutPreferences) {
    LayoutLibrary library(folders);
    Workspace saved = someLayout();
    saved.preferences = {Theme::Light, 2, false, false, false};
    const planet::Result<void> done = library.save("two monitors ä", saved, false);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_THAT(names(library), ElementsAre("Base", "two monitors ä"));
    for (const LayoutLibrary& each : {library, LayoutLibrary(folders)}) {
        const planet::Result<Workspace> loaded = each.load("two monitors ä");
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(*loaded, someLayout());
    }
    EXPECT_EQ(withLayout(saved, *library.load("two monitors ä")), saved);
    const std::string text = tests::contentOf(folders.own / "two monitors ä.toml");
    EXPECT_THAT(text, testing::Not(HasSubstr("width_px")));
    EXPECT_THAT(text, testing::Not(HasSubstr("theme")));
}

TEST_F(Layouts, anExistingLayoutIsReplacedOnlyOnRequest) {
    LayoutLibrary library(folders);
    ASSERT_TRUE(library.save("mine", someLayout(), false));
    EXPECT_THAT(library.save("Mine", {}, false).error().message, HasSubstr("mine.toml: exists; expected"));
    EXPECT_EQ(library.load("mine"), someLayout());
    ASSERT_TRUE(library.save("Mine", {}, true));
    EXPECT_THAT(names(library), ElementsAre("Base", "mine"));
    EXPECT_EQ(library.load("mine"), Workspace{});
    const auto entries = std::filesystem::directory_iterator(folders.own);
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(Layouts, shippedOnesCanNeitherBeDeletedNorReplaced) {
    LayoutLibrary library(folders);
    EXPECT_THAT(library.save("base", someLayout(), true).error().message,
                HasSubstr("built-in layout has that name"));
    EXPECT_THAT(library.remove("Base").error().message, HasSubstr("cannot be deleted"));
    EXPECT_TRUE(std::filesystem::exists(folders.shipped / "Base.toml"));
    ASSERT_TRUE(library.save("mine", {}, false));
    EXPECT_TRUE(library.remove("mine"));
    EXPECT_THAT(names(library), ElementsAre("Base"));
    EXPECT_THAT(library.remove("mine").error().message, HasSubstr("unknown layout \"mine\""));
}

TEST_F(Layouts, hostileFilesAreListedWithTheirProblemAndNeitherLoadedNorReplaced) {
    writeOwn("view.toml", "[lod]\ntau_px = 3\n");
    writeOwn("wide.toml", "[window]\nleft_width = 1e9\n");
    writeOwn("size.toml", "[window]\nwidth_px = 800\n");
    writeOwn("broken.toml", "[panels\n");
    writeOwn("base.toml", "[panels]\n");
    std::filesystem::create_directories(folders.own / "folder.toml");
    LayoutLibrary library(folders);
    const auto problemOf = [&](const std::string& name) { return library.load(name).error().message; };
    EXPECT_THAT(problemOf("view"), HasSubstr("view.toml: lod.tau_px is not part of a layout; expected"));
    EXPECT_THAT(problemOf("wide"),
                HasSubstr("line 2: window.left_width is 1000000000.0; expected a number in [160, 1000]"));
    EXPECT_THAT(problemOf("size"), HasSubstr("window.width_px is not part of a layout"));
    EXPECT_THAT(problemOf("broken"), HasSubstr("broken.toml: line 1: not TOML"));
    EXPECT_THAT(problemOf("base"), HasSubstr("rename the file"));
    EXPECT_THAT(problemOf("folder"), HasSubstr("folder.toml"));
    EXPECT_THAT(library.save("view", {}, true).error().message, HasSubstr("exists and is not a layout"));
    EXPECT_EQ(tests::contentOf(folders.own / "view.toml"), "[lod]\ntau_px = 3\n");
}

TEST_F(Layouts, namesThatAreNoFileNamesAreRefusedAndWriteNothing) {
    LayoutLibrary library(folders);
    for (const char* name : {"", "../evil", "a/b", ".hidden", "x ", "a\nb", "caf\xe9"})
        EXPECT_FALSE(library.save(name, {}, true)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "config"));
    EXPECT_FALSE(std::filesystem::exists(folder / "evil.toml"));
}

TEST(Layout, isTheSameWhateverIsInFront) {
    Workspace other = someLayout();
    other.inFront[1] = PanelId::Camera;
    other.maximised = MaximisedDock::None;
    other.preferences = {Theme::Light, 2, false, false, false};
    EXPECT_TRUE(areSameLayout(other, someLayout()));
    other.bottomHeight += 1;
    EXPECT_FALSE(areSameLayout(other, someLayout()));
    EXPECT_FALSE(areSameLayout(someLayout(), {}));
}

TEST(ShippedLayouts, allCanBeReadAndDifferAndFillTheirDocks) {
    const std::filesystem::path data = std::filesystem::path(WORLDY_SOURCE_DIR) / "data" / "layouts";
    const LayoutLibrary library({data, "/nonexistent"});
    EXPECT_THAT(Layouts::names(library), ElementsAre("Measuring", "Paging", "Selection"));
    for (const NamedLayout& layout : library.layouts()) {
        ASSERT_TRUE(layout.workspace) << layout.workspace.error().message;
        EXPECT_FALSE(areSameLayout(*layout.workspace, {})) << layout.named.name;
        const auto isShownThere = [&](PanelId panel, Dock dock) {
            const PanelPlace& place = layout.workspace->panels[static_cast<std::size_t>(panel)];
            return place.shown && place.dock == dock;
        };
        EXPECT_TRUE(isShownThere(layout.workspace->inFront[0], Dock::Left)) << layout.named.name;
    }
    // The tables of the bottom dock get the whole width.
    for (const std::size_t i : {0u, 1u}) {
        for (const PanelPlace& place : library.layouts()[i].workspace->panels)
            EXPECT_FALSE(place.shown && place.dock == Dock::Right) << library.layouts()[i].named.name;
    }
}

}  // namespace
}  // namespace worldy
