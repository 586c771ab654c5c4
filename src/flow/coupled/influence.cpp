#include "flow/coupled/influence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"
#include "core/segments.hpp"
#include "flow/panel_kernel.hpp"
#include "flow/panel_system.hpp"

namespace lamina::flow::coupled {

namespace {

constexpr double wake_length = 1;        // behind all trailing edges, in chords
constexpr std::size_t wake_places = 26;  // of a wake of this length that no other body is near
/// Panels of a wake near walls need be no shorter than this share of it makes them.
constexpr double least_panel_share = 0.01;
/// Longest panel of a wake over the distance to other walls, as along walls, and to other wakes. Of eleven angles of
/// CRM-HL and 30P-30N from 0 to 20 degrees all are found with 4, 10 with 2, and lift differs by 0.3 %. Without a bound
/// on the distance to wakes 16 degrees fails, with 1 as many as three.
constexpr double gap_share = 0.5, wake_gap_share = 4;

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

/// Returns the strengths at all nodes that answer a stream function there.
std::vector<double> strengths_for(std::span<const double> answers, std::span<const double> stream_function) {
    const std::size_t n = stream_function.size();
    std::vector<double> strengths(n);
    for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += answers[i * n + j] * stream_function[j];
        strengths[i] = sum;
    }
    return strengths;
}

/// Where the angle begins at which nodes are seen from the first node of a panel, since it must not jump along an
/// outline: the node from which it is followed, and the last direction before that with its angle from the panel.
struct AngleStart {
    std::size_t node;
    Point direction;
    double angle;
};

/// Adds the stream function of unit sources on a panel, times a factor, at nodes along an outline, seen as from an
/// image.
void add_stream_function(std::span<const Point> nodes, const Panel& panel, const AngleStart& start, const Image& image,
                         std::span<double> to) {
    const double factor = image.of_sources().stream_function_factor() / (2 * core::pi);
    auto [first, direction, angle] = start;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const std::size_t i = (first + k) % nodes.size();
        const Point p = image.seen_from(nodes[i]), from_start = p - panel.begin;
        const bool is_at_start = squared_length(from_start) == 0;
        if (!is_at_start) {
            angle += core::angle_between(direction, from_start);
            direction = from_start;
        }
        const SeenNode a = flow::see(panel.begin, p), b = flow::see(panel.end, p);
        to[i] += factor * source_stream_function(see(panel, a, b), a, b, angle, is_at_start);
    }
}

/// Returns the strengths at all nodes that unit sources on a panel and its images call for. `own` is the body that the
/// panel belongs to; from outside of it the constant of a body takes up where angles begin.
std::vector<double> answer_to_sources(const PanelResponse& response, const Panel& panel, std::size_t own,
                                      const AngleStart& start) {
    std::vector<double> stream_function(response.nodes);
    for (std::size_t e = 0; e < response.bodies.size(); ++e) {
        const BodyPanels& body = response.bodies[e];
        const std::span<const Point> nodes = body.contour.nodes;
        for (const Image& image : response.images) {
            const bool is_own = e == own && &image == response.images.data();
            add_stream_function(nodes, panel, is_own ? start : AngleStart{0, panel.along, 0}, image,
                                std::span(stream_function).subspan(body.first_node, nodes.size()));
        }
    }
    return strengths_for(response.answers, stream_function);
}

