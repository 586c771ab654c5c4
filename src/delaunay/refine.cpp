// refine() fills large, evenly sized parts of the region with lattices where that pays, and refines all the rest.
#include <utility>
#include <vector>

#include <lamina/delaunay.hpp>

#include "delaunay/arguments.hpp"
#include "delaunay/lattice.hpp"
#include "delaunay/refine_region.hpp"
#include "delaunay/refiner.hpp"

namespace lamina {

using namespace delaunay;

namespace {

/// The seam between the border of a region and its lattice patches, as a region of its own: the boundaries of the
/// patches are frozen like the border. Its points are those of the border, then those of the patches that it shares.
struct Seam {
    std::vector<Point> points;
    std::vector<Segment> segments;
    std::vector<VertexId> shared;  ///< indices into LatticePatches::points
};

Seam make_seam(std::span<const Point> points, std::span<const Segment> segments, const LatticePatches& patches) {
    Seam seam{{points.begin(), points.end()}, {segments.begin(), segments.end()}, {}};
    SharedPatchPoints shared = append_shared_points(patches, seam.points);
    seam.segments.insert(seam.segments.end(), shared.boundary.begin(), shared.boundary.end());
    seam.shared = std::move(shared.patch_points);
    return seam;
}

/// Joins the patches and the refined seam. Vertices of the result are the border points, then those of the patches,
/// then the Steiner points of the seam.
Refinement join(std::size_t border_count, LatticePatches patches, const Seam& seam, const Refinement& refined_seam) {
    Refinement result;
    result.stats = refined_seam.stats;
    const std::size_t patch_count = patches.points.size();
    result.steiner_points = std::move(patches.points);
    result.steiner_points.insert(result.steiner_points.end(), refined_seam.steiner_points.begin(),
                                 refined_seam.steiner_points.end());
    result.triangles = std::move(patches.triangles);
    for (Triangle& t : result.triangles)
        for (VertexId& v : t.v) v = VertexId{border_count + v.index()};
    for (const Triangle& t : refined_seam.triangles) {
        Triangle& joined = result.triangles.emplace_back(t);
        for (VertexId& v : joined.v) {
            if (v.index() >= seam.points.size())
                v = VertexId{v.index() - seam.points.size() + border_count + patch_count};
            else if (v.index() >= border_count)
                v = VertexId{border_count + seam.shared[v.index() - border_count].index()};
        }
    }
    return result;
}

Refinement refine_with_lattice(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                               const RefineOptions& options, LatticePatches patches) {
    if (patches.points.size() > options.max_points) fail_too_many_points(options.max_points);
    const Seam seam = make_seam(points, segments, patches);
    RefineOptions seam_options = options;
    seam_options.expected_triangles = 3 * seam.points.size();
    const Refinement refined_seam = refine_region(seam.points, seam.segments, size, seam_options);
    return join(points.size(), std::move(patches), seam, refined_seam);
}

}  // namespace

Refinement refine(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                  const RefineOptions& options) {
    validate(options);
    check_points_and_segments(points, segments);
    if (options.lattice) {
        LatticePatches patches = fill_with_lattice(points, segments, size, options);
        const bool fits = !options.stop_at_max_points || patches.points.size() <= options.max_points;
        if (fits && !patches.empty()) return refine_with_lattice(points, segments, size, options, std::move(patches));
    }
    return refine_region(points, segments, size, options);
}

RefineStats& RefineStats::operator+=(const RefineStats& other) {
    refused += other.refused;
    below_bound += other.below_bound;
    exempt += other.exempt;
    oversized += other.oversized;
    stopped = stopped || other.stopped;
    return *this;
}

}  // namespace lamina
