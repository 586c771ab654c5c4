// What the file of SU2's case says about this flow and this mesh.
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/words.hpp"
#include "core/reproducible_math.hpp"

namespace lamina::cases {

namespace {

/// Returns the names of all walls, each followed by a value.
std::string walls_with(const CaseFlow& flow, std::string_view value) {
    std::vector<std::string> pairs;
    for (const std::string& wall : flow.all_walls()) pairs.push_back(fmt::format("{}, {}", wall, value));
    return fmt::format("{}", fmt::join(pairs, ", "));
}

constexpr double heat_ratio = 1.4, gas_constant = 287.058, temperature = 300;  // air at FREESTREAM_TEMPERATURE

/// Returns the speed of the free stream in m/s, as SU2 takes it.
double stream_speed(const CaseFlow& flow) { return flow.mach * su2_sound_speed(); }

/// Returns the Mach number behind a row: flow without losses keeps its mass and leaves in this direction. Where no Mach
/// number up to 1 has so much mass in so narrow a stream, it is 1.
double exit_mach(double mach, double alpha_deg, double exit_deg) {
    constexpr int halvings = 60;
    const auto mass = [](double m) { return m / core::pow_reproducible(1 + 0.5 * (heat_ratio - 1) * m * m, 3); };
    const double wanted =
        mass(mach) * core::cos_reproducible(core::radians(alpha_deg)) / core::cos_reproducible(core::radians(exit_deg));
    double low = 0, high = 1;
    for (int i = 0; i < halvings; ++i) (mass(0.5 * (low + high)) < wanted ? low : high) = 0.5 * (low + high);
    return high;
}

/// Returns the conditions at the inlet, the outlet and both borders of a row: total ones and the direction of the flow,
/// the static pressure, and the way from one border to the other.
std::string row_conditions(const CaseFlow& flow, const BladeRow& row) {
    // Sutherland's law, as SU2 has it for air.
    constexpr double viscosity = 1.716e-5, at_temperature = 273.15, constant = 110.4;
    const double ratio = temperature / at_temperature;
    const double mu = viscosity * ratio * std::sqrt(ratio) * (at_temperature + constant) / (temperature + constant);
    const double density = flow.reynolds * mu / (stream_speed(flow) * flow.chord);
    const auto total_over_static = [](double mach) { return 1 + 0.5 * (heat_ratio - 1) * mach * mach; };
    const double total_temperature = temperature * total_over_static(flow.mach);
    const double exponent = heat_ratio / (heat_ratio - 1);
    const double total_pressure =
        density * gas_constant * temperature * core::pow_reproducible(total_over_static(flow.mach), exponent);
    const double exit = exit_mach(flow.mach, flow.alpha_deg, row.exit_deg);
    return fmt::format(
        "% Total temperature and pressure at the inlet, and the static pressure at the outlet with which flow without "
        "losses\n"
        "% that leaves along the rear of the blade, at {:.4g} degrees, has the Mach number above at the inlet.\n"
        "INLET_TYPE= TOTAL_CONDITIONS\n"
        "MARKER_INLET= ( {}, {:.10g}, {:.10g}, {:.10g}, {:.10g}, 0.0 )\n"
        "MARKER_OUTLET= ( {}, {:.10g} )\n"
        "MARKER_PERIODIC= ( {}, {}, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, {}, {}, 0.0 )",
        row.exit_deg, inlet_name, total_temperature, total_pressure, flow.direction.x, flow.direction.y, outlet_name,
        total_pressure / core::pow_reproducible(total_over_static(exit), exponent), row.lower, row.upper,
        row.translation.x, row.translation.y);
}

constexpr const char* steady_comment =
    R"(% Allrun changes AOA, ITER, RESTART_SOL and CONV_... where it needs to. To go on with an earlier run, rename
% restart_flow.dat to solution_flow.dat, set RESTART_SOL= YES, and run SU2_CFD case.cfg.)";

/// With the largest number of iterations to fill in.
constexpr const char* steady_end =
    R"(% ---- The end: drag and lift that have not changed over 200 iterations. SU2 counts changes of drag as shares of 0.1.
ITER= {}
CONV_FIELD= ( DRAG, LIFT )
CONV_STARTITER= 250
CONV_CAUCHY_ELEMS= 200
CONV_CAUCHY_EPS= 2E-7)";

/// With the seconds of a step to fill in.
constexpr const char* end_in_time =
    R"(% ---- Steps in time, each of inner iterations until the residual of the density has fallen to a hundredth
TIME_DOMAIN= YES
TIME_MARCHING= DUAL_TIME_STEPPING-2ND_ORDER
TIME_STEP= {}
MAX_TIME= 1E10
TIME_ITER= 2
RESTART_ITER= 2
READ_BINARY_RESTART= NO
INNER_ITER= 20
CONV_FIELD= REL_RMS_DENSITY
CONV_RESIDUAL_MINVAL= -2
CONV_STARTITER= 2)";

