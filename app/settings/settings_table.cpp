#include "app/settings/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <type_traits>

#include "app/base/colour_text.h"
#include "app/settings/layer_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::size_t maxRampStops = 32;

// The enumerations are bytes, so one kind of field serves them all.
template <class Enum>
std::uint8_t* asByte(Enum& value) {
    static_assert(sizeof(Enum) == 1);
    return reinterpret_cast<std::uint8_t*>(&value);
}

using Fields = std::vector<Field>;

void addData(Fields& fields, Settings& s) {
    fields.insert(fields.end(),
                  {{"data", "set", "Chunk file, elevation image or cube faces to open; empty: the Earth.",
                    Text{&s.dataSet}},
                   {"data", "colour_image",
                    "Colour image of the planet; empty: colour.jpg or colour.png beside the data set.",
                    Text{&s.colourImage}}});
}

void addLod(Fields& fields, LodKnobs& lod) {
    fields.insert(
        fields.end(),
        {{"lod", "tau_px",
          "Screen-space error threshold tau, pixels; larger: fewer triangles, more visible error.",
          Number{&lod.tauPx, {smallestTauPx, largestTauPx, "px"}}},
         {"lod", "hysteresis", "Fraction of tau by which a merge is delayed after a split.",
          Number{&lod.hysteresis, {0, 0.9, ""}}},
         {"lod", "max_level", "Deepest level drawn.", Integer{&lod.maxLevel, {0, 20, ""}}},
         {"lod", "morph", "Morph chunks onto their parents before they merge; false: they pop.",
          Flag{&lod.morph}},
         {"lod", "morph_range", "Fraction of tau over which chunks morph.",
          Number{&lod.morphRange, {0.01, 4, ""}}},
         {"lod", "frustum_culling", "Skip chunks outside the view frustum.", Flag{&lod.frustumCulling}},
         {"lod", "horizon_culling", "Skip chunks below the horizon.", Flag{&lod.horizonCulling}},
         {"lod", "metric", "Geometric error metric: additive (safe) or tight (fewer triangles).",
          Choice{asByte(lod.metric), errorMetricNames}},
         {"lod", "fade_s", "Minimum duration of a morph, seconds; 0: late level changes pop.",
          Number{&lod.fadeS, {0, 10, "s"}}}});
}

void addSeams(Fields& fields, SeamKnobs& seams) {
    fields.insert(
        fields.end(),
        {{"seams", "mode", "What hides cracks between chunks: none, skirts or stitched.",
          Choice{asByte(seams.mode), seamModeNames}},
         {"seams", "depth", "Skirt depth: automatic or fixed.", Choice{asByte(seams.depth), skirtDepthNames}},
         {"seams", "skirt_factor", "Automatic skirt depth relative to the errors it must hide.",
          Number{&seams.skirtFactor, {0, 10, ""}}},
         {"seams", "skirt_depth_m", "Fixed skirt depth, metres.",
          Number{&seams.skirtDepthM, {0, 100000, "m"}}},
         {"seams", "show_pairs", "Highlight edges between chunks of different levels.",
          Flag{&seams.showPairs}}});
}

