#include "flow/euler/dual_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace lamina::flow::euler {

namespace {

constexpr std::uint32_t no_number = 0xffffffff;

/// A graph: the neighbours of v are neighbours[k] for begins[v] <= k < begins[v + 1].
struct Graph {
    std::vector<std::uint32_t> begins, neighbours;
};

/// Returns the vertices that share a triangle with each vertex, those across inner edges twice.
Graph vertices_beside(std::size_t vertices, std::span<const Triangle> triangles) {
    Graph graph{std::vector<std::uint32_t>(vertices + 1, 0), std::vector<std::uint32_t>(6 * triangles.size())};
    for (const Triangle& t : triangles)
        for (const VertexId v : t.v) graph.begins[v.index() + 1] += 2;
    std::partial_sum(graph.begins.begin(), graph.begins.end(), graph.begins.begin());
    std::vector<std::uint32_t> next(graph.begins.begin(), graph.begins.end() - 1);
    for (const Triangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            for (const std::size_t other : {k + 1, k + 2})
                graph.neighbours[next[t.v[k].index()]++] = t.v[other % 3].value;
    return graph;
}

/// Numbers the vertices by breadth-first search.
void number_vertices(const Graph& graph, VertexId first, DualMesh& mesh) {
    const std::size_t vertices = graph.begins.size() - 1;
    mesh.number_of.assign(vertices, no_number);
    mesh.given.reserve(vertices);
    const auto add = [&](std::uint32_t v) {
        if (mesh.number_of[v] != no_number) return;
        mesh.number_of[v] = static_cast<std::uint32_t>(mesh.given.size());
        mesh.given.push_back(v);
    };
    add(first.value);
    // The list grows while it is read.
    std::size_t k = 0;
    while (k < mesh.given.size()) {
        const std::uint32_t v = mesh.given[k++];
        for (std::uint32_t n = graph.begins[v]; n < graph.begins[v + 1]; ++n) add(graph.neighbours[n]);
    }
}

/// Adds the parts of the control volumes that lie in each triangle, and sums up the faces of each edge.
void add_volumes(std::span<const Triangle> triangles, DualMesh& mesh) {
    std::vector<DualEdge> parts;
    parts.reserve(3 * triangles.size());
    mesh.areas.assign(mesh.points.size(), 0);
    for (const Triangle& t : triangles) {
        const std::uint32_t v[3] = {mesh.number_of[t.v[0].index()], mesh.number_of[t.v[1].index()],
                                    mesh.number_of[t.v[2].index()]};
        const Point a = mesh.points[v[0]], b = mesh.points[v[1]], c = mesh.points[v[2]];
        const double area = 0.5 * cross(b - a, c - a);
        const Point middle = (1.0 / 3) * (a + b + c);
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.areas[v[k]] += area / 3;
            const std::uint32_t i = v[k], j = v[(k + 1) % 3];
            // The face leads from the middle of the edge to that of the triangle, which lies on the left.
            const Point normal = -perpendicular(middle - midpoint(mesh.points[i], mesh.points[j]));
            parts.push_back(i < j ? DualEdge{i, j, normal} : DualEdge{j, i, -normal});
        }
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const DualEdge& a, const DualEdge& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
    for (const DualEdge& part : parts) {
        if (!mesh.edges.empty() && mesh.edges.back().i == part.i && mesh.edges.back().j == part.j)
            mesh.edges.back().normal = mesh.edges.back().normal + part.normal;
        else
            mesh.edges.push_back(part);
    }
}

void add_neighbours(DualMesh& mesh) {
    mesh.begins.assign(mesh.points.size() + 1, 0);
    for (const DualEdge& e : mesh.edges) ++mesh.begins[e.i + 1], ++mesh.begins[e.j + 1];
    std::partial_sum(mesh.begins.begin(), mesh.begins.end(), mesh.begins.begin());
    mesh.neighbours.resize(2 * mesh.edges.size());
    std::vector<std::uint32_t> next(mesh.begins.begin(), mesh.begins.end() - 1);
    for (const DualEdge& e : mesh.edges) {
        mesh.places.push_back({next[e.i], next[e.j]});
        mesh.neighbours[next[e.i]++] = e.j;
        mesh.neighbours[next[e.j]++] = e.i;
    }
}

void add_gradient_inverses(DualMesh& mesh) {
    mesh.gradient_inverses.assign(mesh.points.size(), {0, 0, 0});
    for (const DualEdge& e : mesh.edges) {
        const Point d = mesh.points[e.j] - mesh.points[e.i];
        const double weight = 1 / squared_length(d);
        for (const std::uint32_t v : {e.i, e.j}) {
            mesh.gradient_inverses[v][0] += weight * d.x * d.x;
            mesh.gradient_inverses[v][1] += weight * d.x * d.y;
            mesh.gradient_inverses[v][2] += weight * d.y * d.y;
        }
    }
    for (auto& m : mesh.gradient_inverses) {
        const double determinant = m[0] * m[2] - m[1] * m[1];
        m = {m[2] / determinant, -m[1] / determinant, m[0] / determinant};
    }
}

}  // namespace

DualMesh make_dual_mesh(std::span<const Point> points, std::span<const Triangle> triangles, VertexId first) {
    DualMesh mesh;
    number_vertices(vertices_beside(points.size(), triangles), first, mesh);
    if (mesh.given.size() != points.size()) return {};
    for (const std::uint32_t v : mesh.given) mesh.points.push_back(points[v]);
    add_volumes(triangles, mesh);
    add_neighbours(mesh);
    add_gradient_inverses(mesh);
    return mesh;
}

void add_boundary_edge(DualMesh& mesh, Segment edge, BoundaryKind kind) {
    const std::uint32_t a = mesh.number_of[edge.a.index()], b = mesh.number_of[edge.b.index()];
    mesh.boundary.push_back({a, b, -perpendicular(mesh.points[b] - mesh.points[a]), kind});
}

}  // namespace lamina::flow::euler
