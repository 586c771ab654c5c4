// Between two neighbouring rays the grid of rays and layers is a column of cells. On rays of two origins and of one,
// and with a layer more on one of them, the body below:
//
//     c---q2---q1---b   <- outer border      c-----b             b      b, c   the top's ends; b on the first ray
//     |             |                        |     |         .-' |
//     |-------------|                         |---|         c----|      a, d   lower corners of a cell
//     |             |                         |   |         |    |
//     |-------------|                          |-|          |----|      q      points that divide the border
//     |             |                          \ /          |    |
//     d-------------a   <- wall                a=d          d----a
//
// Source: the layer's rays are those of the thesis, chapter 3; joining them as a grid goes beyond it (design 3).
#include "layers/connect.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

#include <lamina/delaunay.hpp>

#include "core/parallel.hpp"
#include "core/predicates.hpp"

namespace lamina {
namespace {

/// Cosines closer than this count as equal: coordinates of cells as thin as 1e-9 of their place are no surer than that.
constexpr double cosine_rounding = 1e-6;
constexpr std::size_t columns_a_block = 512;

VertexId on_ray(const Ray& ray, std::uint32_t n) { return n == 0 ? ray.origin : VertexId(ray.first_point + n - 1); }
VertexId tip(const Ray& ray) { return on_ray(ray, ray.layers); }

/// Cosine of the largest angle; -2, below all cosines, unless counter-clockwise (exact).
double widest_cosine(Point a, Point b, Point c) {
    if (!(detail::inline_orient2d(a, b, c) > 0)) return -2;
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double l = length(ab), m = length(bc), n = length(ca);
    return -std::max({dot(ab, bc) / (l * m), dot(bc, ca) / (m * n), dot(ca, ab) / (n * l)});
}

/// The strip between two neighbouring rays; `second` follows counter-clockwise round the body.
struct Column {
    const Ray &first, &second;
    std::span<const VertexId> top;  ///< the outer border from the tip of `first` to that of `second`
    /// Where the neighbouring column is empty, the border climbs `first` from its origin (descends `second`) to reach a
    /// ray of one layer; else without entries.
    std::span<const VertexId> up, down;
};

/// The columns of one body, each with the stretches of the border that bound it.
class Columns {
public:
    Columns(std::span<const Ray> rays, std::span<const VertexId> border)
        : rays_(rays), border_(border.begin(), border.end()) {
        border_.push_back(border_.front());
        // The border visits the tips in the order of the rays; several bare rays of one origin have one tip.
        std::size_t at = 0;
        for (const Ray& ray : rays) {
            while (border_[at] != tip(ray)) ++at;
            tip_.push_back(at);
        }
        tip_.push_back(border_.size() - 1);
    }

    std::size_t size() const { return rays_.size(); }

    Column operator[](std::size_t i) const {
        const std::size_t n = size(), before = (i + n - 1) % n, second = (i + 1) % n, after = (i + 2) % n;
        Column column{rays_[i], rays_[second], stretch(i), {}, {}};
        if (on_one_ray(before, i)) column.up = stretch(before);
        if (on_one_ray(after, second)) column.down = stretch(second);
        return column;
    }

private:
    std::span<const Ray> rays_;
    std::vector<VertexId> border_;  ///< closed: the first vertex again at its end
    std::vector<std::size_t> tip_;  ///< places of the tips in the border; behind them, of the first one again

    std::span<const VertexId> stretch(std::size_t i) const {
        return {border_.data() + tip_[i], border_.data() + tip_[i + 1] + 1};
    }

    /// Is the border between the tips of these two neighbours the lowest piece of the second?
    bool on_one_ray(std::size_t bare, std::size_t ray) const {
        return rays_[bare].layers == 0 && rays_[ray].layers == 1 && rays_[bare].origin == rays_[ray].origin;
    }
};

/// Makes the cells of columns, one after the other.
class Connector {
public:
    Connector(std::span<const Point> points, GridCells kind) : points_(points), kind_(kind) {}

