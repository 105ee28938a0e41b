#include "app/notes/notebook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using tests::contentOf;

Note noteOf(const std::string& text) {
    Note note;
    note.text = text;
    note.created = "2026-11-26 16:50";
    note.latitudeDeg = 27.988;
    note.longitudeDeg = 86.925;
    note.heightM = 8848.5;
    note.camera = {27.5, 86.5, 12'000, 12.5, -20};
    note.chunk = "y_pos/4/6/13";
    note.measurement = "gap 3 m";
    return note;
}

class NotebookTest : public testing::Test {
protected:
    void write(const std::filesystem::path& file, const std::string& text) const {
        std::ofstream(file) << text;
    }
    std::string problemOf(const std::string& text) const {
        const auto notes = notesFromText(text, "planet.notes.toml");
        return notes ? "" : notes.error().message;
    }

    tests::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "planet.notes.toml";
    std::filesystem::path session_ = folder_ / "planet.notes.session.toml";
};

TEST_F(NotebookTest, notesOpenAgainAsTheyWere) {
    Notebook written = openNotebook(file_);
    EXPECT_TRUE(written.notes.empty());
    ASSERT_TRUE(addNote(written, noteOf("The ridge \"pops\"\nhere, \u00fcber \u03c4 \\ = 2")));
    ASSERT_TRUE(addNote(written, noteOf("second")));
    const Notebook read = openNotebook(file_);
    EXPECT_EQ(read.problem, "");
    ASSERT_EQ(read.notes.size(), 2u);
    EXPECT_EQ(notesText(read.notes), notesText(written.notes));
    EXPECT_EQ(read.notes[0].text, "The ridge \"pops\"\nhere, \u00fcber \u03c4 \\ = 2");
    EXPECT_EQ(read.notes[0].heightM, 8848.5);
    EXPECT_EQ(read.notes[0].camera.headingDeg, 12.5);
    EXPECT_EQ(read.notes[0].chunk, "y_pos/4/6/13");
    EXPECT_EQ(read.notes[0].id, 1u);
    EXPECT_EQ(read.notes[1].id, 2u);
}

TEST_F(NotebookTest, editsAndDeletesByNumber) {
    Notebook book = openNotebook(file_);
    const auto first = addNote(book, noteOf("first")), second = addNote(book, noteOf("second"));
    ASSERT_TRUE(first && second);
    ASSERT_TRUE(editNote(book, *second, "changed"));
    ASSERT_TRUE(deleteNote(book, *first));
    EXPECT_FALSE(deleteNote(book, *first));
    const Notebook read = openNotebook(file_);
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_EQ(read.notes[0].text, "changed");
    EXPECT_EQ(read.notes[0].id, *second);
}

TEST_F(NotebookTest, anEmptyOrTooLongTextIsRefused) {
    Notebook book = openNotebook(file_);
    EXPECT_FALSE(addNote(book, noteOf("")));
    EXPECT_FALSE(addNote(book, noteOf(std::string(longestNoteBytes + 1, 'x'))));
    EXPECT_TRUE(addNote(book, noteOf(std::string(longestNoteBytes, 'x'))));
    EXPECT_EQ(book.notes.size(), 1u);
}

TEST_F(NotebookTest, errorsNameFileLineAndWhatIsRight) {
    Note numbered = noteOf("text");
    numbered.id = 1;
    const std::string good = notesText({numbered});
    EXPECT_EQ(problemOf(good.substr(0, 0)), "");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return problemOf(text);
    };
    EXPECT_THAT(with("latitude_deg = 27.988", "latitude_deg = 91"),
                testing::AllOf(HasSubstr("planet.notes.toml: line"), HasSubstr("latitude_deg"),
                               HasSubstr("[-90, 90]")));
    EXPECT_THAT(with("text = ", "txt = "), HasSubstr("txt is unknown; expected id, text"));
    EXPECT_THAT(with("id = 1\n", ""), HasSubstr("id is missing"));
    EXPECT_THAT(with("id = 1", "id = \"a\""), HasSubstr("id"));
    EXPECT_THAT(with("y_pos/4/6/13", "y_pos/4/60/13"), HasSubstr("is no chunk; expected face/level/x/y"));
    EXPECT_THAT(with("[[note]]", "[note]"), HasSubstr("expected format = 1 and [[note]] tables"));
    EXPECT_THAT(with("format = 1", "format = 2"), HasSubstr("format"));
    EXPECT_THAT(with("format = 1", "format = ["), HasSubstr("planet.notes.toml: line"));
    EXPECT_THAT(problemOf("note = [1, 2]"), HasSubstr("not a table"));
}

TEST_F(NotebookTest, aNumberTwiceIsRefused) {
    Note note = noteOf("text");
    note.id = 3;
    EXPECT_EQ(problemOf(notesText({note})), "");
    EXPECT_THAT(problemOf(notesText({note, note})), HasSubstr("id 3 is there twice"));
}

