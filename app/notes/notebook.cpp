#include "app/notes/notebook.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <utility>

#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/base/toml_file.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::size_t mostFileBytes = 64u << 20;
constexpr std::size_t longestWord = 60;  // bytes of "about" and "created"
constexpr int mostSessionFiles = 100;

struct NumberField {
    std::string_view key;
    double& (*of)(Note&);
    NumberRange range;
};
constexpr std::array<NumberField, 8> numberFields = {{
    {"latitude_deg", [](Note& n) -> double& { return n.latitudeDeg; }, {-90, 90, "°"}},
    {"longitude_deg", [](Note& n) -> double& { return n.longitudeDeg; }, {-360, 360, "°"}},
    {"height_m", [](Note& n) -> double& { return n.heightM; }, {-1e9, 2e10, "m"}},
    {"camera_latitude_deg", [](Note& n) -> double& { return n.camera.latitudeDeg; }, {-90, 90, "°"}},
    {"camera_longitude_deg", [](Note& n) -> double& { return n.camera.longitudeDeg; }, {-360, 360, "°"}},
    {"camera_altitude_m", [](Note& n) -> double& { return n.camera.altitudeM; }, {-1e9, 2e10, "m"}},
    {"camera_heading_deg", [](Note& n) -> double& { return n.camera.headingDeg; }, {-360, 360, "°"}},
    {"camera_pitch_deg", [](Note& n) -> double& { return n.camera.pitchDeg; }, {-90, 90, "°"}},
}};

struct TextField {
    std::string_view key;
    std::string Note::*text;
    std::size_t most;  // bytes
    bool needed;
};
constexpr std::array<TextField, 5> textFields = {{
    {"text", &Note::text, longestNoteBytes, true},
    {"about", &Note::about, longestWord, true},
    {"created", &Note::created, longestWord, true},
    {"chunk", &Note::chunk, longestWord, false},
    {"measurement", &Note::measurement, longestNoteBytes, false},
}};

Result<void> readValue(const fs::path& file, std::string_view key, const toml::node& node, Note& note) {
    if (key == "id") {
        const Result<std::int64_t> id = readInteger(file, key, node, {1, 1e15, ""});
        if (!id) return tl::unexpected(id.error());
        note.id = static_cast<std::uint64_t>(*id);
        return {};
    }
    for (const NumberField& field : numberFields) {
        if (field.key != key) continue;
        return readNumber(file, key, node, field.range).map([&](double value) { field.of(note) = value; });
    }
    for (const TextField& field : textFields) {
        if (field.key != key) continue;
        const Result<std::string> text = readText(file, key, node);
        if (!text) return tl::unexpected(text.error());
        if (text->empty() || text->size() > field.most)
            return planet::badInput(fmt::format("{}: {} has {} bytes; expected 1 to {}", placeOf(file, node),
                                                key, text->size(), field.most));
        note.*field.text = *text;
        return {};
    }
    return planet::badInput(
        fmt::format("{}: {} is unknown; expected id, text, about, created, a place (latitude_deg, "
                    "longitude_deg, height_m), a view "
                    "(camera_latitude_deg, ...), chunk or measurement",
                    placeOf(file, node), key));
}

Result<Note> readNote(const fs::path& file, const toml::table& table) {
    Note note;
    for (const auto& [key, node] : table) {
        if (Result<void> read = readValue(file, key.str(), node, note); !read)
            return tl::unexpected(read.error());
    }
    const auto missing = [&](std::string_view key) {
        return planet::badInput(
            fmt::format("{}: {} is missing; expected it in each [[note]]", placeOf(file, table), key));
    };
    if (!table.contains("id")) return missing("id");
    for (const NumberField& field : numberFields)
        if (!table.contains(field.key)) return missing(field.key);
    for (const TextField& field : textFields)
        if (field.needed && !table.contains(field.key)) return missing(field.key);
    if (!note.chunk.empty() && !planet::chunkIdFromString(note.chunk))
        return planet::badInput(
            fmt::format("{}: chunk: {} is no chunk; expected face/level/x/y, for example "
                        "y_pos/4/6/13",
                        placeOf(file, table), note.chunk));
    return note;
}

