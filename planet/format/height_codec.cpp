#include "planet/format/height_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/format/fitted_block.h"
#include "planet/format/height_pass_decoding.h"
#include "planet/format/height_prediction.h"
#include "planet/format/height_residual_coder.h"
#include "planet/format/height_rows.h"

namespace planet {

namespace {

// The low bits of the first byte of a coded refinement; the bits above are the shift. Plain: the missing samples follow
// uncoded, row by row of each pass. Entropy: one byte per pass (PassChoice) follows, then the output of
// ResidualEncoder. Both code 16-bit samples, (step >> shift) - base. Wide: the steps follow as 32-bit numbers. Split: the
// length (u32) and the code of all samples shifted by the fraction bits, which is Plain, Entropy or Fitted, and then the
// bits that are shifted out. That is for blocks of which a part is coarse: its low bits are zeros, and the others are
// noise. Fitted: 16-bit samples as of Entropy, coded with weights fitted to the block (fitted_block.h). Level: all samples
// of the fine grid are equal, and no bytes follow.
enum class Storage : std::uint8_t { Plain, Entropy, Wide, Split, Fitted, Level };
constexpr int storageBits = 3;
static_assert(maxFractionBits < 1 << (8 - storageBits));
static_assert(maxRowSamples == maxCoarseCells + 1);

// The low 3 bits of a pass's byte are the predictor; the bits above are the shift of all widths plus
// widthShiftBias.
constexpr int predictorBits = 3;
constexpr int widthShiftBias = 23;

struct PassChoice {
    int predictor = 0;
    int widthShift = 0;  // in [minWidthShift, maxWidthShift]
};

std::byte toByte(PassChoice choice) {
    return static_cast<std::byte>(choice.predictor | (choice.widthShift + widthShiftBias) << predictorBits);
}

PassChoice fromByte(std::byte byte) {
    const int bits = std::to_integer<int>(byte);
    return {bits & (refinementPredictorCount - 1), (bits >> predictorBits) - widthShiftBias};
}

std::byte firstByte(Storage storage, int shift) {
    return static_cast<std::byte>(static_cast<int>(storage) | shift << storageBits);
}

// The residuals and expected errors of one pass under one predictor.
struct CodedPass {
    std::vector<std::int16_t> residuals;
    std::vector<float> expected256;
};

// Runs the predictor over a pass of known samples.
CodedPass predictPass(RefinementPredictor& predictor, RefinementPass pass, int choice,
                      std::span<const std::int16_t> fine, int coarseCells) {
    const auto rows = static_cast<std::size_t>(passRows(pass, coarseCells));
    const auto columns = static_cast<std::size_t>(passColumns(pass, coarseCells));
    CodedPass coded{std::vector<std::int16_t>(rows * columns), std::vector<float>(rows * columns)};
    RowBuffers buffers(passColumns(pass, coarseCells));
    const std::span predicted = buffers.predicted();
    const std::span samples = buffers.samples();
    predictor.beginPass(pass, choice);
    for (std::size_t y = 0; y < rows; ++y) {
        const int row = static_cast<int>(y);
        const std::span residuals = std::span(coded.residuals).subspan(y * columns, columns);
        predictor.predictRow(row, predicted);
        predictor.expectErrors(row, std::span(coded.expected256).subspan(y * columns, columns));
        const std::int16_t* const in = fine.data() + rowStart(pass, row, coarseCells);
        for (std::size_t x = 0; x < columns; ++x) {
            samples[x] = in[2 * x];
            residuals[x] = static_cast<std::int16_t>(samples[x] - predicted[x]);
        }
        predictor.setErrors(row, residuals);
        predictor.setSamples(row, samples);
    }
    return coded;
}

// Every step-th sample of a pass, of which its cost is estimated.
struct CostSamples {
    CodedPass coded;
    std::vector<std::uint8_t> widths;

    CostSamples(const CodedPass& pass, std::size_t step) {
        const std::size_t count = (pass.residuals.size() + step - 1) / step;
        coded.residuals.resize(count);
        coded.expected256.resize(count);
        widths.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            coded.residuals[i] = pass.residuals[i * step];
            coded.expected256[i] = pass.expected256[i * step];
        }
    }

