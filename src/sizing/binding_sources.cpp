// A tree of boxes finds, for each source, the edges that it may shorten.
#include "sizing/binding_sources.hpp"

#include <algorithm>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"

namespace lamina::sizing {

namespace {

/// The edges of the loops, in a tree that finds the edge e with the least (-length(e) + gradation x distance).
struct LoopEdges {
    std::vector<SizeSource> edges;  ///< as shapes; their sizes mean nothing
    core::BoxTree tree;
    std::vector<std::vector<double>> negative_lengths;  ///< the values for tree.minimum()
};

LoopEdges collect_edges(Loops loops) {
    // Edges shift and vary a little when others are divided.
    constexpr double margin = 1.25;
    std::size_t count = 0;
    for (const std::vector<Point>& loop : loops) count += loop.size();
    std::vector<SizeSource> edges;
    std::vector<Box> boxes;
    std::vector<double> negative_lengths;
    edges.reserve(count);
    boxes.reserve(count);
    negative_lengths.reserve(count);
    for (const std::vector<Point>& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
            edges.push_back({.a = a, .b = b, .size = 1});
            boxes.push_back(bounding_box(edges.back()));
            negative_lengths.push_back(-margin * distance(a, b));
        }
    core::BoxTree tree(std::move(boxes));
    auto values = tree.group_minima(std::move(negative_lengths));
    return {std::move(edges), std::move(tree), std::move(values)};
}

/// A source that binds, and the edge that exceeds its allowed length most.
struct Binding {
    std::size_t edge, source;
};

}  // namespace

std::vector<SizeSource> binding_sources(std::span<const SizeSource> sources, Loops loops, double gradation,
                                        double share) {
    const LoopEdges loop_edges = collect_edges(loops);
    const auto find_binding = [&](std::size_t begin, std::size_t end) {
        std::vector<Binding> binding;
        for (std::size_t i = begin; i < end; ++i) {
            const Point p = sources[i].a;
            // The source binds where length - gradation x distance of an edge exceeds the allowed length. Lengths are
            // negated here, because the tree finds minima.
            const double allowed = -share * sources[i].size;
            double worst = allowed;
            std::size_t edge = 0;
            loop_edges.tree.minimum(p, gradation, allowed, loop_edges.negative_lengths, [&](std::size_t e) {
                const double apart = distance_to(loop_edges.edges[e], p);
                const double excess = loop_edges.negative_lengths[0][e] + gradation * apart;
                if (excess < worst) {
                    worst = excess;
                    edge = e;
                }
                return apart;
            });
            if (worst < allowed) binding.push_back({edge, i});
        }
        return binding;
    };
    std::vector<Binding> all;
    for (const std::vector<Binding>& block : core::parallel_blocks(sources.size(), 4096, find_binding))
        all.insert(all.end(), block.begin(), block.end());
    std::stable_sort(all.begin(), all.end(), [](const Binding& a, const Binding& b) { return a.edge < b.edge; });
    std::vector<SizeSource> result;
    result.reserve(all.size());
    for (const Binding& b : all) result.push_back(sources[b.source]);
    return result;
}

}  // namespace lamina::sizing
