// Source: J. F. Thompson, B. K. Soni, N. P. Weatherill, Handbook of Grid Generation (1999), chapter 3
// (equidistribution).
#include "surface/divide_curves.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/reproducible_math.hpp"
#include "core/rounding.hpp"

namespace lamina::surface {

namespace {

/// Calls visit(i, a, b, part) for steps along a curve: from share a to share b of the way from sample i to the next
/// one, the integral of ds / spacing is `part`. The spacing is linear between samples, and steps are short against it.
template <class Visit>
void for_each_step(const CurveSamples& samples, Visit&& visit) {
    constexpr double max_step_share = 0.25;  // of the spacing
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const double ds = samples[i + 1].arc_length - samples[i].arc_length;
        const double h0 = samples[i].spacing, h1 = samples[i + 1].spacing;
        const double steps = std::ceil(ds / (max_step_share * std::min(h0, h1)));
        for (double k = 0; k < steps; ++k) {
            const double a = k / steps, b = (k + 1) / steps;
            const double ha = h0 + a * (h1 - h0), hb = h0 + b * (h1 - h0);
            visit(i, a, b, 0.5 * ds / steps * (1 / ha + 1 / hb));
        }
    }
}

double integrate(const CurveSamples& samples) {
    double sum = 0;
    for_each_step(samples, [&](std::size_t, double, double, double part) { sum += part; });
    return sum;
}

/// The edges that a curve is divided into.
struct EdgeCount {
    double integral;                   ///< integral of ds / spacing along the curve
    double edges;                      ///< a whole number
    double first_length, last_length;  ///< lengths of the first and the last edge
};

/// Returns the number of edges of a curve: at least min_edges and as many as its spacings ask for; an even number if
/// is_even.
double needed_edges(double integral, double min_edges, bool is_even) {
    constexpr double slack = 1e-6;  // of an edge, so that rounding does not decide
    const double edges = std::max(std::ceil(integral - slack), min_edges);
    return is_even ? 2 * std::ceil(0.5 * edges - 0.25) : edges;
}

/// Divides a curve, along which the integral of ds / spacing is `integral`, into this number of edges.
EdgeCount measure_edges(const CurveSamples& samples, double integral, double edges) {
    const double edge = integral / edges, length = samples.back().arc_length;
    EdgeCount count{integral, edges, length, length};
    double done = 0;
    for_each_step(samples, [&](std::size_t i, double a, double b, double part) {
        const auto arc_length_at = [&](double value) {
            const double share = a + (b - a) * ((value - done) / part);
            return samples[i].arc_length + share * (samples[i + 1].arc_length - samples[i].arc_length);
        };
        if (done < edge && done + part >= edge) count.first_length = arc_length_at(edge);
        const double before_last = integral - edge;
        if (done < before_last && done + part >= before_last) count.last_length = length - arc_length_at(before_last);
        done += part;
    });
    return count;
}

/// Lowers the spacings at corners whose two edges differ by more than the rule allows: the whole numbers of edges make
/// short curves finer than their spacing asks for. The shorter edge becomes the spacing on both sides, unless the
/// longer one is kept. Returns the curves at whose start a spacing was lowered.
std::vector<std::size_t> even_out_corners(std::span<const OutlineCurve> curves, std::vector<CurveSamples>& samples,
                                          std::span<const EdgeCount> counts, const SpacingRule& rule) {
    constexpr double max_factor = 0.98;  // so that every round changes something
    std::vector<std::size_t> lowered;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::size_t j = (i + 1) % curves.size();
        const double before = counts[i].last_length, after = counts[j].first_length;
        if (std::max(before, after) <= rule.max_corner_ratio * std::min(before, after)) continue;
        if (curves[before > after ? i : j].is_kept) continue;
        double &end = samples[i].back().spacing, &start = samples[j].front().spacing;
        const double spacing =
            std::min(max_factor * std::min(end, start), std::min(before, after) / (1 + 0.5 * rule.gradation));
        if (spacing < rule.min_spacing) continue;
        if (!curves[i].is_kept) end = spacing;
        if (!curves[j].is_kept) start = spacing;
        lowered.push_back(j);
    }
    return lowered;
}

/// Curves with their graded spacings, and the edges of each.
struct DivisionPlan {
    std::vector<CurveSamples> samples;
    std::vector<EdgeCount> counts;

    /// Returns the number of edges of all curves.
    double edges() const {
        return std::accumulate(counts.begin(), counts.end(), 0.0, [](double sum, auto& c) { return sum + c.edges; });
    }
};

