// Writes the seeds of the fuzzers from the data that comes with Worldy: fuzz_seeds FOLDER makes
// FOLDER/chunk_file/..., FOLDER/settings/..., one folder per fuzzer.
#include <gdal.h>
#include <ogr_srs_api.h>
#include <zstd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include "app/flight/flight_record.h"
#include "app/settings/layer_file.h"
#include "app/settings/region_file.h"
#include "app/settings/settings_text.h"
#include "planet/bake/bake.h"
#include "planet/bake/colour_tile_sampling.h"
#include "planet/format/height_codec.h"
#include "planet/measure/atlas_file.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/view.h"
#include "planet/trace/lod_trace.h"
#include "planet/trace/trace_format.h"
#include "tests/support/chunk_blocks.h"
#include "tests/support/earth_windows.h"
#include "tests/support/random_regions.h"
#include "tests/support/sparse_source.h"

namespace {

namespace fs = std::filesystem;
using namespace planet;

using Bytes = std::vector<std::byte>;
const fs::path data = fs::path(WORLDY_SOURCE_DIR) / "data";

// Returns the value of a result; ends the program on an Error.
template <class T>
T must(Result<T>&& result) {
    if (!result) {
        std::fprintf(stderr, "%s\n", result.error().message.c_str());
        std::exit(EXIT_FAILURE);
    }
    if constexpr (!std::is_void_v<T>) return *std::move(result);
}

Bytes read(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

void write(const fs::path& file, std::span<const std::byte> bytes) {
    fs::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream) must(Result<void>(ioError(file.string() + ": cannot be written")));
}
void write(const fs::path& file, const std::string& text) {
    write(file, std::as_bytes(std::span(text)));
}

// ---- chunk files ----

// Returns a source of few colours, so that files stay small and fuzzers fast.
ColourSource evenColours() {
    ColourSource source{.description = "even", .naturalFaceSize = 257, .sample = {}};
    source.sample = [](const SampleTile& tile, std::span<glm::vec3> out) -> Result<void> {
        std::size_t at = 0;
        for (int row = 0; row < tile.rows; ++row) {
            const bool north = 2 * (tile.firstRow + row) > tile.faceCells;
            for (int column = 0; column < tile.columns; ++column)
                out[at++] = north ? glm::vec3(0.9f, 0.9f, 1) : glm::vec3(0.1f, 0.3f, 0.1f);
        }
        return {};
    };
    return source;
}

void chunkFiles(const fs::path& folder) {
    fs::create_directories(folder);
    const HeightSource heights = must(openHeightSource(data / "earth/elevation.tif", {}));
    const ColourSource colours = evenColours();
    const auto baked = [&](const std::string& name, int faceSize, std::optional<ColourFormat> format,
                           int colourFaceSize = 257) {
        BakeSettings settings{.faceSize = faceSize, .chunkSize = 17};
        settings.colour.faceSize = colourFaceSize;
        if (format) settings.colour.format = *format;
        must(bake(heights, settings, folder / name, {}, format ? &colours : nullptr));
    };
    baked("leaf_roots.chk", 17, {});
    baked("heights.chk", 33, {});
    baked("three_levels.chk", 65, {});
    baked("bc1.chk", 33, ColourFormat::Bc1);
    baked("lossless.chk", 17, ColourFormat::Lossless);
    baked("two_levels_of_colours.chk", 17, ColourFormat::Bc1, 513);
    // Flat and of large chunks, so that it is small although a sparse planet has faces of at least 513
    // samples.
    const auto flat = test::formulaSource([](const glm::dvec3&) { return -1000.0; }, -1000, 0, 1, 1025);
    must(bake(test::sparse(flat, {test::boxAround({-1, 1, 1}, 0.01, 1024)}), {.chunkSize = 129},
              folder / "sparse.chk"));
    Bytes old = read(folder / "heights.chk");
    constexpr std::size_t versionAt = 8;
    test::putAt(std::span(old), versionAt, chunkFileVersion - 1);
    test::resealHeader(old);
    write(folder / "older_version.chk", old);
}

// ---- blocks of chunk files ----

Bytes decoderInput(int kind, int size, std::span<const std::byte> coded) {
    Bytes input;
    for (const int option : {kind, size, 0}) input.push_back(static_cast<std::byte>(option));
    for (const std::byte byte : coded) input.push_back(byte);
    return input;
}

void codedBlocks(const fs::path& folder) {
    const test::Square earth = test::earthWindow(2600, 700, 65);
    // Without fractions, and with 6 bits of them: in whole quanta, and with steps of single ones.
    struct Kind {
        const char* name;
        int fractionBits;
        int high;  // bits of the byte of the size
        std::int32_t factor;
        std::int32_t wiggle;
    };
    for (const Kind& kind : {Kind{"", 0, 0, 1, 0}, Kind{"_shifted", 6, 64, 64, 0}, Kind{"_fine", 6, 64, 1, 0},
                             Kind{"_wide", 6, 64, 64, 1}}) {
        test::Square ground = earth;
        for (std::size_t i = 0; i < ground.samples.size(); ++i)
            ground.samples[i] =
                ground.samples[i] * kind.factor + static_cast<std::int32_t>(i % 2) * kind.wiggle;
        for (int log2 = 0; log2 <= 6; ++log2) {
            const int size = (1 << log2) + 1;
            Bytes coded;
            encodeGrid(test::pieceOf(ground, 0, 0, size).samples, size, kind.fractionBits, coded);
            write(folder / ("grid_" + std::to_string(size) + kind.name),
                  decoderInput(0, kind.high + log2, coded));
        }
        // The coarse grid is zeros, like the decoder's pattern 0.
        for (const int cells : {1, 2, 8, 16, 32}) {
            test::Square fine = test::pieceOf(ground, 0, 0, 2 * cells + 1);
            for (int y = 0; y < fine.side; y += 2)
                for (int x = 0; x < fine.side; x += 2)
                    fine.samples[static_cast<std::size_t>(y * fine.side + x)] = 0;
            for (int level = minCompressionLevel; level <= maxCompressionLevel; ++level) {
                Bytes coded;
                encodeRefinement(fine.samples, cells, level, kind.fractionBits, coded);
                write(folder /
                          ("refinement_" + std::to_string(cells) + "_" + std::to_string(level) + kind.name),
                      decoderInput(1, kind.high + cells - 1, coded));
            }
        }
    }
    const ColourSource colours = must(openColourSource(data / "earth/colour.jpg"));
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(colourTileTexels * colourTileTexels));
    must(sampleColourTile(colours, {Face::PosX, 2, 1, 1}, rgb));
    for (const ColourFormat format : {ColourFormat::Bc1, ColourFormat::Lossless}) {
        const int kind = format == ColourFormat::Bc1 ? 2 : 3;
        write(folder / ("tile_" + std::to_string(kind)),
              decoderInput(kind, 0, packColourTexels(format, colourTexels(format, rgb))));
        write(folder / ("checker_" + std::to_string(kind)),
              decoderInput(kind, 0, packColourTexels(format, checkerTexels(format))));
    }
}

