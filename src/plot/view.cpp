#include "plot/view.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include <lamina/error.hpp>
#include <lamina/places.hpp>

#include "core/bounding_box.hpp"
#include "mesh/curved_nodes.hpp"

namespace lamina::plot {

namespace {

/// Returns the window of the place of this name, or of the first place of this kind.
Box window_of_place(const Mesh& mesh, const std::string& name) {
    std::string known;
    for (const Place& place : named_places(mesh)) {
        if (place.name == name || place.name == name + ":1") return place.window;
        known += (known.empty() ? "" : ", ") + place.name;
    }
    throw UsageError("option --window: there is no place '" + name +
                     "': " + (known.empty() ? "the mesh is empty" : "this mesh has " + known));
}

Box window_of_options(const Mesh& mesh, const PlotOptions& options) {
    if (options.window && !options.window->place.empty()) return window_of_place(mesh, options.window->place);
    if (options.window) {
        const auto [x0, x1, y0, y1] = options.window->box;
        return {{x0, y0}, {x1, y1}};
    }
    if (mesh.points.empty()) return {{0, 0}, {1, 1}};
    Box window = core::bounding_box(mesh.points);
    const double margin = 0.01 * core::longer_side(window);
    return {window.lower - Point{margin, margin}, window.upper + Point{margin, margin}};
}

}  // namespace

double text_height(int width_px) { return std::clamp(width_px / 75.0, 9.0, 60.0); }

PictureView make_view(const Mesh& mesh, const PlotOptions& options) {
    PictureView view;
    view.area = window_of_options(mesh, options);
    // Room for numbers: to the left as wide as a long one, below as high as two lines, else half of a number.
    const double text = options.axes ? text_height(options.width_px) : 0;
    const double left = 5.5 * text, below = 2.2 * text, right = 1.5 * text, above = 0.8 * text;
    view.scale = std::min(std::max(1.0, options.width_px - left - right) / view.area.width(),
                          std::max(1.0, options.width_px - below - above) / view.area.height());
    view.window = {view.area.lower - Point{left / view.scale, below / view.scale},
                   view.area.upper + Point{right / view.scale, above / view.scale}};
    // A very slender window would round to no pixel at all.
    view.width = std::max(1.0, std::round(view.window.width() * view.scale));
    view.height = std::max(1.0, std::round(view.window.height() * view.scale));
    return view;
}

double VisibleCell::area() const {
    return 0.5 * std::abs(corners == 3 ? cross(corner[1] - corner[0], corner[2] - corner[0])
                                       : cross(corner[2] - corner[0], corner[3] - corner[1]));
}

double VisibleCell::thickness() const {
    double longest = 0;
    for (std::size_t i = 0; i < corners; ++i)
        longest = std::max(longest, distance(corner[i], corner[(i + 1) % corners]));
    return longest > 0 ? area() / longest : 0;
}

std::vector<VisibleCell> visible_cells(const Mesh& mesh, const Box& window, const CurvedNodes& nodes) {
    std::vector<VisibleCell> visible;
    const auto add_if_visible = [&](std::size_t number, const auto& v) {
        VisibleCell cell{number, std::size(v), {}, {}};
        Box box;
        for (std::size_t i = 0; i < cell.corners; ++i) {
            cell.vertex[i] = v[i];
            cell.corner[i] = mesh.points[v[i].index()];
            box.include(cell.corner[i]);
        }
        if (nodes.order > 1)
            for (const VertexId node : mesh::inner_nodes(mesh, nodes, number))
                box.include(nodes.points[node.index() - mesh.points.size()]);
        if (box.overlaps(window)) visible.push_back(cell);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) add_if_visible(t, mesh.triangles[t].v);
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) add_if_visible(mesh.triangles.size() + q, mesh.quads[q].v);
    return visible;
}

}  // namespace lamina::plot
