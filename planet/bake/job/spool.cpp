#include "planet/bake/job/spool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"

namespace planet {

namespace {

constexpr std::string_view spoolMagic = "WORLDYSP";
constexpr std::uint32_t spoolVersion = 1;
constexpr std::uint64_t spoolHeaderBytes = 32;
constexpr std::uint64_t spoolRecordBytes = 64;
constexpr std::string_view spoolExtension = ".spool";

std::uint64_t sumOf(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

void putSum(std::vector<std::byte>& bytes) {
    ByteWriter(bytes).put(sumOf(bytes));
}

// Returns whether bytes end in their checksum.
bool endsInSum(std::span<const std::byte> bytes) {
    const auto content = bytes.first(bytes.size() - sizeof(std::uint64_t));
    return readLittleEndian<std::uint64_t>(bytes.data() + content.size()) == sumOf(content);
}

std::optional<std::uint32_t> numberOf(const std::filesystem::path& file) {
    const std::string name = file.stem().string();
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (file.extension() != spoolExtension || error != std::errc() || end != name.data() + name.size())
        return std::nullopt;
    return number;
}

}  // namespace

std::filesystem::path spoolFolderOf(const std::filesystem::path& output) {
    std::filesystem::path folder = output;
    folder += spoolExtension;
    return folder;
}

std::filesystem::path spoolFile(const std::filesystem::path& folder, std::uint32_t number) {
    return folder / fmt::format("{:04}{}", number, spoolExtension);
}

Result<std::vector<std::uint32_t>> spoolNumbers(const std::filesystem::path& folder) {
    std::vector<std::uint32_t> numbers;
    std::error_code status;
    if (!std::filesystem::exists(folder, status)) return numbers;
    for (std::filesystem::directory_iterator at(folder, status), end; !status && at != end;
         at.increment(status)) {
        if (const std::optional<std::uint32_t> number = numberOf(at->path())) numbers.push_back(*number);
    }
    if (status)
        return ioError(
            fmt::format("{}: cannot be read: {}; expected the folder of the finished units of a bake",
                        folder.string(), status.message()));
    std::ranges::sort(numbers);
    return numbers;
}

void putRecord(std::vector<std::byte>& out, const SpoolEntry& entry) {
    ByteWriter to(out);
    to.put(entry.done.unit);
    to.put(entry.done.samples);
    to.put(entry.done.seconds);
    to.put(entry.frontBytes);
    to.put(entry.bodyBytes);
    to.put(entry.frontSum);
    to.put(entry.bodySum);
}

SpoolEntry takeRecord(ByteReader& in) {
    SpoolEntry entry;
    entry.done.unit = in.get<std::uint64_t>();
    entry.done.samples = in.get<std::uint64_t>();
    entry.done.seconds = in.get<double>();
    entry.frontBytes = in.get<std::uint64_t>();
    entry.bodyBytes = in.get<std::uint64_t>();
    entry.frontSum = in.get<std::uint64_t>();
    entry.bodySum = in.get<std::uint64_t>();
    return entry;
}

Result<SpoolWriter> SpoolWriter::create(const std::filesystem::path& folder, std::uint32_t number,
                                        std::uint64_t job, const FileCalls& calls) {
    TRY_ASSIGN(auto file, OpenFile::open(spoolFile(folder, number), O_RDWR | O_CREAT | O_TRUNC, calls));
    SpoolWriter writer(std::move(file), number);
    std::vector<std::byte> header;
    const auto name = std::as_bytes(std::span(spoolMagic));
    header.assign(name.begin(), name.end());
    ByteWriter out(header);
    out.put(spoolVersion);
    out.put(std::uint32_t{0});
    out.put(job);
    putSum(header);
    TRY(writer.file_.write(0, header));
    writer.size_ = header.size();
    return writer;
}

Result<SpoolEntry> SpoolWriter::append(const FinishedUnit& done, std::span<const std::byte> front,
                                       std::span<const std::byte> body) {
    const SpoolEntry entry{done,         number_,    size_ + spoolRecordBytes, front.size(), body.size(),
                           sumOf(front), sumOf(body)};
    std::vector<std::byte> record;
    record.reserve(spoolRecordBytes + front.size());
    putRecord(record, entry);
    putSum(record);
    record.insert(record.end(), front.begin(), front.end());
    TRY(file_.write(size_, record));
    TRY(file_.write(size_ + record.size(), body));
    size_ += record.size() + body.size();
    return entry;
}

Result<SpoolReader> SpoolReader::open(const std::filesystem::path& folder, std::uint32_t number,
                                      std::uint64_t job, const FileCalls& calls) {
    TRY_ASSIGN(auto file, OpenFile::open(spoolFile(folder, number), O_RDONLY, calls));
    SpoolReader reader(std::move(file), number);
    TRY_ASSIGN(const auto size, reader.file_.size());
    // A job that was killed while it made the file has left nothing in it.
    if (size < spoolHeaderBytes) return reader;
    std::vector<std::byte> header(spoolHeaderBytes);
    TRY(reader.file_.read(0, header));
    ByteReader in(header);
    const bool isSpool =
        std::ranges::equal(in.take(spoolMagic.size()), std::as_bytes(std::span(spoolMagic))) &&
        in.get<std::uint32_t>() == spoolVersion && endsInSum(header);
    if (!isSpool)
        return badInput(
            fmt::format("{}: is no file of finished units that this version can read; remove its folder "
                        "to bake from the beginning",
                        reader.file_.name()));
    in.get<std::uint32_t>();
    if (in.get<std::uint64_t>() != job)
        return badInput(
            fmt::format("{}: belongs to a bake of another source, with other settings or by another "
                        "version; expected the same command as before; remove its folder to bake from "
                        "the beginning",
                        reader.file_.name()));
    return reader;
}

Result<std::vector<SpoolEntry>> SpoolReader::entries() const {
    TRY_ASSIGN(const auto size, file_.size());
    std::vector<SpoolEntry> entries;
    std::uint64_t at = spoolHeaderBytes;
    std::vector<std::byte> record(spoolRecordBytes);
    while (at < size && size - at >= spoolRecordBytes) {
        TRY(file_.read(at, record));
        if (!endsInSum(record)) break;
        ByteReader in(record);
        SpoolEntry entry = takeRecord(in);
        entry.file = number_;
        entry.offset = at + spoolRecordBytes;
        const std::uint64_t left = size - entry.offset;
        if (entry.frontBytes > left || entry.bodyBytes > left - entry.frontBytes) break;
        // A part that is damaged on the disk is baked again.
        const auto isWhole = [](const Result<std::vector<std::byte>>& part) {
            return part || part.error().kind == ErrorKind::BadInput;
        };
        const auto readFront = front(entry);
        const auto readBody = body(entry);
        if (!isWhole(readFront)) return tl::unexpected(readFront.error());
        if (!isWhole(readBody)) return tl::unexpected(readBody.error());
        if (readFront && readBody) entries.push_back(entry);
        at = entry.offset + entry.frontBytes + entry.bodyBytes;
    }
    return entries;
}

Result<std::vector<std::byte>> SpoolReader::part(std::uint64_t offset, std::uint64_t bytes,
                                                 std::uint64_t sum) const {
    std::vector<std::byte> content(static_cast<std::size_t>(bytes));
    TRY(file_.read(offset, content));
    if (sumOf(content) != sum)
        return badInput(fmt::format("{}: a finished unit at byte {} is damaged; bake again with --resume",
                                    file_.name(), offset));
    return content;
}

Result<std::vector<std::byte>> SpoolReader::front(const SpoolEntry& entry) const {
    return part(entry.offset, entry.frontBytes, entry.frontSum);
}

Result<std::vector<std::byte>> SpoolReader::body(const SpoolEntry& entry) const {
    return part(entry.offset + entry.frontBytes, entry.bodyBytes, entry.bodySum);
}

}  // namespace planet
