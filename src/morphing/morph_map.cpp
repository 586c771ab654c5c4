#include <lamina/morph.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <lamina/error.hpp>

#include "core/text.hpp"
#include "morphing/bodies.hpp"
#include "morphing/complex.hpp"
#include "morphing/motion_field.hpp"
#include "morphing/rays.hpp"
#include "morphing/wall_motion.hpp"

namespace lamina {

using namespace morphing;

struct MorphMap::Parts {
    const Mesh& mesh;
    WallVertices walls;
    std::vector<Point> wall;  ///< the wall vertices
    std::vector<Segment> edges;
    Rays rays;
    WallTurns turns;
    MotionField field;

    explicit Parts(const Mesh& reference)
        : mesh(reference),
          walls(wall_vertices(reference)),
          wall(points_of_walls()),
          edges(edges_of_walls(reference, walls)),
          rays(find_rays(reference, walls, edges)),
          turns(wall, edges, rays.rays),
          field(reference, rays, wall) {}

    /// Returns a vertex on a ray, as seen from the ray's wall vertex.
    Point from_wall(std::size_t v) const { return mesh.points[v] - wall[rays.rays[rays.of_vertex[v]].wall]; }

    /// Returns by how much it is beyond the vertices of its ray that keep their heights.
    Point beyond_kept(std::size_t v) const { return rays.rays[rays.of_vertex[v]].beyond_kept(from_wall(v)); }

    /// Returns the displacement of all vertices by these motions of the rays, which it is linear in.
    std::vector<Point> displacements(std::span<const Motion> motions) const {
        std::vector<Point> displacement(mesh.points.size(), Point{});
        for (std::size_t v = 0; v < displacement.size(); ++v) {
            if (rays.of_vertex[v] == no_ray) continue;
            const Motion& motion = motions[rays.of_vertex[v]];
            displacement[v] =
                product(motion.turn, from_wall(v)) + motion.shift + product(motion.stretch, beyond_kept(v));
        }
        field.displace(motions, displacement);
        return displacement;
    }

private:
    std::vector<Point> points_of_walls() const {
        std::vector<Point> points;
        for (const VertexId v : walls.vertex) points.push_back(mesh.points[v.index()]);
        return points;
    }
};

namespace morphing {

namespace {

/// Throws InputError unless there are as many points as vertices of this kind.
void require_points(std::size_t given, std::size_t needed, const char* kind) {
    if (given != needed)
        throw InputError({}, core::concat(given, " points for the ", needed, " ", kind, " vertices of the mesh"));
}

}  // namespace

}  // namespace morphing

MorphMap::MorphMap(const Mesh& reference) : parts_(std::make_unique<Parts>(reference)) {}
MorphMap::MorphMap(MorphMap&&) noexcept = default;
MorphMap& MorphMap::operator=(MorphMap&&) noexcept = default;
MorphMap::~MorphMap() = default;

const Mesh& MorphMap::reference() const { return parts_->mesh; }
const WallVertices& MorphMap::walls() const { return parts_->walls; }
const std::vector<Point>& MorphMap::wall_points() const { return parts_->wall; }

std::vector<Point> MorphMap::positions(std::span<const Point> wall) const {
    require_points(wall.size(), parts_->wall.size(), "wall");
    std::vector<Point> points = parts_->mesh.points;
    const std::vector<Point> displacement = parts_->displacements(parts_->turns.motions(wall));
    for (std::size_t v = 0; v < points.size(); ++v)
        if (displacement[v] != Point{}) points[v] = points[v] + displacement[v];  // -0 stays -0
    for (std::size_t i = 0; i < wall.size(); ++i) points[parts_->walls.vertex[i].index()] = wall[i];
    return points;
}

std::vector<Point> MorphMap::jacobian_vector(std::span<const Point> wall, std::span<const Point> direction) const {
    for (const std::size_t given : {wall.size(), direction.size()}) require_points(given, parts_->wall.size(), "wall");
    return parts_->displacements(parts_->turns.derivative(wall, direction));
}

std::vector<Point> MorphMap::vector_jacobian(std::span<const Point> wall, std::span<const Point> gradient) const {
    require_points(wall.size(), parts_->wall.size(), "wall");
    require_points(gradient.size(), parts_->mesh.points.size(), "moved");
    std::vector<Motion> by_motion(parts_->rays.rays.size(), Motion{});
    for (std::size_t v = 0; v < gradient.size(); ++v) {
        if (parts_->rays.of_vertex[v] == no_ray) continue;
        Motion& motion = by_motion[parts_->rays.of_vertex[v]];
        motion.turn = motion.turn + product(gradient[v], conjugate(parts_->from_wall(v)));
        motion.shift = motion.shift + gradient[v];
        motion.stretch = motion.stretch + product(gradient[v], conjugate(parts_->beyond_kept(v)));
    }
    parts_->field.add_gradient(gradient, by_motion);
    return parts_->turns.gradient(wall, by_motion);
}

}  // namespace lamina
