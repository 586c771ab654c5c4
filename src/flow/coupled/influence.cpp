#include "flow/coupled/influence.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "core/angles.hpp"
#include "flow/panel_kernel.hpp"
#include "flow/panel_system.hpp"

namespace lamina::flow::coupled {

namespace {

constexpr double wake_length = 1;  // in chords
constexpr std::size_t wake_places = 26;

/// A straight panel.
struct Panel {
    Point begin, end;
    double length;
    Point along;
};

Panel make_panel(Point begin, Point end) { return {begin, end, distance(begin, end), unit(end - begin)}; }

SeenPanel see(const Panel& panel, const SeenNode& a, const SeenNode& b) {
    return see_panel(a, b, panel.length, panel.along);
}

/// Returns the stream function of unit sources on a panel at nodes along the outline from `first` on, round to the node
/// before it. `direction` is that of the panel's first node to `first`, at this angle from the panel.
std::vector<double> stream_function_along(std::span<const Point> nodes, const Panel& panel, std::size_t first,
                                          Point direction, double angle) {
    std::vector<double> result(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const std::size_t i = (first + k) % nodes.size();
        const Point from_start = nodes[i] - panel.begin;
        const bool is_at_start = squared_length(from_start) == 0;
        if (!is_at_start) {
            angle += core::angle_between(direction, from_start);
            direction = from_start;
        }
        const SeenNode a = flow::see(panel.begin, nodes[i]), b = flow::see(panel.end, nodes[i]);
        result[i] = source_stream_function(see(panel, a, b), a, b, angle, is_at_start) / (2 * core::pi);
    }
    return result;
}

/// Returns the strengths that cancel a stream function at the nodes.
std::vector<double> cancel(const BodyResponse& body, std::span<const double> stream_function) {
    const std::size_t n = stream_function.size();
    std::vector<double> strengths(n);
    for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += body.answers[i * n + j] * stream_function[j];
        strengths[i] = sum;
    }
    return strengths;
}

/// The base of a body: what it adds to the velocities for unit speed at the trailing edge.
struct Base {
    Panel panel;
    double vortices, sources;
};

Base make_base(std::span<const Point> nodes) {
    const Panel panel = make_panel(nodes.back(), nodes.front());
    const Point leaving = leaving_direction(nodes);
    return {panel, dot(leaving, panel.along), -dot(leaving, perpendicular(panel.along))};
}

/// Returns the velocity in a direction at a point outside of the body for unit strengths at each node.
std::vector<double> speeds_by_strengths(const BodyResponse& body, Point p, Point direction) {
    const std::vector<Point>& nodes = body.contour.nodes;
    std::vector<double> speeds(nodes.size());
    SeenNode a = flow::see(nodes[0], p);
    for (std::size_t j = 0; j + 1 < nodes.size(); ++j) {
        const SeenNode b = flow::see(nodes[j + 1], p);
        const SeenPanel panel = see_panel(a, b, body.lengths[j], body.along[j]);
        const double slope = 1 / body.lengths[j];
        speeds[j] += dot(direction, vortex_velocity(panel, a, b, 1, -slope));
        speeds[j + 1] += dot(direction, vortex_velocity(panel, a, b, 0, slope));
        a = b;
    }
    if (!body.contour.blunt) return speeds;
    const Base base = make_base(nodes);
    const SeenNode first = flow::see(nodes.back(), p), last = flow::see(nodes.front(), p);
    const SeenPanel panel = see(base.panel, first, last);
    const double at_unit_speed = dot(direction, vortex_velocity(panel, first, last, base.vortices, 0) +
                                                    source_velocity(panel, first, last, base.sources));
    speeds.front() -= 0.5 * at_unit_speed;
    speeds.back() += 0.5 * at_unit_speed;
    return speeds;
}

double speed_by_source(const Panel& panel, Point p, Point direction) {
    const SeenNode a = flow::see(panel.begin, p), b = flow::see(panel.end, p);
    return dot(direction, source_velocity(see(panel, a, b), a, b, 1));
}

/// Returns the factor by which steps grow whose first one and whose sum are given.
double growth_of_steps(double first, double sum, std::size_t count) {
    double low = 1, high = 2;
    for (int i = 0; i < 50; ++i) {
        const double ratio = 0.5 * (low + high);
        double total = 0, step = first;
        for (std::size_t k = 0; k < count; ++k, step *= ratio) total += step;
        (total < sum ? low : high) = ratio;
    }
    return 0.5 * (low + high);
}

/// Returns the places of the wake, by the midpoint rule along the flow of these strengths.
std::vector<Point> trace_wake(const BodyResponse& body, std::span<const double> strengths, Point stream) {
    const std::vector<Point>& nodes = body.contour.nodes;
    const auto direction_at = [&](Point p) {
        const auto along = [&](Point direction) {
            const std::vector<double> speeds = speeds_by_strengths(body, p, direction);
            double sum = dot(stream, direction);
            for (std::size_t j = 0; j < speeds.size(); ++j) sum += strengths[j] * speeds[j];
            return sum;
        };
        const Point velocity{along({1, 0}), along({0, 1})};
        return length(velocity) > 0 ? unit(velocity) : stream;
    };
    double step = 0.5 * (body.lengths.front() + body.lengths.back());
    const double ratio = growth_of_steps(step, wake_length, wake_places - 1);
    std::vector<Point> wake{midpoint(nodes.front(), nodes.back())};
    Point direction = leaving_direction(nodes);
    while (wake.size() < wake_places) {
        if (wake.size() > 1) direction = direction_at(wake.back() + 0.5 * step * direction);
        wake.push_back(wake.back() + step * direction);
        step *= ratio;
    }
    return wake;
}

/// The answers of all speeds to unit sources on each panel, first those of the wall, then those of the wake.
class SourceAnswers {
public:
    SourceAnswers(const BodyResponse& body, std::span<const Point> wake)
        : body_(body), wall_(body.contour.nodes.size()), sources_(wall_ - 1 + wake.size() - 1) {
        for (std::size_t k = 0; k + 1 < wake.size(); ++k) wake_.push_back(make_panel(wake[k], wake[k + 1]));
        answers_.assign((wall_ + wake.size()) * sources_, 0);
        add_walls();
    }

