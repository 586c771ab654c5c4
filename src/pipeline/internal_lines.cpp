// Lines are cut by one constrained triangulation of bodies and lines, in which crossings are vertices. They then stand
// in the way of rays as thin outlines, and are lines between subdomains in the outer region.
#include "pipeline/internal_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>
#include <lamina/triangulation.hpp>

#include "core/bounding_box.hpp"
#include "core/disjoint_sets.hpp"
#include "core/lexicographic_order.hpp"
#include "core/segments.hpp"
#include "core/text.hpp"
#include "geometry/inside.hpp"
#include "geometry/point_list.hpp"
#include "geometry/sheets.hpp"
#include "geometry/symmetry.hpp"

namespace lamina::pipeline {

namespace {

constexpr const char* option_name = "line";
constexpr const char* two_sided_word = "two-sided";

[[noreturn]] void refuse(const InternalLine& line, const std::string& reason) {
    throw OptionError(option_name, fmt::format("{}: {}", line.name, reason));
}

/// Throws OptionError for points that make no line.
void validate_points(const InternalLine& line) {
    if (line.points.size() < 2) refuse(line, "has less than two points");
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        if (!in_exact_range(line.points[i])) refuse(line, "has coordinates outside the exact range");
        if (i > 0 && line.points[i] == line.points[i - 1]) refuse(line, "repeats a point");
        if (i > 1 && core::segments_fold(line.points[i - 1], line.points[i - 2], line.points[i]))
            refuse(line, "runs back on itself");
    }
    if (line.two_sided && line.points.front() == line.points.back())
        refuse(line, "a line with two sides must not enclose a region of its own: leave a gap");
}

}  // namespace

InternalLine parse_line(const std::string& text) {
    const std::vector<std::string> parts = core::split(text, ':');
    core::require_text(parts.size() >= 2, text, "a line is NAME[:two-sided][:H]:FILE or ...:X0,Y0,X1,Y1[,...]");
    InternalLine line;
    line.name = parts.front();
    for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
        if (parts[i] == two_sided_word) {
            line.two_sided = true;
        } else {
            line.size = core::parse_number(parts[i]);
        }
    }
    geometry::PointList list = geometry::parse_point_list(parts.back());
    line.points = std::move(list.points);
    line.file = std::move(list.file);
    return line;
}

std::string line_text(const InternalLine& line) {
    std::string text = line.name;
    if (line.two_sided) text += std::string(":") + two_sided_word;
    if (line.size) text += ":" + core::to_text(*line.size);
    return text + ":" + geometry::point_list_text(line.points, line.file);
}

void validate_lines(std::span<const InternalLine> lines) {
    std::set<std::string> names;
    for (const InternalLine& line : lines) {
        const MarkerKind kind = line.two_sided ? MarkerKind::wall : MarkerKind::internal;
        if (line.name.empty() || legal_marker_name(line.name, kind) != line.name)
            refuse(
                line,
                "is no name that every format takes: it begins with a letter, and letters, digits, _, - and . follow");
        if (!names.insert(line.name).second) refuse(line, "two lines have this name: give each its own");
        validate_points(line);
        if (line.size && !(*line.size > 0)) refuse(line, "the size must be > 0");
    }
}

namespace {

/// An edge of a body, and the numbers of its ends among the vertices of all bodies.
struct WallEdge {
    std::size_t element, index;
    std::size_t first, second;
    Point a, b;
};

std::vector<WallEdge> wall_edges(const Geometry& geometry) {
    std::vector<WallEdge> edges;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const std::vector<Point>& p = geometry.elements[e].points;
        const std::size_t begin = edges.size(), n = p.size();
        for (std::size_t i = 0; i < n; ++i)
            edges.push_back({e, i, begin + i, begin + (i + 1) % n, p[i], p[(i + 1) % n]});
    }
    return edges;
}

constexpr double vertex_share = 0.3;  ///< of an edge: crossings nearer to one of its ends become that end

bool is_inside_body(const Geometry& geometry, Point p) {
    return std::any_of(geometry.elements.begin(), geometry.elements.end(), [&](const Element& element) {
        return core::bounding_box(element.points).contains(p) && geometry::contains(element.points, p);
    });
}

