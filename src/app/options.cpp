#include "app/options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/io.hpp>

#include "app/format_help.hpp"
#include "app/presets.hpp"
#include "core/option_builders.hpp"

namespace lamina::app {

namespace {

/// The headings of the help, in their order.
constexpr std::array<std::string_view, 6> groups{"Files", "Geometry", "Flow", "Layer", "Outer region", "Run"};

OptionTable<MeshCase> file_options() {
    OptionTableBuilder<MeshCase> table("Files");
    table.list("input", OptionKind::paths, "INPUT", input_help, member_at(&MeshCase::inputs));
    table.list("output", OptionKind::paths, "FILE",
               "mesh file to write; may be given several times; - is standard output, with --format",
               member_at(&MeshCase::outputs));
    table.choice(preset_option,
                 "options to begin with, which all others override; rans: y+ 1, layers up to isotropy, and what the "
                 "flow asks for; wall-function: likewise with y+ 60; euler: no layer; les2d: fine and slowly growing; "
                 "thesis: what the cases of J. K. Pardue's thesis have in common; auto: rans where a Reynolds number "
                 "is given, else none",
                 preset_choices(), member_at(&MeshCase::preset));
    table.text("format", OptionKind::word, format_names(),
               "format of every mesh file; else the extension of each says its format", member_at(&MeshCase::format));
    table.flag("stream",
               "write the mesh while it is made, piece by piece, in the memory of a few pieces: the same file; SU2 and "
               "VTU alone",
               true, member_at(&MeshCase::stream));
    table.count(
        "parts", "N",
        "number of parts of equal size: of PVTU files, and of the file cellDecomposition beside OpenFOAM's polyMesh, "
        "which decomposePar reads",
        numbers_from_to(1, max_parts), member_at(&MeshCase::parts));
    table.length("span", "L",
                 "depth of the mesh, which becomes one of prisms and hexahedra in space: CGNS, VTU, msh22-extruded, "
                 "OpenFOAM, FUN3D",
                 positive_numbers, member_at(&MeshCase::span));
    table.count("span-cells", "N", "number of cells across --span", numbers_from_to(1, 100'000),
                member_at(&MeshCase::span_cells));
    table.choice("span-ends", "what the two planes at the ends of --span are",
                 Choices<bool>{{"symmetry", false}, {"periodic", true}}, member_at(&MeshCase::span_periodic));
    table.flag("wall-distance", "write the distance to the nearest wall as point data, in VTU files", true,
               member_at(&MeshCase::wall_distance));
    table.text("wall-data", OptionKind::path, "FILE",
               "CSV file to write: the wall vertices in order with marker, vertex, x, y, arc length, normal and first "
               "height",
               member_at(&MeshCase::wall_data));
    table.text("report", OptionKind::path, "FILE", "JSON report of the run to write", member_at(&MeshCase::report));
    table.text("html", OptionKind::path, "FILE",
               "report of the run to look at: one HTML file with a view of the mesh to zoom into, charts and warnings",
               member_at(&MeshCase::html));
    return table.take();
}

OptionTable<MeshCase> other_options() {
    OptionTableBuilder<MeshCase> sizes("Outer region");
    sizes.text("background", OptionKind::path, "FILE",
               "VTU or MSH mesh to read with an edge length at each vertex, in units of the input: the point data "
               "'size', or the only scalar point data; linear in its triangles",
               member_at(&MeshCase::background));
    OptionTable<MeshCase> table = sizes.take();
    OptionTableBuilder<MeshCase> run("Run");
    run.choice(
        "progress",
        "print the names of the stages on standard error; auto: where it is a terminal, elsewhere a line every few "
        "seconds",
        Choices<ProgressShown>{
            {"auto", ProgressShown::automatic}, {"always", ProgressShown::always}, {"never", ProgressShown::never}},
        member_at(&MeshCase::progress));
    run.flag("quiet", "print no summary and no progress; warnings and errors are printed", true,
             member_at(&MeshCase::quiet));
    run.flag("allow-defects",
             "write the mesh even where isotropic triangles have an angle below the bound (--min-angle) that no sharp "
             "corner excuses; otherwise such a run ends with exit code 4 and writes nothing",
             true, member_at(&MeshCase::allow_defects));
    run.flag("strict", "end with exit code 4 where there is any warning; the outputs are written", true,
             member_at(&MeshCase::strict));
    OptionTable<MeshCase> rows = run.take();
    std::move(rows.begin(), rows.end(), std::back_inserter(table));
    return table;
}

OptionTable<MeshCase> make_table() {
    OptionTable<MeshCase> table = file_options();
    for (OptionTable<MeshCase> rows :
         {nested_table<MeshCase>(option_table<CaseOptions>(), member_at(&MeshCase::options)), other_options()})
        std::move(rows.begin(), rows.end(), std::back_inserter(table));
    std::erase_if(table, [](const Option<MeshCase>& option) { return option.library_only; });
    const auto rank = [](const Option<MeshCase>& option) {
        return std::find(groups.begin(), groups.end(), option.group) - groups.begin();
    };
    std::stable_sort(table.begin(), table.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    return table;
}

/// What is said of a number with a comma: people write 0,5 for a half, and 1e5,1e6 for two runs.
constexpr const char* comma_hint = " (numbers have a decimal point; lamina batch --sweep OPTION=A,B takes several)";

/// Reads a number of this type that fills the whole text; `type_name` names the type in errors.
template <class Number>
Number parse(const std::string& text, const std::string& origin, const char* type_name) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        const bool has_comma = text.find(',') != std::string::npos;
        throw UsageError(fmt::format("{}: '{}' is not a {}{}", origin, text, type_name, has_comma ? comma_hint : ""));
    }
    return value;
}

/// Returns whether a text is a number, NaN and infinities among them.
bool is_real(const std::string& text) {
    double value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

/// Reads a whole number, which may have an exponent: 2e9.
OptionValue parse_count(const std::string& text, const std::string& origin) {
    if (text.find_first_of("eE") != std::string::npos) return parse<double>(text, origin, "whole number");
    return parse<std::int64_t>(text, origin, "whole number");
}

}  // namespace

const OptionTable<MeshCase>& mesh_options() {
    static const OptionTable<MeshCase> table = make_table();
    return table;
}

std::string command_line_name(const Option<MeshCase>& option) {
    if (option.name == "input") return "INPUT";
    if (option.name == "output") return "-o,--output";
    return "--" + option.name;
}

void assign(const Option<MeshCase>& option, MeshCase& mesh_case, const OptionValue& value, const std::string& origin) {
    try {
        option.set(mesh_case, value);
    } catch (const OptionError& error) {
        throw UsageError(origin + ": " + error.reason());
    }
    mesh_case.given.push_back(option.name);
}

bool is_given(const MeshCase& mesh_case, const std::string& name) {
    return std::find(mesh_case.given.begin(), mesh_case.given.end(), name) != mesh_case.given.end();
}

void require_consistent(const MeshCase& mesh_case) {
    require_consistent(mesh_options(), mesh_case.given);
    if (mesh_case.options.surface.treatment == SurfaceTreatment::keep)
        for (const std::string name :
             {"surface-points", "exact-points", "points", "spacing-le", "spacing-te", "spacing-at", "spacing-max"})
            if (is_given(mesh_case, name))
                throw UsageError(name + " asks for new points, and surface keep for the given ones: give one of them");
    validate(mesh_case.options);
}

double parse_real(const std::string& text, const std::string& origin) { return parse<double>(text, origin, "number"); }

std::string default_text(const Option<MeshCase>& option) {
    const std::optional<OptionValue> value = option.get(MeshCase{});
    return value && option.kind != OptionKind::flag ? to_text(*value) : "";
}

std::string help_text(const Option<MeshCase>& option) {
    const std::string value = default_text(option);
    return help_with_range(option) + (value.empty() ? "" : " [" + value + "]");
}

OptionValue value_of_text(OptionKind kind, const std::vector<std::string>& texts, const std::string& origin) {
    if (kind == OptionKind::words || kind == OptionKind::repeated || kind == OptionKind::paths) return texts;
    const std::string& text = texts.back();
    if (kind == OptionKind::number || (kind == OptionKind::number_or_range && !is_range(text)) ||
        (kind == OptionKind::number_or_word && is_real(text)))
        return parse_real(text, origin);
    if (kind == OptionKind::flag) return text == "true";
    if (kind == OptionKind::count || (kind == OptionKind::count_or_auto && text != auto_word))
        return parse_count(text, origin);
    return text;
}

std::string to_text(const OptionValue& value) {
    struct Printer {
        std::string operator()(bool flag) const { return flag ? "true" : "false"; }
        std::string operator()(std::int64_t count) const { return fmt::to_string(count); }
        std::string operator()(double number) const { return fmt::to_string(number); }
        std::string operator()(const std::string& text) const { return text; }
        std::string operator()(const std::vector<std::string>& texts) const {
            return fmt::format("{}", fmt::join(texts, ","));
        }
    };
    return std::visit(Printer{}, value);
}

}  // namespace lamina::app
