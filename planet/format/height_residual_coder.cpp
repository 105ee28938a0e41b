#include "planet/format/height_residual_coder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdlib>

#include "planet/base/cpu_clones.h"
#include "planet/base/little_endian.h"

namespace planet {

namespace {

constexpr int frequencyBits = 12;
constexpr std::uint32_t frequencyTotal = 1u << frequencyBits;

// Symbols are residuals in [-127, 127] shifted right by their width's raw bits. After the last symbol, the
// escape, the whole residual follows as 16 raw bits.
constexpr int symbolCount = 256;
constexpr int symbolOfZero = 127;
constexpr int escapeSymbol = 255;
constexpr int escapeRawBits = 16;

// Up to this width a residual is one symbol. Each octave above codes one more low bit raw, so that the four
// distributions of the last octave serve all wider ones.
constexpr int unshiftedWidths = residualWidthOfOne + 12;
constexpr int shiftedWidths = 4;
constexpr int distributionCount = unshiftedWidths + shiftedWidths;

// A state is in [stateMin, stateMin << 32) and is refilled by one 32-bit word. One residual consumes at most
// 12 + 16 bits, so one word is always enough.
constexpr std::uint64_t stateMin = std::uint64_t{1} << 28;
constexpr int wordBits = 32;
constexpr int stateBytes = 8;
// A coder with one state begins far below the range of states, which takes the fewest bytes: while its decoder has words
// left, it is never below. The start is above all frequencies, so that a decoder which runs out of words, and whose state then
// only shrinks, does not come to rest there. Its final state takes as few bytes as it can, but 5; their number follows from
// that of all bytes, because words have 4.
constexpr std::uint64_t loneStateStart = 4951;
constexpr std::size_t leastLoneStateBytes = 5;
constexpr int wordBytes = 4;

// Half of the degrees of freedom plus one half, of each shape: 3, 5, 9 and 29 degrees.
constexpr std::array<int, residualShapeCount> studentPowers = {2, 3, 5, 15};

constexpr std::size_t at(int index) {
    return static_cast<std::size_t>(index);
}

}  // namespace

struct ResidualDistribution {
    struct Interval {
        std::uint16_t start = 0;
        std::uint16_t frequency = 0;  // 0: the symbol is impossible
    };
    std::array<std::uint8_t, frequencyTotal> symbolOfSlot;
    std::array<Interval, symbolCount> intervals;
};

namespace {

using Interval = ResidualDistribution::Interval;
using Distribution = ResidualDistribution;

// Returns the density of Student's t with 2p - 1 degrees of freedom, up to a factor: (1 + t^2 / (2p - 1))^-p.
double studentDensity(double x, double width, int p) {
    const double t = x / width;
    const double base = 1 + t * t / (2 * p - 1);
    double power = 1;
    for (int i = 0; i < p; ++i) power *= base;
    return 1 / power;
}

// Returns the mass of [low, low + 1], by the midpoints of slices.
double studentMass(double low, double width, int p) {
    constexpr int slices = 8;
    double sum = 0;
    for (int i = 0; i < slices; ++i) sum += studentDensity(low + (i + 0.5) / slices, width, p);
    return sum / slices;
}

// Returns the mean |residual| of a width: quarter octaves, linear within each octave. Width 0 is much
// narrower, for places without errors so far.
double expectedMagnitude(int widthIndex) {
    if (widthIndex == 0) return 1.0 / 1024;
    const int octave = widthIndex / 4 - residualWidthOfOne / 4;
    const double mantissa = 1.125 + 0.25 * (widthIndex % 4);
    return octave >= 0 ? mantissa * (1 << octave) : mantissa / (1 << -octave);
}

// Returns integer frequencies for the masses: rounded, at least 1 for the escape, with the remainder added to
// symbolOfZero.
std::array<std::uint32_t, symbolCount> toFrequencies(const std::array<double, symbolCount>& masses,
                                                     double total) {
    std::array<std::uint32_t, symbolCount> frequencies{};
    std::uint32_t sum = 0;
    double inside = 0;
    for (int s = 0; s < escapeSymbol; ++s) {
        frequencies[at(s)] = static_cast<std::uint32_t>(masses[at(s)] / total * (frequencyTotal - 2) + 0.5);
        sum += frequencies[at(s)];
        if (frequencies[at(s)] > 0) inside += masses[at(s)];
    }
    frequencies[at(escapeSymbol)] =
        std::max(1u, static_cast<std::uint32_t>((total - inside) / total * frequencyTotal + 0.5));
    sum += frequencies[at(escapeSymbol)];
    frequencies[at(symbolOfZero)] = frequencies[at(symbolOfZero)] + frequencyTotal - sum;
    return frequencies;
}

// The mass of each symbol except the escape, their sum, and the mean |residual|.
struct Masses {
    std::array<double, symbolCount> mass{};
    double total = 0;
    double meanMagnitude = 0;
};

// Returns the masses; symbol s covers [s + lower, s + lower + 1) around zero.
Masses massesOf(double width, double lower, int p) {
    Masses masses;
    for (int s = 0; s < escapeSymbol; ++s) {
        const double low = s - symbolOfZero + lower;
        const double mass = studentMass(low, width, p);
        masses.mass[at(s)] = mass;
        masses.total += mass;
        masses.meanMagnitude += mass * std::abs(low + 0.5);
    }
    masses.meanMagnitude /= masses.total;
    return masses;
}

// Returns the masses of the width with a given mean magnitude, found with a factor that shrinks whenever it
// overshoots.
Masses massesOfMean(double meanMagnitude, double lower, int p) {
    double width = meanMagnitude;
    double factor = 4;
    Masses masses = massesOf(width, lower, p);
    for (int step = 0; step < 16; ++step) {
        const bool wider = masses.meanMagnitude < meanMagnitude;
        width = wider ? width * factor : width / factor;
        masses = massesOf(width, lower, p);
        const bool overshot = wider != (masses.meanMagnitude < meanMagnitude);
        if (overshot) factor = 1 + (factor - 1) * 0.4;
    }
    return masses;
}

Distribution makeDistribution(int index, int p) {
    const bool shifted = index >= unshiftedWidths;
    // Shifted by b bits, symbol s stands for the residuals [s 2^b, (s + 1) 2^b); unshifted, for residual s
    // alone.
    const Masses masses = shifted ? massesOfMean(expectedMagnitude(index - shiftedWidths), 0, p)
                                  : massesOfMean(expectedMagnitude(index), -0.5, p);
    const auto frequencies = toFrequencies(masses.mass, masses.total);
    Distribution distribution;
    std::uint32_t start = 0;
    for (int s = 0; s < symbolCount; ++s) {
        const std::uint32_t frequency = frequencies[at(s)];
        distribution.intervals[at(s)] = {static_cast<std::uint16_t>(start),
                                         static_cast<std::uint16_t>(frequency)};
        std::fill_n(distribution.symbolOfSlot.begin() + start, frequency, static_cast<std::uint8_t>(s));
        start += frequency;
    }
    assert(start == frequencyTotal);
    return distribution;
}

using Distributions = std::array<Distribution, distributionCount>;

template <int shape>
const Distributions& distributionsOfShape() {
    static const auto made = [] {
        Distributions all;
        for (int i = 0; i < distributionCount; ++i) all[at(i)] = makeDistribution(i, studentPowers[shape]);
        return all;
    }();
    return made;
}

// The distributions of a shape are made when it is first used.
const Distributions& distributions(int shape) {
    switch (shape) {
        case 0:
            return distributionsOfShape<0>();
        case 1:
            return distributionsOfShape<1>();
        case 2:
            return distributionsOfShape<2>();
        default:
            return distributionsOfShape<3>();
    }
}
static_assert(residualShapeCount == 4);

struct WidthCode {
    int distribution;
    int rawBitCount;
};

constexpr WidthCode codeOfWidth(int widthIndex) {
    if (widthIndex < unshiftedWidths) return {widthIndex, 0};
    const int above = widthIndex - unshiftedWidths;
    return {unshiftedWidths + above % shiftedWidths, 1 + above / shiftedWidths};
}

// Returns log2(value) in 1/256, rounded down; value > 0. Computes the fraction bit by bit by squaring.
int log2Times256(std::uint32_t value) {
    const int whole = static_cast<int>(std::bit_width(value)) - 1;
    std::uint64_t mantissa = (std::uint64_t{value} << 31) >> whole;  // in [2^31, 2^32)
    int fraction = 0;
    for (int bit = 0; bit < 8; ++bit) {
        mantissa = (mantissa * mantissa) >> 31;
        const bool carry = mantissa >> 32 != 0;
        fraction = 2 * fraction + (carry ? 1 : 0);
        if (carry) mantissa >>= 1;
    }
    return whole * 256 + fraction;
}

// How the encoder codes a symbol of a distribution: a symbol that is impossible is coded as the escape.
struct CodedSymbol {
    Interval interval;
    std::int16_t cost256 = 0;  // without raw bits
    bool isEscape = false;
};
using CodedSymbols = std::array<CodedSymbol, symbolCount>;

CodedSymbols codedSymbolsOf(const Distribution& distribution) {
    CodedSymbols symbols;
    for (int s = 0; s < symbolCount; ++s) {
        const bool isEscape = s == escapeSymbol || distribution.intervals[at(s)].frequency == 0;
        const Interval interval = distribution.intervals[at(isEscape ? escapeSymbol : s)];
        const int cost256 = frequencyBits * 256 - log2Times256(interval.frequency);
        symbols[at(s)] = {interval, static_cast<std::int16_t>(cost256), isEscape};
    }
    return symbols;
}

// Says how the encoder codes residuals of a shape under any width.
class Coding {
public:
    explicit Coding(int shape) {
        for (std::size_t i = 0; i < symbols_.size(); ++i)
            symbols_[i] = codedSymbolsOf(distributions(shape)[i]);
        for (int width = 0; width < residualWidthCount; ++width) {
            const WidthCode code = codeOfWidth(width);
            widths_[at(width)] = code;
            for (int s = 0; s < symbolCount; ++s) {
                const CodedSymbol& coded = symbols_[at(code.distribution)][at(s)];
                costs256_[at(width)][at(s)] = static_cast<std::int16_t>(
                    coded.cost256 + 256 * (coded.isEscape ? escapeRawBits : code.rawBitCount));
            }
        }
    }

