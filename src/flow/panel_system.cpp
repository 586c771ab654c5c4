// Source: M. Drela, XFOIL: an analysis and design system for low Reynolds number airfoils, in Low Reynolds Number
// Aerodynamics (1989), section 3.1; J. Katz, A. Plotkin, Low-Speed Aerodynamics, 2nd ed. (2001), section 11.4.
//
// The stream function of the free stream and of all sheets is constant along each body. Unlike a condition on normal
// velocities at the middles of panels, this one stays well-posed where the two sides of a thin trailing edge close to a
// cusp, and its solution at the nodes is the velocity along the wall itself.
#include "flow/panel_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/parallel.hpp"
#include "core/rounding.hpp"
#include "flow/dense_solve.hpp"
#include "flow/panel_kernel.hpp"
#include "flow/sides.hpp"

namespace lamina::flow {

namespace {

/// The panels of one body, in units of the system's length.
struct Body {
    std::vector<Point> nodes;
    std::vector<double> lengths;  ///< per panel
    std::vector<Point> along;     ///< per panel: its unit vector
    bool blunt, rounded;
    std::size_t column;  ///< of its first node in the system; its constant follows that of its last node
    // The base runs from the last node to the first one. Its sheets send the flow off with the speed at the trailing
    // edge in the direction between the two sides.
    double base_length = 0;
    Point base_along{};
    BaseStrengths base{};
};

Body make_body(const Contour& contour, std::size_t column, Point origin, double unit_length) {
    Body body{{}, {}, {}, contour.blunt, contour.rounded, column};
    for (const Point p : contour.nodes)
        body.nodes.push_back({(p.x - origin.x) / unit_length, (p.y - origin.y) / unit_length});
    for (std::size_t i = 0; i + 1 < body.nodes.size(); ++i) {
        body.lengths.push_back(distance(body.nodes[i], body.nodes[i + 1]));
        body.along.push_back((1 / body.lengths[i]) * (body.nodes[i + 1] - body.nodes[i]));
    }
    if (!body.blunt) return body;
    const Point base = body.nodes.front() - body.nodes.back();
    body.base_length = length(base);
    body.base_along = (1 / body.base_length) * base;
    body.base = base_strengths(body.nodes, body.base_along);
    return body;
}

/// Adds to a row of the system what unit strengths at the nodes of a body give to the stream function at a point, times
/// a factor.
void add_sheet(std::span<double> row, const Body& body, Point p, double times, std::span<LoggedNode> seen) {
    const std::size_t n = body.nodes.size();
    for (std::size_t j = 0; j < n; ++j) seen[j] = see_with_log(body.nodes[j], p);
    const double factor = times / (2 * core::pi);
    for (std::size_t j = 0; j + 1 < n; ++j) {
        const SeenPanel panel = see_panel(seen[j], seen[j + 1], body.lengths[j], body.along[j]);
        const PanelIntegrals log = integrate_log(panel, seen[j], seen[j + 1]);
        row[body.column + j] -= factor * (log.constant - log.linear);
        row[body.column + j + 1] -= factor * log.linear;
    }
}

/// Adds what the sheet of a body's copy, far away in a row, gives to the stream function at p: by two points of Gauss
/// on each panel, and with logarithms of distances over the shift. The integrals of add_sheet() are differences of
/// numbers as large as the square of the distance.
void add_far_copy(std::span<double> row, const Body& body, Point p, const Image& copy) {
    const double in_square = 1 / (copy.shift * copy.shift);
    const Point from = copy.seen_from(p);
    constexpr double half_span = 0.28867513459481288;  // of the points, 1 / sqrt(12)
    for (std::size_t j = 0; j + 1 < body.nodes.size(); ++j)
        for (const double t : {0.5 - half_span, 0.5 + half_span}) {
            const Point at = body.nodes[j] + t * (body.nodes[j + 1] - body.nodes[j]);
            const double logarithm = 0.5 * core::log_reproducible(squared_length(at - from) * in_square);
            const double value = copy.stream_function_factor() / (2 * core::pi) * 0.5 * body.lengths[j] * logarithm;
            row[body.column + j] -= (1 - t) * value;
            row[body.column + j + 1] -= t * value;
        }
}

/// Returns the stream function of the base of a body at a point for unit speed at its trailing edge
/// (source_stream_function()).
double base_stream_function(const Body& body, Point p, double direction_angle, bool is_at_start) {
    const LoggedNode a = see_with_log(body.nodes.back(), p), b = see_with_log(body.nodes.front(), p);
    const SeenPanel panel = see_panel(a, b, body.base_length, body.base_along);
    return (body.base.sources * source_stream_function(panel, a, b, direction_angle, is_at_start) -
            body.base.vortices * integrate_log(panel, a, b).constant) /
           (2 * core::pi);
}

/// Adds to the rows of a body what an image of the base of another one, or of its own, gives to the stream function at
/// its nodes.
void add_base(std::vector<double>& matrix, std::size_t size, const Body& at, const Body& of, const Image& image) {
    double angle = 0;
    Point last{};
    for (std::size_t i = 0; i < at.nodes.size(); ++i) {
        const Point p = image.seen_from(at.nodes[i]), from_start = p - of.nodes.back();
        const bool is_at_start = squared_length(from_start) == 0;
        if (!is_at_start) {
            angle += core::angle_between(i == 0 ? of.base_along : last, from_start);
            last = from_start;
        }
        const double value = 0.5 * image.stream_function_factor() * base_stream_function(of, p, angle, is_at_start);
        double* const row = matrix.data() + (at.column + i) * size + of.column;
        row[0] -= value;  // the speed at the trailing edge is half the difference of the strengths there
        row[of.nodes.size() - 1] += value;
    }
}

/// Puts into a row the condition that the mean speed of both sides at a sharp trailing edge continues linearly that at
/// the next two pairs of nodes. The nodes of both sides coincide there, so that the stream function gives one condition
/// for two strengths.
void extrapolate_speed(std::span<double> row, const Body& body) {
    const std::size_t last = body.nodes.size() - 1;
    const auto& l = body.lengths;
    const double near = 0.5 * (l[0] + l[last - 1]), far = near + 0.5 * (l[1] + l[last - 2]);
    const double share = near / (far - near);
    const double weight[3] = {1, -(1 + share), share};
    for (std::size_t k = 0; k < 3; ++k) {
        row[body.column + k] -= weight[k];
        row[body.column + last - k] += weight[k];
    }
}

/// The condition that the flow leaves the trailing edge smoothly: at a corner both sides have the same speed there.
/// Without a corner the trailing edge is a stagnation point.
void add_kutta_conditions(std::vector<double>& matrix, std::size_t size, const Body& body) {
    const std::size_t last = body.column + body.nodes.size() - 1;
    const auto row = [&](std::size_t i) { return std::span(matrix).subspan(i * size, size); };
    row(last + 1)[last] = 1;
    row(last + 1)[body.column] = body.rounded ? 0 : 1;
    if (body.blunt) return;
    std::fill(row(last).begin(), row(last).end(), 0.0);
    if (body.rounded) {
        row(last)[body.column] = 1;
    } else {
        extrapolate_speed(row(last), body);
    }
}

/// The bodies, and the walls in their units.
struct Bodies {
    std::vector<Body> bodies;
    FlowWalls walls;
    double unit_length;  ///< of the units
};

Bodies make_bodies(std::span<const Contour> contours, const FlowWalls& walls) {
    // The logarithms of lengths depend on their unit. The extent of the bodies takes its place, so that scaling by a
    // power of two changes no bit.
    Box box;
    for (const Contour& contour : contours)
        for (const Point p : contour.nodes) box.include(p);
    const double unit_length = std::max(box.width(), box.height());
    Bodies result{{}, {}, unit_length};
    std::size_t column = 0;
    for (const Contour& contour : contours) {
        result.bodies.push_back(make_body(contour, column, box.lower, unit_length));
        column += contour.nodes.size() + 1;
    }
    if (walls.below) result.walls.below = (*walls.below - box.lower.y) / unit_length;
    if (walls.above) result.walls.above = (*walls.above - box.lower.y) / unit_length;
    if (walls.pitch) result.walls.pitch = *walls.pitch / unit_length;
    return result;
}

/// Copies in a row farther away than this, in extents of the configuration, count as add_far_copy() says.
constexpr double far_away = 4;

/// Adds to the rows of a body's nodes what the sheets of all bodies and of their images induce there.
void add_sheets(std::vector<double>& matrix, std::size_t size, const Body& at, std::span<const Body> bodies,
                std::span<const Image> images) {
    constexpr std::size_t grain = 16;
    core::parallel_for(at.nodes.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::vector<LoggedNode> seen(size);
        for (std::size_t i = begin; i < end; ++i) {
            const std::span<double> row = std::span(matrix).subspan((at.column + i) * size, size);
            for (const Image& image : images)
                for (const Body& of : bodies) {
                    if (image.in_row && std::abs(image.shift) > far_away)
                        add_far_copy(row, of, at.nodes[i], image);
                    else
                        add_sheet(row, of, image.seen_from(at.nodes[i]), image.stream_function_factor(), seen);
                }
        }
    });
    for (const Image& image : images)
        for (const Body& of : bodies)
            if (of.blunt) add_base(matrix, size, at, of, image);
}

std::size_t system_size(std::span<const Body> bodies) { return bodies.back().column + bodies.back().nodes.size() + 1; }

/// Returns the matrix of the stream functions at all nodes and of the Kutta conditions.
std::vector<double> make_matrix(std::span<const Body> bodies, std::span<const Image> images) {
    const std::size_t size = system_size(bodies);
    std::vector<double> matrix(size * size);
    for (const Body& at : bodies) {
        add_sheets(matrix, size, at, bodies, images);
        const std::size_t constant = at.column + at.nodes.size();
        for (std::size_t i = at.column; i < constant; ++i) matrix[i * size + constant] = -1;
        add_kutta_conditions(matrix, size, at);
    }
    return matrix;
}

/// Returns the strengths in the free stream, those that each body in turn adds whose trailing edge has a unit of
/// circulating flow round it, contrary to its Kutta condition, and those in a unit stream along y.
std::vector<std::vector<double>> solve_strengths(std::span<const Body> bodies, std::span<const Image> images,
                                                 Point stream) {
    const std::size_t size = system_size(bodies);
    std::vector<double> right_side(size), upright(size);
    std::vector<std::vector<double>> right_sides(1);
    for (const Body& at : bodies) {
        const std::size_t constant = at.column + at.nodes.size();
        for (std::size_t i = 0; i < at.nodes.size(); ++i) {
            right_side[at.column + i] = -cross(stream, at.nodes[i]);
            upright[at.column + i] = -cross({0, 1}, at.nodes[i]);
        }
        if (!at.blunt) right_side[constant - 1] = upright[constant - 1] = 0;
        std::vector<double>& turning = right_sides.emplace_back(size);
        turning[constant] = 1;
        if (at.rounded) turning[constant - 1] = 1;
    }
    right_sides.front() = std::move(right_side);
    right_sides.push_back(std::move(upright));
    return solve_dense(make_matrix(bodies, images), right_sides);
}

std::vector<PanelSheet> make_sheets(std::span<const Contour> contours, std::span<const Body> bodies,
                                    std::span<const double> strengths) {
    std::vector<PanelSheet> sheets;
    for (std::size_t e = 0; e < bodies.size(); ++e) {
        const std::vector<Point>& nodes = contours[e].nodes;
        sheets.push_back(make_sheet(nodes, strengths.subspan(bodies[e].column, nodes.size()), bodies[e].base));
    }
    return sheets;
}

/// Returns the sheets with strengths rounded to 1e-6 of the speed of the free stream: rounding errors of the system,
/// which are smaller by far, have no part in what is made of the flow.
std::vector<PanelSheet> rounded(std::vector<PanelSheet> sheets) {
    constexpr double step = 0x1p-20;
    for (PanelSheet& sheet : sheets)
        for (double& strength : sheet.strengths) strength = core::rounded_to_multiple(strength, step);
    return sheets;
}

double total_circulation(std::span<const PanelSheet> sheets) {
    double total = 0;
    for (const PanelSheet& sheet : sheets) total += circulation(sheet);
    return total;
}

/// Returns the velocity along y that the sheets of a row induce far ahead of it, with the opposite sign: added to the
/// stream that the sheets see, it makes the stream far ahead the given one.
double turning_of_row(std::span<const PanelSheet> sheets, double pitch) {
    return total_circulation(sheets) / (2 * pitch);
}

void add_multiple(double factor, std::span<const double> of, std::vector<double>& to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * of[i];
}

}  // namespace

