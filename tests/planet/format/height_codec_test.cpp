#include "planet/format/height_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "planet/format/height_residual_coder.h"
#include "tests/support/earth_windows.h"

namespace planet {
namespace {

using Samples = std::vector<std::int32_t>;
using Bytes = std::vector<std::byte>;
using test::Square;
using testing::HasSubstr;

constexpr std::int32_t lowest = -32768;
constexpr std::int32_t highestStep = 32767;

Square squareOf(int side, const std::function<int(int x, int y)>& step) {
    Square square{side, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) square.samples.push_back(std::clamp(step(x, y), lowest, highestStep));
    return square;
}

int smoothStep(int x, int y) {
    return static_cast<int>(std::lround(900 * std::sin(0.021 * x + 0.5) * std::cos(0.017 * y) + 3 * x));
}

struct Field {
    std::string name;
    std::function<Square(int side)> make;
};

Square noiseOf(int side, int range) {
    std::mt19937 random(7);
    return squareOf(side, [&](int, int) {
        return static_cast<int>(random() % static_cast<unsigned>(range)) - range / 2;
    });
}

std::vector<Field> fields() {
    return {
        {"zero", [](int side) { return squareOf(side, [](int, int) { return 0; }); }},
        {"flat", [](int side) { return squareOf(side, [](int, int) { return -4711; }); }},
        {"ramp", [](int side) { return squareOf(side, [](int x, int y) { return 17 * x - 5 * y; }); }},
        {"steep ramp", [](int side) { return squareOf(side, [](int x, int y) { return 900 * (x - y); }); }},
        {"smooth", [](int side) { return squareOf(side, smoothStep); }},
        {"spike",
         [](int side) {
             return squareOf(side, [=](int x, int y) { return x == side / 2 && y == 1 ? 30000 : 3; });
         }},
        {"cliff",
         [](int side) {
             return squareOf(side, [=](int x, int) { return x < side / 2 ? lowest : highestStep; });
         }},
        {"chequered extremes",
         [](int side) {
             return squareOf(side, [](int x, int y) { return (x + y) % 2 ? lowest : highestStep; });
         }},
        {"extreme stripes",
         [](int side) { return squareOf(side, [](int x, int) { return x % 2 ? lowest : highestStep; }); }},
        {"lowest", [](int side) { return squareOf(side, [](int, int) { return lowest; }); }},
        {"slight noise", [](int side) { return noiseOf(side, 3); }},
        {"rough noise", [](int side) { return noiseOf(side, 700); }},
        {"white noise", [](int side) { return noiseOf(side, 65536); }},
    };
}

Bytes encoded(const Square& fine, int level = defaultCompressionLevel) {
    Bytes bytes;
    encodeRefinement(fine.samples, fine.side / 2, level, 0, bytes);
    return bytes;
}

Result<Samples> decoded(const Bytes& bytes, const Square& fine) {
    const Square coarse = pieceOf(fine, 0, 0, fine.side / 2 + 1, 2);
    return decodeRefinement(bytes, coarse.samples, fine.side / 2, 0).map([](const Steps& steps) {
        return steps.view().toVector();
    });
}

std::size_t missingSamples(const Square& fine) {
    const auto coarse = static_cast<std::size_t>(fine.side / 2 + 1);
    return fine.samples.size() - coarse * coarse;
}

double bitsPerSample(const Square& fine, int level = defaultCompressionLevel) {
    return 8.0 * static_cast<double>(encoded(fine, level).size()) / static_cast<double>(fine.samples.size());
}

// Bits for each sample of the square, its whole pyramid counted in.
double pyramidBitsPerSample(const Square& square, int coarseCells, int level = defaultCompressionLevel) {
    Bytes bytes;
    for (const test::Block& block : test::pyramidBlocks(square, coarseCells))
        encodeRefinement(block.fine.samples, coarseCells, level, 0, bytes);
    return 8.0 * static_cast<double>(bytes.size()) / static_cast<double>(square.samples.size());
}

// Sample 1025 x 1025: the Alps, the Sahara, the Mediterranean and the Atlantic.
const Square& europeAndAfrica() {
    static const Square window = test::earthWindow(1800, 450, 1025);
    return window;
}

TEST(HeightCodec, EveryFieldComesBackAtEverySizeAndLevel) {
    for (const Field& field : fields()) {
        for (const int cells : {1, 2, 4, 16, 32, 64, 128}) {
            const Square fine = field.make(2 * cells + 1);
            for (int level = minCompressionLevel; level <= maxCompressionLevel; ++level) {
                if (cells > 32 && level == maxCompressionLevel) continue;
                const auto samples = decoded(encoded(fine, level), fine);
                ASSERT_TRUE(samples) << samples.error().message;
                ASSERT_EQ(*samples, fine.samples) << field.name << ", c " << cells << ", level " << level;
            }
        }
    }
}

TEST(HeightCodec, CellsNeedNoPowerOfTwo) {
    for (const int cells : {3, 7, 33, 127}) {
        const Square fine = squareOf(2 * cells + 1, smoothStep);
        const auto samples = decoded(encoded(fine), fine);
        ASSERT_TRUE(samples) << samples.error().message;
        EXPECT_EQ(*samples, fine.samples);
    }
}

TEST(HeightCodec, EncodesTheSameBytesEveryTime) {
    const Square fine = pieceOf(europeAndAfrica(), 300, 200, 65);
    for (int level = minCompressionLevel; level <= maxCompressionLevel; ++level)
        EXPECT_EQ(encoded(fine, level), encoded(fine, level));
}

// Pins the format: a change of the bytes must be a change of the chunk file's version.
TEST(HeightCodec, BytesOfAKnownFieldNeverChange) {
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (const std::byte byte :
         encoded(squareOf(65, [](int x, int y) { return x * x - 3 * y * (x ^ y) % 97; }))) {
        hash ^= std::to_integer<std::uint64_t>(byte);
        hash *= 1099511628211u;
    }
    EXPECT_EQ(hash, 15678521571796931786u);
}

TEST(HeightCodec, AppendsBehindWhatIsThere) {
    const Square fine = squareOf(17, smoothStep);
    Bytes bytes = {std::byte{1}, std::byte{2}};
    encodeRefinement(fine.samples, 8, defaultCompressionLevel, 0, bytes);
    const Bytes alone = encoded(fine);
    EXPECT_EQ(bytes.size(), alone.size() + 2);
    EXPECT_TRUE(std::ranges::equal(std::span(bytes).subspan(2), alone));
}

TEST(HeightCodec, NoFieldTakesMoreThanPlainSamples) {
    for (const Field& field : fields()) {
        for (const int cells : {1, 4, 32}) {
            const Square fine = field.make(2 * cells + 1);
            EXPECT_LE(encoded(fine).size(), 1 + 2 * missingSamples(fine)) << field.name << ", c " << cells;
        }
    }
}

TEST(HeightCodec, FlatGroundAndSlopesCostAlmostNothing) {
    EXPECT_LT(bitsPerSample(squareOf(65, [](int, int) { return -87; })), 0.05);
    EXPECT_LT(bitsPerSample(squareOf(65, [](int x, int y) { return 40 * x - 12 * y; })), 0.1);
}

TEST(HeightCodec, LevelGroundTakesOneByte) {
    for (int level = 1; level <= maxCompressionLevel; ++level)
        EXPECT_EQ(encoded(squareOf(65, [](int, int) { return -4711; }), level).size(), 1u);
}

TEST(HeightCodec, LevelGroundUnderAParentThatIsNotLevelIsRefused) {
    const Bytes level = encoded(squareOf(17, [](int, int) { return 5; }));
    const auto samples = decoded(level, squareOf(17, smoothStep));
    ASSERT_FALSE(samples);
    EXPECT_THAT(samples.error().message, HasSubstr("those of its parent are not"));
}

TEST(HeightCodec, SmoothGroundCostsLittle) {
    EXPECT_LT(bitsPerSample(squareOf(65, smoothStep)), 1.0);
}

TEST(HeightCodec, EarthCostsLessThanSixBitsASample) {
    EXPECT_LT(pyramidBitsPerSample(europeAndAfrica(), 32), 5.9);
    EXPECT_LT(pyramidBitsPerSample(europeAndAfrica(), 64), 5.9);
}

TEST(HeightCodec, HigherLevelsMakeEarthSmaller) {
    const Square window = pieceOf(europeAndAfrica(), 0, 0, 513);
    double before = 16;
    for (int level = minCompressionLevel + 1; level <= maxCompressionLevel; ++level) {
        const double bits = pyramidBitsPerSample(window, 32, level);
        EXPECT_LT(bits, before) << "level " << level;
        before = bits;
    }
}

TEST(HeightCodec, DecodeRejectsDataCutShortAnywhere) {
    const Square fine = pieceOf(europeAndAfrica(), 400, 300, 33);
    for (const int level : {minCompressionLevel, defaultCompressionLevel}) {
        const Bytes bytes = encoded(fine, level);
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            const auto samples =
                decoded(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)), fine);
            ASSERT_FALSE(samples) << length << " of " << bytes.size() << " bytes";
            EXPECT_THAT(samples.error().message, testing::StartsWith("height block: "));
        }
    }
}

