#include "app/flight/flight_record.h"

#include <fmt/format.h>
#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <new>
#include <optional>
#include <set>

#include "app/base/utf8.h"
#include "app/settings/region_file.h"
#include "app/settings/setting_value.h"
#include "app/settings/settings_schema.h"
#include "app/settings/settings_text.h"
#include "planet/base/atomic_file.h"
#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::BlockId;
using planet::BlockKind;
using planet::ByteReader;
using planet::ByteWriter;
using planet::ChunkId;
using planet::PagingMoves;
using planet::Result;

constexpr std::array<char, 8> magic = {'W', 'Y', 'F', 'L', 'I', 'G', 'H', 'T'};
constexpr std::size_t headerBytes = 28;
constexpr std::size_t mostBytesOfText = 1 << 16;
constexpr std::size_t mostBytesOfSetting = 1 << 22;  // regions take the most
// Regions are no setting in files, but recorded like one, as the text of a regions file.
constexpr std::string_view regionsKey = "regions=";
constexpr int mostSidePx = 1 << 16;
constexpr int compressionLevel = 9;

// The outcome of an arrival that failed because of bad data.
constexpr std::uint8_t badDataOutcome = 4;
static_assert(badDataOutcome > static_cast<std::uint8_t>(planet::PagingOutcome::Cancelled));

// Flags for the parts of a frame that differ from the frame before.
constexpr int callsPart = 1, viewsPart = 2, drawnPart = 4, movesPart = 8, hashPart = 16;

void putText(ByteWriter& out, std::string_view text) {
    out.putVariable(text.size());
    for (const char letter : text) out.put(letter);
}

// The levels of colour blocks are stored after those of chunks of the first 21 levels.
constexpr int firstColourLevel = 21;
static_assert(firstColourLevel + planet::maxColourLevel < 32);
// A chunk of a deeper level is stored with an invalid face; its own face takes the place of the level, and the level
// follows.
constexpr unsigned deepFace = 6;
// A block of normals is stored with an invalid face; its own face takes the place of the level, and the level
// follows.
constexpr unsigned normalsFace = 7;
static_assert(normalsFace >= planet::faceCount && deepFace >= planet::faceCount);

void putWithLevel(ByteWriter& out, unsigned invalidFace, const ChunkId& id) {
    out.put(static_cast<std::uint8_t>(invalidFace * 32 + static_cast<unsigned>(id.face)));
    out.put(id.level);
    out.putVariable(id.x);
    out.putVariable(id.y);
}

void putIdInByte(ByteWriter& out, const ChunkId& id) {
    out.put(static_cast<std::uint8_t>(static_cast<unsigned>(id.face) * 32 + id.level));
    out.putVariable(id.x);
    out.putVariable(id.y);
}

void putId(ByteWriter& out, const ChunkId& id) {
    if (id.level >= firstColourLevel) return putWithLevel(out, deepFace, id);
    putIdInByte(out, id);
}

void putIds(ByteWriter& out, const std::vector<ChunkId>& ids) {
    out.putVariable(ids.size());
    for (const ChunkId& id : ids) putId(out, id);
}

void putBlock(ByteWriter& out, const BlockId& block) {
    ChunkId id = block.parent;
    if (block.kind == BlockKind::Normals) return putWithLevel(out, normalsFace, id);
    if (block.kind == BlockKind::Colours) id.level = static_cast<std::uint8_t>(id.level + firstColourLevel);
    if (block.kind == BlockKind::Colours) return putIdInByte(out, id);
    putId(out, id);
}

void putBlocks(ByteWriter& out, const std::vector<BlockId>& blocks) {
    out.putVariable(blocks.size());
    for (const BlockId& block : blocks) putBlock(out, block);
}