void addPaging(Fields& fields, PagingKnobs& paging) {
    planet::BadDiskSettings& disk = paging.badDisk;
    fields.insert(
        fields.end(),
        {{"paging", "budget_mb",
          "Memory budget for resident chunks and colour tiles, CPU and GPU together, MiB.",
          Integer{&paging.budgetMB, {16, 65536, "MiB"}}},
         {"paging", "loader_threads", "Number of loader threads.",
          Integer{&paging.loaderThreads, {1, 64, "threads"}}},
         {"paging", "upload_limit_ms", "Time per frame for uploading loaded chunks, milliseconds.",
          Number{&paging.uploadLimitMs, {0.1, 100, "ms"}}},
         {"paging", "colour_share", "Fraction of the budget for streamed colours.",
          Number{&paging.colourShare, {0.01, 0.9, ""}}},
         {"paging", "normal_share",
          "Fraction of the budget that colours leave, for normals finer than the mesh.",
          Number{&paging.normalShare, {0.01, 0.9, ""}}},
         {"paging", "retries", "Number of automatic retries of a failed read.",
          Integer{&paging.retries, {0, 10, "retries"}}},
         {"paging", "retry_delay_s",
          "Delay before the first retry, seconds; it doubles with each further retry.",
          Number{&paging.retryDelayS, {0, 60, "s"}}},
         {"paging", "simulated",
          "Simulate read times by the fault-injection settings and seed, in frame time instead of real time.",
          Flag{&paging.simulated}},
         {"bad_disk", "latency_ms", "I/O fault injection: latency added to each read, milliseconds.",
          Number{&disk.latencyMs, {0, 10000, "ms"}}},
         {"bad_disk", "bandwidth_mb_s", "Bandwidth per loader thread, MB/s (10^6 bytes); 0: unlimited.",
          Number{&disk.bandwidthMBs, {0, 100000, "MB/s"}}},
         {"bad_disk", "failure_rate", "Fraction of reads that fail.", Number{&disk.failureRate, {0, 1, ""}}},
         {"bad_disk", "shuffled_order", "Serve reads in random order instead of by priority.",
          Flag{&disk.shuffledOrder}},
         {"bad_disk", "seed", "Seed of the injected faults.", Seed{&disk.seed}}});
}

void addOverlay(Fields& fields, OverlaySettings& overlay) {
    fields.insert(
        fields.end(),
        {{"overlay", "colour_by",
          "Quantity that tints chunks: none, level, error, delta_c, morph, age, load_order or measured.",
          Choice{asByte(overlay.colourBy), colourByNames}},
         {"overlay", "opacity", "Opacity of the tint.", Number{&overlay.opacity, {0, 1, ""}}},
         {"overlay", "error_scale", "Screen-space error relative to tau that is tinted yellow.",
          Number{&overlay.errorScale, {0.01, 100, ""}}},
         {"overlay", "delta_top_m", "Upper end of the delta_c scale, metres.",
          Number{&overlay.deltaTopM, {0.01, 100000, "m"}}},
         {"overlay", "age_top_s", "Upper end of the age scale, seconds.",
          Number{&overlay.ageTopS, {0.1, 3600, "s"}}},
         {"overlay", "outlines", "Draw chunk borders.", Flag{&overlay.outlines}},
         {"overlay", "bounds", "Draw bounding volumes.", Flag{&overlay.bounds}},
         {"overlay", "wireframe", "Draw triangle edges.", Flag{&overlay.wireframe}},
         {"overlay", "skirt_paint",
          "Skirt colour: as_ground, loud (highlighted), or loud_alone (only skirts are drawn).",
          Choice{asByte(overlay.skirtPaint), skirtPaintNames}},
         {"overlay", "labels", "Labels on chunks: none, level, error or level_and_error.",
          Choice{asByte(overlay.labels), chunkLabelsNames}},
         {"overlay", "cube", "Draw the unprojected cube.", Flag{&overlay.cube}},
         {"overlay", "clipmap", "Tint clipmap levels and recently updated texels.", Flag{&overlay.clipmap}}});
}

