// What the files of OpenFOAM's case say about this flow and this mesh.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/io.hpp>

#include "cases/words.hpp"
#include "core/reproducible_math.hpp"
#include "io/formats.hpp"
#include "io/openfoam_span.hpp"

namespace lamina::cases {

namespace {

std::string number(double value) { return fmt::format("{}", value); }
std::string vector(double x, double y) { return fmt::format("({} {} 0)", x, y); }

/// Returns the lines of a boundary condition behind its first one, as deep as those of a patch.
std::string condition(const std::string& type, const std::string& value) {
    return fmt::format("type            {};\n        value           {};", type, value);
}

/// Returns the key of an entry for these patches. The group `wall`, which OpenFOAM makes of all walls, would not do: it
/// does not exist where a patch has that name.
std::string key_of_patches(const std::vector<std::string>& names) {
    if (names.size() == 1) return names.front();
    return fmt::format("\"({})\"", fmt::join(names, "|"));
}

/// Returns the entries that sample the faces of each wall.
std::string wall_surfaces(const std::vector<std::string>& walls) {
    std::string entries;
    for (const std::string& wall : walls)
        entries +=
            fmt::format("{}            {} {{ type patch; patches ({}); }}", entries.empty() ? "" : "\n", wall, wall);
    return entries;
}

/// Returns the conditions of patches of symmetry, to stand before another patch. A wedge has no patch at its axis.
std::string symmetry_patches(const CaseFlow& flow) {
    std::string patches;
    for (const std::string& name : flow.symmetries)
        if (!flow.axisymmetric || name != io::axis_name)
            patches += fmt::format("{}\n    {{\n        type            symmetry;\n    }}\n    ", name);
    return patches;
}

/// Returns the velocities of walls that move with the free stream, to stand before another patch. Names win over the
/// pattern that all walls match.
std::string moving_patches(const std::vector<std::string>& names) {
    std::string patches;
    for (const std::string& name : names)
        patches += fmt::format("{}\n    {{\n        {}\n    }}\n    ", name,
                               condition("fixedValue", "uniform $streamVelocity"));
    return patches;
}

/// Returns the conditions of both borders of a row of blades, to stand before another patch.
std::string cyclic_patches(const std::optional<BladeRow>& row) {
    std::string patches;
    if (row)
        for (const std::string& name : {row->lower, row->upper})
            patches += fmt::format("{}\n    {{\n        type            cyclic;\n    }}\n    ", name);
    return patches;
}

/// Returns whether the case is solved in steps of its own in each cell, from a free stream that nothing reaches from
/// behind. rhoSimpleFoam diverges there.
bool is_supersonic(const CaseFlow& flow) { return flow.compressible && flow.mach >= 1; }

/// Adds the velocity and the pressure of the far field, or of the inlet and the outlet of a row.
void add_outer_conditions(const CaseFlow& flow, Words& words) {
    if (flow.row) {
        words["OUTER_VELOCITY"] = fmt::format(
            "{}\n    {{\n        type            fixedValue;\n        value           uniform $streamVelocity;\n    "
            "}}\n"
            "    {}\n    {{\n        type            inletOutlet;\n        inletValue      uniform (0 0 0);\n"
            "        value           uniform $streamVelocity;\n    }}",
            inlet_name, outlet_name);
        words["OUTER_PRESSURE"] = fmt::format(
            "{}\n    {{\n        type            zeroGradient;\n    }}\n    {}\n    {{\n"
            "        type            fixedValue;\n        value           uniform 0;\n    }}",
            inlet_name, outlet_name);
        return;
    }
    const std::string patches = key_of_patches(flow.far_fields);
    words["OUTER_VELOCITY"] = fmt::format(
        "// Allrun gives each face of the far field the free stream and the velocity of a vortex of the present lift.\n"
        "    {}\n    {{\n        type            freestreamVelocity;\n        freestreamValue uniform "
        "$streamVelocity;\n"
        "    }}",
        patches);
    words["OUTER_PRESSURE"] = fmt::format(
        "// Allrun gives each face of the far field the pressure that belongs to the velocity there.\n"
        "    {}\n    {{\n        type            freestreamPressure;\n        freestreamValue uniform {};\n"
        "        supersonic      {};\n    }}",
        patches, words["START_PRESSURE"], is_supersonic(flow) ? "yes" : "no");
}

/// Adds what says which solver it is, and what a gas needs.
void add_medium(const CaseFlow& flow, Words& words) {
    words["APPLICATION"] = flow.time             ? "pimpleFoam"
                           : is_supersonic(flow) ? "rhoPimpleFoam"
                           : flow.compressible   ? "rhoSimpleFoam"
                                                 : "simpleFoam";
    words["MACH"] = number(flow.compressible ? flow.mach : 0);
    words["TRANSONIC"] = flow.compressible && flow.mach > largest_low_mach ? "yes" : "no";
    words["START_PRESSURE"] = words["PRESSURE"] = "0";
    words["PRESSURE_DIMENSIONS"] = "[0 2 -2 0 0 0 0]";
    if (!flow.compressible) return;
    // A gas of density 1 whose speed of sound is velocity / mach. OpenFOAM counts its energy from 298.15 K, where sums
    // of it round least.
    constexpr double heat_ratio = 1.4, temperature = 298.15, gas_constant = 8314.46261815324;
    const double sound_speed = flow.velocity / flow.mach;
    const double pressure = sound_speed * sound_speed / heat_ratio, per_mass = pressure / temperature;
    words["PRESSURE"] = number(pressure);
    words["TEMPERATURE"] = number(temperature);
    if (is_supersonic(flow)) {
        words["START_PRESSURE"] = words["PRESSURE"];
        words["PRESSURE_DIMENSIONS"] = "[1 -1 -2 0 0 0 0]";
    }
    // At rest a gas has stagnation_ratio times the temperature of the free stream.
    const double stagnation_ratio = 1 + 0.5 * (heat_ratio - 1) * flow.mach * flow.mach;
    words["LEAST_TEMPERATURE"] = number(temperature / (is_supersonic(flow) ? 4 : 2));
    words["LARGEST_TEMPERATURE"] = number(std::max(2.0, 1.5 * stagnation_ratio) * temperature);
    words["MOLAR_WEIGHT"] = number(gas_constant / per_mass);
    words["HEAT_CAPACITY"] = number(heat_ratio / (heat_ratio - 1) * per_mass);
    words["ALPHA_T_WALL"] =
        condition(flow.wall_functions ? "compressible::alphatWallFunction" : "fixedValue", "uniform 0");
}

/// Adds how the solver steps towards a steady state. In supersonic flow that is PISO (Issa 1986), whose three
/// corrections in each step make relaxation needless. Detached shocks swing or diverge with fewer, and with larger
/// Courant numbers.
void add_steps(const CaseFlow& flow, Words& words) {
    const bool local = is_supersonic(flow);
    words["BOUNDED"] = local ? "" : "bounded ";
    words["PRESSURE_CONVECTION"] = local ? "upwind" : "limitedLinear 1";
    words["ALGORITHM"] = local ? "PIMPLE" : "SIMPLE";
    words["CONSISTENT"] = local ? "no" : "yes";
    words["LEAST_PRESSURE"] = local ? "0.01" : "0.1";
    words["LARGEST_PRESSURE"] = local ? number(core::pow_reproducible(1 + 0.2 * flow.mach * flow.mach, 3.5)) : "2";
    words["GAS_PRESSURE_RELAXATION"] = local ? "1" : "0.6";
    words["FLOW_RELAXATION"] = local ? "1" : "0.9";
    words["SPALART_ALLMARAS_RELAXATION"] = local ? "1" : "0.8";
    words["SST_RELAXATION"] = local ? "1" : "0.7";
    words["LOCAL_STEPS"] = local ? R"(    nCorrectors     3;
    // The step of each cell.
    maxCo           2;
    maxDeltaT       1;
    rDeltaTSmoothingCoeff 0.1;
    rDeltaTDampingCoeff 1;
)"
                                 : "";
}

/// Adds what makes a case steady, or one in time.
void add_time_scheme(const CaseFlow& flow, Words& words) {
    const bool unsteady = flow.time.has_value();
    const TimeSteps time = flow.time.value_or(TimeSteps{});
    words["TIME_SCHEME"] = unsteady
                               ? "#include        \"march\"\n    default         $timeScheme;"
                               : fmt::format("default         {};", is_supersonic(flow) ? "localEuler" : "steadyState");
    words["MARCH"] =
        unsteady ? "#include        \"march\"         // the step, and from when on fields are averaged\n" : "";
    words["TIME_STEP"] = unsteady ? "$timeStep" : "1";
    words["STEP"] = number(flow.chord / flow.velocity / time.per_time);
    words["TIME_AXIS"] = unsteady ? "time" : "iteration";
    words["WRITE_CONTROL"] = unsteady ? "runTime" : "timeStep";
    words["SHEAR_CONTROL"] = unsteady ? "timeStep" : "writeTime";
    words["WALL_FIELDS"] = unsteady ? "pMean wallShearStressMean" : "p wallShearStress";
    constexpr double across = 0.3;  // share of the speed that a gust has
    const Point gust = flow.velocity * (flow.direction + across * Point{-flow.direction.y, flow.direction.x});
    words["GUST"] = vector(gust.x, gust.y);
    words["AVERAGE"] = unsteady ? R"(    average
    {
        type            fieldAverage;
        libs            ("libfieldFunctionObjects.so");
        timeStart       $averageFrom;
        writeControl    writeTime;
        fields
        (
            U { mean on; prime2Mean on; base time; }
            p { mean on; prime2Mean on; base time; }
            wallShearStress { mean on; prime2Mean off; base time; }
        );
    }
)"
                                : "";
}

