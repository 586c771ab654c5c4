// The public calls: checks, numbers from 0, and the order of batches.
#include <lamina/dynamic_triangulation.hpp>

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/bounding_box.hpp"
#include "core/text.hpp"
#include "delaunay/dynamic/dynamic_tris.hpp"
#include "delaunay/triangulate/brio.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/hilbert.hpp"
#include "delaunay/triangulate/walk.hpp"

namespace lamina {

using namespace delaunay;
using namespace delaunay::dynamic;

/// Vertices are numbered in the order of their insertion, so that what is near in the plane is near in memory. Here
/// they get the numbers of points.
class DynamicTriangulation::Data : public DynamicTris {
public:
    std::vector<Point> points;              ///< by the numbers of points
    std::vector<Index> vertex_of;           ///< for each point its vertex
    std::vector<Index> point_of{no_index};  ///< for each vertex its point
    Index recent = 0;                       ///< a vertex near which the next change is likely; it may have been removed

    VertexId id(Index vertex) const { return VertexId{point_of[vertex]}; }
    Index vertex(VertexId point) const { return vertex_of[point.index()]; }
    bool contains(VertexId point) const {
        return point.valid() && point.index() < points.size() && is_alive(vertex(point));
    }
    void require_contained(VertexId point) const {
        if (!contains(point))
            throw InputError({.points = {point.index()}}, core::concat("there is no point ", point.value));
    }
    void require_room(std::size_t more) const {
        if (more + points.size() > max_triangles / 2)
            throw InputError({}, "these are more points than one triangulation can number");
    }

    /// Appends points and, in this order of theirs, vertices for them. Returns the first vertex.
    Index append_in_order(std::span<const Point> more, std::span<const Index> order) {
        const std::size_t first_point = points.size();
        points.insert(points.end(), more.begin(), more.end());
        std::vector<Point> ordered;
        ordered.reserve(more.size());
        for (const Index i : order) ordered.push_back(more[i]);
        const Index first = append(ordered);
        vertex_of.resize(points.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            const std::size_t point = first_point + order[k];
            point_of.push_back(static_cast<Index>(point));
            vertex_of[point] = static_cast<Index>(first + k);
        }
        return first;
    }
    void drop_last_point() {
        drop_last();
        points.pop_back();
        vertex_of.pop_back();
        point_of.pop_back();
    }
};

namespace delaunay::dynamic {

namespace {

/// Returns an order in which to insert points among so many others. The others take the part of the random rounds of a
/// BRIO where they are more.
std::vector<Index> insertion_order(std::span<const Point> points, std::size_t others) {
    const Box box = core::bounding_box(points);
    if (others < points.size()) return brio_order(points, box);
    constexpr unsigned curve_bits = 20;
    const CurveOrder along_curve(points, HilbertCurve<curve_bits>(box));
    std::vector<Index> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(along_curve[i]);
    return order;
}

}  // namespace

}  // namespace delaunay::dynamic

DynamicTriangulation::DynamicTriangulation() : data_(std::make_unique<Data>()) {}

DynamicTriangulation::DynamicTriangulation(std::span<const Point> points, std::span<const Segment> segments)
    : DynamicTriangulation() {
    core::require_indices_below(points.size(), segments);
    const std::vector<VertexId> ids = insert(points);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        try {
            insert(Segment{ids[segments[i].a.index()], ids[segments[i].b.index()]});
        } catch (const InputError& error) {
            InputPlace place = error.place();
            place.segments = {i};
            throw InputError(place, error.reason());
        }
    }
}

DynamicTriangulation::DynamicTriangulation(const DynamicTriangulation& other)
    : data_(std::make_unique<Data>(*other.data_)) {}
DynamicTriangulation::DynamicTriangulation(DynamicTriangulation&& other) noexcept = default;
DynamicTriangulation& DynamicTriangulation::operator=(DynamicTriangulation other) noexcept {
    data_.swap(other.data_);
    return *this;
}
DynamicTriangulation::~DynamicTriangulation() = default;

VertexId DynamicTriangulation::insert(Point p) {
    Data& data = *data_;
    if (data.tris().empty()) return insert(std::span<const Point>(&p, 1)).front();
    core::require_exact_range({&p, 1}, "point");
    data.require_room(1);
    const Index near = data.sample_near(p, data.recent), only[1] = {0};
    const Index v = data.append_in_order({&p, 1}, only);
    data.recent = data.insert(v, near);
    const VertexId id = data.id(data.recent);
    if (data.recent != v) data.drop_last_point();
    assert(is_sphere(data.tris(), data.alive_count()));
    return id;
}

