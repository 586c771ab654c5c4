// Source of the interpolation within cells: W. J. Gordon, C. A. Hall, Construction of curvilinear co-ordinate systems
// and applications to mesh generation, Int. J. Numer. Meth. Eng. 7 (1973) for quadrilaterals; R. E. Barnhill, G.
// Birkhoff, W. J. Gordon, Smooth interpolation in triangles, J. Approx. Theory 8 (1973) for triangles. Bends that go up
// the columns of a boundary layer: D. Moxey, M. D. Green, S. J. Sherwin, J. Peiro, An isoparametric approach to
// high-order curvilinear boundary-layer meshing, Comput. Methods Appl. Mech. Eng. 283 (2015), where cells are parts of
// one curved cell likewise.
#include "mesh/curve_cells.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "mesh/curved_nodes.hpp"
#include "mesh/jacobian_bounds.hpp"
#include "mesh/prove_cells.hpp"

namespace lamina::mesh {

namespace {

constexpr std::uint32_t no_bend = 0xffffffff;

/// The place of a vertex in a column: on its side where the wall's edge begins (u = 0) or ends (u = 1), and how high.
struct ColumnPlace {
    bool at_end = false;
    double height = 0;
};

/// An edge from one side of a column to the other. It begins at the side where u = 0.
struct Front {
    std::uint32_t edge;  ///< directed, with the rest of the column on its left
    double begin_height = 0, end_height = 0;
};

/// A cell between two fronts of a column.
struct ColumnCell {
    std::uint32_t cell;
    std::array<ColumnPlace, 4> corners;
};

/// What the edge of a wall bends.
struct BentColumn {
    std::vector<Front> fronts;                     ///< from the wall's edge up
    std::vector<ColumnCell> cells;                 ///< between them
    double height = 0;                             ///< where the bend ends
    std::array<Point, max_cell_order + 1> bend{};  ///< at the nodes of the wall's edge, from u = 0 to 1; 0 at both
};

// ---- columns ---------------------------------------------------------------------------------------------------------

/// Follows columns from the edges of walls.
class ColumnSearch {
public:
    ColumnSearch(const MeshView& mesh, const Adjacency& adjacency, const CellColumnNumbers& columns)
        : mesh_(mesh), cells_(mesh), adjacency_(adjacency), columns_(columns) {}

    /// Returns the column over an edge of a wall, without its bend.
    BentColumn follow(std::uint32_t wall) const {
        BentColumn column;
        column.fronts.push_back({wall});
        const std::uint32_t number = columns_.of(mesh_, cells_.cell_of(wall));
        const Point begin = at(cells_.origin(wall)), end = at(cells_.target(wall));
        std::uint32_t edge = wall;
        while (number != CellColumnNumbers::none) {
            const std::optional<Front> next = front_beyond(column.fronts.back(), number, begin, end, column.cells);
            if (!next) break;
            edge = adjacency_.twin[next->edge];
            column.fronts.push_back({edge, next->begin_height, next->end_height});
            if (edge == no_edge) break;
        }
        const Front& top = column.fronts.back();
        column.height = std::max(top.begin_height, top.end_height);
        if (edge == no_edge)
            column.fronts.pop_back();
        else if (cells_.corners(cells_.cell_of(edge)) == 3)
            column.height += height_of_triangle(edge);
        return column;
    }

private:
    Point at(VertexId v) const { return mesh_.points[v.index()]; }
    std::uint32_t edge_after(std::uint32_t edge, std::size_t steps) const {
        const std::size_t cell = cells_.cell_of(edge), first = cells_.first(cell), n = cells_.corners(cell);
        return static_cast<std::uint32_t>(first + (edge - first + steps) % n);
    }
    double height_of_triangle(std::uint32_t edge) const {
        const Point a = at(cells_.origin(edge)), b = at(cells_.target(edge));
        return cross(b - a, at(cells_.target(edge_after(edge, 1))) - a) / distance(a, b);
    }
    /// What is across an edge, in the order in which a column goes on there: another column is behind a ray.
    enum class Across { other_column, no_column, column };
    Across across(std::uint32_t edge, std::uint32_t number) const {
        const std::uint32_t twin = adjacency_.twin[edge];
        const std::uint32_t beyond =
            twin == no_edge ? CellColumnNumbers::none : columns_.of(mesh_, cells_.cell_of(twin));
        if (beyond == number) return Across::column;
        return beyond == CellColumnNumbers::none ? Across::no_column : Across::other_column;
    }

