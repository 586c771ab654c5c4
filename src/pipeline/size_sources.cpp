#include "pipeline/size_sources.hpp"

#include <algorithm>
#include <cmath>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/reproducible_math.hpp"
#include "pipeline/background.hpp"

namespace lamina {

namespace {

// ---- wakes ----

/// Sizes along a wake grow by this share of the gradation: slowly, or the line would be no better than its first point.
constexpr double wake_growth = 0.1;
/// A wake is a chain of segments of one size each; the next one's is larger by this factor.
constexpr double wake_step = 1.05;

struct Wake {
    Point from, direction;
    double length;
};

/// How far the ray from p gets before it enters a wall that p does not lie on.
double free_length(const Pslg& pslg, Point p, Point direction, double length) {
    const double touching = 1e-9 * length;
    for (const Element& element : pslg.elements) {
        for (std::size_t i = 0; i < element.points.size(); ++i) {
            const Point a = element.points[i] - p, b = element.points[(i + 1) % element.points.size()] - p;
            const double side_a = cross(direction, a), side_b = cross(direction, b);
            if ((side_a > 0) == (side_b > 0)) continue;
            const double t = (side_b * dot(direction, a) - side_a * dot(direction, b)) / (side_b - side_a);
            if (t > touching && t < length) length = t;
        }
    }
    return length;
}

/// One from each trailing edge, as long as asked for or up to the first wall.
std::vector<Wake> find_wakes(const Pslg& pslg, const WakeOptions& options) {
    Box box;
    for (const Element& element : pslg.elements)
        for (Point p : element.points) box.include(p);
    const double angle = radians(options.angle_deg), length = options.length * box.width();
    const Point direction{cos_reproducible(angle), sin_reproducible(angle)};
    std::vector<Wake> wakes;
    for (const Element& element : pslg.elements) {
        const Point from = summarize(element).trailing_edge;
        wakes.push_back({from, direction, free_length(pslg, from, direction, length)});
    }
    return wakes;
}

void add_sources(const Wake& wake, double size, double gradation, std::vector<SizeSource>& sources) {
    const double growth = wake_growth * gradation;
    for (double at = 0; at < wake.length;) {
        const double next = std::min(at + (wake_step - 1) * size / growth, wake.length);
        sources.push_back({wake.from + at * wake.direction, wake.from + next * wake.direction, size});
        size *= wake_step;
        at = next;
    }
}

// ---- borders ----

/// A border edge asks for at most this many times the size of which it is a fit share. Without a bound a long edge's
/// excess of a few per cent would be a multiple of the size at a fine edge far away.
constexpr double largest_raise = 2.5;

/// The size that each edge asks for: that of which it is a fit share, or more beside a longer edge, on the same border
/// or across a slot, so that none is too long for the field that the others make: the largest of (size - gradation x
/// distance between the middles), within the bound.
std::vector<double> edge_sizes(std::span<const SizeSource> edges, double gradation) {
    std::vector<Box> boxes;
    std::vector<double> negative_sizes;
    for (const SizeSource& edge : edges) {
        boxes.push_back(box_of(edge));
        negative_sizes.push_back(-edge.size);
    }
    const BoxTree tree(std::move(boxes));
    const auto values = tree.least_values(std::move(negative_sizes));
    std::vector<double> sizes(edges.size());
    parallel_for(edges.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Point p = midpoint(edges[i].a, edges[i].b);
            const double passed_on = -tree.least(p, gradation, -edges[i].size, values, [&](std::size_t other) {
                return distance(p, midpoint(edges[other].a, edges[other].b));
            });
            sizes[i] = std::min(passed_on, largest_raise * edges[i].size);
        }
    });
    return sizes;
}

/// The edges of the layers' outer borders ask for sizes: each for its own, or for `wall_size` where that is less. More
/// than its own would be a jump from frozen edges to triangles many times as large.
std::vector<SizeSource> border_sources(const Layer& layer, const CaseOptions& options) {
    std::vector<SizeSource> sources;
    for (const auto& border : layer.borders)
        for (std::size_t i = 0; i < border.size(); ++i) {
            const Point a = layer.points[border[i].index()];
            const Point b = layer.points[border[i + 1 < border.size() ? i + 1 : 0].index()];
            sources.push_back({.a = a, .b = b, .size = distance(a, b) / frozen_share});
        }
    const std::vector<double> sizes = edge_sizes(sources, options.gradation);
    for (std::size_t i = 0; i < sources.size(); ++i)
        sources[i].size = std::min(sizes[i], options.wall_size.value_or(HUGE_VAL));
    return sources;
}

