#include "flow/euler/block_system.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace lamina::flow::euler {

namespace {

using Row = std::array<float, 4>;

Block block_of(const Matrix4& m) {
    Block block;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) block.columns[4 * j + i] = static_cast<float>(m[4 * i + j]);
    return block;
}

/// Returns the inverse by elimination with pivots of the columns.
Matrix4 inverse(Matrix4 m) {
    Matrix4 result{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (std::size_t c = 0; c < 4; ++c) {
        std::size_t pivot = c;
        for (std::size_t i = c + 1; i < 4; ++i)
            if (std::abs(m[4 * i + c]) > std::abs(m[4 * pivot + c])) pivot = i;
        for (std::size_t j = 0; pivot != c && j < 4; ++j) {
            std::swap(m[4 * pivot + j], m[4 * c + j]);
            std::swap(result[4 * pivot + j], result[4 * c + j]);
        }
        const double scale = 1 / m[5 * c];
        for (std::size_t j = 0; j < 4; ++j) m[4 * c + j] *= scale, result[4 * c + j] *= scale;
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == c) continue;
            const double factor = m[4 * i + c];
            for (std::size_t j = 0; j < 4; ++j) {
                m[4 * i + j] -= factor * m[4 * c + j];
                result[4 * i + j] -= factor * result[4 * c + j];
            }
        }
    }
    return result;
}

/// Subtracts block x vector from a row.
void subtract_product(const Block& block, const Row& vector, Row& row) {
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) row[i] -= block.columns[4 * j + i] * vector[j];
}

void assemble_edges(const DualMesh& mesh, std::span<const Four> states, BlockSystem& system) {
    for (std::size_t k = 0; k < mesh.edges.size(); ++k) {
        const DualEdge& e = mesh.edges[k];
        const Four &left = states[e.i], &right = states[e.j];
        const Matrix4 of_left = flux_jacobian(left, e.normal), of_right = flux_jacobian(right, e.normal),
                      damping = absolute_jacobian(left, right, e.normal);
        Matrix4 leaving, entering;
        Matrix4 &at_i = system.diagonal[e.i], &at_j = system.diagonal[e.j];
        for (std::size_t m = 0; m < 16; ++m) {
            leaving[m] = 0.5 * (of_left[m] + damping[m]);
            entering[m] = 0.5 * (of_right[m] - damping[m]);
            at_i[m] += leaving[m];
            at_j[m] -= entering[m];
            leaving[m] = -leaving[m];
        }
        system.beside[mesh.places[k][0]] = block_of(entering);
        system.beside[mesh.places[k][1]] = block_of(leaving);
    }
}

/// Adds the derivative of the pressure on half of a wall's edge.
void add_wall(const Four& state, Point normal, Matrix4& diagonal) {
    constexpr double g1 = heat_ratio - 1;
    const Four of_pressure{0.5 * g1 * squared_length(velocity(state)), -g1 * state[1], -g1 * state[2], g1};
    for (std::size_t m = 0; m < 4; ++m) {
        diagonal[4 + m] += normal.x * of_pressure[m];
        diagonal[8 + m] += normal.y * of_pressure[m];
    }
}

void assemble_boundary(const DualMesh& mesh, std::span<const Four> states, const Four& free_stream,
                       BlockSystem& system) {
    for (const BoundaryEdge& e : mesh.boundary)
        for (const std::uint32_t v : {e.a, e.b}) {
            const Point normal = 0.5 * e.normal;
            Matrix4& diagonal = system.diagonal[v];
            if (e.kind != BoundaryKind::far) {
                add_wall(states[v], normal, diagonal);
                continue;
            }
            const Matrix4 jacobian = flux_jacobian(states[v], normal),
                          damping = absolute_jacobian(states[v], free_stream, normal);
            for (std::size_t m = 0; m < 16; ++m) diagonal[m] += 0.5 * (jacobian[m] + damping[m]);
        }
}

}  // namespace

void assemble(const DualMesh& mesh, std::span<const Four> states, const Four& free_stream,
              std::span<const double> radii, double cfl, BlockSystem& system) {
    system.diagonal.assign(mesh.points.size(), Matrix4{});
    system.diagonal_inverses.resize(mesh.points.size());
    system.beside.resize(mesh.neighbours.size());
    assemble_edges(mesh, states, system);
    assemble_boundary(mesh, states, free_stream, system);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        Matrix4& diagonal = system.diagonal[v];
        for (std::size_t m = 0; m < 4; ++m) diagonal[5 * m] += radii[v] / cfl;
        system.diagonal_inverses[v] = block_of(inverse(diagonal));
    }
}

void solve(const DualMesh& mesh, const BlockSystem& system, std::span<const Four> right_hand_side, int sweeps,
           std::vector<std::array<float, 4>>& solution) {
    const std::size_t vertices = mesh.points.size();
    solution.assign(vertices, Row{});
    const auto update = [&](std::size_t v) {
        Row row;
        for (std::size_t m = 0; m < 4; ++m) row[m] = static_cast<float>(right_hand_side[v][m]);
        for (std::uint32_t k = mesh.begins[v]; k < mesh.begins[v + 1]; ++k)
            subtract_product(system.beside[k], solution[mesh.neighbours[k]], row);
        Row negative{};
        subtract_product(system.diagonal_inverses[v], row, negative);
        for (std::size_t m = 0; m < 4; ++m) solution[v][m] = -negative[m];
    };
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (std::size_t v = 0; v < vertices; ++v) update(v);
        for (std::size_t v = vertices; v-- > 0;) update(v);
    }
}

}  // namespace lamina::flow::euler