    /// Returns the edge on the far side of the cell beyond a front, as an edge of that cell, and adds the cell. A
    /// column goes on through a quadrilateral, and through a triangle across the edge that is not on a ray:
    ///
    ///      4-----3       4-----3      The front 1-2 is followed by 4-3 through the quadrilateral. Through triangles it is
    ///      |     |       |  .  |      followed by 1-3, since the cell across 2-3 is of another column, and then by 4-3.
    ///      1-----2       1-----2
    ///
    /// Returns nothing where the column ends, or where both edges of a triangle are alike.
    std::optional<Front> front_beyond(const Front& front, std::uint32_t number, Point begin, Point end,
                                      std::vector<ColumnCell>& cells) const {
        const auto cell = static_cast<std::uint32_t>(cells_.cell_of(front.edge));
        if (columns_.of(mesh_, cell) != number) return {};
        const std::size_t corner = front.edge - cells_.first(cell), n = cells_.corners(cell);
        ColumnCell next{cell, {}};
        const auto place = [&](std::size_t steps) -> ColumnPlace& { return next.corners[(corner + steps) % n]; };
        place(0) = {false, front.begin_height};
        place(1) = {true, front.end_height};
        const auto height_at = [&](std::size_t steps, Point foot) {
            return distance(foot, at(cells_.corner(cell, (corner + steps) % n)));
        };
        Front beyond{};
        if (n == 4) {
            place(2) = {true, height_at(2, end)};
            place(3) = {false, height_at(3, begin)};
            beyond = {edge_after(front.edge, 2), place(3).height, place(2).height};
        } else {
            const Across after = across(edge_after(front.edge, 1), number),
                         before = across(edge_after(front.edge, 2), number);
            if (after == before) return {};
            const bool across_end = before > after;  // the third corner is on the ray where the front ends
            place(2) = across_end ? ColumnPlace{true, height_at(2, end)} : ColumnPlace{false, height_at(2, begin)};
            beyond = across_end ? Front{edge_after(front.edge, 2), front.begin_height, place(2).height}
                                : Front{edge_after(front.edge, 1), place(2).height, front.end_height};
        }
        cells.push_back(next);
        return beyond;
    }

    MeshView mesh_;
    CellEdges cells_;
    const Adjacency& adjacency_;
    CellColumnNumbers columns_;
};

/// Returns the share of its bend that a column has at a height.
double share_at(const BentColumn& column, double height) {
    assert(column.height > 0);
    return std::max(0.0, 1 - height / column.height);
}

// ---- nodes -----------------------------------------------------------------------------------------------------------

/// Numbers of the nodes: those of edges first, edge by edge, then those within cells.
class NodeNumbers {
public:
    NodeNumbers(const MeshView& mesh, const Adjacency& adjacency, unsigned order)
        : cells_(mesh), adjacency_(adjacency), within_edge_(order - 1), vertices_(mesh.points.size()) {
        edge_.resize(cells_.size());
        for (std::uint32_t e = 0; e < cells_.size(); ++e) {
            const std::uint32_t twin = adjacency.twin[e];
            edge_[e] = twin != no_edge && twin < e ? edge_[twin] : edges_++;
        }
        for (const std::size_t corners : {3, 4})
            within_cell_[corners - 3] = nodes_of_cell(static_cast<unsigned>(corners), order) - corners * order;
        const std::size_t nodes = first_of_cell(cells_.cells());
        if (vertices_ + nodes >= VertexId{}.value) throw MeshError("more than 2^32 nodes of curved cells");
        count_ = nodes;
    }

