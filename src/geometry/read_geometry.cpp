// The stage "read" as a whole: inputs -> named and checked elements.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/files.hpp>
#include <lamina/geometry.hpp>
#include <lamina/predicates.hpp>

#include "core/bounding_box.hpp"
#include "core/suggestion.hpp"
#include "core/text.hpp"
#include "geometry/characters.hpp"
#include "geometry/element_names.hpp"
#include "geometry/half_section.hpp"
#include "geometry/joined_files.hpp"
#include "geometry/naca.hpp"
#include "geometry/orientation_warnings.hpp"
#include "geometry/outline_repair.hpp"
#include "geometry/parse_airfoil.hpp"
#include "geometry/point_runs.hpp"
#include "geometry/sheets.hpp"
#include "geometry/tail_shape.hpp"
#include "geometry/unite.hpp"

namespace lamina::geometry {

namespace {

/// Returns the trailing edge that a word of an input names.
std::optional<TrailingEdge> trailing_edge_named(const std::string& word) {
    if (word == "sharp") return TrailingEdge::sharp;
    if (word == "blunt") return TrailingEdge::blunt;
    if (word == "extended") return TrailingEdge::extended;
    return {};
}

/// Returns the section of an input naca:DIGITS[:POINTS][:blunt|:extended|:sharp].
Element read_naca(const std::string& input, std::size_t default_points) {
    std::vector<std::string> parts = core::split(input.substr(naca_prefix.size()), ':');
    std::size_t points = default_points;
    const std::optional<TrailingEdge> named = parts.size() > 1 ? trailing_edge_named(parts.back()) : std::nullopt;
    if (named) parts.pop_back();
    if (parts.size() == 2) {
        const std::string& s = parts[1];
        const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), points);
        const std::vector<std::string> trailing_edges{"sharp", "blunt", "extended"};
        if (error != std::errc() || end != s.data() + s.size())
            throw UsageError(fmt::format("{}: '{}' is neither a number of points nor sharp, blunt or extended{}", input,
                                         s, did_you_mean(closest_word(s, trailing_edges))));
    } else if (parts.size() != 1) {
        throw UsageError(fmt::format("{}: expected naca:DIGITS[:POINTS][:blunt|:extended|:sharp]", input));
    }
    const bool is_free = parts.size() == 1 && default_points == 0;
    const TrailingEdge trailing_edge = named.value_or(TrailingEdge::sharp);
    Element element =
        is_free ? sample_naca_section(parts[0], trailing_edge) : naca_airfoil(parts[0], points, trailing_edge);
    element.file = input;
    return element;
}

/// Returns "naca:DIGITS" for a word that probably means a section: "naca0012", "NACA 0012", "0012". Empty for others.
std::string meant_section(const std::string& input) {
    std::size_t at = 0;
    const std::string prefix = "naca";
    while (at < prefix.size() && at < input.size() && (input[at] | ' ') == prefix[at]) ++at;
    if (at == prefix.size() && at == input.size()) return "naca:0012";
    if (at != prefix.size() && at != 0) return {};
    const std::size_t digits = std::min(input.find_first_not_of("-_: ", at), input.size());
    const std::size_t end = std::min(input.find(':', digits), input.size());
    const bool all_digits = std::all_of(input.begin() + static_cast<std::ptrdiff_t>(digits),
                                        input.begin() + static_cast<std::ptrdiff_t>(end), is_digit);
    if (!all_digits || end - digits < 4 || end - digits > 5) return {};
    return std::string(naca_prefix) + input.substr(digits);
}

bool turns(const Transformation& t) {
    return std::holds_alternative<Rotation>(t.change) || std::holds_alternative<FlapDeflection>(t.change);
}