std::vector<VertexId> DynamicTriangulation::insert(std::span<const Point> points) {
    core::require_exact_range(points, "point");
    Data& data = *data_;
    data.require_room(points.size());
    std::vector<VertexId> ids(points.size());
    if (points.empty()) return ids;
    const std::vector<Index> order = insertion_order(points, data.alive_count());
    const Index first = data.append_in_order(points, order);
    if (data.tris().empty()) {
        const std::vector<Index> found = data.insert_without_triangles(first);
        for (std::size_t k = 0; k < order.size(); ++k) ids[order[k]] = data.id(found[k]);
        data.recent = found.back();
        return ids;
    }
    Index near = data.sample_near(points[order[0]], data.recent);
    for (std::size_t k = 0; k < order.size(); ++k) {
        near = data.insert(static_cast<Index>(first + k), near);
        ids[order[k]] = data.id(near);
    }
    data.recent = near;
    assert(is_sphere(data.tris(), data.alive_count()));
    return ids;
}

void DynamicTriangulation::remove(VertexId point) { remove(std::span<const VertexId>(&point, 1)); }

void DynamicTriangulation::remove(std::span<const VertexId> points) {
    Data& data = *data_;
    std::vector<Index> vertices;
    for (const VertexId point : points) {
        data.require_contained(point);
        vertices.push_back(data.vertex(point));
        if (data.has_constrained_edge(vertices.back()))
            throw InputError({.at = data.points[point.index()], .points = {point.index()}},
                             core::concat("point ", point.value, " is an end of a segment's edge"));
    }
    // Vertices inserted one after another are near to each other.
    std::sort(vertices.begin(), vertices.end());
    if (const auto twice = std::adjacent_find(vertices.begin(), vertices.end()); twice != vertices.end())
        throw InputError({.points = {data.id(*twice).index()}},
                         core::concat("point ", data.id(*twice).value, " is to be removed twice"));
    for (const Index v : vertices) data.remove(v);
}

std::vector<Segment> DynamicTriangulation::insert(Segment segment) {
    Data& data = *data_;
    for (const VertexId end : {segment.a, segment.b}) data.require_contained(end);
    std::vector<Segment> edges;
    if (segment.a == segment.b) return edges;
    if (data.tris().empty())
        throw InputError({.points = {segment.a.index(), segment.b.index()}},
                         "all points lie on one line: segments cannot be inserted");
    std::vector<SegmentPiece> pieces;
    const Segment inner{VertexId{data.vertex(segment.a)}, VertexId{data.vertex(segment.b)}};
    if (const auto crossed = data.insert_segment(inner, pieces)) {
        const VertexId c = data.id(crossed->c), d = data.id(crossed->d);
        throw InputError({.points = {segment.a.index(), segment.b.index(), c.index(), d.index()}},
                         core::concat("segment ", segment.a.value, "-", segment.b.value, " crosses the edge ", c.value,
                                      "-", d.value));
    }
    for (const SegmentPiece& piece : pieces)
        edges.push_back({data.id(piece.segment.a.value), data.id(piece.segment.b.value)});
    return edges;
}

void DynamicTriangulation::remove(Segment segment) {
    Data& data = *data_;
    for (const VertexId end : {segment.a, segment.b}) data.require_contained(end);
    const auto way =
        data.tris().empty() ? std::nullopt : data.find_constrained_way(data.vertex(segment.a), data.vertex(segment.b));
    if (!way || way->empty())
        throw InputError(
            {.points = {segment.a.index(), segment.b.index()}},
            core::concat("no edges of segments lead from point ", segment.a.value, " to ", segment.b.value));
    data.release(*way);
}

std::span<const Point> DynamicTriangulation::points() const { return data_->points; }

bool DynamicTriangulation::contains(VertexId point) const { return data_->contains(point); }

std::size_t DynamicTriangulation::size() const { return data_->alive_count(); }

std::optional<VertexId> DynamicTriangulation::find(Point p) const {
    if (!in_exact_range(p)) return std::nullopt;
    if (!data_->tris().empty()) {
        const auto v = data_->find(p, data_->sample_near(p, data_->recent));
        return v ? std::optional(data_->id(*v)) : std::nullopt;
    }
    for (std::size_t i = 0; i < points().size(); ++i)
        if (points()[i] == p && contains(VertexId{i})) return VertexId{i};
    return std::nullopt;
}

std::vector<Triangle> DynamicTriangulation::triangles() const {
    std::vector<Triangle> triangles;
    triangles.reserve(data_->tris().size());
    for (const Tri& t : data_->tris())
        if (!is_growing_ghost(t)) triangles.push_back({data_->id(t.v[0]), data_->id(t.v[1]), data_->id(t.v[2])});
    return triangles;
}

std::vector<Segment> DynamicTriangulation::segments() const {
    std::vector<Segment> segments;
    for (const Tri& t : data_->tris())
        for (unsigned e = 0; e < 3; ++e) {
            if (!t.n[e].is_constrained()) continue;
            // Both triangles at the edge hold it, one in each direction.
            const VertexId a = data_->id(t.v[next(e)]), b = data_->id(t.v[previous(e)]);
            if (a < b) segments.push_back({a, b});
        }
    std::sort(segments.begin(), segments.end());
    return segments;
}

}  // namespace lamina
