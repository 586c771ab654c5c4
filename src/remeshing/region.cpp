#include "remeshing/region.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/lexicographic_order.hpp"
#include "core/predicates.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/cell_text.hpp"
#include "mesh/isotropic_cells.hpp"
#include "remeshing/metric.hpp"

namespace lamina::remeshing {

namespace {

/// The borders at a vertex of the region.
struct VertexBorders {
    std::uint32_t leaving = 0, arriving = 0;  ///< the other ends of border edges, which have the region on their left
    EdgeHandle border = frozen_border;        ///< of the edge that leaves
    EdgeHandle border_before = frozen_border;
    std::uint8_t edges_leaving = 0, edges_arriving = 0;
};

/// Makes the region of a mesh.
class RegionTaker {
public:
    RegionTaker(const MeshView& mesh, std::span<const MetricTensor> metric)
        : mesh_(mesh), edges_(mesh), adjacency_(mesh::find_adjacency(mesh)) {
        region_.vertices.resize(mesh.points.size());
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            region_.vertices[v].at = mesh.points[v];
            region_.vertices[v].metric = metric[v];
            region_.vertices[v].origin = static_cast<std::uint32_t>(v);
        }
    }

    MetricMesh take(bool divide_borders) {
        if (!adjacency_.overused.empty()) {
            const std::uint32_t edge = adjacency_.overused.front();
            throw InputError({.at = mesh_.points[edges_.origin(edge).index()]},
                             fmt::format("edge {} has more than one cell on a side",
                                         mesh::edge_text({edges_.origin(edge), edges_.target(edge)})));
        }
        find_borders(divide_borders);
        add_triangles();
        find_freedoms();
        if (divide_borders) freeze_borders_at_pairs();
        return std::move(region_);
    }

private:
    /// Finds the border of each directed edge of the mesh; 0 for edges that are none.
    void find_borders(bool divide_borders) {
        border_.assign(edges_.size(), 0);
        for (const std::uint32_t e : adjacency_.boundary) border_[e] = frozen_border;
        if (divide_borders) number_borders();
        std::vector<Segment> frozen(mesh_.constraints.begin(), mesh_.constraints.end());
        for (const Marker& marker : mesh_.markers)
            if (marker.kind == MarkerKind::internal)
                frozen.insert(frozen.end(), marker.edges.begin(), marker.edges.end());
        if (frozen.empty()) return;
        for (const mesh::EdgePair& pair : mesh::find_pairs(mesh_, frozen)) {
            if (pair.edge != mesh::no_edge) border_[pair.edge] = frozen_border;
            if (pair.twin != mesh::no_edge) border_[pair.twin] = frozen_border;
        }
    }
    /// Gives the edges that may be divided the number of their marker.
    void number_borders() {
        std::vector<Segment> segments;
        std::vector<EdgeHandle> borders;
        for (std::size_t marker = 0; marker < mesh_.markers.size(); ++marker) {
            const MarkerKind kind = mesh_.markers[marker].kind;
            if (kind == MarkerKind::internal || kind == MarkerKind::periodic) continue;
            const std::vector<Segment>& edges = mesh_.markers[marker].edges;
            segments.insert(segments.end(), edges.begin(), edges.end());
            borders.resize(segments.size(), frozen_border | static_cast<EdgeHandle>(marker + 1));
        }
        const std::vector<std::uint32_t> found = mesh::find_edges(mesh_, segments);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (found[i] != mesh::no_edge) border_[found[i]] = borders[i];
    }
    void add_triangles() {
        std::vector<std::uint32_t> number(mesh_.triangles.size(), no_index);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (!is_remeshed(mesh_, t)) continue;
            number[t] = static_cast<std::uint32_t>(region_.triangles.size());
            MeshTriangle& triangle = region_.triangles.emplace_back();
            for (unsigned i = 0; i < 3; ++i) {
                triangle.v[i] = mesh_.triangles[t].v[i].value;
                region_.vertices[triangle.v[i]].triangle = region_.vertices[triangle.v[i]].place = number[t];
            }
            const Point a = region_.point(triangle.v[0]);
            if (!region_.turns_left(a, region_.point(triangle.v[1]), region_.point(triangle.v[2])))
                throw InputError({.at = a}, mesh::cell_text(mesh_, t) + " is not counter-clockwise");
        }
        borders_.resize(mesh_.points.size());
        for (std::size_t t = 0; t < number.size(); ++t) {
            if (number[t] == no_index) continue;
            for (unsigned i = 0; i < 3; ++i) add_edge(3 * t + i, number[t], before(i), number);
        }
    }
    /// Notes what is behind edge e of a triangle, which is `directed` in the mesh.
    void add_edge(std::size_t directed, std::uint32_t triangle, unsigned e, std::span<const std::uint32_t> number) {
        EdgeHandle behind = border_[directed];
        const std::uint32_t twin = adjacency_.twin[directed];
        if (behind == 0) {
            const std::size_t cell = edges_.cell_of(twin);
            const bool changes = cell < number.size() && number[cell] != no_index;
            behind = changes ? edge_link(number[cell], before(twin % 3)) : frozen_border;
        }
        region_.triangles[triangle].n[e] = behind;
        if (is_border(behind)) note_border(region_.triangles[triangle], e);
    }
    void note_border(const MeshTriangle& triangle, unsigned e) {
        const std::uint32_t from = triangle.v[after(e)], to = triangle.v[before(e)];
        VertexBorders &start = borders_[from], &end = borders_[to];
        start.leaving = to;
        start.border = triangle.n[e];
        start.edges_leaving = static_cast<std::uint8_t>(std::min(start.edges_leaving + 1, 2));
        end.arriving = from;
        end.border_before = triangle.n[e];
        end.edges_arriving = static_cast<std::uint8_t>(std::min(end.edges_arriving + 1, 2));
    }
    void find_freedoms() {
        for (std::size_t v = 0; v < borders_.size(); ++v) {
            const VertexBorders& borders = borders_[v];
            MeshVertex& vertex = region_.vertices[v];
            if (borders.edges_leaving == 0) {
                vertex.freedom = vertex.is_used() ? Freedom::free : Freedom::fixed;
            } else if (borders.edges_leaving == 1 && borders.edges_arriving == 1 &&
                       borders.border == borders.border_before && borders.border != frozen_border &&
                       is_straight(borders.arriving, v, borders.leaving)) {
                vertex.freedom = Freedom::on_line;
            }
        }
    }
    /// Returns whether b is on the way from a to c, as well as coordinates can say it.
    bool is_straight(std::size_t a, std::size_t b, std::size_t c) const {
        const Point p = mesh_.points[a], q = mesh_.points[b], r = mesh_.points[c];
        const double magnitude = std::max({std::abs(q.x), std::abs(q.y), length(q - p), length(r - q)});
        return dot(q - p, r - q) > 0 && std::abs(cross(q - p, r - q)) <= 8 * core::epsilon * magnitude * length(r - p);
    }
    /// The two sides of a wall without thickness have to keep their vertices, which are pairs at the same places.
    void freeze_borders_at_pairs() {
        std::vector<std::uint32_t> order;
        for (std::uint32_t v = 0; v < borders_.size(); ++v)
            if (borders_[v].edges_leaving > 0) order.push_back(v);
        const auto place = [&](std::uint32_t v) { return mesh_.points[v]; };
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return place(a) == place(b) ? a < b : lexicographically_less(place(a), place(b));
        });
        std::vector<char> is_pair(borders_.size(), 0);
        for (std::size_t i = 1; i < order.size(); ++i)
            if (place(order[i - 1]) == place(order[i])) is_pair[order[i - 1]] = is_pair[order[i]] = 1;
        for (MeshTriangle& triangle : region_.triangles)
            for (unsigned e = 0; e < 3; ++e) {
                const std::uint32_t a = triangle.v[after(e)], b = triangle.v[before(e)];
                if (!is_border(triangle.n[e]) || (is_pair[a] == 0 && is_pair[b] == 0)) continue;
                triangle.n[e] = frozen_border;
                region_.vertices[a].freedom = region_.vertices[b].freedom = Freedom::fixed;
            }
    }

    MeshView mesh_;
    mesh::CellEdges edges_;
    mesh::Adjacency adjacency_;
    std::vector<EdgeHandle> border_;
    std::vector<VertexBorders> borders_;  ///< per vertex
    MetricMesh region_;
};

