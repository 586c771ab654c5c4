// Which elements are resampled, and why.
#include <lamina/surface.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "surface/corners.hpp"
#include "surface/features.hpp"
#include "surface/notes.hpp"
#include "surface/resample.hpp"

namespace lamina::surface {

namespace {

/// Ice, rather than a section: its corners are too many for samples of a smooth curve.
bool is_jagged(const Element& e) { return e.features.corners.size() > std::max<std::size_t>(8, e.points.size() / 25); }

// ---- smoothing -----------------------------------------------------------------------------------------------------

/// Smooths the runs between corners, which stay where they are.
void smooth(Element& e, double tolerance) {
    const std::vector<Point> given = e.points;
    const std::vector<std::size_t>& corners = e.features.corners;
    const std::vector<SmoothRun> runs = split_at_corners(given, corners);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const std::size_t first = corners.empty() ? 0 : corners[k];
        const std::vector<Point> points = smoothed(runs[k], tolerance).points;
        for (std::size_t i = 0; i < points.size(); ++i) e.points[(first + i) % given.size()] = points[i];
    }
    double moved = 0;
    for (std::size_t i = 0; i < given.size(); ++i) moved = std::max(moved, distance(given[i], e.points[i]));
    e.surface_notes.push_back(fmt::format("smoothed: points moved by up to {:.2g}", moved));
}

// ---- the decision --------------------------------------------------------------------------------------------------

/// How finely an outline is sampled.
struct Sampling {
    double turning_deg = 0;  ///< most, at a vertex that is no corner
    double ratio = 1;        ///< of neighbouring spacings
    double longest = 0;      ///< spacing, as a share of the element's length
};

Sampling sampling_of(const Element& e) {
    Sampling s;
    const std::size_t n = e.points.size();
    const std::vector<double> turning = turnings(e.points);
    std::vector<bool> is_corner(n);
    for (std::size_t c : e.features.corners) is_corner[c] = true;
    for (std::size_t i = 0; i < n; ++i) {
        const double before = distance(e.points[(i + n - 1) % n], e.points[i]),
                     after = distance(e.points[i], e.points[(i + 1) % n]);
        s.ratio = std::max({s.ratio, before / after, after / before});
        s.longest = std::max(s.longest, after);
        if (!is_corner[i]) s.turning_deg = std::max(s.turning_deg, core::degrees(std::abs(turning[i])));
    }
    s.longest /= extent(e.points);
    return s;
}

struct Decision {
    bool resample;
    std::string reason;  ///< "they turn by up to 12.3 degrees"
};

Decision decide(const Element& e, const Resampling& how) {
    // Beyond these, samples of a smooth curve are too coarse for a mesh. The ratio is a user's own choice up to 2.
    constexpr double most_ratio = 2, longest = 0.05;
    constexpr std::size_t dense = 1000;
    const SurfaceOptions& options = how.options;
    if (options.surface == Surface::keep) return {false, "as asked"};
    if (options.points) return {true, fmt::format("about {} points are asked for", *options.points)};
    if (options.surface == Surface::resample) return {true, "as asked"};
    if (e.format == "naca") return {false, "generated points are exact"};
    if (e.points.size() >= dense) return {false, "they are dense"};
    const std::vector<std::size_t>& corners = e.features.corners;
    if (is_jagged(e) || corners.size() + 1 >= e.points.size())
        return {false, fmt::format("{} of them are corners", corners.size())};
    const Sampling s = sampling_of(e);
    if (s.turning_deg > how.max_turning_deg())
        return {true, fmt::format("they turn by up to {:.1f} degrees", s.turning_deg)};
    if (s.longest > longest) return {true, fmt::format("they are up to {:.1f} % of the length apart", 100 * s.longest)};
    if (s.ratio > most_ratio) return {true, fmt::format("neighbouring spacings differ by up to {:.1f}", s.ratio)};
    return {false,
            fmt::format("they turn by at most {:.1f} degrees, and neighbouring spacings differ by at most {:.2f}",
                        s.turning_deg, s.ratio)};
}

// ---- safety --------------------------------------------------------------------------------------------------------

/// Gives the element back its given points and says why. False where it has them already.
bool take_back(Geometry& geometry, std::size_t element, const Geometry& given, const std::string& why) {
    const Element& original = given.elements[element];
    if (geometry.elements[element].points == original.points) return false;
    geometry.elements[element] = original;
    geometry.elements[element].surface_notes.push_back(
        fmt::format("{} points kept as given: {}", original.points.size(), why));
    return true;
}

bool is_simple(const Geometry& geometry) {
    try {
        check_simple(geometry);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Elements whose new outlines cross themselves or each other get their given points back.
void take_back_crossing(Geometry& geometry, const Geometry& given) {
    if (is_simple(geometry)) return;
    const std::size_t n = geometry.elements.size();
    for (std::size_t e = 0; e < n; ++e)
        if (!is_simple({{geometry.elements[e]}})) take_back(geometry, e, given, "its smooth curve would cross itself");
    for (std::size_t e = 0; e < n && !is_simple(geometry); ++e)
        take_back(geometry, e, given, "its smooth curve would cross that of another element");
}

}  // namespace

}  // namespace lamina::surface

namespace lamina {

using namespace surface;

Geometry prepare_surfaces(Geometry given, const SurfaceOptions& options, const SpacingLimits& limits) {
    validate(options);
    for (Element& e : given.elements) e.features.corners = find_corners(e.points);
    if (options.smooth) {
        Geometry smoothed = given;
        for (Element& e : smoothed.elements) smooth(e, *options.smooth);
        take_back_crossing(smoothed, given);
        given = std::move(smoothed);
    } else {
        for (Element& e : given.elements) {
            if (is_jagged(e)) continue;
            note_noise(e);
            note_misplaced(e);
        }
    }

    const Walls walls(given);
    const Resampling how{options, limits, walls};
    Geometry result = given;
    for (std::size_t i = 0; i < given.elements.size(); ++i) {
        Element& element = result.elements[i];
        const Decision decision = decide(element, how);
        if (decision.resample) {
            element = resampled(given.elements[i], i, how, decision.reason);
        } else {
            element.surface_notes.push_back(fmt::format("{} points kept: {}", element.points.size(), decision.reason));
        }
    }
    take_back_crossing(result, given);
    for (Element& e : result.elements) find_trailing_edge(e.points, e.features);
    return result;
}

}  // namespace lamina
