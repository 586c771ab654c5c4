// Wakes are read from texts such as "10:2:0.01", cut off at walls, and divided into segments of growing size.
#include "sizing/wake.hpp"

#include <algorithm>
#include <cmath>

#include "core/length.hpp"
#include "core/option_builders.hpp"
#include "core/reproducible_math.hpp"
#include "core/text.hpp"

namespace lamina::sizing {

namespace {

/// Sizes along a wake grow by this share of the gradation. With the gradation itself the line would have no more effect
/// than its first point.
constexpr double growth_share = 0.1;
/// A wake is a chain of segments of one size each. This is the ratio of successive sizes.
constexpr double size_ratio = 1.05;

/// Returns the length, at most `length`, up to which the ray from p meets no wall that p does not lie on.
double free_length(Loops walls, Point p, Point direction, double length) {
    const double touching = 1e-9 * length;  // walls nearer than this are those that p lies on
    for (const std::vector<Point>& wall : walls) {
        for (std::size_t i = 0; i < wall.size(); ++i) {
            const Point a = wall[i] - p, b = wall[(i + 1) % wall.size()] - p;
            const double side_a = cross(direction, a), side_b = cross(direction, b);
            if ((side_a > 0) == (side_b > 0)) continue;
            const double t = (side_b * dot(direction, a) - side_a * dot(direction, b)) / (side_b - side_a);
            if (t > touching && t < length) length = t;
        }
    }
    return length;
}

}  // namespace

std::vector<Wake> find_wakes(const SizedBodies& bodies, const WakeOptions& options) {
    const double angle = core::radians(options.angle_deg.value_or(bodies.alpha_deg)),
                 length = in_units(options.length, bodies.chord);
    const Point direction{core::cos_reproducible(angle), core::sin_reproducible(angle)};
    std::vector<Wake> wakes;
    wakes.reserve(bodies.trailing_edges.size());
    for (const Point from : bodies.trailing_edges)
        wakes.push_back({from, direction, free_length(bodies.walls, from, direction, length)});
    return wakes;
}

std::vector<SizeSource> wake_sources(const Wake& wake, double size, double gradation) {
    const double growth = growth_share * gradation;
    std::vector<SizeSource> sources;
    for (double begin = 0; begin < wake.length;) {
        const double end = std::min(begin + (size_ratio - 1) * size / growth, wake.length);
        sources.push_back({wake.from + begin * wake.direction, wake.from + end * wake.direction, size});
        size *= size_ratio;
        begin = end;
    }
    return sources;
}

std::vector<SizeSource> given_wake_sources(const WakeOptions& options, const SizedBodies& bodies, double gradation) {
    std::vector<SizeSource> sources;
    if (!options.size) return sources;
    const double size = in_units(*options.size, bodies.chord);
    for (const Wake& wake : find_wakes(bodies, options)) {
        const std::vector<SizeSource> one = wake_sources(wake, size, gradation);
        sources.insert(sources.end(), one.begin(), one.end());
    }
    return sources;
}

WakeOptions parse_wake(const std::string& text) {
    const std::vector<std::string> parts = core::split(text, ':');
    core::require_text(parts.size() <= 3, text, "a wake is ANGLE[:LENGTH[:SIZE]]");
    WakeOptions wake;
    if (parts[0] != auto_word) wake.angle_deg = core::parse_number(parts[0]);
    core::require_text(std::abs(wake.angle_deg.value_or(0)) <= 360, text, "the angle must be from -360 to 360 degrees");
    if (parts.size() > 1) wake.length = core::parse_length(parts[1]);
    core::require_text(wake.length.value > 0, text, "the length must be > 0");
    if (parts.size() > 2) wake.size = core::parse_length(parts[2]);
    core::require_text(wake.size.value_or(1).value > 0, text, "the size must be > 0");
    return wake;
}

std::string wake_text(const WakeOptions& wake) {
    const std::string angle = wake.angle_deg ? core::to_text(*wake.angle_deg) : auto_word;
    const std::string text = core::concat(angle, ":", core::length_text(wake.length));
    return wake.size ? core::concat(text, ":", core::length_text(*wake.size)) : text;
}

}  // namespace lamina::sizing
