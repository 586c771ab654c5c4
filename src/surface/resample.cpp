// An outline loses samples that say little, is cut at its corners, and each stretch between two corners is replaced by
// a spline that is divided anew.
#include "surface/resample.hpp"
#include "geometry/sharp_corner.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "core/text.hpp"
#include "core/tight_box.hpp"
#include "geometry/element_names.hpp"
#include "geometry/trailing_edge.hpp"
#include "surface/corners.hpp"
#include "surface/decision.hpp"
#include "surface/divide_curves.hpp"
#include "surface/notes.hpp"
#include "surface/smooth_run.hpp"
#include "surface/spline.hpp"

namespace lamina::surface {

namespace {

/// A sample is close to another one where their distance is below this share of the next edge.
constexpr double max_close_share = 0.1;

/// A closed outline and its corners, ascending.
struct CorneredOutline {
    std::vector<Point> points;
    std::vector<std::size_t> corners;
    std::vector<std::size_t> origins;  ///< per point: index of the given one, or of the first one of a merged pair
};

/// Replaces each pair of samples that are much closer to each other than to the next ones by one point, since such a
/// pair tells little but its rounding. Pairs whose point would be a corner stay, as at a narrow base, and so do pairs
/// that are `max_pair_length` apart or more, where one of the two is misplaced, and those beside an edge that stays
/// straight.
CorneredOutline merge_close_pairs(const Element& element, std::span<const EdgeTreatment> treatment,
                                  double max_pair_length) {
    const std::vector<Point>& points = element.points;
    const std::size_t n = points.size();
    const auto length_after = [&](std::size_t i) { return distance(points[i % n], points[(i + 1) % n]); };
    const auto is_spline = [&](std::size_t i) { return treatment[i % n] == EdgeTreatment::spline; };
    std::vector<bool> is_merged(n);  // whether a point is merged with the next one
    for (std::size_t i = 0; n >= 5 && i < n; ++i)
        is_merged[i] = !is_given_corner(element, i) && !is_given_corner(element, (i + 1) % n) && is_spline(i + n - 1) &&
                       is_spline(i) && is_spline(i + 1) &&
                       length_after(i) < std::min(max_pair_length, max_close_share * std::min(length_after(i + n - 1),
                                                                                              length_after(i + 1)));

    CorneredOutline outline;
    const auto keep_points = [&] {
        outline.points.clear();
        outline.origins.clear();
        for (std::size_t i = 0; i < n; ++i) {
            if (is_merged[(i + n - 1) % n]) continue;
            outline.points.push_back(is_merged[i] ? midpoint(points[i], points[(i + 1) % n]) : points[i]);
            outline.origins.push_back(i);
        }
    };
    keep_points();
    if (outline.points.size() == n) {
        outline.corners = element.features.corners;
        return outline;
    }
    for (std::size_t corner : find_corners(outline.points)) is_merged[outline.origins[corner]] = false;
    keep_points();
    Element merged;
    merged.points = outline.points;
    for (std::size_t i = 0; i < outline.origins.size(); ++i)
        if (is_given_corner(element, outline.origins[i])) merged.given_corners.push_back(i);
    outline.corners = find_corners(merged);
    return outline;
}

/// The points of an outline from one corner to the next, and the numbers of the given points that they come from.
struct Stretch {
    SmoothRun run;
    std::vector<std::size_t> origins;  ///< per point of the run; the first one of a closed run stands again at the end
};

std::vector<Stretch> stretches_of(const CorneredOutline& outline) {
    std::vector<Stretch> stretches;
    for (SmoothRun& run : split_at_corners(outline.points, outline.corners)) {
        const std::size_t first = run.closed ? 0 : outline.corners[stretches.size()];
        Stretch& stretch = stretches.emplace_back(Stretch{std::move(run), {}});
        const std::size_t count = stretch.run.points.size() + (stretch.run.closed ? 1 : 0);
        for (std::size_t k = 0; k < count; ++k)
            stretch.origins.push_back(outline.origins[(first + k) % outline.points.size()]);
    }
    return stretches;
}

/// Returns what becomes of a stretch between two of its points. Where samples between the two were left out, the
/// spline takes the place of all edges there.
EdgeTreatment treatment_of(const Stretch& stretch, std::size_t piece, std::span<const EdgeTreatment> treatment) {
    const std::size_t from = stretch.origins[piece], to = stretch.origins[piece + 1];
    return (from + 1) % treatment.size() == to ? treatment[from] : EdgeTreatment::spline;
}

/// Drops the sample beside a corner that is much closer to the corner than to the next sample, and within the tolerance
/// of the straight line between the two, unless an edge there stays straight.
void drop_close_to_corners(Stretch& stretch, std::span<const EdgeTreatment> treatment, double tolerance) {
    std::vector<Point>& p = stretch.run.points;
    std::vector<std::size_t>& origins = stretch.origins;
    const auto is_close = [&](Point corner, Point sample, Point next) {
        return distance(corner, sample) < max_close_share * distance(sample, next) &&
               core::distance_to_segment(sample, corner, next) < tolerance;
    };
    const auto are_splines = [&](std::size_t piece) {
        return treatment_of(stretch, piece, treatment) == EdgeTreatment::spline &&
               treatment_of(stretch, piece + 1, treatment) == EdgeTreatment::spline;
    };
    if (stretch.run.closed) return;
    if (p.size() > 3 && are_splines(0) && is_close(p[0], p[1], p[2])) {
        p.erase(p.begin() + 1);
        origins.erase(origins.begin() + 1);
    }
    if (p.size() > 3 && are_splines(p.size() - 3) && is_close(p.back(), p[p.size() - 2], p[p.size() - 3])) {
        p.erase(p.end() - 2);
        origins.erase(origins.end() - 2);
    }
}

/// Drops all samples between two corners that lie on the straight line between these but for their rounding, unless an
/// edge there stays as it is. A spline through them would turn at each of them, on a base of a thousandth of the chord
/// by some degrees. Samples that are as far from the line as from each other are a shape, however large the element.
void drop_rounding(Stretch& stretch, std::span<const EdgeTreatment> treatment, double tolerance) {
    std::vector<Point>& p = stretch.run.points;
    constexpr double max_share_of_edge = 0.25;
    if (stretch.run.closed || p.size() < 3) return;
    for (std::size_t piece = 0; piece + 1 < p.size(); ++piece)
        if (treatment_of(stretch, piece, treatment) != EdgeTreatment::spline) return;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        const double edge = std::min(distance(p[i - 1], p[i]), distance(p[i], p[i + 1]));
        if (core::distance_to_segment(p[i], p.front(), p.back()) > std::min(tolerance, max_share_of_edge * edge))
            return;
    }
    p.erase(p.begin() + 1, p.end() - 1);
    stretch.origins.erase(stretch.origins.begin() + 1, stretch.origins.end() - 1);
}

/// The curves of an outline.
struct OutlineCurves {
    std::vector<OutlineCurve> curves;
    std::vector<std::vector<std::size_t>> knots;  ///< per curve: the given points at the ends of its pieces
    std::vector<bool> starts_at_corner;           ///< per curve
};

/// Appends the curves of a stretch: pieces of its spline in a row are one curve, and so is each straight edge.
void append_curves(const Stretch& stretch, std::span<const EdgeTreatment> treatment, OutlineCurves& result) {
    const SplineCurve spline(stretch.run);
    const std::size_t n = spline.pieces();
    const auto treatment_at = [&](std::size_t piece) { return treatment_of(stretch, piece % n, treatment); };
    const auto is_spline = [&](std::size_t piece) { return treatment_at(piece) == EdgeTreatment::spline; };
    std::size_t first = 0;  // the piece at which the curves of a closed run start: a straight one, if there is any
    while (stretch.run.closed && first < n && is_spline(first)) ++first;
    for (std::size_t k = 0, count = 0; k < n; k += count) {
        const std::size_t piece = (first + k) % n;
        count = 1;
        while (is_spline(piece) && k + count < n && is_spline(piece + count)) ++count;
        const auto straight = [&] { return SplineCurve({{spline.at(piece, 0), spline.at(piece, 1)}, false}); };
        result.curves.push_back({count == n         ? spline
                                 : is_spline(piece) ? spline.part(piece, count)
                                                    : straight(),
                                 HUGE_VAL, treatment_at(piece) == EdgeTreatment::keep});
        std::vector<std::size_t>& knots = result.knots.emplace_back(1, stretch.origins[piece]);
        for (std::size_t j = 0; j < count; ++j) knots.push_back(stretch.origins[(piece + j) % n + 1]);
        result.starts_at_corner.push_back(k == 0 && !stretch.run.closed);
    }
}

/// The vertices at both ends of the chord of an element: at its trailing edge, both corners of a base, and at its
/// leading edge, two points that are as far from the trailing edge as each other.
struct ChordEnds {
    std::vector<Point> leading, trailing;
    /// Numbers of vertices of the outline: where the upper side starts, the leading edge, and where the lower side
    /// ends.
    std::size_t start = 0, nose = 0, end = 0;
    Point trailing_edge;