void putMoves(ByteWriter& out, const PagingMoves& moves) {
    out.put(static_cast<std::uint8_t>(moves.gaveUp));
    putBlocks(out, moves.taken);
    out.putVariable(moves.arrived.size());
    for (const PagingMoves::Arrival& arrival : moves.arrived) {
        out.put(arrival.badData ? badDataOutcome : static_cast<std::uint8_t>(arrival.outcome));
        putBlock(out, arrival.block);
    }
    putBlocks(out, moves.requested);
}

bool sameView(const FlownView& a, const FlownView& b) {
    return a.view == b.view && a.priorityFactor == b.priorityFactor;
}

void putView(ByteWriter& out, const planet::View& view) {
    for (const glm::dvec3& vector : {view.eyeM, view.right, view.up, view.back})
        for (int i = 0; i < 3; ++i) out.put(vector[i]);
    out.put(view.horizontalFovRad);
    out.putVariable(static_cast<std::uint64_t>(view.widthPx));
    out.putVariable(static_cast<std::uint64_t>(view.heightPx));
}

void putView(ByteWriter& out, const FlownView& flown) {
    putView(out, flown.view);
    out.put(flown.priorityFactor);
}

void putCalls(ByteWriter& out, const std::vector<CalledInFlight>& calls) {
    out.putVariable(calls.size());
    for (const CalledInFlight& called : calls) {
        out.put(static_cast<std::uint8_t>(called.call));
        if (called.call == FlightCall::Settings) {
            out.put(static_cast<std::uint8_t>(called.pagingPaused));
            out.putVariable(called.settings.size());
            for (const std::string& assignment : called.settings) putText(out, assignment);
        }
        if (called.call == FlightCall::RetryBlock) putBlock(out, called.block);
        if (called.call == FlightCall::Announce) {
            out.putVariable(called.announced.size());
            for (const planet::AnnouncedView& one : called.announced) {
                putView(out, one.view);
                out.put(one.inS);
            }
        }
        putMoves(out, called.moves);
    }
}

// Returns the number of calls of a frame plus the number of their settings and announced views.
std::size_t callsIn(const FlightFrame& frame) {
    std::size_t calls = frame.calls.size();
    for (const CalledInFlight& called : frame.calls)
        calls += called.settings.size() + called.announced.size();
    return calls;
}

