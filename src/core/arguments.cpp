#include "core/arguments.hpp"

#include <algorithm>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/text.hpp"

namespace lamina::core {

void require_exact_range(std::span<const Point> points, const std::string& kind) {
    bool in_range = true;
    for (const Point p : points) in_range &= in_exact_range(p);
    if (in_range) return;
    const auto bad = std::find_if_not(points.begin(), points.end(), [](Point p) { return in_exact_range(p); });
    const auto index = static_cast<std::size_t>(bad - points.begin());
    InputPlace place{.at = *bad};
    if (kind == "point") place.points = {index};
    if (kind == "hole" || kind == "region") place.seeds = {index};
    throw InputError(place, concat(kind, " ", index, " is outside the range of exact arithmetic"));
}

void require_indices_below(std::size_t points, std::span<const Segment> segments) {
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (segments[i].a.index() >= points || segments[i].b.index() >= points)
            throw InputError({.segments = {i}},
                             concat(segment_name(segments, i), " does not join two of the ", points, " points"));
}

void require_indices_below(std::size_t points, std::span<const Triangle> triangles) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& v = triangles[i].v;
        if (std::any_of(v, v + 3, [&](VertexId corner) { return corner.index() >= points; }))
            throw InputError({.triangles = {i}},
                             concat("triangle ", i, " (", v[0].value, "-", v[1].value, "-", v[2].value,
                                    ") does not join three of the ", points, " points"));
    }
}

void require_count(std::size_t count, const std::string& things, std::size_t expected, const std::string& others) {
    if (count != expected) throw InputError({}, concat(count, " ", things, " for ", expected, " ", others));
}

std::string segment_name(std::span<const Segment> segments, std::size_t i) {
    return concat("segment ", i, " (", segments[i].a.value, "-", segments[i].b.value, ")");
}

}  // namespace lamina::core