/// Adds the velocities in a direction at a point outside of a body for unit strengths at each of its nodes.
void add_speeds(const BodyPanels& body, const Image& image, Point at, Point direction, std::span<double> speeds) {
    const std::vector<Point>& nodes = body.contour.nodes;
    const Point p = image.seen_from(at);
    const auto along_direction = [&](Point of_body) { return dot(direction, image.velocity(of_body)); };
    SeenNode a = flow::see(nodes[0], p);
    for (std::size_t j = 0; j + 1 < nodes.size(); ++j) {
        const SeenNode b = flow::see(nodes[j + 1], p);
        const SeenPanel panel = see_panel(a, b, body.lengths[j], body.along[j]);
        const double slope = 1 / body.lengths[j];
        speeds[j] += along_direction(vortex_velocity(panel, a, b, 1, -slope));
        speeds[j + 1] += along_direction(vortex_velocity(panel, a, b, 0, slope));
        a = b;
    }
    if (!body.contour.blunt) return;
    const Panel base = make_panel(nodes.back(), nodes.front());
    const BaseStrengths strengths = base_strengths(nodes, base.along);
    const SeenNode first = flow::see(nodes.back(), p), last = flow::see(nodes.front(), p);
    const SeenPanel panel = see(base, first, last);
    const double at_unit_speed = along_direction(vortex_velocity(panel, first, last, strengths.vortices, 0) +
                                                 source_velocity(panel, first, last, strengths.sources));
    speeds.front() -= 0.5 * at_unit_speed;
    speeds[nodes.size() - 1] += 0.5 * at_unit_speed;
}

/// Returns the velocity in a direction at a point outside of all bodies for unit strengths at each node.
std::vector<double> speeds_by_strengths(const PanelResponse& response, Point p, Point direction) {
    std::vector<double> speeds(response.nodes);
    for (const BodyPanels& body : response.bodies)
        for (const Image& image : response.images)
            add_speeds(body, image, p, direction,
                       std::span(speeds).subspan(body.first_node, body.contour.nodes.size()));
    return speeds;
}

double speed_by_source(const Panel& panel, const Image& image, Point at, Point direction) {
    const Point p = image.seen_from(at);
    const SeenNode a = flow::see(panel.begin, p), b = flow::see(panel.end, p);
    return dot(direction, image.of_sources().velocity(source_velocity(see(panel, a, b), a, b, 1)));
}

// ---------------------------------------------------------------------------------------------------------------------
// Wakes

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

/// The flow without friction at an angle of attack.
struct OuterFlow {
    Point stream;
    std::vector<double> strengths;  ///< at all nodes
    SheetVelocity velocity;
};

OuterFlow make_outer_flow(const PanelResponse& response, double alpha_deg) {
    const Point stream = free_stream(alpha_deg);
    std::vector<double> of_stream;
    for (const BodyPanels& body : response.bodies)
        for (const Point p : body.contour.nodes) of_stream.push_back(cross(stream, p));
    std::vector<double> strengths = strengths_for(response.answers, of_stream);
    std::vector<PanelSheet> sheets;
    for (const BodyPanels& body : response.bodies) {
        const std::vector<Point>& nodes = body.contour.nodes;
        const BaseStrengths base =
            body.contour.blunt ? base_strengths(nodes, unit(nodes.front() - nodes.back())) : BaseStrengths{};
        sheets.push_back(make_sheet(nodes, std::span(strengths).subspan(body.first_node, nodes.size()), base));
    }
    return {stream, std::move(strengths), SheetVelocity(sheets, alpha_deg, response.walls)};
}

/// The wakes of all bodies.
using Wakes = std::vector<std::vector<Point>>;

double distance_to_line(Point p, std::span<const Point> line) {
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < line.size(); ++i)
        least = std::min(least, core::distance_to_segment(p, line[i - 1], line[i]));
    return least;
}

/// Returns the longest panel of a body's wake at a point, by the distances from the walls and known wakes of the
/// others.
double longest_panel(const PanelResponse& response, const Wakes& known, std::size_t own, Point p) {
    double longest = HUGE_VAL;
    for (std::size_t e = 0; e < response.bodies.size(); ++e) {
        if (e == own) continue;
        longest = std::min(longest, gap_share * distance_to_line(p, response.bodies[e].contour.nodes));
        if (!known.empty()) longest = std::min(longest, wake_gap_share * distance_to_line(p, known[e]));
    }
    return longest;
}

