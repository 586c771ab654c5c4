// Random multi-element configurations, each meshed and judged: what a user could ask for in ten thousand bad moods.
//   lamina_stress COUNT [FIRST [SEED]]     configurations FIRST .. FIRST + COUNT - 1 of the sequence SEED
//
// A configuration has one to four NACA sections of random size, thickness, camber and trailing edge, set up as slats
// and flaps with slots down to 0.01 % of the chord and deflections up to 60 degrees, or thrown anywhere; the layer's
// options are random too. Bodies that overlap must be refused; everything else must give a layer without findings and a
// valid mesh, or be refused for options that make no sense. The exit status is 1 where anything else happened.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "support/layers.hpp"

namespace lamina {
namespace {

class Random : public core::Random {
public:
    using core::Random::Random;
    double uniform(double low, double high) { return real(low, high); }
    /// Every order of magnitude alike.
    double graded(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }
    bool chance(double share) { return uniform(0, 1) < share; }
};

using Outline = std::vector<Point>;

struct Configuration {
    Geometry geometry;
    CaseOptions options;
    std::string what;  ///< for the log
};

Outline section(Random& random) {
    const std::size_t camber = random.below(7), place = camber > 0 ? 2 + random.below(5) : 0;
    const std::string digits = fmt::format("{}{}{:02}", camber, place, 3 + random.below(random.chance(0.2) ? 40 : 20));
    const TrailingEdge tail = random.chance(0.5) ? TrailingEdge::sharp : TrailingEdge::blunt;
    return naca_airfoil(digits, 20 + random.below(random.chance(0.1) ? 400 : 120), tail).points;
}

/// Nose-down by `degrees` about the origin, scaled, then moved.
Outline placed(Outline outline, double scale, double angle_deg, Point shift) {
    const double c = core::cos_reproducible(core::radians(angle_deg)),
                 s = core::sin_reproducible(core::radians(angle_deg));
    for (Point& p : outline) p = shift + scale * Point{c * p.x + s * p.y, c * p.y - s * p.x};
    return outline;
}

Outline moved(Outline outline, Point shift) { return placed(std::move(outline), 1, 0, shift); }

template <class F>
void for_each_pair_of_edges(const Outline& a, const Outline& b, F&& f) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) f(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]);
}

bool holds(const Outline& outline, Point p) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        Point a = outline[i], b = outline[(i + 1) % outline.size()];
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        if (b.y < a.y) std::swap(a, b);
        inside ^= orient2d(a, b, p) > 0;
    }
    return inside;
}

/// By brute force, without the library's own check.
bool overlap(const Outline& a, const Outline& b) {
    bool meet = holds(a, b[0]) || holds(b, a[0]);
    for_each_pair_of_edges(a, b,
                           [&](Point p, Point q, Point r, Point s) { meet = meet || core::segments_meet(p, q, r, s); });
    return meet;
}

double gap(const Outline& a, const Outline& b) {
    if (overlap(a, b)) return 0;
    double least = HUGE_VAL;
    for_each_pair_of_edges(a, b, [&](Point p, Point q, Point r, Point s) {
        least = std::min({least, core::distance_to_segment(p, r, s), core::distance_to_segment(r, p, q)});
    });
    return least;
}

/// Moves `outline` against `direction` from far away until a slot of `width` is left to what stands there.
Outline brought_near(const Outline& outline, const std::vector<Outline>& standing, Point direction, double width) {
    double near = -1, far = 2;
    for (int step = 0; step < 45; ++step) {
        const double middle = 0.5 * (near + far);
        double least = HUGE_VAL;
        for (const Outline& other : standing) least = std::min(least, gap(moved(outline, middle * direction), other));
        (least > width ? far : near) = middle;
    }
    return moved(outline, far * direction);
}

