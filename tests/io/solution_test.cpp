// Solutions in VTU files and OpenFOAM cases, and files of sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/solution.hpp>

#include "io/su2_restart.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::shuffled;
using test::TemporaryFolder;
using test::tiny;

/// The middle of the corners of a cell: triangles, then quads.
Point corner_mean(const Mesh& mesh, std::size_t cell) {
    const bool is_quad = cell >= mesh.triangles.size();
    const VertexId* v = is_quad ? mesh.quads[cell - mesh.triangles.size()].v : mesh.triangles[cell].v;
    Point sum{0, 0};
    for (int i = 0; i < (is_quad ? 4 : 3); ++i) sum = sum + mesh.points[v[i].index()];
    return (is_quad ? 0.25 : 1.0 / 3) * sum;
}

/// Reads the lists of numbers between brackets of a file of OpenFOAM, each entry of the outer list being one.
std::vector<std::vector<double>> foam_list(std::string text) {
    text = text.substr(text.find("}\n") + 2);
    text = text.substr(text.find('(') + 1);
    std::vector<std::vector<double>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line) && line != ")";) {
        if (const std::size_t bracket = line.find('('); bracket != std::string::npos) line = line.substr(bracket + 1);
        std::istringstream numbers(line);
        std::vector<double> row;
        for (double x = 0; numbers >> x;) row.push_back(x);
        if (!row.empty()) rows.push_back(row);
    }
    return rows;
}

/// Returns the mean of the points of each cell of a polyMesh, by the numbers in its files.
std::vector<Point> foam_cell_means(const TemporaryFolder& folder) {
    const auto list = [&](const std::string& name) { return foam_list(folder.read("case/constant/polyMesh/" + name)); };
    const auto points = list("points"), faces = list("faces"), owner = list("owner"), neighbour = list("neighbour");
    std::vector<std::set<std::size_t>> corners;
    const auto add = [&](const std::vector<double>& cell, std::size_t face) {
        if (corners.size() <= cell[0]) corners.resize(std::size_t(cell[0]) + 1);
        for (const double p : faces[face]) corners[std::size_t(cell[0])].insert(std::size_t(p));
    };
    for (std::size_t f = 0; f < owner.size(); ++f) add(owner[f], f);
    for (std::size_t f = 0; f < neighbour.size(); ++f) add(neighbour[f], f);
    std::vector<Point> means;
    for (const auto& cell : corners) {
        Point sum{0, 0};
        for (const std::size_t p : cell) sum = sum + Point{points[p][0], points[p][1]};
        means.push_back((1.0 / double(cell.size())) * sum);
    }
    return means;
}

std::string foam_field(const std::string& type, const std::string& values) {
    return "/* a comment */\nFoamFile\n{\n    version 2.0;\n    format ascii;\n    arch \"LSB;label=32\";\n    class " +
           type + ";\n    location \"200\";\n    object f;\n}\ndimensions [0 1 -1 0 0 0 0];\ninternalField " + values +
           ";\nboundaryField { wall { type fixedValue; value uniform 0; } }\n";
}

