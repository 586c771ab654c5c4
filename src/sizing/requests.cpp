// Collects the sources of the size field: the borders of the layers, wakes, background meshes and the user's own
// shapes.
#include "sizing/requests.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "sizing/background.hpp"
#include "sizing/binding_sources.hpp"
#include "sizing/wake.hpp"

namespace lamina::sizing {

namespace {

/// An edge of a border requests at most this multiple of its length / frozen_share. Without this bound a long
/// edge that is too long by a few per cent would raise the size at a fine edge far away to a multiple of it.
constexpr double max_raise = 2.5;
/// Bounds are lowered by this share, so that rounding never makes them wrong.
constexpr double lowering = 1e-9;

/// Returns the size that each edge of a border requests. Edges come with their own sizes, length / frozen_share. An
/// edge beside a longer one, on the same border or across a slot, requests more, so that none is too long for the field
/// that the others make: the largest of (size of an edge - gradation x distance between the middles), at most max_raise
/// times its own size.
std::vector<double> edge_sizes(std::span<const SizeSource> edges, double gradation) {
    std::vector<Box> boxes;
    std::vector<double> negative_sizes;
    boxes.reserve(edges.size());
    negative_sizes.reserve(edges.size());
    for (const SizeSource& edge : edges) {
        boxes.push_back(bounding_box(edge));
        negative_sizes.push_back(-edge.size);
    }
    const core::BoxTree tree(std::move(boxes));
    const auto values = tree.group_minima(std::move(negative_sizes));
    std::vector<double> sizes(edges.size());
    core::parallel_for(edges.size(), 1024, [&](std::size_t begin, std::size_t end) {
        Point last = midpoint(edges[begin].a, edges[begin].b);
        double raised = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const Point p = midpoint(edges[i].a, edges[i].b);
            // What the edge before has got, less what the way from there takes, is a bound; rounding must not raise it.
            const double least = (1 - lowering) * (raised - gradation * distance(p, std::exchange(last, p)));
            raised = -tree.minimum(p, gradation, -std::max(least, edges[i].size), values, [&](std::size_t other) {
                return distance(p, midpoint(edges[other].a, edges[other].b));
            });
            sizes[i] = std::min(raised, max_raise * edges[i].size);
        }
    });
    return sizes;
}

/// Returns a source for each edge of closed borders. It requests the edge's length / frozen_share, raised by
/// edge_sizes(), or wall_size where that is less. Larger sizes would put triangles many times as large beside frozen
/// edges.
std::vector<SizeSource> border_sources(Loops borders, const SizingOptions& options, double chord) {
    const double wall_size = options.wall_size ? in_units(*options.wall_size, chord) : HUGE_VAL;
    std::vector<SizeSource> sources;
    for (const std::vector<Point>& border : borders)
        for (std::size_t i = 0; i < border.size(); ++i) {
            const Point a = border[i], b = border[i + 1 < border.size() ? i + 1 : 0];
            sources.push_back({.a = a, .b = b, .size = distance(a, b) / frozen_share});
        }
    const std::vector<double> sizes = edge_sizes(sources, field_gradation(options));
    for (std::size_t i = 0; i < sources.size(); ++i) sources[i].size = std::min(sizes[i], wall_size);
    return sources;
}

/// Returns the size that sources request at a point, whatever the largest size is.
double size_at(Point p, std::span<const SizeSource> sources, double gradation) {
    double size = HUGE_VAL;
    for (const SizeSource& source : sources) size = std::min(size, source.size + gradation * distance_to(source, p));
    return size;
}

void append(const std::vector<SizeSource>& more, std::vector<SizeSource>& sources) {
    sources.insert(sources.end(), more.begin(), more.end());
}

}  // namespace

double field_gradation(const SizingOptions& options) {
    return options.background && options.background->gradation ? *options.background->gradation : options.gradation;
}

double border_gradation(double gradation) {
    // Edges are divided into whole numbers of parts. Graded as steeply as the field, some would be too long for it.
    constexpr double rounding_of_parts = 1.15;
    return frozen_share * gradation / rounding_of_parts;
}

SizeRequests gather_size_requests(const SizingOptions& options, const SizedBodies& bodies, Loops fronts,
                                  const Box& domain) {
    const double gradation = field_gradation(options);
    SizeRequests requests;
    append(options.sources, requests.sources);
    for (const WakeOptions& wake : options.wakes)
        append(given_wake_sources(wake, bodies, options.gradation), requests.sources);
    requests.at_borders = requests.sources;
    if (options.background) {
        const std::vector<SizeSource> points = background_sources(*options.background, gradation, domain);
        append(points, requests.sources);
        // Only few points of a background mesh bind at the borders.
        append(binding_sources(points, fronts, border_gradation(options.gradation), frozen_share), requests.at_borders);
    }
    if (std::all_of(options.wakes.begin(), options.wakes.end(),
                    [](const WakeOptions& w) { return w.size.has_value(); }))
        return requests;

    std::vector<SizeSource> without_wakes = border_sources(fronts, options, bodies.chord);
    append(requests.sources, without_wakes);
    for (const WakeOptions& wake_options : options.wakes) {
        if (wake_options.size) continue;
        for (const Wake& wake : find_wakes(bodies, wake_options)) {
            const double size = size_at(wake.from, without_wakes, gradation);
            const std::vector<SizeSource> along_wake = wake_sources(wake, size, gradation);
            append(along_wake, requests.sources);
            append(along_wake, requests.at_borders);
        }
    }
    return requests;
}

SizeField make_size_field(Loops borders, std::span<const SizeSource> sources, const SizingOptions& options,
                          double chord, const Box& domain) {
    std::vector<SizeSource> all = border_sources(borders, options, chord);
    all.insert(all.end(), sources.begin(), sources.end());
    SizeFieldOptions field{.gradation = field_gradation(options)};
    if (options.far_size) field.max_size = in_units(*options.far_size, chord);
    return SizeField(all, field, domain);
}

}  // namespace lamina::sizing
