#include "flow/coupled/march.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/coupled/small_system.hpp"

namespace lamina::flow::coupled {

namespace {

/// Layers with larger shape factors do not follow prescribed speeds.
constexpr double laminar_limit = 3.8, turbulent_limit = 2.5;
constexpr double first_shear = 0.03;  // of layers that have just become turbulent, to begin with

/// The fourth equation of a station, beside those of the interval: a combination of its unknowns that is 0.
struct Closing {
    double value, by_momentum, by_displacement, by_speed;
};

Closing close_by_law(const SpeedLaw& law, const Station& b) {
    return {b.speed - law.speed - law.answer * (b.speed * b.displacement - law.flux), 0, -law.answer * b.speed,
            1 - law.answer * b.displacement};
}

Closing close_by_shape(double shape, const Station& b) {
    return {(b.displacement - b.base) / b.momentum - shape, -(b.displacement - b.base) / (b.momentum * b.momentum),
            1 / b.momentum, 0};
}

/// Gives a station that was laminar a shear stress.
void make_turbulent(Station& b) {
    if (!(b.shear >= least_shear && b.shear <= largest_shear)) b.shear = first_shear;
}

/// The stations of an interval on their way to a solution.
class StationSolver {
public:
    StationSolver(const Station* before, const LayerConditions& conditions, const std::optional<double>& trip)
        : before_(before), conditions_(conditions), trip_(trip) {}

    /// Solves the station by Newton's method. Returns whether that has converged. `kind_of` says which equations hold.
    template <class Kind, class Close>
    bool solve(Station& b, Kind&& kind_of, Close&& close) const {
        constexpr int most_steps = 30;
        constexpr double tolerance = 1e-4, largest_change = 0.3;
        for (int step = 0; step < most_steps; ++step) {
            const IntervalKind kind = kind_of(b);
            if (is_turbulent(kind)) make_turbulent(b);
            const Equations equations = equations_of(kind, before_ ? *before_ : b, b, trip_, conditions_);
            SmallSystem<4, 1> rows;
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 4; ++j) rows[i][j] = equations[i].by[shear2 + j];
                rows[i][4] = -equations[i].value;
            }
            const Closing closing = close(b);
            rows[3] = {0, closing.by_momentum, closing.by_displacement, closing.by_speed, -closing.value};
            solve_small<4, 1>(rows);
            const std::array<double, 4> shares{is_turbulent(kind) ? 0.3 * rows[0][4] / b.shear : 0.0,
                                               rows[1][4] / b.momentum, rows[2][4] / b.displacement,
                                               rows[3][4] / b.speed};
            double change = 0;
            for (const double share : shares) {
                if (!std::isfinite(share)) return false;
                change = std::max(change, std::abs(share));
            }
            const double part = change > largest_change ? largest_change / change : 1.0;
            b.shear += part * rows[0][4];
            b.momentum += part * rows[1][4];
            b.displacement += part * rows[2][4];
            b.speed += part * rows[3][4];
            keep_in_range(b, kind);
            if (change < tolerance) return true;
        }
        return false;
    }

    /// Returns the shape factor that a station gets whose layer would separate: that of the station before with a slope
    /// as laminar layers have in bubbles, and turbulent ones behind them. Precondition: there is a station before.
    double shape_to_prescribe(IntervalKind kind, const Station& b) const {
        constexpr double laminar_slope = 0.03, turbulent_slope = -0.15;
        const Station& a = *before_;
        const double shape = a.shape(), in_momentum = 1 / a.momentum;
        switch (kind) {
            case IntervalKind::first:
                return 2.2;
            case IntervalKind::laminar:
                return std::max(shape + laminar_slope * (b.x - a.x) * in_momentum, laminar_limit);
            case IntervalKind::transition: {
                const double place = transition_place(a, b, trip_, conditions_);
                return std::max(shape + (laminar_slope * (place - a.x) + turbulent_slope * (b.x - place)) * in_momentum,
                                turbulent_limit);
            }
            case IntervalKind::turbulent:
                return std::max(shape + turbulent_slope * (b.x - a.x) * in_momentum, turbulent_limit);
            case IntervalKind::wake:
                return std::max(shape - 0.05 * (shape - 1), 1.01);
        }
        return turbulent_limit;
    }

private:
    const Station* before_;
    const LayerConditions& conditions_;
    const std::optional<double>& trip_;
};

/// Gives a station the layer of the one before, and a prescribed speed, to begin with.
void begin_from(const Station* before, double speed, bool turbulent, Station& b) {
    if (before) {
        b.momentum = before->momentum;
        b.displacement = before->displacement - before->base + b.base;
        if (turbulent) b.shear = before->shear;
    }
    b.speed = speed;
}

