#include "morphing/rays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "mesh/adjacency.hpp"

namespace lamina::morphing {

namespace {

/// The neighbours of each vertex along the edges of some cells.
class Neighbours {
public:
    Neighbours(const Mesh& mesh, std::span<const Region> region) : first_(mesh.points.size() + 1, 0) {
        const mesh::CellEdges cells(mesh);
        const auto for_each_edge = [&](auto&& visit) {
            for (std::size_t cell = 0; cell < cells.cells(); ++cell) {
                if (region[cell] != Region::layer) continue;
                for (std::size_t i = 0, n = cells.corners(cell); i < n; ++i)
                    visit(cells.corner(cell, i).index(), cells.corner(cell, i + 1 == n ? 0 : i + 1).index());
            }
        };
        for_each_edge([&](std::size_t a, std::size_t b) {
            ++first_[a + 1];
            ++first_[b + 1];
        });
        for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
        vertex_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for_each_edge([&](std::size_t a, std::size_t b) {
            vertex_[next[a]++] = static_cast<std::uint32_t>(b);
            vertex_[next[b]++] = static_cast<std::uint32_t>(a);
        });
    }

    /// Returns them; those along edges of two cells stand there twice.
    std::span<const std::uint32_t> of(std::size_t v) const {
        return std::span(vertex_).subspan(first_[v], first_[v + 1] - first_[v]);
    }

private:
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> vertex_;
};

/// Returns, per vertex, the lowest layer that it has a cell of; nothing where the layers of the cells are not known.
std::vector<std::uint16_t> lowest_layers(const Mesh& mesh) {
    if (mesh.layer.empty()) return {};
    const mesh::CellEdges cells(mesh);
    std::vector<std::uint16_t> lowest(mesh.points.size(), std::numeric_limits<std::uint16_t>::max());
    for (std::size_t cell = 0; cell < cells.cells(); ++cell) {
        if (mesh.layer[cell] == 0) continue;
        for (std::size_t i = 0; i < cells.corners(cell); ++i) {
            std::uint16_t& of_vertex = lowest[cells.corner(cell, i).index()];
            of_vertex = std::min(of_vertex, mesh.layer[cell]);
        }
    }
    return lowest;
}

/// Finds the rays from the wall outwards. A ray is straight: of the neighbours that are nearer to the wall, a vertex
/// goes on along the ray that passes it most closely, as seen from that ray's wall vertex, or begins one there.
class RayFinder {
public:
    RayFinder(const Mesh& mesh, const WallVertices& walls, std::span<const Segment> edges, const Neighbours& neighbours)
        : mesh_(mesh),
          walls_(walls),
          neighbours_(neighbours),
          normals_before_(walls.normal),
          normals_after_(walls.normal),
          levels_(lowest_layers(mesh)) {
        rays_.of_vertex.assign(mesh.points.size(), no_ray);
        for (std::size_t i = 0; i < walls.vertex.size(); ++i) {
            rays_.of_vertex[walls.vertex[i].index()] = static_cast<std::uint32_t>(i);
            rays_.rays.push_back({static_cast<std::uint32_t>(i)});
        }
        for (const auto& [a, b] : edges)
            normals_after_[a.index()] = normals_before_[b.index()] =
                -perpendicular(unit(origin_of(b.index()) - origin_of(a.index())));
    }

    /// Takes the vertices in the order of their distance from the walls.
    void add(std::span<const std::uint32_t> vertices) {
        for (const std::uint32_t v : vertices) {
            const std::uint32_t ray = ray_through(v);
            if (ray == no_ray) continue;
            const bool begins = ray < walls_.vertex.size();
            rays_.of_vertex[v] = begins ? static_cast<std::uint32_t>(rays_.rays.size()) : ray;
            if (begins) rays_.rays.push_back({ray, share_of(mesh_.points[v], ray)});
            lengthen(rays_.rays[rays_.of_vertex[v]], mesh_.points[v]);
        }
    }

    Rays take() {
        spread_fans();
        return std::move(rays_);
    }

private:
    const Mesh& mesh_;
    const WallVertices& walls_;
    const Neighbours& neighbours_;
    std::vector<Point> normals_before_, normals_after_;  ///< per wall vertex: of its edges, into the flow
    std::vector<std::uint16_t> levels_;
    Rays rays_;

