// The panels of the bodies: few points on the outlines, dense where the flow changes fast.
#pragma once

#include <optional>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/point.hpp>

namespace lamina::flow {

/// The outline of an element as ends of panels, counter-clockwise from its trailing edge to its trailing edge.
struct Contour {
    std::vector<Point> nodes;
    bool blunt = false;    ///< whether a base joins the last node to the first one; they are equal otherwise
    bool rounded = false;  ///< whether the outline passes its trailing edge without a sharp corner
    double extent = 0;     ///< longer side of the box round the element
    std::optional<Point> sharp_nose{};  ///< the tip of a sheet opposite of its trailing edge
};

/// How contours are made.
struct ContourOptions {
    double most_panels = 3000;  ///< of all elements together: memory is that of its square, and time of its cube
    bool fair_coves = false;    ///< whether layers pass coves as fair_cove() says
};

/// Returns the contours of all elements. The nodes lie on splines through the given points. Their spacing follows from
/// the curvature, from the distance to corners and to other elements; it does not depend on that of the given points,
/// and zigzags shorter than it do not reduce it. It grows where there would be too many panels. Sheets are thin
/// sections, and those on walls are left out.
std::vector<Contour> make_contours(const Geometry& given, const ContourOptions& options = {});

}  // namespace lamina::flow