void addSurface(Fields& fields, SurfaceSettings& surface) {
    fields.insert(
        fields.end(),
        {{"surface", "colour", "Ground colour: image or height ramp.",
          Choice{asByte(surface.surface), surfaceNames}},
         {"surface", "image_opacity", "Opacity of the image over the ramp.",
          Number{&surface.imageOpacity, {0, 1, ""}}},
         {"surface", "streamed", "Draw the colours baked into the file, if any, instead of an image.",
          Flag{&surface.streamed}},
         {"surface", "texels_per_pixel",
          "Texels per pixel of streamed colours; larger: sharper, but more memory.",
          Number{&surface.texelsPerPixel, {0.1, 4, ""}}},
         {"surface", "colour_mode", "Sampling of streamed colours: tiles or clipmap.",
          Choice{asByte(surface.colourMode), colourModeNames}},
         {"surface", "clipmap_size_px", "Texels along a side of a clipmap level; a power of two.",
          Integer{&surface.clipmapSizePx, {256, 4096, "texels"}}},
         {"surface", "ramp", "Colours by height above sea level, lowest first; empty: the built-in ramp.",
          Ramp{&surface.ramp}},
         {"surface", "sea", "Draw ground below the sea level as sea; false: dry land.", Flag{&surface.sea}},
         {"surface", "sea_level_m", "Sea level, metres above the planet's radius.",
          Number{&surface.seaLevelM, {-20000, 20000, "m"}}},
         {"surface", "exaggeration", "Factor applied to heights when drawing.",
          Number{&surface.exaggeration, {0.1, 100, ""}}},
         {"surface", "lighting", "Shade the ground by the sun; false: flat colour.", Flag{&surface.lighting}},
         {"surface", "atmosphere", "Draw the atmosphere.", Flag{&surface.atmosphere}},
         {"surface", "detail", "Add procedural roughness between the samples; only visual.",
          Flag{&surface.detail}},
         {"surface", "sun_follows", "Keep the sun east of the camera, so it is always day there.",
          Flag{&surface.sunFollows}},
         {"surface", "sun_by_date",
          "If sun_follows is false: place the sun by date and time over the Earth, universal time.",
          Flag{&surface.sunByDate}},
         {"surface", "sun_year", "Year.", Integer{&surface.sunDate.year, {1950, 2050, ""}}},
         {"surface", "sun_month", "Month.", Integer{&surface.sunDate.month, {1, 12, ""}}},
         {"surface", "sun_day", "Day, at most the last of the month.",
          Integer{&surface.sunDate.day, {1, 31, ""}}},
         {"surface", "sun_hour", "Hour, with a fraction.", Number{&surface.sunDate.hour, {0, 24, "h"}}},
         {"surface", "sun_latitude_deg", "If both are false: latitude of the subsolar point, degrees north.",
          Number{&surface.sunLatitudeDeg, {-90, 90, "°"}}},
         {"surface", "sun_longitude_deg", "Longitude of the subsolar point, degrees east.",
          Number{&surface.sunLongitudeDeg, {-180, 180, "°"}}}});
}

void addAir(Fields& fields, planet::gl::AirDrawing& air) {
    fields.insert(
        fields.end(),
        {{"light", "air_rayleigh", "Rayleigh scattering of the physical atmosphere, relative to the Earth.",
          Number{&air.settings.rayleigh, {0, 5, ""}}},
         {"light", "air_haze", "Mie scattering (haze), relative to a clear day.",
          Number{&air.settings.haze, {0, 20, ""}}},
         {"light", "air_ozone", "Ozone absorption, relative to the Earth.",
          Number{&air.settings.ozone, {0, 5, ""}}},
         {"light", "air_forward", "Mie asymmetry g: how strongly haze scatters forward.",
          Number{&air.settings.forward, {0, 0.95, ""}}},
         {"light", "air_thickness", "Scale heights, relative to the Earth.",
          Number{&air.settings.thickness, {0.25, 4, ""}}},
         {"light", "air_exposure", "Exposure; 1: ground by day as bright as with the analytic atmosphere.",
          Number{&air.exposure, {0.1, 10, ""}}},
         {"light", "air_steps", "Ray-march steps through the whole atmosphere; fewer: cheaper and rougher.",
          Integer{&air.steps, {8, 64, ""}}}});
}