TEST_F(NotebookTest, aBrokenFileIsKeptAndNotesGoToASecondOne) {
    write(file_, "format = 1\n[[note]]\nid = oops\n");
    const std::string broken = contentOf(file_);
    Notebook book = openNotebook(file_);
    EXPECT_THAT(book.problem, HasSubstr("planet.notes.toml: line 3"));
    EXPECT_EQ(book.writesTo, session_);
    ASSERT_TRUE(addNote(book, noteOf("of this session")));
    EXPECT_EQ(contentOf(file_), broken);
    // The next session finds them again.
    const Notebook next = openNotebook(file_);
    ASSERT_EQ(next.notes.size(), 1u);
    EXPECT_EQ(next.notes[0].text, "of this session");
    EXPECT_EQ(contentOf(file_), broken);
}

TEST_F(NotebookTest, aMendedFileTakesTheNotesOfTheSecondOne) {
    write(file_, "broken");
    Notebook book = openNotebook(file_);
    ASSERT_TRUE(addNote(book, noteOf("of this session")));
    EXPECT_FALSE(mendNotebook(book));
    Note old = noteOf("old");
    old.id = 1;
    write(file_, notesText({old}));
    EXPECT_TRUE(mendNotebook(book));
    EXPECT_EQ(book.problem, "");
    EXPECT_FALSE(std::filesystem::exists(session_));
    const Notebook read = openNotebook(file_);
    ASSERT_EQ(read.notes.size(), 2u);
    EXPECT_EQ(read.notes[0].text, "old");
    EXPECT_EQ(read.notes[1].text, "of this session");
    EXPECT_EQ(read.notes[1].id, 2u);
}

TEST_F(NotebookTest, aFileMendedBetweenSessionsTakesThemToo) {
    write(file_, "broken");
    Notebook book = openNotebook(file_);
    ASSERT_TRUE(addNote(book, noteOf("of this session")));
    std::filesystem::remove(file_);
    const Notebook read = openNotebook(file_);
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_TRUE(std::filesystem::exists(file_));
    EXPECT_FALSE(std::filesystem::exists(session_));
}

TEST_F(NotebookTest, notesOfAnotherProgramAreKept) {
    Notebook one = openNotebook(file_), other = openNotebook(file_);
    ASSERT_TRUE(addNote(one, noteOf("one")));
    ASSERT_TRUE(addNote(other, noteOf("other")));
    ASSERT_TRUE(addNote(one, noteOf("one more")));
    const Notebook read = openNotebook(file_);
    ASSERT_EQ(read.notes.size(), 3u);
    EXPECT_EQ(read.notes[2].id, 3u);
}

TEST_F(NotebookTest, aFileBrokenWhileOpenLosesNothing) {
    Notebook book = openNotebook(file_);
    ASSERT_TRUE(addNote(book, noteOf("before")));
    write(file_, "broken");
    ASSERT_TRUE(addNote(book, noteOf("after")));
    EXPECT_EQ(contentOf(file_), "broken");
    EXPECT_EQ(book.writesTo, session_);
    EXPECT_EQ(openNotebook(file_).notes.size(), 2u);
}

TEST_F(NotebookTest, theFileLiesBesideWhatTheUserOpened) {
    const std::filesystem::path source = folder_ / "planet.tif",
                                bake = folder_ / "cache" / "worldy" / "planet-12.chk";
    std::filesystem::create_directories(bake.parent_path());
    write(source, "x");
    write(bake, "x");
    EXPECT_EQ(notesFileOf(source, bake), folder_ / "planet.notes.toml");
    EXPECT_EQ(notesFileOf(folder_ / "planet.chk", folder_ / "planet.chk").filename().string().substr(0, 6),
              "planet");
    const std::filesystem::path terrain = notesFileOf("noise:ridged,seed=7", folder_ / "none.chk");
    EXPECT_EQ(terrain.parent_path().filename(), "notes");
    EXPECT_NE(terrain, notesFileOf("noise:ridged,seed=8", folder_ / "none.chk"));
    EXPECT_TRUE(terrain.filename().string().ends_with(".notes.toml"));
}

TEST(Note, firstWordsEndAtALineAndBetweenLetters) {
    Note note;
    note.text = "The ridge pops";
    EXPECT_EQ(firstWords(note, 40), "The ridge pops");
    EXPECT_EQ(firstWords(note, 9), "The ridge...");
    note.text = "One line\nand another";
    EXPECT_EQ(firstWords(note, 40), "One line...");
    note.text = "\u03b5\u03b5\u03b5\u03b5";
    EXPECT_EQ(firstWords(note, 2), "\u03b5\u03b5...");
}

}  // namespace
}  // namespace worldy
