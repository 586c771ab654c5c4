#include "adaptation/cell_gradients.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/cell_middle.hpp"

namespace lamina::adaptation {

std::vector<double> cell_values(const Mesh& mesh, const SolutionField& field) {
    if (field.at_cells) return field.values;
    const mesh::CellEdges cells(mesh);
    std::vector<double> means(cells.cells(), 0.0);
    for (std::size_t cell = 0; cell < means.size(); ++cell)
        for (std::size_t i = 0; i < cells.corners(cell); ++i)
            means[cell] += field.values[cells.corner(cell, i).index()] / static_cast<double>(cells.corners(cell));
    return means;
}

std::vector<Point> cell_middles(const Mesh& mesh) {
    std::vector<Point> middles;
    middles.reserve(mesh.triangles.size() + mesh.quads.size());
    for (const Triangle& triangle : mesh.triangles) middles.push_back(mesh::middle_of_cell(mesh, triangle.v));
    for (const Quad& quad : mesh.quads) middles.push_back(mesh::middle_of_cell(mesh, quad.v));
    return middles;
}

std::vector<Point> CellReconstruction::gradients(std::span<const double> values) const {
    std::vector<Point> result(middles_.size());
    core::parallel_for(result.size(), 1024, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> beside;
        for (std::size_t cell = begin; cell < end; ++cell) {
            find_neighbours(cell, beside);
            result[cell] = gradient(cell, beside, values);
        }
    });
    return result;
}

void CellReconstruction::find_neighbours(std::size_t cell, std::vector<std::uint32_t>& beside) const {
    beside.clear();
    for (const VertexId v : cells_.corners(cell)) {
        const auto at = cells_.at(v.index());
        beside.insert(beside.end(), at.begin(), at.end());
    }
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
}

Point CellReconstruction::gradient(std::size_t cell, const std::vector<std::uint32_t>& beside,
                                   std::span<const double> values) const {
    double xx = 0, xy = 0, yy = 0, xf = 0, yf = 0;
    for (const std::uint32_t other : beside) {
        const Point to = middles_[other] - middles_[cell];
        const double squared = squared_length(to);
        if (!(squared > 0)) continue;
        const double difference = values[other] - values[cell];
        xx += to.x * to.x / squared;
        xy += to.x * to.y / squared;
        yy += to.y * to.y / squared;
        xf += to.x * difference / squared;
        yf += to.y * difference / squared;
    }
    constexpr double on_one_line = 1e-12;
    const double determinant = xx * yy - xy * xy, trace = xx + yy;
    if (!(determinant > on_one_line * trace * trace)) return {0, 0};
    return {(yy * xf - xy * yf) / determinant, (xx * yf - xy * xf) / determinant};
}

}  // namespace lamina::adaptation
