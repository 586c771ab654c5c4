// Source: J. F. Thompson, B. K. Soni, N. P. Weatherill, Handbook of Grid Generation (1999), chapter 30 (spacing of
// surfaces by curvature).
#include "surface/spacing.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/segments.hpp"

namespace lamina::surface {

namespace {

/// Samples a curve so closely that it turns by about a degree at most between two samples, and that arc length between
/// them is nearly linear in the parameter. Spacings are still unbounded.
CurveSamples sample(const SplineCurve& curve) {
    constexpr double turning_per_sample = core::radians(1);
    // Curves of few, long pieces need more samples per piece.
    const double min_count = std::clamp(8000 / static_cast<double>(curve.pieces()), 4.0, 32.0);
    constexpr double max_count = 256;
    CurveSamples samples;
    samples.reserve(1 + curve.pieces() * static_cast<std::size_t>(std::ceil(min_count)));
    samples.push_back({0, 0, 0, curve.at(0, 0), HUGE_VAL});
    for (std::size_t piece = 0; piece < curve.pieces(); ++piece) {
        double turning = 0;
        for (double share = 0; share < 1; share += 0.25)
            turning +=
                std::abs(core::angle_between(curve.direction(piece, share), curve.direction(piece, share + 0.25)));
        const double count = std::ceil(std::clamp(turning / turning_per_sample, min_count, max_count));
        for (double k = 1; k <= count; ++k) {
            const Point at = curve.at(piece, k / count);
            const CurveSample& last = samples.back();
            samples.push_back({piece, k / count, last.arc_length + distance(last.at, at), at, HUGE_VAL});
        }
    }
    return samples;
}

/// Returns the direction of a curve at each of its samples.
std::vector<Point> directions_at(const SplineCurve& curve, const CurveSamples& samples) {
    std::vector<Point> directions(samples.size());
    std::transform(samples.begin(), samples.end(), directions.begin(),
                   [&](const CurveSample& sample) { return curve.direction(sample.piece, sample.share); });
    return directions;
}

/// Bounds spacings by the curvature and by the largest and the smallest spacing.
void limit_by_curvature(std::span<const Point> directions, CurveSamples& samples, const SpacingRule& rule) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, samples.size() - 1);
        const double curvature = std::abs(core::angle_between(directions[before], directions[after])) /
                                 (samples[after].arc_length - samples[before].arc_length);
        double spacing = rule.max_spacing;
        if (curvature > 0)
            spacing = std::min({spacing, rule.max_turning / curvature, std::sqrt(8 * rule.tolerance / curvature)});
        samples[i].spacing = std::max(spacing, rule.min_spacing);
    }
}

void limit_by_clearance(std::span<const Point> directions, CurveSamples& samples, const SpacingRule& rule) {
    if (!rule.clearance) return;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        CurveSample& sample = samples[i];
        const Point normal = unit(-perpendicular(directions[i]));
        sample.spacing = std::min(sample.spacing,
                                  std::max(rule.clearance_share * rule.clearance(sample.at, normal), rule.min_spacing));
    }
}

