// The edges of cells and markers as lines to draw.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <lamina/curved_mesh.hpp>

#include "mesh/curved_nodes.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

/// The points that an edge is drawn through.
struct DrawnEdge {
    static constexpr std::size_t most_chords = 8;  // of a curved edge
    std::array<Point, most_chords + 1> points{};
    std::size_t count = 2;

    std::span<const Point> line() const { return std::span(points).first(count); }
};

/// Finds the lines of edges, which are curved where there are nodes.
class DrawnEdges {
public:
    /// Both must outlive this object.
    DrawnEdges(const Mesh& mesh, const CurvedNodes& nodes) : mesh_(mesh), nodes_(nodes) {}

    /// Returns edge i of a cell, from corner i to the next one.
    DrawnEdge of_cell(const VisibleCell& cell, std::size_t i) const {
        const Point a = cell.corner[i], b = cell.corner[(i + 1) % cell.corners];
        if (nodes_.order <= 1) return straight(a, b);
        return curved(a, b, mesh::inner_nodes(mesh_, nodes_, cell.cell).subspan(i * beside_ends(), beside_ends()));
    }
    /// Returns an edge of a marker. `number`: its place among the edges of all markers.
    DrawnEdge of_marker(const Segment& edge, std::size_t number) const {
        const Point a = mesh_.points[edge.a.index()], b = mesh_.points[edge.b.index()];
        if (nodes_.order <= 1) return straight(a, b);
        return curved(a, b, std::span(nodes_.marker_nodes).subspan(number * beside_ends(), beside_ends()));
    }

private:
    std::size_t beside_ends() const { return nodes_.order - 1; }
    static DrawnEdge straight(Point a, Point b) { return {{a, b}, 2}; }
    DrawnEdge curved(Point a, Point b, std::span<const VertexId> between) const {
        std::array<Point, max_cell_order + 1> all{a};
        std::transform(between.begin(), between.end(), all.begin() + 1,
                       [&](VertexId v) { return nodes_.points[v.index() - mesh_.points.size()]; });
        all[nodes_.order] = b;
        DrawnEdge edge{.count = DrawnEdge::most_chords + 1};
        for (std::size_t k = 0; k < edge.count; ++k)
            edge.points[k] = mesh::point_of_edge(std::span(all).first(nodes_.order + 1),
                                                 static_cast<double>(k) / DrawnEdge::most_chords, nodes_.distribution);
        return edge;
    }

    const Mesh& mesh_;
    const CurvedNodes& nodes_;
};

}  // namespace lamina::plot
