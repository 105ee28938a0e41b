#include "planet/gl/draw/chunk_programs.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <regex>
#include <string>
#include <string_view>
#include <utility>

#include "planet/gl/draw/chunk_instances.h"
#include "planet/gl/draw/shader_prologue.h"
#include "planet/gl/draw/sky.h"

namespace planet::gl {

namespace {

constexpr auto chunkVertexFiles =
    std::to_array<std::string_view>({"frame.glsl", "smooth_rise.glsl", "atmosphere.glsl", "air.glsl",
                                     "face_axes.glsl", "ground.glsl", "vertex_position.glsl", "chunk.vert"});
constexpr auto chunkFragmentFiles = std::to_array<std::string_view>(
    {"frame.glsl", "smooth_rise.glsl", "atmosphere.glsl", "air.glsl", "face_axes.glsl", "ground.glsl",
     "tone.glsl", "water.glsl", "sea.glsl", "shadows.glsl", "layers.glsl", "tile_lookup.glsl",
     "colour_tiles.glsl", "colour_clipmap.glsl", "normal_tiles.glsl", "chunk.frag"});
constexpr std::array<std::string_view, 1> depthFragmentFiles = {"depth.frag"};
constexpr std::array<std::string_view, 2> skyVertexFiles = {"frame.glsl", "sky.vert"};
constexpr auto skyFragmentFiles = std::to_array<std::string_view>(
    {"frame.glsl", "smooth_rise.glsl", "atmosphere.glsl", "air.glsl", "sky.glsl", "tone.glsl", "sky.frag"});
constexpr auto starsVertexFiles =
    std::to_array<std::string_view>({"frame.glsl", "smooth_rise.glsl", "atmosphere.glsl", "air.glsl",
                                     "sky.glsl", "stars.glsl", "stars.vert"});
constexpr auto starsFragmentFiles =
    std::to_array<std::string_view>({"tone.glsl", "stars.glsl", "stars.frag"});
constexpr std::array<std::string_view, 1> faceImageVertexFiles = {"face_image.vert"};
constexpr std::array<std::string_view, 3> faceImageFragmentFiles = {"smooth_rise.glsl", "water.glsl",
                                                                    "face_image.frag"};
constexpr std::array<std::string_view, 1> clipmapVertexFiles = {"colour_clipmap.vert"};
constexpr std::array<std::string_view, 1> clipmapFragmentFiles = {"colour_clipmap.frag"};

Result<Program> buildProgram(const std::filesystem::path& folder, ShaderFiles vertexFiles,
                             ShaderFiles fragmentFiles) {
    const Result<ShaderText> vertex = readShader(folder, vertexFiles);
    if (!vertex) return tl::unexpected(vertex.error());
    const Result<ShaderText> fragment = readShader(folder, fragmentFiles);
    if (!fragment) return tl::unexpected(fragment.error());
    const std::string prologue = shaderPrologue(0);
    return linkProgram(*vertex, *fragment, {.prologue = prologue});
}

// Returns whether everything that the drawn variant reads is bound for the wanted one.
bool hasInputsFor(Switches drawn, Switches wanted) {
    constexpr Switches reading = switchImage | switchTiles | switchClipmap | switchRamp | switchShadows |
                                 switchMipmapsInTiles | switchNormalTiles | switchPhysicalAir;
    return (drawn & ~wanted & reading) == 0;
}

// Returns how differently one variant draws from the wanted one. Switches that move vertices weigh most. A
// program that can morph also draws chunks correctly that do not morph.
int difference(Switches wanted, Switches drawn) {
    constexpr Switches shape = switchCube | switchSeaSurface;
    constexpr Switches slide = switchSlide | switchMorph | switchGather;
    constexpr Switches fine = switchLightByVertex | switchDetail | switchFineDetail;
    const Switches differ = wanted ^ drawn;
    const Switches missing = wanted & ~drawn;
    const Switches others = differ & ~(shape | slide | fine);
    return 1000 * std::popcount(differ & shape) + 1000 * std::popcount(missing & slide) +
           10 * std::popcount(others) + std::popcount(differ & fine) + std::popcount(differ & slide);
}

}  // namespace

ProgramKey depthKey(Switches switches) {
    return {ProgramUse::Depth, switches & (switchSlide | switchMorph | switchGather | switchSeaSurface)};
}

ProgramKey skyKey(Switches switches) {
    return {ProgramUse::Sky, switches & (switchAir | switchPhysicalAir)};
}

ProgramKey starsKey(Switches switches) {
    return {ProgramUse::Stars, skyKey(switches).switches};
}

Result<Program> ChunkPrograms::linked(const Texts& texts, const ProgramKey& key) {
    const std::string prologue = shaderPrologue(key.switches);
    const auto link = [&](const ShaderText& vertex, const ShaderText& fragment,
                          std::span<const VertexInput> inputs) {
        return linkProgram(vertex, fragment, {.prologue = prologue, .inputs = inputs});
    };
    switch (key.use) {
        case ProgramUse::Chunk:
            return link(texts.chunkVertex, texts.chunkFragment, chunkInputs());
        case ProgramUse::Depth:
            return link(texts.chunkVertex, texts.depthFragment, chunkInputs());
        case ProgramUse::Sky:
            return link(texts.skyVertex, texts.skyFragment, {});
        case ProgramUse::Stars:
            return link(texts.starsVertex, texts.starsFragment, starInputs());
    }
    return badInput("no such use of a program");
}

Result<ChunkPrograms> ChunkPrograms::build(const std::filesystem::path& folder,
                                           std::shared_ptr<GlWorker> worker) {
    ChunkPrograms programs;
    programs.folder_ = folder;
    programs.worker_ = std::move(worker);
    programs.delivery_ = std::make_shared<Delivery>();
    const auto texts = std::make_shared<Texts>();
    const std::array<std::pair<ShaderText*, ShaderFiles>, 7> wanted = {
        {{&texts->chunkVertex, chunkVertexFiles},
         {&texts->chunkFragment, chunkFragmentFiles},
         {&texts->depthFragment, depthFragmentFiles},
         {&texts->skyVertex, skyVertexFiles},
         {&texts->skyFragment, skyFragmentFiles},
         {&texts->starsVertex, starsVertexFiles},
         {&texts->starsFragment, starsFragmentFiles}}};
    for (const auto& [text, files] : wanted) {
        Result<ShaderText> read = readShader(folder, files);
        if (!read) return tl::unexpected(read.error());
        *text = std::move(*read);
    }
    programs.texts_ = texts;
    // Programs differ only in constants: if one compiles, so will the others.
    for (const ProgramKey& key :
         {ProgramKey{}, skyKey(switchAir), skyKey(switchAir | switchPhysicalAir), starsKey(0)}) {
        Result<Program> program = linked(*texts, key);
        if (!program) return tl::unexpected(program.error());
        programs.linked_[key].program = std::move(*program);
    }
    Result<Program> faceImage = buildProgram(folder, faceImageVertexFiles, faceImageFragmentFiles);
    if (!faceImage) return tl::unexpected(faceImage.error());
    Result<Program> clipmapFill = buildProgram(folder, clipmapVertexFiles, clipmapFragmentFiles);
    if (!clipmapFill) return tl::unexpected(clipmapFill.error());
    programs.faceImage_ = std::move(*faceImage);
    programs.clipmapFill_ = std::move(*clipmapFill);
    return programs;
}

Result<void> ChunkPrograms::reload() {
    Result<ChunkPrograms> programs = build(folder_, worker_);
    if (!programs) return tl::unexpected(programs.error());
    Result<Program> last = linked(*programs->texts_, {ProgramUse::Chunk, lastSwitches_});
    if (!last) return tl::unexpected(last.error());
    programs->linked_[{ProgramUse::Chunk, lastSwitches_}] = {std::move(*last), true};
    programs->lastSwitches_ = lastSwitches_;
    programs->reloads_ = reloads_ + 1;
    programs->firstDraws_ = firstDraws_;
    *this = std::move(*programs);
    return {};
}

const Program& ChunkPrograms::orPlainest(const ProgramKey& key, const Linked& linked) const {
    if (linked.program.name() != 0 || key.use != ProgramUse::Chunk) return linked.program;
    return linked_.at({}).program;
}

const Program& ChunkPrograms::program(const ProgramKey& key) {
    if (key.use == ProgramUse::Chunk) lastSwitches_ = key.switches;
    const auto [found, fresh] = linked_.try_emplace(key);
    if (fresh) {
        if (Result<Program> made = linked(*texts_, key)) found->second.program = std::move(*made);
    }
    if (!std::exchange(found->second.drawn, true)) ++firstDraws_;
    return orPlainest(key, found->second);
}

bool ChunkPrograms::canOrder() const {
    return worker_ && worker_->works();
}

void ChunkPrograms::takeOrdered() {
    const std::scoped_lock lock(delivery_->mutex);
    for (auto& [key, program] : delivery_->made) linked_[key] = {std::move(program), true};
    delivery_->made.clear();
}

void ChunkPrograms::order(const ProgramKey& key, const DrawingState& state, Urgency urgency) {
    if (!ordered_.insert(key).second) return;
    const std::weak_ptr<Delivery> waiting = delivery_;
    worker_->add(
        [texts = texts_, key, state, waiting] {
            if (waiting.expired()) return;
            Program program;
            if (Result<Program> made = linked(*texts, key)) {
                program = std::move(*made);
                drawNothing(program, key.use, state);
            }
            if (const std::shared_ptr<Delivery> delivery = waiting.lock()) {
                const std::scoped_lock lock(delivery->mutex);
                delivery->made.emplace_back(key, std::move(program));
            }
        },
        urgency);
}

const Program* ChunkPrograms::ready(const ProgramKey& key) const {
    const auto found = linked_.find(key);
    if (found == linked_.end() || !found->second.drawn) return nullptr;
    return &orPlainest(key, found->second);
}

const Program* ChunkPrograms::nearest(Switches switches) const {
    const Program* best = nullptr;
    int least = 0;
    for (const auto& [key, linked] : linked_) {
        if (key.use != ProgramUse::Chunk || !linked.drawn || linked.program.name() == 0) continue;
        if (!hasInputsFor(key.switches, switches)) continue;
        const int differs = difference(switches, key.switches);
        if (best && differs >= least) continue;
        best = &linked.program;
        least = differs;
    }
    return best;
}

Result<Program> ChunkPrograms::capturing(Switches switches, std::span<const char* const> outputs) const {
    const std::string prologue = shaderPrologue(switches);
    return linkProgram(texts_->chunkVertex, texts_->chunkFragment,
                       {.prologue = prologue, .inputs = chunkInputs(), .captured = outputs});
}

std::vector<VertexOutput> ChunkPrograms::chunkOutputs() const {
    static const std::regex declaration(R"(\n(flat )?out (float|vec([234])) (\w+);)");
    const std::string& text = texts_->chunkVertex.text;
    std::vector<VertexOutput> outputs;
    for (std::sregex_iterator found(text.begin(), text.end(), declaration); found != std::sregex_iterator();
         ++found) {
        const std::smatch& match = *found;
        outputs.push_back({match[4], match[2], match[3].matched ? std::stoi(match[3]) : 1, match[1].matched});
    }
    return outputs;
}

Result<Program> ChunkPrograms::passingOn(Switches switches) const {
    static constexpr auto frameFiles = std::to_array<std::string_view>({"frame.glsl"});
    Result<ShaderText> vertex = readShader(folder_, frameFiles);
    if (!vertex) return tl::unexpected(vertex.error());
    const std::vector<VertexOutput> outputs = chunkOutputs();
    std::vector<std::string> names;
    std::string copies;
    for (const VertexOutput& output : outputs) {
        names.push_back(output.name + "Held");
        vertex->text += fmt::format("in {0} {1}Held;\n{2}out {0} {1};\n", output.type, output.name,
                                    output.isFlat ? "flat " : "");
        copies += fmt::format("    {0} = {0}Held;\n", output.name);
    }
    vertex->text += "flat out ShadingFrame held;\n";
    vertex->text += "void main() {\n    held = frame.shading;\n" + copies +
                    "    gl_Position = frame.clipFromWorld * vec4(surface, 1.0);\n}\n";
    std::vector<VertexInput> inputs;
    for (const std::string& name : names) inputs.push_back({.name = name.c_str()});
    const std::string prologue = shaderPrologue(switches);
    return linkProgram(*vertex, texts_->chunkFragment, {.prologue = prologue, .inputs = inputs});
}

}  // namespace planet::gl
