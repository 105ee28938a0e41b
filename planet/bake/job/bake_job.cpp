#include "planet/bake/job/bake_job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "planet/bake/bake_finish.h"
#include "planet/bake/job/job_plan.h"
#include "planet/bake/job/join.h"
#include "planet/bake/job/spool.h"
#include "planet/bake/job/unit_baking.h"
#include "planet/bake/level_images.h"
#include "planet/base/atomic_file.h"
#include "planet/base/little_endian.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"

namespace planet {

namespace {

std::uint64_t peakMemoryBytes() {
    struct rusage usage {};
    return ::getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::uint64_t>(usage.ru_maxrss) * 1024 : 0;
}

std::vector<std::byte> bytesOf(const SpoolEntry& entry) {
    std::vector<std::byte> bytes;
    putRecord(bytes, entry);
    ByteWriter(bytes).put(entry.file);
    ByteWriter(bytes).put(entry.offset);
    return bytes;
}

SpoolEntry entryFrom(ByteReader& in) {
    SpoolEntry entry = takeRecord(in);
    entry.file = in.get<std::uint32_t>();
    entry.offset = in.get<std::uint64_t>();
    return entry;
}

std::vector<std::byte> bytesOf(const RankReport& report) {
    std::vector<std::byte> bytes;
    ByteWriter to(bytes);
    to.put(std::int32_t{report.threads});
    to.put(report.units);
    to.put(report.samples);
    to.put(report.bakeS);
    to.put(report.joinS);
    to.put(report.waitS);
    to.put(report.spooledBytes);
    to.put(report.writtenBytes);
    to.put(report.peakMemoryBytes);
    const auto name = std::as_bytes(std::span(report.name));
    bytes.insert(bytes.end(), name.begin(), name.end());
    return bytes;
}

RankReport rankReportFrom(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    RankReport report;
    report.threads = in.get<std::int32_t>();
    report.units = in.get<std::uint64_t>();
    report.samples = in.get<std::uint64_t>();
    report.bakeS = in.get<double>();
    report.joinS = in.get<double>();
    report.waitS = in.get<double>();
    report.spooledBytes = in.get<std::uint64_t>();
    report.writtenBytes = in.get<std::uint64_t>();
    report.peakMemoryBytes = in.get<std::uint64_t>();
    const auto name = in.rest();
    report.name.assign(reinterpret_cast<const char*>(name.data()), name.size());
    return report;
}

// Makes the output's temporary file and the folder of finished units; only rank 0 does. Returns the numbers of the folder's
// files.
Result<std::vector<std::uint32_t>> prepare(const JobSettings& settings, const std::filesystem::path& output,
                                           const std::filesystem::path& folder,
                                           std::optional<AtomicFile>& file) {
    TRY_ASSIGN(auto created, AtomicFile::create(output, settings.bake.fileCalls));
    file.emplace(std::move(created));
    TRY(file->append(std::vector<std::byte>(chunkFileHeaderBytes)));
    TRY_ASSIGN(auto numbers, spoolNumbers(folder));
    if (!numbers.empty() && !settings.resume) {
        return badInput(
            fmt::format("{}: holds finished units of a bake of {} that did not end; add --resume to go on "
                        "with them, or remove the folder to bake from the beginning",
                        folder.string(), output.string()));
    }
    std::error_code status;
    std::filesystem::create_directories(folder, status);
    if (status)
        return ioError(
            fmt::format("{}: cannot be made: {}; the finished units of a bake are kept there until its end",
                        folder.string(), status.message()));
    return numbers;
}

// A job while it runs, on one rank.
class Job {
public:
    Job(Team& team, const JobPlan& plan, const JobSettings& settings, const std::filesystem::path& output,
        const JobProgressCallback& progress)
        : team_(team),
          plan_(plan),
          settings_(settings),
          output_(output),
          progress_(progress),
          folder_(spoolFolderOf(linkTarget(output).value_or(output))),
          hash_(hashOf(plan)),
          units_(static_cast<std::size_t>(plan.unitCount())) {}

    Result<JobReport> run() {
        TRY(begin());
        TRY(takeOver());
        TRY(bakeRest());
        const Stopwatch stopwatch;
        const double waitedBefore = team_.waitedS();
        TRY(join());
        own_.joinS = stopwatch.elapsedS();
        own_.waitS += team_.waitedS() - waitedBefore;
        return report();
    }

    // Returns the Error with what has become of the finished units.
    Error explained(const Error& error) const {
        const std::size_t done = static_cast<std::size_t>(std::ranges::count_if(units_, isDone));
        if (!began_ || team_.rank() != 0 || done == 0) return error;
        return {error.kind,
                fmt::format("{}; {} of {} units are finished and kept in {}: the same command with --resume "
                            "goes on with them",
                            error.message, done, units_.size(), folder_.string())};
    }

private:
    static bool isDone(const SpoolEntry& entry) { return entry.frontBytes > 0; }

