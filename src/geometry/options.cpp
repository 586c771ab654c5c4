// The table of the options of the stage "read".
#include <lamina/geometry.hpp>

#include <lamina/option_builders.hpp>

namespace lamina {

namespace {

OptionTable<GeometryOptions> make_table() {
    OptionTableBuilder<GeometryOptions> table("Geometry");
    table.list("names", OptionKind::words, "A,B,...",
               "marker names, one per element; else the stems of the files, or 'airfoil' for a single element",
               member_at(&GeometryOptions::names));
    table
        .count("naca-points", "N",
               "surface points of naca: inputs that do not give their number; 0: as many as a wall needs",
               numbers_from_to(0, 1e7), member_at(&GeometryOptions::naca_points))
        .library_only = true;
    return table.take();
}

}  // namespace

const OptionTable<GeometryOptions>& geometry_option_table() {
    static const OptionTable<GeometryOptions> table = make_table();
    return table;
}

void validate(const GeometryOptions& options) { require_in_range(geometry_option_table(), options); }

}  // namespace lamina
