#include "app/settings/settings_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <type_traits>

#include "app/settings/layer_file.h"

namespace worldy {

namespace {

constexpr SliderScale logarithmic = SliderScale::Logarithmic;

// All enumerations are bytes, so one kind of field serves them.
template <class Enum>
std::uint8_t* asByte(Enum& value) {
    static_assert(sizeof(Enum) == 1);
    return reinterpret_cast<std::uint8_t*>(&value);
}

using Fields = std::vector<Field>;

void addData(Fields& fields, Settings& s) {
    fields.insert(
        fields.end(),
        {{"data", "set", "Data set",
          "Chunk file, elevation image or raster, world file, or cube faces to open; if empty, the Earth is "
          "opened.",
          Text{&s.dataSet}},
         {"data", "colour_image", "Colour image",
          "Colour image of the planet; if empty, colour.jpg or colour.png beside the data set is used.",
          Text{&s.colourImage}}});
}

void addLod(Fields& fields, planet::LodSettings& lod) {
    fields.insert(
        fields.end(),
        {{"lod", "tau_px", "Tolerance τ",
          "Screen-space error (SSE) threshold. A chunk is replaced by its children while ε = δc K' / D > τ. "
          "Larger: fewer triangles and less memory, but more visible error and larger pops. Smaller: more "
          "triangles and memory.",
          Number{&lod.tauPx, {smallestTauPx, largestTauPx, "px"}, "%.2f", logarithmic}},
         {"lod", "hysteresis", "Hysteresis",
          "Fraction of τ by which a merge is delayed. A split chunk stays split until ε <= τ (1 - "
          "hysteresis). Larger: fewer chunks change level back and forth, but more triangles are drawn. 0: "
          "chunks near τ may change level with every camera movement.",
          Number{&lod.hysteresis, {0, 0.9, ""}}},
         {"lod", "max_level", "Max LOD level",
          "Deepest level drawn. Chunks of this level are not split. Level 0 is a whole cube face. Smaller: "
          "coarse ground near the camera, regardless of the tolerance.",
          Integer{&lod.maxLevel, {0, planet::maxLevel, ""}}},
         {"lod", "morph", "Morph",
          "Moves a chunk's vertices gradually onto its parent's surface before the parent replaces it. Off: "
          "chunks pop when their level changes.",
          Flag{&lod.morph}},
         {"lod", "morph_range", "Morph range",
          "Fraction of τ over which a chunk morphs. Its morph is 0 where its parent's ε is τ (1 + range), "
          "and 1 where it is τ. Larger: slower morphs, but more chunks are drawn coarser than necessary. "
          "Small: almost a pop.",
          Number{&lod.morphRange, {0.01, 4, ""}, "%.2f", logarithmic}},
         {"lod", "frustum_culling", "Frustum culling",
          "Skips chunks outside the view frustum. Off: they are loaded and drawn too, several times as many "
          "chunks; turning the camera then shows no coarse ground.",
          Flag{&lod.frustumCulling}},
         {"lod", "horizon_culling", "Horizon culling",
          "Skips chunks below the horizon. Off: the far side of the planet is loaded and drawn too, without "
          "visible benefit.",
          Flag{&lod.horizonCulling}},
         {"lod", "metric", "Error metric",
          "Geometric error bound that is projected and compared with the tolerance. Additive: δc, the sum of "
          "the largest errors of each level; safe but loose. Tight: the largest distance the bake measured "
          "between the chunk's surface, or a descendant's, and the finest data; never larger than δc, so it "
          "needs fewer triangles for the same tolerance.",
          Choice{asByte(lod.metric), errorMetricNames}},
         {"lod", "fade_s", "Fade",
          "Minimum duration of a complete morph, for each level. It covers changes the morph range cannot "
          "anticipate: late children, a new tolerance, a fast camera. Larger: smoother, but chunks stay too "
          "coarse or too fine for longer. 0: such changes pop.",
          Number{&lod.fadeS, {0, 10, "s"}, "%.2f", logarithmic}}});
}

void addBudget(Fields& fields, BudgetSettings& budget) {
    fields.insert(
        fields.end(),
        {{"budget", "cpu_ms", "CPU time",
          "Most CPU time of a frame: selecting, paging, uploading, drawing and panels, without waiting for "
          "the "
          "monitor. The tolerance follows it. 0: off. Smaller: coarser ground.",
          Number{&budget.cpuMs, {0, 1000, "ms"}, "%.1f", logarithmic}, "CPU time budget"},
         {"budget", "gpu_ms", "GPU time",
          "Most GPU time of a frame, panels included. The tolerance follows it. 0: off. Smaller: coarser "
          "ground. Without timer queries it has no effect.",
          Number{&budget.gpuMs, {0, 1000, "ms"}, "%.1f", logarithmic}, "GPU time budget"},
         {"budget", "triangles", "Triangles",
          "Most triangles of a frame, skirts included. The tolerance follows it. 0: off. Smaller: coarser "
          "ground.",
          Integer{&budget.triangles, {0, 100'000'000, ""}, logarithmic}, "Triangle budget"},
         {"budget", "memory_mb", "Memory",
          "Most memory of the chunks that the picture needs, CPU and GPU together. The tolerance follows it. "
          "0: off. A value below the paging budget keeps chunks from waiting for room.",
          Integer{&budget.memoryMB, {0, 65536, "MiB"}, logarithmic}, "Memory budget"},
         {"budget", "read_mb_s", "Reading",
          "Most bytes read from the file in a second, as a mean of half a second. 1 MB is 10^6 bytes. The "
          "tolerance follows it. 0: off. Smaller: coarser ground while the camera is fast.",
          Number{&budget.readMBs, {0, 10000, "MB/s"}, "%.2f", logarithmic}, "Reading budget"},
         {"budget", "least_tau_px", "Least τ",
          "Smallest tolerance that a budget may choose. Larger: costs stay below the budgets in simple "
          "views.",
          Number{&budget.leastTauPx, {smallestTauPx, largestTauPx, "px"}, "%.2f", logarithmic}},
         {"budget", "most_tau_px", "Most τ",
          "Largest tolerance that a budget may choose. Smaller: costs exceed the budgets in difficult views "
          "instead of more error. Below the least τ it has no effect.",
          Number{&budget.mostTauPx, {smallestTauPx, largestTauPx, "px"}, "%.2f", logarithmic}},
         {"budget", "hysteresis", "Band",
          "Width of the band of use, below 97.5 %, in which the tolerance stays or only creeps. Larger: "
          "fewer level changes, but less of the budget is used. Small: τ follows the noise of the times.",
          Number{&budget.hysteresis, {0, 0.5, ""}}, "Budget band"}});
}

void addRegions(Fields& fields, RegionSettings& regions) {
    fields.push_back(
        {"regions", "on", "Regions",
         "Applies the regions of the planet (Regions panel): places with a factor on the tolerance, with "
         "limits of level or with a metric of their own. Off: the whole planet has the same tolerance.",
         Flag{&regions.on}});
}

void addSeams(Fields& fields, planet::LodSettings& lod, OverlaySettings& overlay) {
    fields.insert(
        fields.end(),
        {{"seams", "mode", "Seams",
          "Treatment of cracks between chunks of different levels. None: cracks show. Skirts: vertical "
          "strips along chunk edges hide cracks at the cost of more triangles. Stitched: edge vertices move "
          "onto the coarser neighbour's edge, so no cracks exist; this limits the level difference of "
          "neighbours, so some chunks are drawn coarser than the tolerance requires.",
          Choice{asByte(lod.seams), seamModeNames}},
         {"seams", "depth", "Skirt depth",
          "How the skirt depth is chosen. Automatic: each skirt is as deep as the errors it must hide. "
          "Fixed: one depth for all chunks.",
          Choice{asByte(lod.skirtDepth), skirtDepthNames}},
         {"seams", "skirt_factor", "Factor",
          "Factor of the automatic skirt depth. Skirt depth = factor (δc of the chunk + the largest δc of "
          "its drawn neighbours). At 1 no crack shows, because each surface is within its δc of the finest "
          "data. Smaller: cracks may show; 0: no skirts. Larger: more overdraw, and longer walls where a "
          "skirt is seen from the side.",
          Number{&lod.skirtFactor, {0, 10, ""}, "%.3f"}, "Skirt factor"},
         {"seams", "skirt_depth_m", "Depth",
          "Fixed skirt depth, towards the planet's centre. Smaller than a gap: a crack shows. Larger: more "
          "overdraw.",
          Number{&lod.skirtDepthM, {0, 100000, "m"}, "%.1f", logarithmic}, "Fixed skirt depth"},
         {"seams", "show_pairs", "Highlight LOD seams",
          "Highlights edges between chunks of different levels in the viewport.", Flag{&overlay.lodSeams}}});
}

void addPaging(Fields& fields, PagingOptions& paging) {
    planet::BadDiskSettings& disk = paging.badDisk;
    fields.insert(
        fields.end(),
        {{"paging", "budget_mb", "Budget",
          "Memory budget for resident chunks and colour tiles, CPU and GPU together. Smaller: once the "
          "budget is full, some chunks stay coarse and evicted chunks must be loaded again. Larger: less "
          "memory for everything else.",
          Integer{&paging.budgetMB, {16, 65536, "MiB"}, logarithmic}},
         {"paging", "loader_threads", "Loaders",
          "Number of threads that read and decode chunks. More: more reads in flight on a slow disk, but "
          "less CPU time for drawing.",
          Integer{&paging.loaderThreads, {1, 64, ""}, logarithmic}},
         {"paging", "upload_limit_ms", "Upload limit",
          "Time per frame for uploading loaded chunks; at least one block is uploaded per frame. Larger: "
          "detail arrives sooner, but frames may stutter.",
          Number{&paging.uploadLimitMs, {0.1, 100, "ms"}, "%.1f", logarithmic}},
         {"paging", "colour_share", "Colour share",
          "Fraction of the budget for streamed colour tiles. Larger: sharper colours, but coarser ground "
          "once the budget is full.",
          Number{&paging.colourShare, {0.01, 0.9, ""}}},
         {"paging", "normal_share", "Share",
          "Fraction of the budget remaining after colours, for normals finer than the mesh. Larger: finer "
          "shading of coarse chunks. Smaller: finer ground when the budget is full.",
          Number{&paging.normalShare, {0.01, 0.9, ""}}, "Fine normals share"},
         {"paging", "retries", "Retries",
          "How often a failed read is retried before it counts as permanently failed. Fewer: an unreliable "
          "disk leaves chunks coarse. More: a broken disk is retried for longer. Corrupt blocks are never "
          "retried.",
          Integer{&paging.retries, {0, 10, ""}}},
         {"paging", "retry_delay_s", "Retry delay",
          "Delay before the first retry of a failed read; it doubles with each further retry. Smaller: "
          "detail arrives sooner, but a failing disk is read more often.",
          Number{&paging.retryDelayS, {0, 60, "s"}, "%.2f", logarithmic}},
         {"paging", "simulated", "Simulated paging",
          "Read times follow the fault-injection settings and the seed, in frame time instead of real time. "
          "A flight then loads the same blocks in the same frames on any machine. Without latency and "
          "bandwidth a read takes no time. Changing this restarts reads in progress.",
          Flag{&paging.simulated}},
         {"paging", "prefetch", "Predict",
          "What is loaded before the picture wants it. Motion: what the camera will want if it goes on as it "
          "moves now. Announced: what it will want along a flight or at the end of a glide; otherwise as "
          "motion. Prefetches are read only while nothing else is queued, and evict nothing that is in use. "
          "Off: nothing is read early.",
          Choice{asByte(paging.prefetch.mode), prefetchModeNames}, "Prefetch"},
         {"paging", "prefetch_horizon_s", "Horizon",
          "How far ahead prefetching looks. Larger: more is there in time if the camera moves as predicted, "
          "but more is read in vain if it does not.",
          Number{&paging.prefetch.horizonS, {0.1, 60, "s"}, "%.1f", logarithmic}, "Prefetch horizon"},
         {"paging", "prefetch_share", "Loader share",
          "Fraction of the loaders' time that prefetching may take while nothing else is queued. Smaller: a "
          "loader is more often free when the picture needs something. Larger: more is there in time.",
          Number{&paging.prefetch.share, {0.01, 1, ""}}, "Prefetch share"},
         {"paging", "prefetch_lasting_first", "Lasting first",
          "Reads those blocks first, of all that the picture wants, that it will still want when they can "
          "arrive, while the loaders fall behind. Fewer chunks are late, but those that the camera is about "
          "to pass stay coarser. Off: the largest error comes first.",
          Flag{&paging.prefetch.lastingFirst}, "Prefetch, lasting first"},
         {"bad_disk", "latency_ms", "Latency",
          "I/O fault injection: latency added to each read, varied randomly by ±50 %. Larger: detail arrives "
          "later; more loaders hide part of it.",
          Number{&disk.latencyMs, {0, 10000, "ms"}, "%.1f", logarithmic}},
         {"bad_disk", "bandwidth_mb_s", "Bandwidth",
          "I/O fault injection: bandwidth per loader thread. 1 MB is 10^6 bytes; 0 is unlimited. Smaller: "
          "large blocks take longer.",
          Number{&disk.bandwidthMBs, {0, 100000, "MB/s"}, "%.2f", logarithmic}},
         {"bad_disk", "failure_rate", "Failure rate",
          "I/O fault injection: fraction of reads that fail. The parent of a failed block is drawn until a "
          "retry succeeds.",
          Number{&disk.failureRate, {0, 1, ""}, "%.3f"}},
         {"bad_disk", "shuffled_order", "Shuffled order",
          "Serves reads in a random order given by the seed instead of by priority, to show the benefit of "
          "priorities.",
          Flag{&disk.shuffledOrder}},
         {"bad_disk", "seed", "Seed", "Seed of the injected faults; the same seed gives the same faults.",
          Seed{&disk.seed}}});
}

constexpr std::array<std::string_view, 13> colourByLabels = {
    "none",     "level",      "ε / τ",          "δc",     "morph",  "age",  "load order",
    "measured", "leaf depth", "sample spacing", "source", "region", "atlas"};
constexpr std::array<std::string_view, 3> skirtPaintLabels = {"as ground", "highlighted", "only skirts"};
constexpr std::array<std::string_view, 4> chunkLabelsLabels = {"none", "level", "ε", "level and ε"};

void addOverlay(Fields& fields, OverlaySettings& overlay) {
    fields.insert(
        fields.end(),
        {{"overlay", "colour_by", "Colour by",
          "Quantity that tints the chunks in the viewport. ε / τ is the screen-space error relative to the "
          "tolerance, δc the geometric error in metres, age the time since loading, and measured the last "
          "measured error (True error panel) relative to the tolerance. Leaf depth is the level of the "
          "deepest leaf under a chunk, sample spacing the distance of the samples there, source the topmost "
          "layer of the source that has a height in the middle of the chunk, region the region that "
          "decides about the chunk (Regions panel), paler in its soft border, and atlas the measure shown in "
          "the Atlas panel.",
          Choice{asByte(overlay.colourBy), colourByNames, colourByLabels}},
         {"overlay", "opacity", "Opacity",
          "Opacity of the tint. Smaller: more of the ground shows, but colours are harder to tell apart. At "
          "1, the colours are exactly those of the legend: neither light nor the atmosphere changes them.",
          Number{&overlay.opacity, {0, 1, ""}}, "Tint opacity"},
         {"overlay", "error_scale", "Midpoint",
          "Ratio ε / τ drawn in yellow; 0 is green, and twice this value or more is red.",
          Number{&overlay.errorScale, {0.01, 100, ""}, "%.2f x τ", logarithmic}},
         {"overlay", "delta_top_m", "Max δc",
          "Geometric error that is drawn lightest. The scale is logarithmic over the four decades below it.",
          Number{&overlay.deltaTopM, {0.01, 100000, "m"}, "%.4g", logarithmic}},
         {"overlay", "age_top_s", "Max age",
          "Time since loading that is drawn darkest; chunks just loaded are lightest.",
          Number{&overlay.ageTopS, {0.1, 3600, "s"}, "%.3g", logarithmic}},
         {"overlay", "outlines", "Outlines",
          "Draws chunk borders: red where finer chunks could not be read, amber where they will be retried.",
          Flag{&overlay.outlines}},
         {"overlay", "bounds", "Bounds",
          "Draws the bounding boxes used for distance and culling, which contain a chunk and its "
          "descendants. Slow with thousands of chunks.",
          Flag{&overlay.bounds}},
         {"overlay", "wireframe", "Wireframe",
          "Draws the mesh edges over a dimmed surface. Triangles smaller than about three pixels appear "
          "as uniform grey.",
          Flag{&overlay.wireframe}},
         {"overlay", "skirt_paint", "Skirts",
          "How skirts are drawn. As ground: with the colour of the ground. Highlighted: in one bright "
          "colour, so that every crack they fill is visible. Only skirts: in that colour, without the "
          "ground.",
          Choice{asByte(overlay.skirtPaint), skirtPaintNames, skirtPaintLabels}},
         {"overlay", "labels", "Labels",
          "Text at the centre of drawn chunks, nearest first, as far as there is room; ε in pixels. Costs a "
          "few tenths of a millisecond per frame.",
          Choice{asByte(overlay.labels), chunkLabelsNames, chunkLabelsLabels}},
         {"overlay", "cube", "Unprojected cube",
          "Draws the cube before it is projected onto the sphere. LOD selection still uses the sphere, "
          "so screen-space errors do not apply to this picture.",
          Flag{&overlay.cube}},
         {"overlay", "clipmap", "Clipmap",
          "Tints each clipmap level by its colour, if streamed colours use the clipmap (Surface panel). "
          "Texels filled in the last two seconds are magenta if the window moved, cyan if tiles were loaded "
          "or evicted. Freeze LOD or use an observer to see it from outside.",
          Flag{&overlay.clipmap}},
         {"overlay", "regions", "Region outlines",
          "Outlines the circles and polygons of the planet's regions (Regions panel) in the viewport and in "
          "the net of "
          "the Quadtree panel, each region in its colour. A region that is off has no outline.",
          Flag{&overlay.regions}},
         {"overlay", "sources", "Source outlines",
          "Draws what each layer of the source covers, on the planet and on the net of the Quadtree panel, "
          "in the layer's colour of the Sources panel. A layer that covers the planet has no outline.",
          Flag{&overlay.sources}},
         {"overlay", "notes", "Note pins",
          "Draws a pin with its first words where a note lies. A click opens the note. Off: the notes stay "
          "in the Notes "
          "panel.",
          Flag{&overlay.notes}}});
}

constexpr std::array<std::string_view, 2> surfaceLabels = {"image", "height ramp"};

void addSurface(Fields& fields, SurfaceSettings& surface) {
    fields.insert(
        fields.end(),
        {{"surface", "colour", "Colour",
          "Source of the ground colour: the colour image or a ramp of colours by height.",
          Choice{asByte(surface.surface), surfaceNames, surfaceLabels}, "Surface colour"},
         {"surface", "image_opacity", "Image opacity", "Opacity of the colour image over the ramp.",
          Number{&surface.imageOpacity, {0, 1, ""}}},
         {"surface", "streamed", "Streamed",
          "Draws the colours baked into the file, streamed as tiles. Off: the image beside the source, if "
          "there is one, otherwise the ramp.",
          Flag{&surface.streamed}},
         {"surface", "texels_per_pixel", "Texels per pixel",
          "A tile of colours is refined while it has fewer texels per screen pixel than this. Larger: "
          "sharper, but doubling it needs up to four times the tiles, and it may shimmer. Smaller: softer.",
          Number{&surface.texelsPerPixel, {0.1, 4, ""}, "%.2f", logarithmic}},
         {"surface", "colour_mode", "Sampling",
          "How streamed colours are sampled. Tiles: each pixel looks up its tile in a page table; as sharp "
          "everywhere as the loaded tiles. Clipmap: a stack of textures centred on the camera, filled from "
          "the same tiles; no page table lookup, but sharp only near the point under the camera, and it "
          "needs additional memory.",
          Choice{asByte(surface.colourMode), colourModeNames}},
         {"surface", "clipmap_size_px", "Window",
          "Texels along a side of each clipmap level, N, a power of two. Beyond a level's window the next "
          "coarser level is used: towards the horizon about N / (2 K') texels per pixel, K' = viewport width "
          "/ (2 tan(field of view / 2)). Smaller: blurred. Larger: memory grows with the square of the size.",
          Integer{&surface.clipmapSizePx, {256, 4096, "texels"}}, "Clipmap size"},
         {"surface", "ramp", "Height ramp",
          "Colours by height above sea level, lowest first; if empty, the built-in ramp is used.",
          Ramp{&surface.ramp}},
         {"surface", "sea", "Sea", "Draws ground below the sea level as sea. Off: dry land, as on the Moon.",
          Flag{&surface.sea}},
         {"surface", "sea_level_m", "Sea level",
          "Sea level above the planet's radius; ramp heights are relative to it. Affects only colour and "
          "light, not geometry.",
          Number{&surface.seaLevelM, {-20000, 20000, "m"}, "%.0f"}},
         {"surface", "exaggeration", "Exaggeration",
          "Factor applied to heights; errors, bounds and skirts scale with it. Larger: more chunks for the "
          "same tolerance.",
          Number{&surface.exaggeration, {0.1, 100, ""}, "%.2f x", logarithmic}},
         {"surface", "lighting", "Lighting",
          "Shades the ground by the sun. Off: flat colour, without sun and atmosphere.",
          Flag{&surface.lighting}},
         {"surface", "atmosphere", "Atmosphere",
          "Draws haze and the sky. Off: no atmosphere, as on the Moon.", Flag{&surface.atmosphere}},
         {"surface", "detail", "Detail",
          "Adds procedural roughness between the samples, to light and colour only; no measurement changes. "
          "Automatic: on, but off with software rendering.",
          Choice{asByte(surface.detail), featureUseNames}, "Surface detail"},
         {"surface", "sun_follows", "Sun follows",
          "Keeps the sun east of the camera, so it is always day there.", Flag{&surface.sunFollows}},
         {"surface", "sun_by_date", "Sun by date",
          "Places the sun by date and time over the Earth, if sun_follows is false.",
          Flag{&surface.sunByDate}},
         {"surface", "sun_year", "Year", "Year in the Gregorian calendar; it has little effect.",
          Integer{&surface.sunDate.year, {1950, 2050, ""}}},
         {"surface", "sun_month", "Month",
          "Month of the date. The subsolar latitude varies from 23.4° N in June to 23.4° S in December.",
          Integer{&surface.sunDate.month, {1, 12, ""}}},
         {"surface", "sun_day", "Day", "Day of the month, at most its last.",
          Integer{&surface.sunDate.day, {1, 31, ""}}},
         {"surface", "sun_hour", "Hour",
          "Universal time; noon in Greenwich is 12. The subsolar point moves 15° west per hour.",
          Number{&surface.sunDate.hour, {0, 24, "h"}}},
         {"surface", "sun_latitude_deg", "Sun latitude",
          "Latitude of the subsolar point, north positive; used if the sun is fixed, with sun_follows and "
          "sun_by_date false.",
          Number{&surface.sunLatitudeDeg, {-90, 90, "°"}, "%.0f"}},
         {"surface", "sun_longitude_deg", "Sun longitude",
          "Longitude of the subsolar point, east positive; used if the sun is fixed, with sun_follows and "
          "sun_by_date false.",
          Number{&surface.sunLongitudeDeg, {-180, 180, "°"}, "%.0f"}}});
}

void addLayers(Fields& fields, LayerSettings& layers) {
    fields.insert(
        fields.end(),
        {{"surface", "layer_use", "Layers",
          "Draws material textures on near ground. Automatic: on, but off with software rendering.",
          Choice{asByte(layers.use), featureUseNames}},
         {"surface", "layer_opacity", "Opacity", "Opacity of all layers over the image or the ramp.",
          Number{&layers.opacity, {0, 1, ""}}, "Layer opacity"},
         {"surface", "layer_begin_m", "Fade start",
          "Distance from the camera where layers begin to fade into the image or ramp.",
          Number{&layers.beginM, {0, 1e7, "m"}, "%.0f", logarithmic}},
         {"surface", "layer_end_m", "Fade end",
          "Distance from the camera where layers have faded out. Larger: layers cost time on more pixels and "
          "hide more of the image.",
          Number{&layers.endM, {1, 1e7, "m"}, "%.0f", logarithmic}},
         {"surface", "layer_colour_below", "Base-colour blend",
          "How much of the image or ramp colour tints the layers. 0 uses the layers' own colours, 1 only "
          "their pattern. Larger: a less visible transition from far to near.",
          Number{&layers.colourBelow, {0, 1, ""}}},
         {"surface", "layer_preview", "Preview",
          "Shows the weight of the selected layer over the whole planet. Heat: violet 0, green 0.5, yellow "
          "1. Mask: black 0, white 1, without the ground.",
          Choice{asByte(layers.preview), layerPreviewNames}, "Layer preview"},
         {"surface", "layer_previewed", "Previewed layer", "Index of the previewed layer, from the lowest.",
          Integer{&layers.previewed, {1, static_cast<double>(planet::maxLayers), ""}}},
         {"surface", "layer_blend", "Blend by",
          "How overlapping layers are blended. Weight: by their weights. Height: the layer with the higher "
          "relief wins, so sand lies between stones.",
          Choice{asByte(layers.set.blend), layerBlendNames}},
         {"surface", "layer_blend_depth", "Blend depth",
          "Depth for blending by height. A layer lower by this depth keeps 2 % of its weight; relief and "
          "weight are in [0, 1]. Smaller: sharper borders.",
          Number{&layers.set.blendDepth, {0.05, 2, ""}}},
         {"surface", "layer_set", "Layer set",
          "Layer set file that texture paths are relative to; if empty, the built-in textures are used.",
          Text{&layers.file}},
         {"surface", "layers", "Layer stack",
          "Layers, lowest first; data/layers/earth.toml describes their fields.",
          LayerStack{&layers.set.layers}}});
}

void addAir(Fields& fields, planet::gl::AirDrawing& air) {
    fields.insert(
        fields.end(),
        {{"light", "air_rayleigh", "Rayleigh",
          "Rayleigh scattering by air molecules, relative to the Earth. It scatters blue most. Larger: a "
          "bluer sky, a paler horizon, a redder sunset and fainter distant ground.",
          Number{&air.settings.rayleigh, {0, 5, ""}, "%.2f x"}},
         {"light", "air_haze", "Haze",
          "Mie scattering by dust and droplets, relative to a clear day. It scatters all colours alike and "
          "mostly forward. Larger: a whiter horizon, and distant ground fades.",
          Number{&air.settings.haze, {0, 20, ""}, "%.2f x", logarithmic}},
         {"light", "air_ozone", "Ozone",
          "Ozone absorption relative to the Earth. Ozone absorbs green and red light at high altitude, which "
          "keeps the zenith blue at dusk. At 0 the zenith turns yellowish.",
          Number{&air.settings.ozone, {0, 5, ""}, "%.2f x"}},
         {"light", "air_forward", "Mie asymmetry g",
          "How strongly haze scatters forward; 0 scatters evenly. Larger: a smaller and brighter glow around "
          "the sun.",
          Number{&air.settings.forward, {0, 0.95, ""}}},
         {"light", "air_thickness", "Scale height",
          "Scale heights relative to the Earth: 8 km for molecules, 1.2 km for haze. Larger: a broader limb "
          "and more air in total.",
          Number{&air.settings.thickness, {0.25, 4, ""}, "%.2f x"}},
         {"light", "air_exposure", "Exposure",
          "Factor applied to all light. At 1 the ground by day is as bright as with the analytic model. "
          "Larger: dusk is easier to see, and bright ground saturates.",
          Number{&air.exposure, {0.1, 10, ""}, "%.2f x", logarithmic}},
         {"light", "air_steps", "Steps",
          "Ray-march steps through the whole atmosphere; half as many in front of ground, fewer where it is "
          "near. Fewer: a cheaper frame, and a rougher limb and dusk.",
          Integer{&air.steps, {8, 64, ""}}}});
}

void addLight(Fields& fields, planet::gl::LightDrawing& light) {
    fields.insert(
        fields.end(),
        {{"light", "air", "Physical model",
          "Draws the physical atmosphere. Molecules, haze and ozone scatter and absorb light as in the "
          "Earth's atmosphere, with multiple scattering. Off: an analytic model, which costs almost nothing "
          "and leaves the ground more contrast. Automatic: on, but off with software rendering.",
          Choice{asByte(light.air.use), featureUseNames}},
         {"light", "sea", "Sea surface",
          "Draws water at the sea level. It has waves, reflections of the sky and the sun, and a colour that "
          "depends on the depth. Off: flat colours on the sea bed. Measurements always use the bed.",
          Choice{asByte(light.sea.use), featureUseNames}},
         {"light", "sea_wind_mps", "Wind",
          "Wind speed 12.5 m above the water. The variance of the wave slopes is 0.003 + 0.00512 wind (Cox "
          "and Munk). Larger: the sun's glint is wider and dimmer.",
          Number{&light.sea.windMps, {0, 30, "m/s"}, "%.1f"}},
         {"light", "sea_clarity_m", "Clarity",
          "Depth of water that reduces green light to 1/e; red is absorbed five times as fast. Larger: the "
          "bed shows at greater depth.",
          Number{&light.sea.clarityM, {0.5, 100, "m"}, "%.1f", logarithmic}},
         {"light", "sea_waves", "Waves",
          "Strength of the resolved waves, 1.3 to 110 m long. They stand still so that pictures can be "
          "compared.",
          Number{&light.sea.waves, {0, 2, ""}}},
         {"light", "shadows", "Shadows",
          "Shadows of the ground on itself, from the drawn mesh, in three shadow map cascades. They show how "
          "level of detail affects shadows.",
          Choice{asByte(light.shadows.use), featureUseNames}},
         {"light", "shadow_map_px", "Map size",
          "Side of each of the three shadow maps; 12 bytes per pixel in total. Larger: sharper and slower.",
          Integer{&light.shadows.mapSizePx, {256, 8192, "px"}, logarithmic}, "Shadow map size"},
         {"light", "shadow_reach_m", "Shadow distance",
          "Distance from the camera where shadows end. Larger: shadows are coarser everywhere, and more "
          "chunks beside the view are drawn for them.",
          Number{&light.shadows.reachM, {1000, 1e7, "m"}, "%.0f", logarithmic}},
         {"light", "shadow_softness", "Softness",
          "Filter radius at shadow edges, in texels of the map. Larger: softer, and thin shadows fade.",
          Number{&light.shadows.softness, {0, 4, "texels"}, "%.1f"}},
         {"light", "normals", "Fine normals",
          "Lights coarse chunks by slopes of the finest heights, up to the screen resolution, using tiles "
          "derived from the file's heights. Off: lights by vertex normals, which are smooth where the mesh "
          "is coarse; no memory is needed.",
          Choice{asByte(light.normals.use), featureUseNames}},
         {"light", "normal_texels_per_pixel", "Texels per pixel",
          "A tile of normals is refined while it has fewer texels per screen pixel than this. Larger: "
          "sharper, but doubling it needs up to four times the tiles, and it may shimmer. Smaller: softer.",
          Number{&light.normals.texelsPerPixel, {0.1, 4, ""}, "%.2f", logarithmic},
          "Fine normals, texels per pixel"},
         {"light", "fill", "Fill light",
          "Strength of a debug light on the night side, from the upper left of the view; 0 is off. It is "
          "off for tinted chunks, comparisons and sweeps.",
          Number{&light.fill, {0, 1, ""}}}});
    addAir(fields, light.air);
}

constexpr std::array<std::string_view, 3> cameraModeLabels = {"fly", "orbit", "follow a flight"};

void addView(Fields& fields, CameraSettings& camera) {
    fields.insert(
        fields.end(),
        {{"view", "fov_deg", "Field of view",
          "Horizontal field of view. Smaller: errors are magnified, so more detail is selected; K' = W / (2 "
          "tan(fov / 2)).",
          Number{&camera.fovDeg, {5, 150, "°"}, "%.0f"}},
         {"view", "mode", "Mode",
          "How the camera moves. Fly: drag moves the ground, the keys W A S D E Q move the camera. Orbit: "
          "drag turns the camera around the ground point in the centre of the view, the wheel changes the "
          "distance, the right button moves the point. Follow a flight: plays a recorded camera path; using "
          "the controls ends it.",
          Choice{asByte(camera.mode), cameraModeNames, cameraModeLabels}, "Camera mode"},
         {"view", "observer", "View",
          "A second camera that shows the LOD view's selection and culling from outside. Split: both views "
          "side by side. The planet is drawn twice.",
          Choice{asByte(camera.observer), observerModeNames}, "Observer"},
         {"view", "observer_own_lod", "Own LOD",
          "The observer uses its own LOD selection and requests instead of the LOD view's. This loads more "
          "chunks.",
          Flag{&camera.observerOwnLod}},
         {"view", "show_frustum", "Frustum",
          "Draws the edges of the LOD view's frustum in the observer's picture, up to the farthest visible "
          "ground.",
          Flag{&camera.showFrustum}},
         {"view", "show_horizon", "Horizon",
          "Draws the LOD view's horizon circle in the observer's picture, beyond which the planet occludes "
          "itself.",
          Flag{&camera.showHorizon}},
         {"view", "show_switch_distances", "Switch distance",
          "Draws the switch distance d_m = δc K around the selected chunk, K = W / (2 τ tan(fov / 2)). A "
          "camera within this distance requires the chunk to be split. Leaves have none.",
          Flag{&camera.showSwitchDistances}},
         {"view", "flight", "Flight", "File of the flight to follow.", Text{&camera.flight}}});
}

void addCamera(Fields& fields, planet::CameraPose& pose) {
    fields.insert(
        fields.end(),
        {{"camera", "latitude_deg", "Start latitude", "Latitude at the start, north positive.",
          Number{&pose.latitudeDeg, {-90, 90, "°"}}},
         {"camera", "longitude_deg", "Start longitude", "Longitude at the start, east positive.",
          Number{&pose.longitudeDeg, {-360, 360, "°"}}},
         {"camera", "altitude_m", "Start altitude",
          "Altitude at the start above the planet's radius; 0 shows the whole planet.",
          Number{&pose.altitudeM, {-1e6, 2e10, "m"}}},
         {"camera", "heading_deg", "Start heading", "Heading at the start: 0 is north, 90 is east.",
          Number{&pose.headingDeg, {-360, 360, "°"}}},
         {"camera", "pitch_deg", "Start pitch", "Pitch at the start: -90 looks straight down, 0 is level.",
          Number{&pose.pitchDeg, {-90, 90, "°"}}}});
}

void addWindow(Fields& fields, Settings& s) {
    Workspace& workspace = s.workspace;
    fields.insert(
        fields.end(),
        {{"window", "width_px", "Window width", "Width of the window.",
          Integer{&s.windowWidthPx, {640, 16384, "px"}}},
         {"window", "height_px", "Window height", "Height of the window.",
          Integer{&s.windowHeightPx, {400, 16384, "px"}}},
         {"window", "second_x_px", "Second window: left", "Place of the second window on the screen.",
          Integer{&s.secondWindow.x, {SecondWindowPlace::nowhere, 32767, "px"}}},
         {"window", "second_y_px", "Second window: top", "Place of the second window on the screen.",
          Integer{&s.secondWindow.y, {SecondWindowPlace::nowhere, 32767, "px"}}},
         {"window", "second_width_px", "Second window: width", "Width of the second window.",
          Integer{&s.secondWindow.width, {320, 16384, "px"}}},
         {"window", "second_height_px", "Second window: height", "Height of the second window.",
          Integer{&s.secondWindow.height, {200, 16384, "px"}}},
         {"window", "left_width", "Left dock", "Width of the left dock, in units that follow the font.",
          Number{&workspace.leftWidth, {160, 1000, ""}}},
         {"window", "right_width", "Right dock", "Width of the right dock, in units that follow the font.",
          Number{&workspace.rightWidth, {160, 1000, ""}}},
         {"window", "bottom_height", "Bottom dock",
          "Height of the bottom dock, in units that follow the font.",
          Number{&workspace.bottomHeight, {60, 1000, ""}}},
         {"window", "theme", "Theme", "Colours of the user interface.",
          Choice{asByte(workspace.preferences.theme), themeNames}},
         {"window", "scale", "Scale", "Scale of text and controls, relative to the monitor's scale.",
          Number{&workspace.preferences.scale, {0.5, 3, ""}}},
         {"window", "idle", "Idle when still",
          "Draws frames only while something changes, which saves power. Turn it off to watch frame times "
          "without a pause.",
          Flag{&workspace.preferences.idle}},
         {"window", "vsync", "Wait for the monitor",
          "Draws at most as many frames as the monitor shows. Turn it off to draw as fast as the machine "
          "can.",
          Flag{&workspace.preferences.vsync}},
         {"window", "frame_limit", "Frame limit",
          "Most frames drawn in a second; 0 is no limit. A limit leaves power and processor time to other "
          "programs.",
          Integer{&workspace.preferences.frameLimit, {0, 1000, ""}}},
         {"window", "resume", "Go on with the last session",
          "Without a file on the command line, opens what the last session showed: the planet, the camera, "
          "the "
          "trace, the comparison and the ruler.",
          Flag{&workspace.preferences.resume}},
         {"window", "glide", "Glide to places",
          "The camera glides to bookmarks, places, notes and its start in about a second. Off: it jumps "
          "there.",
          Flag{&workspace.preferences.glide}},
         {"window", "steering", "Sensitivity",
          "How fast gamepads and 3-D mice move and turn the camera. At 1, a stick at its end does as much as "
          "a "
          "key that is held.",
          Number{&workspace.preferences.steering, {0.1, 5, ""}, "%.2f x", logarithmic},
          "Steering sensitivity"},
         {"window", "invert_steering", "Invert up and down",
          "Pushing the right stick of a gamepad forward looks down, and tilting a 3-D mouse forward looks "
          "up. Off: "
          "the stick looks up, and the 3-D mouse down.",
          Flag{&workspace.preferences.invertSteering}}});
}

// The panels' keys in the order of PanelId, like panelInfos.
constexpr std::array<std::string_view, panelCount> panelKeys = [] {
    std::array<std::string_view, panelCount> keys;
    for (const PanelInfo& info : panelInfos) keys[static_cast<std::size_t>(info.id)] = info.key;
    return keys;
}();

// The texts of a panel's settings, derived from its title.
struct PanelTexts {
    std::string label, help, shownKey, shownLabel, shownHelp;
};
struct DockTexts {
    std::string key, label, help;
};

const std::array<PanelTexts, panelCount>& panelTexts() {
    static const std::array<PanelTexts, panelCount> texts = [] {
        std::array<PanelTexts, panelCount> made;
        for (std::size_t i = 0; i < panelCount; ++i) {
            const PanelInfo& info = panelInfos[i];
            made[i] = {fmt::format("{}: dock", info.title), fmt::format("Dock of the {} panel.", info.title),
                       fmt::format("{}_shown", info.key), fmt::format("{}: shown", info.title),
                       fmt::format("Shows the {} panel.", info.title)};
        }
        return made;
    }();
    return texts;
}

const std::array<DockTexts, dockCount>& dockTexts() {
    static const std::array<DockTexts, dockCount> texts = [] {
        constexpr std::array<const char*, dockCount> titles = {"left dock", "right dock", "bottom dock",
                                                               "second window"};
        std::array<DockTexts, dockCount> made;
        for (std::size_t i = 0; i < dockCount; ++i)
            made[i] = {fmt::format("{}_front", dockNames[i]), fmt::format("Front of {}", titles[i]),
                       fmt::format("Panel in front in the {}.", titles[i])};
        return made;
    }();
    return texts;
}

void addPanels(Fields& fields, Workspace& workspace) {
    for (std::size_t dock = 0; dock < dockCount; ++dock) {
        const DockTexts& texts = dockTexts()[dock];
        fields.push_back({"panels", texts.key, texts.label, texts.help,
                          Choice{asByte(workspace.inFront[dock]), panelKeys}});
    }
    for (std::size_t i = 0; i < panelCount; ++i) {
        const PanelTexts& texts = panelTexts()[i];
        PanelPlace& place = workspace.panels[static_cast<std::size_t>(panelInfos[i].id)];
        fields.push_back(
            {"panels", panelInfos[i].key, texts.label, texts.help, Choice{asByte(place.dock), dockNames}});
        fields.push_back({"panels", texts.shownKey, texts.shownLabel, texts.shownHelp, Flag{&place.shown}});
    }
    fields.push_back(
        {"panels", "maximised", "Maximised dock",
         "Dock that fills the window between the menu bar and the status bar; viewport: all panels are "
         "away.",
         Choice{asByte(workspace.maximised), maximisedDockNames}});
    fields.push_back(
        {"panels", "order", "Order of the tabs",
         "Order of the tabs in all docks, as keys of panels. Panels that are not listed follow in "
         "their default order.",
         TabOrder{&workspace.order}});
    fields.push_back(
        {"panels", "floating", "Floating panels",
         "Panels in windows of their own. x and y are shares of the free room: 0 is the left or "
         "the top, 1 the right or the bottom. Width and height are in units that follow the font.",
         FloatingPanels{&workspace.panels}});
}

void addCracks(Fields& fields, CrackSettings& cracks) {
    fields.insert(
        fields.end(),
        {{"cracks", "live", "Measure while flying",
          "Measures cracks every few frames. Each measurement takes at least as long as drawing three "
          "frames, so the picture stutters.",
          Flag{&cracks.live}},
         {"cracks", "every_frames", "Every",
          "Number of frames between crack measurements. Fewer: lower frame rate. More: less current values.",
          Integer{&cracks.everyFrames, {1, 1000, "frames"}}, "Crack measurement every"},
         {"cracks", "mark", "Highlight in viewport",
          "Highlights crack pixels in the viewport, each several pixels wide, while the view is the measured "
          "one.",
          Flag{&cracks.mark}}});
}

void addCompare(Fields& fields, CompareSettings& compare) {
    fields.insert(
        fields.end(),
        {{"compare", "mode", "Show",
          "How the pictures A and B are shown. Side by side: the middle half of each picture at the same "
          "pixel size. Wipe: a movable divider. Difference: colour difference. Flip: one picture "
          "at a time.",
          Choice{asByte(compare.mode), compareModeNames}, "Compare: show"},
         {"compare", "gain", "Gain",
          "Factor applied to the difference of each channel. 255: any difference is full brightness.",
          Number{&compare.gain, {1, 255, ""}, "%.0f x", logarithmic}},
         {"compare", "wipe", "Divider",
          "Position of the divider as a fraction of the width, with A on the left and B on the right. You "
          "can also drag it in the viewport.",
          Number{&compare.wipe, {0, 1, ""}}},
         {"compare", "show_b", "Show B", "Shows B in flip mode. Off: shows A.", Flag{&compare.showB}}});
}

void addViewSettings(Fields& fields, ViewSettings& view) {
    addLod(fields, view.lod);
    addRegions(fields, view.regions);
    addBudget(fields, view.budget);
    addSeams(fields, view.lod, view.overlay);
    addPaging(fields, view.paging);
    addOverlay(fields, view.overlay);
    addSurface(fields, view.surface);
    addLayers(fields, view.surface.layers);
    addLight(fields, view.surface.light);
    addView(fields, view.camera);
    addCracks(fields, view.cracks);
    addCompare(fields, view.compare);
}

// The size of the largest list, so that it is allocated once.
constexpr std::size_t fieldCount = 145 + 2 * panelCount + dockCount;

}  // namespace

std::string Field::name() const {
    return fmt::format("{}.{}", table, key);
}

const void* Field::address() const {
    return std::visit([](const auto& of) { return static_cast<const void*>(of.value); }, value);
}

std::vector<Field> fieldsOf(Settings& settings) {
    Fields fields;
    fields.reserve(fieldCount);
    addData(fields, settings);
    addViewSettings(fields, settings.view);
    addCamera(fields, settings.camera);
    addWindow(fields, settings);
    addPanels(fields, settings.workspace);
    return fields;
}

std::vector<Field> fieldsOf(ViewSettings& view) {
    Fields fields;
    fields.reserve(fieldCount);
    addViewSettings(fields, view);
    return fields;
}

std::span<const Field> defaultFields() {
    static Settings defaults;
    static const Fields fields = fieldsOf(defaults);
    return fields;
}

const Field& defaultField(std::string_view name) {
    const Field* field = findField(defaultFields(), name);
    assert(field);
    return *field;
}

const Field& defaultOf(const Field& field) {
    const std::span<const Field> fields = defaultFields();
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& one) {
        return one.key == field.key && one.table == field.table;
    });
    assert(found != fields.end());
    return *found;
}

