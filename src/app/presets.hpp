// Presets: options that go together, as the defaults of a run.
#pragma once

#include <string>

#include <lamina/option_builders.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// The name of the option that chooses a preset.
inline constexpr const char* preset_option = "preset";

/// The names of the options that say the Reynolds number, with which the automatic preset is "rans".
inline constexpr const char* reynolds_options[] = {"reynolds", "velocity"};

/// Returns what the option may be: the words for the automatic preset and for none, and the names of all presets.
const Choices<std::string>& preset_choices();

/// Returns the case that a preset begins with. None of its options counts as given, so that others may exclude it. A
/// name that no preset has gives the defaults; setting the option refuses it. The automatic preset is "rans" where the
/// case has a Reynolds number, and none elsewhere.
MeshCase case_of_preset(const std::string& name, bool has_reynolds);

}  // namespace lamina::app
