// Refinement of a constrained triangulation. Its segments cut it into parts. Each part is refined against frozen
// borders, which are split beforehand, and once more where a part shows that they are too coarse.
//
//   find parts -> split by size -> split where encroached -> refine parts -> split the subsegments that
//                                             ^                              keep bad triangles bad
//                                             '------------------------------------------'
// Sources: J. Ruppert, J. Algorithms 18 (1995); G. Miller, S. Pav, N. Walkington, Int. J. Comput. Geom. Appl. 15
// (2005).
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <lamina/delaunay.hpp>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/reproducible_math.hpp"
#include "delaunay/border_splitter.hpp"
#include "delaunay/constrained_parts.hpp"

namespace lamina::delaunay {

namespace {

constexpr int max_refinement_rounds = 60;

/// A part's refinement, in the numbers of the part alone.
struct RefinedPart {
    std::vector<Index> global;  ///< for each border point its index in ConstrainedParts::points, ascending
    Refinement refinement;
};

/// A triangle of a part's refinement, and how it stands to the bounds.
struct JudgedTriangle {
    Point corners[3];
    Index splits[3];  ///< for each vertex the border that it splits; no_index for the others
    double area2;     ///< twice the area
    bool narrow;      ///< below the angle bound
    bool exempt;      ///< below the angle bound, at a corner that no refinement could mend
    bool oversized;   ///< above the size bound
};

/// The subsegments of a part's borders, found by the boxes of their diametral circles.
class SubsegmentTree {
public:
    SubsegmentTree(const ConstrainedParts& parts, const ConstrainedPart& part)
        : parts_(parts), subsegments_(list(parts, part)), circles_(boxes()) {}

    /// Appends the subsegments that keep a point at `centre` from mending a triangle round `inside`: the first one on
    /// the straight way from `inside` to `centre` or, if there is none, those that `centre` encroaches upon.
    void find_blocking(Point inside, Point centre, std::vector<Subsegment>& found) const {
        Box box;
        box.include(inside);
        box.include(centre);
        std::optional<Subsegment> first;
        double min_share = HUGE_VAL;
        std::vector<Subsegment> encroached;
        circles_.overlaps(box, [&](std::size_t i) {
            const auto [a, b] = ends(subsegments_[i]);
            if (dot(a - centre, b - centre) <= 0) encroached.push_back(subsegments_[i]);
            const double inside_side = cross(b - a, inside - a), centre_side = cross(b - a, centre - a);
            const double a_side = cross(centre - inside, a - inside), b_side = cross(centre - inside, b - inside);
            if ((inside_side > 0) == (centre_side > 0) || (a_side > 0) == (b_side > 0)) return;
            if (const double share = inside_side / (inside_side - centre_side); share < min_share) {
                min_share = share;
                first = subsegments_[i];
            }
        });
        if (first) encroached.assign(1, *first);
        found.insert(found.end(), encroached.begin(), encroached.end());
    }

private:
    static std::vector<Subsegment> list(const ConstrainedParts& parts, const ConstrainedPart& part) {
        std::vector<Subsegment> subsegments;
        for (const PartSide& side : part.sides)
            for (std::size_t i = 0; i + 1 < parts.borders[side.border].chain.size(); ++i)
                subsegments.push_back({side.border, i});
        return subsegments;
    }

    /// Returns the boxes of the diametral circles, which hold the subsegments as well.
    std::vector<Box> boxes() const {
        std::vector<Box> result;
        result.reserve(subsegments_.size());
        for (const Subsegment& s : subsegments_) {
            const auto [a, b] = ends(s);
            const Point m = midpoint(a, b);
            const double r = 0.5 * distance(a, b) * (1 + 1e-12);
            result.push_back({m - Point{r, r}, m + Point{r, r}});
        }
        return result;
    }

    std::pair<Point, Point> ends(const Subsegment& s) const {
        const auto& chain = parts_.borders[s.border].chain;
        return {parts_.points[chain[s.place]], parts_.points[chain[s.place + 1]]};
    }

