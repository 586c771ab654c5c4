#include "adaptation/outer_region.hpp"
#include "decoupling/subdomain.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include <lamina/error.hpp>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "decoupling/separators.hpp"
#include "mesh/adjacency.hpp"
#include "sizing/requests.hpp"

namespace lamina::adaptation {

namespace {

using VertexLoop = std::vector<VertexId>;

/// Sine of the angle of a corner that is none.
constexpr double straight = 1e-9;

/// Returns the edges of the border of isotropic cells as loops.
std::vector<VertexLoop> border_loops_of(const Mesh& mesh, std::span<const char> isotropic) {
    std::vector<VertexId> next(mesh.points.size());
    for (const Segment& edge : border_edges(mesh, isotropic)) {
        assert(!next[edge.a.index()].valid());
        next[edge.a.index()] = edge.b;
    }
    std::vector<VertexLoop> loops;
    for (std::size_t v = 0; v < next.size(); ++v) {
        if (!next[v].valid()) continue;
        VertexLoop loop;
        for (VertexId at(v); next[at.index()].valid();) {
            loop.push_back(at);
            at = std::exchange(next[at.index()], VertexId{});
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

/// Makes a region simple.
class RegionTrimmer {
public:
    explicit RegionTrimmer(const Mesh& mesh) : mesh_(mesh), edges_(mesh), adjacency_(mesh::find_adjacency(mesh)) {}

    /// Keeps the part with the most cells of those that hang together over edges.
    void keep_largest_part(std::vector<char>& isotropic) const {
        std::vector<std::uint32_t> part(isotropic.size(), 0);
        std::uint32_t parts = 0, largest = 0;
        std::size_t most = 0;
        for (std::size_t start = 0; start < isotropic.size(); ++start) {
            if (!isotropic[start] || part[start] != 0) continue;
            std::vector<std::size_t> found{start};
            part[start] = ++parts;
            for (std::size_t at = 0; at < found.size(); ++at)
                for (std::size_t e = edges_.first(found[at]); e < edges_.first(found[at] + 1); ++e) {
                    if (adjacency_.twin[e] == mesh::no_edge) continue;
                    const std::size_t beside = edges_.cell_of(adjacency_.twin[e]);
                    if (!isotropic[beside] || part[beside] != 0) continue;
                    part[beside] = parts;
                    found.push_back(beside);
                }
            if (found.size() <= most) continue;
            most = found.size();
            largest = parts;
        }
        for (std::size_t cell = 0; cell < isotropic.size(); ++cell)
            isotropic[cell] = part[cell] == largest && parts > 0;
    }
    /// Takes the cells at vertices where several borders meet. Returns whether there are any.
    bool open_pinches(std::vector<char>& isotropic) const {
        std::vector<char> leaving(mesh_.points.size(), 0);  // per vertex: how many edges of borders leave it, up to 2
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const std::uint32_t twin = adjacency_.twin[e];
            const bool inside = twin != mesh::no_edge && isotropic[edges_.cell_of(twin)];
            char& count = leaving[edges_.origin(e).index()];
            if (isotropic[edges_.cell_of(e)] && !inside) count = static_cast<char>(std::min(count + 1, 2));
        }
        bool found = false;
        for (std::size_t cell = 0; cell < isotropic.size(); ++cell)
            for (std::size_t i = 0; isotropic[cell] && i < edges_.corners(cell); ++i)
                if (leaving[edges_.corner(cell, i).index()] > 1) {
                    isotropic[cell] = 0;
                    found = true;
                }
        return found;
    }

private:
    const Mesh& mesh_;
    mesh::CellEdges edges_;
    mesh::Adjacency adjacency_;
};

Box box_of(const Mesh& mesh, const VertexLoop& loop) {
    Box box;
    for (const VertexId v : loop) box.include(mesh.points[v.index()]);
    return box;
}

/// Returns the corners of a convex loop without those on straight lines, counter-clockwise.
std::vector<Point> corners_of(const Mesh& mesh, const VertexLoop& loop) {
    std::vector<Point> corners;
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Point before = mesh.points[loop[(i + n - 1) % n].index()], at = mesh.points[loop[i].index()],
                    after = mesh.points[loop[(i + 1) % n].index()];
        const double turn = cross(unit(at - before), unit(after - at));
        if (turn < -straight)
            throw OptionError(
                "solution",
                "has a mesh whose far field is not convex: where layers stand on ground or tunnel walls, --mesh FILE "
                "with their markers is needed");
        if (turn > straight) corners.push_back(at);
    }
    return corners;
}

decoupling::FarField far_field_of(const Mesh& mesh, const VertexLoop& loop) {
    const Box box = box_of(mesh, loop);
    const double width = box.upper.x - box.lower.x, height = box.upper.y - box.lower.y;
    decoupling::FarField far_field;
    far_field.center = midpoint(box.lower, box.upper);
    far_field.radius = 0.5 * width;
    const std::vector<Point> corners = corners_of(mesh, loop);
    const double rounding = 1e-9 * width;
    const auto on_circle = [&](Point p) {
        return std::abs(distance(p, far_field.center) - far_field.radius) < 1e-3 * far_field.radius;
    };
    if (corners.size() == 4 && std::abs(width - height) < rounding &&
        std::abs(distance(corners[0], corners[2]) - std::sqrt(2.0) * width) < rounding) {
        far_field.shape = FarFieldShape::box;
    } else if (corners.size() > 12 && std::all_of(corners.begin(), corners.end(), on_circle)) {
        far_field.shape = FarFieldShape::circle;
    } else {
        far_field.shape = FarFieldShape::outline;
        far_field.outline = corners;
    }
    return far_field;
}

/// Returns the edges of the far field and of lines of symmetry, each with its smaller vertex first; sorted.
std::vector<Segment> edges_of_sides(const Mesh& mesh) {
    std::vector<Segment> edges;
    for (const Marker& marker : mesh.markers)
        if (marker.kind == MarkerKind::far_field || marker.kind == MarkerKind::symmetry)
            for (const Segment& e : marker.edges) edges.push_back({std::min(e.a, e.b), std::max(e.a, e.b)});
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Divides a loop into stretches: sides end at corners, and all other edges that follow each other are one stretch.
/// Nothing where there are sides alone.
std::vector<DomainStretch> stretches_of(const Mesh& mesh, VertexLoop loop) {
    const std::vector<Segment> sides = edges_of_sides(mesh);
    if (sides.empty()) return {};
    const std::size_t n = loop.size();
    const auto is_side = [&](std::size_t i) {
        const VertexId a = loop[i % n], b = loop[(i + 1) % n];
        return std::binary_search(sides.begin(), sides.end(), Segment{std::min(a, b), std::max(a, b)});
    };
    const auto turns = [&](std::size_t i) {
        const auto at = [&](std::size_t k) { return mesh.points[loop[k % n].index()]; };
        return std::abs(cross(unit(at(i) - at(i + n - 1)), unit(at(i + 1) - at(i)))) > straight;
    };
    const auto begins = [&](std::size_t i) { return is_side(i) != is_side(i + n - 1) || (is_side(i) && turns(i)); };
    std::size_t first = 0;
    while (first < n && is_side(first)) ++first;
    if (first == n) return {};
    // What is no side begins behind one, wherever the loop does.
    for (std::size_t k = 0; k < n && !is_side(first + n - 1); ++k) first = (first + n - 1) % n;
    std::vector<DomainStretch> stretches;
    for (std::size_t i = first; i < first + n; ++i) {
        if (i == first || begins(i)) stretches.push_back({{loop[i % n]}, is_side(i)});
        std::vector<VertexId>& vertices = stretches.back().vertices;
        if (stretches.back().is_side && vertices.size() == 2) vertices.pop_back();
        vertices.push_back(loop[(i + 1) % n]);
    }
    return stretches;
}

/// Returns the box of a domain whose border is given: the last one of those between which the decoupling cuts.
decoupling::FarField given_border_in(const Box& box) {
    decoupling::FarField far_field;
    const auto corners = box.corners();
    far_field.shape = FarFieldShape::outline;
    far_field.outline.assign(corners.begin(), corners.end());
    far_field.center = box.center();
    far_field.radius = 0.5 * box.width();
    far_field.floor = box.lower.y;
    far_field.ceiling = box.upper.y;
    far_field.is_half = true;  // bodies may stand on the border
    return far_field;
}

/// Returns the border of the domain with its sides divided by the size field. Their points are added to `points`.
VertexLoop close_domain(const std::vector<DomainStretch>& domain, const SizeField& size, std::vector<Point>& points) {
    VertexLoop loop;
    for (const DomainStretch& stretch : domain) {
        loop.insert(loop.end(), stretch.vertices.begin(), stretch.vertices.end() - 1);
        if (!stretch.is_side) continue;
        const Point a = points[stretch.vertices.front().index()], b = points[stretch.vertices.back().index()];
        for (const Point p : decoupling::divide_separator(a, b, size)) {
            loop.push_back(VertexId(points.size()));
            points.push_back(p);
        }
    }
    return loop;
}

/// Calls visit(chain, is_closed) for each border that stays: round bodies, and the fronts on the border of the domain.
template <class Visit>
void for_each_fixed_border(const OuterRegion& region, Visit visit) {
    for (const VertexLoop& border : region.borders) visit(border, true);
    for (const DomainStretch& stretch : region.domain)
        if (!stretch.is_side) visit(stretch.vertices, false);
}

}  // namespace

std::vector<Segment> border_edges(const Mesh& mesh, std::span<const char> isotropic) {
    const mesh::Adjacency adjacency = mesh::find_adjacency(mesh);
    const mesh::CellEdges edges(mesh);
    std::vector<Segment> border;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (!isotropic[edges.cell_of(e)]) continue;
        const std::uint32_t twin = adjacency.twin[e];
        if (twin == mesh::no_edge || !isotropic[edges.cell_of(twin)])
            border.push_back({edges.origin(e), edges.target(e)});
    }
    return border;
}

std::vector<char> simple_region(const Mesh& mesh, std::vector<char> isotropic) {
    const RegionTrimmer trimmer(mesh);
    do trimmer.keep_largest_part(isotropic);
    while (trimmer.open_pinches(isotropic));
    return isotropic;
}

OuterRegion find_outer_region(const Mesh& mesh, std::span<const char> isotropic) {
    std::vector<VertexLoop> loops = border_loops_of(mesh, isotropic);
    if (loops.empty()) throw OptionError("solution", "has a mesh without cells beyond the layer");
    const auto outermost = std::max_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
        return box_of(mesh, a).width() < box_of(mesh, b).width();
    });
    OuterRegion region;
    std::vector<VertexId> number(mesh.points.size());
    const auto add = [&](VertexLoop& border) {
        for (VertexId& v : border) {
            VertexId& own = number[v.index()];
            if (!own.valid()) {
                own = VertexId(region.points.size());
                region.points.push_back(mesh.points[v.index()]);
            }
            v = own;
        }
    };
    region.domain = stretches_of(mesh, {outermost->rbegin(), outermost->rend()});
    region.far_field =
        region.domain.empty() ? far_field_of(mesh, *outermost) : given_border_in(box_of(mesh, *outermost));
    loops.erase(outermost);
    for (VertexLoop& loop : loops) {
        std::reverse(loop.begin(), loop.end());
        add(loop);
        region.borders.push_back(std::move(loop));
    }
    for (DomainStretch& stretch : region.domain) add(stretch.vertices);
    std::vector<char> outside(mesh.points.size(), 0);
    const mesh::CellEdges cells(mesh);
    for (std::size_t cell = 0; cell < cells.cells(); ++cell)
        for (std::size_t i = 0; isotropic[cell] && i < cells.corners(cell); ++i)
            outside[cells.corner(cell, i).index()] = 1;
    region.inside_vertices = static_cast<std::size_t>(std::count(outside.begin(), outside.end(), 0));
    return region;
}

