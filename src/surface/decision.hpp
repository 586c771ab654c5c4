// The decision what becomes of the given points of an element.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <lamina/geometry.hpp>

#include "surface/resample.hpp"

namespace lamina::surface {

/// The decision on one element: which of its given edges stay as they are, are divided, or give way to a spline.
struct Decision {
    std::vector<EdgeTreatment> edges;  ///< per edge of the outline
    std::vector<std::size_t> ranges;   ///< per edge: number of its range, which lies between two corners or jags
    std::vector<bool> is_smooth;       ///< per range: whether its points are samples of a smooth curve
    std::string reason;                ///< a statement about the points: "they turn by up to 12.3 degrees"

    /// Returns whether all given points are kept, and no others are added.
    bool keeps_all() const;
    /// Replaces a kept edge, beside which others are far shorter: by a spline through its range if that is smooth, else
    /// by its parts.
    void replace_kept(std::size_t edge);
};

/// Returns whether an element has too many corners for samples of a smooth curve. Iced sections have.
/// Precondition: its corners are known (Element::features).
bool is_jagged(const Element& element);

/// Returns whether an element never gets fewer points than it has, unless options ask for it: its shape lies in its
/// points where it is jagged, and thousands of points are a choice. Precondition: its corners are known
/// (Element::features).
bool keeps_number_of_points(const Element& element);

/// Decides for each stretch of the outline of an element, whose number in its geometry is `index`, between two corners.
/// Where nothing else is asked for, the points of an element are kept if all of them are fine: they turn little, they
/// are even, and no edge is far longer than the rules for new points ask for at corners, near walls and under the
/// layer. Otherwise those stretches are replaced that do not obey these rules. Of an element of 1000 even points or
/// more, single edges are replaced. In an element that is jagged a stretch ends also where the outline begins to
/// zigzag. Those that are smooth and coarse are replaced there, edges that are far longer than a neighbour, or than the
/// largest spacing, are divided, and all others are kept. Precondition: the corners of the element are known
/// (Element::features).
Decision decide(const Element& element, std::size_t index, const ResamplingRequest& request);

}  // namespace lamina::surface
