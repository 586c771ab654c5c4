#include "geometry/column_names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "geometry/characters.hpp"
#include "geometry/length_units.hpp"

namespace lamina::geometry {

namespace {

struct NamedRole {
    std::string_view name;
    ColumnRole role;
};

/// Names without what plain_name() takes away. An ordinate may be called z where z points up.
constexpr std::array<NamedRole, 82> named_roles = {{
    {"x", ColumnRole::x},
    {"xcoord", ColumnRole::x},
    {"xcoordinate", ColumnRole::x},
    {"station", ColumnRole::x},
    {"abscissa", ColumnRole::x},
    {"xc", ColumnRole::x},        // over the chord, or along the camber line
    {"points:0", ColumnRole::x},  // as ParaView names coordinates
    {"points0", ColumnRole::x},
    {"y", ColumnRole::y},
    {"ycoord", ColumnRole::y},
    {"ycoordinate", ColumnRole::y},
    {"ordinate", ColumnRole::y},
    {"points:1", ColumnRole::y},
    {"points1", ColumnRole::y},
    {"z", ColumnRole::z},
    {"zcoord", ColumnRole::z},
    {"zcoordinate", ColumnRole::z},
    {"points:2", ColumnRole::z},
    {"points2", ColumnRole::z},
    {"xu", ColumnRole::upper_x},
    {"xup", ColumnRole::upper_x},
    {"xupper", ColumnRole::upper_x},
    {"upperx", ColumnRole::upper_x},
    {"xtop", ColumnRole::upper_x},
    {"xo", ColumnRole::upper_x},
    {"yu", ColumnRole::upper},
    {"yup", ColumnRole::upper},
    {"yupper", ColumnRole::upper},
    {"uppery", ColumnRole::upper},
    {"upper", ColumnRole::upper},
    {"uppersurface", ColumnRole::upper},
    {"ytop", ColumnRole::upper},
    {"top", ColumnRole::upper},
    {"yo", ColumnRole::upper},
    {"zu", ColumnRole::upper},
    {"zup", ColumnRole::upper},
    {"zupper", ColumnRole::upper},
    {"upperz", ColumnRole::upper},
    {"xl", ColumnRole::lower_x},
    {"xlo", ColumnRole::lower_x},
    {"xlow", ColumnRole::lower_x},
    {"xlower", ColumnRole::lower_x},
    {"lowerx", ColumnRole::lower_x},
    {"xbot", ColumnRole::lower_x},
    {"yl", ColumnRole::lower},
    {"ylo", ColumnRole::lower},
    {"ylow", ColumnRole::lower},
    {"ylower", ColumnRole::lower},
    {"lowery", ColumnRole::lower},
    {"lower", ColumnRole::lower},
    {"lowersurface", ColumnRole::lower},
    {"ybot", ColumnRole::lower},
    {"ybottom", ColumnRole::lower},
    {"bottom", ColumnRole::lower},
    {"yb", ColumnRole::lower},
    {"zl", ColumnRole::lower},
    {"zlow", ColumnRole::lower},
    {"zlower", ColumnRole::lower},
    {"lowerz", ColumnRole::lower},
    {"t", ColumnRole::thickness},
    {"thickness", ColumnRole::thickness},
    {"thick", ColumnRole::thickness},
    {"thk", ColumnRole::thickness},
    {"d", ColumnRole::thickness},  // as German tables call it beside x/t and f/t
    {"yt", ColumnRole::half_thickness},
    {"zt", ColumnRole::half_thickness},
    {"halfthickness", ColumnRole::half_thickness},
    {"thickness/2", ColumnRole::half_thickness},
    {"t/2", ColumnRole::half_thickness},
    {"f", ColumnRole::camber},
    {"camber", ColumnRole::camber},
    {"camberline", ColumnRole::camber},
    {"meanline", ColumnRole::camber},
    {"yc", ColumnRole::camber},
    {"zc", ColumnRole::camber},
    {"yf", ColumnRole::camber},
    {"i", ColumnRole::counter},
    {"n", ColumnRole::counter},
    {"no", ColumnRole::counter},
    {"index", ColumnRole::counter},
    {"point", ColumnRole::counter},
    {"group", ColumnRole::counter},
}};

bool joins_parts(char c) { return c == '_' || c == '-' || c == ' ' || c == '.'; }

/// Returns the length of a division by the chord at the start of a text: 2 for "/c" and "/c_upper"; 0 for other texts.
std::size_t division_length(std::string_view text) {
    for (const std::string_view chord : {"/chord", "/c", "/l", "/t"})
        if (text.starts_with(chord) && (text.size() == chord.size() || joins_parts(text[chord.size()])))
            return chord.size();
    return 0;
}

/// Returns the name of a column without its unit, its division by the chord, and the characters that join its parts:
/// "x" of "x [m]", "x/c" and "x_mm", "yupper" of "y_upper/c" and "y/c_upper".
std::string plain_name(const std::string& name) {
    std::string_view plain = trimmed(std::string_view(name).substr(0, name.find_first_of("[(")));
    if (const std::size_t joint = plain.find_last_of("_ "); joint != std::string_view::npos && joint > 0)
        if (length_unit(plain.substr(joint + 1))) plain = plain.substr(0, joint);
    std::string joined;
    while (!plain.empty()) {
        if (const std::size_t length = joined.empty() ? 0 : division_length(plain); length > 0) {
            plain.remove_prefix(length);
        } else {
            if (!joins_parts(plain[0])) joined += plain[0];
            plain.remove_prefix(1);
        }
    }
    return joined;
}

ColumnRole role_of(const std::string& plain) {
    const auto found =
        std::find_if(named_roles.begin(), named_roles.end(), [&](const auto& named) { return named.name == plain; });
    return found == named_roles.end() ? ColumnRole::unknown : found->role;
}

/// Names that mean something else beside each other than alone: yt and yb are top and bottom, and yo and yu are oben
/// and unten, German for above and below.
void read_pairs(const std::vector<std::string>& plain, std::vector<ColumnRole>& roles) {
    const auto place = [&](std::string_view name) {
        return static_cast<std::size_t>(std::find(plain.begin(), plain.end(), name) - plain.begin());
    };
    for (const auto& [upper, lower] : {std::pair{"yt", "yb"}, {"zt", "zb"}, {"yo", "yu"}, {"zo", "zu"}}) {
        const std::size_t u = place(upper), l = place(lower);
        if (u == plain.size() || l == plain.size()) continue;
        roles[u] = ColumnRole::upper;
        roles[l] = ColumnRole::lower;
    }
    const std::size_t u = place("xo"), l = place("xu");
    if (u != plain.size() && l != plain.size()) roles[l] = ColumnRole::lower_x;
}

/// Makes x, y, x, y the columns of two surfaces, as tables of NACA reports have them below "upper surface" and "lower
/// surface". Which of them is the upper one does not matter to the outline.
void read_repeated(std::vector<ColumnRole>& roles) {
    if (std::count(roles.begin(), roles.end(), ColumnRole::x) != 2 ||
        std::count(roles.begin(), roles.end(), ColumnRole::y) != 2)
        return;
    *std::find(roles.begin(), roles.end(), ColumnRole::x) = ColumnRole::upper_x;
    *std::find(roles.begin(), roles.end(), ColumnRole::x) = ColumnRole::lower_x;
    *std::find(roles.begin(), roles.end(), ColumnRole::y) = ColumnRole::upper;
    *std::find(roles.begin(), roles.end(), ColumnRole::y) = ColumnRole::lower;
}

/// Returns the unit that a name ends with, in brackets or behind a joint: "mm" of "x [mm]", "X(mm)", "x_mm" and "x mm".
std::string unit_of_name(const std::string& name) {
    const std::string_view text = trimmed(name);
    const std::size_t open = text.find_first_of("[("), joint = text.find_last_of("_ ");
    if (open != std::string_view::npos) return unit_of_text(text.substr(open));
    return joint == std::string_view::npos ? std::string() : unit_of_text(text.substr(joint + 1));
}

}  // namespace

std::vector<ColumnRole> column_roles(const std::vector<std::string>& names) {
    std::vector<std::string> plain;
    std::vector<ColumnRole> roles;
    for (const std::string& name : names) {
        plain.push_back(plain_name(name));
        roles.push_back(role_of(plain.back()));
    }
    read_pairs(plain, roles);
    read_repeated(roles);
    return roles;
}

std::optional<std::size_t> column_with(const std::vector<ColumnRole>& roles, ColumnRole role) {
    if (std::count(roles.begin(), roles.end(), role) != 1) return std::nullopt;
    return static_cast<std::size_t>(std::find(roles.begin(), roles.end(), role) - roles.begin());
}

std::vector<std::string> units_of_names(const std::vector<std::string>& names) {
    std::vector<std::string> units;
    for (const std::string& name : names) {
        if (role_of(plain_name(name)) == ColumnRole::unknown) continue;
        std::string unit = name.find('%') != std::string::npos ? "%" : unit_of_name(name);
        if (!unit.empty() && std::find(units.begin(), units.end(), unit) == units.end())
            units.push_back(std::move(unit));
    }
    return units;
}

std::string unit_of_text(std::string_view text) {
    text = trimmed(text);
    if (!text.empty() && (text.front() == '[' || text.front() == '(')) text.remove_prefix(1);
    const auto unit = length_unit(trimmed(text.substr(0, text.find_first_of("])"))));
    return unit ? std::string(unit->name) : std::string();
}

bool are_units(const std::vector<std::string>& names) {
    const auto is_none = [&](const std::string& name) { return name == "-" || name == "[-]" || name == "(-)"; };
    return !names.empty() && std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return is_none(name) || !unit_of_text(name).empty();
    });
}

}  // namespace lamina::geometry
