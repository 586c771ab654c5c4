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
#include <cmath>
#include <span>
#include <utility>

#include <lamina/delaunay.hpp>

#include "core/parallel.hpp"
#include "core/predicates.hpp"

namespace lamina::layers {
namespace {

/// Cosines closer than this count as equal: coordinates of cells as thin as 1e-9 of their place are no surer than that.
constexpr double cosine_rounding = 1e-6;
constexpr std::size_t columns_a_block = 512;

VertexId on_ray(const Ray& ray, std::uint32_t n) { return n == 0 ? ray.origin : VertexId(ray.first_point + n - 1); }
VertexId tip(const Ray& ray) { return on_ray(ray, ray.layers); }

/// Cosine of the largest angle; -2, below all cosines, unless counter-clockwise (exact).
double widest_cosine(Point a, Point b, Point c) {
    if (!(core::inline_orient2d(a, b, c) > 0)) return -2;
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double l = length(ab), m = length(bc), n = length(ca);
    return std::max(-1.0, -std::max({dot(ab, bc) / (l * m), dot(bc, ca) / (m * n), dot(ca, ab) / (n * l)}));
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
    Connector(const Layer& layer, GridCells kind) : layer_(layer), kind_(kind) {}

    void add(const Column& column) {
        const Ray &first = column.first, &second = column.second;
        const Point from = at(first.origin), to = at(second.origin);
        first_leads_ =
            from == to ? lexicographically_less(first.direction, second.direction) : lexicographically_less(from, to);
        const std::uint32_t common = std::min(first.layers, second.layers);
        const std::uint32_t highest = std::max(first.layers, second.layers);
        if (common == 0 && from == to) return;  // the border runs along the ray

        const bool divided_sides = column.up.size() > 2 || column.down.size() > 2;
        for (number_ = 1; number_ <= highest; ++number_) {
            const VertexId inner[] = {on_ray(first, number_), on_ray(second, number_)};
            const std::span<const VertexId> top = number_ < highest ? std::span<const VertexId>(inner) : column.top;
            const VertexId a = on_ray(first, number_ - 1), d = on_ray(second, number_ - 1);
            const VertexId lower[] = {a, d};
            if (number_ == 1 && divided_sides) {
                add_bottom_between_borders(column, top);
            } else if (number_ == common && highest > common && column.top.size() > 2) {
                number_ = highest;
                add_divided_step(column, common);
            } else if (number_ > common) {
                add_strip(std::span(lower).subspan(first.layers > common ? 0 : 1, 1), top);
            } else if (a == d) {
                add_strip(std::span(lower).first(1), top);
            } else if (kind_ == GridCells::whole && top.size() == 2 && is_convex(a, top[0], top[1], d)) {
                cells_.quads.push_back({{a, top[0], top[1], d}});
                cells_.quad_layer.push_back(static_cast<std::uint16_t>(number_));
            } else {
                add_strip(lower, top);
            }
        }
    }

    LayerCells take() { return std::move(cells_); }

private:
    /// A strip is cut from its first side to its last by triangles, each on an edge of the top or of the lower chain.
    struct Cuts {
        double along = -2, across = -2;  ///< cosines of the triangles on the next edge of the top, of the lower chain
        double least = -2;               ///< the best that the smallest cosine of all triangles up to here can be
        double rest = HUGE_VAL;          ///< least sum over all triangles from here
    };

    const Layer& layer_;
    GridCells kind_;
    LayerCells cells_;
    std::uint32_t number_ = 0;       ///< layer of the cell at hand
    bool first_leads_ = false;       ///< which of its lower corners comes first where cuts are equal
    std::vector<Cuts> cuts_;         ///< scratch
    std::vector<VertexId> corners_;  ///< scratch: of a polygon

    Point at(VertexId v) const { return layer_.points[v.index()]; }

    bool is_convex(VertexId a, VertexId b, VertexId c, VertexId d) const {
        using core::inline_orient2d;
        return inline_orient2d(at(a), at(b), at(c)) > 0 && inline_orient2d(at(b), at(c), at(d)) > 0 &&
               inline_orient2d(at(c), at(d), at(a)) > 0 && inline_orient2d(at(d), at(a), at(b)) > 0;
    }

    /// On the layer above its lowest corner; but all corners may be at the top's height where that is divided.
    void add_triangle(VertexId a, VertexId b, VertexId c) {
        const auto layer_of = [&](VertexId v) { return std::uint32_t{layer_.layer_of_point[v.index()]}; };
        const std::uint32_t number = std::min({number_, layer_of(a) + 1, layer_of(b) + 1, layer_of(c) + 1});
        cells_.triangles.push_back({{a, b, c}});
        cells_.triangle_layer.push_back(static_cast<std::uint16_t>(number));
    }

    /// What a triangle of this cosine adds to the sum that cuts are compared by: 1 for a right angle, always finite.
    static double burden(double cosine) { return 1 / (1 + cosine + cosine_rounding); }

    /// The lower chain goes from the first side to the last, like the top: a fan where it is one corner, the choice of
    /// a diagonal or of two fans where there are two. The best cut has the smallest largest angle, and then the least
    /// sum.
    ///
    ///     c----q3----q2----q1----b
    ///     |   /    .' \    `.    |       lower chain a, d: triangles on b-q1 and q1-q2 from a, then on a-d, then from
    ///     d |  /  .'     \     `.  | | / .'        \      `.| d----------------------a
    void add_strip(std::span<const VertexId> lower, std::span<const VertexId> top) {
        const std::size_t rows = lower.size(), columns = top.size();
        const auto cut = [&](std::size_t i, std::size_t j) -> Cuts& { return cuts_[i * columns + j]; };
        cuts_.assign(rows * columns, {});
        cut(0, 0).least = 1;
        for (std::size_t i = 0; i < rows; ++i) {
            for (std::size_t j = 0; j < columns; ++j) {
                Cuts& here = cut(i, j);
                if (j + 1 < columns) {
                    here.along = widest_cosine(at(lower[i]), at(top[j]), at(top[j + 1]));
                    cut(i, j + 1).least = std::max(cut(i, j + 1).least, std::min(here.least, here.along));
                }
                if (i + 1 < rows) {
                    here.across = widest_cosine(at(lower[i]), at(top[j]), at(lower[i + 1]));
                    cut(i + 1, j).least = std::max(cut(i + 1, j).least, std::min(here.least, here.across));
                }
            }
        }
        const double best = cut(rows - 1, columns - 1).least, least = best - cosine_rounding;
        if (best < -1) {  // coordinates are too coarse for any
            corners_.assign(top.begin(), top.end());
            corners_.insert(corners_.end(), lower.rbegin(), lower.rend());
            add_polygon();
            return;
        }
        const auto sum_along = [&](std::size_t i, std::size_t j) {
            return j + 1 < columns && cut(i, j).along >= least ? burden(cut(i, j).along) + cut(i, j + 1).rest
                                                               : HUGE_VAL;
        };
        const auto sum_across = [&](std::size_t i, std::size_t j) {
            return i + 1 < rows && cut(i, j).across >= least ? burden(cut(i, j).across) + cut(i + 1, j).rest : HUGE_VAL;
        };
        cut(rows - 1, columns - 1).rest = 0;
        for (std::size_t k = rows * columns - 1; k-- > 0;)
            cuts_[k].rest = std::min(sum_along(k / columns, k % columns), sum_across(k / columns, k % columns));
        for (std::size_t i = 0, j = 0; i + 1 < rows || j + 1 < columns;) {
            const double along = sum_along(i, j), across = sum_across(i, j);
            const double slack = cosine_rounding * std::min(along, across);
            if (first_leads_ ? along <= across + slack : along + slack < across) {
                add_triangle(lower[i], top[j], top[j + 1]);
                ++j;
            } else {
                add_triangle(lower[i], top[j], lower[i + 1]);
                ++i;
            }
        }
    }

    /// A step's triangle alone could only be fanned from one corner, with ever flatter triangles: it is cut together
    /// with the cell below. On its higher ray the lower chain has one corner more.
    ///
    ///              .-b = q0      lower chain a' a d; with the higher ray on the other side, a d d'
    ///          q1-'   |
    ///      q2-'       |
    ///    c-'----------a'
    ///    |            |
    ///    d------------a
    void add_divided_step(const Column& column, std::uint32_t common) {
        const Ray &first = column.first, &second = column.second;
        corners_.clear();
        if (first.layers > common) corners_.push_back(on_ray(first, common));
        corners_.push_back(on_ray(first, common - 1));
        if (on_ray(second, common - 1) != corners_.back()) corners_.push_back(on_ray(second, common - 1));
        if (second.layers > common) corners_.push_back(on_ray(second, common));
        const std::vector<VertexId> lower = corners_;
        add_strip(lower, column.top);
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

    /// corners_, counter-clockwise, some perhaps twice in a row: its constrained Delaunay triangles.
    void add_polygon() {
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
        std::vector<Point> corners;
        std::vector<Segment> sides;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            corners.push_back(at(corners_[i]));
            sides.push_back({VertexId(i), VertexId((i + 1) % corners_.size())});
        }
        for (const Triangle& t : triangulate(corners, sides, {.keep = Keep::left_of_segments}).triangles)
            add_triangle(corners_[t.v[0].index()], corners_[t.v[1].index()], corners_[t.v[2].index()]);
    }
};

/// Parts in their order, one after the other.
template <class Item>
std::vector<Item> joined(const std::vector<LayerCells>& parts, std::vector<Item> LayerCells::*items) {
    std::vector<std::size_t> first{0};
    for (const LayerCells& part : parts) first.push_back(first.back() + (part.*items).size());
    std::vector<Item> all(first.back());
    core::parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
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
            Connector connector(layer, kind);
            for (std::size_t i = begin; i < end; ++i) connector.add(columns[i]);
            return connector.take();
        };
        for (LayerCells& part : core::parallel_blocks(columns.size(), columns_a_block, connect))
            parts.push_back(std::move(part));
    }
    LayerCells cells;
    cells.triangles = joined(parts, &LayerCells::triangles);
    cells.quads = joined(parts, &LayerCells::quads);
    cells.triangle_layer = joined(parts, &LayerCells::triangle_layer);
    cells.quad_layer = joined(parts, &LayerCells::quad_layer);
    return cells;
}

}  // namespace lamina::layers
