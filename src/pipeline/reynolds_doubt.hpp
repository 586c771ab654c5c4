// Whether velocity and viscosity are given in the units of the coordinates.
#pragma once

#include <optional>
#include <string>

#include <lamina/conditions.hpp>

namespace lamina::pipeline {

/// Returns one sentence that says why a Reynolds number is implausible and what to give instead; nothing for plausible
/// ones. `unit` is the unit of length that the file names, empty where it names none. The number is that of no flow
/// below 1 and above 1e10: the largest ships reach 5e9. One that follows from velocity and viscosity is implausible
/// where
/// - the file names its unit, and no fluid has this viscosity in it, but in metres;
/// - the file names none, and in metres the body would be longer than any that this fluid flows round.
std::optional<std::string> doubt_of_reynolds(const FlowConditions& conditions, const ReferenceConditions& reference,
                                             const std::string& unit);

}  // namespace lamina::pipeline
