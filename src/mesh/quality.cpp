#include "mesh/quality.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

namespace lamina::mesh {

namespace {

// The bin of an area ratio is given by the leading bits of the float: 512 bins per factor of 2, up to a ratio of 256.
constexpr unsigned bin_shift = 14;
constexpr std::uint32_t bits_of_one = std::bit_cast<std::uint32_t>(1.0f);
constexpr std::size_t ratio_bins = std::size_t{8} * 512;

std::size_t bin_of(float ratio) {
    return std::min<std::size_t>((std::bit_cast<std::uint32_t>(ratio) - bits_of_one) >> bin_shift, ratio_bins - 1);
}

double upper_end_of(std::size_t bin) {
    return std::bit_cast<float>(bits_of_one + ((static_cast<std::uint32_t>(bin) + 1) << bin_shift));
}

/// Returns the bin of an angle in QualitySummary::angle_histogram.
std::size_t angle_bin(double min_angle_deg) {
    constexpr std::size_t last = std::tuple_size_v<decltype(QualitySummary::angle_histogram)> - 1;
    return std::min(last, static_cast<std::size_t>(min_angle_deg / 5));
}

}  // namespace

CellShape measure_quad(Point a, Point b, Point c, Point d) {
    const double twice_area = cross(c - a, d - b);
    if (!(twice_area > 0)) return core::flat_shape;
    const Point corner[4] = {a, b, c, d};
    CellShape shape{.area = 0.5 * twice_area, .min_angle_deg = 360};
    for (int i = 0; i < 4; ++i) {
        const Point ahead = corner[(i + 1) % 4] - corner[i], back = corner[(i + 3) % 4] - corner[i];
        double angle = core::degrees(core::atan2_reproducible(cross(ahead, back), dot(ahead, back)));
        if (angle < 0) angle += 360;
        shape.min_angle_deg = std::min(shape.min_angle_deg, angle);
        shape.max_angle_deg = std::max(shape.max_angle_deg, angle);
        shape.aspect_ratio = std::max(shape.aspect_ratio, squared_length(ahead) / shape.area);
    }
    shape.mean_ratio = shape_of_quad(a, b, c, d);
    return shape;
}

double shape_of_triangle(Point a, Point b, Point c) {
    const double squares = squared_length(b - a) + squared_length(c - b) + squared_length(a - c);
    return squares > 0 ? std::max(0.0, core::mean_ratio(cross(b - a, c - a), squares)) : 0.0;
}

double shape_of_quad(Point a, Point b, Point c, Point d) {
    const Point corner[4] = {a, b, c, d};
    double worst = 1;
    for (int i = 0; i < 4; ++i) {
        const Point ahead = corner[(i + 1) % 4] - corner[i], back = corner[(i + 3) % 4] - corner[i];
        const double squares = squared_length(ahead) + squared_length(back);
        worst = std::min(worst, squares > 0 ? 2 * cross(ahead, back) / squares : 0.0);
    }
    return std::max(0.0, worst);
}

void QualityCollector::add(const CellShape& shape) {
    ++cells_;
    min_angle_ = std::min(min_angle_, shape.min_angle_deg);
    max_angle_ = std::max(max_angle_, shape.max_angle_deg);
    min_angle_sum_ += shape.min_angle_deg;
    max_angle_sum_ += shape.max_angle_deg;
    mean_ratio_sum_ += shape.mean_ratio;
    max_aspect_ = std::max(max_aspect_, shape.aspect_ratio);
    below_bound_ += shape.min_angle_deg < bound_;
    ++angle_histogram_[angle_bin(shape.min_angle_deg)];
}

void QualityCollector::add(const TriangleShapes& shapes, const ShapeTotals& totals) {
    cells_ += shapes.size;
    min_angle_ = std::min(min_angle_, totals.min_angle_deg);
    max_angle_ = std::max(max_angle_, totals.max_angle_deg);
    min_angle_sum_ += totals.min_angle_sum;
    max_angle_sum_ += totals.max_angle_sum;
    mean_ratio_sum_ += totals.mean_ratio_sum;
    max_aspect_ = std::max(max_aspect_, totals.max_aspect_ratio);
    for (std::size_t i = 0; i < shapes.size; ++i) ++angle_histogram_[angle_bin(shapes.min_angle_deg[i])];
    if (totals.min_angle_deg < bound_)
        below_bound_ += static_cast<std::size_t>(std::count_if(shapes.min_angle_deg, shapes.min_angle_deg + shapes.size,
                                                               [&](double angle) { return angle < bound_; }));
}

void QualityCollector::add_area_ratios(std::span<const double> ratios) {
    if (ratios.empty()) return;
    if (area_ratios_.empty()) area_ratios_.assign(ratio_bins, 0);
    for (const double ratio : ratios) {
        max_area_ratio_ = std::max(max_area_ratio_, ratio);
        ++area_ratios_[bin_of(static_cast<float>(ratio))];
    }
}

void QualityCollector::add_neighbours(double area, double other_area) {
    const double ratio = std::max(area, other_area) / std::min(area, other_area);
    add_area_ratios({&ratio, 1});
}

void QualityCollector::append(const QualityCollector& part) {
    cells_ += part.cells_;
    below_bound_ += part.below_bound_;
    min_angle_ = std::min(min_angle_, part.min_angle_);
    max_angle_ = std::max(max_angle_, part.max_angle_);
    min_angle_sum_ += part.min_angle_sum_;
    max_angle_sum_ += part.max_angle_sum_;
    mean_ratio_sum_ += part.mean_ratio_sum_;
    max_aspect_ = std::max(max_aspect_, part.max_aspect_);
    for (std::size_t i = 0; i < angle_histogram_.size(); ++i) angle_histogram_[i] += part.angle_histogram_[i];
    max_area_ratio_ = std::max(max_area_ratio_, part.max_area_ratio_);
    if (area_ratios_.empty()) area_ratios_.assign(part.area_ratios_.size(), 0);
    for (std::size_t i = 0; i < part.area_ratios_.size(); ++i) area_ratios_[i] += part.area_ratios_[i];
}

double QualityCollector::area_ratio_percentile_999() const {
    const std::size_t n = std::accumulate(area_ratios_.begin(), area_ratios_.end(), std::size_t{0});
    if (n == 0) return 0;
    const std::size_t rank = (n - 1) - (n - 1) / 1000;
    std::size_t bin = 0;
    for (std::size_t count_below = area_ratios_[0]; count_below <= rank; count_below += area_ratios_[bin]) ++bin;
    return bin + 1 < ratio_bins ? std::min(upper_end_of(bin), max_area_ratio_) : max_area_ratio_;
}

QualitySummary QualityCollector::summary() const {
    QualitySummary summary;
    if (cells_ == 0) return summary;
    summary.cells = cells_;
    summary.min_angle_deg = min_angle_;
    summary.max_angle_deg = max_angle_;
    summary.mean_min_angle_deg = min_angle_sum_ / static_cast<double>(cells_);
    summary.mean_max_angle_deg = max_angle_sum_ / static_cast<double>(cells_);
    summary.mean_ratio = mean_ratio_sum_ / static_cast<double>(cells_);
    summary.angles_below_bound = below_bound_;
    summary.max_aspect_ratio = max_aspect_;
    summary.angle_histogram = angle_histogram_;
    const auto below_40 = std::accumulate(angle_histogram_.begin(), angle_histogram_.begin() + 8, std::size_t{0});
    summary.share_below_40_deg = static_cast<double>(below_40) / static_cast<double>(cells_);
    summary.max_neighbour_area_ratio = max_area_ratio_;
    summary.p999_neighbour_area_ratio = area_ratio_percentile_999();
    return summary;
}

}  // namespace lamina::mesh
