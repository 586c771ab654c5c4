// The nodes within triangles of order 4 as Nektar++ has them, beside those of NodeDistribution::gauss_lobatto. Other
// nodes are the same in both.
#pragma once

#include <span>

#include <lamina/point.hpp>

namespace lamina::io {

/// The smaller ones of the barycentric coordinates of the three nodes within a triangle of order 4. Nektar++ knows all
/// places of nodes in triangles with ten digits. Source: Nektar++ 5, library/LibUtilities/Foundations,
/// NodalTriElecData.h and NodalTriFeketeData.h.
inline constexpr double place_in_nodal_tri_elec = 0.2371200168, place_in_nodal_tri_fekete = 0.2165423647;

/// Moves the three nodes within a triangle of order 4, all of whose nodes are given in the order of CurvedNodes, from
/// the places of NodeDistribution::gauss_lobatto to those of Nektar++, on the same polynomial.
void move_to_nektar_places(std::span<Point> nodes, double place);

/// Moves them back.
void move_from_nektar_places(std::span<Point> nodes, double place);

}  // namespace lamina::io