std::vector<Outline> high_lift(Random& random, std::string& what) {
    std::vector<Outline> bodies{section(random)};
    const bool slat = random.chance(0.5);
    const std::size_t flaps = random.below(3);
    double tail = 1, tail_y = 0, deflection = 0;
    for (std::size_t k = 0; k < flaps; ++k) {
        const double chord = random.uniform(0.1, 0.4), width = random.graded(1e-4, 0.05);
        deflection = std::min(60.0, deflection + random.uniform(0, 45));
        const double overlap_x = random.uniform(-0.02, 0.3 * chord);
        const Outline flap = placed(section(random), chord, deflection, {tail - overlap_x, tail_y});
        bodies.push_back(brought_near(flap, bodies, {0, -1}, width));
        tail = bodies.back()[0].x;
        tail_y = bodies.back()[0].y;
        what += fmt::format(" flap {:.3f} at {:.1f} deg, slot {:.5f};", chord, deflection, width);
    }
    if (slat) {
        const double chord = random.uniform(0.08, 0.3), width = random.graded(1e-4, 0.05),
                     angle = random.uniform(0, 60), overlap_x = random.uniform(-0.02, 0.1);
        Outline outline = placed(section(random), chord, -angle, {0, 0});
        outline = moved(outline, {overlap_x - outline[0].x, -outline[0].y});
        bodies.push_back(brought_near(outline, bodies, {-0.6, 0.8}, width));
        what += fmt::format(" slat {:.3f} at {:.1f} deg, slot {:.5f};", chord, angle, width);
    }
    if (bodies.size() > 1 && random.chance(0.05)) {
        const double angle = random.uniform(0, 2 * core::pi);
        bodies.back() =
            moved(bodies.back(), 0.05 * Point{core::cos_reproducible(angle), core::sin_reproducible(angle)});
        what += " last one pushed;";
    }
    return bodies;
}

std::vector<Outline> thrown(Random& random, std::string& what) {
    std::vector<Outline> bodies;
    const std::size_t n = 1 + random.below(4);
    const bool far_apart = random.chance(0.5);
    while (bodies.size() < n) {
        const double size = random.graded(0.05, 1);
        Outline outline = placed(section(random), size, random.uniform(-180, 180),
                                 {random.uniform(-1, 1), random.uniform(-0.6, 0.6)});
        if (far_apart && !bodies.empty()) {
            const double angle = random.uniform(0, 2 * core::pi);
            outline =
                brought_near(moved(outline, {-outline[0].x, -outline[0].y}), bodies,
                             {core::cos_reproducible(angle), core::sin_reproducible(angle)}, random.graded(1e-4, 0.3));
        }
        bodies.push_back(std::move(outline));
    }
    what += fmt::format(" {} bodies {};", n, far_apart ? "side by side" : "anywhere");
    return bodies;
}

CaseOptions random_options(Random& random) {
    CaseOptions options;
    LayerOptions& layer = options.layer;
    layer.first_height = random.graded(1e-6, 3e-3);
    layer.growth = random.uniform(1.05, 1.6);
    layer.layers = static_cast<std::uint32_t>(1 + random.below(40));
    layer.max_ray_angle_deg = random.graded(2, 45);
    layer.corners = random.chance(0.7) ? Corners::fan : Corners::refine;
    layer.enabled = !random.chance(0.03);
    // Thicker than a chord is rarely meant.
    if (layer.enabled && !random.chance(0.05))
        while (*layer.layers > 1 && layer_height(test::growth_of(layer), *layer.layers) > 0.3) --*layer.layers;
    if (random.chance(0.15)) {
        layer.layers.reset();
        layer.growth = random.uniform(1.1, 1.6);
    } else if (random.chance(0.2)) {
        layer.growth_law = random.chance(0.5) ? GrowthLaw::aflr : GrowthLaw::adaptive;
    }
    layer.topology = std::array{LayerTopology::delaunay, LayerTopology::layered, LayerTopology::quads}[random.below(3)];
    options.far_field.size = random.uniform(2, 6);
    options.sizing.field.gradation = random.uniform(0.2, 0.5);
    options.threads = 1;
    return options;
}

Configuration configuration(std::uint64_t seed, std::uint64_t number) {
    Random random(Random(seed ^ (number * 0xd1342543de82ef95u)).bits());
    Configuration c;
    const std::vector<Outline> bodies = random.chance(0.7) ? high_lift(random, c.what) : thrown(random, c.what);
    // Somewhere, in some unit, at some angle of attack.
    const double scale = random.chance(0.3) ? random.graded(1e-3, 1e3) : 1, attack = random.uniform(-20, 20);
    const Point shift = random.chance(0.3) ? Point{random.uniform(-5, 5), random.uniform(-5, 5)} : Point{0, 0};
    for (const Outline& body : bodies) {
        Element element;
        element.name = fmt::format("body{}", c.geometry.elements.size());
        element.file = "stress";
        element.points = placed(body, scale, attack, shift);
        element.lines.assign(element.points.size(), 0);
        c.geometry.elements.push_back(std::move(element));
    }
    c.options = random_options(random);
    c.options.layer.first_height = test::first_height(c.options.layer) * scale;
    const LayerOptions& layer = c.options.layer;
    c.what += fmt::format(" first height {:.3g}, growth {:.3f}, {} layers, rays {:.2f} deg, {}, scale {:.3g}",
                          test::first_height(layer), layer.growth, layer.enabled ? layer.layers.value_or(0) : 0,
                          layer.max_ray_angle_deg, layer.corners == Corners::fan ? "fan" : "refine", scale);
    return c;
}

