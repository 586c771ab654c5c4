#include "geometry/drawings/drawing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "geometry/characters.hpp"

namespace lamina::geometry {

bool leave_out_point(Drawing& drawing, const SpaceCurve& curve) {
    const std::vector<Point3>& control = curve.control;
    const auto is_first = [&](const Point3& p) {
        return p.x == control[0].x && p.y == control[0].y && p.z == control[0].z;
    };
    if (!std::all_of(control.begin(), control.end(), is_first)) return false;
    ++drawing.left_out["curves without length"];
    return true;
}

void add_curve(Drawing& drawing, DrawnCurve curve, const std::string& what, const std::string& file) {
    drawing.control_points += curve.curve.control.size();
    if (drawing.curves.size() == max_drawn_curves || drawing.control_points > max_control_points)
        throw InputError({file, curve.line, {}},
                         fmt::format("more than {} curves or {} of their control points in one drawing",
                                     max_drawn_curves, max_control_points));
    if (const std::string defect = defect_of(curve.curve); !defect.empty())
        throw InputError({file, curve.line, {}}, fmt::format("{}: {}", what, defect));
    if (leave_out_point(drawing, curve.curve)) return;
    const auto is_beyond = [](const Point3& p) {
        return !(std::abs(p.x) <= max_exact_coordinate && std::abs(p.y) <= max_exact_coordinate &&
                 std::abs(p.z) <= max_exact_coordinate);
    };
    if (std::any_of(curve.curve.control.begin(), curve.curve.control.end(), is_beyond))
        throw InputError({file, curve.line, {}}, fmt::format("{}: coordinates above {:g}", what, max_exact_coordinate));
    drawing.curves.push_back(std::move(curve));
}

double drawn_number(std::string_view text, const std::string& file, std::uint32_t line) {
    constexpr std::size_t longest = 64;
    const std::string_view shown = trimmed(text);
    std::string plain(shown.substr(shown.starts_with('+') ? 1 : 0, longest));
    for (char& c : plain)
        if (c == 'D' || c == 'd') c = 'e';
    double value = 0;
    const char *const begin = plain.data(), *const end = begin + plain.size();
    const auto [rest, error] = std::from_chars(begin, end, value);
    if (shown.size() > longest || error != std::errc() || rest != end || !(std::abs(value) <= max_exact_coordinate))
        throw InputError({file, line, {}},
                         fmt::format("'{}' is not a number of a drawing", printable(shown.substr(0, longest))));
    return value;
}

std::size_t drawn_count(std::string_view text, const std::string& file, std::uint32_t line) {
    constexpr double most = 4e9;
    const double value = drawn_number(text, file, line);
    if (!(value >= 0 && value <= most) || value != std::floor(value))
        throw InputError({file, line, {}}, fmt::format("'{}' is not a whole number", printable(trimmed(text))));
    return static_cast<std::size_t>(value);
}

}  // namespace lamina::geometry
