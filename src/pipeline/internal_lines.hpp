// Lines inside the domain that become edges of the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

#include "decoupling/far_field.hpp"
#include "decoupling/subdomain.hpp"
#include "layers/stages.hpp"
#include "pipeline/outer_walls.hpp"

namespace lamina::pipeline {

/// Returns the line that a text of the option means, and its text.
InternalLine parse_line(const std::string& text);
std::string line_text(const InternalLine& line);

/// Throws OptionError for lines without a legal name of their own, without length, that run back on themselves, and for
/// two-sided ones that are closed.
void validate_lines(std::span<const InternalLine> lines);

/// Whether the first and the last point of a line are on walls of bodies.
using EndsOnWalls = std::array<bool, 2>;

/// The lines outside the bodies, cut where they cross each other.
struct LineGraph {
    std::vector<InternalLine> given;  ///< the lines as they were asked for
    std::vector<Point> points;        ///< vertices, where lines bend, cross, end, or meet walls
    std::vector<char> on_wall;        ///< per vertex: whether it is one of a wall of a body
    std::vector<char> on_border;      ///< per vertex: whether it is on a wall of the domain or its line of symmetry
    std::vector<Segment> pieces;      ///< straight, between vertices, in the order of the lines
    std::vector<std::uint32_t> line;  ///< per piece: its line, one of those given
    std::vector<EndsOnWalls> ends{};  ///< of the lines that were given
};

/// Cuts lines where they cross each other, the bodies, walls of the domain and its line of symmetry, and leaves out
/// what lies behind these. A crossing with a wall of a body becomes a vertex of the wall; one that is nearer to a
/// vertex than three tenths of the edge becomes that vertex. So does an end of a line that is nearer to a wall than
/// half its edge, or that was so on coarser walls, as `known` says if it is not empty. Bodies that a line of symmetry
/// cuts stay mirrored. Throws OptionError for a line outside the far field.
LineGraph arrange_lines(std::span<const InternalLine> lines, const decoupling::FarField& far_field, Geometry& geometry,
                        std::span<const EndsOnWalls> known = {});

/// Returns sizes at the vertices of lines: their distances from other lines that they are no part of, and from copies
/// that are so far along y.
std::vector<SizeSource> sizes_between(const LineGraph& graph, std::span<const double> shifts);

/// Returns the sizes that lines ask for along themselves.
std::vector<SizeSource> sizes_along(std::span<const InternalLine> lines);

/// Numbers at the ends of each piece of a line.
using AtEnds = std::vector<std::array<double, 2>>;

/// Returns how high the layer may be along each piece of a line from its ends: nearly half of the piece, or 0 where an
/// end is on no wall.
AtEnds room_at_feet(const LineGraph& graph);

/// Returns how high the front of these rays is along each piece from its ends; 0 where no ray runs along it, or where
/// none runs along another line that ends at the same vertex.
AtEnds heights_at_feet(const LineGraph& graph, const layers::Rays& rays);

/// Returns the lines as obstacles, which stop short of vertices and walls by a tenth of this height, or by a
/// quarter of their length, and a little above these heights of the layer at their feet; with their images where there
/// is a line of symmetry that cuts bodies, and with copies that are so far along y.
layers::Obstacles obstacles_of(const LineGraph& graph, double first_height, const AtEnds& at_feet,
                               std::optional<double> symmetry, std::span<const double> shifts);

/// Returns the two ends of each piece.
std::vector<std::vector<Point>> ends_of_pieces(const LineGraph& graph);

/// Returns x of the vertices of lines at this y on the border of the domain, ascending.
std::vector<double> feet_on_border(const LineGraph& graph, double y);

/// The vertices of the layer along each piece of a line from its ends on walls, from the wall to the front.
using FeetInLayer = std::vector<std::array<std::vector<VertexId>, 2>>;

/// Returns them.
FeetInLayer feet_in_layer(const LineGraph& graph, const layers::Layer& layer);

/// Returns the lines as part of the outer region, which begin at the ends of their feet in the layer. Throws MeshError
/// where the layer crosses a line.
decoupling::InnerLines inner_lines(const LineGraph& graph, const FeetInLayer& feet, const RegionBorders& region);

/// Adds a marker for each line, which is internal. `inner_edges` are those of the pieces beyond the layer.
void add_line_markers(const LineGraph& graph, const FeetInLayer& feet,
                      std::span<const std::vector<Segment>> inner_edges, std::vector<Marker>& markers);

/// Doubles the vertices of two-sided lines, but for their free ends: their markers become walls that hold both sides.
/// Vertices that are added come last.
void split_two_sided(std::span<const InternalLine> lines, Mesh& mesh, std::vector<Segment>& constraints);

}  // namespace lamina::pipeline
