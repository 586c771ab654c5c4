// Slots far narrower than the bodies beside them.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include <lamina/presets.hpp>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

/// Returns two plates with a gap between them.
std::vector<shapes::Outline> plates(double gap) {
    return {{{1, 0}, {1, 0.05}, {0, 0.05}, {0, 0}}, {{1, -0.05 - gap}, {1, -gap}, {0, -gap}, {0, -0.05 - gap}}};
}

/// Returns a plate with slots in its upper side, counter-clockwise.
shapes::Outline comb(double gap, double depth, int teeth) {
    constexpr double pitch = 0.2, back = 0.1;
    const double length = teeth * pitch - gap;
    shapes::Outline outline{{0, -back}, {length, -back}, {length, depth}};
    for (int tooth = teeth - 1; tooth > 0; --tooth) {
        const double right = tooth * pitch, left = right - gap;
        outline.insert(outline.end(), {{right, depth}, {right, 0}, {left, 0}, {left, depth}});
    }
    outline.push_back({0, depth});
    return outline;
}

/// The border's edges in a gap are as long as the gap is wide. The run is refused before there are rays.
TEST(Slots, GapsThatAskForTooMuchAreRefusedBeforeTheLayer) {
    CaseOptions options;
    const auto refuse = [&](const std::vector<shapes::Outline>& bodies) {
        Geometry geometry;
        for (const shapes::Outline& body : bodies) geometry.elements.push_back(shapes::geometry({body}).elements[0]);
        std::string last_stage;
        try {
            generate_mesh(geometry, options, [&](const ProgressEvent& event) { last_stage = event.stage; });
            ADD_FAILURE();
        } catch (const LimitError& error) {
            EXPECT_EQ(error.option(), "transform");
            EXPECT_NE(std::string(error.what()).find("gap"), std::string::npos) << error.what();
        }
        EXPECT_EQ(last_stage, "surface");
    };
    refuse(plates(1e-6));
    refuse(plates(1e-7));
    refuse({comb(2e-7, 0.2, 2)});
    options.limits.max_memory_bytes = std::size_t{1} << 30;
    refuse(plates(1e-5));
    options.limits = {.max_triangles = 100'000};
    refuse(plates(1e-5));
}

/// In slots with one row of triangles, thinner layers move a triangle below the bound along the slot. Shorter edges of
/// the border mend it.
TEST(Slots, OfCombsKeepTheBoundOfAngles) {
    CaseOptions options = preset_options("rans", true);
    options.conditions.reynolds = 1e6;
    for (const shapes::Outline& outline : {comb(0.001, 0.2, 6), comb(0.0005, 0.05, 9), comb(0.002, 0.4, 9)}) {
        const MeshResult result = mesh_of({outline}, options);
        EXPECT_TRUE(result.check.unexcused_cells.empty());
        EXPECT_TRUE(check_mesh(result.mesh).valid());
    }
}

}  // namespace
}  // namespace lamina::test
