#include "mesh/check_arrays.hpp"

#include <fmt/format.h>

#include <lamina/predicates.hpp>

#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/cell_text.hpp"

namespace lamina::mesh {

namespace {

/// Calls check_one(i, defects) for all i below n, in parallel, and appends the defects in the order of i.
template <class F>
void check_blocks(std::size_t n, DefectList& defects, F&& check_one) {
    const auto check_block = [&](std::size_t begin, std::size_t end) {
        DefectList found;
        for (std::size_t i = begin; i < end; ++i) check_one(i, found);
        return found;
    };
    for (DefectList& found : core::parallel_blocks(n, cells_per_block, check_block)) defects.append(std::move(found));
}

void check_lengths(const MeshView& mesh, std::size_t cells, DefectList& defects) {
    if (cells == 0) defects.add([] { return MeshDefect{"no cells", {}}; });
    const auto check_length = [&](const char* array, std::size_t length) {
        if (length != 0 && length != cells)
            defects.add([&] {
                return MeshDefect{fmt::format("{} entries in '{}' for {} cells", length, array, cells), {}};
            });
    };
    check_length("region", mesh.region.size());
    check_length("piece", mesh.piece.size());
    check_length("layer", mesh.layer.size());
}

}  // namespace

void check_arrays(const MeshView& mesh, DefectList& defects) {
    const std::size_t vertices = mesh.points.size();
    const CellEdges edges(mesh);
    const auto in_range = [&](const Segment& s) { return s.a.index() < vertices && s.b.index() < vertices; };

    check_lengths(mesh, edges.cells(), defects);
    check_blocks(vertices, defects, [&](std::size_t v, DefectList& found) {
        const Point p = mesh.points[v];
        if (!in_exact_range(p))
            found.add([&] {
                return MeshDefect{fmt::format("vertex {} ({}, {}) is not a number or out of range", v, p.x, p.y), p};
            });
    });
    check_blocks(edges.cells(), defects, [&](std::size_t cell, DefectList& found) {
        for (std::size_t i = 0; i < edges.corners(cell); ++i)
            if (edges.corner(cell, i).index() >= vertices) {
                found.add([&] {
                    return MeshDefect{fmt::format("{} has an index out of range", cell_text(mesh, cell)), {}};
                });
                return;
            }
    });
    for (const Marker& marker : mesh.markers)
        for (const Segment& edge : marker.edges)
            if (!in_range(edge))
                defects.add([&] {
                    return MeshDefect{
                        fmt::format("edge {} of marker '{}' has an index out of range", edge_text(edge), marker.name),
                        {}};
                });
    for (const Segment& edge : mesh.constraints)
        if (!in_range(edge))
            defects.add([&] {
                return MeshDefect{fmt::format("constraint {} has an index out of range", edge_text(edge)), {}};
            });
}

}  // namespace lamina::mesh
