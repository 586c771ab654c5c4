#include "geometry/point_runs.hpp"

#include <algorithm>

namespace lamina::geometry {

namespace {

double run_length(PointSpan points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1].at, points[i].at);
    return sum;
}

/// Returns the distance from the last point to the first.
double end_gap(PointSpan points) { return distance(points.front().at, points.back().at); }

}  // namespace

bool is_loop(PointSpan points) { return points.size() >= 3 && end_gap(points) <= 0.5 * run_length(points); }

bool are_two_surfaces(PointSpan a, PointSpan b) { return are_two_surfaces(a, b, std::max(extent(a), extent(b))); }

bool are_two_surfaces(PointSpan a, PointSpan b, double size) {
    if (a.size() < 2 || b.size() < 2) return false;
    if (end_gap(a) <= 0.5 * size || end_gap(b) <= 0.5 * size) return false;
    const double start_distance = distance(a.front().at, b.front().at),
                 end_distance = distance(a.back().at, b.back().at);
    return std::min(start_distance, end_distance) <= 0.1 * size && std::max(start_distance, end_distance) <= 0.5 * size;
}

bool is_side_of_plate(std::span<const SourcePoint> points) {
    constexpr double min_share = 0.9, max_slope = 0.05;
    const Point closing = points.front().at - points.back().at;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Point edge = points[i].at - points[i - 1].at;
        const double along = -dot(edge, closing);
        if (along > min_share * squared_length(closing) && std::abs(cross(edge, closing)) < max_slope * along)
            return true;
    }
    return false;
}

std::vector<SourcePoint> join_surfaces(PointSpan upper, PointSpan lower) {
    std::vector<SourcePoint> run;
    run.reserve(upper.size() + lower.size());
    run.assign(upper.rbegin(), upper.rend());
    const bool shared = run.back().at == lower.front().at;
    run.insert(run.end(), lower.begin() + (shared ? 1 : 0), lower.end());
    return run;
}

std::optional<std::size_t> find_second_surface(PointSpan points) {
    // The step from the end of the first surface to the start of the second is the longest one.
    std::size_t second = 0;
    double max_step = -1;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double step = distance(points[i - 1].at, points[i].at);
        if (step > max_step) {
            max_step = step;
            second = i;
        }
    }
    if (second < 3 || points.size() - second < 3) return std::nullopt;
    if (!are_two_surfaces(points.first(second), points.subspan(second))) return std::nullopt;
    return second;
}

}  // namespace lamina::geometry
