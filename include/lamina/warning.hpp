// Warnings: a valid result that is probably not what the user wants.
//
// Guarantees:
//  1. Warnings are data beside the result (MeshResult::warnings, Element::warnings); the program prints each as a line.
//  2. The names of kinds never change. docs/reference/checks.md says what to do about each.
// Example:
//     const Warning warning{.code = WarningCode::large_angle, .number = 178.5, .unit = "degrees"};
//     assert(warning_name(warning.code) == "large_angle" && !warning.at);
#pragma once

#include <optional>
#include <string>

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The kinds of warnings.
enum class WarningCode {
    first_layer_lost,          ///< wall edges without a cell of the first height
    rays_cut_in_the_open,      ///< rays with fewer layers than requested although no other wall is near
    transition_out_of_range,   ///< the last cells of the layer are far larger or smaller than the triangles beyond
    first_height_implausible,  ///< the first height is out of proportion to the chord
    large_angle,               ///< a nearly flat cell
    small_angle,               ///< angles below the bound that no sharp corner excuses
    refused_points,            ///< refinement left out points that would encroach upon a frozen border
    oversized_triangles,       ///< triangles larger than was asked for
    surface_not_as_asked,      ///< the points of a wall, or its curved edges, are not those that the options ask for
    layers_thinned,            ///< layers made thinner so that angles beyond and within keep their bounds
    topology_not_as_asked,     ///< the cells of the layer are not those that the options ask for
    swapped_columns,           ///< a section stands upright: the columns of x and y are probably swapped
    reversed_flow,             ///< a section has its nose at its rear end: the flow probably comes from the right
    crossing_tail_cut,         ///< surfaces that cross near the trailing edge were cut off at the crossing
    folded_outline,            ///< an outline runs back on itself; a point out of place was left out or exchanged
    ambiguous_section,         ///< the digits of a section are also those of another family, which no formula makes
    half_section,              ///< an outline looks like half of a symmetric section
    reynolds_implausible,      ///< velocity and viscosity do not seem to be in the units of the input
    no_triangles,              ///< a triangulation is empty: its points lie on one line, or its holes take all away
    unsuited_to_solver,        ///< the solver that the mesh is written for cannot use its cells
    flow_estimated,            ///< the panel method failed, and the flow is that along flat plates
    flow_separates,            ///< a stalled section or a bluff body: lift is an upper bound
    unsuited_speed,            ///< the settings of the solver's case are not made for this Mach number
    unused_seed,               ///< a hole or a region of a triangulation lies where it changes nothing
    marker_renamed,            ///< a marker has another name than it was given, which not every format takes
    area_jump,                 ///< the areas of neighbouring cells of the layer differ far too much
    noise_smoothed,            ///< the points of an outline scatter like those of a scan, and were smoothed
};

LAMINA_EXPORT std::string warning_name(WarningCode code);  ///< the name of a kind: "first_layer_lost"

/// One warning.
struct Warning {
    WarningCode code;           ///< the kind
    std::string element{};      ///< name of the body; empty where the whole mesh is meant
    std::optional<Point> at{};  ///< the worst place, where there is one
    double number = 0;          ///< how many or how much, as the kind says
    std::string unit{};         ///< of the number: "wall edges", "degrees", "chords"
    std::string message{};      ///< one sentence for a person, with number and place
};

}  // namespace lamina
