// The boundary that a mesh will have, checked before its pieces are made: what is left to do once they are is to see
// that the mesh has it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/boundary.hpp"

namespace lamina::mesh {

/// The edges of all markers, which should be the boundary.
class ExpectedBoundary {
public:
    /// Checks the markers and the boundary that they describe. `outer` holds those of its edges that others will look
    /// for.
    ExpectedBoundary(std::span<const Point> points, std::span<const Marker> markers, std::vector<Segment> outer);

    /// Returns the edges that others look for.
    const std::vector<Segment>& outer() const { return outer_; }
    /// Returns what check_boundary() finds, if the boundary consists of the outer edges and these, which are sorted.
    /// Returns null if it does not, and where something is wrong with the markers or with the boundary.
    const BoundarySummary* summary_with(std::span<const Segment> others) const;

private:
    std::vector<Segment> outer_, others_;  ///< the others are sorted
    BoundarySummary summary_;
    bool flawless_ = false;
};

}  // namespace lamina::mesh
