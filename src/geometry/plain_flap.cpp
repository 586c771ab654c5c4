// Source: M. Drela, XFOIL: An Analysis and Design System for Low Reynolds Number Airfoils (1989), the flaps of its
// routine FLAP: surfaces are parted where they are nearest to the hinge, so that the arc is tangent to both parts.
#include "geometry/plain_flap.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/angles.hpp"
#include "core/box_tree.hpp"
#include "core/segments.hpp"

namespace lamina::geometry {

namespace {

using SourcePoints = std::vector<SourcePoint>;

/// The hinge of a flap and its deflection, of one element.
struct Hinge {
    Point at;
    double turn;             ///< of the rear in radians, positive counter-clockwise
    double length;           ///< of the element, its longer side
    const Element* element;  ///< for messages

    Point turned(Point p) const { return at + core::rotated(p - at, turn); }

    [[noreturn]] void refuse(const std::string& reason) const {
        throw InputError(
            {.file = element->file, .at = at, .element = element->name},
            fmt::format("the flap of '{}' cannot be deflected about its hinge: {}", element->name, reason));
    }
};

/// One surface of a section in two parts, whose first point is where it was parted.
struct PartedSurface {
    SourcePoints rear;   ///< towards the tail
    SourcePoints front;  ///< towards the nose
    double spacing;      ///< length of the edge that was parted
};

// ---- parting -------------------------------------------------------------------------------------------------------

/// Parts a surface, given from the tail to the nose, at its point nearest to the hinge:
///
///     tail ---x------x--o---x------x--- nose
///                       |
///                     hinge
PartedSurface part_at_hinge(const SourcePoints& surface, const Hinge& hinge) {
    std::size_t nearest = 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i + 1 < surface.size(); ++i) {
        const double d = core::distance_to_segment(hinge.at, surface[i].at, surface[i + 1].at);
        if (d < least) nearest = i, least = d;
    }
    const SourcePoint a = surface[nearest], b = surface[nearest + 1];
    const Point edge = b.at - a.at;
    const double share = std::clamp(dot(hinge.at - a.at, edge) / squared_length(edge), 0.0, 1.0);
    if ((nearest == 0 && share <= 0) || (nearest + 2 == surface.size() && share >= 1))
        hinge.refuse("a surface of the section is nearest to it at the nose or the tail; move the hinge");

