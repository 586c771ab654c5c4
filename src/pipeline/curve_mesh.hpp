// The last stage, for curved cells: the walls that the mesh was made on become curves again.
#pragma once

#include <lamina/pipeline.hpp>

#include "mesh/curve_cells.hpp"
#include "surface/wall_curves.hpp"

namespace lamina::pipeline {

/// Throws OptionError where cells of a higher order go with options that know straight cells alone.
void validate_order(const CaseOptions& options);

/// Throws OptionError where the cells are to be curved and an element has sheets.
void refuse_curved_sheets(unsigned order, const Geometry& geometry);

/// Makes the cells of a mesh follow these curves of its walls, proves them valid, and records both in the result, with
/// a warning of parts of edges that are beside the curve and straight. Throws MeshError where the cells of the layer
/// form no columns. Precondition: the order is above 1, and no element has sheets.
void curve_mesh(const mesh::CellOrder& order, const surface::WallCurves& curves, MeshResult& result);

}  // namespace lamina::pipeline