/// Adds what the turbulence models need: conditions upstream and at walls.
void add_turbulence(const CaseFlow& flow, Words& words) {
    const double nu = flow.viscosity;
    const bool sst = flow.turbulence == TurbulenceModel::k_omega_sst;
    // Spalart-Allmaras: nuTilda / nu = 3 upstream, and nut follows by the model's function fv1.
    constexpr double chi = 3, cubed = chi * chi * chi, cv1_cubed = 7.1 * 7.1 * 7.1;
    // SST: as NASA's Turbulence Modeling Resource recommends at Mach 0.15; k is a share of the velocity squared.
    constexpr double k_share = 4e-7, sst_ratio = 0.009;
    const double k = k_share * flow.velocity * flow.velocity;
    const double nu_t = sst ? sst_ratio * nu : chi * nu * cubed / (cubed + cv1_cubed);
    words["SIMULATION_TYPE"] = flow.turbulence == TurbulenceModel::laminar ? "laminar" : "RAS";
    words["RAS_MODEL"] = sst ? "kOmegaSST" : "SpalartAllmaras";
    words["TURBULENCE_FIELDS"] = flow.turbulence == TurbulenceModel::laminar ? "" : sst ? "k omega" : "nuTilda";
    words["NU_TILDA"] = number(chi * nu);
    words["NU_T"] = number(nu_t);
    words["K"] = number(k);
    words["OMEGA"] = number(k / (sst_ratio * nu));
    // OpenFOAM's condition for omega asks the wall for a wall function; the one for low Reynolds numbers leaves nut 0.
    const char* resolved = sst ? "nutLowReWallFunction" : "fixedValue";
    words["NU_T_WALL"] = condition(flow.wall_functions ? "nutUSpaldingWallFunction" : resolved, "uniform 0");
    words["K_WALL"] = flow.wall_functions ? condition("kqRWallFunction", "uniform " + number(k))
                                          : condition("fixedValue", "uniform 0");
}

