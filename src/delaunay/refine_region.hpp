// Delaunay refinement of a region, vertex by vertex; refine() adds lattices where they pay.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/delaunay.hpp>
#include <lamina/export.hpp>

#include "core/edge_links.hpp"

namespace lamina::delaunay {

/// Refines the region on the left of the segments as refine() does, but ignores RefineOptions::lattice.
/// Precondition: options in range.
/// Stores the neighbours of the triangles in `links`, unless that is null.
Refinement refine_region(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                         const RefineOptions& options, core::EdgeLinks* links = nullptr);

/// A refined region with the neighbours of its triangles, which refinement knows anyway.
struct LinkedRefinement {
    Refinement refinement;
    core::EdgeLinks links;  ///< no_link on the border
};

/// Returns what refine() returns, with links.
LAMINA_EXPORT LinkedRefinement refine_linked(std::span<const Point> points, std::span<const Segment> segments,
                                             const SizeField& size, const RefineOptions& options);

}  // namespace lamina::delaunay
