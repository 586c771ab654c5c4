// refine() fills large, evenly sized parts of the region with lattices where that pays, and refines all the rest.
#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include <lamina/delaunay.hpp>

#include "delaunay/refine/lattice.hpp"
#include "delaunay/refine/refine_region.hpp"
#include "delaunay/refine/refiner.hpp"
#include "delaunay/triangulate/arguments.hpp"

namespace lamina {

using namespace delaunay;

namespace {

/// The seam between the border of a region and its lattice patches, as a region of its own: the boundaries of the
/// patches are frozen like the border. Its points are those of the border, then those of the patches that it shares.
struct Seam {
    std::vector<Point> points;
    std::vector<Segment> segments;
    std::vector<VertexId> shared;  ///< indices into LatticePatches::points
    std::size_t fixed_points;      ///< all but the collars
};

Seam make_seam(std::span<const Point> points, std::span<const Segment> segments, const LatticePatches& patches) {
    Seam seam{{points.begin(), points.end()}, {segments.begin(), segments.end()}, {}, points.size()};
    SharedPatchPoints shared = append_shared_points(patches, seam.points);
    seam.segments.insert(seam.segments.end(), shared.boundary.begin(), shared.boundary.end());
    seam.fixed_points += shared.boundary_points;
    seam.shared = std::move(shared.patch_points);
    return seam;
}

/// Joins the links of the patches and of the seam, and links the triangles on both sides of the boundary between them.
/// `joined` are the triangles of both, those of the patches first, whose links `links` holds. Both sides meet where
/// their edges are sorted by the vertices of the edges.
void join_links(const LatticePatches& patches, std::size_t border_count, const core::EdgeLinks& seam_links,
                std::span<const Triangle> joined, core::EdgeLinks& links) {
    const std::size_t patch_triangles = links.size() / 3;
    links.reserve(3 * joined.size());
    const auto shift = static_cast<core::EdgeLink>(patch_triangles << 2);
    for (const core::EdgeLink link : seam_links) links.push_back(link == core::no_link ? link : link + shift);

    struct MeetingEdge {
        Segment ends;  ///< directed as the triangle of the seam has it
        core::EdgeLink link;
        bool operator<(const MeetingEdge& other) const { return ends < other.ends; }
    };
    std::vector<MeetingEdge> of_patches, of_seam;
    const auto vertex = [&](VertexId v) { return VertexId{border_count + v.index()}; };
    for (std::size_t k = 0; k < patches.boundary.size(); ++k)
        of_patches.push_back(
            {{vertex(patches.boundary[k].a), vertex(patches.boundary[k].b)}, patches.boundary_links[k]});
    for (std::size_t t = patch_triangles; t < joined.size(); ++t)
        for (unsigned i = 0; i < 3; ++i)
            if (const Segment ends{joined[t].v[i], joined[t].v[next(i)]};
                links[3 * t + i] == core::no_link && ends.a.index() >= border_count && ends.b.index() >= border_count)
                of_seam.push_back({ends, core::edge_link(t, i)});
    std::sort(of_patches.begin(), of_patches.end());
    std::sort(of_seam.begin(), of_seam.end());
    const auto connect = [&](core::EdgeLink from, core::EdgeLink to) {
        links[3 * core::triangle_of(from) + core::edge_of(from)] = to;
    };
    assert(of_patches.size() == of_seam.size());
    for (std::size_t k = 0; k < std::min(of_patches.size(), of_seam.size()); ++k) {
        assert(of_patches[k].ends == of_seam[k].ends);
        connect(of_patches[k].link, of_seam[k].link);
        connect(of_seam[k].link, of_patches[k].link);
    }
}

/// Joins the patches and the refined seam. Vertices of the result are the border points, then those of the patches,
/// then the Steiner points of the seam.
LinkedRefinement join(std::size_t border_count, LatticePatches patches, const Seam& seam,
                      const LinkedRefinement& linked_seam) {
    const Refinement& refined_seam = linked_seam.refinement;
    LinkedRefinement linked{{}, std::move(patches.links)};
    Refinement& result = linked.refinement;
    result.stats = refined_seam.stats;
    const std::size_t patch_count = patches.points.size(), collar_count = seam.points.size() - seam.fixed_points;
    assert(border_count <= seam.fixed_points && seam.shared.size() == seam.points.size() - border_count);
    assert(collar_count <= refined_seam.steiner_points.size());
    const auto first_new = refined_seam.steiner_points.begin() + static_cast<std::ptrdiff_t>(collar_count);
    result.steiner_points = std::move(patches.points);
    const std::size_t first_of_collar = seam.fixed_points - border_count;
    for (std::size_t i = 0; i < collar_count; ++i)  // smoothing has moved them
        result.steiner_points[seam.shared[first_of_collar + i].index()] = refined_seam.steiner_points[i];
    result.steiner_points.insert(result.steiner_points.end(), first_new, refined_seam.steiner_points.end());
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
            assert(v.index() < border_count + result.steiner_points.size());
        }
    }
    if (patches.linked) join_links(patches, border_count, linked_seam.links, result.triangles, linked.links);
    return linked;
}

LinkedRefinement refine_with_lattice(std::span<const Point> points, std::span<const Segment> segments,
                                     const SizeField& size, const RefineOptions& options, LatticePatches patches) {
    if (patches.points.size() > options.max_points) fail_too_many_points(options.max_points);
    const Seam seam = make_seam(points, segments, patches);
    RefineOptions seam_options = options;
    seam_options.expected_triangles = 3 * seam.points.size();
    LinkedRefinement refined_seam;
    refined_seam.refinement = refine_region(seam.points, seam.fixed_points, seam.segments, size, seam_options,
                                            patches.linked ? &refined_seam.links : nullptr);
    return join(points.size(), std::move(patches), seam, refined_seam);
}

LinkedRefinement refine_checked(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                                const RefineOptions& options, bool linked) {
    validate(options);
    check_points_and_segments(points, segments);
    if (options.lattice && !options.regularize) {
        LatticePatches patches = fill_with_lattice(points, segments, size, options, {}, linked);
        const bool fits = !options.stop_at_max_points || patches.points.size() <= options.max_points;
        if (fits && !patches.empty()) return refine_with_lattice(points, segments, size, options, std::move(patches));
    }
    LinkedRefinement result;
    result.refinement = refine_region(points, points.size(), segments, size, options, linked ? &result.links : nullptr);
    return result;
}

}  // namespace

Refinement refine(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                  const RefineOptions& options) {
    return refine_checked(points, segments, size, options, false).refinement;
}

LinkedRefinement delaunay::refine_linked(std::span<const Point> points, std::span<const Segment> segments,
                                         const SizeField& size, const RefineOptions& options) {
    return refine_checked(points, segments, size, options, true);
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
