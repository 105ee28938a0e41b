// Samples the layers of a world file, from the bottom up.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planet/base/try.h"
#include "planet/raster/gdal_raster.h"
#include "planet/raster/rim_distance.h"
#include "planet/source/height_quanta.h"
#include "planet/source/height_source.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/layer_readings.h"
#include "planet/source/raster_parts.h"
#include "planet/source/raster_sampling.h"
#include "planet/source/sample_tiles.h"
#include "planet/source/source_parts.h"
#include "planet/source/terrain.h"
#include "planet/source/terrain_sources.h"
#include "planet/source/world_file.h"

namespace planet {

namespace {

constexpr std::size_t leastCacheBytes = 8u << 20;  // of a layer
constexpr int worldPieceSide = 65;                 // samples per side of a piece of a tile
constexpr double degPerRad = 180 / std::numbers::pi;

// Rasters on one grid, with the distance from their rim if it is needed.
struct RasterPart {
    RasterArea area;
    std::optional<RimDistance> rim;
};

// A layer, or the rasters of a layer that lie on one grid, which joins the heights of the parts before it.
struct WorldPart {
    WorldLayer layer;
    std::optional<DatumShift> shift;  // of the layer's heights to the planet's datum
    std::uint64_t settings = 0;       // a hash of everything but the content that its heights depend on
    std::variant<std::unique_ptr<RasterPart>, HeightSource> content;
    std::size_t number = 0;  // of the layer in the world file
    std::filesystem::path world{};
};

// Says of an error while reading which layer it struck, and what to do.
template <class T>
T ofLayer(const WorldPart& part, T result) {
    if (result || result.error().kind == ErrorKind::Cancelled) return result;
    Error& error = result.error();
    error.message += fmt::format(
        " (layer \"{}\" of {}); expected the file as it was when it was opened: restore it, or switch the "
        "layer off",
        part.layer.name, part.world.string());
    return result;
}

struct World {
    std::vector<WorldPart> parts;
    double fillM = 0;
    double minM = 0;
    double maxM = 0;
};

double convertedM(const WorldLayer& layer, double heightM, double shiftM) {
    return layer.offsetM + layer.scale * heightM + shiftM;
}

float joined(const WorldLayer& layer, float belowM, float heightM, double shiftM, double weight) {
    const double below = static_cast<double>(belowM);
    const double height = convertedM(layer, static_cast<double>(heightM), shiftM);
    switch (layer.join) {
        case LayerJoin::Replace:
            return static_cast<float>(below + weight * (height - below));
        case LayerJoin::Max:
            return static_cast<float>(below + weight * (std::max(below, height) - below));
        case LayerJoin::Add:
            return static_cast<float>(below + weight * height);
    }
    return belowM;
}

// Gives the voids of a layer their heights; those that stay NaN show what lies under them.
Result<void> treatVoids(const WorldLayer& layer, const RasterArea& area, const PlacesOnGrid& onGrid,
                        std::span<float> heights) {
    if (layer.voids == LayerVoids::Fill) return fillVoids(area, onGrid, heights);
    if (layer.voids == LayerVoids::Below) return {};
    for (const std::size_t i : onGrid.index) {
        if (std::isnan(heights[i])) heights[i] = static_cast<float>(layer.voidM);
    }
    return {};
}

// Returns the shift of each place from the datum of a layer to that of the planet; empty if there is none.
std::vector<double> shiftsAt(const WorldPart& part, const PiecePlaces& places) {
    if (!part.shift) return {};
    std::vector<double> shifts(places.count());
    part.shift->at(places.geographic().longitudeRad, places.geographic().latitudeRad, shifts);
    return shifts;
}

// Checks the shift of place i.
Result<void> checkShift(const WorldLayer& layer, double shiftM, const PiecePlaces& places, std::size_t i) {
    if (std::isfinite(shiftM)) return {};
    return badInput(fmt::format(
        "layer \"{}\": PROJ's grid of its datum or of the planet's has no value at {:.4f} N, {:.4f} E; "
        "expected a grid of the whole planet, or offset_m in the layer instead of the grid",
        layer.name, places.geographic().latitudeRad[i] * degPerRad,
        places.geographic().longitudeRad[i] * degPerRad));
}

// The heights of the places of a piece, and the quanta that they need, metres; none if they are not wanted.
struct PieceHeights {
    std::vector<float> heightsM;
    std::vector<float> neededM;
    double radiusM = 0;  // of the planet; only for quanta
};

// Says which quantum the height of a place needs after a layer has joined it with a weight.
void joinQuantum(const WorldLayer& layer, float quantumM, double weight, float& neededM) {
    if (weight <= 0) return;
    const bool hidesBelow = layer.join == LayerJoin::Replace && weight >= 1;
    neededM = hidesBelow ? quantumM : std::min(neededM, quantumM);
}

// Joins the heights of a layer, of which those that are NaN leave what lies under them. weight(i) is the share of the
// height at place i, and quantum(i) the quantum that it needs.
template <class Weight, class Quantum>
Result<void> joinHeights(const WorldPart& part, const PiecePlaces& places, std::span<const float> heights,
                         PieceHeights& world, const Weight& weight, const Quantum& quantum) {
    const std::vector<double> shifts = shiftsAt(part, places);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (std::isnan(heights[i])) continue;
        const double shiftM = shifts.empty() ? 0 : shifts[i];
        TRY(checkShift(part.layer, shiftM, places, i));
        world.heightsM[i] = joined(part.layer, world.heightsM[i], heights[i], shiftM, weight(i));
        if (!world.neededM.empty()) joinQuantum(part.layer, quantum(i), weight(i), world.neededM[i]);
    }
    return {};
}

double quantumOf(const WorldPart& part, const RasterPart& rasters, double radiusM) {
    const double quantumM = quantumOf(rasters.area, radiusM);
    return rasters.area.stepM > 0 ? std::abs(part.layer.scale) * quantumM : quantumM;
}

Result<void> joinRasters(const WorldPart& part, const RasterPart& rasters, const PiecePlaces& places,
                         PieceHeights& world) {
    const PlacesOnGrid onGrid = placesOnGrid(rasters.area, places);
    if (onGrid.index.empty()) return {};
    std::vector<float> heights(world.heightsM.size(), std::numeric_limits<float>::quiet_NaN());
    TRY(ofLayer(part, fillFrom(rasters.area, places, onGrid, heights)));
    TRY(ofLayer(part, treatVoids(part.layer, rasters.area, onGrid, heights)));
    std::vector<double> weights(rasters.rim ? heights.size() : 0);
    if (rasters.rim) {
        std::vector<double> distances(onGrid.index.size());
        TRY(ofLayer(part, rasters.rim->at(onGrid.column, onGrid.row, distances)));
        for (std::size_t k = 0; k < onGrid.index.size(); ++k)
            weights[onGrid.index[k]] = smoothly(0, rasters.rim->reachRad(), distances[k]);
    }
    const auto quantum = static_cast<float>(quantumOf(part, rasters, world.radiusM));
    return joinHeights(
        part, places, heights, world, [&](std::size_t i) { return weights.empty() ? 1 : weights[i]; },
        [&](std::size_t) { return quantum; });
}

Result<void> joinSource(const WorldPart& part, const HeightSource& source, const SampleTile& piece,
                        const PiecePlaces& places, PieceHeights& world) {
    std::vector<float> heights(world.heightsM.size());
    std::vector<float> needed(world.neededM.size());
    if (needed.empty()) {
        TRY(ofLayer(part, source.sample(piece, heights)));
    } else {
        TRY(ofLayer(part, sampleWithQuanta(source, piece, world.radiusM, heights, needed)));
    }
    const auto scale = static_cast<float>(std::abs(part.layer.scale));
    return joinHeights(
        part, places, heights, world, [](std::size_t) { return 1.0; },
        [&](std::size_t i) { return scale * needed[i]; });
}

// needed: where the quanta that the heights need are wanted, for the same places as out; else null.
Result<void> samplePiece(const World& world, const SampleTile& piece, double radiusM, float* out,
                         float* needed, std::size_t stride) {
    const PiecePlaces places(piece);
    const std::size_t count = samplesIn(piece);
    PieceHeights heights{std::vector<float>(count, static_cast<float>(world.fillM)),
                         std::vector<float>(needed ? count : 0, static_cast<float>(noQuantumM)), radiusM};
    for (const WorldPart& part : world.parts) {
        if (const auto* const source = std::get_if<HeightSource>(&part.content)) {
            TRY(joinSource(part, *source, piece, places, heights));
        } else {
            TRY(joinRasters(part, *std::get<std::unique_ptr<RasterPart>>(part.content), places, heights));
        }
    }
    const auto columns = static_cast<std::size_t>(piece.columns);
    for (std::size_t i = 0; i < count; ++i) {
        out[i / columns * stride + i % columns] =
            std::clamp(heights.heightsM[i], static_cast<float>(world.minM), static_cast<float>(world.maxM));
        if (needed) needed[i / columns * stride + i % columns] = heights.neededM[i];
    }
    return {};
}

// Applies a layer's scale, offset and datum to a reading.
Result<void> convertReading(const WorldPart& part, const PiecePlaces& places, SourceReading& reading) {
    reading.layer = part.number;
    if (!reading.heightM) return {};
    const std::vector<double> shifts = shiftsAt(part, places);
    const double shiftM = shifts.empty() ? 0 : shifts[0];
    TRY(checkShift(part.layer, shiftM, places, 0));
    reading.heightM = convertedM(part.layer, *reading.heightM, shiftM);
    return {};
}

Result<SourceReading> readingOf(const WorldPart& part, const RasterPart& rasters, const PiecePlaces& places) {
    const PlacesOnGrid onGrid = placesOnGrid(rasters.area, places);
    if (onGrid.index.empty()) return SourceReading{.layer = part.number, .heightM = {}};
    TRY_ASSIGN(auto reading, readSample(rasters.area, onGrid));
    if (reading.isVoid) {
        float heightM = std::numeric_limits<float>::quiet_NaN();
        TRY(treatVoids(part.layer, rasters.area, onGrid, std::span(&heightM, 1)));
        if (!std::isnan(heightM)) reading.heightM = static_cast<double>(heightM);
    }
    if (rasters.rim && reading.heightM) {
        double distanceRad = 0;
        TRY(rasters.rim->at(onGrid.column, onGrid.row, std::span(&distanceRad, 1)));
        reading.weight = smoothly(0, rasters.rim->reachRad(), distanceRad);
    }
    TRY(convertReading(part, places, reading));
    return reading;
}

// Appends the readings of a part: of the layer, or of all layers that its detail refines.
Result<void> appendReadings(const WorldPart& part, const Geographic& place,
                            std::vector<SourceReading>& readings) {
    const PiecePlaces places(place);
    if (const auto* const rasters = std::get_if<std::unique_ptr<RasterPart>>(&part.content)) {
        TRY_ASSIGN(auto reading, readingOf(part, **rasters, places));
        // The first raster of a layer with a height counts, or else the first one that lies there.
        const bool isSame = !readings.empty() && readings.back().layer == part.number;
        if (!isSame) {
            readings.push_back(std::move(reading));
        } else if (!readings.back().heightM && (reading.heightM || readings.back().file.empty())) {
            readings.back() = std::move(reading);
        }
        return {};
    }
    TRY_ASSIGN(auto found, std::get<HeightSource>(part.content).layers->at(place));
    if (part.layer.detail.empty()) {
        // A file or terrain: its topmost height, with its own layers as one.
        const SourceReading* const top = topmost(found);
        SourceReading reading = top ? *top : found.front();
        TRY(convertReading(part, places, reading));
        found.assign(1, reading);
    }
    std::ranges::move(found, std::back_inserter(readings));
    return {};
}

Result<std::vector<SourceReading>> readingsOf(const World& world, const Geographic& place) {
    std::vector<SourceReading> readings;
    for (std::size_t i = world.parts.size(); i-- > 0;) TRY(appendReadings(world.parts[i], place, readings));
    return readings;
}

// Returns the cells along a face that lose no samples of a source under a square.
int finestCellsIn(const HeightSource& source, const ChunkId& square) {
    return source.finestCells ? source.finestCells(square) : source.naturalFaceSize - 1;
}

int finestCellsIn(const World& world, const ChunkId& square) {
    int cells = 1;
    for (const WorldPart& part : world.parts) {
        if (const auto* const source = std::get_if<HeightSource>(&part.content)) {
            cells = std::max(cells, finestCellsIn(*source, square));
        } else {
            cells = std::max(
                cells, finestCellsIn(std::get<std::unique_ptr<RasterPart>>(part.content)->area, square));
        }
    }
    return cells;
}

double finestQuantumOf(const World& world, double radiusM) {
    double finestM = noQuantumM;
    for (const WorldPart& part : world.parts) {
        const auto* const source = std::get_if<HeightSource>(&part.content);
        finestM = std::min(
            finestM, source ? std::abs(part.layer.scale) * finestQuantumOf(*source, radiusM)
                            : quantumOf(part, *std::get<std::unique_ptr<RasterPart>>(part.content), radiusM));
    }
    return finestM;
}

SourceReads readsOf(const World& world) {
    SourceReads reads;
    for (const WorldPart& part : world.parts) {
        SourceReads ofPart;
        if (const auto* const source = std::get_if<HeightSource>(&part.content)) {
            if (source->reads) ofPart = source->reads();
        } else {
            const RasterArea& area = std::get<std::unique_ptr<RasterPart>>(part.content)->area;
            ofPart = {area.sampleCount, area.mosaic.samplesRead()};
        }
        reads.samples += ofPart.samples;
        reads.read += ofPart.read;
    }
    return reads;
}

// Returns a hash of how a layer joins what lies under it. A layer's name does not count.
std::uint64_t hashOf(const WorldLayer& layer, const std::optional<VerticalDatum>& planet,
                     const std::optional<DatumShift>& shift, double radiusM,
                     const HeightSourceSettings& settings) {
    Fingerprint hash;
    hash.add(hashOf(settings));
    hash.add(static_cast<std::uint8_t>(layer.join)).add(static_cast<std::uint8_t>(layer.voids));
    hash.add(layer.voidM).add(layer.featherM).add(layer.scale).add(layer.offsetM);
    hash.add(static_cast<std::uint8_t>(shift.has_value()));
    if (shift) {
        hash.add(nameOf(*layer.datum)).add(nameOf(*planet)).add(shift->minM()).add(shift->maxM());
    }
    // Only widths in metres depend on the radius.
    if (layer.featherM > 0 || layer.place) hash.add(radiusM);
    if (layer.place) {
        const ImagePlace& place = *layer.place;
        hash.add(place.latitudeDeg).add(place.longitudeDeg).add(place.widthM).add(place.headingDeg);
        hash.add(std::int32_t{layer.rawSize.value_or(0)});
        if (layer.rawRows) hash.add(std::int32_t{*layer.rawRows});
        hash.add(static_cast<std::uint8_t>(layer.rawBigEndian))
            .add(static_cast<std::uint8_t>(layer.rawSigned));
    }
    return hash.hash();
}

Result<std::vector<SourcePart>> partsOf(const World& world, double filterSpacingRad) {
    std::vector<SourcePart> parts{wholePlanet(Fingerprint().add(world.fillM).hash(), {0, 0})};
    for (const WorldPart& part : world.parts) {
        if (const auto* const rasters = std::get_if<std::unique_ptr<RasterPart>>(&part.content)) {
            const RasterReach reach{filterSpacingRad, (*rasters)->rim ? (*rasters)->rim->reachRad() : 0,
                                    part.layer.voids == LayerVoids::Fill};
            TRY(appendParts((*rasters)->area, part.settings, reach, parts));
            continue;
        }
        TRY_ASSIGN(auto inner, std::get<HeightSource>(part.content).parts(filterSpacingRad));
        for (SourcePart& each : inner) {
            each.signature = Fingerprint().add(part.settings).add(each.signature).hash();
            parts.push_back(each);
        }
    }
    return parts;
}

// The range, the resolution and the sample counts of a source of heights.
struct Extent {
    double minM = 0;
    double maxM = 0;
    int faceCells = 1;
    std::uint64_t sampleCount = 0;
    std::uint64_t missingCount = 0;
};

Extent extentOf(const RasterArea& area) {
    return {static_cast<double>(area.statistics.minM), static_cast<double>(area.statistics.maxM),
            area.faceCells, area.sampleCount, area.statistics.missingCount};
}

Extent extentOf(const HeightSource& source) {
    return {source.minM, source.maxM, source.naturalFaceSize - 1, source.sampleCount, source.missingCount};
}

// Makes a world from its layers, and keeps track of its extent.
class WorldBuilder {
public:
    WorldBuilder(std::filesystem::path path, const WorldFile& file, std::size_t layers,
                 const HeightSourceSettings& settings)
        : path_(std::move(path)),
          settings_(settings),
          cacheBytes_(settings.cacheBytes),
          cache_(std::make_shared<MosaicCache>(settings.cacheBytes)),
          radiusM_(file.radiusM),
          fillM_(file.fillM),
          datum_(file.datum),
          world_(std::make_unique<World>()) {
        // A place without a colour is black.
        world_->fillM = world_->minM = world_->maxM = settings.colourChannel ? 0 : file.fillM;
        // Layers of the whole planet have caches of their own, and all rasters share one.
        settings_.cacheBytes = std::max(leastCacheBytes, settings.cacheBytes / layers);
    }

