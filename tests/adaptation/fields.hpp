// Fields on meshes that are given by formulas.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>
#include <lamina/solution_sizes.hpp>

#include "support/shapes.hpp"

namespace lamina::test {

using Formula = std::function<double(Point)>;

inline Point cell_middle(const Mesh& mesh, std::size_t cell) {
    const bool is_quad = cell >= mesh.triangles.size();
    const VertexId* v = is_quad ? mesh.quads[cell - mesh.triangles.size()].v : mesh.triangles[cell].v;
    Point sum{0, 0};
    for (int i = 0; i < (is_quad ? 4 : 3); ++i) sum = sum + mesh.points[v[i].index()];
    return (is_quad ? 0.25 : 1.0 / 3) * sum;
}

inline SolutionField field_of(const Mesh& mesh, const Formula& formula, bool at_cells = false) {
    SolutionField field{"f", at_cells, {}};
    if (!at_cells)
        for (const Point p : mesh.points) field.values.push_back(formula(p));
    for (std::size_t cell = 0; at_cells && cell < mesh.triangles.size() + mesh.quads.size(); ++cell)
        field.values.push_back(formula(cell_middle(mesh, cell)));
    return field;
}

/// Options of quick meshes with a near far field.
inline CaseOptions near_options() {
    CaseOptions options;
    options.far_field.size = 5;
    options.layer.first_height = 1e-4;
    options.layer.layers = 20;
    return options;
}

inline Geometry one_section() { return shapes::geometry({naca_airfoil("0012", 300).points}); }

}  // namespace lamina::test
