// The numbers that shape the layer, in one place. Each moves something on the cases of `./dev ablate` or is a promise
// of layer.hpp (docs/decisions/0075). Angles are in degrees where names say so, lengths and widths are shares of
// others. Tolerances of rounding and numbers of steps stand where they are used.
#pragma once

#include <numbers>

namespace lamina::layers {

// Everywhere.

/// Lengths are alike up to this ratio: an edge and its target before it is divided, distances from the corner of a
/// cleft, and first heights from vertex to vertex where they are given point by point.
inline constexpr double alike = 1.1;

// Room.

/// A ray may go up to this share of the way to a wall, so that opposing fronts leave a quarter of the gap free.
inline constexpr double wall_fraction = 0.375;

/// A ray may go up to this share of the height at which it crosses another ray, so that neighbours keep more than half
/// of their distance.
inline constexpr double ray_fraction = 0.45;

/// First layers may go beyond the limit by this factor, up to 0.75 of that height, so that walls in clefts are not
/// bare. Neighbours keep a quarter of their distance. Below an opposite wall they may not.
inline constexpr double first_layer_room = 2 * wall_fraction / ray_fraction;

/// Distance of the rays of a sample that looks for what is in the way, as a share of the largest height of the scale.
inline constexpr double sample_spacing = 0.1;

// Directions.

/// Neighbouring rays of jagged walls diverge by up to this angle (LayerOptions::max_ray_angle_deg), in degrees.
inline constexpr double max_jagged_ray_angle_deg = 20;

/// Columns are widened to this many times the angle that they may open by, in heights of the front. On 112 UIUC
/// sections at y+ 1, 0.36, 0.48, 0.6, 0.72 and 0.84 give largest angles of 132, 131, 126, 120 and 123 degrees in the
/// mean, and area ratios of 1 % of 0.64, 0.74, 0.78, 0.79 and 0.79.
inline constexpr double wanted_width_in_openings = 0.72;

/// The widths of columns are measured at this many heights of the front where layers end at isotropy: fronts are as low
/// there as columns are narrow, and columns are to share the angles of corners. Of 300 outlines with first heights of
/// 1e-5, 2, 3, 4 and 8 leave 9.5, 13.7, 16.9 and 20.6 uneven columns and area ratios of 99 % of 1.43, 1.44, 1.45 and
/// 1.44 in the mean; 1 takes 7 % more triangles than 2.
inline constexpr double fronts_of_isotropy = 2;

/// Rays should meet no nearer to the wall than at this many heights of the front. A ray ends at ray_fraction of the way
/// to a ray that it meets, and rays that lean meet nearer to the wall than their openings alone say.
inline constexpr double clearance = 3.5;

/// The stiffness of the chain of leans, over the square of the angle between the rays of fans.
inline constexpr double lean_stiffness = 0.2;

/// Largest lean of the first and the last ray of a fan, in degrees, and the share of the fan's angle that each gives at
/// most to the columns beside it.
inline constexpr double most_fan_lean_deg = 25, most_given_share = 0.3;

/// Largest lean of a ray from the bisector, in degrees: that of a ray beside the corner of a step, parallel to the
/// corner's. And the largest angle from the normals of both edges: cells in all rows at the wall are as skewed as that.
inline constexpr double most_lean_deg = 45, most_lean_from_normals_deg = 57;

/// Edges of curved walls bend by no more than this share of the layers' height; determinants of curved cells then
/// change by about as much. Four NACA sections with 8 to 20 kept points, order 3, 12 layers from 1e-4 on: none of 33.8
/// edges is reduced, and the least scaled Jacobian is 0.41 in the mean. With 0.1 none of 46.5, and 0.45; with 0.5 0.6
/// of 29.5, and 0.17; without a bound 1.8 of 28.2, and 0.17.
inline constexpr double max_bend_of_walls = 0.25;

/// Cells have no larger angles than this, in degrees, where anything can be done about it: columns end below them, and
/// clefts that would need them stay open.
inline constexpr double largest_layer_angle_deg = 150;

/// Sharp concave corners without a ray: walls meet at this angle or less, in degrees. Half of it is what is left to 180
/// degrees in the cells beside a ray.
inline constexpr double largest_sharp_deg = 2 * (180 - largest_layer_angle_deg);

/// First heights that differ by less from the one wanted stay as they are.
inline constexpr double kept_difference = 0.009;

/// Walls without room get first heights down to this share of what is wanted. Below it a wall is bare: cells would be
/// thinner than anything else on it.
inline constexpr double least_opening = 1e-3;

/// The turning of a wall, in degrees, up to which the ray of a vertex is not shifted. It leans no farther then than its
/// first height allows (kept_difference). With 0, triangles beyond the layers of a slit of 3 degrees miss their bound.
inline constexpr double max_smooth_turning_deg = 1;

/// Largest shift of the first layer, as a share of the shorter edge at the corner, far from what would make cells cross
/// each other; and that of rays which bend on above it. With 0.5 for both ten iced sections have an area ratio of 99 %
/// of 1.68 in the mean in place of 1.66, and 0.6 % more triangles; with 0.1 for both more first heights are off.
inline constexpr double most_shift = 0.5, most_bend = 0.1;

/// Largest shift far from the wall over that of the first layer. Faces of CRM-HL's quadrilaterals and of four other
/// sections are off orthogonal by 64 degrees in the mean with 1, 61 with 4, 58 with 8, 58 with 16; the layers of ten
/// iced sections then take 1 to 3 % more triangles.
inline constexpr double most_shift_over_first = 8;

// Front and heights.

/// Largest rise of the front per unit of distance along it. Two such slopes in a corner of 90 degrees leave 65 degrees
/// to the outer region.
inline constexpr double max_front_slope = 0.22;

/// Layers on a ray that leaves the wall's edges at an angle are at most this many times as high along the ray as above
/// the edges.
inline constexpr double max_slant = 2;

/// The growth of layers that are stretched differs from the requested growth by at most this factor.
inline constexpr double max_stretch = 1.06;

/// The distance of rays that spread counts up to this many times that at the wall: with slow growth, layers between
/// spreading rays never become as high as wide.
inline constexpr double max_spread = 2;

/// Cells of columns that go on beyond isotropy are at most this many times as high as wide, unless the column is so
/// narrow that it would get many more layers than the second number.
inline constexpr double max_tallness = 1.5, max_layers_beyond_isotropy = 20;

/// The slope with which the front falls from a fan on both sides.
inline constexpr double slope_beside_fans = 0.5 * max_front_slope;

/// Largest ratio of the last spacings of neighbouring rays. The ratio of their heights is smaller still.
inline constexpr double max_neighbour_ratio = 1.25;

/// Bounds of the adaptive law's ratio.
inline constexpr double min_adaptive_ratio = 1.05, max_adaptive_ratio = 1.5;

/// A number of layers costs this much times the square of its distance from the one that is wanted.
inline constexpr double cost_of_distance = 0.05;

/// Last layers become this many times as high as if their cells had the area of squares on the front's edges: half of
/// such a cell has the area of the triangle beyond, and the front's rise over a column is less than a third of it.
/// Those of quadrilaterals stay as low as the second number says, since high ones skew the faces between columns.
inline constexpr double wanted_tallness = 0.91, least_tallness_of_quads = 0.54;

/// Rays lean along the front's edges by so much at most, as the sine between them; farther ones count as if they did.
inline constexpr double least_sine = 0.5;

/// Last layers become no higher than this share of the part that changes: the layers below would be far lower. Columns
/// of which they are higher, with fewer than three layers in this part, stay as they are.
inline constexpr double max_last_share = 0.5;

/// Last layers become so many times as high at the most.
inline constexpr double max_end_ratio = 2.0;

// Border.

/// Gaps narrower than this share of an edge do not divide it further.
inline constexpr double min_gap_share = 1.0 / 128;

/// Targets are constant on intervals of an edge that are this share of the target long.
inline constexpr double interval_share = 0.5;

/// The top of a cell of the grid stays whole up to this many times its target: up to where its halves would be as much
/// too short as it is too long. A point on the top of a flat cell makes an angle near 180 degrees, and halves of the
/// tops of high ones are farther in area from the triangles beyond. Walls that are kept have no other way to become
/// finer than their borders.
inline constexpr double whole_top = std::numbers::sqrt2;

/// Walls below borders that would be divided are asked for spacings this much finer than need be, for walls whose whole
/// numbers of edges differ from those asked for.
inline constexpr double spacing_margin = 0.97;

/// A cleft ends where the gap between the fronts is this many times as wide as their edges are long.
inline constexpr double open_gap = 2.0;

// Wakes.

/// Ratio of the lengths of successive edges of a wake, and the longest edge as a share of the line.
inline constexpr double wake_edge_ratio = 1.07, max_wake_edge_share = 0.015;

/// From one vertex of a wake to the next the first height grows by this share. Rows of cells rise with it: by six times
/// as much where layers end at isotropy, as a share of the edge's length.
inline constexpr double wake_opening = 0.08;

/// The first height opens until this many layers of equal height would fill the height that is needed.
inline constexpr double layers_when_open = 12;

/// The sides of a wake meet this many times the width of the base behind it.
inline constexpr double core_length = 4;

/// A base so wide that they would meet beyond this share of the wake gets none.
inline constexpr double max_core_share = 0.5;

/// The outermost cells between stations are this many first heights wide, like the first cells on the other side of the
/// wake; each one further in is wider by the ratio. Wide cells beside the first ones made a flow solver diverge.
inline constexpr double outermost_core_cell = 2, core_cell_ratio = 1.4;

// Measures.

/// The boundary layers of two opposing walls, and triangles between them, fit into a gap that is this many times as
/// wide as one of the two is high.
inline constexpr double open_space = 3;

/// A circle holds a wall that comes nearer to its middle than this share of its radius. The slack is for the edges at
/// the ray's own origin, which dip into the circle where the wall is concave.
inline constexpr double inner_share = 0.95;

/// Neighbouring columns end evenly where their ends differ in height by at most this share of a last cell.
inline constexpr double even_border_step = 1.0 / 3;

}  // namespace lamina::layers
