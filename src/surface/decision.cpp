#include "surface/decision.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/reproducible_math.hpp"
#include "geometry/element_names.hpp"
#include "geometry/other_formats.hpp"
#include "surface/corners.hpp"
#include "surface/noise.hpp"

namespace lamina::surface {

namespace {

/// Beyond this ratio of neighbouring spacings, samples of a smooth curve are too uneven for a mesh, and beyond this
/// ratio of a given edge to the spacing that the rules for new points ask for there, they are too coarse.
constexpr double max_given_ratio = 1.25;
/// So many points are kept, even where they are spaced as a generator of meshes would not ...
constexpr std::size_t min_dense_points = 1000;
/// ... unless neighbouring spacings differ by more than this, as where points are random.
constexpr double max_dense_ratio = 10;
/// Points that are nearer to each other, as a share of the element's length, make cells that are far higher than wide.
constexpr double min_given_spacing = 5e-7;

/// An outline that turns by less at each vertex is straight.
constexpr double min_curve_turning = core::radians(0.01);

/// In a jagged outline, zigzags of more than this are part of the shape, and so are vertices that turn by more than
/// that, ...
constexpr double min_zigzag = core::radians(2), max_bend = core::radians(30);
/// ... and so are stretches of fewer edges than this, unless they turn by less than the angle at each vertex and are
/// coarse.
constexpr std::size_t min_smooth_edges = 8;
constexpr double max_smooth_turning = core::radians(5);

/// Edges that follow each other in a closed outline of n points.
struct EdgeRange {
    std::size_t first, count;
    bool is_closed = false;  ///< whether it is the whole outline, which has no ends
};

/// How finely a range of edges samples a curve. Both ends of the range are left out of turning and ratio.
struct Sampling {
    double max_turning = 0;
    double max_ratio = 1;  ///< of neighbouring spacings
    double min_spacing = HUGE_VAL, max_spacing = 0;
};

/// Returns the larger values of two ranges.
Sampling coarser(const Sampling& a, const Sampling& b) {
    return {std::max(a.max_turning, b.max_turning), std::max(a.max_ratio, b.max_ratio),
            std::min(a.min_spacing, b.min_spacing), std::max(a.max_spacing, b.max_spacing)};
}

/// A closed outline with its measures.
struct MeasuredOutline {
    std::size_t n;
    double extent;
    std::vector<double> turning;  ///< per vertex
    std::vector<double> lengths;  ///< per edge, which has the number of its first point

    explicit MeasuredOutline(std::span<const Point> points)
        : n(points.size()), extent(surface::extent(points)), turning(turning_angles(points)) {
        for (std::size_t i = 0; i < n; ++i) lengths.push_back(distance(points[i], points[(i + 1) % n]));
    }

    /// Returns the ratio of the spacings on both sides of a vertex, the larger one over the smaller.
    double ratio_at(std::size_t i) const {
        const double before = lengths[(i + n - 1) % n], after = lengths[i];
        return std::max(before / after, after / before);
    }

    /// Returns whether an edge is far longer than one of its neighbours.
    bool is_long(std::size_t i) const {
        return lengths[i] > max_given_ratio * std::min(lengths[(i + n - 1) % n], lengths[(i + 1) % n]);
    }

