// The parts of stage "assemble", which the pipeline needs before all of the mesh is there.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

#include "decoupling/subdomain.hpp"
#include "layers/layer.hpp"
#include "pipeline/outer_walls.hpp"

namespace lamina::pipeline {

/// Returns the name that the marker of the base of an element would have by itself: NAME_base.
std::string wanted_base_name(const Element& element);

/// Returns the name of the marker of each element's base, which no other marker has.
std::vector<std::string> base_marker_names(const Geometry& geometry);

/// Returns the markers of the walls, element by element, and that of the far field.
std::vector<Marker> make_markers(const Geometry& geometry, const layers::Layer& layer, std::vector<Segment> far_field,
                                 const AssembleOptions& options);

/// Divides the markers that are far fields into `inlet`, where a uniform flow at this angle enters, and `outlet`, the
/// rest. Either is left out where it has no edge. `points` holds the vertices of the markers. Throws OptionError where
/// another marker has one of these names.
LAMINA_EXPORT void split_far_field(std::span<const Point> points, std::vector<Marker>& markers, double alpha_deg);

/// Adds the markers of walls on the border of the domain, with these edges: of the kind symmetry where the flow slips
/// along them. Throws OptionError where a marker has the name of one.
LAMINA_EXPORT void add_outer_walls(std::span<const OuterWallFacts> walls, std::span<const std::vector<Segment>> edges,
                                   std::vector<Marker>& markers);

/// Puts the markers round a domain in a row of blades in the place of the far field. Throws OptionError where a marker
/// has the name of one.
void add_row(std::span<const Marker> row, std::vector<Marker>& markers);

/// Returns the cells of the layer as a mesh of its own, whose points are those of the layer. Regions and layers of
/// cells are there; pieces and markers are not.
Mesh layer_mesh(const layers::Layer& layer, const layers::LayerCells& cells);

/// Joins the layer and the refined subdomains to one mesh, without any search by coordinates. Vertices keep the numbers
/// of the decoupling (walls, layer, separators); Steiner points follow, subdomain by subdomain. The triangles of the
/// layer come first, then those of the subdomains, then the quadrilaterals of the layer. Pieces are numbered in the
/// same order. Throws MeshError from 2^32 vertices on.
LAMINA_EXPORT Mesh assemble(const Geometry& geometry, const layers::Layer& layer, const layers::LayerCells& cells,
                            decoupling::Decoupling decoupling, std::vector<Refinement> refinements,
                            const AssembleOptions& options = {});

}  // namespace lamina::pipeline
