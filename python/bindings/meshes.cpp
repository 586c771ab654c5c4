// Meshes: read, checked, written, and seen as arrays without copies.
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/metric.hpp>
#include <lamina/remesh.hpp>
#include <lamina/warning.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "core/marker_names.hpp"
#include "facts.hpp"
#include "interruption.hpp"
#include "mesh/cell_lattice.hpp"
#include "shared_mesh.hpp"

namespace lamina::python {

namespace {

SharedMesh read(const std::string& file, const std::string& format) {
    const nb::gil_scoped_release unlocked;
    CurvedMesh mesh = read_curved_mesh(file, {.format = format});
    return shared(std::move(mesh.mesh), std::move(mesh.nodes));
}

/// Writes the mesh, with legal names of markers. Returns the warnings of those that differ from the mesh's own.
nb::list write(const SharedMesh& mesh, const std::string& file, const std::string& format, bool wall_distance,
               double span, std::size_t span_cells, bool span_periodic) {
    std::vector<Marker> markers = (*mesh).markers;
    const std::vector<Warning> warnings = make_marker_names_legal(markers);
    MeshView view = *mesh;
    view.markers = markers;
    {
        const nb::gil_scoped_release unlocked;
        const WriteOptions options{.format = format,
                                   .wall_distance = wall_distance,
                                   .span = span,
                                   .span_cells = span_cells,
                                   .span_periodic = span_periodic};
        if (mesh.nodes->order > 1)
            write_curved_mesh(view, *mesh.nodes, file, options);
        else
            write_mesh(view, file, options);
    }
    return warnings_of(warnings);
}

nb::dict check(const SharedMesh& mesh, double min_angle, const std::optional<double>& first_height) {
    MeshCheck result;
    run_unlocked([&] {
        result = check_mesh(*mesh, {.min_angle_deg = min_angle, .first_height = first_height});
        if (mesh.nodes->order <= 1 || !result.valid()) return;
        CurvedCheck curved = check_curved(*mesh, *mesh.nodes);
        result.defects = std::move(curved.defects);
        result.defect_count = curved.defect_count;
    });
    return check_of(result);
}

/// Returns (vertex, marker, arc length, normal, first height, where bodies begin).
nb::tuple walls(const SharedMesh& mesh) {
    WallVertices found;
    {
        const nb::gil_scoped_release unlocked;
        found = wall_vertices(*mesh);
    }
    return nb::make_tuple(
        owning_array<std::uint32_t>(std::move(found.vertex)), owning_array<std::uint32_t>(std::move(found.marker)),
        owning_array<double>(std::move(found.arc_length)), owning_array<double>(std::move(found.normal)),
        owning_array<double>(std::move(found.first_height)), found.body_first);
}

ReadOnlyArray<double> distances(const SharedMesh& mesh) {
    std::vector<double> found;
    run_unlocked([&] { found = wall_distances(*mesh); });
    return owning_array<double>(std::move(found));
}

/// Returns (mesh, metric, number of triangles beyond the layer, share of edges of unit length, mean quality).
nb::tuple remesh_by(const SharedMesh& mesh, const RowsArgument<double, 3>& tensors, bool divide_borders,
                    const std::optional<double>& vertices, const std::optional<double>& gradation,
                    const std::optional<double>& max_ratio) {
    RemeshOptions options{.divide_borders = divide_borders, .vertices = vertices, .gradation = gradation};
    if (max_ratio) options.max_ratio = *max_ratio;
    std::vector<MetricTensor> metric(tensors.shape(0));
    for (std::size_t i = 0; i < metric.size(); ++i) {
        const double* row = tensors.data() + 3 * i;
        metric[i] = {row[0], row[1], row[2]};
    }
    require_straight(mesh, "remesh()");
    RemeshedMesh made;
    run_unlocked([&] {
        require_valid(*mesh);
        made = remesh(*mesh, metric, options);
    });
    return nb::make_tuple(shared(std::move(made.mesh)), owning_array<double>(std::move(made.metric)), made.triangles,
                          made.unit_edges, made.mean_quality);
}

/// Returns a view of an array of the mesh, which keeps the mesh alive.
template <class Scalar, class Item>
ReadOnlyArray<Scalar> view_of(const SharedMesh& mesh, std::vector<Item> Mesh::*items) {
    auto kept = std::make_unique<std::shared_ptr<const Mesh>>(mesh.mesh);
    const nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<std::shared_ptr<const Mesh>*>(p); });
    return view<Scalar>((**kept.release()).*items, owner);
}