/// Plans the edges of the curves: as many as their spacings ask for, or those of `edges`, one number for each curve.
DivisionPlan make_plan(std::span<const OutlineCurve> curves, SampledOutline outline, const SpacingRule& rule,
                       std::span<const double> edges = {}) {
    constexpr int max_rounds = 30;
    const auto min_edges = static_cast<double>(least_edges_of_curve(curves));
    const auto count = [&](std::size_t i, const CurveSamples& samples) {
        if (curves[i].is_kept) {
            const auto kept = static_cast<double>(curves[i].kept_edges);
            const double edge = samples.back().arc_length / kept;
            return EdgeCount{integrate(samples), kept, edge, edge};
        }
        const bool is_even = std::abs(outline.turning[i]) > 0.5 * core::pi;
        const double integral = integrate(samples);
        return measure_edges(samples, integral, edges.empty() ? needed_edges(integral, min_edges, is_even) : edges[i]);
    };
    DivisionPlan plan{std::move(outline.samples), std::vector<EdgeCount>(curves.size())};
    std::vector<bool> is_changed(curves.size(), true);
    limit_gradation(curves, plan.samples, rule.gradation);
    for (int round = 1;; ++round) {
        for (std::size_t i = 0; i < curves.size(); ++i) {
            if (is_changed[i]) plan.counts[i] = count(i, plan.samples[i]);
        }
        if (curves.size() == 1 || round == max_rounds) break;
        is_changed.assign(curves.size(), false);
        const std::vector<std::size_t> lowered = even_out_corners(curves, plan.samples, plan.counts, rule);
        for (const std::size_t i : lowered) {
            is_changed[i] = is_changed[(i + curves.size() - 1) % curves.size()] = true;
            limit_gradation_from(i, curves, plan.samples, rule.gradation, is_changed);
        }
        if (lowered.empty()) break;
    }
    return plan;
}

double distance_to_chord(Point p, Point a, Point b) {
    const double chord = distance(a, b);
    return chord > 0 ? std::abs(cross(b - a, p - a)) / chord : distance(p, a);
}

/// Appends the first point of a curve and those between its edges, but not its last one.
void place_points(const SplineCurve& curve, const CurveSamples& samples, const EdgeCount& count,
                  DividedCurves& result) {
    result.starts.push_back(result.points.size());
    result.points.push_back(samples.front().at);
    result.positions.push_back(0);
    double sum = 0, next = 1;
    std::size_t first_sample = 0;  // of the edge that begins at the last point
    const auto finish_edge = [&](Point end, std::size_t last_sample) {
        for (std::size_t i = first_sample; i <= last_sample; ++i)
            result.deviation = std::max(result.deviation, distance_to_chord(samples[i].at, result.points.back(), end));
    };
    for_each_step(samples, [&](std::size_t i, double a, double b, double part) {
        const double edge = count.integral / count.edges;
        while (next < count.edges && sum + part >= next * edge) {
            const double share = a + (b - a) * ((next * edge - sum) / part);
            const CurveSample &from = samples[i], &to = samples[i + 1];
            const double start = from.piece == to.piece ? from.share : 0;
            const double length = to.share - start;
            // Rounding errors of the integrals move no point, and what falls on a given point is that point exactly,
            // such as the nose of a symmetric section.
            const double on_piece = core::rounded_place(start + share * length, length * (b - a) * edge / part);
            const Point at = curve.at(to.piece, on_piece);
            finish_edge(at, i);
            first_sample = i + 1;
            result.points.push_back(at);
            result.positions.push_back(static_cast<double>(to.piece) + on_piece);
            ++next;
        }
        sum += part;
    });
    finish_edge(samples.back().at, samples.size() - 1);
}

DividedCurves place_all_points(std::span<const OutlineCurve> curves, const DivisionPlan& plan) {
    DividedCurves result;
    for (std::size_t i = 0; i < curves.size(); ++i)
        place_points(curves[i].curve, plan.samples[i], plan.counts[i], result);
    return result;
}

/// Returns the samples with the spacings of curves that are not kept multiplied by a factor, one for each curve.
SampledOutline scaled(const SampledOutline& outline, std::span<const OutlineCurve> curves,
                      std::span<const double> factors) {
    SampledOutline result = outline;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        if (curves[i].is_kept) continue;
        for (CurveSample& sample : result.samples[i]) sample.spacing *= factors[i];
    }
    return result;
}

/// Returns the integrals of ds / spacing along the curves, with these spacings limited in their growth; for kept curves
/// their numbers of edges.
std::vector<double> graded_integrals(SampledOutline outline, std::span<const OutlineCurve> curves, double gradation) {
    limit_gradation(curves, outline.samples, gradation);
    std::vector<double> integrals;
    for (std::size_t i = 0; i < curves.size(); ++i)
        integrals.push_back(curves[i].is_kept ? static_cast<double>(curves[i].kept_edges)
                                              : integrate(outline.samples[i]));
    return integrals;
}

double sum_of(std::span<const double> values, const CurveGroup& group) {
    return std::accumulate(group.curves.begin(), group.curves.end(), 0.0,
                           [&](double sum, std::size_t i) { return sum + values[i]; });
}

