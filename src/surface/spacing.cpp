// Equidistribution of the integral of ds/h along curves.
// Source: J. F. Thompson, B. K. Soni, N. P. Weatherill, Handbook of Grid Generation (1999), chapter 3
// (equidistribution) and 30 (spacing of surfaces by curvature).
#include "surface/spacing.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace lamina::surface {

namespace {

/// A place on a curve, and the spacing wanted there.
struct Sample {
    std::size_t piece;
    double share;  ///< of the piece
    double s;      ///< arc length from the start of the curve
    Point at;
    double h;
};
using Samples = std::vector<Sample>;

/// Close enough that between two of them the curve turns by about a degree at most, and arc length is nearly linear in
/// the parameter.
Samples sample(const Curve& curve) {
    constexpr double turning_a_sample = core::radians(1);
    // Long pieces, of coarse outlines, need more for their length.
    const double fewest = std::clamp(8000 / static_cast<double>(curve.pieces()), 4.0, 32.0);
    constexpr double most = 256;
    Samples samples{{0, 0, 0, curve.at(0, 0), HUGE_VAL}};
    for (std::size_t piece = 0; piece < curve.pieces(); ++piece) {
        double turning = 0;
        for (double share = 0; share < 1; share += 0.25)
            turning +=
                std::abs(core::angle_between(curve.direction(piece, share), curve.direction(piece, share + 0.25)));
        const double count = std::ceil(std::clamp(turning / turning_a_sample, fewest, most));
        for (double k = 1; k <= count; ++k) {
            const Point at = curve.at(piece, k / count);
            samples.push_back({piece, k / count, samples.back().s + distance(samples.back().at, at), at, HUGE_VAL});
        }
    }
    return samples;
}

double turning_of(const Curve& curve, const Samples& samples, std::size_t from, std::size_t to) {
    return core::angle_between(curve.direction(samples[from].piece, samples[from].share),
                               curve.direction(samples[to].piece, samples[to].share));
}

void wish_for_shape(const Curve& curve, Samples& samples, const SpacingRule& rule) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, samples.size() - 1);
        const double curvature =
            std::abs(turning_of(curve, samples, before, after)) / (samples[after].s - samples[before].s);
        double h = rule.longest;
        if (curvature > 0) h = std::min({h, rule.turning / curvature, std::sqrt(8 * rule.tolerance / curvature)});
        samples[i].h = std::max(h, rule.shortest);
    }
}

void wish_for_room(const Curve& curve, Samples& samples, const SpacingRule& rule) {
    if (!rule.room) return;
    for (Sample& sample : samples) {
        const Point normal = unit(-perpendicular(curve.direction(sample.piece, sample.share)));
        sample.h = std::min(sample.h, std::max(rule.room_share * rule.room(sample.at, normal), rule.shortest));
    }
}

/// Corners as wished, and no wish beyond what a short curve between two corners can give.
void wish_at_ends(Samples& samples, double at_start, double at_end, double shortest) {
    const double most = std::max(samples.back().s, shortest);
    samples.front().h = std::min({samples.front().h, at_start, most});
    samples.back().h = std::min({samples.back().h, at_end, most});
}

/// Lowers wishes until none grows faster than `growth`, all round the outline and across corners.
void grade(std::vector<Samples>& curves, double growth) {
    struct Place {
        Samples* curve;
        std::size_t index;
        Sample& sample() const { return (*curve)[index]; }
    };
    std::vector<Place> places;
    for (Samples& samples : curves)
        for (std::size_t i = 0; i < samples.size(); ++i) places.push_back({&samples, i});
    const auto pass_on = [&](const Place& from, const Place& to) {
        const double way = from.curve == to.curve ? std::abs(to.sample().s - from.sample().s) : 0;
        to.sample().h = std::min(to.sample().h, from.sample().h + growth * way);
    };
    const std::size_t n = places.size();
    const auto next = [&](std::size_t i) { return i + 1 < n ? i + 1 : 0; };
    // A single curve's last sample is its first one.
    const auto step = [&](std::size_t from, std::size_t to, bool round) {
        if (round) {
            places[to].sample().h = std::min(places[to].sample().h, places[from].sample().h);
        } else {
            pass_on(places[from], places[to]);
        }
    };
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = 0; i < n; ++i) step(i, next(i), next(i) == 0);
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = n; i-- > 0;) step(next(i), i, next(i) == 0);
}

