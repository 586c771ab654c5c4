// The number of triangles in a whole region, before it is cut into subdomains. Triangles between a border and a far
// field are long and narrow, and h differs by orders of magnitude between their ends. Narrow ones are integrated along
// their length; halving them at their longest edges would leave hundreds of parts that all meet at the border.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/parallel.hpp"
#include "delaunay/refine/estimate.hpp"
#include "sizing/sized_point.hpp"

namespace lamina::delaunay {

namespace {

using sizing::SizedPoint;

/// h may differ by this factor in a part.
constexpr double max_ratio = 1.5;
/// h in the middle of a part may differ by this factor from the mean at its ends.
constexpr double max_middle_ratio = 1.2;
constexpr int max_depth = 200;  // only a guard

double inverse_square(double h) { return 1 / (h * h); }

/// Returns whether h is nearly linear and nearly even where it has these values.
bool is_even(double low, double high, double inside, double mean) {
    return high < max_ratio * low && inside < max_middle_ratio * mean && mean < max_middle_ratio * inside;
}

/// Estimates the triangles in one triangle.
class TriangleTotal {
public:
    explicit TriangleTotal(const SizeField& size) : size_(size) {}

    double in(SizedPoint a, SizedPoint b, SizedPoint c, int depth = max_depth) const {
        const std::array<double, 3> squared = sizing::squared_edges(a, b, c);
        const auto [shortest, longest] = std::minmax({squared[0], squared[1], squared[2]});
        while (squared_length(b.at - a.at) != shortest) a = std::exchange(b, std::exchange(c, a));
        if (is_narrow(shortest, longest, std::min(a.size, b.size))) return along({a, b, c});

        const double mean = (a.size + b.size + c.size) / 3, inside = size_((1.0 / 3) * (a.at + b.at + c.at));
        const auto [low, high] = std::minmax({a.size, b.size, c.size});
        if (depth == 0 || is_even(low, high, inside, mean)) {
            const double mean_inverse_square =
                0.75 * inverse_square(inside) +
                (inverse_square(a.size) + inverse_square(b.size) + inverse_square(c.size)) / 12;
            const double area2 = std::abs(cross(b.at - a.at, c.at - a.at));
            const double climb = length((b.size - a.size) * (c.at - a.at) - (c.size - a.size) * (b.at - a.at));
            return estimated_triangles(0.5 * area2, mean_inverse_square, gradient(climb, area2));
        }
        sizing::rename_longest_edge(a, b, c, sizing::squared_edges(a, b, c));
        const Point half = midpoint(a.at, c.at);
        const SizedPoint between{half, size_(half)};
        return in(a, b, between, depth - 1) + in(between, b, c, depth - 1);
    }

private:
    /// A triangle with a short edge a-b.
    struct Narrow {
        SizedPoint a, b, c;
    };
    /// A place between the middle of a-b (t = 0) and c (t = 1).
    struct Place {
        double t, h;
    };

    static bool is_narrow(double shortest_squared, double longest_squared, double h) {
        constexpr double min_slenderness = 4, max_width = 2;
        return longest_squared > min_slenderness * min_slenderness * shortest_squared &&
               shortest_squared < max_width * max_width * h * h;
    }

    /// Returns climb / distance, but no more than the gradation: rounding might add to it.
    double gradient(double climb, double distance) const {
        const double bound = size_.gradation();
        return climb < bound * distance ? climb / distance : bound;
    }

    double along(const Narrow& triangle) const {
        return between(triangle, {0, 0.5 * (triangle.a.size + triangle.b.size)}, {1, triangle.c.size}, max_depth);
    }

    double between(const Narrow& triangle, Place from, Place to, int depth) const {
        const auto& [a, b, c] = triangle;
        const Point foot = midpoint(a.at, b.at);
        const double t = 0.5 * (from.t + to.t), h = size_(foot + t * (c.at - foot));
        if (depth > 0 && !is_even(std::min(from.h, to.h), std::max(from.h, to.h), h, 0.5 * (from.h + to.h)))
            return between(triangle, from, {t, h}, depth - 1) + between(triangle, {t, h}, to, depth - 1);
        const double area =
            0.5 * std::abs(cross(b.at - a.at, c.at - a.at)) * ((1 - from.t) * (1 - from.t) - (1 - to.t) * (1 - to.t));
        const double mean_inverse_square = (inverse_square(from.h) + 4 * inverse_square(h) + inverse_square(to.h)) / 6;
        return estimated_triangles(area, mean_inverse_square,
                                   gradient(std::abs(to.h - from.h), (to.t - from.t) * distance(foot, c.at)));
    }

    const SizeField& size_;
};

}  // namespace

double estimate_undivided(std::span<const Point> points, const Tris& tris, const SizeField& size) {
    constexpr std::size_t grain = 256;  // triangles in a block
    std::vector<double> sizes(points.size());
    std::transform(points.begin(), points.end(), sizes.begin(), [&](Point p) { return size(p); });
    const auto corner = [&](Index v) { return SizedPoint{points[v], sizes[v]}; };
    const TriangleTotal total(size);
    const std::vector<double> blocks =
        core::parallel_blocks(tris.size(), grain, [&](std::size_t begin, std::size_t end) {
            double triangles = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const Tri& t = tris[i];
                triangles += total.in(corner(t.v[0]), corner(t.v[1]), corner(t.v[2]));
                triangles += refined_along_border * static_cast<double>(std::count_if(
                                                        t.n, t.n + 3, [](Link n) { return n.is_constrained(); }));
            }
            return triangles;
        });
    return std::accumulate(blocks.begin(), blocks.end(), 0.0);
}

}  // namespace lamina::delaunay
