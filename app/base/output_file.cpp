#include "app/base/output_file.h"

#include <span>

#include "planet/base/atomic_file.h"

namespace worldy {

planet::Result<void> writeTextFile(const std::filesystem::path& target, std::string_view text) {
    planet::Result<planet::AtomicFile> file = planet::AtomicFile::create(target);
    if (!file) return tl::unexpected(file.error());
    if (planet::Result<void> written = file->append(std::as_bytes(std::span(text))); !written) return written;
    return file->commit();
}

}  // namespace worldy
