// Where the wall vertices of a mesh are on other shapes.
#include <lamina/morph.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/reproducible_math.hpp"
#include "geometry/element_names.hpp"
#include "geometry/sharp_corner.hpp"
#include "morphing/arc_curve.hpp"
#include "morphing/bodies.hpp"
#include "surface/corners.hpp"
#include "surface/smooth_run.hpp"

namespace lamina::morphing {

namespace {

void require_bodies(std::size_t in_mesh, std::size_t given) {
    if (in_mesh != given)
        throw InputError({}, fmt::format("{} bodies for the {} of the mesh: give one shape for each", given, in_mesh));
}

/// Corners of an outline, ascending, and which of them are sharp: trailing edges and corners of bases. The others are
/// kinks.
struct Corners {
    std::vector<std::size_t> vertices;
    std::vector<bool> sharp;
};

Corners corners_of(std::span<const Point> outline) {
    const std::vector<double> turning = surface::turning_angles(outline);
    Corners corners{surface::find_corners(outline), {}};
    for (const std::size_t c : corners.vertices)
        corners.sharp.push_back(core::degrees(turning[c]) > geometry::sharp_corner_deg);
    return corners;
}

/// Returns the sharp corners; the rearmost vertex stands for them where there are none.
Corners sharp_or_tail(std::span<const Point> outline, const Corners& corners) {
    Corners sharp;
    for (std::size_t k = 0; k < corners.vertices.size(); ++k)
        if (corners.sharp[k]) sharp.vertices.push_back(corners.vertices[k]);
    if (sharp.vertices.empty()) {
        const auto tail = std::max_element(outline.begin(), outline.end(), [](Point a, Point b) { return a.x < b.x; });
        sharp.vertices.push_back(static_cast<std::size_t>(tail - outline.begin()));
    }
    sharp.sharp.assign(sharp.vertices.size(), true);
    return sharp;
}

/// Returns the corners of the shape in such an order that sharp ones meet sharp ones, and that they are nearest to
/// those of the body, both seen from the middles of their boxes. It is empty where there is no such order.
std::vector<std::size_t> matching_corners(std::span<const Point> body, const Corners& of_body,
                                          std::span<const Point> shape, const Corners& of_shape) {
    const std::size_t n = of_shape.vertices.size();
    if (of_body.vertices.size() != n) return {};
    const Point apart = core::bounding_box(shape).center() - core::bounding_box(body).center();
    std::vector<std::size_t> best;
    double least = HUGE_VAL;
    for (std::size_t turn = 0; turn < n; ++turn) {
        std::vector<std::size_t> order;
        double sum = 0;
        bool alike = true;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t j = (i + turn) % n;
            order.push_back(of_shape.vertices[j]);
            alike = alike && of_shape.sharp[j] == of_body.sharp[i];
            sum += squared_length(shape[order.back()] - body[of_body.vertices[i]] - apart);
        }
        if (alike && sum < least) std::tie(least, best) = std::pair(sum, order);
    }
    return best;
}

/// Corners of a body, and those of a shape that they come to stand on.
struct Pairing {
    std::vector<std::size_t> of_body, of_shape;
};

/// Pairs all corners, or the sharp ones alone where the kinks are others: coarse coordinates have kinks, too. It is
/// empty where sharp corners appear or vanish.
Pairing pair_corners(std::span<const Point> body, const Corners& of_body, std::span<const Point> shape,
                     const Corners& of_shape) {
    if (std::vector<std::size_t> all = matching_corners(body, of_body, shape, of_shape); !all.empty())
        return {of_body.vertices, std::move(all)};
    const Corners sharp = sharp_or_tail(body, of_body);
    return {sharp.vertices, matching_corners(body, sharp, shape, sharp_or_tail(shape, of_shape))};
}

/// A closed outline by its arc length, on splines between its corners.
class ClosedCurve {
public:
    /// The arc begins at a vertex.
    ClosedCurve(std::span<const Point> outline, std::span<const std::size_t> corners, std::size_t begin)
        : begin_(begin), size_(outline.size()) {
        std::vector<Point> points(outline.begin(), outline.end());
        std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(begin), points.end());
        std::vector<std::size_t> cuts{0};
        for (const std::size_t c : corners)
            if (c != begin) cuts.push_back(place(c));
        std::sort(cuts.begin(), cuts.end());
        for (const surface::SmoothRun& run : surface::split_at_corners(points, cuts)) {
            const double before = starts_.empty() ? 0 : starts_.back() + curves_.back().length();
            starts_.push_back(before);
            curves_.emplace_back(run);
            const std::vector<double>& arc = curves_.back().arc_lengths();
            for (std::size_t i = 0; i + 1 < arc.size(); ++i) arc_.push_back(before + arc[i]);
        }
        arc_.push_back(starts_.back() + curves_.back().length());
    }