/// Returns how far a trailing edge lies ahead of the rearmost one.
double way_to_rear(const PanelResponse& response, std::size_t own, Point stream) {
    double rear = -HUGE_VAL;
    for (const BodyPanels& body : response.bodies) rear = std::max(rear, dot(body.contour.nodes.front(), stream));
    return rear - dot(response.bodies[own].contour.nodes.front(), stream);
}

/// Returns the places of a body's wake, by the midpoint rule along the flow. Panels are short where walls, and the
/// other wakes if they are known, are near.
std::vector<Point> trace_wake(const PanelResponse& response, const Wakes& known, std::size_t own,
                              const OuterFlow& flow) {
    const BodyPanels& body = response.bodies[own];
    const std::vector<Point>& nodes = body.contour.nodes;
    const auto direction_at = [&](Point p) {
        const Point velocity = flow.velocity(p);
        return length(velocity) > 0 ? unit(velocity) : flow.stream;
    };
    const double first = 0.5 * (body.lengths.front() + body.lengths.back()),
                 ratio = growth_of_steps(first, wake_length, wake_places - 1),
                 whole = wake_length + way_to_rear(response, own, flow.stream),
                 least = std::max(first, least_panel_share * whole);
    std::vector<Point> wake{midpoint(nodes.front(), nodes.back())};
    Point direction = leaving_direction(nodes);
    for (double step = first, s = 0; s + 0.5 * step < whole; step *= ratio) {
        step = std::min(step, std::max(longest_panel(response, known, own, wake.back()), least));
        if (wake.size() > 1) direction = direction_at(wake.back() + 0.5 * step * direction);
        wake.push_back(wake.back() + step * direction);
        s += step;
    }
    return wake;
}

Wakes trace_wakes(const PanelResponse& response, const Wakes& known, const OuterFlow& flow) {
    Wakes wakes;
    for (std::size_t e = 0; e < response.bodies.size(); ++e) wakes.push_back(trace_wake(response, known, e, flow));
    return wakes;
}

// ---------------------------------------------------------------------------------------------------------------------
// Sources

/// The answers of all speeds to unit sources on each panel of the walls and wakes.
class SourceAnswers {
public:
    SourceAnswers(const PanelResponse& response, std::span<const std::vector<Point>> wakes) : response_(response) {
        std::size_t place = 0, source = 0;
        for (std::size_t e = 0; e < wakes.size(); ++e) {
            const std::size_t nodes = response.bodies[e].contour.nodes.size();
            places_.push_back({place, place + nodes, place + nodes + wakes[e].size()});
            sources_.push_back({source, source + nodes - 1, source + nodes - 1 + wakes[e].size() - 1});
            place = places_.back().end, source = sources_.back().end;
            for (std::size_t j = 0; j + 1 < nodes; ++j)
                panels_.push_back({response.bodies[e].contour.nodes[j], response.bodies[e].contour.nodes[j + 1],
                                   response.bodies[e].lengths[j], response.bodies[e].along[j]});
            for (std::size_t k = 0; k + 1 < wakes[e].size(); ++k)
                panels_.push_back(make_panel(wakes[e][k], wakes[e][k + 1]));
        }
        answers_.assign(place * panels_.size(), 0);
        add_at_walls();
    }

    const std::vector<BodyPlaces>& places() const { return places_; }
    /// The sources of each body: those on its wall, then those along its wake.
    const std::vector<BodyPlaces>& sources() const { return sources_; }
    double length(std::size_t source) const { return panels_[source].length; }
    double at(std::size_t place, std::size_t source) const { return answers_[place * panels_.size() + source]; }

