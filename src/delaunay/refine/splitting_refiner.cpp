// An edge of a line is split by the cavity of its division point, which reaches across it to both sides.
#include "delaunay/refine/splitting_refiner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/bounding_box.hpp"
#include "core/segments.hpp"

namespace lamina::delaunay {

namespace {

/// Edges of lines are at most this share of h, which lets triangles of the right size stand on them.
constexpr double border_share = 1;
/// Lenses have the width that this angle bound asks for, even where the bound is lower.
constexpr double min_lens_angle_deg = 20;
/// Vertices nearer to an edge than this share of its length do not say yet where to split it.
constexpr double min_distance_share = 0x1p-20;
/// Nor do vertices that stand beyond the ends of an edge by more than this share of its length.
constexpr double overhang = 0.001;
/// Counts of triangles beyond the bounds leave this to rounding.
constexpr double rounding = 1e-9;

/// Returns which edge of t runs from a to b; 3 if none does.
unsigned edge_between(const Tri& t, Index a, Index b) {
    for (unsigned e = 0; e < 3; ++e)
        if (t.v[next(e)] == a && t.v[previous(e)] == b) return e;
    return 3;
}

}  // namespace

SplittingRefiner::SplittingRefiner(SplittableDomain domain, BorderLines& lines, std::span<const RegionSizes> sizes,
                                   const ConstrainedRefineOptions& options, const RefinementWay& way)
    : Refiner(options.refine, std::move(domain.points), std::move(domain.tris)),
      lines_(lines),
      sizes_of_fields_(sizes),
      fields_(std::move(domain.fields)),
      frozen_begin_(domain.frozen_begin),
      frozen_end_(domain.frozen_end),
      may_split_(options.split_segments),
      conforming_(options.conforming) {
    if (!points_.empty()) scale_ = unit_scale(core::longer_side(core::bounding_box(points_)));
    if (scale_ != 1)
        for (Point& p : points_) p = scale_ * p;
    if (options.refine.unit_length) set_unit(scale_ * *options.refine.unit_length);
    extent_ = core::bounding_box(points_);
    const double bound = core::radians(std::max(options.refine.min_angle_deg, min_lens_angle_deg));
    const double c = core::cos_reproducible(2 * bound);
    squared_lens_ = way.diametral_circles ? 0 : c * c;
    off_centre_ *= way.off_centre_share;
    part_length_ = way.part_share * 2 * core::cos_reproducible(bound) / core::sin_reproducible(bound);
    give_sizes();
}

/// Gives each vertex the smallest of the sizes that the triangles round it demand.
void SplittingRefiner::give_sizes() {
    sizes_.assign(points_.size(), HUGE_VALF);
    for (Index t = 0; t < tris_.size(); ++t) {
        for (const Index v : tris_[t].v) {
            if (fields_.empty() && sizes_[v] < HUGE_VALF) continue;
            sizes_[v] = std::min(sizes_[v], stored(size_at(points_[v], t)));
        }
    }
}

void SplittingRefiner::refine() {
    for (Index t = 0; t < tris_.size(); ++t) queue_edges(t);
    run();
}

std::vector<Point> SplittingRefiner::vertices() const {
    std::vector<Point> vertices = points_;
    if (scale_ != 1)
        for (Point& p : vertices) p = (1 / scale_) * p;
    return vertices;
}

double SplittingRefiner::gradation() const {
    double greatest = 0;
    for (const RegionSizes& sizes : sizes_of_fields_) greatest = std::max(greatest, sizes.gradation());
    return greatest;
}

/// Returns whether a vertex encroaches upon an edge whose ends are at a and b, seen from the vertex.
bool SplittingRefiner::encroaches(Point a, Point b, double aa, double bb) const {
    const double d = dot(a, b);
    return d < 0 && d * d >= squared_lens_ * (aa * bb);
}

bool SplittingRefiner::is_blocked(const CavityEdge& a, const CavityEdge& b) const {
    // A frozen edge is blocked by its diametral circle, so that the triangles behind it stay Delaunay.
    if (is_frozen(a.a, b.a)) return a.ax * b.ax + a.ay * b.ay <= 0;
    return encroaches({a.ax, a.ay}, {b.ax, b.ay}, a.aa, b.aa);
}

/// Returns the distance from a line below which no split helps; 0 where there is no line.
double SplittingRefiner::unresolved_distance(Index line) const {
    return line == no_index ? 0 : scale_ * lines_.unresolved_distance(line);
}

/// Returns whether a vertex is so near to the edge a-b of a line that no split helps, or on a chain that nearly
/// coincides with that of the line.
bool SplittingRefiner::is_left_alone(Index a, Index b, Index p) const {
    const Index line = lines_.line_of_edge(a, b);
    return core::distance_to_segment(points_[p], points_[a], points_[b]) < unresolved_distance(line) ||
           (!conforming_ && lines_.nearly_coincide(line, p));
}

/// Returns whether a triangle is so flat beside the lines that its edges are part of, and that its vertices split, that
/// no split makes its angles larger, or lies between chains that nearly coincide.
bool SplittingRefiner::is_left_alone(const Tri& tri) const {
    if (!conforming_ && lines_.lies_between_coincident_chains(tri)) return true;
    double unresolved = 0;
    for (unsigned e = 0; e < 3; ++e) {
        unresolved = std::max(unresolved, unresolved_distance(lines_.line_of_vertex(tri.v[e])));
        if (tri.n[e].is_constrained())
            unresolved =
                std::max(unresolved, unresolved_distance(lines_.line_of_edge(tri.v[next(e)], tri.v[previous(e)])));
    }
    const TriangleShape s = shape_of(tri);
    const double longest = std::max({s.squared[0], s.squared[1], s.squared[2]});
    return s.area2 * s.area2 < unresolved * unresolved * longest;
}

bool SplittingRefiner::must_mend(Index t) const {
    const Tri& tri = tris_[t];
    if (is_left_alone(tri)) return false;
    const unsigned e = shape_of(tri).shortest();
    return !lines_.join_shells(points_, {tri.v[next(e)], tri.v[previous(e)], tri.v[e]});
}

void SplittingRefiner::vertex_inserted(Index t, std::size_t) {
    if (!fields_.empty()) fields_.resize(tris_.size(), fields_[t]);
}

/// Returns whether the edge a-b of a line is too long for the sizes on it.
bool SplittingRefiner::is_too_long(Index t, Index a, Index b) const {
    const double length = distance(points_[a], points_[b]);
    const double at_ends = std::min(size_of(a), size_of(b));
    if (length > border_share * at_ends) return true;
    // The size at the middle cannot be smaller than the growth of sizes admits.
    if (sizes_of_fields_[field_of(t)].is_uniform()) return false;
    return length > border_share * size_at(midpoint(points_[a], points_[b]), t);
}

/// Returns the point that splits the edge a-b. An edge that is too long is divided so that equal parts result.
Point SplittingRefiner::division_point(Index t, Index a, Index b) const {
    if (lines_.is_acute(a) == lines_.is_acute(b) && is_too_long(t, a, b)) {
        const Point m = midpoint(points_[a], points_[b]);
        const double h = std::min({size_of(a), size_of(b), size_at(m, t)});
        const double parts = std::ceil(distance(points_[a], points_[b]) / (border_share * h));
        if (parts < 0x1p20) return points_[a] + (std::floor(0.5 * parts) / parts) * (points_[b] - points_[a]);
    }
    const unsigned e = edge_between(tris_[t], a, b);
    const double mirrored = share_in_corner(a, b, tris_[t].v[e]);
    if (const double share = mirrored > 0 ? mirrored : share_at_split(t, e); share > 0)
        return points_[a] + share * (points_[b] - points_[a]);
    return lines_.division_point(points_, a, b);
}

/// Returns at which share to split the edge a-b of a line opposite vertex p on another line of the same sharp corner:
/// as far from the corner as p is; 0 if p is on no such line, or a part would be shorter than the distance from p.
///
///                 .--p------       Wherever vertices of one line come to stand, the same radii split the other. What
///       corner --------o----       lies between has its shortest edges across, which are left as they are, so that
///                                  vertices that the lines' outer sides ask for do not fill the corner.
///
/// The new vertex is nearest to p, and so is not the begin of ever shorter edges. Source: circles round corners: J.
/// Ruppert, J. Algorithms 18 (1995), "corner lopping"; which edges may be shorter: J. R. Shewchuk, Comput. Geom. 22
/// (2002), section 4.
double SplittingRefiner::share_in_corner(Index a, Index b, Index p) const {
    const Index line = lines_.line_of_edge(a, b), corner = lines_.facing_corner(points_, line, p);
    if (corner == no_index) return 0;
    const double to_a = distance(points_[corner], points_[a]), to_b = distance(points_[corner], points_[b]);
    const double share = (distance(points_[corner], points_[p]) - to_a) / (to_b - to_a);
    const double across = distance(points_[a] + share * (points_[b] - points_[a]), points_[p]);
    const double shorter = std::min(share, 1 - share) * std::abs(to_b - to_a);
    return shorter >= across && across >= unresolved_distance(line) ? share : 0;
}

/// Returns at which share of edge e of triangle t, which is part of a line, to split it so that its parts become no
/// shorter than the opposite vertex p demands; 0 if it is to be split in the middle, or on a circle round a corner.
///
///       ------o-------p-------o-------     Where the vertices of one line stand opposite the middles of the parts of
///            / \     / \     / \           another, parts of 2 d cot(bound) meet the bound. Here d is the distance of
///           /   \   /   \   /   \          the lines, or that of a vertex from a line.
///       ---o-------o-------o-------o--
///
/// The new vertex lies an odd number of half parts from p, as near to the middle of the edge as that admits; or, if p
/// stands opposite an end, a whole number of parts from either end. Only vertices of the input, and those on lines that
/// do not meet this one, count as p. Their distances are bounded below by those between features of the input, and both
/// sides of an edge get at least a sixth of it, so the argument that refinement ends still holds.
double SplittingRefiner::share_at_split(Index t, unsigned e) const {
    const Tri& tri = tris_[t];
    const Index a = tri.v[next(e)], b = tri.v[previous(e)], opposite = tri.v[e];
    if (lines_.is_acute(a) || lines_.is_acute(b)) return 0;
    if (const Index line = lines_.line_of_vertex(opposite); line != no_index) {
        if (lines_.meet(line, lines_.line_of_edge(a, b))) return 0;
    } else if (opposite >= frozen_begin_) {
        return 0;
    }
    const Point along = points_[b] - points_[a], to_p = points_[opposite] - points_[a];
    const double length = std::sqrt(squared_length(along));
    const double d = cross(along, to_p) / length, x = dot(along, to_p) / length;
    if (!(d > min_distance_share * length) || x < -overhang * length || x > (1 + overhang) * length) return 0;
    const double longest_part = part_length_ * d;
    const double half_parts = std::ceil(2 * length / longest_part);
    const double part = 2 * length / half_parts;
    if (half_parts > 2 && std::min(x, length - x) > 0.25 * part)
        return (x + (std::floor((0.5 * length - x) / part) + 0.5) * part) / length;
    const double parts = std::ceil(length / longest_part);
    return parts > 2 ? std::floor(0.5 * parts) / parts : 0;
}

/// Queues the edges of a triangle that its third vertex encroaches upon or that are too long.
void SplittingRefiner::queue_edges(Index t) {
    const Tri& tri = tris_[t];
    for (unsigned e = 0; e < 3; ++e) {
        if (!tri.n[e].is_constrained()) continue;
        const Index a = tri.v[next(e)], b = tri.v[previous(e)];
        if (is_frozen(a, b)) continue;
        const Point u = points_[a] - points_[tri.v[e]], v = points_[b] - points_[tri.v[e]];
        const bool is_encroached =
            encroaches(u, v, squared_length(u), squared_length(v)) && !is_left_alone(a, b, tri.v[e]);
        if (is_encroached || is_too_long(t, a, b)) long_or_encroached_.push_back({t, a, b});
    }
}

bool SplittingRefiner::split_next() {
    if (long_or_encroached_.empty()) return false;
    const QueuedEdge edge = long_or_encroached_.front();
    long_or_encroached_.pop_front();
    const unsigned e = edge_between(tris_[edge.t], edge.a, edge.b);
    if (e < 3 && tris_[edge.t].n[e].is_constrained() && !split(edge.t, e)) ++refused_;
    return true;
}

/// Returns the triangle of the cavity that has edge i of the cavity's boundary.
Index SplittingRefiner::inside_triangle(std::size_t i) const {
    const CavityEdge& a = cavity_.boundary[i];
    if (!a.outer.is_border()) return tris_[a.outer.triangle()].n[a.outer.edge()].triangle();
    const Index b = cavity_.boundary[i + 1].a;
    for (std::size_t k = 0; k < cavity_.triangles.size(); ++k)
        if (edge_between(tris_[cavity_.triangles[k]], a.a, b) < 3) return cavity_.triangles[k];
    return no_index;
}

/// Returns the first constrained edge on the straight way from the middle x of triangle t to p, with the triangle that
/// the way comes from; nothing if there is none.
///
///             w             p lies beyond edges a-w and w-b of the triangle that the way enters through a-b. It goes on
///           .' '.           on the right of w if w lies on the left of x -> p. Where rounding puts x outside t, the walk
///     x - - - - - - -> p    may choose wrong, but each edge that it crosses still separates it from p.
///       .'       '.
///      b --------- a        Source: as in walk.hpp
std::optional<SplittingRefiner::QueuedEdge> SplittingRefiner::first_on_way(Index t, Point p) const {
    const auto vertex = [&](unsigned i) { return points_[tris_[t].v[i]]; };
    const auto is_beyond = [&](unsigned e) {
        const double side = core::inline_orient2d(vertex(next(e)), vertex(previous(e)), p);
        return side < 0 || (side == 0 && tris_[t].n[e].is_constrained());
    };
    const Point x = (1.0 / 3) * (vertex(0) + vertex(1) + vertex(2));
    unsigned entry = 0;
    while (entry < 2 && is_beyond(entry)) ++entry;
    // Rounding may put a vertex that splits an edge off it, so that the walk runs in circles.
    for (std::size_t steps = 0; steps < tris_.size(); ++steps) {
        unsigned e = next(entry);
        const bool is_beyond_next = is_beyond(e), is_beyond_previous = is_beyond(previous(entry));
        if (!is_beyond_next && !is_beyond_previous) return {};
        if (!is_beyond_next || (is_beyond_previous && !(core::inline_orient2d(x, p, vertex(entry)) > 0)))
            e = previous(entry);
        const Link across = tris_[t].n[e];
        if (across.is_constrained()) return QueuedEdge{t, tris_[t].v[next(e)], tris_[t].v[previous(e)]};
        t = across.triangle();
        entry = across.edge();
    }
    return {};
}

/// Returns whether no constrained edge is known to lie between triangle t and p, which would block p. In a thin strip
/// between two lines, this looks at few triangles where the cavity of p has them all.
bool SplittingRefiner::is_in_sight(Index t, Point p) const {
    return !(squared_length(p) < HUGE_VAL) || !first_on_way(t, p);
}

/// Returns the edges of lines that keep p from mending triangle t: the first one on the straight way from t to p or, if
/// there is none, those that p encroaches upon, the longest first. `frozen` becomes true where one of them is frozen.
std::vector<SplittingRefiner::QueuedEdge> SplittingRefiner::find_blocking(Index t, Point p, bool& frozen) {
    std::vector<QueuedEdge> blocking;
    if (const auto first = first_on_way(t, p)) {
        blocking.push_back(*first);
    } else {
        find_cavity<false>(points_.data(), tris_.data(), t, relative_to(points_.data(), tris_[t], p), p, cavity_);
        for (std::size_t i = 0; i < cavity_.boundary.size(); ++i) {
            const CavityEdge& a = cavity_.boundary[i];
            const CavityEdge& b = cavity_.boundary[i + 1];
            if (a.outer.is_constrained() && is_inside(a, b, p) && is_blocked(a, b))
                blocking.push_back({inside_triangle(i), a.a, b.a});
        }
    }
    const std::size_t all = blocking.size();
    std::erase_if(blocking, [&](const QueuedEdge& edge) { return is_frozen(edge.a, edge.b); });
    frozen = blocking.size() < all;
    std::stable_sort(blocking.begin(), blocking.end(), [&](const QueuedEdge& l, const QueuedEdge& r) {
        return distance(points_[l.a], points_[l.b]) > distance(points_[r.a], points_[r.b]);
    });
    return blocking;
}

/// Returns the last point on the way from a point of the extent to p that is not far outside the extent.
Point SplittingRefiner::clip(Point inside, Point p) const {
    const double reach = 2 * core::longer_side(extent_), length = distance(inside, p);
    return length > reach ? inside + (reach / length) * (p - inside) : p;
}

/// Splits the edges that keep the circumcentre p from mending triangle t, and queues t again if it is still there.
void SplittingRefiner::give_up(Index t, Point p) {
    if (is_left_alone(tris_[t])) return;
    const QueuedTriangle entry{t, tris_[t].v[0]};
    p = clip(points_[tris_[t].v[0]], p);
    if (!(squared_length(p) < HUGE_VAL)) {
        ++refused_;
        return;
    }
    bool frozen = false, any = false;
    for (const QueuedEdge& edge : find_blocking(t, p, frozen)) {
        if (edge.t == no_index) continue;
        const unsigned e = edge_between(tris_[edge.t], edge.a, edge.b);
        if (e < 3) any = split(edge.t, e) || any;
        if (any) break;
    }
    if (!any) {
        ++refused_;
        if (frozen) kept_out_.push_back((1 / scale_) * p);
    } else if (is_current(entry)) {
        classify(t);
        queue_front(t);
    }
}

/// Returns whether an edge is too short to be split.
bool SplittingRefiner::is_too_short(Point a, Point b) const {
    return distance(a, b) < 2 * shortest_edge(std::max(magnitude(a), magnitude(b)), core::longer_side(extent_));
}

/// Returns whether two vertices are so near to each other that rounding decides on the angles between them and a third
/// one at that distance. The user's own vertices may be: (2, 0) and (2, 1e-39).
bool SplittingRefiner::is_unresolved(Point a, Point b) const {
    constexpr double share_of_magnitude = 0x1p-50;
    return distance(a, b) < share_of_magnitude * std::max(magnitude(a), magnitude(b));
}

/// Splits edge e of triangle t, which is an edge of a line. Returns false, and changes nothing, if the edge is too
/// short or rounding leaves no room for the point.
bool SplittingRefiner::split(Index t, unsigned e) {
    assert(e < 3 && tris_[t].n[e].is_constrained() && is_linked(tris_, t, e));
    const Index a = tris_[t].v[next(e)], b = tris_[t].v[previous(e)];
    assert(!is_frozen(a, b) && lines_.line_of_edge(a, b) != no_index);
    if (is_too_short(points_[a], points_[b])) return false;
    const Point p = division_point(t, a, b);
    if (p == points_[a] || p == points_[b]) return false;
    // Rounding may put p so far behind a border that the circle of a thin triangle before it does not hold p.
    const RelativeTriangle relative = relative_to(points_.data(), tris_[t], p);
    if (!in_circle(tris_[t], relative, p)) return false;
    const Link across = tris_[t].n[e];
    if (!across.is_border()) release_edge(tris_, t, e);
    find_cavity<false>(points_.data(), tris_.data(), t, relative, p, cavity_);
    if (!cavity_admits_split(p, a, b, across.is_border())) {
        if (!across.is_border()) constrain_edge(tris_, t, e);
        return false;
    }
    double size = size_at(p, t);
    std::uint32_t right = field_of(t);
    if (!across.is_border()) {
        right = field_of(across.triangle());
        size = std::min(size, size_at(p, across.triangle()));
    }
    const Index line = lines_.line_of_edge(a, b);
    const std::uint32_t left = field_of(t);
    const Index vertex = add_vertex(p, stored(size));
    lines_.add_vertex(vertex, line);
    fill_and_queue(vertex, a, b, left, right);
    return true;
}

/// Returns whether the cavity was found, and the point p that splits the edge a-b lies strictly on the inner side of
/// all other edges of the cavity's boundary, and outside the diametral circles of those that are frozen. The cavity
/// must reach across an edge that is no border; it does not where rounding puts p farther off the edge than the circle
/// across it reaches.
bool SplittingRefiner::cavity_admits_split(Point p, Index a, Index b, bool is_border) const {
    const std::size_t k = cavity_.boundary.size();
    if (k == 0) return false;
    for (std::size_t i = 0; i < k; ++i) {
        const CavityEdge& from = cavity_.boundary[i];
        const CavityEdge& to = cavity_.boundary[i + 1];
        if (from.a == a && to.a == b) {
            if (!is_border) return false;
            continue;
        }
        if (!is_inside(from, to, p)) return false;
        if (from.outer.is_constrained() && is_frozen(from.a, to.a) && from.ax * to.ax + from.ay * to.ay <= 0)
            return false;
    }
    return true;
}

/// Fills the cavity round a vertex that splits the edge a-b, and queues what is wrong with the new triangles. `left`
/// and `right` are the size fields on the sides of a -> b.
///
///            o                 The triangle on the border a -> b itself,     a ------p------ b
///          / : \               if the line is one, is left out: the fan       \     / \     /
///        a --p-- b             is open there.                                  \   /   \   /
///          \ : /                                                                '-o-----o-'
///            o
void SplittingRefiner::fill_and_queue(Index vertex, Index a, Index b, std::uint32_t left, std::uint32_t right) {
    const std::size_t old_count = tris_.size(), k = cavity_.boundary.size();
    std::size_t on_border = k;  // the place of a -> b in the boundary
    for (std::size_t i = 0; i < k; ++i)
        if (cavity_.boundary[i].a == a && cavity_.boundary[i + 1].a == b) on_border = i;
    std::vector<Index> created;
    if (on_border < k) {
        created = fill_open_cavity(tris_, cavity_, vertex, on_border);
    } else {
        fill_cavity(tris_, cavity_, vertex);
        for (std::size_t i = 0; i < k; ++i) {
            const Index t = created.emplace_back(cavity_.created(i, old_count));
            if (tris_[t].v[1] == a || tris_[t].v[1] == b) constrain_edge(tris_, t, 2);
        }
    }
    if (!fields_.empty()) {
        fields_.resize(tris_.size());
        // The triangles from b counter-clockwise to a lie on the left of a -> b.
        const auto first = static_cast<std::size_t>(
            std::find_if(created.begin(), created.end(), [&](Index t) { return tris_[t].v[1] == b; }) -
            created.begin());
        bool is_left = true;
        for (std::size_t i = 0; i < created.size(); ++i) {
            const Index t = created[(first + i) % created.size()];
            if (tris_[t].v[1] == a) is_left = false;
            fields_[t] = is_left ? left : right;
        }
    }
    assert(fields_.empty() || fields_.size() == tris_.size());
    front_.resize(tris_.size());
    for (const Index t : created) {
        // Both parts of a-b are constrained, or borders, as a-b was.
        assert(is_linked(tris_, t) && is_counter_clockwise(points_, tris_[t]));
        assert(tris_[t].v[1] != a || tris_[t].n[2].is_constrained());
        assert(tris_[t].v[2] != b || tris_[t].n[1].is_constrained());
        classify(t);
    }
    for (const Index t : created) {
        queue_front(t);
        queue_edges(t);
    }
}

RefineStats SplittingRefiner::count_leftovers(double min_angle_deg) const {
    const double sine = core::sin_reproducible(core::radians(min_angle_deg));
    RefineStats stats;
    for (const Tri& tri : tris_) {
        const TriangleShape s = shape_of(tri);
        const unsigned e = s.shortest();
        const bool left_alone = is_left_alone(tri);
        stats.oversized += !left_alone && is_oversized(tri, s);
        const double shortest = s.squared[e] * (1 + rounding);
        if (!is_angle_below(sine * sine, s.squared[0], s.squared[1], s.squared[2], shortest, s.area2)) continue;
        ++stats.below_bound;
        const Point middle = (1.0 / 3) * (points_[tri.v[0]] + points_[tri.v[1]] + points_[tri.v[2]]);
        const Index v = tri.v[next(e)], w = tri.v[previous(e)];
        stats.exempt +=
            left_alone || is_unresolved(points_[v], points_[w]) || lines_.join_sharp_lines(points_, {v, w, tri.v[e]}) ||
            std::any_of(tri.v, tri.v + 3, [&](Index u) { return lines_.in_sharp_corner(points_, u, middle); });
    }
    count_refused(stats);
    stats.stopped = stopped();
    return stats;
}

}  // namespace lamina::delaunay
