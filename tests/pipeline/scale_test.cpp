// The unit of the input has no influence: a section written with another chord gives the same mesh, scaled.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

struct ScaleCase {
    std::string name;
    std::vector<Outline> bodies;
    CaseOptions options;
};

CaseOptions with(CaseOptions options, const auto& change) {
    change(options);
    return options;
}

/// A main element, a flap below and behind it, and a slat in front of it.
std::vector<Outline> three_bodies() {
    return {naca("2412", 80), shapes::moved(naca("0012", 60), -0.4, 0.3, {0.98, -0.03}),
            shapes::moved(naca("0010", 60), 0.5, 0.15, {-0.15, -0.1})};
}

/// Options that take every path on which a length has a say.
std::vector<ScaleCase> scale_cases() {
    const CaseOptions quick = [] {
        CaseOptions options;
        options.far_field.size = 10;
        return options;
    }();
    const auto layers_from_flow = [](CaseOptions& o) {
        o.layer.first_height = YPlus{1};
        o.layer.layers.reset();
        o.layer.growth_law = GrowthLaw::aflr;
        o.conditions.reynolds = 5e6;
    };
    const auto sizes = [](CaseOptions& o) {
        o.sizing.far_size = 2;
        o.sizing.wall_size = 0.01;
        o.sizing.wakes = {WakeOptions{.angle_deg = 5, .length = 3, .size = 0.01}};
        o.far_field.shape = FarFieldShape::circle;
        o.surface.smooth = 1e-5;
    };
    const auto adaptive = [](CaseOptions& o) {
        o.layer.growth_law = GrowthLaw::adaptive;
        o.layer.layers = 20;
        o.layer.corners = CornerRays::refine;
        o.layer.topology = LayerTopology::quads;
    };
    const auto thin = [](CaseOptions& o) {
        o.layer.growth_law = GrowthLaw::exponential;
        o.layer.layers = 20;
        o.layer.thickness = 0.01;
    };
    const auto wake_without_layers = [](CaseOptions& o) {
        o.layer.enabled = false;
        o.sizing.wakes = {WakeOptions{}};
        o.conditions.alpha_deg = 4;
    };
    return {{"default options", {naca("4412")}, quick},
            {"given points, Delaunay layer", {naca("0012")}, quick_options()},
            {"layers from the flow", {naca("2412", 80, TrailingEdge::blunt)}, with(quick, layers_from_flow)},
            {"sizes and wakes", {naca("4412")}, with(quick, sizes)},
            {"adaptive quadrilaterals", {naca("4412")}, with(quick, adaptive)},
            {"exponential growth", {naca("4412")}, with(quick, thin)},
            {"no layers", {naca("4412")}, with(quick, wake_without_layers)},
            {"three elements", three_bodies(), quick}};
}

Mesh mesh_with_chord(const ScaleCase& scale_case, double factor) {
    Geometry geometry;
    for (const Outline& body : scale_case.bodies) {
        Outline scaled = body;
        for (Point& p : scaled) p = factor * p;
        geometry.elements.push_back(shapes::geometry({scaled}).elements.front());
        geometry.elements.back().name = "body" + std::to_string(geometry.elements.size());
    }
    return generate_mesh(geometry, scale_case.options).mesh;
}

std::vector<std::size_t> corners_of(const Mesh& mesh) {
    std::vector<std::size_t> corners;
    for (const auto& triangle : mesh.triangles)
        for (const VertexId v : triangle.v) corners.push_back(v.index());
    for (const auto& quad : mesh.quads)
        for (const VertexId v : quad.v) corners.push_back(v.index());
    return corners;
}

/// Returns the largest distance between vertices of the two meshes, in chords of the first one. Precondition: they have
/// equally many.
double max_deviation(const Mesh& mesh, const Mesh& image, double factor) {
    double largest = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        largest = std::max(largest, distance(factor * mesh.points[i], image.points[i]) / factor);
    return largest;
}

/// The vertices of a mesh by where they are, in chords.
class VertexPlaces {
public:
    VertexPlaces(const Mesh& mesh, double factor) {
        for (std::size_t i = 0; i < mesh.points.size(); ++i) vertices_[box_of((1 / factor) * mesh.points[i])] = i;
    }
    /// Returns the vertex within the tolerance of a place, or nothing.
    std::optional<std::size_t> find(Point p) const {
        const auto [column, row] = box_of(p);
        for (std::int64_t dx = -1; dx <= 1; ++dx)
            for (std::int64_t dy = -1; dy <= 1; ++dy)
                if (const auto found = vertices_.find({column + dx, row + dy}); found != vertices_.end())
                    return found->second;
        return {};
    }

private:
    static constexpr double tolerance = 1e-9;
    using Box = std::pair<std::int64_t, std::int64_t>;
    static Box box_of(Point p) { return {std::llround(p.x / tolerance), std::llround(p.y / tolerance)}; }
    std::map<Box, std::size_t> vertices_;
};

