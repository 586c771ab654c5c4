// Bisection of subdomains until each holds about the target number of triangles.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/connected_ranks.hpp"
#include "decoupling/border_triangulation.hpp"
#include "decoupling/line_border.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/ring_regions.hpp"

namespace lamina::decoupling {

/// The border of a subdomain with its estimated work. Every process holds one of each subdomain, so they are small.
struct EstimatedBorder {
    static constexpr std::uint32_t no_trapezoid = std::numeric_limits<std::uint32_t>::max();

    std::unique_ptr<LineBorder> border{};      ///< null where it is a trapezoid of a ring
    std::unique_ptr<WorkEstimate> estimate{};  ///< where this process has searched it
    std::uint32_t trapezoid = no_trapezoid;    ///< its number
    std::uint32_t process = 0;                 ///< that has searched it
    float work = 0;                            ///< number of triangles, about; all processes know the same
    bool kept = false;                         ///< whether that process makes its piece in any case, if it has not yet
};

/// Makes the piece of a trapezoid that stays whole, which this process has searched. Any thread may call it, while no
/// lines are added.
using MakeTrapezoid =
    std::function<void(std::uint32_t trapezoid, const LineBorder& border, const WorkEstimate& estimate, Lines& lines)>;

/// All regions before they are cut: trapezoids, and others whose borders are given.
struct UncutRegions {
    std::vector<LineBorder> borders;
    RingRegions rings;
};

/// Cuts every subdomain of more than about 1.5 x `pieces_target` triangles in two, and the halves again, along the good
/// separators that search_separator() finds. A subdomain without one stays whole. Holes are joined to the outer loop
/// first. Adds the separators to the lines. The result does not depend on the number of threads.
std::vector<EstimatedBorder> cut_to_size(Lines& lines, UncutRegions regions, const SizeField& size,
                                         double pieces_target);

/// Collective: returns what cut_to_size() returns. The processes divide the search for separators among themselves. The
/// regions round the bodies are cut by the first processes; the others call `make`, if it is given, until this is done,
/// for pieces that they keep. Precondition: all other arguments are the same everywhere.
std::vector<EstimatedBorder> cut_to_size_together(Lines& lines, UncutRegions regions, const SizeField& size,
                                                  double pieces_target, core::ConnectedRanks& ranks,
                                                  const MakeTrapezoid& make);

}  // namespace lamina::decoupling