TEST(Solution, FieldsOfOpenFoamFollowTheNumbersOfItsCells) {
    for (const Mesh& mesh :
         {annulus({.quads_in_layer = true}), shuffled(annulus({.quads_in_layer = true}), 5), tiny()}) {
        const TemporaryFolder folder;
        write_mesh(mesh, folder / "case/constant/polyMesh");
        const std::vector<Point> means = foam_cell_means(folder);
        std::string scalars = fmt::format("nonuniform List<scalar>\n{}\n(\n", means.size()), vectors = scalars;
        vectors.replace(vectors.find("scalar"), 6, "vector");
        for (const Point p : means) {
            scalars += fmt::format("{}\n", p.x + 10 * p.y);
            vectors += fmt::format("({} {} 0)\n", p.x, p.y);
        }
        std::filesystem::create_directories(folder / "case/100");
        std::filesystem::create_directories(folder / "case/200");
        folder.write("case/200/p", foam_field("volScalarField", scalars + ")\n"));
        folder.write("case/200/U", foam_field("volVectorField", vectors + ")\n"));
        folder.write("case/200/one", foam_field("volScalarField", "uniform 3"));

        for (const char* path : {"case/200", "case", "case/"}) {
            const Solution solution = read_solution(folder / path, {"p", "U:y", "mag(U)", "one"});
            ASSERT_EQ(solution.fields.size(), 4u);
            for (const SolutionField& field : solution.fields) {
                EXPECT_TRUE(field.at_cells);
                ASSERT_EQ(field.values.size(), mesh.triangles.size() + mesh.quads.size());
            }
            for (std::size_t cell = 0; cell < solution.fields[0].values.size(); ++cell) {
                const Point p = corner_mean(solution.mesh, cell);
                EXPECT_NEAR(solution.fields[0].values[cell], p.x + 10 * p.y, 1e-9);
                EXPECT_NEAR(solution.fields[1].values[cell], p.y, 1e-9);
                EXPECT_NEAR(solution.fields[2].values[cell], length(p), 1e-9);
                EXPECT_EQ(solution.fields[3].values[cell], 3);
            }
        }
        EXPECT_THROW(read_solution(folder / "case/200", {"q"}), UsageError);
        EXPECT_THROW(read_solution(folder / "case/200", {"U"}), UsageError);
        EXPECT_THROW(read_solution(folder / "case/200", {"p:y"}), UsageError);
        folder.write("case/200/short", foam_field("volScalarField", "nonuniform List<scalar> 1 ( 1 )"));
        EXPECT_THROW(read_solution(folder / "case/200", {"short"}), InputError);
        folder.write("case/200/long", foam_field("volScalarField", "nonuniform List<scalar> 99999999 ( 1 2 )"));
        EXPECT_THROW(read_solution(folder / "case/200", {"long"}), InputError);
        folder.write("case/200/tensor", foam_field("volTensorField", "uniform 1"));
        EXPECT_THROW(read_solution(folder / "case/200", {"tensor"}), InputError);
    }
}

TEST(Solution, FieldsOfOpenFoamInBinary) {
    const TemporaryFolder folder;
    const Mesh mesh = tiny();
    write_mesh(mesh, folder / "case/constant/polyMesh");
    std::filesystem::create_directories(folder / "case/200");
    const std::vector<double> values{1.5, -2e300, 3.25, 4, 5, 6};
    const std::string bytes(reinterpret_cast<const char*>(values.data()), 48);
    std::string text = foam_field("volScalarField", "nonuniform List<scalar> \n2\n(" + bytes.substr(0, 16) + ")");
    const auto write = [&](const std::string& name, std::string field, const std::string& arch) {
        field.replace(field.find("ascii"), 5, "binary");
        field.replace(field.find("LSB;label=32"), 12, arch);
        folder.write("case/200/" + name, field);
    };
    const std::string usual = "LSB;label=32;scalar=64";
    write("p", text, usual);
    write("U", foam_field("volVectorField", "nonuniform List<vector> 2(" + bytes + ")"), usual);
    const Solution solution = read_solution(folder / "case", {"p", "U:z"});
    EXPECT_EQ(std::multiset<double>(solution.fields[0].values.begin(), solution.fields[0].values.end()),
              (std::multiset<double>{1.5, -2e300}));
    EXPECT_EQ(std::multiset<double>(solution.fields[1].values.begin(), solution.fields[1].values.end()),
              (std::multiset<double>{3.25, 6}));
    write("single", text, "LSB;label=32;scalar=32");
    EXPECT_THROW(read_solution(folder / "case", {"single"}), InputError);
    write("cut", text.substr(0, text.find('(') + 9), usual);
    EXPECT_THROW(read_solution(folder / "case", {"cut"}), InputError);
}

