// The files of OpenFOAM's case: that they say the flow that was asked for, and that nothing is destroyed.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "cases/case_files.hpp"
#include "cases/case_fixtures.hpp"
#include "io/openfoam_span.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::case_mesh;
using test::numbers_in;
using test::some_conditions;
using test::TemporaryFolder;
using test::text_of;
using test::value_of;

std::vector<cases::SolverCaseFile> openfoam_files(const SolverConditions& conditions,
                                                  const SolverCaseOptions& options = {}) {
    return cases::solver_case_files(FlowSolver::openfoam, case_mesh(), conditions, options);
}

TEST(SolverCase, NoPlaceholderIsLeft) {
    const std::regex placeholder("@[A-Z_]+@");
    for (const auto& [name, solver] : flow_solvers())
        for (const auto turbulence :
             {TurbulenceModel::spalart_allmaras, TurbulenceModel::k_omega_sst, TurbulenceModel::laminar})
            for (const bool special : {false, true}) {
                if (solver == FlowSolver::pyfr && turbulence != TurbulenceModel::laminar) continue;
                SolverConditions conditions = some_conditions();
                conditions.wall_functions = special;
                conditions.reference.mach = 0.2;
                for (const bool unsteady : {false, true}) {
                    SolverCaseOptions options{
                        .turbulence = turbulence, .compressible = special && !unsteady, .unsteady = unsteady};
                    if (solver == FlowSolver::openfoam && !special && !unsteady) options.adjoint = AdjointGoal::lift;
                    for (const cases::SolverCaseFile& file :
                         cases::solver_case_files(solver, case_mesh(), conditions, options)) {
                        EXPECT_FALSE(std::regex_search(file.text, placeholder)) << name << " " << file.name;
                        EXPECT_EQ(file.executable, file.text.starts_with("#!")) << file.name;
                    }
                }
            }
}

TEST(OpenFoamCase, ViscosityMakesTheReynoldsNumber) {
    for (const std::optional<double> velocity : {std::optional<double>{}, std::optional(30.0)}) {
        SolverConditions conditions = some_conditions();
        conditions.velocity = velocity;
        const auto files = openfoam_files(conditions);
        const double nu = std::stod(value_of(text_of(files, "constant/transportProperties"), "nu"));
        const std::string control = text_of(files, "system/controlDict");
        const double speed = std::stod(value_of(control, "magUInf"));
        EXPECT_EQ(speed, velocity.value_or(1));
        EXPECT_NEAR(speed * 2 / nu, 4e6, 1e-6);
        EXPECT_EQ(std::stod(value_of(control, "lRef")), 2);
        EXPECT_EQ(std::stod(value_of(control, "Aref")), 2 * io::openfoam_span);
        // nuTilda is 3 nu upstream, which makes nut 0.21 nu by the model.
        EXPECT_NEAR(numbers_in(value_of(text_of(files, "0/nuTilda"), "internalField")).at(0) / nu, 3, 1e-12);
        EXPECT_NEAR(numbers_in(value_of(text_of(files, "0/nut"), "internalField")).at(0) / nu, 0.2104, 1e-4);
    }
}

TEST(OpenFoamCase, DragFollowsTheStreamAndLiftIsUpwardsAcrossIt) {
    for (const double alpha : {-90.0, -7.0, 0.0, 10.0, 90.0}) {
        const auto files = openfoam_files(some_conditions(alpha));
        const std::string control = text_of(files, "system/controlDict");
        EXPECT_EQ(value_of(control, "dragDir"), "$dragDirection");
        EXPECT_EQ(value_of(control, "liftDir"), "$liftDirection");
        EXPECT_EQ(value_of(text_of(files, "0/U"), "internalField"), "uniform $streamVelocity");
        const std::string directions = text_of(files, "system/stream");
        const auto drag = numbers_in(value_of(directions, "dragDirection")),
                   lift = numbers_in(value_of(directions, "liftDirection")),
                   stream = numbers_in(value_of(directions, "streamVelocity"));
        const double radians = alpha * std::numbers::pi / 180;
        EXPECT_NEAR(drag.at(0), std::cos(radians), 1e-15);
        EXPECT_NEAR(drag.at(1), std::sin(radians), 1e-15);
        EXPECT_EQ(drag, stream);  // at the speed 1
        EXPECT_EQ(lift.at(0), -drag.at(1));
        EXPECT_EQ(lift.at(1), drag.at(0));
        // Moments are about a quarter of the chord behind the foremost vertex, (-1, 0).
        EXPECT_NEAR(numbers_in(value_of(control, "CofR")).at(0), -0.5, 1e-12);
    }
}

