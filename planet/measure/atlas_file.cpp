#include "planet/measure/atlas_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/little_endian.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_tree.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

namespace {

constexpr std::string_view atlasMagic = "WORLDYAT";
constexpr std::string_view unfinishedEnding = ".part";
constexpr std::uint32_t atlasVersion = 1;
constexpr std::size_t atlasHeaderBytes = 16;
constexpr std::size_t recordHeadBytes = 16;
constexpr std::size_t viewpointBytes = 4 + 2 * 4 + 8 + 8 * atlasMeasureCount;
constexpr std::size_t listedChunkBytes = 9;
constexpr std::size_t longestTextBytes = 4u << 20;
constexpr std::uint64_t mostAtlasBytes = 512u << 20;
enum RecordKind : std::uint32_t { surveyRecord = 1, treeRecord = 2, viewpointsRecord = 3, endRecord = 4 };

using Bytes = std::vector<std::byte>;

std::uint64_t recordSum(std::uint32_t kind, std::span<const std::byte> content) {
    const std::uint64_t seed = (std::uint64_t{content.size()} << 32) | kind;
    return XXH3_64bits_withSeed(content.data(), content.size(), seed);
}

void putText(ByteWriter& out, std::string_view text) {
    out.put(static_cast<std::uint32_t>(text.size()));
    for (const char letter : text) out.put(static_cast<std::uint8_t>(letter));
}

void putRecord(Bytes& out, RecordKind kind, std::span<const std::byte> content) {
    Bytes head;
    ByteWriter writer(head);
    writer.put(static_cast<std::uint32_t>(kind));
    writer.put(static_cast<std::uint32_t>(content.size()));
    writer.put(recordSum(kind, content));
    out.insert(out.end(), head.begin(), head.end());
    out.insert(out.end(), content.begin(), content.end());
}

void putHeader(Bytes& out) {
    ByteWriter writer(out);
    for (const char letter : atlasMagic) writer.put(static_cast<std::uint8_t>(letter));
    writer.put(atlasVersion);
    writer.put(std::uint32_t{0});
}

void putSurvey(Bytes& out, const AtlasSurvey& survey) {
    Bytes content;
    ByteWriter writer(content);
    putText(writer, survey.bake);
    putText(writer, survey.settings);
    putText(writer, survey.regions);
    writer.put(survey.bakeHash);
    writer.put(survey.radiusM);
    writer.put(std::int32_t{survey.widthPx});
    writer.put(std::int32_t{survey.heightPx});
    writer.put(survey.fovDeg);
    writer.put(static_cast<std::uint8_t>(survey.measuresError));
    writer.put(static_cast<std::uint8_t>(survey.isRevisit));
    writer.put(static_cast<std::uint32_t>(survey.grid.altitudesM.size()));
    for (const double altitudeM : survey.grid.altitudesM) writer.put(altitudeM);
    writer.put(std::int32_t{survey.grid.headings});
    writer.put(survey.grid.pitchDeg);
    writer.put(std::int32_t{survey.grid.coarsestLevel});
    writer.put(std::int32_t{survey.grid.finestLevel});
    writer.put(survey.grid.most);
    putRecord(out, surveyRecord, content);
}

void putTree(Bytes& out, const AtlasTree& tree) {
    if (tree.chunks.empty()) return;
    Bytes content;
    ByteWriter writer(content);
    writer.put(static_cast<std::uint32_t>(tree.chunks.size()));
    for (const AtlasChunk& chunk : tree.chunks) {
        writer.put(static_cast<std::uint8_t>((chunk.hasChildren ? 1 : 0) | (chunk.isSummary ? 2 : 0)));
        writer.put(chunk.deltaCM);
        writer.put(chunk.digest);
    }
    putRecord(out, treeRecord, content);
}

void putViewpoints(Bytes& out, std::span<const AtlasViewpoint> viewpoints) {
    Bytes content;
    ByteWriter writer(content);
    for (const AtlasViewpoint& viewpoint : viewpoints) {
        const AtlasPlace& place = viewpoint.place;
        writer.put(static_cast<std::uint8_t>(place.cell.face));
        writer.put(place.cell.level);
        writer.put(place.altitude);
        writer.put(place.heading);
        writer.put(place.cell.x);
        writer.put(place.cell.y);
        writer.put(viewpoint.eyeM);
        for (const double figure : viewpoint.figures) writer.put(figure);
    }
    putRecord(out, viewpointsRecord, content);
}

// Reads one record's content. A read beyond its end gives zeros and is remembered.
class ContentReader {
public:
    explicit ContentReader(std::span<const std::byte> content) : reader_(content) {}

