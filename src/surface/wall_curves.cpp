#include "surface/wall_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/bounding_box.hpp"
#include "core/lexicographic_order.hpp"
#include "core/segments.hpp"

namespace lamina::surface {

namespace {

constexpr int samples = 16;  // of a curve that is measured

/// Returns the bound of the rounding errors of points on curves. Positions along a curve count from its start, so
/// errors are as large as those of the largest coordinates everywhere.
double rounding_of(std::span<const CurvedEdge> edges) {
    double largest = 0;
    for (const CurvedEdge& edge : edges) largest = std::max({largest, std::abs(edge.begin.x), std::abs(edge.begin.y)});
    return 0x1p-48 * largest;
}

double bend_of(const CurvedEdge& edge) {
    double bend = 0;
    for (int k = 1; k < samples; ++k)
        bend =
            std::max(bend, core::distance_to_segment(edge.at(static_cast<double>(k) / samples), edge.begin, edge.end));
    return bend;
}

/// Returns a box round a curve and more.
Box box_round(const CurvedEdge& edge, double margin) {
    Box box;
    for (int k = 0; k <= samples; ++k) box.include(edge.at(static_cast<double>(k) / samples));
    return {box.lower - Point{margin, margin}, box.upper + Point{margin, margin}};
}

/// Returns the share at which the curve of an edge goes through a point, if it does up to rounding. The curve turns by
/// less than half a right angle from its chord, along which its points therefore follow each other.
std::optional<double> share_of(const CurvedEdge& edge, Point p, double rounding) {
    constexpr int halvings = 60;
    if (p == edge.begin) return 0.0;
    if (p == edge.end) return 1.0;
    const Point chord = edge.end - edge.begin;
    double lower = 0, upper = 1;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (lower + upper);
        (dot(edge.at(middle) - p, chord) < 0 ? lower : upper) = middle;
    }
    const double share = 0.5 * (lower + upper);
    if (distance(edge.at(share), p) > rounding) return {};
    return share;
}

}  // namespace

WallCurves::WallCurves(std::vector<CurvedEdge> edges) : edges_(std::move(edges)) {
    const core::LexicographicOrder precedes;
    std::sort(edges_.begin(), edges_.end(), [&](const CurvedEdge& a, const CurvedEdge& b) {
        return a.begin == b.begin ? precedes(a.end, b.end) : precedes(a.begin, b.begin);
    });
    rounding_ = rounding_of(edges_);
    std::vector<Box> boxes;
    for (const CurvedEdge& edge : edges_) {
        const double bend = bend_of(edge);
        bends_.push_back(bend > rounding_ ? bend : 0);
        boxes.push_back(box_round(edge, bend + rounding_));  // far more than the curve can be off its samples
    }
    tree_ = core::BoxTree(std::move(boxes));
}

std::optional<CurveStretch> WallCurves::between(Point begin, Point end) const {
    const core::LexicographicOrder precedes;
    auto whole = std::lower_bound(edges_.begin(), edges_.end(), begin,
                                  [&](const CurvedEdge& edge, Point p) { return precedes(edge.begin, p); });
    for (; whole != edges_.end() && whole->begin == begin; ++whole)
        if (whole->end == end) return CurveStretch{&*whole, 0, 1};
    std::optional<CurveStretch> found;
    tree_.overlaps(core::bounding_box(begin, end), [&](std::size_t i) {
        if (found) return;
        const std::optional<double> from = share_of(edges_[i], begin, rounding_),
                                    to = share_of(edges_[i], end, rounding_);
        if (from && to && *from < *to) found = {&edges_[i], *from, *to};
    });
    return found;
}

std::optional<Point> WallCurves::place(Point begin, Point end, double share) const {
    const std::optional<CurveStretch> stretch = between(begin, end);
    if (!stretch || bends_[static_cast<std::size_t>(stretch->edge - edges_.data())] == 0) return {};
    return stretch->at(share);
}

}  // namespace lamina::surface