    Result<void> add(const WorldLayer& layer) {
        TRY(setShift(layer));
        const std::size_t skipped = skipped_.size();
        TRY(addContent(layer));
        SourceLayer& description = layers_.back();
        description.name = layer.name;
        description.join = layer.join;
        description.skipped.assign(skipped_.begin() + static_cast<std::ptrdiff_t>(skipped), skipped_.end());
        return {};
    }

    // Returns whether any layer has a height.
    bool hasHeights() const { return hasHeights_; }

    HeightSource finish(std::string description) {
        HeightSource source;
        source.description = std::move(description) + skippedText(skipped_.size());
        source.skipped = skipped_;
        source.naturalFaceSize = extent_.faceCells + 1;
        source.minM = world_->minM;
        source.maxM = world_->maxM;
        source.sampleCount = extent_.sampleCount;
        source.missingCount = extent_.missingCount;
        source.memoryBytes = cachedBytes(rasterSamples_, cacheBytes_) + wholeBytes_;
        const std::shared_ptr<const World> world = std::move(world_);
        source.parts = [world](double filterSpacingRad) { return partsOf(*world, filterSpacingRad); };
        source.finestCells = [world](const ChunkId& square) { return finestCellsIn(*world, square); };
        source.reads = [world] { return readsOf(*world); };
        source.sample = [world](const SampleTile& tile, std::span<float> out) {
            return sampleInPieces(tile, worldPieceSide, out,
                                  [&](const SampleTile& piece, float* to, std::size_t stride) {
                                      return samplePiece(*world, piece, 0, to, nullptr, stride);
                                  });
        };
        if (settings_.colourChannel) return source;
        source.finestQuantumM = [world](double radiusM) { return finestQuantumOf(*world, radiusM); };
        source.sampleWithQuanta = [world](const SampleTile& tile, double radiusM, std::span<float> out,
                                          std::span<float> neededM) {
            return sampleInPieces(tile, worldPieceSide, out,
                                  [&](const SampleTile& piece, float* to, std::size_t stride) {
                                      float* const needed = neededM.data() + (to - out.data());
                                      return samplePiece(*world, piece, radiusM, to, needed, stride);
                                  });
        };
        source.layers = std::make_shared<const SourceLayers>(SourceLayers{
            layers_, fillM_, [world](const Geographic& place) { return readingsOf(*world, place); }});
        return source;
    }

private:
    Result<void> addContent(const WorldLayer& layer) {
        if (!layer.detail.empty()) return addDetail(layer);
        if (!layer.terrain.empty()) {
            TRY_ASSIGN(auto terrain, openHeightSource(layer.terrain, settings_));
            addWhole(layer, std::move(terrain));
            return {};
        }
        TRY_ASSIGN(const auto files, filesOfLayer(layer));
        if (layer.place) return addPlaced(layer, files[0]);
        // An image of the whole planet or six faces; anything else is georeferenced.
        if (layer.files.size() == 1 && files == layer.files && coversPlanet(files[0], settings_))
            return addImage(layer, files[0]);
        return addRasters(layer, files);
    }

