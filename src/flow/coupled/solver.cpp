#include "flow/coupled/solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "flow/coupled/march.hpp"
#include "flow/coupled/small_system.hpp"
#include "flow/dense_solve.hpp"
#include "flow/panel_system.hpp"

namespace lamina::flow::coupled {

namespace {

/// The solution on its way.
class Solver {
public:
    Solver(const Influence& influence, const LayerConditions& conditions, std::span<const Trips> trips)
        : influence_(influence), conditions_(conditions), trips_(trips), n_(influence.at.size()), signs_(n_, 1) {}

    CoupledLayers solve(const CoupledLayers* start) {
        // From layers of another flow it takes 5 to 20 steps.
        const int most_steps = start ? 30 : 60;
        constexpr double tolerance = 1e-4;  // of the last step, whose error is the square
        if (start) {
            layers_ = *start;
            layers_.converged = false;
            for (std::size_t e = 0; e < layers_.bodies.size(); ++e) {
                set_base(influence_.bodies[e]);
                lay_stretches(e, layers_.bodies[e].upper.places.front());
            }
        } else if (!begin()) {
            return layers_;
        }
        for (layers_.steps = 0; layers_.steps < most_steps && !layers_.converged;) {
            sweep(false);
            const double change = step();
            ++layers_.steps;
            if (!std::isfinite(change)) break;
            layers_.converged = change < tolerance;
        }
        return layers_;
    }

private:
    Station& at(std::size_t place) { return layers_.stations[place]; }
    const Station& at(std::size_t place) const { return layers_.stations[place]; }

    /// Begins with layers that do not act on the flow. Returns whether each body has a stagnation point.
    bool begin() {
        layers_.stations.assign(n_, {});
        layers_.bodies.resize(influence_.bodies.size());
        for (std::size_t i = 0; i < n_; ++i) at(i).speed = std::max(std::abs(influence_.speed[i]), 1e-7);
        for (std::size_t e = 0; e < layers_.bodies.size(); ++e)
            if (!begin_body(e)) return false;
        sweep(true);
        return true;
    }

    bool begin_body(std::size_t e) {
        const std::vector<double>& speed = influence_.speed;
        const auto [first, wall_end, end] = influence_.bodies[e];
        std::size_t nose = first;
        for (std::size_t i = first; i + 1 < wall_end; ++i)
            if (speed[i] < 0 && speed[i + 1] >= 0) nose = i;
        if (nose < first + 2 || nose + 3 > wall_end) return false;
        set_base(influence_.bodies[e]);
        lay_stretches(e, nose);
        for (const Stretch* side : {&layers_.bodies[e].upper, &layers_.bodies[e].lower}) {
            Station& station = at(side->places.front());
            // Hiemenz' flow.
            station.momentum = std::sqrt(0.075 * conditions_.viscosity * station.x / station.speed);
            station.displacement = 2.2 * station.momentum;
        }
        return true;
    }

    /// Sets the width of the fluid at rest behind a base, across the direction in which flow leaves it. It closes over
    /// 2.5 of its heights, as a cubic (XFOIL, section 4).
    void set_base(const BodyPlaces& places) {
        constexpr double length_ratio = 2.5;
        const std::span walls(influence_.at.data() + places.first, places.wake - places.first);
        const double base = std::abs(cross(leaving_direction(walls), walls.front() - walls.back()));
        for (std::size_t i = places.wake; i < places.end; ++i) {
            const double left = base > 0 ? 1 - influence_.s[i] / (length_ratio * base) : 0;
            at(i).base = left > 0 ? base * left * left * (3 - 2 * left) : 0;
        }
    }

