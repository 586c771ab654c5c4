// Smoothing cubic splines.
// Source: C. H. Reinsch, Smoothing by spline functions, Numer. Math. 10 (1967); C. de Boor, A Practical Guide to
// Splines (1978), chapter 14.
#pragma once

#include "surface/smooth_run.hpp"

namespace lamina::surface {

/// Returns the run with every point moved by at most `tolerance`, and the ends of an open run not at all, such that the
/// integral of the squared second derivative is about as small as this allows. The points lie on a smoothing spline
/// whose penalty is as large as most points allow; points that it would move too far are held back by weights, since
/// with one penalty for all the nose reaches the tolerance while the rest stays noisy. Returns the run itself where no
/// such spline is found.
SmoothRun smoothed(const SmoothRun& run, double tolerance);

}  // namespace lamina::surface
