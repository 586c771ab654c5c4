// Streamlines by a Runge-Kutta pair of orders 5 and 4 with step control, along the arc length.
// Source: J. R. Dormand, P. J. Prince, A family of embedded Runge-Kutta formulae, J. Comput. Appl. Math. 6 (1980).
#include <lamina/flow.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/box_tree.hpp"
#include "core/rounding.hpp"
#include "core/segments.hpp"
#include "flow/panel_system.hpp"

namespace lamina::flow {

namespace {

/// The panels and bases of all bodies, which no streamline crosses.
class Walls {
public:
    explicit Walls(std::span<const PanelSheet> sheets) : tree_({}) {
        std::vector<Box> boxes;
        for (const PanelSheet& sheet : sheets)
            for (std::size_t i = 0; i < sheet.nodes.size(); ++i) {
                edges_.push_back({sheet.nodes[i], sheet.nodes[(i + 1) % sheet.nodes.size()]});
                boxes.push_back(core::bounding_box(edges_.back().first, edges_.back().second));
            }
        tree_ = core::BoxTree(std::move(boxes));
    }

    bool meet(Point a, Point b) const {
        bool found = false;
        tree_.overlaps(core::bounding_box(a, b), [&](std::size_t i) {
            found = found || core::segments_meet(a, b, edges_[i].first, edges_[i].second);
        });
        return found;
    }

private:
    std::vector<std::pair<Point, Point>> edges_;
    core::BoxTree tree_;
};

/// A point with the velocity there.
struct FlowingPoint {
    Point at, velocity;
};

/// One step of the pair: the point of order 5, and its distance from that of order 4.
struct Step {
    FlowingPoint to;
    double error;
};

/// Returns the step of this length, or nothing where the fluid is at rest on the way. The last velocity of a step is
/// the first one of the next.
std::optional<Step> try_step(const SheetVelocity& velocity, const FlowingPoint& from, double h) {
    constexpr double nearly_at_rest = 1e-3;
    constexpr double a[6][6] = {{1.0 / 5},
                                {3.0 / 40, 9.0 / 40},
                                {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    constexpr double difference[7] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                      -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
    std::array<Point, 7> direction;
    FlowingPoint p = from;
    for (std::size_t stage = 0;; ++stage) {
        if (!(length(p.velocity) > nearly_at_rest)) return std::nullopt;
        direction[stage] = unit(p.velocity);
        if (stage == 6) break;
        Point slope;
        for (std::size_t k = 0; k <= stage; ++k) slope = slope + a[stage][k] * direction[k];
        p.at = from.at + h * slope;
        p.velocity = velocity(p.at);
    }
    Point error;
    for (std::size_t k = 0; k < 7; ++k) error = error + difference[k] * direction[k];
    return Step{p, h * length(error)};
}

/// Returns a point of a streamline rounded to 1e-9 chords. Where streamlines part, such as before a body, rounding
/// errors would grow along them.
Point rounded(Point p, double chord) {
    constexpr double step = 0x1p-30;
    return chord * core::rounded_to_multiples((1 / chord) * p, step);
}

/// Returns the first point behind a trailing edge, one panel downstream of it, if that is where a streamline begins.
std::optional<Point> leave_trailing_edge(std::span<const PanelSheet> sheets, Point from) {
    constexpr double same_place = 1e-6;  // as a share of the panel
    for (const PanelSheet& sheet : sheets) {
        const double panel = distance(sheet.nodes[0], sheet.nodes[1]);
        const Point middle = midpoint(sheet.nodes.front(), sheet.nodes.back());
        if (distance(from, middle) <= same_place * panel) return middle + panel * leaving_direction(sheet.nodes);
    }
    return std::nullopt;
}

}  // namespace

}  // namespace lamina::flow

namespace lamina {

using namespace flow;

std::vector<Point> streamline(const Flow& flow, Point from, double length, const StreamlineOptions& options) {
    const Walls walls(sheets_of(flow));
    std::vector<Point> points{from};
    double done = 0;
    if (const std::optional<Point> behind = leave_trailing_edge(sheets_of(flow), from); behind && length > 0) {
        done = distance(from, *behind);
        points.push_back(*behind);
    }
    if (!(done < length)) return points;
    const SheetVelocity velocity(flow);
    FlowingPoint last{points.back(), velocity(points.back())};
    const double longest = options.max_step * flow.chord, shortest = 1e-6 * longest;
    double h = 0.1 * longest;
    while (done < length) {
        h = std::min(h, length - done);
        const std::optional<Step> step = try_step(velocity, last, h);
        const bool is_shortest = h <= shortest;
        if (step && (is_shortest || step->error <= options.tolerance * flow.chord) &&
            !walls.meet(last.at, step->to.at)) {
            last = {rounded(step->to.at, flow.chord), step->to.velocity};
            points.push_back(last.at);
            done += h;
            // The error grows with the fifth power of the step. Two square roots come close enough to the fifth root.
            const double room = options.tolerance * flow.chord / std::max(step->error, 1e-300);
            h = std::clamp(0.9 * std::sqrt(std::sqrt(room)), 0.2, 2.0) * h;
            h = std::clamp(h, shortest, longest);
            // Much of a small error is rounding, which must not decide where points are.
            h = flow.chord *
                core::rounded_to_multiple(h / flow.chord, 0.125 * core::power_of_two_below(h / flow.chord));
        } else {
            if (is_shortest) {
                // What is left of the way may be less than the shortest step.
                break;
            }
            h = std::max(0.5 * h, shortest);
        }
    }
    return points;
}

}  // namespace lamina
