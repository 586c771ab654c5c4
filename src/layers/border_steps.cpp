// The steps in which the layer ends.
#include <algorithm>
#include <cmath>
#include <optional>

#include <lamina/layers.hpp>

namespace lamina {

namespace {

/// A column between two rays, whose heights are those above its edge of the wall, or along the rays of a fan.
class Column {
public:
    Column(const Layer& layer, const Ray& a, const Ray& b) : layer_(layer) {
        const Point edge = at(b.origin) - at(a.origin);
        if (a.origin != b.origin) normal_ = -perpendicular(unit(edge));
    }

    /// Returns the height of the top of layer n.
    double height(const Ray& ray, std::uint32_t n) const {
        const Point up = at(ray.vertex(n)) - at(ray.origin);
        return normal_ ? dot(up, *normal_) : length(up);
    }
    /// Returns the height of the last layer; 0 where there is none.
    double last_spacing(const Ray& ray) const {
        return ray.layers == 0 ? 0 : height(ray, ray.layers) - height(ray, ray.layers - 1);
    }

private:
    const Layer& layer_;
    std::optional<Point> normal_;

    Point at(VertexId v) const { return layer_.points[v.index()]; }
};

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
            const Column column(layer, a, b);
            const double step = std::abs(column.height(a, a.layers) - column.height(b, b.layers)) /
                                std::max(column.last_spacing(a), column.last_spacing(b));
            steps.uneven_columns += step > even_border_step;
            if (step <= steps.max_step) continue;
            steps.max_step = step;
            steps.max_step_at = layer.points[a.tip().index()];
        }
    }
    return steps;
}

}  // namespace lamina
