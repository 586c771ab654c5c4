#include "flow/corner_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angles.hpp"
#include "geometry/sharp_corner.hpp"

namespace lamina::flow {

std::vector<double> without_corner_peaks(const std::vector<FlowPoint>& side, double (*number)(const FlowPoint&)) {
    constexpr double reach_share = 0.01;
    std::vector<double> numbers(side.size());
    std::transform(side.begin(), side.end(), numbers.begin(), number);
    if (side.empty()) return numbers;
    const double reach = reach_share * side.back().s;
    for (std::size_t i = 1; i + 1 < side.size(); ++i) {
        const double turning = core::angle_between(side[i].at - side[i - 1].at, side[i + 1].at - side[i].at);
        if (std::abs(core::degrees(turning)) < geometry::sharp_corner_deg) continue;
        std::size_t first = i, last = i;
        while (first > 0 && side[i].s - side[first].s < reach) --first;
        while (last + 1 < side.size() && side[last].s - side[i].s < reach) ++last;
        const double most = std::max(number(side[first]), number(side[last]));
        for (std::size_t k = first; k <= last; ++k) numbers[k] = std::min(numbers[k], most);
    }
    return numbers;
}

}  // namespace lamina::flow
