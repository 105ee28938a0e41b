#include "planet/raster/vertical_datum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/raster/proj_objects.h"

namespace planet {

namespace {

// The grid of a geoid's height above the ellipsoid, by its name and by the one before PROJ 7.
std::array<const char*, 2> gridNamesOf(VerticalDatum datum) {
    if (datum == VerticalDatum::Egm96) return {"us_nga_egm96_15.tif", "egm96_15.gtx"};
    return {"us_nga_egm08_25.tif", "egm08_25.gtx"};
}

// Returns a step that adds a grid's values, times a factor, to heights.
std::string stepOf(const char* grid, int factor) {
    return fmt::format("+proj=vgridshift +grids={} +multiplier={}", grid, factor);
}

// Returns the name under which PROJ finds the grid of a geoid.
Result<const char*> gridOf(VerticalDatum datum) {
    const ProjContextPtr context = makeProjContext();
    for (const char* const grid : gridNamesOf(datum)) {
        if (ProjPtr(proj_create(context.get(), stepOf(grid, 1).c_str()))) return grid;
    }
    const char* const wanted = gridNamesOf(datum)[0];
    return ioError(fmt::format(
        "{}: PROJ has no such grid for datum {} in {}; expected it from \"projsync --file {}\" "
        "(Debian's proj-data has only egm96_15.gtx), or offset_m in the layer instead of the grid",
        wanted, nameOf(datum), proj_info().searchpath, wanted));
}

// The steps of a shift: N(from) - N(to).
Result<std::string> pipelineOf(VerticalDatum from, VerticalDatum to) {
    std::string steps = "+proj=pipeline";
    for (const auto& [datum, factor] : {std::pair(from, 1), std::pair(to, -1)}) {
        if (datum == VerticalDatum::Ellipsoid) continue;
        TRY_ASSIGN(const char* const grid, gridOf(datum));
        steps += " +step " + stepOf(grid, factor);
    }
    return steps;
}

}  // namespace

// Transformations that no thread is using. Another is made if there is none.
class DatumShift::Transformations {
public:
    struct Transformation {
        ProjContextPtr context;  // destroyed last
        ProjPtr pipeline;
    };

    explicit Transformations(std::string steps) : steps_(std::move(steps)) {}

    // Returns a transformation whose pipeline is null if a grid has disappeared.
    Transformation borrow() {
        {
            const std::lock_guard lock(mutex_);
            if (!idle_.empty()) {
                Transformation transformation = std::move(idle_.back());
                idle_.pop_back();
                return transformation;
            }
        }
        Transformation made{makeProjContext(), nullptr};
        made.pipeline.reset(proj_create(made.context.get(), steps_.c_str()));
        return made;
    }
    void giveBack(Transformation transformation) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(transformation));
    }

private:
    std::string steps_;
    std::mutex mutex_;
    std::vector<Transformation> idle_;
};

Result<DatumShift> DatumShift::make(VerticalDatum from, VerticalDatum to) {
    DatumShift shift;
    if (from == to) return shift;
    TRY_ASSIGN(auto steps, pipelineOf(from, to));
    shift.transformations_ = std::make_shared<Transformations>(std::move(steps));
    shift.findRange();
    return shift;
}

void DatumShift::at(std::span<const double> longitudeRad, std::span<const double> latitudeRad,
                    std::span<double> shiftM) const {
    const std::size_t count = longitudeRad.size();
    assert(latitudeRad.size() == count && shiftM.size() == count);
    std::ranges::fill(shiftM, transformations_ ? HUGE_VAL : 0);
    if (!transformations_) return;
    auto transformation = transformations_->borrow();
    if (!transformation.pipeline) return;
    std::vector<double> longitudes(longitudeRad.begin(), longitudeRad.end());
    std::vector<double> latitudes(latitudeRad.begin(), latitudeRad.end());
    std::ranges::fill(shiftM, 0.0);
    proj_trans_generic(transformation.pipeline.get(), PJ_FWD, longitudes.data(), sizeof(double), count,
                       latitudes.data(), sizeof(double), count, shiftM.data(), sizeof(double), count, nullptr,
                       0, 0);
    // PROJ leaves a place outside of a grid infinite.
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::isfinite(longitudes[i])) shiftM[i] = HUGE_VAL;
    }
    transformations_->giveBack(std::move(transformation));
}

// Takes the range from a lattice of half a degree, between whose points geoids vary by less than the margin.
void DatumShift::findRange() {
    constexpr int columns = 720;
    constexpr int rows = 361;
    constexpr double stepRad = 2 * std::numbers::pi / columns;
    constexpr double marginM = 10;
    std::vector<double> longitudes(columns);
    std::vector<double> latitudes(columns);
    std::vector<double> shifts(columns);
    for (int row = 0; row < rows; ++row) {
        for (std::size_t i = 0; i < columns; ++i)
            longitudes[i] = stepRad * static_cast<double>(i) - std::numbers::pi;
        std::ranges::fill(latitudes, std::numbers::pi / 2 - stepRad * row);
        at(longitudes, latitudes, shifts);
        for (const double shift : shifts) {
            if (!std::isfinite(shift)) continue;
            minM_ = std::min(minM_, shift);
            maxM_ = std::max(maxM_, shift);
        }
    }
    minM_ -= marginM;
    maxM_ += marginM;
}

}  // namespace planet