    template <Number T>
    T get() {
        if (reader_.rest().size() < sizeof(T)) {
            isShort_ = true;
            return T{};
        }
        return reader_.get<T>();
    }
    std::string text() {
        const auto bytes = get<std::uint32_t>();
        if (bytes > longestTextBytes || bytes > reader_.rest().size()) {
            isShort_ = true;
            return {};
        }
        const auto taken = reader_.take(bytes);
        std::string text(bytes, '\0');
        std::memcpy(text.data(), taken.data(), bytes);
        return text;
    }
    bool isComplete() const { return !isShort_ && reader_.rest().empty(); }

private:
    ByteReader reader_;
    bool isShort_ = false;
};

bool isBetween(double value, double least, double most) {
    return value >= least && value <= most;  // false for NaN
}

// Returns what is wrong with a survey; empty if nothing is.
std::string problemOf(const AtlasSurvey& survey) {
    const AtlasGrid& grid = survey.grid;
    if (!isBetween(survey.radiusM, leastRadiusM, mostRadiusM))
        return fmt::format("radius: {} m is out of range", survey.radiusM);
    if (!isBetween(survey.widthPx, 16, 16384) || !isBetween(survey.heightPx, 16, 16384))
        return fmt::format("picture size: {}x{} is out of range; expected [16, 16384]", survey.widthPx,
                           survey.heightPx);
    if (!isBetween(survey.fovDeg, 1e-3, 179.9))
        return fmt::format("field of view: {} degrees is out of range", survey.fovDeg);
    if (grid.altitudesM.empty() || grid.altitudesM.size() > mostAtlasAltitudes)
        return fmt::format("{} altitudes; expected [1, {}]", grid.altitudesM.size(), mostAtlasAltitudes);
    for (std::size_t i = 0; i < grid.altitudesM.size(); ++i) {
        if (!isBetween(grid.altitudesM[i], 1e-3, 1e12) ||
            (i > 0 && !(grid.altitudesM[i] > grid.altitudesM[i - 1])))
            return "altitudes: expected ascending numbers of metres above 0";
    }
    if (!isBetween(grid.headings, 1, mostAtlasHeadings))
        return fmt::format("headings: {} is out of range; expected [1, {}]", grid.headings,
                           mostAtlasHeadings);
    if (!isBetween(grid.pitchDeg, -90, 0))
        return fmt::format("pitch: {} degrees is out of range; expected [-90, 0]", grid.pitchDeg);
    if (!isBetween(grid.coarsestLevel, 0, grid.finestLevel) || grid.finestLevel > finestAtlasLevel)
        return fmt::format("levels of cells: [{}, {}] is out of range; expected within [0, {}]",
                           grid.coarsestLevel, grid.finestLevel, finestAtlasLevel);
    if (grid.most < 1 || grid.most > mostAtlasViewpoints)
        return fmt::format("viewpoints: {} is out of range; expected [1, {}]", grid.most,
                           mostAtlasViewpoints);
    return {};
}

Result<AtlasSurvey> surveyFrom(std::span<const std::byte> content, const std::string& name) {
    ContentReader in(content);
    AtlasSurvey survey;
    survey.bake = in.text();
    survey.settings = in.text();
    survey.regions = in.text();
    survey.bakeHash = in.get<std::uint64_t>();
    survey.radiusM = in.get<double>();
    survey.widthPx = in.get<std::int32_t>();
    survey.heightPx = in.get<std::int32_t>();
    survey.fovDeg = in.get<double>();
    survey.measuresError = in.get<std::uint8_t>() != 0;
    survey.isRevisit = in.get<std::uint8_t>() != 0;
    const auto altitudes = std::min<std::uint32_t>(in.get<std::uint32_t>(), mostAtlasAltitudes + 1);
    survey.grid.altitudesM.clear();
    for (std::uint32_t i = 0; i < altitudes; ++i) survey.grid.altitudesM.push_back(in.get<double>());
    survey.grid.headings = in.get<std::int32_t>();
    survey.grid.pitchDeg = in.get<double>();
    survey.grid.coarsestLevel = in.get<std::int32_t>();
    survey.grid.finestLevel = in.get<std::int32_t>();
    survey.grid.most = in.get<std::uint64_t>();
    if (std::string problem = problemOf(survey); !problem.empty())
        return badInput(fmt::format("{}: {}", name, problem));
    if (!in.isComplete())
        return badInput(fmt::format("{}: the record of the survey has a wrong length", name));
    return survey;
}

Result<AtlasTree> treeFrom(std::span<const std::byte> content, const std::string& name) {
    ContentReader in(content);
    const auto count = in.get<std::uint32_t>();
    if (content.size() != 4 + std::uint64_t{count} * listedChunkBytes)
        return badInput(fmt::format("{}: the record of the tree has a wrong length", name));
    AtlasTree tree;
    tree.chunks.resize(count);
    for (AtlasChunk& chunk : tree.chunks) {
        const auto flags = in.get<std::uint8_t>();
        chunk.hasChildren = (flags & 1) != 0;
        chunk.isSummary = (flags & 2) != 0;
        chunk.deltaCM = in.get<float>();
        chunk.digest = in.get<std::uint32_t>();
        if (flags > 2 || !std::isfinite(chunk.deltaCM) || chunk.deltaCM < 0)
            return badInput(fmt::format("{}: a chunk of the tree is damaged", name));
    }
    if (tree.chunks.empty() || !forEachChunk(tree, [](const ChunkId&, const AtlasChunk&) {}))
        return badInput(fmt::format("{}: the chunks of the tree are not those of six quadtrees", name));
    return tree;
}

bool isGood(const AtlasViewpoint& viewpoint, const AtlasSurvey& survey) {
    const AtlasGrid& grid = survey.grid;
    const AtlasPlace& place = viewpoint.place;
    if (static_cast<int>(place.cell.face) >= faceCount || place.cell.level > grid.finestLevel) return false;
    const std::uint32_t cells = 1u << place.cell.level;
    if (place.cell.x >= cells || place.cell.y >= cells) return false;
    if (place.altitude >= grid.altitudesM.size() || place.heading >= grid.headings) return false;
    // A camera needs an eye above the planet's centre.
    if (!isBetween(viewpoint.eyeM, -survey.radiusM, 1e13) || viewpoint.eyeM == -survey.radiusM) return false;
    for (std::size_t i = 0; i < atlasMeasureCount; ++i) {
        const double figure = viewpoint.figures[i];
        const bool isUnbounded =
            mayLackBound(static_cast<AtlasMeasure>(i)) && figure == std::numeric_limits<double>::infinity();
        if (!std::isnan(figure) && !isUnbounded && !isBetween(figure, 0, 1e300)) return false;
    }
    return true;
}

// Earlier surveys recorded huge numbers where there is no bound.
void dropUselessBounds(AtlasFigures& figures, double scalePx) {
    for (std::size_t i = 0; i < atlasMeasureCount; ++i) {
        if (mayLackBound(static_cast<AtlasMeasure>(i))) figures[i] = atlasBoundPx(figures[i], scalePx);
    }
}

Result<void> addViewpoints(std::span<const std::byte> content, const std::string& name, Atlas& atlas) {
    const std::size_t count = content.size() / viewpointBytes;
    if (content.size() % viewpointBytes != 0 || count == 0 || count > atlasBatch)
        return badInput(fmt::format("{}: a record of viewpoints has a wrong length", name));
    if (atlas.viewpoints.size() + count > mostAtlasViewpoints)
        return badInput(
            fmt::format("{}: has too many viewpoints; expected at most {}", name, mostAtlasViewpoints));
    const double scalePx = screenScalePx(atlas.survey);
    ContentReader in(content);
    for (std::size_t i = 0; i < count; ++i) {
        AtlasViewpoint viewpoint;
        AtlasPlace& place = viewpoint.place;
        place.cell.face = static_cast<Face>(in.get<std::uint8_t>());
        place.cell.level = in.get<std::uint8_t>();
        place.altitude = in.get<std::uint8_t>();
        place.heading = in.get<std::uint8_t>();
        place.cell.x = in.get<std::uint32_t>();
        place.cell.y = in.get<std::uint32_t>();
        viewpoint.eyeM = in.get<double>();
        for (double& figure : viewpoint.figures) figure = in.get<double>();
        if (!isGood(viewpoint, atlas.survey))
            return badInput(fmt::format("{}: viewpoint {} is damaged", name, atlas.viewpoints.size()));
        dropUselessBounds(viewpoint.figures, scalePx);
        atlas.viewpoints.push_back(viewpoint);
    }
    return {};
}

struct Record {
    std::uint32_t kind = 0;
    std::span<const std::byte> content;
};

// Returns the next record, or nothing if it is incomplete, and removes it from the bytes.
Result<std::optional<Record>> nextRecord(std::span<const std::byte>& bytes, const std::string& name) {
    if (bytes.size() < recordHeadBytes) return std::nullopt;
    ByteReader in(bytes);
    Record record;
    record.kind = in.get<std::uint32_t>();
    const auto size = in.get<std::uint32_t>();
    const auto sum = in.get<std::uint64_t>();
    if (size > in.rest().size()) return std::nullopt;
    record.content = in.take(size);
    if (recordSum(record.kind, record.content) != sum) {
        // The bytes of a record that was being written when the machine failed may be zeros.
        if (in.rest().empty()) return std::nullopt;
        return badInput(fmt::format("{}: a record does not match its checksum", name));
    }
    bytes = in.rest();
    return record;
}

Result<void> addRecord(const Record& record, const std::string& name, bool isFirst, Atlas& atlas) {
    if (isFirst != (record.kind == surveyRecord) || atlas.isFinished)
        return badInput(fmt::format("{}: its records are out of order", name));
    switch (record.kind) {
        case surveyRecord: {
            TRY_ASSIGN(atlas.survey, surveyFrom(record.content, name));
            return {};
        }
        case treeRecord: {
            if (!atlas.tree.chunks.empty() || !atlas.viewpoints.empty())
                return badInput(fmt::format("{}: its records are out of order", name));
            TRY_ASSIGN(atlas.tree, treeFrom(record.content, name));
            return {};
        }
        case viewpointsRecord:
            return addViewpoints(record.content, name, atlas);
        case endRecord:
            atlas.isFinished = true;
            return {};
        default:
            return badInput(fmt::format("{}: has a record of unknown kind {}", name, record.kind));
    }
}

Result<Bytes> readAtlasFile(const OpenFile& file) {
    struct stat status {};
    if (uninterrupted([&] { return file.calls().fstat(file.descriptor(), &status); }) < 0)
        return ioError(fmt::format("{}: {}", file.name(), lastSystemError()));
    if (!S_ISREG(status.st_mode)) return badInput(fmt::format("{}: is not a regular file", file.name()));
    if (static_cast<std::uint64_t>(status.st_size) > mostAtlasBytes)
        return badInput(fmt::format("{}: {} bytes are too many for an atlas; expected at most {}",
                                    file.name(), status.st_size, mostAtlasBytes));
    Bytes bytes(static_cast<std::size_t>(status.st_size));
    TRY(file.read(0, bytes));
    return bytes;
}

// Refuses a second writer.
Result<void> lockAtlas(const OpenFile& file) {
    if (uninterrupted([&] { return file.calls().flock(file.descriptor(), LOCK_EX | LOCK_NB); }) == 0)
        return {};
    return ioError(fmt::format("{}: is being written by another survey", file.name()));
}

}  // namespace

