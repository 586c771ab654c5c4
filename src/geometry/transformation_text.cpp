// Reads and writes the texts of transformations: "flap:rotate:-30:0.8,0", "all:scale:0.001".
#include <lamina/transformation.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <lamina/error.hpp>

#include "core/text.hpp"

namespace lamina::geometry {

using core::require_text;

namespace {

constexpr const char* grammar =
    "a transformation is ELEMENT:scale:S[:X,Y], ELEMENT:rotate:DEG[:X,Y], ELEMENT:shift:DX,DY, ELEMENT:mirror[:Y] or "
    "ELEMENT:flap:DEG:X,Y";
constexpr double max_rotation_deg = 360, max_deflection_deg = 90;

/// Returns the angle that a text gives, which may not be larger than `max_deg` in either direction.
double parse_angle(const std::string& text, double max_deg) {
    const double angle_deg = core::parse_number(text);
    require_text(std::abs(angle_deg) <= max_deg, text,
                 core::concat("the angle must be from ", -max_deg, " to ", max_deg, " degrees"));
    return angle_deg;
}

Point parse_point(const std::string& text) {
    const std::vector<double> numbers = core::parse_numbers(text, ',');
    require_text(numbers.size() == 2, text, "two coordinates X,Y belong here");
    return {numbers[0], numbers[1]};
}

std::string point_text(Point p) { return core::concat(p.x, ",", p.y); }

/// Reads the parts between colons that follow the name of the element: the kind of the change and its arguments.
decltype(Transformation::change) parse_change(const std::vector<std::string>& parts) {
    if (parts.size() < 2 || parts[0].empty()) throw UsageError(grammar);
    const std::string& kind = parts[1];
    const std::size_t arguments = parts.size() - 2;
    const auto center = [&] { return arguments > 1 ? parse_point(parts[3]) : Point{}; };
    if (kind == "scale" && (arguments == 1 || arguments == 2)) {
        const double factor = core::parse_number(parts[2]);
        require_text(factor > 0, parts[2], "the factor must be > 0");
        return Scaling{factor, center()};
    }
    if (kind == "rotate" && (arguments == 1 || arguments == 2))
        return Rotation{parse_angle(parts[2], max_rotation_deg), center()};
    if (kind == "shift" && arguments == 1) return Shift{parse_point(parts[2])};
    if (kind == "mirror" && arguments <= 1) return Mirroring{arguments > 0 ? core::parse_number(parts[2]) : 0};
    if (kind == "flap" && arguments == 2)
        return FlapDeflection{parse_angle(parts[2], max_deflection_deg), parse_point(parts[3])};
    throw UsageError(grammar);
}

/// Prints what follows the name of the element.
struct ChangeText {
    std::string operator()(const Scaling& s) const {
        return core::concat("scale:", s.factor, ":", point_text(s.center));
    }
    std::string operator()(const Rotation& r) const {
        return core::concat("rotate:", r.angle_deg, ":", point_text(r.center));
    }
    std::string operator()(const Shift& s) const { return core::concat("shift:", point_text(s.by)); }
    std::string operator()(const Mirroring& m) const { return core::concat("mirror:", m.y); }
    std::string operator()(const FlapDeflection& f) const {
        return core::concat("flap:", f.angle_deg, ":", point_text(f.hinge));
    }
};

}  // namespace

}  // namespace lamina::geometry

namespace lamina {

using namespace geometry;

Transformation parse_transformation(const std::string& text) {
    const std::vector<std::string> parts = core::split(text, ':');
    try {
        return {parts[0], parse_change(parts)};
    } catch (const UsageError& error) {
        throw UsageError("'" + text + "': " + error.what());
    }
}

std::string transformation_text(const Transformation& transformation) {
    return core::concat(transformation.element, ":", std::visit(ChangeText{}, transformation.change));
}

}  // namespace lamina
