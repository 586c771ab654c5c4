// The stage "size": from the options and the borders of the layers to the sources of the size field, and to the field.
#pragma once

#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/limits.hpp>
#include <lamina/sizing.hpp>

namespace lamina::sizing {

/// Frozen edges (separators, outer borders of layers) are at most this share of h long. No vertex that refinement has
/// to place encroaches upon a frozen edge of up to 1.06 h where h is constant.
inline constexpr double frozen_share = 1.0;

/// Returns the growth of sizes beyond the layers: SizedMesh::gradation of the background mesh, or that of the options.
double field_gradation(const SizingOptions& options);

/// Returns the growth of the edges of a frozen border per unit of distance that suits a field of this gradation. It is
/// less than the gradation, since edges are divided into whole numbers of pieces.
double border_gradation(double gradation);

/// Closed loops of points. The first point of a loop is not repeated at its end.
using Loops = std::span<const std::vector<Point>>;

/// The facts about the bodies that sizes depend on.
struct SizedBodies {
    std::vector<std::vector<Point>> walls;  ///< outlines, counter-clockwise
    std::vector<Point> trailing_edges;      ///< where wakes begin
    double chord = 1;                       ///< reference chord, which lengths of the options count
    double alpha_deg = 0;                   ///< angle of attack: the direction of wakes that have none of their own
};

/// Throws LimitError where an option by itself requests far more triangles in `domain` than limits or 32 bits allow.
void require_within_limits(const SizingOptions& options, const SizedBodies& bodies, const Box& domain,
                           const WorkLimits& limits);

/// Sources of the size field, besides the outer borders of the layers.
struct SizeRequests {
    std::vector<SizeSource> sources;     ///< all of them: the user's, wakes and points of the background mesh
    std::vector<SizeSource> at_borders;  ///< the sources that may shorten edges of the outer borders
};

/// Gathers the sources of the options: the user's own, wakes, and the points of the background mesh. `fronts` are the
/// polygons through the ends of the layers' rays: a wake without a size begins with the size that they and the other
/// sources request at the trailing edge. Throws OptionError where the background mesh is not well formed or requests
/// more triangles than 32-bit numbers can tell apart.
SizeRequests gather_size_requests(const SizingOptions& options, const SizedBodies& bodies, Loops fronts,
                                  const Box& domain);

/// Makes h(x) from the outer borders of the layers and from further sources. An edge of a border requests its length
/// divided by frozen_share, or more beside an edge that would otherwise be too long for the field; never more than
/// wall_size. `chord` is the reference chord.
LAMINA_EXPORT SizeField make_size_field(Loops borders, std::span<const SizeSource> sources,
                                        const SizingOptions& options, double chord, const Box& domain);

}  // namespace lamina::sizing
