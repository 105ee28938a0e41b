#include "app/base/new_file.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "app/base/output_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr int mostOfASecond = 1000;  // entries with the same name except for their number

// Calls create(path) with one name after the other until it succeeds. It returns false with errno set.
template <class Create>
Result<fs::path> newEntry(const fs::path& folder, const std::tm& localTime, std::string_view name,
                          std::string_view ending, const Create& create) {
    std::string stem = fmt::format("worldy {:%Y-%m-%d %H.%M.%S}", localTime);
    if (!name.empty()) stem += fmt::format(" {}", name);
    for (int number = 1; number <= mostOfASecond; ++number) {
        const fs::path path = folder / (number == 1 ? fmt::format("{}{}", stem, ending)
                                                    : fmt::format("{} {}{}", stem, number, ending));
        if (create(path)) return path;
        if (errno != EEXIST) {
            return planet::ioError(fmt::format("{}: cannot be written: {}; expected a writable folder",
                                               folder.string(), std::strerror(errno)));
        }
    }
    return planet::ioError(fmt::format("{}: already contains {} files of this second; expected fewer",
                                       folder.string(), mostOfASecond));
}

}  // namespace

Result<fs::path> newTimedFile(const fs::path& folder, const std::tm& localTime, std::string_view name,
                              std::string_view extension) {
    return newEntry(folder, localTime, name, fmt::format(".{}", extension), [](const fs::path& path) {
        const int descriptor = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (descriptor < 0) return false;
        ::close(descriptor);
        return true;
    });
}

Result<fs::path> newTimedFolder(const fs::path& folder, const std::tm& localTime, std::string_view name) {
    return newEntry(folder, localTime, name, "",
                    [](const fs::path& path) { return ::mkdir(path.c_str(), 0777) == 0; });
}

Result<fs::path> writeNewTextFile(const fs::path& folder, std::string_view name, std::string_view extension,
                                  std::string_view text) {
    Result<fs::path> file = newTimedFile(folder, localTimeNow(), name, extension);
    if (!file) return file;
    if (const Result<void> written = writeTextFile(*file, text); !written) {
        std::error_code status;
        fs::remove(*file, status);  // otherwise an empty file would remain
        return tl::unexpected(written.error());
    }
    return file;
}

std::tm localTimeNow() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    ::localtime_r(&now, &local);
    return local;
}

}  // namespace worldy
