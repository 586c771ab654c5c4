// Why points are enough. In a triangle with corners v_i and barycentric coordinates w_i at x
//     min_i (s_i + g |x - v_i|)  <=  sum_i w_i (s_i + g |x - v_i|)  =  interpolated size + g sum_i w_i |x - v_i|,
// and by Cauchy and Lagrange's identity (sum w_i |x - v_i|)^2 <= sum_(i<j) w_i w_j |v_i - v_j|^2 <= L^2 / 3, L being
// the longest edge. So a triangle with g L / sqrt 3 within a tenth of its smallest size needs no more points; others
// are halved at their longest edge. Points carry interpolated sizes: none asks for less than the mesh does.
#include "sizing/background.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <lamina/error.hpp>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"

namespace lamina::sizing {

namespace {

/// What the field may exceed the interpolated size by.
constexpr double tolerance = 0.1;

struct Corner {
    Point at;
    double size;
};

SizeSource source_at(const Corner& c) { return {.a = c.at, .b = c.at, .size = c.size}; }

double squared_edge(const Corner& a, const Corner& b) { return squared_length(b.at - a.at); }

Box triangle_box(const Corner& a, const Corner& b, const Corner& c) {
    Box box;
    for (Point p : {a.at, b.at, c.at}) box.include(p);
    return box;
}

class Sampler {
public:
    Sampler(double gradation, const Box& domain)
        : squared_reach_(3 * tolerance * tolerance / (gradation * gradation)), domain_(domain) {}

    /// Adds points inside the triangle and on its edges.
    void sample(Corner a, Corner b, Corner c, std::vector<SizeSource>& points) const {
        const double least = std::min({a.size, b.size, c.size});
        const double ab = squared_edge(a, b), bc = squared_edge(b, c), ca = squared_edge(c, a);
        if (std::max({ab, bc, ca}) <= squared_reach_ * least * least) return;
        if (!triangle_box(a, b, c).overlaps(domain_)) return;
        // c-a becomes the longest edge.
        if (ab >= bc && ab >= ca)
            std::swap(b, c);
        else if (bc >= ca)
            std::swap(a, b);
        const Corner between{midpoint(a.at, c.at), 0.5 * (a.size + c.size)};
        points.push_back(source_at(between));
        sample(a, b, between, points);
        sample(between, b, c, points);
    }

    /// A lower bound of the number of points that sample() would add, but for a factor of about two.
    double least_count(const Corner& a, const Corner& b, const Corner& c) const {
        const Box box = triangle_box(a, b, c);
        if (!box.overlaps(domain_)) return 0;
        const double width = std::min(box.upper.x, domain_.upper.x) - std::max(box.lower.x, domain_.lower.x);
        const double height = std::min(box.upper.y, domain_.upper.y) - std::max(box.lower.y, domain_.lower.y);
        const double area = 0.5 * std::abs(cross(b.at - a.at, c.at - a.at));
        const double share = std::min(1.0, width * height / std::max(area, std::numeric_limits<double>::min()));
        const double reach = std::sqrt(squared_reach_);
        const double across = reach * std::max({a.size, b.size, c.size});
        double count = share * area / (across * across);
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            const double within = std::min(std::sqrt(squared_edge(p, q)), width + height);
            count = std::max(count, within / (reach * std::max(p.size, q.size)));
        }
        return count;
    }

private:
    double squared_reach_;  ///< the longest edge of a triangle that needs no points, over its smallest size
    Box domain_;
};

void require_well_formed(const SizedMesh& mesh) {
    if (mesh.sizes.size() != mesh.points.size()) throw OptionError("background", "one size a point is needed");
    for (double size : mesh.sizes)
        if (!(size > 0 && size < HUGE_VAL)) throw OptionError("background", "a size is not positive");
    for (const Triangle& t : mesh.triangles)
        for (VertexId v : t.v)
            if (v.index() >= mesh.points.size()) throw OptionError("background", "a triangle without its points");
}

}  // namespace

std::vector<SizeSource> background_sources(const SizedMesh& mesh, double gradation, const Box& domain) {
    require_well_formed(mesh);
    const Sampler sampler(gradation, domain);
    const auto corner = [&](VertexId v) { return Corner{mesh.points[v.index()], mesh.sizes[v.index()]}; };
    constexpr std::size_t grain = 4096;

    const std::vector<double> counts =
        core::parallel_blocks(mesh.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
            double count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const auto& v = mesh.triangles[i].v;
                count += sampler.least_count(corner(v[0]), corner(v[1]), corner(v[2]));
            }
            return count;
        });
    double count = 0;
    for (double part : counts) count += part;
    if (count > std::numeric_limits<std::uint32_t>::max())
        throw OptionError("background", core::concat("its sizes ask for more than ", core::rounded_text(count),
                                                     " vertices, which 32-bit numbers cannot count"));

    auto parts = core::parallel_blocks(mesh.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::vector<SizeSource> points;
        for (std::size_t i = begin; i < end; ++i) {
            const auto& v = mesh.triangles[i].v;
            sampler.sample(corner(v[0]), corner(v[1]), corner(v[2]), points);
        }
        return points;
    });
    std::vector<SizeSource> sources;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) sources.push_back(source_at(corner(VertexId(i))));
    for (const auto& points : parts) sources.insert(sources.end(), points.begin(), points.end());
    return sources;
}

std::vector<SizeSource> binding_sources(std::span<const SizeSource> sources, Loops loops, double gradation,
                                        double share) {
    // Edges shift and vary a little when others are divided.
    constexpr double margin = 1.25;
    std::vector<SizeSource> edges;
    std::vector<Box> boxes;
    std::vector<double> negative_lengths;
    for (const std::vector<Point>& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
            edges.push_back({.a = a, .b = b, .size = 1});
            boxes.push_back(bounding_box(edges.back()));
            negative_lengths.push_back(-margin * distance(a, b));
        }
    const core::BoxTree tree(std::move(boxes));
    const auto values = tree.group_minima(std::move(negative_lengths));

    struct Binding {
        std::size_t edge, source;
    };
    const auto parts = core::parallel_blocks(sources.size(), 4096, [&](std::size_t begin, std::size_t end) {
        std::vector<Binding> binding;
        for (std::size_t i = begin; i < end; ++i) {
            const Point p = sources[i].a;
            // length - gradation x distance exceeds the length asked for.
            const double asked = -share * sources[i].size;
            double worst = asked;
            std::size_t edge = 0;
            tree.minimum(p, gradation, asked, values, [&](std::size_t e) {
                const double apart = distance_to(edges[e], p);
                if (values[0][e] + gradation * apart < worst) {
                    worst = values[0][e] + gradation * apart;
                    edge = e;
                }
                return apart;
            });
            if (worst < asked) binding.push_back({edge, i});
        }
        return binding;
    });
    std::vector<Binding> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    std::stable_sort(all.begin(), all.end(), [](const Binding& a, const Binding& b) { return a.edge < b.edge; });
    std::vector<SizeSource> result;
    for (const Binding& b : all) result.push_back(sources[b.source]);
    return result;
}

}  // namespace lamina::sizing