bool bodies_overlap(const Geometry& geometry) {
    for (std::size_t i = 0; i < geometry.elements.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (overlap(geometry.elements[i].points, geometry.elements[j].points)) return true;
    return false;
}

struct Outcome {
    std::string name;
    std::string failure;  ///< empty where all is well
    double angle = 180;
    std::size_t refused = 0, oversized = 0;
    ElementCoverage coverage{};
};

Outcome judge(const Configuration& c) {
    Outcome outcome;
    const bool must_be_refused = bodies_overlap(c.geometry);
    try {
        check_simple(c.geometry);
        if (must_be_refused) return {"accepted", "overlapping bodies were accepted"};
        const Layer layer = test::make_layer(c.geometry, c.options.layer);
        const std::vector<std::string> findings = check_layer(layer, c.options.layer);
        if (!findings.empty()) return {"unsound layer", findings.front()};
        const MeshResult result = generate_mesh(c.geometry, c.options);
        const MeshCheck check = check_mesh(result.mesh, {.min_angle_deg = c.options.refine.min_angle_deg});
        if (!check.valid()) return {"invalid mesh", check.defects.front().what};
        outcome.name = "meshed";
        outcome.angle = check.isotropic.min_angle_deg;
        outcome.refused = result.refinement.refused;
        outcome.oversized = result.refinement.oversized;
        for (const ElementCoverage& element : result.layer_coverage) outcome.coverage += element;
    } catch (const InputError& e) {
        return {"bodies refused", must_be_refused ? "" : std::string("refused sound bodies: ") + e.what()};
    } catch (const UsageError& e) {
        return {"options refused", std::strstr(e.what(), "far_field") || std::strstr(e.what(), "resolution") ||
                                           std::strstr(e.what(), "times the extent")
                                       ? ""
                                       : std::string("refused sound options: ") + e.what()};
    } catch (const std::exception& e) {
        return {"failed", e.what()};
    }
    return outcome;
}

int run(std::uint64_t count, std::uint64_t first, std::uint64_t seed) {
    std::vector<Outcome> outcomes(count);
    core::parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Configuration c = configuration(seed, first + i);
            outcomes[i] = judge(c);
            if (outcomes[i].failure.empty()) continue;
            fmt::print("{} {}: {}: {}\n   {}\n", first + i, seed, outcomes[i].name, outcomes[i].failure, c.what);
            std::fflush(stdout);
        }
    });
    std::map<std::string, std::size_t> counts;
    std::array<std::size_t, 4> below{};  // smallest angles below 1, 5, 10, 20 degrees
    std::size_t failures = 0, left_over = 0;
    ElementCoverage coverage{};
    for (const Outcome& o : outcomes) {
        ++counts[o.name];
        failures += !o.failure.empty();
        left_over += o.refused + o.oversized > 0;
        coverage += o.coverage;
        for (std::size_t k = 0; k < below.size(); ++k) below[k] += o.angle < std::array{1.0, 5.0, 10.0, 20.0}[k];
    }
    for (const auto& [name, n] : counts) fmt::print("{:6} {}\n", n, name);
    const auto percent = [](const LayerCoverage& c) {
        return 100.0 * static_cast<double>(c.made_cells) /
               static_cast<double>(std::max<std::size_t>(c.requested_cells, 1));
    };
    fmt::print(
        "{:6} failures; {} with points refused or triangles too large; smallest angle below 1, 5, 10, 20 deg: "
        "{}, {}, {}, {}; {:.2f} % of the layer cells made, {:.2f} % in the open\n",
        failures, left_over, below[0], below[1], below[2], below[3], percent(coverage.all), percent(coverage.open));
    return failures > 0 ? 1 : 0;
}

}  // namespace
}  // namespace lamina

int main(int argc, char** argv) {
    std::array<std::uint64_t, 3> numbers{100, 0, 1};
    for (int i = 1; i < argc; ++i) {
        const char* end = argv[i] + std::strlen(argv[i]);
        if (i > 3 || std::from_chars(argv[i], end, numbers[static_cast<std::size_t>(i) - 1]).ptr != end) {
            fmt::print(stderr, "usage: lamina_stress COUNT [FIRST [SEED]]\n");
            return 2;
        }
    }
    return lamina::run(numbers[0], numbers[1], numbers[2]);
}