/// Returns the names of the patches of a field, in their order.
std::vector<std::string> patches_of(const std::string& text) {
    std::vector<std::string> names;
    const std::regex block("\n    ([^ \n]+)\n    \\{");
    for (std::sregex_iterator match(text.begin(), text.end(), block), end; match != end; ++match)
        names.push_back((*match)[1]);
    return names;
}

/// Returns the names of the fields of a case. Each must have all patches.
std::set<std::string> fields_of(const SolverCaseOptions& options) {
    SolverConditions conditions = some_conditions();
    conditions.reference.mach = 0.2;
    std::set<std::string> fields;
    for (const cases::SolverCaseFile& file : openfoam_files(conditions, options)) {
        if (!file.name.string().starts_with("0/")) continue;
        fields.insert(file.name.filename().string());
        EXPECT_EQ(patches_of(file.text), (std::vector<std::string>{"wall", "farfield", "frontAndBack"})) << file.name;
    }
    return fields;
}

TEST(OpenFoamCase, EveryFieldHasEveryPatch) {
    using Names = std::set<std::string>;
    constexpr auto sa = TurbulenceModel::spalart_allmaras, sst = TurbulenceModel::k_omega_sst;
    EXPECT_EQ(fields_of({.turbulence = sa}), (Names{"U", "nuTilda", "nut", "p"}));
    EXPECT_EQ(fields_of({.turbulence = sst}), (Names{"U", "k", "nut", "omega", "p"}));
    EXPECT_EQ(fields_of({.turbulence = TurbulenceModel::laminar}), (Names{"U", "p"}));
    EXPECT_EQ(fields_of({.turbulence = sa, .compressible = true}), (Names{"T", "U", "alphat", "nuTilda", "nut", "p"}));
    EXPECT_EQ(fields_of({.turbulence = sst, .compressible = true}),
              (Names{"T", "U", "alphat", "k", "nut", "omega", "p"}));
}

// A wedge has no patch at its axis, but one at the ceiling of a tunnel.
TEST(OpenFoamCase, AWedgeHasNoPatchAtItsAxis) {
    Mesh mesh = case_mesh();
    for (const char* name : {"axis", "ceiling"}) {
        mesh.markers.push_back({name, MarkerKind::symmetry, {mesh.markers[1].edges.back()}});
        mesh.markers[1].edges.pop_back();
    }
    SolverConditions conditions = some_conditions(0);
    conditions.axisymmetric = true;
    const auto files = cases::solver_case_files(FlowSolver::openfoam, mesh, conditions, {});
    EXPECT_EQ(patches_of(text_of(files, "0/U")),
              (std::vector<std::string>{"wall", "farfield", "ceiling", "\"(z0|z1)\""}));
}

// OpenFOAM's group of all walls, `wall`, does not exist where a patch has that name.
TEST(OpenFoamCase, NamesItsWallsOneByOne) {
    Mesh mesh = case_mesh();
    mesh.markers.push_back({"flap-2", MarkerKind::wall, {mesh.markers[0].edges.back()}});
    mesh.markers[0].edges.pop_back();
    const auto files = cases::solver_case_files(FlowSolver::openfoam, mesh, some_conditions(), {});
    for (const char* field : {"0/U", "0/p", "0/nut", "0/nuTilda"})
        EXPECT_EQ(patches_of(text_of(files, field)),
                  (std::vector<std::string>{"\"(wall|flap-2)\"", "farfield", "frontAndBack"}));
    EXPECT_EQ(value_of(text_of(files, "system/controlDict"), "patches"), "(wall flap-2)");
}

