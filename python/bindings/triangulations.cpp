// Triangulations of points and segments, and their refinement.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_connectivity.hpp>
#include <lamina/delaunay_queries.hpp>
#include <lamina/limits.hpp>
#include <lamina/threads.hpp>
#include <lamina/triangulation.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "core/option_builders.hpp"
#include "interruption.hpp"

namespace lamina::python {

namespace {

using SegmentsArgument = RowsArgument<std::uint32_t, 2>;
using TrianglesArgument = RowsArgument<std::uint32_t, 3>;

/// Returns the value of a word. Throws OptionError for other words.
template <class Choice>
Choice choice_of(const Choices<Choice>& choices, const std::string& option, const std::string& word) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
        if (name == word) return value;
        names.push_back(name);
    }
    throw OptionError(option, unknown_choice(word, names));
}

ReadOnlyArray<std::uint32_t> delaunay(const PointsArgument& given) {
    const std::vector<Point> points = points_of(given);
    std::vector<Triangle> triangles;
    run_unlocked([&] { triangles = triangulate(points).triangles; });
    return owning_array<std::uint32_t>(std::move(triangles));
}

/// Returns (Steiner points, triangles, segments, parents, what points are merged into).
nb::tuple constrained_delaunay(const PointsArgument& given, const SegmentsArgument& given_segments,
                               const std::string& keep, const std::string& crossings, const PointsArgument& holes,
                               std::optional<double> merge_distance, double drop_flat) {
    const std::vector<Point> points = points_of(given);
    const std::vector<Segment> segments = cells_of<Segment, 2>(given_segments);
    ConstrainedOptions options;
    options.keep = choice_of<KeptRegion>({{"convex_hull", KeptRegion::convex_hull},
                                          {"inside_segments", KeptRegion::inside_segments},
                                          {"left_of_segments", KeptRegion::left_of_segments},
                                          {"even_odd", KeptRegion::even_odd},
                                          {"non_zero", KeptRegion::non_zero}},
                                         "keep", keep);
    options.crossings =
        choice_of<Crossings>({{"refuse", Crossings::refuse}, {"insert", Crossings::insert}}, "crossings", crossings);
    options.holes = points_of(holes);
    options.merge_distance = merge_distance;
    options.drop_flat = drop_flat;
    ConstrainedTriangulation result;
    run_unlocked([&] { result = triangulate(points, segments, options); });
    return nb::make_tuple(owning_array<double>(std::move(result.steiner_points)),
                          owning_array<std::uint32_t>(std::move(result.triangles)),
                          owning_array<std::uint32_t>(std::move(result.segments)),
                          owning_array<std::uint32_t>(std::move(result.parents)),
                          owning_array<std::uint32_t>(std::move(result.merged_into)));
}

/// Returns (triangles, segments, parents).
nb::tuple adopt_triangles(const PointsArgument& given, const TrianglesArgument& given_triangles,
                          const SegmentsArgument& given_segments, const ListArgument<std::uint32_t>& given_merged) {
    const std::vector<Point> points = points_of(given);
    const std::vector<Triangle> triangles = cells_of<Triangle, 3>(given_triangles);
    const std::vector<Segment> segments = cells_of<Segment, 2>(given_segments);
    ConstrainedTriangulation result;
    {
        const nb::gil_scoped_release unlocked;
        result = constrain_triangles(points, triangles, segments, {given_merged.data(), given_merged.shape(0)});
    }
    raise_signals();
    return nb::make_tuple(owning_array<std::uint32_t>(std::move(result.triangles)),
                          owning_array<std::uint32_t>(std::move(result.segments)),
                          owning_array<std::uint32_t>(std::move(result.parents)));
}

/// Returns the size, or, where it is infinite, one that no edge of the domain reaches.
double size_within(double size, const Box& domain) {
    return std::isinf(size) && size > 0 ? 4 * std::hypot(domain.width(), domain.height()) : size;
}

/// One size, or a background of points, triangles and the sizes of the points.
using SizeArgument = std::variant<double, std::tuple<PointsArgument, TrianglesArgument, ListArgument<double>>>;

/// Returns the field of one size, or of a background. Sizes without a bound are larger than the domain is wide.
SizeField size_field_of(const SizeArgument& argument, double gradation, const Box& domain) {
    if (const double* size = std::get_if<double>(&argument)) return SizeField(size_within(*size, domain));
    const auto& [points, triangles, sizes] = std::get<1>(argument);
    SizedMesh background;
    background.points = points_of(points);
    background.triangles = cells_of<Triangle, 3>(triangles);
    background.sizes.assign(sizes.data(), sizes.data() + sizes.shape(0));
    return size_field_of_mesh(background, {.gradation = gradation}, domain);
}

