#include "delaunay/constrain/piece_edges.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/bounding_box.hpp"

namespace lamina::delaunay {

namespace {

/// Orders the items, which are indices of centers, so that neighbours in the order are neighbours in the plane. Halves
/// the items across the longer side of their box, and each half again.
void order_by_position(std::span<std::size_t> items, const std::vector<Point>& centers) {
    if (items.size() <= 4) return;
    Box box;
    for (std::size_t i : items) box.include(centers[i]);
    const bool by_x = box.width() > box.height();
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), middle, items.end(), [&](std::size_t l, std::size_t r) {
        const double a = by_x ? centers[l].x : centers[l].y, b = by_x ? centers[r].x : centers[r].y;
        return a != b ? a < b : l < r;
    });
    order_by_position(items.first(items.size() / 2), centers);
    order_by_position(items.subspan(items.size() / 2), centers);
}

}  // namespace

PieceEdge edge_of(std::span<const Point> points, const Segment& segment) {
    const PieceEdge edge{segment.a.value, segment.b.value};
    return lexicographically_less(points[edge.b], points[edge.a]) ? PieceEdge{edge.b, edge.a} : edge;
}

std::size_t PieceEdges::find(const PieceEdge& edge) const {
    const auto found = std::lower_bound(edges.begin(), edges.end(), edge);
    assert(found != edges.end() && *found == edge);
    return static_cast<std::size_t>(found - edges.begin());
}

PieceEdges edges_of(std::span<const Point> points, std::span<const SegmentPiece> pieces) {
    std::vector<std::pair<std::uint64_t, Index>> uses;
    uses.reserve(pieces.size());
    for (const SegmentPiece& piece : pieces) {
        const PieceEdge edge = edge_of(points, piece.segment);
        uses.push_back({directed_key(edge.a, edge.b), piece.parent});
    }
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    PieceEdges result;
    for (const auto& [key, parent] : uses) {
        const PieceEdge edge{static_cast<Index>(key >> 32), static_cast<Index>(key)};
        if (result.edges.empty() || !(result.edges.back() == edge)) {
            result.edges.push_back(edge);
            result.first_parent.push_back(result.parents.size());
        }
        result.parents.push_back(parent);
    }
    result.first_parent.push_back(result.parents.size());
    return result;
}

std::vector<Box> PieceEdgeTree::sorted_boxes(std::span<const Point> points, const std::vector<PieceEdge>& edges,
                                             std::span<const double> margins) {
    std::vector<Point> centers;
    centers.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        boxes_[i] = core::bounding_box(points[edges[i].a], points[edges[i].b]);
        const Point margin{margins[i], margins[i]};
        boxes_[i] = {boxes_[i].lower - margin, boxes_[i].upper + margin};
        centers.push_back(boxes_[i].center());
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    order_by_position(order_, centers);
    std::vector<Box> sorted;
    sorted.reserve(order_.size());
    for (std::size_t i : order_) sorted.push_back(boxes_[i]);
    return sorted;
}

}  // namespace lamina::delaunay