    double at(std::size_t place, std::size_t source) const { return answers_[place * sources_ + source]; }

    /// Returns, per place of the wake but the first, the speeds for unit strengths at each node, and fills its answers.
    std::vector<std::vector<double>> add_wake() {
        std::vector<std::vector<double>> by_strengths;
        for (std::size_t k = 1; k <= wake_.size(); ++k) {
            const Point p = wake_[k - 1].end, direction = direction_at(k);
            const std::vector<double>& speeds = by_strengths.emplace_back(speeds_by_strengths(body_, p, direction));
            double* const row = answers_.data() + (wall_ + k) * sources_;
            for (std::size_t i = 0; i < wall_; ++i)
                for (std::size_t j = 0; j < sources_; ++j) row[j] += speeds[i] * at(i, j);
            for (std::size_t j = 0; j + 1 < wall_; ++j)
                row[j] += speed_by_source(
                    {body_.contour.nodes[j], body_.contour.nodes[j + 1], body_.lengths[j], body_.along[j]}, p,
                    direction);
            for (std::size_t j = 0; j < wake_.size(); ++j) row[wall_ - 1 + j] += by_wake(k, j);
        }
        // At the trailing edge the wake has the mean speed of both sides.
        for (std::size_t j = 0; j < sources_; ++j) answers_[wall_ * sources_ + j] = 0.5 * (at(wall_ - 1, j) - at(0, j));
        return by_strengths;
    }

    Point direction_at(std::size_t k) const {
        return k < wake_.size() ? unit(wake_[k - 1].along + wake_[k].along) : wake_[k - 1].along;
    }

private:
    void add_walls() {
        for (std::size_t i = 0; i < wall_; ++i)
            for (std::size_t j = 0; j + 1 < wall_; ++j)
                answers_[i * sources_ + j] = body_.to_walls[i * (wall_ - 1) + j];
        const std::vector<Point>& nodes = body_.contour.nodes;
        for (std::size_t k = 0; k < wake_.size(); ++k) {
            // Upstream of the wake is the body, round which the angle does not jump.
            const std::vector<double> strengths =
                cancel(body_, stream_function_along(nodes, wake_[k], 0, -wake_[k].along, core::pi));
            for (std::size_t i = 0; i < wall_; ++i) answers_[i * sources_ + wall_ - 1 + k] = strengths[i];
        }
    }