    // Adds an image of the whole planet or six faces. With missing samples it is read as a raster, because only those
    // show what lies under them; without any, it has no rim for a feather.
    Result<void> addImage(const WorldLayer& layer, const std::filesystem::path& path) {
        const std::shared_ptr<const GdalRaster> raster = openGeoreferenced(path, settings_);
        if (raster && raster->hidesSamples()) return addRasters(layer, {path});
        if (raster) TRY(checkDatum(layer, *raster));
        TRY_ASSIGN(auto source, openHeightSource(path, settings_));
        if (source.missingCount == 0) {
            addWhole(layer, std::move(source));
            return {};
        }
        if (raster) return addRasters(layer, {path});
        return badInput(
            fmt::format("{}: {} of its samples are missing, and it has no position; expected a georeferenced "
                        "image, such as a GeoTIFF, so that what lies under it shows through",
                        path.string(), source.missingCount));
    }

    // Returns the settings of rasters, which share one cache.
    HeightSourceSettings rasterSettings() const {
        HeightSourceSettings settings = settings_;
        settings.cacheBytes = cacheBytes_;
        return settings;
    }

    // Refuses a file that says that its heights have another datum than its layer, unless offset_m says how much they
    // differ.
    // Without datums, all files that say theirs must say the same.
    Result<void> checkDatum(const WorldLayer& layer, const Raster& raster) {
        const RasterLayout& layout = raster.layout();
        if (layer.hasOffset || layout.verticalName.empty() || settings_.colourChannel) return {};
        if (!datum_ && layer.join != LayerJoin::Add)
            return toldDatum_.add(raster,
                                  "datum at the top of the world file and in each layer, or offset_m in the "
                                  "layer with the difference");
        if (!layer.datum || layout.datum == layer.datum) return {};
        const std::string expected =
            layout.datum ? fmt::format("datum = \"{}\" in the layer, or ", nameOf(*layout.datum)) : "";
        return badInput(fmt::format(
            "{}: says that its heights are {}, but the layer's datum is {}; expected {}offset_m with "
            "the difference",
            raster.path().string(), layout.verticalName, nameOf(*layer.datum), expected));
    }

