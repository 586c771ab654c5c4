// Further rays between those of a set.
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Rays with further ones between them.
struct DividedRays {
    RaySet set;
    /// One number per ray: BorderDivision::target_factors for the edge of the front from its tip to the following one;
    /// empty where insert_rays() was given none.
    std::vector<double> target_factors;
};

/// Inserts rays on the edges between the origins of neighbouring rays; directions turn evenly. shares: for each ray,
/// how far along the edge to the origin of the following ray the new ones start, ascending, in (0, 1). No rays are
/// inserted where both rays have one origin, nor where an edge is too short to be divided. target_factors: for each ray
/// with shares, the numbers for the ray itself and for the new ones behind it; empty where nobody needs them.
DividedRays insert_rays(const RaySet& set, const std::vector<std::vector<double>>& shares,
                        const std::vector<std::vector<double>>& target_factors = {});

/// Inserts rays between neighbours whose limits allow numbers of layers that differ by more than one, one ray for each
/// layer between. As the numbers of neighbours differ by at most one, coarse walls would without these rays have few
/// layers far from where something is in the way.
RaySet insert_rays_where_counts_change(const RaySet& set, const LayerHeights& heights, std::span<const double> limits);

}  // namespace lamina::layers