    /// Makes the stretches of a body from this last node of the upper side on, and the places along them.
    void lay_stretches(std::size_t e, std::size_t nose) {
        auto& [upper, lower, wake, stagnation] = layers_.bodies[e];
        const auto [first, wall_end, end] = influence_.bodies[e];
        upper.places.clear(), lower.places.clear(), wake.places.clear();
        for (std::size_t i = nose + 1; i-- > first;) upper.places.push_back(i);
        for (std::size_t i = nose + 1; i < wall_end; ++i) lower.places.push_back(i);
        for (std::size_t i = wall_end; i < end; ++i) wake.places.push_back(i);
        for (std::size_t i = first; i < end; ++i) signs_[i] = i <= nose ? -1 : 1;
        set_arcs(e);
    }

    /// Sets arc lengths from the stagnation point, which lies where the speed is 0 between both sides.
    void set_arcs(std::size_t e) {
        auto& [upper, lower, wake, stagnation] = layers_.bodies[e];
        const std::size_t a = upper.places.front(), b = lower.places.front();
        const double panel = influence_.s[b] - influence_.s[a], least = 1e-6 * panel;
        stagnation = influence_.s[a] + panel * at(a).speed / (at(a).speed + at(b).speed);
        for (const std::size_t i : upper.places) at(i).x = std::max(stagnation - influence_.s[i], least);
        for (const std::size_t i : lower.places) at(i).x = std::max(influence_.s[i] - stagnation, least);
        for (const std::size_t i : wake.places) at(i).x = at(lower.places.back()).x + influence_.s[i];
        upper.trip = std::max(stagnation - trips_[e].upper, at(a).x);
        lower.trip = std::max(trips_[e].lower - stagnation, at(b).x);
    }

    /// Returns the speed at a place that the outer flow has with the fluxes of now.
    double outer_speed(std::size_t i) const {
        double speed = influence_.speed[i];
        for (std::size_t j = 0; j < n_; ++j)
            speed += influence_.matrix[i * n_ + j] * signs_[j] * at(j).speed * at(j).displacement;
        return signs_[i] * speed;
    }

    void sweep(bool prescribed) {
        std::vector<SpeedLaw> laws;
        for (std::size_t i = 0; i < n_; ++i)
            laws.push_back({at(i).speed, prescribed ? 0 : std::max(influence_.matrix[i * n_ + i], 0.0),
                            at(i).speed * at(i).displacement});
        const auto law = [&](std::size_t place) { return laws[place]; };
        for (auto& [upper, lower, wake, stagnation] : layers_.bodies) {
            for (Stretch* side : {&upper, &lower}) lead_layers(*side, layers_.stations, conditions_, prescribed, law);
            Station& first = at(wake.places.front());
            first = first_of_wake(at(upper.places.back()), at(lower.places.back()), first);
            lead_layers(wake, layers_.stations, conditions_, prescribed, law);
        }
    }

    // -----------------------------------------------------------------------------------------------------------------
    // Newton's method

    /// What the changes of shear, momentum thickness and speed at a place follow from: coefficients of the changes of
    /// all fluxes, a constant, and the coefficients of the ways of the stagnation points along the outlines.
    using Changes = std::array<std::vector<double>, 3>;
    enum Row { of_shear, of_momentum, of_speed };

    std::size_t columns() const { return n_ + 1 + layers_.bodies.size(); }
    std::size_t constant() const { return n_; }
    std::size_t shifting(std::size_t body) const { return n_ + 1 + body; }

    /// Follows the changes through an interval: with the equations R = 0 of its unknowns and d displacement = (d flux -
    /// displacement d speed) / speed. `direction` is that in which arc lengths grow with the way of the body's
    /// stagnation point.
    void follow(const Equations& equations, std::size_t body, double direction, const std::size_t* before,
                std::size_t place) {
        const Station& b = at(place);
        SmallSystem<3, 7> rows;  // right sides: three changes before, flux before, flux here, residual, way
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& by = equations[i].by;
            rows[i] = {by[shear2],
                       by[momentum2],
                       by[speed2] - by[displacement2] * b.displacement / b.speed,
                       -by[shear1],
                       -by[momentum1],
                       0,
                       0,
                       -by[displacement2] / b.speed,
                       -equations[i].value,
                       -by[shift] * direction};
            if (!before) continue;
            const Station& a = at(*before);
            rows[i][5] = -(by[speed1] - by[displacement1] * a.displacement / a.speed);
            rows[i][6] = -by[displacement1] / a.speed;
        }
        solve_small<3, 7>(rows);
        for (std::size_t i = 0; i < 3; ++i) {
            std::vector<double>& row = changes_[place][i];
            row.assign(columns(), 0);
            if (before) {
                const Changes& a = changes_[*before];
                for (std::size_t j = 0; j < columns(); ++j)
                    row[j] = rows[i][3] * a[0][j] + rows[i][4] * a[1][j] + rows[i][5] * a[2][j];
                row[*before] += rows[i][6];
            }
            row[place] += rows[i][7];
            row[constant()] += rows[i][8];
            row[shifting(body)] += rows[i][9];
        }
    }