    // offset_m takes the place of the grids, whether or not they exist: the same world file gives the same heights
    // everywhere.
    Result<void> setShift(const WorldLayer& layer) {
        shift_.reset();
        if (!layer.datum || layer.datum == datum_ || layer.hasOffset) return {};
        TRY_ASSIGN(shift_, DatumShift::make(*layer.datum, *datum_));
        return {};
    }

    std::uint64_t settingsOf(const WorldLayer& layer) const {
        return hashOf(layer, datum_, shift_, radiusM_, settings_);
    }

    void widen(const WorldLayer& layer, const Extent& part) {
        extent_.faceCells = std::max(extent_.faceCells, part.faceCells);
        extent_.sampleCount += part.sampleCount;
        extent_.missingCount += part.missingCount;
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        const auto include = [&](double heightM) {
            const double convertedToM = layer.offsetM + layer.scale * heightM;
            low = std::min(low, convertedToM);
            high = std::max(high, convertedToM);
        };
        if (part.minM <= part.maxM) {
            include(part.minM);
            include(part.maxM);
        }
        if (layer.voids == LayerVoids::Height) include(layer.voidM);
        if (low > high) return;  // all samples are missing, and nothing takes their place
        hasHeights_ = true;
        if (shift_) {
            low += shift_->minM();
            high += shift_->maxM();
        }
        const bool adds = layer.join == LayerJoin::Add;
        if (layer.join != LayerJoin::Max)
            world_->minM = adds ? world_->minM + std::min(0.0, low) : std::min(world_->minM, low);
        world_->maxM = adds ? world_->maxM + std::max(0.0, high) : std::max(world_->maxM, high);
    }

