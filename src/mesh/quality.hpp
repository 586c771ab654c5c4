// Shape of cells, and its summary over many.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "core/cell_shape.hpp"

namespace lamina::mesh {

using core::CellShape;

/// Measures a counter-clockwise quadrilateral; one whose area rounds to zero or less has core::core::flat_shape.
LAMINA_EXPORT CellShape measure_quad(Point a, Point b, Point c, Point d);

/// Mean ratio: 1 for the equilateral triangle and the square, 0 for flat and inverted cells. + - * / alone.
/// Source: P. M. Knupp, Algebraic mesh quality metrics for unstructured initial meshes (2003); "shape" of the Verdict
/// library and VTK. Of a quadrilateral, the worst corner.
LAMINA_EXPORT double shape_of_triangle(Point a, Point b, Point c);
LAMINA_EXPORT double shape_of_quad(Point a, Point b, Point c, Point d);

/// Collects shapes of a part of the cells; parts are added in a fixed order.
class QualityCollector {
public:
    explicit QualityCollector(double min_angle_bound_deg) : bound_(min_angle_bound_deg) {}

    void add(const CellShape& shape);
    void add_neighbours(double area, double other_area);
    void append(const QualityCollector& part);
    QualitySummary summary() const;

private:
    double percentile_999() const;

    double bound_;
    std::size_t cells_ = 0, below_bound_ = 0;
    double min_angle_ = 180, max_angle_ = 0, min_angle_sum_ = 0, max_angle_sum_ = 0, max_aspect_ = 0;
    std::array<std::size_t, 18> histogram_{};
    /// Ratios of neighbouring areas from 1 on, counted in classes 0.2 % wide, the last one open: a percentile needs no
    /// sorting and no memory in proportion to the mesh. Empty until the first one comes.
    std::vector<std::uint32_t> area_ratios_;
    double max_area_ratio_ = 0;
};

}  // namespace lamina::mesh
