#include "mesh/piece_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/predicates.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/sharp_corners.hpp"
#include "mesh/triangle_shapes.hpp"

namespace lamina::mesh {

namespace {

using core::EdgeLink;

constexpr unsigned next_corner(unsigned i) { return i == 2 ? 0 : i + 1; }

/// Checks a piece step by step. Vertices are numbered as in the piece: `points` holds their coordinates.
class PieceChecker {
public:
    PieceChecker(const LinkedPiece& piece, double min_angle_deg)
        : piece_(piece), min_angle_deg_(min_angle_deg), findings_(min_angle_deg) {
        points_.reserve(piece.border.size() + piece.inner.size());
        points_.insert(points_.end(), piece.border.begin(), piece.border.end());
        points_.insert(points_.end(), piece.inner.begin(), piece.inner.end());
        findings_.triangles = piece.triangles.size();
        findings_.inner_vertices = piece.inner.size();
        findings_.border_vertices.assign(piece.border_ids.begin(), piece.border_ids.end());
    }

    PieceFindings check() {
        check_vertices();
        if (findings_.cells.defects.empty()) check_indices();
        if (!findings_.cells.defects.empty()) return std::move(findings_);
        check_shapes();
        check_links();
        if (findings_.cells.defects.empty()) find_unexcused_by_corners();
        return std::move(findings_);
    }

private:
    const LinkedPiece& piece_;
    double min_angle_deg_;
    PieceFindings findings_;
    std::vector<Point> points_;
    std::vector<double> areas_;        ///< per triangle
    std::vector<std::uint8_t> acute_;  ///< per triangle: 1 where all angles are surely acute
    std::vector<EdgeLink> firsts_;     ///< of each pair of links the lower one, of some triangles
    std::vector<EdgeLink> border_;     ///< the edges without a neighbour
    std::vector<double> area_ratios_;  ///< at edges of some triangles

    Point at(VertexId v) const { return points_[v.index()]; }
    VertexId origin(EdgeLink e) const { return piece_.triangles[core::triangle_of(e)].v[core::edge_of(e)]; }
    VertexId target(EdgeLink e) const {
        return piece_.triangles[core::triangle_of(e)].v[next_corner(core::edge_of(e))];
    }
    VertexId apex(EdgeLink e) const {
        return piece_.triangles[core::triangle_of(e)].v[next_corner(next_corner(core::edge_of(e)))];
    }
    EdgeLink link(EdgeLink e) const { return piece_.links[3 * core::triangle_of(e) + core::edge_of(e)]; }
    /// Returns the id that a vertex has in the mesh; inner ones have none yet.
    VertexId id(VertexId v) const {
        return v.index() < piece_.border_ids.size() ? piece_.border_ids[v.index()] : VertexId{};
    }

    void add_defect(const std::string& description, Point place) {
        findings_.cells.defects.add([&] { return MeshDefect{description, place}; });
    }

    /// Border vertices lie where all other pieces see them, and all coordinates are in the exact range.
    void check_vertices() {
        if (piece_.border.size() != piece_.border_ids.size() || piece_.links.size() != 3 * piece_.triangles.size())
            return add_defect("a piece whose arrays differ in length", {});
        if (piece_.triangles.empty()) return add_defect("a piece without triangles", {});
        for (std::size_t i = 0; i < piece_.border.size(); ++i) {
            const std::size_t v = piece_.border_ids[i].index();
            if (v >= piece_.shared_points.size() || piece_.shared_points[v] != piece_.border[i])
                add_defect(fmt::format("a piece has vertex {} at another place than the mesh", v), piece_.border[i]);
        }
        for (const Point p : points_)
            if (!in_exact_range(p))
                add_defect(fmt::format("a vertex ({}, {}) is not a number or out of range", p.x, p.y), p);
    }

    void check_indices() {
        std::uint32_t largest = 0;
        for (const Triangle& t : piece_.triangles)
            largest = std::max({largest, t.v[0].value, t.v[1].value, t.v[2].value});
        if (largest >= points_.size()) return add_defect("a triangle of a piece has an index out of range", {});
        std::vector<std::uint8_t> used(points_.size(), 0);
        for (const Triangle& t : piece_.triangles)
            used[t.v[0].index()] = used[t.v[1].index()] = used[t.v[2].index()] = 1;
        if (std::find(used.begin(), used.end(), 0) == used.end()) return;
        for (std::size_t v = 0; v < used.size(); ++v)
            if (!used[v]) add_defect("a vertex of a piece belongs to none of its triangles", points_[v]);
    }

