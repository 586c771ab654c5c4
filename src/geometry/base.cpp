#include "geometry/base.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/reproducible_math.hpp"
#include "geometry/corners.hpp"

namespace lamina {

std::optional<Base> find_base(std::span<const Point> points) {
    std::vector<double> turnings_deg = turnings(points);
    for (double& angle : turnings_deg) angle = degrees(angle);
    Box box;
    for (const Point p : points) box.include(p);
    std::optional<Base> base;
    double rearmost = box.center().x;
    const std::size_t n = points.size();
    const auto is_corner = [&](std::size_t i) { return turnings_deg[i] > 45 && turnings_deg[i] < 135; };
    for (std::size_t i = 0; i < n; ++i) {
        if (!is_corner(i)) continue;
        std::size_t j = (i + 1) % n;
        while (j != i && std::abs(turnings_deg[j]) < 1) j = (j + 1) % n;
        if (j == i || !is_corner(j)) continue;
        const bool is_short = distance(points[i], points[j]) < 0.5 * std::max(box.width(), box.height());
        const double x = midpoint(points[i], points[j]).x;
        if (!is_short || x <= rearmost) continue;
        base = {i, j};
        rearmost = x;
    }
    return base;
}

}  // namespace lamina
