#include "app/options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/format_help.hpp"

#include "app/size_text.hpp"

namespace lamina::app {

namespace {

// ---- ranges ----

/// Numbers an option may take; always finite.
struct Range {
    double lower = -HUGE_VAL;
    double upper = HUGE_VAL;
    bool with_lower = false;  ///< whether the lower bound itself is in; the upper one always is
};

constexpr Range positive{0, HUGE_VAL, false};
constexpr Range greater_than(double bound) { return {bound, HUGE_VAL, false}; }
constexpr Range above_up_to(double lower, double upper) { return {lower, upper, false}; }
constexpr Range from_to(double lower, double upper) { return {lower, upper, true}; }

std::string range_text(const Range& range) {
    const char* relation = range.with_lower ? ">=" : ">";
    if (std::isinf(range.upper)) return fmt::format("{} {}", relation, range.lower);
    return fmt::format("{} {} and <= {}", relation, range.lower, range.upper);
}

/// Throws for NaN, too.
void require(const Range& range, double value) {
    const bool above = range.with_lower ? value >= range.lower : value > range.lower;
    if (std::isfinite(value) && above && value <= range.upper) return;
    throw UsageError(fmt::format("{} is out of range: must be {}", value, range_text(range)));
}

// ---- typed access to a Value ----

double as_real(const Value& value) {
    if (const auto* real = std::get_if<double>(&value)) return *real;
    if (const auto* count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
    throw UsageError("must be a number");
}

std::int64_t as_count(const Value& value) {
    if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
    throw UsageError("must be a whole number");
}

bool as_flag(const Value& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag;
    throw UsageError("must be true or false");
}

const std::string& as_word(const Value& value) {
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    throw UsageError("must be a string");
}

/// A number will do for a word that may be one.
std::string as_word_or_number(const Value& value) {
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    return fmt::to_string(as_real(value));
}

/// One word will do for a list of one.
std::vector<std::string> as_words(const Value& value) {
    if (const auto* words = std::get_if<std::vector<std::string>>(&value)) return *words;
    if (const auto* word = std::get_if<std::string>(&value)) return {*word};
    throw UsageError("must be an array of strings");
}

/// Stands for a number that the program finds itself.
const std::string automatic = "auto";

// ---- kinds of options; member(c) is a reference to what the option sets in a MeshCase ----

/// A number that may be optional: then empty where it is not set.
template <class As, class Member>
std::optional<Value> number_value(const Member& member) {
    if constexpr (requires { member.has_value(); }) {
        return member ? std::optional<Value>(static_cast<As>(*member)) : std::nullopt;
    } else {
        return static_cast<As>(member);
    }
}

/// The type of a number that may be optional.
template <class Number>
Number number_of(Number);
template <class Number>
Number number_of(std::optional<Number>);

template <class Member>
Option real(std::string name, std::string metavar, const std::string& help, Range range, Member member) {
    const auto set = [=](MeshCase& c, const Value& value) {
        require(range, as_real(value));
        member(c) = as_real(value);
    };
    const auto get = [=](const MeshCase& c) { return number_value<double>(member(c)); };
    return {std::move(name), Kind::real, std::move(metavar), help + "; " + range_text(range), set, get};
}

template <class Member>
Option count(std::string name, std::string metavar, const std::string& help, Range range, Member member) {
    using Number = decltype(number_of(member(std::declval<MeshCase&>())));
    const auto set = [=](MeshCase& c, const Value& value) {
        require(range, static_cast<double>(as_count(value)));
        member(c) = static_cast<Number>(as_count(value));
    };
    const auto get = [=](const MeshCase& c) { return number_value<std::int64_t>(member(c)); };
    return {std::move(name), Kind::count, std::move(metavar), help + "; " + range_text(range), set, get};
}

/// An optional number that is empty for "auto".
template <class Member>
Option count_or_auto(std::string name, std::string metavar, const std::string& help, Range range, Member member) {
    Option option = count(std::move(name), metavar + "|auto", help, range, member);
    option.kind = Kind::count_or_auto;
    const auto set_count = option.set;
    option.set = [=](MeshCase& c, const Value& value) {
        const auto* word = std::get_if<std::string>(&value);
        if (word && *word != automatic) throw UsageError("must be a whole number or 'auto'");
        if (word) {
            member(c).reset();
        } else {
            set_count(c, value);
        }
    };
    const auto get_count = option.get;
    option.get = [=](const MeshCase& c) { return get_count(c).value_or(automatic); };
    return option;
}

/// Sets the member to `meaning` where the flag is given.
template <class Member>
Option flag(std::string name, const std::string& help, bool meaning, Member member) {
    const auto set = [=](MeshCase& c, const Value& value) { member(c) = as_flag(value) == meaning; };
    const auto get = [=](const MeshCase& c) { return std::optional<Value>(member(c) == meaning); };
    return {std::move(name), Kind::flag, "", help, set, get};
}

template <class Choice, class Member>
Option choice(std::string name, const std::string& help, const Choices<Choice>& choices, Member member) {
    std::string metavar;
    for (const auto& entry : choices) metavar += (metavar.empty() ? "" : "|") + entry.first;
    const auto set = [=](MeshCase& c, const Value& value) { member(c) = choose(as_word(value), choices); };
    const auto get = [=](const MeshCase& c) {
        const auto named =
            std::find_if(choices.begin(), choices.end(), [&](const auto& e) { return e.second == member(c); });
        return std::optional<Value>(named->first);
    };
    return {std::move(name), Kind::word, std::move(metavar), help, set, get};
}

template <class Member>
Option text(std::string name, Kind kind, std::string metavar, const std::string& help, Member member) {
    const auto set = [=](MeshCase& c, const Value& value) { member(c) = as_word(value); };
    const auto get = [=](const MeshCase& c) { return std::optional<Value>(member(c)); };
    return {std::move(name), kind, std::move(metavar), help, set, get};
}

template <class Member>
Option list(std::string name, Kind kind, std::string metavar, const std::string& help, Member member) {
    const auto set = [=](MeshCase& c, const Value& value) { member(c) = as_words(value); };
    const auto get = [=](const MeshCase& c) { return std::optional<Value>(member(c)); };
    return {std::move(name), kind, std::move(metavar), help, set, get};
}

/// A word of its own grammar that may be left out: read by `parse`, written by `print`.
template <class Parse, class Print, class Member>
Option spec(std::string name, std::string metavar, const std::string& help, Parse parse, Print print, Member member) {
    const auto set = [=](MeshCase& c, const Value& value) { member(c) = parse(as_word_or_number(value)); };
    const auto get = [=](const MeshCase& c) {
        return member(c) ? std::optional<Value>(print(*member(c))) : std::nullopt;
    };
    return {std::move(name), Kind::word, std::move(metavar), help, set, get};
}

/// Any number of such words.
template <class Parse, class Print, class Member>
Option specs(std::string name, std::string metavar, const std::string& help, Parse parse, Print print, Member member) {
    const auto set = [=](MeshCase& c, const Value& value) {
        member(c).clear();
        for (const std::string& text : as_words(value)) member(c).push_back(parse(text));
    };
    const auto get = [=](const MeshCase& c) {
        std::vector<std::string> texts;
        for (const auto& entry : member(c)) texts.push_back(print(entry));
        return std::optional<Value>(std::move(texts));
    };
    return {std::move(name), Kind::repeated, std::move(metavar), help, set, get};
}

// ---- the table ----

/// The member of a MeshCase at the end of a chain of pointers to members.
template <class... Members>
auto member_at(Members... members) {
    return [members...](auto& mesh_case) -> auto& { return (mesh_case.*....*members); };
}

template <class Member>
auto of_case(Member member) {
    return member_at(&MeshCase::options, member);
}

template <class Member>
auto of_layer(Member member) {
    return member_at(&MeshCase::options, &CaseOptions::layer, member);
}

template <class Member>
auto of_surface(Member member) {
    return member_at(&MeshCase::options, &CaseOptions::surface, member);
}

// Layer numbers are kept in 16 bits.
constexpr double most_layers = 65535;

std::vector<Option> make_table() {
    std::vector<Option> table;
    std::string group;
    const auto add = [&](Option option) {
        option.group = group;
        table.push_back(std::move(option));
    };

    group = "Files";
    add(list("input", Kind::paths, "INPUT", "airfoil files, naca:DIGITS[:POINTS][:blunt], or one case file (.toml)",
             member_at(&MeshCase::inputs)));
    add(list("output", Kind::paths, "FILE", "mesh file; may be given several times", member_at(&MeshCase::outputs)));
    add(text("format", Kind::word, format_names(), "format of every mesh file; else each by its extension",
             member_at(&MeshCase::format)));
    add(flag("base-marker", "the base of a blunt trailing edge is a marker of its own, NAME_base", true,
             member_at(&MeshCase::base_marker)));
    add(flag("wall-distance", "in VTU files: the distance to the nearest wall as point data", true,
             member_at(&MeshCase::wall_distance)));
    add(text("wall-data", Kind::path, "FILE", "CSV of the wall's vertices: arc length, normal, first height",
             member_at(&MeshCase::wall_data)));
    add(text("report", Kind::path, "FILE", "JSON report of the run", member_at(&MeshCase::report)));

    group = "Geometry";
    add(choice("surface", "wall vertices: as given, on a spline through them, or that where they are coarse",
               Choices<Surface>{{"auto", Surface::automatic}, {"keep", Surface::keep}, {"resample", Surface::resample}},
               of_surface(&SurfaceOptions::surface)));
    add(count("surface-points", "N", "wall vertices of each element, about; else as many as the ray angle asks for",
              from_to(3, 1e7), of_surface(&SurfaceOptions::points)));
    add(real("smooth", "TOL", "smooth the points, moving none by more than this, in units of the input", positive,
             of_surface(&SurfaceOptions::smooth)));
    add(list("names", Kind::words, "A,B,...",
             "marker names, one an element; else file stems, 'airfoil' if there is one",
             member_at(&MeshCase::options, &CaseOptions::geometry, &GeometryOptions::names)));

    group = "Layer";
    Option first_height = real("first-height", "H", "height of the first layer along the ray, in units of the input",
                               positive, member_at(&MeshCase::first_height));
    first_height.get = [given = first_height.get](const MeshCase& c) {
        if (c.first_height || c.y_plus) return given(c);
        return std::optional<Value>(c.options.layer.first_height);
    };
    add(std::move(first_height));
    add(real("y-plus", "Y", "instead: y+ of the first layer's top, on a flat plate", positive,
             member_at(&MeshCase::y_plus)));
    add(real("reynolds", "RE", "Reynolds number of y-plus, based on the chord", positive,
             member_at(&MeshCase::reynolds)));
    add(real("chord", "C", "chord of y-plus, in units of the input; else the extent in x of the configuration",
             positive, member_at(&MeshCase::chord)));
    add(real("growth", "R", "ratio of the heights of successive layers; power of the polynomial law", greater_than(1),
             of_layer(&LayerOptions::growth)));
    add(choice("growth-law", "how heights grow along a ray",
               Choices<GrowthLaw>{{"geometric", GrowthLaw::geometric},
                                  {"polynomial", GrowthLaw::polynomial},
                                  {"exponential", GrowthLaw::exponential},
                                  {"adaptive", GrowthLaw::adaptive},
                                  {"aflr", GrowthLaw::aflr}},
               of_layer(&LayerOptions::growth_law)));
    add(count_or_auto("layers", "N", "number of layers, or up to cells as high as wide", from_to(1, most_layers),
                      of_layer(&LayerOptions::layers)));
    add(real("thickness", "T", "total height, in units of the input, beyond which no layer goes", positive,
             of_layer(&LayerOptions::thickness)));
    add(flag("no-layers", "isotropic triangles up to the wall", false, of_layer(&LayerOptions::enabled)));
    add(real("max-ray-angle", "DEG", "largest angle between neighbouring rays, in degrees", above_up_to(0, 90),
             of_layer(&LayerOptions::max_ray_angle_deg)));
    add(choice("corners", "sharp convex corners: a fan of rays, or refining rays beside the vertex",
               Choices<Corners>{{"fan", Corners::fan}, {"refine", Corners::refine}}, of_layer(&LayerOptions::corners)));
    add(choice("layer-topology",
               "cells of the layer: Delaunay triangles, the grid of rays and layers cut, or left whole",
               Choices<LayerTopology>{{"delaunay", LayerTopology::delaunay},
                                      {"layered", LayerTopology::layered},
                                      {"quads", LayerTopology::quads}},
               of_layer(&LayerOptions::topology)));

    group = "Outer region";
    add(real("far-field", "CHORDS",
             "half-width of the far-field box or radius of the circle, in chords (extents in x of the configuration)",
             positive, of_case(&CaseOptions::far_field)));
    add(choice("far-field-shape", "round the middle of the configuration",
               Choices<FarFieldShape>{{"box", FarFieldShape::box}, {"circle", FarFieldShape::circle}},
               of_case(&CaseOptions::far_field_shape)));
    const auto outline = of_case(&CaseOptions::far_field_outline);
    add({"far-field-outline", Kind::word, "X0,Y0,X1,Y1,...",
         "instead: corners of a convex far field, counter-clockwise, in units of the input",
         [=](MeshCase& c, const Value& value) { outline(c) = parse_outline(as_word(value)); },
         [=](const MeshCase& c) {
             return outline(c).empty() ? std::nullopt : std::optional<Value>(outline_text(outline(c)));
         }});
    add(real("gradation", "G", "growth of the edge length per unit of distance", above_up_to(0, 1),
             of_case(&CaseOptions::gradation)));
    add(real("wall-size", "H", "longest edge length at the layer's outer border, in units of the input", positive,
             of_case(&CaseOptions::wall_size)));
    add(real("far-size", "H", "largest edge length, in units of the input", positive, of_case(&CaseOptions::far_size)));
    add(spec(
        "wake", "ANGLE[:LENGTH[:SIZE]]",
        "small triangles along a line from each trailing edge: ANGLE in degrees to the x axis, LENGTH in chords (2), "
        "SIZE at the trailing edge in units of the input (else the size there without a wake)",
        parse_wake, wake_text, of_case(&CaseOptions::wake)));
    add(specs("refine", "SHAPE",
              "edge length h in and round a shape, box:X0,Y0,X1,Y1,H, circle:X,Y,R,H or "
              "line:X0,Y0,X1,Y1,H, in units of the input; may be given several times",
              parse_size_source, size_source_text, of_case(&CaseOptions::size_sources)));
    add(text(
        "background", Kind::path, "FILE",
        "VTU or MSH mesh with a size at each vertex, point data 'size' or the only scalar one: edge lengths, linear "
        "in its triangles",
        member_at(&MeshCase::background)));
    add(real("min-angle", "DEG", "smallest angle of isotropic triangles, in degrees", above_up_to(0, 33),
             of_case(&CaseOptions::min_angle_deg)));
    add(choice(
        "separators", "how borders between pieces are divided",
        Choices<SeparatorRule>{{"equidistributed", SeparatorRule::equidistributed}, {"k-rule", SeparatorRule::k_rule}},
        of_case(&CaseOptions::separators)));
    add(real("pieces-target", "TRIANGLES", "triangles a piece, about", from_to(100, 1e9),
             of_case(&CaseOptions::pieces_target)));
    const auto of_decomposition = [](auto DecompositionOptions::*member) {
        return [member](auto& c) -> auto& { return c.options.decomposition.*member; };
    };
    add(count("decomposition-depth", "N", "most cuts on the way to a piece of the layer", from_to(0, 24),
              of_decomposition(&DecompositionOptions::depth)));
    add(count("leaf-vertices", "N", "pieces of the layer are cut down to about so many vertices", from_to(10, 1e9),
              of_decomposition(&DecompositionOptions::leaf_vertices)));

    group = "Run";
    add(count("threads", "N", "threads, 0 = all cores; never changes the mesh", from_to(0, 1024),
              of_case(&CaseOptions::threads)));
    add(choice(
        "progress", "stages on standard error; auto: where it is a terminal",
        Choices<ProgressShown>{
            {"auto", ProgressShown::automatic}, {"always", ProgressShown::always}, {"never", ProgressShown::never}},
        member_at(&MeshCase::progress)));
    add(flag("quiet", "no summary", true, member_at(&MeshCase::quiet)));
    return table;
}

}  // namespace

std::string Option::key() const {
    std::string key = name;
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

std::string Option::command_line() const {
    if (name == "input") return "INPUT";
    if (name == "output") return "-o,--output";
    return "--" + name;
}

const std::vector<Option>& mesh_options() {
    static const std::vector<Option> table = make_table();
    return table;
}

void assign(const Option& option, MeshCase& mesh_case, const Value& value, const std::string& origin) {
    try {
        option.set(mesh_case, value);
    } catch (const UsageError& error) {
        throw UsageError(origin + ": " + error.what());
    }
}

double parse_real(const std::string& text, const std::string& origin) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        throw UsageError(fmt::format("{}: '{}' is not a number", origin, text));
    }
    return value;
}

Value value_of_text(Kind kind, const std::vector<std::string>& texts, const std::string& origin) {
    if (kind == Kind::words || kind == Kind::repeated || kind == Kind::paths) return texts;
    const std::string& text = texts.back();
    if (kind == Kind::real) return parse_real(text, origin);
    if (kind == Kind::flag) return text == "true";
    if (kind == Kind::count || (kind == Kind::count_or_auto && text != automatic)) {
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) {
            throw UsageError(fmt::format("{}: '{}' is not a whole number", origin, text));
        }
        return value;
    }
    return text;
}

std::string to_text(const Value& value) {
    struct Printer {
        std::string operator()(bool flag) const { return flag ? "true" : "false"; }
        std::string operator()(std::int64_t count) const { return fmt::to_string(count); }
        std::string operator()(double real) const { return fmt::to_string(real); }
        std::string operator()(const std::string& text) const { return text; }
        std::string operator()(const std::vector<std::string>& texts) const {
            return fmt::format("{}", fmt::join(texts, ","));
        }
    };
    return std::visit(Printer{}, value);
}

}  // namespace lamina::app
