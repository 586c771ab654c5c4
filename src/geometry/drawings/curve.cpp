#include "geometry/drawings/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/reproducible_math.hpp"

namespace lamina::geometry {

namespace {

constexpr double quarter_turn = 0.5 * core::pi;

/// Returns the index of the knot at which the piece with a parameter begins.
template <class Position>
std::size_t piece_of(const BSpline<Position>& curve, double parameter) {
    const auto begin = curve.knots.begin() + static_cast<std::ptrdiff_t>(curve.degree);
    const auto end = curve.knots.begin() + static_cast<std::ptrdiff_t>(curve.control.size());
    const auto above = std::upper_bound(begin, end, parameter);
    // At the end of the range the last piece of any length counts.
    auto k = above == begin ? begin : above - 1;
    while (k > begin && *k == *(k + 1)) --k;
    return static_cast<std::size_t>(k - curve.knots.begin());
}

/// De Boor's algorithm on points with their weights.
template <class Position>
Position evaluate(const BSpline<Position>& curve, double parameter) {
    const std::size_t p = curve.degree, k = piece_of(curve, parameter);
    std::array<Position, max_curve_degree + 1> points;
    std::array<double, max_curve_degree + 1> weights;
    for (std::size_t j = 0; j <= p; ++j) {
        const std::size_t i = k - p + j;
        weights[j] = curve.weights.empty() ? 1 : curve.weights[i];
        points[j] = weights[j] * curve.control[i];
    }
    for (std::size_t r = 1; r <= p; ++r) {
        for (std::size_t j = p; j >= r; --j) {
            const double low = curve.knots[k - p + j], high = curve.knots[k + 1 + j - r];
            const double share = high > low ? (parameter - low) / (high - low) : 0;
            points[j] = (1 - share) * points[j - 1] + share * points[j];
            weights[j] = (1 - share) * weights[j - 1] + share * weights[j];
        }
    }
    return curve.weights.empty() ? points[p] : (1 / weights[p]) * points[p];
}

}  // namespace

SpaceCurve polyline(std::vector<Point3> vertices) {
    SpaceCurve curve;
    curve.knots.push_back(0);
    for (std::size_t i = 0; i < vertices.size(); ++i) curve.knots.push_back(static_cast<double>(i));
    curve.knots.push_back(curve.knots.back());
    curve.control = std::move(vertices);
    use_whole_range(curve);
    return curve;
}

SpaceCurve bezier(std::vector<Point3> control) {
    SpaceCurve curve;
    curve.degree = control.size() - 1;
    curve.knots.assign(control.size(), 0);
    curve.knots.insert(curve.knots.end(), control.size(), 1);
    curve.control = std::move(control);
    return curve;
}

SpaceCurve elliptic_arc(Point3 center, Point3 u, Point3 v, double from, double sweep) {
    constexpr double slack = 1e-9;  // a whole turn has four pieces, however its angle is rounded
    const double pieces = std::max(1.0, std::ceil(std::abs(sweep) / quarter_turn - slack));
    const double step = sweep / pieces, middle_weight = core::cos_reproducible(0.5 * step);
    const auto on_circle = [&](double angle, double radius) {
        return center + radius * core::cos_reproducible(angle) * u + radius * core::sin_reproducible(angle) * v;
    };
    SpaceCurve curve;
    curve.degree = 2;
    curve.knots = {0};
    for (double k = 0; k < pieces; ++k) {
        curve.knots.insert(curve.knots.end(), 2, k);
        const double angle = from + k * step;
        curve.control.push_back(on_circle(angle, 1));
        curve.weights.push_back(1);
        curve.control.push_back(on_circle(angle + 0.5 * step, 1 / middle_weight));
        curve.weights.push_back(middle_weight);
    }
    curve.knots.insert(curve.knots.end(), 3, pieces);
    const bool is_whole = std::abs(sweep) >= 4 * quarter_turn - slack;
    curve.control.push_back(is_whole ? curve.control.front() : on_circle(from + sweep, 1));
    curve.weights.push_back(1);
    use_whole_range(curve);
    return curve;
}

SpaceCurve bulged_arc(Point3 a, Point3 b, double bulge) {
    const Point3 half = 0.5 * (b - a), across{-half.y, half.x, 0};
    // The centre is to the left of the chord by half of it times the cotangent of half the angle.
    const Point3 center = 0.5 * (a + b) + (1 - bulge * bulge) / (2 * bulge) * across;
    const Point3 u = a - center;
    SpaceCurve arc = elliptic_arc(center, u, {-u.y, u.x, 0}, 0, 4 * core::atan2_reproducible(bulge, 1));
    arc.control.front() = a;
    arc.control.back() = b;
    return arc;
}

void use_whole_range(SpaceCurve& curve) {
    if (curve.knots.size() <= curve.degree || curve.knots.size() <= curve.control.size()) return;
    curve.first = curve.knots[curve.degree];
    curve.last = curve.knots[curve.control.size()];
}

std::string defect_of(const SpaceCurve& curve) {
    const std::size_t n = curve.control.size();
    if (curve.degree < 1 || curve.degree > max_curve_degree)
        return fmt::format("its degree is not from 1 to {}", max_curve_degree);
    if (n < curve.degree + 1) return fmt::format("it has {} control points for degree {}", n, curve.degree);
    if (curve.knots.size() != n + curve.degree + 1)
        return fmt::format("it has {} knots where {} belong", curve.knots.size(), n + curve.degree + 1);
    if (!curve.weights.empty() && curve.weights.size() != n)
        return fmt::format("it has {} weights for {} control points", curve.weights.size(), n);
    if (!std::is_sorted(curve.knots.begin(), curve.knots.end())) return "its knots do not ascend";
    if (std::any_of(curve.weights.begin(), curve.weights.end(), [](double w) { return !(w > 0); }))
        return "a weight is not positive";
    if (!(curve.first < curve.last)) return "its parameters end where they begin";
    if (curve.first < curve.knots[curve.degree] || curve.last > curve.knots[n])
        return "its parameters end outside its knots";
    return {};
}

SpaceCurve mapped(SpaceCurve curve, const Frame3& frame) {
    for (Point3& p : curve.control) p = frame(p);
    return curve;
}

Point at(const PlaneCurve& curve, double parameter) { return evaluate(curve, parameter); }
Point3 at(const SpaceCurve& curve, double parameter) { return evaluate(curve, parameter); }

std::vector<double> piece_ends(const PlaneCurve& curve) {
    std::vector<double> ends{curve.first};
    for (const double knot : curve.knots)
        if (knot > ends.back() && knot < curve.last) ends.push_back(knot);
    ends.push_back(curve.last);
    return ends;
}

Point direction(const PlaneCurve& curve, double parameter, bool is_ahead) {
    constexpr double step_share = 1e-5;  // of the piece beside the parameter
    const std::vector<double>& knots = curve.knots;
    double end = is_ahead ? curve.last : curve.first;
    if (is_ahead) {
        const auto next = std::upper_bound(knots.begin(), knots.end(), parameter);
        if (next != knots.end()) end = std::min(end, *next);
    } else {
        const auto next = std::lower_bound(knots.begin(), knots.end(), parameter);
        if (next != knots.begin()) end = std::max(end, *(next - 1));
    }
    const Point here = at(curve, parameter);
    for (double share = step_share; share <= 1; share *= 10) {
        const Point there = at(curve, parameter + share * (end - parameter));
        if (!(there == here)) return is_ahead ? there - here : here - there;
    }
    return {};
}

}  // namespace lamina::geometry
