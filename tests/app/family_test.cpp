// lamina family: files, the table of h, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <lamina/io.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

TEST(FamilyCommand, WritesAMeshOfEachLevelAndTheirLengths) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, {"family", "naca:0012", "--levels", "3", "--far-field", "10", "-o",
                                               "n_{level}.su2", "--report", "r_{level}.json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto rows = rows_of(folder.read("n_family.csv"));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0][0], "level");
    double coarser = 0;
    for (std::size_t level = 0; level < 3; ++level) {
        const auto& row = rows[level + 1];
        const std::string file = "n_" + std::to_string(level) + ".su2";
        EXPECT_EQ(row.back(), file);
        EXPECT_TRUE(std::filesystem::exists(folder.path() / ("r_" + std::to_string(level) + ".json")));
        const Mesh mesh = read_mesh(folder.path() / file);
        const MeshCheck check = check_mesh(mesh);
        EXPECT_TRUE(check.valid());
        EXPECT_EQ(std::stoul(row[5]), mesh.points.size());
        EXPECT_EQ(std::stoul(row[6]), mesh.triangles.size() + mesh.quads.size());
        const double h = std::stod(row[1]);
        EXPECT_NEAR(h, std::sqrt(check.area / std::stod(row[6])), 1e-9 * h);
        EXPECT_NEAR(std::stod(row[4]), std::pow(2, 0.5 * (double(level) - 1)), 1e-12);
        if (level > 0) {
            EXPECT_NEAR(h / coarser, std::sqrt(0.5), 0.04);
        }
        coarser = h;
    }
}

TEST(FamilyCommand, TheBaseLevelHasTheOptionsAsGiven) {
    const TemporaryFolder folder;
    const std::vector<std::string> options{"naca:2412", "--far-field", "10", "--surface", "resample"};
    const auto with = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin() + 1, options.begin(), options.end());
        return arguments;
    };
    ASSERT_EQ(run_lamina(folder, with({"mesh", "-o", "one.su2"})).exit_code, 0);
    for (const char* base : {"0", "1"}) {
        ASSERT_EQ(
            run_lamina(folder, with({"family", "--levels", "2", "--base-level", base, "-o", "f{level}.su2"})).exit_code,
            0);
        EXPECT_EQ(folder.read("f" + std::string(base) + ".su2"), folder.read("one.su2"));
    }
}

TEST(FamilyCommand, RefusesWhatMakesNoFamily) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::vector<std::string>& more, const std::string& word) {
        std::vector<std::string> arguments{"family", "naca:0012"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_refused(folder, arguments, usage, word);
    };
    refused({"-o", "n.su2"}, "{level}");
    refused({}, "-o NAME_{level}");
    refused({"-o", "n{level}.su2", "--report", "r.json"}, "--report");
    refused({"-o", "n{level}.su2", "--levels", "0"}, "--levels");
    refused({"-o", "n{level}.su2", "--ratio", "1"}, "--ratio");
    refused({"-o", "n{level}.su2", "--levels", "3", "--base-level", "3"}, "--base-level");
    refused({"-o", "n{level}.su2", "--surface", "keep"}, "surface");
    refused({"-o", "n{level}.su2", "--growth-law", "aflr"}, "growth-law");
    refused({"-o", "n{level}.su2", "--table", "n0.su2"}, "--table");
}

}  // namespace
}  // namespace lamina::test
