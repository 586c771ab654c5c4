// The walls on the border of the domain, as the ground is, and the border that they are a part of.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

#include "decoupling/far_field.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"

namespace lamina::pipeline {

struct LineGraph;

/// A wall on the border of the domain, as the options ask for it.
struct OuterWallFacts {
    std::string name;         ///< of its marker: `ground`, `floor`, `ceiling`, `symmetry` or `axis`
    double y = 0;             ///< where it lies
    OuterWallKind kind{};     ///< how the flow meets it
    double first_height = 0;  ///< of its layers, in units of the input; 0: it has none
    double thickest = 0;  ///< of its layers up to isotropy: twice the boundary layer of a plate as long as the domain
    const char* option = "";  ///< that asks for it
};

/// Returns the walls of this far field, the lower one first. A line of symmetry is one of them unless it cuts bodies.
/// Walls at which the flow sticks, fixed or moving, have layers unless these are disabled; slip walls have none. The
/// first height is the wall's own or that of `growth`. Throws OptionError for a y+ without a Reynolds number, and where
/// a height contradicts the thickness.
std::vector<OuterWallFacts> outer_wall_facts(const decoupling::FarField& far_field, const FarFieldOptions& options,
                                             const Geometry& geometry, const LayerOptions& layer,
                                             const ReferenceConditions& conditions, const layers::LayerGrowth& growth);

/// Returns these walls with vertices at distances that follow the size field, and where lines end on them.
std::vector<layers::OuterWall> divide_outer_walls(std::span<const OuterWallFacts> walls,
                                                  const decoupling::FarField& far_field, const SizeField& size,
                                                  const LineGraph& lines);

/// The borders of the outer region: of the bodies with their layers and, last, of the domain, if that has walls.
struct RegionBorders {
    std::vector<Point> points;                   ///< those of the layer, then those on the sides of the domain
    std::vector<std::vector<VertexId>> borders;  ///< as decoupling::decouple() takes them
    std::vector<Segment> far_field;  ///< edges of the sides, beside the layer and beyond, the mesh on the left
    std::vector<Segment> symmetry;   ///< likewise those of a line of symmetry that cuts bodies
    std::vector<Marker> row;         ///< inlet, outlet and both borders of a domain in a row of blades
};

/// Returns the name of the marker on a line of symmetry.
const char* symmetry_name(const FarFieldOptions& options);

/// Closes the border of the domain: sides without walls are divided by the size field, from the ends of one wall to
/// those of the other or to the corners of the far field. So is a line of symmetry between the bodies that it cuts and
/// the ends of lines.
RegionBorders close_domain(const layers::Layer& layer, const decoupling::FarField& far_field, const SizeField& size,
                           const LineGraph& lines);

}  // namespace lamina::pipeline
