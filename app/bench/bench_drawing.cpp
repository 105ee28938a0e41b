#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <ctime>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/bench/bench_parts.h"
#include "app/scene/scene.h"
#include "app/scene/scene_settings.h"
#include "app/settings/camera_text.h"
#include "planet/bake/bake.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/offscreen_context.h"
#include "planet/gl/device/render_target.h"
#include "planet/gl/device/shader_source.h"
#include "planet/gl/device/software_renderer.h"
#include "planet/gl/device/vertex_inputs.h"
#include "planet/gl/draw/captured_draw.h"
#include "planet/gl/draw/chunk_grid.h"
#include "planet/gl/draw/drawing_state.h"
#include "planet/select/lod_select.h"

namespace worldy {

namespace {

using planet::Result;

constexpr double everyLeafPx = 1e-9;  // a tolerance that only leaves meet
// Mountains in front of a horizon, where all levels are drawn.
constexpr planet::CameraPose benchPose{
    .latitudeDeg = 26, .longitudeDeg = 87, .altitudeM = 120'000, .headingDeg = 0, .pitchDeg = -25};

ViewSettings benchSettings(double tauPx, int budgetMB) {
    ViewSettings settings;
    settings.lod.tauPx = tauPx;
    settings.lod.hysteresis = 0;
    settings.paging.budgetMB = budgetMB;
    settings.paging.loaderThreads = 2;
    settings.lod.seams = planet::SeamMode::None;
    settings.surface.lighting = false;
    settings.surface.atmosphere = false;
    settings.surface.detail = planet::gl::FeatureUse::Off;
    settings.surface.layers.use = planet::gl::FeatureUse::Off;
    settings.surface.surface = planet::gl::SurfaceColour::HeightRamp;
    return settings;
}

ViewSettings everyLeaf(const planet::ChunkFileInfo& info) {
    const auto bytes = info.chunks * (planet::chunkBytesCpu(info.shape) + planet::chunkBytesGpu(info.shape));
    ViewSettings settings = benchSettings(1, static_cast<int>(bytes >> 20) + 64);
    settings.lod.morph = false;
    settings.lod.frustumCulling = false;
    settings.lod.horizonCulling = false;
    settings.lod.tauPx = everyLeafPx;
    return settings;
}

planet::View benchView(const planet::PlanetShape& shape, const PictureSize& size) {
    return planet::viewFromPose(benchPose, shape.radiusM, glm::radians(60.0), size.widthPx, size.heightPx);
}

double residentMiB(const Scene& scene) {
    const planet::PagingCounters& paging = scene.planet->paging();
    return static_cast<double>(paging.residentBytesCpu + paging.residentBytesGpu) / (1 << 20);
}

// A planet drawn with one set of settings.
struct Contender {
    std::string name;
    ViewSettings settings;
    Scene scene;
};

Result<Contender> openContender(std::string name, const ViewSettings& settings, const BenchPlanet& planet,
                                const planet::View& view, const std::filesystem::path& colourImage = {}) {
    Result<Scene> scene = openScene({.chunkFile = planet.chunkFile, .colourImage = colourImage}, settings);
    if (!scene) return tl::unexpected(scene.error());
    Contender contender{std::move(name), settings, std::move(*scene)};
    if (!settleScene(contender.scene, view, settings, loadTimeoutS)) {
        return planet::ioError(fmt::format("{}: loading timed out after {:.0f} s: requested blocks missing",
                                           planet.chunkFile.string(), loadTimeoutS));
    }
    return contender;
}

void drawFrame(Contender& contender, const planet::View& view) {
    stepScene(contender.scene, view, contender.settings);
    drawScene(contender.scene, view, contender.settings);
    glFinish();
}

Spread exactly(double value) {
    return {value, value, value};
}

struct Drawing {
    planet::gl::OffscreenContext context;
    planet::gl::RenderTarget target;
};
Result<Drawing> openDrawing(const PictureSize& size) {
    auto context = planet::gl::OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    auto target = planet::gl::RenderTarget::create(size.widthPx, size.heightPx);
    if (!target) return tl::unexpected(target.error());
    target->bind();
    return Drawing{std::move(*context), std::move(*target)};
}

// The triangles of a selection as a terrain renderer without a planet draws them: a mesh of vertices that morph, with
// skirts and one texture.
struct PlainMesh {
    planet::gl::Program program;
    planet::gl::VertexArray array;
    planet::gl::Buffer vertices;
    planet::gl::Buffer indices;
    planet::gl::Texture texture;
    GLsizei indexCount = 0;
    planet::gl::Projection projection;
};

struct PlainVertex {
    glm::vec3 position;  // from the eye
    glm::vec3 target;    // where it morphs to
    glm::vec2 place;     // in the texture
};

planet::gl::Texture plainTexture() {
    constexpr int size = 1024;
    std::vector<std::uint32_t> texels(std::size_t{size} * size);
    std::uint32_t value = 1;
    for (std::uint32_t& texel : texels) texel = value = value * 1664525u + 1013904223u;
    planet::gl::Texture texture = planet::gl::makeTexture();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, planet::gl::mipmapFilter());
    return texture;
}

Result<std::vector<glm::vec3>> positionsAt(Scene& scene, const planet::View& view,
                                           const ViewSettings& settings, float morph) {
    std::vector<planet::DrawItem> items = scene.planet->selection().draw;
    for (planet::DrawItem& item : items) item.morph = morph;
    return scene.renderer.chunks().readVertexPositions(
        view, items, renderSettingsOf(settings, view, scene.planet->tree()));
}

// Returns the lower end of a skirt below a vertex. Both are relative to the eye.
glm::vec3 loweredBy(float depthM, const glm::vec3& vertex, const planet::View& view) {
    const glm::dvec3 up = glm::normalize(view.eyeM + glm::dvec3(vertex));
    return vertex - depthM * glm::vec3(up);
}

// Makes the mesh of what the scene drew last.
Result<PlainMesh> makePlainMesh(Scene& scene, const planet::View& view, const ViewSettings& settings) {
    const Result<std::vector<glm::vec3>> positions = positionsAt(scene, view, settings, 0);
    if (!positions) return tl::unexpected(positions.error());
    const Result<std::vector<glm::vec3>> targets = positionsAt(scene, view, settings, 1);
    if (!targets) return tl::unexpected(targets.error());
    Result<planet::gl::Program> program = planet::gl::linkProgram(
        {"plain mesh, vertices", "",
         "layout(location = 0) in vec3 position;\nlayout(location = 1) in vec3 target;\n"
         "layout(location = 2) in vec2 place;\nuniform mat4 clipFromWorld;\nuniform float morph;\nout vec2 "
         "at;\n"
         "void main() {\n    at = place;\n"
         "    gl_Position = clipFromWorld * vec4(mix(position, target, morph), 1.0);\n}\n"},
        {"plain mesh, fragments", "",
         "in vec2 at;\nuniform sampler2D picture;\nout vec4 colour;\n"
         "void main() { colour = texture(picture, at); }\n"});
    if (!program) return tl::unexpected(program.error());
    const int cells = planet::chunkCells(scene.planet->tree().shape);
    const planet::gl::ChunkGrid grid = planet::gl::chunkGrid(cells);
    const auto size = static_cast<std::size_t>(cells + 1);
    const std::vector<planet::DrawItem>& drawn = scene.planet->selection().draw;
    std::vector<PlainVertex> vertices;
    std::vector<std::uint32_t> indices;
    for (std::size_t chunk = 0; chunk < drawn.size(); ++chunk) {
        for (const std::uint16_t index : grid.indices)
            indices.push_back(static_cast<std::uint32_t>(vertices.size()) + index);
        for (const planet::gl::GridVertex& vertex : grid.vertices) {
            const std::size_t at = (chunk * size + vertex.row) * size + vertex.column;
            const float depthM = vertex.skirt != 0 ? drawn[chunk].skirtDepthM : 0;
            vertices.push_back({loweredBy(depthM, (*positions)[at], view),
                                loweredBy(depthM, (*targets)[at], view),
                                glm::vec2(vertex.column, vertex.row) / static_cast<float>(cells)});
        }
    }
    PlainMesh mesh{std::move(*program),
                   planet::gl::makeVertexArray(),
                   planet::gl::makeBuffer(),
                   planet::gl::makeBuffer(),
                   plainTexture(),
                   static_cast<GLsizei>(indices.size()),
                   scene.renderer.chunks().projection()};
    glBindVertexArray(mesh.array.name());
    glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(PlainVertex)),
                 vertices.data(), GL_STATIC_DRAW);
    constexpr std::array<planet::gl::VertexInput, 3> inputs = {
        {{.name = "position", .components = 3, .offset = offsetof(PlainVertex, position)},
         {.name = "target", .components = 3, .offset = offsetof(PlainVertex, target)},
         {.name = "place", .components = 2, .offset = offsetof(PlainVertex, place)}}};
    planet::gl::describeInputs(inputs, 0, sizeof(PlainVertex), 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    glBindVertexArray(0);
    return mesh;
}

void drawPlain(const PlainMesh& mesh, const planet::View& view) {
    const glm::mat4 clipFromWorld =
        mesh.projection.clipFromCamera * glm::dmat4(planet::cameraFromWorldRotation(view));
    glViewport(0, 0, view.widthPx, view.heightPx);
    glEnable(GL_CULL_FACE);
    glClearColor(0, 0, 0, 1);
    planet::gl::beginDepthTest(mesh.projection.reversedZ);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const GLuint program = mesh.program.name();
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "clipFromWorld"), 1, GL_FALSE,
                       glm::value_ptr(clipFromWorld));
    glUniform1f(glGetUniformLocation(program, "morph"), 0.3f);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mesh.texture.name());
    glBindVertexArray(mesh.array.name());
    glDrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
    glUseProgram(0);
    glDisable(GL_CULL_FACE);
    planet::gl::endDepthTest(mesh.projection.reversedZ);
}

