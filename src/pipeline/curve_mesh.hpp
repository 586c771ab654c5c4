// The last stage, for curved cells: the walls that the mesh was made on become curves again.
#pragma once

#include <span>

#include <lamina/pipeline.hpp>

#include "surface/curved_edge.hpp"

namespace lamina::pipeline {

/// Throws OptionError where cells of a higher order go with options that know straight cells alone.
void validate_order(const CaseOptions& options);

/// Returns the number of points on the curve of each edge of a wall: nodes, and points between to measure by.
inline std::size_t points_on_curves(unsigned order) { return order > 1 ? 2 * std::size_t{order} - 1 : 0; }

/// Throws OptionError where the cells are to be curved and an element has sheets.
void refuse_curved_sheets(unsigned order, const Geometry& geometry);

/// Makes the cells of a mesh follow these curves of its walls, proves them valid, and records both in the result, with a
/// warning of edges that were divided and are straight. Throws MeshError where the cells of the layer form no columns.
/// Precondition: order > 1, and no element has sheets.
void curve_mesh(unsigned order, std::span<const surface::CurvedEdge> curves, MeshResult& result);

}  // namespace lamina::pipeline
