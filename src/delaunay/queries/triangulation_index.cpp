// The queries of TriangulationIndex, one by one and in batches.
#include <array>
#include <cmath>
#include <limits>

#include <lamina/delaunay_queries.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/text.hpp"
#include "delaunay/queries/query_index.hpp"

namespace lamina {

using namespace delaunay;
using namespace delaunay::queries;

/// The data that copies of an index share.
struct TriangulationIndex::Data {
    QueryIndex index;
};

namespace delaunay::queries {

namespace {

void require_delaunay(const QueryIndex& index) {
    if (!index.is_delaunay)
        throw UsageError("this query needs the Delaunay triangulation of points, with their hull as boundary");
}

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Returns a triangle or ghost that holds p; no_index where there are none, and for coordinates outside the range.
Index find_from_jump(const QueryIndex& index, Point p) {
    if (index.tris.empty() || !in_exact_range(p)) return no_index;
    return walk_to(index, index.at_vertex[vertex_near(index, p)], p);
}

/// Returns the value at p, in or on the triangle t, that is linear and has the values of its corners.
double linear_value(const QueryIndex& index, const Tri& t, std::span<const double> values, Point p) {
    const Point* const v = index.vertices.data();
    const double f[3] = {values[index.point_ids[t.v[0]]], values[index.point_ids[t.v[1]]],
                         values[index.point_ids[t.v[2]]]};
    const std::array<double, 3> weight = linear_weights(v, t, p);
    // From the corner that is nearest in weights, so that a value at a corner comes out as it is.
    const unsigned near = weight[0] >= weight[1] ? (weight[0] >= weight[2] ? 0 : 2) : (weight[1] >= weight[2] ? 1 : 2);
    const unsigned i = next(near), j = previous(near);
    return f[near] + (weight[i] * (f[i] - f[near]) + weight[j] * (f[j] - f[near]));
}

/// Returns the value at p, which the triangle or ghost `found` holds.
double linear_value_at(const QueryIndex& index, Index found, std::span<const double> values, Point p) {
    if (found == no_index) return no_value;
    Index t = found;
    // A point on the boundary may have been found on its outer side.
    if (!index.is_inside(t)) {
        const PointLocation location = classify(index, t, p);
        if (!location.triangle.valid()) return no_value;
        t = index.places[location.triangle.index()];
    }
    return linear_value(index, index.tris[t], values, p);
}

void require_values(const QueryIndex& index, std::span<const double> values) {
    core::require_count(values.size(), "values", index.point_count, "points");
}

}  // namespace

}  // namespace delaunay::queries

TriangulationIndex::TriangulationIndex(std::span<const Point> points, std::span<const Triangle> triangles)
    : data_(std::make_shared<const Data>(Data{make_query_index(points, triangles)})) {}

PointLocation TriangulationIndex::locate(Point p) const {
    const Index found = find_from_jump(data_->index, p);
    return found == no_index ? PointLocation{} : classify(data_->index, found, p);
}

PointLocation TriangulationIndex::locate(Point p, TriangleId hint) const {
    const QueryIndex& index = data_->index;
    if (!hint.valid() || !in_exact_range(p)) return locate(p);
    if (hint.index() >= index.places.size())
        throw InputError({.triangles = {hint.index()}}, core::concat("the hint ", hint.value, " is no triangle"));
    return classify(index, walk_to(index, index.places[hint.index()], p), p);
}

std::vector<PointLocation> TriangulationIndex::locate(std::span<const Point> queries) const {
    std::vector<PointLocation> locations(queries.size());
    for_each_found(data_->index, queries, [&](std::size_t i, Index found) {
        if (found != no_index) locations[i] = classify(data_->index, found, queries[i]);
    });
    return locations;
}

bool TriangulationIndex::is_delaunay() const { return data_->index.is_delaunay; }

VertexId TriangulationIndex::nearest_vertex(Point p) const {
    core::require_exact_range({&p, 1}, "point");
    require_delaunay(data_->index);
    return nearest_point(data_->index, find_from_jump(data_->index, p), p);
}

std::vector<VertexId> TriangulationIndex::nearest_vertices(std::span<const Point> queries) const {
    core::require_exact_range(queries, "point");
    require_delaunay(data_->index);
    std::vector<VertexId> nearest(queries.size());
    for_each_found(data_->index, queries,
                   [&](std::size_t i, Index found) { nearest[i] = nearest_point(data_->index, found, queries[i]); });
    return nearest;
}

NaturalNeighbours TriangulationIndex::natural_neighbours(Point p) const {
    require_delaunay(data_->index);
    const Index found = find_from_jump(data_->index, p);
    return found == no_index ? NaturalNeighbours{} : natural_neighbours_at(data_->index, found, p);
}

std::vector<double> TriangulationIndex::interpolate_linear(std::span<const double> values,
                                                           std::span<const Point> queries) const {
    require_values(data_->index, values);
    std::vector<double> result(queries.size(), no_value);
    for_each_found(data_->index, queries, [&](std::size_t i, Index found) {
        result[i] = linear_value_at(data_->index, found, values, queries[i]);
    });
    return result;
}

double TriangulationIndex::interpolate_linear(std::span<const double> values, Point p) const {
    require_values(data_->index, values);
    return linear_value_at(data_->index, find_from_jump(data_->index, p), values, p);
}

std::vector<double> TriangulationIndex::interpolate_sibson(std::span<const double> values,
                                                           std::span<const Point> queries) const {
    require_values(data_->index, values);
    require_delaunay(data_->index);
    std::vector<double> result(queries.size(), no_value);
    for_each_found(data_->index, queries, [&](std::size_t i, Index found) {
        if (found == no_index) return;
        const NaturalNeighbours n = natural_neighbours_at(data_->index, found, queries[i]);
        if (n.vertices.empty()) return;
        double sum = 0;
        for (std::size_t k = 0; k < n.vertices.size(); ++k) sum += n.weights[k] * values[n.vertices[k].index()];
        result[i] = sum;
    });
    return result;
}

}  // namespace lamina
