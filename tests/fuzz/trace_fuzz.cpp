// Fuzzes traces. An input is a stream or, if it does not begin as one, the content of blocks, because the checksums would
// stop most inputs: two bytes with the size of the definitions, two with that of the events, both, and the next block. The
// same bytes are read as a file, and with all that Worldy makes of one.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/trace/trace_history.h"
#include "planet/trace/trace_compare.h"
#include "planet/trace/trace_faults.h"
#include "planet/trace/trace_index.h"
#include "planet/trace/trace_reader.h"
#include "planet/trace/trace_reading.h"
#include "planet/trace/trace_what_if.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/trace_bytes.h"

namespace {

using namespace planet;
using fuzz::require;

std::vector<std::byte> sealed(std::span<const std::byte> input) {
    std::vector<std::byte> stream = test::traceHeader();
    while (input.size() >= 4) {
        const auto sizeAt = [&](std::size_t at) {
            return std::size_t{readLittleEndian<std::uint16_t>(input.data() + at)};
        };
        const std::size_t definitions = std::min(sizeAt(0), input.size() - 4);
        const std::size_t events = std::min(sizeAt(2), input.size() - 4 - definitions);
        const auto first = input.subspan(4, definitions), second = input.subspan(4 + definitions, events);
        const auto block = test::traceBlock({first.begin(), first.end()}, {second.begin(), second.end()});
        stream.insert(stream.end(), block.begin(), block.end());
        input = input.subspan(4 + definitions + events);
    }
    return stream;
}

struct Outcome {
    std::size_t events = 0;
    std::string problem;
    bool operator==(const Outcome&) const = default;
};

// Reads a stream in pieces, with all that is built on its events.
Outcome read(std::span<const std::byte> stream, std::size_t piece) {
    Outcome outcome;
    TraceState state;
    TraceFaultFinder finder({.maxFaults = 100});
    TraceReader reader("fuzzed", [&](const TraceEvent& event) {
        ++outcome.events;
        if (state.add(event)) finder.add(state);
    });
    Result<void> result;
    for (std::size_t at = 0; at < stream.size() && result; at += piece)
        result = reader.feed(stream.subspan(at, std::min(piece, stream.size() - at)));
    if (result) result = reader.finish();
    if (!fuzz::isRead(result)) outcome.problem = result.error().message;
    finder.finish(state);
    for (const TraceFault& fault : finder.faults())
        require(!fault.sentence.empty(), "a fault has a sentence");
    require(finder.faults().size() <= 100, "the faults are limited");
    return outcome;
}

// A file in memory.
class InputFile {
public:
    explicit InputFile(std::span<const std::byte> bytes) : descriptor_(memfd_create("fuzzed", MFD_CLOEXEC)) {
        require(descriptor_ >= 0, "there is a file in memory");
        require(write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
                "the file takes the bytes");
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile() { close(descriptor_); }
    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

// Reads a stream as a file, as the panels and the command line do: history, report, selections and a comparison with itself.
void readAsFile(std::span<const std::byte> stream) {
    const InputFile input(stream);
    Result<TraceFile> file = TraceFile::open(input.path());
    if (!fuzz::isRead(file)) return;
    TraceState state;
    worldy::TraceHistorian historian;
    std::uint64_t frames = 0;
    const Result<TraceEnd> end = readTrace(*file, {}, [&](const TraceEvent& event) {
        if (!state.add(event)) return;
        historian.add(state);
        ++frames;
    });
    if (end) {
        const auto history = historian.history(state, true);
        require(std::ranges::is_sorted(history->samples, {}, &worldy::TracedSample::timeS),
                "the samples are ordered by time");
        require(history->report.frames == frames, "the report counts the frames");
    }
    TraceSelectorSettings settings;
    settings.tauPx = 1;
    settings.residency = TraceResidency::Disk;
    settings.budgetBytes = 1000;
    const auto whatIf = whatIfOfTrace(*file, {&settings, 1});
    if (whatIf) require(whatIf->frames == frames, "the selection sees the frames");
    Result<TraceFile> other = TraceFile::open(input.path());
    const auto compared = compareTraces(*file, *other, {.match = TraceMatch::Number});
    if (compared) require(compared->framesThatDiffer == 0, "a trace agrees with itself");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = fuzz::bytesOf(data, size);
    const bool isStream = fuzz::textOf(data, size).starts_with("LODTRACE");
    const auto stream = isStream ? std::vector(bytes.begin(), bytes.end()) : sealed(bytes);
    const Outcome whole = read(stream, std::max<std::size_t>(stream.size(), 1));
    require(read(stream, 61) == whole, "pieces give the same");
    readAsFile(stream);
    return 0;
}
