// The check of a whole mesh from the findings of its pieces: check_mesh() for meshes that nobody holds as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "mesh/boundary_edges.hpp"
#include "mesh/piece_check.hpp"

namespace lamina::mesh {

/// Collects the findings of the layer and of all pieces, and completes the check with what only they tell together: that
/// the pieces fit along their borders and that the boundary encloses the domain once.
class PiecewiseCheck {
public:
    /// `shared_points` are the vertices of the layer and those on the borders of pieces, by their ids in the mesh; they
    /// must outlive this object. Throws OptionError for options out of range.
    LAMINA_EXPORT PiecewiseCheck(std::span<const Point> shared_points, MeshCheckOptions options);

    /// Checks the cells of the layer, all of Region::layer, as check_mesh() does. The points of this mesh are the first
    /// of the shared ones. The constraints are those of finish().
    LAMINA_EXPORT void add_layer(const Mesh& layer, std::span<const Segment> constraints);
    /// Adds the findings of the next piece. Sums depend on the order of the pieces in their last bits.
    LAMINA_EXPORT void add_piece(PieceFindings findings);

    /// A border edge behind which finish() needs the area of the triangle, or all of it.
    struct Wanted {
        std::size_t border_edge = 0;  ///< the edges of all pieces are numbered in the order in which they were added
        bool apex = false;            ///< whether the area alone will not do
    };
    /// Returns what finish() needs beyond the findings of other processes, in ascending order. Where these hold the
    /// pieces, findings come with unknown_apex and with shape classes behind border edges. It is little: no angle is obtuse on either side
    /// of most edges, and the ratio of the areas is so small that it changes neither the largest one nor the 99.9th
    /// percentile.
    LAMINA_EXPORT std::vector<Wanted> wanted();
    /// Say what lies behind a border edge: everything, or the area of a triangle whose apex is not wanted.
    LAMINA_EXPORT void set_apex(std::size_t border_edge, Point apex);
    LAMINA_EXPORT void set_area(std::size_t border_edge, double area);

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
    struct LayerEdge {
        BoundaryEdge edge;
        double area = 0;  ///< of the cell
    };
    /// The borders of the layer and of all pieces: first the edges of the layer, then those of the pieces.
    struct Seams {
        std::vector<Segment> edges;
        EdgePairs pairs;
    };
    const Seams& match_seams();
    bool is_known(std::size_t seam_edge) const;
    double area_behind(std::size_t seam_edge) const;
    double even_ratio(const Seams& seams) const;
    /// Frees the memory that grows with the borders.
    void forget_borders();
    /// Reports the shared vertices of no cell, and returns their number.
    std::size_t report_orphans(DefectList& defects) const;
    void measure_across(const Seams& seams, std::span<const Segment> constraints);
    void subtract_constraints(const Seams& seams, std::span<const Segment> constraints, DefectList& defects);
    void find_unexcused(const Seams& seams, std::span<const std::size_t> first_triangle);

    std::optional<Seams> seams_;  ///< once they are matched
    std::span<const Point> shared_points_;
    MeshCheckOptions options_;
    CellsSummary layer_, pieces_;
    std::size_t cells_ = 0, vertices_ = 0, inner_edges_ = 0;
    std::vector<LayerEdge> layer_edges_;             ///< edges that one cell of the layer alone has
    std::vector<std::uint8_t> used_;                 ///< per shared point: whether a cell has it
    std::vector<bool> is_layer_constraint_;          ///< per constraint: whether it is an edge of a cell of the layer
    std::vector<Segment> border_;                    ///< of all pieces, one after the other
    std::vector<Point> apexes_;                      ///< of the triangles behind these edges
    std::vector<std::uint8_t> shape_classes_;        ///< of these triangles
    std::unordered_map<std::size_t, double> areas_;  ///< behind border edges whose apex is not known
    std::vector<NarrowTriangle> candidates_;
    std::vector<std::size_t> first_candidate_;  ///< per piece
    std::vector<NarrowTriangle> unexcused_;
    WorstCell widest_, narrowest_;
};

}  // namespace lamina::mesh
