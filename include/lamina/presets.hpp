// Presets: options that go together, as the defaults of a run.
#pragma once

#include <string>

#include <lamina/export.hpp>
#include <lamina/option_builders.hpp>
#include <lamina/pipeline.hpp>

namespace lamina {

/// The word for no preset.
inline constexpr const char* no_preset = "none";
/// The word for the preset that suits the other options.
inline constexpr const char* automatic_preset = "auto";

/// The names of the options that say the Reynolds number, with which the automatic preset is "rans".
inline constexpr const char* reynolds_options[] = {"reynolds", "velocity"};

/// Returns the words that name presets: those for the automatic preset and for none, and the names of all presets.
LAMINA_EXPORT const Choices<std::string>& preset_choices();

/// Returns the options that a preset begins with. A name that no preset has gives the defaults. The automatic preset is
/// "rans" where there will be a Reynolds number, and none elsewhere.
LAMINA_EXPORT CaseOptions preset_options(const std::string& name, bool has_reynolds);

}  // namespace lamina
