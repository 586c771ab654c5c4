// Flow that has left the walls so far ahead that a mesh for attached flow does not suit it.
#pragma once

#include <optional>

#include <lamina/flow.hpp>

namespace lamina::flow {

/// Returns WarningCode::flow_separates where the boundary layers leave an element so far apart that its wake begins with
/// fluid at rest, as behind stalled sections and bluff bodies; for the widest of several elements. What separates and
/// reattaches, as in coves, does not count, and an estimated flow says nothing.
std::optional<Warning> find_wide_wake(const Flow& flow);

}  // namespace lamina::flow