/// Calls visit(i, a, b, part) along a curve: from share a to b of the way from sample i to the next one the integral of
/// ds/h is `part`; h is linear between samples, and steps are short against it.
template <class Visit>
void march(const Samples& samples, Visit&& visit) {
    constexpr double step_share = 0.25;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const double ds = samples[i + 1].s - samples[i].s, h0 = samples[i].h, h1 = samples[i + 1].h;
        const double steps = std::ceil(ds / (step_share * std::min(h0, h1)));
        for (double k = 0; k < steps; ++k) {
            const double a = k / steps, b = (k + 1) / steps;
            const double ha = h0 + a * (h1 - h0), hb = h0 + b * (h1 - h0);
            visit(i, a, b, 0.5 * ds / steps * (1 / ha + 1 / hb));
        }
    }
}

double integral(const Samples& samples) {
    double sum = 0;
    march(samples, [&](std::size_t, double, double, double part) { sum += part; });
    return sum;
}

struct EdgeCount {
    double integral;
    double edges;
    double first, last;  ///< lengths of the first and the last edge
};

EdgeCount count_edges(const Curve& curve, const Samples& samples, double fewest) {
    constexpr double slack = 1e-6;  // of an edge, lest rounding decides
    double turning = 0;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) turning += turning_of(curve, samples, i, i + 1);
    const double sum = integral(samples);
    double edges = std::max(std::ceil(sum - slack), fewest);
    if (std::abs(turning) > 0.5 * core::pi) edges = 2 * std::ceil(0.5 * edges - 0.25);

    const double edge = sum / edges, length = samples.back().s;
    EdgeCount count{sum, edges, length, length};
    double done = 0;
    march(samples, [&](std::size_t i, double a, double b, double part) {
        const auto arc_length = [&](double at) {
            const double way = a + (b - a) * ((at - done) / part);
            return samples[i].s + way * (samples[i + 1].s - samples[i].s);
        };
        if (done < edge && done + part >= edge) count.first = arc_length(edge);
        const double before_last = sum - edge;
        if (done < before_last && done + part >= before_last) count.last = length - arc_length(before_last);
        done += part;
    });
    return count;
}

/// Makes the spacings on the sides of a corner alike: whole numbers make short curves finer than wished. The shorter
/// edge becomes the wish of both sides.
bool even_out_corners(std::vector<Samples>& curves, std::span<const EdgeCount> counts, const SpacingRule& rule) {
    constexpr double at_least = 0.98;  // every round changes something
    bool changed = false;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::size_t j = (i + 1) % curves.size();
        const double before = counts[i].last, after = counts[j].first;
        if (std::max(before, after) <= rule.worst_ratio * std::min(before, after)) continue;
        const double h = std::min(at_least * curves[j].front().h, std::min(before, after) / (1 + 0.5 * rule.growth));
        if (h < rule.shortest) continue;
        curves[i].back().h = curves[j].front().h = h;
        changed = true;
    }
    return changed;
}

/// Wishes made and graded, numbers of edges chosen.
struct Plan {
    std::vector<Samples> curves;
    std::vector<EdgeCount> counts;

    double edges() const {
        double sum = 0;
        for (const EdgeCount& c : counts) sum += c.edges;
        return sum;
    }
};

Plan make_plan(std::span<const Curve> curves, std::vector<Samples> wishes, const SpacingRule& rule) {
    constexpr int most_rounds = 30;
    Plan plan{std::move(wishes), {}};
    // Fewer edges than a triangle has is no outline.
    const double fewest = curves.size() == 1 ? 3 : curves.size() == 2 ? 2 : 1;
    for (int round = 0; round < most_rounds; ++round) {
        grade(plan.curves, rule.growth);
        plan.counts.clear();
        for (std::size_t i = 0; i < curves.size(); ++i)
            plan.counts.push_back(count_edges(curves[i], plan.curves[i], fewest));
        if (curves.size() == 1 || !even_out_corners(plan.curves, plan.counts, rule)) break;
    }
    return plan;
}

