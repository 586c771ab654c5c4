#include "mesh/check_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/check_markers.hpp"
#include "mesh/walls.hpp"

namespace lamina::mesh {

namespace {

/// Checks sums that hold for every valid mesh. It follows from check_boundary() that they hold: this is a second,
/// independent look.
void check_totals(const MeshCheck& check, const BoundarySummary& boundary, DefectList& defects) {
    // A connected plane domain with k holes has the characteristic 1 - k, one outer loop and k inner ones.
    const long expected = 2 * static_cast<long>(boundary.outer_loops) - static_cast<long>(boundary.loops);
    if (check.euler_characteristic != expected)
        defects.add([&] {
            return MeshDefect{fmt::format("Euler characteristic {} where the boundary loops ask for {}",
                                          check.euler_characteristic, expected),
                              {}};
        });
    // The tolerance is generous for the rounding errors of 1e9 cells, and too small for a cell to hide in.
    constexpr double rounding = 1e-9;
    if (!(std::abs(check.area - boundary.area) <= rounding * boundary.area_magnitude))
        defects.add([&] {
            return MeshDefect{
                fmt::format("the cells' areas sum to {}, the boundary encloses {}", check.area, boundary.area), {}};
        });
}

}  // namespace

void measure_boundary(std::span<const Point> points, std::span<const Marker> markers,
                      std::span<const BoundaryEdge> boundary, const MeshCheckOptions& options, MeshCheck& check) {
    check.walls = measure_walls(points, markers, boundary, options);
    const std::vector<Segment> walls = sorted_wall_edges(markers);
    check.edges_without_first_layer =
        static_cast<std::size_t>(std::count_if(boundary.begin(), boundary.end(), [&](const BoundaryEdge& edge) {
            return edge.beyond_first_layer && std::binary_search(walls.begin(), walls.end(), edge.ends);
        }));
}

void check_whole_boundary(std::span<const Point> points, std::span<const Marker> markers,
                          std::span<const BoundaryEdge> boundary, bool conforming, MeshCheck& check,
                          DefectList& defects) {
    const std::vector<Segment> edges = sorted_ends(boundary);
    check_markers(points, markers, edges, defects);
    if (!conforming) return;
    BoundarySummary summary = check_boundary(points, edges, slit_edges(points, markers));
    check.boundary_loops = summary.loops;
    defects.append(std::move(summary.defects));
    if (defects.empty()) check_totals(check, summary, defects);
}

void take_checked_boundary(const BoundarySummary& boundary, MeshCheck& check, DefectList& defects) {
    check.boundary_loops = boundary.loops;
    if (defects.empty()) check_totals(check, boundary, defects);
}

}  // namespace lamina::mesh
