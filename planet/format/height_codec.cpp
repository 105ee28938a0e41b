#include "planet/format/height_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "planet/format/height_prediction.h"
#include "planet/format/height_residual_coder.h"

namespace planet {

namespace {

// A coded refinement begins with one of these in a byte. Plain: the missing samples as they are, row by row
// of each pass. Entropy: a byte a pass (PassChoice), then what ResidualEncoder wrote.
enum class Storage : std::uint8_t { Plain, Entropy };

constexpr std::size_t passCount = allRefinementPasses.size();

// How a pass is coded: predictor in the low 3 bits; above them, what is added to every width, plus
// widthShiftBias.
constexpr int predictorBits = 3;
constexpr int widthShiftBias = 23;
constexpr int minWidthShift = -23;
constexpr int maxWidthShift = 8;

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

std::size_t gridSamples(int cells) {
    const auto side = static_cast<std::size_t>(cells) + 1;
    return side * side;
}

std::size_t missingSamples(int coarseCells) {
    return gridSamples(2 * coarseCells) - gridSamples(coarseCells);
}

// Where a pass's samples lie in the fine grid.
struct PassLayout {
    int firstRow;
    int firstColumn;
};

PassLayout layoutOf(RefinementPass pass) {
    switch (pass) {
        case RefinementPass::Middle:
            return {1, 1};
        case RefinementPass::OddRow:
            return {1, 0};
        case RefinementPass::OddColumn:
            break;
    }
    return {0, 1};
}

// The first sample of a pass's row in the fine grid; the next ones are every other from there.
std::size_t rowStart(RefinementPass pass, int row, int coarseCells) {
    const PassLayout layout = layoutOf(pass);
    return static_cast<std::size_t>((layout.firstRow + 2 * row) * (2 * coarseCells + 1) + layout.firstColumn);
}

// Widths are the exponent and two bits of the mantissa of the expected error: its logarithm in quarter
// octaves. Width 0 is kept for where no error at all is expected.
void toWidths(std::span<const float> expected256, int widthShift, std::span<std::uint8_t> widths) {
    constexpr int mantissaBits = 23;
    constexpr int widthOf256 = (127 + 8) << 2;
    const int shift = residualWidthOfOne - widthOf256 + widthShift;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const auto bits = std::bit_cast<std::int32_t>(expected256[i]);
        const int width = std::clamp((bits >> (mantissaBits - 2)) + shift, 1, residualWidthCount - 1);
        widths[i] = static_cast<std::uint8_t>(bits == 0 ? 0 : width);
    }
}

// Residuals and expected errors of one pass under one predictor.
struct CodedPass {
    std::vector<std::int16_t> residuals;
    std::vector<float> expected256;
};

// Scratch for one row, as long as the longest and cut to the pass's own.
class RowBuffers {
public:
    explicit RowBuffers(int columns) : columns_(static_cast<std::size_t>(columns)) {}

