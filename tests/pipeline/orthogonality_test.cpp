// Faces between cells are nearly orthogonal to the lines between the cells' centroids, as cell-centred solvers want it.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

Point centroid(const std::vector<Point>& cell) {
    double area = 0;
    Point sum{0, 0};
    for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
        const Point a = cell[i] - cell[0], b = cell[i + 1] - cell[0];
        const double twice = a.x * b.y - a.y * b.x;
        area += twice;
        sum = sum + twice / 3 * (a + b);
    }
    return cell[0] + 1 / area * sum;
}

/// Measures a mesh as OpenFOAM's checkMesh does: the largest angle, in degrees, between the normal of an inner face and
/// the line between the centroids of its cells.
double largest_non_orthogonality(const Mesh& mesh) {
    std::map<std::pair<std::size_t, std::size_t>, Point> centroid_beside;
    double largest = 0;
    const auto add = [&](const auto& vertices) {
        std::vector<Point> cell;
        for (const VertexId v : vertices) cell.push_back(mesh.points[v.index()]);
        const Point own = centroid(cell);
        for (std::size_t i = 0; i < cell.size(); ++i) {
            const std::size_t next = (i + 1) % cell.size(), a = vertices[i].index(), b = vertices[next].index();
            if (const auto other = centroid_beside.find({b, a}); other != centroid_beside.end()) {
                const Point across = other->second - own, along = cell[next] - cell[i];
                const double sine = across.x * along.x + across.y * along.y,
                             cosine = across.x * along.y - across.y * along.x;
                largest = std::max(largest, std::atan2(std::abs(sine), std::abs(cosine)));
            }
            centroid_beside.emplace(std::pair{a, b}, own);
        }
    };
    for (const auto& triangle : mesh.triangles) add(triangle.v);
    for (const auto& quad : mesh.quads) add(quad.v);
    return largest * 180 / 3.14159265358979323846;
}

/// Columns up to isotropy differ in their number of layers, and are stretched to end at one height. Where all of a
/// column was stretched, rows at the wall were 67 degrees from orthogonal beside changes of the number.
TEST(Orthogonality, QuadrilateralsOfLayersUpToIsotropy) {
    for (const auto& [outline, alpha] :
         {std::pair<Outline, double>{naca("0012", 200), 0}, {naca("0012", 200), 10}, {naca("4412", 200), 4}}) {
        CaseOptions options;
        options.conditions = {.alpha_deg = alpha, .reynolds = 6e6};
        options.layer.first_height = YPlus{1};
        options.layer.layers.reset();
        options.layer.topology = LayerTopology::quads;
        options.far_field.size = 20;
        options.use_flow = true;
        const MeshResult result = mesh_of({outline}, options);
        expect_sound(result, options);
        EXPECT_LT(largest_non_orthogonality(result.mesh), 55) << "alpha " << alpha;
    }
}

}  // namespace
}  // namespace lamina::test
