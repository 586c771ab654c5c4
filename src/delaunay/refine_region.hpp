// Delaunay refinement of a region, vertex by vertex; refine() adds lattices where they pay.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/delaunay.hpp>

namespace lamina::delaunay {

/// Refines the region on the left of the segments as refine() does, but ignores RefineOptions::lattice.
/// Precondition: options in range.
Refinement refine_region(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                         const RefineOptions& options);

}  // namespace lamina::delaunay
