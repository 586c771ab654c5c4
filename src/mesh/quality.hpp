// The shape of quadrilaterals, shape measures for VTK, and statistics of the shapes of many cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "core/cell_shape.hpp"
#include "mesh/triangle_shapes.hpp"

namespace lamina::mesh {

using core::CellShape;

/// Measures a counter-clockwise quadrilateral; one whose area rounds to zero or less has core::flat_shape.
LAMINA_EXPORT CellShape measure_quad(Point a, Point b, Point c, Point d);

/// Return the mean ratio: 1 for the equilateral triangle and the square, 0 for flat and inverted cells. The mean ratio
/// of a quadrilateral is that of its worst corner. They use + - * / alone, so the result is the same on every machine.
/// Source: P. M. Knupp, Algebraic mesh quality metrics for unstructured initial meshes (2003); it is the "shape" of the
/// Verdict library and of VTK.
LAMINA_EXPORT double shape_of_triangle(Point a, Point b, Point c);
LAMINA_EXPORT double shape_of_quad(Point a, Point b, Point c, Point d);

/// Counts, sums and extremes of the shapes of cells.
struct QualityTotals {
    std::size_t cells = 0, below_bound = 0;
    double min_angle = 180, max_angle = 0, min_angle_sum = 0, max_angle_sum = 0, mean_ratio_sum = 0, max_aspect = 0;
    double max_area_ratio = 0;
    Point max_area_ratio_at{};                      ///< where it is known
    std::array<std::size_t, 18> angle_histogram{};  ///< smallest angles in bins of 5 degrees
};

/// Collects statistics of the shapes of cells. Several collectors that each hold a part of the cells are appended in a
/// fixed order, so that sums do not depend on the number of threads.
class QualityCollector {
public:
    explicit QualityCollector(double min_angle_bound_deg) : bound_(min_angle_bound_deg) {}

    void add(const CellShape& shape);
    /// Adds all of these triangles, whose totals are those of add_up().
    void add(const TriangleShapes& shapes, const ShapeTotals& totals);
    /// Adds ratios of the areas of cells with a common edge, the larger area over the smaller one.
    void add_area_ratios(std::span<const double> ratios);
    /// Adds the areas of two cells with a common edge.
    void add_neighbours(double area, double other_area);
    /// Adds two cells with a common edge to the largest ratio of areas alone, and keeps the middle of the edge.
    void add_to_largest_ratio(double area, double other_area, Point a, Point b);
    /// Adds pairs of neighbours whose ratios of areas are below area_ratio_exceeded_by() of some share.
    void add_even_neighbours(std::size_t pairs);
    void append(const QualityCollector& part);
    QualitySummary summary() const;

    /// These give and take the same in two parts, for collectors of other processes: the histogram of ratios is larger
    /// than all the rest.
    const QualityTotals& totals() const { return totals_; }
    std::span<const std::uint32_t> area_ratios() const { return area_ratios_; }
    LAMINA_EXPORT void append(const QualityTotals& totals);
    LAMINA_EXPORT void append_area_ratios(std::span<const std::uint32_t> counts);
    /// Replaces the sums over the cells, whose last bits depend on the order in which parts were appended.
    void set_sums(double min_angles, double max_angles, double mean_ratios) {
        totals_.min_angle_sum = min_angles;
        totals_.max_angle_sum = max_angles;
        totals_.mean_ratio_sum = mean_ratios;
    }
    /// Returns a ratio that at least this share of the ratios of areas reach: the lower end of a bin of the histogram.
    LAMINA_EXPORT double area_ratio_exceeded_by(double share) const;

private:
    double area_ratio_percentile_999() const;
    void raise_largest_ratio(double ratio, Point at);

    double bound_;
    QualityTotals totals_;
    /// Histogram of the ratios of neighbouring areas, from 1 on, in bins 0.2 % wide, the last of which has no upper
    /// end. A percentile taken from it needs no sorting and no memory in proportion to the mesh. Empty until the first
    /// ratio is added.
    std::vector<std::uint32_t> area_ratios_;
};

}  // namespace lamina::mesh
