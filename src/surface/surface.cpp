// The stage "prepare": new points for the elements that need them, and the safety net behind it.
#include <lamina/surface.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/text.hpp"
#include "geometry/element_names.hpp"
#include "geometry/sheets.hpp"
#include "geometry/symmetry.hpp"
#include "geometry/trailing_edge.hpp"
#include "surface/clearance.hpp"
#include "surface/corners.hpp"
#include "surface/crossings.hpp"
#include "surface/decision.hpp"
#include "surface/notes.hpp"
#include "surface/resample.hpp"
#include "surface/smooth_run.hpp"
#include "surface/smoothing_spline.hpp"
#include "surface/spacing_limits.hpp"

namespace lamina::surface {

namespace {

// ---- smoothing -----------------------------------------------------------------------------------------------------

/// Smooths the runs between corners. The corners stay where they are.
void smooth(Element& e, double tolerance) {
    const std::vector<Point> given = e.points;
    const std::vector<std::size_t>& corners = e.features.corners;
    const std::vector<SmoothRun> runs = split_at_corners(given, corners);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const std::size_t first = corners.empty() ? 0 : corners[k];
        const std::vector<Point> points = smoothed(runs[k], tolerance).points;
        for (std::size_t i = 0; i < points.size(); ++i) e.points[(first + i) % given.size()] = points[i];
    }
    double moved = 0;
    for (std::size_t i = 0; i < given.size(); ++i) moved = std::max(moved, distance(given[i], e.points[i]));
    e.surface_notes.push_back(fmt::format("smoothed: points moved by up to {:.2g}", moved));
}

// ---- where outlines cross ------------------------------------------------------------------------------------------

/// Gives an element back its given points, unless it has them already, and adds a note with the reason.
void restore(Geometry& geometry, std::size_t element, const Geometry& given, const std::string& reason) {
    const Element& original = given.elements[element];
    if (geometry.elements[element].points == original.points) return;
    geometry.elements[element] = original;
    geometry.elements[element].surface_restored = true;
    geometry.elements[element].surface_notes.push_back(
        fmt::format("{} points kept as given: {}", original.points.size(), reason));
}

bool is_simple(const Geometry& geometry) {
    try {
        check_simple(geometry);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Restores the given points of elements above a line of symmetry whose new outlines reach it.
void restore_below_symmetry(Geometry& geometry, const Geometry& given) {
    if (!geometry.symmetry) return;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const Element& element = geometry.elements[e];
        const bool is_above = std::all_of(element.points.begin(), element.points.end(),
                                          [&](Point p) { return p.y > *geometry.symmetry; });
        if (!is_above && !element.is_mirrored)
            restore(geometry, e, given, "its smooth curve would cross the line of symmetry");
    }
}

/// Restores the given points of elements whose new outlines cross themselves or each other.
void restore_crossing(Geometry& geometry, const Geometry& given) {
    if (is_simple(geometry)) return;
    const std::size_t n = geometry.elements.size();
    for (std::size_t e = 0; e < n; ++e)
        if (!is_simple({{geometry.elements[e]}})) restore(geometry, e, given, "its smooth curve would cross itself");
    for (std::size_t e = 0; e < n && !is_simple(geometry); ++e)
        restore(geometry, e, given, "its smooth curve would cross that of another element");
}

/// Throws OptionError unless each element has the points whose exact number is asked for.
void require_exact_points(const Geometry& geometry, const SurfaceOptions& options) {
    for (const Element& e : geometry.elements) {
        const bool has_sides = side_edges_of(options, e) != nullptr;
        if (!has_sides && !options.exact_points) continue;
        if (e.surface_restored || (options.exact_points && e.points.size() != *options.points))
            throw OptionError(has_sides ? "points" : "exact_points",
                              fmt::format("element {}: {}", e.name, e.surface_notes.back()));
    }
}

/// An element, what becomes of its points, and the edges of the new ones.
struct Plan {
    Decision decision;
    std::vector<GivenEdges> origins;   ///< as in ResampledElement; empty where all points are kept
    std::size_t straightened = 0;      ///< number of edges that stay straight lest they cross
    SampledCurves sampled{};           ///< the curves that the points were put on, for the next time
    std::vector<CurvedEdge> curves{};  ///< of the edges
};

// ---- sheets --------------------------------------------------------------------------------------------------------

/// Gives the given edges on both sides of sheets the same treatment: the one that changes more.
void treat_sides_alike(const Element& given, std::vector<EdgeTreatment>& edges) {
    const std::size_t n = edges.size();
    for (const geometry::SheetRange& range : geometry::sheet_ranges(given))
        for (std::size_t i = range.first; i < range.tip; ++i) {
            EdgeTreatment &edge = edges[i % n], &across = edges[range.across(i, n)];
            for (const EdgeTreatment treatment : {EdgeTreatment::divide, EdgeTreatment::spline})
                if (edge == treatment || across == treatment) {
                    edge = across = treatment;
                    break;
                }
        }
}

/// Returns the given edges on the other side of the sheet that some are on.
GivenEdges edges_across(const GivenEdges& edges, const Element& given) {
    const std::size_t n = given.points.size();
    for (const geometry::SheetRange& range : geometry::sheet_ranges(given)) {
        const std::size_t first = edges.first < range.first ? edges.first + n : edges.first;
        if (first < range.last) return {range.across(edges.first + edges.count - 1, n), edges.count};
    }
    return edges;
}

/// Makes both sides of the sheets of an element alike. `origins` are those of its edges.
void fold_sheets(Element& element, const Element& given, std::vector<GivenEdges>& origins) {
    const std::size_t n = element.points.size();
    const std::vector<geometry::FoldedVertex> vertices = geometry::fold_again(element);
    std::vector<GivenEdges> folded;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const geometry::FoldedVertex &from = vertices[i], &to = vertices[(i + 1) % vertices.size()];
        if ((from.from + 1) % n == to.from) {
            folded.push_back(origins[from.from]);
        } else {
            // The edge is across from the one that ends, or begins, at the vertex that its own end is across from.
            const std::size_t edge = to.is_across ? to.from : (from.from + n - 1) % n;
            folded.push_back(edges_across(origins[edge], given));
        }
    }
    origins = std::move(folded);
}

/// Makes the new points of an element.
void apply(Plan& plan, Element& element, const Element& given, std::size_t index, const ResamplingRequest& request) {
    ResampledElement resampled =
        resample(given, index, request, plan.decision.edges, plan.decision.reason, plan.sampled);
    element = std::move(resampled.element);
    element.resampled = true;
    element.smooth = !is_jagged(given);
    plan.origins = std::move(resampled.origins);
    plan.curves = std::move(resampled.curves);
    if (!element.sheets.empty()) fold_sheets(element, given, plan.origins);
    if (plan.straightened > 0)
        element.surface_notes.push_back(
            fmt::format("{} stay straight, since the smooth curve would cross itself or another one",
                        core::counted(plan.straightened, "given edge")));
}

/// Replaces given edges that are kept beside far shorter new ones, until there are none.
void even_out_joints(Plan& plan, Element& element, const Element& given, std::size_t index,
                     const ResamplingRequest& request) {
    constexpr int max_rounds = 20;
    constexpr double max_ratio = 1.25;
    const double gradation = std::min(request.options.gradation, request.limits.gradation);
    for (int round = 0; round < max_rounds; ++round) {
        const std::size_t n = element.points.size();
        const std::vector<EdgeTreatment> before = plan.decision.edges;
        const auto is_kept = [&](std::size_t i) { return before[plan.origins[i].first] == EdgeTreatment::keep; };
        // From a joint on, replaced edges end about as long as the new one that they begin beside, plus the gradation.
        const auto replace_from = [&](std::size_t other, std::size_t step) {
            const auto length = [&](std::size_t i) { return distance(element.points[i], element.points[(i + 1) % n]); };
            double spacing = length(other);
            for (std::size_t i = (other + step) % n; is_kept(i) && length(i) > max_ratio * spacing;
                 i = (i + step) % n) {
                plan.decision.replace_kept(plan.origins[i].first);
                spacing += gradation * length(i);
            }
        };
        for (std::size_t i = 0; i < n; ++i) {
            if (is_kept(i)) continue;
            replace_from(i, 1);
            replace_from(i, n - 1);
        }
        treat_sides_alike(given, plan.decision.edges);
        if (plan.decision.edges == before) return;
        apply(plan, element, given, index, request);
    }
}

/// Makes given edges straight that are on the spline, and so many more on both sides of them. Returns whether there
/// were any.
bool straighten(Plan& plan, GivenEdges range, std::size_t margin) {
    std::vector<EdgeTreatment>& edges = plan.decision.edges;
    const std::size_t n = edges.size(), count = std::min(range.count + 2 * margin, n);
    const std::size_t before = plan.straightened;
    for (std::size_t k = 0; k < count; ++k) {
        EdgeTreatment& edge = edges[(range.first + n - margin % n + k) % n];
        if (edge != EdgeTreatment::spline) continue;
        edge = EdgeTreatment::divide;
        ++plan.straightened;
    }
    return plan.straightened > before;
}

/// Makes edges straight, of which new outlines cross themselves or each other, until none crosses any more or no edge
/// that crosses is left on a spline.
void straighten_crossing(Geometry& geometry, std::vector<Plan>& plans, const Geometry& given,
                         const ResamplingRequest& request) {
    constexpr int max_rounds = 12;
    std::size_t margin = 0;
    for (int round = 0; round < max_rounds; ++round) {
        std::vector<bool> is_changed(plans.size());
        for (const CrossingEdge& edge : find_crossing_edges(geometry)) {
            Plan& plan = plans[edge.element];
            if (plan.origins.empty()) continue;
            if (straighten(plan, plan.origins[edge.index], margin)) is_changed[edge.element] = true;
        }
        if (std::find(is_changed.begin(), is_changed.end(), true) == is_changed.end()) return;
        for (std::size_t e = 0; e < plans.size(); ++e)
            if (is_changed[e]) {
                treat_sides_alike(given.elements[e], plans[e].decision.edges);
                apply(plans[e], geometry.elements[e], given.elements[e], e, request);
            }
        margin = std::max<std::size_t>(1, 2 * margin);
    }
}

/// Returns the limits with the spacings of walls above a line of symmetry mirrored to the images below.
SpacingLimits mirrored_limits(SpacingLimits limits, const Geometry& geometry) {
    if (!geometry.symmetry) return limits;
    const double y = *geometry.symmetry;
    const auto is_mirrored = [&](const geometry::WallSpacing& wall) {
        return geometry.elements[wall.element].is_mirrored;
    };
    std::erase_if(limits.walls, [&](const geometry::WallSpacing& wall) {
        return is_mirrored(wall) && midpoint(wall.a, wall.b).y < y;
    });
    const std::size_t n = limits.walls.size();
    for (std::size_t i = 0; i < n; ++i) {
        geometry::WallSpacing wall = limits.walls[i];
        if (!is_mirrored(wall)) continue;
        const Point first = wall.a;
        wall.a = geometry::image_of(wall.b, y);
        wall.b = geometry::image_of(first, y);
        limits.walls.push_back(wall);
    }
    return limits;
}

/// Smooths the outlines that stay simple where they are smoothed.
void smooth_all(Geometry& given, double tolerance) {
    Geometry smoothed = given;
    for (Element& e : smoothed.elements)
        if (e.sheets.empty()) smooth(e, tolerance);
    restore_crossing(smoothed, given);
    given = std::move(smoothed);
}

void note_scatter(Geometry& given) {
    for (Element& e : given.elements) {
        if (is_jagged(e)) continue;
        add_noise_note(e);
        add_misplaced_point_notes(e);
    }
}

/// Leaves an outline as it is, with the curves between its points where these are asked for.
void keep_points(Plan& plan, Element& element, const Element& given, const ResamplingRequest& request) {
    element.surface_notes.push_back(fmt::format("{} points kept: {}", element.points.size(), plan.decision.reason));
    // Points that are kept on request may be as noisy and uneven as they like.
    const bool on_request = request.options.treatment == SurfaceTreatment::keep;
    element.smooth = !on_request && !is_jagged(given);
    if (request.limits.with_curves && (!on_request || request.options.curve_kept))
        plan.curves = interpolated_edges(element);
}

}  // namespace

