#include "mesh/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/polygon.hpp"
#include "core/predicates.hpp"

namespace lamina::mesh {

namespace {

/// The edges of all loops, loop by loop; loop l is [first[l], first[l + 1]).
struct BoundaryLoops {
    std::vector<Segment> edges;
    std::vector<std::uint32_t> first;
};

Box box_of(std::span<const Point> points, const Segment& edge) {
    Box box;
    box.include(points[edge.a.index()]);
    box.include(points[edge.b.index()]);
    return box;
}

/// Returns a tree over the edges in the order of the loops, in which successive edges lie close together.
core::BoxTree make_tree(std::span<const Point> points, std::span<const Segment> edges) {
    std::vector<Box> boxes;
    boxes.reserve(edges.size());
    for (const Segment& edge : edges) boxes.push_back(box_of(points, edge));
    return core::BoxTree(std::move(boxes));
}

/// Follows the edges round their loops. The loops are sorted by their lexicographically smallest points, so that
/// neighbours in the list lie close together. Precondition: the edges are sorted, and no two begin at one vertex.
BoundaryLoops trace_loops(std::span<const Point> points, std::span<const Segment> edges) {
    const auto next = [&](const Segment& edge) {
        const auto found = std::lower_bound(edges.begin(), edges.end(), Segment{edge.b, VertexId(0)});
        assert(found != edges.end() && found->a == edge.b);
        return static_cast<std::size_t>(found - edges.begin());
    };
    struct LoopStart {
        std::size_t edge;
        Point smallest;
    };
    std::vector<LoopStart> starts;
    std::vector<bool> seen(edges.size(), false);
    for (std::size_t start = 0; start < edges.size(); ++start) {
        if (seen[start]) continue;
        starts.push_back({start, points[edges[start].a.index()]});
        for (std::size_t e = start; !seen[e]; e = next(edges[e])) {
            seen[e] = true;
            const Point p = points[edges[e].a.index()];
            if (lexicographically_less(p, starts.back().smallest)) starts.back().smallest = p;
        }
    }
    std::stable_sort(starts.begin(), starts.end(), [](const LoopStart& a, const LoopStart& b) {
        return lexicographically_less(a.smallest, b.smallest);
    });

    BoundaryLoops loops;
    loops.edges.reserve(edges.size());
    for (const LoopStart& start : starts) {
        loops.first.push_back(static_cast<std::uint32_t>(loops.edges.size()));
        std::size_t e = start.edge;
        do {
            loops.edges.push_back(edges[e]);
            e = next(edges[e]);
        } while (e != start.edge);
    }
    loops.first.push_back(static_cast<std::uint32_t>(loops.edges.size()));
    return loops;
}

/// Returns 1, 0 or -1 for counter-clockwise, collinear and clockwise points. Exact.
int orientation(Point a, Point b, Point c) {
    const double value = core::inline_orient2d(a, b, c);
    return (value > 0) - (value < 0);
}

/// Returns whether the segments have more in common than one shared end vertex. Exact.
bool have_improper_contact(std::span<const Point> points, const Segment& s, const Segment& t) {
    const Point a = points[s.a.index()], b = points[s.b.index()], c = points[t.a.index()], d = points[t.b.index()];
    if (s.b == t.a || s.a == t.b) {
        if (s.b == t.a && s.a == t.b) return true;
        // q is the shared vertex.
        const auto [p, q, r] = s.b == t.a ? std::array{a, b, d} : std::array{b, a, c};
        return orientation(p, q, r) == 0 && lexicographically_less(p, q) == lexicographically_less(r, q);
    }
    const int c_side = orientation(a, b, c), d_side = orientation(a, b, d);
    const int a_side = orientation(c, d, a), b_side = orientation(c, d, b);
    return (c_side * d_side < 0 && a_side * b_side < 0) || (c_side == 0 && box_of(points, s).contains(c)) ||
           (d_side == 0 && box_of(points, s).contains(d)) || (a_side == 0 && box_of(points, t).contains(a)) ||
           (b_side == 0 && box_of(points, t).contains(b));
}

/// The walls without thickness: where edges may lie at the same place.
class Slits {
public:
    explicit Slits(std::span<const SlitEdge> edges) : edges_(edges) {
        for (const SlitEdge& slit : edges) {
            vertices_.push_back(slit.edge.a);
            vertices_.push_back(slit.edge.b);
        }
        std::sort(vertices_.begin(), vertices_.end());
    }

    /// Returns whether the contact of two edges is that of two sides of such a wall: they are the same edge seen from
    /// both sides, or meet in one end at which each has a vertex of such a wall, and nowhere else.
    bool allow(std::span<const Point> points, const Segment& s, const Segment& t) const {
        if (edges_.empty()) return false;
        const auto found = std::lower_bound(edges_.begin(), edges_.end(), SlitEdge{s, {}});
        if (found != edges_.end() && found->edge == s && found->twin == t) return true;
        for (const auto& [p, q] : {std::pair{s.a, s.b}, std::pair{s.b, s.a}})
            for (const auto& [u, r] : {std::pair{t.a, t.b}, std::pair{t.b, t.a}}) {
                if (q == u || points[q.index()] != points[u.index()] || !is_vertex(q) || !is_vertex(u)) continue;
                const Point a = points[p.index()], b = points[q.index()], c = points[r.index()];
                return orientation(a, b, c) != 0 || lexicographically_less(a, b) != lexicographically_less(c, b);
            }
        return false;
    }