    void add(const Column& column) {
        const Ray &first = column.first, &second = column.second;
        const Point from = at(first.origin), to = at(second.origin);
        first_leads_ =
            from == to ? lexicographically_less(first.direction, second.direction) : lexicographically_less(from, to);
        const std::uint32_t common = std::min(first.layers, second.layers);
        const std::uint32_t highest = std::max(first.layers, second.layers);
        if (common == 0 && from == to) return;  // the border runs along the ray

        for (layer_ = 1; layer_ <= highest; ++layer_) {
            const VertexId inner[] = {on_ray(first, layer_), on_ray(second, layer_)};
            const std::span<const VertexId> top = layer_ < highest ? std::span<const VertexId>(inner) : column.top;
            const VertexId a = on_ray(first, layer_ - 1), d = on_ray(second, layer_ - 1);
            if (layer_ == 1 && (column.up.size() > 2 || column.down.size() > 2)) {
                add_bottom_between_borders(column, top);
            } else if (layer_ > common) {
                add_fan(first.layers > common ? a : d, top);
            } else if (a == d) {
                add_fan(a, top);
            } else if (kind_ == GridCells::whole && top.size() == 2 && is_convex(a, top[0], top[1], d)) {
                add_quad(a, top[0], top[1], d);
            } else {
                add_split(a, d, top);
            }
        }
    }

    LayerCells take() { return std::move(cells_); }

private:
    std::span<const Point> points_;
    GridCells kind_;
    LayerCells cells_;
    std::uint32_t layer_ = 0;        ///< of the cell at hand
    bool first_leads_ = false;       ///< which of its lower corners comes first where cuts are equal
    std::vector<double> widest_;     ///< scratch: by cut
    std::vector<VertexId> corners_;  ///< scratch: of a polygon

    Point at(VertexId v) const { return points_[v.index()]; }

    bool is_convex(VertexId a, VertexId b, VertexId c, VertexId d) const {
        using detail::inline_orient2d;
        return inline_orient2d(at(a), at(b), at(c)) > 0 && inline_orient2d(at(b), at(c), at(d)) > 0 &&
               inline_orient2d(at(c), at(d), at(a)) > 0 && inline_orient2d(at(d), at(a), at(b)) > 0;
    }

    void add_triangle(VertexId a, VertexId b, VertexId c) {
        cells_.triangles.push_back({{a, b, c}});
        cells_.triangle_layer.push_back(static_cast<std::uint16_t>(layer_));
    }

    void add_quad(VertexId a, VertexId b, VertexId c, VertexId d) {
        cells_.quads.push_back({{a, b, c, d}});
        cells_.quad_layer.push_back(static_cast<std::uint16_t>(layer_));
    }

    void add_fan(VertexId apex, std::span<const VertexId> top) {
        for (std::size_t k = 0; k + 1 < top.size(); ++k) add_triangle(apex, top[k], top[k + 1]);
    }