Point free_stream(double alpha_deg) {
    const double alpha = core::radians(alpha_deg);
    return {core::cos_reproducible(alpha), core::sin_reproducible(alpha)};
}

Point leaving_direction(std::span<const Point> nodes) {
    constexpr double nearly_opposite = 1e-2;
    const std::size_t last = nodes.size() - 1;
    const Point above = unit(nodes[0] - nodes[1]), below = unit(nodes[last] - nodes[last - 1]), sum = above + below;
    // Both sides of a flat end without corners arrive from opposite directions: straight across it is the way out.
    return squared_length(sum) > nearly_opposite ? unit(sum) : unit(perpendicular(above - below));
}

BaseStrengths base_strengths(std::span<const Point> nodes, Point along) {
    const Point leaving = leaving_direction(nodes);
    return {dot(leaving, along), -dot(leaving, perpendicular(along))};
}

PanelSheet make_sheet(const std::vector<Point>& nodes, std::span<const double> strengths, const BaseStrengths& base) {
    const double speed = 0.5 * (strengths.back() - strengths.front());
    return {nodes, {strengths.begin(), strengths.end()}, speed * base.vortices, speed * base.sources};
}

PanelSolution solve_panels(std::span<const Contour> contours, double alpha_deg, const FlowWalls& walls) {
    if (contours.empty()) return {};
    const auto [bodies, scaled_walls, unit_length] = make_bodies(contours, walls);
    const std::vector<Image> images = bodies_and_images(scaled_walls);
    std::vector<std::vector<double>> strengths = solve_strengths(bodies, images, free_stream(alpha_deg));
    const std::vector<PanelSheet> in_stream = make_sheets(contours, bodies, strengths.front());
    PanelSolution solution{in_stream, {}, walls};
    if (walls.pitch) {
        const double given = turning_of_row(in_stream, *walls.pitch),
                     by_unit = turning_of_row(make_sheets(contours, bodies, strengths.back()), *walls.pitch);
        std::vector<double> turned = strengths.front();
        add_multiple(given / (1 - by_unit), strengths.back(), turned);
        solution.sheets = make_sheets(contours, bodies, turned);
    }

    // As much flow round each trailing edge as takes all circulation away.
    const std::size_t n = bodies.size();
    std::vector<double> matrix(n * n);
    std::vector<std::vector<double>> circulations{std::vector<double>(n)};
    for (std::size_t e = 0; e < n; ++e) circulations[0][e] = -circulation(in_stream[e]);
    for (std::size_t turned = 0; turned < n; ++turned) {
        const std::vector<PanelSheet> sheets = make_sheets(contours, bodies, strengths[1 + turned]);
        for (std::size_t e = 0; e < n; ++e) matrix[e * n + turned] = circulation(sheets[e]);
    }
    const std::vector<double> turning = solve_dense(std::move(matrix), circulations).front();
    for (std::size_t turned = 0; turned < n; ++turned)
        add_multiple(turning[turned], strengths[1 + turned], strengths.front());
    solution.without_lift = rounded(make_sheets(contours, bodies, strengths.front()));
    solution.sheets = rounded(std::move(solution.sheets));
    return solution;
}

