// Cases that begin with the flow of another case.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/solution.hpp>

#include "cases/case_fixtures.hpp"
#include "io/formats.hpp"
#include "io/su2_restart.hpp"
#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

/// Fields of which the values at the middles of cells are known.
double pressure(Point p) { return 0.5 * p.x - p.y; }

Point middle(const Mesh& mesh, std::size_t cell) {
    const bool is_quad = cell >= mesh.triangles.size();
    const VertexId* v = is_quad ? mesh.quads[cell - mesh.triangles.size()].v : mesh.triangles[cell].v;
    Point sum{0, 0};
    for (int i = 0; i < (is_quad ? 4 : 3); ++i) sum = sum + mesh.points[v[i].index()];
    return (is_quad ? 0.25 : 1.0 / 3) * sum;
}

/// Writes fields at time 100, as OpenFOAM does, with nuTilda equal to a number.
void write_foam_solution(const std::filesystem::path& folder, const std::string& nu_tilda) {
    const io::NumberedCells cells = io::read_numbered_openfoam(folder);
    std::vector<Point> middles(cells.numbers.size());
    for (std::size_t i = 0; i < middles.size(); ++i) middles[cells.numbers[i]] = middle(cells.mesh, i);
    std::string p, u, n;
    for (const Point at : middles) {
        p += fmt::format("{}\n", pressure(at));
        u += fmt::format("({} {} 0)\n", 1 + at.y, at.x);
        n += nu_tilda + "\n";
    }
    const auto write = [&](const char* name, const char* kind, const std::string& values) {
        write_file(folder / "100" / name,
                   fmt::format("FoamFile {{ format ascii; class vol{0}Field; }}\ninternalField nonuniform "
                               "List<{1}> {2} (\n{3});\n",
                               kind, kind == std::string("Vector") ? "vector" : "scalar", middles.size(), values));
    };
    std::filesystem::create_directories(folder / "100");
    write("p", "Scalar", p);
    write("U", "Vector", u);
    write("nuTilda", "Scalar", n);
    write("nut", "Scalar", n);
}

/// Exchanges the numbers of two cells in a case, as renumberMesh does with all of them.
void exchange_cells(const std::filesystem::path& folder, const std::string& one, const std::string& other) {
    for (const char* name : {"owner", "neighbour"}) {
        std::istringstream in(read_file(folder / "constant/polyMesh" / name));
        std::string text;
        bool in_list = false;
        for (std::string line; std::getline(in, line);) {
            in_list = line == "(" || (in_list && line != ")");
            text += (!in_list ? line : line == one ? other : line == other ? one : line) + "\n";
        }
        write_file(folder / "constant/polyMesh" / name, text);
    }
}

TEST(StartOfACase, OpenFoamsFieldsAreReplaced) {
    const TemporaryFolder folder;
    write_solver_case(FlowSolver::openfoam, case_mesh(), some_conditions(), folder / "solved");
    write_solver_case(FlowSolver::openfoam, case_mesh(), some_conditions(), folder / "next");
    // The reader counts triangles first: the first and the last cell, of which one is a quadrilateral.
    const std::size_t cells = io::read_numbered_openfoam(folder / "next").numbers.size();
    exchange_cells(folder / "next", "0", std::to_string(cells - 1));
    EXPECT_NE(io::read_numbered_openfoam(folder / "next").numbers.front(), 0u);
    EXPECT_THROW(start_case_from(FlowSolver::openfoam, folder / "solved", folder / "next", 1.5), Error);
    write_foam_solution(folder / "solved", "0.25");
    start_case_from(FlowSolver::openfoam, folder / "solved", folder / "next", 1.5);
    EXPECT_EQ(folder.read("next/system/start"), "1.5\n");
    const std::string u = folder.read("next/0/U");
    EXPECT_NE(u.find("streamVelocity"), std::string::npos);
    EXPECT_NE(u.find("nonuniform List<vector>"), std::string::npos);

    // The fields of 0/ are read with the numbers of the case's own cells.
    for (const char* name : {"p", "nuTilda"}) {
        std::filesystem::create_directories(folder / "next/7");
        std::filesystem::copy_file(folder / (std::string("next/0/") + name), folder / (std::string("next/7/") + name));
    }
    const Solution read = read_solution(folder / "next", {"p", "nuTilda"});
    for (std::size_t i = 0; i < read.fields[0].values.size(); ++i) {
        EXPECT_NEAR(read.fields[0].values[i], pressure(middle(read.mesh, i)), 1e-9);
        EXPECT_NEAR(read.fields[1].values[i], 0.25, 1e-12);
    }
    write_foam_solution(folder / "solved", "nan");
    EXPECT_THROW(start_case_from(FlowSolver::openfoam, folder / "solved", folder / "next", 1.5), Error);
}

TEST(StartOfACase, NeedsFieldsToReplace) {
    const TemporaryFolder folder;
    write_solver_case(FlowSolver::openfoam, case_mesh(), some_conditions(), folder / "solved");
    write_solver_case(FlowSolver::openfoam, case_mesh(), some_conditions(), folder / "next");
    write_foam_solution(folder / "solved", "0.25");
    std::filesystem::remove_all(folder / "next/0");
    EXPECT_THROW(start_case_from(FlowSolver::openfoam, folder / "solved", folder / "next", 1.5), IoError);
    std::filesystem::create_directory(folder / "next/0");
    EXPECT_THROW(start_case_from(FlowSolver::openfoam, folder / "solved", folder / "next", 1.5), IoError);
}

TEST(StartOfACase, Su2GetsAllFieldsAtTheVertices) {
    const TemporaryFolder folder;
    write_solver_case(FlowSolver::su2, case_mesh(), some_conditions(), folder / "solved");
    write_solver_case(FlowSolver::su2, case_mesh(), some_conditions(), folder / "next");
    io::Su2Restart restart{{"x", "y", "Density", "Nu_Tilde"}, {{}, {}, {}, {}}};
    for (const Point p : case_mesh().points) {
        const double row[] = {p.x, p.y, 1 + 0.1 * p.x, p.x * p.x};
        for (std::size_t f = 0; f < 4; ++f) restart.values[f].push_back(row[f]);
    }
    io::write_su2_restart(restart, folder / "solved/restart_flow.dat");
    start_case_from(FlowSolver::su2, folder / "solved", folder / "next", 0);
    const io::Su2Restart start = io::read_su2_restart(folder / "next/start_flow.dat");
    EXPECT_EQ(start.names, restart.names);
    for (std::size_t f = 0; f < 4; ++f)
        for (std::size_t i = 0; i < start.values[f].size(); ++i)
            EXPECT_NEAR(start.values[f][i], restart.values[f][i], 1e-9 * (1 + std::abs(restart.values[f][i])));
    write_mesh(tiny(), folder / "solved/mesh.su2");
    EXPECT_THROW(start_case_from(FlowSolver::su2, folder / "solved", folder / "next", 0), InputError);
}

}  // namespace
}  // namespace lamina::test
