// A region holds at least min_triangles, the number of triangles if all had the largest area allowed, sqrt(3)/4 h^2: an
// integral of 1 / h^2. How many more are made depends on who makes them (fitted to 12,000 pieces):
//
//   refinement    makes triangles of 0.69 of the largest area on average, whatever the gradation, and a few more along
//                 frozen edges.
//   a lattice     has triangles of 0.71 to 0.94 of the largest area, by its level, but for a seam along frozen edges. A
//                 lattice is made where h is even over the width of a block, and where enough lies inside the seams.
#include "delaunay/refine/estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "delaunay/refine/constrained_input.hpp"
#include "delaunay/refine/estimate_angles.hpp"
#include "delaunay/refine/lattice_levels.hpp"
#include "sizing/sized_point.hpp"

namespace lamina::delaunay {

namespace {

// ---- measured ----

/// Triangles that refinement makes for each of min_triangles where h is constant, and how many more it makes in
/// proportion to the growth of h.
constexpr double refined_where_even = 1.008, refined_by_growth = 0.2;
constexpr double refined(double gradient) { return refined_where_even + refined_by_growth * gradient; }
/// Triangles of the mesh for each triangle of a lattice that covers the region, and how many more for each frozen edge,
/// in the seam.
constexpr double latticed = 1.02, latticed_along_border = 0.63;
/// Mean area of lattice triangles, as a share of the largest allowed, where h passes through the levels.
constexpr double mean_level_share = 0.99;
/// Growth of h beyond which no block keeps to one level.
constexpr double even_gradient = (level_ratio - 1) / (2 * min_block_edges);
/// A lattice is made where it has more triangles than this for each frozen edge and for each change of level.
constexpr double min_lattice_per_border_edge = 7, min_lattice_per_crossing = 60;
/// A lattice is made where h is even for at least this share of min_triangles.
constexpr double min_even_share = 0.5;
/// Within this factor of the smallest number of triangles that a lattice needs, it may be made or not: then the
/// estimate is the mean of both.
constexpr double uncertain_factor = 1.25;

// ---- integral ----

using sizing::SizedPoint;

/// A part of a triangle, in which h is nearly linear.
struct TrianglePart {
    Point at;              ///< its middle
    double min_triangles;  ///< number of triangles if all had the largest area allowed
    double gradient;       ///< growth of h per unit of distance
    double low, high;      ///< smallest and largest h at the corners and in the middle
    double inside;         ///< h in the middle
};

TrianglePart make_part(const SizedPoint& a, const SizedPoint& b, const SizedPoint& c, double inside,
                       double max_gradient) {
    const Point ab = b.at - a.at, ac = c.at - a.at;
    const double area2 = std::abs(cross(ab, ac));
    const double climb = length((b.size - a.size) * ac - (c.size - a.size) * ab);
    const auto inverse_square = [](double h) { return 1 / (h * h); };
    const double mean =
        0.75 * inverse_square(inside) + (inverse_square(a.size) + inverse_square(b.size) + inverse_square(c.size)) / 12;
    return {(1.0 / 3) * (a.at + b.at + c.at),
            0.5 * area2 * mean / equilateral_area,
            climb < max_gradient * area2 ? climb / area2 : max_gradient,
            std::min({a.size, b.size, c.size, inside}),
            std::max({a.size, b.size, c.size, inside}),
            inside};
}

/// Decides whether a triangle is divided. Lengths and areas are in units of the smallest h at its corners.
struct DivisionLimits {
    /// If all edges are shorter than this, the mean of h at the corners is taken for h in the middle.
    double short_edge;
    /// Longer edges are halved. A source inside the triangle lowers h up to a distance of h / gradation, and parts have
    /// to be small, compared to the whole region, to tell on which side of a separator they lie.
    double long_edge;
    /// Triangles of a smaller area need not be divided for their long edges: they hold too few triangles to matter.
    double small_area;
};

DivisionLimits division_limits(const SizeField& size, std::size_t border_points) {
    const double reach = 1 / size.gradation(), border = static_cast<double>(border_points);
    // A region is about border / 4 edges wide. Parts may be up to a tenth of that wide, or hold 0.05 % of the region.
    return {std::clamp(0.3 * reach, 1.0, 40.0), std::clamp(1.6 * reach, 16.0, std::max(40.0, border / 40)),
            std::clamp(3e-5 * border * border, 4.0, 64.0)};
}

/// Largest depth of division: only a guard, since an edge that is 1e9 sizes long needs some 70 halvings.
constexpr int max_division_depth = 200;

/// Divides triangles into parts.
class TriangleDivider {
public:
    TriangleDivider(const SizeField& size, const DivisionLimits& limits, std::vector<TrianglePart>& parts)
        : size_(size), limits_(limits), parts_(parts) {}

