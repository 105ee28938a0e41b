// The programs that a planet is drawn with, and where they look for their inputs. Wants a current context;
// one thread, beside the worker's.
#pragma once

#include <epoxy/gl.h>

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/gl_worker.h"
#include "planet/gl/device/shader_source.h"
#include "planet/gl/draw/drawing_state.h"

namespace planet::gl {

// Uniform blocks. The air's is 5 (air_textures.cpp).
inline constexpr GLuint frameBinding = 0;
inline constexpr GLuint layersBinding = 4;
inline constexpr GLuint seaBinding = 6;
inline constexpr GLuint shadowsBinding = 7;
inline constexpr GLuint clipmapBinding = 12;
// Texture units. The air's are 10 to 12.
inline constexpr GLint heightUnit = 0;
inline constexpr GLint imageUnit = 1;
inline constexpr GLint noiseUnit = 2;
inline constexpr GLint tilesUnit = 3;
inline constexpr GLint pagesUnit = 4;
inline constexpr GLint rootsUnit = 5;
inline constexpr GLint clipmapStackUnit = tilesUnit;  // drawn from in place of the tiles
inline constexpr GLint clipmapBaseUnit = 6;
inline constexpr GLint shadowsUnit = 7;
inline constexpr GLint layerAlbedoUnit = 8;
inline constexpr GLint layerSurfaceUnit = 9;
inline constexpr GLint normalTilesUnit = 13;
inline constexpr GLint normalPagesUnit = 14;
inline constexpr GLint normalRootsUnit = 15;

// A program of a use and a variant (Switch in frame_uniforms.h), which are compiled each by itself: a switch
// that is off costs nothing then. Depth and sky look at a few switches only.
struct ProgramKey {
    ProgramUse use = ProgramUse::Chunk;
    int variant = 0;

    auto operator<=>(const ProgramKey&) const = default;
};

// May serve several renderers whose contexts are one or share their objects.
class ChunkPrograms {
public:
    // From a folder, or the shaders built in where it is empty. Compiles one program of each kind, so that
    // mistakes in the text are found at once. With a worker, others can be compiled by it. The Error names
    // the file.
    static Result<ChunkPrograms> build(const std::filesystem::path& folder,
                                       std::shared_ptr<GlWorker> worker = nullptr);

    // Reads the shaders again and compiles what was drawn with last; on an Error the last good ones go on.
    Result<void> reload();
    // Counts the successful reloads, for renderers that keep programs of their own.
    int reloads() const { return reloads_; }

    // The program, to be drawn with now; compiled where it is not there yet. Should a driver refuse a
    // chunk's, the plainest one; another one has no name then.
    const Program& program(const ProgramKey& key);

    // The functions from here to nearest() never wait. Returns whether a worker compiles in the background.
    bool canOrder() const;
    // Takes the programs that the worker has finished.
    void takeOrdered();
    bool isOrdered(const ProgramKey& key) const { return ordered_.contains(key); }
    // Has the worker compile the program and draw with it once, in this state. An order is made once only.
    void order(const ProgramKey& key, const DrawingState& state, Urgency urgency);
    // Returns the program if it has been drawn with, here or by the worker; else null.
    const Program* ready(const ProgramKey& key) const;
    // Returns the ready chunk program that draws most like the variant, among those that read no texture or
    // table that the variant does not read; null where none is ready.
    const Program* nearest(int variant) const;

    // One more, of which these outputs of vertices can be read back.
    Result<Program> capturing(int variant, std::span<const char* const> outputs) const;

    const Program& faceImage() const { return faceImage_; }
    const Program& clipmapFill() const { return clipmapFill_; }

private:
    struct Texts {
        ShaderText chunkVertex, chunkFragment, depthFragment, skyVertex, skyFragment;
    };
    struct Linked {
        Program program;     // none where the driver refused it
        bool drawn = false;  // with this driver's code for the state made, too
    };
    // Programs that the worker has finished. Its jobs hold weak references, so that a program for which
    // nobody waits any more is deleted.
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
    int lastVariant_ = 0;  // of a chunk
    int reloads_ = 0;
    Program faceImage_, clipmapFill_;
};

// The keys under which the programs for a chunk's variant are kept.
ProgramKey depthKey(int variant);
ProgramKey skyKey(bool physicalAir);

}  // namespace planet::gl
