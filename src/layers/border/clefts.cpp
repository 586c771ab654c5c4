// At the end of a cleft the fronts on both sides are nearer to each other than their edges are long. If triangles
// outside of the layer had to fit between them, these edges would be divided, and with them the tops of flat cells. So
// the end is closed by a strip of triangles from front to front, and the front goes from side to side before it:
//
//     o-----o-----o-----o-._           o-----o-----o-----o-._          o: vertices of the wall
//     +-----+--+--+-++-++   `-._       +-----+-----+-----+   `-._      +: vertices of the fronts
//                               c            |`-._ |`-._ |       c     c: the corner, which has no ray
//     +-----+--+--+-++-++   _.-'       +-----+----`+----`+   _.-'
//     o-----o-----o-----o-'            o-----o-----o-----o-'           left: open; right: closed by a strip
//
// docs/layer.md
#include "layers/border/clefts.hpp"

#include <algorithm>
#include <cassert>
#include <optional>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "core/segments.hpp"
#include "layers/cells/polygon_cutter.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// A cleft ends at so many rays.
constexpr std::size_t most_rays = 128;

/// The search for the end of the cleft at one corner, within one element.
class CleftSearch {
public:
    /// begin, end: the rays of the element.
    CleftSearch(const LayeredRays& rays, std::size_t begin, std::size_t end) : rays_(rays), begin_(begin), end_(end) {}

    /// Returns the end of the cleft at the corner after a ray, if fronts are near to each other there.
    std::optional<CleftEnd> at_corner_after(std::size_t ray) const {
        CleftEnd end{ray, ray, ray + 1};
        if (end.last == end_ || !has_layers(end.first) || !has_layers(end.last)) return std::nullopt;
        std::optional<CleftEnd> widest;
        double width = relative_gap(end);
        while (width < open_gap && go_on(end)) {
            const double gap = relative_gap(end);
            if (gap <= width || !can_be_cut(end)) continue;
            width = gap;
            widest = end;
        }
        assert(!widest ||
               (begin_ <= widest->first && widest->first <= ray && ray < widest->last && widest->last < end_));
        return widest && !is_entered(*widest) ? widest : std::nullopt;
    }

private:
    const LayeredRays& rays_;
    std::size_t begin_, end_;

    bool has_layers(std::size_t ray) const {
        return rays_.counts[ray] > 0 && rays_.set.lines[ray].place == RayPlace::wall;
    }

    /// Returns whether the cleft may reach beyond a ray, to its neighbour. Neither the first nor the last ray of the
    /// element is passed, so that fronts begin where elements do.
    bool can_pass(std::size_t ray, std::size_t next) const {
        return ray != begin_ && ray + 1 != end_ && has_layers(next) &&
               rays_.set.lines[std::min(ray, next)].corner_after.empty();
    }

    /// Lets that side of a cleft go on by a ray which lags behind, or both. Returns whether it may.
    bool go_on(CleftEnd& end) const {
        if (!can_pass(end.first, end.first - 1) || !can_pass(end.last, end.last + 1)) return false;
        if (end.last - end.first > most_rays) return false;
        const std::vector<Point>& corner_after = rays_.set.lines[end.corner].corner_after;
        const Point corner = corner_after[corner_after.size() / 2];
        const double to_first = distance(corner, rays_.tip(end.first - 1)),
                     to_last = distance(corner, rays_.tip(end.last + 1));
        if (to_first <= alike * to_last) --end.first;
        if (to_last <= alike * to_first) ++end.last;
        return true;
    }

    /// Returns the width of the gap between the tips of the outermost rays, over the length of the front's longer edge
    /// there.
    double relative_gap(const CleftEnd& end) const {
        const double before = end.first == begin_ ? 0 : distance(rays_.tip(end.first), rays_.tip(end.first - 1));
        const double after = end.last + 1 == end_ ? 0 : distance(rays_.tip(end.last), rays_.tip(end.last + 1));
        return distance(rays_.tip(end.first), rays_.tip(end.last)) / std::max(before, after);
    }

