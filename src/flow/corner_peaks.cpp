#include "flow/corner_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angles.hpp"
#include "geometry/sharp_corner.hpp"

namespace lamina::flow {

namespace {

/// Returns the point of a side that is nearest to a sharp nose, if there is one; else the number of points.
std::size_t point_at_nose(const std::vector<FlowPoint>& side, const std::optional<Point>& sharp_nose) {
    if (!sharp_nose) return side.size();
    const auto nearest = std::min_element(side.begin(), side.end(), [&](const FlowPoint& a, const FlowPoint& b) {
        return squared_length(a.at - *sharp_nose) < squared_length(b.at - *sharp_nose);
    });
    return static_cast<std::size_t>(nearest - side.begin());
}

}  // namespace

std::vector<double> without_corner_peaks(const std::vector<FlowPoint>& side, double (*number)(const FlowPoint&),
                                         const std::optional<Point>& sharp_nose) {
    constexpr double reach_share = 0.01;
    std::vector<double> numbers(side.size());
    std::transform(side.begin(), side.end(), numbers.begin(), number);
    if (side.empty()) return numbers;
    const double reach = reach_share * side.back().s;
    const std::size_t nose = point_at_nose(side, sharp_nose);
    for (std::size_t i = 1; i + 1 < side.size(); ++i) {
        const double turning = core::angle_between(side[i].at - side[i - 1].at, side[i + 1].at - side[i].at);
        if (std::abs(core::degrees(turning)) < geometry::sharp_corner_deg && i != nose) continue;
        std::size_t first = i, last = i;
        while (first > 0 && side[i].s - side[first].s < reach) --first;
        while (last + 1 < side.size() && side[last].s - side[i].s < reach) ++last;
        const double most = std::max(number(side[first]), number(side[last]));
        for (std::size_t k = first; k <= last; ++k) numbers[k] = std::min(numbers[k], most);
    }
    return numbers;
}

}  // namespace lamina::flow
