#include "planet/trace/trace_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"

namespace planet {

namespace {

enum class Definition : std::uint8_t { Description = 1, Name = 2, Node = 3 };
enum class Event : std::uint8_t {
    FrameBegin = 1,
    FrameEnd = 2,
    ViewNumbers = 3,
    Drawn = 4,
    Culled = 5,
    SelectView = 6,
    Requested = 7,
    Started = 8,
    Arrived = 9,
    Cancelled = 10,
    Failed = 11,
    Evicted = 12,
    Counter = 13,
    Setting = 14,
    Message = 15,
    Dropped = 16,
    Thread = 17,
    ThreadName = 18,
    Restore = 19,
};
constexpr std::size_t viewWords = 39;  // eye 3, view 16, projection 16, viewport 4
constexpr std::size_t viewDoubles = 35;

// Returns a text with spaces for control characters, also those that UTF-8 codes as C2 80 to C2 9F: it goes to terminals and
// into lists whose entries end with a zero.
std::string printable(std::string text) {
    const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool isLong =
            byteAt(i) == 0xC2 && i + 1 < text.size() && byteAt(i + 1) >= 0x80 && byteAt(i + 1) < 0xA0;
        if (isLong) text[i + 1] = ' ';
        if (isLong || byteAt(i) < 0x20 || byteAt(i) == 0x7F) text[i] = ' ';
    }
    return text;
}

// Reads values; after the first that is missing or invalid it gives zeros, and `problem` says what was wrong.
class Cursor {
public:
    explicit Cursor(std::span<const std::byte> bytes) : bytes_(bytes), size_(bytes.size()) {}

    bool atEnd() const { return bytes_.empty(); }
    std::size_t offset() const { return size_ - bytes_.size(); }
    const char* problem() const { return problem_; }  // nullptr: none
    void fail(const char* problem) {
        if (problem_ == nullptr) problem_ = problem;
    }
    // Returns the value, or 0 with a problem if it is larger than the most.
    template <class T>
    T atMost(T value, std::uint64_t most, const char* problem) {
        if (static_cast<std::uint64_t>(value) <= most) return value;
        fail(problem);
        return 0;
    }

    template <Number T>
    T number() {
        const auto taken = take(sizeof(T));
        return taken.empty() ? T{0} : readLittleEndian<T>(taken.data());
    }
    std::uint8_t byte() { return number<std::uint8_t>(); }
    std::uint64_t varint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            const std::uint8_t part = byte();
            if (shift == 63 && part > 1) break;
            value |= static_cast<std::uint64_t>(part & 0x7F) << shift;
            if ((part & 0x80) == 0) return value;
        }
        fail("a number has more than 64 bits");
        return 0;
    }
    // Reads a difference to a value and adds it, modulo 2^64.
    std::uint64_t delta(std::uint64_t from) {
        const std::uint64_t coded = varint();
        return from + (coded >> 1 ^ (~(coded & 1) + 1));
    }
    std::uint64_t index(std::uint64_t value, std::size_t count, const char* problem) {
        if (value < count) return value;
        fail(problem);
        return 0;
    }
    std::string text(std::size_t most) {
        const auto length = atMost(varint(), most, "a text is too long");
        const auto taken = take(length);
        return printable({reinterpret_cast<const char*>(taken.data()), taken.size()});
    }
    glm::dvec3 vector() {
        glm::dvec3 value;
        for (int axis = 0; axis < 3; ++axis) value[axis] = number<double>();
        return value;
    }

private:
    std::span<const std::byte> take(std::size_t count) {
        if (problem_ == nullptr && count > bytes_.size()) problem_ = "the bytes end inside a value";
        if (problem_ != nullptr) return {};
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }

    std::span<const std::byte> bytes_;
    std::size_t size_;
    const char* problem_ = nullptr;
};

tl::unexpected<Error> problemAt(const Cursor& in, std::size_t offset) {
    return badInput(
        fmt::format("byte {} of the block: {}; expected an undamaged trace", offset, in.problem()));
}

template <class Enum>
Enum enumFrom(Cursor& in, std::uint8_t value, Enum last) {
    return static_cast<Enum>(
        in.atMost(value, static_cast<std::uint64_t>(last), "an enumeration has an unknown value"));
}

TraceDescription descriptionFrom(Cursor& in) {
    TraceDescription description;
    description.shape = enumFrom(in, in.byte(), TraceShape::Sphere);
    description.ids = enumFrom(in, in.byte(), TraceIds::Quadtree);
    description.error = enumFrom(in, in.byte(), TraceErrorUnit::Pixels);
    description.requests = enumFrom(in, in.byte(), TraceRequests::Children);
    description.radius = in.number<double>();
    description.metresPerUnit = in.number<double>();
    description.name = in.text(maxTraceNameBytes);
    for (std::string& kind : description.kinds) kind = in.text(maxTraceNameBytes);
    return description;
}