    Result<void> begin() {
        std::vector<std::byte> told;
        Result<void> outcome;
        if (team_.rank() == 0) {
            const auto numbers = prepare(settings_, output_, folder_, file_);
            if (numbers) {
                for (const std::uint32_t number : *numbers) ByteWriter(told).put(number);
            } else {
                outcome = tl::unexpected(numbers.error());
            }
        }
        TRY(team_.agree(outcome));
        began_ = true;
        const auto all = team_.tellAll(told);
        ByteReader in(all[0]);
        while (!in.rest().empty()) earlier_.push_back(in.get<std::uint32_t>());
        return {};
    }

    // Takes over the finished units of an earlier job. Each rank checks its share of the files.
    Result<void> takeOver() {
        std::vector<std::byte> found;
        const auto check = [&]() -> Result<void> {
            for (std::size_t i = static_cast<std::size_t>(team_.rank()); i < earlier_.size();
                 i += static_cast<std::size_t>(team_.count())) {
                TRY_ASSIGN(const auto file,
                           SpoolReader::open(folder_, earlier_[i], hash_, settings_.bake.fileCalls));
                TRY_ASSIGN(const auto entries, file.entries());
                for (const SpoolEntry& entry : entries) {
                    const std::vector<std::byte> bytes = bytesOf(entry);
                    found.insert(found.end(), bytes.begin(), bytes.end());
                }
            }
            return {};
        };
        TRY(team_.agree(check()));
        resumed_ = addAll(found);
        return {};
    }

    // Tells all ranks of finished units; returns how many are new.
    std::uint64_t addAll(const std::vector<std::byte>& own) {
        std::uint64_t added = 0;
        for (const std::vector<std::byte>& theirs : team_.tellAll(own)) {
            ByteReader in(theirs);
            while (!in.rest().empty()) {
                const SpoolEntry entry = entryFrom(in);
                if (entry.done.unit >= units_.size() || isDone(units_[entry.done.unit])) continue;
                units_[entry.done.unit] = entry;
                ++added;
            }
        }
        return added;
    }

    UnitWork work() const {
        UnitWork work;
        work.unitsTotal = units_.size();
        work.samplesTotal = work.samplesLeft = plan_.samplesTotal();
        for (std::size_t unit = 0; unit < units_.size(); ++unit) {
            if (isDone(units_[unit])) {
                work.samplesLeft -= std::min(work.samplesLeft, units_[unit].done.samples);
            } else if (!work.left.empty() && work.left.back().first + work.left.back().count == unit) {
                ++work.left.back().count;
            } else {
                work.left.push_back({unit, 1});
            }
        }
        return work;
    }

    Result<void> bakeRest() {
        const Stopwatch stopwatch;
        const double waitedBefore = team_.waitedS();
        const std::uint32_t firstNumber = earlier_.empty() ? 0 : earlier_.back() + 1;
        Result<SpoolWriter> spool = SpoolWriter::create(
            folder_, firstNumber + static_cast<std::uint32_t>(team_.rank()), hash_, settings_.bake.fileCalls);
        TRY(team_.agree(spool ? Result<void>() : tl::unexpected(spool.error())));
        const UnitWork toDo = work();
        UnitFeed feed;
        UnitCounts counts;
        std::vector<SpoolEntry> finished;
        const Result<void> outcome = bakeUnits(
            team_, toDo, feed, counts, [&] { return bakeFeed(plan_, feed, *spool, finished, counts); },
            progress_);
        own_.bakeS = stopwatch.elapsedS();
        std::vector<std::byte> own;
        for (const SpoolEntry& entry : finished) {
            const std::vector<std::byte> bytes = bytesOf(entry);
            own.insert(own.end(), bytes.begin(), bytes.end());
        }
        addAll(own);
        TRY(team_.agree(outcome));
        own_.waitS = feed.waitedS() + team_.waitedS() - waitedBefore;
        own_.units = counts.units;
        own_.samples = counts.samples;
        own_.spooledBytes = spool->bytes();
        return {};
    }

