#include "planet/gl/draw/planet_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planet/paging/normal_tile.h"
#include "planet/select/shadow_cascades.h"

namespace planet::gl {

Result<PlanetRenderer> PlanetRenderer::create(const Planet& planet, const PlanetRendererConfig& config) {
    auto chunks = ChunkRenderer::create({planet.tree().shape, planet.paging()[BlockKind::Heights].capacity,
                                         config.shaderFolder, config.programs});
    if (!chunks) return tl::unexpected(std::move(chunks.error()));
    return PlanetRenderer(std::move(*chunks), planet);
}

PlanetRenderer::PlanetRenderer(ChunkRenderer&& chunks, const Planet& planet)
    : chunks_(std::move(chunks)),
      heightSlots_(planet.paging()[BlockKind::Heights].capacity),
      exaggeration_(planet.tree().exaggeration) {}

UploadChunk PlanetRenderer::upload() {
    return [this](std::uint32_t slot, StepsView heights) { chunks_.upload(slot, heights); };
}

Result<void> PlanetRenderer::fitHeights(const Planet& planet) {
    const std::uint32_t wanted = planet.paging()[BlockKind::Heights].capacity;
    if (heightSlots_ != wanted) {
        const Result<void> fitted = chunks_.setSlotCapacity(wanted);
        if (!fitted) return fitted;
        heightSlots_ = wanted;
    }
    planet.uploadAll(upload());
    return {};
}

void PlanetRenderer::fitShape(const Planet& planet) {
    const double now = planet.tree().exaggeration;
    if (std::exchange(exaggeration_, now) != now) chunks_.setShape(planet.tree().shape);
}

void PlanetRenderer::limit(ViewInput& view) const {
    if (colourPool_ && !drawsColours_) view.colours.enabled = false;
    if (normalPool_ && !drawsNormals_) view.normals.enabled = false;
}

void PlanetRenderer::followColours(Planet& planet) {
    const std::optional<ColourPyramid>& colour = planet.colour();
    if (!colour) return;
    const BlockCounters& counters = planet.paging()[BlockKind::Colours];
    const ColourPoolConfig wanted{colour->format, colour->leafLevel, counters.capacity, counters.unpacked};
    if (colourPool_ != wanted) {
        const Result<void> made = chunks_.setColours(wanted);
        if (!made) {
            problems_.push_back(
                fmt::format("The file's colours cannot be drawn, using an image or the ramp instead: {}",
                            made.error().message));
            static_cast<void>(chunks_.setColours(std::nullopt));
        }
        colourPool_ = wanted;
        drawsColours_ = made.has_value();
        clipmapPx_.reset();  // setColours() removed it
    }
    const std::vector<TileChange> changes = planet.takeTileChanges(BlockKind::Colours);
    if (drawsColours_) chunks_.followColours(changes);
}

// Frees the pool if the planet has no normals.
void PlanetRenderer::followNormals(Planet& planet) {
    const std::uint32_t capacity = planet.paging()[BlockKind::Normals].capacity;
    const PlanetShape& stored = planet.tree().storedShape;
    std::optional<NormalPoolConfig> wanted;
    if (capacity > 0) wanted = {normalLeafLevel(stored), capacity, stored.quantumM};
    if (normalPool_ != wanted) {
        const Result<void> made = chunks_.setNormals(wanted);
        if (!made) {
            problems_.push_back(fmt::format("Fine normals cannot be drawn, using mesh normals instead: {}",
                                            made.error().message));
            static_cast<void>(chunks_.setNormals(std::nullopt));
        }
        normalPool_ = wanted;
        drawsNormals_ = made && wanted;
    }
    const std::vector<TileChange> changes = planet.takeTileChanges(BlockKind::Normals);
    if (drawsNormals_) chunks_.followNormals(changes);
}

// Centres the clipmap on the first view, whose tiles fill it, whichever view is drawn. A size that failed is
// retried only when it changes.
void PlanetRenderer::followClipmap(const Planet& planet, const RenderSettings& settings) {
    const bool isSeen = drawsColours_ && settings.streamed && settings.surface == SurfaceColour::Image &&
                        settings.imageOpacity > 0 && !settings.cube;
    const std::optional<int> wantedPx = isSeen ? settings.clipmapPx : std::nullopt;
    const auto note = [this](const Result<void>& done) {
        clipmapProblem_ = done ? std::string() : done.error().message;
    };
    if (clipmapPx_ != wantedPx) {
        clipmapPx_ = wantedPx;
        note(chunks_.setColourClipmap(wantedPx));
    }
    if (!chunks_.colourClipmap()) return;
    int finestLevel = 0;
    for (const PlanetView& view : planet.views())
        finestLevel = std::max(finestLevel, static_cast<int>(view.colours.counters.deepestLevel));
    note(chunks_.moveColourClipmap(planet.views()[0].input.lodView.eyeM, finestLevel));
}

// Returns the casters for the view that the level of detail is chosen for, so that freezing the level of
// detail also freezes the shadows.
std::vector<DrawItem> PlanetRenderer::shadowCasters(const Planet& planet, const RenderSettings& settings,
                                                    std::span<const DrawItem> items) const {
    // From far away no drawn chunk is within reach of shadows, and the walk would visit every resident chunk.
    const double reachM = settings.light.shadows.reachM;
    const bool mayBeSeen = std::any_of(items.begin(), items.end(), [&](const DrawItem& item) {
        return static_cast<double>(item.distanceM) < reachM;
    });
    if (!mayBeSeen || !chunks_.drawsShadows(settings)) return {};
    const ViewInput& input = planet.views()[0].input;
    return planet::shadowCasters(planet.tree(), input.lodView, input.lod, reachM);
}

void PlanetRenderer::draw(Planet& planet, const View& view, const RenderSettings& settings,
                          const PlanetDrawing& drawing) {
    fitShape(planet);
    followColours(planet);
    followNormals(planet);
    followClipmap(planet, settings);
    const std::span<const DrawItem> items =
        drawing.items.value_or(std::span<const DrawItem>(planet.selection(drawing.selection).draw));
    chunks_.draw(view, items, settings, drawing.tints, shadowCasters(planet, settings, items), drawing.wait);
}

std::vector<std::string> PlanetRenderer::takeProblems() {
    std::vector<std::string> problems = std::exchange(problems_, {});
    for (std::string& more : chunks_.takeProblems()) problems.push_back(std::move(more));
    return problems;
}

}  // namespace planet::gl
