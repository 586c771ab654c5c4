#include "mesh/seams.hpp"

#include <cmath>
#include <utility>

namespace lamina::mesh {

void Seams::expect(std::size_t border_edges) {
    border_.reserve(border_edges);
    apexes_.reserve(border_edges);
    shape_classes_.reserve(border_edges);
}

void Seams::add_layer_edge(Segment ends, double area, double height) {
    edges_of_layer_.push_back(ends);
    areas_in_layer_.push_back(area);
    heights_in_layer_.push_back(height);
}

void Seams::add(std::span<const PieceBorderEdge> border) {
    for (const PieceBorderEdge& edge : border) {
        border_.push_back({edge.a, edge.b});
        apexes_.push_back(edge.apex);
        shape_classes_.push_back(edge.shape_class);
    }
}

void Seams::match() {
    if (matched_) return;
    matched_ = true;
    if (edges_of_layer_.empty()) {
        edges_ = std::move(border_);
    } else {
        edges_ = std::move(edges_of_layer_);
        edges_.insert(edges_.end(), border_.begin(), border_.end());
    }
    border_ = {};
    pairs_ = pair_edges(edges_);
}

bool Seams::is_known(std::size_t edge) const {
    return edge < layer_edges() || !std::isnan(apexes_[edge - layer_edges()].x);
}

double Seams::area_behind(std::size_t edge) const {
    const std::size_t border_edge = edge - layer_edges();
    if (const auto told = areas_.find(border_edge); told != areas_.end()) return told->second;
    if (!is_known(edge)) return unknown_apex.x;
    const Segment ends = edges_[edge];
    return area_over(points_[ends.a.index()], points_[ends.b.index()], apexes_[border_edge]);
}

std::vector<double> Seams::least_ratios() const {
    std::vector<double> ratios;
    const std::size_t first = layer_edges();
    for (std::size_t e = first; e < edges_.size(); ++e)
        if (const std::uint32_t twin = pairs_.twin[e]; twin != no_edge && twin > e)
            ratios.push_back(least_area_ratio(shape_classes_[e - first], shape_classes_[twin - first]));
    return ratios;
}

std::vector<Seams::Wanted> Seams::wanted(double even_ratio) const {
    std::vector<Wanted> wanted;
    const std::size_t first = layer_edges();
    for (std::size_t e = first; e < edges_.size(); ++e) {
        const std::uint32_t twin = pairs_.twin[e];
        if (twin == no_edge || is_known(e)) continue;
        const double bound =
            twin < first ? 0 : largest_area_ratio(shape_classes_[e - first], shape_classes_[twin - first]);
        if (twin < first || bound > even_ratio) wanted.push_back({e - first, std::isinf(bound)});
    }
    return wanted;
}

bool Seams::violates(std::size_t edge, std::size_t twin) const {
    const Segment ends = edges_[edge];
    return is_strictly_in_circle(points_[ends.a.index()], points_[ends.b.index()], apexes_[edge - layer_edges()],
                                 apexes_[twin - layer_edges()]);
}

SeamMeasures Seams::measure(const std::function<bool(Segment)>& is_constraint) const {
    SeamMeasures measures;
    std::size_t even = 0;
    // Edges of the layer have the lower numbers, and none has its twin in the layer.
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const std::uint32_t twin = pairs_.twin[e];
        if (twin == no_edge || twin < e || twin < layer_edges()) continue;
        if (e < layer_edges()) {
            const double area = area_behind(twin);
            const Point a = points_[edges_[e].a.index()], b = points_[edges_[e].b.index()];
            measures.transition.push_back(
                {areas_in_layer_[e] / area, 2 * area / (distance(a, b) * heights_in_layer_[e])});
            measures.of_layer.add_to_largest_ratio(areas_in_layer_[e], area, a, b);
            continue;
        }
        ++measures.delaunay.edges;
        const double area = area_behind(e), other_area = area_behind(twin);
        if (std::isnan(area) || std::isnan(other_area)) {
            ++even;
            continue;
        }
        measures.ratios.add_neighbours(area, other_area);
        // Where an area alone is known, the edge is Delaunay.
        if (is_known(e) && is_known(twin) && violates(e, twin) && !is_constraint(edges_[e]))
            ++measures.delaunay.violations;
    }
    measures.ratios.add_even_neighbours(even);
    return measures;
}

void SeamFindings::add(const SeamFindings& other) {
    edges += other.edges;
    vertices += other.vertices;
    measures.delaunay.edges += other.measures.delaunay.edges;
    measures.delaunay.violations += other.measures.delaunay.violations;
    measures.ratios.append(other.measures.ratios);
    outer_edges += other.outer_edges;
    one_sided.insert(one_sided.end(), other.one_sided.begin(), other.one_sided.end());
    overused.insert(overused.end(), other.overused.begin(), other.overused.end());
}

}  // namespace lamina::mesh
