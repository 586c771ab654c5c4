// Wakes as parts of the outlines that rays are grown round.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layers/layer.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// A vertex of an outline that rays are grown round.
struct RayVertex {
    Point at;
    RayPlace place = RayPlace::wall;
    double opening = 1;                 ///< RayLine::opening
    double least_height = 0;            ///< RayLine::least_height
    std::vector<Point> corner_after{};  ///< RayLine::corner_after
    std::span<const LineFoot> feet{};   ///< of the lines that end there
};

/// A pair of vertices of a wake, one on either side: the same point but behind a blunt base, where the sides have yet
/// to meet.
struct WakeVertex {
    WakePoint left, right;  ///< `left` holds the height on the left, `right` that on the right
    double opening;         ///< of both rays
};

/// A divided wake.
struct DividedWake {
    std::size_t line;                    ///< index in LayerGrowth::wakes
    std::size_t element;                 ///< index in Geometry::elements
    std::size_t first_corner;            ///< index of the vertex of the outline at which its right side begins
    std::size_t last_corner;             ///< the same for its left side; it differs where there is a base between
    std::vector<Point> edge;             ///< the trailing edge, or the base from the first corner to the last
    std::vector<WakeVertex> vertices{};  ///< from the trailing edge on
    std::vector<double> distances{};     ///< one per vertex: from the trailing edge, along the line
    WakeCore core{};                     ///< what fills the space between the sides; no chains behind a sharp edge
};

/// Divides the wake lines behind sharp trailing edges and behind bases, up to the distances from these that `ends`
/// says, one per line of LayerGrowth::wakes. The first edge of a wake is as long as the edges of the wall beside it;
/// each one after that is longer by the same ratio, up to a share of the line. Towards the end edges become shorter, so
/// that the layers end in a wedge. Lines that are too short for that get no wake.
std::vector<DividedWake> divide_wakes(const Geometry& geometry, const LayerGrowth& growth,
                                      std::span<const double> ends);

/// Returns the outline of a wall with its wake as a slit: from the trailing edge to the end of the wake, and back. A
/// base before the wake is left out. Without a wake it is the wall alone.
std::vector<RayVertex> outline_with_wake(std::span<const Point> wall, const DividedWake* wake = nullptr);

/// Lowers the ends so that wakes leave the walls the space that their layers need, and cross no other wake: a wake ends
/// before it comes into the way of a ray of `walls`, the rays without wakes, within `needed`, one height per ray.
void keep_wakes_clear(const RaySet& walls, std::span<const double> needed, std::span<const DividedWake> wakes,
                      std::span<double> ends);

/// Lowers the ends of wakes beside which rays without layers stand: `counts` are the numbers of layers on the rays.
/// Returns whether there were any.
bool shorten_bare_wakes(const RaySet& set, std::span<const std::uint32_t> counts, std::span<const DividedWake> wakes,
                        std::span<double> ends);

// The space behind a blunt base.

/// Returns the core between a base and the point `end` behind it. Its layers grow from the base by the law, until they
/// are as high as an edge of the wake is long. The first edge has the length `edge`; each one after that is longer by
/// `ratio`. Precondition: base holds two points or more, from the right to the left of the flow.
WakeCore make_core(std::size_t element, std::span<const Point> base, Point end, double edge, double ratio,
                   const LayerGrowth& growth);

/// Keeps the half of a core on the left of a line of symmetry at this y, on which its chains then begin. Precondition:
/// the line halves it.
void keep_left_half(double y, WakeCore& core);

}  // namespace lamina::layers
