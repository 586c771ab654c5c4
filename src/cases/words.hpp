// The files of a case have names between @ signs; this header declares the words that take their place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/solver_case.hpp>

#include "cases/templates.hpp"

namespace lamina::cases {

/// Steps of a case in time.
struct TimeSteps {
    int per_time = 1;  ///< steps in a convective time, chord / velocity
    int times = 1;     ///< convective times to run
};

inline constexpr const char *inlet_name = "inlet", *outlet_name = "outlet";

/// A row of blades, of which the mesh is one part.
struct BladeRow {
    std::string lower, upper;  ///< names of the markers of both borders
    Point translation;         ///< from the one below to the one above
    double exit_deg = 0;       ///< direction in which the rear of the blade points, to the x axis
};

/// The flow of a case with nothing left open.
struct CaseFlow {
    double chord = 1;
    double alpha_deg = 0;
    double reynolds = 0;
    double mach = 0;
    bool compressible = false;  ///< SolverCaseOptions::compressible
    double velocity = 1;
    std::optional<AdjointGoal> adjoint{};  ///< SolverCaseOptions::adjoint
    std::optional<TimeSteps> time{};       ///< empty: the flow is steady
    unsigned order = 1;                    ///< of the cells, and of the solution in PyFR
    double least_height = 0;               ///< of all cells, over their longest edges
    double viscosity = 0;                  ///< kinematic: velocity x chord / Reynolds number
    Point direction;                       ///< of the free stream, of length 1
    Point moment_point;
    bool wall_functions = false;
    TurbulenceModel turbulence = TurbulenceModel::spalart_allmaras;
    std::vector<std::string> walls;         ///< names of the markers of bodies, one or more
    std::vector<std::string> far_fields;    ///< likewise
    std::vector<std::string> symmetries;    ///< likewise, if any
    std::vector<std::string> outer_walls;   ///< SolverConditions::outer_walls
    std::vector<std::string> moving_walls;  ///< SolverConditions::moving_walls
    bool has_internal_lines = false;        ///< whether the mesh has markers inside it
    bool axisymmetric = false;              ///< SolverConditions::axisymmetric
    std::optional<BladeRow> row{};          ///< then the far fields are `inlet` and `outlet`
    double area = 1;                        ///< that coefficients count, for a span of 1 or for a body of revolution

    /// Returns the names of all walls, bodies first.
    std::vector<std::string> all_walls() const {
        std::vector<std::string> all = walls;
        all.insert(all.end(), outer_walls.begin(), outer_walls.end());
        return all;
    }
};

/// Up to this Mach number no flow round a section has a shock that is worth a scheme of its own.
inline constexpr double largest_low_mach = 0.3;

/// Returns the angles of attack, in degrees, at which a case is solved one after the other, each from the flow at the
/// one before and no more than a step away. The last one is the given one.
std::vector<double> angles_to(double alpha_deg, double largest_step);

/// Returns the angles at which Allrun solves a case: angles_to(), or that of the inlet flow of a row alone.
std::string angles_of(const CaseFlow& flow, double largest_step);

/// Return the words for the files of each solver.
Words openfoam_words(const CaseFlow& flow);
Words su2_words(const CaseFlow& flow);
/// Throws UsageError for flows and names of markers that PyFR does not know.
Words pyfr_words(const CaseFlow& flow);
/// Returns the speed of sound in the free stream of SU2's cases, in m/s.
double su2_sound_speed();
/// Returns the options of SU2's steps in time, each of so many seconds.
std::string su2_steps_in_time(std::string_view seconds);

}  // namespace lamina::cases
