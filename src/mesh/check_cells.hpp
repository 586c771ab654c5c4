// Checks of the cells of a mesh and of the edges between them: orientation, shape, areas of neighbours, Delaunay
// property.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/defects.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/quality.hpp"

namespace lamina::mesh {

struct CellsSummary {
    double area = 0;
    QualityCollector layer, isotropic;
    std::vector<std::uint32_t> narrow;  ///< isotropic cells with an angle below the bound
    DelaunayCount delaunay;             ///< over all edges between isotropic triangles, constraints included
    /// For each edge between the regions, the area of the layer's cell divided by the area of the isotropic cell.
    std::vector<double> transition;
    DefectList defects;

    explicit CellsSummary(double min_angle_bound_deg = 0)
        : layer(min_angle_bound_deg), isotropic(min_angle_bound_deg) {}
    void append(CellsSummary&& part);
};

/// Checks all cells against this bound on the smallest angle. The result does not depend on the number of threads.
CellsSummary check_cells(const Mesh& mesh, const Adjacency& adjacency, double min_angle_deg);

/// Returns the area of a cell, rounded.
double area_of(const Mesh& mesh, const CellEdges& edges, std::size_t cell);

/// Summarizes the area ratios at the edges between the regions.
TransitionSummary summarize_transition(std::vector<double> area_ratios);

}  // namespace lamina::mesh