    // Returns the cost with a width shift, in 1/256 bit.
    std::int64_t cost(int widthShift) {
        residualWidths(coded.expected256, widthShift, widths);
        return residualsCost(coded.residuals, widths);
    }
};

// The effort of a compression level above 0.
struct Effort {
    int predictors;    // number of predictors to try
    std::size_t step;  // costs use every step-th sample
};

Effort effortOf(int compressionLevel) {
    constexpr std::array<Effort, maxCompressionLevel> efforts = {{{1, 8}, {4, 8}, {8, 1}}};
    return efforts[static_cast<std::size_t>(compressionLevel - 1)];
}

struct ChosenPass {
    PassChoice choice;
    CodedPass coded;
};

ChosenPass choosePass(RefinementPredictor& predictor, RefinementPass pass, std::span<const std::int16_t> fine,
                      int coarseCells, Effort effort) {
    ChosenPass chosen;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    int shift = 0;
    for (int candidate = 0; candidate < effort.predictors; ++candidate) {
        CodedPass coded = predictPass(predictor, pass, candidate, fine, coarseCells);
        CostSamples samples(coded, effort.step);
        const std::int64_t cost =
            descendShift([&](int widthShift) { return samples.cost(widthShift); }, shift);
        if (cost < least) {
            least = cost;
            chosen = {{candidate, shift}, std::move(coded)};
        }
    }
    // The next pass uses the errors of this one, so recompute them for the chosen predictor.
    const auto columns = static_cast<std::size_t>(passColumns(pass, coarseCells));
    for (int row = 0; row < passRows(pass, coarseCells); ++row) {
        const std::size_t start = static_cast<std::size_t>(row) * columns;
        predictor.setErrors(row, std::span(chosen.coded.residuals).subspan(start, columns));
    }
    return chosen;
}

void addPass(const CodedPass& coded, std::size_t columns, int widthShift, ResidualEncoder& encoder) {
    std::vector<std::uint8_t> widths(coded.residuals.size());
    residualWidths(coded.expected256, widthShift, widths);
    for (std::size_t i = 0; i < widths.size(); i += columns)
        encoder.addRow(std::span(coded.residuals).subspan(i, columns), std::span(widths).subspan(i, columns));
}

void encodeEntropy(std::span<const std::int16_t> fine, int coarseCells, int compressionLevel, int shift,
                   std::vector<std::byte>& out) {
    RefinementPredictor predictor(coarseCells);
    predictor.setCoarse(thinned(fine, 2 * coarseCells + 1, coarseCells + 1, 2));
    ResidualEncoder encoder(missingSamples(coarseCells));
    out.push_back(firstByte(Storage::Entropy, shift));
    for (const RefinementPass pass : allRefinementPasses) {
        const ChosenPass chosen = choosePass(predictor, pass, fine, coarseCells, effortOf(compressionLevel));
        out.push_back(toByte(chosen.choice));
        addPass(chosen.coded, static_cast<std::size_t>(passColumns(pass, coarseCells)),
                chosen.choice.widthShift, encoder);
    }
    encoder.finish(out);
}

// Visits the fine grid's index of every missing sample, in the order of Storage::Plain.
template <class Visit>
void forEachMissing(int coarseCells, const Visit& visit) {
    for (const RefinementPass pass : allRefinementPasses)
        for (int row = 0; row < passRows(pass, coarseCells); ++row) {
            const std::size_t start = rowStart(pass, row, coarseCells);
            for (int x = 0; x < passColumns(pass, coarseCells); ++x)
                visit(start + 2 * static_cast<std::size_t>(x));
        }
}

template <class Sample>
void encodePlain(Storage storage, std::span<const Sample> fine, int coarseCells, int shift,
                 std::vector<std::byte>& out) {
    out.push_back(firstByte(storage, shift));
    ByteWriter writer(out);
    forEachMissing(coarseCells, [&](std::size_t index) { writer.put(fine[index]); });
}

template <class Sample>
Result<void> decodePlain(std::span<const std::byte> coded, int coarseCells, std::span<Sample> fine) {
    const std::size_t wanted = sizeof(Sample) * missingSamples(coarseCells);
    if (coded.size() != wanted)
        return badInput(
            fmt::format("height block: {} bytes of plain samples; expected {}", coded.size(), wanted));
    ByteReader reader(coded);
    forEachMissing(coarseCells, [&](std::size_t index) { fine[index] = reader.get<Sample>(); });
    return {};
}

// Decodes one pass; returns false if the bytes end early.
bool decodePass(RefinementPredictor& predictor, RefinementPass pass, PassChoice choice,
                ResidualDecoder& decoder, int coarseCells, std::span<std::int16_t> fine) {
    predictor.beginPass(pass, choice.predictor);
    return decodePassRows(predictor, pass, choice.widthShift, defaultResidualShape, decoder, coarseCells,
                          fine);
}

Result<void> decodeEntropy(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                           int coarseCells, std::span<std::int16_t> fine) {
    if (coded.size() < passCount) return badInput("height block: coded data ends early");
    RefinementPredictor predictor(coarseCells);
    predictor.setCoarse(coarse);
    ResidualDecoder decoder(coded.subspan(passCount));
    for (std::size_t i = 0; i < passCount; ++i) {
        const PassChoice choice = fromByte(coded[i]);
        if (decoder.failed() ||
            !decodePass(predictor, allRefinementPasses[i], choice, decoder, coarseCells, fine))
            return badInput("height block: coded data ends early or is damaged");
    }
    if (!decoder.ended())
        return badInput("height block: coded data is damaged or continues after the last sample");
    return {};
}

template <class Sample>
void copyCoarse(std::span<const Sample> coarse, int coarseCells, std::span<Sample> fine) {
    const auto side = static_cast<std::size_t>(coarseCells) + 1;
    const std::size_t fineSide = 2 * side - 1;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) fine[2 * y * fineSide + 2 * x] = coarse[y * side + x];
}