TEST(OpenFoamCase, AGasHasTheMachNumberAndDensityOneUpstream) {
    for (const double mach : {0.05, 0.2, 0.6}) {
        SolverConditions conditions = some_conditions();
        conditions.reference.mach = mach;
        conditions.velocity = 50;
        const auto files = openfoam_files(conditions, {.compressible = true});
        const std::string gas = text_of(files, "constant/thermophysicalProperties");
        const double per_mass = 8314.46261815324 / std::stod(value_of(gas, "molWeight"));
        const double heat_capacity = std::stod(value_of(gas, "Cp")), viscosity = std::stod(value_of(gas, "mu"));
        const double temperature = numbers_in(value_of(text_of(files, "0/T"), "internalField")).at(0);
        const double pressure = std::stod(value_of(text_of(files, "system/medium.compressible"), "forcePressure"));
        EXPECT_NEAR(heat_capacity / (heat_capacity - per_mass), 1.4, 1e-12);
        EXPECT_NEAR(pressure / (per_mass * temperature), 1, 1e-12);
        EXPECT_NEAR(50 / std::sqrt(1.4 * per_mass * temperature), mach, 1e-12);
        EXPECT_NEAR(50 * 2 / viscosity, 4e6, 1e-6);
        EXPECT_EQ(value_of(text_of(files, "system/controlDict"), "application"), "rhoSimpleFoam");
        EXPECT_EQ(value_of(text_of(files, "system/fvSolution"), "transonic"), mach > 0.3 ? "yes" : "no");
        EXPECT_NE(text_of(files, "Allrun").find(fmt::format("mach={} pressure={}\n", mach, pressure)),
                  std::string::npos);
    }
    EXPECT_EQ(value_of(text_of(openfoam_files(some_conditions()), "system/controlDict"), "application"), "simpleFoam");
    EXPECT_THROW(openfoam_files(some_conditions(), {.compressible = true}), OptionError) << "no Mach number";
    SolverConditions still = some_conditions();
    still.reference.mach = 0;
    EXPECT_THROW(openfoam_files(still, {.compressible = true}), OptionError);
}

/// From Mach 1 on the run starts with a gas, and each cell has a step of its own, which PISO takes. The far field
/// carries no vortex.
TEST(OpenFoamCase, SupersonicFlowIsSolvedInLocalSteps) {
    SolverConditions conditions = some_conditions();
    for (const double mach : {0.9, 1.0, 2.0}) {
        conditions.reference.mach = mach;
        const auto files = openfoam_files(conditions, {.compressible = true});
        const bool supersonic = mach >= 1;
        const std::string schemes = text_of(files, "system/fvSchemes"), pressure = text_of(files, "0/p");
        EXPECT_EQ(value_of(text_of(files, "system/controlDict"), "application"),
                  supersonic ? "rhoPimpleFoam" : "rhoSimpleFoam");
        EXPECT_EQ(schemes.find("localEuler") != std::string::npos, supersonic);
        const std::string solution = text_of(files, "system/fvSolution");
        EXPECT_EQ(solution.find("nCorrectors     3;") != std::string::npos, supersonic);
        EXPECT_EQ(value_of(solution, "\"U(Final)?\""), supersonic ? "1" : "0.9");
        EXPECT_EQ(value_of(text_of(files, "system/medium.compressible"), "pRelaxation"), supersonic ? "1" : "0.6");
        EXPECT_EQ(value_of(pressure, "supersonic"), supersonic ? "yes" : "no");
        EXPECT_EQ(value_of(pressure, "dimensions"), supersonic ? "[1 -1 -2 0 0 0 0]" : "[0 2 -2 0 0 0 0]");
        EXPECT_NEAR(numbers_in(value_of(pressure, "internalField")).at(0), supersonic ? 1 / (1.4 * mach * mach) : 0,
                    1e-12);
        EXPECT_NE(text_of(files, "Allrun").find(supersonic ? "vortex=no" : "vortex=yes"), std::string::npos);
    }
}