TEST(HeightCodec, DecodeRejectsBytesLeftOver) {
    const Square fine = pieceOf(europeAndAfrica(), 400, 300, 33);
    for (const int level : {minCompressionLevel, defaultCompressionLevel}) {
        for (const std::size_t extra : {1u, 2u, 4u, 8u, 100u}) {
            Bytes bytes = encoded(fine, level);
            bytes.resize(bytes.size() + extra);
            EXPECT_FALSE(decoded(bytes, fine));
        }
    }
}

TEST(HeightCodec, DecodeRejectsUnknownStorage) {
    const Square fine = squareOf(17, smoothStep);
    Bytes bytes = encoded(fine);
    for (const int storage : {2, 3, 6, 7, 255}) {
        bytes[0] = static_cast<std::byte>(storage);
        const auto samples = decoded(bytes, fine);
        ASSERT_FALSE(samples);
        EXPECT_THAT(samples.error().message, testing::HasSubstr("unknown storage"));
    }
}

TEST(HeightCodec, DecodeSurvivesEveryFlippedBitAndNoticesNearlyAll) {
    const Square fine = pieceOf(europeAndAfrica(), 400, 300, 33);
    const Bytes good = encoded(fine);
    std::size_t noticed = 0;
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
        Bytes bytes = good;
        bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
        const auto samples = decoded(bytes, fine);
        if (!samples || *samples != fine.samples) ++noticed;
    }
    EXPECT_GT(noticed, 8 * good.size() * 99 / 100);
}

