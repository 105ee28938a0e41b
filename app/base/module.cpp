#include "app/base/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace worldy {

namespace {

std::filesystem::path modulePath(const char* file) {
    std::error_code status;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", status);
    const std::filesystem::path folder = program.parent_path();
    const std::filesystem::path installed = folder / WORLDY_MODULES / file;
    return std::filesystem::exists(installed, status) ? installed.lexically_normal() : folder / file;
}

}  // namespace

planet::Result<const void*> loadModule(const char* file, const char* object, const char* purpose,
                                       bool isGlobal) {
    const std::filesystem::path path = modulePath(file);
    void* const handle = ::dlopen(path.c_str(), RTLD_LAZY | (isGlobal ? RTLD_GLOBAL : RTLD_LOCAL));
    const void* const found = handle ? ::dlsym(handle, object) : nullptr;
    if (found) return found;
    return planet::ioError(fmt::format("{}: cannot be loaded: {}; expected the module that {}", path.string(),
                                       ::dlerror(), purpose));
}

planet::Error otherBuild(const char* file, const std::string& version) {
    return {planet::ErrorKind::Io,
            fmt::format("{}: belongs to another build of Worldy, of version {}; expected the one "
                        "of this build, of version {}",
                        modulePath(file).string(), version, WORLDY_VERSION)};
}

}  // namespace worldy
