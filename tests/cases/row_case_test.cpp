// Cases of rows of blades.
#include <gtest/gtest.h>

#include <cmath>

#include <lamina/error.hpp>

#include "cases/case_files.hpp"
#include "cases/case_fixtures.hpp"

namespace lamina {
namespace {

/// Returns a square plate in a square whose borders below and above are periodic.
Mesh row_mesh() {
    Mesh mesh{.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}}};
    const auto v = [](std::size_t i) { return VertexId(i); };
    for (std::size_t i = 0; i < 4; ++i) mesh.quads.push_back({{v(i), v((i + 1) % 4), v(4 + (i + 1) % 4), v(4 + i)}});
    Marker wall{"blade", MarkerKind::wall, {}};
    for (std::size_t i = 0; i < 4; ++i) wall.edges.push_back({v(4 + (i + 1) % 4), v(4 + i)});
    mesh.markers = {wall,
                    {"inlet", MarkerKind::far_field, {{v(3), v(0)}}},
                    {"outlet", MarkerKind::far_field, {{v(1), v(2)}}},
                    {"periodic_lower", MarkerKind::periodic, {{v(0), v(1)}}},
                    {"periodic_upper", MarkerKind::periodic, {{v(2), v(3)}}}};
    return mesh;
}

TEST(CaseOfARow, HasInletAndOutletInOpenfoam) {
    const auto files = cases::solver_case_files(FlowSolver::openfoam, row_mesh(), test::some_conditions(45), {});
    const std::string velocity = test::text_of(files, "0/U"), pressure = test::text_of(files, "0/p");
    for (const std::string name : {"0/U", "0/p", "0/nut", "0/nuTilda"})
        for (const std::string border : {"periodic_lower", "periodic_upper"})
            EXPECT_NE(test::text_of(files, name).find(border + "\n    {\n        type            cyclic;"),
                      std::string::npos)
                << name;
    EXPECT_NE(velocity.find("inlet\n    {\n        type            fixedValue;"), std::string::npos);
    EXPECT_NE(pressure.find("outlet\n    {\n        type            fixedValue;"), std::string::npos);
    EXPECT_EQ(velocity.find("freestream"), std::string::npos);
    const std::string run = test::text_of(files, "Allrun");
    EXPECT_NE(run.find("vortex=no"), std::string::npos);
    EXPECT_NE(run.find("angles=\"45\""), std::string::npos);
}

TEST(CaseOfARow, HasTotalConditionsInSu2) {
    SolverConditions conditions = test::some_conditions(30);
    conditions.reference.mach = 0.3;
    const std::string text =
        test::text_of(cases::solver_case_files(FlowSolver::su2, row_mesh(), conditions, {}), "case.cfg");
    const auto numbers = [&](const std::string& key) {
        return test::numbers_in(
            text.substr(text.find("\n" + key), text.find('\n', text.find("\n" + key) + 1) - text.find("\n" + key)));
    };
    const std::vector<double> inlet = numbers("MARKER_INLET="), outlet = numbers("MARKER_OUTLET=");
    ASSERT_EQ(inlet.size(), 5u);
    EXPECT_NEAR(inlet[0], 300 * 1.018, 1e-9);
    EXPECT_NEAR(inlet[2], std::cos(std::acos(-1.0) / 6), 1e-9);
    EXPECT_NEAR(inlet[3], 0.5, 1e-9);
    ASSERT_EQ(outlet.size(), 1u);
    // The stream is wider behind the plate than ahead of it, so it is slower, and its pressure higher.
    const double ahead = inlet[1] / std::pow(1.018, 3.5);
    EXPECT_GT(outlet[0], ahead);
    EXPECT_LT(outlet[0], inlet[1]);
    const std::vector<double> borders = numbers("MARKER_PERIODIC=");
    ASSERT_EQ(borders.size(), 9u);
    EXPECT_EQ(borders[7], 3);
    EXPECT_EQ(text.find("MARKER_FAR"), std::string::npos);
}

TEST(CaseOfARow, NeedsInletAndOutlet) {
    Mesh mesh = row_mesh();
    mesh.markers[1].name = "front";
    EXPECT_THROW(cases::solver_case_files(FlowSolver::openfoam, mesh, test::some_conditions(), {}), MeshError);
}

TEST(CaseOfARow, NeedsABlade) {
    Mesh mesh = row_mesh();
    mesh.markers.front().edges.clear();
    EXPECT_THROW(cases::solver_case_files(FlowSolver::openfoam, mesh, test::some_conditions(), {}), MeshError);
}

}  // namespace
}  // namespace lamina
