// A wake is a slit: the outline that rays are grown round runs from the trailing edge along the wake to its end and
// back, so that the layers of both sides of the element go on behind it:
//
//      |   |   |  |  |   |    |    |     |
//      |   |   |  |  |   |    |    |     |          rays; the first height opens, so that there are
//    __|___|___|  |  |   |    |    |     |  .       fewer and fewer layers up to isotropy
//    ____element__>--+---+----+----+-----+-----     end of the wake: one ray without layers
//      |   |   |  |  |   |    |    |     |  '
//      |   |   |  |  |   |    |    |     |
//
// The wake is no wall: its vertices are inner vertices of the layer, one for both sides. Behind a blunt base the sides
// run straight from both corners to a point on the line of the wake, and a core fills the space between them
// (docs/decisions/0036).
#include "layers/wake/wake_outline.hpp"
#include "geometry/sharp_corner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/segments.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Wakes with fewer vertices before their wedge are not worth it.
constexpr std::size_t min_vertices = 8;

WakePoint between(const WakePoint& a, const WakePoint& b, double share) {
    return {a.at + share * (b.at - a.at), a.left + share * (b.left - a.left), a.right + share * (b.right - a.right)};
}

/// A line, with the distance of each point from the first along it. It has each point once.
class MeasuredLine {
public:
    explicit MeasuredLine(std::span<const WakePoint> line) : line_{line.front()}, done_{0} {
        for (const WakePoint& point : line.subspan(1)) {
            const double piece = distance(line_.back().at, point.at);
            if (piece == 0) continue;
            line_.push_back(point);
            done_.push_back(done_.back() + piece);
        }
    }
    double length() const { return done_.back(); }
    /// Returns the point at this distance, at most length(), from the first one.
    WakePoint at(double from_first) const {
        const auto above = std::upper_bound(done_.begin() + 1, done_.end() - 1, from_first);
        const auto i = static_cast<std::size_t>(above - done_.begin());
        return between(line_[i - 1], line_[i], (from_first - done_[i - 1]) / (done_[i] - done_[i - 1]));
    }

private:
    std::vector<WakePoint> line_;
    std::vector<double> done_;
};

/// Divides one wake, from its trailing edge to its end.
class WakeDivision {
public:
    WakeDivision(const MeasuredLine& line, double end, const LayerGrowth& growth, DividedWake& wake)
        : line_(line), end_(std::min(end, line.length())), growth_(growth), wake_(wake) {}

    /// Adds the vertices on both sides of the core behind a base, which ends at `depth`, and the one where they meet.
    void divide_sides(double depth, double edge) {
        const WakePoint end = line_.at(depth);
        wake_.core = make_core(wake_.element, wake_.edge, end.at, edge, wake_edge_ratio, growth_);
        Point from = wake_.edge.front();
        for (const std::size_t station : wake_.core.stations) {
            const std::vector<Point>& chain = wake_.core.chains[station];
            WakePoint left = end, right = end;
            left.at = chain.back();
            right.at = chain.front();
            const double length = distance(std::exchange(from, right.at), right.at);
            add(left, right, std::min(distance_ + length, depth));
        }
        distance_ = depth;
    }

    /// Adds the vertices on the line, behind those that are there. Returns whether there is room for the wedge.
    bool divide_line(double edge) {
        const double longest = max_wake_edge_share * line_.length();
        for (;;) {
            edge = std::min(edge, longest);
            const std::vector<double> wedge = distances_to_end(edge);
            if (distance_ + edge + wedge.front() > end_) return end_wake(wedge, edge);
            const WakePoint point = line_.at(distance_ + edge);
            add(point, point, distance_ + edge);
            edge *= wake_edge_ratio;
        }
    }

private:
    const MeasuredLine& line_;
    double end_;
    const LayerGrowth& growth_;
    DividedWake& wake_;
    double distance_ = 0, opening_ = 1;  ///< of the last vertex

