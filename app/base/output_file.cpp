#include "app/base/output_file.h"

#include <fstream>
#include <span>

#include "planet/base/atomic_file.h"

namespace worldy {

planet::Result<void> writeTextFile(const std::filesystem::path& target, std::string_view text) {
    planet::Result<planet::AtomicFile> file = planet::AtomicFile::create(target);
    if (!file) return tl::unexpected(file.error());
    if (planet::Result<void> written = file->append(std::as_bytes(std::span(text))); !written) return written;
    return file->commit();
}

std::string startOfFile(const std::filesystem::path& file, std::size_t bytes) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(file, status)) return {};
    std::string start(bytes, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(start.data(), static_cast<std::streamsize>(bytes));
    start.resize(static_cast<std::size_t>(stream.gcount()));
    return start;
}

}  // namespace worldy