/// Bounds spacings near stretches of the outline. They grow with the straight distance from these.
void limit_near_walls(CurveSamples& samples, const SpacingRule& rule) {
    if (rule.walls.empty()) return;
    std::vector<Box> boxes;
    std::vector<double> spacings;
    for (const geometry::WallSpacing& wall : rule.walls) {
        boxes.push_back(core::bounding_box(wall.a, wall.b));
        spacings.push_back(wall.spacing);
    }
    const core::BoxTree tree(std::move(boxes));
    const auto values = tree.group_minima(std::move(spacings));
    const auto apart = [&](std::size_t wall, Point p) {
        return core::distance_to_segment(p, rule.walls[wall].a, rule.walls[wall].b);
    };
    // The limit at one sample bounds that at others, but for rounding. So few stretches matter to neighbouring samples,
    // and one search finds them.
    constexpr std::size_t samples_at_once = 16;
    constexpr double rounding = 1e-9;
    std::vector<std::size_t> near;
    double last_limit = HUGE_VAL;
    Point last = samples.front().at;
    const auto bound_at = [&](const CurveSample& sample) {
        return std::min(sample.spacing, (last_limit + rule.gradation * distance(last, sample.at)) * (1 + rounding));
    };
    for (std::size_t first = 0; first < samples.size(); first += samples_at_once) {
        const auto some = std::span(samples).subspan(first, std::min(samples_at_once, samples.size() - first));
        const Point p = some[0].at;
        const double limit = tree.minimum(p, rule.gradation, bound_at(some[0]), values,
                                          [&](std::size_t wall) { return apart(wall, p); });
        last_limit = limit < some[0].spacing ? limit : HUGE_VAL;
        last = p;
        Box box;
        double highest = 0;
        for (const CurveSample& sample : some) {
            box.include(sample.at);
            highest = std::max(highest, bound_at(sample));
        }
        near.clear();
        tree.below(box, rule.gradation, highest, values, [&](std::size_t wall) { near.push_back(wall); });
        for (CurveSample& sample : some) {
            double lowest = sample.spacing;
            for (const std::size_t wall : near)
                lowest = std::min(lowest, values[0][wall] + rule.gradation * apart(wall, sample.at));
            last_limit = lowest < sample.spacing ? lowest : HUGE_VAL;
            last = sample.at;
            sample.spacing = std::min(sample.spacing, std::max(lowest, rule.min_spacing));
        }
    }
}

/// Bounds the spacings at both ends of a curve, by its length too: a short curve between two corners can have no longer
/// edges.
void limit_at_corners(CurveSamples& samples, double max_at_start, double max_at_end, double min_spacing) {
    const double max_spacing = std::max(samples.back().arc_length, min_spacing);
    samples.front().spacing = std::min({samples.front().spacing, max_at_start, max_spacing});
    samples.back().spacing = std::min({samples.back().spacing, max_at_end, max_spacing});
}

/// Lowers the spacing at the samples that are nearest to a point. The two sides of a corner are as near as each other.
void limit_at_point(std::span<const OutlineCurve> curves, std::vector<CurveSamples>& samples,
                    const PointSpacing& bound) {
    double nearest = HUGE_VAL;
    for (const CurveSamples& curve : samples)
        for (const CurveSample& sample : curve) nearest = std::min(nearest, distance(sample.at, bound.at));
    for (std::size_t i = 0; i < curves.size(); ++i) {
        if (curves[i].is_kept) continue;
        for (CurveSample& sample : samples[i])
            if (distance(sample.at, bound.at) == nearest) sample.spacing = std::min(sample.spacing, bound.spacing);
    }
}

/// Returns the two ends of a curve whose edges are fixed.
CurveSamples samples_of_kept(const OutlineCurve& line, double min_spacing) {
    const Point a = line.curve.at(0, 0), b = line.curve.at(0, 1);
    const double length = distance(a, b);
    const double spacing = std::max(length / static_cast<double>(line.kept_edges), min_spacing);
    return {{0, 0, 0, a, spacing}, {0, 1, length, b, spacing}};
}

/// Returns a curve with the bounds that hold along it.
SampledCurve sample_by_rule(const SplineCurve& curve, const SpacingRule& rule) {
    SampledCurve result{curve, sample(curve), 0};
    CurveSamples& samples = result.samples;
    const std::vector<Point> directions = directions_at(curve, samples);
    limit_by_curvature(directions, samples, rule);
    limit_by_clearance(directions, samples, rule);
    limit_near_walls(samples, rule);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        result.turning += core::angle_between(directions[i], directions[i + 1]);
    return result;
}

/// Returns the same, from the known curves if it is among them. If not, it is added.
const SampledCurve& find_sampled(const SplineCurve& curve, const SpacingRule& rule, SampledCurves& known) {
    const Point start = curve.at(0, 0);
    const auto at = known.find(start);
    if (at != known.end() && at->second.curve == curve) return at->second;
    return known.insert_or_assign(start, sample_by_rule(curve, rule)).first->second;
}

