// The plane of a drawing: outlines lie in a plane of two axes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/drawings/drawing.hpp"

namespace lamina::geometry {

/// A curve of the plane of the outlines.
struct FlatCurve {
    PlaneCurve curve;
    std::uint32_t line = 0;
    std::string layer;
};

/// Returns the curves of a drawing that lie in one plane: z = C, then y = C, whose coordinates are x and z, or x = C with
/// y and z. Where curves lie in several planes, as those of both ends of a wing do, the plane with the longest outline
/// counts, and of equal ones that of the least C. Adds notes on the plane and on curves off it. Throws InputError where no
/// curve lies in such a plane.
std::vector<FlatCurve> in_plane(Drawing drawing, const std::string& file, std::vector<std::string>& notes);

}  // namespace lamina::geometry
