#include "mesh/piecewise_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <lamina/error.hpp>

#include "mesh/cell_text.hpp"
#include "mesh/check_arrays.hpp"
#include "mesh/check_boundary.hpp"
#include "mesh/sharp_corners.hpp"

namespace lamina::mesh {

namespace {

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

PiecewiseCheck::PiecewiseCheck(std::span<const Point> shared_points, MeshCheckOptions options,
                               std::optional<VertexId> elsewhere)
    : shared_points_(shared_points),
      options_(std::move(options)),
      layer_(options_.min_angle_deg),
      pieces_(options_.min_angle_deg),
      seams_(shared_points),
      used_(elsewhere ? elsewhere->index() : shared_points.size(), 0) {
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
    layer_edges_ = find_boundary_edges(layer, checked.edges.boundary);
    for (std::size_t i = 0; i < layer_edges_.size(); ++i) {
        const std::uint32_t edge = checked.edges.boundary[i];
        seams_.add_layer_edge(layer_edges_[i].ends, area_of(layer, edges, edges.cell_of(edge)),
                              height_over(layer, edges, edge));
    }
    is_layer_constraint_.clear();
    for (const std::uint32_t e : find_edges(layer, constraints)) is_layer_constraint_.push_back(e != no_edge);
}

void PiecewiseCheck::add_piece(PieceFindings findings) {
    cells_ += findings.triangles;
    vertices_ += findings.inner_vertices;
    inner_edges_ += findings.inner_edges;
    seams_.add(findings.border);
    if (findings.cells.defects.empty())
        for (const VertexId v : findings.border_vertices) used_[v.index()] = 1;
    first_candidate_.push_back(candidates_.size());
    candidates_.insert(candidates_.end(), findings.narrow.begin(), findings.narrow.end());
    findings.cells.narrow.clear();
    if (findings.widest.badness > widest_.badness) widest_ = findings.widest;
    if (findings.narrowest.badness > narrowest_.badness) narrowest_ = findings.narrowest;
    const QualityTotals& shapes = findings.cells.isotropic.totals();
    area_.add(findings.cells.area);
    min_angles_.add(shapes.min_angle_sum);
    max_angles_.add(shapes.max_angle_sum);
    mean_ratios_.add(shapes.mean_ratio_sum);
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

    seams_.match();
    report_overused(defects);
    const std::size_t orphans = report_orphans(defects);
    pieces_.area = area_.value();
    pieces_.isotropic.set_sums(min_angles_.value(), max_angles_.value(), mean_ratios_.value());
    check.area = layer_.area + pieces_.area;
    check.euler_characteristic = static_cast<long>(shared_points_.size() - orphans + vertices_) -
                                 static_cast<long>(inner_edges_ + seams_.pairs().edges + elsewhere_.edges) +
                                 static_cast<long>(cells_);
    measure_across(constraints);
    subtract_constraints(constraints, defects);
    check.interior_edges = pieces_.delaunay.edges;
    check.delaunay_violations = pieces_.delaunay.violations;
    check.transition = summarize_transition(pieces_.transition);
    check.layer = layer_.layer.summary();
    check.isotropic = pieces_.isotropic.summary();
    find_unexcused(first_triangle);
    for (const NarrowTriangle& narrow : unexcused_)
        check.unexcused_cells.push_back(static_cast<std::uint32_t>(narrow.cell));
    check.isotropic.exempt = check.isotropic.angles_below_bound - unexcused_.size();

    check_boundary_of_all(markers, check, defects);
    forget_borders();
    return finished();
}

void PiecewiseCheck::check_boundary_of_all(std::span<const Marker> markers, MeshCheck& check,
                                           DefectList& defects) const {
    std::vector<BoundaryEdge> boundary;
    for (const std::uint32_t e : seams_.pairs().boundary)
        boundary.push_back(e < layer_edges_.size() ? layer_edges_[e] : BoundaryEdge{seams_.edges()[e]});
    for (const Segment& edge : elsewhere_.one_sided) boundary.push_back({edge});
    const bool unique = seams_.pairs().overused.empty() && elsewhere_.overused.empty();
    if (expected_) {
        const std::vector<Segment>& outer = expected_->outer();
        const bool complete = elsewhere_.outer_edges == outer.size();
        const BoundarySummary* known = expected_->summary_with(sorted_ends(boundary));
        if (complete && unique && known != nullptr) {
            measure_boundary(shared_points_, markers, boundary, options_, check);
            return take_checked_boundary(*known, check, defects);
        }
        if (!complete)
            defects.add([&] {
                return MeshDefect{fmt::format("of {} outer edges, {} are edges of one piece alone", outer.size(),
                                              elsewhere_.outer_edges),
                                  {}};
            });
        for (const Segment& edge : outer) boundary.push_back({edge});
    }
    // The borders of pieces are closed. Those that other processes have told are so only if nothing was lost.
    const bool closed = is_closed(sorted_ends(boundary));
    if (!closed) defects.add([] { return MeshDefect{"the edges of one cell alone do not form loops", {}}; });
    measure_boundary(shared_points_, markers, boundary, options_, check);
    check_whole_boundary(shared_points_, markers, boundary, closed && unique, check, defects);
}

void PiecewiseCheck::forget_borders() {
    seams_ = Seams({});
    layer_edges_ = {};
    elsewhere_ = {};
    candidates_ = {};
    expected_.reset();
}

void PiecewiseCheck::expect_boundary(std::span<const Marker> markers, std::vector<Segment> outer) {
    expected_.emplace(shared_points_, markers, std::move(outer));
}

void PiecewiseCheck::add_seams(const SeamFindings& findings) {
    elsewhere_.add(findings);
    pieces_.delaunay.edges += findings.measures.delaunay.edges;
    pieces_.delaunay.violations += findings.measures.delaunay.violations;
    pieces_.isotropic.append(findings.measures.ratios);
}

QualityCollector PiecewiseCheck::least_ratios() {
    seams_.match();
    QualityCollector ratios = pieces_.isotropic;
    ratios.add_area_ratios(seams_.least_ratios());
    return ratios;
}

std::vector<PiecewiseCheck::Wanted> PiecewiseCheck::wanted() { return wanted(even_ratio(least_ratios())); }

std::vector<PiecewiseCheck::Wanted> PiecewiseCheck::wanted(double even_ratio) {
    seams_.match();
    return seams_.wanted(even_ratio);
}

void PiecewiseCheck::report_overused(DefectList& defects) const {
    const auto report = [&](Segment edge) {
        defects.add([&] {
            return MeshDefect{
                fmt::format("more than two cells, or two on one side, share the edge {}", edge_text(edge)),
                shared_points_[edge.a.index()]};
        });
    };
    for (const std::uint32_t e : seams_.pairs().overused) report(seams_.edges()[e]);
    for (const Segment& edge : elsewhere_.overused) report(edge);
}

std::size_t PiecewiseCheck::report_orphans(DefectList& defects) const {
    std::size_t orphans = 0;
    for (std::size_t v = 0; v < used_.size(); ++v) {
        if (used_[v]) continue;
        ++orphans;
        defects.add([&] { return MeshDefect{fmt::format("vertex {} belongs to no cell", v), shared_points_[v]}; });
    }
    const std::size_t others = shared_points_.size() - used_.size() - elsewhere_.vertices;
    if (others > 0)
        defects.add([&] {
            return MeshDefect{fmt::format("{} vertices between pieces belong to no cell", others), {}};
        });
    return orphans + others;
}

void PiecewiseCheck::measure_across(std::span<const Segment> constraints) {
    SeamMeasures measures =
        seams_.measure([&](Segment edge) { return find_constraint(constraints, edge) != constraints.end(); });
    pieces_.delaunay.edges += measures.delaunay.edges;
    pieces_.delaunay.violations += measures.delaunay.violations;
    pieces_.isotropic.append(measures.ratios);
    layer_.layer.append(measures.of_layer);
    pieces_.transition.insert(pieces_.transition.end(), measures.transition.begin(), measures.transition.end());
}

void PiecewiseCheck::subtract_constraints(std::span<const Segment> constraints, DefectList& defects) {
    std::vector<bool> found(constraints.size(), false);
    for (std::size_t i = 0; i < std::min(constraints.size(), is_layer_constraint_.size()); ++i)
        found[i] = is_layer_constraint_[i];
    // Constraints are edges of the layer, whose vertices have the lowest numbers: most edges need no search.
    VertexId last{std::size_t{0}};
    for (const Segment& constraint : constraints) last = std::max(last, constraint.b);
    for (std::size_t e = 0; e < seams_.edges().size(); ++e) {
        const Segment edge = seams_.edges()[e];
        if (last < std::max(edge.a, edge.b)) continue;
        const auto at = find_constraint(constraints, edge);
        if (at == constraints.end()) continue;
        found[static_cast<std::size_t>(at - constraints.begin())] = true;
        const std::uint32_t twin = seams_.pairs().twin[e];
        if (e >= layer_edges_.size() && twin != no_edge && twin >= e) --pieces_.delaunay.edges;
    }
    for (std::size_t i = 0; i < constraints.size(); ++i)
        if (!found[i])
            defects.add([&] {
                return MeshDefect{fmt::format("constraint {} is no edge of the mesh", edge_text(constraints[i])),
                                  shared_points_[constraints[i].a.index()]};
            });
}

void PiecewiseCheck::find_unexcused(std::span<const std::size_t> first_triangle) {
    if (candidates_.empty()) return;
    // The outline of the isotropic region: borders of pieces on the boundary and on the layer.
    std::vector<Segment> outline_edges = elsewhere_.one_sided;
    if (expected_) outline_edges.insert(outline_edges.end(), expected_->outer().begin(), expected_->outer().end());
    for (std::size_t e = layer_edges_.size(); e < seams_.edges().size(); ++e)
        if (const std::uint32_t twin = seams_.pairs().twin[e]; twin == no_edge || twin < layer_edges_.size())
            outline_edges.push_back(seams_.edges()[e]);
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
