#include "app/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <span>

#include "planet/atomic_file.h"

namespace worldy {

namespace fs = std::filesystem;

planet::Result<void> writeAtomically(const fs::path& target,
                                     const std::function<planet::Result<void>(const fs::path&)>& write) {
    std::error_code status;
    // The rename would put a file in the place of whatever is there, a device too.
    if (fs::exists(target, status) && !fs::is_regular_file(target, status)) {
        return planet::ioError(fmt::format("{}: is a folder or a device; name a file", target.string()));
    }
    const fs::path temporary =
        target.parent_path() / fmt::format(".worldy-{}{}", ::getpid(), target.extension().string());
    planet::Result<void> written = write(temporary);
    if (written) {
        fs::rename(temporary, target, status);
        if (!status) return {};
        written =
            planet::ioError(fmt::format("{}: cannot be written: {}", target.string(), status.message()));
    }
    fs::remove(temporary, status);
    return written;
}

planet::Result<void> writeTextFile(const fs::path& target, std::string_view text) {
    planet::Result<planet::AtomicFile> file = planet::AtomicFile::create(target);
    if (!file) return tl::unexpected(file.error());
    if (planet::Result<void> written = file->append(std::as_bytes(std::span(text))); !written) return written;
    return file->commit();
}

}  // namespace worldy