TraceBounds boundsFrom(Cursor& in, TraceBoundsShape shape) {
    TraceBounds bounds{.shape = shape};
    if (shape != TraceBoundsShape::None) bounds.centre = in.vector();
    if (shape == TraceBoundsShape::Sphere) bounds.radius = in.number<double>();
    if (shape != TraceBoundsShape::Box) return bounds;
    for (glm::dvec3& axis : bounds.axes) axis = in.vector();
    bounds.halfSize = in.vector();
    return bounds;
}

TraceNodeTold nodeFrom(Cursor& in) {
    TraceNodeTold told;
    const std::uint8_t flags = in.atMost(in.byte(), 15, "a node has unknown flags");
    told.index =
        static_cast<TraceNodeIndex>(in.atMost(in.varint(), maxTraceNodes - 1, "there are too many nodes"));
    TraceNode& node = told.node;
    node.id = in.number<std::uint64_t>();
    node.isTold = (flags & 1) != 0;
    if (!node.isTold) return told;
    node.hasParent = (flags & 2) != 0;
    if (node.hasParent) node.parent = in.number<std::uint64_t>();
    node.level = static_cast<std::uint32_t>(in.atMost(in.varint(), 0xFFFFFFFFu, "a level is too large"));
    node.bounds = boundsFrom(in, enumFrom(in, static_cast<std::uint8_t>(flags >> 2), TraceBoundsShape::Box));
    node.error = in.number<double>();
    node.bytes = in.varint();
    node.triangles = in.varint();
    return told;
}

TraceView viewFrom(const std::array<std::uint64_t, viewWords>& words) {
    TraceView view;
    std::size_t at = 0;
    for (int i = 0; i < 3; ++i) view.eye[i] = std::bit_cast<double>(words[at++]);
    for (glm::dmat4* matrix : {&view.view, &view.projection})
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row) (*matrix)[column][row] = std::bit_cast<double>(words[at++]);
    for (int* pixels : {&view.x, &view.y, &view.width, &view.height})
        *pixels = static_cast<int>(static_cast<std::uint32_t>(words[at++]));
    return view;
}

// Decodes the events of one block: the values that they are relative to are reset in each.
class EventDecoder {
public:
    EventDecoder(const TraceBlockHeader& header, Cursor& in, std::size_t nodes, std::size_t names)
        : in_(in), nodes_(nodes), names_(names), frame_(header.frame), ns_(header.ns), blockNs_(header.ns) {
        views_.fill(noView);
    }

    // Decodes one event; nothing if it only says what the next ones refer to, or if in.problem() is set.
    std::optional<TraceEvent> next() {
        const std::uint8_t first = in_.byte();
        flags_ = static_cast<std::uint8_t>(first >> 5);
        const auto type = static_cast<Event>(first & 31);
        switch (type) {
            case Event::FrameBegin:
                return frameBegan();
            case Event::FrameEnd:
                return frameEnded();
            case Event::ViewNumbers:
                return viewTold();
            case Event::Drawn:
                return drawn();
            case Event::Culled:
                return culled();
            case Event::SelectView:
                view_ = viewIndex();
                return std::nullopt;
            case Event::Requested:
            case Event::Started:
            case Event::Arrived:
            case Event::Cancelled:
            case Event::Failed:
            case Event::Evicted:
                return paged(type);
            case Event::Counter:
                return counted();
            case Event::Setting:
                return set();
            case Event::Message:
                return message();
            case Event::Dropped:
                return TraceDropped{in_.varint()};
            case Event::Thread:
                thread_ = threadIndex();
                return std::nullopt;
            case Event::ThreadName:
                return threadNamed();
            case Event::Restore:
                return restored();
        }
        in_.fail("an event has an unknown type");
        return std::nullopt;
    }

private:
    static constexpr std::array<std::uint64_t, viewWords> noView{};

    std::uint64_t time() { return ns_ = in_.delta(ns_); }
    std::uint8_t viewIndex() {
        return in_.atMost(in_.byte(), maxTraceViews - 1, "a view's number is too large");
    }
    std::uint8_t threadIndex() {
        return static_cast<std::uint8_t>(
            in_.atMost(in_.varint(), maxTraceThreads - 1, "there are too many threads"));
    }
    TraceNameIndex nameIndex() {
        return static_cast<TraceNameIndex>(in_.index(in_.varint(), names_, "a name is not defined"));
    }
    TraceNodeIndex nodeIndex(std::uint64_t& last) {
        last = in_.index(in_.delta(last), nodes_, "a node is not defined");
        return static_cast<TraceNodeIndex>(last);
    }
    std::uint8_t kindFrom(std::uint8_t value) {
        return in_.atMost(value, maxTraceKinds - 1, "a kind's number is too large");
    }