    struct Code {
        const CodedSymbol& symbol;
        int rawBitCount;
    };
    Code codeOf(int widthIndex, int residual) const {
        const WidthCode width = widths_[at(widthIndex)];
        const CodedSymbol& coded = symbols_[at(width.distribution)][symbolOf(width, residual)];
        return {coded, coded.isEscape ? escapeRawBits : width.rawBitCount};
    }

    // Returns the cost in 1/256 bit, from a table of its own, which is small.
    int cost256(int widthIndex, int residual) const {
        return costs256_[at(widthIndex)][symbolOf(widths_[at(widthIndex)], residual)];
    }

private:
    // Residuals outside of the symbols become the escape: below them, the number wraps around.
    static unsigned symbolOf(const WidthCode& width, int residual) {
        const auto symbol = static_cast<unsigned>((residual >> width.rawBitCount) + symbolOfZero);
        return std::min(symbol, unsigned{escapeSymbol});
    }

    std::array<CodedSymbols, distributionCount> symbols_;
    std::array<WidthCode, residualWidthCount> widths_;
    std::array<std::array<std::int16_t, symbolCount>, residualWidthCount> costs256_;
};

template <int shape>
const Coding& codingOfShape() {
    static const Coding made(shape);
    return made;
}

const Coding& coding(int shape) {
    switch (shape) {
        case 0:
            return codingOfShape<0>();
        case 1:
            return codingOfShape<1>();
        case 2:
            return codingOfShape<2>();
        default:
            return codingOfShape<3>();
    }
}

// Divides by a frequency with a multiplication: x / f is the high half of 2 x m, shifted right by s. With s the number
// of bits of f - 1 and m = ceil(2^(63 + s) / f), that is exact for x < 2^62 (Granlund and Montgomery 1994).
struct Reciprocal {
    std::uint64_t multiplier = 0;
    int shift = 0;
};

__extension__ using Wide = unsigned __int128;

Reciprocal reciprocalOf(std::uint32_t frequency) {
    const int shift = static_cast<int>(std::bit_width(frequency - 1));
    const Wide dividend = Wide{1} << (63 + shift);
    return {static_cast<std::uint64_t>((dividend + frequency - 1) / frequency), shift};
}

const std::array<Reciprocal, frequencyTotal + 1>& reciprocals() {
    static const auto made = [] {
        std::array<Reciprocal, frequencyTotal + 1> all;
        for (std::uint32_t f = 1; f <= frequencyTotal; ++f) all[f] = reciprocalOf(f);
        return all;
    }();
    return made;
}

std::uint64_t dividedBy(const Reciprocal& reciprocal, std::uint64_t x) {
    return static_cast<std::uint64_t>((Wide{2 * x} * reciprocal.multiplier) >> 64) >> reciprocal.shift;
}

}  // namespace

std::int64_t residualsCost(std::span<const std::int16_t> residuals, std::span<const std::uint8_t> widths,
                           int shape) {
    assert(residuals.size() == widths.size());
    const Coding& all = coding(shape);
    std::int64_t cost256 = 0;
    for (std::size_t i = 0; i < residuals.size(); ++i) cost256 += all.cost256(widths[i], residuals[i]);
    return cost256;
}

// The exponent and two bits of the mantissa are a logarithm in quarter octaves.
PLANET_CPU_CLONES void residualWidths(std::span<const float> expected256, int widthShift,
                                      std::span<std::uint8_t> widths) {
    constexpr int mantissaBits = 23;
    constexpr int widthOf256 = (127 + 8) << 2;
    const int shift = residualWidthOfOne - widthOf256 + widthShift;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const auto bits = std::bit_cast<std::int32_t>(expected256[i]);
        const int width = std::clamp((bits >> (mantissaBits - 2)) + shift, 1, residualWidthCount - 1);
        widths[i] = static_cast<std::uint8_t>(bits == 0 ? 0 : width);
    }
}

