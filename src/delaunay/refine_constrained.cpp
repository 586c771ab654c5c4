// Refinement of a constrained triangulation: its segments cut it into parts, each is refined against frozen borders,
// and the borders are split beforehand, or once more where a part shows that they are too coarse.
//
//   parts (floods between segments) -> split by size -> split where encroached -> refine parts -> split what keeps a
//                                                              ^                                   bad triangle bad
//                                                              '-------------------------------------------'
// Sources: J. Ruppert, J. Algorithms 18 (1995); G. Miller, S. Pav, N. Walkington, Int. J. Comput. Geom. Appl. 15
// (2005).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include <lamina/delaunay.hpp>
#include <lamina/predicates.hpp>

#include "core/box_tree.hpp"
#include "core/equilateral.hpp"
#include "core/parallel.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

namespace {

/// Border edges of at most this share of h gave no encroachment in any trial (docs/decisions/0002).
constexpr double border_share = 0.9;
/// No edge is split below this share of the extent.
constexpr double smallest_share = 0x1p-40;
constexpr int most_rounds = 60;

/// A segment of the triangulation, or an edge of its rim that is none, with the vertices that split it.
struct Border {
    std::vector<Index> chain;
};

/// A border with the part on its left when walked forward, or else backward.
struct Side {
    Index border;
    bool forward;
};

struct Part {
    std::vector<Side> sides;
    std::vector<Index> vertices;  ///< of the triangulation
    const SizeField* size = nullptr;
    std::uint32_t region = ConstrainedRefinement::no_region;

    std::vector<Index> local;  ///< vertices and those that split its borders, ascending: local -> global
    Refinement refinement;     ///< in local numbers
    bool stale = true;         ///< borders were split since the refinement was made
};

/// Borders u-v and u-w, the region between them counter-clockwise from v to w.
struct Corner {
    Index u, v, w;
    friend auto operator<=>(const Corner&, const Corner&) = default;
};

/// Subsegment `place` of a border.
struct Subsegment {
    Index border;
    std::size_t place;
    friend auto operator<=>(const Subsegment&, const Subsegment&) = default;
};

class ConstrainedRefiner {
public:
    ConstrainedRefiner(std::span<const Point> points, const ConstrainedTriangulation& t, const SizeField& size,
                       const ConstrainedRefineOptions& options)
        : options_(options), input_count_(points.size()), points_(points.begin(), points.end()) {
        points_.insert(points_.end(), t.steiner_points.begin(), t.steiner_points.end());
        triangulated_count_ = points_.size();
        Box extent;
        for (Point p : points_) extent.include(p);
        shortest_ = smallest_share * std::max(extent.width(), extent.height());
        link(t);
        make_parts(t);
        find_corners(t);
        assign_sizes(t, size);
    }

    void run() {
        if (options_.split_segments) split_by_size();
        for (int round = 0; round < most_rounds; ++round) {
            if (options_.split_segments)
                while (split_encroached()) {
                }
            refine_parts();
            if (!options_.split_segments || !split_blocking()) return;
        }
        refine_parts();
    }

    ConstrainedRefinement result(const ConstrainedTriangulation& t);

private:
    Point point(Index v) const { return points_[v]; }

    // --- The triangulation as parts and borders

    /// Neighbours across the edges of t: triangle * 3 + edge, no_index on the rim.
    void link(const ConstrainedTriangulation& t) {
        struct Directed {
            std::uint64_t key;
            Index place;
        };
        std::vector<Directed> edges;
        for (Index i = 0; i < t.triangles.size(); ++i)
            for (unsigned e = 0; e < 3; ++e)
                edges.push_back({key(t.triangles[i].v[next(e)].value, t.triangles[i].v[previous(e)].value), 3 * i + e});
        std::sort(edges.begin(), edges.end(), [](const Directed& l, const Directed& r) { return l.key < r.key; });
        across_.assign(edges.size(), no_index);
        for (const Directed& d : edges) {
            const std::uint64_t opposite = d.key << 32 | d.key >> 32;
            const auto at = std::lower_bound(edges.begin(), edges.end(), opposite,
                                             [](const Directed& l, std::uint64_t k) { return l.key < k; });
            if (at != edges.end() && at->key == opposite) across_[d.place] = at->place;
        }
    }

    static std::uint64_t key(Index a, Index b) { return std::uint64_t{a} << 32 | b; }
    static std::uint64_t undirected_key(Index a, Index b) { return key(std::min(a, b), std::max(a, b)); }