    /// The points of a strip between both fronts, and its triangles.
    struct Strip {
        std::vector<Point> points;
        std::vector<Triangle> triangles;

        Point corner(const Triangle& t, std::size_t k) const { return points[t.v[k % 3].index()]; }
    };

    /// Returns the strip of a cleft; without triangles where no triangulation has positive ones only.
    Strip strip_of(const CleftEnd& end) const {
        Strip strip;
        std::vector<VertexId> corners;
        for (std::size_t i = end.last + 1; i-- > end.first;) {
            corners.push_back(VertexId(strip.points.size()));
            strip.points.push_back(rays_.tip(i));
        }
        PolygonCutter(strip.points).cut_strip(corners, end.last - end.corner, true, strip.triangles);
        return strip;
    }

    /// Returns whether the strip between both fronts can be cut into positive triangles without large angles.
    bool can_be_cut(const CleftEnd& end) const {
        const Strip strip = strip_of(end);
        return !strip.triangles.empty() &&
               std::all_of(strip.triangles.begin(), strip.triangles.end(), [&](const Triangle& t) {
                   const auto angle_at = [&](std::size_t k) {
                       const Point at = strip.corner(t, k);
                       return core::angle_between(strip.corner(t, k + 1) - at, strip.corner(t, k + 2) - at);
                   };
                   return std::max({angle_at(0), angle_at(1), angle_at(2)}) <= core::radians(largest_layer_angle_deg);
               });
    }

    /// Returns whether any other front lies in the end of a cleft, or meets the edge that closes it. Fronts do not meet
    /// each other, so nothing else can come into it.
    bool is_entered(const CleftEnd& end) const {
        const RaySet& set = rays_.set;
        const Point a = rays_.tip(end.first), b = rays_.tip(end.last);
        const Box box = core::bounding_box(a, b);
        const Strip strip = strip_of(end);
        const auto is_in_strip = [&](Point p) {
            return std::any_of(strip.triangles.begin(), strip.triangles.end(), [&](const Triangle& t) {
                const auto is_left_of = [&](std::size_t k) {
                    return orient2d(strip.corner(t, k), strip.corner(t, k + 1), p) >= 0;
                };
                return is_left_of(0) && is_left_of(1) && is_left_of(2);
            });
        };
        for (std::size_t e = 0; e < set.elements(); ++e) {
            if (set.begin[e] != begin_ && is_in_strip(rays_.tip(set.begin[e]))) return true;
            for (std::size_t i = set.begin[e], before = set.begin[e + 1] - 1; i < set.begin[e + 1]; before = i++) {
                if (i >= end.first && i <= end.last + 1) continue;  // from the one before the cleft to the one after it
                const Point p = rays_.tip(before), q = rays_.tip(i);
                if (box.overlaps(core::bounding_box(p, q)) && core::segments_meet(a, b, p, q)) return true;
            }
        }
        return false;
    }
};

}  // namespace

std::vector<CleftEnd> cleft_ends(const LayeredRays& rays) {
    std::vector<CleftEnd> found;
    if (!uses("clefts")) return found;
    for (std::size_t e = 0; e < rays.set.elements(); ++e) {
        const CleftSearch search(rays, rays.set.begin[e], rays.set.begin[e + 1]);
        for (std::size_t i = rays.set.begin[e]; i < rays.set.begin[e + 1]; ++i) {
            if (rays.set.lines[i].corner_after.empty()) continue;
            if (const std::optional<CleftEnd> end = search.at_corner_after(i)) found.push_back(*end);
        }
    }
    // Clefts that share a ray stay open.
    std::vector<CleftEnd> ends;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const bool shares_before = k > 0 && found[k - 1].last >= found[k].first;
        const bool shares_after = k + 1 < found.size() && found[k].last >= found[k + 1].first;
        if (!shares_before && !shares_after) ends.push_back(found[k]);
    }
    return ends;
}

}  // namespace lamina::layers
