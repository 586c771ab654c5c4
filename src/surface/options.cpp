// The table of the options of the stage "prepare".
#include <lamina/surface.hpp>

#include <lamina/option_builders.hpp>

namespace lamina {

namespace {

OptionTable<SurfaceOptions> make_table() {
    OptionTableBuilder<SurfaceOptions> table("Geometry");
    const auto at = [](auto SurfaceOptions::*member) { return member_at(member); };
    table.choice("surface",
                 "what becomes of the given points: they are kept, replaced by new ones on a spline through them, or "
                 "replaced where they are coarse",
                 Choices<SurfaceTreatment>{{"auto", SurfaceTreatment::automatic},
                                           {"keep", SurfaceTreatment::keep},
                                           {"resample", SurfaceTreatment::resample}},
                 at(&SurfaceOptions::treatment));
    table.count("surface-points", "N", "wall vertices per element, about; else as many as the ray angle requires",
                numbers_from_to(3, 1e7), at(&SurfaceOptions::points));
    // Options that need another one that has no default are checked by validate(): a flag may be given as false.
    table.flag("surface-points-exact", "each element gets exactly so many wall vertices, or there is no mesh", true,
               at(&SurfaceOptions::exact_points));
    table.count(
        "base-edges", "N",
        "wall edges on the base of each blunt trailing edge, with surface-points-exact; else as the spacing asks",
        numbers_from_to(1, 1e6), at(&SurfaceOptions::base_edges));
    table.number("spacing-le", "SHARE",
                 "wall spacing at the leading edge at most, in lengths of the element; makes auto resample. Where the "
                 "curvature asks for less, it gets less",
                 positive_numbers, at(&SurfaceOptions::leading_edge_spacing));
    table.number("spacing-te", "SHARE",
                 "wall spacing at the trailing edge, in lengths of the element; makes auto resample; else as the layer "
                 "asks, about 0.001",
                 positive_numbers, at(&SurfaceOptions::trailing_edge_spacing));
    table.number("spacing-max", "SHARE", "largest wall spacing, in lengths of the element", positive_numbers,
                 at(&SurfaceOptions::max_spacing));
    table.length("smooth", "TOL", "smooth the points first; none moves by more than this", positive_numbers,
                 at(&SurfaceOptions::smooth));

    const auto library = [&](Option<SurfaceOptions>& option) { option.library_only = true; };
    library(table.number("max-turning", "DEG", "largest turning at a vertex between two corners",
                         numbers_above_up_to(0, 90), at(&SurfaceOptions::max_turning_deg)));
    library(table.number("max-ratio", "R", "largest ratio of neighbouring spacings", numbers_above(1),
                         at(&SurfaceOptions::max_ratio)));
    library(table.number("surface-gradation", "G", "growth of the spacing per unit of arc length", positive_numbers,
                         at(&SurfaceOptions::gradation)));
    const std::pair<const char*, double SurfaceOptions::*> shares[] = {
        {"sharp-corner-spacing", &SurfaceOptions::sharp_corner_spacing},
        {"corner-spacing", &SurfaceOptions::corner_spacing},
        {"gap-spacing", &SurfaceOptions::gap_spacing},
        {"min-spacing", &SurfaceOptions::min_spacing},
        {"surface-tolerance", &SurfaceOptions::tolerance},
    };
    for (const auto& [name, member] : shares)
        library(table.number(name, "SHARE", "see SurfaceOptions", positive_numbers, at(member)));
    return table.take();
}

}  // namespace

const OptionTable<SurfaceOptions>& surface_option_table() {
    static const OptionTable<SurfaceOptions> table = make_table();
    return table;
}

void validate(const SurfaceOptions& options) {
    require_in_range(surface_option_table(), options);
    if (options.exact_points && !options.points) throw OptionError("surface_points_exact", "needs surface_points");
    if (options.exact_points && options.treatment == SurfaceTreatment::keep)
        throw OptionError("surface_points_exact", "needs new points: surface must be auto or resample");
    if (options.base_edges && !options.exact_points) throw OptionError("base_edges", "needs surface_points_exact");
}

}  // namespace lamina
