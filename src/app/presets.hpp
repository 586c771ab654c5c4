// Presets (lamina/presets.hpp) as the beginnings of cases.
#pragma once

#include <string>

#include <lamina/presets.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// The name of the option that chooses a preset.
inline constexpr const char* preset_option = "preset";

/// Returns the case that a preset begins with. None of its options counts as given, so that others may exclude it. A
/// name that no preset has gives the defaults; setting the option refuses it.
MeshCase case_of_preset(const std::string& name, bool has_reynolds);

}  // namespace lamina::app