    Result<void> join() {
        if (!std::ranges::all_of(units_, isDone)) return badInput("a unit was not baked");
        // All ranks write the temporary file, which rank 0 has made.
        std::vector<std::byte> told;
        if (file_) {
            const std::string name = file_->temporary().string();
            const auto bytes = std::as_bytes(std::span(name));
            told.assign(bytes.begin(), bytes.end());
        }
        const auto all = team_.tellAll(told);
        const std::filesystem::path temporary(
            std::string(reinterpret_cast<const char*>(all[0].data()), all[0].size()));
        Result<OpenFile> opened =
            OpenFile::open(temporary, O_RDWR, settings_.bake.fileCalls, output_.string());
        TRY(team_.agree(opened ? Result<void>() : tl::unexpected(opened.error())));
        SpoolFiles spool(folder_, hash_, settings_.bake.fileCalls);
        Join parts{team_, plan_, spool, units_, *opened, bakeThreads(plan_.settings), [this] {
                       return !progress_ || progress_({});
                   }};
        ChunkFileInfo info;
        info.chunks = plan_.tree.chunks;
        info.coarsestLeafLevel = plan_.tree.coarsestLeafLevel;
        TRY_ASSIGN(const auto heights, joinHeights(parts, chunkFileHeaderBytes));
        std::uint64_t end = heights.end;
        std::vector<std::byte> rootsEnd;
        Result<void> wroteRoots;
        if (file_) {
            file_->growTo(end);
            wroteRoots = writeRoots(plan_.bake, std::span(heights.roots).first<faceCount>(), *file_, info);
            ByteWriter(rootsEnd).put(file_->size());
        }
        TRY(team_.agree(wroteRoots));
        end = readLittleEndian<std::uint64_t>(team_.tellAll(rootsEnd)[0].data());
        if (plan_.colour) {
            TRY_ASSIGN(const auto colours, joinColours(parts, end));
            info.colour = colours.pyramid;
            report_.bake.colourBytes = colours.end - end;
            end = colours.end;
        }
        own_.writtenBytes = parts.bytesWritten;
        TRY(team_.agree(synced(*opened)));
        return team_.agree(finish(heights.roots, info, end));
    }

    Result<void> synced(const OpenFile& file) const {
        if (uninterrupted([&] { return file.calls().fsync(file.descriptor()); }) == 0) return {};
        return ioError(fmt::format("{}: writing failed: {}", output_.string(), lastSystemError()));
    }

    // Checks the file and gives it its name, on rank 0.
    Result<void> finish(const std::vector<DeferredChunk>& roots, ChunkFileInfo& info, std::uint64_t end) {
        if (!file_) return {};
        file_->growTo(end);
        TRY(commitBake(plan_.record, *file_, info));
        removeSpool();
        if (!plan_.settings.debugLevelsFolder.empty())
            TRY(writeLevelImages(output_, plan_.settings.debugLevelsFolder));
        describeBake(plan_.source, plan_.settings, plan_.colour, info, std::span(roots).first<faceCount>(),
                     report_.bake);
        report_.bake.fileBytes = file_->size();
        report_.bake.colourTiles = plan_.colourTree.tileCount();
        return {};
    }

    // Removes what is no longer needed. The output is whole, so a failure does not matter.
    void removeSpool() const {
        std::error_code status;
        const Result<std::vector<std::uint32_t>> numbers = spoolNumbers(folder_);
        for (const std::uint32_t number : numbers.value_or(std::vector<std::uint32_t>()))
            std::filesystem::remove(spoolFile(folder_, number), status);
        std::filesystem::remove(folder_, status);
    }

    Result<JobReport> report() {
        own_.name = team_.name();
        own_.threads = bakeThreads(plan_.settings);
        own_.peakMemoryBytes = peakMemoryBytes();
        const auto all = team_.tellAll(bytesOf(own_));
        if (team_.rank() != 0) return JobReport{};
        for (const std::vector<std::byte>& theirs : all) report_.ranks.push_back(rankReportFrom(theirs));
        report_.units = units_.size();
        report_.resumedUnits = resumed_;
        report_.finished = units_;
        return std::move(report_);
    }

    Team& team_;
    const JobPlan& plan_;
    const JobSettings& settings_;
    const std::filesystem::path& output_;
    const JobProgressCallback& progress_;
    std::filesystem::path folder_;
    std::uint64_t hash_;
    std::vector<SpoolEntry> units_;       // by unit
    std::vector<std::uint32_t> earlier_;  // files of an earlier job
    std::optional<AtomicFile> file_;      // on rank 0
    std::uint64_t resumed_ = 0;
    bool began_ = false;
    RankReport own_;
    JobReport report_;
};

}  // namespace

Result<JobReport> bakeJob(Ranks& ranks, const HeightSource& source, const JobSettings& settings,
                          const std::filesystem::path& output, const JobProgressCallback& progress,
                          const ColourSource* colour) {
    const Stopwatch stopwatch;
    Team team(ranks);
    const Result<JobPlan> plan = planJob(source, colour, settings.bake);
    const double planS = stopwatch.elapsedS();
    TRY(checkSamePlan(team, plan, settings.program));
    Job job(team, *plan, settings, output, progress);
    Result<JobReport> report = job.run();
    if (!report) return tl::unexpected(job.explained(report.error()));
    report->planS = planS;
    report->bake.seconds = stopwatch.elapsedS();
    report->bake.sampledCells = plan->tree.leafCells;
    return report;
}

}  // namespace planet
