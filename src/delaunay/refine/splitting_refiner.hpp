// Refinement of a triangulation whose borders may be split.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include <lamina/delaunay.hpp>

#include "delaunay/refine/border_lines.hpp"
#include "delaunay/refine/refiner.hpp"
#include "delaunay/refine/region_sizes.hpp"

namespace lamina::delaunay {

/// A triangulation, with the sizes in each of its triangles and with the vertices between which edges are frozen.
struct SplittableDomain {
    std::vector<Point> points;
    Tris tris;                             ///< constrained edges and borders are parts of lines, or frozen
    std::vector<std::uint32_t> fields;     ///< for each triangle the index of its size field; empty: all have field 0
    std::size_t frozen_begin, frozen_end;  ///< constrained edges between two of these vertices are frozen
};

/// One of the ways to refine. All of them keep the same bounds, but which one makes the fewest triangles is a matter of
/// chance.
struct RefinementWay {
    /// Opposite a vertex, edges of lines are divided into parts of this share of the greatest length that the angle
    /// bound admits. 0.9 leaves room for vertices that do not stand opposite the very middle.
    double part_share = 0.9;
    double off_centre_share = 1;     ///< off-centres stand at this share of the height that the angle bound admits
    bool diametral_circles = false;  ///< whether edges are encroached upon in their diametral circle, not in their lens
    double more_angle_deg = 0;       ///< the angle bound is raised by this, as far as that is admitted
};

/// Splits lines and inserts vertices until every triangle meets its bounds.
///
///        p encroaches upon a-b                  a-b is split instead
///     a-----------o---b                       a------m------o----b
///      \  p      / \ /                         \    / \    / \  /
///       \       /   o                           \  /   \  /   o
///        '-----o----'                            o------o-----'
///
/// A vertex encroaches upon an edge of a line if it lies in the lens round the edge: the points that see the edge at an
/// angle of 180 degrees less twice the angle bound, or more. Source: J. R. Shewchuk, Delaunay refinement algorithms for
/// triangular mesh generation, Comput. Geom. 22 (2002), section 3.4.2 on diametral lenses.
class SplittingRefiner : public Refiner<SplittingRefiner> {
public:
    /// Keeps references to the lines, the size fields and the options.
    SplittingRefiner(SplittableDomain domain, BorderLines& lines, std::span<const RegionSizes> sizes,
                     const ConstrainedRefineOptions& options, const RefinementWay& way);

    /// Refines. May be called once only.
    void refine();

    /// Returns the vertices, those of the domain first, in the coordinates of the domain.
    std::vector<Point> vertices() const;
    const Tris& tris() const { return tris_; }
    /// Returns the index of the size field of a triangle.
    std::uint32_t field_of(Index t) const { return fields_.empty() ? 0 : fields_[t]; }
    /// Returns the numbers of triangles beyond the bounds, with this bound of the angles.
    RefineStats count_leftovers(double min_angle_deg) const;
    /// Returns the circumcentres that a frozen edge kept out, in the coordinates of the domain.
    const std::vector<Point>& kept_out() const { return kept_out_; }

private:
    friend class Refiner<SplittingRefiner>;

    /// The edge a -> b of a line, with triangle t on its left when it was queued.
    struct QueuedEdge {
        Index t, a, b;
    };

    double size_at(Point p, Index t) const { return scale_ * sizes_of_fields_[field_of(t)]((1 / scale_) * p); }
    double gradation() const;
    bool is_blocked(const CavityEdge& a, const CavityEdge& b) const;
    static constexpr bool always_counts = true;
    Index first_movable() const { return static_cast<Index>(frozen_end_); }
    static constexpr bool may_renumber = false;
    bool must_mend(Index t) const;
    bool is_in_sight(Index t, Point p) const;
    // Lines may be shorter than sizes by far.
    static Point settled(Point p, Index) { return p; }
    void vertex_inserted(Index t, std::size_t old_count);
    void give_up(Index t, Point p);
    bool split_next();

    void give_sizes();
    bool is_frozen(Index v) const { return v >= frozen_begin_ && v < frozen_end_; }
    bool is_frozen(Index a, Index b) const { return !may_split_ || (is_frozen(a) && is_frozen(b)); }
    bool encroaches(Point a, Point b, double aa, double bb) const;
    double unresolved_distance(Index line) const;
    bool is_left_alone(Index a, Index b, Index p) const;
    bool is_left_alone(const Tri& tri) const;
    bool is_too_long(Index t, Index a, Index b) const;
    Point division_point(Index t, Index a, Index b) const;
    double share_in_corner(Index a, Index b, Index p) const;
    double share_at_split(Index t, unsigned e) const;
    void queue_edges(Index t);
    std::optional<QueuedEdge> first_on_way(Index t, Point p) const;
    std::vector<QueuedEdge> find_blocking(Index t, Point p, bool& frozen);
    Index inside_triangle(std::size_t i) const;
    Point clip(Point inside, Point p) const;
    bool is_too_short(Point a, Point b) const;
    bool is_unresolved(Point a, Point b) const;
    bool split(Index t, unsigned e);
    bool cavity_admits_split(Point p, Index a, Index b, bool is_border) const;
    void fill_and_queue(Index vertex, Index a, Index b, std::uint32_t left, std::uint32_t right);

    BorderLines& lines_;
    std::span<const RegionSizes> sizes_of_fields_;
    std::vector<std::uint32_t> fields_;
    std::size_t frozen_begin_, frozen_end_;
    bool may_split_;
    bool conforming_;
    double scale_ = 1;     ///< the coordinates of the refiner over those of the domain
    Box extent_;           ///< the box round all vertices
    double part_length_;   ///< the length of parts of an edge over the distance of a vertex
    double squared_lens_;  ///< squared cosine of the angle at which points on a lens see its edge;
                           ///< 0 for diametral circles
    std::deque<QueuedEdge> long_or_encroached_;  ///< a stack
    std::vector<Point> kept_out_;
};

}  // namespace lamina::delaunay