Result<std::vector<Note>> readNotes(const fs::path& file, const toml::table& document) {
    std::vector<Note> notes;
    std::set<std::uint64_t> ids;
    for (const auto& [key, node] : document) {
        if (key.str() == "format") {
            if (const auto format = readInteger(file, "format", node, {1, 1, ""}); !format)
                return tl::unexpected(format.error());
            continue;
        }
        const toml::array* tables = node.as_array();
        if (key.str() != "note" || !tables)
            return planet::badInput(fmt::format("{}: {} is unknown; expected format = 1 and [[note]] tables",
                                                placeOf(file, node), key.str()));
        if (tables->size() > mostNotes)
            return planet::badInput(fmt::format("{}: {} notes; expected at most {}", placeOf(file, node),
                                                tables->size(), mostNotes));
        for (const toml::node& entry : *tables) {
            const toml::table* table = entry.as_table();
            if (!table)
                return planet::badInput(
                    fmt::format("{}: not a table; expected [[note]]", placeOf(file, entry)));
            Result<Note> note = readNote(file, *table);
            if (!note) return tl::unexpected(note.error());
            if (!ids.insert(note->id).second)
                return planet::badInput(fmt::format("{}: id {} is there twice; expected each once",
                                                    placeOf(file, *table), note->id));
            notes.push_back(std::move(*note));
        }
    }
    return notes;
}

// Reads a file that exists.
Result<std::vector<Note>> readFile(const fs::path& file) {
    const Result<toml::table> document = parseTomlFile(file);
    if (!document) return tl::unexpected(document.error());
    return readNotes(file, *document);
}

std::string textOnDisk(const fs::path& file) {
    return startOfFile(file, mostFileBytes);
}

bool isThere(const fs::path& file) {
    std::error_code status;
    return fs::exists(file, status) || fs::is_symlink(fs::symlink_status(file, status));
}

bool isSame(const Note& a, const Note& b) {
    return a.text == b.text && a.created == b.created && a.latitudeDeg == b.latitudeDeg &&
           a.longitudeDeg == b.longitudeDeg;
}

// Appends notes of another file that are not there yet. Their ids may be taken.
void join(std::vector<Note>& notes, std::vector<Note> others) {
    std::uint64_t next = 1;
    for (const Note& note : notes) next = std::max(next, note.id + 1);
    std::erase_if(others, [&](const Note& other) {
        return std::any_of(notes.begin(), notes.end(), [&](const Note& note) { return isSame(note, other); });
    });
    for (Note& other : others) {
        other.id = next++;
        notes.push_back(std::move(other));
    }
}

fs::path sessionFile(const fs::path& file, int number) {
    fs::path path = file;
    path.replace_extension();  // "planet.notes"
    path += number == 1 ? ".session.toml" : fmt::format(".session-{}.toml", number);
    return path;
}

// Chooses the second file: the first one that can be read, or the first name that is free. Takes its notes.
void useSessionFile(Notebook& notebook) {
    for (int number = 1; number <= mostSessionFiles; ++number) {
        const fs::path path = sessionFile(notebook.file, number);
        if (!isThere(path)) {
            notebook.writesTo = path;
            notebook.keptText.clear();
            return;
        }
        Result<std::vector<Note>> notes = readFile(path);
        if (!notes) continue;
        notebook.writesTo = path;
        notebook.keptText = textOnDisk(path);
        join(notebook.notes, std::move(*notes));
        return;
    }
    notebook.writesTo = sessionFile(notebook.file, mostSessionFiles);
}

Result<void> write(Notebook& notebook) {
    std::error_code status;
    if (const fs::path folder = notebook.writesTo.parent_path(); !folder.empty())
        fs::create_directories(folder, status);
    const std::string text = notesText(notebook.notes);
    if (Result<void> written = writeTextFile(notebook.writesTo, text); !written) return written;
    notebook.keptText = text;
    return {};
}

