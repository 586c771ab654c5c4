#include "mesh/piecewise_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <lamina/error.hpp>

#include "mesh/cell_text.hpp"
#include "mesh/check_arrays.hpp"
#include "mesh/check_boundary.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/sharp_corners.hpp"

namespace lamina::mesh {

namespace {

/// A triangle on the left of an edge.
struct EdgeTriangle {
    Point a, b, apex;
};

bool violates(const EdgeTriangle& one, const EdgeTriangle& other) {
    return is_strictly_in_circle(one.a, one.b, one.apex, other.apex);
}

/// Returns the place of the edge among the constraints, which are sorted with their smaller vertices first, each once.
std::span<const Segment>::iterator find_constraint(std::span<const Segment> constraints, Segment edge) {
    const auto [a, b] = std::minmax(edge.a, edge.b);
    const auto at = std::lower_bound(constraints.begin(), constraints.end(), Segment{a, b});
    return at != constraints.end() && *at == Segment{a, b} ? at : constraints.end();
}

/// Calls f(v) for the vertices of all cells.
template <class F>
void for_vertices_of_cells(const Mesh& mesh, F&& f) {
    for (const Triangle& t : mesh.triangles)
        for (const VertexId v : t.v) f(v);
    for (const Quad& q : mesh.quads)
        for (const VertexId v : q.v) f(v);
}

}  // namespace

PiecewiseCheck::PiecewiseCheck(std::span<const Point> shared_points, MeshCheckOptions options)
    : shared_points_(shared_points),
      options_(std::move(options)),
      layer_(options_.min_angle_deg),
      pieces_(options_.min_angle_deg),
      used_(shared_points.size(), 0) {
    validate(options_);
}

void PiecewiseCheck::add_layer(const Mesh& layer, std::span<const Segment> constraints) {
    check_arrays(layer, layer_.defects);
    if (!layer_.defects.empty()) return;
    CheckedCells checked = check_cells(layer, options_.min_angle_deg);
    layer_.append(std::move(checked.summary));
    const CellEdges edges(layer);
    for (const std::uint32_t e : checked.edges.overused)
        layer_.defects.add([&] {
            return MeshDefect{fmt::format("{} of the layer shares an edge with more than one cell or with one on the "
                                          "same side",
                                          cell_text(layer, edges.cell_of(e))),
                              layer.points[edges.origin(e).index()]};
        });
    for_vertices_of_cells(layer, [&](VertexId v) { used_[v.index()] = 1; });
    cells_ += edges.cells();
    inner_edges_ += checked.edges.edges - checked.edges.boundary.size();
    const std::vector<BoundaryEdge> boundary = find_boundary_edges(layer, checked.edges.boundary);
    for (std::size_t i = 0; i < boundary.size(); ++i)
        layer_edges_.push_back({boundary[i], area_of(layer, edges, edges.cell_of(checked.edges.boundary[i]))});
    is_layer_constraint_.clear();
    for (const std::uint32_t e : find_edges(layer, constraints)) is_layer_constraint_.push_back(e != no_edge);
}

void PiecewiseCheck::add_piece(PieceFindings findings) {
    cells_ += findings.triangles;
    vertices_ += findings.inner_vertices;
    inner_edges_ += findings.inner_edges;
    for (const PieceBorderEdge& edge : findings.border) {
        border_.push_back({edge.a, edge.b});
        apexes_.push_back(edge.apex);
        shape_classes_.push_back(edge.shape_class);
    }
    if (findings.cells.defects.empty())
        for (const VertexId v : findings.border_vertices) used_[v.index()] = 1;
    first_candidate_.push_back(candidates_.size());
    candidates_.insert(candidates_.end(), findings.narrow.begin(), findings.narrow.end());
    findings.cells.narrow.clear();
    if (findings.widest.badness > widest_.badness) widest_ = findings.widest;
    if (findings.narrowest.badness > narrowest_.badness) narrowest_ = findings.narrowest;
    pieces_.append(std::move(findings.cells));
}

MeshCheck PiecewiseCheck::finish(std::span<const Marker> markers, std::span<const Segment> constraints,
                                 std::span<const std::size_t> first_triangle) {
    if (!options_.first_heights.empty() && options_.first_heights.size() != markers.size())
        throw OptionError("first_heights", "need one entry per marker");
    MeshCheck check;
    DefectList defects = std::move(layer_.defects);
    defects.append(std::move(pieces_.defects));
    const auto finished = [&] {
        check.defects = std::move(defects.kept);
        check.defect_count = defects.count;
        return std::move(check);
    };
    if (cells_ == 0) defects.add([] { return MeshDefect{"no cells", {}}; });
    if (!defects.empty()) return finished();

    const Seams& seams = match_seams();
    for (const std::uint32_t e : seams.pairs.overused)
        defects.add([&] {
            return MeshDefect{
                fmt::format("more than two cells, or two on one side, share the edge {}", edge_text(seams.edges[e])),
                shared_points_[seams.edges[e].a.index()]};
        });
    const std::size_t orphans = report_orphans(defects);
    check.area = layer_.area + pieces_.area;
    check.euler_characteristic = static_cast<long>(shared_points_.size() - orphans + vertices_) -
                                 static_cast<long>(inner_edges_ + seams.pairs.edges) + static_cast<long>(cells_);
    measure_across(seams, constraints);
    subtract_constraints(seams, constraints, defects);
    check.interior_edges = pieces_.delaunay.edges;
    check.delaunay_violations = pieces_.delaunay.violations;
    check.transition = summarize_transition(std::move(pieces_.transition));
    check.layer = layer_.layer.summary();
    check.isotropic = pieces_.isotropic.summary();
    find_unexcused(seams, first_triangle);
    for (const NarrowTriangle& narrow : unexcused_)
        check.unexcused_cells.push_back(static_cast<std::uint32_t>(narrow.cell));
    check.isotropic.exempt = check.isotropic.angles_below_bound - unexcused_.size();

    std::vector<BoundaryEdge> boundary;
    for (const std::uint32_t e : seams.pairs.boundary)
        boundary.push_back(e < layer_edges_.size() ? layer_edges_[e].edge : BoundaryEdge{seams.edges[e]});
    check_whole_boundary(shared_points_, markers, boundary, seams.pairs.overused.empty(), options_, check, defects);
    forget_borders();
    return finished();
}

void PiecewiseCheck::forget_borders() {
    seams_.reset();
    layer_edges_ = {};
    border_ = {};
    apexes_ = {};
    shape_classes_ = {};
    areas_ = {};
    candidates_ = {};
}

const PiecewiseCheck::Seams& PiecewiseCheck::match_seams() {
    if (seams_) return *seams_;
    seams_.emplace();
    seams_->edges.reserve(layer_edges_.size() + border_.size());
    for (const LayerEdge& edge : layer_edges_) seams_->edges.push_back(edge.edge.ends);
    seams_->edges.insert(seams_->edges.end(), border_.begin(), border_.end());
    seams_->pairs = pair_edges(seams_->edges);
    return *seams_;
}

/// Returns a ratio of areas that the 99.9th percentile reaches at least: smaller ones need not be known.
double PiecewiseCheck::even_ratio(const Seams& seams) const {
    constexpr double share = 0.00101;
    const std::size_t first = layer_edges_.size();
    QualityCollector ratios = pieces_.isotropic;
    std::vector<double> at_least;
    for (std::size_t e = first; e < seams.edges.size(); ++e)
        if (const std::uint32_t twin = seams.pairs.twin[e]; twin != no_edge && twin > e)
            at_least.push_back(least_area_ratio(shape_classes_[e - first], shape_classes_[twin - first]));
    ratios.add_area_ratios(at_least);
    return ratios.area_ratio_exceeded_by(share);
}

void PiecewiseCheck::set_apex(std::size_t border_edge, Point apex) { apexes_[border_edge] = apex; }

void PiecewiseCheck::set_area(std::size_t border_edge, double area) { areas_[border_edge] = area; }

bool PiecewiseCheck::is_known(std::size_t seam_edge) const {
    return seam_edge < layer_edges_.size() || !std::isnan(apexes_[seam_edge - layer_edges_.size()].x);
}

double PiecewiseCheck::area_behind(std::size_t seam_edge) const {
    const std::size_t border_edge = seam_edge - layer_edges_.size();
    if (const auto told = areas_.find(border_edge); told != areas_.end()) return told->second;
    const Segment ends = border_[border_edge];
    return area_over(shared_points_[ends.a.index()], shared_points_[ends.b.index()], apexes_[border_edge]);
}

std::vector<PiecewiseCheck::Wanted> PiecewiseCheck::wanted() {
    std::vector<Wanted> wanted;
    const Seams& seams = match_seams();
    const double ratio = even_ratio(seams);
    const std::size_t first = layer_edges_.size();
    for (std::size_t e = first; e < seams.edges.size(); ++e) {
        const std::uint32_t twin = seams.pairs.twin[e];
        if (twin == no_edge || is_known(e)) continue;
        const double bound =
            twin < first ? 0 : largest_area_ratio(shape_classes_[e - first], shape_classes_[twin - first]);
        if (twin < first || bound > ratio) wanted.push_back({e - first, std::isinf(bound)});
    }
    return wanted;
}

std::size_t PiecewiseCheck::report_orphans(DefectList& defects) const {
    std::size_t orphans = 0;
    for (std::size_t v = 0; v < used_.size(); ++v) {
        if (used_[v]) continue;
        ++orphans;
        defects.add([&] { return MeshDefect{fmt::format("vertex {} belongs to no cell", v), shared_points_[v]}; });
    }
    return orphans;
}

void PiecewiseCheck::measure_across(const Seams& seams, std::span<const Segment> constraints) {
    const auto triangle = [&](std::size_t e) {
        return EdgeTriangle{shared_points_[seams.edges[e].a.index()], shared_points_[seams.edges[e].b.index()],
                            apexes_[e - layer_edges_.size()]};
    };
    std::size_t even = 0;
    // Edges of the layer have the lower numbers, and none has its twin in the layer.
    for (std::size_t e = 0; e < seams.edges.size(); ++e) {
        const std::uint32_t twin = seams.pairs.twin[e];
        if (twin == no_edge || twin < e || twin < layer_edges_.size()) continue;
        if (e < layer_edges_.size()) {
            pieces_.transition.push_back(layer_edges_[e].area / area_behind(twin));
            continue;
        }
        ++pieces_.delaunay.edges;
        const double area = area_behind(e), other_area = area_behind(twin);
        if (std::isnan(area) || std::isnan(other_area)) {
            ++even;
            continue;
        }
        pieces_.isotropic.add_neighbours(area, other_area);
        // Where an area alone is known, the edge is Delaunay.
        if (is_known(e) && is_known(twin) && violates(triangle(e), triangle(twin)) &&
            find_constraint(constraints, seams.edges[e]) == constraints.end())
            ++pieces_.delaunay.violations;
    }
    pieces_.isotropic.add_even_neighbours(even);
}

void PiecewiseCheck::subtract_constraints(const Seams& seams, std::span<const Segment> constraints,
                                          DefectList& defects) {
    std::vector<bool> found(constraints.size(), false);
    for (std::size_t i = 0; i < std::min(constraints.size(), is_layer_constraint_.size()); ++i)
        found[i] = is_layer_constraint_[i];
    // Constraints are edges of the layer, whose vertices have the lowest numbers: most edges need no search.
    VertexId last{std::size_t{0}};
    for (const Segment& constraint : constraints) last = std::max(last, constraint.b);
    for (std::size_t e = 0; e < seams.edges.size(); ++e) {
        if (last < std::max(seams.edges[e].a, seams.edges[e].b)) continue;
        const auto at = find_constraint(constraints, seams.edges[e]);
        if (at == constraints.end()) continue;
        found[static_cast<std::size_t>(at - constraints.begin())] = true;
        const std::uint32_t twin = seams.pairs.twin[e];
        if (e >= layer_edges_.size() && twin != no_edge && twin >= e) --pieces_.delaunay.edges;
    }
    for (std::size_t i = 0; i < constraints.size(); ++i)
        if (!found[i])
            defects.add([&] {
                return MeshDefect{fmt::format("constraint {} is no edge of the mesh", edge_text(constraints[i])),
                                  shared_points_[constraints[i].a.index()]};
            });
}

void PiecewiseCheck::find_unexcused(const Seams& seams, std::span<const std::size_t> first_triangle) {
    if (candidates_.empty()) return;
    // The outline of the isotropic region: borders of pieces on the boundary and on the layer.
    std::vector<Segment> outline_edges;
    for (std::size_t e = layer_edges_.size(); e < seams.edges.size(); ++e)
        if (const std::uint32_t twin = seams.pairs.twin[e]; twin == no_edge || twin < layer_edges_.size())
            outline_edges.push_back(seams.edges[e]);
    const Outline outline(shared_points_, std::move(outline_edges));
    std::size_t piece = 0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        while (piece + 1 < first_candidate_.size() && first_candidate_[piece + 1] <= i) ++piece;
        const NarrowTriangle& candidate = candidates_[i];
        if (candidate.shortest && outline.is_spanned(candidate.shortest->a, candidate.shortest->b)) continue;
        unexcused_.push_back(candidate);
        unexcused_.back().cell += first_triangle[piece];
    }
    std::sort(unexcused_.begin(), unexcused_.end(),
              [](const NarrowTriangle& a, const NarrowTriangle& b) { return a.cell < b.cell; });
}

}  // namespace lamina::mesh
