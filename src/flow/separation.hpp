// Flow that leaves the walls so far apart that fluid is at rest behind them.
#pragma once

#include <optional>

#include <lamina/export.hpp>
#include <lamina/flow.hpp>

namespace lamina::flow {

/// The fluid at rest that begins between the two places where the boundary layers leave an element.
struct OpenWake {
    Point above, below;  ///< where they leave: where they separate for good, or the trailing edge
    Point stream;        ///< direction of the free stream, a unit vector
    double width;        ///< from one to the other across the stream
};

/// Returns the fluid at rest behind an element of this flow if it begins at least 0.16 chords wide, as behind stalled
/// sections, bluff bodies and thick bases: NACA 0012 at a Reynolds number of 6e6 has 0.06 at 15 degrees, 0.15 at 17 and
/// 0.2 at 18, a cylinder 0.7. What separates and reattaches, as in coves, does not count, and an estimated flow has
/// none.
LAMINA_EXPORT std::optional<OpenWake> find_open_wake(const Flow& flow, const ElementFlow& element);

/// Returns WarningCode::flow_separates about the widest of the open wakes, if any. Precondition: the flow has boundary
/// layers.
LAMINA_EXPORT std::optional<Warning> find_wide_wake(const Flow& flow);

}  // namespace lamina::flow