void addLight(Fields& fields, planet::gl::LightDrawing& light) {
    fields.insert(
        fields.end(),
        {{"light", "air", "Physical atmosphere: automatic (off with software rendering), on or off.",
          Choice{asByte(light.air.use), featureUseNames}},
         {"light", "sea", "Sea surface with waves, reflections and depth: automatic, on or off.",
          Choice{asByte(light.sea.use), featureUseNames}},
         {"light", "sea_wind_mps", "Wind speed over the sea; larger: a wider glint of the sun.",
          Number{&light.sea.windMps, {0, 30, "m/s"}}},
         {"light", "sea_clarity_m", "Depth of water that reduces green light to 1/e.",
          Number{&light.sea.clarityM, {0.5, 100, "m"}}},
         {"light", "sea_waves", "Strength of the resolved waves.", Number{&light.sea.waves, {0, 2, ""}}},
         {"light", "shadows", "Terrain shadows: automatic, on or off.",
          Choice{asByte(light.shadows.use), featureUseNames}},
         {"light", "shadow_map_px", "Side of each shadow map, pixels; larger: sharper.",
          Integer{&light.shadows.mapSizePx, {256, 8192, "px"}}},
         {"light", "shadow_reach_m", "Shadow distance from the camera, metres; larger: coarser everywhere.",
          Number{&light.shadows.reachM, {1000, 1e7, "m"}}},
         {"light", "shadow_softness", "Radius of the shadow filter, texels of the map.",
          Number{&light.shadows.softness, {0, 4, "texels"}}},
         {"light", "normals", "Normals finer than the mesh: automatic, on or off.",
          Choice{asByte(light.normals.use), featureUseNames}},
         {"light", "normal_texels_per_pixel",
          "Texels per pixel of fine normals; larger: sharper, but more memory.",
          Number{&light.normals.texelsPerPixel, {0.1, 4, ""}}},
         {"light", "fill", "Debug light on the night side; pictures that measure are drawn without it.",
          Number{&light.fill, {0, 1, ""}}}});
    addAir(fields, light.air);
}

void addLayers(Fields& fields, LayerSettings& layers) {
    fields.insert(
        fields.end(),
        {{"surface", "layer_use",
          "Texture layers on near ground: automatic (off with software rendering), on or off.",
          Choice{asByte(layers.use), featureUseNames}},
         {"surface", "layer_opacity", "Opacity of the layers over the image or ramp.",
          Number{&layers.opacity, {0, 1, ""}}},
         {"surface", "layer_begin_m", "Distance from the camera where layers begin to fade, metres.",
          Number{&layers.beginM, {0, 1e7, "m"}}},
         {"surface", "layer_end_m", "Distance from the camera where layers have faded out, metres.",
          Number{&layers.endM, {1, 1e7, "m"}}},
         {"surface", "layer_colour_below",
          "Base-colour blend: how much of the image or ramp colour tints the layers.",
          Number{&layers.colourBelow, {0, 1, ""}}},
         {"surface", "layer_preview", "Preview of a layer's weight over the planet: off, heat or mask.",
          Choice{asByte(layers.preview), layerPreviewNames}},
         {"surface", "layer_previewed", "Index of the previewed layer, from the lowest.",
          Integer{&layers.previewed, {1, static_cast<double>(planet::maxLayers), ""}}},
         {"surface", "layer_blend", "Blend layers by weight, or by height: the higher relief wins.",
          Choice{asByte(layers.set.blend), layerBlendNames}},
         {"surface", "layer_blend_depth", "Depth for blending by height.",
          Number{&layers.set.blendDepth, {0.05, 2, ""}}},
         {"surface", "layer_set",
          "Layer set file that texture paths are relative to; empty: the built-in textures.",
          Text{&layers.file}},
         {"surface", "layers", "Layers, lowest first; data/layers/earth.toml describes their fields.",
          LayerStack{&layers.set.layers}}});
}

