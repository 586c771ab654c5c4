#include "plot/color_scale.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/quality.hpp"

namespace lamina::plot {

namespace {

constexpr Color layer_tint{0.86, 0.92, 0.99};

/// Returns the logarithm of the side of a square with the area of the cell.
double log_size(const VisibleCell& c) { return 0.5 * std::log10(std::max(c.area(), 1e-300)); }

double min_angle_deg(const VisibleCell& c) {
    return c.corners == 3 ? core::measure_triangle(c.corner[0], c.corner[1], c.corner[2]).min_angle_deg
                          : mesh::measure_quad(c.corner[0], c.corner[1], c.corner[2], c.corner[3]).min_angle_deg;
}

Color plain_color(const Mesh& mesh, std::size_t cell) {
    return !mesh.region.empty() && mesh.region[cell] == Region::layer ? layer_tint : paper;
}

/// Returns colours that stand for no numbers.
CellColors color_classes(const Mesh& mesh, const std::vector<VisibleCell>& cells, PlotColor by) {
    CellColors found;
    for (const VisibleCell& cell : cells) {
        const bool piece = by == PlotColor::piece;
        found.colors.push_back(!piece               ? plain_color(mesh, cell.cell)
                               : mesh.piece.empty() ? paper
                                                    : distinct_color(mesh.piece[cell.cell]));
    }
    return found;
}

/// Returns the numbers of the cells.
std::vector<double> cell_values(const Mesh& mesh, const std::vector<VisibleCell>& cells, PlotColor by) {
    std::vector<double> values(cells.size(), 0.0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (by == PlotColor::size) values[i] = log_size(cells[i]);
        if (by == PlotColor::layer && !mesh.layer.empty()) values[i] = mesh.layer[cells[i].cell];
        if (by == PlotColor::quality) values[i] = min_angle_deg(cells[i]);
    }
    return values;
}

}  // namespace

CellColors color_cells(const Mesh& mesh, const std::vector<VisibleCell>& cells, PlotColor by) {
    if (by == PlotColor::none || by == PlotColor::piece || cells.empty()) return color_classes(mesh, cells, by);
    const std::vector<double> values = cell_values(mesh, cells, by);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    CellColors found;
    if (by == PlotColor::quality) {
        // Angles of isotropic triangles reach 60 degrees, which is the end of the scale; squares look alike.
        found = {{}, "smallest angle, degrees", 0, 60};
    } else if (by == PlotColor::size) {
        found = {{}, "root of the area", *least, std::max(*most, *least + 1e-9), true};
    } else {
        found = {{}, "layer", 0, std::max(1.0, *most)};
    }
    for (const double value : values) {
        const double position = (value - found.low) / (found.high - found.low);
        found.colors.push_back(by == PlotColor::layer && value == 0 ? paper : viridis(position));
    }
    return found;
}

}  // namespace lamina::plot