/// Sets whole numbers of edges of the curves of a group in proportion to their integrals: each gets the whole part of
/// its share, at least min_edges, and those with the largest remainders one more (of equal ones the first).
void share_out(const CurveGroup& group, std::span<const double> integrals, double min_edges,
               std::vector<double>& counts) {
    std::vector<double> remainders(integrals.size(), -HUGE_VAL);
    const double scale = static_cast<double>(group.edges) / sum_of(integrals, group);
    for (const std::size_t i : group.curves) {
        counts[i] = std::max(std::floor(scale * integrals[i]), min_edges);
        remainders[i] = scale * integrals[i] - counts[i];
    }
    // Short curves that have min_edges take edges from the others, where the sum is too large.
    for (double left = static_cast<double>(group.edges) - sum_of(counts, group); left != 0;) {
        const double step = left > 0 ? 1 : -1;
        std::size_t best = integrals.size();
        for (const std::size_t i : group.curves) {
            if (counts[i] + step < min_edges) continue;
            if (best == integrals.size() || step * remainders[i] > step * remainders[best]) best = i;
        }
        assert(best < integrals.size());
        counts[best] += step;
        remainders[best] -= step;
        left -= step;
    }
}

}  // namespace

std::vector<std::vector<double>> edges_of_pieces(std::span<const OutlineCurve> curves, const SpacingRule& rule,
                                                 SampledCurves& known) {
    SampledOutline outline = sample_spacings(curves, rule, known);
    limit_gradation(curves, outline.samples, rule.gradation);
    std::vector<std::vector<double>> edges;
    for (std::size_t c = 0; c < curves.size(); ++c) {
        const CurveSamples& samples = outline.samples[c];
        std::vector<double>& of_pieces = edges.emplace_back(curves[c].curve.pieces(), 0.0);
        for_each_step(samples,
                      [&](std::size_t i, double, double, double part) { of_pieces[samples[i + 1].piece] += part; });
    }
    return edges;
}

std::size_t least_edges_of_curve(std::span<const OutlineCurve> curves) {
    return curves.size() == 1 ? 3 : curves.size() == 2 ? 2 : 1;
}

DividedCurves divide_curves(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known) {
    return place_all_points(curves, make_plan(curves, sample_spacings(curves, rule, known), rule));
}

DividedCurves divide_curves_into(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known,
                                 std::size_t edges) {
    constexpr int max_doublings = 40, max_bisections = 30;
    const SampledOutline outline = sample_spacings(curves, rule, known);
    const auto scaled_plan = [&](double factor) {
        return make_plan(curves, scaled(outline, curves, std::vector(curves.size(), factor)), rule);
    };
    const auto target = static_cast<double>(edges);
    double coarse = 1, fine = 1;  // factors of too few and of too many edges
    for (int k = 0; k < max_doublings && scaled_plan(coarse).edges() > target; ++k) coarse *= 2;
    for (int k = 0; k < max_doublings && scaled_plan(fine).edges() < target; ++k) fine *= 0.5;
    for (int k = 0; k < max_bisections; ++k) {
        const double middle = 0.5 * (coarse + fine);
        const double count = scaled_plan(middle).edges();
        if (count == target) return place_all_points(curves, scaled_plan(middle));
        (count > target ? fine : coarse) = middle;
    }
    const DivisionPlan below = scaled_plan(coarse), above = scaled_plan(fine);
    return place_all_points(curves, target - below.edges() <= above.edges() - target ? below : above);
}

DividedCurves divide_curves_exactly(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known,
                                    std::span<const CurveGroup> groups) {
    constexpr int max_doublings = 40, max_bisections = 40;
    const SampledOutline outline = sample_spacings(curves, rule, known);
    std::vector<double> factors(curves.size(), 1.0);
    const auto integrals = [&] { return graded_integrals(scaled(outline, curves, factors), curves, rule.gradation); };
    const auto edges_with = [&](const CurveGroup& group, double factor) {
        for (const std::size_t i : group.curves) factors[i] = factor;
        return sum_of(integrals(), group);
    };
    // Where the growth of the spacing keeps the sum above the target, however large the factor, the shares remain.
    const auto fit = [&](const CurveGroup& group) {
        const auto target = static_cast<double>(group.edges);
        double coarse = 1, fine = 1;
        for (int k = 0; k < max_doublings && edges_with(group, coarse) > target; ++k) coarse *= 2;
        for (int k = 0; k < max_doublings && edges_with(group, fine) < target; ++k) fine *= 0.5;
        for (int k = 0; k < max_bisections; ++k) {
            const double middle = 0.5 * (coarse + fine);
            (edges_with(group, middle) > target ? fine : coarse) = middle;
        }
        edges_with(group, coarse);
    };
    // Finer curves of one group bound the growth of the spacing on those of another one.
    const int rounds = groups.size() > 1 ? 3 : 1;
    for (int round = 0; round < rounds; ++round)
        for (const CurveGroup& group : groups) fit(group);
    const std::vector<double> sums = integrals();
    std::vector<double> counts = sums;
    for (const CurveGroup& group : groups)
        share_out(group, sums, static_cast<double>(least_edges_of_curve(curves)), counts);
    return place_all_points(curves, make_plan(curves, scaled(outline, curves, factors), rule, counts));
}

}  // namespace lamina::surface