std::size_t count_vertices(const OuterRegion& region, const SizedMesh& sizes) {
    SizingOptions sizing;
    sizing.background = std::make_shared<const SizedMesh>(sizes);
    std::vector<std::vector<Point>> loops;
    for_each_fixed_border(region, [&](const VertexLoop& border, bool is_closed) {
        std::vector<Point>& loop = loops.emplace_back();
        for (const VertexId v : border) loop.push_back(region.points[v.index()]);
        if (!is_closed && loop.size() > 2) std::copy(loop.rbegin() + 1, loop.rend() - 1, std::back_inserter(loop));
    });
    const Box domain = region.far_field.box();
    const sizing::SizeRequests requests = sizing::gather_size_requests(sizing, {}, loops, domain);
    const SizeField field = sizing::make_size_field(loops, requests.sources, sizing, 1, domain);
    RefineOptions refine_options;
    Box bodies;
    for (const Point p : region.points) bodies.include(p);
    if (!region.points.empty()) refine_options.unit_length = bodies.width();
    std::vector<Point> points = region.points;
    std::vector<VertexLoop> borders = region.borders;
    if (!region.domain.empty()) borders.push_back(close_domain(region.domain, field, points));
    const decoupling::Decoupling decoupling =
        decoupling::decouple({points, borders, field, region.far_field}, refine_options);
    std::size_t vertices = region.inside_vertices + decoupling.points.size();
    for (const Refinement& refinement : refine(decoupling.subdomains)) vertices += refinement.steiner_points.size();
    return vertices;
}

