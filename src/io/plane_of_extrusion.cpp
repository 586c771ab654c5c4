#include "io/plane_of_extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "io/mesh_parts.hpp"

namespace lamina::io {

namespace {

/// By how much a node may lean from the one below it, in units of the largest coordinate: files with ten digits round
/// so.
constexpr double rounding_of_files = 1e-9;
constexpr std::uint32_t no_column = std::numeric_limits<std::uint32_t>::max();

class Collapse {
public:
    Collapse(const SpaceMesh& mesh, const std::filesystem::path& file) : mesh_(mesh), file_(file) {}

    PlaneOfExtrusion run(std::size_t markers) {
        find_planes();
        stand_volumes_upright();
        find_columns();
        gather_cells();
        compare_layers();
        gather_edges(markers);
        return std::move(result_);
    }

private:
    using Volume = SpaceMesh::Volume;
    /// The columns of a cell's corners, the lowest one first; `no_column` is the fourth of a triangle.
    using Cell = std::array<std::uint32_t, 4>;

    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError({file_.string(), 0, {}}, "the mesh is no plane mesh in copies across a span: " + reason);
    }

    void find_planes() {
        planes_ = mesh_.heights;
        std::sort(planes_.begin(), planes_.end());
        planes_.erase(std::unique(planes_.begin(), planes_.end()), planes_.end());
        if (planes_.size() < 2) fail("all nodes lie in one plane");
        for (const double height : mesh_.heights)
            plane_.push_back(
                static_cast<std::uint32_t>(std::lower_bound(planes_.begin(), planes_.end(), height) - planes_.begin()));
        for (const Point p : mesh_.points) largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y)});
        column_.assign(plane_.size(), no_column);
        above_.assign(plane_.size(), no_column);
        for (std::uint32_t node = 0; node < plane_.size(); ++node) {
            if (plane_[node] != 0) continue;
            column_[node] = static_cast<std::uint32_t>(result_.nodes.size());
            result_.nodes.push_back(node);
            result_.points.push_back(mesh_.points[node]);
        }
        if (result_.nodes.size() * planes_.size() != plane_.size())
            fail(fmt::format("{} of its {} nodes lie in the lowest of {} planes", result_.nodes.size(), plane_.size(),
                             planes_.size()));
    }

    /// Numbers the corners of each volume so that the lower face comes first, and the volumes from below.
    void stand_volumes_upright() {
        for (std::size_t i = 0; i < mesh_.volumes.size(); ++i) {
            Volume volume = mesh_.volumes[i];
            if (!stand_upright(volume)) fail(fmt::format("cell {} does not reach from one plane to the next", i + 1));
            volumes_.push_back(volume);
        }
        from_below_.resize(volumes_.size());
        std::iota(from_below_.begin(), from_below_.end(), 0U);
        std::stable_sort(from_below_.begin(), from_below_.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return lower_plane(a) < lower_plane(b); });
    }
    std::uint32_t lower_plane(std::uint32_t volume) const { return plane_[volumes_[volume].nodes[0]]; }
    bool stand_upright(Volume& volume) const {
        if (volume.corners == 3) return put_lower_face_first(volume);
        // Each pair of opposite faces of a hexahedron may be the one that lies in the planes.
        static constexpr std::array<std::array<std::size_t, 8>, 3> pairs{
            {{0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 5, 4, 3, 2, 6, 7}, {0, 3, 7, 4, 1, 2, 6, 5}}};
        const Volume given = volume;
        return std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
            for (std::size_t k = 0; k < pair.size(); ++k) volume.nodes[k] = given.nodes[pair[k]];
            return put_lower_face_first(volume);
        });
    }
    /// Returns false where the faces do not lie in a plane and in the next one.
    bool put_lower_face_first(Volume& volume) const {
        const auto begin = volume.nodes.begin();
        const auto middle = begin + static_cast<std::ptrdiff_t>(volume.corners), end = middle + (middle - begin);
        if (plane_[*begin] > plane_[*middle]) std::swap_ranges(begin, middle, middle);
        const std::uint32_t low = plane_[*begin];
        return std::all_of(begin, middle, [&](std::uint32_t node) { return plane_[node] == low; }) &&
               std::all_of(middle, end, [&](std::uint32_t node) { return plane_[node] == low + 1; });
    }

    /// Finds the vertex that each node stands above, from below.
    void find_columns() {
        for (const std::uint32_t i : from_below_)
            for (std::size_t k = 0; k < volumes_[i].corners; ++k)
                put_above(volumes_[i].nodes[k], volumes_[i].nodes[volumes_[i].corners + k]);
        for (std::size_t node = 0; node < column_.size(); ++node)
            if (column_[node] == no_column) fail(fmt::format("node {} is in no cell", node + 1));
    }
    void put_above(std::uint32_t below, std::uint32_t above) {
        if (column_[below] == no_column) fail(fmt::format("there is no cell below node {}", below + 1));
        const bool is_new = above_[below] == no_column && column_[above] == no_column;
        if (!is_new && (above_[below] != above || column_[above] != column_[below]))
            fail(fmt::format("nodes {} and {} are not alone above one another", below + 1, above + 1));
        const Point lean = mesh_.points[above] - mesh_.points[below];
        if (std::max(std::abs(lean.x), std::abs(lean.y)) > rounding_of_files * largest_)
            fail(fmt::format("node {} does not stand straight above node {}", above + 1, below + 1));
        above_[below] = above;
        column_[above] = column_[below];
    }

    void gather_cells() {
        for (const std::size_t corners : {3, 4})
            for (const std::uint32_t i : from_below_) {
                if (lower_plane(i) != 0) break;
                if (volumes_[i].corners != corners) continue;
                result_.volumes.push_back(i);
                const auto v = counter_clockwise(volumes_[i]);
                if (corners == 3)
                    result_.triangles.push_back({{v[0], v[1], v[2]}});
                else
                    result_.quads.push_back({{v[0], v[1], v[2], v[3]}});
            }
    }
    std::array<VertexId, 4> counter_clockwise(const Volume& volume) const {
        std::array<VertexId, 4> v;
        for (std::size_t k = 0; k < volume.corners; ++k) v[k] = VertexId(column_[volume.nodes[k]]);
        const auto at = [&](std::size_t k) { return mesh_.points[volume.nodes[k]]; };
        const bool clockwise =
            volume.corners == 3 ? cross(at(1) - at(0), at(2) - at(0)) < 0 : cross(at(2) - at(0), at(3) - at(1)) < 0;
        if (clockwise) std::reverse(v.begin() + 1, v.begin() + static_cast<std::ptrdiff_t>(volume.corners));
        return v;
    }

    /// Fails unless the cells between any two planes are those between the lowest two.
    void compare_layers() const {
        std::vector<Cell> lowest;
        auto begin = from_below_.begin();
        for (std::uint32_t low = 0; low + 1 < planes_.size(); ++low) {
            std::vector<Cell> cells;
            for (; begin != from_below_.end() && lower_plane(*begin) == low; ++begin)
                cells.push_back(cell_of(volumes_[*begin]));
            std::sort(cells.begin(), cells.end());
            if (low == 0)
                lowest = std::move(cells);
            else if (cells != lowest)
                fail(fmt::format("the cells above height {} differ from the lowest ones", planes_[low]));
        }
    }
    Cell cell_of(const Volume& volume) const {
        Cell cell{no_column, no_column, no_column, no_column};
        for (std::size_t k = 0; k < volume.corners; ++k) cell[k] = column_[volume.nodes[k]];
        const auto end = cell.begin() + static_cast<std::ptrdiff_t>(volume.corners);
        std::rotate(cell.begin(), std::min_element(cell.begin(), end), end);
        // Neighbours of the first corner may stand in either order.
        if (*(cell.begin() + 1) > *(end - 1)) std::reverse(cell.begin() + 1, end);
        return cell;
    }

    void gather_edges(std::size_t markers) {
        result_.edges.resize(markers);
        std::vector<std::size_t> sides(markers, 0);
        const auto top = static_cast<std::uint32_t>(planes_.size() - 1);
        for (const SpaceMesh::Face& face : mesh_.faces) {
            const std::span<const std::uint32_t> nodes(face.nodes.data(), face.corners);
            const auto lies_in = [&](std::uint32_t plane) {
                return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t n) { return plane_[n] == plane; });
            };
            if (lies_in(0) || lies_in(top)) continue;
            const std::uint32_t low = plane_[*std::min_element(
                nodes.begin(), nodes.end(), [&](std::uint32_t a, std::uint32_t b) { return plane_[a] < plane_[b]; })];
            std::array<VertexId, 4> v;  // invalid above the lower plane
            for (std::size_t k = 0; k < face.corners; ++k)
                if (plane_[nodes[k]] == low) v[k] = VertexId(column_[nodes[k]]);
            Segment edge;
            if (!find_lower_edge({v.data(), face.corners}, edge)) fail("a face of its boundary stands on no edge");
            ++sides[face.marker];
            if (low == 0) result_.edges[face.marker].push_back(edge);
        }
        for (std::size_t m = 0; m < markers; ++m)
            if (sides[m] != top * result_.edges[m].size())
                fail(fmt::format("a marker has {} faces, which stand on {} edges", sides[m], result_.edges[m].size()));
    }

    const SpaceMesh& mesh_;
    const std::filesystem::path& file_;
    double largest_ = 0;                ///< the largest coordinate in the plane
    std::vector<double> planes_;        ///< heights, ascending
    std::vector<std::uint32_t> plane_;  ///< per node
    std::vector<Volume> volumes_;
    std::vector<std::uint32_t> from_below_;  ///< indices of volumes_
    std::vector<std::uint32_t> column_;      ///< per node: the vertex it stands above
    std::vector<std::uint32_t> above_;       ///< per node: the next one of its column
    PlaneOfExtrusion result_;
};

}  // namespace

std::vector<double> values_at(std::span<const double> values, std::span<const std::uint32_t> indices) {
    std::vector<double> result;
    result.reserve(indices.size());
    for (const std::uint32_t i : indices) result.push_back(values[i]);
    return result;
}

PlaneOfExtrusion plane_of_extrusion(const SpaceMesh& mesh, std::size_t markers, const std::filesystem::path& file) {
    return Collapse(mesh, file).run(markers);
}

}  // namespace lamina::io