using Short = std::numeric_limits<std::int16_t>;

// Says how steps become 16-bit samples: (step >> shift) - base.
struct Narrowing {
    int shift = 0;
    std::int32_t base = 0;

    bool fits(std::int32_t step) const {
        const std::int32_t sample = (step >> shift) - base;
        return sample >= Short::min() && sample <= Short::max();
    }
};

// Returns the narrowing of a block by its coarse grid: without a base if the grid needs none. Nothing if its range
// exceeds 16 bits.
std::optional<Narrowing> narrowingOf(const StepsView& coarse, int shift) {
    const auto [lowestStep, highestStep] = lowestAndHighest(coarse);
    const std::int32_t lowest = lowestStep >> shift;
    const std::int32_t highest = highestStep >> shift;
    if (highest - lowest > Short::max() - Short::min()) return std::nullopt;
    const bool needsNone = lowest >= Short::min() && highest <= Short::max();
    return Narrowing{shift, needsNone ? 0 : lowest + (highest - lowest) / 2};
}

std::vector<std::int16_t> narrowed(const StepsView& steps, const Narrowing& narrowing) {
    std::vector<std::int16_t> samples(steps.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<std::int16_t>((steps[i] >> narrowing.shift) - narrowing.base);
    return samples;
}

// Returns whether a storage is one of 16-bit samples.
bool isNarrow(int storage) {
    return storage == static_cast<int>(Storage::Plain) || storage == static_cast<int>(Storage::Entropy) ||
           storage == static_cast<int>(Storage::Fitted) || storage == static_cast<int>(Storage::Level);
}

Result<void> decodeLevel(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                         std::span<std::int16_t> fine) {
    if (!coded.empty())
        return badInput(fmt::format("height block: {} bytes of level samples; expected 0", coded.size()));
    if (!std::ranges::all_of(coarse, [&](std::int16_t sample) { return sample == coarse.front(); }))
        return badInput("height block: its samples are level, but those of its parent are not");
    std::ranges::fill(fine, coarse.front());
    return {};
}

Result<void> decodeNarrow(Storage storage, std::span<const std::byte> coded,
                          std::span<const std::int16_t> coarse, int coarseCells,
                          std::span<std::int16_t> fine) {
    if (storage == Storage::Level) return decodeLevel(coded, coarse, fine);
    copyCoarse(coarse, coarseCells, fine);
    if (storage == Storage::Plain) return decodePlain(coded, coarseCells, fine);
    if (storage == Storage::Fitted) return decodeFitted(coded, coarse, coarseCells, fine);
    return decodeEntropy(coded, coarse, coarseCells, fine);
}

bool areValid(std::pair<std::int32_t, std::int32_t> extremes, int fractionBits) {
    return extremes.first >= lowestStepOf(fractionBits) && extremes.second <= highestStepOf(fractionBits);
}

Result<Steps> decodeWide(std::span<const std::byte> coded, const StepsView& coarse, int coarseCells,
                         int fractionBits) {
    std::vector<std::int32_t> fine(gridSamples(2 * coarseCells));
    copyCoarse<std::int32_t>(coarse.toVector(), coarseCells, fine);
    TRY(decodePlain<std::int32_t>(coded, coarseCells, fine));
    if (!areValid(lowestAndHighest(fine), fractionBits))
        return badInput("height block: a height is out of the range of steps");
    return Steps(std::span<const std::int32_t>(fine));
}

}  // namespace

