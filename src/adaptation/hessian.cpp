// Derivatives of fields by least squares. Sources: M.-G. Vallet, C.-M. Manole, J. Dompierre, S. Dufour, F.
// Guibault, Int. J. Numer. Meth. Engng 72 (2007), "quadratic fitting"; O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer.
// Meth. Engng 33 (1992).
#include <lamina/solution_sizes.hpp>

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "adaptation/hessian.hpp"
#include "adaptation/vertex_patches.hpp"
#include "core/parallel.hpp"
#include "mesh/cell_middle.hpp"

namespace lamina::adaptation {

namespace {

/// A quadratic polynomial has 6 coefficients. It is fitted to so many values at least, if there are any more.
constexpr std::size_t min_samples = 12;
/// The values lie within so many edges of the vertex, and within so many at most where they are few.
constexpr int usual_rings = 2, most_rings = 5;

struct Sample {
    Point at;
    double value;
};

/// Collects the values round a vertex.
class SampleSearch {
public:
    SampleSearch(const Mesh& mesh, const SolutionField& field, const VertexCells& cells)
        : mesh_(mesh), field_(field), cells_(cells), patch_(cells, mesh.points.size()) {}

    const std::vector<Sample>& round(std::size_t vertex) {
        patch_.begin(vertex);
        // Cells reach one edge further than the vertices that they are found at.
        for (int ring = field_.at_cells ? 1 : 0; ring < most_rings; ++ring) {
            if (ring >= usual_rings && samples_.size() >= min_samples) break;
            if (!patch_.grow()) break;
            collect();
        }
        return samples_;
    }

private:
    void collect() {
        samples_.clear();
        const std::vector<std::uint32_t>& vertices = patch_.vertices();
        if (!field_.at_cells) {
            for (const std::uint32_t v : vertices) samples_.push_back({mesh_.points[v], field_.values[v]});
            return;
        }
        found_.clear();
        for (const std::uint32_t v : vertices) {
            const auto at = cells_.at(v);
            found_.insert(found_.end(), at.begin(), at.end());
        }
        std::sort(found_.begin(), found_.end());
        found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
        for (const std::uint32_t cell : found_)
            samples_.push_back({mesh::middle_of_cell(mesh_, cells_.corners(cell)), field_.values[cell]});
    }

    const Mesh& mesh_;
    const SolutionField& field_;
    const VertexCells& cells_;
    PatchSearch patch_;
    std::vector<std::uint32_t> found_;
    std::vector<Sample> samples_;
};

/// Fits f = a + b x + c y + d x^2 + e x y + f y^2 about a point, in coordinates that make the farthest sample 1 away.
Derivatives fitted_derivatives(Point origin, const std::vector<Sample>& samples) {
    double reach = 0, mean = 0;
    for (const Sample& sample : samples) reach = std::max(reach, distance(sample.at, origin));
    for (const Sample& sample : samples) mean += sample.value / static_cast<double>(samples.size());
    if (!(reach > 0)) return {};
    using Matrix = Eigen::Matrix<double, 6, 6>;
    using Vector = Eigen::Matrix<double, 6, 1>;
    Matrix matrix = Matrix::Zero();
    Vector right = Vector::Zero();
    for (const Sample& sample : samples) {
        const Point p = (1 / reach) * (sample.at - origin);
        Vector row;
        row << 1, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y;
        matrix += row * row.transpose();
        right += (sample.value - mean) * row;
    }
    const Vector c = matrix.ldlt().solve(right);
    const double scale = 1 / (reach * reach);
    const Derivatives derivatives{{c[1] / reach, c[2] / reach}, {2 * scale * c[3], scale * c[4], 2 * scale * c[5]}};
    const auto& [gradient, hessian] = derivatives;
    for (const double value : {gradient.x, gradient.y, hessian.xx, hessian.xy, hessian.yy})
        if (!std::isfinite(value)) return {};
    return derivatives;
}

}  // namespace

double largest_curvature(const Hessian& hessian) {
    const double mean = 0.5 * (hessian.xx + hessian.yy), half = 0.5 * (hessian.xx - hessian.yy);
    return std::abs(mean) + std::sqrt(half * half + hessian.xy * hessian.xy);
}

/// The root of the square, by the theorem of Cayley and Hamilton: for a positive A, sqrt(A) is A + sqrt(det A) I over
/// sqrt(tr A + 2 sqrt(det A)).
Hessian absolute(const Hessian& h) {
    const double determinant = std::abs(h.xx * h.yy - h.xy * h.xy);
    const double xx = h.xx * h.xx + h.xy * h.xy, yy = h.yy * h.yy + h.xy * h.xy, xy = h.xy * (h.xx + h.yy);
    const double root = std::sqrt(xx + yy + 2 * determinant);
    if (!(root > 0)) return {};
    return (1 / root) * Hessian{xx + determinant, xy, yy + determinant};
}

std::vector<Derivatives> recover_derivatives(const Mesh& mesh, const SolutionField& field) {
    require_fitting(mesh, field);
    const VertexCells cells(mesh, isotropic_cells(mesh));
    std::vector<Derivatives> derivatives(mesh.points.size());
    constexpr std::size_t grain = 4096;
    core::parallel_for(derivatives.size(), grain, [&](std::size_t begin, std::size_t end) {
        SampleSearch search(mesh, field, cells);
        for (std::size_t v = begin; v < end; ++v)
            if (!cells.at(v).empty()) derivatives[v] = fitted_derivatives(mesh.points[v], search.round(v));
    });
    return derivatives;
}

}  // namespace lamina::adaptation