Result<Atlas> atlasFromBytes(std::span<const std::byte> bytes, const std::string& name,
                             std::uint64_t* keptBytes) {
    Bytes header;
    putHeader(header);
    const bool isAtlas = bytes.size() >= atlasHeaderBytes &&
                         std::equal(header.begin(), header.begin() + atlasMagic.size(), bytes.begin());
    if (!isAtlas)
        return badInput(fmt::format("{}: is not an atlas; expected a file that worldy atlas wrote", name));
    if (!std::equal(header.begin(), header.end(), bytes.begin()))
        return badInput(fmt::format("{}: version {} of atlases is unknown; expected {}", name,
                                    readLittleEndian<std::uint32_t>(bytes.data() + atlasMagic.size()),
                                    atlasVersion));
    Atlas atlas;
    std::span<const std::byte> rest = bytes.subspan(atlasHeaderBytes);
    for (bool isFirst = true; true; isFirst = false) {
        TRY_ASSIGN(const std::optional<Record> record, nextRecord(rest, name));
        if (!record && isFirst) return badInput(fmt::format("{}: ends before its survey", name));
        if (!record) break;
        TRY(addRecord(*record, name, isFirst, atlas));
    }
    if (atlas.isFinished && !rest.empty())
        return badInput(fmt::format("{}: has {} bytes after its end", name, rest.size()));
    if (keptBytes != nullptr) *keptBytes = bytes.size() - rest.size();
    return atlas;
}

