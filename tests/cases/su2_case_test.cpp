// The file of SU2's case. SU2 is not at hand where tests run, so names of options are compared with those of its own
// template of a configuration.
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include <lamina/files.hpp>

#include "cases/case_files.hpp"
#include "cases/case_fixtures.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::case_mesh;
using test::some_conditions;

/// Returns the options of a configuration by their names. Fails where one is given twice.
std::map<std::string, std::string> su2_options(const std::string& text) {
    std::map<std::string, std::string> options;
    std::istringstream lines(text);
    const std::regex assignment("([A-Z0-9_-]+)= (.*)");
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.starts_with('%')) continue;
        std::smatch parts;
        EXPECT_TRUE(std::regex_match(line, parts, assignment)) << line;
        EXPECT_TRUE(options.emplace(parts[1], parts[2]).second) << line;
    }
    return options;
}

std::map<std::string, std::string> options_of_case(const SolverConditions& conditions,
                                                   const SolverCaseOptions& options = {}) {
    return su2_options(
        test::text_of(cases::solver_case_files(FlowSolver::su2, case_mesh(), conditions, options), "case.cfg"));
}

/// Returns the names of SU2's options.
std::set<std::string> known_options() {
    std::istringstream words(read_file(LAMINA_SOURCE_DIR "/tests/cases/su2_options.txt"));
    std::set<std::string> known;
    for (std::string line; std::getline(words, line);)
        if (!line.starts_with('#')) known.insert(line);
    EXPECT_GT(known.size(), 60u);
    return known;
}

TEST(Su2Case, EveryOptionIsOneOfSu2) {
    const std::set<std::string> known = known_options();
    for (const auto turbulence :
         {TurbulenceModel::spalart_allmaras, TurbulenceModel::k_omega_sst, TurbulenceModel::laminar})
        for (const bool unsteady : {false, true})
            for (const auto& [name, value] :
                 options_of_case(some_conditions(), {.turbulence = turbulence, .unsteady = unsteady}))
                EXPECT_TRUE(known.contains(name)) << name;
}

/// Flows that may have shocks get a limiter, others the correction for low Mach numbers. Faster than sound, nothing
/// reaches far.
TEST(Su2Case, HasASchemeForEachMachNumber) {
    SolverConditions conditions = some_conditions();
    for (const double mach : {0.1, 0.3, 0.31, 0.734, 2.0}) {
        conditions.reference.mach = mach;
        auto options = options_of_case(conditions);
        EXPECT_EQ(options["LOW_MACH_CORR"], mach <= 0.3 ? "YES" : "NO") << mach;
        EXPECT_EQ(options["SLOPE_LIMITER_FLOW"], mach <= 0.3 ? "NONE" : "VENKATAKRISHNAN") << mach;
        EXPECT_EQ(options.contains("VENKAT_LIMITER_COEFF"), mach > 0.3) << mach;
        for (const FlowSolver solver : {FlowSolver::su2, FlowSolver::openfoam})
            EXPECT_EQ(far_field_for(solver, mach) < far_field_for(solver), mach >= 1) << mach;
    }
}

/// SU2 counts seconds at its own speed of sound, 347 m/s.
TEST(Su2Case, GoesInStepsOfTime) {
    SolverConditions conditions = some_conditions();
    conditions.reference.mach = 0.2;
    auto options = options_of_case(conditions, {.unsteady = true});
    EXPECT_EQ(options["TIME_DOMAIN"], "YES");
    const std::string run =
        test::text_of(cases::solver_case_files(FlowSolver::su2, case_mesh(), conditions, {.unsteady = true}), "Allrun");
    std::smatch steps;
    ASSERT_TRUE(std::regex_search(run, steps, std::regex("\nsteps=([0-9]+) ")));
    EXPECT_NEAR(std::stod(options["TIME_STEP"]) * std::stod(steps[1]) * 0.2 * 347.2, 2, 1e-3);
    EXPECT_FALSE(options.contains("ITER"));
    EXPECT_FALSE(options_of_case(conditions).contains("TIME_STEP"));
}

