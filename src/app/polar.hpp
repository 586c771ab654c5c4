// Polars: forces at many angles of attack, as tables.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/coupled_flow.hpp>
#include <lamina/flow.hpp>
#include <lamina/geometry.hpp>
#include <lamina/pipeline.hpp>

namespace lamina::app {

/// The forces at one angle of attack, and what can be said of them. Numbers that nobody has found are empty.
struct PolarRow {
    double alpha_deg = 0;
    std::string state;   ///< whether the numbers can be trusted, in one word: "attached", "steady", "separated"
    bool steady = true;  ///< whether the state is one of a steady flow that the method is for
    std::optional<double> cl{}, cd{}, cdp{}, cm{};
    std::optional<double> top_xtr{},
        bottom_xtr{};                ///< transition on the longest element, as a share of its extent in x
    std::optional<double> y_plus{};  ///< the largest, on the mesh of the solver
    std::string note{};              ///< more about the state
};

/// What all rows of a polar have in common.
struct PolarConditions {
    std::string name;  ///< of the configuration: its files, or its elements where they have none
    std::optional<double> reynolds{}, mach{};
    std::optional<TransitionOptions> transition{};  ///< where flow and layers are solved together
    bool undisplaced = false;                       ///< whether a row has layers that do not displace the flow
};

/// A polar.
struct FlowPolar {
    PolarConditions conditions;
    std::vector<PolarRow> rows;
};

/// Returns what the rows of a polar of these bodies have in common.
PolarConditions polar_conditions(const Geometry& geometry, const ReferenceConditions& reference);

/// Returns the polar of the flow before the mesh at the angles of the options (FlowConditions::alphas), find_flows().
/// Where layers do not displace the flow, rows whose flow leaves a wall ahead of the trailing edge are not steady: that
/// method is none for separated flow.
FlowPolar flow_polar(Geometry geometry, const CaseOptions& options, const TransitionOptions& transition = {});

/// Returns the rows for people.
std::string polar_summary(const PolarConditions& conditions, std::span<const PolarRow> rows);
/// Returns the rows with their states as CSV.
std::string polar_csv(std::span<const PolarRow> rows);
/// Returns the polar in the format of XFOIL 6.99 (PACC), which has no states: rows that are not steady, and those of
/// which a number is not known, are left out.
std::string polar_of_xfoil(const PolarConditions& conditions, std::span<const PolarRow> rows);
/// Returns the polar in the format that the extension of a file says: .csv, .json, or else XFOIL's.
std::string polar_text(const std::string& file, const PolarConditions& conditions, std::span<const PolarRow> rows);

}  // namespace lamina::app