void addView(Fields& fields, CameraSettings& camera) {
    fields.insert(
        fields.end(),
        {{"view", "fov_deg", "Horizontal field of view, degrees.", Number{&camera.fovDeg, {5, 150, "°"}}},
         {"view", "mode", "How the camera moves: fly, orbit or follow_flight.",
          Choice{asByte(camera.mode), cameraModeNames}},
         {"view", "observer", "Second camera that shows the view from outside: off, split or alone.",
          Choice{asByte(camera.observer), observerModeNames}},
         {"view", "observer_own_lod", "The observer uses its own LOD selection.",
          Flag{&camera.observerOwnLod}},
         {"view", "show_frustum", "Draw the view's frustum in the observer's picture.",
          Flag{&camera.showFrustum}},
         {"view", "show_horizon", "Draw the view's horizon in the observer's picture.",
          Flag{&camera.showHorizon}},
         {"view", "show_switch_distances", "Draw the switch distance d_m of the selected chunk.",
          Flag{&camera.showSwitchDistances}},
         {"view", "flight", "File of the flight to follow.", Text{&camera.flight}}});
}

void addCamera(Fields& fields, planet::CameraPose& pose) {
    fields.insert(fields.end(),
                  {{"camera", "latitude_deg", "Start latitude, degrees north.",
                    Number{&pose.latitudeDeg, {-90, 90, "°"}}},
                   {"camera", "longitude_deg", "Start longitude, degrees east.",
                    Number{&pose.longitudeDeg, {-360, 360, "°"}}},
                   {"camera", "altitude_m",
                    "Start altitude, metres above the planet's radius; 0: the whole planet in view.",
                    Number{&pose.altitudeM, {-1e6, 2e10, "m"}}},
                   {"camera", "heading_deg", "Start heading, degrees: 0 north, 90 east.",
                    Number{&pose.headingDeg, {-360, 360, "°"}}},
                   {"camera", "pitch_deg", "Start pitch, degrees: -90 straight down, 0 level.",
                    Number{&pose.pitchDeg, {-90, 90, "°"}}}});
}

void addWindow(Fields& fields, Settings& s) {
    Workspace& workspace = s.workspace;
    fields.insert(
        fields.end(),
        {{"window", "width_px", "Window size, pixels.", Integer{&s.windowWidthPx, {640, 16384, "px"}}},
         {"window", "height_px", "", Integer{&s.windowHeightPx, {400, 16384, "px"}}},
         {"window", "left_width", "Dock sizes, in units that follow the font.",
          Number{&workspace.leftWidth, {160, 1000, ""}}},
         {"window", "right_width", "", Number{&workspace.rightWidth, {160, 1000, ""}}},
         {"window", "bottom_height", "", Number{&workspace.bottomHeight, {60, 1000, ""}}},
         {"window", "theme", "Theme: dark or light.", Choice{asByte(workspace.theme), themeNames}},
         {"window", "scale", "Scale of text and controls, relative to the monitor's scale.",
          Number{&workspace.scale, {0.5, 3, ""}}}});
}

// In the order of PanelId, as panelInfos is.
constexpr std::array<std::string_view, panelCount> panelKeys = [] {
    std::array<std::string_view, panelCount> keys;
    for (const PanelInfo& info : panelInfos) keys[static_cast<std::size_t>(info.id)] = info.key;
    return keys;
}();

void addPanels(Fields& fields, Workspace& workspace) {
    std::string_view meaning = "Dock of each panel: left, right or bottom; and whether the panel is shown.";
    for (std::size_t dock = 0; dock < dockCount; ++dock) {
        fields.push_back({"panels", fmt::format("{}_front", dockNames[dock]),
                          dock == 0 ? "Front panel of each dock." : "",
                          Choice{asByte(workspace.inFront[dock]), panelKeys}});
    }
    for (const PanelInfo& info : panelInfos) {
        PanelPlace& place = workspace.panels[static_cast<std::size_t>(info.id)];
        fields.push_back({"panels", std::string(info.key), meaning, Choice{asByte(place.dock), dockNames}});
        fields.push_back({"panels", fmt::format("{}_shown", info.key), "", Flag{&place.shown}});
        meaning = {};
    }
}

