// Are the outlines simple, counter-clockwise and pairwise apart? Exact.
// Edges that may meet are found by a tree of boxes over the edges in the order of the outline (every node covers a run
// of consecutive edges), traversed against itself: neighbouring runs touch at one point only, so on real outlines the
// number of overlapping pairs of nodes is O(n), whatever the grading of the points.
// Source: G. Barequet et al., BOXTREE: a hierarchical representation for surfaces in 3D, Comput. Graph. Forum 15
// (1996).
#include <fmt/format.h>

#include <algorithm>
#include <lamina/geometry.hpp>
#include <lamina/predicates.hpp>
#include <utility>

namespace lamina::geometry {

namespace {

struct Edge {
    const Element* element;
    std::size_t index;  ///< from points[index] to the next

    std::size_t next() const { return index + 1 == element->points.size() ? 0 : index + 1; }
    Point a() const { return element->points[index]; }
    Point b() const { return element->points[next()]; }
};

// ---- messages ------------------------------------------------------------------------------------------------------

std::size_t line_of(const Element& e, std::size_t i) { return i < e.lines.size() ? e.lines[i] : 0; }

/// The nearest point at or before/after i that stands in the file.
std::size_t line_near(const Element& e, std::size_t i, bool forward) {
    const std::size_t n = e.points.size();
    for (std::size_t step = 0; step < n; ++step) {
        const std::size_t line = line_of(e, forward ? (i + step) % n : (i + n - step) % n);
        if (line > 0) return line;
    }
    return 0;
}

std::string name_of(const Edge& edge) {
    const Element& e = *edge.element;
    const std::size_t a = line_near(e, edge.index, false), b = line_near(e, edge.next(), true);
    if (a == 0) return fmt::format("the edge of points {} and {}", edge.index + 1, edge.next() + 1);
    const bool added = line_of(e, edge.index) == 0 || line_of(e, edge.next()) == 0;
    return fmt::format("the {} of lines {} and {}", added ? "closing edge" : "edge", std::min(a, b), std::max(a, b));
}

[[noreturn]] void refuse(const Edge& first, const Edge& second, Point at, const std::string& verb) {
    const Element &e = *first.element, &f = *second.element;
    const bool same = &e == &f;
    const std::string reason =
        same ? fmt::format("the outline {} itself: {} and {}", verb, name_of(first), name_of(second))
             : fmt::format("the outline {} that of '{}' ({}): {} and there {}", verb, f.name, f.file, name_of(first),
                           name_of(second));
    throw InputError({e.file, line_near(e, first.index, false), at}, reason);
}

/// Rounded; only for messages.
Point crossing_point(const Edge& e, const Edge& f) {
    const Point d = e.b() - e.a(), g = f.b() - f.a();
    return e.a() + (cross(f.a() - e.a(), g) / cross(d, g)) * d;
}

// ---- pairs of edges ------------------------------------------------------------------------------------------------

Box box_of(const Edge& e) {
    Box box;
    box.include(e.a());
    box.include(e.b());
    return box;
}

/// p is known to be on the line through a and b.
bool within(Point p, Point a, Point b) {
    return lexicographically_less(a, b) ? !lexicographically_less(p, a) && !lexicographically_less(b, p)
                                        : !lexicographically_less(p, b) && !lexicographically_less(a, p);
}

/// Edges without a common vertex may not meet at all.
void check_apart(const Edge& e, const Edge& f) {
    const Point a = e.a(), b = e.b(), c = f.a(), d = f.b();
    const double oa = orient2d(c, d, a), ob = orient2d(c, d, b), oc = orient2d(a, b, c), od = orient2d(a, b, d);
    if (((oa > 0 && ob < 0) || (oa < 0 && ob > 0)) && ((oc > 0 && od < 0) || (oc < 0 && od > 0)))
        refuse(e, f, crossing_point(e, f), "crosses");
    if (oa == 0 && within(a, c, d)) refuse(e, f, a, "touches");
    if (ob == 0 && within(b, c, d)) refuse(e, f, b, "touches");
    if (oc == 0 && within(c, a, b)) refuse(e, f, c, "touches");
    if (od == 0 && within(d, a, b)) refuse(e, f, d, "touches");
}

void check_pair(const Edge& e, const Edge& f) {
    if (!box_of(e).overlaps(box_of(f))) return;
    const bool neighbours = e.element == f.element && (e.next() == f.index || f.next() == e.index);
    if (!neighbours) check_apart(e, f);
}

// ---- all pairs -----------------------------------------------------------------------------------------------------

/// Implicit binary tree: node 1 covers all leaves, node k has the children 2k and 2k + 1.
class EdgeTree {
public:
    explicit EdgeTree(const std::vector<Edge>& edges) : edges_(edges) {
        while (leaves_ < edges.size()) leaves_ *= 2;
        boxes_.resize(2 * leaves_);  // empty boxes overlap nothing
        for (std::size_t i = 0; i < edges.size(); ++i) boxes_[leaves_ + i] = box_of(edges[i]);
        for (std::size_t k = leaves_ - 1; k > 0; --k) {
            const Box &a = boxes_[2 * k], &b = boxes_[2 * k + 1];
            boxes_[k] = {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y)},
                         {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y)}};
        }
    }

    /// Every pair of edges whose boxes overlap, once, in an order that depends on the edges alone.
    void check_all_pairs() const {
        std::vector<std::pair<std::size_t, std::size_t>> stack{{1, 1}};
        while (!stack.empty()) {
            const auto [k, m] = stack.back();
            stack.pop_back();
            if (k == m) {
                if (k >= leaves_) continue;
                stack.insert(stack.end(), {{2 * k, 2 * k + 1}, {2 * k + 1, 2 * k + 1}, {2 * k, 2 * k}});
            } else if (boxes_[k].overlaps(boxes_[m])) {
                if (k >= leaves_) {  // both are leaves: pairs are of one level
                    check_pair(edges_[k - leaves_], edges_[m - leaves_]);
                } else {
                    stack.insert(stack.end(),
                                 {{2 * k + 1, 2 * m + 1}, {2 * k + 1, 2 * m}, {2 * k, 2 * m + 1}, {2 * k, 2 * m}});
                }
            }
        }
    }

