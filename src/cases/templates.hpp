// The files under share/cases, which the library carries with it.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace lamina::cases {

/// A file with placeholders such as @CHORD@.
struct Template {
    std::string_view solver;  ///< the folder under share/cases: "openfoam", or "common" for files of every solver
    std::string_view name;    ///< within that folder: "system/controlDict"
    std::string_view text;    ///< its contents
};

/// Returns all templates, those of one solver together, each solver's in a fixed order.
std::span<const Template> templates();

/// The words to put in place of placeholders, by their names without the signs @.
using Words = std::map<std::string, std::string, std::less<>>;

/// Returns the text with each @NAME@ replaced by its word, once: words may hold anything. Precondition: `words` has
/// every name in the text.
std::string fill_in(std::string_view text, const Words& words);

}  // namespace lamina::cases
