#include "pipeline/divide_boundary.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace lamina::pipeline {

namespace {

/// A triangle or a quad, and what the mesh says of it.
struct Cell {
    std::array<VertexId, 4> v{};
    std::size_t corners = 3;
    Region region{};
    std::uint32_t piece = 0, column = 0;
    std::uint16_t layer = 0;

    VertexId at(std::size_t i) const { return v[i % corners]; }
};

std::vector<Cell> cells_of(const MeshResult& result) {
    const Mesh& mesh = result.mesh;
    std::vector<Cell> cells;
    for (const Triangle& t : mesh.triangles) cells.push_back({{t.v[0], t.v[1], t.v[2]}, 3});
    for (const Quad& q : mesh.quads) cells.push_back({{q.v[0], q.v[1], q.v[2], q.v[3]}, 4});
    std::size_t column = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        cells[i].region = mesh.region[i];
        cells[i].piece = mesh.piece[i];
        cells[i].layer = mesh.layer[i];
        if (!result.columns.empty() && cells[i].region == Region::layer) cells[i].column = result.columns[column++];
    }
    return cells;
}

/// Gives the mesh these cells: triangles of the layer, other triangles, quads.
void set_cells(std::vector<Cell> cells, MeshResult& result) {
    const auto place = [](const Cell& cell) { return cell.corners == 4 ? 2 : cell.region == Region::layer ? 0 : 1; };
    std::stable_sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) { return place(a) < place(b); });
    Mesh& mesh = result.mesh;
    const bool has_columns = !result.columns.empty();
    mesh.triangles.clear();
    mesh.quads.clear();
    mesh.region.clear();
    mesh.piece.clear();
    mesh.layer.clear();
    result.columns.clear();
    for (const Cell& cell : cells) {
        if (cell.corners == 3)
            mesh.triangles.push_back({cell.v[0], cell.v[1], cell.v[2]});
        else
            mesh.quads.push_back({cell.v[0], cell.v[1], cell.v[2], cell.v[3]});
        mesh.region.push_back(cell.region);
        mesh.piece.push_back(cell.piece);
        mesh.layer.push_back(cell.layer);
        if (has_columns && cell.region == Region::layer) result.columns.push_back(cell.column);
    }
}

/// Divides a cell from its edge i on, between new vertices v and w on that edge.
///
///      d ---- c          d ---- c              c             c
///      |      |    ->    |\ \  /|             / \    ->     /|\            .
///      |      |          | \ \/ |            /   \         / | \           .
///      a ---- b          a--v-w-b           a --- b       a--v--b
void divide_cell(std::size_t cell, std::size_t i, std::span<const VertexId> between, std::vector<Cell>& cells) {
    assert(!between.empty() && i < cells[cell].corners);
    const Cell given = cells[cell];
    const VertexId a = given.at(i), b = given.at(i + 1), c = given.at(i + 2),
                   apex = given.at(i + given.corners - 1);  // c, or d of a quad
    const auto triangle = [&](VertexId p, VertexId q, VertexId r) {
        Cell part = given;
        part.corners = 3;
        part.v = {p, q, r};
        return part;
    };
    cells[cell] = triangle(a, between.front(), apex);
    for (std::size_t k = 0; k + 1 < between.size(); ++k) cells.push_back(triangle(between[k], between[k + 1], apex));
    cells.push_back(triangle(between.back(), b, c));
    if (given.corners == 4) cells.push_back(triangle(between.back(), c, apex));
}

/// Puts the parts of a divided edge in its place.
void divide_in(std::vector<Segment>& edges, const std::map<Segment, std::vector<VertexId>>& between) {
    std::vector<Segment> divided;
    for (const Segment& edge : edges) {
        const auto found = between.find(edge);
        VertexId from = edge.a;
        if (found != between.end())
            for (const VertexId v : found->second) divided.push_back({std::exchange(from, v), v});
        divided.push_back({from, edge.b});
    }
    edges = std::move(divided);
}

}  // namespace

void divide_boundary(std::span<const DividedEdge> edges, MeshResult& result) {
    if (edges.empty()) return;
    std::map<Segment, std::vector<VertexId>> between;
    for (const DividedEdge& divided : edges)
        for (const Point p : divided.at) {
            between[divided.edge].push_back(VertexId{result.mesh.points.size()});
            result.mesh.points.push_back(p);
        }
    std::vector<Cell> cells = cells_of(result);
    // Parts of a cell follow behind all others, so that each of its edges is looked at again.
    [[maybe_unused]] std::size_t met = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
        for (std::size_t i = 0; i < cells[cell].corners; ++i) {
            const auto found = between.find({cells[cell].at(i), cells[cell].at(i + 1)});
            if (found == between.end()) continue;
            divide_cell(cell, i, found->second, cells);
            ++met;
            i = 0;  // of the part in its place, whose first edge is no longer one of these
        }
    assert(met == between.size() && "each edge is on the boundary, and so of one cell");
    set_cells(std::move(cells), result);
    for (Marker& marker : result.mesh.markers) divide_in(marker.edges, between);
}

}  // namespace lamina::pipeline
