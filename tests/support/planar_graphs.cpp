#include "support/planar_graphs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.hpp"
#include "core/segments.hpp"

namespace lamina::test {

namespace {

constexpr double square_side = 10;

void add_isolated_vertices(PlanarGraph& graph, core::Random& random) {
    constexpr std::array counts{1, 2, 3, 10, 50, 100};
    const int n = counts[random.below(counts.size())];
    for (int i = 0; i < n; ++i) {
        const Point p{random.real(0.01, 9.99), random.real(0.01, 9.99)};
        graph.points.push_back(p);
        const double gap = std::pow(10, random.real(-6, 0));
        if (random.below(8) == 0 && p.x + gap < 9.99) graph.points.push_back({p.x + gap, p.y});
    }
}

void add_dangling_segments(PlanarGraph& graph, core::Random& random) {
    constexpr std::array lengths{0.01, 0.1, 0.5, 3.0};
    const std::size_t n = 1 + random.below(20);
    for (std::size_t i = 0; i < n; ++i) {
        const double length = lengths[random.below(lengths.size())], turn = random.real(0, 6.3);
        const Point a{random.real(0.2, 9.8), random.real(0.2, 9.8)};
        const Point b = a + length * Point{std::cos(turn), std::sin(turn)};
        if (std::min(b.x, b.y) > 0.05 && std::max(b.x, b.y) < 9.95) graph.add_segment(a, b);
    }
}

void add_slits(PlanarGraph& graph, core::Random& random) {
    const std::size_t n = 1 + random.below(3);
    for (std::size_t i = 0; i < n; ++i) {
        const double width = std::pow(10, random.real(-2.5, -0.3));
        const double y = random.real(0.5, 9), left = random.real(0.5, 4), right = random.real(6, 9.5);
        const std::vector<Point> corners{{left, y}, {right, y}, {right, y + width}, {left, y + width}};
        const bool closed = random.below(2) == 0;
        bool is_free = true;
        for (std::size_t k = 0; k < 4; ++k) {
            PlanarGraph one = graph;
            is_free = is_free && one.add_segment(corners[k], corners[(k + 1) % 4]);
        }
        if (!is_free) continue;
        if (closed) {
            graph.add_loop(corners);
        } else {
            graph.add_segment(corners[0], corners[1]);
            graph.add_segment(corners[3], corners[2]);
        }
    }
}

/// Adds segments from one point in random directions, many of which enclose sharp angles.
void add_fan(PlanarGraph& graph, core::Random& random) {
    const std::size_t centre = graph.points.size(), n = 2 + random.below(12);
    const Point at{random.real(3, 7), random.real(3, 7)};
    graph.points.push_back(at);
    for (std::size_t i = 0; i < n; ++i) {
        const double turn = random.real(0, 6.3), length = random.real(0.3, 2.8);
        graph.segments.push_back({VertexId{centre}, VertexId{graph.points.size()}});
        graph.points.push_back(at + length * Point{std::cos(turn), std::sin(turn)});
    }
}

/// Adds a closed star with spikes.
void add_star(PlanarGraph& graph, core::Random& random) {
    const std::size_t n = 3 + random.below(10);
    const double inner = random.real(0.1, 1.5);
    const Point at{random.real(3, 7), random.real(3, 7)};
    std::vector<Point> corners;
    for (std::size_t i = 0; i < 2 * n; ++i) {
        const double turn = M_PI * static_cast<double>(i) / static_cast<double>(n);
        corners.push_back(at + (i % 2 == 0 ? 2.8 : inner) * Point{std::cos(turn), std::sin(turn)});
    }
    graph.add_loop(corners);
}

void add_mixture(PlanarGraph& graph, core::Random& random) {
    add_dangling_segments(graph, random);
    add_isolated_vertices(graph, random);
}

/// A kind of graph: its name, and the function that adds what is in the square.
struct GraphKind {
    const char* name;
    void (*add)(PlanarGraph& graph, core::Random& random);
};

constexpr std::array kinds{GraphKind{"isolated vertices", add_isolated_vertices},
                           GraphKind{"dangling segments", add_dangling_segments},
                           GraphKind{"slits", add_slits},
                           GraphKind{"fan", add_fan},
                           GraphKind{"star", add_star},
                           GraphKind{"mixture", add_mixture}};

}  // namespace

void PlanarGraph::add_loop(const std::vector<Point>& corners) {
    const std::size_t first = points.size();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        segments.push_back({VertexId{first + i}, VertexId{first + (i + 1) % corners.size()}});
        points.push_back(corners[i]);
    }
}

bool PlanarGraph::add_segment(Point a, Point b) {
    for (const Segment& s : segments)
        if (core::segments_meet(a, b, points[s.a.index()], points[s.b.index()])) return false;
    segments.push_back({VertexId{points.size()}, VertexId{points.size() + 1}});
    points.insert(points.end(), {a, b});
    return true;
}

RandomGraph random_planar_graph(std::uint64_t seed) {
    core::Random random(seed);
    const auto& [kind, add] = kinds[random.below(kinds.size())];
    RandomGraph result{kind, {}};
    result.graph.add_loop({{0, 0}, {square_side, 0}, {square_side, square_side}, {0, square_side}});
    add(result.graph, random);
    return result;
}

}  // namespace lamina::test