    /// Fills the answers along a wake. Returns the speeds there of the outer flow.
    std::vector<double> add_at_wake(std::size_t e, const OuterFlow& flow) {
        const auto [first, wake, end] = places_[e];
        std::vector<double> speeds;
        for (std::size_t k = 1; k < end - wake; ++k) {
            const Point p = panels_[sources_[e].wake + k - 1].end, direction = direction_at(e, k);
            const std::vector<double> by_strengths = speeds_by_strengths(response_, p, direction);
            double* const row = answers_.data() + (wake + k) * panels_.size();
            double speed = dot(flow.stream, direction);
            for (std::size_t b = 0; b < response_.bodies.size(); ++b)
                for (std::size_t i = places_[b].first; i < places_[b].wake; ++i) {
                    const std::size_t node = response_.bodies[b].first_node + i - places_[b].first;
                    for (std::size_t j = 0; j < panels_.size(); ++j) row[j] += by_strengths[node] * at(i, j);
                    speed += by_strengths[node] * flow.strengths[node];
                }
            for (std::size_t j = 0; j < panels_.size(); ++j) row[j] += by_source(e, k, j, p, direction);
            speeds.push_back(speed);
        }
        // At the trailing edge the wake has the mean speed of both sides.
        for (std::size_t j = 0; j < panels_.size(); ++j)
            answers_[wake * panels_.size() + j] = 0.5 * (at(wake - 1, j) - at(first, j));
        return speeds;
    }

private:
    Point direction_at(std::size_t e, std::size_t k) const {
        const Panel* const wake = panels_.data() + sources_[e].wake;
        return k + 1 < places_[e].end - places_[e].wake ? unit(wake[k - 1].along + wake[k].along) : wake[k - 1].along;
    }

    void add_at_walls() {
        for (std::size_t of = 0; of < response_.bodies.size(); ++of) {
            const BodyPanels& body = response_.bodies[of];
            for (std::size_t j = sources_[of].first; j < sources_[of].wake; ++j) {
                const std::size_t panel = body.first_panel + j - sources_[of].first;
                set_at_walls(j, [&](std::size_t node) { return response_.to_walls[node * response_.panels + panel]; });
            }
            for (std::size_t j = sources_[of].wake; j < sources_[of].end; ++j) {
                // Upstream of the wake is the body, round which the angle does not jump.
                const Panel& panel = panels_[j];
                const std::vector<double> strengths =
                    answer_to_sources(response_, panel, of, {0, -panel.along, core::pi});
                set_at_walls(j, [&](std::size_t node) { return strengths[node]; });
            }
        }
    }

    template <class Answer>
    void set_at_walls(std::size_t source, Answer&& answer) {
        for (std::size_t b = 0; b < response_.bodies.size(); ++b)
            for (std::size_t i = places_[b].first; i < places_[b].wake; ++i)
                answers_[i * panels_.size() + source] = answer(response_.bodies[b].first_node + i - places_[b].first);
    }

    /// Returns what a panel and its images do to the speed at place k of a wake: of the wake itself the mean of the
    /// speeds at the middles of both neighbouring panels, since that at the end of a panel is not finite.
    double by_source(std::size_t e, std::size_t k, std::size_t source, Point p, Point direction) const {
        const bool is_own = source >= sources_[e].wake && source < sources_[e].end;
        double speed = 0;
        for (const Image& image : response_.images)
            speed += is_own && &image == response_.images.data()
                         ? by_own_wake(e, k, source)
                         : speed_by_source(panels_[source], image, p, direction);
        return speed;
    }

    double by_own_wake(std::size_t e, std::size_t k, std::size_t source) const {
        const Panel* const wake = panels_.data() + sources_[e].wake;
        const auto at_middle = [&](std::size_t panel) {
            const Panel& at = wake[panel];
            return speed_by_source(panels_[source], response_.images.front(), midpoint(at.begin, at.end), at.along);
        };
        if (sources_[e].wake + k == sources_[e].end) return at_middle(k - 1);
        const double before = wake[k - 1].length, behind = wake[k].length;
        return (behind * at_middle(k - 1) + before * at_middle(k)) / (before + behind);
    }

    const PanelResponse& response_;
    std::vector<BodyPlaces> places_, sources_;
    std::vector<Panel> panels_;
    std::vector<double> answers_;
};

