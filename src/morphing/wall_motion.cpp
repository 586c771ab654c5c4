#include "morphing/wall_motion.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "morphing/complex.hpp"

namespace lamina::morphing {

namespace {

constexpr std::uint32_t no_wall_edge = std::numeric_limits<std::uint32_t>::max();

/// Along so many heights of the rays turns are smoothed. Of 50 random sections (10 % of the thickness) the worst first
/// height changes by 3 % with 1, by 0.9 % with 1/4 and by 0.2 % with 0, where the slot of a flap that is raised by 5
/// degrees gets a cell that turns over.
constexpr double reach_of_turns = 0.25;

/// Returns the derivative of unit(a) in a direction. As a matrix it is symmetric, so that it also makes the gradient by
/// a of a function from its gradient by unit(a).
Point unit_derivative(Point a, Point direction) {
    const Point u = unit(a);
    return (1 / length(a)) * (direction - dot(u, direction) * u);
}

}  // namespace

WallTurns::WallTurns(std::vector<Point> wall, std::vector<Segment> edges, std::vector<Ray> rays)
    : wall_(std::move(wall)), edges_(std::move(edges)), rays_(std::move(rays)) {
    find_edges_beside_vertices();
    const std::vector<Point> tips = highest_tips();
    gaps_ = find_gaps(wall_, edges_, tips);
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
        const double reach = reach_of_turns * distance(tips[v], wall_[v]);
        const double stiffness = std::max(0.0, cosine) * reach * reach / apart;
        for (const std::uint32_t e : {before, after}) entries.push_back({e, e, stiffness});
        entries.push_back({std::max(before, after), std::min(before, after), -stiffness});
    }
    smoothing_ = SymmetricSystem(edges_.size(), std::move(entries));
}

