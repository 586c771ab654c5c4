#include "mesh/exempt.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/isotropic_cells.hpp"

namespace lamina::mesh {

namespace {

/// Finds the two frozen edges between which a corner of an isotropic cell lies.
class FrozenCorners {
public:
    FrozenCorners(const Mesh& mesh, const Adjacency& adjacency, const std::vector<Segment>& constraints)
        : mesh_(mesh), edges_(mesh), adjacency_(adjacency), constraints_(constraints) {}

    /// Returns whether a corner of the cell lies between two frozen edges that enclose less than 60 degrees.
    bool has_sharp_corner(std::size_t cell) const {
        for (std::size_t i = 0; i < edges_.corners(cell); ++i)
            if (is_sharp(edges_.first(cell) + i)) return true;
        return false;
    }

private:
    const Mesh& mesh_;
    CellEdges edges_;
    const Adjacency& adjacency_;
    const std::vector<Segment>& constraints_;

    std::size_t next(std::size_t edge) const { return advanced(edge, 1); }
    std::size_t previous(std::size_t edge) const { return advanced(edge, edges_.corners(edges_.cell_of(edge)) - 1); }
    /// Returns the edge of the same cell that is this many steps ahead, counter-clockwise.
    std::size_t advanced(std::size_t edge, std::size_t steps) const {
        const std::size_t cell = edges_.cell_of(edge), first = edges_.first(cell);
        return first + (edge - first + steps) % edges_.corners(cell);
    }

    /// Precondition: the edge belongs to an isotropic cell.
    bool is_frozen(std::size_t edge) const {
        const std::uint32_t twin = adjacency_.twin[edge];
        if (twin == no_edge) return true;
        const std::size_t cell = edges_.cell_of(edge), other = edges_.cell_of(twin);
        if (!is_isotropic(mesh_, other)) return true;
        if (!mesh_.piece.empty() && mesh_.piece[cell] != mesh_.piece[other]) return true;
        const VertexId a = edges_.origin(edge), b = edges_.target(edge);
        return std::binary_search(constraints_.begin(), constraints_.end(), Segment{std::min(a, b), std::max(a, b)});
    }

    /// Returns whether the corner at the origin v of `edge` lies between two frozen edges that enclose less than 60
    /// degrees. Walks over the cells round v in both directions up to the next frozen edge:
    ///
    ///      b   .            v-a  frozen edge found clockwise from `edge`
    ///       \ .  cell       v-b  frozen edge found counter-clockwise from it
    ///        v-----> edge
    ///         \  .
    ///          a
    bool is_sharp(std::size_t edge) const {
        std::size_t right = edge;  // leaves v
        while (!is_frozen(right)) {
            right = next(adjacency_.twin[right]);
            if (right == edge) return false;  // no edge at v is frozen
        }
        std::size_t left = previous(edge);  // arrives at v
        while (!is_frozen(left)) left = previous(adjacency_.twin[left]);
        const Point v = mesh_.points[edges_.origin(edge).index()];
        const Point a = mesh_.points[edges_.target(right).index()] - v;
        const Point b = mesh_.points[edges_.origin(left).index()] - v;
        return core::encloses_sharp_angle(a, b);
    }
};

}  // namespace

std::size_t count_exempt(const Mesh& mesh, const Adjacency& adjacency, const std::vector<Segment>& constraints,
                         const std::vector<std::uint32_t>& cells) {
    const FrozenCorners corners(mesh, adjacency, constraints);
    const auto count = [&](std::size_t begin, std::size_t end) {
        return std::count_if(cells.begin() + static_cast<std::ptrdiff_t>(begin),
                             cells.begin() + static_cast<std::ptrdiff_t>(end),
                             [&](std::uint32_t cell) { return corners.has_sharp_corner(cell); });
    };
    std::size_t exempt = 0;
    for (const auto part : core::parallel_blocks(cells.size(), cells_per_block, count))
        exempt += static_cast<std::size_t>(part);
    return exempt;
}

}  // namespace lamina::mesh