const NumberRange& rangeOf(std::string_view name) {
    const Field& field = defaultField(name);
    if (const Integer* integer = std::get_if<Integer>(&field.value)) return integer->range;
    return std::get<Number>(field.value).range;
}

bool isViewTable(std::string_view table) {
    return table != "data" && table != "camera" && table != "window" && table != "panels";
}

bool isLayoutField(const Field& field) {
    if (field.table == "panels") return true;
    return field.table == "window" &&
           (field.key == "left_width" || field.key == "right_width" || field.key == "bottom_height");
}

const Field* findField(std::span<const Field> fields, std::string_view name) {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) {
        const std::size_t dot = field.table.size();
        return name.size() == dot + 1 + field.key.size() && name[dot] == '.' &&
               name.starts_with(field.table) && name.ends_with(field.key);
    });
    return found == fields.end() ? nullptr : &*found;
}

std::string_view titleOf(const Field& field) {
    return field.title.empty() ? field.label : field.title;
}

std::string_view firstSentence(const Field& field) {
    const std::size_t end = field.help.find(". ");
    return end == std::string_view::npos ? field.help : field.help.substr(0, end + 1);
}

std::string choiceLabel(const Choice& choice, std::size_t index) {
    if (!choice.labels.empty()) return std::string(choice.labels[index]);
    std::string label(choice.names[index]);
    std::replace(label.begin(), label.end(), '_', ' ');
    return label;
}

void copyValue(const Field& from, const Field& to) {
    std::visit(
        [&](const auto& target) {
            using Kind = std::decay_t<decltype(target)>;
            const auto& source = *std::get<Kind>(from.value).value;
            if constexpr (std::is_same_v<Kind, FloatingPanels>) {
                // The docks in the same array are settings of their own.
                for (std::size_t i = 0; i < panelCount; ++i) {
                    (*target.value)[i].floats = source[i].floats;
                    (*target.value)[i].floating = source[i].floating;
                }
            } else {
                *target.value = source;
            }
        },
        to.value);
}

Field movedTo(const Field& field, Settings& settings) {
    const std::vector<Field> fields = fieldsOf(settings);
    Field moved = field;
    std::visit(
        [&](auto& kind) {
            kind.value = std::get<std::decay_t<decltype(kind)>>(findField(fields, field.name())->value).value;
        },
        moved.value);
    return moved;
}

}  // namespace worldy
