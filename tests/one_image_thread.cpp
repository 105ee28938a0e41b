// Linked into what the thread sanitizer watches: OpenImageIO decodes in the thread that asks, since it hands
// work to its own threads by means inside its library, which the sanitizer does not see.
#include <OpenImageIO/imageio.h>

namespace {

[[maybe_unused]] const bool alone = OIIO::attribute("threads", 1);

}  // namespace
