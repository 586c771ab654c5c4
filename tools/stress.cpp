// Meshes random multi-element configurations and judges each of them.
//
//   lamina_stress COUNT [FIRST [SEED]]     configurations FIRST .. FIRST + COUNT - 1 of the sequence SEED
//
// A configuration has one to four NACA sections of random size, thickness, camber and trailing edge. They are set up as
// slats and flaps with slots down to 0.01 % of the chord and deflections up to 60 degrees, or placed anywhere. The
// options of the layer are random, too. Bodies that overlap must be refused; everything else must give a layer without
// findings and a valid mesh, or be refused for options that make no sense. The exit status is 1 where anything else
// happened.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <utility>
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
    /// Returns a number whose logarithm is uniformly distributed.
    double log_uniform(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }
    /// Returns true with this probability.
    bool chance(double probability) { return uniform(0, 1) < probability; }
};

using Outline = std::vector<Point>;

struct Configuration {
    Geometry geometry;
    CaseOptions options;
    std::string description;  ///< for the log
};

/// Returns a random NACA section of unit chord.
Outline random_section(Random& random) {
    const std::size_t camber = random.below(7), position = camber > 0 ? 2 + random.below(5) : 0;
    const std::string digits =
        fmt::format("{}{}{:02}", camber, position, 3 + random.below(random.chance(0.2) ? 40 : 20));
    const TrailingEdge tail = random.chance(0.5) ? TrailingEdge::sharp : TrailingEdge::blunt;
    return naca_airfoil(digits, 20 + random.below(random.chance(0.1) ? 400 : 120), tail).points;
}

/// Returns the outline turned nose-down by an angle about the origin, scaled, and then moved.
Outline placed(Outline outline, double scale, double angle_deg, Point shift) {
    const double c = core::cos_reproducible(core::radians(angle_deg)),
                 s = core::sin_reproducible(core::radians(angle_deg));
    for (Point& p : outline) p = shift + scale * Point{c * p.x + s * p.y, c * p.y - s * p.x};
    return outline;
}

Outline moved(Outline outline, Point shift) { return placed(std::move(outline), 1, 0, shift); }

/// Calls f(a, b, c, d) for each edge a-b of one outline and each edge c-d of the other.
template <class F>
void for_each_pair_of_edges(const Outline& a, const Outline& b, F&& f) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) f(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]);
}

/// Returns whether p lies inside an outline.
bool contains(const Outline& outline, Point p) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        Point a = outline[i], b = outline[(i + 1) % outline.size()];
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        if (b.y < a.y) std::swap(a, b);
        inside ^= orient2d(a, b, p) > 0;
    }
    return inside;
}

/// Returns whether two bodies overlap, by brute force and not by check_simple(), which is tested.
bool overlap(const Outline& a, const Outline& b) {
    bool meet = contains(a, b[0]) || contains(b, a[0]);
    for_each_pair_of_edges(a, b,
                           [&](Point p, Point q, Point r, Point s) { meet = meet || core::segments_meet(p, q, r, s); });
    return meet;
}

/// Returns the width of the slot between two bodies, 0 where they overlap.
double slot_width(const Outline& a, const Outline& b) {
    if (overlap(a, b)) return 0;
    double width = HUGE_VAL;
    for_each_pair_of_edges(a, b, [&](Point p, Point q, Point r, Point s) {
        width = std::min({width, core::distance_to_segment(p, r, s), core::distance_to_segment(r, p, q)});
    });
    return width;
}

/// Returns the outline after it came from far away, against `direction`, until only a slot of `width` is left to the
/// nearest of the other bodies.
Outline moved_near(const Outline& outline, const std::vector<Outline>& others, Point direction, double width) {
    double near = -1, far = 2;
    for (int step = 0; step < 45; ++step) {
        const double middle = 0.5 * (near + far);
        double slot = HUGE_VAL;
        for (const Outline& other : others)
            slot = std::min(slot, slot_width(moved(outline, middle * direction), other));
        (slot > width ? far : near) = middle;
    }
    return moved(outline, far * direction);
}