    /// Appends the parts of a triangle, which is halved at its longest edge until h differs little between the corners
    /// and the middle, but at most `depth` times in a row.
    void divide(SizedPoint a, SizedPoint b, SizedPoint c, int depth) {
        const double low = std::min({a.size, b.size, c.size}), high = std::max({a.size, b.size, c.size});
        const double mean = (a.size + b.size + c.size) / 3;
        const std::array<double, 3> squared = sizing::squared_edges(a, b, c);
        const double squared_longest = std::max({squared[0], squared[1], squared[2]}), squared_low = low * low;
        const bool is_short = squared_longest < limits_.short_edge * limits_.short_edge * squared_low;
        const double inside = is_short ? mean : size_((1.0 / 3) * (a.at + b.at + c.at));
        const bool is_small = 0.5 * std::abs(cross(b.at - a.at, c.at - a.at)) < limits_.small_area * squared_low;
        const bool is_long = squared_longest > limits_.long_edge * limits_.long_edge * squared_low;
        const bool alike = high < (is_small ? 2 : 1.5) * low && inside < 1.2 * mean && mean < 1.2 * inside;
        if (depth == 0 || parts_.size() >= max_parts || (alike && (is_small || !is_long))) {
            parts_.push_back(make_part(a, b, c, inside, size_.gradation()));
            return;
        }
        sizing::rename_longest_edge(a, b, c, squared);
        const Point half = midpoint(a.at, c.at);
        const SizedPoint between{half, size_(half)};
        divide(a, b, between, depth - 1);
        divide(between, b, c, depth - 1);
    }