TEST(HeightCodec, DecodeSurvivesNoiseAndIsAnErrorOrAGrid) {
    std::mt19937 random(11);
    for (const int side : {3, 5, 33, 65}) {
        const Square fine = noiseOf(side, 65536);
        for (int trial = 0; trial < 500; ++trial) {
            Bytes bytes(random() % 6000);
            for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
            if (!bytes.empty() && trial % 2) bytes[0] = trial % 4 == 1 ? std::byte{1} : std::byte{4};
            const auto samples = decoded(bytes, fine);
            if (!samples) {
                EXPECT_THAT(samples.error().message, testing::StartsWith("height block: "));
            } else {
                EXPECT_EQ(samples->size(), fine.samples.size());
            }
        }
    }
}

TEST(HeightCodec, DecodeKeepsTheCoarseSamples) {
    const Square fine = squareOf(33, smoothStep);
    const Square other = squareOf(33, [](int x, int y) { return 100 * x + y; });
    const auto samples = decoded(encoded(fine, minCompressionLevel), other);
    ASSERT_TRUE(samples);
    const Square mixed{33, *samples};
    EXPECT_EQ(pieceOf(mixed, 0, 0, 17, 2).samples, pieceOf(other, 0, 0, 17, 2).samples);
    EXPECT_EQ(mixed.at(1, 0), fine.at(1, 0));
}

Bytes encodedGrid(const Square& grid) {
    Bytes bytes;
    encodeGrid(grid.samples, grid.side, 0, bytes);
    return bytes;
}

