// New points on a smooth curve through the given ones.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <lamina/surface.hpp>

#include "surface/clearance.hpp"
#include "surface/curved_edge.hpp"
#include "surface/spacing.hpp"
#include "surface/spacing_limits.hpp"

namespace lamina::surface {

/// Returns the length of an element: the longer side of the tightest box round its outline, which turns with it.
double extent(std::span<const Point> outline);

/// Returns the exact numbers of edges that the options ask for on the sides of an element, or null.
const SideEdges* side_edges_of(const SurfaceOptions& options, const Element& element);

/// The requests that the new points of all elements have to meet.
struct ResamplingRequest {
    const SurfaceOptions& options;
    const SpacingLimits& limits;
    const ClearanceSearch& walls;

    /// Returns the largest turning at a vertex between two corners, in degrees.
    double max_turning_deg() const;
    /// Returns the largest spacing at a corner that turns by this angle, in radians, of an element with this number and
    /// extent. One that the element brings along sets none where it turns no more than other vertices may.
    double corner_spacing(std::size_t element, double turning, double extent, bool is_given) const;
};

/// The three ways to treat an edge between two neighbouring given points of an outline.
enum class EdgeTreatment {
    keep,    ///< it stays one edge
    divide,  ///< it stays straight and is divided
    spline,  ///< a spline between the two points takes its place, and is divided
};

/// Given edges that follow each other round an outline.
struct GivenEdges {
    std::size_t first, count;
};

/// Returns, per given edge, the integral of ds / spacing along it: how many edges, a real number, the rules for new
/// points put in its place. Arguments as for resample().
std::vector<double> edges_asked_for(const Element& given, std::size_t index, const ResamplingRequest& request);

/// Returns the spline through the points of an outline between corners, edge by edge. Precondition: the corners of the
/// outline are known (Element::features).
std::vector<CurvedEdge> interpolated_edges(const Element& element);

/// An element with new points.
struct ResampledElement {
    Element element;
    std::vector<GivenEdges> origins;  ///< per new edge: the given ones whose place it takes
    std::vector<CurvedEdge> curves;   ///< of the edges, unless SpacingLimits::with_curves is false
};

/// Returns the element, whose number in its geometry is `index`, with new points, and adds a note that quotes `reason`.
/// `treatment` holds what becomes of each given edge, and `known` the curves of earlier calls for the same element and
/// request.
/// Precondition: the corners of its outline are known (Element::features).
ResampledElement resample(const Element& given, std::size_t index, const ResamplingRequest& request,
                          std::span<const EdgeTreatment> treatment, const std::string& reason, SampledCurves& known);

}  // namespace lamina::surface
