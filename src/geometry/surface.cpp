// Which elements are resampled, why, and what comes of it.
#include <lamina/surface.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/box_tree.hpp"
#include "core/reproducible_math.hpp"
#include "geometry/corners.hpp"
#include "geometry/noise.hpp"
#include "geometry/spacing.hpp"
#include "geometry/spline.hpp"
#include "layers/segments.hpp"

namespace lamina {

namespace {

// ---- options -------------------------------------------------------------------------------------------------------

void require(bool condition, const std::string& message) {
    if (!condition) throw UsageError(message);
}

void check_options(const SurfaceOptions& o) {
    const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
    require(!o.points || *o.points >= 3, "at least three surface points are needed");
    require(!o.smooth || positive(*o.smooth), "the tolerance of smoothing must be greater than 0");
    require(positive(o.max_turning_deg) && o.max_turning_deg <= 90,
            "the largest turning must be greater than 0 and at most 90 degrees");
    require(o.max_ratio > 1 && std::isfinite(o.max_ratio), "the largest ratio of spacings must be greater than 1");
    for (double share :
         {o.longest_spacing, o.sharp_corner_spacing, o.corner_spacing, o.gap_spacing, o.least_spacing, o.tolerance})
        require(positive(share), "spacings and tolerance of the surface must be greater than 0");
}

// ---- an element's points -------------------------------------------------------------------------------------------

double length_of(const Element& e) {
    Box box;
    for (Point p : e.points) box.include(p);
    return std::max(box.width(), box.height());
}

/// A closed outline between its corners.
struct Outline {
    std::vector<Point> points;
    std::vector<std::size_t> corners;  ///< ascending
    std::vector<SmoothRun> runs;       ///< from each corner to the next one; one closed run where there is none
};

/// Two samples much closer to each other than to the next ones say little but their rounding: one point between them.
/// Not where that would be a corner, as at a narrow base, and not where they are `most` apart: one is misplaced.
std::vector<Point> without_close_pairs(const std::vector<Point>& points, double most) {
    constexpr double close = 0.1;
    const std::size_t n = points.size();
    if (n < 5) return points;
    const auto length_after = [&](std::size_t i) { return distance(points[i % n], points[(i + 1) % n]); };
    std::vector<bool> merged(n);  // with the point after
    for (std::size_t i = 0; i < n; ++i)
        merged[i] = length_after(i) < std::min(most, close * std::min(length_after(i + n - 1), length_after(i + 1)));
    const auto kept_points = [&](std::vector<std::size_t>& origins) {
        std::vector<Point> kept;
        for (std::size_t i = 0; i < n; ++i) {
            if (merged[(i + n - 1) % n]) continue;
            kept.push_back(merged[i] ? midpoint(points[i], points[(i + 1) % n]) : points[i]);
            origins.push_back(i);
        }
        return kept;
    };
    std::vector<std::size_t> origins;
    for (std::size_t corner : find_corners(kept_points(origins))) merged[origins[corner]] = false;
    return kept_points(origins);
}

/// The sample beside a corner, if it is much closer to it than to the next sample and on the way there.
void drop_close_to_corners(SmoothRun& run, double tolerance) {
    constexpr double close = 0.1;
    std::vector<Point>& p = run.points;
    const auto is_close = [&](Point corner, Point sample, Point next) {
        return distance(corner, sample) < close * distance(sample, next) &&
               distance_to_segment(sample, corner, next) < tolerance;
    };
    if (run.closed) return;
    if (p.size() > 3 && is_close(p[0], p[1], p[2])) p.erase(p.begin() + 1);
    if (p.size() > 3 && is_close(p.back(), p[p.size() - 2], p[p.size() - 3])) p.erase(p.end() - 2);
}

Outline analysed(const std::vector<Point>& points, double tolerance, double widest_pair) {
    Outline outline{without_close_pairs(points, widest_pair), {}, {}};
    const std::size_t n = outline.points.size();
    outline.corners = find_corners(outline.points);
    const std::vector<std::size_t>& corners = outline.corners;
    if (corners.empty()) outline.runs.push_back({outline.points, true});
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t end = k + 1 < corners.size() ? corners[k + 1] : corners[0] + n;
        SmoothRun run;
        for (std::size_t i = corners[k]; i <= end; ++i) run.points.push_back(outline.points[i % n]);
        drop_close_to_corners(run, tolerance);
        outline.runs.push_back(std::move(run));
    }
    return outline;
}

/// Ice, rather than a section: its corners are too many for samples of a smooth curve.
bool is_jagged(const Element& e, const std::vector<std::size_t>& corners) {
    return corners.size() > std::max<std::size_t>(8, e.points.size() / 25);
}

// ---- smoothing -----------------------------------------------------------------------------------------------------

std::string counted(std::size_t n, const std::string& what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

void smooth(Element& e, double tolerance) {
    const std::vector<std::size_t> corners = find_corners(e.points);
    const std::size_t n = e.points.size();
    const std::vector<Point> given = e.points;
    if (corners.empty()) e.points = smoothed({given, true}, tolerance).points;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t end = k + 1 < corners.size() ? corners[k + 1] : corners[0] + n;
        SmoothRun run;
        for (std::size_t i = corners[k]; i <= end; ++i) run.points.push_back(given[i % n]);
        run = smoothed(run, tolerance);
        for (std::size_t i = corners[k]; i <= end; ++i) e.points[i % n] = run.points[i - corners[k]];
    }
    double moved = 0;
    for (std::size_t i = 0; i < n; ++i) moved = std::max(moved, distance(given[i], e.points[i]));
    e.surface.push_back(fmt::format("smoothed: points moved by up to {:.2g}", moved));
}

void tell_noise(Element& e, const std::vector<std::size_t>& corners) {
    constexpr std::size_t fewest = 3;
    constexpr double enough = 1.5;
    const Noise noise = find_noise(e.points, corners);
    if (noise.vertices < fewest) return;
    e.surface.push_back(fmt::format(
        "{} zigzag by up to {:.2g} degrees, about {:.1g} in the units of the input: smoothing would help "
        "(--smooth {:.1g})",
        counted(noise.vertices, "point"), degrees(noise.turning), noise.amplitude, enough * noise.amplitude));
}

/// A few points that stand off; many are the shape of the thing.
void tell_misplaced(Element& e) {
    constexpr std::size_t most = 3;
    const std::vector<std::size_t> misplaced = find_misplaced(e.points);
    if (misplaced.size() > most) return;
    for (const std::size_t i : misplaced) {
        const Point p = e.points[i];
        const std::string line = i < e.lines.size() && e.lines[i] > 0 ? fmt::format("line {}: ", e.lines[i]) : "";
        e.surface.push_back(fmt::format(
            "{}({}, {}) stands off the curve of its neighbours: a slip? It is kept; take it out if it is wrong", line,
            p.x, p.y));
    }
}

// ---- the decision --------------------------------------------------------------------------------------------------

/// How finely an outline is sampled.
struct Sampling {
    double turning_deg = 0;  ///< most, at a vertex that is no corner
    double ratio = 1;        ///< of neighbouring spacings
    double longest = 0;      ///< spacing, as a share of the element's length
};

Sampling sampling_of(const Element& e, const std::vector<std::size_t>& corners) {
    Sampling s;
    const std::size_t n = e.points.size();
    const std::vector<double> turning = turnings(e.points);
    std::vector<bool> is_corner(n);
    for (std::size_t c : corners) is_corner[c] = true;
    for (std::size_t i = 0; i < n; ++i) {
        const double before = distance(e.points[(i + n - 1) % n], e.points[i]),
                     after = distance(e.points[i], e.points[(i + 1) % n]);
        s.ratio = std::max({s.ratio, before / after, after / before});
        s.longest = std::max(s.longest, after);
        if (!is_corner[i]) s.turning_deg = std::max(s.turning_deg, degrees(std::abs(turning[i])));
    }
    s.longest /= length_of(e);
    return s;
}

struct Decision {
    bool resample;
    std::string reason;  ///< "they turn by up to 12.3 degrees"
};

Decision decide(const Element& e, const SurfaceOptions& options) {
    // Beyond these, samples of a smooth curve are too coarse for a mesh. The ratio is a user's own choice up to 2.
    constexpr double most_ratio = 2, longest = 0.05;
    constexpr std::size_t dense = 1000;
    if (options.surface == Surface::keep) return {false, "as asked"};
    if (options.points) return {true, fmt::format("about {} points are asked for", *options.points)};
    if (options.surface == Surface::resample) return {true, "as asked"};
    if (e.format == "naca") return {false, "generated points are exact"};
    if (e.points.size() >= dense) return {false, "they are dense"};
    const std::vector<std::size_t> corners = find_corners(e.points);
    if (is_jagged(e, corners) || corners.size() + 1 >= e.points.size())
        return {false, fmt::format("{} of them are corners", corners.size())};
    const Sampling s = sampling_of(e, corners);
    if (s.turning_deg > options.max_turning_deg)
        return {true, fmt::format("they turn by up to {:.1f} degrees", s.turning_deg)};
    if (s.longest > longest) return {true, fmt::format("they are up to {:.1f} % of the length apart", 100 * s.longest)};
    if (s.ratio > most_ratio) return {true, fmt::format("neighbouring spacings differ by up to {:.1f}", s.ratio)};
    return {false,
            fmt::format("they turn by at most {:.1f} degrees, and neighbouring spacings differ by at most {:.2f}",
                        s.turning_deg, s.ratio)};
}

// ---- resampling ----------------------------------------------------------------------------------------------------

/// All walls, for the room outside of one of them.
class Walls {
public:
    explicit Walls(const Pslg& pslg) : edges_(edges_of(pslg)), tree_(boxes_of(edges_)) {
        zeros_ = tree_.least_values(std::vector<double>(edges_.size(), 0.0));
    }

