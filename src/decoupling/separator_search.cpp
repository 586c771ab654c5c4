// Separators that leave a border at about right angles are tried all round the border. The best one halves the work, is
// short, and is square to the borders that it meets. Subdomains round the ends of a body become wedges, which are then
// cut across.
//
//      box    o-----------o-----------o
//             |           :           |
//             |     1     :     2     |
//             |           :           |
//      layer  o~~~~~~~~~~~o~~~~~~~~~~~o
#include "decoupling/separator_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "decoupling/separators.hpp"
#include "sizing/requests.hpp"

namespace lamina::decoupling {

namespace {

/// A subdomain of up to this multiple of the target stays whole: its halves would be smaller than need be.
constexpr double max_whole = 1.5;
/// Cosine of the sharpest angle between a separator and the borders that it meets: 60 degrees.
constexpr double max_cosine = 0.5;
/// Neither side of a separator holds less than this share of the work.
constexpr double min_share = 0.15;
/// Number of segments of a separator that divides a subdomain.
constexpr std::size_t min_separator_segments = 4;
/// Number of segments of a separator that joins two loops. It is larger, so that narrow gaps are left alone.
constexpr std::size_t min_joining_segments = 8;
/// Separators are tried from every n-th vertex of a border, n being chosen so that there are this many or up to twice
/// as many.
constexpr std::size_t min_origins = 64;
/// Number of candidates that are looked at closely.
constexpr std::size_t max_tried = 32;
/// Largest ratio, either way, of the lengths of a separator's first or last segment and of the border edges beside it.
constexpr double max_ratio = 1.6;
/// Vertices of a separator keep this share of their distance from each other away from the border.
constexpr double clearance = 0.7;

/// A straight line between two vertices of the border; the lower its cost, the better.
struct CandidateLine {
    LoopVertex from, to;
    double cost;
};

bool is_better(const CandidateLine& a, const CandidateLine& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    const auto ends = [](const CandidateLine& l) {
        return std::array{l.from.loop, l.from.index, l.to.loop, l.to.index};
    };
    return ends(a) < ends(b);
}

/// Returns the box round the circle about the middle of a-b with a radius of `share` x its length.
Box circle_box(Point a, Point b, double share) {
    const double r = share * distance(a, b);
    return {midpoint(a, b) - Point{r, r}, midpoint(a, b) + Point{r, r}};
}

/// The search in one subdomain.
class SeparatorSearch {
public:
    SeparatorSearch(LocalBorder border, const SizeField& size) : border_(std::move(border), size), size_(size) {}

    SearchResult run(double pieces_target) {
        SearchResult result;
        if (!border_.has_more_than(max_whole * pieces_target) || !find(result)) {
            result.estimate = border_.estimate();
            result.work = result.estimate->triangles;
        }
        return result;
    }

private:
    /// Looks for a separator. Returns whether there is one.
    bool find(SearchResult& result) {
        std::vector<CandidateLine> lines = candidates();
        const std::size_t tried = std::min(lines.size(), max_tried);
        std::partial_sort(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(tried), lines.end(), is_better);
        if (tried == 0) return false;
        collect_border_edges();
        for (std::size_t i = 0; i < tried && !result.separator; ++i)
            if (auto interior = divide(lines[i]))
                result.separator = {lines[i].from, lines[i].to, interior->size(), *std::move(interior)};
        return result.separator.has_value();
    }

    /// Returns all lines that may become separators.
    std::vector<CandidateLine> candidates() const {
        std::size_t vertices = 0;
        for (std::size_t l = 0; l < border_.loops(); ++l) vertices += border_.vertices(l);
        const std::size_t stride = std::max<std::size_t>(1, vertices / min_origins);
        std::vector<LoopVertex> origins;
        for (std::size_t l = 0; l < border_.loops(); ++l)
            for (std::size_t i = 0; i < border_.vertices(l); i += stride) origins.push_back({l, i});
        std::vector<CandidateLine> lines;
        const auto lines_from = [&](std::size_t begin, std::size_t end) {
            std::vector<CandidateLine> found;
            for (std::size_t i = begin; i < end; ++i) add_lines_from(origins[i], found);
            return found;
        };
        for (const std::vector<CandidateLine>& found : core::parallel_blocks(origins.size(), 4, lines_from))
            lines.insert(lines.end(), found.begin(), found.end());
        return lines;
    }

    /// Adds lines from a vertex to the vertices near the border edges that rays from it meet.
    void add_lines_from(LoopVertex from, std::vector<CandidateLine>& lines) const {
        const Point straight = inward(from), sideways = perpendicular(straight);
        if (cosine_with_edges(from, straight) > max_cosine) return;
        for (const double turn : {0.0, 0.35, -0.35}) {  // up to 20 degrees to either side
            const Point direction = straight + turn * sideways;
            if (cosine_with_edges(from, direction) > max_cosine) continue;
            const auto hit = border_.shoot(from, direction);
            if (!hit) continue;
            const LoopVertex behind = border_.next(hit->edge);
            for (const LoopVertex to : {border_.previous(hit->edge), hit->edge, behind, border_.next(behind)})
                if (const auto line = rate(from, to, hit->triangles_left)) lines.push_back(*line);
        }
    }

