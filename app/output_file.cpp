#include "app/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <system_error>
#include <vector>

#include "planet/atomic_file.h"
#include "planet/open_file.h"

namespace worldy {

namespace fs = std::filesystem;

namespace {

planet::Result<void> copyInto(planet::AtomicFile& file, const fs::path& from) {
    constexpr std::size_t pieceBytes = std::size_t{1} << 20;
    std::error_code status;
    std::uintmax_t left = fs::file_size(from, status);
    if (status)
        return planet::ioError(fmt::format("{}: cannot be read: {}", from.string(), status.message()));
    const auto opened = planet::OpenFile::open(from, O_RDONLY, planet::systemFileCalls());
    if (!opened) return tl::unexpected(opened.error());
    std::vector<std::byte> piece;
    while (left > 0) {
        piece.resize(static_cast<std::size_t>(std::min<std::uintmax_t>(left, pieceBytes)));
        if (auto read = opened->read(file.size(), piece); !read) return read;
        if (auto written = file.append(piece); !written) return written;
        left -= piece.size();
    }
    return {};
}

}  // namespace

planet::Result<void> writeAtomically(const fs::path& target,
                                     const std::function<planet::Result<void>(const fs::path&)>& write) {
    // From here on no other may write the target, nor what is written beside it.
    planet::Result<planet::AtomicFile> file = planet::AtomicFile::create(target);
    if (!file) return tl::unexpected(file.error());
    const fs::path temporary =
        target.parent_path() / fmt::format(".{}.new{}", target.stem().string(), target.extension().string());
    planet::Result<void> written = write(temporary);
    if (written) written = copyInto(*file, temporary);
    std::error_code status;
    fs::remove(temporary, status);
    return written ? file->commit() : written;
}

planet::Result<void> writeTextFile(const fs::path& target, std::string_view text) {
    planet::Result<planet::AtomicFile> file = planet::AtomicFile::create(target);
    if (!file) return tl::unexpected(file.error());
    if (planet::Result<void> written = file->append(std::as_bytes(std::span(text))); !written) return written;
    return file->commit();
}

}  // namespace worldy