    void follow_stretch(const Stretch& stretch, std::size_t body, double direction) {
        for (std::size_t k = stretch.trip ? 0 : 1; k < stretch.places.size(); ++k) {
            const std::size_t place = stretch.places[k], *before = k > 0 ? &stretch.places[k - 1] : nullptr;
            follow(equations_of(kind_of(stretch, k), before ? at(*before) : at(place), at(place), stretch.trip,
                                conditions_),
                   body, direction, before, place);
        }
    }

    /// Follows the changes of both sides into the first station of the wake (first_of_wake()).
    void join_sides(const BodyStretches& body) {
        const std::size_t u = body.upper.places.back(), l = body.lower.places.back(), w = body.wake.places.front();
        const Station &a = at(u), &b = at(l), &c = at(w);
        const Changes &of_a = changes_[u], &of_b = changes_[l];
        Changes& result = changes_[w];
        for (auto& row : result) row.assign(columns(), 0);
        for (std::size_t j = 0; j < columns(); ++j) {
            result[of_momentum][j] = of_a[of_momentum][j] + of_b[of_momentum][j];
            result[of_shear][j] =
                (a.momentum * of_a[of_shear][j] + b.momentum * of_b[of_shear][j] +
                 (a.shear - c.shear) * of_a[of_momentum][j] + (b.shear - c.shear) * of_b[of_momentum][j]) /
                c.momentum;
            // d displacement, of both sides
            result[of_speed][j] =
                (a.displacement / a.speed * of_a[of_speed][j] + b.displacement / b.speed * of_b[of_speed][j]) *
                c.speed / c.displacement;
        }
        result[of_speed][u] -= c.speed / (c.displacement * a.speed);
        result[of_speed][l] -= c.speed / (c.displacement * b.speed);
        result[of_speed][w] += 1 / c.displacement;
    }

    /// One step for all unknowns. Returns the root of the mean square of their changes, as shares.
    double step() {
        changes_.resize(n_);
        for (std::size_t e = 0; e < layers_.bodies.size(); ++e) {
            const BodyStretches& body = layers_.bodies[e];
            follow_stretch(body.upper, e, 1);
            follow_stretch(body.lower, e, -1);
            join_sides(body);
            follow_stretch(body.wake, e, 0);
        }
        std::vector<double> matrix(n_ * n_);
        std::vector<std::vector<double>> right(1 + layers_.bodies.size(), std::vector<double>(n_));
        for (std::size_t i = 0; i < n_; ++i) {
            const std::vector<double>& row = changes_[i][of_speed];
            for (std::size_t j = 0; j < n_; ++j)
                matrix[i * n_ + j] = signs_[i] * influence_.matrix[i * n_ + j] * signs_[j] - row[j];
            right[0][i] = row[constant()] - (outer_speed(i) - at(i).speed);
            for (std::size_t e = 0; e < layers_.bodies.size(); ++e) right[1 + e][i] = row[shifting(e)];
        }
        const std::vector<std::vector<double>> solved = solve_dense(std::move(matrix), right);
        const std::vector<double> ways = ways_of_stagnation(solved);
        std::vector<double> flux = solved[0];
        for (std::size_t e = 0; e < ways.size(); ++e)
            for (std::size_t i = 0; i < n_; ++i) flux[i] += ways[e] * solved[1 + e][i];
        return apply(flux, ways);
    }