    std::size_t count() const { return count_; }
    /// Returns the first node within a cell.
    std::size_t first_of_cell(std::size_t cell) const {
        const std::size_t triangles = std::min(cell, cells_.cells() - quads());
        return std::size_t{edges_} * within_edge_ + triangles * within_cell_[0] + (cell - triangles) * within_cell_[1];
    }
    std::size_t within_cell(std::size_t cell) const { return within_cell_[cells_.corners(cell) - 3]; }
    /// Returns node k, from 0, within a directed edge.
    std::size_t of_edge(std::uint32_t edge, std::size_t k) const {
        return edge_[edge] * within_edge_ + (is_owner(edge) ? k : within_edge_ - 1 - k);
    }
    /// Returns whether the nodes of an edge are numbered in its direction.
    bool is_owner(std::uint32_t edge) const {
        const std::uint32_t twin = adjacency_.twin[edge];
        return twin == no_edge || edge < twin;
    }
    VertexId id(std::size_t node) const { return VertexId(vertices_ + node); }
    const CellEdges& cells() const { return cells_; }

private:
    std::size_t quads() const { return cells_.size() - 3 * cells_.cells(); }

    CellEdges cells_;
    const Adjacency& adjacency_;
    std::size_t within_edge_, vertices_, count_ = 0;
    std::array<std::size_t, 2> within_cell_{};
    std::vector<std::uint32_t> edge_;
    std::uint32_t edges_ = 0;
};

/// Puts the numbers of the nodes of a cell beside its corners at a place of a list.
void list_nodes(const NodeNumbers& numbers, std::size_t cell, unsigned order, VertexId* at) {
    const CellEdges& cells = numbers.cells();
    for (std::size_t e = cells.first(cell); e < cells.first(cell + 1); ++e) {
        const auto edge = static_cast<std::uint32_t>(e);
        const bool is_owner = numbers.is_owner(edge);
        std::size_t node = numbers.of_edge(edge, 0);
        for (std::size_t k = 0; k + 1 < order; ++k) *at++ = numbers.id(is_owner ? node++ : node--);
    }
    const std::size_t first = numbers.first_of_cell(cell), within = numbers.within_cell(cell);
    for (std::size_t i = 0; i < within; ++i) *at++ = numbers.id(first + i);
}

/// Returns the lists of nodes of all cells and markers, without places. `edges` are those of all markers in a row.
CurvedNodes number_nodes(const MeshView& mesh, const NodeNumbers& numbers, const CellOrder& of_cells,
                         std::span<const std::uint32_t> edges) {
    const unsigned order = of_cells.order;
    CurvedNodes nodes;
    nodes.order = order;
    nodes.distribution = of_cells.distribution;
    const CellEdges& cells = numbers.cells();
    nodes.points.resize(numbers.count());
    const std::size_t triangles = mesh.triangles.size(), of_triangle = nodes_of_cell(3, order) - 3,
                      of_quad = nodes_of_cell(4, order) - 4;
    nodes.triangle_nodes.resize(triangles * of_triangle);
    nodes.quad_nodes.resize(mesh.quads.size() * of_quad);
    core::parallel_for(cells.cells(), cells_per_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell)
            list_nodes(numbers, cell, order,
                       cell < triangles ? nodes.triangle_nodes.data() + cell * of_triangle
                                        : nodes.quad_nodes.data() + (cell - triangles) * of_quad);
    });
    auto edge = edges.begin();
    for (const Marker& marker : mesh.markers)
        for (const Segment& segment : marker.edges) {
            const bool is_along = cells.origin(*edge) == segment.a;
            for (std::size_t k = 0; k + 1 < order; ++k)
                nodes.marker_nodes.push_back(numbers.id(numbers.of_edge(*edge, is_along ? k : order - 2 - k)));
            ++edge;
        }
    return nodes;
}