LayerOptions layer_options(const CaseOptions& options, std::span<const SizeSource> sources) {
    LayerOptions layer = options.layer;
    layer.border_gradation = border_gradation(options);
    layer.ray_gradation = std::max(layer.border_gradation, slowest_wall_gradation);
    layer.longest_border_edge =
        frozen_share * std::min(options.wall_size.value_or(HUGE_VAL), options.far_size.value_or(HUGE_VAL));
    // Neighbouring frozen edges may differ by sqrt 2 / (2 sin(bound)) before a quality-driven vertex can encroach
    // (docs/decisions/0003); a tenth more saves many splits and is never seen to.
    layer.border_ratio = 1.1 * std::sqrt(2.0) / (2 * sin_reproducible(radians(options.min_angle_deg)));
    constexpr double shift_of_cuts = 1.08;
    for (SizeSource source : sources) {
        source.size *= frozen_share / shift_of_cuts;
        layer.border_sources.push_back(source);
    }
    return layer;
}

/// What sources ask for at a point, without any cap.
double size_at(Point p, std::span<const SizeSource> sources, double gradation) {
    double size = HUGE_VAL;
    for (const SizeSource& source : sources) size = std::min(size, source.size + gradation * distance_to(source, p));
    return size;
}

}  // namespace

double border_gradation(const CaseOptions& options) {
    // Edges are divided into whole numbers of pieces: graded as steeply as the field, some would be too long for it.
    constexpr double rounding_of_pieces = 1.15;
    return frozen_share * options.gradation / rounding_of_pieces;
}

std::vector<SizeSource> wake_sources(const Pslg& pslg, const CaseOptions& options) {
    std::vector<SizeSource> sources;
    if (!options.wake || !options.wake->size) return sources;
    for (const Wake& wake : find_wakes(pslg, *options.wake))
        add_sources(wake, *options.wake->size, options.gradation, sources);
    return sources;
}

SizedLayer make_sized_layer(const Pslg& pslg, const CaseOptions& options, const Box& domain) {
    SizedLayer result{{}, options.size_sources};
    const std::vector<SizeSource> given_wakes = wake_sources(pslg, options);
    result.sources.insert(result.sources.end(), given_wakes.begin(), given_wakes.end());
    // Those that the layer's border has to heed: of a background mesh only few.
    std::vector<SizeSource> at_border = result.sources;
    result.layer = make_layer(pslg, layer_options(options, at_border));
    if (options.background) {
        const std::vector<SizeSource> all = background_sources(*options.background, options.gradation, domain);
        const std::vector<SizeSource> binding =
            binding_sources(all, result.layer, border_gradation(options), frozen_share);
        result.sources.insert(result.sources.end(), all.begin(), all.end());
        at_border.insert(at_border.end(), binding.begin(), binding.end());
        if (!binding.empty()) result.layer = make_layer(pslg, layer_options(options, at_border));
    }
    if (!options.wake || options.wake->size) return result;

    // Wakes begin with the size that the layer has at the trailing edge without them.
    std::vector<SizeSource> without = border_sources(result.layer, options);
    without.insert(without.end(), result.sources.begin(), result.sources.end());
    std::vector<SizeSource> along_wakes;
    for (const Wake& wake : find_wakes(pslg, *options.wake))
        add_sources(wake, size_at(wake.from, without, options.gradation), options.gradation, along_wakes);
    result.sources.insert(result.sources.end(), along_wakes.begin(), along_wakes.end());
    at_border.insert(at_border.end(), along_wakes.begin(), along_wakes.end());
    result.layer = make_layer(pslg, layer_options(options, at_border));
    return result;
}

SizeField make_size_field(const SizedLayer& layer, const CaseOptions& options, const Box& domain) {
    std::vector<SizeSource> sources = border_sources(layer.layer, options);
    sources.insert(sources.end(), layer.sources.begin(), layer.sources.end());
    return SizeField(sources, {.gradation = options.gradation, .max_size = options.far_size.value_or(HUGE_VAL)},
                     domain);
}

}  // namespace lamina
