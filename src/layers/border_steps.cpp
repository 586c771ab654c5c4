// The steps in which the layer ends.
#include <algorithm>
#include <cmath>

#include <lamina/layers.hpp>

namespace lamina {

namespace {

/// Returns the height of the top of layer n above the wall.
double height_at(const Layer& layer, const Ray& ray, std::uint32_t n) {
    return distance(layer.points[ray.origin.index()], layer.points[ray.vertex(n).index()]) / ray.slant;
}

/// Returns the height of the last layer; 0 where there is none.
double last_spacing(const Layer& layer, const Ray& ray) {
    return ray.layers == 0 ? 0 : height_at(layer, ray, ray.layers) - height_at(layer, ray, ray.layers - 1);
}

}  // namespace

BorderSteps border_steps(const Layer& layer) {
    BorderSteps steps;
    for (const std::vector<Ray>& rays : layer.rays) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray &a = rays[i], &b = rays[i + 1 < rays.size() ? i + 1 : 0];
            if (a.requested == 0 && b.requested == 0) continue;
            ++steps.columns;
            steps.full_columns += a.layers == a.requested && b.layers == b.requested;
            if (a.layers == 0 && b.layers == 0) continue;
            const double step = std::abs(height_at(layer, a, a.layers) - height_at(layer, b, b.layers)) /
                                std::max(last_spacing(layer, a), last_spacing(layer, b));
            steps.uneven_columns += step > even_border_step;
            if (step <= steps.max_step) continue;
            steps.max_step = step;
            steps.max_step_at = layer.points[a.tip().index()];
        }
    }
    return steps;
}

}  // namespace lamina
