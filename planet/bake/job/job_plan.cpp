#include "planet/bake/job/job_plan.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>

#include "planet/bake/bake_finish.h"
#include "planet/bake/bake_reuse.h"
#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/source/source_parts.h"

namespace planet {

namespace {

std::uint64_t hashOfSource(const JobPlan& plan) {
    const HeightSource& source = plan.source;
    Fingerprint print;
    print.add(source.description).add(source.minM).add(source.maxM).add(source.missingCount);
    print.add(std::uint64_t{plan.tree.chunks}).add(plan.tree.leafCells);
    if (!plan.record) return print.hash();
    for (const SourcePart& part : plan.record->parts) {
        print.add(part.signature).add(part.centre.x).add(part.centre.y).add(part.centre.z);
        print.add(part.radiusRad);
    }
    return print.add(plan.record->colours).hash();
}

std::uint64_t hashOfSettings(const JobPlan& plan) {
    const PlanetShape& shape = plan.bake.shape;
    Fingerprint print;
    print.add(shape.radiusM).add(shape.quantumM).add(shape.baseHeightM);
    print.add(std::int32_t{shape.faceCellsLog2}).add(std::int32_t{shape.chunkCellsLog2});
    print.add(std::int32_t{shape.fractionBits}).add(std::int32_t{plan.bake.compressionLevel});
    print.add(std::int32_t{plan.tileLevels}).add(std::int32_t{plan.unitLevels});
    if (plan.record) print.add(plan.record->settings);
    if (!plan.colour) return print.hash();
    print.add(plan.colour->description).add(static_cast<std::uint8_t>(plan.settings.colour.format));
    return print.add(std::uint64_t{plan.colourTree.levels.size()}).add(plan.colourTree.tileCount()).hash();
}

// The identity of a rank: two hashes, and the program.
struct Identity {
    std::uint64_t source = 0;
    std::uint64_t settings = 0;
    std::string program;
};

std::vector<std::byte> bytesOf(const Identity& identity) {
    std::vector<std::byte> bytes;
    ByteWriter(bytes).put(identity.source);
    ByteWriter(bytes).put(identity.settings);
    const auto text = std::as_bytes(std::span(identity.program));
    bytes.insert(bytes.end(), text.begin(), text.end());
    return bytes;
}

Identity identityFrom(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Identity identity;
    identity.source = in.get<std::uint64_t>();
    identity.settings = in.get<std::uint64_t>();
    const auto text = in.rest();
    identity.program.assign(reinterpret_cast<const char*>(text.data()), text.size());
    return identity;
}

Result<void> compared(const JobPlan& plan, const Identity& own, const Identity& first) {
    if (own.program != first.program)
        return badInput(fmt::format("runs {}, and rank 0 runs {}; expected the same program on all ranks",
                                    own.program, first.program));
    if (own.source != first.source)
        return badInput(
            fmt::format("{}: differs from the source of rank 0 in its name, its files or their content; "
                        "expected the same source on all ranks",
                        plan.source.description));
    if (own.settings != first.settings)
        return badInput("bakes with other settings than rank 0; expected the same command on all ranks");
    return {};
}

}  // namespace

std::uint64_t JobPlan::samplesTotal() const {
    return tree.leafCells + colourTree.tileCount() * samplesPerColourTile;
}

Result<JobPlan> planJob(const HeightSource& source, const ColourSource* colour,
                        const BakeSettings& settings) {
    TRY(checkBakeSettings(settings));
    if (!settings.reuse.empty())
        return badInput(
            "--reuse: a job of several ranks copies nothing from an earlier bake; bake with --reuse on one "
            "machine, or without it");
    TRY_ASSIGN(const auto shape, chooseShape(source, settings));
    JobPlan plan{source, colour, settings, {source, shape, settings.compressionLevel}, {}, {}, 0, 0,
                 {},     {},     {}};
    plan.record = recordOf(source, settings, shape, colour);
    plan.tree = countTree(source, shape).value();
    plan.tileLevels = deepestLevelOf(shape) - tileLevelOf(shape, settings.tileLevels);
    plan.unitLevels = jobUnitLevels(shape, plan.tree.leafCells, plan.tileLevels);
    plan.heightUnits = jobUnits(source, shape, plan.tileLevels, plan.unitLevels);
    if (colour) {
        TRY_ASSIGN(plan.colourTree, colourTreeOf(*colour, settings.colour));
        plan.colourUnits = colourUnits(plan.colourTree);
    }
    return plan;
}

std::uint64_t hashOf(const JobPlan& plan) {
    return Fingerprint().add(hashOfSource(plan)).add(hashOfSettings(plan)).hash();
}

Result<void> checkSamePlan(Team& team, const Result<JobPlan>& plan, const std::string& program) {
    TRY(team.agree(plan ? Result<void>() : tl::unexpected(plan.error())));
    const Identity own{hashOfSource(*plan), hashOfSettings(*plan), program};
    const auto all = team.tellAll(bytesOf(own));
    return team.agree(compared(*plan, own, identityFrom(all[0])));
}

}  // namespace planet