std::uint64_t hashOf(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

// Reads data that may be truncated or hostile. After the first problem, ok() is false and all values are
// zero.
class Reader {
public:
    Reader(std::span<const std::byte> bytes, int deepest) : in_(bytes), deepest_(deepest) {}

    bool ok() const { return problem_.empty(); }
    const std::string& problem() const { return problem_; }
    bool atEnd() const { return in_.rest().empty(); }
    void fail(std::string problem) {
        if (ok()) problem_ = std::move(problem);
    }
    void setDeepest(int level) { deepest_ = level; }

    template <class T>
    T get() {
        if (ok() && in_.rest().size() < sizeof(T)) fail("truncated");
        return ok() ? in_.get<T>() : T{};
    }
    std::uint64_t varint() {
        if (!ok()) return 0;
        const auto value = in_.getVariable();
        if (!value)
            fail(value.error() == planet::VariableProblem::Truncated ? "truncated" : "number out of range");
        return value.value_or(0);
    }
    // Reads the number of elements that take at least bytesEach each.
    std::size_t count(std::size_t bytesEach) {
        const std::uint64_t wanted = varint();
        if (ok() && wanted > in_.rest().size() / bytesEach)
            fail(fmt::format("count {} exceeds the remaining data", wanted));
        return ok() ? static_cast<std::size_t>(wanted) : 0;
    }
    std::size_t countUpTo(std::size_t most, const char* what, std::size_t bytesEach) {
        const std::size_t wanted = count(bytesEach);
        if (wanted > most) fail(fmt::format("{} {}; expected at most {}", wanted, what, most));
        return ok() ? wanted : 0;
    }
    std::string text(std::size_t mostBytes) {
        const std::size_t size = countUpTo(mostBytes, "bytes of one text", 1);
        std::string text;
        for (std::size_t i = 0; i < size && ok(); ++i) text.push_back(get<char>());
        return text;
    }
    // Reads a text for reports and messages, which need UTF-8.
    std::string utf8(const char* what, std::size_t mostBytes = mostBytesOfText) {
        std::string value = text(mostBytes);
        if (!isUtf8(value)) fail(fmt::format("{} is not UTF-8", what));
        return ok() ? value : std::string();
    }
    double number(double low, double high) {
        const auto value = get<double>();
        if (ok() && !(value >= low && value <= high))
            fail(fmt::format("value {}; expected [{}, {}]", value, low, high));
        return ok() ? value : low;
    }
    ChunkId id() {
        const BlockId named = block();
        if (named.kind != BlockKind::Heights) fail("block is a tile; expected a chunk");
        return named.parent;
    }
    BlockId block() {
        const unsigned first = get<std::uint8_t>();
        BlockKind kind = first % 32 >= firstColourLevel ? BlockKind::Colours : BlockKind::Heights;
        unsigned face = first / 32;
        int level = static_cast<int>(first % 32) - (kind == BlockKind::Colours ? firstColourLevel : 0);
        if (face == normalsFace || face == deepFace) {
            kind = face == normalsFace ? BlockKind::Normals : BlockKind::Heights;
            face = first % 32;
            level = get<std::uint8_t>();
        }
        const std::uint64_t x = varint(), y = varint();
        const int deepest = kind == BlockKind::Heights ? deepest_ : planet::maxTileLevel;
        if (ok() && (face >= planet::faceCount || level > deepest || x >> level > 0 || y >> level > 0))
            fail("unknown chunk");
        if (!ok()) return {};
        return {{static_cast<planet::Face>(face), static_cast<std::uint8_t>(level),
                 static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)},
                kind};
    }
    std::vector<BlockId> blocks() {
        std::vector<BlockId> all;
        for (std::size_t left = count(3); left > 0 && ok(); --left) all.push_back(block());
        return all;
    }
    std::vector<ChunkId> ids() {
        std::vector<ChunkId> all;
        for (std::size_t left = count(3); left > 0 && ok(); --left) all.push_back(id());
        return all;
    }
    PagingMoves moves() {
        PagingMoves moves;
        moves.gaveUp = get<std::uint8_t>() != 0;
        moves.taken = blocks();
        for (std::size_t left = count(4); left > 0 && ok(); --left) {
            PagingMoves::Arrival& arrival = moves.arrived.emplace_back();
            auto outcome = get<std::uint8_t>();
            arrival.badData = outcome == badDataOutcome;
            if (arrival.badData) outcome = static_cast<std::uint8_t>(planet::PagingOutcome::Failed);
            arrival.outcome = static_cast<planet::PagingOutcome>(outcome);
            if (outcome > static_cast<std::uint8_t>(planet::PagingOutcome::Cancelled) ||
                arrival.outcome == planet::PagingOutcome::Evicted)
                fail(fmt::format("invalid read outcome {}", outcome));
            arrival.block = block();
        }
        moves.requested = blocks();
        return moves;
    }

private:
    ByteReader in_;
    int deepest_;
    std::string problem_;
};

constexpr double farthestEyeM = 1e12;

glm::dvec3 readVector(Reader& in, double most) {
    glm::dvec3 vector;
    for (int i = 0; i < 3; ++i) vector[i] = in.number(-most, most);
    return vector;
}

bool isUnit(const glm::dvec3& vector) {
    return std::abs(glm::length(vector) - 1) < 1e-6;
}