std::vector<double> strengths_per_stream_function(std::span<const Contour> contours, const FlowWalls& walls) {
    const auto [bodies, scaled_walls, unit_length] = make_bodies(contours, walls);
    std::vector<std::size_t> columns;  // of all nodes
    std::vector<std::vector<double>> units;
    for (const Body& body : bodies)
        for (std::size_t j = 0; j < body.nodes.size(); ++j) {
            columns.push_back(body.column + j);
            std::vector<double>& unit = units.emplace_back(system_size(bodies));
            if (body.blunt || j + 1 < body.nodes.size()) unit[columns.back()] = -1 / unit_length;
        }
    const std::vector<std::vector<double>> answers =
        solve_dense(make_matrix(bodies, bodies_and_images(scaled_walls)), units);
    const std::size_t n = columns.size();
    std::vector<double> result(n * n);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) result[i * n + j] = answers[j][columns[i]];
    return result;
}

SheetVelocity::SheetVelocity(const Flow& flow)
    : SheetVelocity(sheets_of(flow), flow.alpha_deg, flow.panels ? flow.panels->walls : FlowWalls{}) {}

SheetVelocity::SheetVelocity(std::span<const PanelSheet> sheets, double alpha_deg, const FlowWalls& walls)
    : stream_(free_stream(alpha_deg)), images_(images_in(walls)) {
    if (walls.pitch) stream_.y += turning_of_row(sheets, *walls.pitch);
    for (const PanelSheet& sheet : sheets) {
        starts_.push_back(sheet.nodes.front());
        std::vector<Panel>& panels = sheets_.emplace_back();
        panels.reserve(sheet.nodes.size());
        for (std::size_t j = 1; j < sheet.nodes.size(); ++j) {
            const Point edge = sheet.nodes[j] - sheet.nodes[j - 1];
            const double panel_length = length(edge);
            panels.push_back({sheet.nodes[j], (1 / panel_length) * edge, panel_length, sheet.strengths[j - 1],
                              (sheet.strengths[j] - sheet.strengths[j - 1]) / panel_length, 0});
        }
        if (!has_base(sheet)) continue;
        const Point base = sheet.nodes.front() - sheet.nodes.back();
        panels.push_back({sheet.nodes.front(), unit(base), length(base), sheet.base_strength, 0, sheet.base_source});
    }
}

Point SheetVelocity::operator()(Point p) const {
    Point velocity = stream_ + induced_by_sheets(p);
    for (const Image& image : images_) velocity = velocity + image.velocity(induced_by_sheets(image.seen_from(p)));
    return velocity;
}

Point SheetVelocity::induced_by_sheets(Point p) const {
    Point velocity;
    for (std::size_t e = 0; e < sheets_.size(); ++e) {
        SeenNode a = see(starts_[e], p);
        for (const Panel& panel : sheets_[e]) {
            const SeenNode b = see(panel.end, p);
            const SeenPanel seen = see_panel(a, b, panel.length, panel.along);
            velocity = velocity + vortex_velocity(seen, a, b, panel.strength, panel.slope);
            if (panel.source != 0) velocity = velocity + source_velocity(seen, a, b, panel.source);
            a = b;
        }
    }
    return velocity;
}

}  // namespace lamina::flow
