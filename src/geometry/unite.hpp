// Bodies that overlap or touch become one body.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Returns the bodies with those that overlap or touch joined, and the others as they are. The outline of joined bodies
/// is the outer border of their union: pockets of flow between them are filled. Crossings of edges are found exactly
/// and rounded to coordinates once; they are corners. The wall keeps the names of the bodies that it comes from
/// (Element::parts). Throws InputError for points outside the exact range, and for bodies that touch at a single point.
/// check_simple() tells whether rounding has left the outlines simple.
Geometry unite(Geometry geometry);

/// Returns, for each point of an outline, the index of the entry of Element::parts that the edge behind it belongs to;
/// 0 for an element without parts.
std::vector<std::size_t> parts_of_edges(const Element& element);

}  // namespace lamina::geometry