TEST(HeightCodec, EveryGridComesBack) {
    for (const Field& field : fields()) {
        for (const int side : {2, 3, 5, 17, 33, 65, 129}) {
            const Square grid = field.make(side);
            const auto result = decodeGrid(encodedGrid(grid), side, 0);
            ASSERT_TRUE(result) << result.error().message;
            ASSERT_EQ(result->view().toVector(), grid.samples) << field.name << ", side " << side;
        }
    }
}

TEST(HeightCodec, GridsAreCompressed) {
    const Square grid = pieceOf(europeAndAfrica(), 0, 0, 65, 16);
    EXPECT_LT(encodedGrid(grid).size(), 2 * grid.samples.size() * 3 / 4);
}

TEST(HeightCodec, DecodeGridRejectsCutAndLongData) {
    const Square grid = pieceOf(europeAndAfrica(), 0, 0, 17, 64);
    Bytes bytes = encodedGrid(grid);
    for (std::size_t length = 0; length < bytes.size(); ++length)
        EXPECT_FALSE(decodeGrid(std::span(bytes).first(length), 17, 0)) << length;
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(decodeGrid(bytes, 17, 0));
}

TEST(HeightCodec, DecodeGridSurvivesFlippedBits) {
    const Square grid = pieceOf(europeAndAfrica(), 0, 0, 17, 64);
    const Bytes good = encodedGrid(grid);
    std::size_t harmless = 0;
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
        Bytes bytes = good;
        bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
        const auto read = decodeGrid(bytes, 17, 0);
        if (read && read->view().toVector() == grid.samples) ++harmless;
    }
    EXPECT_LT(harmless, 8 * good.size() / 20);
}

// ---- Fractions of the quantum ----

constexpr int fractions = 6;

Bytes encodedFine(const Square& fine, int fractionBits = fractions) {
    Bytes bytes;
    encodeRefinement(fine.samples, fine.side / 2, defaultCompressionLevel, fractionBits, bytes);
    return bytes;
}
Result<Steps> decodedFine(const Bytes& bytes, const Square& fine, int fractionBits = fractions) {
    const Steps coarse(std::span<const std::int32_t>(pieceOf(fine, 0, 0, fine.side / 2 + 1, 2).samples));
    return decodeRefinement(bytes, coarse, fine.side / 2, fractionBits);
}
int storageOf(const Bytes& bytes) {
    return std::to_integer<int>(bytes[0]) & 7;
}
int shiftOf(const Bytes& bytes) {
    return std::to_integer<int>(bytes[0]) >> 3;
}

Square scaled(Square square, std::int32_t factor, std::int32_t offset = 0) {
    for (std::int32_t& sample : square.samples) sample = factor * sample + offset;
    return square;
}

// Rough ground in steps of a millimetre, which exceeds 16 bits even in 1/64 of that.
Square wideGround() {
    Square square = scaled(pieceOf(europeAndAfrica(), 0, 0, 65, 16), 1000);
    for (std::size_t i = 0; i < square.samples.size(); ++i)
        square.samples[i] += static_cast<std::int32_t>(1 + i * i % 63);
    return square;
}

// The same in whole metres but for a corner of noise, as around lidar.
Square mixedGround(int corner) {
    Square square = scaled(pieceOf(europeAndAfrica(), 0, 0, 65, 16), 64);
    std::mt19937 random(5);
    for (int y = 0; y < corner; ++y)
        for (int x = 0; x < corner; ++x)
            square.samples[static_cast<std::size_t>(y * square.side + x)] +=
                static_cast<std::int32_t>(random() % 64);
    return square;
}

TEST(HeightCodec, MultiplesOfTheQuantumCostWhatTheyCostWithoutFractions) {
    for (const Field& field : fields()) {
        const Square whole = field.make(33);
        const Square fine = scaled(whole, 1 << fractions);
        const Bytes bytes = encodedFine(fine);
        EXPECT_EQ(shiftOf(bytes), fractions) << field.name;
        Bytes expected = encoded(whole);
        expected[0] = bytes[0];
        EXPECT_EQ(bytes, expected) << field.name;
        const auto read = decodedFine(bytes, fine);
        ASSERT_TRUE(read) << field.name << ": " << read.error().message;
        EXPECT_EQ(read->view().toVector(), fine.samples) << field.name;
        EXPECT_EQ(read->bytes(), 2 * fine.samples.size()) << "in memory too";
    }
}

