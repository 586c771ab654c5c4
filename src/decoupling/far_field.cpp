#include "decoupling/far_field.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/predicates.hpp>

#include <lamina/option_builders.hpp>
#include "core/text.hpp"

namespace lamina::decoupling {

namespace {

OptionTable<FarFieldOptions> make_far_field_table() {
    OptionTableBuilder<FarFieldOptions> table("Outer region");
    table.number("far-field", "CHORDS",
                 "half-width of the far-field box or radius of the circle, in chords (extents in x of the "
                 "configuration)",
                 positive_numbers, member_at(&FarFieldOptions::size));
    table
        .choice("far-field-shape", "shape of the far field round the middle of the configuration",
                Choices<FarFieldShape>{{"box", FarFieldShape::box}, {"circle", FarFieldShape::circle}},
                member_at(&FarFieldOptions::shape))
        .excludes = {"far-field-outline"};
    const auto set = [](FarFieldOptions& options, const OptionValue& value) {
        const std::string text = word_of(value, "far_field_outline");
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
    return table.take();
}

OptionTable<DecouplingOptions> make_decoupling_table() {
    OptionTableBuilder<DecouplingOptions> table("Outer region");
    table.choice(
        "separators", "how borders between pieces are divided",
        Choices<SeparatorRule>{{"equidistributed", SeparatorRule::equidistributed}, {"k-rule", SeparatorRule::k_rule}},
        member_at(&DecouplingOptions::separators));
    table.number("pieces-target", "TRIANGLES", "triangles per piece, about", numbers_from_to(100, 1e9),
                 member_at(&DecouplingOptions::pieces_target));
    return table.take();
}

void require_convex(std::span<const Point> outline) {
    const std::size_t n = outline.size();
    if (n < 3) throw OptionError("far_field_outline", "an outline has three corners or more");
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = outline[i], b = outline[(i + 1) % n], c = outline[(i + 2) % n];
        if (!(orient2d(a, b, c) > 0))
            throw OptionError("far_field_outline",
                              fmt::format("not convex and counter-clockwise at ({}, {})", b.x, b.y));
    }
}

/// Calls visit(corner, vector to the next corner) for each edge of the outline.
template <class Visit>
void for_each_edge(std::span<const Point> outline, Visit visit) {
    for (std::size_t i = 0; i < outline.size(); ++i) visit(outline[i], outline[(i + 1) % outline.size()] - outline[i]);
}

/// Returns how far the box of the bodies stays away from the far field; negative where it does not.
double room_around(const Box& bodies, const FarField& far_field) {
    const Box around = far_field.box();
    double room = std::min({bodies.lower.x - around.lower.x, bodies.lower.y - around.lower.y,
                            around.upper.x - bodies.upper.x, around.upper.y - bodies.upper.y});
    for (Point corner : bodies.corners()) {
        if (far_field.shape == FarFieldShape::circle)
            room = std::min(room, far_field.radius - distance(corner, far_field.center));
        for_each_edge(far_field.outline,
                      [&](Point a, Point along) { room = std::min(room, cross(along, corner - a) / length(along)); });
    }
    return room;
}

}  // namespace

Box inscribed_box(const FarField& far_field) {
    const Box around = far_field.box();
    if (far_field.shape == FarFieldShape::box) return around;
    constexpr double room = 0.8;  // beyond the box's corners
    double half = 0;
    if (far_field.shape == FarFieldShape::circle) {
        half = far_field.radius / std::sqrt(2.0);
    } else {
        half = std::max(around.width(), around.height());
        for_each_edge(far_field.outline, [&](Point a, Point along) {
            half = std::min(half, cross(along, far_field.center - a) / (std::abs(along.x) + std::abs(along.y)));
        });
    }
    half *= room;
    return {far_field.center - Point{half, half}, far_field.center + Point{half, half}};
}

std::optional<Box> near_body_box(const Box& bodies, const Box& outermost, const FarField& far_field) {
    const double extent = std::max(bodies.width(), bodies.height());
    if (!(room_around(bodies, far_field) > 0.1 * extent))
        throw OptionError("far_field", "leaves no room around the bodies and their layers");
    const double room = std::min({bodies.lower.x - outermost.lower.x, bodies.lower.y - outermost.lower.y,
                                  outermost.upper.x - bodies.upper.x, outermost.upper.y - bodies.upper.y});
    if (room < 1.5 * extent) return std::nullopt;
    const double margin = 0.5 * extent;
    return Box{bodies.lower - Point{margin, margin}, bodies.upper + Point{margin, margin}};
}

}  // namespace lamina::decoupling

namespace lamina {

using namespace decoupling;

const OptionTable<FarFieldOptions>& far_field_option_table() {
    static const OptionTable<FarFieldOptions> table = make_far_field_table();
    return table;
}

const OptionTable<DecouplingOptions>& decoupling_option_table() {
    static const OptionTable<DecouplingOptions> table = make_decoupling_table();
    return table;
}

void validate(const FarFieldOptions& options) {
    require_in_range(far_field_option_table(), options);
    if (options.shape == FarFieldShape::outline) require_convex(options.outline);
}

void validate(const DecouplingOptions& options) { require_in_range(decoupling_option_table(), options); }

std::vector<Point> parse_outline(const std::string& text) {
    const std::vector<double> n = core::parse_numbers(text, ',');
    if (n.size() < 6 || n.size() % 2 != 0)
        throw UsageError("'" + text + "': an outline is X0,Y0,X1,Y1,..., three corners or more");
    std::vector<Point> corners;
    for (std::size_t i = 0; i < n.size(); i += 2) corners.push_back({n[i], n[i + 1]});
    return corners;
}

std::string outline_text(std::span<const Point> corners) {
    std::string text;
    for (Point p : corners) text += core::concat(text.empty() ? "" : ",", p.x, ",", p.y);
    return text;
}

Box FarField::box() const {
    if (shape != FarFieldShape::outline) return {center - Point{radius, radius}, center + Point{radius, radius}};
    Box box;
    for (Point p : outline) box.include(p);
    return box;
}

FarField place_far_field(const Box& bodies, const FarFieldOptions& options) {
    validate(options);
    FarField far_field{options.shape, bodies.center(), options.size * bodies.width()};
    if (options.shape != FarFieldShape::outline) return far_field;
    far_field.outline = options.outline;
    for_each_edge(far_field.outline, [&](Point a, Point along) {
        if (!(orient2d(a, a + along, far_field.center) > 0))
            throw OptionError("far_field_outline", "does not enclose the middle of the configuration");
    });
    return far_field;
}

}  // namespace lamina
