// The work of references.hpp done by CGAL.
#include <utility>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "references.hpp"

namespace lamina::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::vector<Kernel::Point_2> converted(std::span<const Point> points) {
    std::vector<Kernel::Point_2> result;
    for (const Point p : points) result.emplace_back(p.x, p.y);
    return result;
}

}  // namespace

Work cgal_delaunay(std::span<const Point> points) {
    return [points = converted(points)] {
        CGAL::Delaunay_triangulation_2<Kernel> triangulation;
        triangulation.insert(points.begin(), points.end());
        return triangulation.number_of_faces();
    };
}

Work cgal_constrained(std::span<const Point> points, std::span<const Segment> segments) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const Segment s : segments) pairs.emplace_back(s.a.index(), s.b.index());
    return [points = converted(points), pairs] {
        CGAL::Constrained_Delaunay_triangulation_2<Kernel> triangulation;
        triangulation.insert_constraints(points.begin(), points.end(), pairs.begin(), pairs.end());
        return triangulation.number_of_faces();
    };
}

}  // namespace lamina::bench
