#include "app/settings/key_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

KeyChord key(const char* name) {
    return keyChordFrom(name).value();
}

const std::vector<KeyedCommand> commands = {{"freeze_lod", "Freeze LOD", "Keeps the selection.", {key("F2")}},
                                            {"wireframe", "Wireframe", "Draws edges.", {key("F1")}},
                                            {"redo", "Redo", "Redoes.", {key("Ctrl+Shift+Z"), key("Ctrl+Y")}},
                                            {"about", "About", "Tells.", {}}};

KeyFile read(std::string_view text) {
    return keysFromText(text, "keys.toml", commands);
}

TEST(KeyFile, aMissingFileGivesTheDefaults) {
    const KeyFile file = readKeyFile("/no such folder/keys.toml", commands);
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_EQ(file.keys.size(), commands.size());
    for (std::size_t i = 0; i < commands.size(); ++i) EXPECT_EQ(file.keys[i], commands[i].keys);
}

TEST(KeyFile, idsAndNamesNameCommands) {
    const KeyFile file = read("freeze_lod = \"F3\"\n\"Wireframe\" = [\"F4\", \"ctrl+e\"]\nredo = \"\"\n");
    EXPECT_THAT(file.problems, IsEmpty());
    EXPECT_THAT(file.keys[0], ElementsAre(key("F3")));
    EXPECT_THAT(file.keys[1], ElementsAre(key("F4"), key("Ctrl+E")));
    EXPECT_THAT(file.keys[2], IsEmpty());
    EXPECT_THAT(file.keys[3], IsEmpty());
}

TEST(KeyFile, twoCommandsCanExchangeTheirKeys) {
    const KeyFile file = read("wireframe = \"F2\"\nfreeze_lod = \"F1\"\n");
    EXPECT_THAT(file.problems, IsEmpty());
    EXPECT_THAT(file.keys[0], ElementsAre(key("F1")));
    EXPECT_THAT(file.keys[1], ElementsAre(key("F2")));
}

TEST(KeyFile, anUnknownCommandIsNamedWithItsLineAndItsNearest) {
    const KeyFile file = read("\nfreze_lod = \"F3\"\n");
    EXPECT_THAT(file.problems,
                ElementsAre("keys.toml: line 2: freze_lod is not a command; did you mean freeze_lod?"));
    EXPECT_THAT(file.keys[0], ElementsAre(key("F2")));
    EXPECT_THAT(read("nothing_like_it = \"F3\"").problems,
                ElementsAre(AllOf(HasSubstr("line 1"), HasSubstr("expected a command of the Keys window"))));
}

TEST(KeyFile, anUnknownKeyLeavesTheDefault) {
    for (const char* value : {"\"Hyper+F3\"", "3", "[\"F3\", \"F99\"]", "{ key = \"F3\" }", "true"}) {
        const KeyFile file = read(std::string("freeze_lod = ") + value + "\nwireframe = \"F5\"\n");
        EXPECT_THAT(file.problems, ElementsAre(AllOf(HasSubstr("keys.toml: line 1: freeze_lod is"),
                                                     HasSubstr("expected keys such as"))))
            << value;
        EXPECT_THAT(file.keys[0], ElementsAre(key("F2"))) << value;
        EXPECT_THAT(file.keys[1], ElementsAre(key("F5"))) << value;
    }
}

TEST(KeyFile, aKeyThatFliesTheCameraIsRefused) {
    const KeyFile file = read("freeze_lod = \"W\"");
    EXPECT_THAT(file.problems,
                ElementsAre(HasSubstr("freeze_lod is W, but W flies the camera; expected another")));
    EXPECT_THAT(file.keys[0], ElementsAre(key("F2")));
}

TEST(KeyFile, aKeyGivenTwiceIsRefusedTheSecondTime) {
    const KeyFile file = read("wireframe = \"F5\"\nabout = \"F5\"\n");
    EXPECT_THAT(file.problems, ElementsAre("keys.toml: line 2: about is F5, which wireframe has in line 1; "
                                           "expected each key once"));
    EXPECT_THAT(file.keys[1], ElementsAre(key("F5")));
    EXPECT_THAT(file.keys[3], IsEmpty());
}

