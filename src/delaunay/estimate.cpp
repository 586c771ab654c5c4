// Triangles are counted in units of the largest that is allowed, as the integral of 1 / h^2. How much smaller than that
// the mean triangle is depends on who makes it (measured: docs/decisions/0015):
//
//   refinement    0.69 of the bound, whatever the gradation, and a little less along frozen edges
//   a lattice     its level's share, 0.71 to 0.94, less a seam along frozen edges; there is one where h is even over
//                 the width of a block, and where enough lies inside the seams
#include "delaunay/estimate.hpp"

#include <algorithm>
#include <cmath>

#include "core/equilateral.hpp"
#include "core/parallel.hpp"
#include "delaunay/lattice.hpp"

namespace lamina::delaunay {

namespace {

// ---- measured ----

/// Triangles of refinement for each of the bound's, and as many more with the growth of h; and a frozen edge's own.
constexpr double refined_where_even = 1.435, refined_by_growth = 0.28, refined_along_border = 0.184;
constexpr double refined(double gradient) { return refined_where_even + refined_by_growth * gradient; }
/// Triangles for each of the lattice's own; and a frozen edge's own, for the seam.
constexpr double latticed = 1.02, latticed_along_border = 0.63;
/// Mean share of the bound of lattice triangles where h passes through the levels.
constexpr double mean_level_share = 0.812;
/// Growth of h beyond which no block keeps to one level.
constexpr double even_gradient = (level_ratio - 1) / (2 * smallest_block);
/// A lattice is made where its triangles are more than so many for each frozen edge and each change of level.
constexpr double least_lattice_per_border_edge = 7, least_lattice_per_crossing = 60;
constexpr double least_even_share = 0.5;
/// Within this factor of that it may be made or not, and half of each is foreseen.
constexpr double uncertain = 1.25;

// ---- integral ----

struct Corner {
    Point at;
    double size;
};

double squared_edge(const Corner& a, const Corner& b) { return squared_length(b.at - a.at); }

/// Part of a triangle, in which h is nearly linear.
struct Part {
    Point at;
    double bound;              ///< triangles of the bound's area
    double gradient;           ///< of h
    double low, high, inside;  ///< h at the corners and in the middle
};

Part make_part(const Corner& a, const Corner& b, const Corner& c, double inside, double steepest) {
    const Point ab = b.at - a.at, ac = c.at - a.at;
    const double area2 = std::abs(cross(ab, ac));
    const double climb = length((b.size - a.size) * ac - (c.size - a.size) * ab);
    const auto inverse_square = [](double h) { return 1 / (h * h); };
    const double mean =
        0.75 * inverse_square(inside) + (inverse_square(a.size) + inverse_square(b.size) + inverse_square(c.size)) / 12;
    return {(1.0 / 3) * (a.at + b.at + c.at),
            0.5 * area2 * mean / core::equilateral_area,
            climb < steepest * area2 ? climb / area2 : steepest,
            std::min({a.size, b.size, c.size, inside}),
            std::max({a.size, b.size, c.size, inside}),
            inside};
}

/// When a triangle is a part as it stands, in lengths of the smallest h at its corners.
struct Limits {
    double short_edges;  ///< all edges shorter than this: h in the middle is taken for the mean of the corners'
    /// Edges longer than this are halved: a source inside lowers h up to a distance of h / gradation, and parts are
    /// small enough, against the whole of the piece, to tell which side of a line they lie on.
    double long_edge;
    double little_area;  ///< unless there is so little in the triangle that it does not matter
};

Limits limits(const SizeField& size, std::size_t border_points) {
    const double reach = 1 / size.gradation(), border = static_cast<double>(border_points);
    // A piece is about border / 4 edges wide: parts up to a tenth of that, or with 0.05 % of what it holds.
    return {std::clamp(0.3 * reach, 1.0, 40.0), std::clamp(1.6 * reach, 16.0, std::max(40.0, border / 40)),
            std::clamp(3e-5 * border * border, 4.0, 64.0)};
}

/// Appends the parts of a triangle, which is halved at its longest edge until h differs little between the corners and
/// the middle.
void divide(Corner a, Corner b, Corner c, const SizeField& size, const Limits& limit, int depth,
            std::vector<Part>& parts) {
    const double low = std::min({a.size, b.size, c.size}), high = std::max({a.size, b.size, c.size});
    const double mean = (a.size + b.size + c.size) / 3;
    const double ab = squared_edge(a, b), bc = squared_edge(b, c), ca = squared_edge(c, a);
    const double squared_longest = std::max({ab, bc, ca}), squared_low = low * low;
    const bool is_short = squared_longest < limit.short_edges * limit.short_edges * squared_low;
    const double inside = is_short ? mean : size((1.0 / 3) * (a.at + b.at + c.at));
    const bool is_little = 0.5 * std::abs(cross(b.at - a.at, c.at - a.at)) < limit.little_area * squared_low;
    const bool is_long = squared_longest > limit.long_edge * limit.long_edge * squared_low;
    const bool alike = high < (is_little ? 2 : 1.5) * low && inside < 1.2 * mean && mean < 1.2 * inside;
    if (depth == 0 || (alike && (is_little || !is_long))) {
        parts.push_back(make_part(a, b, c, inside, size.gradation()));
        return;
    }
    // c-a becomes the longest edge.
    if (ab >= bc && ab >= ca)
        std::swap(b, c);
    else if (bc >= ca)
        std::swap(a, b);
    const Point half = midpoint(a.at, c.at);
    const Corner between{half, size(half)};
    divide(a, b, between, size, limit, depth - 1, parts);
    divide(between, b, c, size, limit, depth - 1, parts);
}

// ---- lattice or not ----

/// What decides on a lattice, of a whole piece.
struct Sums {
    double bound = 0, even = 0;  ///< triangles of the bound's area, of them where h is even
    double lattice = 0;          ///< triangles of the lattices there
    double crossings = 0;        ///< of levels, times the edges that they are long
    double border_edges = 0;
    double low = HUGE_VAL, high = 0;  ///< sizes
};

bool is_even(const Part& part) { return part.gradient < even_gradient; }

/// Lattice triangles in the place of one of the bound's.
double lattice_triangles(const Part& part, const std::vector<double>& edges) {
    if (part.high > level_ratio * part.low) return 1 / mean_level_share;
    constexpr double rounding = 1 + 1e-6;  // the field holds single-precision numbers
    const double share = edges[static_cast<std::size_t>(level_of(part.inside * rounding, edges))] / part.inside;
    return 1 / (share * share);
}

/// Between 0, no lattice, and 1.
double lattice_expected(const Sums& sums) {
    if (sums.even < least_even_share * sums.bound) return 0;
    const double needed = least_lattice_per_border_edge * sums.border_edges * (sums.even / sums.bound) +
                          least_lattice_per_crossing * sums.crossings;
    if (sums.lattice > uncertain * needed) return 1;
    return uncertain * sums.lattice > needed ? 0.5 : 0;
}

}  // namespace

double estimated_triangles(double area, double mean_inverse_square_size, double gradient) {
    // Where h hardly grows one level serves all of it, else all levels do.
    constexpr double one_level = 0.001;
    const double bound = area * mean_inverse_square_size / core::equilateral_area;
    if (gradient < one_level) return latticed / (lattice_share * lattice_share) * bound;
    return (gradient < even_gradient ? latticed / mean_level_share : refined(gradient)) * bound;
}

Loads estimate_loads(std::span<const Point> points, const Tris& tris, const SizeField& size) {
    constexpr int deepest = 40;         // halvings of one triangle: a guard only
    constexpr std::size_t grain = 256;  // triangles a block
    const Limits limit = limits(size, points.size());
    std::vector<double> sizes(points.size());
    std::transform(points.begin(), points.end(), sizes.begin(), [&](Point p) { return size(p); });
    struct Divided {
        std::vector<Part> parts;
        std::vector<std::size_t> ends;  // of each triangle's parts
        std::size_t border_edges = 0;
    };
    const auto divide_block = [&](std::size_t begin, std::size_t end) {
        Divided divided;
        for (std::size_t i = begin; i < end; ++i) {
            const Tri& t = tris[i];
            const auto corner = [&](Index v) { return Corner{points[v], sizes[v]}; };
            divide(corner(t.v[0]), corner(t.v[1]), corner(t.v[2]), size, limit, deepest, divided.parts);
            divided.ends.push_back(divided.parts.size());
            divided.border_edges +=
                static_cast<std::size_t>(std::count_if(t.n, t.n + 3, [](Link n) { return n.is_constrained(); }));
        }
        return divided;
    };
    Loads result;
    Sums sums;
    std::vector<Part> parts;
    for (const Divided& divided : core::parallel_blocks(tris.size(), grain, divide_block)) {
        for (const std::size_t end : divided.ends) result.begin.push_back(parts.size() + end);
        parts.insert(parts.end(), divided.parts.begin(), divided.parts.end());
        sums.border_edges += static_cast<double>(divided.border_edges);
    }

    if (parts.empty()) return result;
    for (const Part& part : parts) {
        sums.low = std::min(sums.low, part.low);
        sums.high = std::max(sums.high, part.high);
    }
    std::vector<SizeCount> counts;
    for (const Part& part : parts) counts.push_back({part.low, part.high, part.bound});
    const std::vector<double> edges = level_edges(sums.low, 1.01 * sums.high, std::move(counts));
    for (const Part& part : parts) {
        sums.bound += part.bound;
        if (!is_even(part)) continue;
        sums.even += part.bound;
        sums.lattice += part.bound * lattice_triangles(part, edges);
        sums.crossings += part.bound * part.gradient;
    }

    const double lattice = sums.bound > 0 ? lattice_expected(sums) : 0;
    result.lattice = lattice > 0;
    double inside = 0;
    result.loads.reserve(parts.size());
    for (const Part& part : parts) {
        const double by_refinement = refined(part.gradient);
        const double by_lattice =
            lattice > 0 && is_even(part) ? latticed * lattice_triangles(part, edges) : by_refinement;
        const double triangles = part.bound * (lattice * by_lattice + (1 - lattice) * by_refinement);
        result.loads.push_back({part.at, triangles});
        inside += triangles;
    }
    // What lies along the border is spread over the piece.
    const double seam = lattice > 0 ? lattice * (sums.even / sums.bound) : 0;
    result.total = inside + sums.border_edges * (seam * latticed_along_border + (1 - seam) * refined_along_border);
    if (inside > 0)  // it underflows where h is beyond 1e154
        for (Load& load : result.loads) load.triangles *= result.total / inside;
    return result;
}

}  // namespace lamina::delaunay
