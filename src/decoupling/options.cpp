// The table of the options of the far field, and the checks of those of the decoupling.
#include <lamina/decoupling.hpp>

#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/predicates.hpp>

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
        try {
            options.outline = parse_outline(text);
        } catch (const UsageError& error) {
            throw OptionError("far_field_outline", error.what());
        }
        options.shape = FarFieldShape::outline;
    };
    const auto get = [](const FarFieldOptions& options) {
        return options.outline.empty() ? std::nullopt : std::optional<OptionValue>(outline_text(options.outline));
    };
    table.add({"far-field-outline", OptionKind::word, "X0,Y0,X1,Y1,...",
               "instead: corners of a convex far field, counter-clockwise, in units of the input", "", set, get});
    const std::vector<std::string> other_shapes{"far-field-shape", "far-field-outline"};
    table
        .length("tunnel", "H",
                "height of a wind tunnel with the configuration in its middle, or on its ground: floor and ceiling are "
                "slip walls",
                positive_numbers, member_at(&FarFieldOptions::tunnel))
        .excludes = other_shapes;
    table
        .length("ground", "H", "distance of flat ground below the lowest point of the configuration: a slip wall",
                positive_numbers, member_at(&FarFieldOptions::ground))
        .excludes = other_shapes;
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
    if (options.shape != FarFieldShape::box && (options.tunnel || options.ground))
        throw OptionError(options.tunnel ? "tunnel" : "ground", "needs the far field to be a box");
}

void validate(const DecouplingOptions& options) {
    require_in_range(numbers_from_to(100, 1e9), options.pieces_target, "pieces_target");
}

}  // namespace lamina