    void addWhole(const WorldLayer& layer, HeightSource source) {
        skipped_.insert(skipped_.end(), source.skipped.begin(), source.skipped.end());
        // The layer covers the planet, so the height without any does not count.
        if (world_->parts.empty() && layer.join == LayerJoin::Replace) {
            world_->minM = std::numeric_limits<double>::infinity();
            world_->maxM = -world_->minM;
        }
        widen(layer, extentOf(source));
        wholeBytes_ += source.memoryBytes;
        layers_.push_back(source.layers ? source.layers->layers.back() : SourceLayer());
        addPart(layer, std::move(source));
    }

    // Adds a part of the layer that was described last.
    void addPart(const WorldLayer& layer, std::variant<std::unique_ptr<RasterPart>, HeightSource> content) {
        world_->parts.push_back(
            {layer, shift_, settingsOf(layer), std::move(content), layers_.size() - 1, path_});
    }

    Result<void> addRasters(const WorldLayer& layer, const std::vector<std::filesystem::path>& files) {
        TRY_ASSIGN(auto opened, openRasterAreas(files, rasterSettings(), cache_));
        for (const RasterArea& area : opened.areas) {
            for (const RasterMosaic::Tile& tile : area.mosaic.tiles()) TRY(checkDatum(layer, *tile.raster));
        }
        addAreas(layer, std::move(opened));
        return {};
    }