/// Returns a main element with flaps behind it and perhaps a slat before it.
std::vector<Outline> high_lift_bodies(Random& random, std::string& description) {
    std::vector<Outline> bodies{random_section(random)};
    const bool slat = random.chance(0.5);
    const std::size_t flaps = random.below(3);
    double tail = 1, tail_y = 0, deflection = 0;
    for (std::size_t k = 0; k < flaps; ++k) {
        const double chord = random.uniform(0.1, 0.4), width = random.log_uniform(1e-4, 0.05);
        deflection = std::min(60.0, deflection + random.uniform(0, 45));
        const double overlap_x = random.uniform(-0.02, 0.3 * chord);
        const Outline flap = placed(random_section(random), chord, deflection, {tail - overlap_x, tail_y});
        bodies.push_back(moved_near(flap, bodies, {0, -1}, width));
        tail = bodies.back()[0].x;
        tail_y = bodies.back()[0].y;
        description += fmt::format(" flap {:.3f} at {:.1f} deg, slot {:.5f};", chord, deflection, width);
    }
    if (slat) {
        const double chord = random.uniform(0.08, 0.3), width = random.log_uniform(1e-4, 0.05),
                     angle = random.uniform(0, 60), overlap_x = random.uniform(-0.02, 0.1);
        Outline outline = placed(random_section(random), chord, -angle, {0, 0});
        outline = moved(outline, {overlap_x - outline[0].x, -outline[0].y});
        bodies.push_back(moved_near(outline, bodies, {-0.6, 0.8}, width));
        description += fmt::format(" slat {:.3f} at {:.1f} deg, slot {:.5f};", chord, angle, width);
    }
    if (bodies.size() > 1 && random.chance(0.05)) {
        const double angle = random.uniform(0, 2 * core::pi);
        bodies.back() =
            moved(bodies.back(), 0.05 * Point{core::cos_reproducible(angle), core::sin_reproducible(angle)});
        description += " last one pushed;";
    }
    return bodies;
}

/// Returns bodies side by side, or anywhere, where they may overlap.
std::vector<Outline> scattered_bodies(Random& random, std::string& description) {
    std::vector<Outline> bodies;
    const std::size_t n = 1 + random.below(4);
    const bool side_by_side = random.chance(0.5);
    while (bodies.size() < n) {
        const double size = random.log_uniform(0.05, 1);
        Outline outline = placed(random_section(random), size, random.uniform(-180, 180),
                                 {random.uniform(-1, 1), random.uniform(-0.6, 0.6)});
        if (side_by_side && !bodies.empty()) {
            const double angle = random.uniform(0, 2 * core::pi);
            outline = moved_near(moved(outline, {-outline[0].x, -outline[0].y}), bodies,
                                 {core::cos_reproducible(angle), core::sin_reproducible(angle)},
                                 random.log_uniform(1e-4, 0.3));
        }
        bodies.push_back(std::move(outline));
    }
    description += fmt::format(" {} bodies {};", n, side_by_side ? "side by side" : "anywhere");
    return bodies;
}

CaseOptions random_options(Random& random) {
    CaseOptions options;
    LayerOptions& layer = options.layer;
    layer.first_height = random.log_uniform(1e-6, 3e-3);
    layer.growth = random.uniform(1.05, 1.6);
    layer.layers = static_cast<std::uint32_t>(1 + random.below(40));
    layer.max_ray_angle_deg = random.log_uniform(2, 45);
    layer.corners = random.chance(0.7) ? CornerRays::fan : CornerRays::refine;
    layer.enabled = !random.chance(0.03);
    // Layers as thick as a good part of the chord are rarely meant.
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
    options.sizing.gradation = random.uniform(0.2, 0.5);
    options.threads = 1;
    return options;
}

