// Modules that are built with Worldy and loaded when they are needed.
#pragma once

#include <string>

#include "planet/base/result.h"

namespace worldy {

// Loads a module that lies beside the program, as it is built, or in the folder of installed libraries, and returns the
// object that it exports under a name. It is never closed. purpose: what it is for, after "expected the module that".
// isGlobal: other libraries that it loads need its symbols.
planet::Result<const void*> loadModule(const char* file, const char* object, const char* purpose,
                                       bool isGlobal = false);

// Returns the Error of a module that belongs to another build.
planet::Error otherBuild(const char* file, const std::string& version);

}  // namespace worldy
