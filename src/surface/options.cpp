// The table of the options of the stage "prepare".
#include <lamina/surface.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/option_rows.hpp"
#include "core/text.hpp"
#include "geometry/element_names.hpp"

namespace lamina {

namespace {

constexpr OptionRange point_numbers = numbers_from_to(3, 1e7), base_edge_numbers = numbers_from_to(1, 1e6);
constexpr OptionRange side_edge_numbers = numbers_from_to(1, 1e6), stations = numbers_from_to(0, 1);
constexpr const char *exact_key = "exact_points", *sides_key = "points", *station_key = "spacing_at";

/// Returns two or three whole numbers that colons divide; nothing for other texts.
std::vector<std::int64_t> counts_of(const std::string& text, const char* key) {
    std::vector<std::int64_t> numbers;
    try {
        for (const double number : core::parse_numbers(text, ':')) numbers.push_back(as_count(number, key));
    } catch (const UsageError&) {
        numbers.clear();
    }
    return numbers;
}

/// Returns the number of edges of a base, where one is given.
std::optional<std::size_t> base_edges_of(std::span<const std::int64_t> number, const char* key) {
    if (number.empty()) return {};
    require_in_range(base_edge_numbers, static_cast<double>(number[0]), key);
    return static_cast<std::size_t>(number[0]);
}

/// Returns the end of a text that base_edges_of() reads back.
std::string base_text(const std::optional<std::size_t>& edges) { return edges ? ":" + core::to_text(*edges) : ""; }

void set_exact_points(SurfaceOptions& options, const OptionValue& value) {
    const std::string text = as_word_or_number(value, exact_key);
    const std::vector<std::int64_t> numbers = counts_of(text, exact_key);
    if (numbers.empty() || numbers.size() > 2)
        throw OptionError(exact_key, "'" + text + "': it is N or N:BASE, whole numbers");
    require_in_range(point_numbers, static_cast<double>(numbers[0]), exact_key);
    options.base_edges = base_edges_of(std::span(numbers).subspan(1), exact_key);
    options.exact_points = true;
    options.points = static_cast<std::size_t>(numbers[0]);
}

std::optional<OptionValue> exact_points_text(const SurfaceOptions& options) {
    if (!options.exact_points || !options.points) return std::nullopt;
    return core::to_text(*options.points) + base_text(options.base_edges);
}

/// Reads "[ELEMENT:]UPPER:LOWER[:BASE]". The first of two or three numbers is no name.
SideEdges parse_side_edges(const std::string& text) {
    const std::vector<std::int64_t> all = counts_of(text, sides_key);
    const std::size_t colon = text.find(':');
    const bool has_name = (all.empty() || all.size() > 3) && colon != std::string::npos && colon > 0;
    const std::vector<std::int64_t> numbers = has_name ? counts_of(text.substr(colon + 1), sides_key) : all;
    core::require_text(numbers.size() == 2 || numbers.size() == 3, text,
                       "it is UPPER:LOWER or ELEMENT:UPPER:LOWER, and :BASE behind, whole numbers");
    for (const std::int64_t number : {numbers[0], numbers[1]})
        require_in_range(side_edge_numbers, static_cast<double>(number), sides_key);
    return {static_cast<std::size_t>(numbers[0]), static_cast<std::size_t>(numbers[1]),
            base_edges_of(std::span(numbers).subspan(2), sides_key),
            has_name ? text.substr(0, colon) : geometry::every_element};
}

std::string side_edges_text(const SideEdges& sides) {
    const std::string name = sides.element == geometry::every_element ? "" : sides.element + ":";
    return name + core::concat(sides.upper, ":", sides.lower) + base_text(sides.base);
}

/// Reads "ELEMENT[:upper|:lower]:X=SHARE".
StationSpacing parse_station(const std::string& text) {
    constexpr const char* grammar = "a spacing at a station is ELEMENT:X=SHARE, or ELEMENT:upper:X=SHARE (lower)";
    const std::size_t equals = text.rfind('=');
    std::vector<std::string> parts = core::split(text.substr(0, equals), ':');
    core::require_text(equals != std::string::npos && (parts.size() == 2 || parts.size() == 3) && !parts[0].empty(),
                       text, grammar);
    StationSpacing result{parts[0], SurfaceSide::both, core::parse_number(parts.back()),
                          core::parse_number(text.substr(equals + 1))};
    if (parts.size() == 3) {
        core::require_text(parts[1] == "upper" || parts[1] == "lower", text, grammar);
        result.side = parts[1] == "upper" ? SurfaceSide::upper : SurfaceSide::lower;
    }
    return result;
}

std::string station_text(const StationSpacing& s) {
    const char* side = s.side == SurfaceSide::upper ? "upper:" : s.side == SurfaceSide::lower ? "lower:" : "";
    return core::concat(s.element, ":", side, s.station, "=", s.spacing);
}

/// Adds the options of the number of points: about one, or one exactly, of the whole outline or of its sides.
void add_numbers_of_points(OptionTableBuilder<SurfaceOptions>& table) {
    Option<SurfaceOptions>& about =
        table.count("surface-points", "N", "wall vertices per element, about; else as many as the ray angle requires",
                    point_numbers, member_at(&SurfaceOptions::points));
    about.get = [get = about.get](const SurfaceOptions& o) { return o.exact_points ? std::nullopt : get(o); };
    table
        .add({"exact-points", OptionKind::word, "N[:BASE]",
              "for sections whose meshes are to have the same walls and layers by number: exactly N wall vertices on "
              "each element, or there is no mesh; BASE edges on the base of a blunt trailing edge (N / 50); one ray at "
              "each vertex, but at sharp corners a fan with the rays of half a turn, max-ray-angle apart",
              point_numbers.text(), set_exact_points, exact_points_text})
        .excludes = {"surface-points"};
    Option<SurfaceOptions>& sides = table.specs(
        "points", "[ELEMENT:]UPPER:LOWER[:BASE]",
        "exactly so many wall edges on both sides of each element, or of one, or there is no mesh; BASE edges on the "
        "base of a blunt trailing edge (one for 50 of the others); may be given several times",
        parse_side_edges, side_edges_text, member_at(&SurfaceOptions::side_edges));
    // In a case file an empty list would exclude the others, too.
    sides.get = [get = sides.get](const SurfaceOptions& o) { return o.side_edges.empty() ? std::nullopt : get(o); };
    sides.range = side_edge_numbers.text();
    sides.excludes = {"surface-points", "exact-points"};
}

}  // namespace

template <>
OptionTable<SurfaceOptions> option_rows() {
    OptionTableBuilder<SurfaceOptions> table("Geometry");
    const auto at = [](auto SurfaceOptions::*member) { return member_at(member); };
    table.choice("surface",
                 "what becomes of the given points: they are kept, replaced by new ones on a spline through them, or "
                 "replaced where they are coarse",
                 Choices<SurfaceTreatment>{{"auto", SurfaceTreatment::automatic},
                                           {"keep", SurfaceTreatment::keep},
                                           {"resample", SurfaceTreatment::resample}},
                 at(&SurfaceOptions::treatment));
    add_numbers_of_points(table);
    table.number("spacing-le", "SHARE",
                 "wall spacing at the leading edge at most, in lengths of the element; makes auto resample. Where the "
                 "curvature asks for less, it gets less",
                 positive_numbers, at(&SurfaceOptions::leading_edge_spacing));
    table.number("spacing-te", "SHARE",
                 "wall spacing at the trailing edge, in lengths of the element; makes auto resample; else as the layer "
                 "asks, about 0.001",
                 positive_numbers, at(&SurfaceOptions::trailing_edge_spacing));
    table.specs(
        "spacing-at", "ELEMENT:X=SHARE",
        "wall spacing at a station of an element, or of all, at most: X from 0 at the leading to 1 at the trailing "
        "edge, SHARE in lengths of the element; ELEMENT:upper:X=SHARE (lower) on one side; makes auto resample; may be "
        "given several times",
        parse_station, station_text, at(&SurfaceOptions::station_spacings));
    table.flag("curve-kept",
               "with surface keep and curved cells (order), walls follow the spline through their points between "
               "corners; else they are straight from point to point",
               true, at(&SurfaceOptions::curve_kept));
    table.number("spacing-max", "SHARE", "largest wall spacing, in lengths of the element", positive_numbers,
                 at(&SurfaceOptions::max_spacing));
    table.length("smooth", "TOL", "smooth the points first; none moves by more than this", positive_numbers,
                 at(&SurfaceOptions::smooth));

    const auto library = [&](Option<SurfaceOptions>& option) { option.library_only = true; };
    library(table.number("max-turning", "DEG", "largest turning at a vertex between two corners",
                         numbers_above_up_to(0, 90), at(&SurfaceOptions::max_turning_deg)));
    library(table.number("max-ratio", "R", "largest ratio of neighbouring spacings", numbers_above(1),
                         at(&SurfaceOptions::max_ratio)));
    library(table.number("surface-gradation", "G", "growth of the spacing per unit of arc length", positive_numbers,
                         at(&SurfaceOptions::gradation)));
    const std::pair<const char*, double SurfaceOptions::*> shares[] = {
        {"sharp-corner-spacing", &SurfaceOptions::sharp_corner_spacing},
        {"corner-spacing", &SurfaceOptions::corner_spacing},
        {"gap-spacing", &SurfaceOptions::gap_spacing},
        {"min-spacing", &SurfaceOptions::min_spacing},
        {"surface-tolerance", &SurfaceOptions::tolerance},
    };
    for (const auto& [name, member] : shares)
        library(table.number(name, "SHARE", "see SurfaceOptions", positive_numbers, at(member)));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<SurfaceOptions>& option_table();

void validate(const SurfaceOptions& options) {
    require_in_range(option_table<SurfaceOptions>(), options);
    for (const StationSpacing& station : options.station_spacings) {
        require_in_range(stations, station.station, station_key);
        require_in_range(positive_numbers, station.spacing, station_key);
    }
    if (options.max_spacing < options.min_spacing)
        throw OptionError("spacing_max", core::concat(options.max_spacing, " is below the smallest spacing of ",
                                                      options.min_spacing, ", lengths of the element"));
    if (!options.side_edges.empty() && options.points)
        throw OptionError(sides_key, "excludes a number of points of the outline");
    if (options.exact_points && !options.points) throw OptionError(exact_key, "needs a number of points");
    if ((options.exact_points || !options.side_edges.empty()) && options.treatment == SurfaceTreatment::keep)
        throw OptionError(options.exact_points ? exact_key : sides_key,
                          "needs new points: surface must be auto or resample");
}

}  // namespace lamina
