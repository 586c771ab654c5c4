// Meshes for a range of angles of attack, and meshes of so many vertices or cells.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/plate.hpp>

#include "pipeline/cases.hpp"
#include "sizing/requests.hpp"

namespace lamina::test {
namespace {

CaseOptions flow_options(double reynolds) {
    CaseOptions options;
    options.conditions.reynolds = reynolds;
    options.layer.first_height = YPlus{1};
    options.layer.layers.reset();
    options.surface.max_spacing = 0.01;
    options.far_field.size = 10;
    options.use_flow = true;
    return options;
}

CaseOptions options_of_range(double reynolds, const ValueRange& range) {
    CaseOptions options = flow_options(reynolds);
    options.conditions.alphas = range;
    options.conditions.alpha_deg = values_of(range)[values_of(range).size() / 2];
    return options;
}

/// The edge of the mesh nearest to a point, as its length.
double edge_near(const Mesh& mesh, Point p) {
    double nearest = HUGE_VAL, length = 0;
    for (const Triangle& t : mesh.triangles) {
        const Point a = mesh.points[t.v[0].index()], b = mesh.points[t.v[1].index()];
        if (const double away = squared_length(midpoint(a, b) - p); away < nearest) {
            nearest = away;
            length = distance(a, b);
        }
    }
    return length;
}

TEST(AnglesOfAttack, OneMeshServesWhatEachWouldAskForAlone) {
    const Geometry geometry = shapes::geometry({naca("4412", 200)});
    const ValueRange range{0, 12, 6};
    const MeshResult all = generate_mesh(geometry, options_of_range(3e6, range));
    EXPECT_TRUE(all.check.valid());
    ASSERT_EQ(all.decisions.angles.size(), 3u);
    EXPECT_EQ(all.flow->alpha_deg, 6);
    double smallest_height = HUGE_VAL, largest_thickness = 0;
    for (const double alpha : values_of(range)) {
        CaseOptions options = flow_options(3e6);
        options.conditions.alpha_deg = alpha;
        const MeshResult alone = generate_mesh(geometry, options);
        const auto at = std::find_if(all.decisions.angles.begin(), all.decisions.angles.end(),
                                     [&](const AngleDecisions& angle) { return angle.alpha_deg == alpha; });
        ASSERT_NE(at, all.decisions.angles.end());
        EXPECT_EQ(at->first_height, alone.first_heights.front()) << alpha;
        EXPECT_EQ(at->least_thickness, alone.decisions.least_thickness) << alpha;
        EXPECT_EQ(at->lift, alone.flow->lift) << alpha;
        smallest_height = std::min(smallest_height, alone.first_heights.front());
        largest_thickness = std::max(largest_thickness, alone.decisions.least_thickness);
        // Triangles in the wake of each angle are as fine as those of the mesh for it alone.
        const Point behind = streamline(*alone.flow, alone.flow->elements[0].upper.back().at, 1).back();
        EXPECT_LT(edge_near(all.mesh, behind), 2 * edge_near(alone.mesh, behind)) << alpha;
        EXPECT_GT(all.mesh.points.size(), alone.mesh.points.size());
    }
    EXPECT_EQ(all.first_heights.front(), smallest_height);
    EXPECT_EQ(all.decisions.least_thickness, largest_thickness);
}

TEST(AnglesOfAttack, ARangeOfOneAngleIsThatAngle) {
    const Geometry geometry = shapes::geometry({naca("0012", 100)});
    CaseOptions options = flow_options(1e6);
    options.conditions.alpha_deg = 3;
    EXPECT_EQ(mesh_hash(generate_mesh(geometry, options).mesh),
              mesh_hash(generate_mesh(geometry, options_of_range(1e6, {3, 3, 1})).mesh));
}

TEST(AnglesOfAttack, WakesByHandAreAFanToo) {
    const Geometry geometry = shapes::geometry({naca("0012", 100)});
    CaseOptions options = options_of_range(1e6, {-8, 8, 8});
    options.use_flow = false;
    options.layer = {.first_height = 1e-3, .layers = 5};
    options.sizing.wakes = {{}};
    const MeshResult result = generate_mesh(geometry, options);
    for (const double alpha : {-8.0, 0.0, 8.0}) {
        const double radians = alpha * 0.017453292519943295;
        const double on_wake = edge_near(result.mesh, {1 + 1.5 * std::cos(radians), 1.5 * std::sin(radians)});
        EXPECT_LT(on_wake, 0.06) << alpha;
    }
    options.use_flow = true;
    options.layer.layers.reset();
    options.layer.wake_layers = true;
    EXPECT_THROW(generate_mesh(geometry, options), OptionError);
}

TEST(Budgets, MeshesHaveTheNumberOfVerticesOrCells) {
    for (const char* digits : {"0012", "4412"})
        for (const std::size_t wanted : {10'000u, 60'000u}) {
            CaseOptions options = flow_options(3e6);
            options.conditions.alpha_deg = 4;
            options.vertices = wanted;
            const Geometry geometry = shapes::geometry({naca(digits, 200)});
            const MeshResult result = generate_mesh(geometry, options);
            const auto vertices = static_cast<double>(result.mesh.points.size()), number = static_cast<double>(wanted);
            EXPECT_NEAR(vertices, number, 0.03 * number) << digits;
            // First heights stay, and the scale makes the mesh again.
            options.vertices.reset();
            EXPECT_EQ(result.first_heights, generate_mesh(geometry, options).first_heights);
            EXPECT_EQ(mesh_hash(result.mesh),
                      mesh_hash(generate_mesh(geometry, with_scale(options, result.scale)).mesh));
        }
    CaseOptions options = flow_options(1e6);
    options.cells = 30'000;
    const Mesh mesh = generate_mesh(shapes::geometry({naca("0012", 100)}), options).mesh;
    EXPECT_NEAR(static_cast<double>(mesh.triangles.size() + mesh.quads.size()), 30'000, 900);
    options.vertices = 100;
    EXPECT_THROW(generate_mesh(shapes::geometry({naca("0012", 100)}), options), OptionError);
    options.cells.reset();
    EXPECT_THROW(generate_mesh(shapes::geometry({naca("0012", 100)}), options), OptionError);
}

/// Counts that grow with a power of the scale stand in for meshes.
class CountedScales : public testing::TestWithParam<double> {
protected:
    double count_of(double scale) const { return 1e4 * std::pow(scale, GetParam()); }
    /// Returns the nearest, where larger scales and smaller ones than these are refused.
    ScaledMesh find(double wanted, double least_scale = 0, double largest_scale = HUGE_VAL) {
        const auto make = [&](double scale) {
            if (scale < least_scale) throw OptionError("max_ratio", "inf");
            if (scale > largest_scale) throw LimitError("max_triangles", "are exceeded", RunEstimate{});
            largest_count_ = std::max(largest_count_, count_of(scale));
            MeshResult result;
            result.scale = scale;
            return result;
        };
        return mesh_of_count(wanted, make, [&](const MeshResult& result) { return count_of(result.scale); });
    }
    double largest_count_ = 0;
};

TEST_P(CountedScales, AreFoundFromBelow) {
    for (const double wanted : {3e2, 3e3, 5e4, 4e5, 5e6}) {
        largest_count_ = 0;
        EXPECT_NEAR(find(wanted).count, wanted, 0.03 * wanted);
        if (wanted > 1e4) {
            EXPECT_LE(largest_count_, 1.03 * wanted);
        }
    }
}

TEST_P(CountedScales, ThatAreRefusedLeaveTheNearest) {
    const ScaledMesh few = find(10, 0.3), many = find(1e9, 0, 5);
    EXPECT_GE(few.scale, 0.3);
    EXPECT_LT(few.scale, 0.33);
    EXPECT_LE(many.scale, 5);
    EXPECT_GT(many.scale, 4.7);
    EXPECT_NEAR(find(count_of(4.5), 0, 5).count, count_of(4.5), 0.03 * count_of(4.5));
    EXPECT_THROW(find(1e5, 2), OptionError);
}

INSTANTIATE_TEST_SUITE_P(Powers, CountedScales, testing::Values(1.4, 1.84, 2.0));

TEST(AnglesOfAttack, AnInletHasOne) {
    CaseOptions options = options_of_range(1e6, {0, 4, 4});
    EXPECT_NO_THROW(validate(options));
    options.assemble.inlet_outlet = true;
    EXPECT_THROW(validate(options), OptionError);
}

TEST(PlateLayers, HaveTheFirstHeightOfTheirYPlus) {
    const PlateLayer layer = plate_layer({2}, 6e6, 3);
    EXPECT_NEAR(layer.first_height, 2 * 3 * 4.456878e-6, 1e-11);
    const PlateLayer back = plate_layer_of_height(layer.first_height, 6e6, 3);
    EXPECT_NEAR(back.y_plus, 2, 1e-12);
    EXPECT_NEAR(layer.skin_friction, 0.026 / std::pow(6e6, 1.0 / 7), 1e-12);
    EXPECT_GT(layer.thickness, 0.05);
    const double height = layer.first_height * (std::pow(1.2, double(layer.layers)) - 1) / 0.2;
    EXPECT_GT(height, layer.thickness);
    EXPECT_LT(height, 1.3 * layer.thickness);
    EXPECT_THROW(plate_layer({1}, 1e6, 1, 1), OptionError);
    EXPECT_THROW(plate_layer({0}, 1e6), OptionError);
}

TEST(PlateLayers, AreCountedInNoTime) {
    const double more = 0x1p-36;
    const PlateLayer many = plate_layer({1e-9}, 6e6, 1, 1 + more);
    const double height = many.first_height * std::expm1(static_cast<double>(many.layers) * std::log1p(more)) / more;
    EXPECT_NEAR(height, many.thickness, 1e-6 * many.thickness);
    EXPECT_EQ(plate_layer({1e9}, 6e6).layers, 1u);
    EXPECT_THROW(plate_layer({1e-200}, 1e200), OptionError);
    EXPECT_THROW(plate_layer({1e-310}, 1e10), OptionError);
    EXPECT_THROW(plate_layer({1e300}, 1e-10), OptionError);
}

}  // namespace
}  // namespace lamina::test
