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
    ++totals_.cells;
    totals_.min_angle = std::min(totals_.min_angle, shape.min_angle_deg);
    totals_.max_angle = std::max(totals_.max_angle, shape.max_angle_deg);
    totals_.min_angle_sum += shape.min_angle_deg;
    totals_.max_angle_sum += shape.max_angle_deg;
    totals_.mean_ratio_sum += shape.mean_ratio;
    totals_.max_aspect = std::max(totals_.max_aspect, shape.aspect_ratio);
    totals_.below_bound += shape.min_angle_deg < bound_;
    ++totals_.angle_histogram[angle_bin(shape.min_angle_deg)];
}

void QualityCollector::add(const TriangleShapes& shapes, const ShapeTotals& totals) {
    totals_.cells += shapes.size;
    totals_.min_angle = std::min(totals_.min_angle, totals.min_angle_deg);
    totals_.max_angle = std::max(totals_.max_angle, totals.max_angle_deg);
    totals_.min_angle_sum += totals.min_angle_sum;
    totals_.max_angle_sum += totals.max_angle_sum;
    totals_.mean_ratio_sum += totals.mean_ratio_sum;
    totals_.max_aspect = std::max(totals_.max_aspect, totals.max_aspect_ratio);
    for (std::size_t i = 0; i < shapes.size; ++i) ++totals_.angle_histogram[angle_bin(shapes.min_angle_deg[i])];
    if (totals.min_angle_deg < bound_)
        totals_.below_bound += static_cast<std::size_t>(std::count_if(
            shapes.min_angle_deg, shapes.min_angle_deg + shapes.size, [&](double angle) { return angle < bound_; }));
}

void QualityCollector::add_area_ratios(std::span<const double> ratios) {
    if (ratios.empty()) return;
    if (area_ratios_.empty()) area_ratios_.assign(ratio_bins, 0);
    for (const double ratio : ratios) {
        totals_.max_area_ratio = std::max(totals_.max_area_ratio, ratio);
        ++area_ratios_[bin_of(static_cast<float>(ratio))];
    }
}

void QualityCollector::add_neighbours(double area, double other_area) {
    const double ratio = std::max(area, other_area) / std::min(area, other_area);
    add_area_ratios({&ratio, 1});
}

void QualityCollector::add_to_largest_ratio(double area, double other_area, Point a, Point b) {
    const double smaller = std::min(area, other_area), larger = std::max(area, other_area);
    if (smaller > 0 && larger >= totals_.max_area_ratio * smaller)
        raise_largest_ratio(larger / smaller, midpoint(a, b));
}

/// Of equal ratios, as on both sides of a symmetric body, the lexicographically first place stays: the order in which
/// threads come does not matter.
void QualityCollector::raise_largest_ratio(double ratio, Point at) {
    if (ratio < totals_.max_area_ratio) return;
    if (ratio == totals_.max_area_ratio && !lexicographically_less(at, totals_.max_area_ratio_at)) return;
    totals_.max_area_ratio = ratio;
    totals_.max_area_ratio_at = at;
}

void QualityCollector::add_even_neighbours(std::size_t pairs) {
    if (pairs == 0) return;
    if (area_ratios_.empty()) area_ratios_.assign(ratio_bins, 0);
    area_ratios_.front() += static_cast<std::uint32_t>(pairs);
}

void QualityCollector::append(const QualityCollector& part) {
    append(part.totals_);
    append_area_ratios(part.area_ratios_);
}

void QualityCollector::append(const QualityTotals& part) {
    totals_.cells += part.cells;
    totals_.below_bound += part.below_bound;
    totals_.min_angle = std::min(totals_.min_angle, part.min_angle);
    totals_.max_angle = std::max(totals_.max_angle, part.max_angle);
    totals_.min_angle_sum += part.min_angle_sum;
    totals_.max_angle_sum += part.max_angle_sum;
    totals_.mean_ratio_sum += part.mean_ratio_sum;
    totals_.max_aspect = std::max(totals_.max_aspect, part.max_aspect);
    raise_largest_ratio(part.max_area_ratio, part.max_area_ratio_at);
    for (std::size_t i = 0; i < part.angle_histogram.size(); ++i) totals_.angle_histogram[i] += part.angle_histogram[i];
}

void QualityCollector::append_area_ratios(std::span<const std::uint32_t> counts) {
    if (counts.empty()) return;
    if (area_ratios_.empty()) area_ratios_.assign(ratio_bins, 0);
    for (std::size_t i = 0; i < std::min(counts.size(), ratio_bins); ++i) area_ratios_[i] += counts[i];
}

double QualityCollector::area_ratio_exceeded_by(double share) const {
    const auto n = std::accumulate(area_ratios_.begin(), area_ratios_.end(), std::size_t{0});
    std::size_t above = 0;
    for (std::size_t bin = area_ratios_.size(); bin-- > 0;) {
        above += area_ratios_[bin];
        if (static_cast<double>(above) >= share * static_cast<double>(n)) return bin > 0 ? upper_end_of(bin - 1) : 1.0;
    }
    return 1;
}

double QualityCollector::area_ratio_percentile_999() const {
    const std::size_t n = std::accumulate(area_ratios_.begin(), area_ratios_.end(), std::size_t{0});
    if (n == 0) return 0;
    const std::size_t rank = (n - 1) - (n - 1) / 1000;
    std::size_t bin = 0;
    for (std::size_t count_below = area_ratios_[0]; count_below <= rank; count_below += area_ratios_[bin]) ++bin;
    return bin + 1 < ratio_bins ? std::min(upper_end_of(bin), totals_.max_area_ratio) : totals_.max_area_ratio;
}

QualitySummary QualityCollector::summary() const {
    QualitySummary summary;
    if (totals_.cells == 0) return summary;
    summary.cells = totals_.cells;
    summary.min_angle_deg = totals_.min_angle;
    summary.max_angle_deg = totals_.max_angle;
    summary.mean_min_angle_deg = totals_.min_angle_sum / static_cast<double>(totals_.cells);
    summary.mean_max_angle_deg = totals_.max_angle_sum / static_cast<double>(totals_.cells);
    summary.mean_ratio = totals_.mean_ratio_sum / static_cast<double>(totals_.cells);
    summary.angles_below_bound = totals_.below_bound;
    summary.max_aspect_ratio = totals_.max_aspect;
    summary.angle_histogram = totals_.angle_histogram;
    const auto below_40 =
        std::accumulate(totals_.angle_histogram.begin(), totals_.angle_histogram.begin() + 8, std::size_t{0});
    summary.share_below_40_deg = static_cast<double>(below_40) / static_cast<double>(totals_.cells);
    summary.max_neighbour_area_ratio = totals_.max_area_ratio;
    summary.max_neighbour_area_ratio_at = totals_.max_area_ratio_at;
    summary.p999_neighbour_area_ratio = area_ratio_percentile_999();
    return summary;
}

}  // namespace lamina::mesh