    /// Returns the change of a number for changes of the fluxes, without what its constant and the ways add.
    double change_by_flux(std::size_t place, std::size_t row, const std::vector<double>& flux) const {
        const std::vector<double>& of = changes_[place][row];
        double sum = 0;
        for (std::size_t j = 0; j < n_; ++j) sum += of[j] * flux[j];
        return sum;
    }

    double change_of(std::size_t place, std::size_t row, const std::vector<double>& flux,
                     const std::vector<double>& ways) const {
        const std::vector<double>& of = changes_[place][row];
        double sum = of[constant()];
        for (std::size_t e = 0; e < ways.size(); ++e) sum += ways[e] * of[shifting(e)];
        return sum + change_by_flux(place, row, flux);
    }

    /// Returns how far each stagnation point goes: as far as the speeds at its neighbours say that change with the ways
    /// of all. `solved` has the fluxes without ways, and those for a unit of each.
    std::vector<double> ways_of_stagnation(const std::vector<std::vector<double>>& solved) const {
        const std::size_t bodies = layers_.bodies.size();
        std::vector<double> matrix(bodies * bodies);
        std::vector<std::vector<double>> given{std::vector<double>(bodies)};
        for (std::size_t e = 0; e < bodies; ++e) {
            const std::size_t a = layers_.bodies[e].upper.places.front(), b = layers_.bodies[e].lower.places.front();
            const double u = at(a).speed, v = at(b).speed;
            const double factor = (influence_.s[b] - influence_.s[a]) / ((u + v) * (u + v));
            const auto way = [&](std::size_t column, std::size_t of) {
                const auto change = [&](std::size_t place) {
                    return changes_[place][of_speed][column] + change_by_flux(place, of_speed, solved[of]);
                };
                return factor * (v * change(a) - u * change(b));
            };
            given[0][e] = way(constant(), 0);
            for (std::size_t by = 0; by < bodies; ++by)
                matrix[e * bodies + by] = (e == by ? 1 : 0) - way(shifting(by), 1 + by);
        }
        return solve_dense(std::move(matrix), given).front();
    }

    double apply(const std::vector<double>& flux, const std::vector<double>& ways) {
        constexpr double most_up = 1.5, most_down = -0.5, speed_scale = 0.25, exponent_scale = 10;
        // Places of transition that jump between two values, since closures have kinks, settle with half steps.
        constexpr int whole_steps = 15;
        const std::vector<IntervalKind> kinds = kinds_of_places();
        std::vector<std::array<double, 4>> by(n_);  // shear, momentum, displacement, speed
        double part = layers_.steps < whole_steps ? 1 : 0.5, sum = 0;
        const auto limit = [&](double share) {
            sum += share * share;
            if (part * share > most_up) part = most_up / share;
            if (part * share < most_down) part = most_down / share;
        };
        for (std::size_t i = 0; i < n_; ++i) {
            const Station& s = at(i);
            by[i][0] = change_of(i, of_shear, flux, ways);
            by[i][1] = change_of(i, of_momentum, flux, ways);
            by[i][3] = change_of(i, of_speed, flux, ways);
            by[i][2] = (flux[i] - s.displacement * by[i][3]) / s.speed;
            limit(by[i][0] / (kinds[i] == IntervalKind::laminar ? exponent_scale : s.shear));
            limit(by[i][1] / s.momentum);
            limit(by[i][2] / s.displacement);
            limit(std::abs(by[i][3]) / speed_scale);
        }
        std::vector<double> along(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            Station& s = at(i);
            s.shear += part * by[i][0];
            s.momentum += part * by[i][1];
            s.displacement += part * by[i][2];
            s.speed += part * by[i][3];
            along[i] = signs_[i] * s.speed;
            keep_in_range(s, kinds[i]);
        }
        for (std::size_t e = 0; e < layers_.bodies.size(); ++e) {
            move_nose(e, along);
            set_arcs(e);
        }
        return std::sqrt(sum / (4 * static_cast<double>(n_)));
    }

