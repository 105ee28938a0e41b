#include "planet/raster/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "planet/base/try.h"

namespace planet {

Result<std::shared_ptr<const OpenFile>> createTemporaryFile(const FileCalls& calls) {
    std::error_code problem;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(problem);
    if (problem) return ioError(fmt::format("no temporary folder: {}", problem.message()));
    const std::string name = "temporary file in " + folder.string();
    int descriptor = uninterrupted(
        [&] { return calls.open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR); });
    if (descriptor < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL)) {
        std::string named = (folder / "planet-heights-XXXXXX").string();
        descriptor = uninterrupted([&] { return ::mkostemp(named.data(), O_CLOEXEC); });
        if (descriptor >= 0 && calls.unlink(named.c_str()) != 0) {
            const std::string why = lastSystemError();
            calls.close(descriptor);
            return ioError(fmt::format("{}: cannot be removed: {}", named, why));
        }
    }
    if (descriptor < 0) return ioError(fmt::format("{}: cannot be created: {}", name, lastSystemError()));
    return std::make_shared<const OpenFile>(descriptor, name, calls);
}

Result<TemporarySpace::Room> TemporarySpace::take(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    if (!file_) {
        TRY_ASSIGN(file_, createTemporaryFile(calls_));
    }
    return Room{file_, std::exchange(taken_, taken_ + bytes)};
}

}  // namespace planet
