// Presets: options that go together, as the defaults of a run.
#pragma once

#include <string>

#include <lamina/option_builders.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// The name of the option that chooses a preset.
inline constexpr const char* preset_option = "preset";

/// Returns what the option may be: the word for no preset, and the names of all presets.
const Choices<std::string>& preset_choices();

/// Returns the case that a preset begins with. None of its options counts as given, so that others may exclude it. A
/// name that no preset has gives the defaults; setting the option refuses it.
MeshCase case_of_preset(const std::string& name);

}  // namespace lamina::app