    void add(const WakePoint& left, const WakePoint& right, double at) {
        const double opened = (1 + wake_opening) * opening_;
        const double widest = std::min(left.left, right.right) / (layers_when_open * growth_.first_height);
        opening_ = std::max(opening_, std::min(opened, widest));
        distance_ = at;
        wake_.vertices.push_back({left, right, opening_});
        wake_.distances.push_back(at);
    }

    /// Returns the distances from the end at which the wedge has its vertices, descending. Its first edges are about as
    /// long as this one, its last so long that fronts fall no faster than they may.
    std::vector<double> distances_to_end(double edge) const {
        std::vector<double> distances;
        double length = opening_ * layer_height(growth_, 1) / max_front_slope, at = 0;
        do {
            distances.push_back(at += length);
            length *= wake_edge_ratio;
        } while (length < edge);
        std::reverse(distances.begin(), distances.end());
        return distances;
    }

    /// Adds the vertices of the wedge, with the first height of the last vertex before it.
    bool end_wake(const std::vector<double>& wedge, double edge) {
        if (wake_.vertices.size() < min_vertices) return false;
        const auto add_open = [&](double at) {
            const WakePoint point = line_.at(at);
            wake_.vertices.push_back({point, point, opening_});
            wake_.distances.push_back(at);
        };
        for (const double before_end : wedge)
            if (end_ - before_end > distance_ + 0.5 * edge) add_open(end_ - before_end);
        add_open(end_);
        return true;
    }
};

bool is_sharp(std::span<const Point> outline, std::size_t i) {
    const std::size_t n = outline.size();
    const Point before = outline[i] - outline[(i + n - 1) % n], after = outline[(i + 1) % n] - outline[i];
    return core::angle_between(before, after) > core::radians(geometry::sharp_corner_deg);
}

/// Returns the base of an element if the line of a wake begins there, else its sharp corner where the line begins, as a
/// base without a width; nothing where there is neither.
std::optional<Base> trailing_edge(const Element& element, Point from) {
    const std::vector<Point>& outline = element.points;
    if (const std::optional<Base>& base = element.features.base) {
        const Point a = outline[base->first], b = outline[base->last];
        if (core::distance_to_segment(from, a, b) < 0.5 * distance(a, b)) return base;
    }
    const auto nearest = std::min_element(outline.begin(), outline.end(), [&](Point a, Point b) {
        return squared_length(a - from) < squared_length(b - from);
    });
    const auto corner = static_cast<std::size_t>(nearest - outline.begin());
    return is_sharp(outline, corner) ? std::optional<Base>({corner, corner}) : std::nullopt;
}

/// Something that a wake must not cross.
struct Obstacle {
    Point a, b;
    const DividedWake* wake = nullptr;  ///< the wake of which it is an edge
    double from = 0;                    ///< distance of that edge from the trailing edge
};

/// Calls f(a, b, distance of a from the trailing edge) for the edges of a wake: both where it has two sides.
template <class F>
void for_each_edge(const DividedWake& wake, F f) {
    Point left = wake.edge.back(), right = wake.edge.front();
    double from = 0;
    for (std::size_t k = 0; k < wake.vertices.size(); ++k) {
        const WakeVertex& to = wake.vertices[k];
        f(right, to.right.at, from);
        if (left != right) f(left, to.left.at, from);
        left = to.left.at;
        right = to.right.at;
        from = wake.distances[k];
    }
}

/// Returns the points of the outline from the first index to the last, counter-clockwise.
std::vector<Point> stretch(std::span<const Point> outline, const Base& base) {
    std::vector<Point> points{outline[base.first]};
    for (std::size_t i = base.first; i != base.last;) points.push_back(outline[i = (i + 1) % outline.size()]);
    return points;
}