TEST(HeightCodec, FineGroundFarFromStepZeroFitsIntoSixteenBits) {
    const Square near = squareOf(65, smoothStep);
    for (const std::int32_t offset : {1, 1'000'001, -4'000'003}) {
        const Square far = scaled(near, 1, offset);
        const Bytes bytes = encodedFine(far);
        EXPECT_EQ(storageOf(bytes), 1);
        EXPECT_EQ(shiftOf(bytes), 0);
        EXPECT_NEAR(static_cast<double>(bytes.size()), static_cast<double>(encoded(near).size()), 8);
        EXPECT_EQ(decodedFine(bytes, far).value().view().toVector(), far.samples);
    }
}

TEST(HeightCodec, BlocksThatExceedSixteenBitsAreStoredWide) {
    const Square wide = wideGround();
    const Bytes bytes = encodedFine(wide);
    EXPECT_EQ(storageOf(bytes), 2);
    EXPECT_EQ(bytes.size(), 1 + 4 * missingSamples(wide));
    const Steps read = decodedFine(bytes, wide).value();
    EXPECT_EQ(read.view().toVector(), wide.samples);
    EXPECT_EQ(read.bytes(), 4 * wide.samples.size());
}

// A part that is coarse costs hardly more than without the fine part: neither 16 bits nor the bits of its noise.
TEST(HeightCodec, BlocksOfWhichAPartIsFineAreSplit) {
    const Square whole = pieceOf(europeAndAfrica(), 0, 0, 65, 16);
    const auto coarseBytes = static_cast<double>(encoded(whole).size());
    for (const int corner : {2, 9, 20}) {
        const Square mixed = mixedGround(corner);
        const Bytes bytes = encodedFine(mixed);
        EXPECT_EQ(storageOf(bytes), 3) << corner;
        EXPECT_EQ(shiftOf(bytes), fractions);
        EXPECT_LE(static_cast<double>(bytes.size()), coarseBytes + 60 + 1.2 * corner * corner) << corner;
        const auto read = decodedFine(bytes, mixed);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->view().toVector(), mixed.samples) << corner;
        for (std::size_t length = 1; length < bytes.size(); length += 7) {
            const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
            EXPECT_FALSE(decodedFine(cut, mixed)) << length;
        }
        Bytes longer = bytes;
        longer.push_back(std::byte{0});
        EXPECT_FALSE(decodedFine(longer, mixed));
        EXPECT_FALSE(decodedFine(bytes, mixed, fractions + 1)) << "the shift must be that of the file";
    }
}

TEST(HeightCodec, HostileSplitsAreReadWithinTheLimitsOrRefused) {
    const Square mixed = mixedGround(9);
    const Bytes good = encodedFine(mixed);
    ASSERT_EQ(storageOf(good), 3);
    std::mt19937 random(9);
    for (int i = 0; i < 3000; ++i) {
        Bytes bytes = good;
        const std::size_t at = i % 2 == 0 ? random() % 12 : random() % bytes.size();
        bytes[at] = static_cast<std::byte>(random());
        const auto read = decodedFine(bytes, mixed);
        if (!read) continue;
        const auto [low, high] = lowestAndHighest(*read);
        ASSERT_GE(low, lowestStepOf(fractions));
        ASSERT_LE(high, highestStepOf(fractions));
    }
}

TEST(HeightCodec, GridsWithFractionsComeBack) {
    for (const Square& grid : {wideGround(), mixedGround(9), scaled(squareOf(33, smoothStep), 64),
                               scaled(squareOf(33, smoothStep), 1, 2'000'000)}) {
        Bytes bytes;
        encodeGrid(grid.samples, grid.side, fractions, bytes);
        const auto read = decodeGrid(bytes, grid.side, fractions);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->view().toVector(), grid.samples);
        for (const std::size_t length : {std::size_t{0}, std::size_t{15}, bytes.size() - 1})
            EXPECT_FALSE(decodeGrid(std::span(bytes).first(length), grid.side, fractions)) << length;
    }
}

