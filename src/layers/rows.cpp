#include "layers/rows.hpp"

#include <cmath>

#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

constexpr double most_tangent = 8;

}  // namespace

ColumnRow row_between(const RayLine& a, double height_a, const RayLine& b, double height_b) {
    const Point row = b.origin + height_b * b.direction - (a.origin + height_a * a.direction);
    const Point along = unit(a.direction + b.direction);
    return {std::abs(cross(row, along)), dot(row, along)};
}

double tangent_of(const ColumnRow& row) {
    const double shift = std::abs(row.rise);
    return shift < most_tangent * row.width ? shift / row.width : most_tangent;
}

double skewness_between(const ColumnRow& before, const ColumnRow& after, double height) {
    const double off = std::abs(before.rise * after.width - after.rise * before.width);
    const double whole = (before.width + after.width) * height;
    return off < most_tangent * whole ? off / whole : most_tangent;
}

}  // namespace lamina::layers