    void lengthen(Ray& ray, Point p) const {
        ray.tip = p - origin_of(ray.wall);
        if (ray.vertices++ < kept_layers) ray.kept = ray.tip;
    }

    Point origin_of(std::size_t wall) const { return mesh_.points[walls_.vertex[wall].index()]; }

    std::uint32_t ray_through(std::uint32_t v) const {
        std::uint32_t best = no_ray;
        double least = HUGE_VAL;
        for (const std::uint32_t u : neighbours_.of(v)) {
            const std::uint32_t ray = rays_.of_vertex[u];
            if (ray == no_ray || !goes_up(u, v)) continue;
            const double off = distance_from_ray(mesh_.points[v], mesh_.points[u], rays_.rays[ray].wall);
            if (off < least || (off == least && off < HUGE_VAL && ray < best))
                std::tie(least, best) = std::pair(off, ray);
        }
        return best;
    }

    /// Returns whether a ray may go on from u to v: from a wall, or where v is above a higher layer. Behind a trailing
    /// edge the line in the middle of a wake leaves the wall as a ray does, but stays below its first layer.
    bool goes_up(std::uint32_t u, std::uint32_t v) const {
        return levels_.empty() || rays_.of_vertex[u] < walls_.vertex.size() || levels_[v] > levels_[u];
    }

    /// Returns how far from a ray a point lies, which goes on from a vertex of it; infinite where it does not go on in
    /// the ray's direction within 30 degrees. From the wall itself a ray may go into any direction, as in the fan of a
    /// corner.
    double distance_from_ray(Point p, Point on_ray, std::size_t wall) const {
        const Point origin = origin_of(wall);
        if (on_ray == origin) return std::abs(cross(walls_.normal[wall], p - origin));
        const Point ray = unit(on_ray - origin), step = p - on_ray;
        const double along = dot(ray, step), off = std::abs(cross(ray, step));
        return along > 0 && 3 * off * off <= along * along ? std::abs(cross(ray, p - origin)) : HUGE_VAL;
    }

    /// Lets the first and the last ray of each fan follow the edges beside them, which they make cells with.
    void spread_fans() {
        std::vector<double> least(walls_.vertex.size(), 1), most(walls_.vertex.size(), 0);
        const auto fan = std::span(rays_.rays).subspan(walls_.vertex.size());
        for (const Ray& ray : fan) {
            least[ray.wall] = std::min(least[ray.wall], ray.share);
            most[ray.wall] = std::max(most[ray.wall], ray.share);
        }
        for (Ray& ray : fan) {
            const double low = least[ray.wall], high = most[ray.wall];
            ray.share = high > low ? (ray.share - low) / (high - low) : 0.5;
        }
    }

    /// Returns where a ray to a point stands between the normals of the edges, by the chords between unit vectors.
    double share_of(Point p, std::size_t wall) const {
        const Point ray = unit(p - origin_of(wall));
        const double before = distance(ray, normals_before_[wall]), after = distance(ray, normals_after_[wall]);
        return before + after > 0 ? before / (before + after) : 0.5;
    }
};

}  // namespace

std::vector<bool> boundary_vertices(const Mesh& mesh) {
    std::vector<bool> found(mesh.points.size(), false);
    for (const Marker& marker : mesh.markers)
        if (marker.kind != MarkerKind::internal)
            for (const Segment& edge : marker.edges) found[edge.a.index()] = found[edge.b.index()] = true;
    return found;
}

Rays find_rays(const Mesh& mesh, const WallVertices& walls, std::span<const Segment> edges) {
    std::vector<Region> region = mesh.region.empty() ? estimate_regions(mesh) : mesh.region;
    if (region.empty()) region.assign(mesh.triangles.size() + mesh.quads.size(), Region::isotropic);
    const Neighbours neighbours(mesh, region);
    const std::vector<bool> fixed = boundary_vertices(mesh);
    const std::vector<double> height = wall_distances(mesh);
    std::vector<std::uint32_t> outwards;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
        if (!fixed[v] && !neighbours.of(v).empty()) outwards.push_back(static_cast<std::uint32_t>(v));
    std::sort(outwards.begin(), outwards.end(),
              [&](std::uint32_t a, std::uint32_t b) { return height[a] != height[b] ? height[a] < height[b] : a < b; });
    RayFinder finder(mesh, walls, edges, neighbours);
    finder.add(outwards);
    return finder.take();
}

}  // namespace lamina::morphing