Result<Atlas> loadAtlas(const std::filesystem::path& file) {
    TRY_ASSIGN(const OpenFile open, OpenFile::open(file, O_RDONLY | O_NONBLOCK, systemFileCalls()));
    TRY_ASSIGN(const Bytes bytes, readAtlasFile(open));
    return atlasFromBytes(bytes, file.string());
}

std::filesystem::path unfinishedAtlas(const std::filesystem::path& file) {
    std::filesystem::path part = file;
    return part += unfinishedEnding;
}

std::filesystem::path finishedAtlas(const std::filesystem::path& file) {
    std::filesystem::path finished = file;
    return file.extension() == unfinishedEnding ? finished.replace_extension() : finished;
}

bool isNamedAtlas(const std::filesystem::path& file) {
    return finishedAtlas(file).extension() == ".atlas";
}

Result<AtlasWriter> AtlasWriter::create(const std::filesystem::path& file, const AtlasSurvey& survey,
                                        const AtlasTree& tree, const FileCalls& calls) {
    TRY_ASSIGN(OpenFile open, OpenFile::open(unfinishedAtlas(file), O_RDWR | O_CREAT, calls));
    TRY(lockAtlas(open));
    if (uninterrupted([&] { return calls.ftruncate(open.descriptor(), 0); }) < 0)
        return ioError(fmt::format("{}: {}", open.name(), lastSystemError()));
    AtlasWriter writer(file, std::move(open), 0);
    Bytes bytes;
    putHeader(bytes);
    putSurvey(bytes, survey);
    putTree(bytes, tree);
    TRY(writer.write(bytes));
    return writer;
}