/// A sample of one of the curves of an outline.
struct SamplePosition {
    std::size_t curve, sample;
};

/// Returns the sample of an outline after or before another one. The last one of a curve and the first one of the next
/// curve are at the same place.
SamplePosition neighbour(const std::vector<CurveSamples>& curves, SamplePosition at, bool is_after) {
    const std::size_t n = curves.size();
    if (is_after) {
        if (at.sample + 1 < curves[at.curve].size()) return {at.curve, at.sample + 1};
        return {at.curve + 1 < n ? at.curve + 1 : 0, 0};
    }
    if (at.sample > 0) return {at.curve, at.sample - 1};
    const std::size_t before = (at.curve > 0 ? at.curve : n) - 1;
    return {before, curves[before].size() - 1};
}

}  // namespace

SampledOutline sample_spacings(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known) {
    SampledOutline result;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const SplineCurve& curve = curves[i].curve;
        if (curves[i].is_kept) {
            result.samples.push_back(samples_of_kept(curves[i], rule.min_spacing));
            result.turning.push_back(0);
            continue;
        }
        const SampledCurve& sampled = find_sampled(curve, rule, known);
        CurveSamples& samples = result.samples.emplace_back(sampled.samples);
        result.turning.push_back(sampled.turning);
        limit_at_corners(samples, curves[i].start_spacing, curves[(i + 1) % curves.size()].start_spacing,
                         rule.min_spacing);
    }
    for (const PointSpacing& bound : rule.point_spacings) limit_at_point(curves, result.samples, bound);
    return result;
}

void limit_gradation(std::span<const OutlineCurve> curves, std::vector<CurveSamples>& curve_samples, double gradation) {
    // All samples round the outline, and the arc length from each to the next one. It is 0 at a corner, and from the
    // last sample of a single closed curve to its first one, since both are the same point.
    std::vector<CurveSample*> samples;
    std::vector<double> steps;
    std::vector<bool> is_kept;
    for (std::size_t c = 0; c < curves.size(); ++c) {
        CurveSamples& curve = curve_samples[c];
        for (std::size_t i = 0; i < curve.size(); ++i) {
            samples.push_back(&curve[i]);
            steps.push_back(i + 1 < curve.size() ? curve[i + 1].arc_length - curve[i].arc_length : 0);
            is_kept.push_back(curves[c].is_kept);
        }
    }
    const std::size_t n = samples.size();
    const auto limit = [&](std::size_t to, std::size_t from, double step) {
        if (!is_kept[to])
            samples[to]->spacing = std::min(samples[to]->spacing, samples[from]->spacing + gradation * step);
    };
    const auto next = [&](std::size_t i) { return i + 1 < n ? i + 1 : 0; };
    // The second round carries bounds on past the first sample.
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = 0; i < n; ++i) limit(next(i), i, steps[i]);
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = n; i-- > 0;) limit(i, next(i), steps[i]);
}

void limit_gradation_from(std::size_t curve, std::span<const OutlineCurve> curves, std::vector<CurveSamples>& samples,
                          double gradation, std::vector<bool>& is_changed) {
    // Whatever a spacing does not lower, it would not lower anything beyond either.
    const auto spread = [&](SamplePosition from, bool is_after) {
        while (true) {
            const SamplePosition to = neighbour(samples, from, is_after);
            if (curves[to.curve].is_kept) return;
            const CurveSample& source = samples[from.curve][from.sample];
            CurveSample& target = samples[to.curve][to.sample];
            const double step = to.curve != from.curve ? 0
                                : is_after             ? target.arc_length - source.arc_length
                                                       : source.arc_length - target.arc_length;
            const double limit = source.spacing + gradation * step;
            if (!(limit < target.spacing)) return;
            target.spacing = limit;
            is_changed[to.curve] = true;
            from = to;
        }
    };
    const SamplePosition start{curve, 0}, end = neighbour(samples, start, false);
    for (const SamplePosition position : {start, end}) {
        spread(position, true);
        spread(position, false);
    }
}

}  // namespace lamina::surface
