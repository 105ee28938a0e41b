#include "planet/format/source_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "planet/base/little_endian.h"
#include "planet/format/chunk_file_format.h"

namespace planet {
namespace {

using testing::HasSubstr;

SourceRecord someRecord() {
    return {
        7, -100, 200.5, {{11, {0, 0.6, 0.8}, 0.25, {100, 50}}, {12, {1, 0, 0}, std::numbers::pi, {}}}, 13};
}

std::vector<std::byte> resealed(std::vector<std::byte> bytes) {
    const std::uint64_t sum = sourceRecordChecksum(std::span(bytes).first(bytes.size() - 8));
    bytes.resize(bytes.size() - 8);
    ByteWriter(bytes).put(sum);
    return bytes;
}

std::string errorOf(const std::vector<std::byte>& bytes) {
    const auto record = sourceRecordFrom(bytes);
    return record ? "" : record.error().message;
}

TEST(SourceRecord, isReadAsItWasWritten) {
    EXPECT_EQ(sourceRecordFrom(sourceRecordBytes(someRecord())).value(), someRecord());
    EXPECT_EQ(sourceRecordFrom(sourceRecordBytes({})).value(), SourceRecord{});
}

TEST(SourceRecord, everyChangedBitIsNoticed) {
    const std::vector<std::byte> good = sourceRecordBytes(someRecord());
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
        std::vector<std::byte> bytes = good;
        bytes[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
        EXPECT_NE(errorOf(bytes), "") << bit;
    }
}

TEST(SourceRecord, aTruncatedRecordIsRefused) {
    const std::vector<std::byte> good = sourceRecordBytes(someRecord());
    for (std::size_t size = 0; size < good.size(); ++size) {
        EXPECT_NE(errorOf({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}), "");
        EXPECT_NE(errorOf({good.end() - static_cast<std::ptrdiff_t>(size), good.end()}), "");
    }
}

TEST(SourceRecord, valuesOutOfRangeAreRefusedWhateverTheChecksum) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto errorWith = [](auto change) {
        SourceRecord record = someRecord();
        change(record);
        return errorOf(sourceRecordBytes(record));
    };
    EXPECT_THAT(errorWith([](SourceRecord& r) { r.minM = nan; }), HasSubstr("inconsistent"));
    EXPECT_THAT(errorWith([](SourceRecord& r) { r.maxM = std::numeric_limits<double>::infinity(); }),
                HasSubstr("inconsistent"));
    const auto part = [&](auto change) { return errorWith([&](SourceRecord& r) { change(r.parts[0]); }); };
    EXPECT_THAT(part([](SourcePart& p) { p.centre.x = 2; }), HasSubstr("not on the planet"));
    EXPECT_THAT(part([](SourcePart& p) { p.centre.y = nan; }), HasSubstr("not on the planet"));
    EXPECT_THAT(part([](SourcePart& p) { p.radiusRad = -1; }), HasSubstr("not on the planet"));
    EXPECT_THAT(part([](SourcePart& p) { p.radiusRad = 4; }), HasSubstr("not on the planet"));
    EXPECT_THAT(part([](SourcePart& p) { p.densities.alongPerRad = nan; }), HasSubstr("not on the planet"));
    EXPECT_THAT(part([](SourcePart& p) { p.densities.aroundPerRad = -1; }), HasSubstr("not on the planet"));
}

TEST(SourceRecord, aWrongCountOfPartsIsRefused) {
    std::vector<std::byte> bytes = sourceRecordBytes(someRecord());
    bytes[32] = std::byte{3};
    EXPECT_THAT(errorOf(resealed(bytes)), HasSubstr("inconsistent"));
}

}  // namespace
}  // namespace planet
