#include "support/triangulation_families.hpp"

#include <cmath>

namespace lamina::test {

namespace {

/// Appends `count` points at distances 0, step, step (1 + growth), ... from `foot`.
void add_ray(std::vector<Point>& points, Point foot, Point direction, std::size_t count, double step, double growth) {
    double height = 0;
    for (std::size_t i = 0; i < count; ++i, step *= growth) {
        points.push_back(foot + height * direction);
        height += step;
    }
}

}  // namespace

std::vector<Point> naca_layer_points(std::size_t n) {
    constexpr std::size_t points_on_ray = 50;
    const std::size_t rays = n / points_on_ray;
    std::vector<Point> points;
    for (std::size_t i = 0; i < rays; ++i) {
        // The angles are half a step off, so that no ray starts at the leading or the trailing edge.
        const double angle = 2 * M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(rays);
        const double x = 0.5 * (1 + std::cos(angle)), side = angle < M_PI ? 1 : -1;
        const double y = 0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1015 * x))));
        const double slope = 0.6 * (0.14845 / std::sqrt(x) - 0.1260 + x * (-0.7032 + x * (0.8529 - 0.4060 * x)));
        add_ray(points, {x, side * y}, unit({-slope, side}), points_on_ray, 1e-5, 1.15);
    }
    return points;
}

std::vector<Point> points_on_two_lines(std::size_t n, double slope) {
    Random random(4);
    std::vector<Point> points(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = random.real();
        points[i] = {x, slope * x + static_cast<double>(i % 2)};
    }
    return points;
}

std::vector<Point> points_on_a_cross(std::size_t n) {
    Random random(4);
    std::vector<Point> points(n);
    for (std::size_t i = 0; i < n; ++i) (i % 2 == 0 ? points[i].x : points[i].y) = random.real(-1, 1);
    return points;
}

std::vector<Point> flat_plate_points(std::size_t n, double cosine, double sine) {
    constexpr std::size_t points_in_column = 100;
    const std::size_t columns = n / points_in_column;
    std::vector<Point> points;
    for (std::size_t i = 0; i < columns; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(columns);
        add_ray(points, {cosine * x, sine * x}, {-sine, cosine}, points_in_column, 1e-6, 1.08);
    }
    return points;
}

RefinementCase unit_square_case(double triangles, double area_ratio) {
    // The mean area of triangles is about 0.62 of the largest allowed, so a uniform h makes 1 / (0.62 sqrt(3)/4 h^2) of
    // them. A linear h from h0 to h1 makes as many as a uniform h of sqrt(h0 h1).
    const double mean = std::sqrt(1 / (0.62 * equilateral_area * triangles));
    const double ratio = std::sqrt(area_ratio);
    RefinementCase c;
    c.size = mean / std::sqrt(ratio);
    c.gradation = c.size * (ratio - 1);

    constexpr double share = 0.8;
    const auto side = [&](double h) { return static_cast<std::size_t>(std::ceil(1 / (share * h))); };
    const std::size_t at_left = side(c.size), at_right = side(c.size * ratio);
    const std::size_t at_bottom_and_top =
        ratio == 1 ? at_left : static_cast<std::size_t>(std::ceil(std::log(ratio) / (share * c.gradation)));
    const auto x_at = [&](std::size_t i) {
        const double t = static_cast<double>(i) / static_cast<double>(at_bottom_and_top);
        return ratio == 1 ? t : (std::pow(ratio, t) - 1) / (ratio - 1);
    };
    std::vector<Point>& points = c.border.points;
    for (std::size_t i = 0; i < at_bottom_and_top; ++i) points.push_back({x_at(i), 0});
    for (std::size_t i = 0; i < at_right; ++i)
        points.push_back({1, static_cast<double>(i) / static_cast<double>(at_right)});
    for (std::size_t i = at_bottom_and_top; i > 0; --i) points.push_back({x_at(i), 1});
    for (std::size_t i = at_left; i > 0; --i)
        points.push_back({0, static_cast<double>(i) / static_cast<double>(at_left)});
    c.border.close_loop();

    if (ratio == 1) {
        c.field = SizeField(c.size);
    } else {
        const std::vector<SizeSource> left{{{0, 0}, {0, 1}, c.size}};
        c.field = SizeField(left, {.gradation = c.gradation}, Box{{0, 0}, {1, 1}});
    }
    return c;
}

}  // namespace lamina::test