    void check_shapes() {
        const std::size_t n = piece_.triangles.size();
        areas_.resize(n);
        acute_.resize(n);
        TriangleShapes shapes;
        for (std::size_t begin = 0; begin < n; begin += TriangleShapes::capacity) {
            const std::size_t count = std::min(TriangleShapes::capacity, n - begin);
            measure_triangles(points_.data(), piece_.triangles.subspan(begin, count), shapes);
            std::copy_n(shapes.area, count, areas_.data() + begin);
            bool all_turn = true;
            for (std::size_t i = 0; i < count; ++i) {
                acute_[begin + i] = shapes.acuteness[i] > 0;
                all_turn &= shapes.turn[i] > 0;
            }
            if (!all_turn) check_turns(begin, shapes);
            add_shapes(begin, shapes);
        }
    }

    /// Decides exactly where rounding might have turned the sign.
    void check_turns(std::size_t begin, const TriangleShapes& shapes) {
        for (std::size_t i = 0; i < shapes.size; ++i) {
            if (shapes.turn[i] > 0) continue;
            const VertexId* v = piece_.triangles[begin + i].v;
            const double sign = orient2d(at(v[0]), at(v[1]), at(v[2]));
            if (!(sign > 0))
                add_defect(fmt::format("{} triangle of a piece", sign < 0 ? "clockwise" : "flat"), at(v[0]));
        }
    }

    void add_shapes(std::size_t begin, const TriangleShapes& shapes) {
        const ShapeTotals totals = add_up(shapes);
        findings_.cells.isotropic.add(shapes, totals);
        findings_.cells.area += totals.area;
        const std::span<const double> max_angles(shapes.max_angle_deg, shapes.size),
            min_angles(shapes.min_angle_deg, shapes.size);
        if (totals.max_angle_deg > findings_.widest.badness)
            findings_.widest = {totals.max_angle_deg, middle_of_first(totals.max_angle_deg, begin, max_angles)};
        if (-totals.min_angle_deg > findings_.narrowest.badness)
            findings_.narrowest = {-totals.min_angle_deg, middle_of_first(totals.min_angle_deg, begin, min_angles)};
        if (!(totals.min_angle_deg < min_angle_deg_)) return;
        for (std::size_t i = 0; i < shapes.size; ++i)
            if (shapes.min_angle_deg[i] < min_angle_deg_)
                findings_.cells.narrow.push_back(static_cast<std::uint32_t>(begin + i));
    }

    /// Returns the middle of the first triangle with this angle; the first angle belongs to triangle `begin`.
    Point middle_of_first(double angle, std::size_t begin, std::span<const double> angles) const {
        const auto found = std::find(angles.begin(), angles.end(), angle);
        const VertexId* v = piece_.triangles[begin + static_cast<std::size_t>(found - angles.begin())].v;
        return (1.0 / 3) * (at(v[0]) + at(v[1]) + at(v[2]));
    }

    /// Each link between two edges is checked once, from the lower one. All others lead from the higher edge of a pair:
    /// every pair that is found has one of these, so equal numbers mean that they are the same.
    void check_links() {
        constexpr std::size_t block = 2048;  // triangles whose pairs stay in the first-level cache
        const std::size_t n = piece_.triangles.size();
        firsts_.resize(3 * block + 1);
        std::size_t higher = 0;
        for (std::size_t begin = 0; begin < n; begin += block) higher += check_links(begin, std::min(n, begin + block));
        if (findings_.cells.defects.empty() && higher != findings_.inner_edges)
            add_defect("the neighbours of a piece that were handed over are not mutual", points_.front());
        for (const EdgeLink e : border_) findings_.border.push_back({id(origin(e)), id(target(e)), at(apex(e))});
        for (const PieceBorderEdge& edge : findings_.border)
            if (!edge.a.valid() || !edge.b.valid()) add_defect("an edge inside a piece has no neighbour", edge.apex);
        findings_.cells.delaunay.edges += findings_.inner_edges;
    }

    /// Checks the links from these triangles. Returns how many of them lead to a lower edge.
    std::size_t check_links(std::size_t begin, std::size_t end) {
        // No branches but for the border, since half of them would be mispredicted.
        std::size_t pairs = 0, higher = 0;
        EdgeLink* const firsts = firsts_.data();
        const EdgeLink* const links = piece_.links.data();
        for (std::size_t t = begin; t < end; ++t)
            for (unsigned i = 0; i < 3; ++i) {
                const EdgeLink mine = core::edge_link(t, i), other = links[3 * t + i];
                firsts[pairs] = mine;
                const bool is_border = other == core::no_link;
                pairs += static_cast<unsigned>(other > mine) & static_cast<unsigned>(!is_border);
                higher += other <= mine;
                if (is_border) border_.push_back(mine);
            }
        check_pairs({firsts, pairs});
        return higher;
    }