/// Places the nodes of cells. Edges come first; what moves them moves the cells on both sides.
class NodePlacer {
public:
    NodePlacer(const MeshView& mesh, const NodeNumbers& numbers, const Adjacency& adjacency,
               std::span<const BentColumn> columns, const CellOrder& order)
        : mesh_(mesh),
          numbers_(numbers),
          cells_(mesh),
          columns_(columns),
          order_(order.order),
          distribution_(order.distribution) {
        bend_of_edge_.resize(cells_.size(), {no_bend, 0});
        column_of_cell_.resize(cells_.cells(), {no_bend, 0});
        has_bent_edge_.resize(cells_.cells());
        for (const unsigned corners : {3u, 4u})
            for (std::size_t i = 0; i < lattice_of_cell(corners, order_).size(); ++i)
                weights_[corners - 3].push_back(corner_weights(corners, i));
        for (std::size_t i = 0; i < lattice_of_cell(3, order_).size(); ++i)
            across_triangle_.push_back(lines_across_triangle(i));
        for (std::uint32_t c = 0; c < columns.size(); ++c) {
            for (std::uint32_t f = 0; f < columns[c].fronts.size(); ++f) {
                const std::uint32_t edge = columns[c].fronts[f].edge, twin = adjacency.twin[edge];
                bend_of_edge_[edge] = {c, f};
                has_bent_edge_[cells_.cell_of(edge)] = true;
                if (twin != no_edge) has_bent_edge_[cells_.cell_of(twin)] = true;
            }
            for (std::uint32_t k = 0; k < columns[c].cells.size(); ++k)
                column_of_cell_[columns[c].cells[k].cell] = {c, k};
        }
    }

    /// Places all nodes of edges, bends included.
    void place_edges(const Adjacency& adjacency, std::vector<Point>& places) const {
        core::parallel_for(cells_.size(), cells_per_block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t e = begin; e < end; ++e) place_edge(static_cast<std::uint32_t>(e), adjacency, places);
        });
    }
    /// Places the nodes within all cells.
    void place_within_cells(std::vector<Point>& places) const {
        core::parallel_for(cells_.cells(), cells_per_block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t cell = begin; cell < end; ++cell) place_within_cell(cell, places);
        });
    }
    /// Calls f with the number of each column that bends a cell.
    template <class F>
    void for_each_column(std::size_t cell, const Adjacency& adjacency, F&& f) const {
        if (column_of_cell_[cell].column != no_bend) f(column_of_cell_[cell].column);
        for (std::size_t e = cells_.first(cell); e < cells_.first(cell + 1); ++e)
            for (const std::uint32_t edge : {static_cast<std::uint32_t>(e), adjacency.twin[e]})
                if (edge != no_edge && bend_of_edge_[edge].column != no_bend) f(bend_of_edge_[edge].column);
    }