/// Returns the cells of a mesh as sorted lists of corners, which may have other numbers.
std::vector<std::vector<std::size_t>> cells_of(const Mesh& mesh, const std::vector<std::size_t>& numbers) {
    std::vector<std::vector<std::size_t>> cells;
    const auto add = [&](const auto& cell) {
        std::vector<std::size_t>& corners = cells.emplace_back();
        for (const VertexId v : cell.v) corners.push_back(numbers[v.index()]);
        std::sort(corners.begin(), corners.end());
    };
    for (const auto& triangle : mesh.triangles) add(triangle);
    for (const auto& quad : mesh.quads) add(quad);
    std::sort(cells.begin(), cells.end());
    return cells;
}

/// Returns whether another factor gives the same cells between vertices at the same places, within rounding; only the
/// same vertices where layers are Delaunay. Symmetric meshes may number them otherwise.
bool has_same_cells(const ScaleCase& scale_case, const Mesh& mesh, double factor) {
    const Mesh image = mesh_with_chord(scale_case, factor);
    if (image.points.size() != mesh.points.size()) return false;
    const VertexPlaces places(mesh, 1);
    std::vector<std::size_t> numbers, own(mesh.points.size());
    std::iota(own.begin(), own.end(), std::size_t{0});
    for (const Point p : image.points) {
        const std::optional<std::size_t> vertex = places.find((1 / factor) * p);
        if (!vertex) return false;
        numbers.push_back(*vertex);
    }
    // Of a trapezoid with equal sides, rounding decides which diagonal is Delaunay.
    if (scale_case.options.layer.topology == LayerTopology::delaunay) return true;
    return cells_of(image, numbers) == cells_of(mesh, own);
}

void expect_exact_scaling(const ScaleCase& scale_case) {
    SCOPED_TRACE(scale_case.name);
    const Mesh mesh = mesh_with_chord(scale_case, 1);
    for (const double factor : {256.0, 0.25, 0x1p-20}) {
        SCOPED_TRACE(factor);
        const Mesh image = mesh_with_chord(scale_case, factor);
        ASSERT_EQ(corners_of(image), corners_of(mesh));
        EXPECT_EQ(max_deviation(mesh, image, factor), 0);
    }
}

TEST(UnitOfTheInput, PowersOfTwoScaleTheMeshExactly) {
    for (const ScaleCase& scale_case : scale_cases()) expect_exact_scaling(scale_case);
}

CaseOptions options_from_flow() {
    CaseOptions options;
    options.far_field.size = 10;
    options.conditions = {.alpha_deg = 6, .reynolds = 5e6};
    options.layer.first_height = YPlus{1};
    options.layer.layers.reset();
    options.use_flow = true;
    return options;
}

TEST(UnitOfTheInput, PowersOfTwoScaleWhatTheFlowDecides) {
    expect_exact_scaling({"three elements", three_bodies(), options_from_flow()});
}

/// Counts the pairs of a case and another factor, and those that have the same cells.
struct FactorCount {
    int all = 0, same = 0;

    void add(const ScaleCase& scale_case) {
        const Mesh mesh = mesh_with_chord(scale_case, 1);
        for (const double factor : {300.0, 0.3048}) {
            ++all;
            same += has_same_cells(scale_case, mesh, factor);
        }
    }
};

/// Other factors round every coordinate, which no decision may hang on. One value in a hundred thousand lies so near to
/// where rounding to fewer bits begins to choose the other neighbour that rounding errors decide after all, and meshes
/// have as many (docs/decisions/0062).
TEST(UnitOfTheInput, OtherFactorsKeepNearlyAllMeshes) {
    FactorCount count;
    for (const ScaleCase& scale_case : scale_cases()) count.add(scale_case);
    EXPECT_GE(count.same, 0.9 * count.all);
}

TEST(UnitOfTheInput, OtherFactorsKeepNearlyAllThatTheFlowDecides) {
    FactorCount count;
    for (const std::string digits : {"0009", "0018", "2412", "4409", "4418"})
        for (const TrailingEdge tail : {TrailingEdge::sharp, TrailingEdge::blunt})
            count.add({digits, {naca(digits, 80, tail)}, options_from_flow()});
    EXPECT_GE(count.same, 0.9 * count.all);
}

/// So does a change of the last bit of coordinates, such as other digits of a file.
TEST(UnitOfTheInput, LastBitsKeepTheMesh) {
    const ScaleCase given{"given", {naca("2412")}, options_from_flow()};
    ScaleCase changed = given;
    int i = 0;
    for (Point& p : changed.bodies[0]) {
        p = {(1 + 0x1p-52 * (i % 3)) * p.x, (1 + 0x1p-52 * (i % 2)) * p.y};
        ++i;
    }
    const Mesh mesh = mesh_with_chord(given, 1), image = mesh_with_chord(changed, 1);
    ASSERT_EQ(corners_of(image), corners_of(mesh));
    EXPECT_LT(max_deviation(mesh, image, 1), 1e-10);
}