    TraceEvent frameBegan() {
        TraceFrameBegan began;
        began.number = frame_ = in_.delta(frame_);
        began.ns = time();
        began.timeS = in_.number<double>();
        return began;
    }
    TraceEvent frameEnded() {
        TraceFrameEnded ended;
        ended.ns = time();
        ended.cpuMs = in_.number<double>();
        ended.gpuMs = in_.number<double>();
        return ended;
    }
    TraceEvent viewTold() {
        const std::uint8_t view = viewIndex();
        const std::uint64_t changed = in_.varint();
        if (changed >> viewWords != 0) in_.fail("a view has unknown numbers");
        auto& words = views_[view];
        for (std::size_t i = 0; i < viewWords; ++i) {
            if ((changed >> i & 1) == 0) continue;
            words[i] = i < viewDoubles ? in_.number<std::uint64_t>() : in_.number<std::uint32_t>();
        }
        return TraceViewTold{view, viewFrom(words)};
    }
    TraceEvent drawn() {
        TraceDrawn event{.view = view_, .node = nodeIndex(lastDrawn_)};
        const int morph = flags_ & 3;
        if (morph == 3) in_.fail("a morph has an unknown form");
        event.morph = morph == 2 ? in_.number<float>() : static_cast<float>(morph);
        event.hasErrorPx = (flags_ & 4) != 0;
        if (event.hasErrorPx) event.errorPx = in_.number<float>();
        return event;
    }
    TraceEvent culled() {
        return TraceCulled{view_, nodeIndex(lastDrawn_), enumFrom(in_, flags_, TraceCulling::Other)};
    }
    TraceEvent paged(Event type) {
        TracePaged event{
            .step = static_cast<TraceStep>(static_cast<int>(type) - static_cast<int>(Event::Requested))};
        if (flags_ > (type == Event::Requested ? 3 : 1)) in_.fail("a paging event has unknown flags");
        if ((flags_ & 1) != 0) event.kind = kindFrom(in_.byte());
        event.thread = thread_;
        event.node = nodeIndex(lastPaged_);
        event.ns = time();
        event.hasPriority = (flags_ & 2) != 0;
        if (event.hasPriority) event.priority = in_.number<float>();
        if (type == Event::Failed) event.reason = nameIndex();
        return event;
    }
    TraceEvent counted() {
        TraceCounted event{.name = nameIndex()};
        event.value =
            flags_ == 1 ? static_cast<double>(static_cast<std::int64_t>(in_.delta(0))) : in_.number<double>();
        return event;
    }
    TraceEvent set() {
        TraceSet event{.name = nameIndex(), .value = 0.0};
        if (flags_ == 1) {
            event.value = in_.text(maxTraceTextBytes);
        } else {
            event.value = in_.number<double>();
        }
        return event;
    }
    TraceEvent message() {
        TraceMessage event{
            .severity = enumFrom(in_, flags_, TraceSeverity::Failure), .thread = thread_, .text = {}};
        event.ns = time();
        event.text = in_.text(maxTraceTextBytes);
        return event;
    }
    TraceEvent threadNamed() {
        const std::uint8_t thread = threadIndex();
        return TraceThreadNamed{thread, nameIndex()};
    }
    TraceEvent restored() {
        TraceRestored event;
        const std::uint8_t state = in_.byte();
        event.kind = kindFrom(static_cast<std::uint8_t>(state >> 4));
        event.data = enumFrom(in_, state & 15, TraceData::Failed);
        event.node = nodeIndex(lastPaged_);
        const bool isPending = event.data == TraceData::Requested || event.data == TraceData::Started;
        if (isPending) event.requestedNs = in_.delta(blockNs_);
        if (event.data == TraceData::Started) event.startedNs = in_.delta(blockNs_);
        return event;
    }

    Cursor& in_;
    std::size_t nodes_;
    std::size_t names_;
    std::uint64_t frame_;
    std::uint64_t ns_;
    std::uint64_t blockNs_;
    std::uint64_t lastDrawn_ = 0;
    std::uint64_t lastPaged_ = 0;
    std::uint8_t view_ = 0;
    std::uint8_t thread_ = 0;
    std::uint8_t flags_ = 0;
    std::array<std::array<std::uint64_t, viewWords>, maxTraceViews> views_{};
};

}  // namespace

Result<void> checkTraceHeader(std::span<const std::byte, traceHeaderBytes> bytes) {
    ByteReader in(bytes);
    const auto magic = in.take(8);
    if (std::memcmp(magic.data(), "LODTRACE", magic.size()) != 0)
        return badInput("is no trace; expected a file that lod_trace.h wrote");
    const auto version = in.get<std::uint16_t>();
    if (version != traceVersion)
        return badInput(fmt::format("version: {} is unknown; expected {}", version, traceVersion));
    const auto size = in.get<std::uint16_t>();
    const auto reserved = in.get<std::uint32_t>();
    if (size != traceHeaderBytes || reserved != 0)
        return badInput("the header is inconsistent; expected an undamaged trace");
    return {};
}