/// Returns whether a point lies on the trailing edge or the base before a wake, but for rounding: at a vertex of it, or
/// where a ray was added between two.
bool lies_on_edge(const DividedWake& wake, Point p) {
    constexpr double tolerance = 1e-9;
    for (std::size_t k = 0; k < wake.edge.size(); ++k) {
        const Point a = wake.edge[k], b = wake.edge[std::min(k + 1, wake.edge.size() - 1)];
        const double square = squared_length(b - a), along = dot(p - a, b - a);
        if (p == a || (along > 0 && along < square && std::abs(cross(b - a, p - a)) <= tolerance * square)) return true;
    }
    return false;
}

/// Puts the line of a wake into a line of symmetry, with the same heights on both sides.
void put_on_symmetry(double y, std::vector<WakePoint>& line) {
    for (WakePoint& point : line) {
        point.at.y = y;
        point.left = point.right = std::max(point.left, point.right);
    }
}

}  // namespace

std::vector<DividedWake> divide_wakes(const Geometry& geometry, const LayerGrowth& growth,
                                      std::span<const double> ends) {
    std::vector<DividedWake> wakes;
    for (std::size_t i = 0; i < growth.wakes.size(); ++i) {
        const WakeLine& line = growth.wakes[i];
        const Element& element = geometry.elements[line.element];
        const std::vector<Point>& outline = element.points;
        const std::optional<Base> edge = trailing_edge(element, line.points.front().at);
        if (!edge) continue;
        const std::size_t n = outline.size();
        const double on_wall = std::min(distance(outline[edge->last], outline[(edge->last + 1) % n]),
                                        distance(outline[edge->first], outline[(edge->first + n - 1) % n]));
        DividedWake wake{.line = i,
                         .element = line.element,
                         .first_corner = edge->first,
                         .last_corner = edge->last,
                         .edge = stretch(outline, *edge)};
        std::vector<WakePoint> points = line.points;
        points.front().at = midpoint(wake.edge.front(), wake.edge.back());
        if (element.is_mirrored) {
            if (wake.edge[wake.edge.size() / 2] != outline.front()) continue;
            put_on_symmetry(*geometry.symmetry, points);
        }
        const MeasuredLine measured(points);
        const double depth = core_length * distance(wake.edge.front(), wake.edge.back());
        if (depth > max_core_share * std::min(measured.length(), ends[i])) continue;
        const LayerGrowth own = growth_on_element(growth, line.element);
        WakeDivision division(measured, ends[i], own, wake);
        double first_edge = on_wall;
        if (depth > 0) {
            division.divide_sides(depth, on_wall);
            const std::size_t sides = wake.vertices.size();
            first_edge = sides > 1 ? wake.distances[sides - 1] - wake.distances[sides - 2] : depth;
        }
        if (division.divide_line(std::max(first_edge, on_wall))) wakes.push_back(std::move(wake));
    }
    return wakes;
}

std::vector<RayVertex> outline_with_wake(std::span<const Point> wall, const DividedWake* wake) {
    std::vector<RayVertex> outline;
    if (!wake) {
        for (const Point p : wall) outline.push_back({p});
        return outline;
    }
    // From the corner on the left round the body to that on the right, then along the wake.
    const std::size_t n = wall.size(), end = wake->vertices.size() - 1;
    outline.push_back({wall[wake->last_corner]});
    for (std::size_t i = wake->last_corner; outline.size() == 1 || i != wake->first_corner;)
        outline.push_back({wall[i = (i + 1) % n]});
    for (std::size_t k = 0; k < end; ++k) {
        const WakeVertex& vertex = wake->vertices[k];
        outline.push_back({vertex.right.at, RayPlace::wake, vertex.opening, vertex.right.right});
    }
    outline.push_back({wake->vertices[end].left.at, RayPlace::wake_end, wake->vertices[end].opening, 0});
    for (std::size_t k = end; k-- > 0;) {
        const WakeVertex& vertex = wake->vertices[k];
        outline.push_back({vertex.left.at, RayPlace::wake, vertex.opening, vertex.left.left});
    }
    // Both sides of the wake, and its end, lie between the last point of the wall and the first.
    assert(outline[outline.size() - 1 - end].place == RayPlace::wake_end);
    assert(outline[outline.size() - 2 - 2 * end].place == RayPlace::wall && outline.front().place == RayPlace::wall);
    return outline;
}