std::vector<double> sizes_of_borders(const OuterRegion& region, std::span<const Point> points) {
    // An edge may be a little longer than the size of a source there, and edges of the next mesh a little longer than
    // those of this one.
    constexpr double margin = 1.15;
    const double gradation = sizing::border_gradation(SizingOptions{}.gradation);
    std::vector<Segment> edges;
    std::vector<Box> boxes;
    std::vector<double> negative_sizes;
    const Box domain = region.far_field.box();
    for_each_fixed_border(region, [&](const VertexLoop& border, bool is_closed) {
        // What leads from one side of the domain to the other, as ground does, the next mesh divides anew.
        const double x = region.points[border.front().index()].x;
        if (!is_closed && (x == domain.lower.x || x == domain.upper.x)) return;
        for (std::size_t i = 0; i + !is_closed < border.size(); ++i) {
            const Segment edge{border[i], border[(i + 1) % border.size()]};
            const Point a = region.points[edge.a.index()], b = region.points[edge.b.index()];
            edges.push_back(edge);
            boxes.emplace_back();
            boxes.back().include(a);
            boxes.back().include(b);
            negative_sizes.push_back(-margin * distance(a, b) / sizing::frozen_share);
        }
    });
    std::vector<double> sizes(points.size(), 0.0);
    if (edges.empty()) return sizes;
    const core::BoxTree tree(std::move(boxes));
    const auto values = tree.group_minima(std::move(negative_sizes));
    constexpr std::size_t grain = 1024;
    core::parallel_for(points.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            sizes[i] = -tree.minimum(points[i], gradation, 0, values, [&](std::size_t e) {
                const SizeSource edge{
                    .a = region.points[edges[e].a.index()], .b = region.points[edges[e].b.index()], .size = 1};
                return distance_to(edge, points[i]);
            });
    });
    return sizes;
}

}  // namespace lamina::adaptation
