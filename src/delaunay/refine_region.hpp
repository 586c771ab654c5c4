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

/// Throws MeshError for a region that needs more Steiner points than this.
[[noreturn]] void fail_too_many_points(std::size_t max_points);

}  // namespace lamina::delaunay