/// Throws LimitError where the refinement would exceed the limits.
void require_refinement_within(const WorkLimits& limits, std::span<const Point> points,
                               const ConstrainedTriangulation& triangulation, const SizeField& size,
                               const ConstrainedRefineOptions& options) {
    const RefinementEstimate estimate = estimate_triangles(points, triangulation, size, options);
    require_within(limits, estimate_run(estimate.by_sizes, refinement_cost, thread_count()), "size", "this size");
    if (estimate.least_by_angles > allowed_triangles(limits, angle_refinement_cost))
        throw_limit_error(limits, estimate_run(estimate.by_angles, angle_refinement_cost, thread_count()), "min_angle",
                          fmt::format("{}, with segments so close together,", options.refine.min_angle_deg));
}

/// The options of refine() as the package hands them over.
struct RefineArguments {
    double gradation, min_angle;
    bool split_segments;
    unsigned smoothing;
    std::optional<std::size_t> max_triangles;
    bool conforming;
    std::optional<double> max_area_ratio;
    std::optional<ListArgument<double>> areas;  ///< per triangle the largest area; no bound unless positive
    PointsArgument seeds;                       ///< a point inside each region
    ListArgument<double> region_sizes;          ///< per region
};

ConstrainedRefineOptions options_of(const RefineArguments& arguments, const Box& domain) {
    ConstrainedRefineOptions options;
    options.refine.min_angle_deg = arguments.min_angle;
    options.refine.smoothing = arguments.smoothing;
    if (arguments.max_area_ratio) options.refine.max_area_ratio = *arguments.max_area_ratio;
    options.split_segments = arguments.split_segments;
    options.conforming = arguments.conforming;
    const std::vector<Point> seeds = points_of(arguments.seeds);
    for (std::size_t i = 0; i < seeds.size(); ++i)
        options.regions.push_back({seeds[i], SizeField(size_within(arguments.region_sizes.data()[i], domain))});
    return options;
}

/// Returns the vertices of the boundary of a triangulation, each with the smallest size that bounds the areas round it.
std::vector<std::pair<Point, double>> sizes_on_boundary(const std::vector<Point>& points,
                                                        const std::vector<Triangle>& triangles,
                                                        std::span<const double> areas, double max_area_ratio) {
    std::vector<double> size(points.size(), HUGE_VAL);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (areas[t] > 0)
            for (const VertexId v : triangles[t].v)
                size[v.index()] = std::min(size[v.index()], size_for_area(areas[t], max_area_ratio));
    const std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);
    std::vector<std::pair<Point, double>> found;
    for (std::size_t h = 0; h < twins.size(); ++h)
        if (twins[h] == no_half_edge) {
            const VertexId v = triangles[h / 3].v[h % 3];
            found.emplace_back(points[v.index()], size[v.index()]);
        }
    return found;
}

/// Returns the smaller one of the size of a field and that of the areas of triangles. Triangles at the boundary may
/// have the centres of their circles outside, where the vertex of the boundary that is nearest says the size.
SizeFunction size_function_of(const SizeField& size, const std::vector<Point>& points,
                              const ConstrainedTriangulation& triangulation, const ListArgument<double>& areas,
                              double max_area_ratio) {
    const std::span<const double> bounds{areas.data(), areas.shape(0)};
    const SizeFunction inside = sizes_of_areas(points, triangulation.triangles, bounds, max_area_ratio);
    const auto boundary = sizes_on_boundary(points, triangulation.triangles, bounds, max_area_ratio);
    const auto index = std::make_shared<const TriangulationIndex>(points, triangulation.triangles);
    return [=](Point p) {
        if (index->locate(p).place != PointPlace::outside) return std::min(size(p), inside(p));
        const auto nearest = std::min_element(boundary.begin(), boundary.end(), [p](const auto& a, const auto& b) {
            return squared_length(a.first - p) < squared_length(b.first - p);
        });
        return std::min(size(p), nearest->second);
    };
}

