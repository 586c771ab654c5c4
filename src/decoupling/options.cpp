// The table of the options of the far field, and the checks of those of the decoupling.
#include <lamina/decoupling.hpp>

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <lamina/predicates.hpp>

#include "core/length.hpp"
#include "core/option_rows.hpp"
#include "core/text.hpp"

namespace lamina {

namespace {

/// Reads an outline "X0,Y0,X1,Y1,..." of three corners or more. Throws UsageError with the bare reason.
std::vector<Point> parse_outline(const std::string& text) {
    const std::vector<double> numbers = core::parse_numbers(text, ',');
    if (numbers.size() < 6 || numbers.size() % 2 != 0)
        throw UsageError("'" + text + "': an outline is X0,Y0,X1,Y1,..., three corners or more");
    std::vector<Point> corners;
    corners.reserve(numbers.size() / 2);
    for (std::size_t i = 0; i < numbers.size(); i += 2) corners.push_back({numbers[i], numbers[i + 1]});
    return corners;
}

/// Returns the text that parse_outline() reads back.
std::string outline_text(std::span<const Point> corners) {
    std::string text;
    for (const Point p : corners) text += core::concat(text.empty() ? "" : ",", p.x, ",", p.y);
    return text;
}

/// Reads the first height on a wall: a length, or "y+" and a number. Throws UsageError with the bare reason.
OuterLayers parse_outer_layers(const std::string& text) {
    constexpr std::string_view y_plus = "y+";
    const bool is_y_plus = text.rfind(y_plus, 0) == 0;
    const Length height = core::parse_length(is_y_plus ? text.substr(y_plus.size()) : text);
    require_in_range(positive_numbers, height.value, "layers");
    if (!is_y_plus) return height;
    if (height.unit != LengthUnit::chord) throw UsageError("'" + text + "': a y+ has no unit");
    return YPlus{height.value};
}

/// Returns the text that parse_outer_layers() reads back.
std::string outer_layers_text(const OuterLayers& layers) {
    const auto* height = std::get_if<Length>(&layers);
    return height ? core::length_text(*height) : core::concat("y+", std::get<YPlus>(layers).y_plus);
}

/// Returns what `read` makes of the text of an option. Its errors name the option.
template <class Read>
auto of_option(const char* name, Read&& read) {
    try {
        return read();
    } catch (const UsageError& error) {
        throw OptionError(name, error.what());
    }
}

/// Returns the positive length that a part of the text of an option gives.
Length length_of_option(const std::string& part, const char* name) {
    const Length length = of_option(name, [&] { return core::parse_length(part); });
    require_in_range(positive_numbers, length.value, name);
    return length;
}

/// Adds the option of the tunnel: its height and how far it goes on both ways.
Option<FarFieldOptions>& add_tunnel(OptionTableBuilder<FarFieldOptions>& table) {
    const auto set = [](FarFieldOptions& options, const OptionValue& value) {
        const std::string text = as_word_or_number(value, "tunnel");
        std::vector<Length> lengths;
        for (const std::string& part : core::split(text, ':')) lengths.push_back(length_of_option(part, "tunnel"));
        if (lengths.size() != 1 && lengths.size() != 3)
            throw OptionError("tunnel", "'" + text + "': a tunnel is H, or H:UP:DOWN");
        options.tunnel = lengths[0];
        options.tunnel_upstream = options.tunnel_downstream = std::nullopt;
        if (lengths.size() == 1) return;
        options.tunnel_upstream = lengths[1];
        options.tunnel_downstream = lengths[2];
    };
    const auto get = [](const FarFieldOptions& options) -> std::optional<OptionValue> {
        if (!options.tunnel) return std::nullopt;
        std::string text = core::length_text(*options.tunnel);
        for (const std::optional<Length>& length : {options.tunnel_upstream, options.tunnel_downstream})
            if (length) text += ":" + core::length_text(*length);
        return text;
    };
    return table.add(
        {"tunnel", OptionKind::word, "H[:UP:DOWN]",
         "height of a wind tunnel with the configuration or the line of symmetry in its middle, or on its ground, and "
         "how far it goes on ahead of the configuration and behind it; else 10 and 15 chords, or 3 and 4 heights, the "
         "larger of "
         "both, unless far-field says it",
         "", set, get});
}

/// Adds the options of a row of blades, one under two names: the pitch and the stagger angle.
void add_row(OptionTableBuilder<FarFieldOptions>& table) {
    const auto set = [](FarFieldOptions& options, const OptionValue& value) {
        const std::string text = as_word_or_number(value, "periodic");
        const std::vector<std::string> parts = core::split(text, ',');
        if (parts.size() > 2) throw OptionError("periodic", "'" + text + "': a row is PITCH, or PITCH,STAGGER");
        options.pitch = length_of_option(parts.front(), "periodic");
        options.stagger_deg =
            parts.size() > 1 ? of_option("periodic", [&] { return core::parse_number(parts[1]); }) : 0;
        require_in_range(numbers_from_to(-180, 180), options.stagger_deg, "periodic");
    };
    const auto get = [](const FarFieldOptions& options) -> std::optional<OptionValue> {
        if (!options.pitch) return std::nullopt;
        const std::string pitch = core::length_text(*options.pitch);
        return options.stagger_deg == 0 ? pitch : core::concat(pitch, ",", options.stagger_deg);
    };
    const auto none = [](const FarFieldOptions&) -> std::optional<OptionValue> { return std::nullopt; };
    const std::vector<std::string> other_borders{"far-field-outline", "tunnel", "ground", "symmetry"};
    table
        .add(
            {"periodic", OptionKind::word, "PITCH[,STAGGER]",
             "the configuration is a blade of an endless row along y, at this distance from the next; STAGGER turns it "
             "counter-clockwise from the axial direction x, in degrees, and alpha is the angle of the inlet flow",
             "", set, get})
        .excludes = other_borders;
    std::vector<std::string> all = other_borders;
    all.push_back("periodic");
    table.add({"cascade", OptionKind::word, "PITCH[,STAGGER]", "the same as periodic", "", set, none}).excludes = all;
}

}  // namespace

template <>
OptionTable<FarFieldOptions> option_rows() {
    OptionTableBuilder<FarFieldOptions> table("Outer region");
    table.length("far-field", "L", "half-width of the far-field box or radius of the circle", positive_numbers,
                 member_at(&FarFieldOptions::size));
    table
        .choice("far-field-shape", "shape of the far field round the middle of the configuration",
                Choices<FarFieldShape>{{"box", FarFieldShape::box}, {"circle", FarFieldShape::circle}},
                member_at(&FarFieldOptions::shape))
        .excludes = {"far-field-outline"};
    const auto set = [](FarFieldOptions& options, const OptionValue& value) {
        const std::string text = as_word(value, "far_field_outline");
        options.outline = of_option("far_field_outline", [&] { return parse_outline(text); });
        options.shape = FarFieldShape::outline;
    };
    const auto get = [](const FarFieldOptions& options) {
        return options.outline.empty() ? std::nullopt : std::optional<OptionValue>(outline_text(options.outline));
    };
    table.add({"far-field-outline", OptionKind::word, "X0,Y0,X1,Y1,...",
               "instead: corners of a convex far field, counter-clockwise, in units of the input", "", set, get});
    // Other shapes than a box do not go with these either; case files may say that it is one.
    const std::vector<std::string> other_shapes{"far-field-outline"};
    add_tunnel(table).excludes = other_shapes;
    table.choice("tunnel-walls", "floor and ceiling of the tunnel",
                 Choices<OuterWallKind>{{"slip", OuterWallKind::slip}, {"no-slip", OuterWallKind::no_slip}},
                 member_at(&FarFieldOptions::tunnel_walls));
    table.spec(
        "tunnel-layers", "H",
        "height of the first layer on floor and ceiling without slip, or y+Y: that with this y+ on a flat plate; "
        "else as on the configuration",
        parse_outer_layers, outer_layers_text, member_at(&FarFieldOptions::tunnel_layers));
    table
        .length("ground", "H", "distance of flat ground below the lowest point of the configuration", positive_numbers,
                member_at(&FarFieldOptions::ground))
        .excludes = other_shapes;
    table.choice(
        "ground-wall", "the ground: with slip, without, or without and moving with the free stream",
        Choices<OuterWallKind>{
            {"slip", OuterWallKind::slip}, {"no-slip", OuterWallKind::no_slip}, {"moving", OuterWallKind::moving}},
        member_at(&FarFieldOptions::ground_wall));
    table.spec("ground-layers", "H", "the same on ground without slip, as tunnel-layers", parse_outer_layers,
               outer_layers_text, member_at(&FarFieldOptions::ground_layers));
    table
        .number("symmetry", "Y",
                "line of symmetry y = Y, in units of the input, that cuts bodies and domain: what is above is kept",
                numbers_from_to(-1e6, 1e6), member_at(&FarFieldOptions::symmetry))
        .excludes = {"far-field-outline", "ground"};
    table.flag("axisymmetric", "the line of symmetry, y = 0, is the axis of bodies of revolution", true,
               member_at(&FarFieldOptions::axisymmetric));
    add_row(table);
    return table.take();
}
template LAMINA_EXPORT const OptionTable<FarFieldOptions>& option_table();

namespace {

/// Throws OptionError unless the outline is a convex polygon, counter-clockwise.
void require_convex(std::span<const Point> outline) {
    const std::size_t n = outline.size();
    if (n < 3) throw OptionError("far_field_outline", "an outline has three corners or more");
    std::size_t leftmost_corners = 0;  // of a star that turns left at each corner there are several
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = outline[i], b = outline[(i + 1) % n], c = outline[(i + 2) % n];
        leftmost_corners += lexicographically_less(b, a) && lexicographically_less(b, c);
        if (leftmost_corners > 1) throw OptionError("far_field_outline", "it runs round its middle more than once");
        if (!(orient2d(a, b, c) > 0))
            throw OptionError("far_field_outline",
                              fmt::format("not convex and counter-clockwise at ({}, {})", b.x, b.y));
    }
}

}  // namespace