    /// Returns the arc length up to a vertex.
    double arc_at(std::size_t vertex) const { return arc_[place(vertex)]; }
    double length() const { return arc_.back(); }
    Point at(double arc) const {
        const auto above = std::upper_bound(starts_.begin() + 1, starts_.end(), arc);
        const auto k = static_cast<std::size_t>(above - starts_.begin() - 1);
        return curves_[k].at(arc - starts_[k]);
    }

private:
    std::size_t begin_, size_;
    std::vector<ArcCurve> curves_;
    std::vector<double> starts_;  ///< arc length where each of them begins
    std::vector<double> arc_;     ///< up to each vertex, and of the whole

    std::size_t place(std::size_t vertex) const { return (vertex + size_ - begin_) % size_; }
};

std::size_t count_of_sharp(const Corners& corners) {
    return static_cast<std::size_t>(std::count(corners.sharp.begin(), corners.sharp.end(), true));
}

/// Returns the index of the value that is nearest to one, the first of several.
std::size_t nearest_in(std::span<const double> values, double one) {
    const auto nearer = [one](double a, double b) { return std::abs(a - one) < std::abs(b - one); };
    return static_cast<std::size_t>(std::min_element(values.begin(), values.end(), nearer) - values.begin());
}

/// Returns the vertices of a body on an element: between paired corners they divide the arc length as they do on the
/// body, but for the nearest one to each kink that has no partner, which comes to stand there.
std::vector<Point> points_on(const Element& element, std::span<const Point> body, const std::string& name) {
    const std::span<const Point> shape = element.points;
    const Corners of_body = corners_of(body), of_shape = corners_of(shape);
    const auto [from, onto] = pair_corners(body, of_body, shape, of_shape);
    if (onto.empty())
        throw InputError({.file = element.file, .element = name},
                         fmt::format("sharp corners appear or vanish: the shape has {}, and '{}' of the mesh has {}",
                                     count_of_sharp(of_shape), name, count_of_sharp(of_body)));
    const ClosedCurve mesh_curve(body, of_body.vertices, from.front());
    const ClosedCurve shape_curve(shape, of_shape.vertices, onto.front());
    std::vector<Point> points(body.size());
    std::vector<double> arcs(body.size(), -HUGE_VAL);  // of the vertices that no corner holds
    for (std::size_t k = 0; k < from.size(); ++k) {
        const bool last = k + 1 == from.size();
        const double a = mesh_curve.arc_at(from[k]), c = shape_curve.arc_at(onto[k]);
        const double b = last ? mesh_curve.length() : mesh_curve.arc_at(from[k + 1]);
        const double d = last ? shape_curve.length() : shape_curve.arc_at(onto[k + 1]);
        const std::size_t end = from[(k + 1) % from.size()];
        points[from[k]] = shape[onto[k]];
        for (std::size_t i = (from[k] + 1) % body.size(); i != end; i = (i + 1) % body.size()) {
            arcs[i] = c + (mesh_curve.arc_at(i) - a) / (b - a) * (d - c);
            points[i] = shape_curve.at(arcs[i]);
        }
    }
    for (const std::size_t kink : of_shape.vertices)
        if (std::find(onto.begin(), onto.end(), kink) == onto.end())
            points[nearest_in(arcs, shape_curve.arc_at(kink))] = shape[kink];
    return points;
}

/// Puts the points of each body at their places among those of all wall vertices.
void put(std::span<const Point> points, const Body& body, std::vector<Point>& wall) {
    std::copy(points.begin(), points.end(), wall.begin() + static_cast<std::ptrdiff_t>(body.first));
}

}  // namespace

}  // namespace lamina::morphing

namespace lamina {

using namespace morphing;

std::vector<Point> wall_points_on(const MorphMap& map, const Geometry& shape) {
    const std::vector<Body> bodies = closed_bodies(map);
    require_bodies(bodies.size(), shape.elements.size());
    std::vector<Point> wall = map.wall_points();
    const Geometry reference = as_geometry(bodies, wall);
    for (std::size_t b = 0; b < bodies.size(); ++b)
        put(points_on(shape.elements[b], reference.elements[b].points, bodies[b].name), bodies[b], wall);
    return wall;
}

std::vector<Point> moved_wall_points(const MorphMap& map, std::span<const Transformation> changes) {
    const std::vector<Body> bodies = closed_bodies(map);
    std::vector<Point> wall = map.wall_points();
    const Geometry reference = as_geometry(bodies, wall), geometry = transformed(reference, changes);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const Element& element = geometry.elements[b];
        const bool deflected = std::any_of(changes.begin(), changes.end(), [&](const Transformation& change) {
            return std::holds_alternative<FlapDeflection>(change.change) &&
                   geometry::stands_for(change.element, element);
        });
        // A flap takes points of the wall and adds some.
        put(deflected ? points_on(element, reference.elements[b].points, bodies[b].name) : element.points, bodies[b],
            wall);
    }
    return wall;
}

}  // namespace lamina