TEST(KeyFile, theKeyOfACommandThatKeepsItIsRefused) {
    const KeyFile file = read("about = \"F1\"\n");
    EXPECT_THAT(file.problems,
                ElementsAre(HasSubstr("about is F1, which is the key of wireframe; expected a free "
                                      "key, or another key for wireframe in this file")));
    EXPECT_THAT(file.keys[3], IsEmpty());
}

TEST(KeyFile, whoTookTheKeyOfARefusedEntryIsRefusedToo) {
    // wireframe falls back to F1, which about has taken.
    const KeyFile file = read("about = \"F1\"\nwireframe = \"F2\"\n");
    EXPECT_EQ(file.problems.size(), 2u);
    for (std::size_t i = 0; i < commands.size(); ++i) EXPECT_EQ(file.keys[i], commands[i].keys);
}

TEST(KeyFile, aCommandNamedTwiceIsRefusedTheSecondTime) {
    const KeyFile file = read("freeze_lod = \"F3\"\n\"Freeze LOD\" = \"F4\"\n");
    EXPECT_THAT(file.problems, ElementsAre(HasSubstr("line 2: freeze_lod has its keys in line 1 already")));
    EXPECT_THAT(file.keys[0], ElementsAre(key("F3")));
}

TEST(KeyFile, whatIsNotTomlGivesTheDefaults) {
    const KeyFile file = read("freeze_lod = \"F3\"\nfreeze_lod = = 4\n");
    EXPECT_THAT(file.problems, ElementsAre(AllOf(HasSubstr("keys.toml"), HasSubstr("line 2"))));
    EXPECT_THAT(file.keys[0], ElementsAre(key("F2")));
}

TEST(KeyFile, theWrittenFileChangesNothingAndNamesAllCommands) {
    const std::string text = keyFileText(commands);
    EXPECT_THAT(text, HasSubstr("# freeze_lod = \"F2\"\n"));
    EXPECT_THAT(text, HasSubstr("# redo = [\"Ctrl+Shift+Z\", \"Ctrl+Y\"]\n"));
    EXPECT_THAT(text, HasSubstr("# about = \"\"\n"));
    EXPECT_THAT(read(text).problems, IsEmpty());
    // Without the marks in front of the entries, it says the defaults.
    std::string entries;
    for (std::size_t at = 0; (at = text.find(" = ", at)) != std::string::npos; ++at) {
        const std::size_t begin = text.rfind("\n# ", at) + 3;
        entries += text.substr(begin, text.find('\n', at) - begin) + "\n";
    }
    const KeyFile file = read(entries);
    EXPECT_THAT(file.problems, IsEmpty()) << entries;
    for (std::size_t i = 0; i < commands.size(); ++i) EXPECT_EQ(file.keys[i], commands[i].keys);
}

TEST(KeyFile, anExistingFileIsNotOverwritten) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "new folder" / "keys.toml";
    ASSERT_TRUE(writeKeyFile(file, commands));
    EXPECT_EQ(tests::contentOf(file), keyFileText(commands));
    std::ofstream(file) << "freeze_lod = \"F3\"\n";
    const auto again = writeKeyFile(file, commands);
    ASSERT_FALSE(again);
    EXPECT_THAT(again.error().message, AllOf(HasSubstr(file.string()), HasSubstr("not overwritten")));
    EXPECT_EQ(tests::contentOf(file), "freeze_lod = \"F3\"\n");
}

TEST(KeyFile, longAndManyEntriesAreNamedShortly) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += std::string(2000, 'a') + std::to_string(i) + " = \"F3\"\n";
    const KeyFile file = read(text);
    ASSERT_EQ(file.problems.size(), 1000u);
    for (const std::string& problem : file.problems) EXPECT_LT(problem.size(), 250u);
}

}  // namespace
}  // namespace worldy