void keep_wakes_clear(const RaySet& walls, std::span<const double> needed, std::span<const DividedWake> wakes,
                      std::span<double> ends) {
    // The edges of the walls, the ways of their rays, and the edges of the wakes.
    std::vector<Obstacle> obstacles;
    const std::vector<std::size_t> next = walls.following();
    for (std::size_t i = 0; i < walls.lines.size(); ++i) {
        const RayLine& ray = walls.lines[i];
        obstacles.push_back({ray.origin, walls.lines[next[i]].origin});
        obstacles.push_back({ray.origin, ray.origin + (needed[i] / wall_fraction) * ray.direction});
    }
    for (const DividedWake& wake : wakes)
        for_each_edge(wake, [&](Point a, Point b, double from) { obstacles.push_back({a, b, &wake, from}); });
    std::vector<Box> boxes;
    boxes.reserve(obstacles.size());
    for (const Obstacle& obstacle : obstacles) boxes.push_back(core::bounding_box(obstacle.a, obstacle.b));
    const core::BoxTree tree(std::move(boxes));
    for (const DividedWake& wake : wakes) {
        const auto is_own = [&](Point p) { return lies_on_edge(wake, p); };
        for_each_edge(wake, [&](Point a, Point b, double from) {
            if (from >= ends[wake.line]) return;
            tree.overlaps(core::bounding_box(a, b), [&](std::size_t i) {
                const Obstacle& other = obstacles[i];
                // The rays of the trailing edge, and the wall beside it, make way for the wake. Of two wakes that
                // cross, the one that has come farther ends.
                if (other.wake ? other.wake->line == wake.line || other.from > from ||
                                     (other.from == from && other.wake->line < wake.line)
                               : is_own(other.a) || is_own(other.b))
                    return;
                if (core::segments_meet(a, b, other.a, other.b)) ends[wake.line] = std::min(ends[wake.line], from);
            });
        });
    }
}

bool shorten_bare_wakes(const RaySet& set, std::span<const std::uint32_t> counts, std::span<const DividedWake> wakes,
                        std::span<double> ends) {
    bool changed = false;
    for (const DividedWake& wake : wakes) {
        // The wake's rays end the element's. The ray of vertex k on the way out is first + k, on the way back last - k.
        const std::size_t end = wake.vertices.size() - 1, begin = set.begin[wake.element],
                          last = set.begin[wake.element + 1] - 1, first = last - 2 * end;
        // Along a line of symmetry they begin with that of the end, and those below are images.
        const bool is_half = set.lines[begin].place == RayPlace::wake_end;
        const auto is_bare = [&](std::size_t k) {
            return is_half ? counts[begin + end - k] == 0 : counts[first + k] == 0 || counts[last - k] == 0;
        };
        std::size_t kept = 0;
        while (kept < end && !is_bare(kept)) ++kept;
        const bool bare_corner = is_half ? counts[begin + end + 1] == 0 : counts[first - 1] == 0 || counts[begin] == 0;
        if (kept == end && !bare_corner) continue;
        ends[wake.line] = bare_corner || kept == 0 ? 0 : wake.distances[kept - 1];
        changed = true;
    }
    return changed;
}

// The space between a base and the point where the layers of both sides meet behind it is cut into strips between
// chains. The first chain is the base, the last one a point. Chains end at stations, vertices of the wake, but for
// those of the layers on the base, which end at its corners:
//
//    wall ___________u_
//                    |\\'--s---.__
//                    ||||  |   |  '--s----.__           s  stations
//              base  ||||  |   |     |       '--s- end
//                    ||//  |   |  .--s---''
//                    |//.--s---''
//    wall -----------l'
//
// Ends on the edges between stations would make first cells beside the wake, a millionth of a chord high, meet them in
// angles of nearly 180 degrees.