    /// Returns the direction that halves the angle of the border at a vertex.
    Point inward(LoopVertex v) const {
        const Point p = border_.point(v), a = border_.point(border_.next(v)), b = border_.point(border_.previous(v));
        return unit(perpendicular(unit(a - p) - unit(b - p)));
    }

    /// Returns the largest cosine between a direction from a vertex and the edges beside the vertex, or 1 where the
    /// direction does not lead into the subdomain.
    double cosine_with_edges(LoopVertex v, Point direction) const {
        const Point p = border_.point(v), a = border_.point(border_.next(v)), b = border_.point(border_.previous(v));
        if (!core::inside_wedge(p, a, b, p + direction)) return 1;
        const double l = length(direction);
        return std::max(dot(direction, a - p) / (l * distance(p, a)), dot(direction, b - p) / (l * distance(p, b)));
    }

    /// Returns the line between two vertices with its cost, unless it is out of the question. It has about
    /// `triangles_left` triangles on its left.
    std::optional<CandidateLine> rate(LoopVertex from, LoopVertex to, double triangles_left) const {
        const bool joins = from.loop != to.loop;
        if (!joins && border_.loops() > 1) return std::nullopt;
        const double triangles = border_.triangles(), share = joins ? 0.5 : triangles_left / triangles;
        if (!joins && (share < min_share || share > 1 - min_share)) return std::nullopt;
        const Point p = border_.point(from), q = border_.point(to);
        const double cosine = std::max(cosine_with_edges(from, q - p), cosine_with_edges(to, p - q));
        if (cosine > max_cosine) return std::nullopt;
        const double h_from = size_(p), h_to = size_(q);
        // A joining line goes from where the border is finest to where it is coarse: rather to the outer border than to
        // another body.
        if (joins) return CandidateLine{from, to, cosine + std::min(h_from, h_to) / std::max(h_from, h_to)};
        const double segments = distance(p, q) / (sizing::frozen_share * std::sqrt(h_from * h_to));
        return CandidateLine{from, to, std::abs(2 * share - 1) + 0.5 * cosine + 0.2 * segments / std::sqrt(triangles)};
    }

    void collect_border_edges() {
        std::vector<Box> boxes;
        for (std::size_t l = 0; l < border_.loops(); ++l)
            for (std::size_t i = 0; i < border_.vertices(l); ++i) {
                const LoopVertex v{l, i};
                edges_.push_back(v);
                boxes.push_back(circle_box(border_.point(v), border_.point(border_.next(v)), 0.5));
            }
        edge_tree_ = core::BoxTree(std::move(boxes));
    }

    /// Returns the points inside the line, if the line is a good separator.
    std::optional<std::vector<Point>> divide(const CandidateLine& line) const {
        if (!border_.sees(line.from, line.to)) return std::nullopt;
        const Point p = border_.point(line.from), q = border_.point(line.to);
        std::vector<Point> interior = divide_separator(p, q, size_);
        const bool joins = line.from.loop != line.to.loop;
        if (interior.size() + 1 < (joins ? min_joining_segments : min_separator_segments)) return std::nullopt;
        if (!is_like_edges_at(line.from, distance(p, interior.front())) ||
            !is_like_edges_at(line.to, distance(q, interior.back())))
            return std::nullopt;
        std::vector<Point> chain{p};
        chain.insert(chain.end(), interior.begin(), interior.end());
        chain.push_back(q);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            if (!is_clear(chain[i], chain[i + 1], p, q)) return std::nullopt;
        return interior;
    }

    /// Returns whether a length is like the lengths of the edges beside a vertex.
    bool is_like_edges_at(LoopVertex v, double length) const {
        for (const LoopVertex other : {border_.next(v), border_.previous(v)}) {
            const double edge = distance(border_.point(v), border_.point(other));
            if (length > max_ratio * edge || edge > max_ratio * length) return false;
        }
        return true;
    }

    /// Returns whether the segment a-b of the line from p to q and the border keep out of each other's diametral
    /// circles, and the segment's ends keep away from the border's vertices.
    bool is_clear(Point a, Point b, Point p, Point q) const {
        const auto encroaches = [](Point x, Point u, Point v) { return dot(u - x, v - x) <= 0; };
        const double squared_clearance = clearance * clearance * squared_length(b - a);
        bool clear = true;
        edge_tree_.overlaps(circle_box(a, b, 0.5 + clearance), [&](std::size_t item) {
            const Point u = border_.point(edges_[item]), v = border_.point(border_.next(edges_[item]));
            if (!(u == p) && !(u == q) && encroaches(u, a, b)) clear = false;
            for (const Point x : {a, b}) {
                if (x == p || x == q) continue;
                if (encroaches(x, u, v) || squared_length(u - x) < squared_clearance) clear = false;
            }
        });
        return clear;
    }

    BorderTriangulation border_;
    const SizeField& size_;
    std::vector<LoopVertex> edges_;  ///< all border edges, each from this vertex to the next
    core::BoxTree edge_tree_{{}};    ///< the boxes round their diametral circles
};

}  // namespace

SearchResult search_separator(LocalBorder border, const SizeField& size, double pieces_target) {
    return SeparatorSearch(std::move(border), size).run(pieces_target);
}

}  // namespace lamina::decoupling
