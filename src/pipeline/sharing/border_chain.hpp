// The border of a subdomain as a chain of edges: all processes know it from the decoupling, whoever holds the piece.
#pragma once

#include <cstdint>
#include <vector>

#include "decoupling/line_border.hpp"
#include "decoupling/subdomain.hpp"
#include "mesh/piece_check.hpp"

namespace lamina::pipeline {

/// The edges of a border, and the lines that they are on.
struct BorderChain {
    std::vector<Segment> edges;
    std::vector<std::uint32_t> lines;  ///< per edge
};

/// Returns the edges of the border, with the ids that their ends have in the mesh, in the order of Subdomain::segments.
/// Lines that dangle in the subdomain, whose edges run both ways, cancel out.
BorderChain border_chain(const decoupling::LineBorder& border, const decoupling::Lines& lines);

/// Returns what lies behind the edges of the subdomain's border_chain(), from the border edges that the check of the
/// piece has found. Adds a defect where these are other edges: the triangles of the piece do not add up to its border
/// then.
std::vector<Point> apexes_of(const decoupling::Subdomain& subdomain, mesh::PieceFindings& findings);

}  // namespace lamina::pipeline