std::string errorOfFine(Bytes bytes, const Square& fine, int first, int fractionBits = fractions) {
    bytes[0] = static_cast<std::byte>(first);
    const auto read = decodedFine(bytes, fine, fractionBits);
    return read ? "none" : read.error().message;
}

TEST(HeightCodec, HostileShiftsAndStoragesAreRefused) {
    const Square ground = scaled(squareOf(17, smoothStep), 8, 8 * 3);
    const Bytes bytes = encodedFine(ground);
    ASSERT_EQ(shiftOf(bytes), 3);
    EXPECT_EQ(errorOfFine(bytes, ground, 1 | 3 << 3), "none");
    EXPECT_THAT(errorOfFine(bytes, ground, 1 | 7 << 3), HasSubstr("shift 7; expected [0, 6]"));
    EXPECT_THAT(errorOfFine(bytes, ground, 1 | 31 << 3), HasSubstr("shift 31; expected [0, 6]"));
    EXPECT_THAT(errorOfFine(bytes, ground, 1 | 4 << 3),
                HasSubstr("not all heights of its parent are multiples"));
    EXPECT_THAT(errorOfFine(bytes, ground, 6), HasSubstr("unknown storage 6; expected [0, 5]"));
    EXPECT_THAT(errorOfFine(bytes, ground, 3), HasSubstr("shift 0; expected [6, 6]"));
    EXPECT_THAT(errorOfFine(bytes, ground, 3 | 6 << 3), HasSubstr("bytes of high bits"));
    EXPECT_THAT(errorOfFine(bytes, ground, 2 | 1 << 3), HasSubstr("shift 1; expected [0, 0]"));
    EXPECT_THAT(errorOfFine(bytes, ground, 2), HasSubstr("bytes of plain samples"));
    EXPECT_THAT(errorOfFine(bytes, ground, 2, 0), HasSubstr("unknown storage 2; expected 0, 1, 4 or 5"));
    EXPECT_THAT(errorOfFine(bytes, ground, 1 | 3 << 3, 0), HasSubstr("shift 3; expected [0, 0]"));
    const Square wide = wideGround();
    EXPECT_THAT(errorOfFine(encodedFine(wide), wide, 1), HasSubstr("exceed 16 bits"));
}

TEST(HeightCodec, StepsBeyondTheLimitsAreRefused) {
    Square wide = wideGround();
    Bytes bytes = encodedFine(wide);
    for (const std::int32_t step :
         {farthestStep, farthestStep + 1, -farthestStep - 1, std::numeric_limits<std::int32_t>::max()}) {
        Bytes changed = bytes;
        for (std::size_t i = 0; i < 4; ++i)
            changed[1 + i] = static_cast<std::byte>(static_cast<std::uint32_t>(step) >> (8 * i));
        EXPECT_EQ(decodedFine(changed, wide).has_value(), step == farthestStep) << step;
    }
    // A plain block near the limit, whose samples reach beyond it.
    const Square edge = squareOf(3, [](int, int) { return 0; });
    const Square high = scaled(edge, 1, farthestStep);
    bytes.clear();
    encodeRefinement(high.samples, 1, minCompressionLevel, fractions, bytes);
    EXPECT_TRUE(decodedFine(bytes, high));
    bytes[1] = std::byte{1};
    EXPECT_THAT(decodedFine(bytes, high).error().message, HasSubstr("out of the range of steps"));
    Bytes corners;
    encodeGrid(wide.samples, wide.side, fractions, corners);
    corners[3] = std::byte{0x40};
    EXPECT_THAT(decodeGrid(corners, wide.side, fractions).error().message, HasSubstr("out of the range"));
}

using Residuals = std::vector<std::int16_t>;