// ---- texts ----

void copyToml(const fs::path& from, const fs::path& to) {
    for (const auto& entry : fs::directory_iterator(from)) {
        if (entry.path().extension() == ".toml") write(to / entry.path().filename(), read(entry.path()));
    }
}

void settingsFiles(const fs::path& folder) {
    copyToml(data / "presets", folder);
    worldy::Settings settings;
    write(folder / "written.toml", worldy::settingsText(settings));
    write(folder / "assignment.toml", std::string("lod.tau_px=3\n"));
}

void regionsFile(const fs::path& folder) {
    std::mt19937 random(1);
    write(folder / "all.regions.toml",
          worldy::regionsText(planet::randomRegions(random, planet::earthRadiusM, 8)));
    write(folder / "few.regions.toml",
          worldy::regionsText(planet::randomRegions(random, planet::earthRadiusM, 2)));
}

// ---- recorded flights ----

worldy::FlightFrame madeFrame(int frame) {
    worldy::FlownView flown;
    flown.view =
        viewFromPose({.latitudeDeg = 10.0 + frame, .longitudeDeg = 20, .altitudeM = 1e6 / (1 + frame)},
                     6'371'000, 1.0, 1280, 720);
    const ChunkId id{Face::PosY, 2, static_cast<std::uint32_t>(frame % 4), 1};
    if (frame < 4) flown.appeared = {id};
    if (frame >= 4 && frame < 8) flown.vanished = {id};
    worldy::FlightFrame made;
    made.elapsedS = 1.0 / 60;
    made.views.assign(frame < 6 ? 1 : 2, flown);
    if (frame >= 6) made.views[1].appeared = made.views[1].vanished = {};
    made.moves.requested = {id, {id, BlockKind::Colours}, {id, BlockKind::Normals}};
    made.moves.taken = {id};
    made.moves.arrived = {{id, PagingOutcome::Loaded}};
    made.selectionHash = static_cast<std::uint64_t>(frame) * 0x9E3779B97F4A7C15u;
    if (frame == 0)
        made.calls.push_back({worldy::FlightCall::Settings,
                              {},
                              worldy::flightSettings(worldy::ViewSettings{}),
                              false,
                              {},
                              {}});
    if (frame == 3) made.calls.push_back({worldy::FlightCall::Settings, {}, {"lod.tau_px=3"}, true, {}, {}});
    if (frame == 4)
        made.calls.push_back({worldy::FlightCall::Announce, {}, {}, false, {{flown.view, 1.5}}, {}});
    if (frame == 5) made.calls.push_back({worldy::FlightCall::DropAll, {}, {}, false, {}, made.moves});
    return made;
}