// The cost of one frame until the last of its pixels is drawn.
struct DrawnFrameCost {
    double wallMs = 0;
    double cpuMs = 0;  // of all threads of the process
    double gpuMs = 0;
};

double processCpuMs() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

DrawnFrameCost measureFrame(const std::function<void()>& frame) {
    const planet::gl::Query begin = planet::gl::makeQuery();
    const planet::gl::Query end = planet::gl::makeQuery();
    glFinish();
    const Stopwatch watch;
    const double cpuMs = processCpuMs();
    glQueryCounter(begin.name(), GL_TIMESTAMP);
    frame();
    glQueryCounter(end.name(), GL_TIMESTAMP);
    glFinish();
    DrawnFrameCost cost{watch.elapsedMs(), processCpuMs() - cpuMs, 0};
    std::array<GLuint64, 2> ns{};
    glGetQueryObjectui64v(begin.name(), GL_QUERY_RESULT, ns.data());
    glGetQueryObjectui64v(end.name(), GL_QUERY_RESULT, &ns[1]);
    cost.gpuMs = 1e-6 * static_cast<double>(ns[1] - ns[0]);
    return cost;
}

// Draws all frames in turn until the shaders are compiled and a GPU runs at its full clock.
void warmUp(std::span<const std::function<void()>> frames) {
    constexpr double leastMs = 1000;
    const Stopwatch watch;
    for (int round = 0; round < 2 || watch.elapsedMs() < leastMs; ++round) {
        for (const auto& frame : frames) {
            frame();
            glFinish();
        }
    }
}

