// Keeps the editor's controllers small: reads the sources of app/editor, without compiling them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace worldy {
namespace {

constexpr int mostMembers = 15;

std::string withoutComments(const std::string& text) {
    static const std::regex comment(R"(//[^\n]*)");
    return std::regex_replace(text, comment, "");
}

std::string withoutEnumClasses(const std::string& text) {
    static const std::regex enumClass(R"(\benum\s+(class|struct)\b)");
    return std::regex_replace(text, enumClass, "enum");
}

std::string withoutTemplateArguments(std::string text) {
    static const std::regex innermost(R"(<[^<>]*>)");
    for (std::string shorter; (shorter = std::regex_replace(text, innermost, "")) != text;) text = shorter;
    return text;
}

// Returns the position after the brace that closes the one at open.
std::size_t afterBlock(const std::string& text, std::size_t open) {
    int depth = 0;
    for (std::size_t at = open; at < text.size(); ++at) {
        if (text[at] == '{') ++depth;
        if (text[at] == '}' && --depth == 0) return at + 1;
    }
    return text.size();
}

// Returns the number of data members that a declaration declares, the semicolon left out.
int membersDeclaredBy(const std::string& declaration) {
    static const std::regex noMember(
        R"(^\s*(using|friend|static|enum|struct|class|template|typedef)\b|\boperator\b|^\s*$)");
    const std::string plain = withoutTemplateArguments(declaration);
    const std::string declared = plain.substr(0, plain.find('='));
    if (std::regex_search(plain, noMember) || declared.find('(') != std::string::npos) return 0;
    return 1 + static_cast<int>(std::count(plain.begin(), plain.end(), ','));
}

// body: between the braces of a struct or class.
int dataMembersOf(const std::string& body) {
    static const std::regex access(R"(\b(public|private|protected):)");
    const std::string text = std::regex_replace(body, access, "");
    int members = 0;
    std::string declaration;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == ';') {
            members += membersDeclaredBy(declaration);
            declaration.clear();
        } else if (text[at] == '{') {
            at = afterBlock(text, at) - 1;
            const std::string plain = withoutTemplateArguments(declaration);
            if (plain.substr(0, plain.find('=')).find('(') != std::string::npos) declaration.clear();
        } else {
            declaration += text[at];
        }
    }
    return members;
}

struct Type {
    std::string name;
    int members = 0;
};
std::vector<Type> typesIn(const std::string& source) {
    static const std::regex opening(R"(\b(?:struct|class)\s+(\w+)\s*(?:final\s*)?(?::[^;{()]*)?\{)");
    const std::string text = withoutEnumClasses(withoutComments(source));
    std::vector<Type> types;
    for (std::sregex_iterator found(text.begin(), text.end(), opening), end; found != end; ++found) {
        const auto brace = static_cast<std::size_t>(found->position() + found->length() - 1);
        const std::size_t after = afterBlock(text, brace);
        types.push_back({(*found)[1], dataMembersOf(text.substr(brace + 1, after - brace - 2))});
    }
    return types;
}

std::string contentOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

std::vector<std::filesystem::path> sourcesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".h" || extension == ".cpp") files.push_back(entry.path());
    }
    return files;
}

TEST(Controllers, membersAreCounted) {
    const std::vector<Type> types = typesIn(R"(
        struct Plain { int a = 0; std::map<int, std::function<void(int, int)>> b{}; double c, d; };  // int e;
        enum class Not { A, B };
        class Other {
        public:
            explicit Other(int x) : one_(x) { int local = 0; }
            bool operator==(const Other&) const = default;
            static constexpr int two = 2;
            using Kind = int;
            std::vector<int> list() const { return {}; }
            struct Inner { int x = 0; };
        private:
            int one_ = call();
            std::vector<int> three_{1, 2, 3};
        };)");
    ASSERT_EQ(types.size(), 3u);
    EXPECT_EQ(types[0].members, 4);
    EXPECT_EQ(types[1].name, "Other");
    EXPECT_EQ(types[1].members, 2);
    EXPECT_EQ(types[2].members, 1);
}

TEST(Controllers, noTypeOfTheEditorHasMoreThanFifteenDataMembers) {
    std::size_t types = 0;
    for (const auto& file : sourcesIn(std::filesystem::path(WORLDY_SOURCE_DIR) / "app" / "editor")) {
        for (const Type& type : typesIn(contentOf(file))) {
            ++types;
            EXPECT_LE(type.members, mostMembers) << file.string() << ": " << type.name;
        }
    }
    EXPECT_GT(types, 40u);
}

TEST(Controllers, noFunctionTakesTheWholeEditor) {
    static const std::regex whole(R"(\bEditor\s*(const\s*)?[&*])");
    std::size_t files = 0;
    for (const char* folder : {"app", "ui"}) {
        for (const auto& file : sourcesIn(std::filesystem::path(WORLDY_SOURCE_DIR) / folder)) {
            ++files;
            EXPECT_FALSE(std::regex_search(withoutComments(contentOf(file)), whole)) << file.string();
        }
    }
    EXPECT_GT(files, 200u);
}

}  // namespace
}  // namespace worldy
