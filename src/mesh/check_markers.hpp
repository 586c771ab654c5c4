// Checks of the markers of a mesh.
#pragma once

#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/defects.hpp"

namespace lamina::mesh {

/// Reports boundary edges that are in no marker or in several, marker edges that are not on the boundary or directed
/// the wrong way, markers of the same name, and periodic markers that are no exact copies of each other. `boundary` are
/// the edges of the boundary, directed with the mesh on their left, sorted; `points` holds their vertices and those of
/// the markers. Edges of internal markers must not be on the boundary; nor may a marker hold one twice.
void check_markers(std::span<const Point> points, std::span<const Marker> markers, const std::vector<Segment>& boundary,
                   DefectList& defects);

/// Returns edges with their smaller vertices first, sorted.
std::vector<Segment> sorted_undirected(std::span<const Segment> edges);

/// Returns the edges of all internal markers, with their smaller vertices first, sorted, each once.
std::vector<Segment> internal_edges(std::span<const Marker> markers);

/// An edge of the boundary and another one of the same marker at the same place, in the opposite direction, between
/// other vertices.
struct SlitEdge {
    Segment edge, twin;
    friend bool operator<(const SlitEdge& a, const SlitEdge& b) { return a.edge < b.edge; }
};

/// Returns the edges along walls without thickness, sorted: those of markers that hold nothing but such pairs.
std::vector<SlitEdge> slit_edges(std::span<const Point> points, std::span<const Marker> markers);

}  // namespace lamina::mesh
