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

std::optional<Warning> find_wide_wake(const Flow& flow) {
    // In chords, across the stream. NACA 0012 at a Reynolds number of 6e6 has 0.06 at 15 degrees, 0.15 at 17 and 0.2 at
    // 18, where the Reynolds-averaged equations have no attached flow any more; a cylinder has 0.7.
    constexpr double widest = 0.2;
    if (flow.estimated) return std::nullopt;
    const double alpha = core::radians(flow.alpha_deg);
    const Point stream{core::cos_reproducible(alpha), core::sin_reproducible(alpha)};
    std::optional<Warning> warning;
    for (const ElementFlow& element : flow.elements) {
        const FlowPoint &above = last_attached(element.upper), &below = last_attached(element.lower);
        const double width = cross(stream, above.at - below.at) / flow.chord;
        if (!(width > (warning ? warning->number : widest))) continue;
        // The side whose layer leaves farther from the end of the body says more.
        const bool upper = element.upper.back().s - above.s >= element.lower.back().s - below.s;
        const Point at = (upper ? above : below).at;
        warning = {
            .code = WarningCode::flow_separates,
            .element = element.name,
            .at = at,
            .number = width,
            .unit = "chords",
            .message = fmt::format("{}: stalled or bluff, since its boundary layer leaves the wall at ({:.6g}, "
                                   "{:.6g}) and the wake begins {:.2f} chords wide; sizes and wakes are those of "
                                   "attached flow (--refine, or lamina sizes with a solution)",
                                   element.name, at.x, at.y, width)};
    }
    return warning;
}

}  // namespace lamina::flow