/// Returns the point of a wall that an end of a line outside the bodies is moved to, which is near it or known to be on
/// walls.
Point attached(Point end, bool is_known, std::span<const WallEdge> walls) {
    const double reach = is_known ? HUGE_VAL : 0.5;  // of the edge
    double nearest = HUGE_VAL;
    Point result = end;
    for (const WallEdge& wall : walls) {
        const double length = distance(wall.a, wall.b), d = core::distance_to_segment(end, wall.a, wall.b);
        if (!(d < reach * length && d < nearest)) continue;
        nearest = d;
        const double t = dot(end - wall.a, wall.b - wall.a) / (length * length);
        result = t < vertex_share ? wall.a : t > 1 - vertex_share ? wall.b : wall.a + t * (wall.b - wall.a);
    }
    return result;
}

/// Vertices that a wall gets, by the number of the edge on which they stand, in their order along it.
using VerticesOnEdges = std::map<std::size_t, std::vector<Point>>;

/// Adds the images of vertices on the upper part of a body that a line of symmetry cuts.
void add_images(const Element& element, double y, VerticesOnEdges& after) {
    const VerticesOnEdges above = after;
    for (const auto& [edge, points] : above) {
        std::vector<Point>& below = after[element.points.size() - 1 - edge];
        for (std::size_t i = points.size(); i-- > 0;) below.push_back(geometry::image_of(points[i], y));
    }
}

/// Adds vertices on the other side of sheets where lines that end on one side stand.
void add_across_sheets(const Element& element, VerticesOnEdges& after) {
    constexpr double same = 1e-6;  // of an edge: a line that crosses a sheet has a vertex on both sides
    const std::vector<Point>& p = element.points;
    const std::size_t n = p.size();
    const VerticesOnEdges given = after;
    for (const geometry::SheetRange& range : geometry::sheet_ranges(element))
        for (std::size_t i = range.first; i < range.last; ++i) {
            const auto found = given.find(i % n);
            if (found == given.end()) continue;
            const std::size_t edge = range.across(i, n);
            const Point a = p[i % n], b = p[(i + 1) % n], c = p[edge], d = p[(edge + 1) % n];
            std::vector<Point>& across = after[edge];
            for (const Point q : found->second) {
                const double share = distance(b, q) / distance(a, b);
                const auto is_same = [&](Point r) { return std::abs(distance(c, r) / distance(c, d) - share) < same; };
                if (std::none_of(across.begin(), across.end(), is_same)) across.push_back(c + share * (d - c));
            }
            std::sort(across.begin(), across.end(), [&](Point q, Point r) { return distance(c, q) < distance(c, r); });
        }
}

/// Puts vertices into the outline of an element.
void insert_vertices(const VerticesOnEdges& after, Element& element) {
    std::vector<Point> points;
    std::vector<std::size_t> lines, place;
    for (std::size_t i = 0; i < element.points.size(); ++i) {
        place.push_back(points.size());
        points.push_back(element.points[i]);
        lines.push_back(i < element.lines.size() ? element.lines[i] : 0);
        if (const auto found = after.find(i); found != after.end())
            for (const Point p : found->second) {
                points.push_back(p);
                lines.push_back(0);
            }
    }
    for (std::size_t& corner : element.features.corners) corner = place[corner];
    for (std::size_t& corner : element.given_corners) corner = place[corner];
    if (element.features.base) {
        element.features.base->first = place[element.features.base->first];
        element.features.base->last = place[element.features.base->last];
    }
    element.points = std::move(points);
    element.lines = std::move(lines);
}

/// The strip between the walls of the domain, or above its line of symmetry.
struct Strip {
    Box domain;
    bool ends_below = false, ends_above = false;  ///< else the far field is there

    bool contains(Point p) const {
        return (!ends_below || p.y > domain.lower.y) && (!ends_above || p.y < domain.upper.y);
    }
    bool is_on_border(Point p) const {
        return (ends_below && p.y == domain.lower.y) || (ends_above && p.y == domain.upper.y);
    }
    /// Returns y on the border of the strip that is no further away than `reach`, else y itself.
    double snapped(double y, double reach) const {
        if (ends_below && std::abs(y - domain.lower.y) <= reach) return domain.lower.y;
        return ends_above && std::abs(y - domain.upper.y) <= reach ? domain.upper.y : y;
    }
};

Strip strip_of(const decoupling::FarField& far_field) {
    return {far_field.box(), std::isfinite(far_field.floor), std::isfinite(far_field.ceiling)};
}