namespace {

/// A chain: how far behind the base it lies, the height of the strip below it, and whether it ends at stations.
struct ChainPlace {
    double height, strip;
    bool station;
};

std::vector<ChainPlace> place_chains(double depth, double edge, double ratio, const LayerGrowth& growth) {
    std::vector<ChainPlace> places;
    double of_law = 0;
    for (std::uint32_t n = 1;; ++n) {
        const double above = layer_height(growth, n);
        const double strip = above - of_law;
        // Half a strip before the first station, or more, so that the strip below it is no thinner than the last layer.
        if (above + 0.5 * strip >= edge) break;
        places.push_back({above, strip, false});
        of_law = above;
    }
    for (double height = edge; height <= depth - 0.5 * edge; height += edge) {
        places.push_back({height, edge, true});
        edge *= ratio;
    }
    return places;
}

/// Returns the shares of a chain's length at which its points lie: cells widen from both ends up to this width.
std::vector<double> shares_between_stations(double length, double widest, double outermost) {
    std::vector<double> half{0};
    double cell = outermost;
    while (half.back() + 1.5 * cell < 0.5 * length && cell < widest) {
        half.push_back(half.back() + cell);
        cell *= core_cell_ratio;
    }
    // The rest between both halves is divided evenly.
    const double rest = length - 2 * half.back();
    const double parts = std::max(1.0, std::ceil(rest / std::max(widest, cell)));
    std::vector<double> shares = half;
    for (double& share : shares) share /= length;
    for (double part = 1; part < parts; ++part) shares.push_back((half.back() + rest * part / parts) / length);
    for (std::size_t i = half.size(); i-- > 0;) shares.push_back(1 - half[i] / length);
    return shares;
}

/// Returns the shares of a base's length at which its points lie.
std::vector<double> shares_along(std::span<const Point> base) {
    std::vector<double> shares{0};
    for (std::size_t i = 1; i < base.size(); ++i) shares.push_back(shares.back() + distance(base[i - 1], base[i]));
    const double length = shares.back();
    for (double& share : shares) share /= length;
    shares.back() = 1;
    return shares;
}

}  // namespace

WakeCore make_core(std::size_t element, std::span<const Point> base, Point end, double edge, double ratio,
                   const LayerGrowth& growth) {
    const Point right = base.front(), left = base.back();
    const double width = distance(right, left), depth = std::abs(cross(left - right, end - right)) / width;
    WakeCore core{.element = element, .chains = {std::vector<Point>(base.begin(), base.end())}, .stations = {}};
    if (base.size() == 2) core.chains[0].insert(core.chains[0].begin() + 1, midpoint(right, left));
    const std::vector<double> base_shares = shares_along(core.chains[0]);
    const double base_cell = width / static_cast<double>(base_shares.size() - 1);
    for (const ChainPlace& place : place_chains(depth, edge, ratio, growth)) {
        const double share = place.height / depth;
        const Point a = right + share * (end - right), b = left + share * (end - left);
        const std::vector<double> shares =
            place.station ? shares_between_stations((1 - share) * width, std::max(place.strip, base_cell),
                                                    outermost_core_cell * growth.first_height)
                          : base_shares;
        std::vector<Point> chain{place.station ? a : right};
        for (std::size_t i = 1; i + 1 < shares.size(); ++i) chain.push_back(a + shares[i] * (b - a));
        chain.push_back(place.station ? b : left);
        if (place.station) core.stations.push_back(core.chains.size());
        core.chains.push_back(std::move(chain));
    }
    core.stations.push_back(core.chains.size());
    core.chains.push_back({end});
    return core;
}

void keep_left_half(double y, WakeCore& core) {
    for (std::vector<Point>& chain : core.chains) {
        const std::size_t half = chain.size() / 2;
        Point first = chain[half];
        if (chain.size() % 2 == 0) first = midpoint(chain[half - 1], chain[half]);
        chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(half));
        if (chain.front() != first) chain.insert(chain.begin(), first);
        chain.front().y = y;
    }
}

}  // namespace lamina::layers
