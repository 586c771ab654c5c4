#include "pipeline/reynolds_doubt.hpp"

#include <fmt/format.h>

#include "geometry/length_units.hpp"

namespace lamina::pipeline {

namespace {

// Kinematic viscosities in m2/s: no fluid at all is below the first (mercury has 1e-7, liquid helium 2e-8), water and
// other thin liquids are below the second, air between it and the third (1.5e-5 at the ground, 1e-3 at 35 km).
constexpr double least_viscosity = 1e-8, thin_liquid = 5e-6, thin_air = 1e-3;

// Lengths in metres: of the largest wings and vehicles in air, and of the largest ships (458).
constexpr double longest_in_air = 50, longest_in_water = 500;

/// Returns what to give where coordinates are in a unit, and velocity and viscosity in m/s and m2/s.
std::string remedy(const FlowConditions& conditions, const std::string& name, double metres) {
    return fmt::format("give --velocity {:.6g} --viscosity {:.6g}, in {}/s and {}2/s, or --transform all:scale:{:.4g}",
                       *conditions.velocity / metres, *conditions.viscosity / (metres * metres), name, name, metres);
}

/// Returns what is wrong with a Reynolds number that follows from velocity and viscosity.
std::optional<std::string> doubt_of_units(const FlowConditions& conditions, double chord, const std::string& unit) {
    const double viscosity = *conditions.viscosity;
    if (const auto length = geometry::length_unit(unit)) {
        const double in_metres = viscosity * length->metres * length->metres;
        if (in_metres >= least_viscosity || viscosity < least_viscosity) return std::nullopt;
        return fmt::format("the file is in {}, in which no fluid has this viscosity: {}", unit,
                           remedy(conditions, unit, length->metres));
    }
    if (viscosity < least_viscosity || viscosity > thin_air) return std::nullopt;
    const bool is_liquid = viscosity < thin_liquid;
    if (chord <= (is_liquid ? longest_in_water : longest_in_air)) return std::nullopt;
    return fmt::format("a viscosity in m2/s makes the chord {:.6g} m; if the file is in mm, {}", chord,
                       remedy(conditions, "mm", 1e-3));
}

}  // namespace

std::optional<std::string> doubt_of_reynolds(const FlowConditions& conditions, const ReferenceConditions& reference,
                                             const std::string& unit) {
    constexpr double least = 1, largest = 1e10;
    if (!reference.reynolds) return std::nullopt;
    const double reynolds = *reference.reynolds;
    std::string origin = fmt::format("the Reynolds number {:.3g}", reynolds);
    if (conditions.velocity && conditions.viscosity) {
        origin += fmt::format(" = {:.4g} x {:.6g} / {:.4g} (velocity x chord / viscosity)", *conditions.velocity,
                              reference.chord, *conditions.viscosity);
        if (const auto doubt = doubt_of_units(conditions, reference.chord, unit)) return origin + ": " + *doubt;
    }
    if (reynolds >= least && reynolds <= largest) return std::nullopt;
    return origin +
           (reynolds < least ? " is that of creeping flow, without a boundary layer"
                             : " is above that of the largest ships, 5e+09") +
           ": --velocity and --viscosity count units of the input";
}

}  // namespace lamina::pipeline
