// Stage "assemble": the layer and the refined subdomains become one mesh.
#include <algorithm>
#include <cassert>
#include <utility>

#include <lamina/pipeline.hpp>

#include "core/marker_names.hpp"
#include "core/parallel.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/sharing/piece_streamer.hpp"

namespace lamina::pipeline {

namespace {

/// Takes the edges of the base out of the edges of an element's wall, and returns them. Edge i of the wall joins the
/// vertices i and i + 1 of the counter-clockwise outline, and runs from the latter to the former.
std::vector<Segment> take_base(const Element& element, std::span<const Point> points, std::vector<Segment>& wall) {
    const auto edge_at = [&](std::size_t corner) {
        const auto found = std::find_if(wall.begin(), wall.end(), [&](const Segment& edge) {
            return points[edge.b.index()] == element.points[corner];
        });
        return static_cast<std::size_t>(found - wall.begin());
    };
    // The base of a body that a line of symmetry cuts begins on that line.
    const std::size_t n = wall.size(), first = element.is_mirrored ? 0 : edge_at(element.features.base->first);
    const std::size_t length = (edge_at(element.features.base->last) + n - first) % n;
    assert(first < n && length > 0);
    std::vector<Segment> base, rest;
    for (std::size_t k = 0; k < length; ++k) base.push_back(wall[(first + k) % n]);
    for (std::size_t i = 0; i < n; ++i)
        if ((i + n - first) % n >= length) rest.push_back(wall[i]);
    wall = std::move(rest);
    assert(base.size() + wall.size() == n);
    return base;
}

/// Sorts the edges of the wall of a body that was joined from several by the markers of these. Edges run against the
/// outline, in its order; some of their vertices are no points of the outline.
std::vector<Marker> markers_of_parts(const Element& element, std::span<const Point> points,
                                     std::span<const Segment> wall) {
    const auto begun_at = [&](std::size_t edge) {
        return std::find_if(element.parts.begin(), element.parts.end(),
                            [&](const WallPart& part) { return part.begin == points[wall[edge].b.index()]; });
    };
    std::size_t first = 0;
    while (first < wall.size() && begun_at(first) == element.parts.end()) ++first;
    std::vector<Marker> markers;
    std::string name = element.parts.back().name;
    for (std::size_t k = 0; k < wall.size(); ++k) {
        const std::size_t edge = (first + k) % wall.size();
        if (const auto begun = begun_at(edge); begun != element.parts.end()) name = begun->name;
        auto marker = std::find_if(markers.begin(), markers.end(), [&](const Marker& m) { return m.name == name; });
        if (marker == markers.end()) marker = markers.insert(marker, {name, MarkerKind::wall, {}});
        marker->edges.push_back(wall[edge]);
    }
    return markers;
}

}  // namespace

std::string wanted_base_name(const Element& element) {
    constexpr std::string_view ending = "_base";
    return element.name.substr(0, core::max_marker_name - ending.size()) + std::string(ending);
}

std::vector<std::string> base_marker_names(const Geometry& geometry) {
    std::vector<core::NamedMarker> markers{{std::string(core::far_field_name), MarkerKind::far_field}};
    for (const Element& element : geometry.elements) markers.push_back({element.name, MarkerKind::wall});
    for (const Element& element : geometry.elements)
        for (const WallPart& part : element.parts) markers.push_back({part.name, MarkerKind::wall});
    for (const Element& element : geometry.elements) markers.push_back({wanted_base_name(element), MarkerKind::wall});
    const std::vector<std::string> names = core::legal_marker_names(markers);
    return {names.end() - static_cast<std::ptrdiff_t>(geometry.elements.size()), names.end()};
}

std::vector<Marker> make_markers(const Geometry& geometry, const layers::Layer& layer, std::vector<Segment> far_field,
                                 const AssembleOptions& options) {
    std::vector<Marker> markers;
    const std::vector<std::string> base_names = base_marker_names(geometry);
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const Element& element = geometry.elements[e];
        std::vector<Segment> wall = layer.edges.walls[e], base;
        std::vector<Marker> parts;
        if (!element.parts.empty()) parts = markers_of_parts(element, layer.points, wall);
        if (options.base_marker && element.features.base) base = take_base(element, layer.points, wall);
        if (parts.empty()) parts.push_back({element.name, MarkerKind::wall, std::move(wall)});
        for (Marker& part : parts) {
            std::erase_if(part.edges, [&](Segment s) { return std::find(base.begin(), base.end(), s) != base.end(); });
            if (!part.edges.empty()) markers.push_back(std::move(part));
        }
        if (!base.empty()) markers.push_back({base_names[e], MarkerKind::wall, std::move(base)});
    }
    markers.push_back({std::string(core::far_field_name), MarkerKind::far_field, std::move(far_field)});
    return markers;
}

Mesh layer_mesh(const layers::Layer& layer, const layers::LayerCells& cells) {
    Mesh mesh;
    mesh.points = layer.points;
    mesh.triangles = cells.triangles;
    mesh.quads = cells.quads;
    mesh.layer = cells.triangle_layer;
    mesh.layer.insert(mesh.layer.end(), cells.quad_layer.begin(), cells.quad_layer.end());
    mesh.region.assign(mesh.triangles.size() + mesh.quads.size(), Region::layer);
    return mesh;
}

Mesh assemble(const Geometry& geometry, const layers::Layer& layer, const layers::LayerCells& cells,
              decoupling::Decoupling decoupling, std::vector<Refinement> refinements, const AssembleOptions& options) {
    Mesh mesh;
    MeshTaker taker(decoupling, mesh);
    PieceStreamer streamer(decoupling, taker, false);
    streamer.start(cells);
    core::parallel_for(refinements.size(), 1,
                       [&](std::size_t i, std::size_t) { streamer.take(i, std::move(refinements[i])); });
    mesh.markers = make_markers(geometry, layer, std::move(decoupling.far_field), options);
    mesh.constraints = layer.edges.interfaces;
    streamer.finish(mesh.markers);
    return mesh;
}

}  // namespace lamina::pipeline