/// Transforms a geometry, and says where its elements lie without rotations and flaps. A section that stands upright is
/// turned to lie in the flow, and its chord is that of the turned one.
Geometry transformed_with_boxes(const Geometry& geometry, const std::vector<Transformation>& transformations) {
    constexpr double upright = 2;  // height over length, as for the warning of swapped columns
    std::vector<Transformation> others;
    std::remove_copy_if(transformations.begin(), transformations.end(), std::back_inserter(others), turns);
    const Geometry unturned = transformed(geometry, others);
    const bool any_turns = others.size() < transformations.size();
    Geometry result = any_turns ? transformed(geometry, transformations) : unturned;
    const auto is_upright = [&](const Box& box) { return box.height() > upright * box.width(); };
    const Box all = bounding_box(unturned);
    if (any_turns && !is_upright(all)) result.unturned_box = all;
    for (std::size_t e = 0; e < result.elements.size(); ++e) {
        const Element &before = unturned.elements[e], &after = result.elements[e];
        const Box box = core::bounding_box(before.points);
        result.unturned_elements.push_back(
            {after.name, after.given_name, is_upright(box) ? core::bounding_box(after.points) : box});
    }
    return result;
}

/// Returns the contents of an airfoil file. An error says where the name was probably meant to be a section.
std::string contents_of(const std::string& input) {
    try {
        return read_file(input, max_text_bytes);
    } catch (const IoError& error) {
        const std::string section = meant_section(input);
        if (section.empty()) throw;
        throw IoError(error.file(), error.reason() + did_you_mean(section));
    }
}

}  // namespace

}  // namespace lamina::geometry

namespace lamina {

using namespace geometry;

std::vector<Element> read_inputs(std::span<const std::string> inputs, const GeometryOptions& options) {
    std::vector<Element> elements;
    std::vector<OutlinesOfFile> files;  // in a row
    const auto repair = [&] {
        join_files(files);
        for (auto& [file, outlines] : files)
            for (RawOutline& outline : outlines)  // which is freed: a file may have many thousands
                elements.push_back(repair_outline(std::exchange(outline, {}), file, options));
        files.clear();
    };
    for (const std::string& input : inputs) {
        if (input.starts_with(naca_prefix)) {
            repair();
            elements.push_back(read_naca(input, options.naca_points));
        } else {
            const std::string file = input_name(input);
            files.push_back({file, read_outlines(contents_of(input), file, options)});
        }
    }
    repair();
    return elements;
}

Element element_of_points(std::span<const Point> points, const std::string& source, const GeometryOptions& options) {
    PointRun run;
    run.reserve(points.size());
    for (const Point p : points) {
        run.push_back({{p, static_cast<std::uint32_t>(run.size() + 1)}});
        if (!in_exact_range(p)) throw InputError({source, run.size(), {}}, "no number, or outside the exact range");
    }
    RawOutline outline;
    if (const auto second = find_second_surface(run))
        outline.points = join_surfaces(PointSpan(run).first(*second), PointSpan(run).subspan(*second));
    else
        outline.points.assign(run.begin(), run.end());
    outline.format = "points";
    if (options.mirror_half) outline.points = mirrored_half(std::move(outline.points), source);
    return repair_outline(outline, source, options);
}

Geometry make_geometry(std::vector<Element> elements, const GeometryOptions& options) {
    validate(options);
    if (elements.empty() && options.sheets.empty()) throw UsageError("no input given");
    Geometry geometry{std::move(elements)};
    name_elements(geometry.elements, options);
    for (Element& element : geometry.elements) shape_tail(element, options);
    for (const Sheet& sheet : options.sheets) geometry.elements.push_back(open_sheet(sheet));
    geometry = transformed_with_boxes(geometry, options.transformations);
    const auto first_sheet = geometry.elements.end() - static_cast<std::ptrdiff_t>(options.sheets.size());
    const std::vector<Element> sheets(first_sheet, geometry.elements.end());
    geometry.elements.erase(first_sheet, geometry.elements.end());
    if (options.unite && !geometry.elements.empty()) geometry = unite(std::move(geometry));
    geometry = with_sheets(std::move(geometry), sheets);
    check_simple(geometry);
    add_orientation_warnings(geometry);
    return geometry;
}

Geometry read_geometry(std::span<const std::string> inputs, const GeometryOptions& options) {
    validate(options);
    return make_geometry(read_inputs(inputs, options), options);
}

}  // namespace lamina