PreparedSurfaces prepare_with_curves(Geometry given, const SurfaceOptions& options, const SpacingLimits& given_limits,
                                     std::optional<double> chord) {
    validate(options);
    for (const StationSpacing& station : options.station_spacings)
        geometry::require_known_element(given, station.element, "spacing_at");
    for (const SideEdges& sides : options.side_edges) geometry::require_known_element(given, sides.element, "points");
    const SpacingLimits limits = mirrored_limits(given_limits, given);
    for (Element& e : given.elements) e.features.corners = find_corners(e);
    if (options.smooth)
        smooth_all(given, in_units(*options.smooth, chord ? *chord : bounding_box(given).width()));
    else
        note_scatter(given);

    const ClearanceSearch walls(given);
    const ResamplingRequest request{options, limits, walls};
    Geometry result = given;
    std::vector<Plan> plans;
    for (std::size_t i = 0; i < given.elements.size(); ++i) {
        Element& element = result.elements[i];
        Plan& plan = plans.emplace_back(Plan{decide(element, i, request), {}});
        treat_sides_alike(element, plan.decision.edges);
        if (plan.decision.keeps_all()) {
            keep_points(plan, element, given.elements[i], request);
        } else {
            apply(plan, element, given.elements[i], i, request);
            even_out_joints(plan, element, given.elements[i], i, request);
        }
    }
    straighten_crossing(result, plans, given, request);
    restore_below_symmetry(result, given);
    restore_crossing(result, given);
    require_exact_points(result, options);
    geometry::mirror_again(result);
    for (Element& e : result.elements) geometry::find_trailing_edge(e.points, e.features);
    PreparedSurfaces prepared{std::move(result), {}};
    for (std::size_t e = 0; e < plans.size(); ++e) {
        // Given points that were restored stand between straight edges, and sheets between two sides.
        const Element& element = prepared.geometry.elements[e];
        if (element.surface_restored || !element.sheets.empty()) continue;
        prepared.curves.insert(prepared.curves.end(), plans[e].curves.begin(), plans[e].curves.end());
    }
    return prepared;
}

Geometry prepare_within(Geometry given, const SurfaceOptions& options, const SpacingLimits& limits,
                        std::optional<double> chord) {
    return prepare_with_curves(std::move(given), options, limits, chord).geometry;
}

}  // namespace lamina::surface

namespace lamina {

Geometry prepare_surfaces(Geometry geometry, const SurfaceOptions& options, std::optional<double> chord) {
    return surface::prepare_within(std::move(geometry), options, {}, chord);
}

}  // namespace lamina
