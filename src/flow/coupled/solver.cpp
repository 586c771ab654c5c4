#include "flow/coupled/solver.hpp"

#include <algorithm>
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
    Solver(const Influence& influence, const LayerConditions& conditions, const Trips& trips)
        : influence_(influence), conditions_(conditions), trips_(trips), n_(influence.at.size()) {}

    CoupledLayers solve(const CoupledLayers* start) {
        constexpr int most_steps = 60;
        constexpr double tolerance = 1e-4;  // of the last step, whose error is the square
        if (start) {
            layers_ = *start;
            layers_.converged = false;
            lay_stretches(layers_.stretches[0].places.front());
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
    double sign(std::size_t place) const {
        return place < influence_.wall && place <= layers_.stretches[0].places.front() ? -1 : 1;
    }
    Station& at(std::size_t place) { return layers_.stations[place]; }
    const Station& at(std::size_t place) const { return layers_.stations[place]; }

    /// Begins with layers that do not act on the flow. Returns whether the flow has a stagnation point.
    bool begin() {
        const std::vector<double>& speed = influence_.speed;
        std::size_t nose = 0;
        for (std::size_t i = 0; i + 1 < influence_.wall; ++i)
            if (speed[i] < 0 && speed[i + 1] >= 0) nose = i;
        if (nose < 2 || nose + 3 > influence_.wall) return false;
        layers_.stations.assign(n_, {});
        for (std::size_t i = 0; i < n_; ++i) at(i).speed = std::max(std::abs(speed[i]), 1e-7);
        set_bases();
        lay_stretches(nose);
        for (const auto& side : {layers_.stretches[0], layers_.stretches[1]}) {
            Station& first = at(side.places.front());
            // Hiemenz' flow.
            first.momentum = std::sqrt(0.075 * conditions_.viscosity * first.x / first.speed);
            first.displacement = 2.2 * first.momentum;
        }
        sweep(true);
        return true;
    }

    /// Sets the widths of the fluid at rest behind a base, across the direction in which flow leaves it. It closes over 2.5 of
    /// its heights, as a cubic (XFOIL, section 4).
    void set_bases() {
        constexpr double length_ratio = 2.5;
        const std::span walls(influence_.at.data(), influence_.wall);
        const double base = std::abs(cross(leaving_direction(walls), walls.front() - walls.back()));
        for (std::size_t i = influence_.wall; i < n_; ++i) {
            const double left = base > 0 ? 1 - influence_.s[i] / (length_ratio * base) : 0;
            at(i).base = left > 0 ? base * left * left * (3 - 2 * left) : 0;
        }
    }

    /// Makes the stretches from this last node of the upper side on, and the places along them.
    void lay_stretches(std::size_t nose) {
        auto& [upper, lower, wake] = layers_.stretches;
        upper.places.clear(), lower.places.clear(), wake.places.clear();
        for (std::size_t i = nose + 1; i-- > 0;) upper.places.push_back(i);
        for (std::size_t i = nose + 1; i < influence_.wall; ++i) lower.places.push_back(i);
        for (std::size_t i = influence_.wall; i < n_; ++i) wake.places.push_back(i);
        set_arcs();
    }

    /// Sets arc lengths from the stagnation point, which lies where the speed is 0 between both sides.
    void set_arcs() {
        auto& [upper, lower, wake] = layers_.stretches;
        const std::size_t a = upper.places.front(), b = lower.places.front();
        const double panel = influence_.s[b] - influence_.s[a], least = 1e-6 * panel;
        layers_.stagnation = influence_.s[a] + panel * at(a).speed / (at(a).speed + at(b).speed);
        for (const std::size_t i : upper.places) at(i).x = std::max(layers_.stagnation - influence_.s[i], least);
        for (const std::size_t i : lower.places) at(i).x = std::max(influence_.s[i] - layers_.stagnation, least);
        for (const std::size_t i : wake.places) at(i).x = at(lower.places.back()).x + influence_.s[i];
        upper.trip = std::max(layers_.stagnation - trips_[0], at(a).x);
        lower.trip = std::max(trips_[1] - layers_.stagnation, at(b).x);
    }

    /// Returns the speed at a place that the outer flow has with the fluxes of now.
    double outer_speed(std::size_t i) const {
        double speed = influence_.speed[i];
        for (std::size_t j = 0; j < n_; ++j)
            speed += influence_.matrix[i * n_ + j] * sign(j) * at(j).speed * at(j).displacement;
        return sign(i) * speed;
    }

    void sweep(bool prescribed) {
        std::vector<SpeedLaw> laws;
        for (std::size_t i = 0; i < n_; ++i)
            laws.push_back({at(i).speed, prescribed ? 0 : std::max(influence_.matrix[i * n_ + i], 0.0),
                            at(i).speed * at(i).displacement});
        const auto law = [&](std::size_t place) { return laws[place]; };
        auto& [upper, lower, wake] = layers_.stretches;
        for (Stretch* side : {&upper, &lower}) lead_layers(*side, layers_.stations, conditions_, prescribed, law);
        Station& first = at(wake.places.front());
        first = first_of_wake(at(upper.places.back()), at(lower.places.back()), first);
        lead_layers(wake, layers_.stations, conditions_, prescribed, law);
    }

    // -----------------------------------------------------------------------------------------------------------------
    // Newton's method

    /// What the changes of shear, momentum thickness and speed at a place follow from: coefficients of the changes of all
    /// fluxes, a constant, and the coefficient of the way of the stagnation point along the outline.
    using Changes = std::array<std::vector<double>, 3>;
    enum Row { of_shear, of_momentum, of_speed };

    std::size_t constant() const { return n_; }
    std::size_t shifting() const { return n_ + 1; }

    /// Follows the changes through an interval: with the equations R = 0 of its unknowns and d displacement = (d flux -
    /// displacement d speed) / speed.
    void follow(const Equations& equations, double direction, const std::size_t* before, std::size_t place) {
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
            row.assign(n_ + 2, 0);
            if (before) {
                const Changes& a = changes_[*before];
                for (std::size_t j = 0; j < n_ + 2; ++j)
                    row[j] = rows[i][3] * a[0][j] + rows[i][4] * a[1][j] + rows[i][5] * a[2][j];
                row[*before] += rows[i][6];
            }
            row[place] += rows[i][7];
            row[constant()] += rows[i][8];
            row[shifting()] += rows[i][9];
        }
    }

    void follow_stretch(const Stretch& stretch, double direction) {
        for (std::size_t k = stretch.trip ? 0 : 1; k < stretch.places.size(); ++k) {
            const std::size_t place = stretch.places[k], *before = k > 0 ? &stretch.places[k - 1] : nullptr;
            follow(equations_of(kind_of(stretch, k), before ? at(*before) : at(place), at(place), stretch.trip,
                                conditions_),
                   direction, before, place);
        }
    }

    /// Follows the changes of both sides into the first station of the wake (first_of_wake()).
    void join_sides() {
        auto& [upper, lower, wake] = layers_.stretches;
        const std::size_t u = upper.places.back(), l = lower.places.back(), w = wake.places.front();
        const Station &a = at(u), &b = at(l), &c = at(w);
        const Changes &of_a = changes_[u], &of_b = changes_[l];
        Changes& result = changes_[w];
        for (auto& row : result) row.assign(n_ + 2, 0);
        for (std::size_t j = 0; j < n_ + 2; ++j) {
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
        auto& [upper, lower, wake] = layers_.stretches;
        follow_stretch(upper, 1);
        follow_stretch(lower, -1);
        join_sides();
        follow_stretch(wake, 0);

        std::vector<double> matrix(n_ * n_), right(n_), shifted(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            const std::vector<double>& row = changes_[i][of_speed];
            for (std::size_t j = 0; j < n_; ++j)
                matrix[i * n_ + j] = sign(i) * influence_.matrix[i * n_ + j] * sign(j) - row[j];
            right[i] = row[constant()] - (outer_speed(i) - at(i).speed);
            shifted[i] = row[shifting()];
        }
        const std::vector<std::vector<double>> solved = solve_dense(std::move(matrix), std::vector{right, shifted});
        std::vector<double> flux = solved[0];
        const double way = way_of_stagnation(solved[0], solved[1]);
        for (std::size_t i = 0; i < n_; ++i) flux[i] += way * solved[1][i];
        return apply(flux, way);
    }

    double change_of(std::size_t place, std::size_t row, const std::vector<double>& flux, double way) const {
        const std::vector<double>& of = changes_[place][row];
        double sum = of[constant()] + way * of[shifting()];
        for (std::size_t j = 0; j < n_; ++j) sum += of[j] * flux[j];
        return sum;
    }

    /// Returns how far the stagnation point goes: as far as the speeds at its neighbours say that change with it.
    double way_of_stagnation(const std::vector<double>& flux, const std::vector<double>& by_way) const {
        const std::size_t a = layers_.stretches[0].places.front(), b = layers_.stretches[1].places.front();
        const double u = at(a).speed, v = at(b).speed;
        const double factor = (influence_.s[b] - influence_.s[a]) / ((u + v) * (u + v));
        const auto way = [&](double du, double dv) { return factor * (v * du - u * dv); };
        const double given = way(change_of(a, of_speed, flux, 0), change_of(b, of_speed, flux, 0));
        const double by_unit = way(change_of(a, of_speed, by_way, 1) - changes_[a][of_speed][constant()],
                                   change_of(b, of_speed, by_way, 1) - changes_[b][of_speed][constant()]);
        return given / (1 - by_unit);
    }

    double apply(const std::vector<double>& flux, double way) {
        constexpr double most_up = 1.5, most_down = -0.5, speed_scale = 0.25, exponent_scale = 10;
        // Places of transition that jump between two values, since closures have kinks, settle with half steps.
        constexpr int whole_steps = 15;
        std::vector<std::array<double, 4>> by(n_);  // shear, momentum, displacement, speed
        double part = layers_.steps < whole_steps ? 1 : 0.5, sum = 0;
        const auto limit = [&](double share) {
            sum += share * share;
            if (part * share > most_up) part = most_up / share;
            if (part * share < most_down) part = most_down / share;
        };
        for (std::size_t i = 0; i < n_; ++i) {
            const Station& s = at(i);
            by[i][0] = change_of(i, of_shear, flux, way);
            by[i][1] = change_of(i, of_momentum, flux, way);
            by[i][3] = change_of(i, of_speed, flux, way);
            by[i][2] = (flux[i] - s.displacement * by[i][3]) / s.speed;
            limit(by[i][0] / (is_laminar(i) ? exponent_scale : s.shear));
            limit(by[i][1] / s.momentum);
            limit(by[i][2] / s.displacement);
            limit(std::abs(by[i][3]) / speed_scale);
        }
        std::vector<double> along(influence_.wall);
        for (std::size_t i = 0; i < n_; ++i) {
            Station& s = at(i);
            s.shear += part * by[i][0];
            s.momentum += part * by[i][1];
            s.displacement += part * by[i][2];
            s.speed += part * by[i][3];
            if (i < influence_.wall) along[i] = sign(i) * s.speed;
            keep_in_range(s, i >= influence_.wall ? IntervalKind::wake
                             : is_laminar(i)      ? IntervalKind::laminar
                                                  : IntervalKind::turbulent);
        }
        move_nose(along);
        set_arcs();
        return std::sqrt(sum / (4 * static_cast<double>(n_)));
    }

    bool is_laminar(std::size_t place) const {
        const auto& [upper, lower, wake] = layers_.stretches;
        if (place >= influence_.wall) return false;
        const bool above = place <= upper.places.front();
        return above ? upper.places.front() - place < upper.transition
                     : place - lower.places.front() < lower.transition;
    }

    /// Gives nodes whose flow has turned round to the other side, with the layer of that side's first station.
    void move_nose(const std::vector<double>& along) {
        const std::size_t old = layers_.stretches[0].places.front();
        std::size_t nose = old;
        while (nose > 2 && along[nose] >= 0) --nose;
        while (nose + 4 < influence_.wall && along[nose + 1] < 0) ++nose;
        if (nose == old) return;
        const Station first = at(nose < old ? old + 1 : old);
        for (std::size_t i = std::min(nose, old) + 1; i <= std::max(nose, old); ++i) {
            at(i) = first;
            at(i).speed = std::abs(along[i]);
        }
        lay_stretches(nose);
        // Stations keep their regimes.
        auto& [upper, lower, wake] = layers_.stretches;
        const auto moved = static_cast<std::ptrdiff_t>(nose) - static_cast<std::ptrdiff_t>(old);
        const auto shift_transition = [](Stretch& side, std::ptrdiff_t by) {
            const auto to = static_cast<std::ptrdiff_t>(side.transition) + by;
            side.transition = static_cast<std::size_t>(std::max(to, std::ptrdiff_t{1}));
        };
        shift_transition(upper, moved);
        shift_transition(lower, -moved);
    }

    const Influence& influence_;
    const LayerConditions& conditions_;
    const Trips& trips_;
    std::size_t n_;
    CoupledLayers layers_;
    std::vector<Changes> changes_;
};

}  // namespace

CoupledLayers solve_layers(const Influence& influence, const LayerConditions& conditions, const Trips& trips,
                           const CoupledLayers* start) {
    return Solver(influence, conditions, trips).solve(start);
}

}  // namespace lamina::flow::coupled
