// The edges that pieces of segments run along, and a search for them by place. planarize.cpp is built on it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "core/box_tree.hpp"
#include "delaunay/constrain/insert_segments.hpp"

namespace lamina::delaunay {

/// An edge that one or several pieces run along, in either direction.
struct PieceEdge {
    Index a, b;  ///< a is lexicographically smaller than b
    friend bool operator==(const PieceEdge&, const PieceEdge&) = default;
    friend bool operator<(const PieceEdge& l, const PieceEdge& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; }
};

/// Returns the edge that a segment runs along.
PieceEdge edge_of(std::span<const Point> points, const Segment& segment);

/// The edges of pieces, sorted, each once, and the segments that run along them.
struct PieceEdges {
    std::vector<PieceEdge> edges;
    std::vector<Index> parents;             ///< the segments along the first edge, then those along the second, ...
    std::vector<std::size_t> first_parent;  ///< for each edge its place in `parents`, and one entry more

    std::span<const Index> parents_of(std::size_t edge) const {
        return std::span(parents).subspan(first_parent[edge], first_parent[edge + 1] - first_parent[edge]);
    }
    /// Returns the number of an edge. Precondition: there is this edge.
    std::size_t find(const PieceEdge& edge) const;
};
PieceEdges edges_of(std::span<const Point> points, std::span<const SegmentPiece> pieces);

/// Finds edges by their bounding boxes, each of which is wider than its edge by a margin on all sides.
class PieceEdgeTree {
public:
    /// Precondition: there is a margin for each edge.
    PieceEdgeTree(std::span<const Point> points, const std::vector<PieceEdge>& edges, std::span<const double> margins)
        : boxes_(edges.size()), order_(edges.size()), tree_(sorted_boxes(points, edges, margins)) {}

    const Box& box(std::size_t edge) const { return boxes_[edge]; }
    /// Calls visit(edge) for each edge whose box overlaps this one.
    template <class Visit>
    void overlaps(const Box& box, Visit&& visit) const {
        tree_.overlaps(box, [&](std::size_t i) { visit(order_[i]); });
    }

private:
    std::vector<Box> sorted_boxes(std::span<const Point> points, const std::vector<PieceEdge>& edges,
                                  std::span<const double> margins);

    std::vector<Box> boxes_;
    std::vector<std::size_t> order_;  ///< the edges in the order of the tree's items
    core::BoxTree tree_;
};

}  // namespace lamina::delaunay