void recordedFlights(const fs::path& folder) {
    fs::create_directories(folder);
    worldy::FlightEncoder encoder;
    for (int frame = 0; frame < 10; ++frame) encoder.add(madeFrame(frame));
    const fs::path file = folder / "made.flight";
    must(encoder.write(file, "made",
                       {.chunkFile = "earth.chk", .shape = {}, .fileBytes = 1, .headerHash = 2}));
    must(worldy::loadFlightRecord(file));
    // The content alone is easier to mutate.
    const Bytes bytes = read(file);
    constexpr std::size_t packedAt = 28;
    const auto packed = std::span(bytes).subspan(packedAt);
    Bytes content(1 << 20);
    content.resize(ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size()));
    write(folder / "content", content);
}

// ---- raw faces ----

void rawFaces(const fs::path& folder) {
    const test::Square earth = test::earthWindow(2600, 700, 9);
    Bytes shorts;
    for (const std::int32_t sample : earth.samples) ByteWriter(shorts).put(static_cast<std::int16_t>(sample));
    const auto seed = [&](const std::string& name, std::vector<int> options, std::span<const std::byte> bytes,
                          int times) {
        Bytes input;
        for (const int option : options) input.push_back(static_cast<std::byte>(option));
        for (int i = 0; i < times; ++i) input.insert(input.end(), bytes.begin(), bytes.end());
        write(folder / name, input);
    };
    seed("six_alike", {1, 0x83, 1}, shorts, 1);
    seed("six", {0, 4, 0}, shorts, 6);
    seed("big_endian_16_bits", {1, 0x85, 1 | 2 | 4}, shorts, 1);
    seed("eight_bits_by_size", {1, 6, 4 | 8 | 16, 0, 0, 0, 9}, std::span(shorts).first(81), 1);
    seed("size_in_name", {3, 3, 0, 9}, shorts, 1);
    seed("scaled_without_data", {1, 3, 1 | 32 | 64, 0, 0, 0, 0, 0x3F, 0, 0, 0, 0x42, 0, 0, 0, 0, 0, 0, 0},
         shorts, 1);
    seed("small_cache", {1, 3, 1 | 128, 2}, shorts, 1);
    seed("cut_short", {1, 3, 1}, std::span(shorts).first(100), 1);
}

// ---- rasters ----

// Small rasters of the formats that GDAL writes into one file.
void rasters(const fs::path& folder) {
    fs::create_directories(folder);
    GDALAllRegister();
    const GDALDatasetH made = GDALCreate(GDALGetDriverByName("MEM"), "", 12, 9, 1, GDT_Int16, nullptr);
    double transform[] = {10, 0.01, 0, 45, 0, -0.01};
    GDALSetGeoTransform(made, transform);
    GDALSetProjection(made, SRS_WKT_WGS84_LAT_LONG);
    GDALSetRasterNoDataValue(GDALGetRasterBand(made, 1), -9999);
    std::vector<std::int16_t> samples(12 * 9);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = i % 7 == 0 ? std::int16_t{-9999} : static_cast<std::int16_t>(i * 13);
    if (GDALRasterIO(GDALGetRasterBand(made, 1), GF_Write, 0, 0, 12, 9, samples.data(), 12, 9, GDT_Int16, 0,
                     0) != CE_None)
        std::abort();
    const char* const deflate[] = {"COMPRESS=DEFLATE", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16",
                                   nullptr};
    const char* const lzw[] = {"COMPRESS=LZW", "PREDICTOR=2", nullptr};
    struct Seed {
        const char* driver;
        const char* name;
        const char* const* options;
    };
    for (const auto& [driver, name, options] :
         {Seed{"GTiff", "rows.tif", nullptr}, Seed{"GTiff", "tiled.tif", deflate},
          Seed{"GTiff", "lzw.tif", lzw}, Seed{"AAIGrid", "grid.asc", nullptr},
          Seed{"JP2OpenJPEG", "grid.jp2", nullptr}, Seed{"HFA", "erdas.img", nullptr}}) {
        GDALClose(GDALCreateCopy(GDALGetDriverByName(driver), (folder / name).c_str(), made, FALSE, options,
                                 nullptr, nullptr));
    }
    GDALClose(made);
    write(
        folder / "mosaic.vrt",
        std::string(
            "<VRTDataset rasterXSize=\"12\" rasterYSize=\"9\"><SRS>EPSG:4326</SRS><GeoTransform>10, 0.01, 0, "
            "45, 0, -0.01</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\"><SimpleSource>"
            "<SourceFilename relativeToVRT=\"1\">rows.tif</SourceFilename><SourceBand>1</SourceBand>"
            "</SimpleSource></VRTRasterBand></VRTDataset>"));
}