/// Adds what the adjoint solution needs. Its convection takes the flow's scheme; that of its turbulence is of first
/// order.
void add_adjoint(const CaseFlow& flow, Words& words) {
    const bool of_lift = flow.adjoint == AdjointGoal::lift;
    words["GOAL"] = of_lift ? "lift" : "drag";
    words["GOAL_DIRECTION"] = words[of_lift ? "LIFT_DIRECTION" : "DRAG_DIRECTION"];
    words["ADJOINT_ITERATIONS"] = "300";
    words["ADJOINT_MODEL"] =
        flow.turbulence == TurbulenceModel::spalart_allmaras ? "adjointSpalartAllmaras" : "adjointLaminar";
    words["ADJOINT_SCHEMES"] = flow.adjoint ? R"(    div(-phi,Ua)    bounded Gauss linearUpwind limited;
    div(-phi,nuaTilda) bounded Gauss upwind;
    div((nuEff*dev(grad(Ua).T()))) Gauss linear;
    div((momentumSourceMult*nuaTilda)) Gauss linear;
)"
                                            : "";
}

}  // namespace

Words openfoam_words(const CaseFlow& flow) {
    const double u = flow.velocity * flow.direction.x, v = flow.velocity * flow.direction.y;
    Words words;
    const std::string mach = flow.compressible ? fmt::format("Mach number {}, ", flow.mach) : "";
    words["TITLE"] = fmt::format("Reynolds number {}, {}angle of attack {} degrees, chord {}", flow.reynolds, mach,
                                 flow.alpha_deg, flow.chord);
    words["FAR_FIELD"] = key_of_patches(flow.far_fields);
    words["WALL"] = key_of_patches(flow.all_walls());
    words["MOVING_WALLS"] = moving_patches(flow.moving_walls);
    words["FAR_FIELDS"] = fmt::format("{}", fmt::join(flow.far_fields, " "));
    words["WALLS"] = fmt::format("{}", fmt::join(flow.walls, " "));
    words["SYMMETRIES"] = symmetry_patches(flow) + cyclic_patches(flow.row);
    words["ENDS"] = flow.axisymmetric ? "\"(z0|z1)\"" : "frontAndBack";
    words["ENDS_TYPE"] = flow.axisymmetric ? "wedge" : "empty";
    words["VORTEX"] =
        flow.symmetries.empty() && flow.outer_walls.empty() && !flow.row && !is_supersonic(flow) ? "yes" : "no";
    words["WALL_SURFACES"] = wall_surfaces(flow.walls);
    words["VELOCITY_VECTOR"] = vector(u, v);
    words["VELOCITY"] = number(flow.velocity);
    words["NU"] = number(flow.viscosity);
    words["CHORD"] = number(flow.chord);
    words["AREA"] = number(flow.area * (flow.axisymmetric ? io::foam_wedge_deg / 360 : io::openfoam_span));
    // At each step lift swings by 0.2 per degree before it settles.
    constexpr double step_of_angles = 1;
    words["ANGLES"] = angles_of(flow, step_of_angles);
    words["DRAG_DIRECTION"] = vector(flow.direction.x, flow.direction.y);
    words["LIFT_DIRECTION"] = vector(-flow.direction.y, flow.direction.x);
    // Lift acts a quarter of the chord behind the nose of a thin section.
    words["VORTEX_X"] = number(flow.moment_point.x);
    words["VORTEX_Y"] = number(flow.moment_point.y);
    words["MAX_ITERATIONS"] = "8000";
    words["MOMENT_POINT"] = vector(flow.moment_point.x, flow.moment_point.y);
    add_time_scheme(flow, words);
    add_medium(flow, words);
    add_outer_conditions(flow, words);
    add_steps(flow, words);
    add_turbulence(flow, words);
    add_adjoint(flow, words);
    return words;
}

}  // namespace lamina::cases