void addCracks(Fields& fields, CrackKnobs& cracks) {
    fields.insert(fields.end(),
                  {{"cracks", "live", "Measure cracks continuously.", Flag{&cracks.live}},
                   {"cracks", "every_frames", "Frames between crack measurements.",
                    Integer{&cracks.everyFrames, {1, 1000, "frames"}}},
                   {"cracks", "mark", "Highlight crack pixels in the viewport.", Flag{&cracks.mark}}});
}

void addCompare(Fields& fields, CompareKnobs& compare) {
    fields.insert(fields.end(),
                  {{"compare", "mode", "Comparison view: side_by_side, wipe, difference or flip.",
                    Choice{asByte(compare.mode), compareModeNames}},
                   {"compare", "gain", "Gain of the difference.", Number{&compare.gain, {1, 255, ""}}},
                   {"compare", "wipe", "Position of the divider as a fraction of the width.",
                    Number{&compare.wipe, {0, 1, ""}}},
                   {"compare", "show_b", "Show B in flip mode.", Flag{&compare.showB}}});
}

// What a setting was called before version 0.2. Files that hold these names go on to be read, without a
// word: they mean the same, and the next save writes the present ones.
struct FormerName {
    std::string_view before;
    std::string_view now;
};
constexpr std::string_view formerSkirts = "view.skirts";  // true or false, now one of three words
constexpr std::array<FormerName, 12> formerNameTable = {{
    {"lod.skirt_factor", "seams.skirt_factor"},
    {formerSkirts, "seams.mode"},
    {"view.colour_by", "overlay.colour_by"},
    {"view.surface", "surface.colour"},
    {"view.atmosphere", "surface.atmosphere"},
    {"view.detail", "surface.detail"},
    {"view.lighting", "surface.lighting"},
    {"view.sun_follows", "surface.sun_follows"},
    {"view.sun_latitude_deg", "surface.sun_latitude_deg"},
    {"view.sun_longitude_deg", "surface.sun_longitude_deg"},
    {"window.lod_panel_width", "window.right_width"},
    {"window.log_panel_height", "window.bottom_height"},
}};

const FormerName* findFormer(std::string_view name) {
    const auto found = std::find_if(formerNameTable.begin(), formerNameTable.end(),
                                    [&](const FormerName& former) { return former.before == name; });
    return found == formerNameTable.end() ? nullptr : &*found;
}

std::string joined(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    return text;
}

struct ReadField {
    const fs::path& file;
    const std::string name;
    const toml::node& node;

    tl::unexpected<planet::Error> wrong(const toml::node& where, const std::string& message) const {
        return planet::badInput(fmt::format("{}: {}", placeOf(file, where), message));
    }

    Result<void> operator()(const Number& number) const {
        return readNumber(file, name, node, number.range).map([&](double v) { *number.value = v; });
    }
    Result<void> operator()(const Integer& integer) const {
        return readInteger(file, name, node, integer.range).map([&](std::int64_t v) {
            *integer.value = static_cast<int>(v);
        });
    }
    Result<void> operator()(const Seed& seed) const {
        return readInteger(file, name, node, {0, 4294967295.0, ""}).map([&](std::int64_t v) {
            *seed.value = static_cast<std::uint32_t>(v);
        });
    }
    Result<void> operator()(const Flag& flag) const {
        return readBool(file, name, node).map([&](bool v) { *flag.value = v; });
    }
    Result<void> operator()(const Text& text) const {
        return readText(file, name, node).map([&](const std::string& v) { *text.value = v; });
    }
    Result<void> operator()(const Choice& choice) const {
        const std::string text = node.value_or(std::string());
        const auto found = std::find(choice.names.begin(), choice.names.end(), text);
        if (found == choice.names.end()) {
            return wrong(node, fmt::format("{} is {}; expected one of {}", name, shownValue(node),
                                           joined(choice.names)));
        }
        *choice.value = static_cast<std::uint8_t>(found - choice.names.begin());
        return {};
    }
    Result<void> operator()(const Ramp& ramp) const {
        const toml::array* array = node.as_array();
        if (!array) {
            return wrong(
                node,
                fmt::format(
                    "{} is {}; expected an array of stops, as [{{ height_m = 0, colour = \"#40a060\" }}]",
                    name, shownValue(node)));
        }
        if (array->size() > maxRampStops) {
            return wrong(
                node, fmt::format("{} has {} stops; expected at most {}", name, array->size(), maxRampStops));
        }
        std::vector<planet::gl::RampStop> stops;
        for (const toml::node& stop : *array) {
            if (Result<void> read = readStop(stop, stops); !read) return read;
        }
        *ramp.value = std::move(stops);
        return {};
    }