int sharedShift(const StepsView& steps, int fractionBits) {
    if (fractionBits == 0) return 0;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) bits |= static_cast<std::uint32_t>(steps[i]);
    return std::min(std::countr_zero(bits), fractionBits);
}

namespace {

// --- The low bits of split blocks

// Returns the widths for the low bits of a row: none are expected where all coarse samples around have none. coarse: the
// coarse grid.
void lowWidths(const StepsView& coarse, int coarseCells, RefinementPass pass, int row, int bits,
               std::span<std::uint8_t> widths) {
    const PassLayout layout = passLayouts[static_cast<std::size_t>(pass)];
    const auto side = static_cast<std::size_t>(coarseCells) + 1;
    const std::int32_t mask = (1 << bits) - 1;
    // Evenly spread numbers of these bits are a quarter of their range away from its middle.
    const auto spread = static_cast<std::uint8_t>(residualWidthOfOne + 4 * std::max(bits - 2, 0));
    const auto south = static_cast<std::size_t>(row);
    const std::size_t north = south + static_cast<std::size_t>(layout.firstRow);
    for (std::size_t x = 0; x < widths.size(); ++x) {
        const std::size_t east = x + static_cast<std::size_t>(layout.firstColumn);
        const std::int32_t around = coarse[south * side + x] | coarse[south * side + east] |
                                    coarse[north * side + x] | coarse[north * side + east];
        widths[x] = (around & mask) == 0 ? std::uint8_t{0} : spread;
    }
}

// The middle of the range that low bits are coded relative to.
std::int32_t lowMiddle(std::uint8_t width, int bits) {
    return width == 0 ? 0 : 1 << (bits - 1);
}

void encodeLows(std::span<const std::int32_t> fine, const StepsView& coarse, int coarseCells, int bits,
                std::vector<std::byte>& out) {
    ResidualEncoder encoder(missingSamples(coarseCells));
    for (const RefinementPass pass : allRefinementPasses) {
        RowBuffers buffers(passColumns(pass, coarseCells));
        const std::span widths = buffers.widths();
        const std::span residuals = buffers.residuals();
        for (int row = 0; row < passRows(pass, coarseCells); ++row) {
            lowWidths(coarse, coarseCells, pass, row, bits, widths);
            const std::int32_t* const in = fine.data() + rowStart(pass, row, coarseCells);
            for (std::size_t x = 0; x < widths.size(); ++x)
                residuals[x] =
                    static_cast<std::int16_t>((in[2 * x] & ((1 << bits) - 1)) - lowMiddle(widths[x], bits));
            encoder.addRow(residuals, widths);
        }
    }
    encoder.finish(out);
}

// Adds the low bits to fine samples without them.
Result<void> decodeLows(std::span<const std::byte> coded, const StepsView& coarse, int coarseCells, int bits,
                        std::span<std::int32_t> fine) {
    ResidualDecoder decoder(coded);
    const std::int32_t mask = (1 << bits) - 1;
    for (const RefinementPass pass : allRefinementPasses) {
        RowBuffers buffers(passColumns(pass, coarseCells));
        const std::span widths = buffers.widths();
        const std::span residuals = buffers.residuals();
        for (int row = 0; row < passRows(pass, coarseCells); ++row) {
            lowWidths(coarse, coarseCells, pass, row, bits, widths);
            if (decoder.failed()) return badInput("height block: its low bits end early");
            decoder.readRow(widths, residuals);
            std::int32_t* const out = fine.data() + rowStart(pass, row, coarseCells);
            for (std::size_t x = 0; x < widths.size(); ++x)
                out[2 * x] += (residuals[x] + lowMiddle(widths[x], bits)) & mask;
        }
    }
    if (decoder.failed() || !decoder.ended())
        return badInput("height block: its low bits end early or continue after the last sample");
    return {};
}

void encodeNarrow(std::span<const std::int16_t> samples, int coarseCells, int compressionLevel, int shift,
                  std::vector<std::byte>& out) {
    const std::size_t before = out.size();
    if (compressionLevel > minCompressionLevel) {
        if (std::ranges::all_of(samples, [&](std::int16_t sample) { return sample == samples.front(); })) {
            out.push_back(firstByte(Storage::Level, shift));
            return;
        }
        encodeEntropy(samples, coarseCells, compressionLevel, shift, out);
        if (compressionLevel == maxCompressionLevel && coarseCells >= minFittedCells) {
            std::vector<std::byte> fitted = {firstByte(Storage::Fitted, shift)};
            encodeFitted(samples, coarseCells, fitted);
            if (fitted.size() < out.size() - before) {
                out.resize(before);
                out.insert(out.end(), fitted.begin(), fitted.end());
            }
        }
        if (out.size() - before <= 1 + 2 * missingSamples(coarseCells)) return;
        out.resize(before);
    }
    encodePlain<std::int16_t>(Storage::Plain, samples, coarseCells, shift, out);
}

// Returns the narrowing of a block; nothing if its samples do not fit into 16 bits.
std::optional<Narrowing> narrowingOf(std::span<const std::int32_t> fine, const StepsView& coarse, int shift) {
    const auto narrowing = narrowingOf(coarse, shift);
    const bool isGood =
        narrowing && std::ranges::all_of(fine, [&](std::int32_t step) { return narrowing->fits(step); });
    return isGood ? narrowing : std::nullopt;
}

// Returns whether splitting a block may be worth it: it is neither coarse nor fine everywhere.
bool isMixed(std::span<const std::int32_t> fine, int fractionBits) {
    const std::int32_t mask = (1 << fractionBits) - 1;
    const auto coarse = std::ranges::count_if(fine, [&](std::int32_t step) { return (step & mask) == 0; });
    return static_cast<std::size_t>(coarse) > fine.size() / 8;
}

// Codes a block split. Nothing if the samples do not fit into 16 bits without their low bits.
std::vector<std::byte> splitBlock(std::span<const std::int32_t> fine, const StepsView& coarse,
                                  int coarseCells, int compressionLevel, int fractionBits) {
    const auto narrowing = narrowingOf(fine, coarse, fractionBits);
    if (!narrowing) return {};
    std::vector<std::byte> high;
    encodeNarrow(narrowed(fine, *narrowing), coarseCells, compressionLevel, 0, high);
    std::vector<std::byte> block = {firstByte(Storage::Split, fractionBits)};
    ByteWriter(block).put(static_cast<std::uint32_t>(high.size()));
    block.insert(block.end(), high.begin(), high.end());
    encodeLows(fine, coarse, coarseCells, fractionBits, block);
    return block;
}

Result<Steps> decodeSplit(std::span<const std::byte> coded, const StepsView& coarse, int coarseCells,
                          int fractionBits) {
    ByteReader reader(coded);
    if (reader.rest().size() < sizeof(std::uint32_t)) return badInput("height block: coded data ends early");
    const auto length = reader.get<std::uint32_t>();
    if (length == 0 || length > reader.rest().size())
        return badInput(fmt::format("height block: {} bytes of high bits; expected [1, {}]", length,
                                    reader.rest().size()));
    const auto high = reader.take(length);
    const int storage = std::to_integer<int>(high[0]);
    if (!isNarrow(storage))
        return badInput(
            fmt::format("height block: unknown storage {} of high bits; expected 0, 1, 4 or 5", storage));
    const auto narrowing = narrowingOf(coarse, fractionBits);
    if (!narrowing) return badInput("height block: the heights of its parent exceed 16 bits");
    std::vector<std::int16_t> samples(gridSamples(2 * coarseCells));
    TRY(decodeNarrow(static_cast<Storage>(storage), high.subspan(1), narrowed(coarse, *narrowing),
                     coarseCells, samples));
    std::vector<std::int32_t> fine(samples.size());
    // Unsigned, because a hostile sample may be far out of range.
    for (std::size_t i = 0; i < fine.size(); ++i)
        fine[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(samples[i] + narrowing->base)
                                            << fractionBits);
    TRY(decodeLows(reader.rest(), coarse, coarseCells, fractionBits, fine));
    copyCoarse<std::int32_t>(coarse.toVector(), coarseCells, fine);
    if (!areValid(lowestAndHighest(fine), fractionBits))
        return badInput("height block: a height is out of the range of steps");
    return Steps(std::span<const std::int32_t>(fine));
}

}  // namespace