// One of the frames that are compared; the last of them is the usual yardstick.
struct FrameSubject {
    std::string name;
    std::function<void()> draw;
    std::optional<BenchAim> aim{};  // of what bounds the frame: the CPU with software rendering, else the GPU
    struct Yardstick {
        std::size_t subject = 0;  // index
        std::string name;
    };
    std::optional<Yardstick> yardstick{};  // unset: the usual one
};

// Adds the rows of frames that are measured in turn. yardstick: name of the usual one.
void addFrames(const std::vector<FrameSubject>& subjects, const std::string& yardstick, int rounds,
               bool software, std::vector<BenchRow>& rows) {
    std::vector<std::function<void()>> frames;
    for (const FrameSubject& subject : subjects) frames.push_back(subject.draw);
    warmUp(frames);
    std::vector<std::vector<DrawnFrameCost>> costs(subjects.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < subjects.size(); ++i) costs[i].push_back(measureFrame(frames[i]));
    }
    struct Quantity {
        const char* name;
        double DrawnFrameCost::*ms;
        bool isAimed;
    };
    std::vector<Quantity> quantities = {{"frame", &DrawnFrameCost::wallMs, false},
                                        {"CPU, all threads", &DrawnFrameCost::cpuMs, software}};
    if (!software) quantities.push_back({"GPU", &DrawnFrameCost::gpuMs, true});
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        for (const Quantity& quantity : quantities) {
            const auto values = [&](const std::vector<DrawnFrameCost>& of) {
                std::vector<double> ms;
                for (const DrawnFrameCost& cost : of) ms.push_back(cost.*quantity.ms);
                return ms;
            };
            BenchRow row{subjects[i].name, quantity.name, "ms", spreadOf(values(costs[i]))};
            if (i + 1 < subjects.size()) {
                const FrameSubject::Yardstick usual{subjects.size() - 1, yardstick};
                const FrameSubject::Yardstick against = subjects[i].yardstick.value_or(usual);
                row.ratio = spreadOf(ratios(values(costs[i]), values(costs[against.subject])));
                row.yardstick = against.name;
                if (quantity.isAimed) row.aim = subjects[i].aim;
            }
            rows.push_back(std::move(row));
        }
    }
}