void ResidualEncoder::addRow(std::span<const std::int16_t> residuals, std::span<const std::uint8_t> widths,
                             int shape) {
    assert(residuals.size() == widths.size());
    const Coding& all = coding(shape);
    const std::size_t before = tokens_.size();
    tokens_.resize(before + residuals.size());
    Token* const tokens = tokens_.data() + before;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        const Coding::Code code = all.codeOf(widths[i], residuals[i]);
        const int mask = (1 << code.rawBitCount) - 1;
        tokens[i] = {code.symbol.interval.start, code.symbol.interval.frequency,
                     static_cast<std::uint16_t>(residuals[i] & mask),
                     static_cast<std::uint8_t>(code.rawBitCount),
                     static_cast<std::uint8_t>(states_ == 2 ? i & 1 : 0)};
    }
}

// The coder is last in, first out: the states process the tokens backwards, and their words are written
// backwards.
void ResidualEncoder::finish(std::vector<std::byte>& out) const {
    const auto& dividers = reciprocals();
    std::vector<std::uint32_t> words(tokens_.size());  // a token writes at most one
    std::size_t wordCount = 0;
    const auto put = [&](std::uint64_t & state, const Token& token) __attribute__((always_inline)) {
        const std::uint64_t frequency = token.frequency;
        // From this limit on, the state would leave its range. Selects instead of branching, because the branch would
        // be unpredictable.
        const std::uint64_t limit = (stateMin >> frequencyBits << wordBits >> token.rawBitCount) * frequency;
        const bool isFull = state >= limit;
        words[wordCount] = static_cast<std::uint32_t>(state);
        wordCount += isFull ? 1 : 0;
        const std::uint64_t kept = isFull ? state >> wordBits : state;
        const std::uint64_t coded = kept << token.rawBitCount | token.rawBits;
        const std::uint64_t quotient = dividedBy(dividers[frequency], coded);
        state = (quotient << frequencyBits) + (coded - quotient * frequency) + token.start;
    };
    std::uint64_t even = states_ == 2 ? stateMin : loneStateStart;
    std::uint64_t odd = stateMin;
    // Branches, which follow a pattern, let both states stay in registers.
    for (auto token = tokens_.rbegin(); token != tokens_.rend(); ++token) {
        if (token->state == 0) {
            put(even, *token);
        } else {
            put(odd, *token);
        }
    }
    out.reserve(out.size() + 2 * stateBytes + wordCount * wordBytes);
    ByteWriter writer(out);
    if (states_ == 2) {
        writer.put(even);
        writer.put(odd);
    } else {
        for (std::size_t i = 0; i < leastLoneStateBytes || (i < stateBytes && even >> (8 * i) != 0); ++i)
            writer.put(static_cast<std::uint8_t>(even >> (8 * i)));
    }
    for (std::size_t i = wordCount; i-- > 0;) writer.put(words[i]);
}