/// Returns (name, kind, edges) for each marker.
nb::list markers(const SharedMesh& mesh) {
    nb::list result;
    for (const Marker& marker : (*mesh).markers) {
        auto kept = std::make_unique<std::shared_ptr<const Mesh>>(mesh.mesh);
        const nb::capsule owner(kept.release(),
                                [](void* p) noexcept { delete static_cast<std::shared_ptr<const Mesh>*>(p); });
        result.append(
            nb::make_tuple(marker.name, static_cast<int>(marker.kind), view<std::uint32_t>(marker.edges, owner)));
    }
    return result;
}

using MarkerArrays = std::vector<std::tuple<std::string, int, RowsArgument<std::uint32_t, 2>>>;
using CellArrays = std::tuple<ListArgument<std::uint8_t>, ListArgument<std::uint32_t>, ListArgument<std::uint16_t>>;

/// Throws InputError where vertices have no points, or arrays per cell are neither empty nor one number per cell.
void require_consistent_arrays(const Mesh& mesh) {
    const auto require = [](bool holds, const char* reason) {
        if (!holds) throw InputError({}, reason);
    };
    const auto in_range = [&](VertexId v) { return v.value < mesh.points.size(); };
    for (const Triangle& t : mesh.triangles)
        for (VertexId v : t.v) require(in_range(v), "a triangle has a vertex without a point");
    for (const Quad& q : mesh.quads)
        for (VertexId v : q.v) require(in_range(v), "a quadrilateral has a vertex without a point");
    const auto require_segments = [&](const std::vector<Segment>& segments) {
        for (const Segment& s : segments)
            require(in_range(s.a) && in_range(s.b), "an edge has a vertex without a point");
    };
    for (const Marker& marker : mesh.markers) require_segments(marker.edges);
    require_segments(mesh.constraints);
    const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
    for (const std::size_t size : {mesh.region.size(), mesh.piece.size(), mesh.layer.size()})
        require(size == 0 || size == cells, "an array of the cells has not one number for each");
    for (Region region : mesh.region) require(region <= Region::isotropic, "a region is neither 0 nor 1");
}

/// Returns the mesh of these arrays.
SharedMesh mesh_of_arrays(const PointsArgument& points, const RowsArgument<std::uint32_t, 3>& triangles,
                          const RowsArgument<std::uint32_t, 4>& quads, const MarkerArrays& markers,
                          const CellArrays& cells, const RowsArgument<std::uint32_t, 2>& constraints) {
    Mesh mesh;
    mesh.points = points_of(points);
    mesh.triangles = cells_of<Triangle, 3>(triangles);
    mesh.quads = cells_of<Quad, 4>(quads);
    mesh.constraints = cells_of<Segment, 2>(constraints);
    for (const auto& [name, kind, edges] : markers) {
        if (kind < 0 || kind >= static_cast<int>(core::marker_kind_count))
            throw InputError({}, "a marker has an unknown kind");
        mesh.markers.push_back({name, static_cast<MarkerKind>(kind), cells_of<Segment, 2>(edges)});
    }
    const auto& [region, piece, layer] = cells;
    for (std::size_t i = 0; i < region.shape(0); ++i) mesh.region.push_back(static_cast<Region>(region.data()[i]));
    mesh.piece.assign(piece.data(), piece.data() + piece.shape(0));
    mesh.layer.assign(layer.data(), layer.data() + layer.shape(0));
    require_consistent_arrays(mesh);
    return shared(std::move(mesh));
}

/// Returns (order, points, the nodes of triangles, quadrilaterals and markers, whether they are Gauss and Lobatto's) as
/// CurvedNodes has them.
nb::tuple curved_nodes(const SharedMesh& mesh) {
    const nb::capsule owner(new std::shared_ptr<const CurvedNodes>(mesh.nodes),
                            [](void* p) noexcept { delete static_cast<std::shared_ptr<const CurvedNodes>*>(p); });
    const auto ids = [&](const std::vector<VertexId>& list) { return view<std::uint32_t>(list, owner); };
    const CurvedNodes& nodes = *mesh.nodes;
    return nb::make_tuple(nodes.order, view<double>(nodes.points, owner), ids(nodes.triangle_nodes),
                          ids(nodes.quad_nodes), ids(nodes.marker_nodes),
                          nodes.distribution == NodeDistribution::gauss_lobatto);
}