// ---- traces ----

// Writes the content of a trace's blocks as trace_fuzz.cpp seals it.
Bytes traceContent(std::span<const std::byte> stream) {
    Bytes content;
    ByteWriter out(content);
    for (std::size_t at = traceHeaderBytes; at < stream.size();) {
        const auto header = must(traceBlockHeaderFrom(stream.subspan(at).first<traceBlockHeaderBytes>()));
        out.put(static_cast<std::uint16_t>(header.definitionBytes));
        out.put(static_cast<std::uint16_t>(header.bytes - header.definitionBytes));
        const auto bytes = stream.subspan(at + traceBlockHeaderBytes, header.bytes);
        content.insert(content.end(), bytes.begin(), bytes.end());
        at += traceBlockHeaderBytes + header.bytes;
    }
    return content;
}

void traceFrame(lod_trace* trace, int frame) {
    const auto id = static_cast<std::uint64_t>(frame);
    const auto node = [&](std::uint64_t of, std::uint32_t level) {
        lod_trace_node_info info{};
        info.id = lod_trace_quadtree_id(2, level, static_cast<std::uint32_t>(of), 0);
        info.has_parent = level > 0;
        if (level > 0)
            info.parent = lod_trace_quadtree_id(2, level - 1, static_cast<std::uint32_t>(of / 2), 0);
        info.level = level;
        info.bounds = frame % 2 == 0 ? LOD_TRACE_BOUNDS_BOX : LOD_TRACE_BOUNDS_SPHERE;
        info.axes[0] = info.axes[4] = info.axes[8] = info.radius = 1;
        info.error = 3;
        return info;
    };
    for (const std::uint32_t level : {0u, 1u, 2u}) {
        const lod_trace_node_info told = node(level == 0 ? 0 : id % 4, level);
        lod_trace_node(trace, &told);
    }
    const std::uint64_t drawn = lod_trace_quadtree_id(2, 1, static_cast<std::uint32_t>(id % 2), 0);
    lod_trace_view_info view{};
    view.eye[2] = view.view[0] = view.view[5] = view.view[10] = view.view[15] = 1;
    view.projection[0] = view.projection[5] = 1;
    view.projection[11] = -1;
    view.viewport[2] = view.viewport[3] = 100 + frame;
    lod_trace_frame_begin(trace, frame / 10.0);
    lod_trace_view(trace, frame % 2, &view);
    lod_trace_drawn(trace, 0, drawn, 0.5f);
    lod_trace_drawn_px(trace, 1, drawn, 1, 2);
    lod_trace_culled(trace, 0, drawn + 1, LOD_TRACE_CULLED_HORIZON);
    lod_trace_requested(trace, drawn, 1, 2);
    lod_trace_started(trace, drawn, 1);
    lod_trace_failed(trace, drawn, 1, "disk");
    lod_trace_arrived(trace, drawn, 0);
    lod_trace_counter(trace, "counter", frame + 0.5);
    lod_trace_setting(trace, LOD_TRACE_TAU, 1);
    lod_trace_setting_text(trace, "mode", "fast");
    lod_trace_message(trace, LOD_TRACE_WARNING, "message");
    lod_trace_frame_end(trace, 1, 2);
}

