#include "remeshing/metric.hpp"

namespace lamina::remeshing {

bool is_metric(const MetricTensor& m) {
    if (!(std::isfinite(m.xx) && std::isfinite(m.xy) && std::isfinite(m.yy) && m.xx > 0 && m.yy > 0)) return false;
    // Products of entries must neither overflow nor underflow: lengths from 1e-60 to 1e60 have such eigenvalues.
    constexpr double least = 1e-120, most = 1e120;
    const Spectrum s = spectrum(m);
    return s.small >= least && s.large <= most;
}

MetricTensor intersection(const MetricTensor& a, const MetricTensor& b) {
    // With a = L L^T, the metric b becomes C = L^-1 b L^-T, whose eigenvectors are the common basis; a becomes the
    // identity.
    const double l11 = std::sqrt(a.xx), l21 = a.xy / l11, l22 = std::sqrt(determinant(a)) / l11;
    const double i11 = 1 / l11, i22 = 1 / l22, i21 = -l21 * i11 * i22;
    const double c11 = i11 * i11 * b.xx;
    const double c12 = i11 * (i21 * b.xx + i22 * b.xy);
    const double c22 = i21 * (i21 * b.xx + i22 * b.xy) + i22 * (i21 * b.xy + i22 * b.yy);
    const Spectrum s = spectrum({c11, c12, c22});
    if (s.small >= 1) return b;
    if (s.large <= 1) return a;
    const MetricTensor c = with_eigenvalues(s, s.large, 1);
    // L C L^T
    const double t11 = l11 * c.xx, t12 = l11 * c.xy, t21 = l21 * c.xx + l22 * c.xy, t22 = l21 * c.xy + l22 * c.yy;
    return {t11 * l11, t11 * l21 + t12 * l22, t21 * l21 + t22 * l22};
}

}  // namespace lamina::remeshing