    Sampling sampling(EdgeRange range) const {
        Sampling s;
        for (std::size_t k = 0; k < range.count; ++k) {
            const std::size_t i = (range.first + k) % n;
            s.min_spacing = std::min(s.min_spacing, lengths[i]);
            s.max_spacing = std::max(s.max_spacing, lengths[i]);
            if (k == 0 && !range.is_closed) continue;
            s.max_turning = std::max(s.max_turning, std::abs(turning[i]));
            s.max_ratio = std::max(s.max_ratio, ratio_at(i));
        }
        return s;
    }
};

/// Cuts a closed outline of n points at vertices, given by ascending index. Without any it is one range.
std::vector<EdgeRange> ranges_between(std::span<const std::size_t> vertices, std::size_t n) {
    if (vertices.empty()) return {{0, n, true}};
    std::vector<EdgeRange> ranges;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const std::size_t end = k + 1 < vertices.size() ? vertices[k + 1] : vertices[0] + n;
        ranges.push_back({vertices[k], end - vertices[k]});
    }
    return ranges;
}

/// Returns the decision to keep all edges of these ranges.
Decision keep_all(std::span<const EdgeRange> ranges, std::size_t edges) {
    Decision decision{std::vector(edges, EdgeTreatment::keep), std::vector<std::size_t>(edges),
                      std::vector(ranges.size(), true), ""};
    for (std::size_t r = 0; r < ranges.size(); ++r)
        for (std::size_t k = 0; k < ranges[r].count; ++k) decision.ranges[(ranges[r].first + k) % edges] = r;
    return decision;
}

void replace_range(Decision& decision, std::size_t range) {
    for (std::size_t i = 0; i < decision.edges.size(); ++i)
        if (decision.ranges[i] == range) decision.edges[i] = EdgeTreatment::spline;
}

/// Returns the reason why points are too coarse for a mesh, or nothing where they are not.
std::string coarseness(const Sampling& s, double extent, const ResamplingRequest& request) {
    if (core::degrees(s.max_turning) > request.max_turning_deg())
        return fmt::format("they turn by up to {:.1f} degrees", core::degrees(s.max_turning));
    const double uneven = s.max_ratio / max_given_ratio,
                 coarse = s.max_spacing / (request.options.max_spacing * extent);
    if (uneven > 1 && uneven >= coarse) return fmt::format("neighbouring spacings differ by up to {:.1f}", s.max_ratio);
    if (coarse > 1) return fmt::format("they are up to {:.1f} % of the length apart", 100 * s.max_spacing / extent);
    return "";
}

// ---- jagged outlines -----------------------------------------------------------------------------------------------

/// Returns whether a range of edges between two jags samples a smooth curve.
bool is_smooth(const Sampling& s, std::size_t edges, double max_spacing) {
    return edges >= min_smooth_edges ||
           (edges > 1 && s.max_turning < max_smooth_turning && s.max_spacing > max_spacing);
}

Decision decide_jagged(const Element& e, const ResamplingRequest& request) {
    const MeasuredOutline outline(e.points);
    std::vector<bool> is_jag = find_zigzags(outline.turning, min_zigzag);
    for (const std::size_t corner : e.features.corners) is_jag[corner] = true;
    std::vector<std::size_t> jags;
    for (std::size_t i = 0; i < outline.n; ++i)
        if (is_jag[i] || std::abs(outline.turning[i]) > max_bend) jags.push_back(i);

    const std::vector<EdgeRange> ranges = ranges_between(jags, outline.n);
    Decision decision = keep_all(ranges, outline.n);
    const double longest = request.options.max_spacing * outline.extent;
    Sampling replaced;
    for (std::size_t r = 0; r < ranges.size(); ++r) {
        const Sampling s = outline.sampling(ranges[r]);
        decision.is_smooth[r] = is_smooth(s, ranges[r].count, longest);
        if (!decision.is_smooth[r] || coarseness(s, outline.extent, request).empty()) continue;
        replace_range(decision, r);
        replaced = coarser(replaced, s);
    }
    for (std::size_t i = 0; i < outline.n; ++i)
        if (decision.edges[i] == EdgeTreatment::keep && (outline.is_long(i) || outline.lengths[i] > longest))
            decision.replace_kept(i);

    const std::string reason = coarseness(replaced, outline.extent, request);
    decision.reason = decision.keeps_all()
                          ? fmt::format("{} of them are corners", e.features.corners.size())
                          : fmt::format("between {} corners {}", e.features.corners.size(),
                                        reason.empty() ? "some edges are far longer than their neighbours" : reason);
    return decision;
}

// ---- smooth outlines -----------------------------------------------------------------------------------------------

/// Returns whether the points between two corners obey the rules for new ones, so that they can stay beside new ones. A
/// straight side does not matter: new points lie on it as well.
bool is_fine(const Sampling& s, EdgeRange range, std::span<const double> asked, const ResamplingRequest& request) {
    for (std::size_t k = 0; k < range.count; ++k)
        if (asked[(range.first + k) % asked.size()] > max_given_ratio) return false;
    return s.max_turning > min_curve_turning && core::degrees(s.max_turning) <= request.max_turning_deg() &&
           s.max_ratio <= max_given_ratio;
}

/// Returns the reason why edges are longer than the rules for new points ask for, or nothing where none is. `asked`
/// holds the number of new edges that would take the place of each.
std::string excess_length(std::span<const double> asked, std::span<const Point> points) {
    const auto worst = std::max_element(asked.begin(), asked.end());
    if (*worst <= max_given_ratio) return "";
    const auto i = static_cast<std::size_t>(worst - asked.begin());
    const Point middle = midpoint(points[i], points[(i + 1) % points.size()]);
    return fmt::format(
        "they are up to {:.1f} times as far apart as corners, walls nearby and the layer ask for, at "
        "({:.4g}, {:.4g})",
        *worst, middle.x, middle.y);
}

/// Returns why points are kept, and how many would do where that is less than half of them.
std::string reason_to_keep(std::string reason, std::span<const double> asked) {
    const double enough = std::ceil(std::accumulate(asked.begin(), asked.end(), 0.0));
    if (2 * enough >= static_cast<double>(asked.size())) return reason;
    return reason + fmt::format("; {} would do (--surface resample)", enough);
}

/// Decides on an element of so many points that their number is a choice. Edges that are too long give way one by one.
Decision decide_dense(const Element& e, std::span<const double> asked) {
    std::vector<EdgeRange> single;
    for (std::size_t i = 0; i < asked.size(); ++i) single.push_back({i, 1});
    Decision decision = keep_all(single, asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (asked[i] > max_given_ratio) decision.edges[i] = EdgeTreatment::spline;
    decision.reason = decision.keeps_all() ? reason_to_keep("they are dense", asked) : excess_length(asked, e.points);
    return decision;
}

Decision decide_smooth(const Element& e, std::size_t index, const ResamplingRequest& request) {
    const MeasuredOutline outline(e.points);
    const std::vector<EdgeRange> ranges = ranges_between(e.features.corners, outline.n);
    Sampling all;
    for (const EdgeRange range : ranges) all = coarser(all, outline.sampling(range));
    const std::vector<double> asked = edges_asked_for(e, index, request);
    const bool are_too_close = all.min_spacing < min_given_spacing * outline.extent;
    if (outline.n >= min_dense_points && all.max_ratio <= max_dense_ratio && !are_too_close)
        return decide_dense(e, asked);
    Decision decision = keep_all(ranges, outline.n);
    for (const std::size_t corner : e.features.corners)
        all.max_ratio = std::max(all.max_ratio, outline.ratio_at(corner));
    decision.reason = coarseness(all, outline.extent, request);
    if (decision.reason.empty() && are_too_close)
        decision.reason = fmt::format("some are only {:.1g} of the length apart", all.min_spacing / outline.extent);
    if (decision.reason.empty()) decision.reason = excess_length(asked, e.points);
    if (decision.reason.empty()) {
        decision.reason = reason_to_keep(
            fmt::format("they turn by at most {:.1f} degrees, and neighbouring spacings differ by at most {:.2f}",
                        core::degrees(all.max_turning), all.max_ratio),
            asked);
        return decision;
    }
    for (std::size_t r = 0; r < ranges.size(); ++r)
        if (ranges.size() == 1 || !is_fine(outline.sampling(ranges[r]), ranges[r], asked, request))
            replace_range(decision, r);
    return decision;
}

}  // namespace

bool Decision::keeps_all() const {
    return std::all_of(edges.begin(), edges.end(), [](EdgeTreatment t) { return t == EdgeTreatment::keep; });
}

void Decision::replace_kept(std::size_t edge) {
    if (is_smooth[ranges[edge]]) {
        replace_range(*this, ranges[edge]);
    } else {
        edges[edge] = EdgeTreatment::divide;
    }
}

bool keeps_number_of_points(const Element& e) {
    return !e.samples_of_curve && (is_jagged(e) || e.points.size() >= min_dense_points);
}

bool is_jagged(const Element& e) { return e.features.corners.size() > std::max<std::size_t>(8, e.points.size() / 25); }

Decision decide(const Element& e, std::size_t index, const ResamplingRequest& request) {
    const SurfaceOptions& options = request.options;
    const auto all = [&](EdgeTreatment treatment, std::string reason) {
        return Decision{std::vector(e.points.size(), treatment),
                        std::vector<std::size_t>(e.points.size()),
                        {true},
                        std::move(reason)};
    };
    if (options.treatment == SurfaceTreatment::keep) return all(EdgeTreatment::keep, "as requested");
    if (options.points)
        return all(EdgeTreatment::spline, fmt::format("{} {} points are requested",
                                                      options.exact_points ? "exactly" : "about", *options.points));
    if (const SideEdges* sides = side_edges_of(options, e))
        return all(EdgeTreatment::spline, fmt::format("{} edges on the upper and {} on the lower side are requested",
                                                      sides->upper, sides->lower));
    if (options.treatment == SurfaceTreatment::resample) return all(EdgeTreatment::spline, "as requested");
    const bool has_station = std::any_of(options.station_spacings.begin(), options.station_spacings.end(),
                                         [&](const StationSpacing& s) { return geometry::stands_for(s.element, e); });
    if (options.leading_edge_spacing || options.trailing_edge_spacing || has_station)
        return all(EdgeTreatment::spline, "a spacing is requested");
    if (e.samples_of_curve)
        return all(EdgeTreatment::spline, e.format == "naca"                      ? "its formula is known"
                                          : geometry::is_drawing_format(e.format) ? "its curves are drawn"
                                                                                  : "they were smoothed");
    if (e.format == "naca") return all(EdgeTreatment::keep, "generated points are exact");
    if (e.features.corners.size() == e.points.size())
        return all(EdgeTreatment::spline, "they are the corners of a polygon");
    return is_jagged(e) ? decide_jagged(e, request) : decide_smooth(e, index, request);
}

}  // namespace lamina::surface