/// Allrun of a case that pitches adds options to those of a steady case, and changes some.
TEST(Su2Case, PitchesByOptionsOfSu2) {
    const test::TemporaryFolder folder;
    const TurnInTime turn{"all", Pitching{1, 5, 0.04}, {0.25, 0}};
    write_pitching_case(case_mesh(), turn, 25, 20, folder / "pitching");
    for (const auto& file : pitching_case_outputs(folder / "pitching")) EXPECT_TRUE(std::filesystem::exists(file));
    const std::string script = folder.read("pitching/Allrun"), begin = "<<END\n";
    const std::size_t at = script.find(begin) + begin.size();
    auto options = su2_options(script.substr(at, script.find("\nEND\n") - at));
    const std::set<std::string> known = known_options();
    for (const auto& [name, value] : options) EXPECT_TRUE(known.contains(name)) << name;
    EXPECT_EQ(options["GRID_MOVEMENT"], "RIGID_MOTION");
    EXPECT_EQ(options["PITCHING_AMPL"], "0.0 0.0 5");
    EXPECT_EQ(options["TIME_STEP"], "$seconds");
}

/// Below a Reynolds number of 1e4 cases are laminar, unless they are asked for a model.
TEST(Su2Case, IsLaminarAtLowReynoldsNumbers) {
    SolverConditions conditions = some_conditions();
    conditions.reference.reynolds = 5000;
    auto options = options_of_case(conditions);
    EXPECT_EQ(options["SOLVER"], "NAVIER_STOKES");
    EXPECT_EQ(options["KIND_TURB_MODEL"], "NONE");
    EXPECT_EQ(options["SCREEN_OUTPUT"].find("NU_TILDE"), std::string::npos);
    EXPECT_EQ(options_of_case(conditions, {.turbulence = TurbulenceModel::k_omega_sst})["KIND_TURB_MODEL"], "SST");
    conditions.reference.reynolds = 1e4;
    EXPECT_EQ(options_of_case(conditions)["SOLVER"], "RANS");
    EXPECT_EQ(options_of_case(conditions, {.turbulence = TurbulenceModel::laminar})["SOLVER"], "NAVIER_STOKES");
}

TEST(Su2Case, SaysTheFlow) {
    SolverConditions conditions = some_conditions();
    auto options = options_of_case(conditions);
    EXPECT_EQ(std::stod(options["AOA"]), 10);
    EXPECT_EQ(std::stod(options["REYNOLDS_NUMBER"]), 4e6);
    EXPECT_EQ(std::stod(options["REYNOLDS_LENGTH"]), 2);
    EXPECT_EQ(std::stod(options["REF_LENGTH"]), 2);
    EXPECT_EQ(std::stod(options["REF_AREA"]), 2);
    EXPECT_EQ(std::stod(options["MACH_NUMBER"]), 0.15);
    EXPECT_EQ(options["MARKER_HEATFLUX"], "( wall, 0.0 )");
    EXPECT_EQ(options["MARKER_FAR"], "( farfield )");
    EXPECT_EQ(options["MESH_FILENAME"], "mesh.su2");
    // With these, and as SU2 8 has them, cases converge in hundreds of iterations. With an error of 1e-4 and 20 steps
    // the CFL number is cut to a tenth again and again.
    EXPECT_EQ(options["CFL_ADAPT_PARAM"], "( 0.5, 1.1, 10, 2000 )");
    EXPECT_EQ(options["LINEAR_SOLVER_ERROR"], "0.1");
    EXPECT_EQ(options["LINEAR_SOLVER_ITER"], "15");
    EXPECT_EQ(options["DISCARD_INFILES"], "YES");
    EXPECT_EQ(options["WRT_RESTART_COMPACT"], "NO");
    EXPECT_NE(options["SCREEN_OUTPUT"].find("AVG_CFL, LINSOL_RESIDUAL"), std::string::npos);
    EXPECT_NE(options["HISTORY_OUTPUT"].find("CFL_NUMBER, LINSOL"), std::string::npos);
    EXPECT_EQ(options["MARKER_WALL_FUNCTIONS"], "( wall, NO_WALL_FUNCTION )");
    conditions.reference.mach = 0.2;
    conditions.wall_functions = true;
    options = options_of_case(conditions, {.turbulence = TurbulenceModel::k_omega_sst});
    EXPECT_EQ(std::stod(options["MACH_NUMBER"]), 0.2);
    EXPECT_EQ(options["KIND_TURB_MODEL"], "SST");
    EXPECT_EQ(options["MARKER_WALL_FUNCTIONS"], "( wall, STANDARD_WALL_FUNCTION )");
    // NASA's page on the 2D bump says 0.000387 for Mach 0.2.
    EXPECT_NEAR(std::stod(options["FREESTREAM_TURBULENCEINTENSITY"]), 3.873e-4, 1e-7);
}

}  // namespace
}  // namespace lamina
