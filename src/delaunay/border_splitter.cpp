// A round looks for subsegments that must be split, in all parts in parallel, and then splits them one by one.
#include "delaunay/border_splitter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bounding_box.hpp"
#include "core/parallel.hpp"

namespace lamina::delaunay {

namespace {

/// Subsegments of at most this share of h gave no encroachment in any trial (docs/decisions/0002).
constexpr double border_share = 0.9;
/// No subsegment becomes shorter than this share of the extent.
constexpr double min_length_share = 0x1p-40;

}  // namespace

BorderSplitter::BorderSplitter(ConstrainedParts& parts) : parts_(parts) {
    Box extent;
    for (Point p : parts.points) extent.include(p);
    min_length_ = min_length_share * core::longer_side(extent);
}

/// Returns the smallest of the sizes that the parts beside the border have at p.
double BorderSplitter::size_at(const PartBorder& border, Point p) const {
    double h = HUGE_VAL;
    for (Index part : border.parts) h = std::min(h, (*parts_.parts[part].size)(p));
    return h;
}

/// Returns the point that divides a-b: the middle or, if one end is an acute corner, the point on a circle round that
/// end whose radius is a power of two. Each side keeps at least a third.
Point BorderSplitter::division_point(Index a, Index b) const {
    const bool from_a = is_acute_at(a), from_b = is_acute_at(b);
    if (from_a == from_b) return midpoint(point(a), point(b));
    const Point corner = point(from_a ? a : b), far = point(from_a ? b : a);
    const double whole = distance(corner, far);
    int exponent = 0;
    std::frexp(whole * (2.0 / 3.0), &exponent);
    return corner + (std::ldexp(0.5, exponent) / whole) * (far - corner);
}

/// Splits a subsegment. Returns false if it is too short.
bool BorderSplitter::split(const Subsegment& s) {
    PartBorder& border = parts_.borders[s.border];
    const Index a = border.chain[s.place], b = border.chain[s.place + 1];
    if (distance(point(a), point(b)) < 2 * min_length_) return false;
    const Point p = division_point(a, b);
    if (p == point(a) || p == point(b)) return false;
    border.chain.insert(border.chain.begin() + static_cast<std::ptrdiff_t>(s.place) + 1,
                        static_cast<Index>(parts_.points.size()));
    parts_.points.push_back(p);
    parts_.border_of_vertex.push_back(s.border);
    for (Index part : border.parts) parts_.parts[part].stale = true;
    return true;
}

bool BorderSplitter::split_all(std::span<const std::vector<Subsegment>> found) {
    std::vector<Subsegment> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    // Borders are split from back to front, so that the places of the other subsegments stay what they were.
    std::sort(all.begin(), all.end(), [](const Subsegment& l, const Subsegment& r) {
        return l.border != r.border ? l.border < r.border : l.place > r.place;
    });
    all.erase(std::unique(all.begin(), all.end()), all.end());
    bool any = false;
    for (const Subsegment& s : all) any = split(s) || any;
    return any;
}

void BorderSplitter::split_by_size() {
    for (Index i = 0; i < parts_.borders.size(); ++i) {
        const PartBorder& border = parts_.borders[i];
        for (std::size_t place = 0; place + 1 < border.chain.size();) {
            const Point a = point(border.chain[place]), b = point(border.chain[place + 1]);
            const double h = std::min({size_at(border, a), size_at(border, midpoint(a, b)), size_at(border, b)});
            if (!(distance(a, b) > border_share * h && split({i, place}))) ++place;
        }
    }
}

bool BorderSplitter::split_encroached() {
    std::vector<std::vector<Subsegment>> found(parts_.parts.size());
    core::parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t) {
        if (parts_.parts[begin].stale) found[begin] = find_encroached(parts_.parts[begin]);
    });
    return split_all(found);
}

std::vector<Subsegment> BorderSplitter::find_encroached(const ConstrainedPart& part) const {
    const LocalPart local = parts_.localize(part);
    std::vector<std::pair<Segment, std::size_t>> by_ends;
    by_ends.reserve(local.segments.size());
    for (std::size_t i = 0; i < local.segments.size(); ++i) by_ends.push_back({local.segments[i], i});
    std::sort(by_ends.begin(), by_ends.end());
    std::vector<Subsegment> found;
    const auto t = triangulate(local.points, local.segments, {.keep = KeptRegion::left_of_segments});
    for (const Triangle& triangle : t.triangles) {
        for (unsigned e = 0; e < 3; ++e) {
            const VertexId a = triangle.v[next(e)], b = triangle.v[previous(e)];
            const Point p = local.points[triangle.v[e].index()];
            if (dot(local.points[a.index()] - p, local.points[b.index()] - p) >= 0) continue;
            const auto at = std::lower_bound(by_ends.begin(), by_ends.end(), std::pair{Segment{a, b}, std::size_t{0}});
            if (at != by_ends.end() && at->first == Segment{a, b}) found.push_back(local.subsegments[at->second]);
        }
    }
    return found;
}

}  // namespace lamina::delaunay
