// Monotone chains: A. M. Andrew, Inf. Proc. Letters 9 (1979). Only few points come to the exact predicates: the points
// on or beyond the chords between the outermost points of blocks.
#include "delaunay/pieces/convex_hull.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "core/parallel.hpp"
#include "core/predicates.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// Number of points in a block; blocks follow each other in the order by x.
constexpr std::size_t block_size = 64;

/// The lowest and the highest point of every block.
struct BlockExtremes {
    std::vector<Point> lowest, highest;
};

BlockExtremes find_extremes(std::span<const Point> points) {
    BlockExtremes extremes;
    const std::size_t blocks = (points.size() + block_size - 1) / block_size;
    extremes.lowest.resize(blocks);
    extremes.highest.resize(blocks);
    core::parallel_for(blocks, 2000, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const std::span<const Point> block =
                points.subspan(b * block_size, std::min(block_size, points.size() - b * block_size));
            const Point *lowest = block.data(), *highest = block.data();
            for (const Point& p : block) {
                if (p.y < lowest->y) lowest = &p;
                if (p.y > highest->y) highest = &p;
            }
            extremes.lowest[b] = *lowest;
            extremes.highest[b] = *highest;
        }
    });
    return extremes;
}

/// A convex chain that bounds the lower side of the hull from above (sign 1) or, upside down, its upper side (sign -1).
template <int sign>
class BoundingChain {
public:
    /// Makes the lower hull of the extremes of blocks, by rounded arithmetic. Rounding can only choose other chords,
    /// and every chord between points lies above the hull.
    explicit BoundingChain(std::span<const Point> extremes) {
        for (const Point e : extremes) {
            const Point p{e.x, height_of(e)};
            magnitude_ = std::max(magnitude_, std::abs(p.y));
            while (chain_.size() >= 2 && cross(chain_.back() - chain_[chain_.size() - 2], p - chain_.back()) <= 0)
                chain_.pop_back();
            if (chain_.empty() || p.x > chain_.back().x) chain_.push_back(p);
        }
    }

    /// Returns the height of a point: its y, measured so that the outside of the hull is low.
    static double height_of(Point p) { return sign * p.y; }

    /// Returns the height of the chain at x, infinite beyond its ends. Precondition: x is no less than in earlier
    /// calls.
    double height_at(double x) {
        while (edge_ + 2 < chain_.size() && chain_[edge_ + 1].x < x) ++edge_;
        const bool beyond = chain_.size() < 2 || x < chain_[edge_].x || x > chain_[edge_ + 1].x;
        if (beyond) return HUGE_VAL;
        const Point a = chain_[edge_], b = chain_[edge_ + 1];
        return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    }

    /// Returns more than the rounding errors of height_at() can amount to.
    double rounding_error() const { return 0x1p-40 * magnitude_; }

private:
    std::vector<Point> chain_;
    double magnitude_ = 0;  ///< largest absolute height
    std::size_t edge_ = 0;  ///< where the last call of height_at() ended
};

/// Returns the points that may be on the lower side (sign 1) or the upper side (-1) of the hull, in ascending order.
/// `extremes` are the outermost points of the blocks on that side.
template <int sign>
std::vector<Index> hull_candidates(std::span<const Point> points, std::span<const Point> extremes) {
    BoundingChain<sign> chain(extremes);
    const auto height = [](Point p) { return BoundingChain<sign>::height_of(p); };
    const double end_x = points.back().x;
    std::vector<Index> candidates;
    double at_begin = HUGE_VAL;
    for (std::size_t begin = 0; begin < points.size(); begin += block_size) {
        const std::size_t end = std::min(begin + block_size, points.size());
        const double at_end = points[end - 1].x < end_x ? chain.height_at(points[end - 1].x) : HUGE_VAL;
        // The chain is convex: inside the block it is nowhere higher than at both ends.
        const double highest = std::max(at_begin, at_end) + chain.rounding_error();
        at_begin = at_end;
        if (height(extremes[begin / block_size]) > highest) continue;
        for (std::size_t i = begin; i < end; ++i)
            if (height(points[i]) <= highest) candidates.push_back(static_cast<Index>(i));
    }
    return candidates;
}

/// Appends the hull's side through the candidates, without its last point, with which the other side begins. Points on
/// hull edges stay. Returns the number of points that were added.
std::size_t append_chain(std::span<const Point> points, const std::vector<Index>& candidates,
                         std::vector<Index>& hull) {
    const std::size_t start = hull.size();
    for (const Index c : candidates) {
        while (hull.size() >= start + 2 &&
               core::inline_orient2d(points[hull[hull.size() - 2]], points[hull.back()], points[c]) < 0)
            hull.pop_back();
        hull.push_back(c);
    }
    // It goes from one end of the order by x to the other.
    assert(hull[start] + hull.back() + std::size_t{1} == points.size());
    hull.pop_back();
    return hull.size() - start;
}

}  // namespace

std::vector<BorderEdge> convex_hull(const SortedPoints& sorted) {
    const std::span<const Point> points = sorted.points.all();
    const BlockExtremes extremes = find_extremes(points);
    std::vector<Index> hull;
    const std::size_t lower = append_chain(points, hull_candidates<1>(points, extremes.lowest), hull);
    std::vector<Index> upper_candidates = hull_candidates<-1>(points, extremes.highest);
    std::reverse(upper_candidates.begin(), upper_candidates.end());
    const std::size_t upper = append_chain(points, upper_candidates, hull);
    const bool on_one_line = lower + 1 == points.size() && upper + 1 == points.size();
    if (on_one_line) return {};
    std::vector<BorderEdge> edges;
    edges.reserve(hull.size());
    for (std::size_t i = 0; i < hull.size(); ++i) edges.push_back({hull[i], hull[i + 1 < hull.size() ? i + 1 : 0]});
    return edges;
}

}  // namespace lamina::delaunay::pieces
