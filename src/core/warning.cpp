#include <lamina/warning.hpp>

#include <array>
#include <cstddef>

namespace lamina {

std::string warning_name(WarningCode code) {
    // In the order of the enumerators.
    constexpr std::array names{"first_layer_lost",
                               "rays_cut_in_the_open",
                               "transition_out_of_range",
                               "first_height_implausible",
                               "large_angle",
                               "small_angle",
                               "refused_points",
                               "oversized_triangles",
                               "surface_not_as_asked",
                               "layers_thinned",
                               "topology_not_as_asked",
                               "swapped_columns",
                               "reversed_flow",
                               "crossing_tail_cut",
                               "folded_outline",
                               "ambiguous_section",
                               "half_section",
                               "reynolds_implausible",
                               "no_triangles",
                               "unsuited_to_solver",
                               "flow_estimated",
                               "flow_separates",
                               "unsuited_speed",
                               "unused_seed",
                               "marker_renamed",
                               "area_jump",
                               "noise_smoothed"};
    static_assert(names.size() == static_cast<std::size_t>(WarningCode::noise_smoothed) + 1);
    return names[static_cast<std::size_t>(code)];
}

}  // namespace lamina