ResidualDecoder::ResidualDecoder(std::span<const std::byte> coded, int states)
    : next_(coded.data()),
      end_(coded.data() + coded.size()),
      stateCount_(states),
      states_{stateMin, stateMin} {
    const std::size_t least = states == 2 ? 2 * stateBytes : leastLoneStateBytes;
    if (coded.size() < least) {
        failed_ = true;
        next_ = end_;
        return;
    }
    if (states == 2) {
        for (std::uint64_t& state : states_) {
            state = readLittleEndian<std::uint64_t>(next_);
            next_ += stateBytes;
            if (state < stateMin || state >= stateMin << wordBits) failed_ = true;
        }
        return;
    }
    const std::size_t bytes = least + (coded.size() - least) % wordBytes;
    states_[0] = 0;
    for (std::size_t i = 0; i < bytes; ++i) states_[0] |= std::to_integer<std::uint64_t>(coded[i]) << (8 * i);
    next_ += bytes;
    if (states_[0] >= stateMin << wordBits || (states_[0] < stateMin && next_ != end_)) failed_ = true;
}

// Decodes one residual from the state. Words are read without checking for the end unless MayEnd.
template <bool MayEnd>
inline std::int16_t ResidualDecoder::readOne(const ResidualDistribution* shape, std::uint64_t& state,
                                             int widthIndex) {
    const WidthCode code = codeOfWidth(widthIndex);
    const Distribution& distribution = shape[code.distribution];
    const std::uint64_t slot = state & (frequencyTotal - 1);
    const int symbol = distribution.symbolOfSlot[slot];
    const Interval interval = distribution.intervals[at(symbol)];
    state = (state >> frequencyBits) * interval.frequency + slot - interval.start;
    int residual = 0;
    if (symbol == escapeSymbol) [[unlikely]] {
        residual = static_cast<int>(state & 0xffff);
        state >>= escapeRawBits;
    } else {
        const auto mask = (std::uint64_t{1} << code.rawBitCount) - 1;
        residual = ((symbol - symbolOfZero) << code.rawBitCount) + static_cast<int>(state & mask);
        state >>= code.rawBitCount;
    }
    if constexpr (MayEnd) {
        if (state < stateMin) refillNearEnd(state);
    } else {
        // Selects instead of branching, because the branch would be unpredictable.
        const bool refill = state < stateMin;
        const std::uint64_t refilled = state << wordBits | readLittleEndian<std::uint32_t>(next_);
        state = refill ? refilled : state;
        next_ += refill ? wordBytes : 0;
    }
    return static_cast<std::int16_t>(residual);
}

