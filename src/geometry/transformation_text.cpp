// Reads and writes the texts of transformations: "flap:rotate:-30:0.8,0", "all:scale:0.001".
#include <lamina/transformation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
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

/// Says why the numbers of a change are refused; nothing where they are not.
struct ChangeDefect {
    static std::string angle(double angle_deg, double max_deg) {
        if (std::abs(angle_deg) <= max_deg) return {};
        return core::concat("the angle must be from ", -max_deg, " to ", max_deg, " degrees");
    }
    static std::string finite(std::initializer_list<double> numbers) {
        const bool all = std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
        return all ? "" : "the numbers must be finite";
    }

    std::string operator()(const Scaling& s) const {
        return s.factor > 0 ? finite({s.factor, s.center.x, s.center.y}) : "the factor must be > 0";
    }
    std::string operator()(const Rotation& r) const {
        const std::string defect = angle(r.angle_deg, max_rotation_deg);
        return defect.empty() ? finite({r.center.x, r.center.y}) : defect;
    }
    std::string operator()(const Shift& s) const { return finite({s.by.x, s.by.y}); }
    std::string operator()(const Mirroring& m) const { return finite({m.y}); }
    std::string operator()(const FlapDeflection& f) const {
        const std::string defect = angle(f.angle_deg, max_deflection_deg);
        return defect.empty() ? finite({f.hinge.x, f.hinge.y}) : defect;
    }
};

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
    if (kind == "scale" && (arguments == 1 || arguments == 2)) return Scaling{core::parse_number(parts[2]), center()};
    if (kind == "rotate" && (arguments == 1 || arguments == 2)) return Rotation{core::parse_number(parts[2]), center()};
    if (kind == "shift" && arguments == 1) return Shift{parse_point(parts[2])};
    if (kind == "mirror" && arguments <= 1) return Mirroring{arguments > 0 ? core::parse_number(parts[2]) : 0};
    if (kind == "flap" && arguments == 2) return FlapDeflection{core::parse_number(parts[2]), parse_point(parts[3])};
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

void validate(const Transformation& transformation) {
    const std::string defect = std::visit(ChangeDefect{}, transformation.change);
    if (!defect.empty())
        throw OptionError("transform", core::concat("'", transformation_text(transformation), "': ", defect));
}

Transformation parse_transformation(const std::string& text) {
    const std::vector<std::string> parts = core::split(text, ':');
    try {
        Transformation transformation{parts[0], parse_change(parts)};
        if (const std::string defect = std::visit(ChangeDefect{}, transformation.change); !defect.empty())
            throw UsageError(defect);
        return transformation;
    } catch (const UsageError& error) {
        throw UsageError("'" + text + "': " + error.what());
    }
}

std::string transformation_text(const Transformation& transformation) {
    return core::concat(transformation.element, ":", std::visit(ChangeText{}, transformation.change));
}

}  // namespace lamina
