// The public calls: checks, numbers from 0, and the order of batches.
#include <lamina/dynamic_triangulation.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/bounding_box.hpp"
#include "core/text.hpp"
#include "delaunay/brio.hpp"
#include "delaunay/dynamic/dynamic_tris.hpp"
#include "delaunay/hilbert.hpp"
#include "delaunay/walk.hpp"

namespace lamina {

using namespace delaunay;
using namespace delaunay::dynamic;

/// Vertex v of the triangles is point v - 1.
class DynamicTriangulation::Data : public DynamicTris {
public:
    Index recent = 0;  ///< a vertex near which the next change is likely; it may have been removed

    void require_room(std::size_t points) const {
        if (points + vertices().size() > max_triangles / 2)
            throw InputError({}, "these are more points than one triangulation can number");
    }
    void require_contained(VertexId point) const {
        if (!point.valid() || !is_alive(static_cast<Index>(point.index() + 1)))
            throw InputError({.points = {point.index()}}, core::concat("there is no point ", point.value));
    }
};

DynamicTriangulation::DynamicTriangulation() : data_(std::make_unique<Data>()) {}

DynamicTriangulation::DynamicTriangulation(std::span<const Point> points, std::span<const Segment> segments)
    : DynamicTriangulation() {
    core::require_indices_below(points.size(), segments);
    const std::vector<VertexId> ids = insert(points);
    for (const Segment& s : segments) insert(Segment{ids[s.a.index()], ids[s.b.index()]});
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
    const Index near = data.sample_near(p, data.recent), v = data.append({&p, 1});
    data.recent = data.insert(v, near);
    if (data.recent != v) data.drop_last();
    return VertexId{data.recent - 1};
}

std::vector<VertexId> DynamicTriangulation::insert(std::span<const Point> points) {
    core::require_exact_range(points, "point");
    data_->require_room(points.size());
    std::vector<VertexId> ids(points.size());
    if (points.empty()) return ids;
    Data& data = *data_;
    const Index first = data.append(points);
    if (data.tris().empty()) {
        std::vector<Index> vertices(points.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = static_cast<Index>(first + i);
        const std::vector<Index> found = data.insert_without_triangles(vertices);
        for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = VertexId{found[i] - 1};
        data.recent = found.back();
        return ids;
    }
    const std::vector<Index> order = brio_order(points, core::bounding_box(points));
    Index near = data.sample_near(points[order[0]], data.recent);
    for (const Index i : order) {
        near = data.insert(first + i, near);
        ids[i] = VertexId{near - 1};
    }
    data.recent = near;
    return ids;
}

void DynamicTriangulation::remove(VertexId point) { remove(std::span<const VertexId>(&point, 1)); }

void DynamicTriangulation::remove(std::span<const VertexId> points) {
    Data& data = *data_;
    std::vector<Point> places;
    for (const VertexId point : points) {
        data.require_contained(point);
        if (data.has_constrained_edge(static_cast<Index>(point.index() + 1)))
            throw InputError({.at = this->points()[point.index()], .points = {point.index()}},
                             core::concat("point ", point.value, " is an end of a segment's edge"));
        places.push_back(this->points()[point.index()]);
    }
    if (points.empty()) return;
    std::vector<VertexId> sorted(points.begin(), points.end());
    std::sort(sorted.begin(), sorted.end());
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
        throw InputError({.points = {twice->index()}}, core::concat("point ", twice->value, " is to be removed twice"));
    constexpr unsigned curve_bits = 20;
    const CurveOrder order(places, HilbertCurve<curve_bits>(core::bounding_box(places)));
    for (std::size_t i = 0; i < points.size(); ++i) data.remove(static_cast<Index>(points[order[i]].index() + 1));
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
    const Segment inner{VertexId{segment.a.index() + 1}, VertexId{segment.b.index() + 1}};
    if (const auto crossed = data.insert_segment(inner, pieces))
        throw InputError({.points = {segment.a.index(), segment.b.index(), crossed->c - std::size_t{1},
                                     crossed->d - std::size_t{1}}},
                         core::concat("segment ", segment.a.value, "-", segment.b.value, " crosses the edge ",
                                      crossed->c - 1, "-", crossed->d - 1));
    for (const SegmentPiece& piece : pieces)
        edges.push_back({VertexId{piece.segment.a.index() - 1}, VertexId{piece.segment.b.index() - 1}});
    return edges;
}

void DynamicTriangulation::remove(Segment segment) {
    Data& data = *data_;
    for (const VertexId end : {segment.a, segment.b}) data.require_contained(end);
    const auto way = data.tris().empty() ? std::nullopt
                                         : data.find_constrained_way(static_cast<Index>(segment.a.index() + 1),
                                                                     static_cast<Index>(segment.b.index() + 1));
    if (!way || way->empty())
        throw InputError(
            {.points = {segment.a.index(), segment.b.index()}},
            core::concat("no edges of segments lead from point ", segment.a.value, " to ", segment.b.value));
    data.release(*way);
}

std::span<const Point> DynamicTriangulation::points() const { return data_->vertices().subspan(1); }

bool DynamicTriangulation::contains(VertexId point) const {
    return point.valid() && point.index() < points().size() && data_->is_alive(static_cast<Index>(point.index() + 1));
}

std::size_t DynamicTriangulation::size() const { return data_->alive_count(); }

std::optional<VertexId> DynamicTriangulation::find(Point p) const {
    if (!in_exact_range(p)) return std::nullopt;
    if (!data_->tris().empty()) {
        const auto v = data_->find(p, data_->sample_near(p, data_->recent));
        return v ? std::optional(VertexId{*v - 1}) : std::nullopt;
    }
    for (std::size_t i = 0; i < points().size(); ++i)
        if (points()[i] == p && contains(VertexId{i})) return VertexId{i};
    return std::nullopt;
}

std::vector<Triangle> DynamicTriangulation::triangles() const {
    std::vector<Triangle> triangles;
    for (const Tri& t : data_->tris())
        if (!is_growing_ghost(t))
            triangles.push_back({VertexId{t.v[0] - 1}, VertexId{t.v[1] - 1}, VertexId{t.v[2] - 1}});
    return triangles;
}

std::vector<Segment> DynamicTriangulation::segments() const {
    std::vector<Segment> segments;
    for (const Tri& t : data_->tris())
        for (unsigned e = 0; e < 3; ++e)
            if (t.n[e].is_constrained() && t.v[next(e)] < t.v[previous(e)])
                segments.push_back({VertexId{t.v[next(e)] - 1}, VertexId{t.v[previous(e)] - 1}});
    std::sort(segments.begin(), segments.end());
    return segments;
}

}  // namespace lamina
