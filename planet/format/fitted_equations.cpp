#include "planet/format/fitted_equations.h"

#include <cmath>
#include <utility>

#include "planet/format/height_rows.h"

namespace planet {

FitSamples fitSamplesOf(FittedPredictor& predictor, RefinementPass pass, std::span<const std::int16_t> fine,
                        int coarseCells) {
    const auto columns = static_cast<std::size_t>(passColumns(pass, coarseCells));
    const auto rows = static_cast<std::size_t>(passRows(pass, coarseCells));
    FitSamples samples;
    samples.terms = static_cast<std::size_t>(predictionTermCount(pass)) - 1;
    samples.differences.resize(rows * columns * samples.terms);
    samples.targets.resize(rows * columns);
    std::vector<std::int32_t> first(columns);
    std::vector<std::int32_t> other(columns);
    std::vector<std::int16_t> own(columns);
    predictor.beginPass(pass);
    for (std::size_t y = 0; y < rows; ++y) {
        const int row = static_cast<int>(y);
        predictor.readPredictionTerm(0, row, first);
        for (std::size_t k = 0; k < samples.terms; ++k) {
            predictor.readPredictionTerm(static_cast<int>(k) + 1, row, other);
            for (std::size_t x = 0; x < columns; ++x)
                samples.differences[(y * columns + x) * samples.terms + k] = other[x] - first[x];
        }
        const std::int16_t* const in = fine.data() + rowStart(pass, row, coarseCells);
        for (std::size_t x = 0; x < columns; ++x) {
            own[x] = in[2 * x];
            samples.targets[y * columns + x] = own[x] - first[x];
        }
        predictor.setSamples(row, own);
    }
    return samples;
}

std::optional<std::vector<double>> solved(NormalEquations equations) {
    const std::size_t size = equations.size;
    auto& a = equations;
    for (std::size_t j = 0; j < size; ++j) {
        double diagonal = a.at(j, j);
        for (std::size_t k = 0; k < j; ++k) diagonal -= a.at(j, k) * a.at(j, k);
        if (!(diagonal > 1e-12)) return std::nullopt;
        diagonal = std::sqrt(diagonal);
        a.at(j, j) = diagonal;
        for (std::size_t i = j + 1; i < size; ++i) {
            double sum = a.at(i, j);
            for (std::size_t k = 0; k < j; ++k) sum -= a.at(i, k) * a.at(j, k);
            a.at(i, j) = sum / diagonal;
        }
    }
    std::vector<double> x = std::move(a.right);
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t k = 0; k < i; ++k) x[i] -= a.at(i, k) * x[k];
        x[i] /= a.at(i, i);
    }
    for (std::size_t i = size; i-- > 0;) {
        for (std::size_t k = i + 1; k < size; ++k) x[i] -= a.at(k, i) * x[k];
        x[i] /= a.at(i, i);
    }
    return x;
}

NormalEquations robustEquations(const FitSamples& samples, std::span<const double> weights,
                                std::span<const double> expected) {
    const std::size_t terms = samples.terms;
    NormalEquations equations{terms, std::vector<double>(terms * terms), std::vector<double>(terms)};
    for (std::size_t i = 0; i < samples.targets.size(); ++i) {
        const double* const d = samples.differences.data() + i * terms;
        double residual = samples.targets[i];
        for (std::size_t k = 0; k < terms; ++k) residual -= weights[k] * d[k];
        const double scale = (expected[i] + 0.3) * (expected[i] + 0.3);
        const double importance = 1 / (scale * (1 + residual * residual / (5 * scale)));
        for (std::size_t a = 0; a < terms; ++a) {
            const double weighted = importance * d[a];
            double* const row = equations.matrix.data() + a * terms;
            for (std::size_t b = 0; b <= a; ++b) row[b] += weighted * d[b];
            equations.right[a] += weighted * residual;
        }
    }
    for (std::size_t a = 0; a < terms; ++a)
        for (std::size_t b = a + 1; b < terms; ++b) equations.at(a, b) = equations.at(b, a);
    return equations;
}

}  // namespace planet