    std::span<std::int16_t> predicted() { return std::span(predicted_).first(columns_); }
    std::span<float> expected256() { return std::span(expected256_).first(columns_); }
    std::span<std::uint8_t> widths() { return std::span(widths_).first(columns_); }
    std::span<std::int16_t> residuals() { return std::span(residuals_).first(columns_); }
    std::span<std::int16_t> samples() { return std::span(samples_).first(columns_); }

private:
    std::size_t columns_;
    std::array<std::int16_t, maxCoarseCells + 1> predicted_;
    std::array<float, maxCoarseCells + 1> expected256_;
    std::array<std::uint8_t, maxCoarseCells + 1> widths_;
    std::array<std::int16_t, maxCoarseCells + 1> residuals_;
    std::array<std::int16_t, maxCoarseCells + 1> samples_;
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

// What a pass costs with a width shift, in 1/256 bit, from every step-th sample.
std::int64_t costOf(const CodedPass& coded, int widthShift, std::size_t step) {
    std::int64_t cost = 0;
    for (std::size_t i = 0; i < coded.residuals.size(); i += step) {
        std::uint8_t width = 0;
        toWidths(std::span(&coded.expected256[i], 1), widthShift, std::span(&width, 1));
        cost += residualCost(width, coded.residuals[i]);
    }
    return cost;
}

// What a compression level above 0 spends.
struct Effort {
    int predictors;    // how many of a pass's predictors are tried
    std::size_t step;  // costs are counted on every step-th sample
};

Effort effortOf(int compressionLevel) {
    constexpr std::array<Effort, maxCompressionLevel> efforts = {{{1, 8}, {4, 8}, {8, 1}}};
    return efforts[static_cast<std::size_t>(compressionLevel - 1)];
}

// Walks downhill from a shift: the cost has one valley.
std::int64_t bestShift(const CodedPass& coded, std::size_t step, int& widthShift) {
    std::int64_t best = costOf(coded, widthShift, step);
    for (const int direction : {-1, 1}) {
        const int before = widthShift;
        while (widthShift + direction >= minWidthShift && widthShift + direction <= maxWidthShift) {
            const std::int64_t cost = costOf(coded, widthShift + direction, step);
            if (cost >= best) break;
            best = cost;
            widthShift += direction;
        }
        if (widthShift != before) break;
    }
    return best;
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
        const std::int64_t cost = bestShift(coded, effort.step, shift);
        if (cost < least) {
            least = cost;
            chosen = {{candidate, shift}, std::move(coded)};
        }
    }
    // The next pass looks at this one's errors: they must be those of the choice.
    const auto columns = static_cast<std::size_t>(passColumns(pass, coarseCells));
    for (int row = 0; row < passRows(pass, coarseCells); ++row) {
        const std::size_t start = static_cast<std::size_t>(row) * columns;
        predictor.setErrors(row, std::span(chosen.coded.residuals).subspan(start, columns));
    }
    return chosen;
}

void addPass(const CodedPass& coded, std::size_t columns, int widthShift, ResidualEncoder& encoder) {
    std::vector<std::uint8_t> widths(coded.residuals.size());
    toWidths(coded.expected256, widthShift, widths);
    for (std::size_t i = 0; i < widths.size(); i += columns)
        encoder.addRow(std::span(coded.residuals).subspan(i, columns), std::span(widths).subspan(i, columns));
}

// Every step-th row and column of a grid.
std::vector<std::int16_t> thinned(std::span<const std::int16_t> grid, int size, int step) {
    const auto side = static_cast<std::size_t>(size);
    const auto stride = static_cast<std::size_t>(step);
    std::vector<std::int16_t> samples;
    for (std::size_t y = 0; y < side; y += stride)
        for (std::size_t x = 0; x < side; x += stride) samples.push_back(grid[y * side + x]);
    return samples;
}

void encodeEntropy(std::span<const std::int16_t> fine, int coarseCells, int compressionLevel,
                   std::vector<std::byte>& out) {
    RefinementPredictor predictor(coarseCells);
    predictor.setCoarse(thinned(fine, 2 * coarseCells + 1, 2));
    ResidualEncoder encoder(missingSamples(coarseCells));
    out.push_back(static_cast<std::byte>(Storage::Entropy));
    for (const RefinementPass pass : allRefinementPasses) {
        const ChosenPass chosen = choosePass(predictor, pass, fine, coarseCells, effortOf(compressionLevel));
        out.push_back(toByte(chosen.choice));
        addPass(chosen.coded, static_cast<std::size_t>(passColumns(pass, coarseCells)),
                chosen.choice.widthShift, encoder);
    }
    encoder.finish(out);
}

void appendSample(std::int16_t sample, std::vector<std::byte>& out) {
    const auto bits = static_cast<std::uint16_t>(sample);
    out.push_back(static_cast<std::byte>(bits & 0xff));
    out.push_back(static_cast<std::byte>(bits >> 8));
}

std::int16_t sampleAt(std::span<const std::byte> bytes, std::size_t index) {
    const auto low = std::to_integer<unsigned>(bytes[2 * index]);
    const auto high = std::to_integer<unsigned>(bytes[2 * index + 1]);
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8));
}

// Visits the index into fine of every missing sample, in the order of Storage::Plain.
template <class Visit>
void forEachMissing(int coarseCells, const Visit& visit) {
    for (const RefinementPass pass : allRefinementPasses)
        for (int row = 0; row < passRows(pass, coarseCells); ++row) {
            const std::size_t start = rowStart(pass, row, coarseCells);
            for (int x = 0; x < passColumns(pass, coarseCells); ++x)
                visit(start + 2 * static_cast<std::size_t>(x));
        }
}

void encodePlain(std::span<const std::int16_t> fine, int coarseCells, std::vector<std::byte>& out) {
    out.push_back(static_cast<std::byte>(Storage::Plain));
    forEachMissing(coarseCells, [&](std::size_t index) { appendSample(fine[index], out); });
}

Result<void> decodePlain(std::span<const std::byte> coded, int coarseCells, std::span<std::int16_t> fine) {
    const std::size_t wanted = 2 * missingSamples(coarseCells);
    if (coded.size() != wanted)
        return badInput(
            fmt::format("height block: {} bytes of plain samples; expected {}", coded.size(), wanted));
    std::size_t next = 0;
    forEachMissing(coarseCells, [&](std::size_t index) { fine[index] = sampleAt(coded, next++); });
    return {};
}

// Decodes one pass; false where the bytes end early.
bool decodePass(RefinementPredictor& predictor, RefinementPass pass, PassChoice choice,
                ResidualDecoder& decoder, int coarseCells, std::span<std::int16_t> fine) {
    RowBuffers row(passColumns(pass, coarseCells));
    const std::span predicted = row.predicted();
    const std::span residuals = row.residuals();
    const std::span samples = row.samples();
    predictor.beginPass(pass, choice.predictor);
    for (int y = 0; y < passRows(pass, coarseCells); ++y) {
        predictor.predictRow(y, predicted);
        predictor.expectErrors(y, row.expected256());
        toWidths(row.expected256(), choice.widthShift, row.widths());
        decoder.readRow(row.widths(), residuals);
        if (decoder.failed()) return false;
        std::int16_t* const out = fine.data() + rowStart(pass, y, coarseCells);
        for (std::size_t x = 0; x < samples.size(); ++x) {
            samples[x] = static_cast<std::int16_t>(predicted[x] + residuals[x]);
            out[2 * x] = samples[x];
        }
        predictor.setErrors(y, residuals);
        predictor.setSamples(y, samples);
    }
    return true;
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

void copyCoarse(std::span<const std::int16_t> coarse, int coarseCells, std::span<std::int16_t> fine) {
    const auto side = static_cast<std::size_t>(coarseCells) + 1;
    const std::size_t fineSide = 2 * side - 1;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) fine[2 * y * fineSide + 2 * x] = coarse[y * side + x];
}

}  // namespace

