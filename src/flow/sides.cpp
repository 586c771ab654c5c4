#include "flow/sides.hpp"

#include <cmath>
#include <cstddef>

#include "flow/panel_system.hpp"

namespace lamina::flow {

namespace {

/// A point of the outline: after node `panel`, at a share of the panel that begins there.
struct OutlinePlace {
    std::size_t panel;
    double share;
};

std::optional<OutlinePlace> find_stagnation(const PanelSheet& sheet) {
    const std::vector<double>& g = sheet.strengths;
    std::optional<OutlinePlace> best;
    double potential = 0, least = HUGE_VAL;
    for (std::size_t i = 0; i + 1 < g.size(); ++i) {
        const double length = distance(sheet.nodes[i], sheet.nodes[i + 1]);
        if (g[i] < 0 && g[i + 1] >= 0) {
            const double share = g[i] / (g[i] - g[i + 1]);
            const double there = potential + 0.5 * share * length * g[i];
            if (there < least) {
                least = there;
                best = {i, share};
            }
        }
        potential += 0.5 * length * (g[i] + g[i + 1]);
    }
    return best;
}

void append(std::vector<FlowPoint>& side, Point p, double speed) {
    const double step = distance(side.back().at, p);
    if (step == 0) return;
    side.push_back({p, side.back().s + step, speed, 1 - speed * speed});
}

}  // namespace

std::optional<ElementFlow> make_sides(const PanelSheet& sheet) {
    const std::optional<OutlinePlace> place = find_stagnation(sheet);
    if (!place) return std::nullopt;
    const Point a = sheet.nodes[place->panel], b = sheet.nodes[place->panel + 1];
    ElementFlow element;
    element.stagnation = a + place->share * (b - a);
    const FlowPoint start{element.stagnation};
    element.upper = {start};
    element.lower = {start};
    for (std::size_t i = place->panel + 1; i-- > 0;)
        append(element.upper, sheet.nodes[i], std::abs(sheet.strengths[i]));
    for (std::size_t i = place->panel + 1; i < sheet.nodes.size(); ++i)
        append(element.lower, sheet.nodes[i], std::abs(sheet.strengths[i]));
    return element;
}

ElementFlow make_flat_plates(const std::vector<Point>& nodes) {
    const Point end = midpoint(nodes.front(), nodes.back());
    std::size_t nose = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (squared_length(nodes[i] - end) > squared_length(nodes[nose] - end)) nose = i;
    ElementFlow element;
    element.stagnation = nodes[nose];
    element.upper = element.lower = {{nodes[nose], 0, 1, 0}};
    for (std::size_t i = nose; i-- > 0;) append(element.upper, nodes[i], 1);
    for (std::size_t i = nose + 1; i < nodes.size(); ++i) append(element.lower, nodes[i], 1);
    return element;
}

double lift_of_pressures(const PanelSheet& sheet, double alpha_deg) {
    const Point stream = free_stream(alpha_deg);
    // The edge from a to b has the normal -perpendicular(b - a) into the fluid, and pressure pushes against it.
    const auto lift_on = [&](Point a, Point b, double squared_speed) {
        return (1 - squared_speed) * dot(perpendicular(b - a), perpendicular(stream));
    };
    double lift = 0;
    for (std::size_t i = 0; i + 1 < sheet.nodes.size(); ++i) {
        const double g = sheet.strengths[i], next = sheet.strengths[i + 1];
        lift += lift_on(sheet.nodes[i], sheet.nodes[i + 1], (g * g + g * next + next * next) / 3);
    }
    const double end = 0.5 * (sheet.strengths.back() - sheet.strengths.front());
    return lift + lift_on(sheet.nodes.back(), sheet.nodes.front(), end * end);
}

double circulation(const PanelSheet& sheet) {
    double sum = sheet.base_strength * distance(sheet.nodes.back(), sheet.nodes.front());
    for (std::size_t i = 0; i + 1 < sheet.nodes.size(); ++i)
        sum += 0.5 * distance(sheet.nodes[i], sheet.nodes[i + 1]) * (sheet.strengths[i] + sheet.strengths[i + 1]);
    return sum;
}

}  // namespace lamina::flow
