#include "adaptation/error_norm.hpp"

#include <initializer_list>

#include "core/reproducible_math.hpp"

namespace lamina::adaptation {

namespace {

/// Integrates (x (1 - x) / 2)^p over the line from 0 to 1, by the rule of midpoints.
double mean_power_on_line(double p) {
    constexpr int pieces = 256;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
        const double x = (i + 0.5) / pieces;
        sum += core::pow_reproducible(0.5 * x * (1 - x), p);
    }
    return sum / pieces;
}

/// The error at a point with the barycentric coordinates a, b, c is half of a b |e_ab|^2 + b c |e_bc|^2 + c a |e_ca|^2,
/// where edges count as long as they are in the direction of x. Points are the middles of small triangles, which stand
/// on their base or on their tip; directions repeat after 60 degrees.
double mean_power_on_triangle(double p) {
    constexpr int rows = 24, directions = 8;
    const auto squared_cosine = [](double degrees) {
        const double cosine = core::cos_reproducible(core::radians(degrees));
        return cosine * cosine;
    };
    double sum = 0;
    for (int k = 0; k < directions; ++k) {
        const double angle = 60.0 * k / directions;
        const double ab = squared_cosine(angle), bc = squared_cosine(angle + 120), ca = squared_cosine(angle + 240);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; i + j < rows; ++j)
                for (const double third : {1.0 / 3, 2.0 / 3}) {
                    const double a = (i + third) / rows, b = (j + third) / rows, c = 1 - a - b;
                    if (c > 0) sum += core::pow_reproducible(0.5 * (a * b * ab + b * c * bc + c * a * ca), p);
                }
    }
    return sum / (directions * rows * rows);
}

}  // namespace

ErrorNorm::ErrorNorm(double p)
    : p_(p), power_on_line_(mean_power_on_line(p)), power_on_triangle_(mean_power_on_triangle(p)) {}

double ErrorNorm::size(double lambda) const { return 1 / core::pow_reproducible(lambda, p_ / (2 * p_ + 2)); }

}  // namespace lamina::adaptation
