// The number of triangles that a bound of the angles alone asks for.
#pragma once

#include "delaunay/refine/border_lines.hpp"
#include "delaunay/refine/constrained_input.hpp"

namespace lamina::delaunay {

/// The triangles that an angle bound asks for, by estimate.
struct AngleEstimate {
    double in_channels = 0;  ///< in narrow channels between constrained edges
    double growing = 0;      ///< round small edges, and on the open sides of channels: from small ones to large ones
};

/// Estimates the triangles once all angles reach the bound. Edges are cut into parts about as long as the channel
/// beside them is wide. `lines` are the borders of the input.
AngleEstimate estimate_for_angles(const ConstrainedInput& input, const BorderLines& lines, double min_angle_deg);

}  // namespace lamina::delaunay