// Adds the rows of alternating measurements; the last subject is the baseline.
void addTimes(const std::vector<std::string>& subjects, const std::vector<std::vector<double>>& times,
              const std::string& yardstick, std::vector<BenchRow>& rows) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        BenchRow row{subjects[i], "frame", "ms", spreadOf(times[i])};
        if (i + 1 < subjects.size()) {
            row.ratio = spreadOf(ratios(times[i], times.back()));
            row.yardstick = yardstick;
        }
        rows.push_back(std::move(row));
    }
}

// Bakes a planet again with the colours of an image, as the window does at its first start.
Result<BenchPlanet> withOwnColours(const BenchPlanet& planet, const planet::HeightSource& source,
                                   const std::filesystem::path& colourImage,
                                   const std::filesystem::path& folder) {
    const auto colours = planet::openColourSource(colourImage);
    if (!colours) return tl::unexpected(colours.error());
    planet::BakeSettings settings;
    settings.faceSize = planet.faceSize;
    const BenchPlanet coloured{planet.faceSize, folder / fmt::format("coloured{}.chk", planet.faceSize)};
    const auto report = planet::bake(source, settings, coloured.chunkFile, {}, &*colours);
    if (!report) return tl::unexpected(report.error());
    return coloured;
}

void addSelection(planet::Planet& planet, const planet::View& view, double tauPx, int rounds,
                  std::vector<BenchRow>& rows) {
    planet::LodSettings lod = lodSettingsOf(benchSettings(1, 256));
    lod.tauPx = tauPx;
    planet.settle(
        view, lod, [](std::uint32_t, planet::StepsView) {}, loadTimeoutS);
    constexpr int repeats = 50;
    planet::Selection selection;
    const std::array<std::function<void()>, 1> jobs = {[&] {
        for (int i = 0; i < repeats; ++i) planet::selectChunks(planet.tree(), view, lod, selection);
    }};
    std::vector<double> ms = timeInTurn(jobs, rounds).front();
    for (double& value : ms) value /= repeats;
    std::vector<double> ns = ms;
    for (double& value : ns) value *= 1e6 / selection.counters.visited;
    const std::string subject =
        fmt::format("{}, {} nodes visited",
                    tauPx == everyLeafPx ? "all leaves, high altitude" : fmt::format("tau {:g} px", tauPx),
                    selection.counters.visited);
    BenchRow perNode{subject, "per visited node", "ns", spreadOf(ns)};
    perNode.aim = {.bound = tauPx == everyLeafPx ? 100.0 : 60.0};
    rows.push_back(std::move(perNode));
    rows.push_back({subject, "per frame", "ms", spreadOf(ms)});
}

}  // namespace

