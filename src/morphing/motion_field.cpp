#include "morphing/motion_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "morphing/complex.hpp"

namespace lamina::morphing {

namespace {

constexpr std::uint32_t not_free = no_ray;

/// Returns, per vertex, whether it may slide: whether all boundary edges at it are pieces of one horizontal line of
/// symmetry.
std::vector<bool> sliding_vertices(const Mesh& mesh) {
    std::vector<bool> slides(mesh.points.size(), false), held(mesh.points.size(), false);
    for (const Marker& marker : mesh.markers) {
        if (marker.kind == MarkerKind::internal) continue;
        for (const Segment& edge : marker.edges) {
            const bool along_x = mesh.points[edge.a.index()].y == mesh.points[edge.b.index()].y;
            for (const VertexId v : {edge.a, edge.b})
                (marker.kind == MarkerKind::symmetry && along_x ? slides : held)[v.index()] = true;
        }
    }
    for (std::size_t v = 0; v < held.size(); ++v) slides[v] = slides[v] && !held[v];
    return slides;
}

/// The unknowns: first the vertices that are on no ray and not on the boundary, then those that slide along it.
struct Unknowns {
    std::vector<std::uint32_t> number;  ///< per vertex of the mesh, or not_free
    std::vector<std::uint32_t> vertex;  ///< per unknown
    std::uint32_t inside = 0;           ///< how many of them are not on the boundary
};

Unknowns number_free(const Mesh& mesh, const Rays& rays) {
    const std::vector<bool> on_boundary = boundary_vertices(mesh), slides = sliding_vertices(mesh);
    Unknowns unknowns;
    unknowns.number.assign(on_boundary.size(), not_free);
    const auto add = [&](std::size_t v) {
        unknowns.number[v] = static_cast<std::uint32_t>(unknowns.vertex.size());
        unknowns.vertex.push_back(static_cast<std::uint32_t>(v));
    };
    for (std::size_t v = 0; v < on_boundary.size(); ++v)
        if (rays.of_vertex[v] == no_ray && !on_boundary[v]) add(v);
    unknowns.inside = static_cast<std::uint32_t>(unknowns.vertex.size());
    for (std::size_t v = 0; v < on_boundary.size(); ++v)
        if (rays.of_vertex[v] == no_ray && slides[v]) add(v);
    return unknowns;
}

/// Calls visit(triangle) for the triangles of a mesh, and for the halves of its quads on both sides of that diagonal
/// which leaves the smaller half larger.
template <class Visit>
void for_each_triangle(const Mesh& mesh, Visit&& visit) {
    for (const Triangle& triangle : mesh.triangles) visit(triangle);
    const auto area = [&](VertexId a, VertexId b, VertexId c) {
        const Point p = mesh.points[a.index()];
        return cross(mesh.points[b.index()] - p, mesh.points[c.index()] - p);
    };
    for (const Quad& quad : mesh.quads) {
        const auto [a, b, c, d] = quad.v;
        if (std::min(area(a, b, c), area(a, c, d)) >= std::min(area(a, b, d), area(b, c, d))) {
            visit(Triangle{{a, b, c}});
            visit(Triangle{{a, c, d}});
        } else {
            visit(Triangle{{a, b, d}});
            visit(Triangle{{b, c, d}});
        }
    }
}

}  // namespace

MotionField::MotionField(const Mesh& mesh, const Rays& rays, std::span<const Point> wall) {
    if (!wall.empty()) origin_ = core::bounding_box(wall).center();
    for (const Ray& ray : rays.rays) {
        wall_.push_back(wall[ray.wall] - origin_);
        kept_.push_back(wall_.back() + ray.kept);
    }
    const Unknowns unknowns = number_free(mesh, rays);
    const std::vector<std::uint32_t>& number = unknowns.number;
    vertex_ = unknowns.vertex;
    inside_ = unknowns.inside;
    for (const std::uint32_t v : vertex_) from_origin_.push_back(mesh.points[v] - origin_);
    std::vector<Entry> entries;
    std::vector<double> diagonal(vertex_.size(), 0);
    // Half the cotangent of the angle at c couples a and b, times the stiffness of the triangle.
    const auto couple = [&](VertexId a, VertexId b, VertexId c) {
        const Point p = mesh.points[c.index()], to_a = mesh.points[a.index()] - p, to_b = mesh.points[b.index()] - p;
        const double twice_area = cross(to_a, to_b);
        if (!(twice_area > 0)) throw MeshError("a triangle is too flat for a field to be found on it", p);
        const double value = 0.5 * dot(to_a, to_b) / (twice_area * std::sqrt(twice_area));
        const std::array ends{a.index(), b.index()};
        for (std::size_t k = 0; k < 2; ++k) {
            const std::uint32_t here = number[ends[k]];
            if (here == not_free) continue;
            diagonal[here] += value;
            const std::size_t other = ends[1 - k];
            if (number[other] != not_free) {
                if (number[other] < here) entries.push_back({here, number[other], -value});
            } else if (rays.of_vertex[other] != no_ray) {
                const Ray& ray = rays.rays[rays.of_vertex[other]];
                const bool stretched = ray.beyond_kept(mesh.points[other] - wall[ray.wall]) != Point{};
                couplings_.push_back({here, rays.of_vertex[other], stretched, value});
            }
        }
    };
    for_each_triangle(mesh, [&](const Triangle& t) {
        couple(t.v[0], t.v[1], t.v[2]);
        couple(t.v[1], t.v[2], t.v[0]);
        couple(t.v[2], t.v[0], t.v[1]);
    });
    for (std::uint32_t i = 0; i < diagonal.size(); ++i) entries.push_back({i, i, diagonal[i]});
    if (vertex_.size() > inside_) along_ = SymmetricSystem(vertex_.size(), entries);
    std::erase_if(entries, [&](const Entry& entry) { return entry.row >= inside_; });
    system_ = SymmetricSystem(inside_, std::move(entries));
}

std::vector<Row> MotionField::solve(std::span<const Row> right) const {
    constexpr std::size_t shift_x = 2;  // of a row
    std::vector<Row> solution = system_.solve(right.first(inside_));
    if (right.size() == inside_) return solution;
    solution.resize(right.size(), Row{});
    const std::vector<Row> along = along_.solve(right);
    for (std::size_t i = 0; i < right.size(); ++i) solution[i][shift_x] = along[i][shift_x];
    return solution;
}

Row MotionField::row_of(const Motion& motion, const Coupling& coupling) const {
    const Point stretch = coupling.stretched ? motion.stretch : Point{};
    const Point turn = motion.turn + stretch;
    const Point shift =
        motion.shift - product(motion.turn, wall_[coupling.ray]) - product(stretch, kept_[coupling.ray]);
    return {turn.x, turn.y, shift.x, shift.y};
}

void MotionField::displace(std::span<const Motion> motions, std::span<Point> displacement) const {
    std::vector<Row> right(vertex_.size(), Row{});
    for (const Coupling& coupling : couplings_) {
        const Row row = row_of(motions[coupling.ray], coupling);
        for (std::size_t k = 0; k < 4; ++k) right[coupling.free][k] += coupling.value * row[k];
    }
    const std::vector<Row> field = solve(right);
    for (std::size_t i = 0; i < vertex_.size(); ++i)
        displacement[vertex_[i]] =
            product({field[i][0], field[i][1]}, from_origin_[i]) + Point{field[i][2], field[i][3]};
}

void MotionField::add_gradient(std::span<const Point> by_displacement, std::span<Motion> by_motion) const {
    std::vector<Row> by_field;
    for (std::size_t i = 0; i < vertex_.size(); ++i) {
        const Point by_shift = by_displacement[vertex_[i]], by_turn = product(by_shift, conjugate(from_origin_[i]));
        by_field.push_back({by_turn.x, by_turn.y, by_shift.x, by_shift.y});
    }
    const std::vector<Row> by_right = solve(by_field);
    for (const auto& [free, ray, stretched, value] : couplings_) {
        const Row& row = by_right[free];
        const Point by_turn{row[0], row[1]}, by_shift{row[2], row[3]};
        Motion& motion = by_motion[ray];
        motion.turn = motion.turn + value * (by_turn - product(by_shift, conjugate(wall_[ray])));
        motion.shift = motion.shift + value * by_shift;
        if (stretched) motion.stretch = motion.stretch + value * (by_turn - product(by_shift, conjugate(kept_[ray])));
    }
}

}  // namespace lamina::morphing
