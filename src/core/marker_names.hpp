// The names of markers that all formats, solvers and shells take (docs/reference/formats.md, "Names of markers").
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/marker_names.hpp>
#include <lamina/warning.hpp>

namespace lamina::core {

/// The number of kinds of markers, of which MarkerKind::internal is the last.
inline constexpr std::size_t marker_kind_count = static_cast<std::size_t>(MarkerKind::internal) + 1;

/// The words for the kinds of markers in files and bindings, in the order of MarkerKind.
inline constexpr std::array marker_kind_words{"wall", "far_field", "symmetry", "other", "periodic", "internal"};
static_assert(marker_kind_words.size() == marker_kind_count);

/// Returns the word for a kind.
inline const char* word_of(MarkerKind kind) { return marker_kind_words[static_cast<std::size_t>(kind)]; }

/// The largest length of the name of a marker in bytes: that of a node of CGNS.
inline constexpr std::size_t max_marker_name = 32;

/// The marker of the outer boundary.
inline constexpr std::string_view far_field_name = "farfield";

/// The markers of the borders between the blades of a row.
inline constexpr std::string_view periodic_lower_name = "periodic_lower", periodic_upper_name = "periodic_upper";

/// Returns the kind of a marker that has no kind, as in a file of a format without kinds, judged by its name. Case,
/// punctuation and digits do not count.
LAMINA_EXPORT MarkerKind kind_of_name(std::string_view name);

/// Returns the kind of a marker that a file tells, or periodic where the file has no word for it and the name says so.
inline MarkerKind kind_or_periodic(MarkerKind told, std::string_view name) {
    return told == MarkerKind::other && kind_of_name(name) == MarkerKind::periodic ? MarkerKind::periodic : told;
}

/// A name that a marker is to have, and its kind.
struct NamedMarker {
    std::string name;                     ///< any bytes
    MarkerKind kind = MarkerKind::other;  ///< the boundary condition that it is meant for
};

/// Returns the names of markers that every format, solver and shell takes, in the order of the markers. A legal name
/// begins with a letter, has at most max_marker_name letters, digits, '_', '-' or '.', differs from all others by more
/// than case, and is no word that a format or a solver keeps for itself; a wall does not have a name that reads as an
/// outer boundary. Legal names stay; of several that differ by case alone, the first. Other characters become
/// underscores, "0012" becomes "wall_0012" (far_, symmetry_, periodic_, line_ or marker_ for other kinds), and a number
/// behind it tells those apart that have become the same. Names returned stay when they are given again with the same
/// kinds.
LAMINA_EXPORT std::vector<std::string> legal_marker_names(std::span<const NamedMarker> markers);

/// Returns the warning that a marker has another name than it was given: "the name '0012' does not begin with a letter:
/// the marker is 'wall_0012'". Precondition: the names differ.
LAMINA_EXPORT Warning renamed_marker_warning(const NamedMarker& given, const std::string& name);

}  // namespace lamina::core