    Result<void> operator()(const LayerStack& layers) const {
        return layersFromToml(file, name, node).map([&](std::vector<planet::TextureLayer> read) {
            *layers.value = std::move(read);
        });
    }

    Result<void> readStop(const toml::node& stop, std::vector<planet::gl::RampStop>& stops) const {
        const std::string stopName = fmt::format("{}: stop {}", name, stops.size() + 1);
        const toml::table* table = stop.as_table();
        const toml::node* height = table ? table->get("height_m") : nullptr;
        const toml::node* colour = table ? table->get("colour") : nullptr;
        if (!height || !colour || table->size() != 2) {
            return wrong(stop, fmt::format("{} is not a stop; expected {{ height_m = 0, colour = \"#40a060\" "
                                           "}} with exactly these two keys",
                                           stopName));
        }
        const Result<double> heightM =
            readNumber(file, stopName + ": height_m", *height, {-100000, 100000, "m"});
        if (!heightM) return tl::unexpected(heightM.error());
        if (!stops.empty() && *heightM <= stops.back().heightM) {
            return wrong(
                *height,
                fmt::format("{}: height_m is {}; expected more than the {} of the stop before: lowest first",
                            stopName, *heightM, stops.back().heightM));
        }
        const std::optional<glm::vec3> rgb = colourFromText(colour->value_or(std::string()));
        if (!rgb) {
            return wrong(*colour, fmt::format("{}: colour is {}; expected red, green and blue as \"#rrggbb\"",
                                              stopName, shownValue(*colour)));
        }
        stops.push_back({*heightM, *rgb});
        return {};
    }
};

struct FieldText {
    std::string_view lineBreak;  // between the stops of a ramp
    std::string_view lineEnd;    // after them

    // The shortest digits that read back as the same number.
    std::string operator()(const Number& number) const { return fmt::format("{}", *number.value); }
    std::string operator()(const Integer& integer) const { return fmt::format("{}", *integer.value); }
    std::string operator()(const Seed& seed) const { return fmt::format("{}", *seed.value); }
    std::string operator()(const Flag& flag) const { return *flag.value ? "true" : "false"; }
    std::string operator()(const Text& text) const {
        // TOML is UTF-8, and file names need not be: better a default than a file that cannot be read.
        if (!isUtf8(*text.value)) return "\"\"";
        std::ostringstream stream;
        stream << toml::value<std::string>(*text.value);
        return stream.str();
    }
    std::string operator()(const Ramp& ramp) const {
        std::string text;
        for (const planet::gl::RampStop& stop : *ramp.value) {
            text += fmt::format("{}{}{{ height_m = {}, colour = \"{}\" }}", text.empty() ? "" : ",",
                                lineBreak, stop.heightM, colourText(stop.colour));
        }
        return ramp.value->empty() ? "[]" : fmt::format("[{}{}]", text, lineEnd);
    }
    std::string operator()(const LayerStack& layers) const {
        std::string text;
        for (const planet::TextureLayer& layer : *layers.value)
            text += fmt::format("{}{}{}", text.empty() ? "" : ",", lineBreak, layerLine(layer));
        return layers.value->empty() ? "[]" : fmt::format("[{}{}]", text, lineEnd);
    }
    std::string operator()(const Choice& choice) const {
        return fmt::format("\"{}\"", choice.names[*choice.value]);
    }
};

