#include "planet/base/installed_file.h"

#include <system_error>

namespace planet {

std::filesystem::path installedFile(const char* name) {
    std::error_code status;
    const std::filesystem::path folder =
        std::filesystem::read_symlink("/proc/self/exe", status).parent_path();
    const std::filesystem::path installed = folder / WORLDY_MODULES / name;
    return std::filesystem::exists(installed, status) ? installed.lexically_normal() : folder / name;
}

}  // namespace planet