    bool is_vertex(VertexId v) const { return std::binary_search(vertices_.begin(), vertices_.end(), v); }

private:
    std::span<const SlitEdge> edges_;
    std::vector<VertexId> vertices_;
};

void check_contacts(std::span<const Point> points, const BoundaryLoops& loops, const core::BoxTree& tree,
                    const Slits& slits, DefectList& defects) {
    const auto check_edges = [&](std::size_t begin, std::size_t end) {
        DefectList found;
        for (std::size_t i = begin; i < end; ++i) {
            const Segment& s = loops.edges[i];
            tree.overlaps(box_of(points, s), [&](std::size_t j) {
                const Segment& t = loops.edges[j];
                if (j > i && have_improper_contact(points, s, t) && !slits.allow(points, s, t))
                    found.add([&] {
                        return MeshDefect{fmt::format("boundary edges {}-{} and {}-{} cross, touch or overlap",
                                                      s.a.value, s.b.value, t.a.value, t.b.value),
                                          points[s.a.index()]};
                    });
            });
        }
        return found;
    };
    for (DefectList& found : core::parallel_blocks(loops.edges.size(), 1024, check_edges))
        defects.append(std::move(found));
}

/// Returns whether a loop is counter-clockwise. Exact. Walls without thickness lie inside the domain, so a loop whose
/// smallest vertex is one of theirs is not.
bool is_counter_clockwise(std::span<const Point> points, std::span<const Segment> loop, const Slits& slits) {
    const auto vertex = [&](std::size_t i) { return points[loop[i].a.index()]; };
    if (slits.is_vertex(loop[core::smallest_vertex(loop.size(), vertex)].a)) return false;
    return core::polygon_orientation(loop.size(), vertex) > 0;
}

/// Returns the winding number of all other loops round a vertex of loop l: the signed number of their crossings with
/// the ray from the vertex to the right.
long winding_of_others(std::span<const Point> points, const BoundaryLoops& loops, const core::BoxTree& tree,
                       std::size_t l) {
    const Point p = points[loops.edges[loops.first[l]].a.index()];
    long winding = 0;
    tree.overlaps({p, {HUGE_VAL, p.y}}, [&](std::size_t e) {
        if (e >= loops.first[l] && e < loops.first[l + 1]) return;
        const Point a = points[loops.edges[e].a.index()], b = points[loops.edges[e].b.index()];
        if ((a.y <= p.y) == (b.y <= p.y)) return;  // half-open, so that a vertex on the ray counts once
        const int side = orientation(a, b, p);
        if (a.y <= p.y && side > 0) ++winding;
        if (b.y <= p.y && side < 0) --winding;
    });
    return winding;
}

/// Checks how the loops are nested. In a valid mesh a counter-clockwise loop lies outside all other domains, where the
/// winding number of the other loops is 0, and a clockwise one inside exactly one domain, where it is 1.
void check_nesting(std::span<const Point> points, const BoundaryLoops& loops, const core::BoxTree& tree,
                   const Slits& slits, BoundarySummary& summary) {
    for (std::size_t l = 0; l + 1 < loops.first.size(); ++l) {
        const std::span loop(loops.edges.data() + loops.first[l], loops.first[l + 1] - loops.first[l]);
        const bool outer = is_counter_clockwise(points, loop, slits);
        summary.outer_loops += outer;
        if (winding_of_others(points, loops, tree, l) != (outer ? 0 : 1))
            summary.defects.add([&] {
                return MeshDefect{fmt::format("the boundary loop through vertex {} bounds cells that overlap others",
                                              loop[0].a.value),
                                  points[loop[0].a.index()]};
            });
    }
}

void add_areas(std::span<const Point> points, const BoundaryLoops& loops, BoundarySummary& summary) {
    Box box;
    for (const Segment& e : loops.edges) box.include(points[e.a.index()]);
    const Point center = box.center();
    for (const Segment& e : loops.edges) {
        const double part = 0.5 * cross(points[e.a.index()] - center, points[e.b.index()] - center);
        summary.area += part;
        summary.area_magnitude += std::abs(part);
    }
}

}  // namespace

BoundarySummary check_boundary(std::span<const Point> points, std::vector<Segment> edges,
                               std::span<const SlitEdge> slits) {
    BoundarySummary summary;
    if (edges.empty()) return summary;
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (edges[i].a == edges[i - 1].a)
            summary.defects.add([&] {
                return MeshDefect{fmt::format("the boundary passes twice through vertex {}", edges[i].a.value),
                                  points[edges[i].a.index()]};
            });
    // Where the boundary passes a vertex twice, it is not defined which edge follows which.
    if (!summary.defects.empty()) return summary;

    const BoundaryLoops loops = trace_loops(points, edges);
    const core::BoxTree tree = make_tree(points, loops.edges);
    summary.loops = loops.first.size() - 1;
    add_areas(points, loops, summary);
    const Slits walls_without_thickness(slits);
    check_contacts(points, loops, tree, walls_without_thickness, summary.defects);
    if (summary.defects.empty()) check_nesting(points, loops, tree, walls_without_thickness, summary);
    return summary;
}

}  // namespace lamina::mesh