    void check_pairs(std::span<const EdgeLink> firsts) {
        area_ratios_.resize(2 * firsts.size());
        double* const larger = area_ratios_.data();
        double* const smaller = larger + firsts.size();
        std::size_t good = 0;
        for (const EdgeLink e : firsts) {
            const EdgeLink twin = link(e);
            const std::size_t t = core::triangle_of(e), other = core::triangle_of(twin);
            const bool exists = other < piece_.triangles.size() && core::edge_of(twin) < 3;
            if (!exists || link(twin) != e || origin(e) != target(twin) || target(e) != origin(twin)) {
                add_defect("a triangle of a piece has another neighbour than was handed over", at(origin(e)));
                continue;
            }
            const double area = areas_[t], other_area = areas_[other];
            larger[good] = area < other_area ? other_area : area;
            smaller[good] = other_area < area ? other_area : area;
            ++good;
            if (!(acute_[t] & acute_[other])) count_violation(e, twin);
        }
        for (std::size_t k = 0; k < good; ++k) larger[k] /= smaller[k];
        findings_.cells.isotropic.add_area_ratios({larger, good});
        findings_.inner_edges += good;
    }

    void count_violation(EdgeLink e, EdgeLink twin) {
        const VertexId* v = piece_.triangles[core::triangle_of(e)].v;
        findings_.cells.delaunay.violations += is_strictly_in_circle(at(v[0]), at(v[1]), at(v[2]), at(apex(twin)));
    }

    /// What is_sharp_corner() needs to know. Frozen edges are those of the border: the mesh does not show that a line
    /// is frozen that dangles in a piece, and there the triangles on both sides are linked.
    struct WalkedEdges {
        const PieceChecker& checker;

        Point origin(EdgeLink e) const { return checker.at(checker.origin(e)); }
        Point target(EdgeLink e) const { return checker.at(checker.target(e)); }
        EdgeLink twin(EdgeLink e) const { return checker.link(e); }
        bool is_frozen(EdgeLink e) const { return twin(e) == core::no_link; }
        EdgeLink next(EdgeLink e) const { return core::edge_of(e) == 2 ? e - 2 : e + 1; }
        EdgeLink previous(EdgeLink e) const { return core::edge_of(e) == 0 ? e + 2 : e - 1; }
    };

    /// Leaves out the narrow triangles at sharp corners between frozen edges.
    void find_unexcused_by_corners() {
        if (findings_.cells.narrow.empty()) return;
        const WalkedEdges edges{*this};
        for (const std::uint32_t t : findings_.cells.narrow) {
            const auto is_sharp = [&](unsigned i) { return is_sharp_corner(edges, core::edge_link(t, i)); };
            if (is_sharp(0) || is_sharp(1) || is_sharp(2)) continue;
            const VertexId* v = piece_.triangles[t].v;
            NarrowTriangle narrow{t, {at(v[0]), at(v[1]), at(v[2])}};
            const std::size_t shortest = shortest_edge(narrow.corners[0], narrow.corners[1], narrow.corners[2]);
            const Segment ends{id(v[shortest]), id(v[(shortest + 1) % 3])};
            if (ends.a.valid() && ends.b.valid()) narrow.shortest = ends;
            findings_.narrow.push_back(narrow);
        }
    }
};

}  // namespace

namespace {

/// The ratios of areas that class 1 begins with, and that the lower ends of successive classes have.
constexpr double first_class = 0.62, class_step = 1.065;

}  // namespace

std::uint8_t shape_class_behind(Point a, Point b, Point apex) {
    constexpr double margin = 1e-6;  // far larger than the rounding errors of the products below
    const Point to_a = a - apex, to_b = b - apex;
    const double scalar = dot(to_a, to_b);
    const double size = std::abs(to_a.x * to_b.x) + std::abs(to_a.y * to_b.y);
    if (!(scalar > margin * size)) return 0;
    constexpr double equilateral = 0.86602540378443865;  // twice its area over its squared edge
    const double relative = cross(b - a, apex - a) / (equilateral * squared_length(b - a));
    if (!(relative >= first_class)) return 0;
    double end = first_class;
    for (std::uint8_t number = 1; number < 16; ++number) {
        end *= class_step;
        if (relative < end) return number;
    }
    return 0;
}

double largest_area_ratio(std::uint8_t one, std::uint8_t other) {
    if (one == 0 || other == 0) return HUGE_VAL;
    double bound = 1 + 1e-6;  // for rounding, also to single precision
    for (int steps = std::abs(one - other); steps >= 0; --steps) bound *= class_step;
    return bound;
}

double least_area_ratio(std::uint8_t one, std::uint8_t other) {
    if (one == 0 || other == 0) return 1;
    double bound = 1 - 1e-6;
    for (int steps = std::abs(one - other); steps > 1; --steps) bound *= class_step;
    return std::max(1.0, bound);
}

PieceFindings check_piece(const LinkedPiece& piece, double min_angle_deg) {
    return PieceChecker(piece, min_angle_deg).check();
}

}  // namespace lamina::mesh