void ResidualDecoder::refillNearEnd(std::uint64_t& state) {
    if (end_ - next_ < wordBytes) {
        if (stateCount_ == 1) return;  // its state began below the range
        failed_ = true;
        state = stateMin;
        return;
    }
    state = state << wordBits | readLittleEndian<std::uint32_t>(next_);
    next_ += wordBytes;
}

template <bool MayEnd, int stateCount>
void ResidualDecoder::readRowAs(const ResidualDistribution* shape, std::span<const std::uint8_t> widths,
                                std::span<std::int16_t> residuals) {
    const std::size_t count = residuals.size();
    std::uint64_t even = states_[0];
    std::uint64_t odd = states_[1];
    std::size_t i = 0;
    for (; i + 1 < count; i += 2) {
        residuals[i] = readOne<MayEnd>(shape, even, widths[i]);
        residuals[i + 1] = readOne<MayEnd>(shape, stateCount == 2 ? odd : even, widths[i + 1]);
    }
    if (i < count) residuals[i] = readOne<MayEnd>(shape, even, widths[i]);
    states_[0] = even;
    states_[1] = odd;
}

void ResidualDecoder::readRow(std::span<const std::uint8_t> widths, std::span<std::int16_t> residuals,
                              int shape) {
    assert(residuals.size() == widths.size());
    const ResidualDistribution* const ofShape = distributions(shape).data();
    // Each residual consumes at most one word, and one word is read ahead.
    const std::size_t mostBytes = (residuals.size() + 1) * wordBytes;
    const bool mayEnd = static_cast<std::size_t>(end_ - next_) < mostBytes;
    if (stateCount_ == 2)
        mayEnd ? readRowAs<true, 2>(ofShape, widths, residuals)
               : readRowAs<false, 2>(ofShape, widths, residuals);
    else
        mayEnd ? readRowAs<true, 1>(ofShape, widths, residuals)
               : readRowAs<false, 1>(ofShape, widths, residuals);
}

bool ResidualDecoder::ended() const {
    const std::uint64_t start = stateCount_ == 2 ? stateMin : loneStateStart;
    return next_ == end_ && states_[0] == start && states_[1] == stateMin;
}

}  // namespace planet
