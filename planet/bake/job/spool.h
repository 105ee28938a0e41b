// The finished units of a job, in files of a folder beside its output. They survive the job, so that a later one can go on
// with them, and they hold what is put together into the output at the end.
//
// A file begins with 32 bytes: "WORLDYSP", u32 version, u32 0, u64 the job, u64 XXH3 of all before. Records follow, each
// with 64 bytes: u64 the unit, u64 its samples, f64 the seconds that it took, u64 and u64 the lengths of its two parts, u64
// and u64 their XXH3, u64 XXH3 of the 56 bytes before; then the two parts. All numbers are little-endian. The first part is
// small: the chunks above a unit need it. The second goes into the output. A job that was killed may leave a record without
// its end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/little_endian.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"

namespace planet {

// Returns the folder of an output: "earth.chk.spool" beside "earth.chk".
std::filesystem::path spoolFolderOf(const std::filesystem::path& output);

// Returns the path of a file in it.
std::filesystem::path spoolFile(const std::filesystem::path& folder, std::uint32_t number);
// Returns the numbers of all files in it, ascending; none if there is no such folder. Other names are ignored.
Result<std::vector<std::uint32_t>> spoolNumbers(const std::filesystem::path& folder);

struct FinishedUnit {
    std::uint64_t unit = 0;
    std::uint64_t samples = 0;
    double seconds = 0;  // of one thread
};

// The place of a finished unit, and its checksums.
struct SpoolEntry {
    FinishedUnit done;
    std::uint32_t file = 0;
    std::uint64_t offset = 0;  // of the first part
    std::uint64_t frontBytes = 0;
    std::uint64_t bodyBytes = 0;
    std::uint64_t frontSum = 0;  // XXH3
    std::uint64_t bodySum = 0;
};

// Write and read the numbers of an entry that a record holds: all but where it is.
void putRecord(std::vector<std::byte>& out, const SpoolEntry& entry);
SpoolEntry takeRecord(ByteReader& in);

class SpoolWriter {
public:
    // job: a hash of everything that the units depend on. Replaces an older file. The Errors name the file.
    static Result<SpoolWriter> create(const std::filesystem::path& folder, std::uint32_t number,
                                      std::uint64_t job, const FileCalls& calls);

    Result<SpoolEntry> append(const FinishedUnit& done, std::span<const std::byte> front,
                              std::span<const std::byte> body);
    std::uint64_t bytes() const { return size_; }  // of the file

private:
    SpoolWriter(OpenFile file, std::uint32_t number) : file_(std::move(file)), number_(number) {}

    OpenFile file_;
    std::uint32_t number_;
    std::uint64_t size_ = 0;
};

class SpoolReader {
public:
    // The Errors name the file.
    static Result<SpoolReader> open(const std::filesystem::path& folder, std::uint32_t number,
                                    std::uint64_t job, const FileCalls& calls);

    // Reads the whole file and returns the units whose checksums are right, up to the first record that is not whole.
    Result<std::vector<SpoolEntry>> entries() const;
    // Returns the first part. The Error says that its checksum is wrong.
    Result<std::vector<std::byte>> front(const SpoolEntry& entry) const;
    Result<std::vector<std::byte>> body(const SpoolEntry& entry) const;

private:
    SpoolReader(OpenFile file, std::uint32_t number) : file_(std::move(file)), number_(number) {}
    Result<std::vector<std::byte>> part(std::uint64_t offset, std::uint64_t bytes, std::uint64_t sum) const;

    OpenFile file_;
    std::uint32_t number_;
};

}  // namespace planet