private:
    /// A column, and the front or the cell of it.
    struct InColumn {
        std::uint32_t column, index;
    };

    Point at(VertexId v) const { return mesh_.points[v.index()]; }
    void place_edge(std::uint32_t edge, const Adjacency& adjacency, std::vector<Point>& places) const {
        if (!numbers_.is_owner(edge)) return;
        const std::size_t first = numbers_.of_edge(edge, 0);
        const Point a = at(cells_.origin(edge)), b = at(cells_.target(edge));
        const std::uint32_t twin = adjacency.twin[edge];
        const bool is_reversed = bend_of_edge_[edge].column == no_bend && twin != no_edge;
        const InColumn bent = bend_of_edge_[is_reversed ? twin : edge];
        for (unsigned k = 1; k < order_; ++k) {
            Point node = a + place_on_edge(order_, k, distribution_) * (b - a);
            if (bent.column != no_bend) node = node + bend_of_front(bent, is_reversed ? order_ - k : k);
            places[first + k - 1] = node;
        }
    }
    Point bend_of_front(const InColumn& bent, unsigned k) const {
        const BentColumn& column = columns_[bent.column];
        const Front& front = column.fronts[bent.index];
        const double u = place_on_edge(order_, k, distribution_);
        return share_at(column, (1 - u) * front.begin_height + u * front.end_height) * column.bend[k];
    }

    void place_within_cell(std::size_t cell, std::vector<Point>& places) const {
        const auto corners = static_cast<unsigned>(cells_.corners(cell));
        const std::span<const LatticePlace> lattice = lattice_of_cell(corners, order_);
        const std::size_t first = numbers_.first_of_cell(cell);
        const std::size_t border = std::size_t{corners} * order_;
        const InColumn in = column_of_cell_[cell];
        std::array<Point, 4> vertices{};
        for (std::size_t c = 0; c < corners; ++c) vertices[c] = at(cells_.corner(cell, c));
        for (std::size_t i = border; i < lattice.size(); ++i) {
            const std::array<double, 4>& weights = weights_[corners - 3][i];
            Point node{0, 0};
            for (std::size_t c = 0; c < corners; ++c) node = node + weights[c] * vertices[c];
            if (in.column != no_bend)
                node = node + bend_in_column(in, corners, weights);
            else if (has_bent_edge_[cell])
                node = node + bend_between_edges(cell, corners, i, places);
            places[first + i - border] = node;
        }
    }
    /// Returns how much of each corner a node of the straight cell is.
    std::array<double, 4> corner_weights(unsigned corners, std::size_t node) const {
        const auto [s, t] = places_of_nodes(corners, order_, distribution_)[node];
        if (corners == 3 && distribution_ == NodeDistribution::equidistant) {
            const LatticePlace& place = lattice_of_cell(3, order_)[node];
            return {static_cast<double>(order_ - place.i - place.j) / order_, s, t, 0};
        }
        if (corners == 3) return {1 - s - t, s, t, 0};
        return {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    }
    /// Returns the bend of a node within a cell of a column, where u is that of a node of the wall: its corners have 0
    /// and 1. But for triangles whose nodes are not evenly spaced.
    Point bend_in_column(const InColumn& in, unsigned corners, const std::array<double, 4>& weights) const {
        const BentColumn& column = columns_[in.column];
        double u = 0, height = 0;
        for (std::size_t c = 0; c < corners; ++c) {
            const ColumnPlace& place = column.cells[in.index].corners[c];
            u += place.at_end ? weights[c] : 0;
            height += weights[c] * place.height;
        }
        if (corners == 3 && distribution_ != NodeDistribution::equidistant)
            return share_at(column, height) * point_of_edge(std::span(column.bend).first(order_ + 1), u, distribution_);
        unsigned k = 0;
        while (u > half_step_on_edge(order_, 2 * k + 1, distribution_)) ++k;
        return share_at(column, height) * column.bend[k];
    }
    using EdgeWeights = std::array<double, max_cell_order + 1>;

    /// The six points where the lines through a node, each parallel to an edge of its triangle, meet the other edges,
    /// and the share of the second one in a node on their line.
    struct LinesAcross {
        struct Line {
            std::size_t from, to;  ///< edges
            EdgeWeights at_from, at_to;
            double share;
        };
        std::array<Line, 3> lines;
    };
    LinesAcross lines_across_triangle(std::size_t node) const {
        // Whole numbers in place of i / p, where they may be: they do not round.
        const bool is_even = distribution_ == NodeDistribution::equidistant;
        const LatticePlace& of_lattice = lattice_of_cell(3, order_)[node];
        const NodePlace& place = places_of_nodes(3, order_, distribution_)[node];
        const double whole = is_even ? order_ : 1, s = is_even ? of_lattice.i : place.s,
                     t = is_even ? of_lattice.j : place.t, r = whole - s - t;
        const auto line = [&](std::size_t from, double at_from, std::size_t to, double at_to, double share) {
            return LinesAcross::Line{from, to, weights_on_edge(order_, at_from / whole, distribution_),
                                     weights_on_edge(order_, at_to / whole, distribution_), share};
        };
        return {{line(2, whole - t, 1, t, s / (r + s)), line(0, s + t, 2, r, t / (s + t)),
                 line(1, whole - s, 0, s, r / (t + r))}};
    }
    /// Returns the bend of a node within a cell by transfinite interpolation of those of its edges.
    Point bend_between_edges(std::size_t cell, unsigned corners, std::size_t node,
                             const std::vector<Point>& places) const {
        const unsigned p = order_;
        const auto bend = [&](std::size_t edge, unsigned k) {
            const auto e = static_cast<std::uint32_t>(cells_.first(cell) + edge);
            const Point a = at(cells_.origin(e)), b = at(cells_.target(e));
            return places[numbers_.of_edge(e, k - 1)] - (a + place_on_edge(p, k, distribution_) * (b - a));
        };
        if (corners == 4) {
            const auto [i, j] = lattice_of_cell(4, p)[node];
            const auto [s, t] = places_of_nodes(4, p, distribution_)[node];
            return (1 - t) * bend(0, i) + s * bend(1, j) + t * bend(2, p - i) + (1 - s) * bend(3, p - j);
        }
        // Half the sum of the interpolations along the lines parallel to each edge; bends vanish at corners.
        Point sum{0, 0};
        const auto bend_at = [&](std::size_t edge, const EdgeWeights& weights) {
            Point at_edge{0, 0};
            for (unsigned k = 1; k < p; ++k) at_edge = at_edge + weights[k] * bend(edge, k);
            return at_edge;
        };
        for (const LinesAcross::Line& line : across_triangle_[node].lines)
            sum =
                sum + ((1 - line.share) * bend_at(line.from, line.at_from) + line.share * bend_at(line.to, line.at_to));
        return 0.5 * sum;
    }

    MeshView mesh_;
    const NodeNumbers& numbers_;
    CellEdges cells_;
    std::span<const BentColumn> columns_;
    unsigned order_;
    NodeDistribution distribution_;
    std::vector<InColumn> bend_of_edge_, column_of_cell_;
    std::array<std::vector<std::array<double, 4>>, 2> weights_;  ///< corner_weights() in triangles and quadrilaterals
    std::vector<LinesAcross> across_triangle_;                   ///< per node of a triangle
    std::vector<char> has_bent_edge_;                            ///< per cell: whether columns bend an edge of it
};