TEST(Solution, RestartsOfSu2) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({});
    write_mesh(mesh, folder / "mesh.su2");
    io::Su2Restart restart{{"x", "y", "Density", "Velocity_x", "Velocity_y"}, {{}, {}, {}, {}, {}}};
    std::string csv = "\"PointID\",\"x\",\"y\",\"Density\",\"Velocity_x\",\"Velocity_y\"\n";
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const Point p = mesh.points[i];
        const double row[] = {p.x, p.y, 1 + p.x / 3, 3 * p.y, 4 * p.y};
        for (std::size_t f = 0; f < 5; ++f) restart.values[f].push_back(row[f]);
        csv += fmt::format("{}, {}, {}, {}, {}, {}\n", i, row[0], row[1], row[2], row[3], row[4]);
    }
    io::write_su2_restart(restart, folder / "restart_flow.dat");
    folder.write("restart_flow.csv", csv + "EXT_ITER= 100\n");
    for (const char* file : {"restart_flow.dat", "restart_flow.csv"}) {
        const Solution solution = read_solution(folder / file, {"Density", "Velocity:y", "mag(Velocity)"});
        EXPECT_EQ(solution.fields[0].values, restart.values[2]);
        EXPECT_EQ(solution.fields[1].values, restart.values[4]);
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            EXPECT_NEAR(solution.fields[2].values[i], 5 * std::abs(mesh.points[i].y), 1e-9);
        EXPECT_THROW(read_solution(folder / file, {"Mach"}), UsageError);
        write_mesh(tiny(), folder / "other.su2");
        EXPECT_THROW(read_solution(folder / file, {"Density"}, folder / "other.su2"), InputError);
    }
    const std::string whole = folder.read("restart_flow.dat");
    folder.write("cut.dat", whole.substr(0, whole.size() - 1));
    EXPECT_THROW(read_solution(folder / "cut.dat", {"Density"}), InputError);
    folder.write("text.dat", "VARIABLES = x\n");
    EXPECT_THROW(read_solution(folder / "text.dat", {"Density"}), InputError);
    restart.values[2][3] = NAN;
    io::write_su2_restart(restart, folder / "diverged.dat");
    EXPECT_THROW(read_solution(folder / "diverged.dat", {"Density"}), InputError);
    restart.values[2][3] = 1;
    restart.values[0][3] += 1;
    io::write_su2_restart(restart, folder / "moved.dat");
    EXPECT_THROW(read_solution(folder / "moved.dat", {"Density"}), InputError);
}