/// Solves a station with the law of the speed. Where `before` is given and the layer does not follow the law, it gets a
/// prescribed shape factor instead. It stays as it was where no solution is found.
template <class Kind>
void lead_to_station(const StationSolver& solver, const Kind& kind, const SpeedLaw& law, const Station* before,
                     Station& b) {
    const Station given = b;
    bool solved = solver.solve(b, kind, [&](const Station& now) { return close_by_law(law, now); });
    const IntervalKind found = kind(b);
    const double highest = found == IntervalKind::laminar ? laminar_limit : turbulent_limit;
    if (before && (!solved || (found != IntervalKind::wake && b.shape() > highest))) {
        b = given;
        solved = solver.solve(b, kind, [&](const Station& now) {
            return close_by_shape(solver.shape_to_prescribe(kind(now), now), now);
        });
    }
    if (!solved) b = given;
}

}  // namespace

bool is_turbulent(IntervalKind kind) { return kind != IntervalKind::laminar && kind != IntervalKind::first; }

void keep_in_range(Station& b, IntervalKind kind) {
    constexpr double least_wall_shape = 1.02, least_wake_shape = 1.00005, least_speed = 1e-7;
    if (is_turbulent(kind)) b.shear = std::clamp(b.shear, least_shear, largest_shear);
    const double shape = kind == IntervalKind::wake ? least_wake_shape : least_wall_shape;
    b.displacement = std::max(b.displacement, b.base + shape * b.momentum);
    b.speed = std::max(b.speed, least_speed);
}

IntervalKind kind_of(const Stretch& stretch, std::size_t k) {
    if (!stretch.trip) return IntervalKind::wake;
    if (k == 0) return IntervalKind::first;
    if (k < stretch.transition) return IntervalKind::laminar;
    return k == stretch.transition ? IntervalKind::transition : IntervalKind::turbulent;
}

Equations equations_of(IntervalKind kind, const Station& a, const Station& b, const std::optional<double>& trip,
                       const LayerConditions& conditions) {
    switch (kind) {
        case IntervalKind::first:
            return first_equations(b, conditions);
        case IntervalKind::laminar:
            return interval_equations(a, b, Regime::laminar, conditions);
        case IntervalKind::transition:
            return transition_equations(a, b, trip, conditions);
        case IntervalKind::turbulent:
            return interval_equations(a, b, Regime::turbulent, conditions);
        case IntervalKind::wake:
            return interval_equations(a, b, Regime::wake, conditions);
    }
    return {};
}

Station first_of_wake(const Station& upper, const Station& lower, const Station& wake) {
    Station first = wake;
    first.momentum = upper.momentum + lower.momentum;
    first.displacement = upper.displacement + lower.displacement + wake.base;
    first.shear = (upper.momentum * upper.shear + lower.momentum * lower.shear) / first.momentum;
    return first;
}

namespace {

/// How layers come to a station: from the one before it, unless it is the first, and as what.
struct Approach {
    const Station* before;
    bool laminar, at_last;
};

IntervalKind kind_after(const Approach& approach, const Station& now, const std::optional<double>& trip,
                        const LayerConditions& conditions) {
    if (!trip) return IntervalKind::wake;
    if (!approach.before) return IntervalKind::first;
    if (!approach.laminar) return IntervalKind::turbulent;
    const bool ends = approach.at_last || *trip <= now.x ||
                      grown_exponent(*approach.before, now, conditions) >= conditions.critical_exponent;
    return ends ? IntervalKind::transition : IntervalKind::laminar;
}

}  // namespace

void lead_layers(Stretch& stretch, std::vector<Station>& stations, const LayerConditions& conditions, bool prescribed,
                 const std::function<SpeedLaw(std::size_t)>& law) {
    const bool in_wake = !stretch.trip;
    const std::size_t last = stretch.places.size() - 1;
    bool laminar = !in_wake;
    for (std::size_t k = in_wake ? 1 : 0; k <= last; ++k) {
        const Station* before = k > 0 ? &stations[stretch.places[k - 1]] : nullptr;
        Station& b = stations[stretch.places[k]];
        const auto kind = [&](const Station& now) {
            return kind_after({before, laminar, k == last}, now, stretch.trip, conditions);
        };
        const SpeedLaw answer = law(stretch.places[k]);
        if (prescribed) begin_from(before, answer.speed, !laminar, b);
        lead_to_station(StationSolver(before, conditions, stretch.trip), kind, answer, prescribed ? before : nullptr,
                        b);
        if (laminar && before && kind(b) == IntervalKind::transition) {
            laminar = false;
            stretch.transition = k;
            stretch.turbulent_from = transition_place(*before, b, stretch.trip, conditions);
        }
        if (laminar)
            b.shear = before ? grown_exponent(*before, b, conditions) : 0;
        else
            make_turbulent(b);
    }
}

}  // namespace lamina::flow::coupled
