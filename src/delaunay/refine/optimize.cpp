// Smoothing of a triangulation that knows no sizes.
#include <algorithm>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "core/arguments.hpp"
#include "core/bounding_box.hpp"
#include "core/reproducible_math.hpp"
#include "delaunay/refine/refiner.hpp"
#include "delaunay/refine/smoothing.hpp"
#include "delaunay/refine/triangle_shape.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/link_triangles.hpp"

namespace lamina {

using namespace delaunay;

namespace {

/// Allows every triangle that keeps the angle bound.
struct AngleRules {
    double squared_sine;
    static double size_at(Point, Index) { return 0; }
    bool is_allowed(double aa, double bb, double cc, double area2, double) const {
        return !is_angle_below(squared_sine, aa, bb, cc, std::min({aa, bb, cc}), area2);
    }
    /// No bound of refinement is as large as the angles of triangles that are not ill-shaped.
    static constexpr bool is_surely_allowed(double, double, double) { return true; }
    static constexpr double unit() { return 0; }
    static constexpr double gradation() { return 0; }
    static constexpr double size_error() { return 0; }
    static bool is_blocked(const CavityEdge&, const CavityEdge&) { return false; }
};

}  // namespace

OptimizedTriangulation optimize(std::span<const Point> points, std::span<const Triangle> triangles,
                                std::span<const Segment> segments, const OptimizeOptions& options) {
    if (!(options.min_angle_deg >= 0 && options.min_angle_deg <= max_min_angle_deg))
        throw OptionError("min-angle", "must be from 0 to the largest bound of refinement");
    check_points_and_segments(points, segments);
    core::require_indices_below(points.size(), triangles);
    OptimizedTriangulation result{{points.begin(), points.end()}, {}};
    const double scale = points.empty() ? 1 : unit_scale(core::longer_side(core::bounding_box(points)));
    for (Point& p : result.points) p = scale * p;
    Tris tris = link_triangles(triangles, segments);
    std::vector<float> sizes(points.size(), 0);
    const double sine = core::sin_reproducible(core::radians(options.min_angle_deg));
    const auto first_free = static_cast<Index>(std::min(options.fixed_points, points.size()));
    Smoother<AngleRules>({result.points, sizes, tris, first_free}, {sine * sine}).smooth(options.rounds);
    for (Point& p : result.points) p = (1 / scale) * p;
    result.triangles.reserve(tris.size());
    for (const Tri& t : tris) result.triangles.push_back({VertexId{t.v[0]}, VertexId{t.v[1]}, VertexId{t.v[2]}});
    return result;
}

}  // namespace lamina
