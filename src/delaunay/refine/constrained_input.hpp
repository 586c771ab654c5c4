// The input of the refinement of constrained triangulations, as all its steps see it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/point.hpp>

#include "delaunay/refine/region_sizes.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// A constrained triangulation with the size field of each triangle.
struct ConstrainedInput {
    std::vector<Point> points;  ///< those of the user, then those of the triangulation
    Tris tris;
    std::vector<RegionSizes> sizes;     ///< the general ones, then those of the regions
    std::vector<std::uint32_t> fields;  ///< for each triangle the index of its size field; empty without regions

    std::uint32_t field_of(Index t) const { return fields.empty() ? 0 : fields[t]; }
};

/// Throws OptionError for options out of range; InputError for points as check_points() does, for seeds of regions
/// outside the exact range, and for a triangulation that does not belong to the points.
void check_arguments(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                     const ConstrainedRefineOptions& options);

/// Links the triangles and finds their size fields: 0 is the general one, and r + 1 that of region r, which is used all
/// over the part that holds its seed. The first of several regions counts. The result refers to the size fields.
ConstrainedInput make_constrained_input(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                                        RegionSizes size, std::span<const RegionSize> regions);

}  // namespace lamina::delaunay
