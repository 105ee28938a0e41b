// Who may know whom, as the README's table of folders says: read from the sources' own include lines, and
// from the names that the built libraries ask others for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace worldy {
namespace {

struct FolderRule {
    const char* folder;     // from the top
    const char* except;     // a folder inside it that has a rule of its own; empty: none
    const char* forbidden;  // a regular expression over what is included
};

constexpr const char* windowsAndPanels = "GLFW/|imgui|ui/|app/";
constexpr std::array<FolderRule, 3> rules = {{
    {"planet", "planet/gl", "GLFW/|imgui|ui/|app/|epoxy/|GL/|EGL/|KHR/|planet/gl/"},
    {"planet/gl", "", windowsAndPanels},
    // Settings and counters of the renderer are plain data; what uploads, draws or bakes is not for panels.
    {"ui", "",
     "GLFW/|app/|epoxy/|GL/|EGL/|KHR/|imgui_impl_|planet/gl/"
     "(?!chunk_renderer\\.h|crack_meter\\.h|light_drawing\\.h|object_counts\\.h)"},
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
    EXPECT_GT(symbols.size(), 100u) << archive;
    const std::regex pattern(forbidden);
    for (const std::string& symbol : symbols)
        EXPECT_FALSE(std::regex_search(symbol, pattern)) << archive << ": " << symbol;
}

TEST(Manners, NoFolderIncludesWhatItMustNotKnow) {
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

// So that a header which leans on what others include does not compile.
TEST(Manners, EachSourceIncludesItsOwnHeaderFirst) {
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

TEST(Manners, ACheckFindsWhatIsPlanted) {
    const auto found = [](const FolderRule& rule, const char* text) {
        std::istringstream source(text);
        return forbiddenIn(source, rule).size();
    };
    EXPECT_EQ(found(rules[0], "#include <GLFW/glfw3.h>\n  # include \"imgui.h\"\n#include <epoxy/gl.h>\n"),
              3u);
    EXPECT_EQ(found(rules[0], "#include \"planet/gl/gl_objects.h\"\n#include \"planet/glance.h\"\n"), 1u);
    EXPECT_EQ(found(rules[1], "#include <epoxy/gl.h>\n#include \"ui/theme.h\"\n"), 1u);
    EXPECT_EQ(
        found(rules[2], "#include \"planet/gl/chunk_renderer.h\"\n#include \"planet/gl/tile_pool.h\"\n"), 1u);
    EXPECT_EQ(found(rules[2], "#include <imgui.h>\n// #include <GL/gl.h>\nint x;\n"), 0u);
}

TEST(Manners, TheLibraryCallsNoGlAndNoWindow) {
    expectNone(PLANET_ARCHIVE, "^(epoxy_|gl[A-Z]|egl[A-Z]|glfw|ImGui|planet::gl::|ui::|worldy::)");
    expectNone(PLANET_GL_ARCHIVE, "^(glfw|ImGui|ui::|worldy::)");
}

// `bake` itself and the parts of a bake; asking what one would cost is none.
TEST(Manners, PanelsCallNoGlAndNoBake) {
    expectNone(UI_ARCHIVE,
               "^(epoxy_|gl[A-Z]|egl[A-Z]|glfw|planet::bake|planet::AtomicFile|planet::gl::|planet::Planet::"
               "(open|step|settle|setPaging|dropAll|retryFailed)|worldy::)");
}

}  // namespace
}  // namespace worldy
