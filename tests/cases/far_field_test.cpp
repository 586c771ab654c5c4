// farField.awk, which gives the far field of OpenFOAM's case the vortex of the lift.
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/case_fixtures.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::numbers_in;
using test::TemporaryFolder;

/// Returns a field as OpenFOAM writes it, with a uniform or a nonuniform value on each of the patches.
std::string field(const std::string& type, const std::string& wall_value, const std::string& far_value) {
    return "FoamFile\n{\n    class       " + type +
           ";\n}\n\ninternalField   nonuniform List<scalar>\n3\n(\n1\n2\n3\n)\n;\n\nboundaryField\n{\n    wall\n    {\n"
           "        type            noSlip;\n        freestreamValue " +
           wall_value + ";\n    }\n    farfield\n    {\n        type            freestreamVelocity;\n        " +
           "freestreamValue " + far_value + ";\n        value           uniform (0 0 0);\n    }\n}\n";
}

/// Runs the script on a case, with further variables, and returns what it prints.
std::string with_vortex(const TemporaryFolder& folder, const std::string& text, const std::string& variables = "") {
    folder.write("case/field", text);
    const std::string command = "cd '" + (folder / "case").string() +
                                "' && awk -v patches=farfield -v speed=2 -v alpha=30 -v circulation=3 -v x0=0.1 -v "
                                "y0=-0.2 " +
                                variables +
                                " -f system/farField.awk constant/polyMesh/boundary constant/polyMesh/points "
                                "constant/polyMesh/faces field > new";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return folder.read("case/new");
}

/// Returns the list of values of the far field, which begins with its length.
std::vector<double> far_values(const std::string& text) {
    const std::size_t begin = text.find("nonuniform", text.find("farfield"));
    EXPECT_NE(begin, std::string::npos);
    return numbers_in(text.substr(begin, text.find(';', begin) - begin));
}

TEST(FarField, HasTheStreamTheVortexAndItsPressure) {
    const TemporaryFolder folder;
    const Mesh mesh = test::case_mesh();
    write_solver_case(FlowSolver::openfoam, mesh, test::some_conditions(), folder / "case");
    const std::string wall = "uniform (7 8 9)";
    const std::string velocities = with_vortex(folder, field("volVectorField", wall, "uniform (1 0 0)"));
    // The file that the script wrote is what it reads the next time.
    EXPECT_EQ(with_vortex(folder, velocities), velocities);
    const std::string pressures = with_vortex(folder, field("volScalarField", wall, "uniform 0"));

    const std::vector<Segment>& edges = mesh.markers[1].edges;
    const auto velocity = far_values(velocities), pressure = far_values(pressures);
    ASSERT_EQ(velocity.size(), 1 + 3 * edges.size());
    ASSERT_EQ(pressure.size(), 1 + edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Point middle = 0.5 * (mesh.points[edges[i].a.index()] + mesh.points[edges[i].b.index()]);
        const Point from = middle - Point{0.1, -0.2};
        const double vortex = 3 / (2 * std::numbers::pi * dot(from, from));
        const double u = 2 * std::cos(std::numbers::pi / 6) + vortex * from.y, v = 1 - vortex * from.x;
        EXPECT_NEAR(velocity[1 + 3 * i], u, 1e-10);
        EXPECT_NEAR(velocity[2 + 3 * i], v, 1e-10);
        EXPECT_EQ(velocity[3 + 3 * i], 0);
        // Bernoulli: the pressure far away is 0.
        EXPECT_NEAR(pressure[1 + i] + (u * u + v * v) / 2, 2, 1e-10);
    }
    // Everything else stays.
    EXPECT_NE(velocities.find("freestreamValue " + wall), std::string::npos);
    EXPECT_NE(velocities.find("value           uniform (0 0 0);"), std::string::npos);
    EXPECT_NE(velocities.find("List<scalar>\n3\n(\n1\n2\n3\n)"), std::string::npos);
}