/// Returns (Steiner points, triangles, segments, parents, numbers of what could not be refined, regions of triangles).
nb::tuple refine_triangulation(const PointsArgument& given, const TrianglesArgument& triangles,
                               const SegmentsArgument& segments, const ListArgument<std::uint32_t>& parents,
                               const SizeArgument& size_argument, const RefineArguments& arguments) {
    const std::vector<Point> points = points_of(given);
    ConstrainedTriangulation triangulation;
    triangulation.triangles = cells_of<Triangle, 3>(triangles);
    triangulation.segments = cells_of<Segment, 2>(segments);
    triangulation.parents.assign(parents.data(), parents.data() + parents.shape(0));
    Box domain;
    for (const Point p : points) domain.include(p);
    ConstrainedRefineOptions options = options_of(arguments, domain);
    const WorkLimits limits = with_default_limits({.max_triangles = arguments.max_triangles});
    ConstrainedRefinement result;
    run_unlocked([&] {
        const SizeField size = size_field_of(size_argument, arguments.gradation, domain);
        require_refinement_within(limits, points, triangulation, size, options);
        options.refine.max_points = allowed_points(limits, angle_refinement_cost, options.refine.max_points);
        result =
            arguments.areas
                ? refine(points, triangulation,
                         size_function_of(size, points, triangulation, *arguments.areas, options.refine.max_area_ratio),
                         options)
                : refine(points, triangulation, size, options);
    });
    nb::dict stats;
    stats["refused"] = result.stats.refused;
    stats["below_bound"] = result.stats.below_bound;
    stats["exempt"] = result.stats.exempt;
    stats["oversized"] = result.stats.oversized;
    return nb::make_tuple(owning_array<double>(std::move(result.steiner_points)),
                          owning_array<std::uint32_t>(std::move(result.triangles)),
                          owning_array<std::uint32_t>(std::move(result.segments)),
                          owning_array<std::uint32_t>(std::move(result.parents)), stats,
                          owning_array<std::uint32_t>(std::move(result.regions)));
}

/// Returns the first defects of a triangulation, one line each.
std::vector<std::string> defects_of(const PointsArgument& given, const TrianglesArgument& triangles,
                                    const SegmentsArgument& segments, bool require_delaunay) {
    std::vector<std::string> defects;
    run_unlocked([&] {
        defects = check_triangulation(points_of(given), cells_of<Triangle, 3>(triangles),
                                      cells_of<Segment, 2>(segments), {.require_delaunay = require_delaunay});
    });
    return defects;
}

}  // namespace

void add_triangulations(nb::module_& module) {
    module.def("delaunay", &delaunay);
    module.def("constrained_delaunay", &constrained_delaunay, nb::arg("points"), nb::arg("segments"), nb::arg("keep"),
               nb::arg("crossings"), nb::arg("holes"), nb::arg("merge_distance").none(), nb::arg("drop_flat"));
    module.def("constrain_triangles", &adopt_triangles);
    module.def("merge_points", [](const PointsArgument& points, double distance) {
        return owning_array<std::uint32_t>(merge_points(points_of(points), distance));
    });
    module.def("ring_segments", [](std::size_t points, const ListArgument<std::uint32_t>& given) {
        const std::vector<std::size_t> starts(given.data(), given.data() + given.shape(0));
        return owning_array<std::uint32_t>(ring_segments(points, starts));
    });
    module.def("check_triangulation", &defects_of);
    module.def(
        "refine",
        [](const PointsArgument& points, const TrianglesArgument& triangles, const SegmentsArgument& segments,
           const ListArgument<std::uint32_t>& parents, const SizeArgument& size, double gradation, double min_angle,
           bool split_segments, unsigned smoothing, std::optional<std::size_t> max_triangles, bool conforming,
           std::optional<double> max_area_ratio, const std::optional<ListArgument<double>>& areas,
           const PointsArgument& seeds, const ListArgument<double>& region_sizes) {
            return refine_triangulation(points, triangles, segments, parents, size,
                                        {gradation, min_angle, split_segments, smoothing, max_triangles, conforming,
                                         max_area_ratio, areas, seeds, region_sizes});
        },
        nb::arg("points"), nb::arg("triangles"), nb::arg("segments"), nb::arg("parents"), nb::arg("size"),
        nb::arg("gradation"), nb::arg("min_angle"), nb::arg("split_segments"), nb::arg("smoothing"),
        nb::arg("max_triangles").none(), nb::arg("conforming"), nb::arg("max_area_ratio").none(),
        nb::arg("areas").none(), nb::arg("seeds"), nb::arg("region_sizes"));
}

}  // namespace lamina::python
