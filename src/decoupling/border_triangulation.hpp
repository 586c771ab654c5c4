// The constrained Delaunay triangulation of a subdomain's border. It answers how many triangles the subdomain will hold
// and where lines across it end.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "decoupling/line_border.hpp"
#include "delaunay/refine/estimate.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::decoupling {

/// The work of refining a subdomain, before it is refined.
struct WorkEstimate {
    double triangles = 0;  ///< number of triangles that refinement will make
    bool lattice = true;   ///< whether a lattice may pay (RefineOptions::lattice)
};

/// A constrained Delaunay triangulation of the vertices of a border, kept inside the border.
class BorderTriangulation {
public:
    BorderTriangulation(LocalBorder border, const SizeField& size);

    /// Returns whether the estimate is more than so many triangles. Where it clearly is, and there are several loops,
    /// only a part of it is made.
    bool has_more_than(double triangles);
    WorkEstimate estimate();
    /// Returns the triangles of the estimate for a border of one loop.
    double triangles() const { return loads_.total; }

    Point point(LoopVertex v) const { return points_[local_index(v)]; }
    LoopVertex next(LoopVertex v) const { return {v.loop, v.index + 1 < loops_[v.loop].size() ? v.index + 1 : 0}; }
    LoopVertex previous(LoopVertex v) const { return {v.loop, v.index > 0 ? v.index - 1 : loops_[v.loop].size() - 1}; }
    /// Returns the number of loops.
    std::size_t loops() const { return loops_.size(); }
    /// Returns the number of vertices of a loop.
    std::size_t vertices(std::size_t loop) const { return loops_[loop].size(); }

    /// The border edge that a ray meets first.
    struct RayHit {
        LoopVertex edge;            ///< the edge runs from here to the next vertex
        double triangles_left = 0;  ///< estimated on the left of the ray; for borders of one loop only
    };
    /// Follows a ray from a vertex of the border. Returns nothing where the ray does not leave the vertex into the
    /// subdomain, or meets another vertex.
    std::optional<RayHit> shoot(LoopVertex from, Point direction) const;

    /// Returns whether the straight line between two vertices leaves both into the subdomain and touches nothing in
    /// between.
    bool sees(LoopVertex from, LoopVertex to) const;

private:
    /// A directed border edge and the triangle on its left.
    struct LoopEdge {
        delaunay::Index a, b;
        delaunay::Link inside;
        LoopVertex from;  ///< where a stands in the border
    };

    delaunay::Index local_index(LoopVertex v) const { return loops_[v.loop][v.index]; }
    void collect_loop_edges();
    void estimate_loads();
    void sum_up_subtrees();
    double triangles_in(delaunay::Index t) const;
    double triangles_beyond(delaunay::Index t, unsigned edge) const;
    LoopEdge* find_loop_edge(delaunay::Index a, delaunay::Index b);
    const LoopEdge& loop_edge(delaunay::Index a, delaunay::Index b) const;
    delaunay::Index first_triangle(LoopVertex from, Point toward) const;
    delaunay::Link link_out_of(delaunay::Index first, LoopVertex from) const;

    std::vector<std::vector<delaunay::Index>> loops_;  ///< indices into points_
    std::vector<Point> points_;
    delaunay::Tris tris_;
    SizeField size_;
    delaunay::LoadEstimate loads_;             ///< empty until they are needed, where there are several loops
    std::vector<LoopEdge> loop_edges_;         ///< by the vertices that they begin at
    std::vector<delaunay::Index> first_edge_;  ///< for each vertex the first of its loop edges, and the number of all
    // The triangles inside a border of one loop form a tree, whose root is triangle 0. Without it both arrays are
    // empty.
    std::vector<unsigned char> to_root_;  ///< for each triangle its edge towards the root
    std::vector<double> subtree_;         ///< estimated triangles in each triangle and all triangles below it
};

/// Estimates the number of triangles in a region that will be cut into subdomains, from its border.
double estimate_undivided(const LocalBorder& border, const SizeField& size);

}  // namespace lamina::decoupling
