// A trial by hand of a long live trace: an engine draws 1,000 nodes in each of 60 frames a second, a TraceLink writes them
// into a file, and a TraceFile follows the file as a window would.
//
//   live_trial [SECONDS [RING_MIB]]
//
// SECONDS: 600. RING_MIB: the engine's ring, a power of two; 1, which holds half a second. A machine that lets the engine's
// writer thread wait for longer needs more. Prints a line each 10 s, and at the end whether every frame came whole, whether
// the file has the bytes that the engine sent and the nodes that it drew, and whether memory grew. Exits with 1 if not, and
// then keeps the file. The latency is from the end of a frame until it was read from the file.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/base/process_memory.h"
#include "planet/base/percentile.h"
#include "planet/trace/lod_trace.h"
#include "planet/trace/trace_index.h"
#include "planet/trace/trace_link.h"
#include "planet/trace/trace_state.h"

namespace {

using namespace planet;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t nodeCount = 20'000;
constexpr std::uint64_t drawnCount = 1000;
constexpr double framesPerS = 60;
constexpr std::size_t allowedGrowth = std::size_t{1}
                                      << 20;  // of the heap after the first tenth of the time, bytes

// Returns the node that the frame draws as its i-th one. They move on by 3 nodes in a frame.
std::uint64_t drawnNode(std::uint64_t frame, std::uint64_t i) {
    return 1 + (3 * frame + 2 * i) % nodeCount;
}

lod_trace_node_info nodeOf(std::uint64_t id) {
    lod_trace_node_info node{};
    node.id = id;
    node.has_parent = id > 1;
    node.parent = (id + 2) / 4;
    node.bounds = LOD_TRACE_BOUNDS_SPHERE;
    node.centre[0] = static_cast<double>(id);
    node.radius = 10;
    node.error = 1.0 / static_cast<double>(id);
    return node;
}

// Draws frames at a steady pace until the time is over.
void runEngine(lod_trace* trace, double seconds) {
    for (std::uint64_t id = 1; id <= nodeCount; ++id) {
        const lod_trace_node_info node = nodeOf(id);
        while (lod_trace_node(trace, &node) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    lod_trace_setting(trace, LOD_TRACE_TAU, 2);
    while (lod_trace_listening(trace) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lod_trace_flush(trace, 60'000);  // the nodes leave the ring
    const auto start = Clock::now();
    const auto frames = static_cast<std::uint64_t>(seconds * framesPerS);
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        const double timeS = static_cast<double>(frame) / framesPerS;
        lod_trace_frame_begin(trace, timeS);
        lod_trace_view_info view{};
        view.eye[0] = timeS;
        for (int i = 0; i < 4; ++i) view.view[5 * i] = view.projection[5 * i] = 1;
        view.viewport[2] = 1280;
        view.viewport[3] = 720;
        lod_trace_view(trace, 0, &view);
        for (std::uint64_t i = 0; i < drawnCount; ++i) {
            const float morph = i % 10 == 0 ? 0.5f : 0;
            lod_trace_drawn(trace, 0, drawnNode(frame, i), morph);
        }
        lod_trace_requested(trace, drawnNode(frame, 0), 0, 1);
        lod_trace_arrived(trace, drawnNode(frame, 0), 0);
        lod_trace_evicted(trace, drawnNode(frame, 1), 0);
        lod_trace_counter(trace, "triangles", static_cast<double>(frame));
        lod_trace_frame_end(trace, 4, 4);
        std::this_thread::sleep_until(
            start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeS)));
    }
    lod_trace_flush(trace, 60'000);
}

// Reads the file while it grows, and checks each frame.
struct Follower {
    explicit Follower(TraceFile opened) : file(std::move(opened)) {}

    void follow() {
        if (!file.refresh()) ++wrong;
        const auto take = [this](const TraceEvent& event) {
            if (state.add(event)) check(state.frame());
        };
        for (;;) {
            const auto next = file.next(take);
            if (!next) ++wrong;
            if (!next || !*next) return;
        }
    }
    void check(const TraceFrame& frame) {
        ++frames;
        latenciesMs.push_back(static_cast<double>(lod_trace_now_ns() - frame.endNs) / 1e6);
        bool isRight = frame.isComplete() && frame.number == frames && frame.views.size() == 1 &&
                       frame.views[0].drawn.size() == drawnCount;
        for (std::uint64_t i = 0; isRight && i < drawnCount; ++i)
            isRight = state.nodes()[frame.views[0].drawn[i].node].node.id == drawnNode(frame.number, i);
        if (!isRight) ++wrong;
    }

    TraceFile file;
    TraceState state;
    std::uint64_t frames = 0;
    std::uint64_t wrong = 0;
    std::vector<double> latenciesMs;
};

double mib(std::size_t bytes) {
    return static_cast<double>(bytes) / (1 << 20);
}

int fail(const std::string& why) {
    fmt::print(stderr, "live_trial: {}\n", why);
    return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : 600;
    lod_trace_options options{};
    if (argc > 2) options.ring_bytes = static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)) << 20;
    std::string folder = (std::filesystem::temp_directory_path() / "live-trial-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) return fail("no temporary folder");
    char error[512];
    lod_trace* trace = lod_trace_open("tcp:127.0.0.1:0", &options, error, sizeof error);
    if (trace == nullptr) return fail(error);
    TraceLinkSettings settings;
    settings.port = lod_trace_port(trace);
    settings.folder = folder;
    const auto link = TraceLink::start(settings);
    if (!link) return fail(link.error().message);

    const auto start = Clock::now();
    const auto elapsedS = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    std::atomic<bool> isDone = false;
    std::thread engine([&] {
        runEngine(trace, seconds);
        isDone = true;
    });
    while ((*link)->status().files == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    auto opened = TraceFile::open((*link)->status().file.path);
    if (!opened) return fail(opened.error().message);
    Follower follower(*std::move(opened));
    // So that it does not grow below.
    follower.latenciesMs.reserve(static_cast<std::size_t>(seconds * framesPerS) + 1);
    std::fill_n(std::back_inserter(follower.latenciesMs), follower.latenciesMs.capacity(), 0.0);
    follower.latenciesMs.clear();
    // The reader of the file keeps a list of its blocks, which grows with the file.
    const auto heapBytes = [&] {
        return worldy::heapBytesInUse() - follower.file.blocks().capacity() * sizeof(TraceBlock);
    };
    std::size_t warmBytes = 0;
    std::size_t mostBytes = 0;
    double nextLineS = 10;
    while (!isDone) {
        follower.follow();
        const std::size_t heap = heapBytes();
        if (elapsedS() < seconds / 10) warmBytes = std::max(warmBytes, heap);
        mostBytes = std::max(mostBytes, heap);
        if (elapsedS() >= nextLineS) {
            const TraceLinkStatus status = (*link)->status();
            fmt::print("{:6.0f} s: {} frames, {:.1f} MiB, {} dropped, {:.2f} MiB resident\n", elapsedS(),
                       status.frames, mib(status.bytes), lod_trace_get_stats(trace).dropped,
                       mib(worldy::residentProcessBytes()));
            std::fflush(stdout);
            nextLineS += 10;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    engine.join();
    const lod_trace_stats stats = lod_trace_get_stats(trace);
    while ((*link)->status().bytes < stats.bytes && elapsedS() < seconds + 60)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    follower.follow();
    lod_trace_close(trace);
    (*link)->stop();
    const TraceLinkStatus status = (*link)->status();

    const auto expected = static_cast<std::uint64_t>(seconds * framesPerS);
    const std::uint64_t fileBytes = std::filesystem::file_size(status.file.path);
    std::vector<double>& latencies = follower.latenciesMs;
    fmt::print("frames: {} drawn, {} in the file, {} wrong; the engine dropped {} events\n", expected,
               follower.frames, follower.wrong, stats.dropped);
    fmt::print("bytes: {} sent, {} in {}, {:.1f} KiB/s\n", stats.bytes, fileBytes, status.file.path.string(),
               static_cast<double>(fileBytes) / 1024 / seconds);
    fmt::print("latency: median {:.1f} ms, 99 % at most {:.1f} ms, largest {:.1f} ms\n",
               percentileOf(latencies, 0.5), percentileOf(latencies, 0.99), percentileOf(latencies, 1));
    fmt::print("heap: at most {:.2f} MiB in the first tenth, {:.2f} MiB later, and a list of {} blocks\n",
               mib(warmBytes), mib(mostBytes), follower.file.blocks().size());
    const bool isWhole = follower.frames == expected && follower.wrong == 0 && stats.dropped == 0 &&
                         fileBytes == stats.bytes && status.files == 1;
    if (!isWhole) return fail("the trace is not what the engine sent");
    if (mostBytes > warmBytes + allowedGrowth) return fail("memory grew");
    std::filesystem::remove_all(folder);
    return EXIT_SUCCESS;
}
