// Connectivity, queries, Voronoi diagrams and triangulations that change.
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <lamina/delaunay_connectivity.hpp>
#include <lamina/delaunay_queries.hpp>
#include <lamina/dynamic_triangulation.hpp>
#include <lamina/voronoi.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interruption.hpp"

namespace lamina::python {

namespace {

using TrianglesArgument = RowsArgument<std::uint32_t, 3>;
using ValuesArgument = ListArgument<double>;
using IndicesArgument = ListArgument<std::uint32_t>;

/// Calls a function while other threads of Python run, and returns its result.
template <class F>
auto unlocked(F&& f) {
    auto result = [&] {
        const nb::gil_scoped_release released;
        return f();
    }();
    raise_signals();
    return result;
}

std::span<const double> values_of(const ValuesArgument& array) { return {array.data(), array.shape(0)}; }
std::span<const std::uint32_t> indices_of(const IndicesArgument& array) { return {array.data(), array.shape(0)}; }

nb::tuple lists(IndexLists lists) {
    return nb::make_tuple(owning_array<std::uint32_t>(std::move(lists.starts)),
                          owning_array<std::uint32_t>(std::move(lists.items)));
}

// ---- connectivity ----

void add_connectivity(nb::module_& module) {
    module.def("half_edges", [](std::size_t points, const TrianglesArgument& given) {
        const std::vector<Triangle> triangles = cells_of<Triangle, 3>(given);
        return owning_array<std::uint32_t>(unlocked([&] { return half_edges(points, triangles); }));
    });
    module.def("neighbours", [](const IndicesArgument& twins) {
        return owning_array<std::uint32_t>(unlocked([&] { return neighbours(indices_of(twins)); }));
    });
    module.def("half_edges_at_points",
               [](std::size_t points, const TrianglesArgument& given, const IndicesArgument& twins) {
                   const std::vector<Triangle> triangles = cells_of<Triangle, 3>(given);
                   return lists(unlocked([&] { return half_edges_at_points(points, triangles, indices_of(twins)); }));
               });
    module.def("boundary_loops", [](const IndicesArgument& twins) {
        return lists(unlocked([&] { return boundary_loops(indices_of(twins)); }));
    });
}

// ---- queries ----

/// Returns (triangles, corners), both -1 where there are none: outside, and off the corners.
nb::tuple locate(const TriangulationIndex& index, const PointsArgument& given) {
    const std::vector<Point> queries = points_of(given);
    const std::vector<PointLocation> found = unlocked([&] { return index.locate(queries); });
    std::vector<std::int64_t> triangles(found.size(), -1);
    std::vector<std::int8_t> corners(found.size(), -1);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].place != PointPlace::outside) triangles[i] = found[i].triangle.value;
        if (found[i].place == PointPlace::on_vertex) corners[i] = static_cast<std::int8_t>(found[i].corner);
    }
    return nb::make_tuple(owning_array<std::int64_t>(std::move(triangles)),
                          owning_array<std::int8_t>(std::move(corners)));
}

void add_queries(nb::module_& module) {
    nb::class_<TriangulationIndex>(module, "TriangulationIndex")
        .def("__init__",
             [](TriangulationIndex* self, const PointsArgument& points, const TrianglesArgument& triangles) {
                 new (self) TriangulationIndex(points_of(points), cells_of<Triangle, 3>(triangles));
             })
        .def("locate", &locate)
        .def("nearest",
             [](const TriangulationIndex& index, const PointsArgument& given) {
                 const std::vector<Point> queries = points_of(given);
                 return owning_array<std::uint32_t>(unlocked([&] { return index.nearest_vertices(queries); }));
             })
        .def("linear",
             [](const TriangulationIndex& index, const ValuesArgument& values, const PointsArgument& given) {
                 const std::vector<Point> queries = points_of(given);
                 return owning_array<double>(
                     unlocked([&] { return index.interpolate_linear(values_of(values), queries); }));
             })
        .def("sibson",
             [](const TriangulationIndex& index, const ValuesArgument& values, const PointsArgument& given) {
                 const std::vector<Point> queries = points_of(given);
                 return owning_array<double>(
                     unlocked([&] { return index.interpolate_sibson(values_of(values), queries); }));
             })
        .def("natural_neighbours",
             [](const TriangulationIndex& index, double x, double y) {
                 NaturalNeighbours found = index.natural_neighbours({x, y});
                 return nb::make_tuple(owning_array<std::uint32_t>(std::move(found.vertices)),
                                       owning_array<double>(std::move(found.weights)));
             })
        .def("is_delaunay", &TriangulationIndex::is_delaunay);
}

