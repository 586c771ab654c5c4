// farField.awk, which gives the far field of OpenFOAM's case the vortex of the lift.
#include <cmath>
#include <cstdlib>
#include <numbers>

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

/// Runs the script on a case and returns what it prints.
std::string with_vortex(const TemporaryFolder& folder, const std::string& text) {
    folder.write("case/field", text);
    const std::string command = "cd '" + (folder / "case").string() +
                                "' && awk -v patches=farfield -v speed=2 -v alpha=30 -v circulation=3 -v x0=0.1 -v "
                                "y0=-0.2 -f system/farField.awk constant/polyMesh/boundary constant/polyMesh/points "
                                "constant/polyMesh/faces field > new";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return folder.read("case/new");
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

    const auto list_of = [](const std::string& text) {
        const std::size_t begin = text.find("nonuniform", text.find("farfield"));
        EXPECT_NE(begin, std::string::npos);
        return text.substr(begin, text.find(';', begin) - begin);
    };
    const std::vector<Segment>& edges = mesh.markers[1].edges;
    const auto velocity = numbers_in(list_of(velocities)), pressure = numbers_in(list_of(pressures));
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

}  // namespace
}  // namespace lamina
