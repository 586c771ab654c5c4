// Size functions on meshes, which find the triangle that holds a point.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_connectivity.hpp>
#include <lamina/delaunay_queries.hpp>
#include <lamina/error.hpp>

#include "core/arguments.hpp"
#include "core/text.hpp"

namespace lamina::delaunay {

namespace {

/// A size for each triangle of a mesh.
struct PiecewiseSizes {
    TriangulationIndex index;
    std::vector<double> sizes;
    std::vector<std::array<double, 3>> at_edges, at_corners;  ///< the smallest of the triangles there

    double operator()(Point p) const {
        const PointLocation at = index.locate(p);
        if (at.place == PointPlace::outside) return HUGE_VAL;
        const std::size_t t = at.triangle.index();
        if (at.place == PointPlace::inside) return sizes[t];
        return at.place == PointPlace::on_edge ? at_edges[t][at.corner] : at_corners[t][at.corner];
    }
};

PiecewiseSizes make_piecewise_sizes(std::span<const Point> points, std::span<const Triangle> triangles,
                                    std::vector<double> sizes) {
    const auto across = neighbours(half_edges(points.size(), triangles));
    std::vector<double> at_points(points.size(), HUGE_VAL);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const VertexId v : triangles[t].v) at_points[v.index()] = std::min(at_points[v.index()], sizes[t]);
    std::vector<std::array<double, 3>> at_edges(triangles.size()), at_corners(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (unsigned e = 0; e < 3; ++e) {
            at_corners[t][e] = at_points[triangles[t].v[e].index()];
            at_edges[t][e] = across[t][e].valid() ? std::min(sizes[t], sizes[across[t][e].index()]) : sizes[t];
        }
    return {TriangulationIndex(points, triangles), std::move(sizes), std::move(at_edges), std::move(at_corners)};
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

SizeFunction sizes_of_mesh(std::span<const Point> points, std::span<const Triangle> triangles,
                           std::span<const double> sizes) {
    core::require_count(sizes.size(), "sizes", points.size(), "points");
    const auto bad = std::find_if(sizes.begin(), sizes.end(), [](double s) { return !(s > 0); });
    if (bad != sizes.end()) {
        const auto i = static_cast<std::size_t>(bad - sizes.begin());
        throw InputError({.at = points[i], .points = {i}}, core::concat("size ", i, " is not positive: ", *bad));
    }
    // Copies of the function share the mesh.
    return [mesh = TriangulationIndex(points, triangles),
            values = std::make_shared<const std::vector<double>>(sizes.begin(), sizes.end())](Point p) {
        const double size = mesh.interpolate_linear(*values, p);
        return std::isnan(size) ? HUGE_VAL : size;
    };
}

SizeFunction sizes_of_areas(std::span<const Point> points, std::span<const Triangle> triangles,
                            std::span<const double> areas, double max_area_ratio) {
    core::require_count(areas.size(), "areas", triangles.size(), "triangles");
    std::vector<double> sizes;
    for (const double area : areas) sizes.push_back(area > 0 ? size_for_area(area, max_area_ratio) : HUGE_VAL);
    return [mesh = std::make_shared<const PiecewiseSizes>(make_piecewise_sizes(points, triangles, std::move(sizes)))](
               Point p) { return (*mesh)(p); };
}

}  // namespace lamina
