// The files of PyFR's case. PyFR is not at hand where tests run: docs/recipes/high-order.md says what it made of them.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "cases/case_files.hpp"
#include "cases/case_fixtures.hpp"
#include "support/curved_cell.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::case_mesh;
using test::some_conditions;

using Section = std::map<std::string, std::string>;

/// Returns the sections of a configuration. Fails where one, or an option of it, is there twice.
std::map<std::string, Section> sections_in(const std::string& text) {
    std::map<std::string, Section> sections;
    std::istringstream lines(text);
    std::string section;
    for (std::string line; std::getline(lines, line);) {
        std::smatch parts;
        if (line.empty() || line.starts_with(';')) continue;
        if (std::regex_match(line, parts, std::regex("\\[(.*)\\]"))) {
            section = parts[1];
            EXPECT_TRUE(sections.try_emplace(section).second) << line;
        } else {
            EXPECT_TRUE(std::regex_match(line, parts, std::regex("([A-Za-z-]+) = (.+)"))) << line;
            EXPECT_TRUE(sections[section].emplace(parts[1], parts[2]).second) << line;
        }
    }
    return sections;
}

SolverConditions laminar_conditions() {
    SolverConditions conditions = some_conditions();
    conditions.reference.reynolds = 5000;
    conditions.reference.mach = 0.5;
    return conditions;
}

std::map<std::string, Section> pyfr_sections(const Mesh& mesh, const SolverCaseOptions& options = {},
                                             unsigned order = 3) {
    return sections_in(test::text_of(
        cases::solver_case_files(FlowSolver::pyfr, mesh, laminar_conditions(), options, order), "case.ini"));
}

TEST(PyfrCase, SaysTheFlow) {
    auto sections = pyfr_sections(case_mesh());
    EXPECT_EQ(sections["solver"]["system"], "navier-stokes");
    EXPECT_EQ(sections["solver"]["order"], "3");
    EXPECT_DOUBLE_EQ(std::stod(sections["constants"]["mu"]), 2.0 / 5000);  // density, speed and chord are 1, 1 and 2
    EXPECT_EQ(sections["soln-bcs-wall"]["type"], "no-slp-adia-wall");
    Section& far = sections["soln-bcs-farfield"];
    EXPECT_EQ(far["type"], "char-riem-inv");
    const double u = std::stod(far["u"]), v = std::stod(far["v"]), p = std::stod(far["p"]);
    EXPECT_NEAR(u * u + v * v, 1, 1e-14);
    EXPECT_NEAR(v / u, std::tan(10 * 0x1.921fb54442d18p+1 / 180), 1e-14);
    EXPECT_NEAR(1 / std::sqrt(1.4 * p), 0.5, 1e-14);
    for (const char* name : {"u", "v", "p", "rho"}) EXPECT_EQ(sections["soln-ics"][name], far[name]);
    EXPECT_EQ(sections["soln-plugin-fluidforce-wall"]["file"], "forces-wall.csv");
    EXPECT_EQ(sections["solver-time-integrator"]["tend"], sections["soln-plugin-writer"]["dt-out"]);
    const std::string gust = pyfr_sections(case_mesh(), {.unsteady = true})["soln-ics"]["u"];
    EXPECT_NE(gust.find("exp("), std::string::npos);
    EXPECT_EQ(gust.find('^'), std::string::npos) << "PyFR takes powers by pow alone";
}

/// The first step falls with the cells and with the order.
TEST(PyfrCase, BeginsWithAStepForItsSmallestCell) {
    const auto step = [&](const Mesh& mesh, unsigned order) {
        return std::stod(pyfr_sections(mesh, {}, order)["solver-time-integrator"]["dt"]);
    };
    Mesh mesh = case_mesh();
    const double third = step(mesh, 3), first = step(mesh, 1);
    EXPECT_GT(third, 0);
    EXPECT_GT(first, 2 * third);
    const Triangle cut = mesh.triangles.front();
    mesh.points.push_back(mesh.points[cut.v[0].index()] +
                          1e-3 * (mesh.points[cut.v[2].index()] - mesh.points[cut.v[0].index()]));
    mesh.triangles.push_back({{cut.v[0], cut.v[1], VertexId(mesh.points.size() - 1)}});
    if (!mesh.region.empty())
        mesh.region.insert(mesh.region.begin() + static_cast<std::ptrdiff_t>(mesh.triangles.size()) - 1,
                           Region::isotropic);
    EXPECT_LT(step(mesh, 3), 0.1 * third);
}