std::vector<Point> WallTurns::highest_tips() const {
    std::vector<Point> tips = wall_;
    for (const Ray& ray : rays_)
        if (squared_length(ray.tip) > squared_length(tips[ray.wall] - wall_[ray.wall]))
            tips[ray.wall] = wall_[ray.wall] + ray.tip;
    return tips;
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

std::vector<WallTurns::Change> WallTurns::smoothed(std::span<const Change> of_edges) const {
    std::vector<Row> right;
    for (std::size_t e = 0; e < of_edges.size(); ++e)
        right.push_back(
            {length_[e] * of_edges[e].turn.x, length_[e] * of_edges[e].turn.y, length_[e] * of_edges[e].stretch, 0});
    std::vector<Change> smooth;
    for (const Row& row : smoothing_.solve(right)) smooth.push_back({{row[0], row[1]}, row[2]});
    return smooth;
}

std::vector<WallTurns::Change> WallTurns::smoothed_changes(std::span<const Point> moved) const {
    std::vector<double> stretches;
    for (std::size_t v = 0; v < wall_.size(); ++v)
        stretches.push_back(gaps_[v].weight > 0 ? gaps_[v].stretch(length(gaps_[v].vector_from(v, moved))) : 0);
    std::vector<Change> changes;
    for (std::size_t e = 0; e < edges_.size(); ++e)
        changes.push_back(
            {unit(change_of(e, moved)), 0.5 * (stretches[edges_[e].a.index()] + stretches[edges_[e].b.index()])});
    return smoothed(changes);
}

Point WallTurns::stretch_gradient(std::size_t v, std::span<const Point> moved) const {
    const Point across = gaps_[v].vector_from(v, moved);
    return gaps_[v].stretch_derivative(length(across)) * unit(across);
}

WallTurns::Change WallTurns::at_ray(const Ray& ray, std::span<const Change> of_edges) const {
    const Change &before = of_edges[before_[ray.wall]], &after = of_edges[after_[ray.wall]];
    return {(1 - ray.share) * before.turn + ray.share * after.turn,
            (1 - ray.share) * before.stretch + ray.share * after.stretch};
}

std::vector<Motion> WallTurns::motions(std::span<const Point> moved) const {
    assert(moved.size() == wall_.size());
    const std::vector<Change> changes = smoothed_changes(moved);
    std::vector<Motion> motions;
    for (const Ray& ray : rays_) {
        const Change change = at_ray(ray, changes);
        const Point turned = unit(change.turn);
        motions.push_back({turned - Point{1, 0}, moved[ray.wall] - wall_[ray.wall], change.stretch * turned});
    }
    return motions;
}

std::vector<Motion> WallTurns::derivative(std::span<const Point> moved, std::span<const Point> direction) const {
    assert(moved.size() == wall_.size() && direction.size() == wall_.size());
    std::vector<double> of_stretches;
    for (std::size_t v = 0; v < wall_.size(); ++v)
        of_stretches.push_back(gaps_[v].weight > 0 ? dot(stretch_gradient(v, moved), gaps_[v].vector_from(v, direction))
                                                   : 0);
    std::vector<Change> of_edges;
    for (std::size_t e = 0; e < edges_.size(); ++e)
        of_edges.push_back(
            {unit_derivative(change_of(e, moved), product(vector_of(e, direction), conjugate(vector_of(e, wall_)))),
             0.5 * (of_stretches[edges_[e].a.index()] + of_stretches[edges_[e].b.index()])});
    of_edges = smoothed(of_edges);
    const std::vector<Change> changes = smoothed_changes(moved);
    std::vector<Motion> motions;
    for (const Ray& ray : rays_) {
        const Change change = at_ray(ray, changes), of_change = at_ray(ray, of_edges);
        const Point of_turn = unit_derivative(change.turn, of_change.turn);
        motions.push_back(
            {of_turn, direction[ray.wall], of_change.stretch * unit(change.turn) + change.stretch * of_turn});
    }
    return motions;
}

std::vector<Point> WallTurns::gradient(std::span<const Point> moved, std::span<const Motion> by_motion) const {
    assert(moved.size() == wall_.size() && by_motion.size() == rays_.size());
    const std::vector<Change> changes = smoothed_changes(moved);
    std::vector<Point> gradient(wall_.size(), Point{});
    std::vector<Change> by_edge(edges_.size());
    const auto add = [&](std::uint32_t edge, double share, const Change& change) {
        by_edge[edge].turn = by_edge[edge].turn + share * change.turn;
        by_edge[edge].stretch += share * change.stretch;
    };
    for (std::size_t r = 0; r < rays_.size(); ++r) {
        const Ray& ray = rays_[r];
        gradient[ray.wall] = gradient[ray.wall] + by_motion[r].shift;
        const Change change = at_ray(ray, changes);
        const Point by_unit = by_motion[r].turn + change.stretch * by_motion[r].stretch;
        const Change by_change{unit_derivative(change.turn, by_unit), dot(unit(change.turn), by_motion[r].stretch)};
        add(before_[ray.wall], 1 - ray.share, by_change);
        add(after_[ray.wall], ray.share, by_change);
    }
    add_gradient_of_edges(moved, by_edge, gradient);
    return gradient;
}

void WallTurns::add_gradient_of_edges(std::span<const Point> moved, std::span<const Change> by_edge,
                                      std::vector<Point>& gradient) const {
    // smoothed() is the inverse of a symmetric matrix times the lengths: its adjoint is the lengths times the inverse.
    std::vector<Row> right;
    for (const Change& by : by_edge) right.push_back({by.turn.x, by.turn.y, by.stretch, 0});
    const std::vector<Row> by_right = smoothing_.solve(right);
    const auto add = [&](VertexId v, Point by) { gradient[v.index()] = gradient[v.index()] + by; };
    std::vector<double> by_stretch(wall_.size(), 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const auto [a, b] = edges_[e];
        const Point by_unit = length_[e] * Point{by_right[e][0], by_right[e][1]};
        const Point by_vector = product(unit_derivative(change_of(e, moved), by_unit), vector_of(e, wall_));
        add(b, by_vector);
        add(a, -by_vector);
        for (const VertexId v : {a, b}) by_stretch[v.index()] += 0.5 * length_[e] * by_right[e][2];
    }
    for (std::size_t v = 0; v < wall_.size(); ++v) {
        const Gap& gap = gaps_[v];
        if (gap.weight == 0) continue;
        const Point by_vector = by_stretch[v] * stretch_gradient(v, moved);
        add(gap.across.a, (1 - gap.share) * by_vector);
        add(gap.across.b, gap.share * by_vector);
        add(VertexId(v), -by_vector);
    }
}

}  // namespace lamina::morphing