/// Returns configuration `number` of the sequence of this seed.
Configuration make_configuration(std::uint64_t seed, std::uint64_t number) {
    Random random(Random(seed ^ (number * 0xd1342543de82ef95u)).bits());
    Configuration c;
    const std::vector<Outline> bodies =
        random.chance(0.7) ? high_lift_bodies(random, c.description) : scattered_bodies(random, c.description);
    // The whole configuration gets a random unit, angle of attack and place.
    const double scale = random.chance(0.3) ? random.log_uniform(1e-3, 1e3) : 1, attack = random.uniform(-20, 20);
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
    c.options.layer.first_height = input_units(test::first_height(c.options.layer) * scale);
    const LayerOptions& layer = c.options.layer;
    c.description += fmt::format(" first height {:.3g}, growth {:.3f}, {} layers, rays {:.2f} deg, {}, scale {:.3g}",
                                 test::first_height(layer), layer.growth, layer.enabled ? layer.layers.value_or(0) : 0,
                                 layer.max_ray_angle_deg, layer.corners == CornerRays::fan ? "fan" : "refine", scale);
    if (random.chance(0.3)) {
        c.options.conditions = {.alpha_deg = random.uniform(-20, 20), .reynolds = random.log_uniform(1e5, 1e8)};
        c.options.use_flow = true;
        c.description += fmt::format(", flow at {:.3g} degrees, Reynolds number {:.3g}", c.options.conditions.alpha_deg,
                                     *c.options.conditions.reynolds);
        if (layer.growth_law == GrowthLaw::geometric && layer.growth >= 1.1) c.options.layer.layers.reset();
        c.options.layer.wake_layers = random.chance(0.7) && !layer.layers;
        if (layer.wake_layers) c.description += ", wake layers";
    }
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
    std::string failure;                     ///< empty where nothing is wrong
    double min_angle_deg = 180;              ///< of the isotropic triangles
    std::size_t refused = 0, oversized = 0;  ///< as in RefineStats
    ElementCoverage coverage{};
};

/// Meshes a configuration and judges the result.
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
        if (!check.valid()) return {"invalid mesh", check.defects.front().description};
        outcome.name = "meshed";
        outcome.min_angle_deg = check.isotropic.min_angle_deg;
        outcome.refused = result.refinement.refused;
        outcome.oversized = result.refinement.oversized;
        for (const ElementCoverage& element : result.layer_coverage) outcome.coverage += element;
    } catch (const InputError& e) {
        return {"bodies refused", must_be_refused ? "" : std::string("refused sound bodies: ") + e.what()};
    } catch (const UsageError& e) {
        return {"options refused", std::strstr(e.what(), "far_field") || std::strstr(e.what(), "far field") ||
                                           std::strstr(e.what(), "resolution") ||
                                           std::strstr(e.what(), "times the extent")
                                       ? ""
                                       : std::string("refused sound options: ") + e.what()};
    } catch (const std::exception& e) {
        return {"failed", e.what()};
    }
    return outcome;
}

/// Judges configurations and prints every failure and a summary. Returns the exit status.
int run(std::uint64_t count, std::uint64_t first, std::uint64_t seed) {
    std::vector<Outcome> outcomes(count);
    core::parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Configuration c = make_configuration(seed, first + i);
            outcomes[i] = judge(c);
            if (outcomes[i].failure.empty()) continue;
            fmt::print("{} {}: {}: {}\n   {}\n", first + i, seed, outcomes[i].name, outcomes[i].failure, c.description);
            std::fflush(stdout);
        }
    });
    std::map<std::string, std::size_t> counts;
    constexpr std::array angle_bounds_deg{1.0, 5.0, 10.0, 20.0};
    std::array<std::size_t, angle_bounds_deg.size()> below{};  // meshes whose smallest angle is below each bound
    std::size_t failures = 0, left_over = 0;
    ElementCoverage coverage{};
    for (const Outcome& o : outcomes) {
        ++counts[o.name];
        failures += !o.failure.empty();
        left_over += o.refused + o.oversized > 0;
        coverage += o.coverage;
        for (std::size_t k = 0; k < below.size(); ++k) below[k] += o.min_angle_deg < angle_bounds_deg[k];
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