BenchRows benchLodAgainstLeaves(const BenchPlanet& planet, const BenchOptions& options) {
    Result<Drawing> drawing = openDrawing(options.size);
    if (!drawing) return tl::unexpected(drawing.error());
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(planet.chunkFile);
    if (!file) return tl::unexpected(file.error());
    const planet::PlanetShape& shape = file->info().shape;
    const planet::View view = benchView(shape, options.size);

    std::vector<Contender> contenders;
    const auto add = [&](std::string name, const ViewSettings& settings) -> Result<void> {
        Result<Contender> opened = openContender(std::move(name), settings, planet, view);
        if (!opened) return tl::unexpected(opened.error());
        contenders.push_back(std::move(*opened));
        return {};
    };
    for (const double tauPx : options.tausPx) {
        const std::string name = fmt::format("faces of {}, tau {:g} px", planet.faceSize, tauPx);
        if (const Result<void> added = add(name, benchSettings(tauPx, 256)); !added)
            return tl::unexpected(added.error());
    }
    const std::string leaves = fmt::format("faces of {}, every leaf", planet.faceSize);
    if (const Result<void> added = add(leaves, everyLeaf(file->info())); !added)
        return tl::unexpected(added.error());

    std::vector<std::function<void()>> frames;
    for (Contender& contender : contenders) frames.push_back([&] { drawFrame(contender, view); });
    warmUp(frames);
    std::vector<BenchRow> rows;
    std::vector<std::string> subjects;
    for (const Contender& contender : contenders) subjects.push_back(contender.name);
    addTimes(subjects, timeInTurn(frames, options.rounds), "every leaf", rows);
    for (const Contender& contender : contenders) {
        rows.push_back({contender.name, "triangles", "",
                        exactly(static_cast<double>(contender.scene.drawn.triangles()))});
        rows.push_back({contender.name, "resident", "MiB", exactly(residentMiB(contender.scene))});
    }
    return rows;
}

BenchRows benchDynamicAgainstStatic(const BenchPlanet& planet, const BenchOptions& options) {
    Result<Drawing> drawing = openDrawing(options.size);
    if (!drawing) return tl::unexpected(drawing.error());
    const ViewSettings settings = benchSettings(options.tausPx.front(), 512);
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(planet.chunkFile);
    if (!file) return tl::unexpected(file.error());
    const planet::View view = benchView(file->info().shape, options.size);
    Result<Contender> dynamic = openContender("selection and draw", settings, planet, view);
    if (!dynamic) return tl::unexpected(dynamic.error());
    drawFrame(*dynamic, view);
    planet::gl::ChunkRenderer& chunks = dynamic->scene.renderer.chunks();
    const planet::Selection& selection = dynamic->scene.planet->selection();
    const Result<planet::gl::CapturedDraw> captured =
        chunks.capture(view, selection.draw, renderSettingsOf(settings, view, dynamic->scene.planet->tree()));
    if (!captured) return tl::unexpected(captured.error());
    std::vector<BenchRow> rows;
    addFrames({{"selection and draw", [&] { drawFrame(*dynamic, view); },
                BenchAim{.bound = 1.2, .isOfRatio = true}},
               {"the same triangles, static", [&] { chunks.draw(view, *captured); }}},
              "static", options.rounds, chunks.capabilities().software, rows);
    rows.push_back({"either", "triangles", "", exactly(static_cast<double>(captured->indexCount) / 3)});
    return rows;
}

