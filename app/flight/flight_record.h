// A recorded flight: all inputs of a planet, its selections, and the actions of its loaders, frame by frame.
// It is stored in a .flight file, from which a replay reproduces the same frames.
//
//   8 bytes   "WYFLIGHT"
//   4         version, 1
//   8         bytes of the content
//   8         XXH3 of the content
//   rest      the content, compressed by zstd
//
// The content is binary and little-endian, and stores only the changes from frame to frame: a camera at rest
// takes about ten bytes per frame before compression. The file is untrusted until checked. One thread.
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
// A recording ends when it reaches one of these limits. A file that exceeds one is refused.
inline constexpr std::size_t maxFlightFrames = 216'000;   // an hour at 60 frames per second
inline constexpr std::size_t maxFlightBytes = 64u << 20;  // size of the content
inline constexpr double maxFlightS = 1e6;
inline constexpr std::size_t maxCallsAFrame = 1000;
inline constexpr std::size_t maxFlightCalls =
    2 * maxFlightFrames;  // calls of all frames plus their settings and announced views
inline constexpr std::size_t maxFlightChunks = 1u << 20;  // chunks drawn at once in a view

// Identifies the chunk file of a flight. Copies of a file have the same identity.
struct FlightData {
    std::string chunkFile;  // path when recorded
    planet::PlanetShape shape;
    std::uint64_t fileBytes = 0;   // without the record of the source
    std::uint64_t headerHash = 0;  // XXH3
};
FlightData flightDataOf(const planet::ChunkFile& file);
// Different files are an Error that names the difference.
planet::Result<void> checkSameData(const std::filesystem::path& flight, const FlightData& recorded,
                                   const FlightData& present);

// A call to the planet between two steps.
enum class FlightCall : std::uint8_t { DropAll, LoadOne, RetryFailed, Settings, RetryBlock, Announce };

struct CalledInFlight {
    FlightCall call = FlightCall::DropAll;
    planet::BlockId block{};  // for RetryBlock
    // For Settings: the changed settings, "lod.tau_px=3", or all of them in the first frame.
    std::vector<std::string> settings{};
    bool pagingPaused = false;  // for Settings
    // For Announce: the path of the first view, at most planet::maxAnnounced points.
    std::vector<planet::AnnouncedView> announced{};
    planet::PagingMoves moves{};
};

struct FlownView {
    planet::View view;
    double priorityFactor = 1;
    std::vector<planet::ChunkId> appeared;  // drawn now but not in the frame before; ascending
    std::vector<planet::ChunkId> vanished;
};

struct FlightFrame {
    std::vector<CalledInFlight> calls;  // in order, before the step
    double elapsedS = 0;                // since the frame before
    std::vector<FlownView> views;       // 1 to maxViews
    planet::PagingMoves moves;          // moves of the step
    std::uint64_t selectionHash = 0;    // selectionHashOf the planet after the step
};

struct FlightRecord {
    std::string name;
    FlightData data;
    std::vector<FlightFrame> frames;
};

// Return the view settings as assignments: all of them, or those that differ in `now`. The settings of camera
// movement are omitted, because the recording contains the movement.
std::vector<std::string> flightSettings(const ViewSettings& now);
std::vector<std::string> flightSettings(const ViewSettings& before, const ViewSettings& now);
// An invalid assignment is an Error that names it.
planet::Result<void> applyFlightSettings(const std::vector<std::string>& assignments, ViewSettings& settings);

// The handling of a file that already exists.
enum class IfThere : std::uint8_t { Replace, Fail };

// Encodes frames as they come, so memory use is limited to the size of the content.
class FlightEncoder {
public:
    void add(const FlightFrame& frame);
    // Returns true if the frame keeps the recording within the limits of a file.
    bool fits(const FlightFrame& frame) const;
    void end() { ended_ = true; }

    std::size_t frames() const { return frames_; }
    std::size_t bytes() const { return bytes_.size(); }  // before compression
    double seconds() const { return seconds_; }
    bool full() const { return ended_ || frames_ >= maxFlightFrames || bytes_.size() >= maxFlightBytes; }

    // Writes the file atomically.
    planet::Result<void> write(const std::filesystem::path& file, const std::string& name,
                               const FlightData& data, IfThere ifThere = IfThere::Replace) const;

private:
    std::vector<std::byte> bytes_;
    std::size_t frames_ = 0;
    std::size_t calls_ = 0;  // calls plus their settings and announced views
    double seconds_ = 0;
    bool ended_ = false;
    std::vector<FlownView> views_;  // views of the frame before
    std::uint64_t hash_ = 0;
};

planet::Result<FlightRecord> loadFlightRecord(const std::filesystem::path& file);
// Reads the bytes of a file. place stands for the file name in errors.
planet::Result<FlightRecord> flightRecordFromBytes(std::span<const std::byte> bytes,
                                                   const std::filesystem::path& place);
// Returns the bytes of a file: the header and the compressed content. A failed compression is an Error.
planet::Result<std::vector<std::byte>> flightFileBytes(std::span<const std::byte> content,
                                                       int compressionLevel);

// Returns true if the file is named *.flight.
bool isFlightRecord(const std::filesystem::path& file);

}  // namespace worldy