planet::View readView(Reader& in) {
    planet::View view;
    view.eyeM = readVector(in, farthestEyeM);
    view.right = readVector(in, 2);
    view.up = readVector(in, 2);
    view.back = readVector(in, 2);
    const bool square = isUnit(view.right) && isUnit(view.up) && isUnit(view.back) &&
                        glm::length(glm::cross(view.right, view.up) - view.back) < 1e-6;
    if (in.ok() && glm::length(view.eyeM) < 1e-3) in.fail("camera at the planet's centre");
    if (!square) in.fail("camera axes are not at right angles");
    view.horizontalFovRad = in.number(1e-6, 3.1415);
    const std::uint64_t width = in.varint(), height = in.varint();
    if (width < 1 || height < 1 || width > mostSidePx || height > mostSidePx)
        in.fail(fmt::format("picture of {} x {} pixels", width, height));
    if (!in.ok()) return {};
    view.widthPx = static_cast<int>(width);
    view.heightPx = static_cast<int>(height);
    return view;
}

FlownView readFlownView(Reader& in) {
    FlownView flown;
    flown.view = readView(in);
    if (in.ok()) flown.priorityFactor = in.number(1e-9, 1e9);
    return flown;
}

FlightData readData(Reader& in) {
    FlightData data;
    data.chunkFile = in.text(mostBytesOfText);
    data.shape.radiusM = in.number(1e-3, 1e9);
    data.shape.quantumM = in.number(1e-12, 1e9);
    data.shape.baseHeightM = in.number(-1e9, 1e9);
    data.shape.faceCellsLog2 = in.get<std::uint8_t>();
    data.shape.chunkCellsLog2 = in.get<std::uint8_t>();
    const planet::PlanetShape& shape = data.shape;
    if (shape.chunkCellsLog2 < 4 || shape.chunkCellsLog2 > 7 || shape.faceCellsLog2 < shape.chunkCellsLog2 ||
        shape.faceCellsLog2 > planet::maxFaceCellsLog2)
        in.fail("invalid planet shape");
    data.fileBytes = in.get<std::uint64_t>();
    data.headerHash = in.get<std::uint64_t>();
    return data;
}

void putData(ByteWriter& out, const FlightData& data) {
    putText(out, data.chunkFile);
    out.put(data.shape.radiusM);
    out.put(data.shape.quantumM);
    out.put(data.shape.baseHeightM);
    out.put(static_cast<std::uint8_t>(data.shape.faceCellsLog2));
    out.put(static_cast<std::uint8_t>(data.shape.chunkCellsLog2));
    out.put(data.fileBytes);
    out.put(data.headerHash);
}

// Reads views without their drawn chunks.
std::vector<FlownView> readViews(Reader& in) {
    const std::size_t count = in.get<std::uint8_t>();
    if (count == 0 || count > planet::maxViews) {
        in.fail(fmt::format("frame of {} views; expected [1, {}]", count, planet::maxViews));
        return {};
    }
    std::vector<FlownView> views(count);
    for (FlownView& view : views) view = readFlownView(in);
    return views;
}

// The state that frames are checked against.
struct FlightSoFar {
    std::vector<std::set<ChunkId>> drawn;  // by view
    ViewSettings settings;
    double seconds = 0;
    std::size_t calls = 0;  // calls plus their settings and announced views
    std::size_t settingsACall = flightSettings(ViewSettings{}).size();
};

CalledInFlight readCall(Reader& in, FlightSoFar& soFar) {
    CalledInFlight called;
    const auto call = in.get<std::uint8_t>();
    if (call > static_cast<std::uint8_t>(FlightCall::Announce)) in.fail(fmt::format("unknown call {}", call));
    called.call = static_cast<FlightCall>(call);
    if (in.ok() && called.call == FlightCall::Settings) {
        called.pagingPaused = in.get<std::uint8_t>() != 0;
        for (std::size_t left = in.countUpTo(soFar.settingsACall, "settings in a call", 1);
             left > 0 && in.ok(); --left)
            called.settings.push_back(in.utf8("setting", mostBytesOfSetting));
        if (!in.ok()) return called;
        if (const Result<void> good = applyFlightSettings(called.settings, soFar.settings); !good)
            in.fail("invalid setting: " + good.error().message);
    }
    if (called.call == FlightCall::RetryBlock) called.block = in.block();
    if (in.ok() && called.call == FlightCall::Announce) {
        constexpr std::size_t leastBytes = 115;  // of a view and its time
        for (std::size_t left = in.countUpTo(planet::maxAnnounced, "announced views in a call", leastBytes);
             left > 0 && in.ok(); --left) {
            const planet::View view = readView(in);
            called.announced.push_back({view, in.number(0, planet::latestAnnouncedS)});
        }
    }
    called.moves = in.moves();
    return called;
}