TEST(Solution, PointDataAndCellDataOfVtuFiles) {
    // The mesh of tiny() in ASCII, with a line before its cells, whose data count as those of no cell.
    const TemporaryFolder folder;
    folder.write(
        "s.vtu",
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n"
        "<PointData>\n<DataArray type=\"Float64\" Name=\"p\" NumberOfComponents=\"1\" format=\"ascii\">"
        "1 2 3 4 5</DataArray>\n<DataArray type=\"Float64\" Name=\"U\" NumberOfComponents=\"3\" format=\"ascii\">"
        "3 4 0 0 0 1 0 0 0 1 1 1 0 0 2</DataArray>\n</PointData>\n<CellData>\n"
        "<DataArray type=\"Float64\" Name=\"c\" NumberOfComponents=\"1\" format=\"ascii\">7 8 9</DataArray>\n"
        "</CellData>\n<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
        "format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 2 0 0</DataArray>\n</Points>\n<Cells>\n"
        "<DataArray type=\"Int64\" Name=\"connectivity\" NumberOfComponents=\"1\" format=\"ascii\">"
        "0 1 0 1 2 3 1 4 2</DataArray>\n"
        "<DataArray type=\"Int64\" Name=\"offsets\" NumberOfComponents=\"1\" format=\"ascii\">2 6 9</DataArray>\n"
        "<DataArray type=\"UInt8\" Name=\"types\" NumberOfComponents=\"1\" format=\"ascii\">3 9 5</DataArray>\n"
        "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    const Solution solution = read_solution(folder / "s.vtu", {"p", "mag(U)", "U:z", "c"});
    ASSERT_EQ(solution.fields.size(), 4u);
    EXPECT_FALSE(solution.fields[0].at_cells);
    EXPECT_EQ(solution.fields[0].values, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(solution.fields[1].values[0], 5);
    EXPECT_EQ(solution.fields[2].values, (std::vector<double>{0, 1, 0, 1, 2}));
    EXPECT_TRUE(solution.fields[3].at_cells);
    EXPECT_EQ(solution.fields[3].values, (std::vector<double>{9, 8}));  // the triangle, then the quad
    EXPECT_EQ(solution.mesh.quads.size(), 1u);

    EXPECT_THROW(read_solution(folder / "s.vtu", {"U"}), UsageError);
    EXPECT_THROW(read_solution(folder / "s.vtu", {"nothing"}), UsageError);
    EXPECT_THROW(read_solution(folder / "s.vtu", {"mag()"}), UsageError);
    EXPECT_THROW(read_solution(folder / "none.vtu", {"p"}), IoError);
    write_mesh(annulus({}), folder / "other.su2");
    EXPECT_THROW(read_solution(folder / "s.vtu", {"p"}, folder / "other.su2"), InputError);
    EXPECT_THROW(read_solution(folder / "other.su2", {"p"}), UsageError);
}

TEST(Solution, IsReadBackAsWritten) {
    const TemporaryFolder folder;
    Solution solution{annulus({.quads_in_layer = true}), {}};
    const std::size_t points = solution.mesh.points.size(),
                      cells = solution.mesh.triangles.size() + solution.mesh.quads.size();
    for (const char* name : {"p", "U:x", "U:y", "V:x", "V:y", "V:z"}) {
        solution.fields.push_back({name, false, std::vector<double>(points, double(solution.fields.size()))});
        solution.fields.back().values[7] = -1.0 / 3;
    }
    solution.fields.push_back({"c", true, std::vector<double>(cells, 2.5)});
    write_solution(solution, folder / "solution.vtu");
    const std::vector<std::string> names = solution_fields(folder / "solution.vtu");
    EXPECT_EQ(names, (std::vector<std::string>{"U:x", "U:y", "V:x", "V:y", "V:z", "p", "c"}));
    const Solution read = read_solution(folder / "solution.vtu", names);
    EXPECT_EQ(read.mesh.markers.size(), solution.mesh.markers.size());
    for (const SolutionField& field : read.fields) {
        const auto same = std::find_if(solution.fields.begin(), solution.fields.end(),
                                       [&](const SolutionField& other) { return other.name == field.name; });
        EXPECT_EQ(field.at_cells, same->at_cells);
        EXPECT_EQ(field.values, same->values) << field.name;
    }
    Mesh moved = solution.mesh;
    std::reverse(moved.points.begin(), moved.points.end());
    write_mesh(moved, folder / "moved.vtu");
    EXPECT_THROW(read_solution(folder / "solution.vtu", {"p"}, folder / "moved.vtu"), InputError);
}

TEST(Solution, SizesAreReadBackAsWritten) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({});
    SizedMesh sizes{mesh.points, mesh.triangles, {}, {}};
    for (const Point p : mesh.points) sizes.sizes.push_back(0.1 + length(p));
    for (const std::optional<double> gradation : {std::optional<double>(), std::optional<double>(0.2)}) {
        sizes.gradation = gradation;
        if (gradation) sizes.walls = {{{{0, 0}, {0.1, 0}, {0, 0.1}}, {0.3, 0.2, 0.1}, {1e-6, 2e-6, 1. / 3}, {0, 2, 3}}};
        write_sizes(sizes, folder / "sizes.vtu");
        const SizedMesh read = read_sizes(folder / "sizes.vtu");
        EXPECT_EQ(read.points, sizes.points);
        EXPECT_EQ(read.sizes, sizes.sizes);
        EXPECT_EQ(read.gradation, gradation);
        ASSERT_EQ(read.walls.size(), sizes.walls.size());
        for (std::size_t w = 0; w < read.walls.size(); ++w) {
            EXPECT_EQ(read.walls[w].points, sizes.walls[w].points);
            EXPECT_EQ(read.walls[w].spacings, sizes.walls[w].spacings);
            EXPECT_EQ(read.walls[w].units, sizes.walls[w].units);
            EXPECT_EQ(read.walls[w].thicknesses, sizes.walls[w].thicknesses);
        }
        EXPECT_EQ(read.triangles.size(), sizes.triangles.size());
    }
    for (const SizedWall& bad : {SizedWall{{{0, 0}, {1, 0}}, {1, 1}, {1, 1}, {1, 1}},
                                 SizedWall{{{0, 0}, {1, 0}, {0, 1}}, {1, 0, 1}, {1, 1, 1}, {1, 1, 1}},
                                 SizedWall{{{0, 0}, {1, 0}, {0, 1}}, {1, 1, 1}, {1, NAN, 1}, {1, 1, 1}}}) {
        sizes.walls = {bad};
        write_sizes(sizes, folder / "sizes.vtu");
        EXPECT_THROW(read_sizes(folder / "sizes.vtu"), InputError);
    }
}

}  // namespace
}  // namespace lamina
