// Laminar part: B. Thwaites, Approximate calculation of the laminar boundary layer, Aeronaut. Q. 1 (1949), 245-280,
// with the fits to his tables by T. Cebeci and P. Bradshaw, Momentum Transfer in Boundary Layers (1977).
// Turbulent part: M. R. Head, Entrainment in the turbulent boundary layer, ARC R&M 3152 (1958), with the fits to his
// curves by Cebeci and Bradshaw, and the skin friction of F. M. White, Viscous Fluid Flow (1974), which T. W. Swafford,
// AIAA J. 21 (1983), and M. Drela and M. B. Giles, AIAA J. 25 (1987), took from there. The friction of Ludwieg and
// Tillmann, which goes with Head's method in textbooks, is 30 % too small at a Reynolds number of 1e9.
// Separated part: the plane mixing layer, S. B. Pope, Turbulent Flows (2000), section 5.4.2.
//
// Between the points the speed is a monotone cubic (F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984),
// 300-304), so that steps need not be those of the points. Every number formed here is a ratio of lengths, so that
// scaling all of them by a power of two scales the result exactly.
#include "flow/boundary_layer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/reproducible_math.hpp"

namespace lamina::flow {

namespace {

/// Speeds below it count as this one. It is far below the speeds that a flow without viscosity tells anything about,
/// and keeps sixth powers of ratios of speeds finite.
constexpr double least_speed = 1e-6;

// ---------------------------------------------------------------------------------------------------------------------
// Speed between the points

/// The speed between two neighbouring points, a cubic of t from 0 to 1.
struct Interval {
    double s, length;             ///< arc length of its first point, and up to its second
    double speed0, speed1;        ///< speeds at both
    double gradient0, gradient1;  ///< derivatives of the speed with respect to s at both