// Levenshtein's distance: how many letters differ.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t above = row[j + 1];
            row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row.back();
}

}  // namespace

std::string Field::name() const {
    return fmt::format("{}.{}", table, key);
}

std::vector<Field> fieldsOf(Settings& settings) {
    Fields fields;
    fields.reserve(113);
    addData(fields, settings);
    addLod(fields, settings.view.lod);
    addSeams(fields, settings.view.seams);
    addPaging(fields, settings.view.paging);
    addOverlay(fields, settings.view.overlay);
    addSurface(fields, settings.view.surface);
    addLayers(fields, settings.view.surface.layers);
    addLight(fields, settings.view.surface.light);
    addView(fields, settings.view.camera);
    addCamera(fields, settings.camera);
    addWindow(fields, settings);
    addPanels(fields, settings.workspace);
    addCracks(fields, settings.view.cracks);
    addCompare(fields, settings.view.compare);
    return fields;
}

bool isViewTable(std::string_view table) {
    return table != "data" && table != "camera" && table != "window" && table != "panels";
}

const Field* findField(std::span<const Field> fields, std::string_view name) {
    const FormerName* former = findFormer(name);
    const std::string_view wanted = former ? former->now : name;
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) {
        const std::size_t dot = field.table.size();
        return wanted.size() == dot + 1 + field.key.size() && wanted[dot] == '.' &&
               wanted.starts_with(field.table) && wanted.ends_with(field.key);
    });
    return found == fields.end() ? nullptr : &*found;
}

bool isFormerName(std::string_view name) {
    return findFormer(name) != nullptr;
}

Result<void> readField(const fs::path& file, const Field& field, std::string_view name,
                       const toml::node& node) {
    if (name == formerSkirts) {
        const planet::SeamMode mode[] = {planet::SeamMode::None, planet::SeamMode::Skirts};
        return readBool(file, name, node).map([&](bool skirts) {
            *std::get<Choice>(field.value).value = static_cast<std::uint8_t>(mode[skirts ? 1 : 0]);
        });
    }
    return std::visit(ReadField{file, std::string(name), node}, field.value);
}

tl::unexpected<planet::Error> unknownSetting(const std::string& place, std::string_view name,
                                             std::span<const Field> fields) {
    // Of a name as long as a file its beginning, which is far from any already.
    constexpr std::size_t mostLetters = 100;
    std::string nearest;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const Field& field : fields) {
        const std::size_t distance = editDistance(field.name(), name.substr(0, mostLetters));
        if (distance < least) nearest = field.name();
        least = std::min(least, distance);
    }
    // A name that is far from all settings is no misspelt one.
    const std::size_t letters = std::max(std::min(name.size(), mostLetters), nearest.size());
    std::string instead = 3 * least <= letters ? "did you mean " + nearest + "?"
                                               : "expected a name of the settings file, such as lod.tau_px";
    if (name == "key") instead = "the file seems to be a flight; expected a settings file";
    if (name == "layer") instead = "the file seems to be a texture layer set; expected a settings file";
    return planet::badInput(fmt::format("{}: {:.60} is not a setting; {}", place, name, instead));
}

std::string tomlText(const Field& field) {
    return std::visit(FieldText{"\n    ", "\n"}, field.value);
}

std::string plainText(const Field& field) {
    if (const Choice* choice = std::get_if<Choice>(&field.value))
        return std::string(choice->names[*choice->value]);
    return std::visit(FieldText{" ", " "}, field.value);
}

void copyValue(const Field& from, const Field& to) {
    std::visit(
        [&](const auto& target) {
            *target.value = *std::get<std::decay_t<decltype(target)>>(from.value).value;
        },
        to.value);
}

}  // namespace worldy
