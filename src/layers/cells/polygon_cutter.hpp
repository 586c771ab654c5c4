// Polygons between rays and the outer border, cut into triangles without large angles.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::layers {

/// Cuts polygons, one after the other. Of all triangulations of a polygon without further points, it finds the best
/// one from the best ones of smaller polygons: the triangle on the base i-j has its apex at any corner k between, and
/// the edges i-k and k-j are the bases of what is left.
///
///         ____k_____
///       .'   / `.   `.          The polygon of the base i-j has the corners from i to j. That of all corners stands
///      /    /    `.   \.        on the edge from the first to the last.
///     |    /       `.  |
///     i___/__________`.j
///
/// Source: G. T. Klincsek, Minimal triangulations of polygonal domains, Annals of Discrete Mathematics 9 (1980).
class PolygonCutter {
public:
    explicit PolygonCutter(std::span<const Point> points) : points_(points) {}

    /// Adds the triangles of the best triangulation, counter-clockwise: the sum of 1 / (1 + cos)^4 of the largest
    /// angles of all triangles is smallest, which the largest angle of all decides where one is much larger than
    /// others. Sums that differ by less than a millionth, which is more than rounding, count as equal. Where sums are
    /// equal, `first_leads` prefers large fans from the first corner, otherwise from the last. Returns false, and adds
    /// nothing, where every triangulation has a triangle that is not positive (exact). Each simple polygon has one of
    /// positive triangles. The time grows as the third power of the number of corners.
    /// Precondition: three corners or more, counter-clockwise.
    bool cut(std::span<const VertexId> corners, bool first_leads, std::vector<Triangle>& triangles) {
        return cut_strip(corners, 0, first_leads, triangles);
    }

    /// Does what cut() does, but each triangle has corners of both sides of a strip: of the first `side` corners, and
    /// of the others. An apex then is next to an end of the base, so that the time grows as the second power. With a
    /// side of 0 the polygon is no strip.
    bool cut_strip(std::span<const VertexId> corners, std::size_t side, bool first_leads,
                   std::vector<Triangle>& triangles);

private:
    /// The best triangulation of the polygon of a base.
    struct Best {
        double burden = HUGE_VAL;
        std::size_t apex = 0;
    };

    std::span<const Point> points_;
    std::span<const VertexId> corners_;
    std::vector<Best> best_;  ///< for each corner, those of the bases from it to all corners

    Best& best(std::size_t i, std::size_t j) { return best_[i * corners_.size() + j]; }
    Best find_best(std::size_t i, std::size_t j, bool first_leads, bool is_strip);
    void add_triangles(std::size_t i, std::size_t j, std::vector<Triangle>& triangles);
};

}  // namespace lamina::layers