void readCalls(Reader& in, FlightFrame& frame, FlightSoFar& soFar) {
    for (std::size_t left = in.countUpTo(maxCallsAFrame, "calls in a frame", 5); left > 0 && in.ok();
         --left) {
        frame.calls.push_back(readCall(in, soFar));
        soFar.calls += 1 + frame.calls.back().settings.size() + frame.calls.back().announced.size();
        if (soFar.calls > maxFlightCalls) {
            in.fail(fmt::format("more than {} calls, settings and announced views", maxFlightCalls));
        }
    }
}

void checkAscending(Reader& in, const std::vector<ChunkId>& ids, const char* what) {
    const auto wrong = std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>());
    if (wrong != ids.end()) {
        in.fail(fmt::format("duplicate or unsorted {}: {}; expected each once, ascending", what,
                            toString(*(wrong + 1))));
    }
}

// Updates the drawn chunks, and checks that chunks appear and vanish consistently.
void followDrawn(Reader& in, const FlownView& view, std::set<ChunkId>& drawn) {
    checkAscending(in, view.appeared, "appearance");
    checkAscending(in, view.vanished, "disappearance");
    for (const ChunkId& id : view.appeared) {
        if (!in.ok()) return;
        if (drawn.count(id) > 0) in.fail(fmt::format("{} appears although already drawn", toString(id)));
    }
    for (const ChunkId& id : view.vanished) {
        if (!in.ok()) return;
        if (drawn.erase(id) == 0) in.fail(fmt::format("{} vanishes although not drawn", toString(id)));
    }
    if (drawn.size() + view.appeared.size() > maxFlightChunks)
        in.fail(fmt::format("more than {} chunks drawn in a view", maxFlightChunks));
    if (in.ok()) drawn.insert(view.appeared.begin(), view.appeared.end());
}

// before is null for the first frame.
FlightFrame readFrame(Reader& in, const FlightFrame* before, FlightSoFar& soFar) {
    FlightFrame frame;
    const auto parts = in.get<std::uint8_t>();
    frame.elapsedS = in.number(0, maxFlightS);
    soFar.seconds += frame.elapsedS;
    if (soFar.seconds > maxFlightS) in.fail(fmt::format("later than {} s", maxFlightS));
    if (before) frame.selectionHash = before->selectionHash;
    if (parts & callsPart) readCalls(in, frame, soFar);
    if (parts & viewsPart) {
        frame.views = readViews(in);
    } else if (before) {
        frame.views = before->views;
        for (FlownView& view : frame.views) {
            view.appeared.clear();
            view.vanished.clear();
        }
    } else {
        in.fail("first frame has no view");
    }
    soFar.drawn.resize(frame.views.size());
    if (parts & drawnPart) {
        for (std::size_t v = 0; v < frame.views.size() && in.ok(); ++v) {
            frame.views[v].appeared = in.ids();
            frame.views[v].vanished = in.ids();
            followDrawn(in, frame.views[v], soFar.drawn[v]);
        }
    }
    if (parts & movesPart) frame.moves = in.moves();
    if (parts & hashPart) frame.selectionHash = in.get<std::uint64_t>();
    return frame;
}