    double secant() const { return (speed1 - speed0) / length; }
    double speed(double t) const {
        if (t >= 1) return speed1;  // which the cubic would miss by its rounding
        const double a = length * gradient0, b = length * gradient1, rise = speed1 - speed0;
        const double cubic = speed0 + t * (a + t * ((3 * rise - 2 * a - b) + t * (a + b - 2 * rise)));
        return std::clamp(cubic, std::min(speed0, speed1), std::max(speed0, speed1));
    }
    double gradient(double t) const {
        const double mean = secant();
        return gradient0 +
               t * (2 * (3 * mean - 2 * gradient0 - gradient1) + t * (3 * (gradient0 + gradient1 - 2 * mean)));
    }
};

/// Returns the derivative at a point between intervals of the given lengths and secants: the harmonic mean of the
/// secants, or 0 at an extremum.
double gradient_between(double length0, double secant0, double length1, double secant1) {
    if (!(secant0 * secant1 > 0)) return 0;
    const double weight0 = length0 + 2 * length1, weight1 = 2 * length0 + length1;
    return (weight0 + weight1) / (weight0 / secant0 + weight1 / secant1);
}

/// Returns the intervals between the points. One between points with the same s has length 0 and nothing else.
std::vector<Interval> make_intervals(std::span<const EdgePoint> points) {
    const bool from_stagnation = points[0].speed <= least_speed;
    const auto speed = [&](std::size_t i) {
        return i == 0 && from_stagnation ? 0.0 : std::max(points[i].speed, least_speed);
    };
    std::vector<Interval> intervals;
    intervals.reserve(points.size());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double length = std::max(points[i + 1].s - points[i].s, 0.0);
        const double secant = length > 0 ? (speed(i + 1) - speed(i)) / length : 0.0;
        intervals.push_back({points[i].s, length, speed(i), speed(i + 1), secant, secant});
    }
    // The gradient at the end of an interval is its secant until the loop gets there.
    for (std::size_t i = 0; i + 1 < intervals.size(); ++i) {
        Interval &before = intervals[i], &after = intervals[i + 1];
        const double gradient = gradient_between(before.length, before.gradient1, after.length, after.gradient1);
        before.gradient1 = after.gradient0 = gradient;
    }
    // The flow at a stagnation point is linear, and Thwaites' integral is exact there.
    if (!intervals.empty() && from_stagnation && intervals[0].length > 0)
        intervals[0].gradient0 = intervals[0].gradient1 = intervals[0].secant();
    return intervals;
}

// ---------------------------------------------------------------------------------------------------------------------
// Closures

/// Thwaites' parameter, momentum thickness^2 x gradient / viscosity, where the skin friction becomes 0.
constexpr double laminar_separation = -0.09;

double clamp_parameter(double lambda) { return std::clamp(lambda, laminar_separation, 0.25); }

/// Returns the shear parameter l: shear stress at the wall x momentum thickness / (viscosity x speed). The fit of the
/// range 0 to 0.1 agrees with Thwaites' table up to its end, 0.25.
double laminar_shear(double lambda) {
    if (lambda >= 0) return 0.22 + lambda * (1.57 - 1.8 * lambda);
    return std::max(0.22 + 1.402 * lambda + 0.018 * lambda / (0.107 + lambda), 0.0);
}

double laminar_shape(double lambda) {
    return lambda >= 0 ? 2.61 + lambda * (-3.75 + 5.24 * lambda) : 2.088 + 0.0731 / (0.14 + lambda);
}

/// Returns the thickness over the momentum thickness. Thwaites gives none; this is a fit to the profiles of Falkner and
/// Skan, where it is within 2 %, or 8 % at separation.
double laminar_thickness(double lambda) {
    const double x = std::min(lambda, 0.11);
    return 7.39 + x * (3.0 + 65.0 * x);
}

/// Returns base^exponent. It is exact to about |exponent log(base)| units in the last place, and fast.
double power(double base, double exponent) { return core::exp_reproducible(exponent * core::log_reproducible(base)); }

/// Returns Head's second shape factor H1 = (thickness - displacement thickness) / momentum thickness.
double entrainment_shape(double shape) {
    return shape <= 1.6 ? 3.3 + 0.8234 * power(shape - 1.1, -1.287) : 3.3 + 1.5501 * power(shape - 0.6778, -3.064);
}

/// Returns the shape factor that belongs to H1 > 3.3, the inverse of entrainment_shape(). The two branches of that
/// leave a gap of 0.02 in H1 at 1.6.
double shape_from(double entrainment_shape) {
    const double x = entrainment_shape - 3.3;
    const double attached = 1.1 + power(x * (1 / 0.8234), -1 / 1.287);
    return attached <= 1.6 ? attached : std::max(0.6778 + power(x * (1 / 1.5501), -1 / 3.064), 1.6);
}

/// Returns Head's rate of entrainment over the edge speed.
double entrainment_rate(double entrainment_shape) { return 0.0306 * power(entrainment_shape - 3.0, -0.6169); }

/// Returns the skin friction over the dynamic pressure at the edge. The law holds for Reynolds numbers of the momentum
/// thickness from some hundred; below 50, where it would soon be infinite, it stays constant.
double turbulent_friction(double shape, double reynolds) {
    constexpr double decades = 1 / 2.302585092994046;
    const double logarithm = decades * core::log_reproducible(std::max(reynolds, 50.0));
    return 0.3 * core::exp_reproducible(-1.33 * shape - (1.74 + 0.31 * shape) * core::log_reproducible(logarithm));
}

/// Returns the shape factor of the turbulent layer on a plate, for which entrainment keeps H1 constant:
/// F(H1) = H1 cf / 2. A turbulent layer starts with it, so that it has no transient on a plate.
double equilibrium_shape(double reynolds) {
    double low = 1.15, high = separation_shape;
    for (int i = 0; i < 40; ++i) {
        const double shape = 0.5 * (low + high), h1 = entrainment_shape(shape);
        (entrainment_rate(h1) > 0.5 * h1 * turbulent_friction(shape, reynolds) ? high : low) = shape;
    }
    return 0.5 * (low + high);
}

// ---------------------------------------------------------------------------------------------------------------------
// Layers on their way along the wall

/// How often the place where the state changes is narrowed down by half.
constexpr int halvings = 45;

/// What follows from the momentum thickness and the flux of a turbulent layer.
struct Closure {
    double entrainment_shape, shape;  ///< H1 and H
    double friction;                  ///< skin friction over the dynamic pressure at the edge
    double entrainment;               ///< rate of entrainment over the edge speed
};

/// A laminar, turbulent or separated layer at one place.
struct Layer {
    BoundaryLayerState state = BoundaryLayerState::laminar;
    double squared_momentum = 0;  ///< laminar: momentum thickness^2
    double momentum = 0;          ///< turbulent: momentum thickness
    double flux = 0;              ///< turbulent: edge speed x (thickness - displacement thickness), the flux inside
    Closure closure{};            ///< turbulent: what follows from both
    LayerPoint separation;        ///< separated: the layer where that happened
    double separated_at = 0;      ///< separated: s there
    double separation_speed = 0;  ///< separated: speed at the edge there
};

/// Returns the squared momentum thickness after a way along which the speed is linear. Thwaites' integral is exact
/// then: theta^2 u^6 = 0.45 nu int u^5 ds. From a stagnation point it gives the known limit 0.075 nu / (du/ds).
double thwaites_step(double squared_momentum, double speed0, double speed1, double way, double viscosity) {
    const double r = speed0 / speed1, r2 = r * r;
    const double sum = (1 + r) * (1 + r2 + r2 * r2);
    return squared_momentum * (r2 * r2 * r2) + 0.45 * viscosity * way * sum / (6 * speed1);
}

/// Says whether a laminar layer of the interval ends before t, where its momentum thickness is given.
bool laminar_ends(const Interval& interval, double t, double squared_momentum, const BoundaryLayerOptions& options) {
    if (squared_momentum * interval.gradient(t) <= laminar_separation * options.viscosity) return true;
    if (!options.turbulent) return false;
    const double reynolds = std::sqrt(squared_momentum) * interval.speed(t) / options.viscosity;
    return reynolds >= sustaining_reynolds && interval.s + t * interval.length >= options.transition.value_or(0);
}

Closure close_turbulent(double momentum, double flux, double speed, double viscosity) {
    const double h1 = std::max(flux / (speed * momentum), 3.4);  // trial steps lead beyond separation
    const double shape = shape_from(h1);
    return {h1, shape, turbulent_friction(shape, speed * momentum / viscosity), entrainment_rate(h1)};
}

/// Starts a turbulent layer of the given thickness and shape.
void start_turbulent(Layer& layer, double momentum, double shape, double speed, double viscosity) {
    layer.state = BoundaryLayerState::turbulent;
    layer.momentum = momentum;
    layer.flux = speed * momentum * entrainment_shape(shape);
    layer.closure = close_turbulent(momentum, layer.flux, speed, viscosity);
}

/// Separates a laminar layer at a place of an interval.
void separate_laminar(Layer& layer, const Interval& interval, double t) {
    const double momentum = std::sqrt(layer.squared_momentum), shape = laminar_shape(laminar_separation);
    layer.separation = {momentum,
                        shape * momentum,
                        laminar_thickness(laminar_separation) * momentum,
                        shape,
                        0,
                        BoundaryLayerState::separated};
    layer.separated_at = interval.s + t * interval.length;
    layer.separation_speed = interval.speed(t);
    layer.state = BoundaryLayerState::separated;
}

/// Leads a laminar layer through the interval, or up to where it becomes turbulent or separates for lack of turbulence.
/// Returns the t where it ended.
double march_laminar(Layer& layer, const Interval& interval, const BoundaryLayerOptions& options) {
    constexpr int steps = 4;
    for (int step = 0; step < steps; ++step) {
        const double t0 = static_cast<double>(step) / steps, speed0 = interval.speed(t0);
        const auto squared_at = [&](double t) {
            return thwaites_step(layer.squared_momentum, speed0, interval.speed(t), (t - t0) * interval.length,
                                 options.viscosity);
        };
        double end = t0 + 1.0 / steps;
        if (!laminar_ends(interval, end, squared_at(end), options)) {
            layer.squared_momentum = squared_at(end);
            continue;
        }
        double begin = t0;
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (begin + end);
            (laminar_ends(interval, middle, squared_at(middle), options) ? end : begin) = middle;
        }
        layer.squared_momentum = squared_at(end);
        if (!options.turbulent) {
            separate_laminar(layer, interval, end);
            return end;
        }
        const double momentum = std::sqrt(layer.squared_momentum), speed = interval.speed(end);
        start_turbulent(layer, momentum, equilibrium_shape(speed * momentum / options.viscosity), speed,
                        options.viscosity);
        return end;
    }
    return 1;
}

