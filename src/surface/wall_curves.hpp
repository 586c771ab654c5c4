// The curves of all walls, found by points on them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/point.hpp>

#include "core/box_tree.hpp"
#include "surface/curved_edge.hpp"

namespace lamina::surface {

/// The part of the curve of an edge between two points of it.
struct CurveStretch {
    const CurvedEdge* edge;
    double from, to;  ///< shares of the edge

    /// Returns the point at a share, in [0, 1], of the stretch.
    Point at(double share) const { return edge->at(from + share * (to - from)); }
};

/// The curves of walls, edge by edge.
class LAMINA_EXPORT WallCurves {
public:
    explicit WallCurves(std::vector<CurvedEdge> edges);

    /// Returns the stretch between two points of the curve of one edge, in the order of the outline; nothing where no
    /// curve goes through both, up to rounding.
    std::optional<CurveStretch> between(Point begin, Point end) const;
    /// Returns the place at a share, in (0, 1), of the stretch between two such points; nothing where there is none, or
    /// where it is straight up to rounding.
    std::optional<Point> place(Point begin, Point end, double share) const;

    std::span<const CurvedEdge> edges() const { return edges_; }
    /// Returns how far the curve of an edge, by its number, is off its chord; 0 where that is rounding alone.
    double bend(std::size_t edge) const { return bends_[edge]; }

private:
    std::vector<CurvedEdge> edges_;  ///< sorted by their first vertices
    double rounding_ = 0;            ///< no point is farther than this off a curve that it was put on
    std::vector<double> bends_;
    core::BoxTree tree_{{}};  ///< over the edges
};

}  // namespace lamina::surface
