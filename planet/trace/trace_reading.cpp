#include "planet/trace/trace_reading.h"

#include "planet/base/try.h"

namespace planet {

bool TraceBlocks::next(const TraceDecoder::Sink& sink) {
    Result<bool> more = file_.next(sink);
    if (more && !*more) more = file_.nextCut(sink);
    if (more) return *more;
    end_ = {more.error().message, true};
    return false;
}

Result<TraceEnd> readTrace(TraceFile& file, const std::function<bool()>& goOn, const TraceDecoder::Sink& sink,
                           const std::function<void()>& blockEnded) {
    TraceBlocks blocks(file);
    TRY(blocks.begin(sink));
    for (;;) {
        if (goOn && !goOn()) return cancelled();
        if (!blocks.next(sink)) return blocks.end();
        if (blockEnded) blockEnded();
    }
}

}  // namespace planet