    /// Returns whether an edge, by its first vertex, is one of the upper side.
    bool is_upper(std::size_t edge, std::size_t n) const { return (edge + n - start) % n < (nose + n - start) % n; }
};

ChordEnds find_chord_ends(std::span<const Point> outline) {
    constexpr double rounding = 1e-9;
    OutlineFeatures features;
    geometry::find_trailing_edge(outline, features);
    ChordEnds ends;
    ends.trailing_edge = features.trailing_edge;
    const auto [upper, lower] = geometry::tail_corners(outline, features);
    ends.start = upper;
    ends.end = lower;
    ends.trailing = {outline[lower]};
    if (upper != lower) ends.trailing.push_back(outline[upper]);
    const Point far = outline[geometry::farthest_vertex(outline, features.trailing_edge)];
    const double farthest = distance(far, features.trailing_edge);
    for (std::size_t i = outline.size(); i-- > 0;) {
        if (distance(outline[i], features.trailing_edge) < (1 - rounding) * farthest) continue;
        ends.leading.push_back(outline[i]);
        ends.nose = i;
    }
    std::reverse(ends.leading.begin(), ends.leading.end());
    return ends;
}

/// Adds the bounds that options set at stations of an element.
void add_station_bounds(SpacingRule& rule, const Element& given, const SurfaceOptions& options, const ChordEnds& ends,
                        double scale) {
    const std::vector<Point>& p = given.points;
    const std::size_t n = p.size();
    const Point chord = ends.trailing_edge - p[ends.nose];
    const auto station = [&](Point q) { return dot(q - p[ends.nose], chord) / squared_length(chord); };
    for (const StationSpacing& wanted : options.station_spacings) {
        if (!geometry::stands_for(wanted.element, given)) continue;
        for (std::size_t i = 0; i < n; ++i) {
            const SurfaceSide side = ends.is_upper(i, n) ? SurfaceSide::upper : SurfaceSide::lower;
            if (wanted.side != SurfaceSide::both && wanted.side != side) continue;
            const Point a = p[i], b = p[(i + 1) % n];
            const double from = station(a) - wanted.station, to = station(b) - wanted.station;
            if (from == to || from * to > 0) continue;
            rule.point_spacings.push_back({a + from / (from - to) * (b - a), wanted.spacing * scale});
        }
    }
}

SpacingRule make_spacing_rule(const ResamplingRequest& request, const ChordEnds& ends, double scale,
                              std::size_t element, const Element& given) {
    const SurfaceOptions& options = request.options;
    // The bound on turning holds for the mean over two edges, of which gradation makes one longer.
    constexpr double turning_share = 0.85;
    SpacingRule rule;
    rule.max_spacing = options.max_spacing * scale;
    rule.min_spacing = options.min_spacing * scale;
    rule.max_turning = turning_share * core::radians(request.max_turning_deg());
    rule.tolerance = options.tolerance * scale;
    // Edges that equidistribute ds/h with dh/ds = g grow by exp(g). The largest g is ln(max_ratio), which this
    // approximant stays below. The margin is for chords, which are shorter than their arcs.
    constexpr double margin = 0.97;
    rule.gradation = std::min(
        {margin * 2 * (options.max_ratio - 1) / (options.max_ratio + 1), options.gradation, request.limits.gradation});
    rule.max_corner_ratio = options.max_ratio;
    for (const geometry::WallSpacing& wall : request.limits.walls)
        if (wall.element == element) rule.walls.push_back(wall);
    rule.clearance_share = options.gap_spacing;
    rule.clearance = [&walls = request.walls, element, min_own_clearance = options.corner_spacing * scale,
                      max_clearance = rule.max_spacing / options.gap_spacing](Point p, Point normal) {
        return walls.clearance(element, p, normal, min_own_clearance, max_clearance);
    };
    const auto add_bounds = [&](std::span<const Point> points, const std::optional<double>& spacing) {
        if (!spacing) return;
        for (Point p : points) rule.point_spacings.push_back({p, *spacing * scale});
    };
    add_bounds(ends.leading, options.leading_edge_spacing);
    add_bounds(ends.trailing, options.trailing_edge_spacing);
    add_station_bounds(rule, given, options, ends, scale);
    return rule;
}

/// Returns the number of edges of a base beside exactly so many other edges.
std::size_t base_edges(const std::optional<std::size_t>& requested, std::size_t others) {
    constexpr std::size_t others_per_edge = 50;
    return requested.value_or(std::max<std::size_t>(1, (others + others_per_edge / 2) / others_per_edge));
}

/// Gives the curve along the base of an element this number of equal edges.
void fix_base(OutlineCurves& curves, const Element& given, std::size_t edges) {
    OutlineFeatures features;
    geometry::find_trailing_edge(given.points, features);
    if (!features.base) return;
    for (std::size_t i = 0; i < curves.curves.size(); ++i) {
        std::vector<std::size_t>& knots = curves.knots[i];
        if (knots.front() != features.base->first || knots.back() != features.base->last) continue;
        OutlineCurve& base = curves.curves[i];
        const Point a = given.points[knots.front()], b = given.points[knots.back()];
        base = {SplineCurve({{a, b}, false}), base.start_spacing, true, edges};
        knots = {knots.front(), knots.back()};
    }
}

/// Divides the curve through the leading edge there, so that each side has curves of its own. Returns the given point
/// at which the sides meet: another one where the leading edge was merged with its neighbour.
std::size_t divide_at_leading_edge(OutlineCurves& curves, const Element& given, const ChordEnds& ends) {
    const Point nose = given.points[ends.nose];
    std::size_t curve = 0, knot = 0;
    double nearest = HUGE_VAL;
    for (std::size_t c = 0; c < curves.curves.size(); ++c)
        for (std::size_t k = 0; k < curves.knots[c].size(); ++k)
            if (const double d = distance(given.points[curves.knots[c][k]], nose); d < nearest) {
                nearest = d;
                curve = c;
                knot = k;
            }
    std::vector<std::size_t>& knots = curves.knots[curve];
    const std::size_t meeting_point = knots[knot];
    if (knot == 0 || knot + 1 == knots.size()) return meeting_point;
    const auto at = [](auto& list, std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::vector<std::size_t> behind(at(knots, knot), knots.end());
    OutlineCurve second = curves.curves[curve];
    second.curve = second.curve.part(knot, behind.size() - 1);
    second.start_spacing = HUGE_VAL;
    curves.curves[curve].curve = curves.curves[curve].curve.part(0, knot);
    knots.erase(at(knots, knot + 1), knots.end());
    curves.curves.insert(at(curves.curves, curve + 1), std::move(second));
    curves.knots.insert(at(curves.knots, curve + 1), behind);
    curves.starts_at_corner.insert(at(curves.starts_at_corner, curve + 1), false);
    return meeting_point;
}

/// Returns the curves of the upper and the lower side with their numbers of edges. Throws OptionError where the
/// trailing edge is no corner, or a side has more curves than edges.
std::vector<CurveGroup> sides_of(const OutlineCurves& curves, const Element& given, const ChordEnds& ends,
                                 const SideEdges& edges) {
    const auto starts_at = [&](std::size_t vertex) {
        for (std::size_t c = 0; c < curves.curves.size(); ++c)
            if (curves.starts_at_corner[c] && curves.knots[c].front() == vertex) return true;
        return false;
    };
    if (!starts_at(ends.start) || !starts_at(ends.end))
        throw OptionError("points",
                          fmt::format("element {} has no corner or base at its trailing edge, where its sides would "
                                      "begin",
                                      given.name));
    std::vector<CurveGroup> sides{{{}, edges.upper}, {{}, edges.lower}};
    for (std::size_t c = 0; c < curves.curves.size(); ++c) {
        if (curves.curves[c].is_kept) continue;
        const bool is_upper = ends.is_upper(curves.knots[c].front(), given.points.size());
        sides[is_upper ? 0 : 1].curves.push_back(c);
    }
    const std::size_t least = least_edges_of_curve(curves.curves);
    for (const CurveGroup& side : sides)
        if (side.curves.empty() || side.edges < least * side.curves.size())
            throw OptionError("points", fmt::format("{} edges are too few for a side of element {} with {} curves",
                                                    side.edges, given.name, side.curves.size()));
    return sides;
}

/// Returns the curves of an outline with the number of edges that all of it is to have. Throws OptionError where that
/// is too small.
std::vector<CurveGroup> whole_outline(const OutlineCurves& curves, const Element& given, std::size_t points) {
    CurveGroup all;
    std::size_t kept = 0;
    for (std::size_t c = 0; c < curves.curves.size(); ++c) {
        if (curves.curves[c].is_kept)
            kept += curves.curves[c].kept_edges;
        else
            all.curves.push_back(c);
    }
    if (const std::size_t least = kept + least_edges_of_curve(curves.curves) * all.curves.size(); points < least)
        throw OptionError("exact_points",
                          fmt::format("exactly {} are too few for the {} of element {}: it needs {}", points,
                                      core::counted(curves.curves.size(), "corner"), given.name, least));
    all.edges = points - kept;
    return {all};
}

/// Divides the curves into the number of edges that the options ask for. Throws OptionError for exact numbers that are
/// too small.
DividedCurves divide_into_requested(const OutlineCurves& curves, const Element& given, const SurfaceOptions& options,
                                    const ChordEnds& ends, const SpacingRule& rule, SampledCurves& known) {
    if (const SideEdges* sides = side_edges_of(options, given))
        return divide_curves_exactly(curves.curves, rule, known, sides_of(curves, given, ends, *sides));
    if (!options.points) return divide_curves(curves.curves, rule, known);
    if (!options.exact_points) return divide_curves_into(curves.curves, rule, known, *options.points);
    return divide_curves_exactly(curves.curves, rule, known, whole_outline(curves, given, *options.points));
}

/// Sets the largest spacing at each corner. Beside a kept edge, that edge alone sets it.
void limit_at_corners(OutlineCurves& curves, const CorneredOutline& outline, const Element& given, std::size_t index,
                      const ResamplingRequest& request, const ChordEnds& ends) {
    const double scale = extent(given.points);
    const std::vector<double> turning = turning_angles(outline.points);
    const std::optional<double>& trailing_edge_spacing = request.options.trailing_edge_spacing;
    std::size_t corners = 0;
    for (std::size_t i = 0, n = curves.curves.size(); i < n; ++i) {
        if (!curves.starts_at_corner[i]) continue;
        const std::size_t corner = outline.corners[corners++];
        if (curves.curves[i].is_kept || curves.curves[(i + n - 1) % n].is_kept) continue;
        const std::vector<Point>& trailing = ends.trailing;
        const bool is_trailing = std::find(trailing.begin(), trailing.end(), outline.points[corner]) != trailing.end();
        const bool is_given = is_given_corner(given, outline.origins[corner]);
        curves.curves[i].start_spacing = trailing_edge_spacing && is_trailing
                                             ? *trailing_edge_spacing * scale
                                             : request.corner_spacing(index, turning[corner], scale, is_given);
    }
}

/// Returns, per new point, the line of the file if a given point stands there, as at corners, else 0.
std::vector<std::size_t> lines_of(const Element& given, const std::vector<Point>& points) {
    std::vector<std::pair<Point, std::size_t>> given_lines;
    for (std::size_t i = 0; i < given.lines.size(); ++i) given_lines.emplace_back(given.points[i], given.lines[i]);
    const auto less = [](const auto& a, const auto& b) { return lexicographically_less(a.first, b.first); };
    std::sort(given_lines.begin(), given_lines.end(), less);
    std::vector<std::size_t> lines;
    for (Point p : points) {
        const auto at = std::lower_bound(given_lines.begin(), given_lines.end(), std::pair{p, std::size_t{0}}, less);
        lines.push_back(at != given_lines.end() && at->first == p ? at->second : 0);
    }
    return lines;
}

/// Returns, per edge of a divided outline, the given edges whose place it takes.
std::vector<GivenEdges> origins_of(const OutlineCurves& outline, const DividedCurves& divided, std::size_t given) {
    std::vector<GivenEdges> origins;
    for (std::size_t c = 0; c < outline.curves.size(); ++c) {
        const std::vector<std::size_t>& knots = outline.knots[c];
        const std::size_t end = c + 1 < divided.starts.size() ? divided.starts[c + 1] : divided.points.size();
        for (std::size_t i = divided.starts[c]; i < end; ++i) {
            const double from = std::floor(divided.positions[i]);
            const double to = i + 1 < end ? std::ceil(divided.positions[i + 1]) : static_cast<double>(knots.size() - 1);
            const std::size_t first = knots[static_cast<std::size_t>(from)], last = knots[static_cast<std::size_t>(to)];
            origins.push_back({first, 1 + (last + given - first - 1) % given});
        }
    }
    return origins;
}

/// Returns the stretches of the curves that the edges of a divided outline stand for.
std::vector<CurvedEdge> curved_edges_of(const OutlineCurves& outline, const DividedCurves& divided) {
    std::vector<CurvedEdge> edges;
    const std::size_t n = divided.points.size();
    for (std::size_t c = 0; c < outline.curves.size(); ++c) {
        const auto curve = std::make_shared<const SplineCurve>(outline.curves[c].curve);
        const std::size_t end = c + 1 < divided.starts.size() ? divided.starts[c + 1] : n;
        for (std::size_t i = divided.starts[c]; i < end; ++i) {
            const double to = i + 1 < end ? divided.positions[i + 1] : static_cast<double>(curve->pieces());
            edges.push_back({divided.points[i], divided.points[(i + 1) % n], curve, divided.positions[i], to});
        }
    }
    return edges;
}

/// Returns the outline of an element with all of its points and corners.
CorneredOutline whole_outline(const Element& given) {
    CorneredOutline outline{given.points, given.features.corners, std::vector<std::size_t>(given.points.size())};
    std::iota(outline.origins.begin(), outline.origins.end(), std::size_t{0});
    return outline;
}

/// Returns the curves of an outline that a spline follows from corner to corner, through all of its points.
OutlineCurves interpolating_curves(const CorneredOutline& outline) {
    const std::vector<EdgeTreatment> treatment(outline.points.size(), EdgeTreatment::spline);
    OutlineCurves curves;
    for (const Stretch& stretch : stretches_of(outline)) append_curves(stretch, treatment, curves);
    return curves;
}

}  // namespace

const SideEdges* side_edges_of(const SurfaceOptions& options, const Element& element) {
    const SideEdges* found = nullptr;
    for (const SideEdges& sides : options.side_edges) {
        const bool gives_way = sides.element == geometry::every_element && found && found->element != sides.element;
        if (geometry::stands_for(sides.element, element) && !gives_way) found = &sides;
    }
    return found;
}

double ResamplingRequest::max_turning_deg() const { return std::min(options.max_turning_deg, limits.max_turning_deg); }

double ResamplingRequest::corner_spacing(std::size_t element, double turning, double extent, bool is_given) const {
    if (is_given && std::abs(core::degrees(turning)) <= max_turning_deg()) return HUGE_VAL;
    if (turning <= core::radians(geometry::sharp_corner_deg)) return options.corner_spacing * extent;
    const double by_options = options.sharp_corner_spacing * extent;
    std::optional<double> by_fans =
        limits.fan_spacings.empty() ? limits.fan_spacing : std::optional(limits.fan_spacings[element]);
    if (by_fans && limits.fan_parts) *by_fans *= turning / (*limits.fan_parts * core::radians(limits.max_turning_deg));
    return by_fans ? std::clamp(*by_fans, 0.25 * by_options, options.corner_spacing * extent) : by_options;
}

double extent(std::span<const Point> outline) { return core::longer_side_of_tight_box(outline); }

std::vector<double> edges_asked_for(const Element& given, std::size_t index, const ResamplingRequest& request) {
    const CorneredOutline outline = whole_outline(given);
    OutlineCurves curves = interpolating_curves(outline);
    const ChordEnds ends = find_chord_ends(given.points);
    limit_at_corners(curves, outline, given, index, request, ends);
    SampledCurves sampled;
    const SpacingRule rule = make_spacing_rule(request, ends, extent(given.points), index, given);
    const std::vector<std::vector<double>> of_pieces = edges_of_pieces(curves.curves, rule, sampled);
    std::vector<double> edges(given.points.size());
    for (std::size_t c = 0; c < of_pieces.size(); ++c)
        for (std::size_t piece = 0; piece < of_pieces[c].size(); ++piece)
            edges[curves.knots[c][piece]] = of_pieces[c][piece];
    return edges;
}

std::vector<CurvedEdge> interpolated_edges(const Element& element) {
    const OutlineCurves curves = interpolating_curves(whole_outline(element));
    std::vector<CurvedEdge> edges;
    for (std::size_t c = 0; c < curves.curves.size(); ++c) {
        const auto curve = std::make_shared<const SplineCurve>(curves.curves[c].curve);
        for (std::size_t piece = 0; piece < curve->pieces(); ++piece) {
            const auto from = static_cast<double>(piece);
            edges.push_back({element.points[curves.knots[c][piece]], element.points[curves.knots[c][piece + 1]], curve,
                             from, from + 1});
        }
    }
    return edges;
}

ResampledElement resample(const Element& given, std::size_t index, const ResamplingRequest& request,
                          std::span<const EdgeTreatment> treatment, const std::string& reason, SampledCurves& known) {
    constexpr double max_pair_share = 1e-3, rounding = 5e-6;  // of the extent; flaps have as many digits as sections
    const SurfaceOptions& options = request.options;
    const double scale = extent(given.points);
    const CorneredOutline outline = merge_close_pairs(given, treatment, max_pair_share * scale);
    OutlineCurves outline_curves;
    for (Stretch& stretch : stretches_of(outline)) {
        drop_close_to_corners(stretch, treatment, 0.5 * options.tolerance * scale);
        drop_rounding(stretch, treatment, rounding * scale);
        append_curves(stretch, treatment, outline_curves);
    }
    ChordEnds ends = find_chord_ends(given.points);
    const SideEdges* sides = side_edges_of(options, given);
    if (sides)
        fix_base(outline_curves, given, base_edges(sides->base, sides->upper + sides->lower));
    else if (options.exact_points)
        fix_base(outline_curves, given, base_edges(options.base_edges, *options.points));
    limit_at_corners(outline_curves, outline, given, index, request, ends);
    if (sides) ends.nose = divide_at_leading_edge(outline_curves, given, ends);
    const SpacingRule rule = make_spacing_rule(request, ends, scale, index, given);

    const std::vector<OutlineCurve>& curves = outline_curves.curves;
    DividedCurves divided = divide_into_requested(outline_curves, given, options, ends, rule, known);
    // Where lamina decides by itself, it takes no points away from an outline whose number of them matters.
    const bool decides_alone = options.treatment == SurfaceTreatment::automatic && !options.points && !sides &&
                               !options.leading_edge_spacing && !options.trailing_edge_spacing &&
                               options.station_spacings.empty();
    if (decides_alone && keeps_number_of_points(given) && divided.points.size() < given.points.size())
        divided = divide_curves_into(curves, rule, known, given.points.size());

    std::vector<GivenEdges> origins = origins_of(outline_curves, divided, given.points.size());
    Element element = given;
    std::vector<CurvedEdge> curved;
    if (request.limits.with_curves) curved = curved_edges_of(outline_curves, divided);
    element.points = std::move(divided.points);
    element.lines = lines_of(given, element.points);
    element.features.corners.clear();
    element.given_corners.clear();
    for (std::size_t c = 0; c < curves.size(); ++c) {
        if (!outline_curves.starts_at_corner[c]) continue;
        element.features.corners.push_back(divided.starts[c]);
        if (is_given_corner(given, outline_curves.knots[c].front())) element.given_corners.push_back(divided.starts[c]);
    }
    const auto kept = static_cast<std::size_t>(std::count(treatment.begin(), treatment.end(), EdgeTreatment::keep));
    element.surface_notes.push_back(
        fmt::format("{} points resampled to {}: {}; {}{} kept, edges within {:.2g} of the spline", given.points.size(),
                    element.points.size(), reason, core::counted(outline.corners.size(), "corner"),
                    kept > 0 ? " and " + core::counted(kept, "given edge") : "", divided.deviation));
    return {std::move(element), std::move(origins), std::move(curved)};
}

}  // namespace lamina::surface
