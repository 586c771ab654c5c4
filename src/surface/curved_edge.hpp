// The curves that walls follow between their vertices.
#pragma once

#include <vector>

#include <lamina/point.hpp>

namespace lamina::surface {

/// The stretch of a curve between two neighbouring vertices of an outline: a part of the spline that the wall was resampled
/// on, or that goes through points that were kept; straight where the wall is.
struct CurvedEdge {
    Point begin, end;            ///< the two vertices, in the order of the outline
    std::vector<Point> between;  ///< on the curve, at equal steps of its parameter
};

}  // namespace lamina::surface
