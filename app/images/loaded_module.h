// Calls functions of the modules of image_functions.h, and loads a module at the first call. Any thread.
#pragma once

#include <string>
#include <string_view>

#include "app/base/module.h"
#include "app/images/image_functions.h"

namespace worldy {

// Returns the functions of a module. It is never closed, because open sources have functions of it. file: its name.
// object: what it exports. purpose: for the Error, as in loadModule.
// version: the program's.
template <class Functions>
planet::Result<const Functions*> loadFunctions(const char* file, const char* object, const char* purpose,
                                               std::string_view version) {
    const planet::Result<const void*> found = loadModule(file, object, purpose);
    if (!found) return tl::unexpected(found.error());
    const auto* const module = static_cast<const FunctionModule<Functions>*>(*found);
    if (module->build != ModuleBuild{version})
        return tl::unexpected(otherBuild(file, std::string(module->build.version)));
    return &module->functions;
}

// Returns the functions of worldy_images.so, or the Error that says why it cannot be loaded.
const planet::Result<const ImageFunctions*>& images();

// Calls a function of a module that returns a Result.
template <class Functions, class Function, class... Arguments>
auto callIn(const planet::Result<const Functions*>& module, Function Functions::*function,
            Arguments&&... arguments) {
    using Returned = decltype(((*module)->*function)(arguments...));
    if (!module) return Returned(tl::unexpected(module.error()));
    return ((*module)->*function)(arguments...);
}

// Calls one that returns a bool, which is false without the module.
template <class Functions, class Function, class... Arguments>
bool askIn(const planet::Result<const Functions*>& module, Function Functions::*function,
           const Arguments&... arguments) {
    return module && ((*module)->*function)(arguments...);
}

}  // namespace worldy
