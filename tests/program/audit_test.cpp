#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_format.h"
#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json reportIn(const TemporaryFolder& folder) {
    return json::parse(contentOf(folder.path() / "report.json"));
}

TEST(Audit, OfACleanPlanetFindsNoViolationAndEndsWell) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran = runWorldy(folder, "audit planet.chk -o report.json --worst 3");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors << ran.output;
    EXPECT_THAT(ran.output, HasSubstr("violations"));
    EXPECT_THAT(ran.output, HasSubstr("chunks by error"));
    const json report = reportIn(folder);
    EXPECT_EQ(report["schema_version"], 2);
    EXPECT_EQ(report["violations"], 0);
    ASSERT_EQ(report["view"].size(), 9u);
    EXPECT_GT(report["worst_measured_px"], 0.2);
    EXPECT_LT(report["worst_measured_px"], report["worst_drawn_bound_px"]);
    EXPECT_GT(report["mean_slack"], 0);
    std::uint64_t samples = 0;
    for (const json& view : report["view"]) {
        EXPECT_EQ(view["chunk"].size(), view["drawn_chunks"]);
        EXPECT_EQ(view["triangles"],
                  view["ground_triangles"].get<int>() + view["skirt_triangles"].get<int>());
        samples += view["samples"].get<std::uint64_t>();
    }
    EXPECT_EQ(report["samples"], samples);
}

TEST(Audit, MeasuresTheViewsThatItIsTold) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const std::string told = "audit planet.chk -o report.json --tau 4 --size 640x480 ";
    ASSERT_EQ(runWorldy(folder, told + "--camera 10,20,30000,0,-40 --camera 5,6,7000").exitCode, 0);
    json report = reportIn(folder);
    ASSERT_EQ(report["view"].size(), 2u);
    EXPECT_NEAR(report["view"][0]["camera"]["longitude_deg"], 20, 1e-9);
    EXPECT_NEAR(report["view"][1]["camera"]["altitude_m"], 7000, 1e-3);
    EXPECT_EQ(report["tau_px"], 4);
    EXPECT_EQ(report["width_px"], 640);

    std::ofstream(folder.path() / "flight.toml")
        << "name = \"There\"\n[[key]]\ntime_s = 3\nlatitude_deg = 0\nlongitude_deg = 0\naltitude_m = "
           "9000\nheading_deg = 0\npitch_deg = -30\n"
           "[[key]]\ntime_s = 8\nlatitude_deg = 10\nlongitude_deg = 30\naltitude_m = 8000\nheading_deg = "
           "0\npitch_deg = -30\n";
    const Ran flown = runWorldy(folder, told + "--flight flight.toml --step-s 2.5");
    ASSERT_EQ(flown.exitCode, 0) << flown.errors;
    report = reportIn(folder);
    ASSERT_EQ(report["view"].size(), 3u);
    EXPECT_NEAR(report["view"][2]["camera"]["longitude_deg"], 30, 1e-6);
}

// Hysteresis keeps chunks split, a small budget keeps blocks resident, and a camera below the ground is
// lifted above the finest ground that is resident: none of these may carry over.
TEST(Audit, AViewDoesNotDependOnTheViewsBeforeIt) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const std::string audit =
        "audit planet.chk -o report.json --tau 2 --size 640x480 --set lod.hysteresis=0.5";
    const std::array<std::string, 3> cameras = {" --camera 20,120,4000,0,-90", " --camera 20,120,60000,0,-90",
                                                " --camera 20,120,-3000,0,-10"};
    json alone = json::array();
    std::string all;
    for (const std::string& camera : cameras) {
        ASSERT_EQ(runWorldy(folder, audit + camera).exitCode, 0);
        alone.push_back(reportIn(folder)["view"][0]);
        all += camera;
    }
    ASSERT_EQ(runWorldy(folder, audit + all).exitCode, 0);
    EXPECT_EQ(reportIn(folder)["view"], alone);
    ASSERT_EQ(runWorldy(folder, audit + cameras[2] + cameras[0] + cameras[1]).exitCode, 0);
    EXPECT_EQ(reportIn(folder)["view"][2], alone[1]);
}

std::string bytesAt(std::fstream& file, planet::BlockLocation location) {
    std::string bytes(location.size, 0);
    file.seekg(static_cast<std::streamoff>(location.offset));
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return bytes;
}

// Says of four chunks that they are a hundred times as exact as they are, checksum and all.
void belittleErrors(std::fstream& file, const planet::ChunkId& parent, planet::BlockLocation location) {
    const std::string old = bytesAt(file, location);
    const std::span oldBytes(reinterpret_cast<const std::byte*>(old.data()), old.size());
    std::vector<std::byte> block;
    auto index = planet::indexFrom(oldBytes, planet::quadrantCount, true, location.offset).value();
    for (planet::ChunkEntry& entry : index.entries) {
        entry.deltaCM /= 100;
        entry.deltaTightM /= 100;
    }
    planet::putIndex(block, index.entries, location.offset);
    const auto rest = oldBytes.subspan(block.size(), old.size() - block.size() - planet::checksumBytes);
    block.insert(block.end(), rest.begin(), rest.end());
    const std::uint64_t sum = planet::siblingChecksum(block, parent);
    for (int i = 0; i < 8; ++i) block.push_back(static_cast<std::byte>(sum >> (8 * i)));
    file.seekp(static_cast<std::streamoff>(location.offset));
    file.write(reinterpret_cast<const char*>(block.data()), static_cast<std::streamsize>(block.size()));
}

TEST(Audit, FindsErrorsThatAFileBelittlesAndEndsWithOne) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const std::filesystem::path path = folder.path() / "planet.chk";
    const planet::ChunkFile chunks = planet::ChunkFile::open(path).value();
    ASSERT_EQ(planet::deepestLevelOf(chunks.info().shape), 3);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const planet::ChunkData root = chunks.readRoot(planet::Face::PosY).value();
    const auto level1 = chunks.readChildren(root.id, root.children, root.heights).value();
    for (const planet::ChunkData& chunk : level1) belittleErrors(file, chunk.id, chunk.children);
    file.close();

    const Ran ran = runWorldy(
        folder, "audit planet.chk -o report.json --camera 20,120,20000,0,-20 --set lod.morph=false");
    EXPECT_EQ(ran.exitCode, 1) << ran.errors << ran.output;
    EXPECT_THAT(ran.output, HasSubstr("VIOLATION"));
    const json report = reportIn(folder);
    EXPECT_GT(report["violations"], 0);
    for (const json& chunk : report["view"][0]["chunk"]) {
        if (chunk["violation"]) {
            EXPECT_THAT(chunk["chunk"].get<std::string>(), testing::StartsWith("y_pos/2/"));
        }
    }
}

}  // namespace
}  // namespace worldy