FlightRecord readContent(Reader& in) {
    FlightRecord record;
    record.name = in.utf8("name");
    record.data = readData(in);
    if (!in.ok()) return record;
    in.setDeepest(std::min(planet::deepestLevelOf(record.data.shape), planet::maxLevel));
    const auto frames = in.get<std::uint32_t>();
    if (frames == 0 || frames > maxFlightFrames)
        in.fail(fmt::format("{} frames; expected [1, {}]", frames, maxFlightFrames));
    FlightSoFar soFar;
    for (std::uint32_t i = 0; i < frames && in.ok(); ++i) {
        const FlightFrame* before = record.frames.empty() ? nullptr : &record.frames.back();
        FlightFrame frame = readFrame(in, before, soFar);
        record.frames.push_back(std::move(frame));
    }
    if (in.ok() && !in.atEnd()) in.fail("data after the end");
    return record;
}

Result<std::vector<std::byte>> readWhole(const fs::path& file) {
    std::error_code status;
    if (!fs::exists(file, status))
        return planet::badInput(fmt::format("{}: no such file; expected a .flight file", file.string()));
    const std::uintmax_t size = fs::is_regular_file(file, status) ? fs::file_size(file, status) : 0;
    if (size < headerBytes || size > 2 * maxFlightBytes) {
        return planet::badInput(
            fmt::format("{}: not a recorded flight: {} bytes; expected {} bytes to {} MiB", file.string(),
                        size, headerBytes, 2 * maxFlightBytes >> 20));
    }
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!stream)
        return planet::ioError(fmt::format("{}: cannot be read; expected a readable file", file.string()));
    return bytes;
}

Result<std::vector<std::byte>> contentBytes(std::span<const std::byte> all, const fs::path& file) {
    const auto wrong = [&](const std::string& what) {
        return planet::badInput(fmt::format("{}: {}", file.string(), what));
    };
    if (all.size() < headerBytes || std::memcmp(all.data(), magic.data(), magic.size()) != 0)
        return wrong("not a recorded flight; expected a .flight file by Worldy");
    ByteReader header(all.subspan(magic.size(), headerBytes - magic.size()));
    const auto version = header.get<std::uint32_t>();
    if (version != flightRecordVersion) {
        return wrong(fmt::format("version {}; expected {}: record it again", version, flightRecordVersion));
    }
    const auto size = header.get<std::uint64_t>();
    const auto checksum = header.get<std::uint64_t>();
    if (size > maxFlightBytes + (1u << 20))
        return wrong(fmt::format("{} bytes; expected at most {}", size, maxFlightBytes));
    std::vector<std::byte> content(static_cast<std::size_t>(size));
    const auto packed = all.subspan(headerBytes);
    const std::size_t got = ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
    if (ZSTD_isError(got) || got != content.size() || hashOf(content) != checksum)
        return wrong("is damaged or truncated: checksum mismatch; expected a complete recording");
    return content;
}

}  // namespace

FlightData flightDataOf(const planet::ChunkFile& file) {
    // The record of the source, which nothing shows, does not count.
    planet::ChunkFileInfo info = file.info();
    std::uint64_t bytes = file.sizeBytes();
    const auto record = file.readSourceRecord();
    if (record && *record) {
        info.hasSourceRecord = false;
        bytes -= planet::sourceRecordBytes(**record).size();
    }
    const auto header = planet::headerBytes(info, bytes);
    return {file.name(), file.info().shape, bytes, hashOf(header)};
}

