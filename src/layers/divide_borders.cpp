// Outer borders must be graded before they are frozen, since no Delaunay refinement mends a long edge beside a short
// one (docs/decisions/0003). First each edge gets the number of parts that its target length needs, and the division
// points of divided edges shift towards the lengths of the neighbours. Then, wherever the parts on both sides of a
// corner still differ by more than the allowed ratio, the edge of the longer part gets one more, until nothing changes.
// Both steps treat the two directions of a front alike.
#include "layers/divide_borders.hpp"

#include <algorithm>
#include <utility>

#include "layers/balance_divisions.hpp"
#include "layers/edge_division.hpp"
#include "layers/polygon_edges.hpp"
#include "layers/stages.hpp"
#include "layers/target_length.hpp"
#include "layers/undo_crossings.hpp"

namespace lamina::layers {

namespace {

/// Returns whether an edge is longer than a source asks for at its middle.
bool exceeds_sources(const PolygonEdge& edge, const BorderOptions& options) {
    const Point middle = midpoint(edge.a, edge.b);
    return std::any_of(options.sources.begin(), options.sources.end(), [&](const SizeSource& source) {
        return edge.length > source.size + options.gradation * distance_to(source, middle);
    });
}

/// Returns the division of an edge by itself. It may stay whole up to so many times its target, unless sources ask for
/// less.
EdgeDivision own_division(const PolygonEdge& edge, std::vector<TargetInterval> target, double whole_up_to,
                          const BorderOptions& options) {
    if (whole_up_to <= target_slack) return {edge.length, std::move(target)};
    const EdgeDivision division(edge.length, target, whole_up_to);
    const bool spared = !division.divided() && division.excess() > target_slack;
    return spared && exceeds_sources(edge, options) ? EdgeDivision(edge.length, std::move(target)) : division;
}

std::vector<EdgeDivision> balanced_divisions(std::span<const PolygonEdge> edges, const BorderOptions& options,
                                             std::span<const std::vector<double>> whole_up_to) {
    const TargetLength target(edges, options);
    std::vector<double> slacks;
    for (const std::vector<double>& front : whole_up_to) slacks.insert(slacks.end(), front.begin(), front.end());
    slacks.resize(edges.size(), target_slack);
    std::vector<EdgeDivision> divisions;
    divisions.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
        divisions.push_back(own_division(edges[i], target.along(i), slacks[i], options));
    balance_divisions(edges, options.max_ratio, divisions);
    return divisions;
}

/// Returns the division points of an edge, without those that floating point cannot tell from their neighbours.
std::vector<Point> division_points(const PolygonEdge& edge, const EdgeDivision& division) {
    std::vector<Point> points;
    Point before = edge.a;
    for (double at : division.division_points()) {
        const Point p = edge.a + (at / edge.length) * (edge.b - edge.a);
        if (p == before || p == edge.b) continue;
        points.push_back(p);
        before = p;
    }
    return points;
}

}  // namespace

BorderDivision divide_borders(std::span<const std::vector<Point>> fronts, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> least_requests,
                              std::span<const std::vector<double>> whole_up_to) {
    const std::vector<PolygonEdge> edges = polygon_edges(fronts, least_requests);
    const std::vector<EdgeDivision> divisions = balanced_divisions(edges, options, whole_up_to);
    std::vector<std::vector<Point>> points(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) points[i] = division_points(edges[i], divisions[i]);
    undo_crossings(edges, polygon_edges(walls), points);

    BorderDivision result;
    std::size_t i = 0;
    for (const std::vector<Point>& front : fronts) {
        auto& points_of_front = result.points.emplace_back();
        auto& excess_of_front = result.excess.emplace_back();
        for (std::size_t k = 0; k < front.size(); ++k, ++i) {
            excess_of_front.push_back(divisions[i].excess());
            points_of_front.push_back(std::move(points[i]));
        }
    }
    return result;
}

}  // namespace lamina::layers