TEST(ResidualCoder, EveryWidthCodesEveryResidual) {
    Residuals residuals = {-32768, 32767, 0, 1, -1};
    for (int r = -300; r <= 300; ++r) residuals.push_back(static_cast<std::int16_t>(r));
    for (int r = lowest; r <= highestStep; r += 97) residuals.push_back(static_cast<std::int16_t>(r));
    for (const int states : {1, 2}) {
        for (int shape = 0; shape < residualShapeCount; ++shape) {
            for (int width = 0; width < residualWidthCount; ++width) {
                const std::vector<std::uint8_t> widths(residuals.size(), static_cast<std::uint8_t>(width));
                ResidualEncoder encoder(residuals.size(), states);
                encoder.addRow(residuals, widths, shape);
                Bytes bytes;
                encoder.finish(bytes);
                ResidualDecoder decoder(bytes, states);
                Residuals read(residuals.size());
                decoder.readRow(widths, read, shape);
                ASSERT_FALSE(decoder.failed());
                EXPECT_TRUE(decoder.ended());
                ASSERT_EQ(read, residuals) << "width " << width << ", shape " << shape;
            }
        }
    }
}

TEST(ResidualCoder, RowsOfEveryLengthComeBackWithOneState) {
    std::mt19937 random(17);
    for (std::size_t count = 0; count < 200; ++count) {
        Residuals residuals(count);
        for (std::int16_t& residual : residuals) residual = static_cast<std::int16_t>(random() % 9 - 4);
        const std::vector<std::uint8_t> widths(count, residualWidthOfOne + 3);
        ResidualEncoder encoder(count, 1);
        encoder.addRow(residuals, widths);
        Bytes bytes;
        encoder.finish(bytes);
        ResidualDecoder decoder(bytes, 1);
        Residuals read(count);
        decoder.readRow(widths, read);
        EXPECT_FALSE(decoder.failed());
        EXPECT_TRUE(decoder.ended());
        ASSERT_EQ(read, residuals) << count << " residuals";
    }
}

TEST(ResidualCoder, OneStateWithoutResidualsTakesFiveBytes) {
    Bytes bytes;
    ResidualEncoder(0, 1).finish(bytes);
    EXPECT_EQ(bytes.size(), 5u);
    EXPECT_TRUE(ResidualDecoder(bytes, 1).ended());
}

TEST(ResidualCoder, CostIsWhatTheBytesTake) {
    std::mt19937 random(3);
    for (const int width : {10, residualWidthOfOne, residualWidthOfOne + 12, residualWidthCount - 10}) {
        Residuals residuals;
        for (int i = 0; i < 20000; ++i) {
            const int magnitude = 1 << std::max(0, (width - residualWidthOfOne) / 4);
            residuals.push_back(static_cast<std::int16_t>(static_cast<int>(random() % 3 - 1) * magnitude));
        }
        const std::vector<std::uint8_t> widths(residuals.size(), static_cast<std::uint8_t>(width));
        ResidualEncoder encoder(residuals.size());
        encoder.addRow(residuals, widths);
        Bytes bytes;
        encoder.finish(bytes);
        const double expectedBytes = static_cast<double>(residualsCost(residuals, widths)) / (256 * 8);
        EXPECT_NEAR(static_cast<double>(bytes.size()), expectedBytes, 20 + 0.005 * expectedBytes)
            << "width " << width;
    }
}

std::int64_t costOf(int width, int residual) {
    const auto one = static_cast<std::int16_t>(residual);
    const auto itsWidth = static_cast<std::uint8_t>(width);
    return residualsCost(std::span(&one, 1), std::span(&itsWidth, 1));
}

// The encoder's choice of width would be worth nothing otherwise.
TEST(ResidualCoder, AResidualIsCheapestAtItsOwnWidth) {
    for (int octave = 0; octave < 12; ++octave) {
        const int own = residualWidthOfOne + 4 * octave;
        const int residual = 1 << octave;
        EXPECT_LT(costOf(own, residual), costOf(own - 12, residual));
        EXPECT_LT(costOf(own, residual), costOf(std::min(own + 12, residualWidthCount - 1), residual));
    }
}

}  // namespace
}  // namespace planet
