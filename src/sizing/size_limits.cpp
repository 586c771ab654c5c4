// Lower bounds of the number of triangles that single options request: the integral of 1 / h^2, divided by the area of
// the equilateral triangle of edge 1. Inside a source of size s the integral is the area divided by s^2. Beside a
// border of length L, where h = s + g d at the distance d, g being the gradation, the integral up to the distance D is
//
//     L D / (s (s + g D)).
#include "sizing/requests.hpp"

#include <algorithm>
#include <cmath>

#include <lamina/limits.hpp>
#include <lamina/threads.hpp>

#include "core/length.hpp"
#include "core/limits.hpp"
#include "sizing/shapes.hpp"
#include "sizing/wake.hpp"

namespace lamina::sizing {

namespace {

/// Throws LimitError where an integral of 1 / h^2 amounts to far more triangles than the limits allow. The message
/// names the option and its value.
void require_within_limits(double inverse_square_integral, const std::string& option, const std::string& value,
                           const WorkLimits& limits) {
    // Some of the integral may lie inside bodies and layers.
    constexpr double certain = 2;
    const double triangles = inverse_square_integral / equilateral_area;
    if (triangles > certain * allowed_triangles(limits, core::mesh_cost))
        throw_limit_error(limits, estimate_run(triangles, core::mesh_cost, thread_count()), option, value);
}

/// Returns the integral of 1 / h^2 beside a border of this length and size, up to the distance `reach`.
double integral_beside(double length, double size, double gradation, double reach) {
    return length * reach / (size * (size + gradation * reach));
}

/// Returns the integral of 1 / h^2 in and beside a source, as far as it lies in the domain.
double integral_round(const SizeSource& source, double gradation, double reach, const Box& domain) {
    const auto [area, border] = extent_in(domain, source);
    return area / (source.size * source.size) + integral_beside(border, source.size, gradation, reach);
}

double total_length(const std::vector<std::vector<Point>>& loops) {
    double length = 0;
    for (const std::vector<Point>& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) length += distance(loop[i], loop[(i + 1) % loop.size()]);
    return length;
}

}  // namespace

void require_within_limits(const SizingOptions& options, const SizedBodies& bodies, const Box& domain,
                           const WorkLimits& limits) {
    const double gradation = options.gradation, reach = 0.1 * std::min(domain.width(), domain.height());
    if (options.far_size) {
        const double size = in_units(*options.far_size, bodies.chord);
        require_within_limits(domain.width() * domain.height() / (size * size), "far_size",
                              core::length_text(*options.far_size), limits);
    }
    for (const SizeSource& source : options.sources)
        require_within_limits(integral_round(source, gradation, reach, domain), "refine", size_source_text(source),
                              limits);
    if (const auto& size = options.wall_size)
        require_within_limits(
            integral_beside(total_length(bodies.walls), in_units(*size, bodies.chord), gradation, reach), "wall_size",
            core::length_text(*size), limits);
    for (const WakeOptions& wake : options.wakes) {
        double integral = 0;
        for (const SizeSource& source : given_wake_sources(wake, bodies, gradation))
            integral += integral_round(source, gradation, reach, domain);
        require_within_limits(integral, "wake", wake_text(wake), limits);
    }
}

}  // namespace lamina::sizing
