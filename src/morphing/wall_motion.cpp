#include "morphing/wall_motion.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "morphing/complex.hpp"

namespace lamina::morphing {

namespace {

constexpr std::uint32_t no_wall_edge = std::numeric_limits<std::uint32_t>::max();

/// Returns the derivative of unit(a) in a direction. As a matrix it is symmetric, so that it also makes the gradient by a
/// of a function from its gradient by unit(a).
Point unit_derivative(Point a, Point direction) {
    const Point u = unit(a);
    return (1 / length(a)) * (direction - dot(u, direction) * u);
}

}  // namespace

WallTurns::WallTurns(std::vector<Point> wall, std::vector<Segment> edges, std::vector<Ray> rays,
                     std::span<const double> reach)
    : wall_(std::move(wall)), edges_(std::move(edges)), rays_(std::move(rays)) {
    find_edges_beside_vertices();
    std::vector<Entry> entries;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        length_.push_back(length(vector_of(e, wall_)));
        const auto row = static_cast<std::uint32_t>(e);
        entries.push_back({row, row, length_[e]});
    }
    for (std::size_t v = 0; v < wall_.size(); ++v) {
        const std::uint32_t before = before_[v], after = after_[v];
        if (before == after) continue;
        const double apart = 0.5 * (length_[before] + length_[after]);
        const double cosine =
            dot(vector_of(before, wall_), vector_of(after, wall_)) / (length_[before] * length_[after]);
        const double stiffness = std::max(0.0, cosine) * reach[v] * reach[v] / apart;
        for (const std::uint32_t e : {before, after}) entries.push_back({e, e, stiffness});
        entries.push_back({std::max(before, after), std::min(before, after), -stiffness});
    }
    smoothing_ = SymmetricSystem(edges_.size(), entries);
}

void WallTurns::find_edges_beside_vertices() {
    before_.assign(wall_.size(), no_wall_edge);
    after_ = before_;
    for (std::size_t e = 0; e < edges_.size(); ++e)
        after_[edges_[e].a.index()] = before_[edges_[e].b.index()] = static_cast<std::uint32_t>(e);
    for (std::size_t v = 0; v < wall_.size(); ++v) {
        if (before_[v] == no_wall_edge) before_[v] = after_[v];
        if (after_[v] == no_wall_edge) after_[v] = before_[v];
    }
}

Point WallTurns::vector_of(std::size_t edge, std::span<const Point> points) const {
    return points[edges_[edge].b.index()] - points[edges_[edge].a.index()];
}

Point WallTurns::change_of(std::size_t edge, std::span<const Point> moved) const {
    return product(vector_of(edge, moved), conjugate(vector_of(edge, wall_)));
}

std::vector<Point> WallTurns::smoothed(std::span<const Point> of_edges) const {
    std::vector<Row> right;
    for (std::size_t e = 0; e < of_edges.size(); ++e)
        right.push_back({length_[e] * of_edges[e].x, length_[e] * of_edges[e].y, 0, 0});
    std::vector<Point> smooth;
    for (const Row& row : smoothing_.solve(right)) smooth.push_back({row[0], row[1]});
    return smooth;
}

std::vector<Point> WallTurns::smoothed_turns(std::span<const Point> moved) const {
    std::vector<Point> turns;
    for (std::size_t e = 0; e < edges_.size(); ++e) turns.push_back(unit(change_of(e, moved)));
    return smoothed(turns);
}

Point WallTurns::at_ray(const Ray& ray, std::span<const Point> of_edges) const {
    return (1 - ray.share) * of_edges[before_[ray.wall]] + ray.share * of_edges[after_[ray.wall]];
}

std::vector<Motion> WallTurns::motions(std::span<const Point> moved) const {
    assert(moved.size() == wall_.size());
    const std::vector<Point> turns = smoothed_turns(moved);
    std::vector<Motion> motions;
    for (const Ray& ray : rays_)
        motions.push_back({unit(at_ray(ray, turns)) - Point{1, 0}, moved[ray.wall] - wall_[ray.wall]});
    return motions;
}

std::vector<Motion> WallTurns::derivative(std::span<const Point> moved, std::span<const Point> direction) const {
    assert(moved.size() == wall_.size() && direction.size() == wall_.size());
    std::vector<Point> of_turns;
    for (std::size_t e = 0; e < edges_.size(); ++e)
        of_turns.push_back(
            unit_derivative(change_of(e, moved), product(vector_of(e, direction), conjugate(vector_of(e, wall_)))));
    of_turns = smoothed(of_turns);
    const std::vector<Point> turns = smoothed_turns(moved);
    std::vector<Motion> motions;
    for (const Ray& ray : rays_)
        motions.push_back({unit_derivative(at_ray(ray, turns), at_ray(ray, of_turns)), direction[ray.wall]});
    return motions;
}

std::vector<Point> WallTurns::gradient(std::span<const Point> moved, std::span<const Motion> by_motion) const {
    assert(moved.size() == wall_.size() && by_motion.size() == rays_.size());
    const std::vector<Point> turns = smoothed_turns(moved);
    std::vector<Point> gradient(wall_.size(), Point{}), by_turn(edges_.size(), Point{});
    for (std::size_t r = 0; r < rays_.size(); ++r) {
        const Ray& ray = rays_[r];
        gradient[ray.wall] = gradient[ray.wall] + by_motion[r].shift;
        const Point by_mean = unit_derivative(at_ray(ray, turns), by_motion[r].turn);
        Point &before = by_turn[before_[ray.wall]], &after = by_turn[after_[ray.wall]];
        before = before + (1 - ray.share) * by_mean;
        after = after + ray.share * by_mean;
    }
    // smoothed() is the inverse of a symmetric matrix times the lengths: its adjoint is the lengths times the inverse.
    std::vector<Row> right;
    for (const Point by : by_turn) right.push_back({by.x, by.y, 0, 0});
    const std::vector<Row> by_right = smoothing_.solve(right);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const Point by_unit = length_[e] * Point{by_right[e][0], by_right[e][1]};
        const Point by_edge = product(unit_derivative(change_of(e, moved), by_unit), vector_of(e, wall_));
        Point &a = gradient[edges_[e].a.index()], &b = gradient[edges_[e].b.index()];
        b = b + by_edge;
        a = a - by_edge;
    }
    return gradient;
}

}  // namespace lamina::morphing
