#include "plot/view.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/bounding_box.hpp"

namespace lamina::plot {

PictureView make_view(const Mesh& mesh, const PlotOptions& options) {
    PictureView view;
    if (options.window) {
        const auto [x0, x1, y0, y1] = *options.window;
        view.window = {{x0, y0}, {x1, y1}};
    } else {
        for (const Point p : mesh.points) view.window.include(p);
        if (mesh.points.empty()) view.window = {{0, 0}, {1, 1}};
        const double margin = 0.01 * core::longer_side(view.window);
        view.window.lower = view.window.lower - Point{margin, margin};
        view.window.upper = view.window.upper + Point{margin, margin};
    }
    const double longer = core::longer_side(view.window);
    view.scale = options.width_px / longer;
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

std::vector<VisibleCell> visible_cells(const Mesh& mesh, const Box& window) {
    std::vector<VisibleCell> visible;
    const auto add_if_visible = [&](std::size_t number, const auto& v) {
        VisibleCell cell{number, std::size(v), {}, {}};
        Box box;
        for (std::size_t i = 0; i < cell.corners; ++i) {
            cell.vertex[i] = v[i];
            cell.corner[i] = mesh.points[v[i].index()];
            box.include(cell.corner[i]);
        }
        if (box.overlaps(window)) visible.push_back(cell);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) add_if_visible(t, mesh.triangles[t].v);
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) add_if_visible(mesh.triangles.size() + q, mesh.quads[q].v);
    return visible;
}

}  // namespace lamina::plot
