// Presets: options that go together, as the defaults of a run.
//
// Guarantees:
//  1. preset_options() takes every word of preset_choices().
// Example:
//     const CaseOptions rans = preset_options(automatic_preset, true);
//     assert(std::holds_alternative<YPlus>(rans.layer.first_height));
//     assert(std::holds_alternative<Length>(preset_options(automatic_preset, false).layer.first_height));
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina {

inline constexpr const char* no_preset = "none";         ///< the word for no preset
inline constexpr const char* automatic_preset = "auto";  ///< the word for the preset that suits the other options

/// The names of the options that say the Reynolds number, with which the automatic preset is "rans".
inline constexpr const char* reynolds_options[] = {"reynolds", "velocity"};
/// Returns the words that name presets, each twice: those for the automatic preset and for none, and the names of all.
LAMINA_EXPORT const std::vector<std::pair<std::string, std::string>>& preset_choices();
/// Returns the options that a preset begins with. A name that no preset has gives the defaults. The automatic preset is
/// "rans" where there will be a Reynolds number, and none elsewhere.
LAMINA_EXPORT CaseOptions preset_options(const std::string& name, bool has_reynolds);

}  // namespace lamina
