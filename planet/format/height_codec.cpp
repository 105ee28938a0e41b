#include "planet/format/height_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/format/height_prediction.h"
#include "planet/format/height_residual_coder.h"

namespace planet {

namespace {

// The first byte of a coded refinement. Plain: the missing samples follow uncoded, row by row of each pass.
// Entropy: one byte per pass (PassChoice) follows, then the output of ResidualEncoder.
enum class Storage : std::uint8_t { Plain, Entropy };

constexpr std::size_t passCount = allRefinementPasses.size();

// The low 3 bits of a pass's byte are the predictor; the bits above are the shift of all widths plus
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

// The position of a pass's first sample in the fine grid.
struct PassLayout {
    int firstRow;
    int firstColumn;
};

constexpr std::array<PassLayout, passCount> passLayouts = {{{1, 1}, {1, 0}, {0, 1}}};

// Returns the index in the fine grid of the first sample of a pass's row; the row's samples are every other
// one.
std::size_t rowStart(RefinementPass pass, int row, int coarseCells) {
    const PassLayout layout = passLayouts[static_cast<std::size_t>(pass)];
    return static_cast<std::size_t>((layout.firstRow + 2 * row) * (2 * coarseCells + 1) + layout.firstColumn);
}

// Computes widths from the exponent and two bits of the mantissa of the expected errors: their logarithms in
// quarter octaves. Width 0 means that no error is expected.
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

// The residuals and expected errors of one pass under one predictor.
struct CodedPass {
    std::vector<std::int16_t> residuals;
    std::vector<float> expected256;
};

// Memory for one row of a pass.
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

// Returns the cost of a pass with a width shift, in 1/256 bit, estimated from every step-th sample.
std::int64_t costOf(const CodedPass& coded, int widthShift, std::size_t step) {
    std::int64_t cost = 0;
    for (std::size_t i = 0; i < coded.residuals.size(); i += step) {
        std::uint8_t width = 0;
        toWidths(std::span(&coded.expected256[i], 1), widthShift, std::span(&width, 1));
        cost += residualCost(width, coded.residuals[i]);
    }
    return cost;
}

// The effort of a compression level above 0.
struct Effort {
    int predictors;    // number of predictors to try
    std::size_t step;  // costs use every step-th sample
};

Effort effortOf(int compressionLevel) {
    constexpr std::array<Effort, maxCompressionLevel> efforts = {{{1, 8}, {4, 8}, {8, 1}}};
    return efforts[static_cast<std::size_t>(compressionLevel - 1)];
}

// Descends from a shift to the minimum of the cost, which is unique.
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
    toWidths(coded.expected256, widthShift, widths);
    for (std::size_t i = 0; i < widths.size(); i += columns)
        encoder.addRow(std::span(coded.residuals).subspan(i, columns), std::span(widths).subspan(i, columns));
}

// Returns every step-th row and column of a grid.
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

void encodePlain(std::span<const std::int16_t> fine, int coarseCells, std::vector<std::byte>& out) {
    out.push_back(static_cast<std::byte>(Storage::Plain));
    ByteWriter writer(out);
    forEachMissing(coarseCells, [&](std::size_t index) { writer.put(fine[index]); });
}

Result<void> decodePlain(std::span<const std::byte> coded, int coarseCells, std::span<std::int16_t> fine) {
    const std::size_t wanted = 2 * missingSamples(coarseCells);
    if (coded.size() != wanted)
        return badInput(
            fmt::format("height block: {} bytes of plain samples; expected {}", coded.size(), wanted));
    ByteReader reader(coded);
    forEachMissing(coarseCells, [&](std::size_t index) { fine[index] = reader.get<std::int16_t>(); });
    return {};
}

// Decodes one pass; returns false if the bytes end early.
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

// A coded grid has its four corners, followed by the refinements from a grid of one cell upwards, each after
// its length (u32).
constexpr std::size_t cornerBytes = 4 * sizeof(std::int16_t);

[[maybe_unused]] bool isGridSize(int size) {
    return size >= 2 && size <= maxGridSize && std::has_single_bit(static_cast<unsigned>(size - 1));
}

}  // namespace

void encodeGrid(std::span<const std::int16_t> grid, int size, std::vector<std::byte>& out) {
    assert(isGridSize(size) && grid.size() == gridSamples(size - 1));
    ByteWriter writer(out);
    for (const std::int16_t corner : thinned(grid, size, size - 1)) writer.put(corner);
    for (int cells = 1; cells < size - 1; cells *= 2) {
        std::vector<std::byte> coded;
        encodeRefinement(thinned(grid, size, (size - 1) / (2 * cells)), cells, maxCompressionLevel, coded);
        writer.put(static_cast<std::uint32_t>(coded.size()));
        out.insert(out.end(), coded.begin(), coded.end());
    }
}

Result<void> decodeGrid(std::span<const std::byte> coded, int size, std::span<std::int16_t> grid) {
    assert(isGridSize(size) && grid.size() == gridSamples(size - 1));
    const auto endsEarly = [] { return badInput("height block: coded data ends early"); };
    if (coded.size() < cornerBytes) return endsEarly();
    ByteReader reader(coded);
    std::vector<std::int16_t> coarse;
    for (int corner = 0; corner < 4; ++corner) coarse.push_back(reader.get<std::int16_t>());
    for (int cells = 1; cells < size - 1; cells *= 2) {
        if (reader.rest().size() < sizeof(std::uint32_t)) return endsEarly();
        const auto length = reader.get<std::uint32_t>();
        if (reader.rest().size() < length) return endsEarly();
        std::vector<std::int16_t> fine(gridSamples(2 * cells));
        TRY(decodeRefinement(reader.take(length), coarse, cells, fine));
        coarse = std::move(fine);
    }
    if (const std::size_t left = reader.rest().size(); left > 0)
        return badInput(fmt::format("height block: {} bytes left over after its last sample", left));
    std::ranges::copy(coarse, grid.begin());
    return {};
}

}  // namespace planet
