#include "planet/raster/raster_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <list>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "planet/raster/proj_objects.h"

namespace planet {

namespace {

constexpr double radPerDeg = std::numbers::pi / 180;
// A reference system whose degrees differ by less from those of WGS 84, about 0.1 mm, needs no transformation.
constexpr double sameDeg = 1e-9;

// The transformation from degrees of longitude and latitude, for the use of one thread at a time.
struct Transformation {
    ProjContextPtr context;  // destroyed last
    ProjPtr forward;
};

// Returns a transformation between two reference systems with longitude before latitude and easting before
// northing; null if there is none.
ProjPtr between(PJ_CONTEXT* context, const PJ* from, const PJ* to) {
    const ProjPtr plain(proj_create_crs_to_crs_from_pj(context, from, to, nullptr, nullptr));
    return ProjPtr(plain ? proj_normalize_for_visualization(context, plain.get()) : nullptr);
}

// Returns false if a reference system has the code of another kind of system in PROJ's database. PROJ 9.1 crashes on one.
bool hasCodeOfItsKind(PJ_CONTEXT* context, const PJ* system) {
    const char* const authority = proj_get_id_auth_name(system, 0);
    const char* const code = proj_get_id_code(system, 0);
    if (!authority || !code) return true;
    const ProjPtr known(proj_create_from_database(context, authority, code, PJ_CATEGORY_CRS, 0, nullptr));
    return !known || proj_get_type(known.get()) == proj_get_type(system);
}

std::optional<Transformation> makeTransformation(const std::string& crs) {
    Transformation made{makeProjContext(), nullptr};
    PJ_CONTEXT* const context = made.context.get();
    const ProjPtr target(proj_create(context, crs.c_str()));
    const ProjPtr wgs84(proj_create(context, "EPSG:4326"));
    if (!target || !wgs84 || !hasCodeOfItsKind(context, target.get())) return std::nullopt;
    const ProjPtr base(proj_crs_get_geodetic_crs(context, target.get()));
    if (base && !hasCodeOfItsKind(context, base.get())) return std::nullopt;
    made.forward = between(context, wgs84.get(), target.get());
    // PROJ refuses to go from the Earth to another body, whose own latitude and longitude are meant then.
    if (!made.forward && base) made.forward = between(context, base.get(), target.get());
    if (!made.forward) return std::nullopt;
    return made;
}

// Returns the units of longitude in a full turn if the reference system is one of longitude and latitude;
// otherwise 0.
double unitsAround(const std::string& crs) {
    const ProjContextPtr context = makeProjContext();
    const ProjPtr system(proj_create(context.get(), crs.c_str()));
    if (!system) return 0;
    const PJ_TYPE type = proj_get_type(system.get());
    if (type != PJ_TYPE_GEOGRAPHIC_2D_CRS && type != PJ_TYPE_GEOGRAPHIC_3D_CRS) return 0;
    const ProjPtr axes(proj_crs_get_coordinate_system(context.get(), system.get()));
    double unitRad = 0;
    const bool known = axes && proj_cs_get_axis_info(context.get(), axes.get(), 0, nullptr, nullptr, nullptr,
                                                     &unitRad, nullptr, nullptr, nullptr) != 0;
    return known && unitRad > 0 ? 2 * std::numbers::pi / unitRad : 0;
}

// Returns the units of easting in a full turn if a projection is cylindrical: its easting grows evenly with longitude and
// its northing depends only on latitude. Otherwise returns 0.
double eastingAround(PJ* forward) {
    constexpr double spanDeg = 0.5;
    constexpr double most = 1e-9;  // of the change, by which rounding may differ
    double perDegree = 0;
    for (const double latitude : {-60.0, 0.25, 40.0}) {
        for (const double longitude : {-97.0, 0.5, 151.0}) {
            const PJ_COORD here = proj_trans(forward, PJ_FWD, proj_coord(longitude, latitude, 0, HUGE_VAL));
            const PJ_COORD east =
                proj_trans(forward, PJ_FWD, proj_coord(longitude + spanDeg, latitude, 0, HUGE_VAL));
            const double change = (east.xy.x - here.xy.x) / spanDeg;
            if (perDegree == 0) perDegree = change;
            const bool isEven = std::abs(change - perDegree) <= most * std::abs(perDegree) &&
                                std::abs(east.xy.y - here.xy.y) <= most * std::abs(perDegree);
            if (!isEven) return 0;  // also for a place that the projection does not reach
        }
    }
    return 360 * std::abs(perDegree);
}

// Returns whether a transformation leaves degrees of longitude and latitude as they are.
bool keepsDegrees(PJ* forward) {
    return std::ranges::all_of(std::array{-97.0, 0.5, 151.0}, [&](double longitude) {
        const PJ_COORD out = proj_trans(forward, PJ_FWD, proj_coord(longitude, longitude / 4, 0, HUGE_VAL));
        return std::abs(out.xy.x - longitude) < sameDeg && std::abs(out.xy.y - longitude / 4) < sameDeg;
    });
}

double withinTurn(double longitudeRad) {
    return std::remainder(longitudeRad, 2 * std::numbers::pi);
}

}  // namespace

// A coordinate reference system, and its transformations that no thread is using. Another is made if there is none.
class RasterPlacement::System {
public:
    // Null if PROJ knows no way to the system from longitude and latitude.
    static std::shared_ptr<System> make(const std::string& crs) {
        std::optional<Transformation> transformation = makeTransformation(crs);
        if (!transformation) return nullptr;
        const auto system = std::make_shared<System>(crs);
        system->unitsAround_ = planet::unitsAround(crs);
        system->isDegrees_ =
            std::abs(system->unitsAround_ - 360) < sameDeg && keepsDegrees(transformation->forward.get());
        if (system->unitsAround_ == 0)
            system->eastingAround_ = planet::eastingAround(transformation->forward.get());
        system->giveBack(*std::move(transformation));
        return system;
    }
    explicit System(std::string crs) : crs_(std::move(crs)) {}