/// In a step the stream crosses no more than one edge of the shorter ones, and steps fill a convective time.
TEST(OpenFoamCase, StepsInTimeFollowTheMesh) {
    SolverConditions conditions = some_conditions();
    conditions.velocity = 50;
    const auto files = openfoam_files(conditions, {.unsteady = true});
    const std::string control = text_of(files, "system/controlDict"), run = text_of(files, "Allrun");
    EXPECT_EQ(value_of(control, "application"), "pimpleFoam");
    EXPECT_EQ(value_of(text_of(files, "system/medium"), "forceDensity"), "rhoInf");
    EXPECT_EQ(value_of(text_of(files, "system/fvSchemes"), "default"), "$timeScheme");
    std::smatch steps;
    ASSERT_TRUE(std::regex_search(run, steps, std::regex("step=(\\S+) steps=([0-9]+) ")));
    const double step = std::stod(steps[1]), of_time = std::stod(value_of(text_of(files, "system/march"), "timeStep"));
    EXPECT_EQ(value_of(control, "deltaT"), "$timeStep");
    EXPECT_EQ(step, of_time);
    EXPECT_NEAR(step * std::stod(steps[2]), 2.0 / 50, 1e-15);
    const Mesh mesh = case_mesh();
    std::size_t shorter = 0, outside = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.region[i] == Region::layer) continue;
        ++outside;
        double shortest = HUGE_VAL;
        for (unsigned k = 0; k < 3; ++k)
            shortest = std::min(shortest, distance(mesh.points[mesh.triangles[i].v[k].index()],
                                                   mesh.points[mesh.triangles[i].v[(k + 1) % 3].index()]));
        if (50 * step > shortest) ++shorter;
    }
    EXPECT_LE(shorter, (outside + 3) / 4);
    // Steady cases have none of this.
    for (const cases::SolverCaseFile& file : openfoam_files(conditions))
        EXPECT_EQ(file.text.find("pimpleFoam"), std::string::npos) << file.name;
}

TEST(OpenFoamCase, TheAdjointIsThatOfTheForceAskedFor) {
    const SolverConditions conditions = some_conditions(7);
    const auto names = [&](const SolverCaseOptions& options) {
        std::set<std::string> all;
        for (const auto& file : openfoam_files(conditions, options)) all.insert(file.name.string());
        return all;
    };
    for (const AdjointGoal goal : {AdjointGoal::drag, AdjointGoal::lift}) {
        const auto files = openfoam_files(conditions, {.adjoint = goal});
        const std::vector<double> direction =
            numbers_in(value_of(text_of(files, "system/optimisationDict"), "direction"));
        const bool of_lift = goal == AdjointGoal::lift;
        EXPECT_NEAR(direction.at(of_lift ? 1 : 0), std::cos(7 * std::numbers::pi / 180), 1e-12);
        EXPECT_NEAR(direction.at(of_lift ? 0 : 1), (of_lift ? -1 : 1) * std::sin(7 * std::numbers::pi / 180), 1e-12);
        EXPECT_NE(text_of(files, "system/fvSchemes").find("div(-phi,Ua)"), std::string::npos);
    }
    EXPECT_EQ(names({}).count("Alladjoint"), 0u);
    EXPECT_EQ(names({.adjoint = AdjointGoal::drag}).count("adjoint/nuaTilda"), 1u);
    // No adjoint of the other models is there: their viscosity stays.
    const SolverCaseOptions sst{.turbulence = TurbulenceModel::k_omega_sst, .adjoint = AdjointGoal::drag};
    EXPECT_EQ(names(sst).count("adjoint/nuaTilda"), 0u);
    EXPECT_EQ(value_of(text_of(openfoam_files(conditions, sst), "constant/adjointRASProperties"), "adjointRASModel"),
              "adjointLaminar");
    EXPECT_THROW(openfoam_files(conditions, {.unsteady = true, .adjoint = AdjointGoal::drag}), OptionError);
    SolverConditions fast = conditions;
    fast.reference.mach = 0.2;
    EXPECT_THROW(openfoam_files(fast, {.compressible = true, .adjoint = AdjointGoal::drag}), OptionError);
    EXPECT_THROW(cases::solver_case_files(FlowSolver::su2, case_mesh(), fast, {.adjoint = AdjointGoal::drag}),
                 OptionError);
}