using NodeNumbers = ListArgument<std::uint32_t>;

/// Returns the mesh with the curved cells of these nodes. Throws InputError where these do not fit it.
SharedMesh with_curved_nodes(const SharedMesh& mesh, unsigned order, const PointsArgument& points,
                             const NodeNumbers& triangle_nodes, const NodeNumbers& quad_nodes,
                             const NodeNumbers& marker_nodes, bool is_lobatto) {
    CurvedNodes nodes{.order = order,
                      .distribution = is_lobatto ? NodeDistribution::gauss_lobatto : NodeDistribution::equidistant,
                      .points = points_of(points)};
    const std::size_t first = (*mesh).points.size(), end = first + nodes.points.size();
    const auto take = [&](const NodeNumbers& given, std::size_t expected, std::vector<VertexId>& list) {
        if (given.shape(0) != expected) throw InputError({}, "the nodes of curved cells do not fit their order");
        for (std::size_t i = 0; i < expected; ++i) {
            if (given.data()[i] < first || given.data()[i] >= end)
                throw InputError({}, "a curved cell has a node without a point");
            list.emplace_back(given.data()[i]);
        }
    };
    if (order < 2 || order > max_cell_order) throw InputError({}, "curved cells have an order from 2 to 4");
    std::size_t edges = 0;
    for (const Marker& marker : (*mesh).markers) edges += marker.edges.size();
    take(triangle_nodes, (*mesh).triangles.size() * (mesh::nodes_of_cell(3, order) - 3), nodes.triangle_nodes);
    take(quad_nodes, (*mesh).quads.size() * (mesh::nodes_of_cell(4, order) - 4), nodes.quad_nodes);
    take(marker_nodes, edges * (order - 1), nodes.marker_nodes);
    return {mesh.mesh, std::make_shared<const CurvedNodes>(std::move(nodes))};
}

}  // namespace

void add_meshes(nb::module_& module) {
    nb::class_<SharedMesh>(module, "Mesh")
        .def("points", [](const SharedMesh& mesh) { return view_of<double>(mesh, &Mesh::points); })
        .def("triangles", [](const SharedMesh& mesh) { return view_of<std::uint32_t>(mesh, &Mesh::triangles); })
        .def("quads", [](const SharedMesh& mesh) { return view_of<std::uint32_t>(mesh, &Mesh::quads); })
        .def("region", [](const SharedMesh& mesh) { return view_of<std::uint8_t>(mesh, &Mesh::region); })
        .def("piece", [](const SharedMesh& mesh) { return view_of<std::uint32_t>(mesh, &Mesh::piece); })
        .def("layer", [](const SharedMesh& mesh) { return view_of<std::uint16_t>(mesh, &Mesh::layer); })
        .def("constraints", [](const SharedMesh& mesh) { return view_of<std::uint32_t>(mesh, &Mesh::constraints); })
        .def("markers", &markers)
        .def("curved_nodes", &curved_nodes)
        .def("with_curved_nodes", &with_curved_nodes)
        .def("walls", &walls)
        .def("wall_distances", &distances)
        .def("check", &check, nb::arg("min_angle"), nb::arg("first_height").none())
        .def("write", &write)
        .def("write_wall_data", [](const SharedMesh& mesh, const std::string& file) { write_wall_data(*mesh, file); })
        .def("hash", [](const SharedMesh& mesh) {
            const nb::gil_scoped_release unlocked;
            return mesh_hash(*mesh);
        });
    module.def("read", &read);
    module.def("read_metric", [](const std::string& file) { return owning_array<double>(read_metric(file)); });
    module.def("remesh", &remesh_by, nb::arg("mesh"), nb::arg("metric"), nb::arg("divide_borders"),
               nb::arg("vertices").none(), nb::arg("gradation").none(), nb::arg("max_ratio").none());
    module.def("create_folders_above", [](const std::string& file) { create_folders_above(file); });
    module.def("mesh_of_arrays", &mesh_of_arrays);
    module.def("format_names", [] {
        std::vector<std::string> names;
        for (const MeshFormat& format : mesh_formats()) names.push_back(format.name);
        return names;
    });
    nb::list kinds;
    for (const char* word : core::marker_kind_words) kinds.append(word);
    module.attr("marker_kinds") = nb::tuple(kinds);
    module.attr("proved_min_angle") = proved_min_angle_deg;
}

}  // namespace lamina::python