// ---- Voronoi diagrams ----

void add_voronoi(nb::module_& module) {
    module.def("voronoi_diagram", [](const PointsArgument& given, const TrianglesArgument& given_triangles) {
        const std::vector<Point> points = points_of(given);
        const std::vector<Triangle> triangles = cells_of<Triangle, 3>(given_triangles);
        VoronoiDiagram diagram = unlocked([&] { return voronoi_diagram(points, triangles); });
        std::vector<std::array<std::uint32_t, 3>> rays;
        std::vector<Point> directions;
        for (const VoronoiRay& ray : diagram.rays) {
            rays.push_back({ray.a.value, ray.b.value, ray.triangle.value});
            directions.push_back(ray.direction);
        }
        return nb::make_tuple(owning_array<double>(std::move(diagram.corners)), lists(std::move(diagram.cells)),
                              owning_array<std::uint32_t>(std::move(rays)),
                              owning_array<double>(std::move(directions)));
    });
    module.def("clipped_voronoi_cells", [](const PointsArgument& given, const TrianglesArgument& given_triangles,
                                           const PointsArgument& given_polygon) {
        const std::vector<Point> points = points_of(given), polygon = points_of(given_polygon);
        const std::vector<Triangle> triangles = cells_of<Triangle, 3>(given_triangles);
        VoronoiCells cells = unlocked([&] { return clipped_voronoi_cells(points, triangles, polygon); });
        return nb::make_tuple(owning_array<std::uint32_t>(std::move(cells.starts)),
                              owning_array<double>(std::move(cells.corners)));
    });
}

// ---- triangulations that change ----

void add_dynamic(nb::module_& module) {
    using Dynamic = DynamicTriangulation;
    nb::class_<Dynamic>(module, "DynamicTriangulation")
        .def(nb::init<>())
        .def("insert",
             [](Dynamic& t, const PointsArgument& given) {
                 const std::vector<Point> points = points_of(given);
                 return owning_array<std::uint32_t>(t.insert(points));
             })
        .def("remove",
             [](Dynamic& t, const IndicesArgument& given) {
                 std::vector<VertexId> numbers;
                 for (const std::uint32_t i : indices_of(given)) numbers.push_back(VertexId{i});
                 t.remove(numbers);
             })
        .def("insert_segment",
             [](Dynamic& t, std::uint32_t a, std::uint32_t b) {
                 return owning_array<std::uint32_t>(t.insert(Segment{VertexId{a}, VertexId{b}}));
             })
        .def("remove_segment",
             [](Dynamic& t, std::uint32_t a, std::uint32_t b) {
                 t.remove(Segment{VertexId{a}, VertexId{b}});
             })
        .def("points",
             [](const Dynamic& t) {
                 return owning_array<double>(std::vector<Point>(t.points().begin(), t.points().end()));
             })
        .def("triangles", [](const Dynamic& t) { return owning_array<std::uint32_t>(t.triangles()); })
        .def("segments", [](const Dynamic& t) { return owning_array<std::uint32_t>(t.segments()); })
        .def("size", &Dynamic::size)
        .def("contains", [](const Dynamic& t, std::uint32_t i) { return t.contains(VertexId{i}); })
        .def("find", [](const Dynamic& t, double x, double y) -> std::optional<std::uint32_t> {
            const std::optional<VertexId> found = t.find({x, y});
            if (!found) return std::nullopt;
            return found->value;
        });
}

}  // namespace

void add_triangulation_queries(nb::module_& module) {
    add_connectivity(module);
    add_queries(module);
    add_voronoi(module);
    add_dynamic(module);
}

}  // namespace lamina::python
