// Folds: places where an outline runs back on itself and forth again, as it does where a point has a wrong digit or two
// points are out of order.
#pragma once

#include <optional>
#include <vector>

#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// A FoldMend says what became of a fold.
enum class FoldMend {
    left_out,   ///< one point was left out
    exchanged,  ///< two neighbours were exchanged
    none,       ///< the fold is still there
};

/// A fold. The outline turns back at one of two points and forth again at the other, where it may cross itself.
///
///     ----------->-----------.  first
///        second .-----<-----'
///                '---->-----------
struct Fold {
    SourcePoint first, second;  ///< where a point was left out, the first is that point
    double share = 0;           ///< length of the part that runs back, as a share of the section's extent
    FoldMend mend = FoldMend::none;
};

/// Mends the first fold of an outline that is narrow, or at most 1 % of its extent long, where its two turning points
/// are neighbours and the outline is smooth without one of them, or with the two exchanged. Where both would do, they
/// are exchanged if that bends the outline little more. The ends of an open outline stay. Returns nothing where no fold
/// can be mended.
std::optional<Fold> mend_fold(std::vector<SourcePoint>& points, bool closed);

/// Returns the folds of an outline that are so narrow that walls are not drawn like that on purpose, in its order.
std::vector<Fold> find_narrow_folds(const std::vector<SourcePoint>& points);

}  // namespace lamina::geometry
