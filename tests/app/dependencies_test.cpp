// Checks who knows whom: .ci/layers itself, outside headers in the sources' include lines, and the symbols
// that the built libraries ask others for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

// Headers from outside that a folder must not include. .ci/layers checks the project's own.
struct FolderRule {
    const char* folder;     // from the top
    const char* except;     // a folder inside it that has a rule of its own; empty: none
    const char* forbidden;  // a regular expression over what is included
};

constexpr std::array<FolderRule, 3> rules = {{
    {"planet", "planet/gl", "GLFW/|imgui|epoxy/|GL/|EGL/|KHR/"},
    {"planet/gl", "", "GLFW/|imgui"},
    // Settings and counters of the renderer are plain data; what uploads, draws or bakes is not for panels.
    {"ui", "",
     "GLFW/|epoxy/|GL/|EGL/|KHR/|imgui_impl_|planet/gl/"
     "(?!draw/render_settings\\.h|draw/render_counters\\.h|measure/crack_meter\\.h|"
     "device/object_counts\\.h)"},
}};

std::vector<std::string> includesIn(std::istream& source) {
    static const std::regex line(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
    std::vector<std::string> found;
    std::smatch match;
    for (std::string text; std::getline(source, text);)
        if (std::regex_search(text, match, line)) found.push_back(match[1]);
    return found;
}

std::vector<std::string> forbiddenIn(std::istream& source, const FolderRule& rule) {
    const std::regex forbidden(std::string("^(") + rule.forbidden + ")");
    std::vector<std::string> found = includesIn(source);
    std::erase_if(found, [&](const std::string& name) { return !std::regex_search(name, forbidden); });
    return found;
}

bool isBelow(const std::filesystem::path& path, const std::filesystem::path& folder) {
    return std::search(path.begin(), path.end(), folder.begin(), folder.end()) != path.end();
}

// A symbol a line, as C++ spells it, that an archive uses and does not hold.
std::vector<std::string> symbolsAskedFor(const char* archive) {
    const std::string command =
        std::string("nm --demangle --undefined-only --format=just-symbols ") + archive;
    const std::unique_ptr<FILE, int (*)(FILE*)> lines(popen(command.c_str(), "r"), pclose);
    std::vector<std::string> symbols;
    std::array<char, 4096> line{};
    while (fgets(line.data(), line.size(), lines.get()) != nullptr) symbols.emplace_back(line.data());
    return symbols;
}

void expectNone(const char* archive, const char* forbidden) {
    const std::vector<std::string> symbols = symbolsAskedFor(archive);
    EXPECT_GT(symbols.size(), 50u) << archive;
    const std::regex pattern(forbidden);
    for (const std::string& symbol : symbols)
        EXPECT_FALSE(std::regex_search(symbol, pattern)) << archive << ": " << symbol;
}

TEST(Dependencies, noFolderIncludesForbiddenHeaders) {
    std::size_t files = 0;
    for (const FolderRule& rule : rules) {
        const std::filesystem::path top = WORLDY_SOURCE_DIR;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(top / rule.folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            if (*rule.except != '\0' && isBelow(entry.path(), rule.except)) continue;
            ++files;
            std::ifstream source(entry.path());
            for (const std::string& name : forbiddenIn(source, rule))
                ADD_FAILURE() << entry.path().string() << " includes " << name;
        }
    }
    EXPECT_GT(files, 200u);
}

// A header that relies on what others include then does not compile.
TEST(Dependencies, eachSourceIncludesItsOwnHeaderFirst) {
    const std::filesystem::path top = WORLDY_SOURCE_DIR;
    std::size_t files = 0;
    for (const char* folder : {"planet", "ui", "app", "tests"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(top / folder)) {
            std::filesystem::path header = entry.path();
            if (header.extension() != ".cpp" || !exists(header.replace_extension(".h"))) continue;
            ++files;
            std::ifstream source(entry.path());
            const std::vector<std::string> included = includesIn(source);
            EXPECT_EQ(included.empty() ? "nothing" : included.front(), relative(header, top)) << entry.path();
        }
    }
    EXPECT_GT(files, 200u);
}

TEST(Dependencies, aForbiddenIncludeIsFound) {
    const auto found = [](const FolderRule& rule, const char* text) {
        std::istringstream source(text);
        return forbiddenIn(source, rule).size();
    };
    EXPECT_EQ(found(rules[0], "#include <GLFW/glfw3.h>\n  # include \"imgui.h\"\n#include <epoxy/gl.h>\n"),
              3u);
    EXPECT_EQ(found(rules[1], "#include <epoxy/gl.h>\n#include <imgui.h>\n"), 1u);
    EXPECT_EQ(found(rules[2], "#include \"planet/gl/draw/render_settings.h\"\n"), 0u);
    EXPECT_EQ(found(rules[2], "#include \"planet/gl/store/tile_pool.h\"\n"), 1u);
    EXPECT_EQ(found(rules[2], "#include <imgui.h>\n// #include <GL/gl.h>\nint x;\n"), 0u);
}

// Runs .ci/layers over a small tree of its own.
class Layers : public testing::Test {
protected:
    void write(const std::string& file, const std::string& text) const {
        const std::filesystem::path path = folder_.path() / file;
        create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    int status() const {
        const std::string command =
            WORLDY_SOURCE_DIR "/.ci/layers " + folder_.path().string() + " 2>/dev/null";
        return WEXITSTATUS(std::system(command.c_str()));
    }
    void SetUp() override {
        write("planet/base/result.h", "int result;\n");
        write("planet/select/lod_select.h", "#include \"planet/base/result.h\"\n");
        write("ui/kit/theme.h", "#include \"planet/select/lod_select.h\"\n");
        write("app/main.cpp", "#include \"ui/kit/theme.h\"\n");
        write("tests/ui/kit/theme_test.cpp", "#include \"ui/kit/theme.h\"\n");
    }

    tests::TemporaryFolder folder_;
};

TEST_F(Layers, includesOfFoldersAbovePass) {
    EXPECT_EQ(status(), 0);
}

TEST_F(Layers, anUpwardIncludeFails) {
    write("planet/select/lod_select.h", "#include \"planet/bake/bake.h\"\n");
    EXPECT_EQ(status(), 1);
}

TEST_F(Layers, panelsThatIncludeASiblingFail) {
    write("ui/panels/lod/lod_panel.h", "#include \"ui/panels/bake/bake_panel.h\"\n");
    EXPECT_EQ(status(), 1);
}

// A header and its source count as one.
TEST_F(Layers, aRingOfIncludesFails) {
    write("planet/select/a.h", "int a;\n");
    write("planet/select/a.cpp", "#include \"planet/select/a.h\"\n#include \"planet/select/b.h\"\n");
    write("planet/select/b.h", "#include \"planet/select/a.h\"\n");
    EXPECT_EQ(status(), 1);
}

TEST_F(Layers, aFolderOfMoreThan30SourcesFails) {
    for (const std::string folder : {"planet/bake/", "tests/planet/bake/"}) {
        for (int i = 0; i < 30; ++i) write(folder + "source" + std::to_string(i) + ".cpp", "int x;\n");
        EXPECT_EQ(status(), 0) << folder;
        write(folder + "source30.cpp", "int x;\n");
        EXPECT_EQ(status(), 1) << folder;
        std::filesystem::remove_all(folder_.path() / folder);
    }
}

TEST_F(Layers, aFolderThatIsNotListedFails) {
    write("planet/misc/new.h", "#include \"planet/base/result.h\"\n");
    EXPECT_EQ(status(), 1);
}

TEST(Dependencies, theRuntimeUsesNoImageLibraryNoTbbAndNoGl) {
    expectNone(PLANET_ARCHIVE,
               "^(epoxy_|gl[A-Z]|egl[A-Z]|glfw|ImGui|tbb::|OpenImageIO|OIIO|TIFF|planet::gl::|planet::bake|"
               "worldy::)");
}

TEST(Dependencies, theLibrariesCallNoWindow) {
    expectNone(PLANET_BAKE_ARCHIVE, "^(epoxy_|gl[A-Z]|egl[A-Z]|glfw|ImGui|planet::gl::|worldy::)");
    expectNone(PLANET_MEASURE_ARCHIVE, "^(epoxy_|gl[A-Z]|egl[A-Z]|glfw|ImGui|planet::gl::|worldy::)");
    expectNone(PLANET_GL_ARCHIVE, "^(glfw|ImGui|OpenImageIO|worldy::)");
}

// Commands run without a window, so what they share with the editor must know neither panels nor a window.
TEST(Dependencies, theCoreKnowsNoPanelAndNoWindow) {
    expectNone(CORE_ARCHIVE, "^(glfw|ImGui|worldy::ui::)");
}

// Panels may ask what a bake would cost, but they must not bake, page, draw or measure.
TEST(Dependencies, panelsCallNoGlAndNoBake) {
    expectNone(
        UI_ARCHIVE,
        "^(epoxy_|gl[A-Z]|egl[A-Z]|glfw|planet::bake|planet::AtomicFile|planet::gl::|planet::Planet::"
        "(open|step|settle|setPaging|dropAll|retryFailed)|"
        "worldy::(openScene|stepScene|drawScene|measure|ErrorJob|CostMeter|PreviewJob|BakeJob|SweepJob))");
}

}  // namespace
}  // namespace worldy