std::uint32_t traceChecksum(std::span<const std::byte> bytes) {
    std::uint32_t hash = 2166136261u;
    for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint32_t>(byte)) * 16777619u;
    return hash;
}

Result<TraceBlockHeader> traceBlockHeaderFrom(std::span<const std::byte, traceBlockHeaderBytes> bytes) {
    ByteReader in(bytes);
    const auto magic = in.take(4);
    if (std::memcmp(magic.data(), "LTB1", magic.size()) != 0)
        return badInput("no block begins here; expected \"LTB1\"");
    const auto told = readLittleEndian<std::uint32_t>(bytes.last<4>().data());
    if (told != traceChecksum(bytes.first<traceBlockHeaderBytes - 4>()))
        return badInput("the checksum of the block's header does not match; expected an undamaged trace");
    TraceBlockHeader header;
    header.bytes = in.get<std::uint32_t>();
    header.definitionBytes = in.get<std::uint32_t>();
    const auto flags = in.get<std::uint32_t>();
    header.isKey = (flags & 1) != 0;
    header.isInside = (flags & 2) != 0;
    header.frame = in.get<std::uint64_t>();
    header.ns = in.get<std::uint64_t>();
    header.frames = in.get<std::uint32_t>();
    header.events = in.get<std::uint32_t>();
    header.checksum = in.get<std::uint32_t>();
    if (header.bytes > maxTraceBlockBytes)
        return badInput(fmt::format("block: {} bytes are too many; expected at most {}", header.bytes,
                                    maxTraceBlockBytes));
    if (header.definitionBytes > header.bytes || flags > 3)
        return badInput("the block's header is inconsistent; expected an undamaged trace");
    return header;
}

Result<void> TraceDecoder::decodeDefinitions(std::span<const std::byte> definitions, const Sink& sink) {
    Cursor in(definitions);
    while (!in.atEnd()) {
        const std::size_t offset = in.offset();
        TraceEvent event;
        const auto type = static_cast<Definition>(in.byte());
        if (type == Definition::Description) {
            event = descriptionFrom(in);
        } else if (type == Definition::Name) {
            const auto index = in.index(in.varint(), maxTraceNames, "there are too many names");
            if (index != names_) in.fail("a name is defined out of order");
            event = TraceNamed{static_cast<TraceNameIndex>(index), in.text(maxTraceNameBytes)};
            if (in.problem() == nullptr) ++names_;
        } else if (type == Definition::Node) {
            const TraceNodeTold told = nodeFrom(in);
            if (told.index > nodes_) in.fail("a node is defined out of order");
            if (in.problem() == nullptr) nodes_ = std::max<std::size_t>(nodes_, std::size_t{told.index} + 1);
            event = told;
        } else {
            in.fail("a definition has an unknown type");
        }
        if (in.problem() != nullptr) return problemAt(in, offset);
        sink(event);
    }
    return {};
}

Result<void> TraceDecoder::decodeEvents(const TraceBlockHeader& header, std::span<const std::byte> events,
                                        const Sink& sink) {
    Cursor in(events);
    EventDecoder decoder(header, in, nodes_, names_);
    if (header.isKey) sink(TraceKey{header.frame, header.ns});
    while (!in.atEnd()) {
        const std::size_t offset = header.definitionBytes + in.offset();
        const std::optional<TraceEvent> event = decoder.next();
        if (in.problem() != nullptr) return problemAt(in, offset);
        if (event) sink(*event);
    }
    return {};
}

Result<void> TraceDecoder::decode(const TraceBlockHeader& header, std::span<const std::byte> bytes,
                                  const Sink& sink) {
    if (bytes.size() != header.bytes || traceChecksum(bytes) != header.checksum)
        return badInput("the checksum of the block does not match; expected an undamaged trace");
    TRY(decodeDefinitions(bytes.first(header.definitionBytes), sink));
    return decodeEvents(header, bytes.subspan(header.definitionBytes), sink);
}

void TraceDecoder::decodePrefix(const TraceBlockHeader& header, std::span<const std::byte> bytes,
                                const Sink& sink) {
    const std::size_t definitions = std::min<std::size_t>(header.definitionBytes, bytes.size());
    if (!decodeDefinitions(bytes.first(definitions), sink) || definitions == bytes.size()) return;
    // The problem that it reports is the missing rest.
    (void)decodeEvents(header, bytes.subspan(definitions), sink);
}

}  // namespace planet