/// Turns answers to sources to those to fluxes, whose growth along a panel is its source.
std::vector<double> answers_to_fluxes(const SourceAnswers& answers) {
    const std::size_t n = answers.places().back().end;
    std::vector<double> matrix(n * n);
    const auto add = [&](std::size_t source, std::size_t from) {
        for (std::size_t i = 0; i < n; ++i) {
            const double answer = answers.at(i, source) / answers.length(source);
            matrix[i * n + from] -= answer;
            matrix[i * n + from + 1] += answer;
        }
    };
    for (std::size_t e = 0; e < answers.places().size(); ++e) {
        const BodyPlaces &places = answers.places()[e], &sources = answers.sources()[e];
        for (std::size_t j = sources.first; j < sources.wake; ++j) add(j, places.first + j - sources.first);
        for (std::size_t j = sources.wake; j < sources.end; ++j) add(j, places.wake + j - sources.wake);
    }
    return matrix;
}

}  // namespace

PanelResponse make_response(std::span<const Contour> contours, const FlowWalls& walls) {
    PanelResponse response;
    response.walls = walls;
    response.images = bodies_and_images(walls);
    for (const Contour& contour : contours) {
        BodyPanels body{contour, {}, {}, response.nodes, response.panels};
        for (std::size_t j = 0; j + 1 < contour.nodes.size(); ++j) {
            const Panel panel = make_panel(contour.nodes[j], contour.nodes[j + 1]);
            body.lengths.push_back(panel.length);
            body.along.push_back(panel.along);
        }
        response.nodes += contour.nodes.size();
        response.panels += body.lengths.size();
        response.bodies.push_back(std::move(body));
    }
    response.answers = strengths_per_stream_function(contours, walls);
    response.to_walls.assign(response.nodes * response.panels, 0);
    for (std::size_t e = 0; e < response.bodies.size(); ++e) {
        const BodyPanels& body = response.bodies[e];
        for (std::size_t j = 0; j < body.lengths.size(); ++j) {
            const Panel panel{body.contour.nodes[j], body.contour.nodes[j + 1], body.lengths[j], body.along[j]};
            // Seen from the panel's first node, the outline turns from the panel's direction to the left.
            const std::vector<double> strengths = answer_to_sources(response, panel, e, {j + 1, panel.along, 0});
            for (std::size_t i = 0; i < response.nodes; ++i)
                response.to_walls[i * response.panels + body.first_panel + j] = strengths[i];
        }
    }
    return response;
}

Influence influence_at(const PanelResponse& response, double alpha_deg) {
    const OuterFlow flow = make_outer_flow(response, alpha_deg);
    const Wakes wakes = trace_wakes(response, trace_wakes(response, {}, flow), flow);
    SourceAnswers answers(response, wakes);
    Influence result;
    result.bodies = answers.places();
    for (std::size_t e = 0; e < response.bodies.size(); ++e) {
        const BodyPanels& body = response.bodies[e];
        const std::size_t nodes = body.contour.nodes.size();
        for (std::size_t i = 0; i < nodes; ++i) {
            result.at.push_back(body.contour.nodes[i]);
            result.s.push_back(i == 0 ? 0 : result.s.back() + body.lengths[i - 1]);
            result.speed.push_back(flow.strengths[body.first_node + i]);
        }
        const std::vector<double> speeds = answers.add_at_wake(e, flow);
        for (std::size_t k = 0; k < wakes[e].size(); ++k) {
            result.at.push_back(wakes[e][k]);
            result.s.push_back(k == 0 ? 0 : result.s.back() + distance(wakes[e][k - 1], wakes[e][k]));
            result.speed.push_back(
                k == 0 ? 0.5 * (result.speed.back() - *(result.speed.end() - static_cast<std::ptrdiff_t>(nodes)))
                       : speeds[k - 1]);
        }
    }
    result.matrix = answers_to_fluxes(answers);
    return result;
}

}  // namespace lamina::flow::coupled
