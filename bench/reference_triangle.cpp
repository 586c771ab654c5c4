// The work of references.hpp done by Triangle. Its switches are p (segments), c (keep the convex hull), r (refine the
// mesh given), YY (split no segment), q (smallest angle), a (largest area), u (call triunsuitable()), z (count from 0),
// Q (be quiet), and B, P, N (leave markers, segments, nodes out of the output).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#define REAL double
#define VOID int
extern "C" {
#include <triangle.h>
int triunsuitable(REAL* a, REAL* b, REAL* c, REAL area);
}

#include "references.hpp"

namespace lamina::bench {

namespace {

/// The size bound in force. It is global because Triangle's hook, triunsuitable(), gets no other argument.
struct {
    double size, gradation;  ///< h(x) = size + gradation x
    const SizeField* field;  ///< if there is one, it is h instead
    double factor;           ///< the area bound of this pass over the final one
} sizing;

/// Points and segments in the arrays that Triangle reads.
struct TriangleProgramInput {
    std::vector<REAL> points;
    std::vector<int> segments;

    explicit TriangleProgramInput(std::span<const Point> from, std::span<const Segment> edges = {}) {
        for (const Point p : from) points.insert(points.end(), {p.x, p.y});
        for (const Segment s : edges)
            segments.insert(segments.end(), {static_cast<int>(s.a.index()), static_cast<int>(s.b.index())});
    }
};

void free_output(triangulateio& io) {
    for (REAL* array : {io.pointlist, io.pointattributelist, io.triangleattributelist}) std::free(array);
    for (int* array : {io.pointmarkerlist, io.trianglelist, io.segmentlist, io.segmentmarkerlist}) std::free(array);
}

triangulateio call(const std::string& switches, triangulateio& in) {
    triangulateio out{};
    std::string text = switches;  // triangulate() takes a pointer to non-const
    triangulate(text.data(), &in, &out, nullptr);
    return out;
}

/// Returns Triangle's view of the arrays, which stay where they are.
triangulateio view(TriangleProgramInput& input) {
    triangulateio in{};
    in.pointlist = input.points.data();
    in.numberofpoints = static_cast<int>(input.points.size() / 2);
    in.segmentlist = input.segments.data();
    in.numberofsegments = static_cast<int>(input.segments.size() / 2);
    return in;
}

Work single_call(TriangleProgramInput input, std::string switches) {
    return [input = std::move(input), switches]() mutable {
        triangulateio in = view(input);
        triangulateio out = call(switches, in);
        const auto triangles = static_cast<std::size_t>(out.numberoftriangles);
        free_output(out);
        return triangles;
    };
}

}  // namespace

Work triangle_delaunay(std::span<const Point> points) { return single_call(TriangleProgramInput(points), "zQBN"); }

Work triangle_constrained(std::span<const Point> points, std::span<const Segment> segments) {
    return single_call(TriangleProgramInput(points, segments), "pczQBPN");
}

namespace {

/// Refines with the bound in `sizing`, whose factor it sets for each pass. `area` is sqrt(3)/4 h^2 if h is the same
/// everywhere, else 0. Returns the number of triangles.
std::size_t refine_in_passes(triangulateio io, double area, double min_angle_deg) {
    char angle[32];
    std::snprintf(angle, sizeof angle, "%.4f", min_angle_deg);
    bool first = true;
    for (const double factor : {4096.0, 256.0, 16.0, 1.0}) {
        sizing.factor = factor;
        std::string switches = std::string(first ? "p" : "rp") + "YYzQBq" + angle;
        if (area > 0) {  // Triangle tests this by itself, without a call of triunsuitable() for each triangle
            char bound[64];
            std::snprintf(bound, sizeof bound, "a%.24f", area * factor);
            switches += bound;
        } else {
            switches += "u";
        }
        triangulateio out = call(switches, io);
        if (!first) free_output(io);
        io = out;
        first = false;
    }
    const auto triangles = static_cast<std::size_t>(io.numberoftriangles);
    free_output(io);
    return triangles;
}

}  // namespace

Work triangle_refine(std::span<const Point> points, std::span<const Segment> segments, double size, double gradation,
                     double min_angle_deg) {
    return [input = TriangleProgramInput(points, segments), size, gradation, min_angle_deg]() mutable {
        sizing = {size, gradation, nullptr, 1};
        return refine_in_passes(view(input), gradation == 0 ? equilateral_area * size * size : 0, min_angle_deg);
    };
}

Work triangle_refine(std::span<const Point> points, std::span<const Segment> segments, Point hole,
                     const SizeField& field, double min_angle_deg) {
    return [input = TriangleProgramInput(points, segments), hole, field, min_angle_deg]() mutable {
        sizing = {0, 0, &field, 1};
        triangulateio in = view(input);
        REAL holes[] = {hole.x, hole.y};
        in.holelist = holes;
        in.numberofholes = 1;
        return refine_in_passes(in, 0, min_angle_deg);
    };
}

}  // namespace lamina::bench

int triunsuitable(REAL* a, REAL* b, REAL* c, REAL area) {
    const auto& s = lamina::bench::sizing;
    const lamina::Point center{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3};
    const double h = s.field != nullptr ? (*s.field)(center) : s.size + s.gradation * center.x;
    return area > s.factor * lamina::equilateral_area * h * h;
}