// The linear equation of subsonic flow, (1 - M^2) u_x + v_y = 0 with x along the stream, and the same entropy and total
// enthalpy everywhere.
TEST(FarField, OfAGasObeysPrandtlsAndGlauertsEquation) {
    const TemporaryFolder folder;
    const Mesh mesh = test::case_mesh();
    SolverConditions conditions = test::some_conditions();
    conditions.reference.mach = 0.6;
    write_solver_case(FlowSolver::openfoam, mesh, conditions, folder / "case", {.compressible = true});
    const double upstream = 2 * 2 / (1.4 * 0.6 * 0.6);  // of density 1 at the speed 2
    const std::string gas = fmt::format("-v mach=0.6 -v pressure={}", upstream);
    const auto velocity = far_values(with_vortex(folder, field("volVectorField", "uniform (7 8 9)", "uniform 0"), gas));
    const auto pressure = far_values(with_vortex(folder, field("volScalarField", "uniform 1", "uniform 0"), gas));
    const auto beside = far_values(with_vortex(folder, field("volVectorField", "uniform 1", "uniform 0"), "-v mach=0"));
    const std::vector<Segment>& edges = mesh.markers[1].edges;
    ASSERT_EQ(velocity.size(), 1 + 3 * edges.size());
    const Point along{std::cos(std::numbers::pi / 6), 0.5}, across{-0.5, std::cos(std::numbers::pi / 6)};
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Point u{velocity[1 + 3 * i], velocity[2 + 3 * i]};
        const Point swirl = u - 2 * along, round = Point{beside[1 + 3 * i], beside[2 + 3 * i]} - 2 * along;
        // The potential is that of the incompressible vortex with distances across the stream shrunk by b. Its velocity
        // is along that of the incompressible vortex, and their ratio b r^2 / (x^2 + b^2 y^2).
        const Point from = 0.5 * (mesh.points[edges[i].a.index()] + mesh.points[edges[i].b.index()]) - Point{0.1, -0.2};
        const double x = dot(from, along), y = dot(from, across), b = 0.8;
        EXPECT_NEAR(cross(swirl, round), 0, 1e-10);
        EXPECT_NEAR(length(swirl) / length(round), b * dot(from, from) / (x * x + b * b * y * y), 1e-8);
        // Total enthalpy: a^2 / 0.4 + u^2 / 2, with a^2 = 1.4 p / rho and rho = (p / upstream)^(1 / 1.4).
        const double p = pressure[1 + i], density = std::pow(p / upstream, 1 / 1.4);
        EXPECT_NEAR(3.5 * p / density + dot(u, u) / 2, 3.5 * upstream + 2, 1e-8);
    }
}

// compress.awk turns pressures of an incompressible flow into those of a gas.
TEST(Compress, AddsThePressureOfTheFreeStreamAndKeepsTheRest) {
    const TemporaryFolder folder;
    SolverConditions conditions = test::some_conditions();
    conditions.reference.mach = 0.2;
    write_solver_case(FlowSolver::openfoam, test::case_mesh(), conditions, folder / "case", {.compressible = true});
    folder.write("case/p",
                 "dimensions      [0 2 -2 0 0 0 0];\n\n" +
                     field("volScalarField", "uniform -1.5", "nonuniform List<scalar>\n2\n(\n0.25\n-20\n)\n"));
    const std::string command =
        "cd '" + (folder / "case").string() + "' && awk -v pressure=10 -f system/compress.awk p > new";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string gas = folder.read("case/new");
    for (const char* part :
         {"dimensions      [1 -1 -2 0 0 0 0];", "List<scalar>\n3\n(\n11\n12\n13\n)\n;", "freestreamValue uniform 8.5;",
          "List<scalar>\n2\n(\n10.25\n2\n)\n;", "noSlip;", "class       volScalarField;"})
        EXPECT_NE(gas.find(part), std::string::npos) << part << "\n" << gas;
}

}  // namespace
}  // namespace lamina