private:
    const std::vector<Edge>& edges_;
    std::size_t leaves_ = 1;
    std::vector<Box> boxes_;
};

// ---- whole outlines ------------------------------------------------------------------------------------------------

void check_points(const Element& e) {
    const std::size_t n = e.points.size();
    const InputPlace place{e.file, n > 0 ? line_near(e, 0, true) : 0, {}};
    if (n < 3) throw InputError(place, fmt::format("only {} points; an outline needs at least three", n));
    for (std::size_t i = 0; i < n; ++i) {
        if (!in_exact_range(e.points[i]))
            throw InputError({e.file, line_of(e, i), e.points[i]}, "coordinates outside the exact range");
        if (e.points[i] == e.points[(i + 1) % n])
            throw InputError({e.file, line_of(e, i), e.points[i]}, "a point is repeated");
    }
}

/// Consecutive edges a-b and b-c may share b only.
void check_neighbours(const Edge& first, const Edge& second) {
    const Point a = first.a(), b = first.b(), c = second.b();
    if (orient2d(a, b, c) == 0 && lexicographically_less(a, b) == lexicographically_less(c, b)) {
        const std::size_t line = line_of(*first.element, first.next());
        throw InputError(
            {first.element->file, line, b},
            fmt::format("the outline folds back on itself: {} and {} overlap", name_of(first), name_of(second)));
    }
}

/// Precondition: simple.
void check_orientation(const Element& e) {
    const std::size_t n = e.points.size();
    const auto i = static_cast<std::size_t>(std::min_element(e.points.begin(), e.points.end(), lexicographically_less) -
                                            e.points.begin());
    if (orient2d(e.points[(i + n - 1) % n], e.points[i], e.points[(i + 1) % n]) <= 0)
        throw InputError({e.file, line_near(e, i, true), e.points[i]}, "the outline runs clockwise");
}

/// Precondition: p is not on the outline. Crossings of the ray from p towards +x.
bool contains(const Element& e, Point p) {
    bool inside = false;
    for (std::size_t i = 0, n = e.points.size(); i < n; ++i) {
        const Point a = e.points[i], b = e.points[(i + 1) % n];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        if ((orient2d(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
}

/// Precondition: no two outlines touch.
void check_side_by_side(const std::vector<Element>& elements) {
    std::vector<Box> boxes(elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i)
        for (Point p : elements[i].points) boxes[i].include(p);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const Element& inner = elements[i];
        for (std::size_t j = 0; j < elements.size(); ++j) {
            if (i == j || !boxes[j].contains(inner.points[0]) || !contains(elements[j], inner.points[0])) continue;
            throw InputError({inner.file, line_near(inner, 0, true), inner.points[0]},
                             fmt::format("'{}' lies inside '{}' ({}); elements must lie side by side", inner.name,
                                         elements[j].name, elements[j].file));
        }
    }
}

}  // namespace

}  // namespace lamina::geometry

namespace lamina {

using namespace geometry;

void check_simple(const Geometry& geometry) {
    std::vector<Edge> edges;
    for (const Element& e : geometry.elements) {
        check_points(e);
        for (std::size_t i = 0; i < e.points.size(); ++i) {
            edges.push_back({&e, i});
            check_neighbours(edges.back(), {&e, edges.back().next()});
        }
    }
    if (edges.empty()) return;
    EdgeTree(edges).check_all_pairs();
    for (const Element& e : geometry.elements) check_orientation(e);
    check_side_by_side(geometry.elements);
}

}  // namespace lamina