    Result<void> addPlaced(const WorldLayer& layer, const std::filesystem::path& file) {
        HeightSourceSettings settings = rasterSettings();
        settings.rawSize = layer.rawSize;
        settings.rawRows = layer.rawRows;
        settings.rawBigEndian = layer.rawBigEndian;
        settings.rawSigned = layer.rawSigned;
        TRY_ASSIGN(auto opened, openRasterAreas({file}, settings, cache_, [&](std::size_t) {
                       return openPlacedImage(file, *layer.place, radiusM_, settings);
                   }));
        addAreas(layer, std::move(opened));
        return {};
    }

    void addAreas(const WorldLayer& layer, RasterAreas opened) {
        skipped_.insert(skipped_.end(), opened.skipped.begin(), opened.skipped.end());
        layers_.push_back(opened.areas.empty() ? SourceLayer() : rasterLayer(layer.name, opened.areas));
        // The finest rasters come first and must lie on top, so they are added last.
        std::ranges::reverse(opened.areas);
        for (RasterArea& area : opened.areas) {
            widen(layer, extentOf(area));
            rasterSamples_ += area.sampleCount;
            auto part = std::make_unique<RasterPart>(RasterPart{std::move(area), {}});
            if (layer.featherM > 0) {
                const bool showsBelow = layer.voids == LayerVoids::Below;
                part->rim.emplace(part->area, std::min(1.0, layer.featherM / radiusM_),
                                  showsBelow ? RimDistance::Rims::TilesAndVoids : RimDistance::Rims::Tiles);
            }
            addPart(layer, std::move(part));
        }
    }

