// The colours of the cells of a picture, and what they mean.
#pragma once

#include <string>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/plot.hpp>

#include "plot/color.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

/// The colours of cells, and the numbers at the ends of their scale.
struct CellColors {
    std::vector<Color> colors;  ///< per cell
    std::string quantity;       ///< what the numbers are; empty where colours stand for no numbers
    double low = 0, high = 1;   ///< the numbers, or their decimal logarithms
    bool logarithmic = false;
};

/// Returns the colours of these cells. The scales of size and layer span the cells in view.
CellColors color_cells(const Mesh& mesh, const std::vector<VisibleCell>& cells, PlotColor by);

}  // namespace lamina::plot