/// Returns the metric in which an edge is at most sqrt(2) long, by a larger size along it alone: the inverse of the
/// metric gets a multiple of e e^T (J. Sherman, W. J. Morrison, Ann. Math. Statist. 21 (1950)).
MetricTensor lowered_along(const MetricTensor& m, Point edge) {
    const double squared = product(m, edge, edge);
    if (squared <= 2) return m;
    const Point image{m.xx * edge.x + m.xy * edge.y, m.xy * edge.x + m.yy * edge.y};
    const double share = (1 - 2 / squared) / squared;
    const MetricTensor lowered{m.xx - share * image.x * image.x, m.xy - share * image.x * image.y,
                               m.yy - share * image.y * image.y};
    if (is_metric(lowered)) return lowered;
    // The difference was rounded away. As long an edge in all directions is larger still.
    const double isotropic = 2 / squared_length(edge);
    return {isotropic, 0, isotropic};
}

/// Makes the mesh with the region put back.
class RegionReturner {
public:
    RegionReturner(const MeshView& mesh, const MetricMesh& region) : mesh_(mesh), region_(region) { find_numbers(); }

    Mesh put_back(std::span<const MetricTensor> asked, std::vector<MetricTensor>& metric) const {
        Mesh result;
        result.points.resize(vertices_);
        metric.resize(vertices_);
        for (std::size_t v = 0; v < number_.size(); ++v) {
            if (!number_[v].valid()) continue;
            result.points[number_[v].index()] = mesh_.points[v];
            metric[number_[v].index()] = asked[v];
        }
        for (std::size_t v = 0; v < region_number_.size(); ++v) {
            if (!region_.vertices[v].is_used()) continue;
            result.points[region_number_[v].index()] = region_.vertices[v].at;
            metric[region_number_[v].index()] = region_.vertices[v].metric;
        }
        add_cells(result);
        add_markers(result);
        for (const Segment& edge : mesh_.constraints)
            result.constraints.push_back({number_[edge.a.index()], number_[edge.b.index()]});
        return result;
    }

private:
    /// Numbers the vertices of the mesh that stay, in their order, and then those that are new.
    void find_numbers() {
        std::vector<char> stays(mesh_.points.size(), 0);
        const mesh::CellEdges cells(mesh_);
        for (std::size_t cell = 0; cell < cells.cells(); ++cell)
            for (std::size_t i = 0; !is_remeshed(mesh_, cell) && i < cells.corners(cell); ++i)
                stays[cells.corner(cell, i).index()] = 1;
        for (const MeshVertex& vertex : region_.vertices)
            if (vertex.is_used() && vertex.origin != no_index) stays[vertex.origin] = 1;
        number_.resize(stays.size());
        for (std::size_t v = 0; v < stays.size(); ++v)
            if (stays[v] != 0) number_[v] = VertexId(vertices_++);
        old_vertices_ = vertices_;
        region_number_.resize(region_.vertices.size());
        for (std::size_t v = 0; v < region_number_.size(); ++v) {
            const MeshVertex& vertex = region_.vertices[v];
            if (vertex.is_used())
                region_number_[v] = vertex.origin != no_index ? number_[vertex.origin] : VertexId(vertices_++);
        }
    }
    void add_cells(Mesh& result) const {
        const auto copy_attributes = [&](std::size_t cell) {
            if (!mesh_.region.empty()) result.region.push_back(mesh_.region[cell]);
            if (!mesh_.layer.empty()) result.layer.push_back(mesh_.layer[cell]);
        };
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (is_remeshed(mesh_, t)) continue;
            const auto& v = mesh_.triangles[t].v;
            result.triangles.push_back({{number_[v[0].index()], number_[v[1].index()], number_[v[2].index()]}});
            copy_attributes(t);
        }
        for (const MeshTriangle& triangle : region_.triangles)
            if (triangle.is_used())
                result.triangles.push_back(
                    {{region_number_[triangle.v[0]], region_number_[triangle.v[1]], region_number_[triangle.v[2]]}});
        if (!mesh_.region.empty()) result.region.resize(result.triangles.size(), Region::isotropic);
        if (!mesh_.layer.empty()) result.layer.resize(result.triangles.size(), 0);
        for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
            const auto& v = mesh_.quads[q].v;
            result.quads.push_back(
                {{number_[v[0].index()], number_[v[1].index()], number_[v[2].index()], number_[v[3].index()]}});
            copy_attributes(mesh_.triangles.size() + q);
        }
    }
    /// Copies the markers; where borders were divided, the edges of each follow each other as they did before.
    void add_markers(Mesh& result) const {
        std::vector<std::vector<VertexId>> next(mesh_.markers.size());
        for (const MeshTriangle& triangle : region_.triangles)
            for (unsigned e = 0; triangle.is_used() && e < 3; ++e) {
                if (!is_border(triangle.n[e]) || triangle.n[e] == frozen_border) continue;
                auto& of_marker = next[(triangle.n[e] & ~border_bit) - 1];
                if (of_marker.empty()) of_marker.resize(vertices_);
                of_marker[region_number_[triangle.v[after(e)]].index()] = region_number_[triangle.v[before(e)]];
            }
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) {
            result.markers.push_back({mesh_.markers[m].name, mesh_.markers[m].kind, {}});
            for (const Segment& edge : mesh_.markers[m].edges) add_edges(edge, next[m], result.markers.back().edges);
        }
    }
    /// Adds the edges that have come of one: from its start up to the next vertex that the mesh had before.
    void add_edges(const Segment& edge, std::vector<VertexId>& next, std::vector<Segment>& edges) const {
        // Where its start has gone, the edge before it leads past it.
        VertexId at = number_[edge.a.index()];
        if (!at.valid()) return;
        if (next.empty() || !next[at.index()].valid()) {
            edges.push_back({at, number_[edge.b.index()]});
            return;
        }
        do {
            const VertexId to = std::exchange(next[at.index()], VertexId{});
            assert(to.valid());
            edges.push_back({at, to});
            at = to;
        } while (at.index() >= old_vertices_);
    }

    const MeshView& mesh_;
    const MetricMesh& region_;
    std::vector<VertexId> number_;         ///< of the vertices of the mesh; not valid where they have gone
    std::vector<VertexId> region_number_;  ///< of those of the region
    std::size_t vertices_ = 0, old_vertices_ = 0;
};

}  // namespace

bool is_remeshed(const MeshView& mesh, std::size_t cell) { return mesh::is_isotropic_triangle(mesh, cell); }

MetricMesh take_region(const MeshView& mesh, std::span<const MetricTensor> metric, bool divide_borders) {
    return RegionTaker(mesh, metric).take(divide_borders);
}

void limit_at_frozen_edges(MetricMesh& region) {
    for (const MeshTriangle& triangle : region.triangles)
        for (unsigned e = 0; e < 3; ++e) {
            if (triangle.n[e] != frozen_border) continue;
            MeshVertex &a = region.vertices[triangle.v[after(e)]], &b = region.vertices[triangle.v[before(e)]];
            for (MetricTensor* metric : {&a.metric, &b.metric}) *metric = lowered_along(*metric, b.at - a.at);
        }
    for (std::uint32_t t = 0; t < region.triangles.size(); ++t) region.renew(t);
}

Mesh put_back(const MeshView& mesh, const MetricMesh& region, std::span<const MetricTensor> asked,
              std::vector<MetricTensor>& metric) {
    return RegionReturner(mesh, region).put_back(asked, metric);
}

}  // namespace lamina::remeshing
