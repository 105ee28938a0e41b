#include "planet/base/little_endian.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

namespace planet {
namespace {

std::vector<std::byte> bytesOf(std::initializer_list<unsigned> values) {
    std::vector<std::byte> bytes;
    for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

tl::expected<std::uint64_t, VariableProblem> variableFrom(std::initializer_list<unsigned> values) {
    const std::vector<std::byte> bytes = bytesOf(values);
    return ByteReader(bytes).getVariable();
}

TEST(VariableNumbers, areReadAsTheyWereWritten) {
    std::vector<std::byte> bytes;
    ByteWriter out(bytes);
    std::vector<std::uint64_t> values;
    for (int bit = 0; bit < 64; ++bit) {
        values.push_back(std::uint64_t{1} << bit);
        values.push_back((std::uint64_t{1} << bit) - 1);
    }
    values.push_back(std::numeric_limits<std::uint64_t>::max());
    for (const std::uint64_t value : values) out.putVariable(value);
    ByteReader in(bytes);
    for (const std::uint64_t value : values) EXPECT_EQ(in.getVariable(), value);
    EXPECT_TRUE(in.rest().empty());
}

TEST(VariableNumbers, withSignsAreReadAsTheyWereWritten) {
    using Limits = std::numeric_limits<std::int64_t>;
    for (const std::int64_t value : {Limits::min(), std::int64_t{-65}, std::int64_t{-64}, std::int64_t{-1},
                                     std::int64_t{0}, std::int64_t{63}, std::int64_t{64}, Limits::max()}) {
        std::vector<std::byte> bytes;
        ByteWriter(bytes).putVariableSigned(value);
        EXPECT_EQ(ByteReader(bytes).getVariableSigned(), value);
    }
}

TEST(VariableNumbers, longerThanTheyNeedToBeAreRefused) {
    EXPECT_EQ(variableFrom({0}), std::uint64_t{0});
    EXPECT_EQ(variableFrom({0x80, 0x01}), std::uint64_t{128});
    for (const auto& coded :
         {bytesOf({0x80, 0x00}), bytesOf({0xFF, 0x80, 0x00}), bytesOf({0x80, 0x00, 0x05})})
        EXPECT_EQ(ByteReader(coded).getVariable(), tl::unexpected(VariableProblem::OutOfRange));
}

TEST(VariableNumbers, ofMoreThan64BitsAreOutOfRangeAlsoWhereTheBytesEnd) {
    const auto refused = tl::unexpected(VariableProblem::OutOfRange);
    EXPECT_EQ(variableFrom({255, 255, 255, 255, 255, 255, 255, 255, 255, 1}),
              std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(variableFrom({255, 255, 255, 255, 255, 255, 255, 255, 255, 2}), refused);
    EXPECT_EQ(variableFrom({255, 255, 255, 255, 255, 255, 255, 255, 255, 129}), refused);
}

TEST(VariableNumbers, whoseBytesEndAreTruncated) {
    const auto refused = tl::unexpected(VariableProblem::Truncated);
    EXPECT_EQ(variableFrom({}), refused);
    EXPECT_EQ(variableFrom({0x80}), refused);
    EXPECT_EQ(variableFrom({255, 255, 255, 255, 255, 255, 255, 255, 255}), refused);
}

}  // namespace
}  // namespace planet