    const SourcePoint foot = share <= 0 ? a : share >= 1 ? b : SourcePoint{a.at + share * edge, 0};
    const auto begin = surface.begin() + static_cast<std::ptrdiff_t>(nearest);
    PartedSurface parts{{foot}, {foot}, length(edge)};
    parts.rear.insert(parts.rear.end(), std::make_reverse_iterator(share > 0 ? begin + 1 : begin), surface.rend());
    parts.front.insert(parts.front.end(), share < 1 ? begin + 1 : begin + 2, surface.end());
    assert(parts.rear.size() >= 2 && parts.front.size() >= 2);
    return parts;
}

// ---- joining -------------------------------------------------------------------------------------------------------

/// Returns whether the parts of a surface move away from each other. The speed of the rear's first point is compared
/// with the direction from the front's next point to the rear's.
bool opens(const PartedSurface& parts, const Hinge& hinge) {
    const Point speed = hinge.turn * perpendicular(parts.front[0].at - hinge.at);
    return dot(speed, parts.rear[1].at - parts.front[1].at) > 0;
}

/// Returns the vertices of the arc from the front's first point to that of the turned rear, without both.
SourcePoints arc_between(const PartedSurface& parts, const Hinge& hinge) {
    constexpr double max_step_deg = 5, max_steps = 1000;
    const Point arm = parts.front[0].at - hinge.at;
    const double turn = std::abs(hinge.turn), arc = turn * length(arm);
    const double steps =
        std::ceil(std::min(std::max(core::degrees(turn) / max_step_deg, arc / parts.spacing), max_steps));
    SourcePoints points;
    for (double k = 1; k < steps; ++k) points.push_back({hinge.at + core::rotated(arm, k / steps * hinge.turn), 0});
    return points;
}

/// Takes off what the front and the turned rear have inside each other. Both then begin at their crossing: of several,
/// the one farthest along the front, behind which the parts cannot cross again.
///
///     rear \   / front         rear \   / front
///           \ /                      \ /
///            x           ->           v
///           / \ overlap
void cut_at_crossing(PartedSurface& parts, const Hinge& hinge) {
    const std::size_t front_edges = parts.front.size() - 1;
    std::vector<Box> boxes;
    for (const SourcePoints* part : {&parts.front, &parts.rear})
        for (std::size_t i = 0; i + 1 < part->size(); ++i)
            boxes.push_back(core::bounding_box((*part)[i].at, (*part)[i + 1].at));

    struct Crossing {
        std::size_t front, rear;  ///< the edges, by their first vertices
        double share;             ///< where it lies on the edge of the front
        Point at;
    };
    std::optional<Crossing> last;
    core::BoxTree(std::move(boxes)).overlapping_pairs([&](std::size_t i, std::size_t j) {
        if (i >= front_edges || j < front_edges) return;
        const std::size_t k = j - front_edges;
        const Point a = parts.front[i].at, b = parts.front[i + 1].at, c = parts.rear[k].at, d = parts.rear[k + 1].at;
        const double denominator = cross(b - a, d - c);
        if (denominator == 0 || !core::segments_meet(a, b, c, d)) return;
        const double share = std::clamp(cross(c - a, d - c) / denominator, 0.0, 1.0);
        if (!last || std::pair{last->front, last->share} < std::pair{i, share})
            last = {i, k, share, a + share * (b - a)};
    });
    if (!last) hinge.refuse("the parts of a surface overlap as a whole; deflect it less, or move the hinge");
    const auto cut = [&](SourcePoints& part, std::size_t edge) {
        part.erase(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(edge));
        part[0] = part[0].at == last->at ? part[0] : SourcePoint{last->at, 0};
        if (part.size() > 2 && part[1].at == last->at) part.erase(part.begin());
    };
    cut(parts.front, last->front);
    cut(parts.rear, last->rear);
    assert(parts.front[0].at == parts.rear[0].at && parts.front.size() >= 2 && parts.rear.size() >= 2);
}

/// Takes out the second vertex of a part where it is much nearer to the first one than to the third and hardly off the
/// edge between these.
void drop_close_second(SourcePoints& part, const Hinge& hinge) {
    constexpr double max_share = 1.0 / 3, max_offset = 1e-5;  // of the next edge; of the element's length
    if (part.size() < 4) return;
    const Point first = part[0].at, second = part[1].at, third = part[2].at;
    if (distance(first, second) < max_share * distance(second, third) &&
        core::distance_to_segment(second, first, third) < max_offset * hinge.length)
        part.erase(part.begin() + 1);
}

/// Returns a surface, given from the tail to the nose, with its rear turned about the hinge.
SourcePoints with_turned_rear(const SourcePoints& surface, const Hinge& hinge) {
    // Of the element's length. The parts stay together where the hinge lies on the surface or hardly turns.
    constexpr double min_move = 1e-8;
    PartedSurface parts = part_at_hinge(surface, hinge);
    const double move = std::min(std::abs(hinge.turn), 1.0) * distance(parts.front[0].at, hinge.at);
    const bool together = move < min_move * hinge.length;
    const bool opening = !together && opens(parts, hinge);
    for (SourcePoint& p : parts.rear) p.at = hinge.turned(p.at);
    SourcePoints arc;
    if (opening) arc = arc_between(parts, hinge);
    if (!opening && !together) cut_at_crossing(parts, hinge);
    parts.rear[0].is_corner |= !opening;
    drop_close_second(parts.front, hinge);
    drop_close_second(parts.rear, hinge);

    SourcePoints joined(parts.rear.rbegin(), parts.rear.rend());
    joined.insert(joined.end(), arc.rbegin(), arc.rend());
    // Where there is no arc, the front begins at the vertex at which the rear ends.
    joined.insert(joined.end(), parts.front.begin() + (opening ? 0 : 1), parts.front.end());
    return joined;
}

}  // namespace

std::vector<SourcePoint> with_deflected_flap(const std::vector<SourcePoint>& outline, const FlapDeflection& flap,
                                             const Element& element) {
    if (flap.angle_deg == 0) return outline;
    const Hinge hinge{flap.hinge, -core::radians(flap.angle_deg), extent(outline), &element};
    SourcePoints upper = outline;
    const auto before = [](const SourcePoint& a, const SourcePoint& b) { return lexicographically_less(a.at, b.at); };
    std::rotate(upper.begin(), std::max_element(upper.begin(), upper.end(), before), upper.end());
    const auto nose = std::min_element(upper.begin(), upper.end(), before);
    SourcePoints lower{upper.front()};
    lower.insert(lower.end(), upper.rbegin(), std::make_reverse_iterator(nose));
    upper.erase(nose + 1, upper.end());

    SourcePoints result = with_turned_rear(upper, hinge);
    lower = with_turned_rear(lower, hinge);
    result.insert(result.end(), lower.rbegin() + 1, lower.rend() - 1);
    return result;
}

}  // namespace lamina::geometry
