// Potential flow beside sharp corners.
#pragma once

#include <optional>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/flow.hpp>

namespace lamina::flow {

/// Returns a number at each point of a side as real flow has it beside sharp corners before the trailing edge, as the
/// lip of a slat. Potential flow is infinitely fast there; real flow leaves the wall instead. Within 1 % of the side
/// from such a corner, the number counts as no more than the larger one at the ends of that stretch. `sharp_nose`
/// counts as one: that of a sheet, which is round for the panel method alone.
LAMINA_EXPORT std::vector<double> without_corner_peaks(const std::vector<FlowPoint>& side,
                                                       double (*number)(const FlowPoint&),
                                                       const std::optional<Point>& sharp_nose = {});

}  // namespace lamina::flow