void encodeRefinement(std::span<const std::int32_t> fine, int coarseCells, int compressionLevel,
                      int fractionBits, std::vector<std::byte>& out) {
    assert(coarseCells >= 1 && coarseCells <= maxCoarseCells);
    assert(compressionLevel >= minCompressionLevel && compressionLevel <= maxCompressionLevel);
    assert(fine.size() == gridSamples(2 * coarseCells));
    const std::vector<std::int32_t> coarse = thinned(fine, 2 * coarseCells + 1, coarseCells + 1, 2);
    const int shift = sharedShift(fine, fractionBits);
    const std::size_t before = out.size();
    const auto narrowing = narrowingOf(fine, coarse, shift);
    if (narrowing)
        encodeNarrow(narrowed(fine, *narrowing), coarseCells, compressionLevel, shift, out);
    else
        encodePlain(Storage::Wide, fine, coarseCells, 0, out);
    const bool maySplit = shift < fractionBits && compressionLevel > minCompressionLevel;
    if (!maySplit || (narrowing && !isMixed(fine, fractionBits))) return;
    const auto split = splitBlock(fine, coarse, coarseCells, compressionLevel, fractionBits);
    if (split.empty() || split.size() >= out.size() - before) return;
    out.resize(before);
    out.insert(out.end(), split.begin(), split.end());
}

