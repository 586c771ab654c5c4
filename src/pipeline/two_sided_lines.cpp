// Lines become walls without thickness: their vertices are doubled.
#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "pipeline/internal_lines.hpp"

namespace lamina::pipeline {

namespace {

/// The cells at the vertices of two-sided lines, and the copy of the vertex that each of them has.
class VertexCopies {
public:
    VertexCopies(std::span<const Segment> lines, Mesh& mesh) : mesh_(mesh) {
        for (const Segment& edge : lines) {
            cut_.insert(std::minmax(edge.a, edge.b));
            corners_.try_emplace(edge.a);
            corners_.try_emplace(edge.b);
        }
        for (Triangle& triangle : mesh.triangles) collect(triangle.v, 3);
        for (Quad& quad : mesh.quads) collect(quad.v, 4);
        for (auto& [v, corners] : corners_) number(v, corners);
    }

    /// Gives the cells their copies.
    void apply() {
        for (const auto& [v, corners] : corners_)
            for (const Corner& corner : corners) *corner.place = corner.copy;
    }
    /// Returns a directed edge with the copies that the cell on its left has; the edge itself where there is no such
    /// cell.
    Segment on_left(Segment edge) const {
        Segment result = edge;
        if (const Corner* a = corner_with(edge.a, edge.b, true)) result.a = a->copy;
        if (const Corner* b = corner_with(edge.b, edge.a, false)) result.b = b->copy;
        return result;
    }

private:
    /// The corner of a cell, and the vertices beside it, the next one counter-clockwise first.
    struct Corner {
        VertexId* place;
        VertexId next, previous, copy;
    };

    void collect(VertexId* v, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i)
            if (const auto found = corners_.find(v[i]); found != corners_.end())
                found->second.push_back({&v[i], v[(i + 1) % n], v[(i + n - 1) % n], v[i]});
    }
    /// Numbers the copies of a vertex: one for each fan of cells between edges of lines and of the boundary. The first
    /// fan keeps the vertex.
    void number(VertexId v, std::vector<Corner>& corners) {
        std::vector<char> done(corners.size());
        bool is_first = true;
        for (std::size_t first = 0; first < corners.size(); ++first) {
            if (done[first]) continue;
            VertexId copy = v;
            if (!is_first) {
                copy = VertexId{mesh_.points.size()};
                mesh_.points.push_back(Point(mesh_.points[v.index()]));
            }
            is_first = false;
            std::vector<std::size_t> fan{first};
            done[first] = 1;
            for (std::size_t k = 0; k < fan.size(); ++k) {
                corners[fan[k]].copy = copy;
                for (std::size_t i = 0; i < corners.size(); ++i) {
                    if (done[i]) continue;
                    const bool after = corners[i].next == corners[fan[k]].previous && !is_cut(v, corners[i].next);
                    const bool before = corners[i].previous == corners[fan[k]].next && !is_cut(v, corners[i].previous);
                    if (!after && !before) continue;
                    done[i] = 1;
                    fan.push_back(i);
                }
            }
        }
    }
    bool is_cut(VertexId a, VertexId b) const { return cut_.contains(std::minmax(a, b)); }
    /// Returns the corner at v whose next or previous vertex is this one; null where there is none.
    const Corner* corner_with(VertexId v, VertexId other, bool is_next) const {
        const auto found = corners_.find(v);
        if (found == corners_.end()) return nullptr;
        for (const Corner& corner : found->second)
            if ((is_next ? corner.next : corner.previous) == other) return &corner;
        return nullptr;
    }

    Mesh& mesh_;
    std::set<std::pair<VertexId, VertexId>> cut_;
    std::map<VertexId, std::vector<Corner>> corners_;
};

}  // namespace

void split_two_sided(std::span<const InternalLine> lines, Mesh& mesh, std::vector<Segment>& constraints) {
    const auto is_two_sided = [&](const Marker& marker) {
        return marker.kind == MarkerKind::internal &&
               std::any_of(lines.begin(), lines.end(),
                           [&](const InternalLine& line) { return line.two_sided && line.name == marker.name; });
    };
    std::vector<Segment> cut;
    for (const Marker& marker : mesh.markers)
        if (is_two_sided(marker)) cut.insert(cut.end(), marker.edges.begin(), marker.edges.end());
    VertexCopies copies(cut, mesh);
    for (Marker& marker : mesh.markers) {
        std::vector<Segment> edges;
        const bool both = is_two_sided(marker);
        for (const Segment& edge : marker.edges) {
            edges.push_back(copies.on_left(edge));
            if (both) edges.push_back(copies.on_left({edge.b, edge.a}));
        }
        if (both) marker.kind = MarkerKind::wall;
        marker.edges = std::move(edges);
    }
    for (Segment& edge : constraints) {
        const Segment moved = copies.on_left(edge);
        edge = {std::min(moved.a, moved.b), std::max(moved.a, moved.b)};
    }
    std::sort(constraints.begin(), constraints.end());
    copies.apply();
}

}  // namespace lamina::pipeline
