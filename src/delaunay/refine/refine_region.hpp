// Delaunay refinement of a region, vertex by vertex; refine() adds lattices where they pay.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/delaunay.hpp>
#include <lamina/export.hpp>

#include "core/edge_links.hpp"

namespace lamina::delaunay {

/// Refines the region on the left of the segments as refine() does, but ignores RefineOptions::lattice. Precondition:
/// options in range. Points from `fixed_points` on lie inside the region. They are the first Steiner points of the
/// result: refinement takes them as they are, and smoothing may move those on no segment. Stores the neighbours of the
/// triangles in `links`, unless that is null.
Refinement refine_region(std::span<const Point> points, std::size_t fixed_points, std::span<const Segment> segments,
                         const SizeField& size, const RefineOptions& options, core::EdgeLinks* links = nullptr);

/// A refined region with the neighbours of its triangles, which refinement knows anyway.
struct LinkedRefinement {
    Refinement refinement;
    core::EdgeLinks links;  ///< no_link on the border
};

/// Returns what refine() returns, with links.
LAMINA_EXPORT LinkedRefinement refine_linked(std::span<const Point> points, std::span<const Segment> segments,
                                             const SizeField& size, const RefineOptions& options);

}  // namespace lamina::delaunay