// Moves the notes of the second file, which are the notebook's, into the first file, which holds `notes`.
Result<void> joinSession(Notebook& notebook, std::vector<Note> notes) {
    Notebook joined = notebook;
    const fs::path second = notebook.writesTo;
    joined.notes = std::move(notes);
    join(joined.notes, notebook.notes);
    joined.writesTo = joined.file;
    joined.problem.clear();
    if (!notebook.notes.empty()) {
        if (Result<void> written = write(joined); !written) return written;
    } else {
        joined.keptText = textOnDisk(joined.file);
    }
    std::error_code status;
    if (second != joined.file) fs::remove(second, status);
    notebook = std::move(joined);
    return {};
}

void meetBrokenFile(Notebook& notebook, const planet::Error& error) {
    notebook.problem = error.message;
    notebook.brokenText = textOnDisk(notebook.file);
    useSessionFile(notebook);
}

// Reads the file again if another program has changed it.
void refresh(Notebook& notebook) {
    const std::string text = textOnDisk(notebook.writesTo);
    if (text == notebook.keptText || !isThere(notebook.writesTo)) return;
    Result<std::vector<Note>> notes = readFile(notebook.writesTo);
    if (!notes) return meetBrokenFile(notebook, notes.error());
    notebook.notes = std::move(*notes);
    notebook.keptText = text;
}

using Change = std::function<Result<void>(std::vector<Note>&)>;

// Changes a copy, and keeps it only if it can be written.
Result<void> commit(Notebook& notebook, const Change& change) {
    if (notebook.file.empty())
        return planet::badInput("no planet is open; expected one to write notes about");
    Notebook changed = notebook;
    refresh(changed);
    if (Result<void> done = change(changed.notes); !done) return done;
    if (Result<void> written = write(changed); !written) return written;
    notebook = std::move(changed);
    return {};
}

Result<void> checkText(std::string_view text) {
    if (text.empty() || text.size() > longestNoteBytes)
        return planet::badInput(
            fmt::format("note: {} bytes of text; expected 1 to {}", text.size(), longestNoteBytes));
    return {};
}

Result<std::vector<Note>::iterator> find(std::vector<Note>& notes, std::uint64_t id) {
    const auto note =
        std::find_if(notes.begin(), notes.end(), [=](const Note& each) { return each.id == id; });
    if (note == notes.end())
        return planet::badInput(fmt::format("note {}: not found; another program may have deleted it", id));
    return note;
}

bool canWriteIn(const fs::path& folder) {
    return ::access((folder.empty() ? fs::path(".") : folder).c_str(), W_OK) == 0;
}

bool isBelow(const fs::path& path, const fs::path& folder) {
    std::error_code status;
    const fs::path inside = fs::weakly_canonical(path, status),
                   outside = fs::weakly_canonical(folder, status);
    return std::mismatch(outside.begin(), outside.end(), inside.begin(), inside.end()).first == outside.end();
}

// Returns a name for a source without a folder: letters and digits of its text, and a hash of the whole.
std::string nameOf(const fs::path& source) {
    std::string name = source.stem().string().substr(0, 40);
    std::replace_if(
        name.begin(), name.end(),
        [](char letter) {
            return !((letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') ||
                     (letter >= 'a' && letter <= 'z') || letter == '-' || letter == '_');
        },
        '_');
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (const char letter : source.string())
        hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
    return fmt::format("{}-{:08x}", name, hash & 0xffffffffu);
}

}  // namespace

std::string firstWords(const Note& note, std::size_t letters) {
    std::string words;
    std::size_t count = 0;
    for (const char letter : note.text) {
        const bool continues = (static_cast<unsigned char>(letter) & 0xC0u) == 0x80u;  // of a UTF-8 sequence
        if (!continues && count++ == letters) return words + "...";
        if (letter == '\n') return words.size() + 1 < note.text.size() ? words + "..." : words;
        words += static_cast<unsigned char>(letter) < 0x20u ? ' ' : letter;
    }
    return words;
}

