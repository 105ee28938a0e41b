#include "app/base/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "planet/base/installed_file.h"

namespace worldy {

planet::Result<const void*> loadModule(const char* file, const char* object, const char* purpose,
                                       bool isGlobal) {
    const std::filesystem::path path = planet::installedFile(file);
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
                        planet::installedFile(file).string(), version, WORLDY_VERSION)};
}

}  // namespace worldy