    const ConstrainedParts& parts_;
    std::vector<Subsegment> subsegments_;
    core::BoxTree circles_;
};

/// The steps of the refinement.
class ConstrainedRefiner {
public:
    ConstrainedRefiner(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                       const SizeField& size, const ConstrainedRefineOptions& options)
        : options_(options),
          input_count_(points.size()),
          triangulated_count_(points.size() + triangulation.steiner_points.size()),
          parts_(find_parts(points, triangulation, size, options.regions)),
          splitter_(parts_),
          refined_(parts_.parts.size()) {}

    void run() {
        if (options_.split_segments) splitter_.split_by_size();
        for (int round = 0; round < max_refinement_rounds; ++round) {
            if (options_.split_segments)
                while (splitter_.split_encroached()) {
                }
            refine_stale_parts();
            if (!options_.split_segments || !split_blocking()) return;
        }
        refine_stale_parts();
    }

    ConstrainedRefinement result(const ConstrainedTriangulation& triangulation) const;

private:
    void refine_stale_parts() {
        core::parallel_for(refined_.size(), 1, [&](std::size_t begin, std::size_t) {
            ConstrainedPart& part = parts_.parts[begin];
            if (!part.stale) return;
            LocalPart local = parts_.localize(part);
            refined_[begin].refinement = lamina::refine(local.points, local.segments, *part.size, options_.refine);
            refined_[begin].global = std::move(local.global);
            part.stale = false;
        });
    }

    /// Splits the subsegments between bad triangles and the points that would mend them. Returns whether there were
    /// any.
    bool split_blocking() {
        std::vector<std::vector<Subsegment>> found(refined_.size());
        core::parallel_for(found.size(), 1,
                           [&](std::size_t begin, std::size_t) { found[begin] = find_blocking(begin); });
        return splitter_.split_all(found);
    }

    std::vector<Subsegment> find_blocking(std::size_t part) const;
    JudgedTriangle judge(std::size_t part, const Triangle& triangle) const;
    bool is_exempt(const RefinedPart& refined, const Triangle& triangle, const JudgedTriangle& j,
                   unsigned shortest) const;
    void append_triangles(std::size_t part, ConstrainedRefinement& r) const;