/// Separates the layer where, in a step that leads to the given values, its shape factor becomes that of separation.
void separate(Layer& layer, double momentum, double shape, const Interval& interval, double begin, double end) {
    const double change = shape - layer.closure.shape;
    const double part = change > 0 ? std::max(separation_shape - layer.closure.shape, 0.0) / change : 0.0;
    const double at = layer.momentum + part * (momentum - layer.momentum), h1 = entrainment_shape(separation_shape);
    layer.separation = {at, separation_shape * at,        (h1 + separation_shape) * at, separation_shape,
                        0,  BoundaryLayerState::separated};
    const double place = begin + part * (end - begin);
    layer.separated_at = interval.s + place * interval.length;
    layer.separation_speed = interval.speed(place);
    layer.state = BoundaryLayerState::separated;
}

/// Leads a turbulent layer through the rest of the interval, from t on, or up to where it separates, by von Karman's
/// equation, d theta / ds = cf / 2 - (H + 2) theta / u du/ds, and Head's, d(u theta H1) / ds = u F(H1). The steps of
/// the midpoint rule are short against the length over which the layer adapts, some 200 momentum thicknesses, and
/// against that over which the speed changes.
void march_turbulent(Layer& layer, const Interval& interval, double t, double viscosity) {
    constexpr double momentum_steps = 50, speed_change = 0.05, most_steps = 300;
    const double steepest =
        std::max({std::abs(interval.gradient0), std::abs(interval.gradient1), 1.5 * std::abs(interval.secant())});
    const auto thickening = [&](const Closure& closure, double momentum, double at) {
        return 0.5 * closure.friction - (closure.shape + 2) * momentum * interval.gradient(at) / interval.speed(at);
    };
    // No step more than doubles or halves the thickness, whatever the speeds do.
    const auto changed = [&](double by) {
        return std::clamp(layer.momentum + by, 0.5 * layer.momentum, 2 * layer.momentum);
    };
    while (t < 1) {
        const double speed = interval.speed(t);
        double way = momentum_steps * layer.momentum;
        if (way * steepest > speed_change * speed) way = speed_change * speed / steepest;
        const double step = std::min(std::max(way / interval.length, 1 / most_steps), 1 - t);
        way = step * interval.length;

        const double middle = t + 0.5 * step, middle_speed = interval.speed(middle);
        const double middle_momentum = changed(0.5 * way * thickening(layer.closure, layer.momentum, t));
        const Closure closure = close_turbulent(
            middle_momentum, layer.flux + 0.5 * way * speed * layer.closure.entrainment, middle_speed, viscosity);
        const double end = step < 1 - t ? t + step : 1.0;
        const double momentum = changed(way * thickening(closure, middle_momentum, middle));
        const double flux = layer.flux + way * middle_speed * closure.entrainment;
        const Closure next = close_turbulent(momentum, flux, interval.speed(end), viscosity);
        if (next.shape > separation_shape) return separate(layer, momentum, next.shape, interval, t, end);
        layer.momentum = momentum;
        layer.flux = flux;
        layer.closure = next;
        t = end;
    }
}