TEST(OpenFoamCase, InTimeIsIncompressible) {
    SolverConditions conditions = some_conditions();
    conditions.reference.mach = 0.2;
    EXPECT_THROW(openfoam_files(conditions, {.compressible = true, .unsteady = true}), OptionError);
}

TEST(OpenFoamCase, InletAndOutletBothHaveTheFarFieldsConditions) {
    Mesh mesh = case_mesh();
    Marker& far = mesh.markers[1];
    far.name = "inlet";
    const auto half = static_cast<std::ptrdiff_t>(far.edges.size() / 2);
    Marker outlet{"outlet", MarkerKind::far_field, {far.edges.begin() + half, far.edges.end()}};
    far.edges.resize(static_cast<std::size_t>(half));
    mesh.markers.push_back(outlet);
    const auto files = cases::solver_case_files(FlowSolver::openfoam, mesh, some_conditions());
    EXPECT_EQ(patches_of(text_of(files, "0/U")).at(1), "\"(inlet|outlet)\"");
    EXPECT_NE(text_of(files, "Allrun").find("far_fields=\"inlet outlet\""), std::string::npos);
}

TEST(OpenFoamCase, WallFunctionsWhereTheFirstCellsAreHigh) {
    SolverConditions conditions = some_conditions();
    EXPECT_EQ(text_of(openfoam_files(conditions), "0/nut").find("WallFunction"), std::string::npos);
    conditions.wall_functions = true;
    EXPECT_NE(text_of(openfoam_files(conditions), "0/nut").find("nutUSpaldingWallFunction"), std::string::npos);
}

TEST(SolverCase, RefusesWhatNoCaseCanBeMadeOf) {
    SolverConditions conditions = some_conditions();
    conditions.reference.reynolds.reset();
    EXPECT_THROW(openfoam_files(conditions), OptionError);
    for (const std::size_t missing : {0u, 1u}) {
        Mesh mesh = case_mesh();
        mesh.markers[missing].kind = MarkerKind::other;
        EXPECT_THROW(cases::solver_case_files(FlowSolver::openfoam, mesh, some_conditions()), MeshError);
    }
}

TEST(SolverCase, LargeAnglesAreApproachedFromTenDegrees) {
    const auto angles = [](FlowSolver solver, double alpha) {
        const std::string run =
            text_of(cases::solver_case_files(solver, case_mesh(), some_conditions(alpha)), "Allrun");
        const std::size_t begin = run.find("angles=\"") + 8;
        return run.substr(begin, run.find('"', begin) - begin);
    };
    for (const FlowSolver solver : {FlowSolver::openfoam, FlowSolver::su2}) {
        for (const char* alone : {"0", "10", "12", "-12", "30.5", "90"})
            EXPECT_EQ(angles(solver, std::stod(alone)), alone);
    }
    EXPECT_EQ(angles(FlowSolver::openfoam, 17), "10 11 12 13 14 15 16 17");
    EXPECT_EQ(angles(FlowSolver::openfoam, -12.5), "-10 -10.8 -11.7 -12.5");
    EXPECT_EQ(angles(FlowSolver::su2, 15), "10 12.5 15");
    EXPECT_EQ(angles(FlowSolver::su2, -17), "-10 -12.3 -14.7 -17");
}

TEST(SolverCase, Su2GetsNoTrianglesInTheLayer) {
    EXPECT_THROW(cases::solver_case_files(FlowSolver::su2, test::annulus(), some_conditions()), UsageError);
    EXPECT_NO_THROW(cases::solver_case_files(FlowSolver::su2, case_mesh(), some_conditions()));
}

/// Returns the flow round NACA 0012, without boundary layers.
Flow flow_of_section(double alpha_deg) {
    return solve_flow(read_geometry(std::vector<std::string>{"naca:0012"}), {.alpha_deg = alpha_deg});
}