/// A region whose border has no four cocircular points, so that no tie depends on rounding.
TEST(UnitOfTheInput, RefinementCountsItsUnitOfLength) {
    constexpr std::size_t n = 61;
    const auto refined = [](double factor, std::optional<double> unit) {
        std::vector<Point> border;
        std::vector<Segment> sides;
        std::vector<SizeSource> sources;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 6.283185307179586 * (static_cast<double>(i) + 0.2 * std::sin(7.3 * double(i))) / n;
            const double radius = factor * (1 + 0.03 * std::sin(3.7 * static_cast<double>(i)));
            border.push_back({radius * std::cos(angle), radius * std::sin(angle)});
            sides.push_back({VertexId(i), VertexId((i + 1) % n)});
        }
        for (std::size_t i = 0; i < n; ++i) {
            const Point a = border[i], b = border[(i + 1) % n];
            sources.push_back({.a = a, .b = b, .size = distance(a, b)});
        }
        const Point corner{1.1 * factor, 1.1 * factor};
        const SizeField size(sources, {.gradation = 0.1}, {-1 * corner, corner});
        return refine(border, sides, size, {.unit_length = unit});
    };
    const Refinement one = refined(1, {}), many = refined(300, 300);
    ASSERT_EQ(many.triangles.size(), one.triangles.size());
    for (std::size_t t = 0; t < one.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) ASSERT_EQ(many.triangles[t].v[i], one.triangles[t].v[i]);
    double largest = 0, largest_without_unit = 0;
    const Refinement without_unit = refined(300, {});
    for (std::size_t i = 0; i < one.steiner_points.size(); ++i) {
        largest = std::max(largest, distance(300 * one.steiner_points[i], many.steiner_points[i]) / 300);
        if (i < without_unit.steiner_points.size())
            largest_without_unit = std::max(
                largest_without_unit, distance(300 * one.steiner_points[i], without_unit.steiner_points[i]) / 300);
    }
    EXPECT_LT(largest, 1e-12);
    EXPECT_GT(largest_without_unit, 1e-10) << "sizes of single precision are rounded otherwise";
}

TEST(UnitOfTheInput, LengthsInUnitsAndAGivenChordMeanTheSame) {
    CaseOptions chords;
    chords.far_field.size = 10;
    chords.layer.first_height = 1e-4;
    chords.layer.thickness = 0.02;
    chords.sizing.far_size = 3;
    chords.sizing.wakes = {WakeOptions{.angle_deg = 2, .length = 2, .size = 0.02}};
    CaseOptions units = chords;
    units.far_field.size = input_units(40);
    units.layer.first_height = input_units(4e-4);
    units.layer.thickness = input_units(0.08);
    units.sizing.far_size = input_units(12);
    units.sizing.wakes = {WakeOptions{.angle_deg = 2, .length = input_units(8), .size = input_units(0.08)}};
    CaseOptions halved = chords;  // a chord twice as long, and half the numbers
    halved.conditions.chord = 8;
    halved.far_field.size = 5;
    halved.layer.first_height = 5e-5;
    halved.layer.thickness = 0.01;
    halved.sizing.far_size = 1.5;
    halved.sizing.wakes = {WakeOptions{.angle_deg = 2, .length = 1, .size = 0.01}};
    const ScaleCase by_chords{"", {naca("2412")}, chords}, by_units{"", {naca("2412")}, units},
        by_other_chord{"", {naca("2412")}, halved};
    const std::string hash = mesh_hash(mesh_with_chord(by_chords, 4));
    EXPECT_EQ(mesh_hash(mesh_with_chord(by_units, 4)), hash);
    EXPECT_EQ(mesh_hash(mesh_with_chord(by_other_chord, 4)), hash);
}

TEST(UnitOfTheInput, TheFlowTurnsWithTheAngleOfAttackAndNotTheSection) {
    CaseOptions options;
    options.far_field.size = 10;
    const ScaleCase level{"", {naca("2412")}, options};
    ScaleCase raised = level;
    raised.options.conditions.alpha_deg = 6;
    EXPECT_EQ(mesh_hash(mesh_with_chord(raised, 1)), mesh_hash(mesh_with_chord(level, 1)));
    // A wake without an angle follows the flow.
    ScaleCase with_angle = level;
    raised.options.sizing.wakes = {WakeOptions{}};
    with_angle.options.sizing.wakes = {WakeOptions{.angle_deg = 6}};
    EXPECT_EQ(mesh_hash(mesh_with_chord(raised, 1)), mesh_hash(mesh_with_chord(with_angle, 1)));
}

}  // namespace
}  // namespace lamina::test