    void make_parts(const ConstrainedTriangulation& t) {
        struct Keyed {
            std::uint64_t key;
            Index border;
        };
        std::vector<Keyed> segments;
        for (const Segment& s : t.segments) {
            segments.push_back({undirected_key(s.a.value, s.b.value), static_cast<Index>(borders_.size())});
            borders_.push_back({{s.a.value, s.b.value}});
        }
        std::sort(segments.begin(), segments.end(), [](const Keyed& l, const Keyed& r) { return l.key < r.key; });

        border_at_.assign(across_.size(), no_index);
        for (Index place = 0; place < across_.size(); ++place) {
            const auto [a, b] = ends(t, place);
            const auto at = std::lower_bound(segments.begin(), segments.end(), undirected_key(a, b),
                                             [](const Keyed& l, std::uint64_t k) { return l.key < k; });
            if (at != segments.end() && at->key == undirected_key(a, b)) {
                border_at_[place] = at->border;
            } else if (across_[place] == no_index) {
                border_at_[place] = static_cast<Index>(borders_.size());
                borders_.push_back({{a, b}});
            }
        }

        part_of_.assign(t.triangles.size(), no_index);
        std::vector<Index> front;
        for (Index first = 0; first < t.triangles.size(); ++first) {
            if (part_of_[first] != no_index) continue;
            const auto number = static_cast<Index>(parts_.size());
            Part& part = parts_.emplace_back();
            part_of_[first] = number;
            front.push_back(first);
            while (!front.empty()) {
                const Index i = front.back();
                front.pop_back();
                for (unsigned e = 0; e < 3; ++e) {
                    const Index place = 3 * i + e;
                    part.vertices.push_back(t.triangles[i].v[e].value);
                    if (const Index border = border_at_[place]; border != no_index) {
                        part.sides.push_back({border, borders_[border].chain.front() == ends(t, place).first});
                    } else if (const Index other = across_[place] / 3; part_of_[other] == no_index) {
                        part_of_[other] = number;
                        front.push_back(other);
                    }
                }
            }
            std::sort(part.vertices.begin(), part.vertices.end());
            part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()), part.vertices.end());
        }
        parts_of_border_.resize(borders_.size());
        for (Index p = 0; p < parts_.size(); ++p)
            for (const Side& side : parts_[p].sides) parts_of_border_[side.border].push_back(p);
        border_of_vertex_.assign(points_.size(), no_index);
    }

    static std::pair<Index, Index> ends(const ConstrainedTriangulation& t, Index place) {
        const Triangle& triangle = t.triangles[place / 3];
        return {triangle.v[next(place % 3)].value, triangle.v[previous(place % 3)].value};
    }

    /// Pairs of borders that meet at a vertex u, with an angle of the region below 90 or 60 degrees between them: from
    /// each border u -> v round u, counter-clockwise through triangles, to the next border.
    void find_corners(const ConstrainedTriangulation& t) {
        acute_.assign(points_.size(), 0);
        for (Index start = 0; start < across_.size(); ++start) {
            if (border_at_[start] == no_index) continue;
            const auto [u, v] = ends(t, start);
            // In triangle (apex, u, v) the edge from the apex to u is the one opposite v.
            Index place = start;
            Index leaving = 3 * (place / 3) + previous(place % 3);
            while (border_at_[leaving] == no_index) {
                place = across_[leaving];  // u -> apex of the next triangle
                leaving = 3 * (place / 3) + previous(place % 3);
            }
            const Index w = ends(t, leaving).first;
            const Point a = point(v) - point(u), b = point(w) - point(u);
            if (!(orient2d(point(u), point(v), point(w)) > 0 && dot(a, b) > 0)) continue;
            acute_[u] = 1;
            if (!core::encloses_sharp_angle(a, b)) continue;
            sharp_corners_.push_back({u, v, w});
            sharp_pairs_.push_back(undirected_key(border_at_[start], border_at_[leaving]));
        }
        std::sort(sharp_pairs_.begin(), sharp_pairs_.end());
        std::sort(sharp_corners_.begin(), sharp_corners_.end());
    }

    /// Does p lie in a sharp corner at vertex u?
    bool in_sharp_corner(Index u, Point p) const {
        auto c = std::lower_bound(sharp_corners_.begin(), sharp_corners_.end(), Corner{u, 0, 0});
        for (; c != sharp_corners_.end() && c->u == u; ++c)
            if (orient2d(point(u), point(c->v), p) >= 0 && orient2d(point(u), p, point(c->w)) >= 0) return true;
        return false;
    }

    void assign_sizes(const ConstrainedTriangulation& t, const SizeField& size) {
        for (Part& part : parts_) part.size = &size;
        for (std::size_t r = options_.regions.size(); r-- > 0;) {
            const Point seed = options_.regions[r].seed;
            for (Index i = 0; i < t.triangles.size(); ++i) {
                const VertexId* v = t.triangles[i].v;
                const Point a = points_[v[0].index()], b = points_[v[1].index()], c = points_[v[2].index()];
                if (orient2d(a, b, seed) < 0 || orient2d(b, c, seed) < 0 || orient2d(c, a, seed) < 0) continue;
                parts_[part_of_[i]].size = &options_.regions[r].size;
                parts_[part_of_[i]].region = static_cast<std::uint32_t>(r);
                break;
            }
        }
    }

    // --- Splitting borders

    double size_at(Index border, Point p) const {
        double h = HUGE_VAL;
        for (Index part : parts_of_border_[border]) h = std::min(h, (*parts_[part].size)(p));
        return h;
    }

    /// Where a-b is divided: in the middle; on a circle of a power of two round an acute corner at one end, which
    /// leaves each side at least a third.
    Point division(Index a, Index b) const {
        const bool from_a = acute_at(a), from_b = acute_at(b);
        if (from_a == from_b) return midpoint(point(a), point(b));
        const Point corner = point(from_a ? a : b), far = point(from_a ? b : a);
        const double l = distance(corner, far);
        int exponent = 0;
        std::frexp(l * (2.0 / 3.0), &exponent);
        return corner + (std::ldexp(0.5, exponent) / l) * (far - corner);
    }
    bool acute_at(Index v) const { return v < acute_.size() && acute_[v]; }

    /// False where the subsegment is too short to be divided.
    bool split(const Subsegment& s) {
        Border& border = borders_[s.border];
        const Index a = border.chain[s.place], b = border.chain[s.place + 1];
        if (distance(point(a), point(b)) < 2 * shortest_) return false;
        const Point p = division(a, b);
        if (p == point(a) || p == point(b)) return false;
        border.chain.insert(border.chain.begin() + static_cast<std::ptrdiff_t>(s.place) + 1,
                            static_cast<Index>(points_.size()));
        points_.push_back(p);
        border_of_vertex_.push_back(s.border);
        for (Index part : parts_of_border_[s.border]) parts_[part].stale = true;
        return true;
    }

    /// Splits each once, from the back of each border, so that places stay what they were.
    bool split_all(std::vector<Subsegment> found) {
        std::sort(found.begin(), found.end(), [](const Subsegment& l, const Subsegment& r) {
            return l.border != r.border ? l.border < r.border : l.place > r.place;
        });
        found.erase(std::unique(found.begin(), found.end()), found.end());
        bool any = false;
        for (const Subsegment& s : found) any = split(s) || any;
        return any;
    }

    void split_by_size() {
        for (Index i = 0; i < borders_.size(); ++i) {
            for (std::size_t place = 0; place + 1 < borders_[i].chain.size();) {
                const Point a = point(borders_[i].chain[place]), b = point(borders_[i].chain[place + 1]);
                const double h = std::min({size_at(i, a), size_at(i, midpoint(a, b)), size_at(i, b)});
                if (!(distance(a, b) > border_share * h && split({i, place}))) ++place;
            }
        }
    }

    /// One round: subsegments that a vertex of an adjacent triangle encroaches upon. If any visible vertex lies in a
    /// diametral circle, such a one does.
    bool split_encroached() {
        std::vector<std::vector<Subsegment>> found(parts_.size());
        core::parallel_for(parts_.size(), 1, [&](std::size_t begin, std::size_t) {
            if (parts_[begin].stale) found[begin] = encroached(parts_[begin]);
        });
        std::vector<Subsegment> all;
        for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
        return split_all(std::move(all));
    }

    /// The part's points and segments in local numbers; the subsegment of each segment.
    struct Local {
        std::vector<Point> points;
        std::vector<Segment> segments;
        std::vector<Subsegment> subsegments;
    };

    Local localize(Part& part) const {
        part.local = part.vertices;
        for (const Side& side : part.sides) {
            const auto& chain = borders_[side.border].chain;
            part.local.insert(part.local.end(), chain.begin() + 1, chain.end() - 1);
        }
        std::sort(part.local.begin(), part.local.end());
        part.local.erase(std::unique(part.local.begin(), part.local.end()), part.local.end());
        const auto local = [&](Index v) {
            return VertexId(static_cast<std::size_t>(std::lower_bound(part.local.begin(), part.local.end(), v) -
                                                     part.local.begin()));
        };
        Local result;
        for (Index v : part.local) result.points.push_back(point(v));
        for (const Side& side : part.sides) {
            const auto& chain = borders_[side.border].chain;
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                const VertexId a = local(chain[i]), b = local(chain[i + 1]);
                result.segments.push_back(side.forward ? Segment{a, b} : Segment{b, a});
                result.subsegments.push_back({side.border, i});
            }
        }
        return result;
    }

    std::vector<Subsegment> encroached(Part& part) const {
        const Local local = localize(part);
        std::vector<std::pair<Segment, std::size_t>> by_ends;
        for (std::size_t i = 0; i < local.segments.size(); ++i) by_ends.push_back({local.segments[i], i});
        std::sort(by_ends.begin(), by_ends.end());
        std::vector<Subsegment> found;
        const auto t = triangulate(local.points, local.segments, {.keep = Keep::left_of_segments});
        for (const Triangle& triangle : t.triangles) {
            for (unsigned e = 0; e < 3; ++e) {
                const VertexId a = triangle.v[next(e)], b = triangle.v[previous(e)];
                const Point p = local.points[triangle.v[e].index()];
                if (dot(local.points[a.index()] - p, local.points[b.index()] - p) >= 0) continue;
                const auto at =
                    std::lower_bound(by_ends.begin(), by_ends.end(), std::pair{Segment{a, b}, std::size_t{0}});
                if (at != by_ends.end() && at->first == Segment{a, b}) found.push_back(local.subsegments[at->second]);
            }
        }
        return found;
    }

    // --- Refinement

    void refine_parts() {
        core::parallel_for(parts_.size(), 1, [&](std::size_t begin, std::size_t) {
            Part& part = parts_[begin];
            if (!part.stale) return;
            const Local local = localize(part);
            part.refinement = lamina::refine(local.points, local.segments, *part.size, options_.refine);
            part.stale = false;
        });
    }

    /// A triangle of a part's refinement with what the bounds say about it.
    struct Judged {
        Point corners[3];
        Index on[3];  ///< border that the vertex splits, no_index for others
        double area2;
        bool narrow, exempt, oversized;
    };

    Judged judge(const Part& part, const Triangle& triangle) const {
        Judged j{};
        double h = 0;
        for (unsigned i = 0; i < 3; ++i) {
            const std::size_t v = triangle.v[i].index();
            const bool added = v >= part.local.size();
            j.corners[i] = added ? part.refinement.steiner_points[v - part.local.size()] : point(part.local[v]);
            j.on[i] = added ? no_index : border_of_vertex_[part.local[v]];
            h += (*part.size)(j.corners[i]) / 3;
        }
        double squared[3];
        for (unsigned e = 0; e < 3; ++e) squared[e] = squared_length(j.corners[previous(e)] - j.corners[next(e)]);
        const auto shortest = static_cast<unsigned>(std::min_element(squared, squared + 3) - squared);
        j.area2 = cross(j.corners[1] - j.corners[0], j.corners[2] - j.corners[0]);
        const double sine = core::sin_reproducible(core::radians(options_.refine.min_angle_deg));
        // The bounds, less rounding: see refine().
        j.narrow =
            j.area2 * j.area2 * squared[shortest] * (1 + 1e-9) < sine * sine * (squared[0] * squared[1] * squared[2]);
        j.oversized = j.area2 > 2 * core::equilateral_area * h * h * (1 + 1e-9);
        const Index a = j.on[next(shortest)], b = j.on[previous(shortest)];
        const Point middle = (1.0 / 3) * (j.corners[0] + j.corners[1] + j.corners[2]);
        const bool at_sharp =
            j.narrow && std::any_of(triangle.v, triangle.v + 3, [&](VertexId v) {
                return v.index() < part.local.size() && in_sharp_corner(part.local[v.index()], middle);
            });
        j.exempt = at_sharp ||
                   (j.narrow && (a != no_index && b != no_index && a != b &&
                                 std::binary_search(sharp_pairs_.begin(), sharp_pairs_.end(), undirected_key(a, b))));
        return j;
    }

    /// Splits what stands between bad triangles and the points that would mend them.
    bool split_blocking() {
        std::vector<std::vector<Subsegment>> found(parts_.size());
        core::parallel_for(parts_.size(), 1,
                           [&](std::size_t begin, std::size_t) { found[begin] = blocking(parts_[begin]); });
        std::vector<Subsegment> all;
        for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
        return split_all(std::move(all));
    }

    std::vector<Subsegment> blocking(const Part& part) const {
        std::vector<Judged> bad;
        for (const Triangle& triangle : part.refinement.triangles) {
            const Judged j = judge(part, triangle);
            if ((j.narrow && !j.exempt) || j.oversized) bad.push_back(j);
        }
        if (bad.empty()) return {};

        std::vector<Subsegment> subsegments;
        std::vector<Box> circles;  // boxes of the diametral circles, which hold the subsegments as well
        for (const Side& side : part.sides) {
            const auto& chain = borders_[side.border].chain;
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                const Point a = point(chain[i]), b = point(chain[i + 1]), m = midpoint(a, b);
                const double r = 0.5 * distance(a, b) * (1 + 1e-12);
                subsegments.push_back({side.border, i});
                circles.push_back({m - Point{r, r}, m + Point{r, r}});
            }
        }
        const core::BoxTree tree(std::move(circles));
        std::vector<Subsegment> found;
        for (const Judged& j : bad) {
            // From the middle of the triangle to its circumcentre: the first subsegment on the way, else those upon
            // which the circumcentre encroaches.
            const Point inside = (1.0 / 3) * (j.corners[0] + j.corners[1] + j.corners[2]);
            const Point u = j.corners[1] - j.corners[0], v = j.corners[2] - j.corners[0];
            const Point centre =
                j.corners[0] + (0.5 / j.area2) * perpendicular(squared_length(v) * u - squared_length(u) * v);
            Box way;
            way.include(inside);
            way.include(centre);
            std::optional<Subsegment> first;
            double nearest = HUGE_VAL;
            std::vector<Subsegment> around;
            tree.overlaps(way, [&](std::size_t i) {
                const auto& chain = borders_[subsegments[i].border].chain;
                const Point a = point(chain[subsegments[i].place]), b = point(chain[subsegments[i].place + 1]);
                if (dot(a - centre, b - centre) <= 0) around.push_back(subsegments[i]);
                const double from = cross(b - a, inside - a), to = cross(b - a, centre - a);
                const double left = cross(centre - inside, a - inside), right = cross(centre - inside, b - inside);
                if ((from > 0) == (to > 0) || (left > 0) == (right > 0)) return;
                if (const double t = from / (from - to); t < nearest) {
                    nearest = t;
                    first = subsegments[i];
                }
            });
            if (first) around.assign(1, *first);
            found.insert(found.end(), around.begin(), around.end());
        }
        return found;
    }

    const ConstrainedRefineOptions& options_;
    std::size_t input_count_, triangulated_count_ = 0;
    std::vector<Point> points_;  ///< as handed in, added by the triangulation, added on borders
    double shortest_ = 0;
    std::vector<Index> across_, border_at_, part_of_;
    std::vector<Border> borders_;
    std::vector<Part> parts_;
    std::vector<std::vector<Index>> parts_of_border_;
    std::vector<Index> border_of_vertex_;  ///< for vertices that split borders
    std::vector<char> acute_;              ///< of the triangulation's vertices
    std::vector<Corner> sharp_corners_;
    std::vector<std::uint64_t> sharp_pairs_;
};

