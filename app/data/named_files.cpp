#include "app/data/named_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/text.h"
#include "app/base/utf8.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::size_t maxNameBytes = 60;
constexpr std::string_view ending = ".toml";

// Lower-cases ASCII letters, which is enough to detect clashes on file systems that ignore case.
std::string lowered(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), lowerAscii);
    return lower;
}

bool isControl(char letter) {
    return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F;
}

tl::unexpected<planet::Error> wrongName(std::string_view name, std::string_view why) {
    return planet::badInput(fmt::format("name \"{:.80}\": {}", name, why));
}

void addFiles(const fs::path& folder, bool shipped, std::vector<NamedFile>& files) {
    std::error_code status;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
        const std::string file = entry.path().filename().string();
        // Hidden files are unfinished or belong to an editor.
        if (!file.ends_with(ending) || file.starts_with('.') || !isUtf8(file)) continue;
        files.push_back({file.substr(0, file.size() - ending.size()), entry.path(), shipped});
    }
}

}  // namespace

planet::Error unknownName(std::string_view name, const NamedFolders& folders, std::string_view what) {
    return {planet::ErrorKind::BadInput, fmt::format("unknown {} \"{:.80}\"; expected one in {} or {}", what,
                                                     name, folders.own.string(), folders.shipped.string())};
}

Result<void> checkFileName(std::string_view name) {
    if (name.empty()) return planet::badInput("name: empty; expected letters, digits and spaces");
    if (name.size() > maxNameBytes)
        return wrongName(name, fmt::format("{} bytes; expected 1 to {}", name.size(), maxNameBytes));
    if (!isUtf8(name)) return planet::badInput("name: not UTF-8; expected UTF-8 text");
    if (std::any_of(name.begin(), name.end(), isControl))
        return planet::badInput("name: contains control characters; expected printable text");
    if (name.find_first_of("/\\:*?\"<>|") != std::string_view::npos)
        return wrongName(name, "contains one of / \\ : * ? \" < > |; expected none of them");
    if (std::string_view(". ").find(name.front()) != std::string_view::npos ||
        std::string_view(". ").find(name.back()) != std::string_view::npos) {
        return wrongName(name, "begins or ends with a dot or a space; expected neither");
    }
    return {};
}

bool areSameName(std::string_view a, std::string_view b) {
    return lowered(a) == lowered(b);
}

std::vector<NamedFile> namedFiles(const NamedFolders& folders) {
    std::vector<NamedFile> files;
    addFiles(folders.shipped, true, files);
    const std::size_t shipped = files.size();
    addFiles(folders.own, false, files);
    for (std::size_t i = shipped; i < files.size(); ++i) {
        files[i].isHidden =
            std::any_of(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(shipped),
                        [&](const NamedFile& one) { return areSameName(one.name, files[i].name); });
    }
    std::stable_sort(files.begin(), files.end(), [](const NamedFile& a, const NamedFile& b) {
        return std::pair(!a.shipped, lowered(a.name)) < std::pair(!b.shipped, lowered(b.name));
    });
    return files;
}

Result<fs::path> fileToWrite(const NamedFolders& folders, std::string_view name, std::string_view what) {
    if (Result<void> good = checkFileName(name); !good) return tl::unexpected(good.error());
    const std::vector<NamedFile> files = namedFiles(folders);
    const auto present = std::find_if(files.begin(), files.end(),
                                      [&](const NamedFile& file) { return areSameName(file.name, name); });
    if (present != files.end() && present->shipped) {
        return wrongName(
            name,
            fmt::format("a built-in {} has that name and cannot be replaced; expected another name", what));
    }
    std::error_code status;
    fs::create_directories(folders.own, status);
    return present != files.end() ? present->file : folders.own / (std::string(name) + std::string(ending));
}

Result<void> deleteNamed(const NamedFile& file, std::string_view what) {
    if (file.shipped) {
        return planet::badInput(
            fmt::format("The {} \"{}\" is built-in and cannot be deleted", what, file.name));
    }
    std::error_code status;
    fs::remove(file.file, status);
    if (!status) return {};
    return planet::ioError(fmt::format("{}: cannot be deleted: {}", file.file.string(), status.message()));
}

}  // namespace worldy
