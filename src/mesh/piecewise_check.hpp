// The check of a whole mesh from the findings of its pieces: check_mesh() for meshes that nobody holds as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "core/exact_sum.hpp"
#include "mesh/boundary_edges.hpp"
#include "mesh/expected_boundary.hpp"
#include "mesh/piece_check.hpp"
#include "mesh/seams.hpp"

namespace lamina::mesh {

/// Collects the findings of the layer and of all pieces, and completes the check with what only they tell together:
/// that the pieces fit along their borders and that the boundary encloses the domain once.
class PiecewiseCheck {
public:
    /// `shared_points` are the vertices of the layer and those on the borders of pieces, by their ids in the mesh; they
    /// must outlive this object. Other processes match the edges that end at one from `elsewhere` on, where it is
    /// given: add_seams() takes what they have found, once for each, and the borders of pieces that are added hold none
    /// of these edges and vertices. Throws OptionError for options out of range.
    LAMINA_EXPORT PiecewiseCheck(std::span<const Point> shared_points, MeshCheckOptions options,
                                 std::optional<VertexId> elsewhere = {});

    /// Checks the cells of the layer, all of Region::layer, as check_mesh() does. The points of this mesh are the first
    /// of the shared ones. The constraints are those of finish().
    LAMINA_EXPORT void add_layer(const Mesh& layer, std::span<const Segment> constraints);
    /// Adds the findings of the next piece. No number depends on the order of the pieces.
    LAMINA_EXPORT void add_piece(PieceFindings findings);

    /// Adds what another process has found.
    LAMINA_EXPORT void add_seams(const SeamFindings& findings);
    /// Says which edges other processes expect on the boundary, and checks the boundary that these markers describe.
    /// That leaves less to do for finish(), which gets the same markers.
    LAMINA_EXPORT void expect_boundary(std::span<const Marker> markers, std::vector<Segment> outer);

    using Wanted = Seams::Wanted;
    /// Returns what finish() needs beyond findings with unknown_apex, whose pieces other processes hold, in ascending
    /// order. The edges of all pieces are numbered in the order in which they were added.
    LAMINA_EXPORT std::vector<Wanted> wanted();
    /// Returns what wanted() returns, where the edges here are some of all, and ratios of areas up to this one need not
    /// be known.
    LAMINA_EXPORT std::vector<Wanted> wanted(double even_ratio);
    /// Returns the ratios of areas in all pieces, and the least ones between pieces, on both sides of these edges.
    LAMINA_EXPORT QualityCollector least_ratios();
    /// Say what lies behind a border edge: everything, or the area of a triangle whose apex is not wanted.
    LAMINA_EXPORT void set_apex(std::size_t border_edge, Point apex) { seams_.set_apex(border_edge, apex); }
    LAMINA_EXPORT void set_area(std::size_t border_edge, double area) { seams_.set_area(border_edge, area); }

    /// Returns the check of the mesh, with MeshCheck::unexcused_cells numbered by `first_triangle`, which has one entry
    /// for each piece in the order in which they were added. Constraints are as in Mesh::constraints, each once. May be
    /// called once.
    LAMINA_EXPORT MeshCheck finish(std::span<const Marker> markers, std::span<const Segment> constraints,
                                   std::span<const std::size_t> first_triangle);

    /// The worst triangles of all pieces, and those that MeshCheck::unexcused_cells numbers, known after finish().
    WorstCell widest() const { return widest_; }
    WorstCell narrowest() const { return narrowest_; }
    const std::vector<NarrowTriangle>& unexcused() const { return unexcused_; }

private:
    /// Frees the memory that grows with the borders.
    void forget_borders();
    /// Reports the shared vertices of no cell, and returns their number.
    std::size_t report_orphans(DefectList& defects) const;
    void report_overused(DefectList& defects) const;
    void measure_across(std::span<const Segment> constraints);
    void subtract_constraints(std::span<const Segment> constraints, DefectList& defects);
    void find_unexcused(std::span<const std::size_t> first_triangle);
    /// Checks the boundary once all else is known.
    void check_boundary_of_all(std::span<const Marker> markers, MeshCheck& check, DefectList& defects) const;

    std::span<const Point> shared_points_;
    MeshCheckOptions options_;
    CellsSummary layer_, pieces_;
    std::size_t cells_ = 0, vertices_ = 0, inner_edges_ = 0;
    core::ExactSum area_, min_angles_, max_angles_, mean_ratios_;  ///< over all pieces
    std::optional<ExpectedBoundary> expected_;
    Seams seams_;
    std::vector<BoundaryEdge> layer_edges_;  ///< edges that one cell of the layer alone has
    std::vector<std::uint8_t> used_;         ///< per shared point that is not matched elsewhere: whether a cell has it
    std::vector<bool> is_layer_constraint_;  ///< per constraint: whether it is an edge of a cell of the layer
    SeamFindings elsewhere_;                 ///< all that add_seams() has taken
    std::vector<NarrowTriangle> candidates_;
    std::vector<std::size_t> first_candidate_;  ///< per piece
    std::vector<NarrowTriangle> unexcused_;
    WorstCell widest_, narrowest_;
};

}  // namespace lamina::mesh
