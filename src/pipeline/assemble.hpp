// The parts of stage "assemble", which the pipeline needs before all of the mesh is there.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina::pipeline {

/// Returns the name that the marker of the base of an element would have by itself: NAME_base.
std::string wanted_base_name(const Element& element);

/// Returns the name of the marker of each element's base, which no other marker has.
std::vector<std::string> base_marker_names(const Geometry& geometry);

/// Returns the markers of the walls, element by element, and that of the far field.
std::vector<Marker> make_markers(const Geometry& geometry, const Layer& layer, std::vector<Segment> far_field,
                                 const AssembleOptions& options);

/// Does what the public split_far_field() does. `points` holds the vertices of the markers.
void split_far_field(std::span<const Point> points, std::vector<Marker>& markers, double alpha_deg);

/// Does what the public mark_slip_walls() does, likewise.
void mark_slip_walls(std::span<const Point> points, std::vector<Marker>& markers, const FarField& far_field,
                     bool has_ground);

/// Returns the cells of the layer as a mesh of its own, whose points are those of the layer. Regions and layers of cells
/// are there; pieces and markers are not.
Mesh layer_mesh(const Layer& layer, const LayerCells& cells);

}  // namespace lamina::pipeline
