// The options of all stages: the table, and the refusal of values out of range by the library itself.
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/option.hpp>
#include <lamina/pipeline.hpp>

#include "layers/layer.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

/// Returns the name of the option that the call refuses; empty if it refuses none.
template <class Call>
std::string refused_option(Call&& call) {
    try {
        call();
    } catch (const OptionError& error) {
        EXPECT_NE(error.reason(), "");
        return error.option();
    }
    return "";
}

template <class Options>
std::string refused_by_validate(const Options& options) {
    return refused_option([&] { validate(options); });
}

TEST(CaseOptions, DefaultsAreValidAndEveryRowCanBeReadAndSet) {
    EXPECT_EQ(refused_by_validate(CaseOptions{}), "");
    std::set<std::string> names;
    for (const Option<CaseOptions>& option : option_table<CaseOptions>()) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name << " stands in the table twice";
        EXPECT_NE(option.help, "") << option.name;
        EXPECT_NE(option.group, "") << option.name;
        CaseOptions options;
        const std::optional<OptionValue> value = option.get(options);
        if (!value) continue;
        EXPECT_NO_THROW(option.set(options, *value)) << option.name;
        EXPECT_EQ(option.get(options), value) << option.name;
    }
}

TEST(CaseOptions, RowsThatExcludeOrNeedOthersNameRows) {
    std::set<std::string> names;
    for (const Option<CaseOptions>& option : option_table<CaseOptions>()) names.insert(option.name);
    for (const Option<CaseOptions>& option : option_table<CaseOptions>()) {
        for (const std::string& other : option.excludes) EXPECT_EQ(names.count(other), 1u) << option.name;
        for (const std::string& other : option.needs) EXPECT_EQ(names.count(other), 1u) << option.name;
    }
}

TEST(CaseOptions, RowsRefuseWhatIsNoNumberOrHasAnotherType) {
    for (const Option<CaseOptions>& option : option_table<CaseOptions>()) {
        CaseOptions options;
        const auto refused = [&](const OptionValue& value) {
            return refused_option([&] { option.set(options, value); }) == option.key();
        };
        std::vector<OptionValue> wrong;
        if (option.kind == OptionKind::number)
            wrong = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                     std::string("many"), true};
        if (option.kind == OptionKind::number_or_word)
            wrong = {std::numeric_limits<double>::quiet_NaN(), -1.0, std::string(), true};
        if (option.kind == OptionKind::length)
            wrong = {std::numeric_limits<double>::quiet_NaN(),
                     -1.0,
                     std::string("many"),
                     std::string("u"),
                     std::string("-1u"),
                     std::string("infu"),
                     true};
        if (option.kind == OptionKind::count) wrong = {2.5, std::string("many"), true};
        if (option.kind == OptionKind::flag) wrong = {1.0, std::string("yes")};
        for (std::size_t i = 0; i < wrong.size(); ++i)
            EXPECT_TRUE(refused(wrong[i])) << option.name << " takes value " << i;
    }
}

TEST(CaseOptions, ValidateFindsTheOptionOfAnyStage) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](auto&& change) {
        CaseOptions options;
        change(options);
        return refused_by_validate(options);
    };
    EXPECT_EQ(refused([](CaseOptions& o) { o.refine.min_angle_deg = 0; }), "min_angle");
    EXPECT_EQ(refused([](CaseOptions& o) { o.refine.min_angle_deg = 45; }), "min_angle");
    EXPECT_EQ(refused([](CaseOptions& o) { o.threads = 2000; }), "threads");
    EXPECT_EQ(refused([&](CaseOptions& o) { o.layer.growth = nan; }), "growth");
    EXPECT_EQ(refused([](CaseOptions& o) { o.layer.first_height = -1.0; }), "first_height");
    EXPECT_EQ(refused([](CaseOptions& o) { o.layer.first_height = YPlus{1}; }), "y_plus");
    EXPECT_EQ(refused([](CaseOptions& o) { o.layer.first_height = input_units(0); }), "first_height");
    EXPECT_EQ(refused([](CaseOptions& o) { o.conditions.reynolds = 0; }), "reynolds");
    EXPECT_EQ(refused([](CaseOptions& o) { o.conditions.velocity = 30; }), "velocity");
    EXPECT_EQ(refused([](CaseOptions& o) { o.conditions.viscosity = 1e-5; }), "viscosity");
    EXPECT_EQ(refused([](CaseOptions& o) { o.conditions = {.reynolds = 1e6, .velocity = 30, .viscosity = 1e-5}; }),
              "reynolds");
    EXPECT_EQ(refused([](CaseOptions& o) { o.layer.growth_law = GrowthLaw::exponential; }), "layers");
    EXPECT_EQ(refused([](CaseOptions& o) {
                  o.layer.growth_law = GrowthLaw::exponential;
                  o.layer.layers = 30;
              }),
              "thickness");
    EXPECT_EQ(refused([](CaseOptions& o) { o.layer.max_ray_angle_deg = 0; }), "max_ray_angle");
    EXPECT_EQ(refused([&](CaseOptions& o) { o.sizing.gradation = nan; }), "gradation");
    EXPECT_EQ(refused([](CaseOptions& o) { o.far_field.size = 0; }), "far_field");
    EXPECT_EQ(refused([](CaseOptions& o) { o.decoupling.pieces_target = 1; }), "pieces_target");
    EXPECT_EQ(refused([](CaseOptions& o) { o.decomposition.depth = 100; }), "depth");
    EXPECT_EQ(refused([](CaseOptions& o) { o.decomposition.leaf_vertices = 0; }), "leaf_vertices");
    EXPECT_EQ(refused([](CaseOptions& o) { o.surface.max_ratio = 0.5; }), "max_ratio");
}

// Without a layer its options are not looked at, so that a case file can switch it off and keep the rest.
TEST(CaseOptions, OptionsOfALayerThatIsOffAreNotChecked) {
    CaseOptions options;
    options.layer.enabled = false;
    options.layer.growth = 0.5;
    EXPECT_EQ(refused_by_validate(options), "");
}

TEST(StageOptions, EveryStageRefusesValuesOutOfRangeByItself) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Point> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<Segment> sides;
    for (std::size_t i = 0; i < 4; ++i) sides.push_back({VertexId(i), VertexId((i + 1) % 4)});
    const Geometry body = shapes::geometry({shapes::circle(0.5, 40)});

    EXPECT_EQ(refused_option([&] { triangulate(corners, DecompositionOptions{.depth = 100}); }), "depth");
    for (double bound : {-1.0, 40.0, 60.0, nan})
        EXPECT_EQ(refused_option([&] { refine(corners, sides, SizeField(0.2), {.min_angle_deg = bound}); }),
                  "min_angle");
    // The kernel alone may refine without a bound.
    EXPECT_FALSE(refine(corners, sides, SizeField(0.2), {.min_angle_deg = 0}).triangles.empty());
    EXPECT_EQ(refused_option([&] { layers::make_layer(body, {.growth = nan}); }), "growth");
    EXPECT_EQ(refused_option([&] { prepare_surfaces(body, {.max_ratio = 1}); }), "max_ratio");
    EXPECT_EQ(refused_option([&] { check_mesh(Mesh{}, {.min_angle_deg = nan}); }), "min_angle");
    EXPECT_EQ(refused_option([&] { generate_mesh(body, {.threads = 5000}); }), "threads");
}

}  // namespace
}  // namespace lamina