BenchRows benchFrame(const BenchPlanet& planet, const planet::HeightSource& source,
                     const std::filesystem::path& colourImage, const BenchOptions& options,
                     const std::filesystem::path& folder) {
    Result<Drawing> drawing = openDrawing(options.size);
    if (!drawing) return tl::unexpected(drawing.error());
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(planet.chunkFile);
    if (!file) return tl::unexpected(file.error());
    struct Kind {
        const char* name;
        BenchPlanet planet;
        double aim;
        ViewSettings settings{};
        std::optional<double> aimOfVertices{};  // in the small picture, relative to the last kind
    };
    ViewSettings detailed;
    detailed.surface.detail = planet::gl::FeatureUse::On;
    ViewSettings plain;
    plain.surface.lighting = false;
    plain.surface.atmosphere = false;
    plain.surface.detail = planet::gl::FeatureUse::Off;
    std::vector<Kind> kinds = {{"default settings", planet, 2.5, {}, 1.23},
                               {"with detail", planet, 4, detailed},
                               {"without light, air and detail", planet, 1.3, plain}};
    if (!colourImage.empty()) {
        const Result<BenchPlanet> coloured = withOwnColours(planet, source, colourImage, folder);
        if (!coloured) return tl::unexpected(coloured.error());
        kinds.insert(kinds.begin(), {"default settings, colours of its own", *coloured, 2.5});
    }
    std::vector<BenchRow> rows;
    // In the small picture, the same chunks have an eighth of the pixels along each side, so vertices count most.
    constexpr int smaller = 8;
    for (const int divisor : {1, smaller}) {
        const PictureSize size{options.size.widthPx / divisor, options.size.heightPx / divisor};
        const planet::View view = benchView(file->info().shape, size);
        const std::string picture = fmt::format("{} x {}", size.widthPx, size.heightPx);
        std::vector<Contender> contenders;
        for (const Kind& kind : kinds) {
            ViewSettings scaled = kind.settings;
            scaled.lod.tauPx /= divisor;
            Result<Contender> opened = openContender(fmt::format("{}, {}", picture, kind.name), scaled,
                                                     kind.planet, view, colourImage);
            if (!opened) return tl::unexpected(opened.error());
            contenders.push_back(std::move(*opened));
        }
        for (Contender& contender : contenders) drawFrame(contender, view);
        Contender& plainest = contenders.back();
        const Result<PlainMesh> mesh = makePlainMesh(plainest.scene, view, plainest.settings);
        if (!mesh) return tl::unexpected(mesh.error());
        std::vector<FrameSubject> subjects;
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            FrameSubject subject{contenders[i].name, [&, i] { drawFrame(contenders[i], view); }};
            const bool isPlainest = i + 1 == kinds.size();
            if (divisor == 1) {
                subject.aim = BenchAim{.bound = kinds[i].aim, .isOfRatio = true};
            } else if (!isPlainest) {
                subject.yardstick = {kinds.size() - 1, kinds.back().name};
                if (kinds[i].aimOfVertices)
                    subject.aim = BenchAim{.bound = *kinds[i].aimOfVertices, .isOfRatio = true};
            }
            subjects.push_back(std::move(subject));
        }
        subjects.push_back({picture + ", morph and one texture", [&] { drawPlain(*mesh, view); }});
        addFrames(subjects, "one texture", options.rounds,
                  contenders[0].scene.renderer.chunks().capabilities().software, rows);
        for (const Contender& contender : contenders)
            rows.push_back({contender.name, "triangles", "",
                            exactly(static_cast<double>(contender.scene.drawn.triangles()))});
        rows.push_back({picture + ", morph and one texture", "triangles", "",
                        exactly(static_cast<double>(mesh->indexCount) / 3)});
    }
    return rows;
}

BenchRows benchSelection(const BenchPlanet& planet, const BenchOptions& options) {
    const auto opened = planet::Planet::open(planet.chunkFile, planet::PagingSettings{});
    if (!opened) return tl::unexpected(opened.error());
    planet::Planet& tree = **opened;
    planet::CameraPose high = benchPose;
    high.altitudeM = 5e6;
    high.pitchDeg = -90;
    const planet::View above = planet::viewFromPose(high, tree.tree().shape.radiusM, glm::radians(60.0),
                                                    options.size.widthPx, options.size.heightPx);
    std::vector<BenchRow> rows;
    for (const double tauPx : options.tausPx)
        addSelection(tree, benchView(tree.tree().shape, options.size), tauPx, options.rounds, rows);
    addSelection(tree, above, everyLeafPx, options.rounds, rows);  // visits many nodes
    return rows;
}

}  // namespace worldy