    /// Returns, per place, whether its layer is laminar, turbulent or that of a wake.
    std::vector<IntervalKind> kinds_of_places() const {
        std::vector<IntervalKind> kinds(n_, IntervalKind::wake);
        for (const BodyStretches& body : layers_.bodies)
            for (const Stretch* side : {&body.upper, &body.lower})
                for (std::size_t k = 0; k < side->places.size(); ++k)
                    kinds[side->places[k]] = k < side->transition ? IntervalKind::laminar : IntervalKind::turbulent;
        return kinds;
    }

    /// Gives nodes whose flow has turned round to the other side, with the layer of that side's first station.
    void move_nose(std::size_t e, const std::vector<double>& along) {
        const auto [first_place, wall_end, end] = influence_.bodies[e];
        const std::size_t old = layers_.bodies[e].upper.places.front();
        std::size_t nose = old;
        while (nose > first_place + 2 && along[nose] >= 0) --nose;
        while (nose + 4 < wall_end && along[nose + 1] < 0) ++nose;
        if (nose == old) return;
        const Station first = at(nose < old ? old + 1 : old);
        for (std::size_t i = std::min(nose, old) + 1; i <= std::max(nose, old); ++i) {
            at(i) = first;
            at(i).speed = std::abs(along[i]);
        }
        lay_stretches(e, nose);
        // Stations keep their regimes.
        const auto moved = static_cast<std::ptrdiff_t>(nose) - static_cast<std::ptrdiff_t>(old);
        const auto shift_transition = [](Stretch& side, std::ptrdiff_t by) {
            const auto to = static_cast<std::ptrdiff_t>(side.transition) + by;
            side.transition = static_cast<std::size_t>(std::max(to, std::ptrdiff_t{1}));
        };
        shift_transition(layers_.bodies[e].upper, moved);
        shift_transition(layers_.bodies[e].lower, -moved);
    }

    const Influence& influence_;
    const LayerConditions& conditions_;
    std::span<const Trips> trips_;
    std::size_t n_;
    std::vector<double> signs_;  ///< per place: -1 where the flow runs against the outline, on upper sides
    CoupledLayers layers_;
    std::vector<Changes> changes_;
};

/// Returns the station between two others, whose arc lengths do not count.
Station between(const Station& a, const Station& b, double share) {
    const auto mean = [&](double Station::*number) { return a.*number + share * (b.*number - a.*number); };
    return {.x = 0,
            .shear = mean(&Station::shear),
            .momentum = mean(&Station::momentum),
            .displacement = mean(&Station::displacement),
            .speed = mean(&Station::speed)};
}

}  // namespace

CoupledLayers carry_over(const CoupledLayers& layers, const Influence& from, const Influence& to) {
    CoupledLayers result = layers;
    result.stations.clear();
    for (std::size_t e = 0; e < to.bodies.size(); ++e) {
        const BodyPlaces &old = from.bodies[e], &now = to.bodies[e];
        const std::size_t nose = result.stations.size() + layers.bodies[e].upper.places.front() - old.first;
        result.bodies[e].upper.places = {nose};
        for (std::size_t i = old.first; i < old.wake; ++i) result.stations.push_back(layers.stations[i]);
        for (std::size_t i = now.wake, j = old.wake + 1; i < now.end; ++i) {
            while (j + 1 < old.end && from.s[j] < to.s[i]) ++j;
            const double share = std::min((to.s[i] - from.s[j - 1]) / (from.s[j] - from.s[j - 1]), 1.0);
            result.stations.push_back(between(layers.stations[j - 1], layers.stations[j], share));
        }
    }
    return result;
}

CoupledLayers solve_layers(const Influence& influence, const LayerConditions& conditions, std::span<const Trips> trips,
                           const CoupledLayers* start) {
    return Solver(influence, conditions, trips).solve(start);
}

}  // namespace lamina::flow::coupled
