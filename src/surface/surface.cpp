// The stage "prepare": the decision which elements are resampled, and the safety net behind it.
#include <lamina/surface.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "surface/clearance.hpp"
#include "surface/corners.hpp"
#include "surface/notes.hpp"
#include "surface/resample.hpp"
#include "surface/smooth_run.hpp"
#include "surface/smoothing_spline.hpp"
#include "surface/trailing_edge.hpp"

namespace lamina::surface {

namespace {

/// Returns whether an element has too many corners for samples of a smooth curve. Iced sections have.
bool is_jagged(const Element& e) { return e.features.corners.size() > std::max<std::size_t>(8, e.points.size() / 25); }

// ---- smoothing -----------------------------------------------------------------------------------------------------

/// Smooths the runs between corners. The corners stay where they are.
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
    double max_turning_deg = 0;  ///< at vertices that are no corners
    double max_ratio = 1;        ///< of neighbouring spacings
    double max_spacing = 0;      ///< as a share of the element's length
};

Sampling measure_sampling(const Element& e) {
    Sampling s;
    const std::size_t n = e.points.size();
    const std::vector<double> turning = turning_angles(e.points);
    std::vector<bool> is_corner(n);
    for (std::size_t c : e.features.corners) is_corner[c] = true;
    for (std::size_t i = 0; i < n; ++i) {
        const double before = distance(e.points[(i + n - 1) % n], e.points[i]),
                     after = distance(e.points[i], e.points[(i + 1) % n]);
        s.max_ratio = std::max({s.max_ratio, before / after, after / before});
        s.max_spacing = std::max(s.max_spacing, after);
        if (!is_corner[i]) s.max_turning_deg = std::max(s.max_turning_deg, core::degrees(std::abs(turning[i])));
    }
    s.max_spacing /= extent(e.points);
    return s;
}

struct Decision {
    bool resample;
    std::string reason;  ///< a statement about the points: "they turn by up to 12.3 degrees"
};

Decision decide(const Element& e, const ResamplingRequest& request) {
    // Beyond these bounds, samples of a smooth curve are too coarse for a mesh. Ratios up to 2 may be a user's choice.
    constexpr double max_ratio = 2, max_spacing = 0.05;
    constexpr std::size_t min_dense_points = 1000;
    const SurfaceOptions& options = request.options;
    if (options.treatment == SurfaceTreatment::keep) return {false, "as requested"};
    if (options.points) return {true, fmt::format("about {} points are requested", *options.points)};
    if (options.treatment == SurfaceTreatment::resample) return {true, "as requested"};
    if (e.samples_of_curve) return {true, "its formula is known"};
    if (e.format == "naca") return {false, "generated points are exact"};
    if (e.points.size() >= min_dense_points) return {false, "they are dense"};
    const std::vector<std::size_t>& corners = e.features.corners;
    if (corners.size() == e.points.size()) return {true, "they are the corners of a polygon"};
    if (is_jagged(e)) return {false, fmt::format("{} of them are corners", corners.size())};
    const Sampling s = measure_sampling(e);
    if (s.max_turning_deg > request.max_turning_deg())
        return {true, fmt::format("they turn by up to {:.1f} degrees", s.max_turning_deg)};
    if (s.max_spacing > max_spacing)
        return {true, fmt::format("they are up to {:.1f} % of the length apart", 100 * s.max_spacing)};
    if (s.max_ratio > max_ratio)
        return {true, fmt::format("neighbouring spacings differ by up to {:.1f}", s.max_ratio)};
    return {false,
            fmt::format("they turn by at most {:.1f} degrees, and neighbouring spacings differ by at most {:.2f}",
                        s.max_turning_deg, s.max_ratio)};
}

// ---- safety --------------------------------------------------------------------------------------------------------

/// Gives an element back its given points, unless it has them already, and adds a note with the reason.
void restore(Geometry& geometry, std::size_t element, const Geometry& given, const std::string& reason) {
    const Element& original = given.elements[element];
    if (geometry.elements[element].points == original.points) return;
    geometry.elements[element] = original;
    geometry.elements[element].surface_restored = true;
    geometry.elements[element].surface_notes.push_back(
        fmt::format("{} points kept as given: {}", original.points.size(), reason));
}

bool is_simple(const Geometry& geometry) {
    try {
        check_simple(geometry);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Restores the given points of elements whose new outlines cross themselves or each other.
void restore_crossing(Geometry& geometry, const Geometry& given) {
    if (is_simple(geometry)) return;
    const std::size_t n = geometry.elements.size();
    for (std::size_t e = 0; e < n; ++e)
        if (!is_simple({{geometry.elements[e]}})) restore(geometry, e, given, "its smooth curve would cross itself");
    for (std::size_t e = 0; e < n && !is_simple(geometry); ++e)
        restore(geometry, e, given, "its smooth curve would cross that of another element");
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
        restore_crossing(smoothed, given);
        given = std::move(smoothed);
    } else {
        for (Element& e : given.elements) {
            if (is_jagged(e)) continue;
            add_noise_note(e);
            add_misplaced_point_notes(e);
        }
    }

    const ClearanceSearch walls(given);
    const ResamplingRequest request{options, limits, walls};
    Geometry result = given;
    for (std::size_t i = 0; i < given.elements.size(); ++i) {
        Element& element = result.elements[i];
        const Decision decision = decide(element, request);
        if (decision.resample) {
            element = resample(given.elements[i], i, request, decision.reason);
        } else {
            element.surface_notes.push_back(fmt::format("{} points kept: {}", element.points.size(), decision.reason));
        }
    }
    restore_crossing(result, given);
    for (Element& e : result.elements) find_trailing_edge(e.points, e.features);
    return result;
}

}  // namespace lamina