/// PyFR reads the cells from one physical group of surfaces, `fluid`, and names in small letters.
TEST(PyfrCase, HasOneSurfaceAndABoundaryForEachMarker) {
    const test::TemporaryFolder folder;
    const SolverConditions conditions = laminar_conditions();
    CurvedMesh cell = test::one_cell(4, 3);
    cell.mesh.markers = {{"Wall", MarkerKind::wall, {{VertexId{0u}, VertexId{1u}}}},
                         {"farfield",
                          MarkerKind::far_field,
                          {{VertexId{1u}, VertexId{2u}}, {VertexId{2u}, VertexId{3u}}, {VertexId{3u}, VertexId{0u}}}}};
    cell.mesh.region = {Region::layer};
    cell.nodes.marker_nodes.clear();
    for (unsigned n = 4; n < 12; ++n) cell.nodes.marker_nodes.push_back(VertexId(n));
    write_solver_case(FlowSolver::pyfr, cell.mesh, conditions, folder / "c", {}, cell.nodes);
    const std::string mesh = folder.read("c/mesh.msh"), ini = folder.read("c/case.ini");
    EXPECT_TRUE(mesh.starts_with("$MeshFormat\n2.2 0 8\n"));
    EXPECT_NE(mesh.find("$PhysicalNames\n3\n1 1 \"Wall\"\n1 2 \"farfield\"\n2 3 \"fluid\"\n"), std::string::npos);
    EXPECT_NE(mesh.find("\n5 36 2 3 3 1 2 3 4 "), std::string::npos);  // the quadrilateral of order 3 in group 3
    for (const char* section : {"[soln-bcs-wall]", "[soln-bcs-farfield]", "[soln-plugin-fluidforce-wall]"})
        EXPECT_NE(ini.find(section), std::string::npos) << section;
    EXPECT_EQ(read_curved_mesh(folder / "c/mesh.msh").nodes.points, cell.nodes.points);
    EXPECT_NE(folder.read("c/Allrun").find("walls=\"wall\""), std::string::npos);
    for (const auto& file : solver_case_outputs(FlowSolver::pyfr, folder / "c"))
        EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST(PyfrCase, RefusesWhatPyfrDoesNotKnow) {
    const auto reason = [](const Mesh& mesh, const SolverConditions& conditions,
                           const SolverCaseOptions& options = {}) {
        try {
            cases::solver_case_files(FlowSolver::pyfr, mesh, conditions, options);
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const SolverConditions conditions = laminar_conditions();
    EXPECT_EQ(reason(case_mesh(), conditions), "");
    for (const char* name : {"fluid", "Farfield", "periodic_1"}) {
        Mesh mesh = case_mesh();
        mesh.markers.front().name = name;
        EXPECT_NE(reason(mesh, conditions).find("PyFR cannot have a marker"), std::string::npos) << name;
    }
    SolverConditions other = conditions;
    other.outer_walls = other.moving_walls = {"ground"};
    EXPECT_NE(reason(case_mesh(), other).find("walls that move"), std::string::npos);
    other = conditions;
    other.axisymmetric = true;
    EXPECT_NE(reason(case_mesh(), other).find("axisymmetric"), std::string::npos);
    EXPECT_NE(reason(case_mesh(), conditions, {.turbulence = TurbulenceModel::k_omega_sst}).find("laminar"),
              std::string::npos);
    other = conditions;
    other.reference.mach = 1.2;
    EXPECT_NE(reason(case_mesh(), other, {.compressible = true}).find("PyFR"), std::string::npos);
    const auto warnings = [](double reynolds) {
        return find_solver_warnings(FlowSolver::pyfr, case_mesh(), {.reynolds = reynolds});
    };
    EXPECT_EQ(warnings(5000).size(), 0u);
    ASSERT_EQ(warnings(1e6).size(), 1u);
    EXPECT_EQ(warnings(1e6)[0].code, WarningCode::unsuited_to_solver);
}

}  // namespace
}  // namespace lamina
