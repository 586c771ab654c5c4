// The constrained Delaunay triangulation of a piece's border: what the piece will hold, and what a line across it
// meets.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "decoupling/piece.hpp"
#include "delaunay/estimate.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::decoupling {

class PieceTriangulation {
public:
    /// `points` holds the piece's vertices by their ids.
    PieceTriangulation(std::span<const Point> points, const Piece& piece, const SizeField& size);

    double triangles() const { return loads_.total; }
    /// Whether a lattice may pay in it.
    bool lattice() const { return loads_.lattice; }

    Point point(Corner c) const { return points_[vertex(c)]; }
    Corner next(Corner c) const { return {c.loop, c.place + 1 < loops_[c.loop].size() ? c.place + 1 : 0}; }
    Corner previous(Corner c) const { return {c.loop, c.place > 0 ? c.place - 1 : loops_[c.loop].size() - 1}; }
    std::size_t loops() const { return loops_.size(); }
    std::size_t corners(std::size_t loop) const { return loops_[loop].size(); }

    /// What a ray meets first: the border edge from a corner to the next one; and what lies left of the ray (told for
    /// pieces of one loop only).
    struct Hit {
        Corner corner;
        double triangles_left = 0;
    };
    /// Nothing where the ray does not leave its corner into the piece, or meets a vertex.
    std::optional<Hit> shoot(Corner from, Point direction) const;

    /// Whether the straight line between two corners leaves both into the piece and touches nothing in between.
    bool sees(Corner from, Corner to) const;

private:
    delaunay::Index vertex(Corner c) const { return loops_[c.loop][c.place]; }
    delaunay::Index first_triangle(Corner from, Point toward) const;
    double held_by(delaunay::Index t) const;
    double beyond(delaunay::Index t, unsigned edge) const;
    void sum_up();

    /// A directed border edge and the triangle on its left.
    struct BorderEdge {
        delaunay::Index a, b;
        delaunay::Link inside;
        Corner corner;  ///< at a
        friend bool operator<(const BorderEdge& l, const BorderEdge& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; }
    };
    const BorderEdge& border_edge(delaunay::Index a, delaunay::Index b) const;

    std::vector<std::vector<delaunay::Index>> loops_;  ///< into points_
    std::vector<Point> points_;
    delaunay::Tris tris_;
    delaunay::Loads loads_;
    std::vector<BorderEdge> border_;  ///< sorted
    /// Triangles of a piece with one loop form a tree: the edge towards the root, and what the triangles below hold
    /// together with this one.
    std::vector<unsigned char> to_root_;
    std::vector<double> below_;
};

}  // namespace lamina::decoupling