    const std::string& crs() const { return crs_; }
    // The units of longitude in a full turn, if the system is one of longitude and latitude; otherwise 0.
    double unitsAround() const { return unitsAround_; }
    // The units of easting in a full turn of a cylindrical projection; otherwise 0.
    double eastingAround() const { return eastingAround_; }
    // Whether coordinates are degrees of WGS 84.
    bool isDegrees() const { return isDegrees_; }

    Transformation borrow() {
        {
            const std::lock_guard lock(mutex_);
            if (!idle_.empty()) {
                Transformation transformation = std::move(idle_.back());
                idle_.pop_back();
                return transformation;
            }
        }
        std::optional<Transformation> made = makeTransformation(crs_);
        assert(made);  // it could be made before
        return *std::move(made);
    }
    void giveBack(Transformation transformation) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(transformation));
    }

private:
    std::string crs_;
    double unitsAround_ = 0;
    double eastingAround_ = 0;
    bool isDegrees_ = false;
    std::mutex mutex_;
    std::vector<Transformation> idle_;
};

// The systems of the rasters that were opened last, the most recently used first. PROJ takes about 10 ms to make one, and a
// planet can have thousands of rasters with the same.
class RasterPlacement::RecentSystems {
public:
    std::shared_ptr<System> of(const std::string& crs) {
        {
            const std::lock_guard lock(mutex_);
            const auto found =
                std::ranges::find(systems_, crs, [](const auto& system) { return system->crs(); });
            if (found != systems_.end()) {
                systems_.splice(systems_.begin(), systems_, found);
                return systems_.front();
            }
        }
        const std::shared_ptr<System> made = System::make(crs);
        if (!made) return nullptr;
        const std::lock_guard lock(mutex_);
        systems_.push_front(made);
        if (systems_.size() > mostRecent) systems_.pop_back();
        return made;
    }

private:
    static constexpr std::size_t mostRecent = 8;
    std::mutex mutex_;
    std::list<std::shared_ptr<System>> systems_;
};

Result<RasterPlacement> RasterPlacement::make(const std::string& file, const RasterGrid& grid) {
    static RecentSystems recent;
    const std::shared_ptr<System> system = recent.of(grid.crs);
    if (!system) {
        return badInput(
            fmt::format("{}: PROJ knows no way from longitude and latitude to its coordinate reference "
                        "system; expected one of the Earth, or of another body with its own longitude and "
                        "latitude",
                        file));
    }
    RasterPlacement placement;
    placement.x_ = grid.x;
    placement.y_ = grid.y;
    placement.perArea_ = 1 / (grid.x[1] * grid.y[2] - grid.x[2] * grid.y[1]);
    const double around = system->unitsAround();
    const bool isStraight = grid.x[2] == 0 && grid.y[1] == 0;
    if (around > 0 && isStraight) {
        placement.columnsAround_ = around / std::abs(grid.x[1]);
        const double pole = around / 4;
        placement.northRow_ = (pole - grid.y[0]) / grid.y[2];
        placement.southRow_ = (-pole - grid.y[0]) / grid.y[2];
    } else if (around == 0 && isStraight) {
        placement.columnsAround_ = system->eastingAround() / std::abs(grid.x[1]);
    }
    if (!system->isDegrees()) placement.system_ = system;
    return placement;
}

double RasterPlacement::rowsPerRad() const {
    return std::abs(southRow_ - northRow_) / std::numbers::pi;
}

void RasterPlacement::toGrid(std::span<const double> longitudeRad, std::span<const double> latitudeRad,
                             std::span<double> column, std::span<double> row) const {
    const std::size_t count = longitudeRad.size();
    assert(latitudeRad.size() == count && column.size() == count && row.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
        column[i] = longitudeRad[i] / radPerDeg;
        row[i] = latitudeRad[i] / radPerDeg;
    }
    if (system_) {
        Transformation transformation = system_->borrow();
        proj_trans_generic(transformation.forward.get(), PJ_FWD, column.data(), sizeof(double), count,
                           row.data(), sizeof(double), count, nullptr, 0, 0, nullptr, 0, 0);
        system_->giveBack(std::move(transformation));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double dx = column[i] - x_[0];
        const double dy = row[i] - y_[0];
        column[i] = (dx * y_[2] - dy * x_[2]) * perArea_;
        row[i] = (dy * x_[1] - dx * y_[1]) * perArea_;
    }
}

void RasterPlacement::toPlanet(std::span<const double> column, std::span<const double> row,
                               std::span<double> longitudeRad, std::span<double> latitudeRad) const {
    const std::size_t count = column.size();
    assert(row.size() == count && longitudeRad.size() == count && latitudeRad.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
        longitudeRad[i] = x_[0] + x_[1] * column[i] + x_[2] * row[i];
        latitudeRad[i] = y_[0] + y_[1] * column[i] + y_[2] * row[i];
    }
    if (system_) {
        Transformation transformation = system_->borrow();
        proj_trans_generic(transformation.forward.get(), PJ_INV, longitudeRad.data(), sizeof(double), count,
                           latitudeRad.data(), sizeof(double), count, nullptr, 0, 0, nullptr, 0, 0);
        system_->giveBack(std::move(transformation));
    }
    for (std::size_t i = 0; i < count; ++i) {
        longitudeRad[i] = withinTurn(longitudeRad[i] * radPerDeg);
        latitudeRad[i] *= radPerDeg;
    }
}

}  // namespace planet