// ---- walls -----------------------------------------------------------------------------------------------------------

/// Returns the nodes of the straight edge of a wall.
std::array<Point, max_cell_order + 1> nodes_of_chord(const MeshView& mesh, const WallCurve& wall,
                                                     const CellOrder& order) {
    const Point a = mesh.points[wall.edge.a.index()], b = mesh.points[wall.edge.b.index()];
    std::array<Point, max_cell_order + 1> nodes{};
    for (unsigned k = 0; k <= order.order; ++k)
        nodes[k] = a + place_on_edge(order.order, k, order.distribution) * (b - a);
    return nodes;
}

/// Sets the bend of a column to a share of that of the wall's curve.
void set_bend(BentColumn& column, const MeshView& mesh, const WallCurve& wall, const CellOrder& order, double share) {
    const auto straight = nodes_of_chord(mesh, wall, order);
    for (unsigned k = 1; k < order.order; ++k) column.bend[k] = share * (wall.between[2 * k - 1] - straight[k]);
}

/// Returns how far an edge of a wall is off the curve, at the nodes and halfway between them.
double distance_from_curve(const MeshView& mesh, const WallCurve& wall, const BentColumn& column,
                           const CellOrder& order) {
    auto nodes = nodes_of_chord(mesh, wall, order);
    for (unsigned k = 0; k <= order.order; ++k) nodes[k] = nodes[k] + column.bend[k];
    double largest = 0;
    for (unsigned i = 0; i < wall.between.size(); ++i)
        largest = std::max(
            largest, distance(wall.between[i], point_of_edge(std::span(nodes).first(order.order + 1),
                                                             half_step_on_edge(order.order, i + 1, order.distribution),
                                                             order.distribution)));
    return largest;
}

/// Returns the directed edges of walls, and then those of all markers in a row.
std::vector<std::uint32_t> edges_of_boundary(const MeshView& mesh, std::span<const WallCurve> walls) {
    std::vector<Segment> edges;
    for (const WallCurve& wall : walls) edges.push_back(wall.edge);
    for (const Marker& marker : mesh.markers) edges.insert(edges.end(), marker.edges.begin(), marker.edges.end());
    return find_edges(mesh, edges);
}

/// Follows the column over each wall, whose directed edge is known, and bends it by the wall's curve.
std::vector<BentColumn> bent_columns(const MeshView& mesh, const ColumnSearch& search, const CellOrder& order,
                                     std::span<const WallCurve> walls, std::span<const std::uint32_t> edges) {
    std::vector<BentColumn> columns(walls.size());
    core::parallel_for(walls.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t w = begin; w < end; ++w) {
            columns[w] = search.follow(edges[w]);
            set_bend(columns[w], mesh, walls[w], order, 1);
        }
    });
    return columns;
}

/// Returns the scaled determinant of a straight cell.
double straight_scaled(const MeshView& mesh, std::size_t cell) {
    const CellEdges cells(mesh);
    std::vector<Point> corners;
    for (std::size_t i = 0; i < cells.corners(cell); ++i) corners.push_back(mesh.points[cells.corner(cell, i).index()]);
    return bound_jacobian(static_cast<unsigned>(corners.size()), 1, corners).scaled();
}

