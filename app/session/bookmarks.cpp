#include "app/session/bookmarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/base/toml_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;
using Pose = planet::CameraPose;

constexpr std::size_t longestName = 60;  // bytes

std::vector<ui::Bookmark> shippedBookmarks() {
    return {
        {"Aconcagua", {-32.95, -70.45, 9'000, 48, -10}, true},
        {"Vancouver", {49.12, -123.25, 5'000, 8, -10}, true},
        {"Himalaya", {26.7, 86.5, 22'000, 12, -9}, true},
        {"Andes", {-19.4, -70.9, 24'000, 50, -11}, true},
        {"Grand Canyon", {35.2, -113.0, 22'000, 38, -15}, true},
        {"Mariana Trench", {10.2, 139.6, 330'000, 65, -38}, true},
        {"North Pole", {82.5, -40, 700'000, 0, -44}, true},
        {"South Pole", {-80.5, 60, 900'000, 180, -44}, true},
        // The corner of the faces +x, +y and +z: latitude asin(1/sqrt 3), longitude 45 degrees.
        {"Cube corner", {33.6, 45, 220'000, 0, -50}, true},
    };
}

struct PoseField {
    std::string_view name;
    double Pose::*value;
    NumberRange range;
};
constexpr std::array<PoseField, 5> poseFields = {{
    {"latitude_deg", &Pose::latitudeDeg, {-90, 90, "°"}},
    {"longitude_deg", &Pose::longitudeDeg, {-360, 360, "°"}},
    {"altitude_m", &Pose::altitudeM, {-1e9, 2e10, "m"}},
    {"heading_deg", &Pose::headingDeg, {-360, 360, "°"}},
    {"pitch_deg", &Pose::pitchDeg, {-90, 90, "°"}},
}};

Result<void> readField(const fs::path& file, std::string_view key, const toml::node& node,
                       ui::Bookmark& bookmark) {
    if (key == "name") {
        return readText(file, key, node).map([&](const std::string& name) { bookmark.name = name; });
    }
    for (const PoseField& field : poseFields) {
        if (field.name != key) continue;
        return readNumber(file, key, node, field.range).map([&](double value) {
            bookmark.pose.*field.value = value;
        });
    }
    return planet::badInput(
        fmt::format("{}: {} is unknown; expected name, latitude_deg, longitude_deg, altitude_m, "
                    "heading_deg or pitch_deg",
                    placeOf(file, node), key));
}

Result<ui::Bookmark> readBookmark(const fs::path& file, const toml::table& table) {
    ui::Bookmark bookmark;
    for (const auto& [key, node] : table) {
        if (Result<void> read = readField(file, key.str(), node, bookmark); !read)
            return tl::unexpected(read.error());
    }
    if (bookmark.name.empty() || bookmark.name.size() > longestName) {
        return planet::badInput(fmt::format("{}: name is {}; expected 1 to {} bytes", placeOf(file, table),
                                            bookmark.name.empty() ? "missing" : "too long", longestName));
    }
    for (const PoseField& field : poseFields) {
        if (!table.contains(field.name)) {
            return planet::badInput(fmt::format("{}: {} is missing; expected a number in {}",
                                                placeOf(file, table), field.name, textOf(field.range)));
        }
    }
    return bookmark;
}

Result<std::vector<ui::Bookmark>> readBookmarks(const fs::path& file) {
    const Result<toml::table> document = parseTomlFile(file);
    if (!document) return tl::unexpected(document.error());
    std::vector<ui::Bookmark> own;
    for (const auto& [key, node] : *document) {
        const toml::array* tables = node.as_array();
        if (key.str() != "bookmark" || !tables) {
            return planet::badInput(fmt::format("{}: {} is unknown; expected [[bookmark]] tables",
                                                placeOf(file, node), key.str()));
        }
        for (const toml::node& entry : *tables) {
            const toml::table* table = entry.as_table();
            if (!table) {
                return planet::badInput(
                    fmt::format("{}: not a table; expected [[bookmark]]", placeOf(file, entry)));
            }
            Result<ui::Bookmark> bookmark = readBookmark(file, *table);
            if (!bookmark) return tl::unexpected(bookmark.error());
            own.push_back(std::move(*bookmark));
        }
    }
    return own;
}

Result<void> writeBookmarks(const Bookmarks& bookmarks) {
    std::string text = "# Worldy's bookmarks: places to fly to.\n";
    for (const ui::Bookmark& bookmark : bookmarks.list) {
        if (bookmark.shipped) continue;
        text += fmt::format("\n[[bookmark]]\nname = {}\n", tomlText(bookmark.name));
        for (const PoseField& field : poseFields)
            text += fmt::format("{} = {}\n", field.name, bookmark.pose.*field.value);
    }
    std::error_code status;
    fs::create_directories(fs::absolute(bookmarks.file, status).parent_path(), status);
    return writeTextFile(bookmarks.file, text);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

auto findByName(std::vector<ui::Bookmark>& list, std::string_view name) {
    return std::find_if(list.begin(), list.end(),
                        [&](const ui::Bookmark& bookmark) { return bookmark.name == name; });
}

// Writes a changed copy, and keeps it only if writing succeeds.
Result<void> commit(Bookmarks& bookmarks, Bookmarks&& changed) {
    if (!bookmarks.problem.empty()) {
        return planet::badInput(fmt::format("{}; fix the file or move it away", bookmarks.problem));
    }
    if (Result<void> written = writeBookmarks(changed); !written) return written;
    bookmarks = std::move(changed);
    return {};
}

}  // namespace

fs::path bookmarksFile() {
    return configFolder() / "bookmarks.toml";
}

Bookmarks loadBookmarks(const fs::path& file) {
    Bookmarks bookmarks{file, shippedBookmarks(), {}};
    std::error_code status;
    if (!fs::exists(file, status)) return bookmarks;
    const Result<std::vector<ui::Bookmark>> own = readBookmarks(file);
    if (own)
        bookmarks.list.insert(bookmarks.list.end(), own->begin(), own->end());
    else
        bookmarks.problem = own.error().message;
    return bookmarks;
}

Result<void> addBookmark(Bookmarks& bookmarks, std::string_view name, const Pose& pose) {
    const std::string_view kept = trimmed(name);
    if (kept.empty() || kept.size() > longestName) {
        return planet::badInput(
            fmt::format("bookmark name: {} bytes; expected 1 to {}", kept.size(), longestName));
    }
    Bookmarks changed = bookmarks;
    const auto found = findByName(changed.list, kept);
    if (found == changed.list.end()) {
        changed.list.push_back({std::string(kept), pose, false});
    } else if (found->shipped) {
        return planet::badInput(fmt::format("the bookmark \"{}\" is built-in; choose another name", kept));
    } else {
        found->pose = pose;
    }
    return commit(bookmarks, std::move(changed));
}

Result<void> removeBookmark(Bookmarks& bookmarks, std::string_view name) {
    Bookmarks changed = bookmarks;
    const auto found = findByName(changed.list, name);
    if (found == changed.list.end() || found->shipped) {
        return planet::badInput(fmt::format("unknown bookmark \"{}\"; expected a user bookmark", name));
    }
    changed.list.erase(found);
    return commit(bookmarks, std::move(changed));
}

}  // namespace worldy