void validate(const FarFieldOptions& options) {
    require_in_range(option_table<FarFieldOptions>(), options);
    if (options.shape == FarFieldShape::outline) require_convex(options.outline);
    if (options.shape != FarFieldShape::box && (options.tunnel || options.ground || options.symmetry))
        throw OptionError(options.symmetry ? "symmetry"
                          : options.tunnel ? "tunnel"
                                           : "ground",
                          "needs the far field to be a box");
    if (options.symmetry && options.ground)
        throw OptionError("symmetry", "is the border below, where no ground can be");
    if (options.pitch && (options.shape != FarFieldShape::box || options.tunnel || options.ground || options.symmetry))
        throw OptionError("periodic",
                          "is the border above and below, where no ground, tunnel, line of symmetry or "
                          "other far field can be");
    if (options.stagger_deg != 0 && !options.pitch) throw OptionError("periodic", "a stagger angle needs a pitch");
    if (options.axisymmetric && options.symmetry != 0.0)
        throw OptionError("axisymmetric", "needs symmetry 0, the axis of flow solvers: shift the configuration");
    if (options.tunnel_upstream.has_value() != options.tunnel_downstream.has_value())
        throw OptionError("tunnel", "goes on upstream and downstream by lengths that are both given, or neither");
    if (options.tunnel_walls == OuterWallKind::moving) throw OptionError("tunnel_walls", "no wall of a tunnel moves");
    const auto require = [](bool given, bool base, const char* option, const char* needed) {
        if (given && !base) throw OptionError(option, std::string("needs ") + needed);
    };
    require(options.tunnel_walls != OuterWallKind::slip, options.tunnel.has_value(), "tunnel_walls",
            "a tunnel (--tunnel H)");
    require(options.ground_wall != OuterWallKind::slip, options.ground.has_value(), "ground_wall",
            "ground (--ground H)");
    require(options.tunnel_layers.has_value(), options.tunnel_walls != OuterWallKind::slip, "tunnel_layers",
            "tunnel_walls without slip");
    require(options.ground_layers.has_value(), options.ground_wall != OuterWallKind::slip, "ground_layers",
            "ground_wall without slip");
}

void validate(const DecouplingOptions& options) {
    require_in_range(numbers_from_to(100, 1e9), options.pieces_target, "pieces_target");
}

}  // namespace lamina