/// Bodies, borders of the domain on which lines may end, and lines in one triangulation.
struct Arrangement {
    std::vector<Point> points;
    std::size_t wall_points = 0;      ///< the first so many are those of the bodies
    std::vector<WallEdge> walls;      ///< the first segments
    std::size_t borders = 0;          ///< number of the next ones
    std::vector<std::uint32_t> line;  ///< of the other segments
    ConstrainedTriangulation cells;
    std::vector<EndsOnWalls> ends;  ///< LineGraph::ends

    bool is_of_line(std::size_t segment) const { return cells.parents[segment] >= walls.size() + borders; }
    std::uint32_t line_of(std::size_t segment) const { return line[cells.parents[segment] - walls.size() - borders]; }
};

/// Adds the borders of the domain on which lines may end.
void add_borders(const Strip& strip, std::vector<Segment>& segments, Arrangement& result) {
    const auto [lower_left, lower_right, upper_right, upper_left] = strip.domain.corners();
    const auto add = [&](Point a, Point b) {
        segments.push_back({VertexId(result.points.size()), VertexId(result.points.size() + 1)});
        result.points.insert(result.points.end(), {a, b});
        ++result.borders;
    };
    if (strip.ends_below) add(lower_left, lower_right);
    if (strip.ends_above) add(upper_left, upper_right);
}

/// Puts the vertices on borders, which may have been rounded, there exactly.
void straighten_borders(const Strip& strip, Arrangement& result) {
    for (std::size_t i = 0; i < result.cells.segments.size(); ++i) {
        if (result.cells.parents[i] < result.walls.size() || result.is_of_line(i)) continue;
        for (const VertexId v : {result.cells.segments[i].a, result.cells.segments[i].b}) {
            Point& p = result.points[v.index()];
            const bool is_below = strip.ends_below && result.cells.parents[i] == result.walls.size();
            p.y = is_below ? strip.domain.lower.y : strip.domain.upper.y;
        }
    }
}

Arrangement arrange(std::span<const InternalLine> lines, const Strip& strip, const Geometry& geometry,
                    std::span<const EndsOnWalls> known) {
    Arrangement result;
    result.walls = wall_edges(geometry);
    std::vector<Segment> segments;
    for (const WallEdge& wall : result.walls) {
        segments.push_back({VertexId(wall.first), VertexId(wall.second)});
        result.points.push_back(wall.a);
    }
    result.wall_points = result.points.size();
    add_borders(strip, segments, result);
    for (std::uint32_t k = 0; k < lines.size(); ++k) {
        std::vector<Point> points = lines[k].points;
        // Free ends are no double vertices, so a wall without thickness needs one between them.
        if (lines[k].two_sided && points.size() == 2) points.insert(points.begin() + 1, midpoint(points[0], points[1]));
        EndsOnWalls ends{};
        if (points.front() != points.back()) {
            const std::array before{distance(points[0], points[1]), distance(points.end()[-1], points.end()[-2])};
            points.front().y = strip.snapped(points.front().y, geometry::typed_rounding * before[0]);
            points.back().y = strip.snapped(points.back().y, geometry::typed_rounding * before[1]);
            for (const bool is_last : {false, true}) {
                Point& end = is_last ? points.back() : points.front();
                ends[is_last] = !known.empty() && known[k][is_last];
                const bool is_inside = is_inside_body(geometry, end);
                const Point on_wall = is_inside ? end : attached(end, ends[is_last], result.walls);
                ends[is_last] |= is_inside || on_wall != end;
                end = on_wall;
            }
        }
        result.ends.push_back(ends);
        result.points.insert(result.points.end(), points.begin(), points.end());
        for (std::size_t i = result.points.size() - points.size(); i + 1 < result.points.size(); ++i) {
            segments.push_back({VertexId(i), VertexId(i + 1)});
            result.line.push_back(k);
        }
    }
    result.cells = triangulate(result.points, segments, {.crossings = Crossings::insert, .merge_distance = 0.0});
    result.points.insert(result.points.end(), result.cells.steiner_points.begin(), result.cells.steiner_points.end());
    straighten_borders(strip, result);
    return result;
}

/// Vertices that walls get, per element.
using InsertedVertices = std::vector<VerticesOnEdges>;

