#include <lamina/mesh.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/base.hpp"

namespace lamina {

namespace {

/// The edges of the base, taken out of the marker. Its edges run clockwise round the body, or in reverse order: edge i
/// joins vertices i and i + 1 of the counter-clockwise outline.
std::vector<Segment> take_base(const Mesh& mesh, Marker& marker) {
    std::vector<Segment>& edges = marker.edges;
    const std::size_t n = edges.size();
    std::vector<Point> outline;
    for (std::size_t i = 0; i < n; ++i) {
        if (edges[i].a != edges[(i + 1) % n].b) return {};
        outline.push_back(mesh.points[edges[i].b.index()]);
    }
    const std::optional<Base> base = n < 4 ? std::nullopt : find_base(outline);
    if (!base) return {};
    std::vector<Segment> taken, kept;
    const std::size_t length = (base->last + n - base->first) % n;
    for (std::size_t i = 0; i < n; ++i) ((i + n - base->first) % n < length ? taken : kept).push_back(edges[i]);
    // A base round the end of the list stays in one piece.
    std::rotate(taken.begin(),
                std::find_if(taken.begin(), taken.end(), [&](const Segment& e) { return e == edges[base->first]; }),
                taken.end());
    edges = std::move(kept);
    return taken;
}

}  // namespace

std::size_t add_base_markers(Mesh& mesh) {
    std::vector<Marker> markers;
    std::size_t bases = 0;
    for (Marker& marker : mesh.markers) {
        std::vector<Segment> base;
        if (marker.kind == MarkerKind::wall) base = take_base(mesh, marker);
        Marker own{marker.name + "_base", MarkerKind::wall, std::move(base)};
        markers.push_back(std::move(marker));
        if (own.edges.empty()) continue;
        markers.push_back(std::move(own));
        ++bases;
    }
    mesh.markers = std::move(markers);
    return bases;
}

}  // namespace lamina
