// Refinement of a constrained triangulation, as one domain whose borders are split where that is needed. Large, evenly
// sized parts of it are filled with lattices, whose boundaries are frozen; all the rest is refined.
//
//   link triangles -> find the size field of each -> fill with lattices -> refine -> join
//                                                           ^                |
//                                                           '----------------'
//                                    once more, with wider room round the places that a lattice kept from being refined
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "core/interruption_point.hpp"
#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/refine/border_lines.hpp"
#include "delaunay/refine/constrained_input.hpp"
#include "delaunay/refine/lattice.hpp"
#include "delaunay/refine/splitting_refiner.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay {

namespace {

/// Attempts with lattices before the domain is refined without.
constexpr int max_lattice_attempts = 4;
/// Ways that are tried besides the first one where few triangles result, because their number is a matter of chance
/// then (docs/decisions/0022). The first three help larger meshes most.
constexpr std::array other_ways{
    RefinementWay{.part_share = 0.97},
    RefinementWay{.off_centre_share = 0.85},
    RefinementWay{.part_share = 0.75},
    RefinementWay{.off_centre_share = 0.85, .more_angle_deg = 0.5},
    RefinementWay{.off_centre_share = 0.95, .diametral_circles = true},
    RefinementWay{.part_share = 0.55},
    RefinementWay{.part_share = 0.65, .off_centre_share = 0.75},
    RefinementWay{.off_centre_share = 0.6, .diametral_circles = true},
    RefinementWay{.part_share = 0.83},
    RefinementWay{.part_share = 0.65, .off_centre_share = 0.95},
    RefinementWay{.off_centre_share = 0.95},
    RefinementWay{.off_centre_share = 0.75},
    RefinementWay{.off_centre_share = 0.85, .more_angle_deg = 2},
    RefinementWay{.off_centre_share = 0.85, .diametral_circles = true, .more_angle_deg = 0.5},
    RefinementWay{.diametral_circles = true},
    RefinementWay{.part_share = 0.65},
    RefinementWay{.part_share = 1.2},
    RefinementWay{.part_share = 1.05},
    RefinementWay{.part_share = 0.83, .off_centre_share = 0.9, .diametral_circles = true},
    RefinementWay{.part_share = 0.55, .off_centre_share = 0.9},
};
/// The same for handfuls of triangles, in all combinations.
constexpr std::array part_shares_of_handfuls{1.2, 1.05, 0.9, 0.75, 0.6};
constexpr std::array off_centre_shares_of_handfuls{1.0, 0.9, 0.8, 0.7, 0.6};
/// Other ways are tried as long as all meshes together have no more triangles than this.
constexpr std::size_t max_triangles_of_ways = 6000;

/// Returns the vertices so near to others that triangles round them will be smaller than their sizes demand. Lattices
/// leave room for triangles to grow.
std::vector<LatticeObstacle> crowded_vertices(const ConstrainedInput& input) {
    constexpr double reach_of_growth = 2;
    std::vector<double> size(input.points.size(), 0), nearest(input.points.size(), HUGE_VAL);
    for (Index t = 0; t < input.tris.size(); ++t) {
        const RegionSizes& field = input.sizes[input.field_of(t)];
        const Index* v = input.tris[t].v;
        for (unsigned e = 0; e < 3; ++e) {
            const Index a = v[next(e)], b = v[previous(e)];
            const double length = distance(input.points[a], input.points[b]);
            nearest[a] = std::min(nearest[a], length);
            nearest[b] = std::min(nearest[b], length);
            if (!field.is_uniform() || size[a] == 0) size[a] = std::max(size[a], field(input.points[a]));
        }
    }
    std::vector<LatticeObstacle> obstacles;
    for (std::size_t v = 0; v < input.points.size(); ++v)
        if (nearest[v] < size[v])
            obstacles.push_back({input.points[v], size[v] + reach_of_growth * (size[v] - nearest[v])});
    return obstacles;
}

/// Returns the constrained edges and borders of the triangles with this field, once for each such triangle that they
/// bound, with the triangle on their left.
std::vector<Segment> edges_round_field(const ConstrainedInput& input, std::uint32_t field) {
    std::vector<Segment> edges;
    for (Index t = 0; t < input.tris.size(); ++t) {
        if (input.field_of(t) != field) continue;
        const Tri& tri = input.tris[t];
        for (unsigned e = 0; e < 3; ++e)
            if (tri.n[e].is_constrained()) edges.push_back({VertexId{tri.v[next(e)]}, VertexId{tri.v[previous(e)]}});
    }
    return edges;
}

/// Lattice patches, with the fields of their triangles and of their boundary edges.
struct FieldPatches {
    LatticePatches patches;
    std::vector<std::uint32_t> fields;
    std::vector<std::uint32_t> boundary_fields;
};

/// Looks whether the work is still wanted, each time that so many triangles more have been copied.
void look_now_and_then(std::size_t triangles) {
    constexpr std::size_t triangles_between_looks = std::size_t{1} << 16;
    if (triangles % triangles_between_looks == 0) core::check_interruption();
}

/// Appends the patches of one field.
void append(FieldPatches& all, const LatticePatches& some, std::uint32_t field) {
    const std::size_t offset = all.patches.points.size();
    const auto shifted = [offset](VertexId v) { return VertexId{offset + v.index()}; };
    all.patches.points.insert(all.patches.points.end(), some.points.begin(), some.points.end());
    core::check_interruption();
    for (const Triangle& t : some.triangles) {
        look_now_and_then(all.patches.triangles.size());
        all.patches.triangles.push_back({{shifted(t.v[0]), shifted(t.v[1]), shifted(t.v[2])}});
    }
    for (const Segment& s : some.boundary) all.patches.boundary.push_back({shifted(s.a), shifted(s.b)});
    for (const VertexId v : some.collar) all.patches.collar.push_back(shifted(v));
    all.fields.resize(all.patches.triangles.size(), field);
    all.boundary_fields.resize(all.patches.boundary.size(), field);
}

FieldPatches fill_fields(const ConstrainedInput& input, std::span<const LatticeObstacle> obstacles,
                         const RefineOptions& options) {
    FieldPatches all;
    for (std::uint32_t field = 0; field < input.sizes.size(); ++field) {
        const SizeField* const size = input.sizes[field].field();
        if (!size) continue;
        const std::vector<Segment> edges = edges_round_field(input, field);
        if (edges.empty()) continue;
        const LatticePatches patches = fill_with_lattice(input.points, edges, *size, options, obstacles);
        core::check_interruption();
        append(all, patches, field);
    }
    if (all.patches.points.size() > options.max_points) {
        if (options.stop_at_max_points) return {};
        fail_too_many_points(options.max_points);
    }
    return all;
}

/// The domain without its patches.
struct SeamDomain {
    SplittableDomain domain;
    std::vector<VertexId> shared;  ///< for each vertex behind those of the input the index of its point in the patches
};

/// The edges that bound the seam, each with the seam on its left, and the field there.
struct SeamEdges {
    std::vector<Segment> edges;
    std::vector<std::uint32_t> fields;
};

/// Returns for each point itself, or no_index if it is one of the input that no triangle has, as where
/// equal points were merged.
std::vector<Index> stand_ins(const ConstrainedInput& input, std::size_t points) {
    std::vector<Index> stand_in(points);
    std::iota(stand_in.begin(), stand_in.end(), Index{0});
    std::fill_n(stand_in.begin(), input.points.size(), no_index);
    for (const Tri& t : input.tris)
        for (const Index v : t.v) stand_in[v] = v;
    return stand_in;
}

/// Triangulates the seam inside its edges.
void triangulate_seam(const SeamEdges& edges, std::span<const Index> stand_in, SplittableDomain& domain) {
    Tris tris = triangulate_points(domain.points, stand_in);
    insert_segments(domain.points, edges.edges, tris);
    const std::vector<Index> at_vertex = triangle_at_vertex(tris, domain.points.size());
    std::vector<ValueSeed> seeds;
    for (std::size_t i = 0; i < edges.edges.size(); ++i) {
        const Link left = find_edge(tris, at_vertex, edges.edges[i].a.value, edges.edges[i].b.value);
        assert(!left.is_border());
        seeds.push_back({left.triangle(), edges.fields[i]});
    }
    const std::vector<std::uint32_t> fields = spread_values(tris, seeds);
    TriangleSelection selection(tris.size());
    for (std::size_t t = 0; t < fields.size(); ++t) selection[t] = fields[t] != no_index;
    domain.tris = keep_selected(tris, selection);
    for (const std::uint32_t field : fields)
        if (field != no_index) domain.fields.push_back(field);
    assert(domain.fields.size() == domain.tris.size());
}

SeamDomain make_seam(const ConstrainedInput& input, const FieldPatches& filled) {
    const std::size_t count = input.points.size();
    const LatticePatches& patches = filled.patches;
    if (patches.empty()) return {{input.points, input.tris, input.fields, count, count}, {}};

    SeamDomain seam{{input.points, {}, {}, count, count}, {}};
    SharedPatchPoints shared = append_shared_points(patches, seam.domain.points);
    seam.domain.frozen_end = count + shared.boundary_points;
    seam.shared = std::move(shared.patch_points);
    SeamEdges edges{std::move(shared.boundary), filled.boundary_fields};
    for (std::uint32_t field = 0; field < input.sizes.size(); ++field) {
        for (const Segment& s : edges_round_field(input, field)) {
            edges.edges.push_back(s);
            edges.fields.push_back(field);
        }
    }
    triangulate_seam(edges, stand_ins(input, seam.domain.points.size()), seam.domain);
    if (input.fields.empty()) seam.domain.fields.clear();
    return seam;
}

/// Returns the numbers that the refiner's vertices have in the result, where those of the input come first, then those
/// on lines, then the points of the patches, then the rest.
std::vector<VertexId> number_vertices(std::size_t input_count, std::size_t vertex_count, const SeamDomain& seam,
                                      const BorderLines& lines, std::size_t patch_points) {
    std::vector<VertexId> ids;
    ids.reserve(vertex_count);
    const std::size_t first_of_patch = input_count + lines.splits();
    std::size_t on_line = input_count, inside = first_of_patch + patch_points;
    for (std::size_t v = 0; v < vertex_count; ++v) {
        if (v < input_count)
            ids.emplace_back(v);
        else if (v - input_count < seam.shared.size())
            ids.emplace_back(first_of_patch + seam.shared[v - input_count].index());
        else
            ids.emplace_back(lines.line_of_vertex(static_cast<Index>(v)) != no_index ? on_line++ : inside++);
    }
    // Each number is given once, but for those of points inside patches.
    assert(on_line == first_of_patch && inside + seam.shared.size() == vertex_count + patch_points);
    return ids;
}

std::uint32_t region_of_field(std::uint32_t field) { return field == 0 ? ConstrainedRefinement::no_region : field - 1; }

/// Appends the segments of the triangulation, split, to the result.
void append_segments(const ConstrainedTriangulation& triangulation, const BorderLines& lines,
                     std::span<const Point> vertices, std::span<const VertexId> ids, ConstrainedRefinement& r) {
    const std::vector<std::vector<Index>> chains = lines.chains(vertices);
    for (std::size_t i = 0; i < triangulation.segments.size(); ++i) {
        for (std::size_t k = 0; k + 1 < chains[i].size(); ++k) {
            r.segments.push_back({ids[chains[i][k]], ids[chains[i][k + 1]]});
            r.parents.push_back(triangulation.parents[i]);
        }
    }
}

/// The task that one call of refine() has.
struct RefinementTask {
    const ConstrainedInput& input;
    const ConstrainedTriangulation& triangulation;
    const ConstrainedRefineOptions& options;
    std::size_t user_points;
};

/// Joins the patches and the refined seam.
ConstrainedRefinement join(const RefinementTask& task, const FieldPatches& filled, const SeamDomain& seam,
                           const BorderLines& lines, const SplittingRefiner& refiner, double min_angle_deg) {
    const LatticePatches& patches = filled.patches;
    const std::size_t user_points = task.user_points;
    const std::size_t input_count = user_points + task.triangulation.steiner_points.size();
    const std::size_t first_of_patch = input_count + lines.splits();
    const std::vector<Point> vertices = refiner.vertices();
    const std::vector<VertexId> ids = number_vertices(input_count, vertices.size(), seam, lines, patches.points.size());
    ConstrainedRefinement r;
    r.on_segments = lines.splits();
    r.steiner_points.resize(vertices.size() - user_points + patches.points.size() - seam.shared.size());
    for (std::size_t i = 0; i < patches.points.size(); ++i)
        r.steiner_points[first_of_patch + i - user_points] = patches.points[i];
    core::check_interruption();
    for (std::size_t v = user_points; v < vertices.size(); ++v)  // the refiner has moved collars
        r.steiner_points[ids[v].index() - user_points] = vertices[v];
    for (std::size_t t = 0; t < patches.triangles.size(); ++t) {
        look_now_and_then(t);
        Triangle& triangle = r.triangles.emplace_back(patches.triangles[t]);
        for (VertexId& v : triangle.v) v = VertexId{first_of_patch + v.index()};
        r.regions.push_back(region_of_field(filled.fields[t]));
    }
    core::check_interruption();
    for (Index t = 0; t < refiner.tris().size(); ++t) {
        const Index* v = refiner.tris()[t].v;
        r.triangles.push_back({{ids[v[0]], ids[v[1]], ids[v[2]]}});
        r.regions.push_back(region_of_field(refiner.field_of(t)));
    }
    append_segments(task.triangulation, lines, vertices, ids, r);
    r.stats = refiner.count_leftovers(min_angle_deg);
    return r;
}

/// The result of one way to refine.
struct Outcome {
    ConstrainedRefinement mesh;  ///< empty if a frozen edge kept a point out
    std::vector<Point> kept_out;
    std::size_t inserted = 0;  ///< number of vertices that the refiner inserted
};

Outcome refine_round(const FieldPatches& filled, const RefinementTask& task, RefinementWay way) {
    ConstrainedRefineOptions options = task.options;
    double& min_angle = options.refine.min_angle_deg;
    min_angle = std::max(min_angle, std::min(min_angle + way.more_angle_deg, max_min_angle_deg));
    way.diametral_circles = way.diametral_circles || options.conforming;
    SeamDomain seam = make_seam(task.input, filled);
    const std::size_t before = seam.domain.points.size();
    BorderLines lines(task.input.points, task.triangulation.segments, task.triangulation.parents, task.input.tris);
    SplittingRefiner refiner(std::move(seam.domain), lines, task.input.sizes, options, way);
    refiner.refine();
    Outcome outcome{{}, refiner.kept_out(), refiner.vertices().size() - before};
    if (filled.patches.empty() || outcome.kept_out.empty())
        outcome.mesh = join(task, filled, seam, lines, refiner, task.options.refine.min_angle_deg);
    return outcome;
}

/// Returns whether a mesh leaves fewer triangles beyond the bounds than another one or, if both leave as many, has
/// fewer triangles.
bool is_better(const ConstrainedRefinement& mesh, const ConstrainedRefinement& other) {
    const auto beyond = [](const RefineStats& s) { return s.below_bound - s.exempt + s.oversized; };
    return std::pair{beyond(mesh.stats), mesh.triangles.size()} <
           std::pair{beyond(other.stats), other.triangles.size()};
}

/// Returns the ways that are tried besides the first one, in their order.
std::vector<RefinementWay> ways_to_try() {
    std::vector<RefinementWay> ways(other_ways.begin(), other_ways.end());
    for (const double part_share : part_shares_of_handfuls)
        for (const double off_centre_share : off_centre_shares_of_handfuls)
            for (const bool circles : {false, true})
                ways.push_back(
                    {.part_share = part_share, .off_centre_share = off_centre_share, .diametral_circles = circles});
    return ways;
}

/// Refines in other ways as well, the more the smaller the mesh is, and returns the best mesh.
ConstrainedRefinement choose_best(Outcome best, const FieldPatches& filled, const RefinementTask& task) {
    if (best.mesh.stats.stopped) return std::move(best.mesh);
    ConstrainedRefineOptions options = task.options;
    options.refine.stop_at_max_points = false;
    std::size_t triangles = 0;
    for (const RefinementWay& way : ways_to_try()) {
        triangles += best.mesh.triangles.size();
        if (triangles > max_triangles_of_ways) break;
        options.refine.max_points = best.inserted;
        try {
            Outcome other = refine_round(filled, {task.input, task.triangulation, options, task.user_points}, way);
            if ((filled.patches.empty() || other.kept_out.empty()) && is_better(other.mesh, best.mesh))
                best = std::move(other);
        } catch (const MeshError&) {
            continue;  // This way needs more points, and is therefore no better.
        }
    }
    return std::move(best.mesh);
}

/// Refines to these sizes.
ConstrainedRefinement refine_to_sizes(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                      RegionSizes size, const ConstrainedRefineOptions& options) {
    check_arguments(points, triangulation, options);
    const ConstrainedInput input = make_constrained_input(points, triangulation, size, options.regions);
    const RefinementTask task{input, triangulation, options, points.size()};
    std::vector<LatticeObstacle> obstacles = crowded_vertices(input);
    for (int attempt = 0;; ++attempt) {
        FieldPatches filled;
        if (options.refine.lattice && attempt < max_lattice_attempts)
            filled = fill_fields(input, obstacles, options.refine);
        Outcome outcome = refine_round(filled, task, {});
        if (filled.patches.empty() || outcome.kept_out.empty()) return choose_best(std::move(outcome), filled, task);
        const double reach = 2 << attempt;
        for (const Point p : outcome.kept_out) obstacles.push_back({p, reach * size(p)});
    }
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                             const SizeField& size, const ConstrainedRefineOptions& options) {
    return refine_to_sizes(points, triangulation, RegionSizes(size), options);
}

ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                             const SizeFunction& size, const ConstrainedRefineOptions& options) {
    return refine_to_sizes(points, triangulation, RegionSizes(size), options);
}

}  // namespace lamina