    /// Beyond this number parts are left as they are: the triangles cannot all be made, and only their order of
    /// magnitude counts.
    static constexpr std::size_t max_parts = std::size_t{1} << 20;

private:
    const SizeField& size_;
    const DivisionLimits limits_;
    std::vector<TrianglePart>& parts_;
};

/// The parts of all triangles.
struct DividedTriangles {
    std::vector<TrianglePart> parts;
    std::vector<std::size_t> ends;  ///< for each triangle the number of parts up to its last one
    std::size_t border_edges = 0;
};

DividedTriangles divide_triangles(std::span<const Point> points, const Tris& tris, const SizeField& size) {
    constexpr std::size_t grain = 256;  // triangles in a block
    const DivisionLimits limits = division_limits(size, points.size());
    std::vector<double> sizes(points.size());
    std::transform(points.begin(), points.end(), sizes.begin(), [&](Point p) { return size(p); });
    const auto divide_block = [&](std::size_t begin, std::size_t end) {
        DividedTriangles block;
        TriangleDivider divider(size, limits, block.parts);
        const auto corner = [&](Index v) { return SizedPoint{points[v], sizes[v]}; };
        block.ends.reserve(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            const Tri& t = tris[i];
            divider.divide(corner(t.v[0]), corner(t.v[1]), corner(t.v[2]), max_division_depth);
            block.ends.push_back(block.parts.size());
            block.border_edges +=
                static_cast<std::size_t>(std::count_if(t.n, t.n + 3, [](Link n) { return n.is_constrained(); }));
        }
        return block;
    };
    DividedTriangles all;
    all.ends.reserve(tris.size());
    for (const DividedTriangles& block : core::parallel_blocks(tris.size(), grain, divide_block)) {
        for (const std::size_t end : block.ends) all.ends.push_back(all.parts.size() + end);
        all.parts.insert(all.parts.end(), block.parts.begin(), block.parts.end());
        all.border_edges += block.border_edges;
    }
    return all;
}

// ---- lattice or not ----

/// The sums over a whole region that decide whether a lattice is made.
struct LatticeSums {
    double min_triangles = 0;
    double even = 0;          ///< min_triangles where h is even
    double lattice = 0;       ///< triangles of the lattices there
    double crossings = 0;     ///< length of the boundaries between levels, in edges
    double border_edges = 0;  ///< number of frozen edges
};

bool is_even(const TrianglePart& part) { return part.gradient < even_gradient; }

/// Returns the number of lattice triangles for each of min_triangles.
double lattice_triangles(const TrianglePart& part, const LatticeLevels& levels) {
    if (part.high > level_ratio * part.low) return 1 / mean_level_share;
    constexpr double rounding = 1 + 1e-6;  // the size field holds numbers of single precision
    const double share = levels.edges[static_cast<std::size_t>(levels.level_of(part.inside * rounding))] / part.inside;
    return 1 / (share * share);
}

/// Returns the levels that the sizes of the parts suit.
LatticeLevels levels_for(const std::vector<TrianglePart>& parts) {
    double low = HUGE_VAL, high = 0;
    std::vector<SizeBin> bins;
    bins.reserve(parts.size());
    for (const TrianglePart& part : parts) {
        low = std::min(low, part.low);
        high = std::max(high, part.high);
        bins.push_back({part.low, part.high, part.min_triangles});
    }
    return lattice_levels(low, 1.01 * high, RefineOptions{}.max_area_ratio, std::move(bins));
}

LatticeSums sum_up(const DividedTriangles& divided, const LatticeLevels& levels) {
    LatticeSums sums;
    sums.border_edges = static_cast<double>(divided.border_edges);
    for (const TrianglePart& part : divided.parts) {
        sums.min_triangles += part.min_triangles;
        if (!is_even(part)) continue;
        sums.even += part.min_triangles;
        sums.lattice += part.min_triangles * lattice_triangles(part, levels);
        sums.crossings += part.min_triangles * part.gradient;
    }
    return sums;
}

/// Returns how probable a lattice is: 0, 0.5 or 1.
double lattice_probability(const LatticeSums& sums) {
    if (!(sums.min_triangles > 0) || sums.even < min_even_share * sums.min_triangles) return 0;
    const double needed = min_lattice_per_border_edge * sums.border_edges * (sums.even / sums.min_triangles) +
                          min_lattice_per_crossing * sums.crossings;
    if (sums.lattice > uncertain_factor * needed) return 1;
    return uncertain_factor * sums.lattice > needed ? 0.5 : 0;
}

/// Returns the number of triangles made for each of min_triangles in a region far larger than its triangles, in which h
/// grows by `gradient` per unit of distance.
double made_for_each_of_min_triangles(double gradient) {
    // Below this gradient one level serves the whole region, above it all levels do.
    constexpr double max_one_level_gradient = 0.001;
    if (gradient < max_one_level_gradient) return latticed / (commonest_lattice_share * commonest_lattice_share);
    return gradient < even_gradient ? latticed / mean_level_share : refined(gradient);
}

// ---- constrained triangulations ----

/// The lengths of borders, in edges, and the areas between them, in triangles of the largest area allowed.
struct UndividedSums {
    double min_triangles = 0;
    double border_edges = 0;
};

/// Adds a triangle. h is taken for constant in it: the size at its vertices, which is finest.
void add_triangle(const ConstrainedInput& input, Index t, UndividedSums& sums) {
    // Borders are divided into equal parts of at most h.
    constexpr double mean_border_edge = 0.95;
    const Tri& tri = input.tris[t];
    const Point a = input.points[tri.v[0]], b = input.points[tri.v[1]], c = input.points[tri.v[2]];
    const SizeField& size = *input.sizes[input.field_of(t)].field();
    const double h = std::min({size(a), size(b), size(c)});
    sums.min_triangles += 0.5 * cross(b - a, c - a) / (equilateral_area * h * h);
    for (unsigned e = 0; e < 3; ++e) {
        if (!tri.n[e].is_constrained()) continue;
        const double length = distance(input.points[tri.v[next(e)]], input.points[tri.v[previous(e)]]);
        sums.border_edges += std::max(1.0, length / (mean_border_edge * h));
    }
}

/// Adds what the angle bound asks for.
void add_angles(const ConstrainedInput& input, const ConstrainedTriangulation& triangulation,
                const ConstrainedRefineOptions& options, RefinementEstimate& estimate) {
    // Refinement makes this many triangles for each of the triangulation where there are no channels, as measured.
    constexpr double made_for_each = 2;
    // In channels it made 0.78 to 2.7 times the estimate (docs/decisions/0020).
    constexpr double certain_share = 0.5;
    const auto given = static_cast<double>(input.tris.size());
    AngleEstimate angles;
    if (options.split_segments)
        angles = estimate_for_angles(input, {input.points, triangulation.segments, triangulation.parents, input.tris},
                                     options.refine.min_angle_deg);
    estimate.by_angles = std::max(made_for_each * given, angles.in_channels + angles.growing);
    estimate.least_by_angles = std::max(given, certain_share * angles.in_channels);
}

}  // namespace

double estimated_triangles(double area, double mean_inverse_square_size, double gradient) {
    return made_for_each_of_min_triangles(gradient) * (area * mean_inverse_square_size / equilateral_area);
}

bool has_clearly_more_than(std::span<const Point> points, const Tris& tris, const SizeField& size, double triangles) {
    // No triangle of a lattice has more than the largest area allowed, but for rounding, nor has any other on average.
    constexpr double least_made_for_each_of_min_triangles = 0.5;
    const DivisionLimits limits = division_limits(size, points.size());
    std::vector<TrianglePart> parts;
    TriangleDivider divider(size, limits, parts);
    const auto corner = [&](Index v) { return SizedPoint{points[v], size(points[v])}; };
    double made = 0;
    for (Index t = 0; t < tris.size() && made <= triangles; ++t) {
        const std::size_t first = parts.size();
        divider.divide(corner(tris[t].v[0]), corner(tris[t].v[1]), corner(tris[t].v[2]), max_division_depth);
        if (parts.size() >= TriangleDivider::max_parts) return false;  // here other parts are left as they are
        for (std::size_t i = first; i < parts.size(); ++i)
            made += least_made_for_each_of_min_triangles * parts[i].min_triangles;
    }
    return made > triangles;
}

LoadEstimate estimate_loads(std::span<const Point> points, const Tris& tris, const SizeField& size) {
    const DividedTriangles divided = divide_triangles(points, tris, size);
    LoadEstimate result;
    result.begin.insert(result.begin.end(), divided.ends.begin(), divided.ends.end());
    if (divided.parts.empty()) return result;

    const LatticeLevels levels = levels_for(divided.parts);
    const LatticeSums sums = sum_up(divided, levels);
    const double lattice = lattice_probability(sums);
    result.lattice = lattice > 0;
    double inside = 0;
    result.loads.reserve(divided.parts.size());
    for (const TrianglePart& part : divided.parts) {
        const double by_refinement = refined(part.gradient);
        const double by_lattice =
            lattice > 0 && is_even(part) ? latticed * lattice_triangles(part, levels) : by_refinement;
        const double triangles = part.min_triangles * (lattice * by_lattice + (1 - lattice) * by_refinement);
        result.loads.push_back({part.at, triangles});
        inside += triangles;
    }
    // The triangles along the border are spread over the whole region.
    const double seam = lattice > 0 ? lattice * (sums.even / sums.min_triangles) : 0;
    result.total = inside + sums.border_edges * (seam * latticed_along_border + (1 - seam) * refined_along_border);
    if (inside > 0)  // it underflows where h is beyond 1e154
        for (Load& load : result.loads) load.triangles *= result.total / inside;
    return result;
}

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

RefinementEstimate estimate_triangles(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                      const SizeField& size, const ConstrainedRefineOptions& options) {
    const ConstrainedInput input = make_constrained_input(points, triangulation, RegionSizes(size), options.regions);
    UndividedSums sums;
    for (Index t = 0; t < input.tris.size(); ++t) add_triangle(input, t, sums);
    const double by_lattice = sums.min_triangles * made_for_each_of_min_triangles(0);
    const bool lattice = options.refine.lattice && by_lattice > min_lattice_per_border_edge * sums.border_edges;
    const double by_size = lattice ? by_lattice + latticed_along_border * sums.border_edges
                                   : refined(0) * sums.min_triangles + refined_along_border * sums.border_edges;
    const auto given = static_cast<double>(triangulation.triangles.size());
    RefinementEstimate estimate{std::max(by_size, given), 0, 0};
    if (options.refine.min_angle_deg > 0) add_angles(input, triangulation, options, estimate);
    return estimate;
}

}  // namespace lamina
