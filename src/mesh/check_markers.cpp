#include "mesh/check_markers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "mesh/cell_text.hpp"
#include "mesh/periodic.hpp"

namespace lamina::mesh {

std::vector<Segment> sorted_undirected(std::span<const Segment> edges) {
    std::vector<Segment> sorted(edges.begin(), edges.end());
    for (Segment& edge : sorted)
        if (edge.b < edge.a) std::swap(edge.a, edge.b);
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

std::vector<Segment> internal_edges(std::span<const Marker> markers) {
    std::vector<Segment> edges;
    for (const Marker& marker : markers)
        if (marker.kind == MarkerKind::internal) edges.insert(edges.end(), marker.edges.begin(), marker.edges.end());
    edges = sorted_undirected(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

std::vector<SlitEdge> slit_edges(std::span<const Point> points, std::span<const Marker> markers) {
    std::vector<SlitEdge> slits;
    const auto ends_of = [&](const Segment& edge) {
        const Point a = points[edge.a.index()], b = points[edge.b.index()];
        return lexicographically_less(a, b) ? std::pair{a, b} : std::pair{b, a};
    };
    const auto less = [&](const Segment& s, const Segment& t) {
        const auto [a, b] = ends_of(s);
        const auto [c, d] = ends_of(t);
        return a == c ? lexicographically_less(b, d) : lexicographically_less(a, c);
    };
    for (const Marker& marker : markers) {
        if (marker.kind == MarkerKind::internal) continue;
        std::vector<Segment> edges = marker.edges;
        std::stable_sort(edges.begin(), edges.end(), less);
        std::vector<SlitEdge> twins;
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            const Segment &s = edges[i], &t = edges[i + 1];
            if (points[s.a.index()] != points[t.b.index()] || points[s.b.index()] != points[t.a.index()]) continue;
            if (s.a == t.b && s.b == t.a) continue;
            twins.push_back({s, t});
            twins.push_back({t, s});
        }
        // Doubled vertices along a seam that was not closed have other edges in their marker.
        if (twins.size() == edges.size()) slits.insert(slits.end(), twins.begin(), twins.end());
    }
    std::sort(slits.begin(), slits.end());
    return slits;
}

namespace {

/// Looks at one marker after the other, and reports what is wrong with it.
class MarkerCheck {
public:
    MarkerCheck(std::span<const Point> points, const std::vector<Segment>& boundary, DefectList& defects)
        : points_(points), boundary_(boundary), defects_(defects), marked_(boundary.size(), 0) {}

    void check_name(const Marker& marker, std::span<const Marker> earlier) {
        const auto is_namesake = [&](const Marker& other) { return other.name == marker.name; };
        if (std::any_of(earlier.begin(), earlier.end(), is_namesake))
            defects_.add([&] { return MeshDefect{fmt::format("two markers are named '{}'", marker.name), {}}; });
    }
    void check_internal(const Marker& marker) {
        const std::vector<Segment> edges = sorted_undirected(marker.edges);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const Segment edge = edges[i];
            if (i > 0 && edge == edges[i - 1])
                report(edge, fmt::format("marker '{}' holds the edge {} twice", marker.name, edge_text(edge)));
            for (const Segment& side : {edge, reversed(edge)})
                if (std::binary_search(boundary_.begin(), boundary_.end(), side))
                    report(side, fmt::format("edge {} of the internal marker '{}' is on the boundary", edge_text(side),
                                             marker.name));
        }
    }
    void check_on_boundary(const Marker& marker) {
        for (const Segment& edge : marker.edges) {
            const auto found = std::lower_bound(boundary_.begin(), boundary_.end(), edge);
            if (found == boundary_.end() || *found != edge) {
                const bool other_way = std::binary_search(boundary_.begin(), boundary_.end(), reversed(edge));
                report(edge, fmt::format("edge {} of marker '{}' {}", edge_text(edge), marker.name,
                                         other_way ? "has the mesh on its right" : "is not on the boundary"));
            } else if (std::exchange(marked_[static_cast<std::size_t>(found - boundary_.begin())], 1)) {
                report(edge,
                       fmt::format("boundary edge {} is marked twice, once as '{}'", edge_text(edge), marker.name));
            }
        }
    }
    void check_all_marked() {
        for (std::size_t i = 0; i < boundary_.size(); ++i)
            if (!marked_[i])
                report(boundary_[i], fmt::format("boundary edge {} is in no marker", edge_text(boundary_[i])));
    }

private:
    std::span<const Point> points_;
    const std::vector<Segment>& boundary_;
    DefectList& defects_;
    std::vector<std::uint8_t> marked_;  ///< of boundary_

    static Segment reversed(const Segment& edge) { return {edge.b, edge.a}; }
    void report(const Segment& edge, const std::string& description) {
        defects_.add([&] { return MeshDefect{description, points_[edge.a.index()]}; });
    }
};

}  // namespace

void check_markers(std::span<const Point> points, std::span<const Marker> markers, const std::vector<Segment>& boundary,
                   DefectList& defects) {
    MarkerCheck checker(points, boundary, defects);
    for (std::size_t i = 0; i < markers.size(); ++i) {
        checker.check_name(markers[i], markers.first(i));
        if (markers[i].kind == MarkerKind::internal)
            checker.check_internal(markers[i]);
        else
            checker.check_on_boundary(markers[i]);
    }
    checker.check_all_marked();
    const PeriodicSearch periodic = find_periodic_pair(points, markers);
    if (const auto& mismatch = periodic.mismatch)
        defects.add([&] { return MeshDefect{mismatch->reason, mismatch->at}; });
}

}  // namespace lamina::mesh