/// Returns a separated layer at s. A plane mixing layer beside fluid at rest spreads by 0.06 to 0.11 of its length to
/// either side. The larger number is taken, since a mesh suffers from layers that are too thin. Half of what is added
/// is displaced.
LayerPoint separated_point(const Layer& layer, double s) {
    constexpr double spreading = 0.11;
    LayerPoint point = layer.separation;
    const double growth = spreading * std::max(s - layer.separated_at, 0.0);
    point.thickness += growth;
    point.displacement += 0.5 * growth;
    point.shape = point.displacement / point.momentum;
    return point;
}

/// Leads a separated layer through the interval, or up to where it reattaches. Returns the t where it ended. The
/// pressure under a separated layer is that where it left the wall, so it comes back where the pressure outside falls
/// below that: where the edge speed exceeds that of separation. The turbulent layer goes on with the shape factor that
/// it had when it separated, and with the thickness that it has got meanwhile. Without turbulence it does not come
/// back.
double march_separated(Layer& layer, const Interval& interval, const BoundaryLayerOptions& options) {
    if (!options.turbulent || !(interval.speed1 > layer.separation_speed)) return 1;
    double begin = 0, end = 1;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (begin + end);
        (interval.speed(middle) > layer.separation_speed ? end : begin) = middle;
    }
    const LayerPoint point = separated_point(layer, interval.s + end * interval.length);
    const double momentum = point.momentum * (point.thickness / layer.separation.thickness);
    start_turbulent(layer, momentum, separation_shape, interval.speed(end), options.viscosity);
    return end;
}

// ---------------------------------------------------------------------------------------------------------------------
// Layers at the points

