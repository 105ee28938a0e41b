// Creates nameless temporary files. Internal to the library; any thread.
#pragma once

#include <memory>

#include "planet/base/file_calls.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"

namespace planet {

// Creates a file in the system's temporary folder that disappears when it is closed, even if the program is killed. On
// file systems without nameless files it briefly has a name.
Result<std::shared_ptr<const OpenFile>> createTemporaryFile(const FileCalls& calls);

}  // namespace planet
