// The curves that walls follow between their vertices.
#pragma once

#include <memory>

#include <lamina/point.hpp>

#include "surface/spline.hpp"

namespace lamina::surface {

/// The stretch of a curve between two neighbouring vertices of an outline: a part of the spline that the wall was
/// resampled on, or that goes through points that were kept; straight where the wall is.
struct CurvedEdge {
    Point begin, end;                          ///< the two vertices, in the order of the outline
    std::shared_ptr<const SplineCurve> curve;  ///< what the stretch is a part of
    double from, to;                           ///< positions of the two on it, in pieces from its start

    /// Returns the point at a share, in [0, 1], of the stretch, by the parameter of the curve.
    Point at(double share) const {
        if (share <= 0) return begin;
        return share < 1 ? curve->between(from, to, share) : end;
    }
};

}  // namespace lamina::surface
