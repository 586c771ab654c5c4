// Options that earlier versions of lamina had: what serves in their place, or why none is needed.
//
// Guarantees:
//  1. No option that is in use is found.
// Example:
//     const FormerOption* flip = find_former_option("--flip");
//     assert(flip != nullptr && !advice_on_command_line(*flip).empty() && find_former_option("growth") == nullptr);
#pragma once

#include <span>
#include <string>

#include <lamina/export.hpp>

namespace lamina {

/// An option of meshes that is gone.
struct FormerOption {
    const char* name;       ///< as it was on the command line, without hyphens in front: "fan-rays"
    const char* arguments;  ///< what to give on the command line in its place; empty: nothing
    const char* line;       ///< what to write in a case file or a script in its place; empty: nothing
    const char* reason;     ///< a clause that says what the replacement does, or why none is needed
};

LAMINA_EXPORT std::span<const FormerOption> former_options();  ///< all of them

/// Returns the former option that a word names; none is null. Case, hyphens and underscores do not count.
LAMINA_EXPORT const FormerOption* find_former_option(const std::string& word);
/// Returns advice to whoever gave the option on the command line: "give --exact-points N: ..."; "leave it out: ...".
LAMINA_EXPORT std::string advice_on_command_line(const FormerOption& option);
/// Returns advice to whoever wrote the option in a case file or a script: "write exact_points = N: ...".
LAMINA_EXPORT std::string advice_in_file(const FormerOption& option);
/// Throws OptionError with advice_in_file() where the key, such as "fan_rays", is that of a former option.
LAMINA_EXPORT void refuse_former_option(const std::string& key);

}  // namespace lamina
