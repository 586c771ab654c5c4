#include "core/marker_names.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/text.hpp"

namespace lamina::core {

namespace {

// Character classes of ASCII, whatever the locale is.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_legal(char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '.'; }

/// Returns whether a byte goes on with a character of UTF-8 that an earlier one has begun.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Words that mean something else, in lower case.
constexpr std::array reserved_words =
    std::to_array<std::string_view>({"none",          // SU2: no marker
                                     "send_receive",  // SU2: a border between processes
                                     "frontandback",
                                     "defaultfaces",  // OpenFOAM: the sides, and faces without a patch
                                     "y0",
                                     "y1",  // FUN3D: the planes at the ends of a span
                                     "z0",
                                     "z1",        // those of other formats
                                     "interior",  // Fluent: the faces between cells
                                     "zone",
                                     "zonetype",
                                     "zonebc",
                                     "gridcoordinates",  // CGNS: nodes beside those of markers
                                     "layer",
                                     "isotropic",
                                     "fluid",  // groups of cells, which readers of Gmsh's files list beside markers
                                     "layer_triangles",
                                     "isotropic_triangles",
                                     "fluid_triangles",  // their sections in CGNS
                                     "layer_quads",
                                     "isotropic_quads",
                                     "fluid_quads",  //
                                     "nan",
                                     "inf",
                                     "infinity",
                                     "na",
                                     "null"});  // what reads a table of walls takes these for numbers, or for none

bool is_reserved(std::string_view name) {
    const std::string lower = lower_case(std::string(name));
    return std::find(reserved_words.begin(), reserved_words.end(), lower) != reserved_words.end();
}

/// Returns whether a wall of this name would be taken for an outer boundary where a file does not say kinds.
bool is_mistaken(const NamedMarker& marker) {
    return marker.kind == MarkerKind::wall && !may_be_wall(kind_of_name(marker.name));
}

/// Says why a name is not legal by itself; nothing where it is.
std::string defect_of(const NamedMarker& marker) {
    const std::string& name = marker.name;
    if (name.empty()) return "is empty";
    if (!is_letter(name.front())) return "does not begin with a letter";
    if (!std::all_of(name.begin(), name.end(), is_legal)) return "has characters other than letters, digits and _ - .";
    if (name.size() > max_marker_name) return concat("has more than ", max_marker_name, " characters");
    if (is_reserved(name)) return "means something else to a format or a solver";
    if (is_mistaken(marker)) return "reads as that of an outer boundary";
    return {};
}

/// The beginnings of names that need one, such that the name says the kind in the order of MarkerKind.
constexpr std::array<const char*, 6> beginnings{"wall_", "far_", "symmetry_", "marker_", "periodic_", "line_"};

/// Returns a name that is legal by itself.
std::string changed(const NamedMarker& marker) {
    std::string name;
    for (const char c : marker.name)
        if (!continues_character(c)) name += is_legal(c) ? c : '_';
    NamedMarker result{name.substr(0, max_marker_name), marker.kind};
    if (!defect_of(result).empty())
        result.name = (beginnings[static_cast<std::size_t>(marker.kind)] + name).substr(0, max_marker_name);
    return result.name;
}

}  // namespace

MarkerKind kind_of_name(std::string_view name) {
    std::string letters;
    for (const char c : name)
        if (is_letter(c)) letters += c;
    letters = lower_case(std::move(letters));
    if (letters == "farfield" || letters == "far" || letters == "inlet" || letters == "outlet")
        return MarkerKind::far_field;
    if (letters == "symmetry" || letters == "symmetryplane" || letters == "axis") return MarkerKind::symmetry;
    if (letters == "periodiclower" || letters == "periodicupper") return MarkerKind::periodic;
    if (letters == "wall" || letters == "airfoil") return MarkerKind::wall;
    return MarkerKind::other;
}

std::vector<std::string> legal_marker_names(std::span<const NamedMarker> markers) {
    std::vector<std::string> names(markers.size());
    std::set<std::string> used;                // in lower case
    std::map<std::string, std::size_t> tried;  // the last number behind each stem
    for (std::size_t i = 0; i < markers.size(); ++i)
        if (defect_of(markers[i]).empty() && used.insert(lower_case(markers[i].name)).second)
            names[i] = markers[i].name;
    for (std::size_t i = 0; i < markers.size(); ++i) {
        if (!names[i].empty()) continue;
        const std::string stem = changed(markers[i]);
        names[i] = stem;
        while (!used.insert(lower_case(names[i])).second) {
            const std::string suffix = concat("_", ++tried.try_emplace(stem, 1).first->second);
            names[i] = stem.substr(0, max_marker_name - suffix.size()) + suffix;
        }
    }
    return names;
}

Warning renamed_marker_warning(const NamedMarker& given, const std::string& name) {
    std::string reason = defect_of(given);
    if (reason.empty()) reason = "is that of another marker, or differs from it by case alone";
    return {.code = WarningCode::marker_renamed,
            .number = 1,
            .unit = "markers",
            .message = concat("the name '", given.name, "' ", reason, ": the marker is '", name, "'")};
}

}  // namespace lamina::core

namespace lamina {

std::string legal_marker_name(const std::string& name, MarkerKind kind) {
    return core::legal_marker_names(std::array{core::NamedMarker{name, kind}}).front();
}

}  // namespace lamina