    /// Points of the top lie on one line, hence two fans and the triangle a q_s d between them; s is chosen. Without q
    /// the choice is that of the diagonal: a to c (s = 1) or d to b (s = 0).
    ///
    ///     c----q3----q2----q1----b
    ///     |   /    .' \    `.    |
    ///     |  /  .'     \     `.  |       s = 2
    ///     | / .'        \      `.|
    ///     d----------------------a
    void add_split(VertexId a, VertexId d, std::span<const VertexId> top) {
        const std::size_t pieces = top.size() - 1;
        // For each s the smallest cosine of all triangles: fans grow from either end.
        widest_.assign(pieces + 1, 1);
        double fan = 1;
        for (std::size_t s = 0; s <= pieces; ++s) {
            if (s > 0) fan = std::min(fan, widest_cosine(at(a), at(top[s - 1]), at(top[s])));
            widest_[s] = std::min(fan, widest_cosine(at(a), at(top[s]), at(d)));
        }
        fan = 1;
        for (std::size_t s = pieces; s-- > 0;) {
            fan = std::min(fan, widest_cosine(at(d), at(top[s]), at(top[s + 1])));
            widest_[s] = std::min(widest_[s], fan);
        }
        const double best = *std::max_element(widest_.begin(), widest_.end());
        if (best < -1) {  // coordinates are too coarse for any
            corners_ = {a};
            corners_.insert(corners_.end(), top.begin(), top.end());
            corners_.push_back(d);
            add_polygon();
            return;
        }
        const auto good = [&](double widest) { return widest >= best - cosine_rounding; };
        const std::size_t chosen =
            first_leads_
                ? pieces -
                      static_cast<std::size_t>(std::find_if(widest_.rbegin(), widest_.rend(), good) - widest_.rbegin())
                : static_cast<std::size_t>(std::find_if(widest_.begin(), widest_.end(), good) - widest_.begin());
        add_fan(a, top.first(chosen + 1));
        add_triangle(a, top[chosen], d);
        add_fan(d, top.subspan(chosen));
    }

    /// The lowest cell of a column whose neighbour is empty: the border divides its sides, too.
    ///
    ///     c---q---b
    ///      \     |         the first ray is the end of a fan of which the rest has no layers
    ///       \    q
    ///        \   |
    ///         d--a
    void add_bottom_between_borders(const Column& column, std::span<const VertexId> top) {
        corners_.clear();
        const auto append = [&](VertexId v) {
            if (corners_.empty() || corners_.back() != v) corners_.push_back(v);
        };
        append(column.first.origin);
        std::for_each(column.up.begin(), column.up.end(), append);
        std::for_each(top.begin(), top.end(), append);
        std::for_each(column.down.begin(), column.down.end(), append);
        append(column.second.origin);
        if (corners_.back() == corners_.front()) corners_.pop_back();
        add_polygon();
    }

    /// corners_, counter-clockwise: its constrained Delaunay triangles.
    void add_polygon() {
        std::vector<Point> corners;
        std::vector<Segment> sides;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            corners.push_back(at(corners_[i]));
            sides.push_back({VertexId(i), VertexId((i + 1) % corners_.size())});
        }
        for (const Triangle& t : constrained_delaunay(corners, sides, {.keep = Keep::left_of_segments}).triangles)
            add_triangle(corners_[t.v[0].index()], corners_[t.v[1].index()], corners_[t.v[2].index()]);
    }
};

/// Parts in their order, one after the other.
template <class Item>
std::vector<Item> joined(const std::vector<LayerCells>& parts, std::vector<Item> LayerCells::*items) {
    std::vector<std::size_t> first{0};
    for (const LayerCells& part : parts) first.push_back(first.back() + (part.*items).size());
    std::vector<Item> all(first.back());
    parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            std::copy((parts[i].*items).begin(), (parts[i].*items).end(),
                      all.begin() + static_cast<std::ptrdiff_t>(first[i]));
    });
    return all;
}

}  // namespace

LayerCells connect_layer(const Layer& layer, GridCells kind) {
    std::vector<LayerCells> parts;
    for (std::size_t e = 0; e < layer.rays.size(); ++e) {
        if (layer.rays[e].empty()) continue;
        const Columns columns(layer.rays[e], layer.borders[e]);
        const auto connect = [&](std::size_t begin, std::size_t end) {
            Connector connector(layer.points, kind);
            for (std::size_t i = begin; i < end; ++i) connector.add(columns[i]);
            return connector.take();
        };
        for (LayerCells& part : parallel_blocks(columns.size(), columns_a_block, connect))
            parts.push_back(std::move(part));
    }
    return {joined(parts, &LayerCells::triangles), joined(parts, &LayerCells::quads),
            joined(parts, &LayerCells::triangle_layer), joined(parts, &LayerCells::quad_layer)};
}

}  // namespace lamina
