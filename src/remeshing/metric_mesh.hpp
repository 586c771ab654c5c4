// Triangles that know their neighbours, vertices that know their metric, and the changes that a remesher makes of them.
//
// Invariants between changes:
//  1. Every triangle in use is counter-clockwise, exactly.
//  2. Neighbours know each other: the edge behind edge h is g if and only if the edge behind g is h.
//  3. MeshVertex::triangle is a triangle at the vertex; on a line that may be divided, any of them.
//  4. MeshTriangle::distortion is that of its corners as they are.
// Edge e of a triangle is opposite its corner e, and leads from corner e + 1 to corner e + 2.
#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <lamina/remesh.hpp>

#include "core/edge_links.hpp"
#include "core/predicates.hpp"
#include "remeshing/metric.hpp"

namespace lamina::remeshing {

inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// An edge of a triangle, opposite its corner of this number. Or, with the highest bit set, a border: nothing behind it
/// changes. Its number is 0 where it stays, or that of a marker, from 1, on which it may be divided.
using EdgeHandle = core::EdgeLink;
using core::edge_link;
using core::edge_of;
using core::triangle_of;
inline constexpr EdgeHandle border_bit = 1u << 31;
inline constexpr EdgeHandle frozen_border = border_bit;
/// More triangles have no handles.
inline constexpr std::size_t most_triangles = std::size_t{1} << 29;
[[noreturn]] void refuse_more_triangles();
constexpr bool is_border(EdgeHandle h) { return (h & border_bit) != 0; }
constexpr unsigned after(unsigned i) { return i == 2 ? 0 : i + 1; }
constexpr unsigned before(unsigned i) { return i == 0 ? 2 : i - 1; }

/// Which changes a vertex allows while the mesh is adapted.
enum class Freedom : std::uint8_t {
    free,     ///< it may move and vanish
    on_line,  ///< inside a straight line of the boundary that may be divided: it may move along it, and vanish
    fixed     ///< it stays
};

struct MeshVertex {
    Point at;
    MetricTensor metric;
    std::uint32_t place = 0;            ///< triangle of the background that holds the vertex
    std::uint32_t triangle = no_index;  ///< one at the vertex
    std::uint32_t origin = no_index;    ///< its number in the mesh that is remeshed; none where it is new
    Freedom freedom = Freedom::fixed;
    bool is_settled = false;  ///< whether nothing has changed round it since it last stayed where it was

    bool is_used() const { return triangle != no_index; }
};

struct MeshTriangle {
    std::uint32_t v[3];  ///< the corners, counter-clockwise; the first is no_index where the triangle is not in use
    EdgeHandle n[3];     ///< what is behind the edges
    float distortion = 0;
    bool is_settled = false;  ///< whether its edges have been found in order since it last changed

    bool is_used() const { return v[0] != no_index; }
};

/// The triangles round a vertex, counter-clockwise, each by its edge opposite the vertex.
using Ring = std::vector<EdgeHandle>;

class MetricMesh {
public:
    std::vector<MeshVertex> vertices;
    std::vector<MeshTriangle> triangles;

    Point point(std::uint32_t v) const { return vertices[v].at; }
    bool turns_left(Point a, Point b, Point c) const { return core::inline_orient2d(a, b, c) > 0; }
    /// Returns the squared length of an edge in the metric of one vertex.
    double squared_length_at(std::uint32_t v, Point edge) const { return product(vertices[v].metric, edge, edge); }
    /// Returns the length in the metric of an edge between two vertices.
    double edge_length(std::uint32_t a, std::uint32_t b) const {
        const Point edge = vertices[b].at - vertices[a].at;
        return length_between(squared_length_at(a, edge), squared_length_at(b, edge));
    }
    /// Returns the distortion of a triangle: 1 if it is equilateral in the mean of the metrics at its corners, and
    /// infinite or negative if it is flat or clockwise up to rounding.
    double distortion(const MeshVertex& a, const MeshVertex& b, const MeshVertex& c) const {
        return triangle_distortion(a.at, b.at, c.at, a.metric + b.metric + c.metric);
    }

    /// Collects the triangles round a vertex; on a line from border to border.
    void collect_ring(std::uint32_t v, Ring& ring) const;

    /// Divides an edge by a new vertex on it. Returns the number of the vertex, or no_index where a triangle would not
    /// be counter-clockwise.
    std::uint32_t divide(EdgeHandle h, const MeshVertex& vertex);
    /// Swaps the diagonal of the two triangles at an edge. Precondition: both new ones are counter-clockwise.
    void swap(EdgeHandle h, float first, float second);
    /// Contracts the edge from the vertex of a ring to the origin (or target) of an edge opposite it. Precondition: all
    /// triangles that stay are counter-clockwise.
    void contract(std::uint32_t v, const Ring& ring, std::uint32_t onto);
    /// Moves a vertex, with its metric. `distortions` are those of its triangles afterwards. Precondition: the
    /// triangles stay counter-clockwise.
    void move(std::uint32_t v, const Ring& ring, const MeshVertex& moved, std::span<const float> distortions);
    /// Numbers triangles and vertices as a walk from neighbour to neighbour meets them, and drops those that are not in
    /// use: what is close in the mesh comes close in memory. Source: E. Cuthill, J. McKee, ACM National Conference
    /// (1969).
    void renumber();
    /// Finds the distortion of a triangle, and notes that it has changed.
    void renew(std::uint32_t t);

private:
    /// Two triangles t and u at an edge b-c, with the corners a and d opposite it, and what is behind their other
    /// edges.
    struct TwoTriangles {
        std::uint32_t t, u, a, b, c, d;
        EdgeHandle to_ca, to_ab, to_bd, to_dc;
    };
    TwoTriangles triangles_at(EdgeHandle h) const;
    std::uint32_t divide_border(EdgeHandle h, const MeshVertex& vertex);
    std::uint32_t new_triangle();
    void link(std::uint32_t t, unsigned e, EdgeHandle behind) {
        triangles[t].n[e] = behind;
        if (!is_border(behind)) triangles[triangle_of(behind)].n[edge_of(behind)] = edge_link(t, e);
    }
    void set_corners(std::uint32_t t, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        triangles[t].v[0] = a;
        triangles[t].v[1] = b;
        triangles[t].v[2] = c;
        vertices[a].triangle = vertices[b].triangle = vertices[c].triangle = t;
    }

    std::vector<std::uint32_t> unused_;  ///< triangles that are not in use
};

}  // namespace lamina::remeshing