/// Returns the vertices of lines on walls that become vertices of these, and replaces others in `moved` by the vertex
/// of the wall that they are near to.
InsertedVertices settle_on_walls(const Arrangement& arrangement, std::span<const char> used, std::size_t elements,
                                 std::vector<std::size_t>& moved) {
    InsertedVertices inserted(elements);
    std::map<std::uint32_t, std::vector<std::size_t>> on_edge;
    for (std::size_t i = 0; i < arrangement.cells.segments.size(); ++i) {
        const std::uint32_t parent = arrangement.cells.parents[i];
        if (parent >= arrangement.walls.size()) continue;
        for (const VertexId v : {arrangement.cells.segments[i].a, arrangement.cells.segments[i].b})
            if (v.index() >= arrangement.wall_points && used[v.index()]) on_edge[parent].push_back(v.index());
    }
    for (auto& [parent, vertices] : on_edge) {
        const WallEdge& wall = arrangement.walls[parent];
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        const double length = distance(wall.a, wall.b);
        const auto at = [&](std::size_t v) { return distance(wall.a, arrangement.points[v]); };
        std::sort(vertices.begin(), vertices.end(), [&](std::size_t a, std::size_t b) { return at(a) < at(b); });
        std::size_t last = wall.first;
        for (const std::size_t v : vertices) {
            if (at(v) < vertex_share * length) {
                moved[v] = wall.first;
            } else if (at(v) > (1 - vertex_share) * length) {
                moved[v] = wall.second;
            } else if (at(v) > at(last)) {
                inserted[wall.element][wall.index].push_back(arrangement.points[v]);
                last = v;
            } else {
                moved[v] = last;
            }
        }
    }
    return inserted;
}

/// Throws OptionError where two-sided lines enclose a region, by themselves or with bodies.
void require_connected_domain(const LineGraph& graph, const Geometry& geometry) {
    // Bodies that a line of symmetry cuts are parts of the domain's border, which comes behind the bodies.
    const std::size_t bodies = geometry.elements.size() + 1;
    std::map<Point, std::size_t, core::LexicographicOrder> body_at;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e)
        for (const Point p : geometry.elements[e].points)
            body_at.emplace(p, geometry.elements[e].is_mirrored ? bodies - 1 : e);
    core::DisjointSets connected(bodies + graph.points.size());
    const auto node = [&](VertexId v) {
        const auto body = body_at.find(graph.points[v.index()]);
        if (body != body_at.end()) return static_cast<std::uint32_t>(body->second);
        return static_cast<std::uint32_t>(graph.on_border[v.index()] ? bodies - 1 : bodies + v.index());
    };
    for (std::size_t i = 0; i < graph.pieces.size(); ++i) {
        const InternalLine& line = graph.given[graph.line[i]];
        if (!line.two_sided) continue;
        if (!connected.join(node(graph.pieces[i].a), node(graph.pieces[i].b)))
            refuse(line, "it encloses a part of the flow, with bodies or other two-sided lines: leave a gap");
    }
}

/// Throws OptionError where lines have no place in the domain.
void require_place_for_lines(std::span<const InternalLine> lines, const Strip& strip) {
    const Box& domain = strip.domain;
    for (const InternalLine& line : lines)
        for (const Point p : line.points)
            if (!(domain.lower.x < p.x && p.x < domain.upper.x && (strip.ends_below || domain.lower.y < p.y) &&
                  (strip.ends_above || p.y < domain.upper.y)))
                refuse(line, fmt::format("the point ({}, {}) is not inside the far field, from ({:g}, {:g}) to ({:g}, "
                                         "{:g}): end the line there, or make --far-field larger",
                                         p.x, p.y, domain.lower.x, domain.lower.y, domain.upper.x, domain.upper.y));
}

/// Returns the pieces of lines in the strip outside bodies, as numbers of segments.
std::vector<std::size_t> pieces_in_flow(const Arrangement& arrangement, const Strip& strip, const Geometry& geometry) {
    std::vector<std::size_t> pieces;
    const ConstrainedTriangulation& cells = arrangement.cells;
    for (std::size_t i = 0; i < cells.segments.size(); ++i) {
        if (!arrangement.is_of_line(i)) continue;
        const auto [a, b] = cells.segments[i];
        const Point middle = midpoint(arrangement.points[a.index()], arrangement.points[b.index()]);
        if (strip.contains(middle) && !is_inside_body(geometry, middle)) pieces.push_back(i);
    }
    return pieces;
}

