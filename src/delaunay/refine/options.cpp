// The tables of the options of refinement and of constrained triangulation.
#include <lamina/delaunay.hpp>

#include "core/option_rows.hpp"

namespace lamina {

template <>
OptionTable<RefineOptions> option_rows() {
    OptionTableBuilder<RefineOptions> table("Outer region");
    table.number("min-angle", "DEG", "smallest angle of isotropic triangles, in degrees; 0: no bound",
                 numbers_from_to(0, max_min_angle_deg), member_at(&RefineOptions::min_angle_deg));
    table
        .count("max-points", "N", "points beyond which the refinement of one piece gives up", numbers_from_to(0, 4e9),
               member_at(&RefineOptions::max_points))
        .library_only = true;
    table
        .number("max-area-ratio", "R", "largest area of a triangle, over that of the equilateral one with edges of h",
                numbers_from_to(1.05, max_circle_ratio * max_circle_ratio), member_at(&RefineOptions::max_area_ratio))
        .library_only = true;
    table.count(
        "smoothing", "N",
        "how often all vertices of isotropic triangles move to the means of their neighbours; those of ill-shaped "
        "ones then move a few times more; 0: none moves",
        numbers_from_to(0, 100), member_at(&RefineOptions::smoothing));
    table.flag("regularize",
               "merge, split and join otherwise the vertices near those without six neighbours, where that makes "
               "isotropic triangles more regular; takes some fifty times as long as refinement",
               true, member_at(&RefineOptions::regularize));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<RefineOptions>& option_table();

template <>
OptionTable<ConstrainedOptions> option_rows() {
    OptionTableBuilder<ConstrainedOptions> table("Constrained triangulation");
    table.number(
        "drop-flat", "TOL",
        "drop triangles within TOL times the length of an edge of the convex hull from that edge, which rounding "
        "makes of points on straight sides, such as 1e-10; 0: none",
        numbers_from_to(0, max_drop_flat), member_at(&ConstrainedOptions::drop_flat));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<ConstrainedOptions>& option_table();

void validate(const RefineOptions& options) {
    require_in_range(option_table<RefineOptions>(), options);
    if (options.unit_length) require_in_range(positive_numbers, *options.unit_length, "unit_length");
}

}  // namespace lamina