void encodeRefinement(std::span<const std::int16_t> fine, int coarseCells, int compressionLevel,
                      std::vector<std::byte>& out) {
    assert(coarseCells >= 1 && coarseCells <= maxCoarseCells);
    assert(compressionLevel >= minCompressionLevel && compressionLevel <= maxCompressionLevel);
    assert(fine.size() == gridSamples(2 * coarseCells));
    const std::size_t before = out.size();
    if (compressionLevel > minCompressionLevel) {
        encodeEntropy(fine, coarseCells, compressionLevel, out);
        if (out.size() - before <= 1 + 2 * missingSamples(coarseCells)) return;
        out.resize(before);
    }
    encodePlain(fine, coarseCells, out);
}

Result<void> decodeRefinement(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                              int coarseCells, std::span<std::int16_t> fine) {
    assert(coarseCells >= 1 && coarseCells <= maxCoarseCells);
    assert(coarse.size() == gridSamples(coarseCells) && fine.size() == gridSamples(2 * coarseCells));
    if (coded.empty()) return badInput("height block: coded data is empty");
    copyCoarse(coarse, coarseCells, fine);
    const auto storage = std::to_integer<int>(coded[0]);
    switch (static_cast<Storage>(storage)) {
        case Storage::Plain:
            return decodePlain(coded.subspan(1), coarseCells, fine);
        case Storage::Entropy:
            return decodeEntropy(coded.subspan(1), coarse, coarseCells, fine);
    }
    return badInput(fmt::format("height block: unknown storage {}; expected 0 or 1", storage));
}

namespace {

// A coded grid: its four corners, then refinements from a coarse grid of one cell upwards, each behind its
// length.
constexpr std::size_t cornerBytes = 4 * sizeof(std::int16_t);
constexpr std::size_t lengthBytes = 4;

[[maybe_unused]] bool isGridSize(int size) {
    return size >= 2 && size <= maxGridSize && std::has_single_bit(static_cast<unsigned>(size - 1));
}

void writeLength(std::size_t length, std::span<std::byte> to) {
    for (std::size_t i = 0; i < lengthBytes; ++i) to[i] = static_cast<std::byte>(length >> (8 * i) & 0xff);
}

std::size_t readLength(std::span<const std::byte> from) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < lengthBytes; ++i) length |= std::to_integer<std::size_t>(from[i]) << (8 * i);
    return length;
}

}  // namespace

void encodeGrid(std::span<const std::int16_t> grid, int size, std::vector<std::byte>& out) {
    assert(isGridSize(size) && grid.size() == gridSamples(size - 1));
    for (const std::int16_t corner : thinned(grid, size, size - 1)) appendSample(corner, out);
    for (int cells = 1; cells < size - 1; cells *= 2) {
        const std::size_t lengthAt = out.size();
        out.resize(lengthAt + lengthBytes);
        encodeRefinement(thinned(grid, size, (size - 1) / (2 * cells)), cells, maxCompressionLevel, out);
        writeLength(out.size() - lengthAt - lengthBytes, std::span(out).subspan(lengthAt, lengthBytes));
    }
}

Result<void> decodeGrid(std::span<const std::byte> coded, int size, std::span<std::int16_t> grid) {
    assert(isGridSize(size) && grid.size() == gridSamples(size - 1));
    if (coded.size() < cornerBytes) return badInput("height block: coded data ends early");
    std::vector<std::int16_t> coarse;
    for (std::size_t i = 0; i < 4; ++i) coarse.push_back(sampleAt(coded, i));
    coded = coded.subspan(cornerBytes);
    for (int cells = 1; cells < size - 1; cells *= 2) {
        if (coded.size() < lengthBytes) return badInput("height block: coded data ends early");
        const std::size_t length = readLength(coded);
        coded = coded.subspan(lengthBytes);
        if (coded.size() < length) return badInput("height block: coded data ends early");
        std::vector<std::int16_t> fine(gridSamples(2 * cells));
        if (auto decoded = decodeRefinement(coded.first(length), coarse, cells, fine); !decoded)
            return decoded;
        coded = coded.subspan(length);
        coarse = std::move(fine);
    }
    if (!coded.empty())
        return badInput(fmt::format("height block: {} bytes left over after its last sample", coded.size()));
    std::ranges::copy(coarse, grid.begin());
    return {};
}

}  // namespace planet
