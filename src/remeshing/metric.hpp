// Metric tensors: sizes, lengths and shapes.
#pragma once

#include <cmath>

#include <lamina/metric.hpp>
#include <lamina/point.hpp>

namespace lamina::remeshing {

/// Returns a . M b.
inline double product(const MetricTensor& m, Point a, Point b) {
    return a.x * (m.xx * b.x + m.xy * b.y) + a.y * (m.xy * b.x + m.yy * b.y);
}
inline double determinant(const MetricTensor& m) { return m.xx * m.yy - m.xy * m.xy; }
inline MetricTensor operator+(const MetricTensor& a, const MetricTensor& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
}
inline MetricTensor operator*(double s, const MetricTensor& m) { return {s * m.xx, s * m.xy, s * m.yy}; }

/// The eigenvalues of a tensor, the larger one first, and what of the tensor has no trace: M = mean I + [d, e; e, -d].
struct Spectrum {
    double large, small;
    double d, e, radius;  ///< radius is the length of (d, e)
};
inline Spectrum spectrum(const MetricTensor& m) {
    const double mean = 0.5 * (m.xx + m.yy), d = 0.5 * (m.xx - m.yy);
    const double radius = std::sqrt(d * d + m.xy * m.xy);
    const double large = mean + radius;
    // The difference of mean and radius would lose the digits of the smaller one.
    return {large, determinant(m) / large, d, m.xy, radius};
}
/// Returns the tensor with the same eigenvectors and other eigenvalues.
inline MetricTensor with_eigenvalues(const Spectrum& s, double large, double small) {
    const double mean = 0.5 * (large + small);
    const double slope = s.radius > 0 ? 0.5 * (large - small) / s.radius : 0.0;
    return {mean + slope * s.d, slope * s.e, mean - slope * s.d};
}

/// Returns whether a tensor is finite and positive definite, in numbers of doubles.
bool is_metric(const MetricTensor& m);
/// Returns M^(-1).
inline MetricTensor inverse(const MetricTensor& m) {
    const double scale = 1 / determinant(m);
    return {scale * m.yy, -scale * m.xy, scale * m.xx};
}
/// Returns M^(-1/2), the tensor of the lengths that a metric asks for: its eigenvalues. Source for the root of a matrix
/// of order 2: B. W. Levinger, Mathematics Magazine 53 (1980).
inline MetricTensor sizes_of(const MetricTensor& m) {
    const double root = std::sqrt(determinant(m));
    const double scale = 1 / (root * std::sqrt(m.xx + m.yy + 2 * root));
    return {scale * (m.yy + root), -scale * m.xy, scale * (m.xx + root)};
}
/// Returns H^(-2), the metric that asks for the lengths of a tensor.
inline MetricTensor metric_of(const MetricTensor& h) {
    const double off = h.xy * (h.xx + h.yy), root = determinant(h);
    const double scale = 1 / (root * root);
    return {scale * (h.yy * h.yy + h.xy * h.xy), -scale * off, scale * (h.xx * h.xx + h.xy * h.xy)};
}
/// Returns a metric in which every vector is at least as long as in each of two, and no longer than it must be: the two
/// become diagonal in one basis, and the larger of each two entries counts. Source: Alauzet 2010, section 3.
MetricTensor intersection(const MetricTensor& a, const MetricTensor& b);

/// Returns the length of an edge with the squared lengths p and q in the metrics of its ends, where the size h along it
/// is linear: sqrt(p q) over the logarithmic mean of sqrt(p) and sqrt(q), by Simpson's rule for that mean. The result
/// is 0.8 % too small where the lengths differ by a factor of 10. Source: Alauzet 2010, section 2.
inline double length_between(double p, double q) {
    const double a = std::sqrt(p), b = std::sqrt(q), product = a * b;
    return 6 * product / (a + b + 4 * std::sqrt(product));
}

/// The distortion of a triangle in a metric that may have any scale: the square of (sum of squared edges) / (4 sqrt(3)
/// area), which is 1 if it is equilateral in the metric. It is infinite where the triangle is flat and negative where
/// it is clockwise, up to rounding. Source: T. Munson, Mathematical Programming 110 (2007), inverse mean ratio.
inline double triangle_distortion(Point a, Point b, Point c, const MetricTensor& m) {
    const Point ab = b - a, ac = c - a;
    const double twice_area = cross(ab, ac);
    const double edges = product(m, ab, ab) + product(m, ac, ac) - product(m, ab, ac);  // half the sum of the squares
    return edges * edges / (3 * twice_area * std::abs(twice_area) * determinant(m));
}

}  // namespace lamina::remeshing
