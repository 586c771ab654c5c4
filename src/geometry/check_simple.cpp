// The exact test that outlines are simple, counter-clockwise and pairwise apart. Edges that may meet are found by a
// tree of boxes over the edges in the order of the outlines.
#include <lamina/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/predicates.hpp>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/polygon.hpp"
#include "geometry/inside.hpp"

namespace lamina::geometry {

namespace {

/// The edge of an outline from one point to the next.
struct OutlineEdge {
    const Element* element;
    std::size_t index;  ///< of the first point

    std::size_t next() const { return index + 1 == element->points.size() ? 0 : index + 1; }
    Point a() const { return element->points[index]; }
    Point b() const { return element->points[next()]; }
};

// ---- messages ------------------------------------------------------------------------------------------------------

/// Returns the line of the file that holds point i, 0 if none does.
std::size_t line_of(const Element& e, std::size_t i) { return i < e.lines.size() ? e.lines[i] : 0; }

/// Returns the line of the first point that stands in the file, from point i forward or backward; 0 if none does.
std::size_t line_near(const Element& e, std::size_t i, bool forward) {
    const std::size_t n = e.points.size();
    for (std::size_t step = 0; step < n; ++step) {
        const std::size_t line = line_of(e, forward ? (i + step) % n : (i + n - step) % n);
        if (line > 0) return line;
    }
    return 0;
}

std::string describe(const OutlineEdge& edge) {
    const Element& e = *edge.element;
    const std::size_t a = line_near(e, edge.index, false), b = line_near(e, edge.next(), true);
    if (a == 0) return fmt::format("the edge of points {} and {}", edge.index + 1, edge.next() + 1);
    const bool closes = line_of(e, edge.index) == 0 || line_of(e, edge.next()) == 0;
    return fmt::format("the {} of lines {} and {}", closes ? "closing edge" : "edge", std::min(a, b), std::max(a, b));
}

/// Returns advice where two elements of different files cover about the same stretch of x, as sections do that are to
/// be meshed one by one; else nothing.
std::string advice_on_separate_sections(const Element& e, const Element& f) {
    constexpr double max_offset = 0.1;  // of the shorter section
    const Box a = core::bounding_box(e.points), b = core::bounding_box(f.points);
    const double offset = std::max(std::abs(a.lower.x - b.lower.x), std::abs(a.upper.x - b.upper.x));
    if (e.file == f.file || offset > max_offset * std::min(a.width(), b.width())) return "";
    return fmt::format(
        "; both reach from about x = {:.3g} to {:.3g}, like sections of their own rather than elements of one "
        "configuration: mesh each in a run of its own, as in: for f in *.dat; do lamina mesh \"$f\" -o "
        "\"${{f%.*}}.vtu\"; done",
        a.lower.x, a.upper.x);
}

/// Throws InputError for the place where two edges meet: of a point of the first one, where they belong to two
/// elements.
[[noreturn]] void refuse(const OutlineEdge& first, const OutlineEdge& second, Point at, const std::string& verb) {
    const Element &e = *first.element, &f = *second.element;
    const std::string reason =
        &e == &f ? fmt::format("the outline {} itself: {} and {}", verb, describe(first), describe(second))
                 : fmt::format("the outline {} that of '{}' ({}): {} and there {}; --union joins them{}", verb, f.name,
                               f.file, describe(first), describe(second), advice_on_separate_sections(e, f));
    const std::size_t line =
        &e != &f && at == first.b() ? line_near(e, first.next(), true) : line_near(e, first.index, false);
    throw InputError({e.file, line, at}, reason);
}

/// Returns the point where two edges cross, rounded, for messages only.
Point crossing_point(const OutlineEdge& e, const OutlineEdge& f) {
    const Point d = e.b() - e.a(), g = f.b() - f.a();
    return e.a() + (cross(f.a() - e.a(), g) / cross(d, g)) * d;
}

// ---- pairs of edges ------------------------------------------------------------------------------------------------

/// Returns whether p lies on the closed segment a-b. Precondition: p lies on the line through a and b.
bool is_between(Point p, Point a, Point b) {
    return lexicographically_less(a, b) ? !lexicographically_less(p, a) && !lexicographically_less(b, p)
                                        : !lexicographically_less(p, b) && !lexicographically_less(a, p);
}

/// Throws InputError where edges without a common vertex meet.
void check_apart(const OutlineEdge& e, const OutlineEdge& f) {
    const Point a = e.a(), b = e.b(), c = f.a(), d = f.b();
    const double a_side = orient2d(c, d, a), b_side = orient2d(c, d, b), c_side = orient2d(a, b, c),
                 d_side = orient2d(a, b, d);
    if (((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0)) &&
        ((c_side > 0 && d_side < 0) || (c_side < 0 && d_side > 0)))
        refuse(e, f, crossing_point(e, f), "crosses");
    if (a_side == 0 && is_between(a, c, d)) refuse(e, f, a, "touches");
    if (b_side == 0 && is_between(b, c, d)) refuse(e, f, b, "touches");
    const auto &first = e.element == f.element ? e : f, &second = e.element == f.element ? f : e;
    if (c_side == 0 && is_between(c, a, b)) refuse(first, second, c, "touches");
    if (d_side == 0 && is_between(d, a, b)) refuse(first, second, d, "touches");
}

/// Throws InputError where consecutive edges a-b and b-c share more than b.
void check_neighbours(const OutlineEdge& first, const OutlineEdge& second) {
    const Point a = first.a(), b = first.b(), c = second.b();
    if (orient2d(a, b, c) != 0 || lexicographically_less(a, b) != lexicographically_less(c, b)) return;
    throw InputError(
        {first.element->file, line_of(*first.element, first.next()), b},
        fmt::format("the outline folds back on itself: {} and {} overlap", describe(first), describe(second)));
}

/// Throws InputError where any two edges meet that are not consecutive.
void check_all_pairs(const std::vector<OutlineEdge>& edges) {
    std::vector<Box> boxes;
    boxes.reserve(edges.size());
    for (const OutlineEdge& edge : edges) boxes.push_back(core::bounding_box(edge.a(), edge.b()));
    core::BoxTree(std::move(boxes)).overlapping_pairs([&](std::size_t i, std::size_t j) {
        const OutlineEdge &e = edges[i], &f = edges[j];
        const bool consecutive = e.element == f.element && (e.next() == f.index || f.next() == e.index);
        if (!consecutive) check_apart(e, f);
    });
}

// ---- whole outlines ------------------------------------------------------------------------------------------------

/// Throws InputError for fewer than three points, points outside the exact range and repeated points.
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

/// Throws InputError for a clockwise outline. Precondition: the outline is simple.
void check_orientation(const Element& e) {
    const auto vertex = [&](std::size_t i) { return e.points[i]; };
    if (core::polygon_orientation(e.points.size(), vertex) > 0) return;
    const std::size_t i = core::smallest_vertex(e.points.size(), vertex);
    throw InputError({e.file, line_near(e, i, true), e.points[i]}, "the outline runs clockwise");
}

/// Throws InputError where an element lies inside another one. Precondition: no two outlines touch.
void check_side_by_side(const std::vector<Element>& elements) {
    std::vector<Box> boxes;
    boxes.reserve(elements.size());
    for (const Element& e : elements) boxes.push_back(core::bounding_box(e.points));
    std::optional<std::pair<std::size_t, std::size_t>> first;  // the first element that lies inside, and round it
    const auto look = [&](std::size_t i, std::size_t j) {
        const Point p = elements[i].points[0];
        if (boxes[j].contains(p) && contains(elements[j].points, p))
            first = std::min(first.value_or(std::pair(i, j)), {i, j});
    };
    core::BoxTree(boxes).overlapping_pairs([&](std::size_t i, std::size_t j) {
        look(i, j);
        look(j, i);
    });
    if (!first) return;
    const Element &inner = elements[first->first], &outer = elements[first->second];
    throw InputError(
        {inner.file, line_near(inner, 0, true), inner.points[0]},
        fmt::format("'{}' lies inside '{}' ({}); elements must lie side by side, and --union joins those that do not"
                    "{}",
                    inner.name, outer.name, outer.file, advice_on_separate_sections(inner, outer)));
}

}  // namespace

}  // namespace lamina::geometry

namespace lamina {

using namespace geometry;

void check_simple(const Geometry& geometry) {
    std::vector<OutlineEdge> edges;
    for (const Element& e : geometry.elements) {
        check_points(e);
        for (std::size_t i = 0; i < e.points.size(); ++i) {
            edges.push_back({&e, i});
            check_neighbours(edges.back(), {&e, edges.back().next()});
        }
    }
    check_all_pairs(edges);
    for (const Element& e : geometry.elements) check_orientation(e);
    check_side_by_side(geometry.elements);
}

}  // namespace lamina