Result<void> checkSameData(const fs::path& flight, const FlightData& recorded, const FlightData& present) {
    const auto differs = [&](const std::string& how) {
        return planet::badInput(
            fmt::format("{}: was recorded with a different file than {}: {}; expected {} or a copy of it",
                        flight.string(), present.chunkFile, how, recorded.chunkFile));
    };
    const planet::PlanetShape &a = recorded.shape, &b = present.shape;
    if (a.radiusM != b.radiusM || a.quantumM != b.quantumM || a.baseHeightM != b.baseHeightM)
        return differs(fmt::format("a radius of {} m and steps of {} m, not {} m and {} m", a.radiusM,
                                   a.quantumM, b.radiusM, b.quantumM));
    if (a.faceCellsLog2 != b.faceCellsLog2 || a.chunkCellsLog2 != b.chunkCellsLog2)
        return differs(fmt::format("faces of {} samples in chunks of {}, not {} in {}",
                                   planet::faceCells(a) + 1, planet::chunkSize(a), planet::faceCells(b) + 1,
                                   planet::chunkSize(b)));
    if (recorded.fileBytes != present.fileBytes)
        return differs(fmt::format("{} bytes, not {}", recorded.fileBytes, present.fileBytes));
    if (recorded.headerHash != present.headerHash) return differs("header differs");
    return {};
}

namespace {

bool isFlightField(const Field& field) {
    return field.table != "view" || (field.key != "flight" && field.key != "mode");
}

}  // namespace

std::vector<std::string> flightSettings(const ViewSettings& now) {
    ViewSettings copy = now;
    std::vector<std::string> assignments;
    for (const Field& field : fieldsOf(copy)) {
        if (isFlightField(field)) assignments.push_back(fmt::format("{}={}", field.name(), plainText(field)));
    }
    assignments.push_back(fmt::format("{}{}", regionsKey, regionsText(now.regions.all())));
    return assignments;
}

std::vector<std::string> flightSettings(const ViewSettings& before, const ViewSettings& now) {
    if (before == now) return {};
    const std::vector<std::string> then = flightSettings(before);
    std::vector<std::string> changed = flightSettings(now);
    std::erase_if(changed,
                  [&, i = std::size_t{0}](const std::string& one) mutable { return one == then[i++]; });
    return changed;
}

Result<void> applyFlightSettings(const std::vector<std::string>& assignments, ViewSettings& settings) {
    Settings all;
    all.view = settings;
    for (const std::string& assignment : assignments) {
        if (assignment.starts_with(regionsKey)) {
            TRY_ASSIGN(auto regions, regionsFromText(std::string_view(assignment).substr(regionsKey.size()),
                                                     "recorded regions"));
            all.view.regions.list = std::make_shared<const std::vector<planet::Region>>(std::move(regions));
            continue;
        }
        const bool ofView = isViewTable(assignment.substr(0, assignment.find('.')));
        if (!ofView)
            return planet::badInput(
                fmt::format("{:.60}: is not a view setting; expected one such as lod.tau_px=3", assignment));
        if (Result<void> set = setSetting(all, assignment); !set) return set;
    }
    settings = all.view;
    return {};
}

bool FlightEncoder::fits(const FlightFrame& frame) const {
    return frame.calls.size() <= maxCallsAFrame && calls_ + callsIn(frame) <= maxFlightCalls &&
           seconds_ + frame.elapsedS <= maxFlightS;
}

void FlightEncoder::add(const FlightFrame& frame) {
    const bool newViews = frames_ == 0 || !std::equal(frame.views.begin(), frame.views.end(), views_.begin(),
                                                      views_.end(), sameView);
    const bool drawn = std::any_of(frame.views.begin(), frame.views.end(), [](const FlownView& view) {
        return !view.appeared.empty() || !view.vanished.empty();
    });
    const bool newHash = frame.selectionHash != hash_;
    const int parts = (frame.calls.empty() ? 0 : callsPart) | (newViews ? viewsPart : 0) |
                      (drawn ? drawnPart : 0) | (frame.moves == PagingMoves{} ? 0 : movesPart) |
                      (newHash ? hashPart : 0);
    ByteWriter out(bytes_);
    out.put(static_cast<std::uint8_t>(parts));
    out.put(frame.elapsedS);
    if (parts & callsPart) putCalls(out, frame.calls);
    if (newViews) {
        out.put(static_cast<std::uint8_t>(frame.views.size()));
        for (const FlownView& view : frame.views) putView(out, view);
    }
    if (drawn) {
        for (const FlownView& view : frame.views) {
            putIds(out, view.appeared);
            putIds(out, view.vanished);
        }
    }
    if (parts & movesPart) putMoves(out, frame.moves);
    if (newHash) out.put(frame.selectionHash);
    ++frames_;
    calls_ += callsIn(frame);
    seconds_ += frame.elapsedS;
    hash_ = frame.selectionHash;
    views_ = frame.views;
}

