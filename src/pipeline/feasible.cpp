// Triangles round a source, in units of the largest allowed, are the integral of 1 / h^2: the area at its size s, and
// beside a border of length L, where h = s + g d at a distance d, L times the integral up to the reach D:
//
//     L D / (s (s + g D))
#include "pipeline/feasible.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/equilateral.hpp"
#include "core/reproducible_math.hpp"
#include "pipeline/size_sources.hpp"

namespace lamina {

namespace {

/// Vertices have 32-bit numbers, and there are twice as many triangles; half of them leaves room for what is not
/// foreseen.
constexpr double most_triangles = 4294967296.0;

void require_countable(double inverse_square_integral, const std::string& what) {
    const double triangles = inverse_square_integral / equilateral_area;
    if (triangles <= most_triangles) return;
    throw UsageError(fmt::format("{} asks for about {:.1e} triangles, and no more than {:.1e} can be numbered", what,
                                 triangles, most_triangles));
}

double beside(double length, double size, double gradation, double reach) {
    return length * reach / (size * (size + gradation * reach));
}

/// The length of a segment within a box.
double length_inside(const Box& box, Point a, Point b) {
    double from = 0, to = 1;
    const auto clip = [&](double start, double along, double low, double high) {
        if (along == 0) {
            if (start < low || start > high) to = -1;
            return;
        }
        const double enter = (low - start) / along, leave = (high - start) / along;
        from = std::max(from, std::min(enter, leave));
        to = std::min(to, std::max(enter, leave));
    };
    clip(a.x, b.x - a.x, box.lower.x, box.upper.x);
    clip(a.y, b.y - a.y, box.lower.y, box.upper.y);
    return std::max(to - from, 0.0) * distance(a, b);
}

double asked_by(const SizeSource& source, double gradation, double reach, const Box& domain) {
    const Box inside = box_of(source).intersection(domain);
    const double width = std::max(inside.width(), 0.0), height = std::max(inside.height(), 0.0);
    double area = 0, border = 0;
    if (source.shape == SizeSource::Shape::box) {
        area = width * height;
        border = 2 * (width + height);
    } else if (source.radius > 0) {
        area = 0.25 * pi * width * height;
        border = 0.5 * pi * (width + height);
    } else {
        border = 2 * length_inside(domain, source.a, source.b);
    }
    return area / (source.size * source.size) + beside(border, source.size, gradation, reach);
}

}  // namespace

void require_feasible_sizes(const Pslg& pslg, const CaseOptions& options, const Box& domain) {
    const double g = options.gradation, reach = 0.1 * std::min(domain.width(), domain.height());
    if (const auto& size = options.far_size)
        require_countable(domain.width() * domain.height() / (*size * *size), fmt::format("far-size {}", *size));
    for (const SizeSource& source : options.size_sources)
        require_countable(asked_by(source, g, reach, domain), fmt::format("refine with edges of {}", source.size));
    if (const auto& size = options.wall_size) {
        double walls = 0;
        for (const Element& element : pslg.elements) walls += summarize(element).perimeter;
        require_countable(beside(walls, *size, g, reach), fmt::format("wall-size {}", *size));
    }
    if (options.wake && options.wake->size) {
        double wakes = 0;
        for (const SizeSource& source : wake_sources(pslg, options)) wakes += asked_by(source, g, reach, domain);
        require_countable(wakes, fmt::format("wake with edges of {}", *options.wake->size));
    }
}

void require_feasible(const SizeField& size, const CaseOptions& options) {
    if (!size.is_uniform())
        require_countable(size.inverse_square_integral(),
                          fmt::format("gradation {} with these sizes at walls and sources", options.gradation));
}

}  // namespace lamina