/// Returns the columns that squeeze a cell to less than half of what it is when straight, ascending. Doubtful cells are
/// among these.
std::vector<std::uint32_t> columns_at_fault(const MeshView& mesh, const CellProofs& proofs, const NodePlacer& placer,
                                            const Adjacency& adjacency) {
    std::vector<std::uint32_t> at_fault;
    for (const SqueezedCell& squeezed : proofs.squeezed)
        if (squeezed.scaled < 0.5 * straight_scaled(mesh, squeezed.cell))
            placer.for_each_column(squeezed.cell, adjacency, [&](std::uint32_t c) { at_fault.push_back(c); });
    std::sort(at_fault.begin(), at_fault.end());
    at_fault.erase(std::unique(at_fault.begin(), at_fault.end()), at_fault.end());
    return at_fault;
}

/// Returns how well walls are followed, whose bends were halved so many times.
CurvingSummary summary_of(const MeshView& mesh, std::span<const WallCurve> walls, std::span<const BentColumn> columns,
                          std::span<const int> halvings, const CellOrder& order) {
    CurvingSummary summary;
    for (std::size_t w = 0; w < walls.size(); ++w) {
        const double off = distance_from_curve(mesh, walls[w], columns[w], order);
        ++(halvings[w] > 0 ? summary.reduced_edges : summary.curved_edges);
        double& largest = halvings[w] > 0 ? summary.reduced_distance : summary.wall_distance;
        largest = std::max(largest, off);
    }
    return summary;
}

}  // namespace

std::uint32_t CellColumnNumbers::of(const MeshView& mesh, std::size_t cell) const {
    const std::size_t triangles = mesh.triangles.size();
    if (columns.size() < mesh.quads.size()) return none;
    const std::size_t in_triangles = columns.size() - mesh.quads.size();
    if (cell >= triangles) return columns[in_triangles + cell - triangles];
    return cell < in_triangles ? columns[cell] : none;
}

CurvedCells curve_cells(const MeshView& mesh, CellOrder order, std::span<const WallCurve> walls,
                        const CellColumnNumbers& numbers_of_columns) {
    constexpr int max_halvings_of_bend = 6;                                    // docs/decisions/0012
    if (order.order <= 2) order.distribution = NodeDistribution::equidistant;  // both are the same
    const Adjacency adjacency = find_adjacency(mesh);
    const std::vector<std::uint32_t> edges = edges_of_boundary(mesh, walls);
    const ColumnSearch search(mesh, adjacency, numbers_of_columns);
    std::vector<BentColumn> columns = bent_columns(mesh, search, order, walls, std::span(edges).first(walls.size()));
    const NodeNumbers numbers(mesh, adjacency, order.order);
    CurvedCells curved{number_nodes(mesh, numbers, order, std::span(edges).subspan(walls.size())), {}, {}};
    const NodePlacer placer(mesh, numbers, adjacency, columns, order);
    std::vector<int> halvings(walls.size());
    for (;;) {
        placer.place_edges(adjacency, curved.nodes.points);
        placer.place_within_cells(curved.nodes.points);
        const CellProofs proofs = prove_cells(mesh, curved.nodes);
        std::vector<std::uint32_t> at_fault = columns_at_fault(mesh, proofs, placer, adjacency);
        std::erase_if(at_fault, [&](std::uint32_t c) { return halvings[c] == max_halvings_of_bend; });
        if (at_fault.empty()) {
            curved.check = check_of(mesh, proofs);
            break;
        }
        for (const std::uint32_t c : at_fault) {
            const double share = ++halvings[c] == max_halvings_of_bend ? 0 : std::ldexp(1.0, -halvings[c]);
            set_bend(columns[c], mesh, walls[c], order, share);
        }
    }
    if (!curved.check.valid())
        throw MeshError(
            fmt::format("the cells of order {} are not valid: {}", order.order, curved.check.defects[0].description),
            curved.check.defects[0].at);
    curved.summary = summary_of(mesh, walls, columns, halvings, order);
    curved.summary.straight_min_scaled_jacobian = prove_cells(mesh, {}).min_scaled;
    return curved;
}

}  // namespace lamina::mesh