    // Makes the layers so far a source of its own, and refines it.
    Result<void> addDetail(const WorldLayer& layer) {
        const bool isPlain = layer.detail.ends_with(':');
        TRY_ASSIGN(const auto terrain, terrainFromText(layer.detail + (isPlain ? "of=." : ",of=.")));
        if (terrain.of != ".") {
            return badInput(fmt::format(
                "detail is \"{}\"; expected only its settings, because it refines what lies under it",
                layer.detail));
        }
        const Extent extent = extent_;
        wholeBytes_ += cachedBytes(rasterSamples_, cacheBytes_);  // of the layers so far
        rasterSamples_ = 0;
        TRY_ASSIGN(auto refined, amplified(finish({}), std::get<DetailTerrain>(terrain.settings)));
        world_ = std::make_unique<World>();
        world_->minM = refined.minM;
        world_->maxM = refined.maxM;
        extent_ = {refined.minM, refined.maxM, refined.naturalFaceSize - 1, extent.sampleCount,
                   extent.missingCount};
        layers_.push_back(refined.layers->layers.back());
        addPart(layer, std::move(refined));
        return {};
    }

    std::filesystem::path path_;  // of the world file
    HeightSourceSettings settings_;
    std::size_t cacheBytes_;  // of all rasters
    std::shared_ptr<MosaicCache> cache_;
    double radiusM_;
    double fillM_;
    std::optional<VerticalDatum> datum_;  // of the planet
    ToldDatum toldDatum_;                 // by the files, without a datum of the planet
    std::optional<DatumShift> shift_;     // of the layer that is being added
    std::unique_ptr<World> world_;
    Extent extent_;
    bool hasHeights_ = false;
    std::vector<SourceLayer> layers_;
    std::vector<std::string> skipped_;  // as in HeightSource
    std::uint64_t rasterSamples_ = 0;
    std::uint64_t wholeBytes_ = 0;  // that the caches of layers of the whole planet hold
};

}  // namespace