    /// Distance from p on an element to the others, or to what faces it across a cove of its own, but for that no less
    /// than `least_own`; at most `most`.
    double room(std::size_t element, Point p, Point normal, double least_own, double most) const {
        return tree_.least(p, 1, most, zeros_, [&](std::size_t i) {
            const Edge& edge = edges_[i];
            const double d = distance_to_segment(p, edge.a, edge.b);
            if (edge.element != element) return d;
            // Opposite faces whose normals meet: not the wall's other side, nor the way round a corner.
            const Point towards = midpoint(edge.a, edge.b) - p, facing = unit(-perpendicular(edge.b - edge.a));
            const bool across = dot(towards, normal) > 0 && dot(towards, facing) < 0 && dot(normal, facing) < -0.5;
            return across ? std::max(d, least_own) : HUGE_VAL;
        });
    }

private:
    struct Edge {
        std::size_t element;
        Point a, b;
    };
    std::vector<Edge> edges_;
    BoxTree tree_;
    std::vector<std::vector<double>> zeros_;

    static std::vector<Edge> edges_of(const Pslg& pslg) {
        std::vector<Edge> edges;
        for (std::size_t e = 0; e < pslg.elements.size(); ++e) {
            const std::vector<Point>& p = pslg.elements[e].points;
            for (std::size_t i = 0; i < p.size(); ++i) edges.push_back({e, p[i], p[(i + 1) % p.size()]});
        }
        return edges;
    }
    static std::vector<Box> boxes_of(const std::vector<Edge>& edges) {
        std::vector<Box> boxes;
        for (const Edge& e : edges) boxes.push_back(box_of(e.a, e.b));
        return boxes;
    }
};

SpacingRule spacing_rule(const SurfaceOptions& options, double scale, const Walls& walls, std::size_t element) {
    // Turning is met on the average over two edges; gradation takes a part of it.
    constexpr double turning_share = 0.85;
    SpacingRule rule;
    rule.longest = options.longest_spacing * scale;
    rule.shortest = options.least_spacing * scale;
    rule.turning = turning_share * radians(options.max_turning_deg);
    rule.tolerance = options.tolerance * scale;
    // Edges that equidistribute ds/h with dh/ds = g grow by exp(g); this approximant of ln(ratio) is below it. A margin
    // for chords, which are shorter than their arcs.
    constexpr double margin = 0.97;
    rule.growth = std::min(margin * 2 * (options.max_ratio - 1) / (options.max_ratio + 1), options.gradation);
    rule.worst_ratio = options.max_ratio;
    rule.room_share = options.gap_spacing;
    rule.room = [&walls, element, least_own = options.corner_spacing * scale,
                 most = rule.longest / options.gap_spacing](Point p, Point normal) {
        return walls.room(element, p, normal, least_own, most);
    };
    return rule;
}

std::vector<double> corner_spacings(const Outline& outline, const SurfaceOptions& options, double scale) {
    if (outline.corners.empty()) return {HUGE_VAL};
    constexpr double sharp = radians(60);
    const std::vector<double> turning = turnings(outline.points);
    const double by_share = options.sharp_corner_spacing * scale;
    const double at_sharp = options.fan_spacing
                                ? std::clamp(*options.fan_spacing, 0.25 * by_share, options.corner_spacing * scale)
                                : by_share;
    std::vector<double> spacings;
    for (std::size_t c : outline.corners)
        spacings.push_back(turning[c] > sharp ? at_sharp : options.corner_spacing * scale);
    return spacings;
}

/// Lines of the file for the points that still stand there: corners, as a rule.
std::vector<std::size_t> lines_of(const Element& given, const std::vector<Point>& points) {
    std::vector<std::pair<Point, std::size_t>> known;
    for (std::size_t i = 0; i < given.lines.size(); ++i) known.emplace_back(given.points[i], given.lines[i]);
    const auto less = [](const auto& a, const auto& b) { return lexicographically_less(a.first, b.first); };
    std::sort(known.begin(), known.end(), less);
    std::vector<std::size_t> lines;
    for (Point p : points) {
        const auto at = std::lower_bound(known.begin(), known.end(), std::pair{p, std::size_t{0}}, less);
        lines.push_back(at != known.end() && at->first == p ? at->second : 0);
    }
    return lines;
}

Element resampled(const Element& given, std::size_t index, const Walls& walls, const SurfaceOptions& options,
                  const std::string& reason) {
    constexpr double widest_pair = 1e-3;
    const double scale = length_of(given);
    const Outline outline = analysed(given.points, 0.5 * options.tolerance * scale, widest_pair * scale);
    std::vector<Curve> curves;
    for (const SmoothRun& run : outline.runs) curves.emplace_back(run);
    const SpacingRule rule = spacing_rule(options, scale, walls, index);
    const std::vector<double> at_corners = corner_spacings(outline, options, scale);

    Division division =
        options.points ? divide_into(curves, at_corners, rule, *options.points) : divide(curves, at_corners, rule);
    // Left to decide, lamina never takes points away from a fine outline.
    if (!options.points && options.surface == Surface::automatic && division.points.size() < given.points.size())
        division = divide_into(curves, at_corners, rule, given.points.size());

    Element element = given;
    element.points = std::move(division.points);
    element.lines = lines_of(given, element.points);
    element.resampled = true;
    element.surface.push_back(fmt::format("{} points resampled to {}: {}; {} kept, edges within {:.2g} of the spline",
                                          given.points.size(), element.points.size(), reason,
                                          counted(outline.corners.size(), "corner"), division.deviation));
    return element;
}

// ---- safety --------------------------------------------------------------------------------------------------------

bool is_simple(const Pslg& pslg) {
    try {
        check_simple(pslg);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

void take_back(Pslg& pslg, std::size_t element, const Element& given, const std::string& why) {
    if (pslg.elements[element].points == given.points) return;
    pslg.elements[element] = given;
    pslg.elements[element].surface.push_back(fmt::format("{} points kept as given: {}", given.points.size(), why));
}

/// Resampled outlines that would cross themselves or each other become what they were.
void take_back_crossing(Pslg& pslg, const Pslg& given) {
    const std::size_t n = pslg.elements.size();
    for (std::size_t e = 0; e < n; ++e)
        if (!is_simple({{pslg.elements[e]}}))
            take_back(pslg, e, given.elements[e], "its smooth curve would cross itself");
    for (std::size_t e = 0; e < n && !is_simple(pslg); ++e)
        take_back(pslg, e, given.elements[e], "its smooth curve would cross that of another element");
}

}  // namespace

Pslg prepare_surfaces(Pslg pslg, const SurfaceOptions& options) {
    check_options(options);
    Pslg given = std::move(pslg);
    if (options.smooth) {
        Pslg smoothed = given;
        for (Element& e : smoothed.elements) smooth(e, *options.smooth);
        take_back_crossing(smoothed, given);
        given = std::move(smoothed);
    } else {
        for (Element& e : given.elements) {
            const std::vector<std::size_t> corners = find_corners(e.points);
            if (is_jagged(e, corners)) continue;
            tell_noise(e, corners);
            tell_misplaced(e);
        }
    }

    const Walls walls(given);
    Pslg result = given;
    for (std::size_t i = 0; i < given.elements.size(); ++i) {
        Element& element = result.elements[i];
        const Decision decision = decide(element, options);
        if (decision.resample) {
            element = resampled(given.elements[i], i, walls, options, decision.reason);
        } else {
            element.surface.push_back(fmt::format("{} points kept: {}", element.points.size(), decision.reason));
        }
    }
    take_back_crossing(result, given);
    return result;
}

}  // namespace lamina