Result<Steps> decodeRefinement(std::span<const std::byte> coded, const StepsView& coarse, int coarseCells,
                               int fractionBits) {
    assert(coarseCells >= 1 && coarseCells <= maxCoarseCells);
    assert(coarse.size() == gridSamples(coarseCells));
    if (coded.empty()) return badInput("height block: coded data is empty");
    const int first = std::to_integer<int>(coded[0]);
    const int shift = first >> storageBits;
    const int storage = first & ((1 << storageBits) - 1);
    const bool isWide = storage == static_cast<int>(Storage::Wide);
    const bool isSplit = storage == static_cast<int>(Storage::Split);
    if (!isNarrow(storage) && !(fractionBits > 0 && (isWide || isSplit)))
        return badInput(fmt::format("height block: unknown storage {}; expected {}", storage,
                                    fractionBits > 0 ? "[0, 5]" : "0, 1, 4 or 5"));
    const int leastShift = isSplit ? fractionBits : 0;
    const int mostShift = isWide ? 0 : fractionBits;
    if (shift < leastShift || shift > mostShift)
        return badInput(
            fmt::format("height block: shift {}; expected [{}, {}]", shift, leastShift, mostShift));
    if (isSplit) return decodeSplit(coded.subspan(1), coarse, coarseCells, fractionBits);
    if (isWide) return decodeWide(coded.subspan(1), coarse, coarseCells, fractionBits);
    std::vector<std::int16_t> fine(gridSamples(2 * coarseCells));
    const auto decode = [&](std::span<const std::int16_t> known) {
        return decodeNarrow(static_cast<Storage>(storage), coded.subspan(1), known, coarseCells, fine);
    };
    // Without fractions, all heights are samples themselves.
    if (const auto plain = coarse.plain(); fractionBits == 0 && !plain.empty()) {
        TRY(decode(plain));
        return Steps(fine);
    }
    if (sharedShift(coarse, shift) < shift)
        return badInput(
            fmt::format("height block: shift {}, but not all heights of its parent are multiples "
                        "of 2^{}",
                        shift, shift));
    const auto narrowing = narrowingOf(coarse, shift);
    if (!narrowing) return badInput("height block: the heights of its parent exceed 16 bits");
    TRY(decode(narrowed(coarse, *narrowing)));
    Steps steps(fine, narrowing->base << shift, 1 << shift);
    if (!areValid(lowestAndHighest(steps), fractionBits))
        return badInput("height block: a height is out of the range of steps");
    return steps;
}

