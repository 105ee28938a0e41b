#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/cli/bench_parts.h"
#include "app/scene/scene.h"
#include "app/scene/scene_settings.h"
#include "app/settings/camera_text.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/offscreen_context.h"
#include "planet/gl/device/render_target.h"
#include "planet/gl/device/shader_source.h"
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
    settings.surface.detail = false;
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
                                const planet::View& view) {
    Result<Scene> scene = openScene({.chunkFile = planet.chunkFile}, settings);
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

// The triangles of a selection as a static mesh: positions and indices in two buffers, drawn by one call in
// one colour.
struct StaticMesh {
    planet::gl::Program program;
    planet::gl::VertexArray array;
    planet::gl::Buffer vertices;
    planet::gl::Buffer indices;
    GLsizei indexCount = 0;
    bool reversedZ = false;
};

std::vector<std::uint32_t> gridIndices(std::size_t chunks, std::uint32_t cells) {
    std::vector<std::uint32_t> indices;
    indices.reserve(chunks * cells * cells * 6);
    const std::uint32_t size = cells + 1;
    for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
        for (std::uint32_t row = 0; row < cells; ++row) {
            for (std::uint32_t column = 0; column < cells; ++column) {
                const std::uint32_t corner = chunk * size * size + row * size + column;
                for (const std::uint32_t step : {0u, 1u, size + 1, 0u, size + 1, size})
                    indices.push_back(corner + step);
            }
        }
    }
    return indices;
}

Result<StaticMesh> makeStaticMesh(Scene& scene, const planet::View& view, const ViewSettings& settings) {
    const planet::Selection& selection = scene.planet->selection();
    const Result<std::vector<glm::vec3>> positions = scene.renderer.chunks().readVertexPositions(
        view, selection.draw, renderSettingsOf(settings, view, scene.planet->tree()));
    if (!positions) return tl::unexpected(positions.error());
    Result<planet::gl::Program> program =
        planet::gl::linkProgram({"static mesh, vertices", "",
                                 "layout(location = 0) in vec3 position;\nuniform mat4 clipFromWorld;\n"
                                 "void main() { gl_Position = clipFromWorld * vec4(position, 1.0); }\n"},
                                {"static mesh, fragments", "",
                                 "out vec4 colour;\nvoid main() { colour = vec4(0.5, 0.5, 0.5, 1.0); }\n"});
    if (!program) return tl::unexpected(program.error());
    const std::vector<std::uint32_t> indices = gridIndices(
        selection.draw.size(), static_cast<std::uint32_t>(planet::chunkCells(scene.planet->tree().shape)));
    StaticMesh mesh{std::move(*program),
                    planet::gl::makeVertexArray(),
                    planet::gl::makeBuffer(),
                    planet::gl::makeBuffer(),
                    static_cast<GLsizei>(indices.size()),
                    scene.renderer.chunks().capabilities().reversedZ};
    glBindVertexArray(mesh.array.name());
    glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(positions->size() * sizeof(glm::vec3)),
                 positions->data(), GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    glBindVertexArray(0);
    return mesh;
}

void drawStatic(const StaticMesh& mesh, const planet::View& view, const planet::gl::Projection& projection) {
    const glm::mat4 clipFromWorld =
        projection.clipFromCamera * glm::dmat4(planet::cameraFromWorldRotation(view));
    glViewport(0, 0, view.widthPx, view.heightPx);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glDepthFunc(mesh.reversedZ ? GL_GREATER : GL_LESS);
    if (mesh.reversedZ) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glClearDepth(mesh.reversedZ ? 0 : 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(mesh.program.name());
    glUniformMatrix4fv(glGetUniformLocation(mesh.program.name(), "clipFromWorld"), 1, GL_FALSE,
                       glm::value_ptr(clipFromWorld));
    glBindVertexArray(mesh.array.name());
    glDrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
    glUseProgram(0);
    glClearDepth(1);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    if (mesh.reversedZ) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glFinish();
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
    frames.front()();  // compiles the shaders, which happens on first use
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
    const Result<StaticMesh> mesh = makeStaticMesh(dynamic->scene, view, settings);
    if (!mesh) return tl::unexpected(mesh.error());
    const planet::gl::Projection projection = dynamic->scene.renderer.chunks().projection();
    const std::array<std::function<void()>, 2> frames = {[&] { drawFrame(*dynamic, view); },
                                                         [&] { drawStatic(*mesh, view, projection); }};
    for (const auto& frame : frames) frame();
    std::vector<BenchRow> rows;
    addTimes({"selection and draw", "the same triangles, static"}, timeInTurn(frames, options.rounds),
             "static", rows);
    rows.front().aim = {.bound = 1.2, .isOfRatio = true};
    rows.push_back({"either", "triangles", "", exactly(static_cast<double>(mesh->indexCount) / 3)});
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
