#include "pipeline/sharing/border_chain.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <fmt/format.h>

namespace lamina::pipeline {

namespace {

/// The edges of a subdomain's border by the vertices that they begin at. Most vertices have one.
class EdgesFrom {
public:
    explicit EdgesFrom(const decoupling::Subdomain& subdomain)
        : subdomain_(subdomain), first_(subdomain.points.size() + 1, 0), edges_(subdomain.segments.size()) {
        for (const Segment& s : subdomain.segments) ++first_[s.a.index() + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < subdomain.segments.size(); ++i) edges_[next[subdomain.segments[i].a.index()]++] = i;
    }

    /// Returns the number of the segment from a to b, or that of segments.
    std::size_t find(VertexId a, VertexId b) const {
        for (std::size_t k = first_[a.index()]; k < first_[a.index() + 1]; ++k)
            if (subdomain_.segments[edges_[k]].b == b) return edges_[k];
        return edges_.size();
    }
    bool dangles(std::size_t segment) const {
        const Segment& s = subdomain_.segments[segment];
        return find(s.b, s.a) < edges_.size();
    }

private:
    const decoupling::Subdomain& subdomain_;
    std::vector<std::size_t> first_, edges_;
};

/// Returns the number that a vertex of the mesh has in the subdomain, or the number of its vertices.
VertexId local_id(const decoupling::Subdomain& subdomain, VertexId v) {
    const auto at = std::lower_bound(subdomain.global.begin(), subdomain.global.end(), v);
    const bool found = at != subdomain.global.end() && *at == v;
    return VertexId{found ? static_cast<std::size_t>(at - subdomain.global.begin()) : subdomain.global.size()};
}

}  // namespace

BorderChain border_chain(const decoupling::LineBorder& border, const decoupling::Lines& lines) {
    BorderChain chain;
    auto& [edges, edge_lines] = chain;
    edges.reserve(border.vertices());
    edge_lines.reserve(border.vertices());
    for (const decoupling::LineLoop& of_border : border.loops) {
        const std::vector<VertexId> loop = decoupling::ids_of(of_border, lines);
        for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back({loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]});
        for (const decoupling::Stretch& stretch : of_border.stretches)
            edge_lines.insert(edge_lines.end(), stretch.segments(), stretch.line);
        assert(edges.size() == edge_lines.size());
    }
    if (!border.may_dangle) return chain;
    std::vector<Segment> sorted = edges;
    std::sort(sorted.begin(), sorted.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (std::binary_search(sorted.begin(), sorted.end(), Segment{edges[i].b, edges[i].a})) continue;
        edges[kept] = edges[i];
        edge_lines[kept++] = edge_lines[i];
    }
    edges.resize(kept);
    edge_lines.resize(kept);
    return chain;
}

std::vector<Point> apexes_of(const decoupling::Subdomain& subdomain, mesh::PieceFindings& findings) {
    mesh::DefectList& defects = findings.cells.defects;
    const EdgesFrom from(subdomain);
    const std::size_t n = subdomain.segments.size();
    std::vector<Point> by_segment(n, mesh::unknown_apex);
    const auto is_known = [&](std::size_t i) { return !std::isnan(by_segment[i].x); };
    for (const mesh::PieceBorderEdge& edge : findings.border) {
        const VertexId a = local_id(subdomain, edge.a), b = local_id(subdomain, edge.b);
        const std::size_t i = a.index() < subdomain.points.size() ? from.find(a, b) : n;
        if (i == n || is_known(i))
            defects.add([&] {
                return MeshDefect{fmt::format("the edge ({}, {}) of a piece is {} of its border", edge.a.index(),
                                              edge.b.index(), i == n ? "none" : "twice an edge"),
                                  edge.apex};
            });
        else
            by_segment[i] = edge.apex;
    }
    std::vector<Point> apexes;
    apexes.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (from.dangles(i)) {
            // Its two sides are linked, or else they are neighbours by their ends.
            const Segment& s = subdomain.segments[i];
            const std::size_t other = from.find(s.b, s.a);
            if (i > other) continue;
            if (is_known(i) != is_known(other))
                defects.add([&] {
                    return MeshDefect{"a piece is linked on one side of a line alone", subdomain.points[s.a.index()]};
                });
            findings.inner_edges += is_known(i);
            findings.cells.delaunay.edges += is_known(i);
            continue;
        }
        apexes.push_back(by_segment[i]);
        if (!is_known(i))
            defects.add([&] {
                return MeshDefect{"an edge of the border of a piece has no triangle of the piece",
                                  subdomain.points[subdomain.segments[i].a.index()]};
            });
    }
    return apexes;
}

}  // namespace lamina::pipeline