Result<void> FlightEncoder::write(const fs::path& file, const std::string& name, const FlightData& data,
                                  IfThere ifThere) const {
    std::vector<std::byte> content;
    ByteWriter out(content);
    putText(out, name);
    putData(out, data);
    out.put(static_cast<std::uint32_t>(frames_));
    content.insert(content.end(), bytes_.begin(), bytes_.end());

    const Result<std::vector<std::byte>> bytes = flightFileBytes(content, compressionLevel);
    if (!bytes) return planet::ioError(fmt::format("{}: {}", file.string(), bytes.error().message));
    Result<planet::AtomicFile> target = planet::AtomicFile::create(file);
    if (!target) return tl::unexpected(target.error());
    // From here on no other process can write the file.
    std::error_code status;
    if (ifThere == IfThere::Fail && fs::exists(fs::symlink_status(file, status))) {
        return planet::ioError(fmt::format("{}: already exists; expected another name", file.string()));
    }
    return target->append(*bytes).and_then([&] { return target->commit(); });
}

Result<std::vector<std::byte>> flightFileBytes(std::span<const std::byte> content, int level) {
    std::vector<std::byte> bytes;
    ByteWriter head(bytes);
    for (const char letter : magic) head.put(letter);
    head.put(flightRecordVersion);
    head.put(static_cast<std::uint64_t>(content.size()));
    head.put(hashOf(content));
    bytes.resize(headerBytes + ZSTD_compressBound(content.size()));
    const std::size_t size = ZSTD_compress(bytes.data() + headerBytes, bytes.size() - headerBytes,
                                           content.data(), content.size(), level);
    if (ZSTD_isError(size))
        return planet::ioError(fmt::format("cannot be compressed: {}", ZSTD_getErrorName(size)));
    bytes.resize(headerBytes + size);
    return bytes;
}

namespace {

Result<FlightRecord> readRecord(std::span<const std::byte> bytes, const fs::path& file) {
    const Result<std::vector<std::byte>> content = contentBytes(bytes, file);
    if (!content) return tl::unexpected(content.error());
    Reader in(*content, 0);
    FlightRecord record = readContent(in);
    if (in.ok()) return record;
    const std::string where =
        record.frames.empty() ? "its beginning" : fmt::format("frame {}", record.frames.size());
    return planet::badInput(fmt::format("{}: {}: {}; record it again", file.string(), where, in.problem()));
}

template <class Read>
Result<FlightRecord> withinMemory(const fs::path& file, const Read& read) {
    try {
        return read();
    } catch (const std::bad_alloc&) {
        return planet::badInput(fmt::format(
            "{}: is too large for the available memory; expected a shorter recording", file.string()));
    }
}

}  // namespace

Result<FlightRecord> loadFlightRecord(const fs::path& file) {
    return withinMemory(file, [&] {
        return readWhole(file).and_then(
            [&](const std::vector<std::byte>& bytes) { return readRecord(bytes, file); });
    });
}

Result<FlightRecord> flightRecordFromBytes(std::span<const std::byte> bytes, const fs::path& place) {
    return withinMemory(place, [&] { return readRecord(bytes, place); });
}

bool isFlightRecord(const fs::path& file) {
    return file.extension() == recordedFlightEnding;
}

}  // namespace worldy
