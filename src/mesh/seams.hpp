// The edges between pieces, and between pieces and the layer: which of them fit together, and what the triangles on
// both sides are like. One process may have all of them, or some.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/check_cells.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/piece_check.hpp"
#include "mesh/quality.hpp"

namespace lamina::mesh {

/// The numbers that pairs of edges which fit together add to the check of a mesh.
struct SeamMeasures {
    DelaunayCount delaunay;                      ///< of the edges between two pieces
    QualityCollector ratios{0};                  ///< of the areas on both sides of these
    std::vector<TransitionRatios> transition{};  ///< for each edge between the layer and a piece
    QualityCollector of_layer{0};                ///< the largest ratio of areas at these
};

/// Returns a ratio of areas that the 99.9th percentile reaches at least, from the least ratios that are possible:
/// smaller ones need not be known.
inline double even_ratio(const QualityCollector& least_ratios) { return least_ratios.area_ratio_exceeded_by(0.00101); }

/// Pairs the edges of borders, first those of the layer and then those of pieces, which are numbered in this order.
class Seams {
public:
    /// `points` holds the ends of all edges that are added, by their ids; it must outlive this object.
    LAMINA_EXPORT explicit Seams(std::span<const Point> points) : points_(points) {}

    /// Makes room for so many edges of pieces.
    LAMINA_EXPORT void expect(std::size_t border_edges);
    /// Adds an edge of one cell of the layer, which has this area, and this height over the edge.
    LAMINA_EXPORT void add_layer_edge(Segment ends, double area, double height);
    /// Adds the border of a piece.
    LAMINA_EXPORT void add(std::span<const PieceBorderEdge> border);

    std::size_t layer_edges() const { return areas_in_layer_.size(); }

    /// Finds the pairs. Call it once all edges are there, and before the functions below. Calls after the first do
    /// nothing.
    LAMINA_EXPORT void match();
    std::span<const Segment> edges() const { return edges_; }
    const EdgePairs& pairs() const { return pairs_; }

    /// An edge of a piece behind which measure() needs the area of the triangle, or all of it.
    struct Wanted {
        std::size_t border_edge = 0;  ///< its number less that of the edges of the layer
        bool apex = false;            ///< whether the area alone will not do
    };
    /// Returns ratios that those of the areas on both sides reach at least, one for each edge between two pieces.
    LAMINA_EXPORT std::vector<double> least_ratios() const;
    /// Returns what measure() needs of edges that came with unknown_apex and with shape classes, in ascending order.
    /// Ratios of areas up to `even_ratio` need not be known. It is little: no angle is obtuse on either side of most
    /// edges.
    LAMINA_EXPORT std::vector<Wanted> wanted(double even_ratio) const;
    /// Say what lies behind an edge of a piece: everything, or the area of a triangle whose apex is not wanted.
    LAMINA_EXPORT void set_apex(std::size_t border_edge, Point apex) { apexes_[border_edge] = apex; }
    LAMINA_EXPORT void set_area(std::size_t border_edge, double area) { areas_[border_edge] = area; }

    /// Measures all pairs. Edges that are constraints violate nothing.
    LAMINA_EXPORT SeamMeasures measure(const std::function<bool(Segment)>& is_constraint) const;

private:
    bool is_known(std::size_t edge) const;
    double area_behind(std::size_t edge) const;
    bool violates(std::size_t edge, std::size_t twin) const;

    std::span<const Point> points_;
    std::vector<Segment> edges_of_layer_, border_;  ///< until they are matched
    std::vector<Segment> edges_;                    ///< all of them, from then on
    std::vector<double> areas_in_layer_, heights_in_layer_;
    std::vector<Point> apexes_;                      ///< of the triangles behind the edges of pieces
    std::vector<std::uint8_t> shape_classes_;        ///< of these triangles
    std::unordered_map<std::size_t, double> areas_;  ///< behind edges of pieces whose apex is not known
    EdgePairs pairs_;
    bool matched_ = false;
};

/// The findings of one process about the seams that it has matched for all. The edges of the layer are not among them.
struct SeamFindings {
    std::size_t edges = 0;     ///< each once, whether it has two sides or one
    std::size_t vertices = 0;  ///< those of its vertices that some piece has
    SeamMeasures measures;
    std::size_t outer_edges = 0;     ///< those of one piece alone that are expected to be on the boundary
    std::vector<Segment> one_sided;  ///< all others of one piece alone, directed as this piece has them
    std::vector<Segment> overused;   ///< edges of more than two pieces, or of two on one side

    /// Adds those of another process.
    LAMINA_EXPORT void add(const SeamFindings& other);
};

}  // namespace lamina::mesh