TEST(SolverCase, WarnsOfSpeedsThatItsMeshIsNotMadeFor) {
    const auto warned = [](double mach, double alpha_deg, bool knows_shocks = false) {
        const Flow flow = flow_of_section(alpha_deg);
        const auto warnings = find_speed_warnings(mach, &flow, knows_shocks);
        EXPECT_TRUE(warnings.empty() || warnings[0].code == WarningCode::unsuited_speed);
        return !warnings.empty();
    };
    // Critical at Mach 0.51 at 4 degrees, and at 0.29 at 10: there the flow is supersonic along 1 % of the chord.
    for (const double alpha_deg : {0.0, 4.0, 10.0, 15.0}) {
        EXPECT_FALSE(warned(0.15, alpha_deg)) << alpha_deg;
        EXPECT_TRUE(warned(0.7, alpha_deg)) << alpha_deg;
        EXPECT_FALSE(warned(0.7, alpha_deg, true)) << alpha_deg;
        EXPECT_TRUE(warned(2, alpha_deg)) << alpha_deg;
    }
    EXPECT_FALSE(warned(0.3, 10));
    EXPECT_TRUE(warned(0.45, 10));
    EXPECT_FALSE(warned(0.45, 0));
    EXPECT_TRUE(find_speed_warnings(0.3, nullptr, false).empty());
    EXPECT_EQ(find_speed_warnings(0.7, nullptr, false).size(), 1u);
}

TEST(SolverCase, WarnsOfThinTriangles) {
    EXPECT_TRUE(find_solver_warnings(FlowSolver::openfoam, case_mesh()).empty());
    const Mesh triangles = test::annulus();
    const auto warnings = find_solver_warnings(FlowSolver::openfoam, triangles);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].code, WarningCode::unsuited_to_solver);
    EXPECT_EQ(warnings[0].number, std::count(triangles.region.begin(), triangles.region.end(), Region::layer));
}

TEST(SolverCase, FilesAreThoseAnnouncedAndNothingElseIsTouched) {
    namespace fs = std::filesystem;
    for (const auto& [name, solver] : flow_solvers()) {
        const TemporaryFolder folder;
        fs::create_directories(folder / "case/system");
        folder.write("case/system/notes", "mine");
        const fs::path path = folder / "case";
        SolverConditions gas = some_conditions();
        gas.reference.mach = 0.2;
        write_solver_case(solver, case_mesh(), gas, folder / "gas", {.compressible = true});
        for (const fs::path& file : solver_case_outputs(solver, folder / "gas", {.compressible = true}))
            EXPECT_TRUE(fs::exists(file)) << file;
        fs::remove_all(folder / "gas");
        write_solver_case(solver, case_mesh(), some_conditions(), path);
        for (const fs::path& file : solver_case_outputs(solver, path)) EXPECT_TRUE(fs::exists(file)) << file;
        EXPECT_EQ(folder.read("case/system/notes"), "mine");
        const char* const mesh = solver == FlowSolver::openfoam ? ""
                                 : solver == FlowSolver::su2    ? "mesh.su2"
                                                                : "mesh.msh";
        EXPECT_EQ(mesh_hash(read_mesh(path / mesh)), mesh_hash(case_mesh()));

        // Any one file of the case is enough to refuse the folder.
        for (const fs::path& file : solver_case_outputs(solver, path)) {
            const fs::path copy = folder / "copy" / fs::relative(file, path);
            fs::create_directories(copy.parent_path());
            fs::copy(file, copy, fs::copy_options::recursive);
            EXPECT_THROW(write_solver_case(solver, case_mesh(), some_conditions(), folder / "copy"), UsageError);
            fs::remove_all(folder / "copy");
        }
        EXPECT_NO_THROW(write_solver_case(solver, case_mesh(), some_conditions(), path, {.overwrite = true}));
        if (solver == FlowSolver::openfoam) {
            EXPECT_NE(fs::status(path / "Allrun").permissions() & fs::perms::owner_exec, fs::perms::none);
        }
    }
}

}  // namespace
}  // namespace lamina
