// NACA sections as samples of their formula.
#pragma once

#include <string>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Returns the section that naca_airfoil() makes, as about 2000 samples of its formula, of which prepare_surfaces()
/// takes as many as a wall needs (Element::samples_of_curve). One sample of each surface is where both parts of the
/// mean line meet, since no spline follows the outline across that place (Element::given_corners). Throws UsageError
/// for digits that name no section.
Element sample_naca_section(const std::string& digits, TrailingEdge trailing_edge);

}  // namespace lamina::geometry