/// Adds what makes a case steady, or one in time.
void add_time_options(const CaseFlow& flow, Words& words) {
    constexpr const char* max_iterations = "5000";
    words["TIME_COLUMN"] = flow.time ? "TIME_DOMAIN, " : "";
    words["TIME_ITERATION"] = flow.time ? "TIME_ITER, " : "";
    words["OUTPUT_FREQUENCY"] = flow.time ? "1000000" : "1000";
    words["MAX_ITERATIONS"] = max_iterations;
    words["RUN_COMMENT"] = flow.time ? "% Allrun changes TIME_ITER, and starts with a steady run." : steady_comment;
    words["END_OPTIONS"] = fmt::format(steady_end, max_iterations);
    if (flow.time)
        words["END_OPTIONS"] =
            su2_steps_in_time(fmt::format("{}", flow.chord / (stream_speed(flow) * flow.time->per_time)));
}

/// Returns the lines of walls that move with the free stream.
std::string moving_walls(const CaseFlow& flow) {
    if (flow.moving_walls.empty()) return "";
    const double speed = stream_speed(flow);
    return fmt::format("SURFACE_MOVEMENT= MOVING_WALL\nMARKER_MOVING= ( {} )\nSURFACE_TRANSLATION_RATE= {} {} 0.0",
                       fmt::join(flow.moving_walls, ", "), speed * flow.direction.x, speed * flow.direction.y);
}

}  // namespace

double su2_sound_speed() { return std::sqrt(heat_ratio * gas_constant * temperature); }

std::string su2_steps_in_time(std::string_view seconds) { return fmt::format(end_in_time, seconds); }

Words su2_words(const CaseFlow& flow) {
    const bool sst = flow.turbulence == TurbulenceModel::k_omega_sst,
               laminar = flow.turbulence == TurbulenceModel::laminar;
    Words words;
    words["EQUATIONS"] = laminar ? "NAVIER_STOKES" : "RANS";
    words["TURBULENCE_MODEL"] = laminar ? "NONE" : sst ? "SST" : "SA";
    // Upstream, SST has the turbulence that NASA's Turbulence Modeling Resource recommends: k is 9e-9 times the square
    // of the speed of sound. Spalart-Allmaras has nuTilda / nu = 3, SU2's default.
    constexpr double k_over_sound_squared = 9e-9;
    const double mach_squared = flow.mach * flow.mach;
    const double intensity = std::sqrt(k_over_sound_squared / (1.5 * mach_squared));
    words["TURBULENCE_OPTIONS"] = sst ? fmt::format(
                                            "SST_OPTIONS= V2003m\nFREESTREAM_TURBULENCEINTENSITY= {:.4g}\n"
                                            "FREESTREAM_TURB2LAMVISCRATIO= 0.009",
                                            intensity)
                                  : laminar ? ""
                                            : "SA_OPTIONS= NONE";
    // A limiter stalls where there is no shock. Beyond the low Mach numbers Roe's scheme needs no correction, and
    // limits by the changes of an edge in 0.05 lengths (V. Venkatakrishnan, J. Comput. Phys. 118 (1995)).
    words["SPEED_OPTIONS"] = flow.mach <= largest_low_mach
                                 ? "LOW_MACH_CORR= YES\nSLOPE_LIMITER_FLOW= NONE"
                                 : "LOW_MACH_CORR= NO\nSLOPE_LIMITER_FLOW= VENKATAKRISHNAN\nVENKAT_LIMITER_COEFF= 0.05";
    words["SCREEN_TURBULENCE"] = laminar ? "RMS_ENERGY" : sst ? "RMS_TKE" : "RMS_NU_TILDE";
    words["MACH"] = fmt::format("{}", flow.mach);
    words["ALPHA"] = fmt::format("{}", flow.alpha_deg);
    words["REYNOLDS"] = fmt::format("{}", flow.reynolds);
    words["CHORD"] = fmt::format("{}", flow.chord);
    words["AREA"] = fmt::format("{}", flow.area);
    words["AXISYMMETRY"] = flow.axisymmetric ? "AXISYMMETRIC= YES" : "";
    words["MOMENT_X"] = fmt::format("{}", flow.moment_point.x);
    words["MOMENT_Y"] = fmt::format("{}", flow.moment_point.y);
    // SU2 goes from 10 to 15 degrees at once, too; the lift swings by half of itself then.
    constexpr double step_of_angles = 2.5;
    words["ANGLES"] = angles_of(flow, step_of_angles);
    add_time_options(flow, words);
    words["WALL_NAMES"] = fmt::format("{}", fmt::join(flow.walls, " "));
    words["WALLS"] = fmt::format("{}", fmt::join(flow.walls, ", "));
    words["HEAT_FLUXES"] = walls_with(flow, "0.0");
    words["OUTER_CONDITIONS"] = flow.row ? row_conditions(flow, *flow.row)
                                         : fmt::format("MARKER_FAR= ( {} )", fmt::join(flow.far_fields, ", "));
    words["SYMMETRIES"] = flow.symmetries.empty() ? "NONE" : fmt::format("{}", fmt::join(flow.symmetries, ", "));
    words["MOVING_WALLS"] = moving_walls(flow);
    words["WALL_FUNCTIONS"] =
        fmt::format("MARKER_WALL_FUNCTIONS= ( {} )",
                    walls_with(flow, flow.wall_functions ? "STANDARD_WALL_FUNCTION" : "NO_WALL_FUNCTION"));
    return words;
}

}  // namespace lamina::cases
