// Points that scatter about an outline, as those of a scan do.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::geometry {

/// Points in the order of an outline. A ring goes on from its last point to its first one.
struct PointSequence {
    std::vector<Point> points;
    bool is_ring = false;
};

/// Returns the standard deviation, per coordinate, of white noise in the points: each stands off a curve by a random
/// length of its own. Empty where the points are too few to be certain of it, where their roughness may belong to the
/// shape, or where the noise turns the outline by less than a flow solver overlooks.
///
/// The estimate is the median absolute fourth difference across the outline. Noise is white if differences at two and
/// three times the distance give the same estimate, since shapes grow with the distance, and if the signs of second
/// differences are correlated as those of white noise: by -0.46 and 0.11 at one and two places apart, and not at all
/// beyond.
/// Source: J. Rice, Bandwidth choice for nonparametric regression, Ann. Statist. 12 (1984) (differences); G. E. P. Box,
/// D. A. Pierce, J. Amer. Statist. Assoc. 65 (1970) (whiteness); N. Blomqvist, Ann. Math. Statist. 21 (1950) (signs).
std::optional<double> white_noise(const PointSequence& sequence);

/// Returns the indices, ascending, of points at which the outline has a corner in spite of white noise of this standard
/// deviation: straight lines fitted to points on both sides differ by more than 10 degrees, by more than noise
/// explains, and by far more than those beside them, as at a corner and not at a round nose. The more a corner turns,
/// the fewer points it takes.
/// Source: H.-G. Mueller, Change-points in nonparametric regression analysis, Ann. Statist. 20 (1992).
std::vector<std::size_t> find_corners_above_noise(const PointSequence& sequence, double noise);

/// Returns the points on smoothing splines between those corners. The penalty is as large as it can be while what the
/// points move by stays noise: it has no mean, over any 11 or 41 points in a row, that noise does not explain. Source:
/// C. H. Reinsch, Smoothing by spline functions, Numer. Math. 10 (1967), whose bound is on the sum of squares.
std::vector<Point> without_noise(const PointSequence& sequence, std::span<const std::size_t> corners, double noise);

}  // namespace lamina::geometry