void traces(const fs::path& folder) {
    fs::create_directories(folder);
    const fs::path file = folder / "made.lodtrace";
    lod_trace* trace = lod_trace_open(file.c_str(), nullptr, nullptr, 0);
    lod_trace_description description{};
    description.shape = LOD_TRACE_SPHERE;
    description.radius = 1;
    description.ids = LOD_TRACE_IDS_QUADTREE;
    description.requests = LOD_TRACE_REQUESTS_CHILDREN;
    lod_trace_describe(trace, &description);
    lod_trace_thread_begin(trace, "main");
    for (int frame = 0; frame < 6; ++frame) {
        traceFrame(trace, frame);
        if (frame % 2 == 0) lod_trace_flush(trace, 10'000);
    }
    lod_trace_close(trace);
    write(folder / "content", traceContent(read(file)));
}

// ---- atlases ----

AtlasViewpoint madeViewpoint(int i) {
    AtlasViewpoint viewpoint;
    viewpoint.place = {{allFaces[static_cast<std::size_t>(i / 2 % 6)], 0, 0, 0}, 0, i % 2 == 0};
    if (i >= 12) viewpoint.place.cell = childOf(viewpoint.place.cell, i % 4);
    viewpoint.eyeM = 1000.0 * i;
    for (std::size_t measure = 0; measure < atlasMeasureCount; ++measure)
        viewpoint.figures[measure] =
            measure == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(measure) * i;
    return viewpoint;
}

// Writes the records of an atlas as atlas_fuzz.cpp seals them.
Bytes atlasContent(std::span<const std::byte> file) {
    constexpr std::size_t headerBytes = 16, recordHeadBytes = 16;
    Bytes content;
    ByteWriter out(content);
    for (std::size_t at = headerBytes; at < file.size();) {
        const auto bytes = readLittleEndian<std::uint32_t>(file.data() + at + 4);
        out.put(static_cast<std::uint8_t>(readLittleEndian<std::uint32_t>(file.data() + at)));
        out.put(static_cast<std::uint16_t>(bytes));
        const auto record = file.subspan(at + recordHeadBytes, bytes);
        content.insert(content.end(), record.begin(), record.end());
        at += recordHeadBytes + bytes;
    }
    return content;
}

void atlases(const fs::path& folder) {
    fs::create_directories(folder);
    AtlasSurvey survey;
    survey.bake = "earth.chk";
    survey.radiusM = earthRadiusM;
    survey.settings = "lod.tau_px=2\n";
    survey.grid.altitudesM = {200};
    survey.grid.headings = 2;
    survey.grid.most = 100;
    AtlasTree tree;
    for (int root = 0; root < faceCount; ++root) {
        tree.chunks.push_back({.deltaCM = 100, .digest = 1, .hasChildren = root == 0});
        if (root > 0) continue;
        for (int child = 0; child < quadrantCount; ++child)
            tree.chunks.push_back({.deltaCM = 10, .digest = 2, .isSummary = child == 3});
    }
    std::vector<AtlasViewpoint> viewpoints;
    for (int i = 0; i < 20; ++i) viewpoints.push_back(madeViewpoint(i));
    const auto made = [&](const std::string& name, const AtlasTree& of) {
        AtlasWriter writer = must(AtlasWriter::create(folder / name, survey, of));
        must(writer.append(std::span(viewpoints).first(12)));
        must(writer.append(std::span(viewpoints).subspan(12)));
        must(writer.finish());
        write(folder / ("content_of_" + name), atlasContent(read(folder / name)));
    };
    made("made.atlas", tree);
    survey.isRevisit = true;
    made("without_tree.atlas", {});
}

void notes(const fs::path& folder) {
    const std::string text = R"(format = 1

[[note]]
id = 1
text = "The ridge \"pops\"\nhere"
about = "pops"
created = "2026-11-26 16:50"
chunk = "y_pos/4/6/13"
measurement = "jump 1.2 px"
latitude_deg = 27.988
longitude_deg = 86.925
height_m = 8848.5
camera_latitude_deg = 27.5
camera_longitude_deg = 86.5
camera_altitude_m = 12000
camera_heading_deg = 12.5
camera_pitch_deg = -20
)";
    write(folder / "one.toml", text);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "fuzz_seeds FOLDER\n");
        return EXIT_FAILURE;
    }
    const fs::path folder = argv[1];
    chunkFiles(folder / "chunk_file");
    codedBlocks(folder / "decoders");
    settingsFiles(folder / "settings");
    copyToml(data / "layers", folder / "layer_set");
    regionsFile(folder / "regions");
    copyToml(data / "flights", folder / "flight_path");
    notes(folder / "notes");
    recordedFlights(folder / "flight_record");
    rawFaces(folder / "raw_faces");
    rasters(folder / "raster");
    traces(folder / "trace");
    atlases(folder / "atlas");
    return EXIT_SUCCESS;
}
