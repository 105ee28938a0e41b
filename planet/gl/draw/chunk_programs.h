// The programs that draw a planet. Requires a current context. One thread uses it; the worker has its own.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/gl_worker.h"
#include "planet/gl/device/shader_source.h"
#include "planet/gl/draw/drawing_state.h"
#include "planet/gl/draw/shader_switches.h"

namespace planet::gl {

// Each combination of a use and switches is a separate program. All but Chunk depend on few switches.
struct ProgramKey {
    ProgramUse use = ProgramUse::Chunk;
    Switches switches = 0;

    auto operator<=>(const ProgramKey&) const = default;
};

// An output of a vertex shader; all are floats.
struct VertexOutput {
    std::string name;
    std::string type;  // in GLSL
    GLint components = 1;
    bool isFlat = false;
};

// Can be shared by any number of renderers whose contexts share objects.
class ChunkPrograms {
public:
    // Reads the shaders from a folder, or the built-in ones if it is empty. Compiles one program per use, to
    // find errors in the text at once. The worker, if any, can compile the others. The Error names the file.
    static Result<ChunkPrograms> build(const std::filesystem::path& folder,
                                       std::shared_ptr<GlWorker> worker = nullptr);

    // Rereads the shaders and compiles the chunk program used last. On an Error the last valid programs stay.
    Result<void> reload();
    // Counts the successful reloads, for renderers that keep their own programs.
    int reloads() const { return reloads_; }

    // Returns the program, compiling it if needed. If the driver rejects a chunk program, returns the one
    // without switches; for other uses, returns a program with name 0.
    const Program& program(const ProgramKey& key);
    // Counts the programs that program() returned for their first draw.
    std::uint32_t firstDraws() const { return firstDraws_; }

    // Returns whether a worker compiles in the background. The functions from here to nearest() never wait.
    bool canOrder() const;
    // Collects the programs that the worker has finished.
    void takeOrdered();
    bool isOrdered(const ProgramKey& key) const { return ordered_.contains(key); }
    // Makes the worker compile the program and draw with it once in this state. Repeated orders are ignored.
    void order(const ProgramKey& key, const DrawingState& state, Urgency urgency);
    // Returns the program if it has been used in a draw, here or by the worker; else null.
    const Program* ready(const ProgramKey& key) const;
    // Returns the ready chunk program that draws most similarly to one with these switches and reads no
    // texture or table that it does not read; null if none is ready.
    const Program* nearest(Switches switches) const;

    // Compiles a chunk program whose vertex outputs of these names can be captured.
    Result<Program> capturing(Switches switches, std::span<const char* const> outputs) const;
    // Returns the outputs of the chunks' vertex shader, in the order in which it declares them.
    std::vector<VertexOutput> chunkOutputs() const;
    // Compiles a program with the fragment shader of chunks, whose vertices hold the outputs of the vertex shader of chunks
    // as inputs: chunkOutputs(), in this order.
    Result<Program> passingOn(Switches switches) const;

    const Program& faceImage() const { return faceImage_; }
    const Program& clipmapFill() const { return clipmapFill_; }

private:
    struct Texts {
        ShaderText chunkVertex, chunkFragment, depthFragment, skyVertex, skyFragment, starsVertex,
            starsFragment;
    };
    struct Linked {
        Program program;     // name 0 if the driver rejected it
        bool drawn = false;  // the driver has also compiled it for the drawing state
    };
    // The programs that the worker has finished. Its jobs hold weak references, so that a program that is no
    // longer wanted is deleted.
    struct Delivery {
        std::mutex mutex;
        std::vector<std::pair<ProgramKey, Program>> made;
    };

    ChunkPrograms() = default;
    static Result<Program> linked(const Texts& texts, const ProgramKey& key);
    const Program& orPlainest(const ProgramKey& key, const Linked& linked) const;

    std::filesystem::path folder_;
    std::shared_ptr<GlWorker> worker_;
    std::shared_ptr<const Texts> texts_;
    std::map<ProgramKey, Linked> linked_;
    std::set<ProgramKey> ordered_;
    std::shared_ptr<Delivery> delivery_;
    Switches lastSwitches_ = 0;  // of a chunk program
    int reloads_ = 0;
    std::uint32_t firstDraws_ = 0;
    Program faceImage_, clipmapFill_;
};

// Return the keys of the programs that accompany a chunk program.
ProgramKey depthKey(Switches switches);
ProgramKey skyKey(Switches switches);
ProgramKey starsKey(Switches switches);

}  // namespace planet::gl