Result<HeightSource> openWorld(const std::filesystem::path& path, const HeightSourceSettings& settings) {
    TRY_ASSIGN(const auto file, readWorldFile(path));
    const std::vector<WorldLayer> layers = layersOn(settings.colourChannel ? file.colours : file.layers);
    if (layers.empty()) {
        return badInput(fmt::format("{}: has no layers of {}; expected tables [[{}]]", path.string(),
                                    settings.colourChannel ? "colour" : "elevation",
                                    settings.colourChannel ? "colour" : "elevation"));
    }
    WorldBuilder builder(path, file, layers.size(), settings);
    for (const WorldLayer& layer : layers) {
        if (const Result<void> added = builder.add(layer); !added) {
            const Error& error = added.error();
            return tl::unexpected(Error{error.kind, fmt::format("{} (layer \"{}\" of {})", error.message,
                                                                layer.name, path.string())});
        }
    }
    if (!builder.hasHeights()) {
        return badInput(
            fmt::format("{}: has no {}, because all samples of its layers are missing; expected some",
                        path.string(), settings.colourChannel ? "colours" : "heights"));
    }
    return builder.finish(fmt::format("{}, {} layer{}", path.filename().string(), layers.size(),
                                      layers.size() == 1 ? "" : "s"));
}

}  // namespace planet