    const ConstrainedRefineOptions& options_;
    std::size_t input_count_;         ///< number of points of the input
    std::size_t triangulated_count_;  ///< number of points of the triangulation
    ConstrainedParts parts_;
    BorderSplitter splitter_;
    std::vector<RefinedPart> refined_;
};

JudgedTriangle ConstrainedRefiner::judge(std::size_t part, const Triangle& triangle) const {
    const RefinedPart& refined = refined_[part];
    const std::size_t border_count = refined.global.size();
    JudgedTriangle j{};
    double h = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const std::size_t v = triangle.v[i].index();
        const bool is_steiner = v >= border_count;
        j.corners[i] =
            is_steiner ? refined.refinement.steiner_points[v - border_count] : parts_.points[refined.global[v]];
        j.splits[i] = is_steiner ? no_index : parts_.border_of_vertex[refined.global[v]];
        h += (*parts_.parts[part].size)(j.corners[i]) / 3;
    }
    double squared[3];
    for (unsigned e = 0; e < 3; ++e) squared[e] = squared_length(j.corners[previous(e)] - j.corners[next(e)]);
    const auto shortest = static_cast<unsigned>(std::min_element(squared, squared + 3) - squared);
    j.area2 = cross(j.corners[1] - j.corners[0], j.corners[2] - j.corners[0]);
    const double sine = core::sin_reproducible(core::radians(options_.refine.min_angle_deg));
    // The bounds have the same allowance for rounding as the counts of refine().
    j.narrow =
        j.area2 * j.area2 * squared[shortest] * (1 + 1e-9) < sine * sine * (squared[0] * squared[1] * squared[2]);
    j.oversized = j.area2 > 2 * equilateral_area * h * h * (1 + 1e-9);
    j.exempt = j.narrow && is_exempt(refined, triangle, j, shortest);
    return j;
}

/// Returns whether a narrow triangle lies in a sharp corner, or its shortest edge joins two borders that make one.
bool ConstrainedRefiner::is_exempt(const RefinedPart& refined, const Triangle& triangle, const JudgedTriangle& j,
                                   unsigned shortest) const {
    const Point middle = (1.0 / 3) * (j.corners[0] + j.corners[1] + j.corners[2]);
    if (std::any_of(triangle.v, triangle.v + 3, [&](VertexId v) {
            return v.index() < refined.global.size() && parts_.in_sharp_corner(refined.global[v.index()], middle);
        }))
        return true;
    const Index a = j.splits[next(shortest)], b = j.splits[previous(shortest)];
    return a != no_index && b != no_index && a != b && parts_.meet_sharply(a, b);
}

std::vector<Subsegment> ConstrainedRefiner::find_blocking(std::size_t part) const {
    std::vector<JudgedTriangle> bad;
    for (const Triangle& triangle : refined_[part].refinement.triangles) {
        const JudgedTriangle j = judge(part, triangle);
        if ((j.narrow && !j.exempt) || j.oversized) bad.push_back(j);
    }
    if (bad.empty()) return {};

    const SubsegmentTree tree(parts_, parts_.parts[part]);
    std::vector<Subsegment> found;
    for (const JudgedTriangle& j : bad) {
        const Point inside = (1.0 / 3) * (j.corners[0] + j.corners[1] + j.corners[2]);
        const Point u = j.corners[1] - j.corners[0], v = j.corners[2] - j.corners[0];
        const Point circumcentre =
            j.corners[0] + (0.5 / j.area2) * perpendicular(squared_length(v) * u - squared_length(u) * v);
        tree.find_blocking(inside, circumcentre, found);
    }
    return found;
}

ConstrainedRefinement ConstrainedRefiner::result(const ConstrainedTriangulation& triangulation) const {
    ConstrainedRefinement r;
    r.steiner_points.assign(parts_.points.begin() + static_cast<std::ptrdiff_t>(input_count_), parts_.points.end());
    r.on_segments = parts_.points.size() - triangulated_count_;
    for (std::size_t part = 0; part < refined_.size(); ++part) append_triangles(part, r);
    for (std::size_t i = 0; i < triangulation.segments.size(); ++i) {
        const auto& chain = parts_.borders[i].chain;
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
            r.segments.push_back({VertexId{chain[k]}, VertexId{chain[k + 1]}});
            r.parents.push_back(triangulation.parents[i]);
        }
    }
    return r;
}

/// Appends the triangles and Steiner points of a part to the result, and counts the triangles beyond the bounds.
void ConstrainedRefiner::append_triangles(std::size_t part, ConstrainedRefinement& r) const {
    const auto& [global, refinement] = refined_[part];
    const std::size_t offset = input_count_ + r.steiner_points.size();
    for (const Triangle& triangle : refinement.triangles) {
        Triangle& renumbered = r.triangles.emplace_back();
        for (unsigned i = 0; i < 3; ++i) {
            const std::size_t v = triangle.v[i].index();
            renumbered.v[i] = v < global.size() ? VertexId{global[v]} : VertexId{offset + v - global.size()};
        }
        r.regions.push_back(parts_.parts[part].region);
        const JudgedTriangle j = judge(part, triangle);
        r.stats.below_bound += j.narrow;
        r.stats.exempt += j.exempt;
        r.stats.oversized += j.oversized;
    }
    r.steiner_points.insert(r.steiner_points.end(), refinement.steiner_points.begin(), refinement.steiner_points.end());
    r.stats.refused += refinement.stats.refused;
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

ConstrainedRefinement refine(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                             const SizeField& size, const ConstrainedRefineOptions& options) {
    ConstrainedRefiner refiner(points, triangulation, size, options);
    refiner.run();
    return refiner.result(triangulation);
}

}  // namespace lamina
