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

/// The size function in force: Triangle's hook has no other way to it.
struct {
    double size, gradation, factor;
} sizing;

/// Input as Triangle wants it.
struct Input {
    std::vector<REAL> points;
    std::vector<int> segments;

    explicit Input(std::span<const Point> from, std::span<const Segment> edges = {}) {
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
    std::string text = switches;  // it is not const there
    triangulate(text.data(), &in, &out, nullptr);
    return out;
}

triangulateio view(Input& input) {
    triangulateio in{};
    in.pointlist = input.points.data();
    in.numberofpoints = static_cast<int>(input.points.size() / 2);
    in.segmentlist = input.segments.data();
    in.numberofsegments = static_cast<int>(input.segments.size() / 2);
    return in;
}

Work single_call(Input input, std::string switches) {
    return [input = std::move(input), switches]() mutable {
        triangulateio in = view(input);
        triangulateio out = call(switches, in);
        const auto triangles = static_cast<std::size_t>(out.numberoftriangles);
        free_output(out);
        return triangles;
    };
}

}  // namespace

Work triangle_delaunay(std::span<const Point> points) { return single_call(Input(points), "zQBN"); }

Work triangle_constrained(std::span<const Point> points, std::span<const Segment> segments) {
    return single_call(Input(points, segments), "pczQBPN");
}

Work triangle_refine(std::span<const Point> points, std::span<const Segment> segments, double size, double gradation,
                     double min_angle_deg) {
    return [input = Input(points, segments), size, gradation, min_angle_deg]() mutable {
        char angle[32];
        std::snprintf(angle, sizeof angle, "%.4f", min_angle_deg);
        triangulateio io = view(input);
        bool first = true;
        for (const double factor : {4096.0, 256.0, 16.0, 1.0}) {
            sizing = {size, gradation, factor};
            std::string switches = std::string(first ? "p" : "rp") + "YYzQBq" + angle;
            if (gradation == 0) {  // its own test, without a call for each triangle
                char area[64];
                std::snprintf(area, sizeof area, "a%.24f", std::sqrt(3.0) / 4 * size * size * factor);
                switches += area;
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
    };
}

}  // namespace lamina::bench

int triunsuitable(REAL* a, REAL* b, REAL* c, REAL area) {
    const auto& s = lamina::bench::sizing;
    const double h = s.size + s.gradation * ((a[0] + b[0] + c[0]) / 3);
    return area > s.factor * 0.43301270189221932 * h * h;
}
