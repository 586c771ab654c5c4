#include "io/mesh_faces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <lamina/error.hpp>

#include "core/parallel.hpp"

namespace lamina::io {

namespace {

using Faces = std::vector<std::uint32_t>;

Faces internal_faces(const mesh::CellEdges& edges, const mesh::Adjacency& adjacency) {
    constexpr std::size_t grain = 1 << 14;
    const auto faces_of = [&](std::size_t begin, std::size_t end) {
        Faces faces;
        for (std::size_t cell = begin; cell < end; ++cell) {
            const auto first = static_cast<std::ptrdiff_t>(faces.size());
            for (std::size_t e = edges.first(cell); e < edges.first(cell) + edges.corners(cell); ++e)
                if (adjacency.twin[e] != mesh::no_edge && edges.cell_of(adjacency.twin[e]) > cell)
                    faces.push_back(static_cast<std::uint32_t>(e));
            std::sort(faces.begin() + first, faces.end(), [&](std::uint32_t a, std::uint32_t b) {
                return edges.cell_of(adjacency.twin[a]) < edges.cell_of(adjacency.twin[b]);
            });
        }
        return faces;
    };
    Faces all;
    for (const Faces& faces : core::parallel_blocks(edges.cells(), grain, faces_of))
        all.insert(all.end(), faces.begin(), faces.end());
    return all;
}

/// Returns the faces on the edges of the markers, marker by marker. Throws MeshError where such an edge is not on the
/// boundary or has its cell on the right.
Faces marker_faces(const MeshView& mesh, const mesh::CellEdges& edges, const mesh::Adjacency& adjacency,
                   const std::filesystem::path& file, const char* format) {
    std::vector<Segment> marked;
    for (const Marker& marker : mesh.markers) marked.insert(marked.end(), marker.edges.begin(), marker.edges.end());
    Faces faces = mesh::find_edges(mesh, marked);
    std::size_t i = 0;
    for (const Marker& marker : mesh.markers)
        for (const Segment& edge : marker.edges) {
            const std::uint32_t e = faces[i++];
            if (e != mesh::no_edge && adjacency.twin[e] == mesh::no_edge && edges.origin(e) == edge.a) continue;
            const Point at = mesh.points[edge.a.index()];
            throw MeshError(
                fmt::format("{}: {} cannot hold an edge of marker '{}' at ({}, {}) that is not on "
                            "the boundary, with its cell on the left",
                            file.string(), format, marker.name, at.x, at.y));
        }
    return faces;
}

}  // namespace

MeshFaces find_faces(const MeshView& mesh, const std::filesystem::path& file, const char* format) {
    MeshFaces found{mesh::CellEdges(mesh), mesh::find_adjacency(mesh)};
    if (!found.adjacency.overused.empty())
        throw MeshError(fmt::format("{}: {} cannot hold a mesh that is not conforming", file.string(), format));
    found.faces = internal_faces(found.edges, found.adjacency);
    found.internal = found.faces.size();
    const Faces marked = marker_faces(mesh, found.edges, found.adjacency, file, format);
    found.faces.insert(found.faces.end(), marked.begin(), marked.end());
    if (marked.size() != found.adjacency.boundary.size())
        throw MeshError(
            fmt::format("{}: {} wants every edge of the boundary in exactly one marker", file.string(), format));
    return found;
}

}  // namespace lamina::io