LayerPoint laminar_point(double squared_momentum, double speed, double gradient, double viscosity) {
    const double lambda = clamp_parameter(squared_momentum * gradient / viscosity);
    const double momentum = std::sqrt(squared_momentum), shape = laminar_shape(lambda);
    const double friction = momentum > 0 ? 2 * viscosity * speed * laminar_shear(lambda) / momentum : 0.0;
    return {momentum, shape * momentum, laminar_thickness(lambda) * momentum,
            shape,    friction,         BoundaryLayerState::laminar};
}

/// Returns the layer at the end of an interval.
LayerPoint point_at_end(const Layer& layer, const Interval& interval, double viscosity) {
    const double speed = interval.speed1;
    if (layer.state == BoundaryLayerState::laminar)
        return laminar_point(layer.squared_momentum, speed, interval.gradient1, viscosity);
    if (layer.state == BoundaryLayerState::turbulent) {
        const Closure& c = layer.closure;
        // A layer too thin for turbulence, behind an early laminar separation, rubs no less than the laminar plate.
        const double friction = std::max(c.friction, 0.441 * viscosity / (speed * layer.momentum));
        return {layer.momentum, c.shape * layer.momentum, (c.entrainment_shape + c.shape) * layer.momentum,
                c.shape,        friction * speed * speed, BoundaryLayerState::turbulent};
    }
    return separated_point(layer, interval.s + interval.length);
}

/// Returns the layer at the first point.
LayerPoint first_point(const Interval& interval, double viscosity) {
    if (interval.speed0 > 0) return laminar_point(0, interval.speed0, interval.gradient0, viscosity);
    const double squared = thwaites_step(0, 0, interval.speed1, interval.length, viscosity);
    return laminar_point(squared, 0, interval.gradient0, viscosity);
}

}  // namespace

std::vector<LayerPoint> boundary_layer(std::span<const EdgePoint> points, const BoundaryLayerOptions& options) {
    assert(options.viscosity > 0);
    std::vector<LayerPoint> result;
    result.reserve(points.size());
    if (points.empty()) return result;
    const std::vector<Interval> intervals = make_intervals(points);
    result.push_back(intervals.empty() ? laminar_point(0, 0, 0, options.viscosity)
                                       : first_point(intervals.front(), options.viscosity));
    Layer layer;
    for (const Interval& interval : intervals) {
        if (!(interval.length > 0)) {
            result.push_back(result.back());
            continue;
        }
        double t = 0;
        if (layer.state == BoundaryLayerState::laminar) t = march_laminar(layer, interval, options);
        if (layer.state == BoundaryLayerState::separated) t = march_separated(layer, interval, options);
        if (layer.state == BoundaryLayerState::turbulent) march_turbulent(layer, interval, t, options.viscosity);
        result.push_back(point_at_end(layer, interval, options.viscosity));
    }
    if (points[0].speed > least_speed && points.size() > 1 && points[1].s > points[0].s) {
        // At a leading edge all of the lost momentum is friction, where the speed is constant.
        const double speed = intervals[0].speed1;
        result[0].skin_friction = 2 * speed * speed * result[1].momentum / intervals[0].length;
    }
    return result;
}

LayerPoint flat_plate(double s, double viscosity, bool turbulent) {
    assert(s >= 0 && viscosity > 0);
    if (!(s > 0)) return {0, 0, 0, 2.591, 0, BoundaryLayerState::laminar};
    const double reynolds = s / viscosity, root = std::sqrt(reynolds);
    if (!turbulent || 0.664 * root < sustaining_reynolds)
        return {0.664 * s / root, 1.7208 * s / root, 4.91 * s / root, 2.591, 0.664 / root, BoundaryLayerState::laminar};
    const double seventh = power(reynolds, 1.0 / 7);
    const double thickness = 0.16 * s / seventh;
    return {7.0 / 72 * thickness, thickness / 8, thickness, 9.0 / 7, 0.027 / seventh, BoundaryLayerState::turbulent};
}

double wake_thickness(double thickness_upper, double thickness_lower, double momentum_total, double distance) {
    const double start = thickness_upper + thickness_lower;
    constexpr double half_width = 0.57;  // over sqrt(distance x twice the momentum thickness)
    return std::sqrt(start * start + 8 * half_width * half_width * momentum_total * distance);
}

}  // namespace lamina::flow