/// Drops the pieces that are edges of walls, as those become that run from one vertex of a wall to the next.
void drop_wall_edges(const Arrangement& arrangement, std::span<const std::size_t> moved, const Geometry& geometry,
                     std::vector<std::size_t>& pieces) {
    std::map<Point, std::pair<Point, Point>, core::LexicographicOrder> beside;
    for (const Element& element : geometry.elements)
        for (std::size_t i = 0, n = element.points.size(); i < n; ++i)
            beside[element.points[i]] = {element.points[(i + n - 1) % n], element.points[(i + 1) % n]};
    std::erase_if(pieces, [&](std::size_t i) {
        const Segment& piece = arrangement.cells.segments[i];
        const Point b = arrangement.points[moved[piece.b.index()]];
        const auto found = beside.find(arrangement.points[moved[piece.a.index()]]);
        return found != beside.end() && (found->second.first == b || found->second.second == b);
    });
}

/// Numbers the vertices of pieces, `moved` to where they have settled, in the order in which pieces have them.
LineGraph number_pieces(const Arrangement& arrangement, std::span<const std::size_t> pieces,
                        std::span<const std::size_t> moved, const std::set<Point, core::LexicographicOrder>& on_wall,
                        const Strip& strip) {
    LineGraph graph;
    std::map<std::size_t, VertexId> number;
    const auto vertex = [&](VertexId of_arrangement) {
        const std::size_t v = moved[of_arrangement.index()];
        const auto [at, is_new] = number.try_emplace(v, VertexId{graph.points.size()});
        if (is_new) {
            graph.points.push_back(arrangement.points[v]);
            graph.on_wall.push_back(on_wall.contains(arrangement.points[v]) ? 1 : 0);
            graph.on_border.push_back(!graph.on_wall.back() && strip.is_on_border(arrangement.points[v]) ? 1 : 0);
        }
        return at->second;
    };
    std::set<std::pair<VertexId, VertexId>> known;
    for (const std::size_t i : pieces) {
        const Segment& piece = arrangement.cells.segments[i];
        const VertexId a = vertex(piece.a), b = vertex(piece.b);
        if (a == b || !known.insert(std::minmax(a, b)).second) continue;
        graph.pieces.push_back({a, b});
        graph.line.push_back(arrangement.line_of(i));
    }
    return graph;
}

}  // namespace

LineGraph arrange_lines(std::span<const InternalLine> lines, const decoupling::FarField& far_field, Geometry& geometry,
                        std::span<const EndsOnWalls> known) {
    if (lines.empty()) return {};
    const Strip strip = strip_of(far_field);
    require_place_for_lines(lines, strip);
    const Arrangement arrangement = arrange(lines, strip, geometry, known);
    std::vector<std::size_t> pieces = pieces_in_flow(arrangement, strip, geometry);
    std::vector<char> used(arrangement.points.size());
    for (const std::size_t i : pieces)
        for (const VertexId v : {arrangement.cells.segments[i].a, arrangement.cells.segments[i].b}) used[v.index()] = 1;
    std::vector<std::size_t> moved(arrangement.points.size());
    std::iota(moved.begin(), moved.end(), std::size_t{0});
    InsertedVertices inserted = settle_on_walls(arrangement, used, geometry.elements.size(), moved);
    std::set<Point, core::LexicographicOrder> on_wall(
        arrangement.points.begin(), arrangement.points.begin() + static_cast<std::ptrdiff_t>(arrangement.wall_points));
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        if (inserted[e].empty()) continue;
        if (!geometry.elements[e].sheets.empty()) add_across_sheets(geometry.elements[e], inserted[e]);
        for (const auto& [edge, points] : inserted[e]) on_wall.insert(points.begin(), points.end());
        if (geometry.elements[e].is_mirrored) add_images(geometry.elements[e], *geometry.symmetry, inserted[e]);
        insert_vertices(inserted[e], geometry.elements[e]);
    }
    drop_wall_edges(arrangement, moved, geometry, pieces);
    LineGraph graph = number_pieces(arrangement, pieces, moved, on_wall, strip);
    graph.given.assign(lines.begin(), lines.end());
    graph.ends = arrangement.ends;
    require_connected_domain(graph, geometry);
    return graph;
}

}  // namespace lamina::pipeline