std::vector<Samples> make_wishes(std::span<const Curve> curves, std::span<const double> corner_spacing,
                                 const SpacingRule& rule) {
    std::vector<Samples> wishes;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        wishes.push_back(sample(curves[i]));
        wish_for_shape(curves[i], wishes.back(), rule);
        wish_for_room(curves[i], wishes.back(), rule);
        wish_at_ends(wishes.back(), corner_spacing[i], corner_spacing[(i + 1) % curves.size()], rule.shortest);
    }
    return wishes;
}

double distance_to_chord(Point p, Point a, Point b) {
    const double chord = distance(a, b);
    return chord > 0 ? std::abs(cross(b - a, p - a)) / chord : distance(p, a);
}

/// The curve's first point and those between its edges, not its last one.
void place(const Curve& curve, const Samples& samples, const EdgeCount& count, Division& division) {
    division.starts.push_back(division.points.size());
    division.points.push_back(samples.front().at);
    double sum = 0, next = 1;
    std::size_t first_of_edge = 0;
    const auto finish_edge = [&](Point end, std::size_t last_sample) {
        for (std::size_t i = first_of_edge; i <= last_sample; ++i)
            division.deviation =
                std::max(division.deviation, distance_to_chord(samples[i].at, division.points.back(), end));
    };
    march(samples, [&](std::size_t i, double a, double b, double part) {
        const double edge = count.integral / count.edges;
        while (next < count.edges && sum + part >= next * edge) {
            const double way = a + (b - a) * ((next * edge - sum) / part);
            const Sample &from = samples[i], &to = samples[i + 1];
            const double start = from.piece == to.piece ? from.share : 0;
            const Point at = curve.at(to.piece, start + way * (to.share - start));
            finish_edge(at, i);
            first_of_edge = i + 1;
            division.points.push_back(at);
            ++next;
        }
        sum += part;
    });
    finish_edge(samples.back().at, samples.size() - 1);
}

Division place_all(std::span<const Curve> curves, const Plan& plan) {
    Division division;
    for (std::size_t i = 0; i < curves.size(); ++i) place(curves[i], plan.curves[i], plan.counts[i], division);
    return division;
}

}  // namespace

Division divide(std::span<const Curve> curves, std::span<const double> corner_spacing, const SpacingRule& rule) {
    return place_all(curves, make_plan(curves, make_wishes(curves, corner_spacing, rule), rule));
}

Division divide_into(std::span<const Curve> curves, std::span<const double> corner_spacing, const SpacingRule& rule,
                     std::size_t edges) {
    const std::vector<Samples> wishes = make_wishes(curves, corner_spacing, rule);
    const auto plan_of = [&](double factor) {
        std::vector<Samples> scaled = wishes;
        for (Samples& samples : scaled)
            for (Sample& sample : samples) sample.h *= factor;
        return make_plan(curves, std::move(scaled), rule);
    };
    const auto target = static_cast<double>(edges);
    double coarse = 1, fine = 1;
    for (int k = 0; k < 40 && plan_of(coarse).edges() > target; ++k) coarse *= 2;
    for (int k = 0; k < 40 && plan_of(fine).edges() < target; ++k) fine *= 0.5;
    for (int k = 0; k < 30; ++k) {
        const double middle = 0.5 * (coarse + fine);
        const double count = plan_of(middle).edges();
        if (count == target) return place_all(curves, plan_of(middle));
        (count > target ? fine : coarse) = middle;
    }
    const Plan below = plan_of(coarse), above = plan_of(fine);
    return place_all(curves, target - below.edges() <= above.edges() - target ? below : above);
}

}  // namespace lamina::surface