    /// Returns what a panel of the wake does to the speed at its place k: the mean of the speeds at the middles of both
    /// neighbouring panels, since that at the end of a panel is not finite.
    double by_wake(std::size_t k, std::size_t source) const {
        const auto at_middle = [&](std::size_t panel) {
            const Panel& at = wake_[panel];
            return speed_by_source(wake_[source], midpoint(at.begin, at.end), at.along);
        };
        if (k == wake_.size()) return at_middle(k - 1);
        const double before = wake_[k - 1].length, behind = wake_[k].length;
        return (behind * at_middle(k - 1) + before * at_middle(k)) / (before + behind);
    }

    const BodyResponse& body_;
    std::size_t wall_, sources_;
    std::vector<Panel> wake_;
    std::vector<double> answers_;
};

/// Turns answers to sources to those to fluxes, whose growth along a panel is its source.
std::vector<double> answers_to_fluxes(const BodyResponse& body, const Influence& places, const SourceAnswers& answers) {
    const std::size_t n = places.at.size(), wall = places.wall;
    std::vector<double> matrix(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        double* const row = matrix.data() + i * n;
        for (std::size_t j = 0; j + 1 < n; ++j) {
            if (j + 1 == wall) continue;
            const std::size_t source = j < wall ? j : j - 1;
            const double length = j < wall ? body.lengths[j] : places.s[j + 1] - places.s[j];
            const double answer = answers.at(i, source) / length;
            row[j] -= answer;
            row[j + 1] += answer;
        }
    }
    return matrix;
}

}  // namespace

BodyResponse make_response(Contour contour) {
    BodyResponse body{std::move(contour), {}, {}, {}, {}};
    const std::vector<Point>& nodes = body.contour.nodes;
    const std::size_t n = nodes.size();
    body.answers = strengths_per_stream_function(body.contour);
    body.to_walls.assign(n * (n - 1), 0);
    for (std::size_t j = 0; j + 1 < n; ++j) {
        const Panel panel = make_panel(nodes[j], nodes[j + 1]);
        body.lengths.push_back(panel.length);
        body.along.push_back(panel.along);
        // Seen from the panel's first node, the outline turns from the panel's direction to the left.
        const std::vector<double> strengths = cancel(body, stream_function_along(nodes, panel, j + 1, panel.along, 0));
        for (std::size_t i = 0; i < n; ++i) body.to_walls[i * (n - 1) + j] = strengths[i];
    }
    return body;
}

Influence influence_at(const BodyResponse& body, double alpha_deg) {
    const Point stream = free_stream(alpha_deg);
    Influence result;
    result.at = body.contour.nodes;
    result.wall = result.at.size();
    std::vector<double> of_stream;
    for (const Point p : result.at) of_stream.push_back(cross(stream, p));
    result.speed = cancel(body, of_stream);
    const std::vector<Point> wake = trace_wake(body, result.speed, stream);
    for (std::size_t i = 0; i < result.wall; ++i)
        result.s.push_back(i == 0 ? 0 : result.s[i - 1] + body.lengths[i - 1]);
    for (std::size_t k = 0; k < wake.size(); ++k)
        result.s.push_back(k == 0 ? 0 : result.s.back() + distance(wake[k - 1], wake[k]));
    result.at.insert(result.at.end(), wake.begin(), wake.end());
    SourceAnswers answers(body, wake);
    const std::vector<std::vector<double>> by_strengths = answers.add_wake();
    result.speed.push_back(0.5 * (result.speed[result.wall - 1] - result.speed[0]));
    for (std::size_t k = 1; k < wake.size(); ++k) {
        double speed = dot(stream, answers.direction_at(k));
        for (std::size_t j = 0; j < result.wall; ++j) speed += by_strengths[k - 1][j] * result.speed[j];
        result.speed.push_back(speed);
    }
    result.matrix = answers_to_fluxes(body, result, answers);
    return result;
}

}  // namespace lamina::flow::coupled
