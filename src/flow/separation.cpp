#include "flow/separation.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/reproducible_math.hpp"

namespace lamina::flow {

namespace {

/// Returns where the boundary layer leaves a side for good: its trailing edge, or where it separates before that.
const FlowPoint& last_attached(const std::vector<FlowPoint>& side) {
    const auto attached = std::find_if(side.rbegin(), side.rend(), [](const FlowPoint& point) {
        return point.state != BoundaryLayerState::separated;
    });
    return attached == side.rbegin() || attached == side.rend() ? side.back() : *std::prev(attached);
}

}  // namespace

std::optional<OpenWake> find_open_wake(const Flow& flow, const ElementFlow& element) {
    constexpr double least_width = 0.16;  // in chords
    if (flow.estimated) return std::nullopt;
    const double alpha = core::radians(flow.alpha_deg);
    const Point stream{core::cos_reproducible(alpha), core::sin_reproducible(alpha)},
        above = last_attached(element.upper).at, below = last_attached(element.lower).at;
    const double width = cross(stream, above - below);
    if (!(width > least_width * flow.chord)) return std::nullopt;
    return OpenWake{above, below, stream, width};
}

std::optional<Warning> find_wide_wake(const Flow& flow) {
    const ElementFlow* widest = nullptr;
    std::optional<OpenWake> wake;
    for (const ElementFlow& element : flow.elements)
        if (const auto other = find_open_wake(flow, element); other && (!wake || other->width > wake->width)) {
            widest = &element;
            wake = other;
        }
    if (!wake) return std::nullopt;
    // The side whose layer leaves farther from the end of the body says more.
    const bool upper = distance(wake->above, widest->upper.back().at) >= distance(wake->below, widest->lower.back().at);
    const Point at = upper ? wake->above : wake->below;
    const double width = wake->width / flow.chord;
    return Warning{
        .code = WarningCode::flow_separates,
        .element = widest->name,
        .at = at,
        .number = width,
        .unit = "chords",
        .message = fmt::format(
            "{}: stalled or bluff, separated from ({:.6g}, {:.6g}) on, where a wake {:.2f} chords wide begins; the "
            "lift coefficient {:.3g} is an upper bound, and the wake is meshed along the "
            "free stream",
            widest->name, at.x, at.y, width, flow.lift)};
}

}  // namespace lamina::flow
