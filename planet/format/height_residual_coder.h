// Entropy coding of the height codec's residuals: a range variant of asymmetric numeral systems (Duda,
// "Asymmetric numeral systems", arXiv:1311.2540) over a fixed family of distributions, with two interleaved
// states.
//
// Small codes may have one state, which saves about 12 bytes and is decoded more slowly.
//
// Only the residuals are coded. The distribution of each one follows from a width that both sides compute
// from known data. A width step is a quarter octave of the expected |residual|. The distributions are
// Student's t, whose tails fit terrain, as integer frequencies. Its degrees of freedom are the shape. They are computed
// once, with only IEEE additions, multiplications and divisions, so they are the same on every machine.
//
// Residuals are taken modulo 2^16.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace planet {

// The number of widths. residualWidthOfOne expects |residual| near 1; each step is a quarter octave.
inline constexpr int residualWidthCount = 84;
inline constexpr int residualWidthOfOne = 24;

// The shapes of the distributions: Student's t with 3, 5, 9 and 29 degrees of freedom. The first one fits what is level in
// parts, and the others suit rough ground.
inline constexpr int residualShapeCount = 4;
inline constexpr int defaultResidualShape = 0;

// Returns the cost of residuals under their widths, in 1/256 bit, for choosing between codings.
std::int64_t residualsCost(std::span<const std::int16_t> residuals, std::span<const std::uint8_t> widths,
                           int shape = defaultResidualShape);

// Computes widths from expected errors in 1/256: their logarithms in quarter octaves, plus a shift. Width 0 means that no
// error is expected.
void residualWidths(std::span<const float> expected256, int widthShift, std::span<std::uint8_t> widths);

// Collects residuals in the order of the decoder.
class ResidualEncoder {
public:
    // states: 1 or 2, as of the decoder.
    explicit ResidualEncoder(std::size_t expectedResiduals, int states = 2) : states_(states) {
        tokens_.reserve(expectedResiduals);
    }

    // Adds one row, which the decoder must read as one row of the same shape. widths: [0, residualWidthCount).
    void addRow(std::span<const std::int16_t> residuals, std::span<const std::uint8_t> widths,
                int shape = defaultResidualShape);
    // Codes all rows and appends the bytes.
    void finish(std::vector<std::byte>& out) const;

private:
    struct Token {
        std::uint16_t start;      // of the symbol's interval, in 1/4096
        std::uint16_t frequency;  // the interval's length, > 0
        std::uint16_t rawBits;    // uncoded low bits after the symbol
        std::uint8_t rawBitCount;
        std::uint8_t state;  // 0 or 1
    };
    int states_;
    std::vector<Token> tokens_;
};

struct ResidualDistribution;

// Decodes the bytes of ResidualEncoder. Malicious bytes cause a failure or wrong residuals, never a read out
// of bounds.
class ResidualDecoder {
public:
    explicit ResidualDecoder(std::span<const std::byte> coded, int states = 2);

    // shape: [0, residualShapeCount).
    void readRow(std::span<const std::uint8_t> widths, std::span<std::int16_t> residuals,
                 int shape = defaultResidualShape);

    // Returns whether the bytes ended too early or began with an invalid state. The residuals are meaningless
    // then.
    bool failed() const { return failed_; }
    // Returns whether all bytes are used and both states equal the encoder's initial ones.
    bool ended() const;

private:
    template <bool MayEnd>
    std::int16_t readOne(const ResidualDistribution* shape, std::uint64_t& state, int widthIndex);
    template <bool MayEnd, int stateCount>
    void readRowAs(const ResidualDistribution* shape, std::span<const std::uint8_t> widths,
                   std::span<std::int16_t> residuals);

    void refillNearEnd(std::uint64_t& state);

    const std::byte* next_;
    const std::byte* end_;
    int stateCount_;
    std::uint64_t states_[2];
    bool failed_ = false;
};

}  // namespace planet
