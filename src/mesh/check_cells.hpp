// Checks of the cells of a mesh and of the edges between them: orientation, shape, areas of neighbours, Delaunay
// property.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/defects.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/edge_survey.hpp"
#include "mesh/quality.hpp"
#include "mesh/vertex_marks.hpp"

namespace lamina::mesh {

/// The ratios at an edge between the regions.
struct TransitionRatios {
    double area;    ///< that of the layer's cell over that of the isotropic cell
    double height;  ///< of the isotropic cell over the edge, over that of the layer's cell
};

struct CellsSummary {
    double area = 0;
    QualityCollector layer, isotropic;
    std::vector<std::uint32_t> narrow;         ///< isotropic cells with an angle below the bound
    DelaunayCount delaunay;                    ///< over all edges between isotropic triangles, constraints included
    std::vector<TransitionRatios> transition;  ///< for each edge between the regions
    std::vector<Segment> outline;              ///< these edges, directed as the isotropic cell has them
    DefectList defects;

    explicit CellsSummary(double min_angle_bound_deg = 0)
        : layer(min_angle_bound_deg), isotropic(min_angle_bound_deg) {}
    void append(CellsSummary&& part);
};

/// The findings of check_cells().
struct CheckedCells {
    CellsSummary summary;
    EdgeTotals edges;
    VertexMarks frozen;  ///< the ends of edges between isotropic cells and the layer, or isotropic cells of two pieces
};

/// Checks all cells against this bound on the smallest angle, and the edges between them. `max_bytes` is that of
/// EdgeSurvey. The result does not depend on the number of threads. Precondition: all indices are in range.
CheckedCells check_cells(const MeshView& mesh, double min_angle_deg, std::optional<std::size_t> max_bytes = {});

/// Returns the area of a cell, rounded.
double area_of(const MeshView& mesh, const CellEdges& edges, std::size_t cell);

/// Returns the height of a cell over one of its edges: the mean distance of its other corners from the edge's line.
double height_over(const MeshView& mesh, const CellEdges& edges, std::size_t edge);

/// Summarizes the ratios at the edges between the regions.
TransitionSummary summarize_transition(std::span<const TransitionRatios> ratios);

}  // namespace lamina::mesh