ConstrainedRefinement ConstrainedRefiner::result(const ConstrainedTriangulation& t) {
    ConstrainedRefinement r;
    r.steiner_points.assign(points_.begin() + static_cast<std::ptrdiff_t>(input_count_), points_.end());
    r.on_segments = points_.size() - triangulated_count_;
    for (const Part& part : parts_) {
        const std::size_t offset = input_count_ + r.steiner_points.size();
        for (const Triangle& triangle : part.refinement.triangles) {
            Triangle global;
            for (unsigned i = 0; i < 3; ++i) {
                const std::size_t v = triangle.v[i].index();
                global.v[i] =
                    v < part.local.size() ? VertexId{part.local[v]} : VertexId{offset + v - part.local.size()};
            }
            r.triangles.push_back(global);
            r.regions.push_back(part.region);
            const Judged j = judge(part, triangle);
            r.stats.below_bound += j.narrow;
            r.stats.exempt += j.narrow && j.exempt;
            r.stats.oversized += j.oversized;
        }
        r.steiner_points.insert(r.steiner_points.end(), part.refinement.steiner_points.begin(),
                                part.refinement.steiner_points.end());
        r.stats.refused += part.refinement.stats.refused;
    }
    for (std::size_t i = 0; i < t.segments.size(); ++i) {
        const auto& chain = borders_[i].chain;
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
            r.segments.push_back({VertexId{chain[k]}, VertexId{chain[k + 1]}});
            r.parents.push_back(t.parents[i]);
        }
    }
    return r;
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                             const SizeField& size, const ConstrainedRefineOptions& options) {
    ConstrainedRefiner refiner(points, triangulation, size, options);
    refiner.run();
    return refiner.result(triangulation);
}

}  // namespace lamina