fs::path notesFileOf(const fs::path& source, const fs::path& chunkFile) {
    std::error_code status;
    const bool hasSource = fs::exists(source, status);
    const fs::path owner = hasSource ? source : chunkFile;
    const bool isFile = fs::exists(owner, status);
    const fs::path whole = fs::absolute(owner, status).lexically_normal();
    const bool isOurs = !isFile || isBelow(whole, cacheFolder()) || isBelow(whole, dataFolder());
    fs::path beside = whole;
    beside.replace_extension(".notes.toml");
    if (isFile && isThere(beside)) return beside;
    if (!isOurs && canWriteIn(whole.parent_path())) return beside;
    return configFolder() / "notes" /
           (nameOf(hasSource        ? whole
                   : source.empty() ? chunkFile
                                    : source) +
            ".notes.toml");
}

std::string notesText(const std::vector<Note>& notes) {
    std::string text = "# Notes on a planet, by Worldy.\nformat = 1\n";
    for (Note note : notes) {
        text += fmt::format("\n[[note]]\nid = {}\n", note.id);
        for (const TextField& field : textFields)
            if (const std::string& value = note.*field.text; !value.empty())
                text += fmt::format("{} = {}\n", field.key, tomlText(value));
        for (const NumberField& field : numberFields)
            text += fmt::format("{} = {}\n", field.key, field.of(note));
    }
    return text;
}

Result<std::vector<Note>> notesFromText(std::string_view text, const fs::path& file) {
    const Result<toml::table> document = parseTomlText(text, file);
    if (!document) return tl::unexpected(document.error());
    return readNotes(file, *document);
}

Notebook openNotebook(const fs::path& file) {
    Notebook notebook{.file = file, .writesTo = file};
    if (file.empty()) return notebook;
    std::vector<Note> notes;
    if (isThere(file)) {
        Result<std::vector<Note>> read = readFile(file);
        if (!read) {
            meetBrokenFile(notebook, read.error());
            return notebook;
        }
        notes = std::move(*read);
        notebook.keptText = textOnDisk(file);
    }
    // Notes of an earlier session in which the file could not be read.
    Notebook earlier{.file = file, .writesTo = file};
    useSessionFile(earlier);
    if (earlier.notes.empty()) {
        notebook.notes = std::move(notes);
        return notebook;
    }
    if (const Result<void> joined = joinSession(earlier, notes); joined) return earlier;
    notebook.notes = std::move(notes);
    join(notebook.notes, std::move(earlier.notes));
    return notebook;
}

Result<std::uint64_t> addNote(Notebook& notebook, Note note) {
    if (Result<void> good = checkText(note.text); !good) return tl::unexpected(good.error());
    std::uint64_t id = 0;
    const Result<void> done = commit(notebook, [&](std::vector<Note>& notes) -> Result<void> {
        if (notes.size() >= mostNotes)
            return planet::badInput(fmt::format("notes: there are {} already; expected fewer", notes.size()));
        id = 1;
        for (const Note& each : notes) id = std::max(id, each.id + 1);
        note.id = id;
        notes.push_back(std::move(note));
        return {};
    });
    if (!done) return tl::unexpected(done.error());
    return id;
}

Result<void> editNote(Notebook& notebook, std::uint64_t id, std::string_view text) {
    if (Result<void> good = checkText(text); !good) return good;
    return commit(notebook, [&](std::vector<Note>& notes) {
        return find(notes, id).map([&](auto note) { note->text = text; });
    });
}

Result<void> deleteNote(Notebook& notebook, std::uint64_t id) {
    return commit(notebook, [&](std::vector<Note>& notes) {
        return find(notes, id).map([&](auto note) { notes.erase(note); });
    });
}

bool mendNotebook(Notebook& notebook) {
    if (notebook.problem.empty()) return false;
    const std::string text = textOnDisk(notebook.file);
    if (isThere(notebook.file) && text == notebook.brokenText) return false;
    std::vector<Note> notes;
    if (isThere(notebook.file)) {
        Result<std::vector<Note>> read = readFile(notebook.file);
        if (!read) {
            notebook.problem = read.error().message;
            notebook.brokenText = text;
            return false;
        }
        notes = std::move(*read);
    }
    return joinSession(notebook, std::move(notes)).has_value();
}

}  // namespace worldy
