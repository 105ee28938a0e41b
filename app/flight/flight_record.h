// A recorded flight: all that a planet was given, frame by frame, what it chose, and what its loaders did.
// Kept in a .flight file, of which a replay makes the same frames again.
//
//   8 bytes   "WYFLIGHT"
//   4         version, 1
//   8         bytes of the content
//   8         XXH3 of the content
//   rest      the content, compressed by zstd
//
// The content is binary, little-endian, and says of each frame only what is not as in the frame before: a
// camera at rest costs about ten bytes a frame before compression. The file is hostile until checked.
// Pure but for reading and writing; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/planet.h"

namespace worldy {

// The file extension of recorded flights.
inline constexpr const char* recordedFlightEnding = ".flight";

inline constexpr std::uint32_t flightRecordVersion = 1;
// A recording ends by itself at either.
inline constexpr std::size_t maxFlightFrames = 216'000;   // an hour at 60 a second
inline constexpr std::size_t maxFlightBytes = 64u << 20;  // of the content
// And at these, of which a file that holds more is refused.
inline constexpr double maxFlightS = 1e6;
inline constexpr std::size_t maxCallsAFrame = 1000;
inline constexpr std::size_t maxFlightCalls = 2 * maxFlightFrames;  // of all frames, and their settings
inline constexpr std::size_t maxFlightChunks = 1u << 20;            // drawn at once in a view

// Which chunk file was flown over; equal for copies of the same file.
struct FlightData {
    std::string chunkFile;  // where it lay
    planet::PlanetShape shape;
    std::uint64_t fileBytes = 0;
    std::uint64_t headerHash = 0;  // XXH3
};
FlightData flightDataOf(const planet::ChunkFile& file);
// The Error says what is different.
planet::Result<void> checkSameData(const std::filesystem::path& flight, const FlightData& recorded,
                                   const FlightData& present);

// What was asked of the planet between two steps.
enum class FlightCall : std::uint8_t { DropAll, LoadOne, RetryFailed, Settings, RetryBlock };

struct CalledInFlight {
    FlightCall call = FlightCall::DropAll;
    planet::BlockId block{};  // of RetryBlock
    // Of Settings: "lod.tau_px=3", those that changed, all at the beginning; and whether paging is paused.
    std::vector<std::string> settings{};
    bool pagingPaused = false;
    planet::PagingMoves moves{};
};

struct FlownView {
    planet::View view;
    double priorityFactor = 1;
    std::vector<planet::ChunkId> appeared;  // drawn, and not in the frame before; ascending
    std::vector<planet::ChunkId> vanished;
};

struct FlightFrame {
    std::vector<CalledInFlight> calls;  // in their order, before the step
    double elapsedS = 0;                // since the frame before
    std::vector<FlownView> views;       // 1 to maxViews
    planet::PagingMoves moves;          // of the step
    std::uint64_t selectionHash = 0;    // of all views' chunks, their order, levels and morphs
};

struct FlightRecord {
    std::string name;
    FlightData data;
    std::vector<FlightFrame> frames;
};

// Settings of the view as assignments: all of them, or those in which `now` differs. Left out is how the
// camera moves, which the recording itself says.
std::vector<std::string> flightSettings(const ViewSettings& now);
std::vector<std::string> flightSettings(const ViewSettings& before, const ViewSettings& now);
// The Error names the assignment.
planet::Result<void> applyFlightSettings(const std::vector<std::string>& assignments, ViewSettings& settings);

// What becomes of a file that is there already.
enum class IfThere : std::uint8_t { Replace, Fail };

// Encodes frames as they come, so that memory holds no more than the file will.
class FlightEncoder {
public:
    void add(const FlightFrame& frame);
    // Whether a file may hold it after those before.
    bool fits(const FlightFrame& frame) const;
    void end() { ended_ = true; }

    std::size_t frames() const { return frames_; }
    std::size_t bytes() const { return bytes_.size(); }  // before compression
    double seconds() const { return seconds_; }
    bool full() const { return ended_ || frames_ >= maxFlightFrames || bytes_.size() >= maxFlightBytes; }

    // The whole file appears at once, or not at all.
    planet::Result<void> write(const std::filesystem::path& file, const std::string& name,
                               const FlightData& data, IfThere ifThere = IfThere::Replace) const;

private:
    std::vector<std::byte> bytes_;
    std::size_t frames_ = 0;
    std::size_t calls_ = 0;  // and their settings
    double seconds_ = 0;
    bool ended_ = false;
    std::vector<FlownView> views_;  // of the frame before
    std::uint64_t hash_ = 0;
};

planet::Result<FlightRecord> loadFlightRecord(const std::filesystem::path& file);
// The same of a file's bytes; place stands for its name in errors.
planet::Result<FlightRecord> flightRecordFromBytes(std::span<const std::byte> bytes,
                                                   const std::filesystem::path& place);
// What a file begins with and how it holds its content. The Error is of the compression.
planet::Result<std::vector<std::byte>> flightFileBytes(std::span<const std::byte> content,
                                                       int compressionLevel);

// Returns true if the file is named *.flight.
bool isFlightRecord(const std::filesystem::path& file);

}  // namespace worldy
