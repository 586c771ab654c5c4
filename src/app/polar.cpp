#include "app/polar.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/compressible_flow.hpp>

#include "app/adapt_page.hpp"
#include "app/flow_run.hpp"
#include "app/report.hpp"

namespace lamina::app {

namespace {

/// A layer that leaves the wall behind this share of its side is taken for attached: at trailing edges that of
/// potential flow always does.
constexpr double attached_share = 0.95;

/// Returns the element with the longest sides.
const ElementFlow& longest(const Flow& flow) {
    return *std::max_element(flow.elements.begin(), flow.elements.end(), [](const auto& a, const auto& b) {
        return a.upper.back().s + a.lower.back().s < b.upper.back().s + b.lower.back().s;
    });
}

/// Returns where the layer of a side becomes turbulent, as a share of the element's extent in x; 1 where it does not.
double transition_on(const std::vector<FlowPoint>& side, const Box& box) {
    const auto turbulent = std::find_if(side.begin(), side.end(),
                                        [](const FlowPoint& p) { return p.state != BoundaryLayerState::laminar; });
    return turbulent == side.end() ? 1 : (turbulent->at.x - box.lower.x) / box.width();
}

/// Returns whether all layers are attached up to the last part of their walls. Bubbles, behind which a layer comes
/// back, count where that is said.
bool is_attached(const Flow& flow, bool bubbles_count) {
    for (const ElementFlow& element : flow.elements)
        for (const auto* side : {&element.upper, &element.lower}) {
            const FlowPoint* separation = nullptr;  // for good, or at all
            for (const FlowPoint& p : *side)
                if (p.state != BoundaryLayerState::separated) {
                    if (!bubbles_count) separation = nullptr;
                } else if (separation == nullptr) {
                    separation = &p;
                }
            if (separation != nullptr && separation->s < attached_share * side->back().s) return false;
        }
    return true;
}

void add_transition(const FoundFlow& found, PolarRow& row) {
    const ElementFlow& element = longest(found.flow);
    if (found.is_coupled()) {
        const auto& [upper, lower] = found.transitions[static_cast<std::size_t>(&element - found.flow.elements.data())];
        row.top_xtr = upper;
        row.bottom_xtr = lower;
        return;
    }
    Box box;
    for (const auto* side : {&element.upper, &element.lower})
        for (const FlowPoint& p : *side) box.include(p.at);
    row.top_xtr = transition_on(element.upper, box);
    row.bottom_xtr = transition_on(element.lower, box);
}

PolarRow row_of_incompressible_flow(const FoundFlow& found) {
    const Flow& flow = found.flow;
    PolarRow row{.alpha_deg = flow.alpha_deg, .state = "attached"};
    if (flow.estimated) {
        row.state = "failed";
        row.steady = false;
        row.note = flow.warnings.front().message;
        return row;
    }
    row.cl = found.forces.lift;
    row.cm = found.forces.moment;
    if (!found.has_layers) {
        row.state = "inviscid";
        return row;
    }
    row.cd = found.forces.drag;
    row.cdp = found.forces.drag - found.forces.friction_drag;
    add_transition(found, row);
    if (!is_attached(flow, !found.is_coupled())) {
        row.state = "separated";
        row.steady = found.is_coupled();
    }
    if (!flow.warnings.empty()) {
        row.state = found.loose ? "not coupled" : "stalled";
        row.steady = false;
        row.note = (found.loose ? flow.warnings.back() : flow.warnings.front()).message;
    }
    return row;
}

PolarRow row_of_compressible_flow(const CompressibleFlow& flow) {
    PolarRow row{.alpha_deg = flow.alpha_deg, .state = flow.has_layers ? "steady" : "inviscid"};
    row.cl = flow.lift;
    if (flow.has_layers) row.cd = flow.drag;
    if (!flow.converged) {
        row.state = "not steady";
        row.steady = false;
    }
    return row;
}

PolarRow row_of_flow(const FoundFlow& found) {
    return found.compressible ? row_of_compressible_flow(*found.compressible) : row_of_incompressible_flow(found);
}

std::string column(const std::optional<double>& value, int width, int digits) {
    return value ? fmt::format("{:{}.{}f}", *value, width, digits) : fmt::format("{:>{}}", "-", width);
}

Json json_number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace

PolarConditions polar_conditions(const Geometry& geometry, const ReferenceConditions& reference) {
    PolarConditions conditions{"", reference.reynolds, reference.mach};
    std::string before;
    for (const Element& element : geometry.elements) {
        const std::string& name = element.file.empty() ? element.name : element.file;
        if (name != before) conditions.name += (before.empty() ? "" : " ") + name;
        before = name;
    }
    return conditions;
}

FlowPolar flow_polar(Geometry geometry, const CaseOptions& options, const TransitionOptions& transition) {
    FlowPolar polar{polar_conditions(geometry, reference_conditions(options.conditions, geometry)), {}};
    bool coupled = false;
    for (const FoundFlow& found :
         find_flows(std::move(geometry), options, conditions_of_angles(options.conditions), transition)) {
        polar.rows.push_back(row_of_flow(found));
        coupled = coupled || found.is_coupled();
        polar.conditions.undisplaced = polar.conditions.undisplaced || is_undisplaced(found);
    }
    if (coupled) polar.conditions.transition = transition;
    return polar;
}

std::string polar_summary(const PolarConditions& conditions, std::span<const PolarRow> rows) {
    std::string text = "polar of " + conditions.name;
    if (conditions.reynolds) text += fmt::format(", Reynolds number {:.4g}", *conditions.reynolds);
    if (conditions.mach) text += fmt::format(", Mach {:.4g}", *conditions.mach);
    text += "\n   alpha       CL        CD       CDp       CM  Top_Xtr  Bot_Xtr";
    const bool has_y_plus = std::any_of(rows.begin(), rows.end(), [](const PolarRow& row) { return row.y_plus; });
    text += has_y_plus ? "       y+  state\n" : "  state\n";
    for (const PolarRow& row : rows)
        text +=
            fmt::format("{:8.3f} {} {} {} {} {} {}{}  {}\n", row.alpha_deg, column(row.cl, 8, 4), column(row.cd, 9, 5),
                        column(row.cdp, 9, 5), column(row.cm, 8, 4), column(row.top_xtr, 8, 4),
                        column(row.bottom_xtr, 8, 4), has_y_plus ? " " + column(row.y_plus, 8, 3) : "", row.state);
    if (conditions.undisplaced) text += undisplaced_line;
    return text;
}

std::string polar_csv(std::span<const PolarRow> rows) {
    std::string text = "alpha,CL,CD,CDp,CM,top_xtr,bottom_xtr,y_plus,state,steady\n";
    for (const PolarRow& row : rows)
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{}\n", row.alpha_deg, optional_text(row.cl), optional_text(row.cd),
                        optional_text(row.cdp), optional_text(row.cm), optional_text(row.top_xtr),
                        optional_text(row.bottom_xtr), optional_text(row.y_plus), row.state, row.steady ? "yes" : "no");
    return text;
}

namespace {

/// Returns the rows with their states as JSON.
Json polar_json(const PolarConditions& conditions, std::span<const PolarRow> rows) {
    Json list = Json::array();
    for (const PolarRow& row : rows)
        list.push_back({{"alpha", row.alpha_deg},
                        {"CL", json_number(row.cl)},
                        {"CD", json_number(row.cd)},
                        {"CDp", json_number(row.cdp)},
                        {"CM", json_number(row.cm)},
                        {"top_xtr", json_number(row.top_xtr)},
                        {"bottom_xtr", json_number(row.bottom_xtr)},
                        {"y_plus", json_number(row.y_plus)},
                        {"state", row.state},
                        {"steady", row.steady},
                        {"note", row.note}});
    return {{"name", conditions.name},
            {"reynolds", json_number(conditions.reynolds)},
            {"mach", json_number(conditions.mach)},
            {"undisplaced", conditions.undisplaced},
            {"rows", list}};
}

}  // namespace

std::string polar_of_xfoil(const PolarConditions& conditions, std::span<const PolarRow> rows) {
    const TransitionOptions transition = conditions.transition.value_or(TransitionOptions{.critical_exponent = 0});
    // Readers of the format look for what stands in these columns and lines.
    std::string text = fmt::format(
        " \n       XFOIL         Version 6.99\n  \n Calculated polar for: {:<48}\n  \n"
        " 1 1 Reynolds number fixed          Mach number fixed         \n  \n"
        " xtrf = {:7.3f} (top)    {:9.3f} (bottom)  \n"
        " Mach = {:7.3f}     Re = {:9.3f} e 6     Ncrit = {:7.3f}\n  \n"
        "   alpha    CL        CD       CDp       CM     Top_Xtr  Bot_Xtr\n"
        "  ------ -------- --------- --------- -------- -------- --------\n",
        conditions.name, transition.trip.value_or(1), transition.trip_lower.value_or(transition.trip.value_or(1)),
        conditions.mach.value_or(0), 1e-6 * conditions.reynolds.value_or(0), transition.critical_exponent);
    for (const PolarRow& row : rows)
        if (row.steady && row.cl && row.cd && row.cdp && row.cm && row.top_xtr && row.bottom_xtr)
            text += fmt::format("{:8.3f} {:8.4f} {:9.5f} {:9.5f} {:8.4f} {:8.4f} {:8.4f}\n", row.alpha_deg, *row.cl,
                                *row.cd, *row.cdp, *row.cm, *row.top_xtr, *row.bottom_xtr);
    return text;
}

std::string polar_text(const std::string& file, const PolarConditions& conditions, std::span<const PolarRow> rows) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension == ".csv") return polar_csv(rows);
    if (extension == ".json") return to_text(polar_json(conditions, rows));
    return polar_of_xfoil(conditions, rows);
}

}  // namespace lamina::app
