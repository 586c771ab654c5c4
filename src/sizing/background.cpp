// Sources that are points suffice to stand for a background mesh. In a triangle with corners v_i of sizes s_i and
// barycentric coordinates w_i at x, g being the gradation,
//     min_i (s_i + g |x - v_i|)  <=  sum_i w_i (s_i + g |x - v_i|)  =  interpolated size + g sum_i w_i |x - v_i|,
// and by Cauchy and Lagrange's identity (sum w_i |x - v_i|)^2 <= sum_(i<j) w_i w_j |v_i - v_j|^2 <= L^2 / 3, L being
// the longest edge. So a triangle needs no further points if g L / sqrt 3 is at most a tenth of its smallest size.
// Other triangles are halved at their longest edge. Points carry interpolated sizes, so none requests less than the
// mesh does.
#include "sizing/background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "sizing/sized_point.hpp"

namespace lamina::sizing {

namespace {

/// The share of the interpolated size by which the field may exceed it.
constexpr double tolerance = 0.1;

SizeSource source_at(const SizedPoint& p) { return {.a = p.at, .b = p.at, .size = p.size}; }

Box triangle_box(const SizedPoint& a, const SizedPoint& b, const SizedPoint& c) {
    Box box;
    for (const Point p : {a.at, b.at, c.at}) box.include(p);
    return box;
}

/// Samples the triangles of a background mesh.
class Sampler {
public:
    Sampler(double gradation, const Box& domain)
        : squared_reach_(3 * tolerance * tolerance / (gradation * gradation)), domain_(domain) {}

    /// Adds the points that a triangle needs inside and on its edges. It is halved until each part is small enough or
    /// lies outside the domain.
    void sample(SizedPoint a, SizedPoint b, SizedPoint c, std::vector<SizeSource>& points) const {
        const double min_size = std::min({a.size, b.size, c.size});
        const std::array<double, 3> squared = squared_edges(a, b, c);
        if (*std::max_element(squared.begin(), squared.end()) <= squared_reach_ * min_size * min_size) return;
        if (!triangle_box(a, b, c).overlaps(domain_)) return;
        rename_longest_edge(a, b, c, squared);
        const SizedPoint middle{midpoint(a.at, c.at), 0.5 * (a.size + c.size)};
        points.push_back(source_at(middle));
        sample(a, b, middle, points);
        sample(middle, b, c, points);
    }

    /// Returns a lower bound of the number of points that sample() adds, up to a factor of about two.
    double min_count(const SizedPoint& a, const SizedPoint& b, const SizedPoint& c) const {
        const Box box = triangle_box(a, b, c);
        if (!box.overlaps(domain_)) return 0;
        const double width = std::min(box.upper.x, domain_.upper.x) - std::max(box.lower.x, domain_.lower.x);
        const double height = std::min(box.upper.y, domain_.upper.y) - std::max(box.lower.y, domain_.lower.y);
        const double area = 0.5 * std::abs(cross(b.at - a.at, c.at - a.at));
        const double share = std::min(1.0, width * height / std::max(area, std::numeric_limits<double>::min()));
        const double reach = std::sqrt(squared_reach_);
        const double max_edge = reach * std::max({a.size, b.size, c.size});
        double count = share * area / (max_edge * max_edge);
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            const double length_inside = std::min(distance(p.at, q.at), width + height);
            count = std::max(count, length_inside / (reach * std::max(p.size, q.size)));
        }
        return count;
    }

private:
    double squared_reach_;  ///< square of (longest edge of a triangle that needs no points / its smallest size)
    Box domain_;
};

void require_well_formed(const SizedMesh& mesh) {
    if (mesh.sizes.size() != mesh.points.size()) throw OptionError("background", "needs one size per point");
    for (const double size : mesh.sizes)
        if (!(size > 0 && size < HUGE_VAL)) throw OptionError("background", "a size is not positive");
    for (const Triangle& t : mesh.triangles)
        for (const VertexId v : t.v)
            if (v.index() >= mesh.points.size()) throw OptionError("background", "a triangle has no such point");
}

}  // namespace

std::vector<SizeSource> background_sources(const SizedMesh& mesh, double gradation, const Box& domain) {
    require_well_formed(mesh);
    const Sampler sampler(gradation, domain);
    const auto corner = [&](VertexId v) { return SizedPoint{mesh.points[v.index()], mesh.sizes[v.index()]}; };
    constexpr std::size_t grain = 4096;

    const std::vector<double> counts =
        core::parallel_blocks(mesh.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
            double count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const auto& v = mesh.triangles[i].v;
                count += sampler.min_count(corner(v[0]), corner(v[1]), corner(v[2]));
            }
            return count;
        });
    double count = 0;
    for (const double c : counts) count += c;
    if (count > std::numeric_limits<std::uint32_t>::max())
        throw OptionError("background", core::concat("its sizes ask for more than ", core::rounded_text(count),
                                                     " vertices, which 32-bit numbers cannot count"));

    const auto parts = core::parallel_blocks(mesh.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::vector<SizeSource> points;
        for (std::size_t i = begin; i < end; ++i) {
            const auto& v = mesh.triangles[i].v;
            sampler.sample(corner(v[0]), corner(v[1]), corner(v[2]), points);
        }
        return points;
    });
    std::vector<SizeSource> sources;
    sources.reserve(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) sources.push_back(source_at(corner(VertexId(i))));
    for (const auto& points : parts) sources.insert(sources.end(), points.begin(), points.end());
    return sources;
}

}  // namespace lamina::sizing
