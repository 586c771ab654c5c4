// The table of the options of check_mesh().
#include <lamina/mesh.hpp>

#include "core/option_rows.hpp"

namespace lamina {

template <>
OptionTable<MeshCheckOptions> option_rows() {
    OptionTableBuilder<MeshCheckOptions> table("Check");
    table.number("min-angle", "DEG",
                 "require this smallest angle of isotropic triangles, in degrees, but in sharp corners",
                 numbers_from_to(0, 60), member_at(&MeshCheckOptions::min_angle_deg));
    table.number("first-height", "H",
                 "compare the heights of first cells with this one, in units of the mesh, instead of with their median "
                 "on each wall",
                 positive_numbers, member_at(&MeshCheckOptions::first_height));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<MeshCheckOptions>& option_table();

void validate(const MeshCheckOptions& options) {
    require_in_range(option_table<MeshCheckOptions>(), options);
    for (const double height : options.first_heights) require_in_range(positive_numbers, height, "first_heights");
    for (const double height : options.first_height_at) require_in_range(positive_numbers, height, "first_height_at");
}

}  // namespace lamina