Result<std::optional<AtlasWriter::Resumed>> AtlasWriter::resume(const std::filesystem::path& file,
                                                                const FileCalls& calls) {
    const std::filesystem::path part = unfinishedAtlas(file);
    std::error_code status;
    if (!std::filesystem::exists(part, status)) return std::nullopt;
    TRY_ASSIGN(OpenFile open, OpenFile::open(part, O_RDWR | O_NONBLOCK, calls));
    TRY(lockAtlas(open));
    TRY_ASSIGN(const Bytes bytes, readAtlasFile(open));
    std::uint64_t kept = 0;
    TRY_ASSIGN(Atlas atlas, atlasFromBytes(bytes, part.string(), &kept));
    if (uninterrupted([&] { return calls.ftruncate(open.descriptor(), static_cast<off_t>(kept)); }) < 0)
        return ioError(fmt::format("{}: {}", open.name(), lastSystemError()));
    return Resumed{AtlasWriter(file, std::move(open), kept), std::move(atlas)};
}

Result<void> AtlasWriter::write(std::span<const std::byte> bytes) {
    TRY(open_.write(bytes_, bytes));
    bytes_ += bytes.size();
    return {};
}

Result<void> AtlasWriter::append(std::span<const AtlasViewpoint> viewpoints) {
    Bytes bytes;
    putViewpoints(bytes, viewpoints);
    return write(bytes);
}

Result<void> AtlasWriter::finish() {
    Bytes bytes;
    putRecord(bytes, endRecord, {});
    TRY(write(bytes));
    const FileCalls& calls = open_.calls();
    if (uninterrupted([&] { return calls.fsync(open_.descriptor()); }) < 0 ||
        uninterrupted([&] { return calls.rename(unfinishedAtlas(file_).c_str(), file_.c_str()); }) < 0)
        return ioError(fmt::format("{}: {}", file_.string(), lastSystemError()));
    return {};
}

}  // namespace planet