namespace {

// A coded grid has its four corners, followed by the refinements from a grid of one cell upwards, each after
// its length (u32).
// Returns the bytes of a corner: 16 bits hold any step without fractions.
std::size_t cornerBytes(int fractionBits) {
    return fractionBits == 0 ? sizeof(std::int16_t) : sizeof(std::int32_t);
}

[[maybe_unused]] bool isGridSize(int size) {
    return size >= 2 && size <= maxGridSize && std::has_single_bit(static_cast<unsigned>(size - 1));
}

}  // namespace

void encodeGrid(std::span<const std::int32_t> grid, int size, int fractionBits, std::vector<std::byte>& out) {
    assert(isGridSize(size) && grid.size() == gridSamples(size - 1));
    ByteWriter writer(out);
    for (const std::int32_t corner : thinned(grid, size, 2, size - 1)) {
        if (fractionBits == 0)
            writer.put(static_cast<std::int16_t>(corner));
        else
            writer.put(corner);
    }
    for (int cells = 1; cells < size - 1; cells *= 2) {
        std::vector<std::byte> coded;
        encodeRefinement(thinned(grid, size, 2 * cells + 1, (size - 1) / (2 * cells)), cells,
                         maxCompressionLevel, fractionBits, coded);
        writer.put(static_cast<std::uint32_t>(coded.size()));
        out.insert(out.end(), coded.begin(), coded.end());
    }
}

Result<Steps> decodeGrid(std::span<const std::byte> coded, int size, int fractionBits) {
    assert(isGridSize(size));
    const auto endsEarly = [] { return badInput("height block: coded data ends early"); };
    if (coded.size() < 4 * cornerBytes(fractionBits)) return endsEarly();
    ByteReader reader(coded);
    std::vector<std::int32_t> corners;
    for (int corner = 0; corner < 4; ++corner) {
        corners.push_back(fractionBits == 0 ? std::int32_t{reader.get<std::int16_t>()}
                                            : reader.get<std::int32_t>());
    }
    if (!areValid(lowestAndHighest(corners), fractionBits))
        return badInput("height block: a height is out of the range of steps");
    Steps steps{std::span<const std::int32_t>(corners)};
    for (int cells = 1; cells < size - 1; cells *= 2) {
        if (reader.rest().size() < sizeof(std::uint32_t)) return endsEarly();
        const auto length = reader.get<std::uint32_t>();
        if (reader.rest().size() < length) return endsEarly();
        TRY_ASSIGN(steps, decodeRefinement(reader.take(length), steps, cells, fractionBits));
    }
    if (const std::size_t left = reader.rest().size(); left > 0)
        return badInput(fmt::format("height block: {} bytes left over after its last sample", left));
    return steps;
}

}  // namespace planet
